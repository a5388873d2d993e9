/* Lists and steps; in which order they are tried is cheapest_search's. */
#include "choose/cheapest_task.h"

#include "reference/reference.h"
#include "scene/effects.h"

/* Of a turn, or a side. */
const int CANDIDATE_LEVELS[] = {4,  6,  8,  10, 12, 14,  16,  20,  24,  28,  32,  40,
                                48, 56, 64, 80, 96, 112, 128, 160, 192, 256, 384, 512};
enum { LEVEL_COUNT = sizeof CANDIDATE_LEVELS / sizeof CANDIDATE_LEVELS[0] };

bool candidate_is_kept(unsigned kept, QualityAxis axis)
{
    return (kept >> axis) & 1;
}

/* A teapot, of four patches around, is not closer to the exact picture's where it is finer. */
int candidate_level_count(unsigned kept, const Object *object)
{
    enum { FINEST = 4 * REFERENCE_TEAPOT_DIVISIONS };
    int count = 0;
    if (!object->solid.kind || object->mesh->colors || object->mesh->lit_positions ||
        candidate_is_kept(kept, AXIS_DIVISIONS))
        return 0;
    while (count < LEVEL_COUNT &&
           (object->solid.kind != SOLID_TEAPOT || CANDIDATE_LEVELS[count] <= FINEST))
        count++;
    return count;
}

enum { RELAX_VIEWER, RELAX_NORMALS, RELAX_LIGHTS };

int candidate_relaxation_count(const Scene *scene)
{
    const int most = EFFECTS_MAX_LIGHTS, lights = scene->light_count;
    return RELAX_LIGHTS + 3 * (lights < most ? lights : most);
}

bool candidate_relax(unsigned kept, const Scene *scene, int which, ObjectQuality *quality)
{
    const ObjectQuality before = *quality;
    if (which == RELAX_VIEWER) {
        quality->distant_viewer |= !candidate_is_kept(kept, AXIS_VIEWER);
    } else if (which == RELAX_NORMALS) {
        quality->skip_renormalization |= !candidate_is_kept(kept, AXIS_NORMALS);
    } else if (!candidate_is_kept(kept, AXIS_LIGHTS)) {
        const int number = (which - RELAX_LIGHTS) / 3;
        const uint32_t bit = (uint32_t)1 << number;
        const Light *light = &scene->lights[number];
        if (light->off || quality->dark_lights & bit)
            return false;
        if ((which - RELAX_LIGHTS) % 3 == 0)
            quality->dark_lights |= bit;
        else if ((which - RELAX_LIGHTS) % 3 == 1 && !color_is_black(light->specular))
            quality->matte_lights |= bit;
        else if ((which - RELAX_LIGHTS) % 3 == 2 && light->kind == LIGHT_POINT)
            quality->far_lights |= bit;
    }
    return !object_quality_equal(&before, quality);
}

bool candidate_refine(unsigned kept, const Object *object, const ObjectQuality *plain,
                      ObjectQuality *quality)
{
    const ObjectQuality before = *quality;
    if (plain) {
        quality->distant_viewer = plain->distant_viewer;
        quality->skip_renormalization = plain->skip_renormalization;
        quality->far_lights = quality->matte_lights = quality->dark_lights = 0;
    }
    for (int i = 0; i < candidate_level_count(kept, object); i++) {
        if (CANDIDATE_LEVELS[i] > quality->divisions) {
            /* Of the mesh as given the fineness is not known. */
            quality->divisions = quality->divisions ? CANDIDATE_LEVELS[i] : 32;
            break;
        }
    }
    return !object_quality_equal(&before, quality);
}
