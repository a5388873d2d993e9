/*
 * effects_of: the effects of one object of a scene that has passed scene_check, without a plan.
 */
#ifndef EFFECTS_OF_H
#define EFFECTS_OF_H

#include "scene/effects.h"

ObjectFacts effects_facts(const Scene *scene, const Object *object);
Effects effects_of(const Scene *scene, const Object *object);
Effects effects_full(const Scene *scene, const Object *object);
void effects_explain(const Scene *scene, const Object *object, FILE *file);

#endif
