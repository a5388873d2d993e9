/*
 * report_gnuplot: fills scripts of gnuplot and runs them.
 */
#ifndef REPORT_GNUPLOT_H
#define REPORT_GNUPLOT_H

#include "base/template.h"

#include <stdbool.h>

/* The size of every plot and the height of its letters, at least a fortieth of the plot's, so that
 * they can be read when projected; in pixels. */
enum { GNUPLOT_WIDTH = 1000, GNUPLOT_HEIGHT = 700, GNUPLOT_FONT = 18, GNUPLOT_TITLE = 21 };

/* Colours safe for colour blindness (Okabe and Ito, Color Universal Design, 2008), dark ones first.
 */
enum { GNUPLOT_COLORS = 7 };
extern const char *const GNUPLOT_PALETTE[GNUPLOT_COLORS];

/* The values of a script: its title, and a footer that says what was measured with; NULL: none. */
TemplateValues *gnuplot_values(const char *title, const char *foot);

/* A quoted string. */
void gnuplot_set(TemplateValues *values, const char *name, const char *text);

/* As x_axis or y_axis the range of an axis ('x' or 'y') and its tics: 1, 2 and 5 times powers of
 * ten, or others if those are too few or too many. If `log`, 0 < min < max. */
void gnuplot_set_axis(TemplateValues *values, char axis, double min, double max, bool log);

/* Fills a script, "examples/.../curves.gp" (see template_print), closes the values, and runs it
 * twice, for FOLDER/NAME.svg and FOLDER/NAME.png, each written completely or not at all. The script
 * sets neither terminal nor output. Uses no shell and no temporary files. */
bool gnuplot_draw(const char *source, TemplateValues *values, const char *folder, const char *name,
                  Message *message);

/* Removes both files of an earlier run, if there are any. */
bool gnuplot_forget(const char *folder, const char *name, Message *message);

#endif
