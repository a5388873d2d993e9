/*
 * viewer_panel: what a window shows over the picture: the example's parameters, their cost, the
 * command that draws the picture, help, errors.
 *
 * Without the panel's module the picture is shown alone, and help goes to standard error.
 */
#ifndef VIEWER_PANEL_H
#define VIEWER_PANEL_H

#include "app/stage.h"
#include "base/clock.h"
#include "window/panel.h"
#include "window/panel_draw.h"

enum { VIEWER_COMMAND_SIZE = 16384 };

typedef struct ViewerPanel {
    const Example *example;
    Window *window;
    Panel *panel; /* NULL: there is none */
    PanelDraw draw;
    PanelView view;
    PanelResult result; /* of this frame */
    bool help;
    ParameterValue defaults[OPTIONS_MAX_PARAMETERS];
    double seconds; /* per frame, smoothed; 0: unknown */
    double rate;    /* frames per second; 0: unknown */
    ErrorWorker *error_worker;
    double error_time;     /* clock_now when it was last started */
    Options error_options; /* of its picture */
    bool stale;            /* the parameters have changed since */
    char *effects;
    double effects_time;
    char command[VIEWER_COMMAND_SIZE];
    char notice[PATH_MAX + 64];
    double notice_time;
} ViewerPanel;

/* `defaults`: of the example's parameters, before the command line was read. Never fails: what is
 * missing is reported on standard error. */
void viewer_panel_open(ViewerPanel *panel, const Example *example, Window *window,
                       const Options *options, const ParameterValue *defaults);

/* One frame of the panel; viewer_panel_draw draws it. Describes the stage's picture at `options`;
 * NULL: there is none. `trouble` is shown as an error unless it is empty. */
bool viewer_panel_frame(ViewerPanel *panel, const WindowInput *input, double seconds, Stage *stage,
                        const Options *options, const Message *trouble, Message *message);

/* Draws it into the bound framebuffer, of the window's size. */
bool viewer_panel_draw(ViewerPanel *panel, int width, int height, Message *message);

/* The time a frame took to draw. */
void viewer_panel_measured(ViewerPanel *panel, double seconds);

/* Shows a line for a few seconds; NULL: removes it. */
void viewer_panel_notice(ViewerPanel *panel, const char *text);

void viewer_panel_toggle(ViewerPanel *panel);
void viewer_panel_toggle_help(ViewerPanel *panel);

void viewer_panel_close(ViewerPanel *panel);

#endif
