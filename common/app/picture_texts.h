/*
 * picture_texts: what a picture's file says of itself.
 */
#ifndef PICTURE_TEXTS_H
#define PICTURE_TEXTS_H

#include "app/options.h"
#include "images/picture_queue.h"

/* How the picture is to be encoded, and its texts: title, moment, driver and command. The caller
 * sets its path before. */
void picture_texts_set(const Example *example, const Canvas *canvas, const Options *options,
                       double seconds, Picture *picture);

/* Reads what the part of another process has written to picture->path. Fails if it is not of the
 * command that `picture` has, or was drawn by another driver ("": by any), whose name is replaced
 * by the picture's. */
enum { PICTURE_DRIVER_SIZE = 512 };
bool picture_texts_check(Picture *picture, char driver[PICTURE_DRIVER_SIZE], Message *message);

#endif
