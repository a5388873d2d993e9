/*
 * scene_options: the options of programs that draw scenes.
 */
#ifndef SCENE_OPTIONS_H
#define SCENE_OPTIONS_H

#include "app/options_table.h"

/* Ended by a NULL name. */
extern const Parameter SCENE_OPTIONS[];

/* By bit of SceneTerms. */
extern const char *const SCENE_TERM_NAMES[4];

#endif
