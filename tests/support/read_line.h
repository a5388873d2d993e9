/*
 * read_line: a command line as one text, for tests.
 */
#ifndef READ_LINE_H
#define READ_LINE_H

#include "app/options.h"

/* Reads arguments that are separated by blanks; "" stands for an empty one. The options point to
 * their texts until the next call, and the program's own parameters are set, too. */
OptionsResult read_line(Options *options, const Usage *usage, const char *line, Message *message);

#endif
