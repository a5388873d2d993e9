/*
 * command: the command line that draws the same picture without a window.
 */
#ifndef COMMAND_H
#define COMMAND_H

#include "example.h"
#include "options.h"

/* Writes the program's name and those options, in the order of --help, that differ from their
 * defaults and make a difference to what is drawn and where it goes: not those that look on, as
 * --verbose, or --window, in whose place the backend is that with which a window draws. Numbers are
 * in the fewest digits that read back as the very same one; a shell splits the line as it is meant,
 * whatever a file's name has in it.
 *
 * `defaults` has a value for each of the example's own parameters, as parameter_save had them
 * before options_read; NULL: they have these still. False, and an empty text, where `size` bytes
 * are too few, or where a parameter has a value that no option gives it: no number, no text, a flag
 * that is no longer set.
 */
bool command_write(const Example *example, const Options *options, const ParameterValue *defaults,
                   char *text, size_t size);

#endif
