/*
 * scene_ineffective: options of a program with scenes that name what is not there, or change
 * nothing.
 */
#ifndef SCENE_INEFFECTIVE_H
#define SCENE_INEFFECTIVE_H

#include "kinds/ineffective_options.h"

/* Whether the scene has the terms that --terms names, and the lights that --terms, --light-at and
 * --light-color do; the message lists those it has. Runs init and finish of the example. */
bool scene_check_names(const Example *example, const DrawRequest *request, Message *message);

/* As in ExampleKind: also --shadows, where no shadow can fall on anything. */
void ineffective_scene_options(const Example *example, const Options *options,
                               const ParameterValue *defaults, char *text, size_t size);

#endif
