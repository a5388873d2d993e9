/*
 * exact_light: the lighting equation at a pixel, with its numbers, and its directions.
 */
#ifndef EXACT_LIGHT_H
#define EXACT_LIGHT_H

#include "probe/exact_pixel.h"
#include "reference/reference_trace.h"

/* At `at`, in pixels of the view whose x, y, width and height in the picture are `place`. `unlit`:
 * as SceneTerms has it. */
void exact_light_tell(ExactPixel *exact, const Trace *trace, const Scene *scene, const int place[4],
                      const double at[2], bool unlit);

#endif
