/*
 * picture_check: what the tests of pictures share: whether this machine can draw at all, whether
 * two pictures are the same, and keeping those that are not, to be looked at.
 */
#ifndef PICTURE_CHECK_H
#define PICTURE_CHECK_H

#include "image.h"
#include "testing.h"

/* Whether a driver can be had; where none can, says so in one line. */
bool picture_check_driver(const char *test);

/* Whether every channel, alpha too, of every pixel of two byte pictures differs by `levels` steps
 * of 1/255 at most. Where not, says where they differ most and keeps both as `name`. */
bool picture_check_same(const char *name, const Image *picture, const Image *expected, int levels);

/* Writes NAME-picture.png, NAME-expected.png and NAME-difference.png (brightened, so that one
 * level can be seen) into the folder that the environment's LIGHTING_FAILURES names, by default
 * "failures", and prints their paths. Byte pictures of one size. */
void picture_check_keep(const char *name, const Image *picture, const Image *expected);

#endif
