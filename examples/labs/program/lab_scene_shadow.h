/*
 * lab_scene_shadow: the scenes of lab 11: one or two objects on a floor, and a light above. No GL.
 *
 * Objects stand a little in the floor, and no light grazes their faces: what a bias of a few
 * thousandths leaves or leaks is then within two pixels of a shadow's edge.
 */
#ifndef LAB_SCENE_SHADOW_H
#define LAB_SCENE_SHADOW_H

#include "labs/program/lab_scene.h"

/* An object's matrix, lowered onto the floor. */
Mat4 lab_scene_on_floor(const Mesh *mesh, Mat4 world_from_object);

/* Adds the floor, the last object. */
bool lab_scene_add_floor(LabScene *lab_scene, Vec3 color, Message *message);

/* The camera, the light and the objects of a scene other than the lab's own. */
bool lab_scene_choose_shadow(LabScene *lab_scene, Random *random, Message *message);

#endif
