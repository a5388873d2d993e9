/*
 * panel_frame: what a panel is given for a frame, and what it returns, as plain data.
 */
#ifndef PANEL_FRAME_H
#define PANEL_FRAME_H

#include "scene/parameter.h"
#include "window/window.h"

#include <stdint.h>

/* Folded: only the title, which unfolds it. */
typedef enum PanelView { PANEL_HIDDEN, PANEL_FOLDED, PANEL_OPEN } PanelView;

typedef struct PanelInput {
    const WindowInput *window; /* invalid sizes and positions are ignored */
    double seconds;            /* since the last frame */
    int place[4];              /* of the picture; panel_frame sets it */
    /* The clipboard and its functions, which may be NULL. */
    void *clipboard;
    const char *(*get_clipboard)(void *clipboard);
    void (*set_clipboard)(void *clipboard, const char *text);
} PanelInput;

/* A line of help: "space", "pauses". */
typedef struct PanelHelp {
    const char *key, *action;
} PanelHelp;

/* In steps of 1/255; rms NaN: there are no such pixels, or it is not known. */
typedef struct PanelErrorPart {
    double rms, maximum;
} PanelErrorPart;

/* The error of the picture against exact ones. */
typedef struct PanelError {
    bool known, computing;            /* both: the known error is that of an earlier picture */
    PanelErrorPart of_computing;      /* inside objects, against the exact picture of the meshes */
    PanelErrorPart of_mesh;           /* inside objects, against that of the shapes */
    PanelErrorPart at_edges;          /* elsewhere, against that of the shapes */
    double seconds;                   /* time of that picture */
    bool mapped;                      /* a map of the error is shown in the picture's place */
    const unsigned char (*colors)[3]; /* of the map: of errors of 0.5, 4, 32 and 255 */
} PanelError;

/* A point of the picture that can be dragged: a light. */
typedef struct PanelMark {
    int number;
    double x, y; /* pixels of the window */
    bool held;
} PanelMark;

/* A pixel of the picture. */
typedef struct PanelPixel {
    const char *line;         /* over the picture: of the one under the pointer */
    const char *title, *text; /* of the one that was clicked, in lines; NULL: none was */
    const char *const *names; /* what can be drawn instead of the picture; ended by NULL */
    const char *shown;        /* which of them is; "": none */
    const char *legend;       /* what its colours mean, in lines */
} PanelPixel;

/* The objects of a picture: what is in their list, and the lines of each one's effects. Those with
 * the same in a few words follow each other. */
typedef struct PanelObject {
    char *row, *effects, *same;
    int number;
    float ring[3]; /* around it: handles_ring */
} PanelObject;
typedef struct PanelObjects {
    PanelObject *all;
    int count, room;
} PanelObjects;

/* What to show. Texts are UTF-8; NULL: none. */
typedef struct PanelContent {
    const char *name; /* of the program: the title */
    PanelView view;
    const Parameter *parameters;    /* ended by a NULL name, at most 32; may be NULL */
    const ParameterValue *defaults; /* of each; NULL: no reset */
    const Parameter *options;       /* common ones, in a section of their own; the same */
    const ParameterValue *option_defaults;
    const Parameter *lights; /* colors of the scene's lights, the same; no row: no section */
    const ParameterValue *light_defaults;
    const PanelMark *marks; /* drawn over the picture */
    int mark_count;
    double milliseconds; /* per frame; not positive: unknown */
    double frames_per_second;
    PanelError error;
    PanelPixel pixel;
    const char *effects;      /* lines, as effects_explain writes them */
    PanelObjects objects;     /* of many their list is shown */
    const char *command;      /* that draws this picture */
    const char *const *tries; /* arguments to try, a button each; ended by NULL; may be NULL */
    const char *const *looks; /* what to look for in each; may be NULL */
    /* Shown also while the panel is hidden: */
    const PanelHelp *help; /* ended by a NULL key */
    const char *errors;    /* lines, "file:line: reason" */
    const char *notice;    /* one line, "saved NAME.png" */
} PanelContent;

typedef struct PanelVertex {
    float x, y; /* pixels, from the upper left corner of the window */
    float u, v; /* 0..1 in the atlas */
    unsigned char color[4];
} PanelVertex;

/* Triangles clipped to a rectangle in the window, with its upper left pixel at (x, y). */
typedef struct PanelCommand {
    int first, count; /* indices */
    int vertex;       /* added to each index */
    int x, y, width, height;
} PanelCommand;

/* Commands to draw in order, alpha-blended: the vertex colour, with its alpha multiplied by the
 * atlas's. */
typedef struct PanelDrawing {
    const PanelVertex *vertices;
    const uint16_t *indices;
    const PanelCommand *commands;
    int vertex_count, index_count, command_count; /* no commands: nothing to draw */
    const unsigned char *atlas;                   /* alpha, row after row */
    int atlas_width, atlas_height;
    unsigned generation; /* changes with the atlas */
} PanelDrawing;

typedef struct PanelResult {
    PanelView view;       /* a click on the title changes it */
    uint32_t changed;     /* bit i: parameter i changed */
    uint32_t options;     /* bit i: option i changed */
    uint32_t lights;      /* bit i: color i of the lights changed */
    bool mapped;          /* as PanelError has it, or as a click on its switch has set it */
    int larger;           /* letters by so many sizes, or smaller if negative */
    const char *tried;    /* the arguments of the button that was pressed; NULL: none */
    const char *shown;    /* one of PanelPixel.names, or "", if that was chosen; else NULL */
    bool pixel_closed;    /* no pixel is to be explained any more */
    bool wants_pointer;   /* the panel uses pointer and wheel in this frame */
    bool wants_keys;      /* ... keys and characters */
    PanelDrawing drawing; /* valid until the next frame */
} PanelResult;

#endif
