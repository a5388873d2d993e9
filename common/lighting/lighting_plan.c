/*
 * A plan is refreshed in three steps, each of which reads only what the one before it left. Where
 * objects are: their boxes in the world, if a mesh or a transform has changed. What shadows may
 * fall on: if an object or a light has moved. And for each object its facts (scene/effects.h),
 * which are compared with those its effects were decided from. In most frames of an animation all
 * facts are the same, and the plan stays as it is.
 */
#include "base/memory.h"
#include "lighting/lighting_shadows.h"

#include <stdlib.h>
#include <string.h>

static const Object *object_of(const LightingFrame *frame, int number)
{
    return frame->parts ? &frame->parts[number].objects[0] : &frame->scene->objects[number];
}

/* Room */

/* Keeps what the last frame left, unless that was of another kind. */
static bool open_plan(LightingPlan *plan, Lighting *lighting, const LightingFrame *frame,
                      Message *message)
{
    const Scene *scene = frame->scene;
    const bool many = scene->light_count > EFFECTS_MAX_LIGHTS;
    const int lights = many ? SCENE_MAX_CASTING : scene->light_count;
    if (plan->lighting != lighting || plan->renewal != lighting->renewal ||
        plan->full != frame->full || plan->in_parts != (frame->parts != NULL) ||
        plan->each != (frame->parts || many) || plan->object_count != scene->object_count ||
        plan->light_count != lights)
        plan->object_count = plan->light_count = 0;
    plan->lighting = lighting;
    plan->renewal = lighting->renewal;
    plan->full = frame->full;
    plan->in_parts = frame->parts != NULL;
    plan->each = frame->parts || many;
    plan->frame = *frame;
    plan->view.any_normals = lighting->normal_matrix != NULL; /* wrong ones */
    if (scene->object_count > plan->object_capacity) {
        const size_t room = (size_t)scene->object_count;
        plan->objects = memory_grow(plan->objects, room, sizeof *plan->objects);
        plan->surfaces = memory_grow(plan->surfaces, room, sizeof *plan->surfaces);
        plan->casters = memory_grow(plan->casters, room, sizeof *plan->casters);
        plan->scenes = memory_grow(plan->scenes, room, sizeof *plan->scenes);
        memset(plan->scenes, 0, room * sizeof *plan->scenes);
        plan->object_capacity = scene->object_count;
    }
    for (int i = plan->object_count; i < scene->object_count; i++)
        plan->objects[i] = (PlannedObject){.mesh = NULL};
    plan->object_count = scene->object_count;
    if (lights > plan->light_capacity) {
        plan->lights = memory_grow(plan->lights, (size_t)lights, sizeof *plan->lights);
        plan->light_capacity = lights;
    }
    for (int i = plan->light_count; i < lights; i++)
        memset(&plan->lights[i], 0, sizeof plan->lights[i]);
    plan->light_count = lights;
    return shadow_pairs_open(&plan->pairs, scene->object_count, message);
}

void lighting_plan_close(LightingPlan *plan)
{
    if (!plan)
        return;
    shadow_pairs_close(&plan->pairs);
    free(plan->objects);
    free(plan->scenes);
    effects_view_close(&plan->view);
    free(plan->eye_lights);
    free(plan->lights);
    free(plan->surfaces);
    free(plan->casters);
    *plan = (LightingPlan){.lighting = NULL};
}

/* Where objects are. Whether one has moved, or is another. */
static bool place_objects(LightingPlan *plan, const LightingFrame *frame)
{
    bool moved = false;
    for (int i = 0; i < plan->object_count; i++) {
        PlannedObject *planned = &plan->objects[i];
        const Object *object = object_of(frame, i);
        const bool other = planned->mesh != object->mesh;
        const bool convex = object_is_convex(object), lamp = object->lamp != 0;
        if (!other && planned->convex == convex && planned->lamp == lamp &&
            memcmp(&planned->world_from_object, &object->world_from_object,
                   sizeof object->world_from_object) == 0)
            continue;
        if (other) {
            *planned =
                (PlannedObject){.mesh = object->mesh, .normals = effects_normal_cone(object->mesh)};
            plan->pairs.boxes[i] = mesh_bounds(object->mesh);
        }
        planned->convex = convex;
        planned->lamp = lamp;
        planned->world_from_object = object->world_from_object;
        planned->place = effects_place(object, &plan->pairs.boxes[i], &planned->normals);
        plan->pairs.placed[i] = placed_box(&plan->pairs.boxes[i], object->world_from_object);
        moved = true;
    }
    return moved;
}

/* Effects */

/* An object's key, with all effects or those it needs. */
static void make_key(const LightingPlan *plan, int number, bool full, LightingKey *key)
{
    const SceneFacts *scene = lighting_plan_facts(plan, number);
    const ObjectFacts *object = &plan->objects[number].facts;
    uint32_t shadowed = 0;
    memset(key, 0, sizeof *key);
    key->effects = full ? effects_decide_full(scene, object) : effects_decide(scene, object, NULL);
    if (plan->lighting->normal_matrix && key->effects.normals && !full)
        key->effects.normal_matrix = key->effects.normalize_vertex = true;
    for (int g = 0; g < key->effects.group_count; g++) {
        const LightGroup *group = &key->effects.groups[g];
        for (int i = 0; i < group->count && group->terms.shadow; i++) {
            const int light = scene->numbers[group->lights[i]];
            key->numbers[group->lights[i]] = (uint8_t)light;
            shadowed |= (uint32_t)1 << light;
        }
    }
    key->shadows = shadowed ? scene->shadows : 0;
    key->maps = plan->maps & shadowed;
    for (uint32_t left = key->maps; left; left &= left - 1)
        key->looks[__builtin_ctz(left)] = (uint8_t)plan->lights[__builtin_ctz(left)].look;
}

/* How an object's mesh must be remade; INTERPOLATION_PHONG: not at all. */
static Interpolation remade_for(const SceneFacts *scene, const Object *object)
{
    const Interpolation kind = (Interpolation)scene->interpolation;
    const bool flatten = kind == INTERPOLATION_FLAT && !object->flat;
    return flatten || kind == INTERPOLATION_CONSTANT ? kind : INTERPOLATION_PHONG;
}

/* Buffers and program of an object whose facts are known. */
static bool find_means(LightingPlan *plan, const Object *object, int number, Message *message)
{
    PlannedObject *planned = &plan->objects[number];
    LightingMeshes *meshes = &plan->lighting->meshes;
    const SceneFacts *scene = lighting_plan_facts(plan, number);
    LightingKey key;
    planned->variant = NULL;
    planned->drawn = lighting_mesh_buffer(meshes, object->mesh, remade_for(scene, object), message);
    if (!planned->drawn)
        return false;
    make_key(plan, number, plan->full, &key);
    planned->variant = lighting_program(&plan->lighting->programs, &key, message);
    plan->decisions++;
    return planned->variant != NULL;
}

/* Finds the facts of a scene; whether they are new. */
static bool find_scene(SceneFacts *facts, const EffectsView *view, const EffectsLights *lights)
{
    const SceneFacts now = effects_scene(view, lights);
    if (memcmp(facts, &now, sizeof now) == 0)
        return false;
    *facts = now;
    return true;
}

/* Says which object a message is about, unless a shader's line is named. */
static bool object_failed(int number, const Message *why, Message *message)
{
    if (why->located && message)
        *message = *why;
    else
        message_set(message, "object %d: %s", number, why->text);
    return false;
}

/* The facts of all objects, and unless `unbuilt` what is drawn with. `anew`: all are decided. */
static bool plan_objects(LightingPlan *plan, const LightingFrame *frame, bool anew, bool unbuilt,
                         Message *message)
{
    EffectsView *view = &plan->view;
    bool changed = anew;
    for (int i = 0; i < plan->object_count; i++) {
        PlannedObject *planned = &plan->objects[i];
        const Object *object = object_of(frame, i);
        EffectsLights chosen;
        if (i == 0 || frame->parts)
            effects_view(view, frame->parts ? &frame->parts[i] : frame->scene);
        const EffectsLights *lights = effects_lights(view, object, &planned->place, &chosen, NULL);
        if (i == 0 || plan->each)
            changed = find_scene(&plan->scenes[i], view, lights) || anew;
        ObjectFacts facts =
            effects_object(view, lights, object, &planned->place, plan->pairs.receives[i]);
        if (view->any_normals)
            facts.behind = 0;
        const bool same = memcmp(&facts, &planned->facts, OBJECT_FACTS_DECIDE) == 0;
        planned->facts = facts;
        if (!changed && planned->variant && same)
            continue;
        Message why = {.located = false};
        if (!unbuilt && !find_means(plan, object, i, &why))
            return object_failed(i, &why, message);
    }
    return true;
}

static bool check_frame(const LightingFrame *frame, Message *message)
{
    const Scene *scene = frame->scene;
    for (int i = SCENE_MAX_CASTING; i < scene->light_count; i++)
        if (scene->lights[i].shadows && !scene->lights[i].off)
            return message_set(message, "scene: light %d: only the first %d may cast shadows", i,
                               SCENE_MAX_CASTING);
    if (scene_has_shadows(scene) && scene->clamp_vertex &&
        scene->interpolation != INTERPOLATION_PHONG)
        return message_set(message, "shadows are looked up at the fragments: light that is clamped "
                                    "at the vertices has none");
    return true;
}

static bool make_plan(LightingPlan *plan, const LightingFrame *frame, bool unbuilt,
                      Message *message)
{
    bool anew = false;
    const bool moved = place_objects(plan, frame);
    if (plan_shadows(plan, frame, moved, &anew, message) &&
        plan_objects(plan, frame, anew, unbuilt, message))
        return unbuilt || plan_casters(plan, frame->scene, message);
    plan->object_count = 0; /* what is half made is made again */
    return false;
}

bool lighting_plan(LightingPlan *plan, Lighting *lighting, const LightingFrame *frame,
                   Message *message)
{
    return check_frame(frame, message) && open_plan(plan, lighting, frame, message) &&
           make_plan(plan, frame, false, message);
}

bool lighting_decide(LightingPlan *plan, Lighting *lighting, const LightingFrame *frame,
                     Message *message)
{
    return check_frame(frame, message) && open_plan(plan, lighting, frame, message) &&
           make_plan(plan, frame, true, message);
}

/* Reading it */

const SceneFacts *lighting_plan_facts(const LightingPlan *plan, int object)
{
    return &plan->scenes[plan->each ? object : 0];
}

bool lighting_plan_reach(const LightingPlan *plan, int object, uint8_t *why)
{
    const Scene *parts = plan->frame.parts;
    EffectsLights chosen;
    EffectsView own = {.any_normals = plan->view.any_normals};
    if (parts)
        effects_view(&own, &parts[object]);
    const bool chooses = effects_lights(parts ? &own : &plan->view, object_of(&plan->frame, object),
                                        &plan->objects[object].place, &chosen, why) == &chosen;
    effects_view_close(&own);
    return chooses;
}

/* "without lights 3 to 17, 20: it is off". */
static void explain_left_out(const uint8_t *why, int count, FILE *file)
{
    for (int reach = REACH_YES + 1; reach < REACH_COUNT; reach++) {
        const char *before = "without lights ";
        for (int i = 0, next; i < count; i = next) {
            for (next = i; next < count && why[next] == reach;)
                next++;
            if (next > i)
                fprintf(file, next > i + 1 ? "%s%d to %d" : "%s%d", before, i, next - 1);
            before = next > i ? ", " : before;
            next = next > i ? next : i + 1;
        }
        if (before[0] == ',')
            fprintf(file, ": %s\n", EFFECTS_REACHES[reach]);
    }
}

Effects lighting_plan_effects(const LightingPlan *plan, int object)
{
    LightingKey key;
    make_key(plan, object, plan->full, &key);
    return key.effects;
}

void lighting_plan_explain(const LightingPlan *plan, int object, FILE *file)
{
    const int count = plan->frame.scene->light_count;
    uint8_t *why = memory_new((size_t)count + 1, sizeof *why);
    effects_decide(lighting_plan_facts(plan, object), &plan->objects[object].facts, file);
    if (lighting_plan_reach(plan, object, why))
        explain_left_out(why, count, file);
    free(why);
}

bool lighting_plan_sources(const LightingPlan *plan, int object, bool full, ShaderSource sources[2],
                           Message *message)
{
    LightingKey key;
    make_key(plan, object, full, &key);
    return lighting_program_sources(&plan->lighting->programs.loader, &key, sources, message);
}

bool lighting_plan_sources_of(const LightingPlan *plan, int object, const Effects *effects,
                              ShaderSource sources[2], Message *message)
{
    LightingKey key;
    make_key(plan, object, false, &key);
    memcpy(&key.effects, effects, sizeof key.effects);
    return lighting_program_sources(&plan->lighting->programs.loader, &key, sources, message);
}

bool lighting_sources(Lighting *lighting, const Scene *scene, const Object *object, bool full,
                      ShaderSource sources[2], Message *message)
{
    const LightingFrame frame = {.scene = scene, .aspect = 1, .full = full};
    LightingPlan plan = {.lighting = NULL};
    sources[SHADER_VERTEX] = sources[SHADER_FRAGMENT] = (ShaderSource){0};
    const bool done =
        lighting_decide(&plan, lighting, &frame, message) &&
        lighting_plan_sources(&plan, (int)(object - scene->objects), full, sources, message);
    lighting_plan_close(&plan);
    return done;
}
