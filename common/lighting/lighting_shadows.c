/*
 * A light's shadows are drawn from a map (shadows/shadow_map.h) or as volumes
 * (shadows/shadow_cast.h). A map of one face is looked up by the programs that light the objects,
 * as far as they have room; else, and for volumes, what is in shadow is drawn into a mask first
 * (shadows/shadow_mask.h). Volumes end where lighting_shadow_ends.c says.
 */
#include "lighting/lighting_shadows.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The plan */

static bool lights_moved(LightingPlan *plan, const Scene *scene)
{
    bool moved = memcmp(&plan->eye, &scene->camera.eye, sizeof plan->eye) != 0;
    plan->eye = scene->camera.eye;
    for (int l = 0; l < plan->light_count; l++) {
        const Light placed = scene_world_light(scene, l);
        moved |= memcmp(&plan->lights[l].placed, &placed, sizeof placed) != 0;
        memcpy(&plan->lights[l].placed, &placed, sizeof placed);
    }
    return moved;
}

static int fit_maps(const LightingPlan *plan, int number, ShadowFrustum faces[SHADOW_FACES])
{
    static const double RADIANS = 0.017453292519943295;
    const Light *light = &plan->lights[number].placed;
    const bool spot = light->kind == LIGHT_SPOT;
    const ShadowFitting fitting = {.light = light_place(light),
                                   .axis = spot ? light->direction : (Vec3){0, 0, 0},
                                   .reach = spot ? tan(light->cutoff * RADIANS) : 0,
                                   .boxes = plan->pairs.placed,
                                   .throws = plan->pairs.throws,
                                   .receives = plan->pairs.receives,
                                   .count = plan->pairs.count,
                                   .number = number};
    return shadow_frusta(&fitting, plan->lighting->shadows.map_size, faces);
}

static ShadowLookup lookup_of(const Lighting *lighting)
{
    const ShadowSettings *settings = &lighting->shadows;
    return (ShadowLookup){settings->smooth != 0, settings->bias.x, settings->bias.y,
                          settings->bias.z};
}

/* The number of maps that a program has room for. It has two varyings for each; what is lit at the
 * vertices, two for each light with shadows; and six others. */
static int map_room(const LightingPlan *plan, const Scene *scene)
{
    GLint varyings = 0, units = 0;
    const int lights = __builtin_popcount(plan->pairs.all);
    glGetIntegerv(GL_MAX_VARYING_VECTORS, &varyings);
    glGetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &units);
    varyings -= 6 + (scene->interpolation == INTERPOLATION_PHONG ? 0 : 2 * lights);
    units -= (plan->light_count + SHADOW_CHANNELS - 1) / SHADOW_CHANNELS; /* masks */
    return varyings / 2 < units ? varyings / 2 : units;
}

/* How each light's shadows are drawn; of maps their frusta, if something has moved. Programs look
 * maps of one face up themselves, as far as there is room; full programs have masks of all lights.
 */
static void find_ways(LightingPlan *plan, const Scene *scene, bool moved)
{
    const bool maps = plan->lighting->shadows.way == SHADOWS_MAP;
    const ShadowLookup lookup = lookup_of(plan->lighting);
    int room = maps && plan->pairs.all ? map_room(plan, scene) : 0;
    plan->maps = 0;
    for (int l = 0; l < plan->light_count; l++) {
        PlannedLight *light = &plan->lights[l];
        const bool falls = plan->pairs.all >> l & 1;
        light->way = !falls ? SHADOWS_OFF : maps ? SHADOWS_MAP : SHADOWS_VOLUMES;
        light->in_program = false;
        if (light->way != SHADOWS_MAP)
            continue;
        if (moved)
            light->face_count = fit_maps(plan, l, light->faces);
        if (plan->full || light->face_count != 1 || room-- <= 0)
            continue;
        light->in_program = true;
        light->look = shadow_map_look(&plan->lighting->maps, &light->faces[0], &lookup);
        plan->maps |= (uint32_t)1 << l;
    }
}

bool plan_shadows(LightingPlan *plan, const LightingFrame *frame, bool moved, bool *anew,
                  Message *message)
{
    Lighting *lighting = plan->lighting;
    const uint32_t maps = plan->maps;
    int looks[EFFECTS_MAX_LIGHTS];
    plan->shadows = 0;
    for (int l = 0; l < plan->light_count; l++) {
        looks[l] = plan->lights[l].look;
        plan->shadows |= (uint32_t)frame->scene->lights[l].shadows << l;
    }
    moved |= lights_moved(plan, frame->scene);
    if (moved)
        shadow_pairs_find(&plan->pairs, frame->scene);
    if (plan->pairs.all && lighting->shadows.way == SHADOWS_MAP && !lighting->maps.framebuffer &&
        !shadow_maps_open(&lighting->maps, &lighting->programs.loader, message))
        return false;
    find_ways(plan, frame->scene, moved);
    /* The number of masks that the programs look up. */
    int count = 0;
    for (int l = 0; l < plan->light_count; l++)
        if (plan->full ? frame->scene->lights[l].shadows
                       : plan->lights[l].way != SHADOWS_OFF && !plan->lights[l].in_program)
            count = effects_channel(plan->shadows, l) / SHADOW_CHANNELS + 1;
    plan->masks = count;
    *anew = maps != plan->maps;
    for (int l = 0; l < plan->light_count; l++)
        *anew |= looks[l] != plan->lights[l].look;
    return true;
}

bool plan_casters(LightingPlan *plan, const Scene *scene, Message *message)
{
    LightingMeshes *meshes = &plan->lighting->meshes;
    const bool volumes = plan->lighting->shadows.way != SHADOWS_MAP;
    if (!plan->pairs.all && !plan->masks)
        return true;
    for (int i = 0; i < plan->object_count; i++) {
        PlannedObject *planned = &plan->objects[i];
        const Mesh *mesh = scene->objects[i].mesh;
        if (!planned->plain)
            planned->plain = lighting_mesh_buffer(meshes, mesh, INTERPOLATION_PHONG, message);
        if (!planned->caster && volumes && plan->pairs.throws[i])
            planned->caster = lighting_mesh_caster(meshes, mesh, message);
        if (!planned->plain || (!planned->caster && volumes && plan->pairs.throws[i]))
            return false;
    }
    return true;
}

/* Drawing volumes */

static void find_surfaces(const ShadowFrame *frame)
{
    LightingPlan *plan = frame->plan;
    const LightingTransforms *transforms = &plan->lighting->transforms;
    for (int i = 0; i < plan->object_count; i++) {
        const Object *object = &frame->scene->objects[i];
        const ObjectFacts *facts = &plan->objects[i].facts;
        const Mat4 eye_from_object = transforms->eye_from_object(
            &frame->scene->camera, frame->eye_from_world, object->world_from_object);
        plan->surfaces[i] =
            (ShadowSurface){.buffer = plan->objects[i].plain,
                            .clip_from_object = transforms->clip_from_object(
                                frame->clip_from_eye, frame->eye_from_world,
                                object->world_from_object, eye_from_object),
                            .mirrored = mat4_determinant(eye_from_object) < 0,
                            .clockwise = object->clockwise,
                            .cull = facts->closed && !facts->clockwise && facts->beyond,
                            .behind_lines = object->behind_lines};
    }
}

/* A closed mesh may leave out half of its triangles: see SilhouetteFacing. A light that touches the
 * mesh (silhouette.c) may be a rounding outside of its box, and is not outside of it. */
static SilhouetteFacing facing_of(const LightingPlan *plan, int number, bool closed, Vec4 light)
{
    const MeshBox *box = &plan->pairs.boxes[number];
    const double touching = ldexp(vec3_length(vec3_subtract(box->high, box->low)), -20);
    const bool outside = light.w == 0 || light.x < box->low.x - touching ||
                         light.x > box->high.x + touching || light.y < box->low.y - touching ||
                         light.y > box->high.y + touching || light.z < box->low.z - touching ||
                         light.z > box->high.z + touching;
    if (!closed)
        return SILHOUETTE_ALL;
    if (plan->objects[number].convex)
        return SILHOUETTE_UNLIT;
    return outside ? SILHOUETTE_LIT : SILHOUETTE_ALL;
}

/* From the eye to the near plane, as far as it is seen. */
static PlacedBox eye_box(const ShadowFrame *frame)
{
    const Camera *camera = &frame->scene->camera;
    /* Eye coordinates, of the rotation: its rows are the axes. */
    const double *m = frame->eye_from_world.m, *p = frame->clip_from_eye.m;
    const Vec3 right = {m[0], m[4], m[8]}, up = {m[1], m[5], m[9]}, back = {m[2], m[6], m[10]};
    return (PlacedBox){.center = vec3_add(camera->eye, vec3_scale(back, -0.5 * camera->near)),
                       .half = {vec3_scale(right, camera->near / p[0]),
                                vec3_scale(up, camera->near / p[5]),
                                vec3_scale(back, 0.5 * camera->near)}};
}

/* Whether light may fall where the mesh's normals say that none does: the object is drawn with
 * others, with a normal of the triangle, with another light, in 16 bits, or its back is where the
 * mesh has its front. */
static bool has_odd_normals(const ShadowFrame *frame, const Object *object)
{
    const Lighting *lighting = frame->plan->lighting;
    return object->wrong_normals || lighting->normal_matrix || frame->plan->in_parts ||
           frame->scene->interpolation == INTERPOLATION_FLAT ||
           lighting_is_mediump(&lighting->programs.loader) ||
           (object->two_sided && object->clockwise);
}

static bool cast_shadow(const ShadowFrame *frame, const ShadowEnds *ends, int light_number,
                        int number, Message *message)
{
    const LightingPlan *plan = frame->plan;
    Lighting *lighting = plan->lighting;
    const Object *object = &frame->scene->objects[number];
    const ShadowCaster *caster = plan->objects[number].caster;
    Light light = plan->lights[light_number].placed;
    Mat4 object_from_world;
    vec3_normalize(light.direction, &light.direction);
    if (!mat4_inverse(object->world_from_object, &object_from_world))
        return true; /* flattened: no volume lies behind it */
    const Vec4 end = shadow_ends_choose(ends, &plan->pairs.placed[number], &light);
    const Vec4 light_object = mat4_transform(object_from_world, light_place(&light));
    const PlacedBox seen = eye_box(frame);
    const ShadowThrow thrown = {
        .surface = plan->surfaces[number],
        .caster = caster,
        .light_object = light_object,
        .end = mat4_transform(mat4_transpose(object->world_from_object), end),
        .two_sided = object->two_sided,
        /* The near plane may lie in the shadow: then the eye may, too. */
        .behind = !lighting->depth_pass &&
                  may_come_between(&plan->pairs.placed[number], &seen, light_place(&light)),
        .own = plan->full || plan->pairs.receives[number] >> light_number & 1,
        .odd = has_odd_normals(frame, object),
        /* The near plane may lie beyond the end: then the eye sees into the volume there. */
        .beyond = shadow_end_before(&end, &seen),
        .facing = facing_of(plan, number, caster->silhouette.closed, light_object)};
    return shadow_cast(&lighting->volumes, &lighting->mask, &thrown, message);
}

/* Drawing maps */

static bool draw_map(const ShadowFrame *frame, int number, Message *message)
{
    LightingPlan *plan = frame->plan;
    const PlannedLight *light = &plan->lights[number];
    ShadowMapScene drawn = {.size = plan->lighting->shadows.map_size,
                            .face_count = light->face_count,
                            .frusta = light->faces,
                            .casters = plan->casters};
    for (int o = 0; o < plan->object_count; o++)
        if (plan->pairs.throws[o] >> number & 1)
            plan->casters[drawn.caster_count++] = (ShadowMapCaster){
                plan->objects[o].plain, frame->scene->objects[o].world_from_object};
    return shadow_map_draw(&plan->lighting->maps, number, &drawn, message);
}

static bool look_up_map(const ShadowFrame *frame, int number, int channel, Message *message)
{
    const LightingPlan *plan = frame->plan;
    Lighting *lighting = plan->lighting;
    bool done = true;
    for (int r = plan->object_count - 1; r >= 0 && done; r--) {
        if (!(plan->pairs.receives[r] >> number & 1))
            continue;
        const ShadowMark mark = {.light = number,
                                 .channel = channel,
                                 .surface = &plan->surfaces[r],
                                 .world_from_object = frame->scene->objects[r].world_from_object,
                                 .lookup = lookup_of(lighting)};
        done = shadow_map_mark(&lighting->maps, &lighting->mask, &mark, message);
    }
    return done;
}

/* Drawing masks */

static bool draw_light_mask(const ShadowFrame *frame, int number, Message *message)
{
    const LightingPlan *plan = frame->plan;
    const int channel = effects_channel(plan->shadows, number);
    ShadowEnds ends;
    if (plan->lights[number].way == SHADOWS_MAP)
        return look_up_map(frame, number, channel, message);
    shadow_ends_find(&ends, plan, number);
    for (int o = 0; o < plan->object_count; o++)
        if ((plan->pairs.throws[o] >> number & 1) && !cast_shadow(frame, &ends, number, o, message))
            return false;
    shadow_mask_light(&plan->lighting->mask, channel);
    return true;
}

static bool draw_masks(const ShadowFrame *frame, Message *message)
{
    LightingPlan *plan = frame->plan;
    Lighting *lighting = plan->lighting;
    ShadowMask *mask = &lighting->mask;
    if ((!mask->framebuffer && !shadow_mask_open(mask, &lighting->programs.loader, message)) ||
        !shadow_mask_begin(mask, plan->masks, frame->scene->camera.near, message))
        return false;
    find_surfaces(frame);
    for (int o = 0; o < plan->object_count; o++)
        shadow_mask_draw(mask, &plan->surfaces[o]);
    shadow_cast_begin(&lighting->volumes);
    bool done = true;
    for (int l = 0; l < plan->light_count && done; l++)
        if (plan->lights[l].way != SHADOWS_OFF && !plan->lights[l].in_program)
            done = draw_light_mask(frame, l, message);
    const bool ended = shadow_mask_end(mask, message);
    shadow_cast_end(&lighting->volumes, !ended);
    return ended && done;
}

bool draw_shadows(const ShadowFrame *frame, Message *message)
{
    for (int l = 0; l < frame->plan->light_count; l++)
        if (frame->plan->lights[l].way == SHADOWS_MAP && !draw_map(frame, l, message))
            return false;
    return frame->plan->masks == 0 || draw_masks(frame, message);
}

/* Looking them up */

void bind_shadows(const LightingPlan *plan, bool bind)
{
    const Lighting *lighting = plan->lighting;
    GLenum unit = GL_TEXTURE0 + (GLenum)plan->masks;
    if (!plan->masks && !plan->maps)
        return;
    shadow_mask_bind(bind ? &lighting->mask : NULL, plan->masks);
    for (uint32_t left = plan->maps; left; left &= left - 1) {
        glActiveTexture(unit++);
        glBindTexture(GL_TEXTURE_2D,
                      bind ? lighting->maps.lights[__builtin_ctz(left)].textures[0] : 0);
    }
    glActiveTexture(GL_TEXTURE0);
}

/* Where the masks are looked up: at places in the framebuffer, or in mediump in its viewport, from
 * -1 to 1. */
static void set_mask_place(const Lighting *lighting, GLint location)
{
    const ShadowMask *mask = &lighting->mask;
    const bool mediump = lighting_is_mediump(&lighting->programs.loader);
    const double size[2] = {mask->width, mask->height};
    float place[4] = {0};
    for (int i = 0; i < 2; i++) {
        const double half = mask->place[2 + i] / 2.0;
        place[i] = (float)((mediump ? half : 1) / size[i]);
        place[2 + i] = (float)((mediump ? mask->place[i] + half : 0) / size[i]);
    }
    glUniform4fv(location, 1, place);
}

void set_shadows(const LightingPlan *plan, const LightingProgram *program)
{
    const ShadowLookup lookup = lookup_of(plan->lighting);
    for (int i = 0; i < plan->masks; i++)
        glUniform1i(program->masks[i], i);
    if (program->mask_place >= 0)
        set_mask_place(plan->lighting, program->mask_place);
    for (int i = 0; i < program->map_count; i++) {
        const MapLocations *map = &program->maps[i];
        const uint32_t before = plan->maps & (((uint32_t)1 << map->light) - 1);
        glUniform1i(map->at.map, plan->masks + __builtin_popcount(before));
        shadow_map_set(&plan->lighting->maps.lights[map->light], 0, &lookup, &map->at);
    }
}

void place_shadows(const LightingPlan *plan, const LightingProgram *program, Mat4 world_from_object)
{
    for (int i = 0; i < program->map_count; i++)
        shadow_map_place(&plan->lighting->maps.lights[program->maps[i].light], 0, world_from_object,
                         &program->maps[i].at);
}

/* Explaining them */

static void explain_maps(const LightingPlan *plan, int number, FILE *file)
{
    const PlannedLight *light = &plan->lights[number];
    const int size = plan->lighting->shadows.map_size, bits = plan->lighting->maps.bits;
    for (int i = 0; i < light->face_count; i++) {
        const ShadowFrustum *face = &light->faces[i];
        const double near = face->near, far = face->far;
        fprintf(
            file,
            "light %d: map %d of %d, %dx%d: a texel is %.2g wide at the back; depths of %d bits%s"
            " from %.4g to %.4g, in steps of %.1g in front and %.1g at the back\n",
            number, i, light->face_count, size, size,
            face->width / size * (face->perspective ? far : 1), bits,
            plan->lighting->maps.packed ? " in colours" : "", near, far,
            shadow_depth_step(face, bits, near), shadow_depth_step(face, bits, far));
    }
}

/* The sides of the volumes of all objects, whether there is need of them or not. */
static size_t count_triangles(const LightingPlan *plan, const Scene *scene, const Light *light)
{
    ShadowVolume volume = {.capacity = 0};
    size_t indices = 0;
    for (int o = 0; o < plan->object_count; o++) {
        const Object *object = &scene->objects[o];
        Mat4 object_from_world;
        const ShadowCaster *caster =
            lighting_mesh_caster(&plan->lighting->meshes, object->mesh, NULL);
        if (object->lamp || !caster || !mat4_inverse(object->world_from_object, &object_from_world))
            continue;
        const Silhouette *silhouette = &caster->silhouette;
        const Vec4 light_object = mat4_transform(object_from_world, light_place(light));
        const ShadowVolumeKind kind = {light_object,
                                       facing_of(plan, o, silhouette->closed, light_object),
                                       SHADOW_END_OPEN, false};
        if (shadow_volume_make(&volume, silhouette, &kind, NULL))
            indices += volume.side_count;
    }
    shadow_volume_close(&volume);
    return indices / 3;
}

static void explain_none(const LightingPlan *plan, const Scene *scene, int number, FILE *file)
{
    const int size = plan->lighting->shadows.map_size;
    fprintf(file, "light %d: none, because nothing can come between; that saves ", number);
    if (plan->lighting->shadows.way == SHADOWS_MAP)
        fprintf(file, "a map of %dx%d", size, size);
    else
        fprintf(file, "volumes of %zu triangles, the depths of all surfaces once more,",
                count_triangles(plan, scene, &plan->lights[number].placed));
    fprintf(file, " and a look-up for each fragment\n");
}

void lighting_plan_explain_shadows(const LightingPlan *plan, const Scene *scene, FILE *file)
{
    if (!scene_has_shadows(scene))
        return;
    fprintf(file, "# shadows\n");
    if (scene->light_count > SCENE_MAX_CASTING)
        fprintf(file, "lights %d to %d: none, because of a scene's lights the first %d cast them\n",
                SCENE_MAX_CASTING, scene->light_count - 1, SCENE_MAX_CASTING);
    for (int l = 0; l < plan->light_count; l++) {
        if (!scene->lights[l].shadows || scene->lights[l].off)
            continue;
        if (plan->lights[l].way == SHADOWS_OFF)
            explain_none(plan, scene, l, file);
        else if (plan->lights[l].way == SHADOWS_MAP)
            explain_maps(plan, l, file);
        else
            fprintf(file, "light %d: volumes\n", l);
    }
}
