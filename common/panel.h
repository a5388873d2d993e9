/*
 * panel: the controls over the picture in a window, and what they cost beside them; help, errors
 * and notices too. No GL: what a person does goes in, triangles come out (panel_draw.h draws them),
 * both as plain data.
 *
 * Its widgets are Dear ImGui's, in a module that is loaded at the first need.
 */
#ifndef PANEL_H
#define PANEL_H

#include "message.h"
#include "parameter.h"
#include "window.h"

#include <stdint.h>

typedef struct Panel Panel;

/* Folded, there is its title alone, which unfolds it. */
typedef enum PanelView { PANEL_HIDDEN, PANEL_FOLDED, PANEL_OPEN } PanelView;

typedef struct PanelInput {
    const WindowInput *window; /* of sizes and places, those that cannot be count as none */
    double seconds;            /* since the last frame */
    /* The clipboard, and what its functions are called with. Those may be NULL. */
    void *clipboard;
    const char *(*get_clipboard)(void *clipboard);
    void (*set_clipboard)(void *clipboard, const char *text);
} PanelInput;

/* A line of help: "space", "pauses". */
typedef struct PanelHelp {
    const char *key, *action;
} PanelHelp;

/* How far the picture lies from the exact one. */
typedef struct PanelError {
    bool known, computing; /* both: what is known is of another moment or another choice */
    double rms, maximum;   /* in steps of 1/255; rms NaN: no object is seen */
    double seconds;        /* the moment at which it is so */
} PanelError;

/* What there is to show. Texts are UTF-8; NULL where there is nothing to say. */
typedef struct PanelContent {
    const char *name; /* of the program: the title */
    PanelView view;
    const Parameter *parameters;    /* ended by a NULL name, at most 32; may be NULL */
    const ParameterValue *defaults; /* of each; NULL: nothing can be put back */
    double milliseconds;            /* a frame takes; not positive: not known */
    double frames_per_second;
    PanelError error;
    const char *effects; /* lines, as effects_explain writes them */
    const char *command; /* that draws this picture */
    /* Over the picture, whether the panel is hidden or not: */
    const PanelHelp *help; /* ended by a NULL key */
    const char *errors;    /* lines, "file:line: what is wrong" */
    const char *notice;    /* one line, "saved NAME.png" */
} PanelContent;

typedef struct PanelVertex {
    float x, y; /* pixels, from the upper left corner of the window */
    float u, v; /* 0..1 in the atlas */
    unsigned char color[4];
} PanelVertex;

/* Triangles within a rectangle, whose upper left pixel is (x, y), and which lies in the window. */
typedef struct PanelCommand {
    int first, count; /* indices */
    int vertex;       /* to be added to each index */
    int x, y, width, height;
} PanelCommand;

/* What is to be drawn, one command after the other, blended by alpha: the vertex's color, whose
 * alpha is multiplied by the atlas's there. */
typedef struct PanelDrawing {
    const PanelVertex *vertices;
    const uint16_t *indices;
    const PanelCommand *commands;
    int vertex_count, index_count, command_count; /* no commands: there is nothing to draw */
    const unsigned char *atlas;                   /* alpha, row after row */
    int atlas_width, atlas_height;
    unsigned generation; /* another atlas has another one */
} PanelDrawing;

typedef struct PanelResult {
    PanelView view;       /* after a click on the title another one */
    uint32_t changed;     /* bit i: parameter number i was given another value */
    bool wants_pointer;   /* pointer and scroll wheel are the panel's, in this frame */
    bool wants_keys;      /* and so are keys and characters */
    PanelDrawing drawing; /* lasts until the next frame */
} PanelResult;

/* False where the module cannot be loaded. To be closed with panel_close. */
bool panel_open(Panel **panel, Message *message);

/* One frame: takes what was done, sets parameters that it changes, each to a value that
 * parameter_read accepts, and says what to draw. Where there is nothing to show this costs nothing.
 * A new content is laid out in its first frame and settles in its second. */
bool panel_frame(Panel *panel, const PanelInput *input, const PanelContent *content,
                 PanelResult *result, Message *message);

/* NULL is fine. */
void panel_close(Panel *panel);

/* What the key for the panel makes of a view: open unless it is open already. */
PanelView panel_next_view(PanelView view);

/* Says on standard output whether there is a panel, for --doctor. */
bool panel_doctor(void);

#endif
