/*
 * A shadow volume would reach to infinity, which costs pixels. What lies behind all receivers need
 * not be counted, so each volume ends at a plane there. Any plane will do; good ones are parallel
 * to a floor or a wall, which are the sides of the largest boxes. For each light the receivers'
 * extent along these few directions is found once, and for each caster the plane that it reaches
 * first: the time is linear in both.
 */
#include "lighting/lighting_state.h"

#include <math.h>

/* The numbers of the largest boxes, in their order; how many. */
static int largest_boxes(const ShadowPairs *pairs, int numbers[END_BOXES])
{
    double sizes[END_BOXES];
    int count = 0;
    for (int i = 0; i < pairs->count; i++) {
        const double size = placed_size(&pairs->placed[i]);
        int least = 0;
        for (int k = 1; k < count; k++)
            least = sizes[k] < sizes[least] ? k : least;
        if (count == END_BOXES && size <= sizes[least])
            continue;
        for (int k = least; count == END_BOXES && k + 1 < count; k++) {
            numbers[k] = numbers[k + 1];
            sizes[k] = sizes[k + 1];
        }
        count = count < END_BOXES ? count + 1 : count;
        numbers[count - 1] = i;
        sizes[count - 1] = size;
    }
    return count;
}

static double receivers_least(const LightingPlan *plan, int light, Vec3 way)
{
    double least = INFINITY, most = -INFINITY;
    for (int r = 0; r < plan->pairs.count; r++) {
        if (!(plan->full || plan->pairs.receives[r] >> light & 1))
            continue;
        const PlacedBox *box = &plan->pairs.placed[r];
        const double middle = vec3_dot(box->center, way), reach = placed_reach(box, way);
        least = fmin(least, middle - reach);
        most = fmax(most, middle + reach);
    }
    return least - 1e-3 * (most - least) - 1e-5 * fabs(least);
}

void shadow_ends_find(ShadowEnds *ends, const LightingPlan *plan, int light)
{
    int numbers[END_BOXES];
    const int boxes = largest_boxes(&plan->pairs, numbers);
    ends->count = 0;
    for (int k = 0; k < 6 * boxes; k++) {
        const Vec3 *half = plan->pairs.placed[numbers[k / 6]].half;
        Vec3 way;
        if (!vec3_normalize(vec3_cross(half[k / 2 % 3], half[(k / 2 + 1) % 3]), &way))
            continue;
        way = vec3_scale(way, k % 2 ? -1 : 1);
        ends->ways[ends->count] = way;
        ends->least[ends->count++] = receivers_least(plan, light, way);
    }
}

Vec4 shadow_ends_choose(const ShadowEnds *ends, const PlacedBox *caster, const Light *light)
{
    static const double FAR = 1e6; /* a light's distance that leaves no digits of a float */
    const bool directional = light->kind == LIGHT_DIRECTIONAL;
    double soonest = INFINITY;
    Vec4 found = {0, 0, 0, 1};
    if (!directional && vec3_length(vec3_subtract(light->position, caster->center)) >
                            FAR * vec3_length(vec3_add(caster->half[0], caster->half[1])))
        return found;
    for (int k = 0; k < ends->count; k++) {
        const Vec3 way = ends->ways[k];
        /* The light is on the plane's other side, and the caster between them. */
        const double middle = vec3_dot(caster->center, way), reach = placed_reach(caster, way);
        const double lights = directional ? vec3_dot(light->direction, way)
                                          : vec3_dot(light->position, way) - middle - reach;
        const double least = ends->least[k], steps = (middle - least) / lights;
        if (lights > 0 && middle - reach > least && steps < soonest) {
            soonest = steps;
            found = (Vec4){way.x, way.y, way.z, -least};
        }
    }
    return found;
}

bool shadow_end_before(const Vec4 *end, const PlacedBox *box)
{
    const Vec3 way = {end->x, end->y, end->z};
    return vec3_dot(box->center, way) - placed_reach(box, way) + end->w < 0;
}
