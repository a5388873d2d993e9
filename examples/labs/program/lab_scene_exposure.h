/*
 * lab_scene_exposure: makes the lights of a scene so bright that whatever clamps them shows. No GL.
 */
#ifndef LAB_SCENE_LIGHT_H
#define LAB_SCENE_LIGHT_H

#include "labs/program/lab_scene.h"

/* The light of each lamp, before it is multiplied by the surface's colour, exceeds 1 in two
 * channels although no colour of the picture does. On flat shapes the first lamp faces a face. With
 * a highlight, except in lab 7, one channel has only that, up to 1. */
void lab_scene_overexpose_light(LabScene *lab_scene, const Lab *lab);

/* One channel of the picture exceeds 1. */
void lab_scene_overexpose_picture(LabScene *lab_scene);

#endif
