/*
 * choose: one of the measured settings, by what is allowed of error or of time.
 */
#ifndef CHOOSE_H
#define CHOOSE_H

#include "survey.h"

/* Says on standard output the cheapest setting of a surveyed scene whose error inside objects is at
 * most `error`, the largest or with `rms` its root mean square; measures that setting once more,
 * and says what the next cheaper one would cost in error. False where none is so exact, or where
 * the second measurement does not confirm it. */
bool choose_by_error(Survey *survey, int scene, double error, bool rms, Message *message);

/* The same the other way round: the most exact setting whose frame takes at most so many
 * milliseconds, and what the next slower one would gain. Where the second measurement takes longer,
 * it says so: time is no property of a setting alone. */
bool choose_by_time(Survey *survey, int scene, double milliseconds, bool rms, Message *message);

/* Writes the table of efficient settings for each class of scenes, and says where. All scenes have
 * been surveyed. A setting's error for a class is the largest in any of its scenes. */
bool choose_calibrate(Survey *survey, Message *message);

#endif
