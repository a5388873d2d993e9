/*
 * arguments: reads a command line, GNU style, against a table of options.
 */
#ifndef ARGUMENTS_H
#define ARGUMENTS_H

#include "scene/parameter.h"

/* Reads options, long (abbreviated if the beginning is unique) and short, into the values of
 * `table`, which a NULL name ends. An option without a value to set, as --help, ends the reading
 * and is left in *answer, else NULL. The arguments that are no options are moved to argv[1] on and
 * end with NULL. False with a message for a usage error. */
bool arguments_read(const Parameter *table, int argc, char *argv[], const Parameter **answer,
                    Message *message);

#endif
