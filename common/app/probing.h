/*
 * probing: --probe and --show: what the shaders of a program's picture compute.
 */
#ifndef PROBING_H
#define PROBING_H

#include "app/options.h"

/* --probe: on standard output. */
bool probing_tell(const Example *example, const Options *options, Message *message);

/* --show: writes the picture, and what its colours mean to standard error. A name that no shader
 * has sets options->show_unknown. */
bool probing_show(const Example *example, Options *options, Message *message);

#endif
