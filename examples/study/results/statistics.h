/*
 * statistics: quantiles.
 */
#ifndef STATISTICS_H
#define STATISTICS_H

/* Sorts the values and interpolates a quantile (0.5: the median). NaN if there are none. */
double statistics_quantile(double *values, int count, double share);

#endif
