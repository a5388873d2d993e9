/*
 * picture: a drawn image on its way to a file, on this thread or on others.
 *
 * A queue has threads that encode and write while the caller draws, so that drawing and writing
 * share the cores there are.
 */
#ifndef PICTURE_H
#define PICTURE_H

#include "image.h"

#include <limits.h>

/* An image and everything its file needs. */
typedef struct Picture {
    Image image;
    char path[PATH_MAX]; /* "-": standard output, as PNG */
    int compress;
    bool alpha;
    /* The file's text chunks. */
    char title[64];     /* the program's name */
    char moment[64];    /* the time drawn: "1.5 s" */
    char settings[512]; /* size, samples, precision, renderer */
} Picture;

/* Encodes and writes; see output.h for what becomes of an existing file. */
bool picture_write(const Picture *picture, Message *message);

/* What becomes of the pictures of a queue. */
typedef struct PictureSink {
    /* False stops the queue; without a message, nothing is to be said of it. */
    bool (*write)(void *data, const Picture *picture, Message *message);
    void *data;
    int threads; /* that call it, 1 or 2; one gets the pictures in the order in which they are given
                  */
} PictureSink;

typedef struct PictureQueue PictureQueue;

/* Starts the threads, for `count` pictures of this size and type. Where `sink` is NULL, two threads
 * write each picture to its own file. */
bool picture_queue_open(PictureQueue **queue, int width, int height, ImageType type, int count,
                        const PictureSink *sink, Message *message);

/* A picture to draw into; waits while all are being written. */
Picture *picture_queue_take(PictureQueue *queue);

/* Gives it to the threads. False, with its message, where an earlier picture could not be
 * written: none that is given later is written then. */
bool picture_queue_give(PictureQueue *queue, Picture *picture, Message *message);

/* Waits until all that was given is written, ends the threads and frees the queue. False, with the
 * first failure's message, where a picture could not be written. NULL is fine. */
bool picture_queue_close(PictureQueue *queue, Message *message);

#endif
