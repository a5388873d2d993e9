/*
 * picture_check: shared by tests that draw: whether there is a driver, comparing pictures, keeping
 * those that differ.
 */
#ifndef PICTURE_CHECK_H
#define PICTURE_CHECK_H

#include "core/canvas.h"
#include "images/image_file.h"
#include "lighting/lighting.h"
#include "reference/reference.h"
#include "support/testing.h"

/* Whether there is a driver; if not, prints why. */
bool picture_check_driver(const char *test);

/* testing_run of list 0, or EXIT_SKIPPED without a driver; and a main of that alone. */
int picture_check_run(const char *name, CMFixtureFunction setup, CMFixtureFunction teardown);
#define PICTURE_TEST_MAIN(name, setup, teardown)                                                   \
    int main(void)                                                                                 \
    {                                                                                              \
        return picture_check_run(name, setup, teardown);                                           \
    }

/* Draws a frame, whose scene must pass scene_check and whose aspect is the canvas's, and reads the
 * picture back. */
void picture_draw(const Canvas *canvas, Lighting *lighting, const LightingFrame *frame,
                  Image *image);

/* The largest difference between two pixels' channels, alpha included, and how many of `count`
 * pixels are more than `levels` apart: steps of 1/255. */
int pixel_levels(const unsigned char a[4], const unsigned char b[4]);
int pixels_apart(const void *a, const void *b, int count, int levels);

/* Whether two byte pictures differ by at most `levels` steps of 1/255 in every channel, alpha
 * included. If not, prints where they differ most and keeps both as `name`. */
bool picture_check_same(const char *name, const Image *picture, const Image *expected, int levels);

/* Writes NAME-picture.png, NAME-expected.png and NAME-difference.png (brightened, so that one step
 * is visible) to the folder in the environment's LIGHTING_FAILURES, by default "failures", and
 * prints their paths. For byte pictures of the same size. */
void picture_check_keep(const char *name, const Image *picture, const Image *expected);
void picture_check_keep_exact(const char *name, const Image *picture, const Reference *expected);

#endif
