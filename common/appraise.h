/*
 * appraise: how far a drawn picture lies from the exact one, found in the background while the
 * caller goes on drawing. No GL.
 *
 * The exact picture takes a hundred times as long as the drawn one, so it is computed by threads of
 * their own: one less than there are cores, of low priority, so that frames stay smooth.
 *
 * It is that of the exact shapes, lit at every point. Interior are pixels inside the objects of
 * both the exact shapes and the meshes as drawn; see reference_error_add.
 */
#ifndef APPRAISE_H
#define APPRAISE_H

#include "image.h"
#include "reference_error.h"
#include "scene.h"

/* A part of the picture with its scene. */
typedef struct AppraiseView {
    int place[4]; /* x, y, width, height, in pixels from the upper left; 1x1 or more */
    SceneCopy asked;
    SceneCopy drawn; /* empty: as asked */
} AppraiseView;

/* What there is to appraise: a picture of scenes alone, without marks or text, as it was drawn. */
typedef struct AppraisePicture {
    Image image;
    double seconds; /* the moment; comes back with the result */
    AppraiseView *views;
    int view_count;
} AppraisePicture;

/* Opens it without views, but with room for so many. The image's pixels are the caller's to write.
 */
bool appraise_picture_open(AppraisePicture *picture, int width, int height, ImageType type,
                           int most_views, Message *message);

/* Adds a view: copies of the scene whose exact picture counts, and, if not NULL, of that which was
 * drawn in its place with other meshes. Both have passed scene_check. */
bool appraise_picture_add(AppraisePicture *picture, const int place[4], const Scene *asked,
                          const Scene *drawn, Message *message);
void appraise_picture_close(AppraisePicture *picture); /* NULL or a zeroed picture is fine */

/* The last picture that was finished, if there is one. */
typedef struct AppraiseResult {
    bool computing;       /* another one is on its way */
    bool known;           /* the rest, but for `message`, is set */
    ReferenceError error; /* `worst` is a pixel's number in the image */
    double seconds;       /* the picture's moment */
    double milliseconds;  /* it took */
    Message message;      /* why the last one has no result; else empty */
} AppraiseResult;

typedef struct Appraise Appraise;

/* Starts the thread that waits for pictures. */
bool appraise_open(Appraise **appraise, Message *message);

/* Takes the picture over (it is zeroed), and returns at once. One that is being computed is
 * abandoned. */
void appraise_start(Appraise *appraise, AppraisePicture *picture);

/* Whether something is being computed. */
bool appraise_busy(Appraise *appraise);

void appraise_result(Appraise *appraise, AppraiseResult *result);

/* Abandons what is being computed and forgets what is known: the picture is another one. Returns at
 * once. */
void appraise_cancel(Appraise *appraise);

/* Abandons what is being computed and waits for the thread's end: see reference_open for how long.
 * NULL is fine. */
void appraise_close(Appraise *appraise);

/* The same without a thread of its own, and with `threads` of them, for those who can wait. False,
 * with a message, where memory runs out. `stop` as in ReferenceOptions. */
bool appraise_compute(const AppraisePicture *picture, int threads, const atomic_bool *stop,
                      ReferenceError *error, Message *message);

#endif
