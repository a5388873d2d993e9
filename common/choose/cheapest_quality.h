/*
 * cheapest_quality: the cheapest way to draw a scene whose error stays within what is allowed,
 * found by drawing: each candidate is compared with the exact picture of this very scene.
 *
 * The error is that of picture_error's interior: against the exact shapes (solids) or the mesh as
 * given (others), the largest over the pixels that lie wholly inside one surface, that the drawn
 * objects cover, and that the same lights reach. Edges, and edges of shadows, do not count; but
 * coarser meshes may move those of shadows over at most a hundredth of these pixels more than the
 * plain picture's do.
 *
 * Candidates differ per object in the mesh of a solid and in lighting per fragment or per vertex;
 * then, as far as the error still allows, in the viewer and each light at infinity, lights without
 * highlight or off, and normals as interpolated. All objects are searched at once, because the
 * pixels of one hardly depend on another. Which one is cheapest is decided by
 * quality_parts_cost, not by a clock, so that the same is chosen every time. `mediump` is no
 * candidate: on llvmpipe it is 1.5 to 3.5 times as slow as `highp`, and never more exact.
 *
 * Exact pictures and choices are kept in base/cache.
 */
#ifndef CHEAPEST_QUALITY_H
#define CHEAPEST_QUALITY_H

#include "choose/cheapest_search.h"

#include <stdio.h>

/* Where the error is unreachable, the cheapest of the most exact is chosen: `error` is then above
 * the task's. Never less exact than the plain picture unless expected to save 30% of its time. */
bool cheapest_quality_find(CheapestQuality *cheapest, const CheapestQualityTask *task,
                           Message *message);
void cheapest_quality_close(CheapestQuality *cheapest);

/* What was simplified, the error, and what that leaves out, in one line without its end:
 * "object 0: 24 divisions, lit per vertex; error 1.2 of 2 allowed inside objects...". */
void cheapest_quality_write(const CheapestQuality *cheapest, const Scene *scene, double allowed,
                            FILE *file);

#endif
