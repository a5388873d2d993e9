/*
 * probe_shadow: the scenes of lab 11: one or two objects on a floor, and a light above. No GL.
 *
 * Objects stand a little in the floor, and no light grazes their faces: what a bias of a few
 * thousandths leaves or leaks is then within two pixels of a shadow's edge.
 */
#ifndef PROBE_SHADOW_H
#define PROBE_SHADOW_H

#include "labs/program/probe.h"

/* An object's matrix, lowered onto the floor. */
Mat4 probe_on_floor(const Mesh *mesh, Mat4 world_from_object);

/* Adds the floor, the last object. */
bool probe_add_floor(Probe *probe, Vec3 color, Message *message);

/* The camera, the light and the objects of a scene other than the lab's own. */
bool probe_choose_shadow(Probe *probe, Random *random, Message *message);

#endif
