/*
 * trials: measures settings of a scene against each other.
 *
 * Settings are measured in batches. In every batch are also the usual setting, twice, so that one
 * sees how far a thing and itself come out apart, and a frame that draws nothing. Each round visits
 * all of them in a random order, draws a frame that is not timed and one that is; a setting's time
 * is its median ratio to the usual one in the same round, times what the usual one took when the
 * scene was begun. So a machine that becomes slower meanwhile changes nothing.
 */
#ifndef TRIALS_H
#define TRIALS_H

#include "results.h"
#include "studio.h"

enum { TRIALS_BATCH = 16, TRIALS_MOST_ROUNDS = 9 };

/* A list of settings, each once. */
typedef struct SettingList {
    Setting *settings;
    int count, capacity;
} SettingList;
bool setting_list_add(SettingList *list, const Setting *setting, Message *message);
void setting_list_close(SettingList *list);

/* The settings that are measured for a scene: the usual one first; from it, each axis's other
 * choices; then what is worth combining. `quick`: a tenth of them. */
bool trials_plan(bool quick, SettingList *list, Message *message);

typedef struct Trials {
    Studio *studio;
    const Scene *scene;
    const Reference *exact;
    ResultRow like; /* scene, size, renderer, threads, seed */
    double usual;   /* milliseconds of the usual setting; 0: not known yet */
    /* Set from outside, by a signal's handler: stop. */
    const volatile int *interrupted;
} Trials;

/* Measures up to TRIALS_BATCH settings and writes a row for each; `seconds` is about what it may
 * take. False where something failed or it was interrupted (with an empty message). Sets
 * trials->usual where that is 0: then the usual setting must be among `settings`. */
bool trials_measure(Trials *trials, const Setting *settings, int count, double seconds,
                    ResultRow *rows, Message *message);

#endif
