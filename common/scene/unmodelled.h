/*
 * unmodelled: what a scene would show in reality that the lighting model leaves out. No GL.
 */
#ifndef UNMODELLED_H
#define UNMODELLED_H

#include "scene/scene.h"

#include <stdio.h>

/* Writes a line for each thing that this scene lacks: "object 0, a sphere, would cast a shadow on
 * object 1, a square (light 0)". Shadows are found by rays from points spread over the surfaces to
 * each light. Fails only if memory is out. */
bool unmodelled_explain(const Scene *scene, FILE *file, Message *message);

#endif
