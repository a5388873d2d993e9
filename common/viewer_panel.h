/*
 * viewer_panel: what a window shows over the picture, and what there is to say in it: the example's
 * parameters, what they cost, the command that draws the picture, help, errors.
 *
 * Without the panel's module the picture is shown all the same, and help is said on standard error.
 */
#ifndef VIEWER_PANEL_H
#define VIEWER_PANEL_H

#include "appraise.h"
#include "canvas.h"
#include "example.h"
#include "options.h"
#include "panel.h"
#include "panel_draw.h"

enum { VIEWER_COMMAND_SIZE = 16384 };

typedef struct ViewerPanel {
    const Example *example;
    Window *window;
    Panel *panel; /* NULL: there is none */
    PanelDraw draw;
    PanelView view;
    PanelResult result; /* of this frame */
    bool help;
    ParameterValue defaults[OPTIONS_MOST_PARAMETERS];
    double seconds; /* that a frame takes, smoothed; 0: not known */
    double rate;    /* frames a second; 0: not known */
    Appraise *appraise;
    /* The picture that was last given to it. */
    double appraised_time; /* when, as progress_now tells it */
    Options appraised;
    bool stale; /* the parameters are others since */
    char *effects;
    double effects_time;
    char command[VIEWER_COMMAND_SIZE];
    char notice[PATH_MAX + 64];
    double notice_time;
} ViewerPanel;

/* `defaults`: of the example's parameters, as the command line does not know them. Never fails:
 * what is missing is said on standard error. */
void viewer_panel_open(ViewerPanel *panel, const Example *example, Window *window,
                       const Options *options, const ParameterValue *defaults);

/* A frame of the panel, whose drawing waits for viewer_panel_draw. `trouble` is shown as an error
 * where there is some. What it says of the picture is that of `options`, which is on the stage
 * unless `on_stage` is false. */
bool viewer_panel_frame(ViewerPanel *panel, const WindowInput *input, double seconds,
                        const Canvas *canvas, const Options *options, bool on_stage,
                        const Message *trouble, Message *message);

/* Draws it into the framebuffer that is bound, of the window's size. */
bool viewer_panel_draw(ViewerPanel *panel, int width, int height, Message *message);

/* A frame took so long to draw. */
void viewer_panel_measured(ViewerPanel *panel, double seconds);

/* Says something for a few seconds; NULL: nothing any more. */
void viewer_panel_notice(ViewerPanel *panel, const char *text);

void viewer_panel_toggle(ViewerPanel *panel);
void viewer_panel_toggle_help(ViewerPanel *panel);

void viewer_panel_close(ViewerPanel *panel);

#endif
