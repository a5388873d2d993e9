/*
 * conclusions: what a study's rows say: in a sentence each, in plots and tables of the rows that
 * answer one question, and as a page.
 */
#ifndef CONCLUSIONS_H
#define CONCLUSIONS_H

#include "study/measure/survey.h"
#include "study/results/results.h"

#include <limits.h>
#include <stdio.h>

/* "1.3 steps: Phong interpolation 1.8 ms, Gouraud 17 ms": the smallest largest error inside objects
 * that both reach, and what that takes; which times differ by no more than the noise. Empty if one
 * of them was not measured, or the machine was busy. */
enum { CONCLUSION_SIZE = 320 };
void conclusion_of_scene(const Results *results, const char *scene, char text[CONCLUSION_SIZE]);

/* What one change of a setting costs, over the scenes in which it was measured: a row of the first
 * screen. */
enum { GLANCE_TEXT = 96 };
typedef struct Glance {
    const char *name, *file;   /* "4 samples"; of its picture, without an ending */
    const char *setting;       /* NULL: shadows */
    double ratio, least, most; /* the time over the usual one's: median and range; NAN: unknown */
    double more;               /* by how many steps the error grows at most */
    int scene;                 /* its number; -1: none of the study's */
    char time[GLANCE_TEXT], error[GLANCE_TEXT], verdict[GLANCE_TEXT];
} Glance;

/* How far a ratio is from 1: -1 to 1 for a quarter to four times; 0 of NAN. */
double glance_bar(double ratio);

/* The rows whose measurements there are, and up to CONCLUSIONS lines. The first line says what was
 * measured, with how much noise. */
enum { CONCLUSIONS = 4, GLANCES = 7 };
typedef struct Conclusions {
    char lines[CONCLUSIONS][CONCLUSION_SIZE];
    Glance glances[GLANCES];
    int count, glance_count;
    bool busy; /* the machine, for some scenes: the first line says it */
} Conclusions;

/* Of these scenes, by their numbers. */
struct ShadowWays;
Conclusions conclusions_of(const Results *results, const int *scenes, int count,
                           const ModelsApart *apart, const struct ShadowWays *ways);

/* The first line, the rows, the other lines, and where the page is. On a terminal with colours the
 * rows are cells, each with the difference of its picture in the folder. */
void conclusions_print(const Conclusions *conclusions, const char *folder, FILE *file);

/* FOLDER/glance-FILE.png, the picture of a row. */
void glance_path(const char *file, const char *folder, char path[PATH_MAX]);

/* Into the folder, as FOLDER/finding-NAME.svg and .png:
 *   interpolation  Gouraud's and Phong's error over time as divisions grow
 *   precision      the error of mediump, scene by scene
 *   guards         the time of guards
 *   viewer         the error of a viewer at infinity
 *   antialiasing   the error of all pixels over time
 *   matrices       the error of arithmetic and order, far from the origin
 * Missing rows are left out, empty plots, and times where the machine was busy. False if gnuplot is
 * missing; the message names the package. */
bool findings_plot(const Results *results, const char *folder, Message *message);

/* A table: the time of composing the matrices of one object and the position of one light, in each
 * arithmetic and order, and the error of the scene far from the origin. False: no memory. */
void findings_matrices(const Results *results, bool markdown, FILE *file);

/* The numbers of these plots as Markdown tables. False: no memory. */
void findings_tables(const Results *results, FILE *file);

/* FOLDER/index.html: for each scene, by its number, a sentence and its plot; then the conclusions,
 * and the plots of findings. Plots and sheets are linked if they are in the folder, and all tables.
 */
bool report_page(const Results *results, const int *scenes, int count,
                 const Conclusions *conclusions, const char *folder, Message *message);

/* How far shadows by maps of each size, bias and filter are from the exact picture, beside those by
 * volumes; and their time.
 *
 * Errors are the root mean square in steps of 1/255 of the pixels within two of a shadow's edge,
 * against the exact picture of the same meshes at the pixels' centers, as without antialiasing.
 * Times are medians of ratios to a frame without shadows, drawn in turn; of the processor, where it
 * draws. */

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

/* The volumes of a scene, and the map with a filter that is the cheapest of those within 8 steps
 * near shadows' edges, or the most exact; its size. False: they were not measured. */
bool shadow_ways_best(const ShadowWays *ways, int scene, ShadowMeasured *volumes,
                      ShadowMeasured *map, int *size);

/* Measures, and prints a table. A quick survey has one scene, and few maps. */
void shadow_ways_report(Survey *survey, bool markdown, FILE *file, ShadowWays *ways);

/* For each scene that was measured FOLDER/finding-shadows-NAME.svg and .png, the error by the size
 * of the map, and finding-shadows-NAME-time, the time. Volumes are a horizontal line. */
bool shadow_ways_plot(const ShadowWays *ways, const char *folder, Message *message);

#endif
