/*
 * survey: measures the planned settings of some scenes. Each batch of rows is written to a file as
 * soon as it is known, so that an interrupted survey continues where it stopped.
 */
#ifndef SURVEY_H
#define SURVEY_H

#include "app/options.h"
#include "study/measure/setting_picture.h"
#include "study/results/results.h"

#include <stdio.h>

/* What to measure, and for which of several processes or machines. */
typedef struct SurveyPlan {
    unsigned seed; /* of the order of measuring */
    bool quick;
    bool fresh; /* drop earlier rows; */
    bool merge; /* when the merged ones are there, by survey_merge */
    Part part;  /* of each scene's settings; its rows are in a file of their own */
} SurveyPlan;

typedef struct Survey {
    SettingRenderer *renderer;
    Results results; /* of this and of earlier surveys into the same folder */
    ResultRow like;  /* size, renderer, threads, seed */
    const char *folder;
    char path[PATH_MAX]; /* of the file of results */
    SurveyPlan plan;
} Survey;

/* Opens the driver, makes the folder, and reads its rows. */
bool survey_open(Survey *survey, const Options *options, const SurveyPlan *plan, Message *message);

/* The exact picture of a scene; close it with reference_close. */
bool survey_exact(const Survey *survey, const Scene *scene, Reference *exact, Message *message);

/* Measures the planned settings of these scenes that have no rows yet, with a progress bar. An
 * interruption (SIGINT, SIGTERM) is a failure; its message says what is kept. */
bool survey_run(Survey *survey, const int *scenes, int count, Message *message);

/* Makes the file of results, which must not have rows yet, from those of the parts in the folder:
 * the rows of one survey, in its order. Each part has measured the usual setting; its times are
 * scaled by that to the first one's, because parts may be of different machines. */
bool survey_merge(Survey *survey, const int *scenes, int count, Message *message);

/* Measures up to SETTING_TIMES_BATCH - 1 settings of one scene against each other, without keeping
 * their rows. */
bool survey_again(Survey *survey, int scene, const Quality *qualities, int count, ResultRow *rows,
                  Message *message);

void survey_close(Survey *survey);

/* Blinn-Phong is another model than Phong's. */

/* The largest distances from Phong's exact picture, over all exponents, in steps of 1/255. */
typedef struct ModelsApart {
    double same[2], fitted[2]; /* least and most; of the same and of the fitted exponent */
} ModelsApart;

/* Measures both on the study's shiny sphere for some exponents, Blinn-Phong also with the exponent
 * fitted to Phong's. Prints a table. */
bool models_report(Survey *survey, bool markdown, FILE *file, ModelsApart *apart, Message *message);

/* The best of the measured settings within a limit of error or time. */

/* Milliseconds per frame, or an error of this kind in steps of 1/255. */
typedef struct ChooseLimit {
    bool is_time;
    double value;
    ErrorKind kind;
} ChooseLimit;

/* Of rows as measured against each other: among those within the limit that none of these is surely
 * faster than (of a limit of time: that are as exact as the most exact) the one with the fewest
 * unusual choices, then the most exact. NULL: none is within. If the median noise is above
 * FRONT_NOISE_BOUND none is surely faster. */
const ResultRow *choose_among(const ResultRow *rows, int count, const ChooseLimit *limit);

/* Prints the cheapest setting of a surveyed scene within a limit of error, or the most exact one
 * within a limit of time; those tied with it, of which it is the most usual; and what less error or
 * less time would cost. The best settings are measured again, against each other, before one is
 * chosen: what the survey measured one after another depends on what else ran. False if none is
 * within the limit, both times. */
bool choose(Survey *survey, int scene, const ChooseLimit *limit, Message *message);

#endif
