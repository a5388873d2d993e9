/*
 * panel_kind: what a window's panel shows of a kind of program besides its parameters: the error of
 * its picture, its effects, its lights.
 */
#ifndef PANEL_KIND_H
#define PANEL_KIND_H

#include "app/example_kind.h"
#include "window/handles.h"
#include "window/panel.h"

#include <stdio.h>

struct ErrorWorker; /* see choose/error_worker.h */

typedef struct PanelKind {
    /* What computes the error of a picture in the background. */
    bool (*open)(struct ErrorWorker **worker, Message *message);
    void (*close)(struct ErrorWorker *worker);
    bool (*start)(struct ErrorWorker *worker, Renderer *renderer, const DrawRequest *request);
    void (*cancel)(struct ErrorWorker *worker);
    bool (*busy)(struct ErrorWorker *worker);
    PanelError (*error)(struct ErrorWorker *worker);
    /* Copies the map of the last result, if that has another number. */
    void (*map)(struct ErrorWorker *worker, Image *map, int *number);

    /* As a text, and as a list. */
    void (*write_effects)(Renderer *renderer, const DrawRequest *request, FILE *file,
                          PanelObjects *objects);

    /* The lights of all views as the example has them; how many. */
    int (*lights)(Renderer *renderer, const DrawRequest *request, Light lights[SCENE_MAX_PLACED]);

    /* As points of the picture. */
    int (*handles)(Renderer *renderer, const DrawRequest *request, Handle handles[HANDLES_MAX]);
    const Handle *(*find_handle)(const Handle *handles, int count, double x, double y,
                                 double reach);
    /* Where the light is once its handle has been dragged. */
    bool (*drag)(Renderer *renderer, const DrawRequest *request, const Handle *handle, Vec3 *at);
} PanelKind;

#endif
