/*
 * stage: what a program with one example and a gallery of them share: a canvas opened as the
 * options say, an example put on it, a frame drawn and made a picture.
 */
#ifndef STAGE_H
#define STAGE_H

#include "appraise.h"
#include "canvas.h"
#include "example.h"
#include "options.h"
#include "picture.h"

/* Opens the canvas that the options ask for; with float colours where the output's format holds
 * them. On --verbose says on standard error what it got. */
bool stage_open(Canvas *canvas, const Options *options, const char *output, Message *message);

/* Puts an example on the stage: its init, and for one that is a scene what draws it. One at a time.
 * stage_leave takes it off, and puts back the GL state that it may have changed. */
bool stage_enter(const Example *example, const Options *options, Message *message);
void stage_leave(const Example *example);

/* Clears the canvas and draws one frame, without reading it back. */
bool stage_draw(const Example *example, const Canvas *canvas, const Options *options,
                double seconds, Message *message);

/* Draws one frame and reads it back into the picture, whose image gets the canvas's size, and whose
 * path is set by the caller. */
bool stage_picture(const Example *example, const Canvas *canvas, const Options *options,
                   double seconds, Picture *picture, Message *message);

/* Draws one frame of an example that is a scene without anything over it, marks, labels or
 * retouches, and copies the scenes that it is of as they were before an --error simplified them:
 * what appraise_start wants. The canvas then holds that frame. */
bool stage_appraise(const Example *example, const Canvas *canvas, const Options *options,
                    double seconds, AppraisePicture *picture, Message *message);

/* Makes anew what an example on the stage has made of its parameters, which are others now. What
 * was compiled stays. After a failure there is nothing to draw: it can be made anew again, or
 * taken off. */
bool stage_renew(const Example *example, const Options *options, Message *message);

/* Writes which effects a scene calls for at the options' moment, view by view, object by object. */
void stage_effects(const Example *example, const Options *options, FILE *file);

/* --explain: says on standard output, for each view and object, which effects the scene calls for,
 * and prints the shaders of its program. */
bool stage_explain(const Example *example, const Options *options, Message *message);

/* --doctor: says what this machine has. Returns the exit code. */
int stage_doctor(void);

#endif
