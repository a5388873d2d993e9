/*
 * choose: the best of the measured settings within a limit of error or time.
 */
#ifndef CHOOSE_H
#define CHOOSE_H

#include "study/measure/survey.h"
#include "study/results/front.h"

/* Milliseconds per frame, or an error of this kind in steps of 1/255. */
typedef struct ChooseLimit {
    bool is_time;
    double value;
    ErrorKind kind;
} ChooseLimit;

/* Prints the cheapest setting of a surveyed scene within a limit of error, or the most exact one
 * within a limit of time; those tied with it, of which it is the most usual; and what less error or
 * less time would cost. The best settings are measured again, against each other, before one is
 * chosen: what the survey measured one after another depends on what else ran. False if none is
 * within the limit, both times. */
bool choose(Survey *survey, int scene, const ChooseLimit *limit, Message *message);

#endif
