/*
 * stage: an example ready to be drawn into a canvas, for programs of one example and for the
 * gallery of all.
 */
#ifndef STAGE_H
#define STAGE_H

#include "app/options.h"
#include "core/canvas.h"
#include "core/example.h"
#include "images/drawing.h"
#include "images/picture_queue.h"
#include "lighting/lighting.h"
#include "choose/cheapest_quality.h"
#include "choose/error_worker.h"
#include "scene/overlay.h"
#include "scene/quality.h"

/* Only examples with scenes come to call these. The lecture's programs are linked without them and
 * the files that they need, a fifth of all: a weak reference asks the linker for nothing. */
#pragma weak PICTURE_ERROR_COLORS
#pragma weak cheapest_quality_find
#pragma weak cheapest_quality_close
#pragma weak cheapest_quality_text
#pragma weak error_picture_add
#pragma weak error_picture_close
#pragma weak error_picture_open
#pragma weak error_sum_rms
#pragma weak error_worker_busy
#pragma weak error_worker_cancel
#pragma weak error_worker_close
#pragma weak error_worker_map
#pragma weak error_worker_open
#pragma weak error_worker_result
#pragma weak error_worker_start

/* Opens the canvas that the options ask for, with float colours if the format of `output` stores
 * them. With --verbose describes it on standard error. */
bool stage_open_canvas(Canvas *canvas, const Options *options, const char *output,
                       Message *message);

/* One is open at a time, because an example's state is its own. */
typedef struct Stage {
    const Example *example; /* NULL: closed */
    const Canvas *canvas;
    Message warning; /* of the example's shaders: variables of the program that they do not use */
    /* Of an example with a scene: */
    Lighting *lighting;
    Overlay overlay;
    SolidMeshes meshes; /* of the choices */
    /* With --error, by view: what is drawn in pictures of this size, at this time or, in a window
     * or an animation, at any. NULL: not chosen yet. */
    CheapestQuality *choices;
    int choice_count, choice_width, choice_height;
    double choice_seconds;
} Stage;

/* Calls the example's init. What is pointed to must outlive the stage. */
bool stage_open(Stage *stage, const Example *example, const Canvas *canvas, const Options *options,
                Message *message);

/* Prints the warning, if there is one, on standard error. */
void stage_warn(const Stage *stage);

/* Calls the example's finish and restores the GL state it may have changed. Zeroed is fine. */
void stage_close(Stage *stage);

/* Rebuilds what the example has made of its parameters after they changed; compiled programs stay.
 * After a failure there is nothing to draw, but it can be renewed again or closed. */
bool stage_renew(Stage *stage, const Options *options, Message *message);

/* Clears the canvas and draws one frame. */
bool stage_draw(Stage *stage, const Options *options, double seconds, Message *message);

/* Opens the drawing of an example that is a diagram, in a size in pixels. */
bool stage_drawing(const Example *example, double seconds, int width, int height, Drawing *drawing,
                   Message *message);

/* Draws one frame and reads it back into the picture, whose image gets the canvas's size; a diagram
 * is painted into it, and needs no canvas but that size; so is a page, with canvases beside this
 * one. The caller sets its path. */
bool stage_picture(Stage *stage, const Options *options, double seconds, Picture *picture,
                   Message *message);

/* Instead of drawing: reads the picture that the part of another process has written to
 * picture->path. Fails if it is not the one that this command draws, or was drawn by another driver
 * ("": by any), whose name is replaced by the picture's. */
enum { STAGE_DRIVER_SIZE = 512 };
bool stage_picture_part(const Stage *stage, const Options *options, double seconds,
                        char driver[STAGE_DRIVER_SIZE], Picture *picture, Message *message);

/* For error_worker_start: draws one frame of an example with a scene, without marks, labels and
 * retouching, over the background's color with alpha 0, and copies its scenes as they were before
 * --error simplified them. The canvas then holds that frame. */
bool stage_error_picture(Stage *stage, const Options *options, double seconds,
                         ErrorPicture *picture, Message *message);

/* The views of an example with a scene. */
typedef struct StageView {
    SceneCopy kept;     /* the lights and objects of --terms */
    Scene asked, scene; /* before and after --error, which may change the meshes */
    QualityParts made;  /* with --error: the scene as drawn, object by object */
} StageView;

int stage_view_count(const Stage *stage);

/* A view's part of the picture: x, y, width, height, in pixels from the upper left. False if it is
 * less than a pixel. */
bool stage_view_place(const Stage *stage, int view, int place[4]);

/* With --error makes the choice first, if that is not made yet: draws into the canvas. */
bool stage_view_open(StageView *view, Stage *stage, const Options *options, double seconds,
                     int number, Message *message);
void stage_view_close(StageView *view);

/* The scene that an object of the view is drawn in, and its number there. */
const Scene *stage_view_part(const StageView *view, int *object);

#endif
