/*
 * For each light that has shadows: an object receives them if another, or itself, may come between
 * it and the light; and that other throws them. For both questions one partner is enough. So each
 * object looks for a single one, and tries first the partner of the object before it: above a floor
 * that is the floor, for all of them. What is found answers the partner's question, too. Objects
 * beyond a light's range or cone are left out: what shades one that it reaches lies between. Before
 * boxes are compared exactly (shadows/shadow_culling.h), spheres around them rule out most pairs.
 */
#include "scene/shadow_pairs.h"

#include <math.h>
#include <stdlib.h>

static bool grow(void *list, size_t size, int count)
{
    void *larger = realloc(*(void **)list, (size_t)count * size);
    if (larger)
        *(void **)list = larger;
    return larger != NULL;
}

bool shadow_pairs_open(ShadowPairs *pairs, int count, Message *message)
{
    if (count > pairs->capacity) {
        if (!grow(&pairs->boxes, sizeof *pairs->boxes, count) ||
            !grow(&pairs->placed, sizeof *pairs->placed, count) ||
            !grow(&pairs->receives, sizeof *pairs->receives, count) ||
            !grow(&pairs->throws, sizeof *pairs->throws, count) ||
            !grow(&pairs->reached, sizeof *pairs->reached, count))
            return message_set(message, "shadows: not enough memory for %d objects", count);
        pairs->capacity = count;
    }
    pairs->count = count;
    return true;
}

void shadow_pairs_close(ShadowPairs *pairs)
{
    free(pairs->boxes);
    free(pairs->placed);
    free(pairs->receives);
    free(pairs->throws);
    free(pairs->reached);
    *pairs = (ShadowPairs){.count = 0};
}

/* Its center lies farther than the radius outside the tangent plane of the cone on its side. */
bool cone_misses(const Light *light, Sphere sphere)
{
    static const double RADIANS = 0.017453292519943295;
    Vec3 axis;
    const Vec3 to_center = vec3_subtract(sphere.center, light->position);
    if (!vec3_normalize(light->direction, &axis))
        return false;
    const double along = vec3_dot(to_center, axis);
    const double across = vec3_length(vec3_subtract(to_center, vec3_scale(axis, along)));
    const double angle = light->cutoff * RADIANS;
    return across * cos(angle) - along * sin(angle) > sphere.radius * (1 + 1e-9);
}

double nearest_to(const Light *light, Sphere sphere)
{
    return fmax(vec3_length(vec3_subtract(sphere.center, light->position)) - sphere.radius, 0);
}

bool beyond_range(const Light *light, Sphere sphere)
{
    return light->range > 0 && nearest_to(light, sphere) > light->range * (1 + 1e-6);
}

/* One light's search. */
typedef struct Search {
    ShadowPairs *pairs;
    const Scene *scene;
    Light light; /* in the world */
    uint32_t bit;
    int count; /* of `reached` */
    int last;  /* where a partner was found */
} Search;

static bool casts(const Light *light)
{
    return light->shadows && !light->off &&
           !(color_is_black(light->diffuse) && color_is_black(light->specular));
}

/* Whether the light ends somewhere, and before the object. */
static bool misses(const Search *search, int object)
{
    const Light *light = &search->light;
    const bool spot = light->kind == LIGHT_SPOT;
    if (!spot && (light->kind == LIGHT_DIRECTIONAL || light->range == 0))
        return false;
    const Sphere sphere =
        scene_sphere(&search->scene->objects[object], &search->pairs->boxes[object]);
    return (spot && cone_misses(light, sphere)) || beyond_range(light, sphere);
}

static void find_reached(Search *search)
{
    for (int i = 0; i < search->pairs->count; i++)
        if (!misses(search, i))
            search->pairs->reached[search->count++] = i;
}

/* Whether spheres around both show that the occluder is beside, behind or beyond all that lies
 * between the receiver and the light. */
static bool far_apart(const PlacedBox *occluder, const PlacedBox *receiver, Vec4 light)
{
    const double apart = (placed_size(occluder) + placed_size(receiver)) * (1 + 1e-5);
    const Vec3 place = {light.x, light.y, light.z};
    const Vec3 to_light = light.w != 0 ? vec3_subtract(place, receiver->center) : place;
    const Vec3 way = vec3_subtract(occluder->center, receiver->center);
    const double square = vec3_dot(to_light, to_light);
    double share = square > 0 ? fmax(vec3_dot(way, to_light) / square, 0) : 0;
    if (light.w != 0)
        share = fmin(share, 1);
    const Vec3 rest = vec3_subtract(way, vec3_scale(to_light, share));
    return vec3_dot(rest, rest) > apart * apart;
}

/* Both are reached. An object that is convex does not shadow itself: where N.L > 0 it sees the
 * light. */
static bool may_fall(const Search *search, int occluder, int receiver)
{
    const PlacedBox *placed = search->pairs->placed;
    const Vec4 place = light_place(&search->light);
    if (search->scene->objects[occluder].lamp)
        return false;
    if (occluder == receiver)
        return !object_is_convex(&search->scene->objects[occluder]);
    return !far_apart(&placed[occluder], &placed[receiver], place) &&
           may_come_between(&placed[occluder], &placed[receiver], place);
}

/* Whether the object finds a partner, or is one: `throwing`, that its shadow may fall on; else,
 * whose shadow may fall on it. */
static void find_partner(Search *search, int object, bool throwing)
{
    ShadowPairs *pairs = search->pairs;
    if ((throwing ? pairs->throws : pairs->receives)[object] & search->bit)
        return;
    for (int k = -1; k < search->count; k++) {
        const int other = k < 0 ? search->last : pairs->reached[k];
        const int occluder = throwing ? object : other, receiver = throwing ? other : object;
        if (!may_fall(search, occluder, receiver))
            continue;
        pairs->throws[occluder] |= search->bit;
        pairs->receives[receiver] |= search->bit;
        pairs->all |= search->bit;
        search->last = other;
        return;
    }
}

void shadow_pairs_find(ShadowPairs *pairs, const Scene *scene)
{
    pairs->all = 0;
    for (int i = 0; i < pairs->count; i++)
        pairs->receives[i] = pairs->throws[i] = 0;
    for (int l = 0; l < scene->light_count && l < SCENE_MAX_CASTING && pairs->count > 0; l++) {
        Search search = {pairs, scene, scene_world_light(scene, l), (uint32_t)1 << l, 0, 0};
        /* What is seen from the eye sees a light there. */
        const Vec3 to_eye = vec3_subtract(search.light.position, scene->camera.eye);
        if (!casts(&scene->lights[l]) ||
            (search.light.kind != LIGHT_DIRECTIONAL && vec3_length(to_eye) == 0))
            continue;
        find_reached(&search);
        for (int turn = 0; turn < 2 && search.count > 0; turn++) {
            search.last = pairs->reached[0];
            for (int i = 0; i < search.count; i++)
                find_partner(&search, pairs->reached[i], turn == 0);
        }
    }
}
