/*
 * picture_queue: threads that encode and write pictures while the caller draws the next.
 */
#ifndef PICTURE_QUEUE_H
#define PICTURE_QUEUE_H

#include "images/image_file.h"

#include <limits.h>

enum { PICTURE_DRIVER_SIZE = 512, PICTURE_SOURCES_SIZE = 4000 };

/* An image and everything its file needs. */
typedef struct Picture {
    Image image;
    char path[PATH_MAX]; /* "-": standard output, as PNG */
    int compress;
    bool alpha;
    /* The file's text chunks. */
    char title[64];                     /* the program's name */
    char moment[64];                    /* the time drawn: "1.5 s" */
    char driver[PICTURE_DRIVER_SIZE];   /* backend, platform, renderer */
    char sources[PICTURE_SOURCES_SIZE]; /* what it was drawn from; "": not said */
    char command[4 * PATH_MAX]; /* makes the file again, under another name; "": there is none */
} Picture;

/* Encodes and writes, as output_write does. */
bool picture_write(const Picture *picture, Message *message);

/* Reads what picture_write has written to picture->path, a PNG: the image, which is reopened if
 * its size differs, alpha, and the texts. An image that was zeroed is to be closed even on failure.
 */
bool picture_read(Picture *picture, Message *message);

/* Takes a queue's pictures. False stops the queue; without a message if that is no error. */
typedef bool PictureWrite(void *data, const Picture *picture, Message *message);

typedef struct PictureQueueOptions {
    int width, height;
    ImageType type;
    int count;           /* of the pictures that will be given */
    PictureWrite *write; /* called by one thread, in order; NULL: two threads write each picture to
                            its path */
    void *data;
} PictureQueueOptions;

typedef struct PictureQueue PictureQueue;

/* Starts the threads. */
bool picture_queue_open(PictureQueue **queue, const PictureQueueOptions *options, Message *message);

/* A picture to draw into; waits while all are in use. */
Picture *picture_queue_take(PictureQueue *queue);

/* Hands it to the threads. False, with its message, if an earlier picture could not be written;
 * later pictures are then dropped. */
bool picture_queue_give(PictureQueue *queue, Picture *picture, Message *message);

/* Waits until every picture is written, ends the threads and frees the queue. False, with the first
 * failure's message, if a picture could not be written. NULL is fine. */
bool picture_queue_close(PictureQueue *queue, Message *message);

#endif
