/*
 * renderer: an example opened in a canvas, to be drawn by the operations of its kind.
 *
 * One is open at a time, because an example's state is its own.
 */
#ifndef RENDERER_H
#define RENDERER_H

#include "app/example_kind.h"

/* Calls the example's init. What is pointed to must outlive the renderer. */
bool renderer_open(Renderer *renderer, const Example *example, const Canvas *canvas,
                   const DrawRequest *request, Message *message);

/* Calls the example's finish and restores the GL state it may have changed. Zeroed is fine. */
void renderer_close(Renderer *renderer);

/* Rebuilds what the example has made of its parameters after they changed; compiled programs stay.
 * After a failure there is nothing to draw, but it can be renewed again or closed. */
bool renderer_renew(Renderer *renderer, const DrawRequest *request, Message *message);

/* Clears the canvas and draws one frame. Only if the kind draws. */
bool renderer_draw(Renderer *renderer, const DrawRequest *request, double seconds,
                   Message *message);

/* Whether a picture whose image has this type is finished on the CPU. */
bool renderer_finishes_on_cpu(const Example *example, ImageType type);

/* Draws one frame and reads it back into the image, which gets the canvas's size; or paints it
 * there, if that is what the kind does. */
bool renderer_picture(Renderer *renderer, const DrawRequest *request, double seconds, Image *image,
                      Message *message);

/* Writes on standard output what the kind has to say of the program. */
bool renderer_explain(Renderer *renderer, const DrawRequest *request, Message *message);

/* For kinds: clears the canvas to the background of the request. */
void renderer_clear(const Renderer *renderer, const DrawRequest *request, Vec3 background);

#endif
