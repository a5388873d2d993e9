/*
 * lit_world: the world of exact_world in a directional light along the view, for tests.
 */
#ifndef LIT_WORLD_H
#define LIT_WORLD_H

#include "support/exact_world.h"

enum { SIZE = WORLD_SIZE, MIDDLE = SIZE / 2 * SIZE + SIZE / 2 };

/* Fixtures. */
int set_up(void **state);
int tear_down(void **state);

Object *add_object(Solid solid, int divisions);

size_t pixel_at(const Reference *picture, int x, int y);
size_t pixel_count(const Reference *picture);
double channel(const Reference *picture, size_t pixel, size_t k);
void assert_color(const Reference *picture, size_t pixel, double red, double green, double blue);

/* The number of pixels that object 0 covers. */
double covered(const Reference *picture);

/* How many pixels a length at distance 1 has. */
double pixels_at_one(int height);

#endif
