/*
 * panel: controls over the picture in a window, with their cost; help, errors and notices. No GL:
 * input goes in, triangles come out (panel_draw.h draws them), both as plain data.
 *
 * The widgets are Dear ImGui's, in a module that is loaded on first use.
 */
#ifndef PANEL_H
#define PANEL_H

#include "window/panel_frame.h"

typedef struct Panel Panel;

/* What the panel wants of the window around the picture: to the right of it, above it, and below it
 * for errors. Pixels. */
enum { PANEL_RIGHT, PANEL_ABOVE, PANEL_BELOW, PANEL_MARGINS };
void panel_margins(PanelView view, bool errors, double scale, int margins[PANEL_MARGINS]);

/* Where the picture is in a window of this size: x, y, width, height, from the upper left. It gets
 * at least a third of the width and of the height, and a pixel. */
void panel_place(PanelView view, bool errors, double scale, int width, int height, int place[4]);

/* False if the module cannot be loaded. */
bool panel_open(Panel **panel, Message *message);

/* One frame: handles input, sets changed parameters, each to a value that parameter_read accepts,
 * and returns what to draw. Costs nothing if there is nothing to show. New content is laid out in
 * its first frame and settles in its second. */
bool panel_frame(Panel *panel, const PanelInput *input, const PanelContent *content,
                 PanelResult *result, Message *message);

/* NULL is fine. */
void panel_close(Panel *panel);

/* The view after the panel key: open, or hidden if it was open. */
PanelView panel_next_view(PanelView view);

/* Loads the module and appends a line about what was found; true if it was. */
bool panel_probe(Message *findings);

#endif
