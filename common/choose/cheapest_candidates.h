/*
 * cheapest_candidates: the ways to draw an object among which the cheapest is looked for:
 * finenesses of its mesh, and simplifications of its lighting. `kept`: see CheapestQualityTask.
 */
#ifndef CHEAPEST_CANDIDATES_H
#define CHEAPEST_CANDIDATES_H

#include "scene/quality.h"

/* Divisions of a turn, or a side, from coarse to fine; how many of them can be drawn of an object.
 */
extern const int CANDIDATE_LEVELS[];
int candidate_level_count(unsigned kept, const Object *object);

/* The number of simplifications there may be in a scene: the viewer, the normals, and three of each
 * light. */
int candidate_relaxation_count(const Scene *scene);

/* Adds one of them. False: there is no such one for this quality. */
bool candidate_relax(unsigned kept, const Scene *scene, int which, ObjectQuality *quality);

/* Takes the next finer level; with `plain` also back what was simplified. False: there is none. */
bool candidate_refine(unsigned kept, const Object *object, const ObjectQuality *plain,
                      ObjectQuality *quality);

bool candidate_is_kept(unsigned kept, QualityAxis axis);

#endif
