/*
 * viewer_state: what the files of the viewer share, for them alone.
 */
#ifndef VIEWER_STATE_H
#define VIEWER_STATE_H

#include "app/shader_reload.h"
#include "app/viewer_panel.h"
#include "images/picture_queue.h"

typedef struct Viewer {
    const Example *example;
    Canvas *canvas;
    Window *window;
    Options first; /* at the start; restored by r */
    ParameterValue first_values[OPTIONS_MAX_PARAMETERS];
    Options options;       /* current */
    double seconds;        /* options.seconds before it was rounded */
    const char *precision; /* that are in use */
    int samples;
    bool paused, full_screen, left;
    WindowInput input;
    double last; /* when the last frame began */
    int due;     /* frames to draw although time stands still: something has changed */
    int drawn, drawn_paused;
    int margins[PANEL_MARGINS]; /* that the panel has in the window's size */
    int place[4];               /* the picture's in the window: x, y, width, height */
    int plain[2], asked[2]; /* the window's size without the panel, and the one asked for with it */
    /* Since the title was last updated: */
    double title_time;
    int frames;
    const char *state; /* in the title */
    bool title_paused;
    ViewerPanel panel;
    bool panel_had_pointer; /* in the previous frame: a press may precede the pointer's current
                               position */
    bool pressed, holding;  /* in the previous frame: the left button; a light, by its handle */
    Handle held;            /* where it has been dragged */
    ShaderReload reload;
    DrawRequest request; /* of the options: see current */
    Message broken;      /* error of the shaders on disk */
    Message unmade;      /* why renderer_renew failed */
    Picture picture;     /* read back, to be saved or retouched */
    Message trouble;     /* why drawing failed */
} Viewer;

/* Whether there is a picture to draw. */
bool viewer_is_made(const Viewer *viewer);

/* As the options are now. */
const DrawRequest *viewer_request(Viewer *viewer);

/* Draws the picture and reads it back. */
bool viewer_read_picture(Viewer *viewer, Message *message);

/* Rebuilds what the example made of its parameters. If that fails (a missing model file), reports
 * it once, and there is no picture until they change. */
void viewer_renew(Viewer *viewer);

/* Within the command line's limits, so that every time can be drawn again. */
void viewer_pass_time(Viewer *viewer, double seconds);

/* Starts again with the arguments of a try, which blanks separate. A given time is held. */
void viewer_try(Viewer *viewer, const char *arguments);

/* What was typed, and what the pointer did, since the last frame. */
void viewer_use_keys(Viewer *viewer);
void viewer_use_pointer(Viewer *viewer);

#endif
