/*
 * statistics: of a few numbers.
 */
#ifndef STATISTICS_H
#define STATISTICS_H

/* Sorts the values and gives a quantile of them (0.5: the median), between the nearest two. Not a
 * number where there are none. */
double statistics_quantile(double *values, int count, double share);

#endif
