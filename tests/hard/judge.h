/*
 * judge: the error of a scene's picture beyond what rounding to floats explains.
 */
#ifndef JUDGE_H
#define JUDGE_H

#include "hard/random_scene.h"

/* Opens canvases of this size. */
void judge_open(int size);
void judge_close(void);

/* random_scene_ready with the judge's own meshes. */
bool judge_ready(RandomScene *scene);

/* The largest error inside the objects of a float picture, in steps of 1/255, beyond twice the
 * effect of changing the scene's numbers in the 7th digit; INFINITY if a value is not finite. If
 * the error cannot be more than `enough`, without that allowance. -1 if a scene is not judged: it
 * is invalid, shows nothing, or needs more bits of depth than there are. */
double judge_error(RandomScene *scene, double enough);

#endif
