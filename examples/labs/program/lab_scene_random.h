/*
 * lab_scene_random: what the scenes of a seed are made of. No GL.
 */
#ifndef LAB_SCENE_RANDOM_H
#define LAB_SCENE_RANDOM_H

#include "base/random.h"
#include "core/matrix.h"

#include <stdbool.h>

/* Three different numbers, so that swapped channels show. */
Vec3 random_color(Random *random, double min, double max);

/* Evenly over the unit sphere. */
Vec3 random_direction(Random *random);

/* A unit direction at min to max degrees from the axis. */
Vec3 random_near(Random *random, Vec3 axis, double min, double max);

bool random_chance(Random *random);

/* A size, of either sign. One number in a statement: compilers differ in the order of operands and
 * arguments. */
double random_signed(Random *random, double min, double max);

#endif
