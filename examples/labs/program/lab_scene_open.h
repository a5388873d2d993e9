/*
 * lab_scene_open: makes the scenes of a lab. No GL.
 */
#ifndef LAB_SCENE_OPEN_H
#define LAB_SCENE_OPEN_H

#include "labs/program/lab_scene.h"

/* The known form of a scene. False, with a message: out of memory. */
bool lab_scene_open_known(LabScene *lab_scene, const Lab *lab, LabSceneKind kind, Message *message);

/* The form of a seed. */
bool lab_scene_open_seed(LabScene *lab_scene, const Lab *lab, LabSceneKind kind, uint64_t seed,
                         Message *message);

/* The scene of the lab's program at a time. */
bool lab_scene_open_usual(LabScene *lab_scene, const Lab *lab, double seconds, Message *message);

#endif
