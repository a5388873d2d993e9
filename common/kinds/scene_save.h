/*
 * scene_save: a scene as a file of glTF 2.0.
 */
#ifndef SCENE_SAVE_H
#define SCENE_SAVE_H

#include "scene/scene.h"

/* Writes all of a scene into one file, whose buffer is a data URI. What glTF has no word for is in
 * `extras`, so that reading it gives the same scene; other readers see materials as diffuse colours
 * with a roughness, lights without ambient colours and attenuation. */
bool scene_save(const Scene *scene, const char *path, Message *message);

#endif
