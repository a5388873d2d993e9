/*
 * survey: measures what is planned for some scenes, and keeps each batch of rows in a file as soon
 * as it is known, so that an interrupted survey goes on where it stopped.
 */
#ifndef SURVEY_H
#define SURVEY_H

#include "options.h"
#include "results.h"
#include "studio.h"

typedef struct Survey {
    Studio *studio;
    Results results;     /* of this and of earlier surveys into the same folder */
    ResultRow like;      /* size, renderer, threads, seed */
    char path[PATH_MAX]; /* of the file of results */
    bool quick;
    double seconds; /* that all scenes together may take, about */
} Survey;

/* Opens the driver, makes the folder, and reads what is there already. `fresh`: drops that. */
bool survey_open(Survey *survey, const Options *options, unsigned seed, bool quick, bool fresh,
                 Message *message);

/* The exact picture of a scene; close it with reference_close. */
bool survey_exact(const Survey *survey, const Scene *scene, Reference *exact, Message *message);

/* Measures the planned settings of these scenes, by their numbers, that have no rows yet. With a
 * progress bar where that takes long. An interruption (SIGINT, SIGTERM) is a failure, whose message
 * says what is kept. */
bool survey_run(Survey *survey, const int *scenes, int count, Message *message);

/* Measures one setting of one scene anew, and gives its row without keeping it. */
bool survey_once(Survey *survey, int scene, const Setting *setting, ResultRow *row,
                 Message *message);

void survey_close(Survey *survey);

#endif
