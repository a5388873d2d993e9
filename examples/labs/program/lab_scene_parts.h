/*
 * lab_scene_parts: what the scenes of a lab are made of. No GL.
 */
#ifndef LAB_SCENE_PARTS_H
#define LAB_SCENE_PARTS_H

#include "base/random.h"
#include "core/matrix.h"
#include "labs/program/lab_scene.h"

#include <stdbool.h>

/* Random numbers of a seed. */

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

/* Lights so bright that whatever clamps them shows. */

/* The light of each lamp, before it is multiplied by the surface's colour, exceeds 1 in two
 * channels although no colour of the picture does. On flat shapes the first lamp faces a face. With
 * a highlight, except in lab 7, one channel has only that, up to 1. */
void lab_scene_overexpose_light(LabScene *lab_scene, const Lab *lab);

/* One channel of the picture exceeds 1. */
void lab_scene_overexpose_picture(LabScene *lab_scene);

/* The scenes of lab 11: one or two objects on a floor, and a light above. Objects stand a little in
 * the floor, and no light grazes their faces: what a bias of a few thousandths leaves or leaks is
 * then within two pixels of a shadow's edge. */

/* An object's matrix, lowered onto the floor. */
Mat4 lab_scene_on_floor(const Mesh *mesh, Mat4 world_from_object);

/* Adds the floor, the last object. */
bool lab_scene_add_floor(LabScene *lab_scene, Vec3 color, Message *message);

/* The camera, the light and the objects of a scene other than the lab's own. */
bool lab_scene_choose_shadow(LabScene *lab_scene, Random *random, Message *message);

#endif
