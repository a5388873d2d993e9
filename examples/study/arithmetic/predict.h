/*
 * predict: the largest error that measured arithmetic can make in the picture of a scene. No GL.
 *
 * The lighting equation is computed with intervals: of every intermediate result all values that
 * the shader may have there, from its inputs and the largest measured error of each operation. An
 * optimizer that computes something more exactly, or in another order, stays within them.
 */
#ifndef PREDICT_H
#define PREDICT_H

#include "scene/scene.h"
#include "study/arithmetic/arithmetic.h"

/* In steps of 1/255, against the exact picture of the meshes as given, inside objects: at least the
 * half step of rounding, at most 255. `height`: of the picture, in pixels. `fragment`: of the
 * precision that its fragment shader declares. The scene has passed scene_check, and its objects
 * have meshes. Shadows are left out. It is sampled at the corners of the triangles and between, at
 * 5000 points and more. */
double predict_scene(const Scene *scene, int height, const Arithmetic *vertex,
                     const Arithmetic *fragment, const Raster *raster);

/* What of that the power function alone adds to a highlight of this shininess, as bright as can be.
 */
double predict_pow(const Arithmetic *fragment, double shininess);

#endif
