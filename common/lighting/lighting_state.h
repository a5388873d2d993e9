/*
 * lighting_state: what the files of lighting share, for them alone.
 */
#ifndef LIGHTING_STATE_H
#define LIGHTING_STATE_H

#include "lighting/lighting.h"
#include "lighting/lighting_meshes.h"
#include "lighting/lighting_program.h"
#include "shadows/shadow_map.h"

struct Lighting {
    LightingPrograms programs;
    LightingMeshes meshes;
    ShadowSettings shadows;
    ShadowMask mask; /* opened when a scene first needs it */
    ShadowMaps maps; /* likewise */
    ShadowVolumes volumes;
    LightingTransforms transforms;
    LightingNormalMatrix *normal_matrix; /* NULL: mat4_normal */
    bool depth_pass;                     /* even where the eye is in a volume */
    int renewal; /* counts what makes plans out of date: settings, and meshes that are forgotten */
    LightingPlan *shown; /* lighting_show's, by view */
    int shown_count;
};

#endif
