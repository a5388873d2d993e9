/*
 * options_check: whether a command line's options go together.
 */
#ifndef OPTIONS_CHECK_H
#define OPTIONS_CHECK_H

#include "app/options.h"

/* Needs neither driver nor files. Sets what follows from the output's name: the animation, the
 * vector format. */
bool options_check(Options *options, const Usage *usage, Message *message);

#endif
