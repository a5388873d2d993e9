/*
 * report_gnuplot: gnuplot as a child process, and what a script for it needs.
 */
#ifndef REPORT_GNUPLOT_H
#define REPORT_GNUPLOT_H

#include "message.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* The size of every plot, in pixels. */
enum { GNUPLOT_WIDTH = 1000, GNUPLOT_HEIGHT = 700 };

/* Colours that people who do not see all colours can tell apart (Okabe and Ito, Color Universal
 * Design, 2008), the darker ones first. */
enum { GNUPLOT_COLORS = 7 };
extern const char *const GNUPLOT_PALETTE[GNUPLOT_COLORS];

/* Runs a script twice, and writes what it draws to FOLDER/NAME.svg and FOLDER/NAME.png, each whole
 * or not at all. The script sets no terminal and no output. No shell runs, and no file is made
 * besides. */
bool gnuplot_draw(const char *script, size_t size, const char *folder, const char *name,
                  Message *message);

/* Closes a script that open_memstream opened and frees it; draws it before, where `done` and all of
 * it was written. */
bool gnuplot_finish(FILE *file, char **script, const size_t *size, bool done, const char *folder,
                    const char *name, Message *message);

/* Text as a string of a script, in quotes. */
void gnuplot_string(FILE *script, const char *text);

/* A line in small letters at the foot of a plot: what it was measured with. NULL: none. */
void gnuplot_foot(FILE *script, const char *text);

/* The range of an axis ('x' or 'y') and its numbers: at 1, 2 and 5 times powers of ten, or as many
 * others as give a few. 0 < least < most where `log`. */
void gnuplot_axis(FILE *script, char axis, double least, double most, bool log);

#endif
