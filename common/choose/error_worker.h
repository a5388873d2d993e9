/*
 * error_worker: computes the error of a drawn picture in the background while drawing goes on. No
 * GL.
 *
 * The exact picture takes a hundred times as long as the drawn one. Low-priority threads compute
 * it, one fewer than there are cores, so that frames stay smooth. It is that of the exact shapes,
 * lit at every point; for interior pixels see pixel_is_interior.
 */
#ifndef ERROR_WORKER_H
#define ERROR_WORKER_H

#include "base/image.h"
#include "reference/picture_error.h"
#include "scene/scene.h"

/* A part of the picture with its scene. */
typedef struct ErrorView {
    int place[4];    /* x, y, width, height, in pixels from the upper left; 1x1 or more */
    SceneCopy scene; /* whose exact picture counts */
    SceneCopy drawn; /* with the meshes that were drawn, whose shadows they have; zeroed: as `scene`
                        has them, or there are no shadows */
} ErrorView;

/* A picture as drawn, of scenes alone, without overlay or text, over a background of alpha 0. */
typedef struct ErrorPicture {
    Image image;
    double seconds; /* the moment; comes back with the result */
    ErrorView *views;
    int view_count;
    bool simplified; /* drawn with other meshes or less lighting than the scenes have */
} ErrorPicture;

/* Opens it without views, but with room for so many. The image's pixels are the caller's to write.
 */
bool error_picture_open(ErrorPicture *picture, int width, int height, ImageType type, int max_views,
                        Message *message);

/* Adds a view with a copy of its scene, which has passed scene_check. `drawn`: the same with the
 * meshes that were drawn; NULL: with its own. */
bool error_picture_add(ErrorPicture *picture, const int place[4], const Scene *scene,
                       const Scene *drawn, Message *message);
void error_picture_close(ErrorPicture *picture); /* NULL or a zeroed picture is fine */

/* For picture_error_add: opens the meshes as drawn; zeroed where no light casts shadows. `exact`:
 * the size and the like. */
bool error_view_drawn(const ErrorView *view, const ReferenceOptions *exact, Reference *drawn,
                      Message *message);

/* The last picture that was finished, if there is one. */
typedef struct ErrorResult {
    bool computing;     /* another one is on its way */
    bool known;         /* the rest, but for `message`, is set */
    PictureError error; /* `worst` is a pixel's number in the image */
    /* Inside objects, against the exact picture of the meshes as they are drawn, with the scene's
     * interpolation: what only computing adds. Empty if the picture is simplified. */
    ErrorSum of_computing;
    int number;          /* of this result, counted */
    double seconds;      /* the picture's moment */
    double milliseconds; /* it took */
    Message message;     /* why the last one has no result; else empty */
} ErrorResult;

typedef struct ErrorWorker ErrorWorker;

/* Starts the thread that waits for pictures. */
bool error_worker_open(ErrorWorker **worker, Message *message);

/* Takes the picture over (it is zeroed), and returns at once. One that is being computed is
 * abandoned. */
void error_worker_start(ErrorWorker *worker, ErrorPicture *picture);

/* Whether something is being computed. */
bool error_worker_busy(ErrorWorker *worker);

void error_worker_result(ErrorWorker *worker, ErrorResult *result);

/* Copies the map of the last result (picture_error_map), with the alpha of opaque pixels, to an
 * image of bytes, which is opened again if its size differs. False if there is none. */
bool error_worker_map(ErrorWorker *worker, Image *map);

/* Abandons what is being computed and forgets what is known: the picture is another one. Returns at
 * once. */
void error_worker_cancel(ErrorWorker *worker);

/* Abandons what is being computed and waits for the thread's end: see reference_open for how long.
 * NULL is fine. */
void error_worker_close(ErrorWorker *worker);

#endif
