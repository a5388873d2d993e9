/*
 * help: what a program prints about its options: --help, a man page, completion for shells.
 */
#ifndef HELP_H
#define HELP_H

#include "app/options.h"

void help_print(const Usage *usage);

/* The lines of --help for the options of a table, which a NULL name ends. */
void help_options(const Parameter *table);

/* "man": a page in roff's man macros; "bash", "zsh", "fish": the completion for that shell. */
void help_generate(const char *form, const Usage *usage);

#endif
