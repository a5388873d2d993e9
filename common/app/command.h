/*
 * command: the command line that draws the same picture without a window.
 */
#ifndef COMMAND_H
#define COMMAND_H

#include "app/options.h"
#include "core/example.h"

/* How to start the program again in the same folder, quoted for a shell: with the script
 * that started it, which the environment names (LIGHTING_RUN=examples/run), or else as argv[0] has
 * it. False, and an empty text, if `size` bytes are too few. */
bool command_start(const char *name, const char *argv0, char *text, size_t size);

/* Writes options->start, or the program's name, and the options, in the order of --help, that
 * differ from their defaults and change what is drawn or where it goes; the backend of a window is
 * EGL. Numbers have the fewest digits that read back as the same one, and words are quoted for a
 * shell.
 *
 * `defaults` are the values of the example's own parameters, from parameter_save before
 * options_read; NULL: they are unchanged. False, and an empty text, if `size` bytes are too few or
 * no option sets a parameter's value: NaN, a NULL text, a flag that is no longer set. */
bool command_write(const Example *example, const Options *options, const ParameterValue *defaults,
                   char *text, size_t size);

#endif
