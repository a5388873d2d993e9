/*
 * unused: what of a command line the scene or diagram has no use for.
 */
#ifndef UNUSED_H
#define UNUSED_H

#include "app/options.h"
#include "core/example.h"

/* Whether the scene has the terms that --terms names, and the lights that --terms, --light-at and
 * --light-color do; the message lists those it has. */
bool unused_terms_check(const Example *example, const Options *options, Message *message);

/* Names the program's own options that were given and change nothing: without one of them the
 * example hands over the same meshes, scenes, marks, labels and size, at the time to draw and two
 * others; and --shadows where no shadow can fall on anything at these times. "--shininess,
 * --opacity"; empty if there are none, or if that is not known: with a file, which might take long
 * to read, and with --error. `defaults` as for command_write. Runs init and finish of the example.
 */
void unused_options(const Example *example, const Options *options, const ParameterValue *defaults,
                    char *text, size_t size);

#endif
