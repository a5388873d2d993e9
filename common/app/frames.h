/*
 * frames: the pictures of a command, drawn one after the other, to files or into an animation.
 */
#ifndef FRAMES_H
#define FRAMES_H

#include "app/options.h"
#include "app/renderer.h"
#include "images/animation.h"
#include "images/picture_queue.h"

/* The file of picture `number`, and its moment. */
bool frames_path(const Options *options, int number, char path[PATH_MAX], Message *message);
double frames_moment(const Options *options, int number);

/* The threads that write pictures, and the animation if all go to one file or stream. */
typedef struct FrameSink {
    PictureQueue *queue;
    Animation *animation;
} FrameSink;

bool frames_open(FrameSink *sink, const Canvas *canvas, const Options *options, Message *message);

/* Draws all, or those of --part. */
bool frames_draw(Renderer *renderer, const Options *options, PictureQueue *queue, Message *message);

/* Waits for the last picture to be written. Unless all were drawn, no animation is left. */
bool frames_close(FrameSink *sink, bool drawn, Message *message);

/* Writes files of lines and curves instead. */
bool frames_write_vectors(const Example *example, const Options *options, Message *message);

/* Where the parts of an animation are: pictures in a folder of its name. */
typedef struct FrameParts {
    char folder[PATH_MAX], pictures[2 * PATH_MAX];
    Options options; /* with which they are drawn */
} FrameParts;
bool frames_find_parts(FrameParts *parts, const Options *options, Message *message);

/* --merge: draws nothing; puts the animation together from what --part has drawn. */
bool frames_merge(const Example *example, const Options *options, Message *message);

#endif
