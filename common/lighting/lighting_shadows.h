/*
 * lighting_shadows: the shadows of a plan, how each is drawn, and drawing them. For lighting's own
 * files.
 */
#ifndef LIGHTING_SHADOWS_H
#define LIGHTING_SHADOWS_H

#include "lighting/lighting_state.h"

/* What shadows may fall on, and how they are drawn. Boxes and places are known; `moved`: have
 * changed. Sets `anew` if the programs look up shadows otherwise than before. */
bool plan_shadows(LightingPlan *plan, const LightingFrame *frame, bool moved, bool *anew,
                  Message *message);

/* What of each object draws its shadows, once it is known which fall. */
bool plan_casters(LightingPlan *plan, const Scene *scene, Message *message);

/* What the shadows of a frame are drawn from. */
typedef struct ShadowFrame {
    const Scene *scene;
    LightingPlan *plan;
    Mat4 eye_from_world, clip_from_eye;
} ShadowFrame;

/* Draws maps, and masks. */
bool draw_shadows(const ShadowFrame *frame, Message *message);

/* Masks and maps to texture units; `bind` false: no longer. */
void bind_shadows(const LightingPlan *plan, bool bind);

/* The uniforms with which the current program looks them up: what is the same for all objects, and
 * an object's. */
void set_shadows(const LightingPlan *plan, const LightingProgram *program);
void place_shadows(const LightingPlan *plan, const LightingProgram *program,
                   Mat4 world_from_object);

#endif
