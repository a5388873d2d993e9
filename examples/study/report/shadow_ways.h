/*
 * shadow_ways: how far shadows by maps of each size, bias and filter are from the exact picture,
 * beside those by volumes; and their time.
 *
 * Errors are the root mean square in steps of 1/255 of the pixels within two of a shadow's edge,
 * against the exact picture of the same meshes at the pixels' centers, as without antialiasing.
 * Times are medians of ratios to a frame without shadows, drawn in turn; of the processor, where it
 * draws.
 */
#ifndef SHADOW_WAYS_H
#define SHADOW_WAYS_H

#include "study/measure/survey.h"

#include <stdio.h>

enum { SHADOW_SCENES = 2, SHADOW_MAP_SIZES = 7, SHADOW_MAP_KINDS = 5 };

typedef struct ShadowTime {
    double ratio, lower, upper; /* over a frame without shadows: median and quartiles */
} ShadowTime;

typedef struct ShadowMeasured {
    double error, all;        /* rms near shadows' edges, and of all pixels */
    long long wrong;          /* pixels inside, off by more than a step */
    ShadowTime still, moving; /* the latter: a light moves, so that a map is drawn again */
} ShadowMeasured;

/* Of each scene; what was not measured has a ratio of 0. */
typedef struct ShadowWays {
    struct {
        ShadowMeasured volumes;
        ShadowMeasured maps[SHADOW_MAP_KINDS][SHADOW_MAP_SIZES];
    } scenes[SHADOW_SCENES];
    char with[RESULT_WITH_SIZE]; /* what was measured with */
} ShadowWays;

/* Measures, prints a table and writes FOLDER/shadows.csv. A quick survey has one scene, and few
 * maps. */
bool shadow_ways_report(Survey *survey, const char *folder, bool markdown, FILE *file,
                        ShadowWays *ways, Message *message);

/* For each scene that was measured FOLDER/finding-shadows-NAME.svg and .png, the error by the size
 * of the map, and finding-shadows-NAME-time, the time. Volumes are a horizontal line. */
bool shadow_ways_plot(const ShadowWays *ways, const char *folder, Message *message);

#endif
