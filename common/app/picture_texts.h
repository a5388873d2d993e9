/*
 * picture_texts: what a picture's file says of itself.
 */
#ifndef PICTURE_TEXTS_H
#define PICTURE_TEXTS_H

#include "app/options.h"
#include "images/picture_queue.h"

#include <time.h>

/* How the picture is to be encoded, and its texts: title, moment, driver and command. The caller
 * sets its path before. */
void picture_texts_set(const Example *example, const Canvas *canvas, const Options *options,
                       double seconds, Picture *picture);

/* What pictures were drawn from: lines of a file's name and its hash, of the program, the files
 * that options name (a model) and the shader files that were read. Zeroed: not known yet. */
typedef struct PictureSources {
    char text[PICTURE_SOURCES_SIZE];
    int files;             /* read shader files */
    bool kept;             /* the last picture was there already */
    struct timespec since; /* older files of pictures that do not say it were drawn from others */
} PictureSources;

/* Brings it up to date after drawing, and gives it to the picture. */
void picture_texts_sources(PictureSources *sources, const Example *example, const Options *options,
                           Picture *picture);

/* Whether the file of the picture's path is there, whole, with the same texts. Reads the image. */
bool picture_texts_kept(Picture *picture);

/* Reads what the part of another process has written to picture->path. Fails if it is not of the
 * command that `picture` has, was drawn by another driver ("": by any) or from a file that was
 * another one then, and adds what it says to both. */
typedef struct PictureOrigin {
    char driver[PICTURE_DRIVER_SIZE];
    char sources[PICTURE_SOURCES_SIZE];
} PictureOrigin;
bool picture_texts_check(Picture *picture, PictureOrigin *origin, Message *message);

#endif
