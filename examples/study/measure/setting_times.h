/*
 * setting_times: measures settings of a scene against each other.
 *
 * Settings are measured in batches, together with the usual setting, twice (the A/A noise), and
 * with a frame that draws nothing. Each round visits all of them in random order and draws one
 * frame untimed and one timed. A setting's time is its median ratio to the usual one in the same
 * round, or if that is noisy the ratio of their fastest tenths, times the fastest tenth of the
 * usual one's at the start of the scene: neither a machine that slows down nor other programs
 * change much.
 */
#ifndef SETTING_TIMES_H
#define SETTING_TIMES_H

#include "study/measure/setting_picture.h"
#include "study/results/results.h"

enum { SETTING_TIMES_BATCH = 16, SETTING_TIMES_MAX_ROUNDS = 9 };

/* A set of settings, in order of insertion. */
typedef struct QualityList {
    Quality *qualities;
    int count, capacity;
} QualityList;
void quality_list_add(QualityList *list, const Quality *quality);
void quality_list_close(QualityList *list);

/* The settings to measure for a scene: the usual one; each other choice of each axis; useful
 * combinations. `quick`: a tenth of them. */
void setting_times_plan(bool quick, QualityList *list);

typedef struct SettingTimes {
    SettingRenderer *renderer;
    const Scene *scene;
    const Reference *exact;
    ResultRow like; /* scene, size, renderer, threads, seed */
    double usual;   /* milliseconds of the usual setting; 0: not known yet */
    /* Set by a signal handler: stop. */
    const volatile int *interrupted;
} SettingTimes;

/* Measures up to SETTING_TIMES_BATCH settings in about `seconds` and writes a row for each. False
 * on failure or interruption (with an empty message). Sets times->usual if that is 0; the usual
 * setting must then be among `qualities`. */
bool setting_times_measure(SettingTimes *times, const Quality *qualities, int count, double seconds,
                           ResultRow *rows, Message *message);

#endif
