/* Which light's shadows may fall on what, maps and masks of them, and how programs look them up. */
#include "lighting/lighting_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* What throws a shadow. */
typedef struct Caster {
    const Mesh *mesh;
    ShadowCaster shadow;
    struct Caster *next;
} Caster;

void shadow_plan_close(ShadowPlan *plan)
{
    free(plan->receives);
    free(plan->throws);
    free(plan->boxes);
    free(plan->placed);
    *plan = (ShadowPlan){.count = 0};
}

static void plan_pair(ShadowPlan *plan, const Scene *scene, int occluder, int receiver)
{
    for (int l = 0; l < scene->light_count; l++) {
        if (!effects_may_shadow(scene, l, occluder, receiver, plan->boxes, plan->placed))
            continue;
        plan->receives[receiver] |= (uint32_t)1 << l;
        plan->throws[occluder] |= (uint32_t)1 << l;
        plan->all |= (uint32_t)1 << l;
    }
}

bool shadow_plan_open(ShadowPlan *plan, Lighting *lighting, const Scene *scene, Message *message)
{
    const size_t count = (size_t)scene->object_count;
    bool any = false, on = false;
    *plan = (ShadowPlan){.count = 0};
    for (int l = 0; l < scene->light_count; l++) {
        any |= scene->lights[l].shadows;
        on |= scene->lights[l].shadows && !scene->lights[l].off;
    }
    if (!any)
        return true; /* the full program has masks of lights that are off, too */
    if (on && scene->clamp_vertex && scene->interpolation != INTERPOLATION_PHONG)
        return message_set(message, "shadows are looked up at the fragments: light that is clamped "
                                    "at the vertices has none");
    *plan = (ShadowPlan){.count = scene->object_count,
                         .receives = calloc(count + 1, sizeof *plan->receives),
                         .throws = calloc(count + 1, sizeof *plan->throws),
                         .boxes = calloc(count + 1, sizeof *plan->boxes),
                         .placed = calloc(count + 1, sizeof *plan->placed)};
    if (!plan->receives || !plan->throws || !plan->boxes || !plan->placed) {
        shadow_plan_close(plan);
        return message_set(message, "shadows: not enough memory for %zu objects", count);
    }
    for (size_t i = 0; i < count; i++) {
        const Buffered *buffered =
            lighting_buffer(lighting, scene->objects[i].mesh, INTERPOLATION_PHONG, message);
        if (!buffered) {
            shadow_plan_close(plan);
            return false;
        }
        plan->boxes[i] = buffered->box;
        plan->placed[i] = placed_box(&buffered->box, scene->objects[i].world_from_object);
    }
    for (int o = 0; o < scene->object_count; o++)
        for (int r = 0; r < scene->object_count; r++)
            plan_pair(plan, scene, o, r);
    return true;
}

static const Caster *find_caster(Lighting *lighting, const Mesh *mesh, Message *message)
{
    for (const Caster *caster = lighting->casters; caster; caster = caster->next)
        if (caster->mesh == mesh)
            return caster;
    Caster *caster = calloc(1, sizeof *caster);
    if (!caster || !shadow_caster_open(&caster->shadow, mesh, message)) {
        message_set(message, "shadows: not enough memory");
        free(caster);
        return NULL;
    }
    caster->mesh = mesh;
    caster->next = lighting->casters;
    lighting->casters = caster;
    return caster;
}

void lighting_forget_shadows(Lighting *lighting, const Mesh *mesh)
{
    shadow_mask_forget(&lighting->mask);
    shadow_maps_forget(&lighting->maps);
    for (Caster **link = &lighting->casters; *link;) {
        Caster *caster = *link;
        if (mesh && caster->mesh != mesh) {
            link = &caster->next;
            continue;
        }
        *link = caster->next;
        shadow_caster_close(&caster->shadow);
        free(caster);
    }
}

static ShadowSurface surface_of(Lighting *lighting, const ShadowFrame *frame, int number)
{
    const LightingTransforms *transforms = &lighting->transforms;
    const Object *object = &frame->scene->objects[number];
    const Mat4 eye_from_object = transforms->eye_from_object(
        &frame->scene->camera, frame->eye_from_world, object->world_from_object);
    const Effects effects = effects_of_boxed(frame->scene, object, &frame->plan->boxes[number], 0);
    return (ShadowSurface){
        .buffer = &lighting_buffer(lighting, object->mesh, INTERPOLATION_PHONG, NULL)->buffer,
        .clip_from_object =
            transforms->clip_from_object(frame->clip_from_eye, frame->eye_from_world,
                                         object->world_from_object, eye_from_object),
        .mirrored = mat4_determinant(eye_from_object) < 0,
        .clockwise = object->clockwise,
        .cull = effects.cull,
        .behind_lines = object->behind_lines};
}

/* A closed mesh may leave out half of its triangles: see SilhouetteFacing. */
static SilhouetteFacing facing_of(const ShadowFrame *frame, int number, bool closed, Vec4 light)
{
    const Object *object = &frame->scene->objects[number];
    const MeshBox *box = &frame->plan->boxes[number];
    const bool outside = light.w == 0 || light.x < box->low.x || light.x > box->high.x ||
                         light.y < box->low.y || light.y > box->high.y || light.z < box->low.z ||
                         light.z > box->high.z;
    if (!closed)
        return SILHOUETTE_ALL;
    if (object_is_convex(object))
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

/* Whether the near plane may lie in the shadow: then the eye may, too. */
static bool eye_in_shadow(const ShadowFrame *frame, int number, const Light *light)
{
    const PlacedBox seen = eye_box(frame);
    return may_come_between(&frame->plan->placed[number], &seen, light_place(light));
}

/* Where a box begins along a direction, and where it ends. */
static double box_least(const PlacedBox *box, Vec3 way)
{
    return vec3_dot(box->center, way) - placed_reach(box, way);
}

static double box_most(const PlacedBox *box, Vec3 way)
{
    return vec3_dot(box->center, way) + placed_reach(box, way);
}

/* The least of what receives a light's shadows along a direction, less a little. */
static double receivers_least(const ShadowFrame *frame, int light, Vec3 way)
{
    double least = INFINITY, most = -INFINITY;
    for (int r = 0; r < frame->plan->count; r++) {
        if (!(frame->full || frame->plan->receives[r] >> light & 1))
            continue;
        least = fmin(least, box_least(&frame->plan->placed[r], way));
        most = fmax(most, box_most(&frame->plan->placed[r], way));
    }
    return least - 1e-3 * (most - least) - 1e-5 * fabs(least);
}

/* Looks for the plane before which all receivers lie that ends a caster's volume the soonest: of
 * those along the sides of the receivers' boxes. Infinity, if there is none. */
static Vec4 find_end(const ShadowFrame *frame, int number, int light_number, const Light *light)
{
    static const double FAR = 1e6; /* a light's distance that leaves no digits of a float */
    const Vec4 none = {0, 0, 0, 1};
    const PlacedBox *caster = &frame->plan->placed[number];
    const bool directional = light->kind == LIGHT_DIRECTIONAL;
    double soonest = INFINITY;
    Vec4 found = none;
    if (!directional && vec3_length(vec3_subtract(light->position, caster->center)) >
                            FAR * vec3_length(vec3_add(caster->half[0], caster->half[1])))
        return none;
    for (int k = 0; k < 6 * frame->plan->count; k++) {
        const Vec3 *half = frame->plan->placed[k / 6].half;
        Vec3 way;
        if (!vec3_normalize(vec3_cross(half[k / 2 % 3], half[(k / 2 + 1) % 3]), &way))
            continue;
        way = vec3_scale(way, k % 2 ? -1 : 1);
        /* The light is on the plane's other side, and the caster between them. */
        const double least = receivers_least(frame, light_number, way);
        const double most = box_most(caster, way);
        const double lights =
            directional ? vec3_dot(light->direction, way) : vec3_dot(light->position, way) - most;
        const double steps = (vec3_dot(caster->center, way) - least) / lights;
        if (lights > 0 && box_least(caster, way) > least && steps < soonest) {
            soonest = steps;
            found = (Vec4){way.x, way.y, way.z, -least};
        }
    }
    return found;
}

/* Whether the near plane may lie beyond the end of a volume: then the eye sees into it there. */
static bool eye_beyond(const ShadowFrame *frame, Vec4 end)
{
    const PlacedBox seen = eye_box(frame);
    return box_least(&seen, (Vec3){end.x, end.y, end.z}) + end.w < 0;
}

/* In object coordinates. */
static Vec4 plane_of_object(Vec4 plane, Mat4 world_from_object)
{
    return mat4_transform(mat4_transpose(world_from_object), plane);
}

/* What is the same for volumes and flattened shadows, which end at a plane. */
static bool make_throw(Lighting *lighting, const ShadowFrame *frame, const Light *light, int number,
                       Vec4 end, ShadowThrow *thrown, Message *message)
{
    const Object *object = &frame->scene->objects[number];
    Mat4 object_from_world;
    if (!mat4_inverse(object->world_from_object, &object_from_world))
        return message_set(message, "object %d is flattened, and throws no shadow by volumes",
                           number);
    const Caster *caster = find_caster(lighting, object->mesh, message);
    if (!caster)
        return false;
    *thrown = (ShadowThrow){.surface = surface_of(lighting, frame, number),
                            .caster = &caster->shadow,
                            .light_object = mat4_transform(object_from_world, light_place(light)),
                            .end = plane_of_object(end, object->world_from_object)};
    return true;
}

/* Whether light may fall where the mesh's normals say that none does: the object is drawn with
 * others, with a normal of the triangle, with another light, in 16 bits, or its back is where the
 * mesh has its front. */
static bool has_odd_normals(const Lighting *lighting, const ShadowFrame *frame,
                            const Object *object)
{
    return object->wrong_normals || lighting->normal_matrix || frame->in_parts ||
           frame->scene->interpolation == INTERPOLATION_FLAT || lighting_is_mediump(lighting) ||
           (object->two_sided && object->clockwise);
}

static bool cast_shadow(Lighting *lighting, const ShadowFrame *frame, const Light *light,
                        int light_number, int number, Message *message)
{
    const Vec4 end = find_end(frame, number, light_number, light);
    ShadowThrow thrown;
    if (!make_throw(lighting, frame, light, number, end, &thrown, message))
        return false;
    thrown.two_sided = frame->scene->objects[number].two_sided;
    thrown.behind = !lighting->depth_pass && eye_in_shadow(frame, number, light);
    thrown.own = frame->full || frame->plan->receives[number] >> light_number & 1;
    thrown.odd = has_odd_normals(lighting, frame, &frame->scene->objects[number]);
    thrown.beyond = eye_beyond(frame, end);
    thrown.facing = facing_of(frame, number, thrown.caster->silhouette.closed, thrown.light_object);
    return shadow_mask_cast(&lighting->mask, &thrown, message);
}

/* The plane of a flat object, with the light on its positive side; false: it is not flat. */
static bool flat_plane(const ShadowFrame *frame, int number, const Light *light, Vec4 *plane)
{
    const MeshBox *box = &frame->plan->boxes[number];
    const PlacedBox *placed = &frame->plan->placed[number];
    const double thick[3] = {box->high.x - box->low.x, box->high.y - box->low.y,
                             box->high.z - box->low.z};
    const Vec4 place = light_place(light);
    for (int k = 0; k < 3; k++) {
        Vec3 way;
        if (thick[k] != 0 ||
            !vec3_normalize(vec3_cross(placed->half[(k + 1) % 3], placed->half[(k + 2) % 3]), &way))
            continue;
        const double offset = vec3_dot(way, placed->center);
        const bool before = way.x * place.x + way.y * place.y + way.z * place.z > offset * place.w;
        way = vec3_scale(way, before ? 1 : -1);
        *plane = (Vec4){way.x, way.y, way.z, before ? -offset : offset};
        return true;
    }
    return false;
}

/* The first object that receives a light's shadows and is not flat, or is one too many; -1: none.
 */
static int not_flat(const ShadowFrame *frame, int number, const Light *light)
{
    int count = 0;
    Vec4 plane;
    for (int r = 0; r < frame->plan->count; r++) {
        if (!(frame->plan->receives[r] >> number & 1))
            continue;
        if (count++ >= SHADOW_FLATS || !flat_plane(frame, r, light, &plane))
            return r;
    }
    return -1;
}

static bool flatten_shadows(Lighting *lighting, const ShadowFrame *frame, const Light *light,
                            int number, Message *message)
{
    ShadowThrow thrown;
    Vec4 plane;
    for (int r = frame->plan->count - 1, flats = 0; r >= 0; r--) {
        if (!(frame->plan->receives[r] >> number & 1) || !flat_plane(frame, r, light, &plane))
            continue;
        const ShadowSurface surface = surface_of(lighting, frame, r);
        shadow_mask_flat(&lighting->mask, &surface, flats);
        for (int o = 0; o < frame->plan->count; o++)
            if (frame->plan->throws[o] >> number & 1 && o != r &&
                (!make_throw(lighting, frame, light, o, plane, &thrown, message) ||
                 !shadow_mask_flatten(&lighting->mask, &thrown, flats, message)))
                return false;
        flats++;
    }
    return true;
}

/* Maps. */

ShadowLookup lighting_lookup(const Lighting *lighting)
{
    const ShadowSettings *settings = &lighting->shadows;
    return (ShadowLookup){settings->smooth != 0, settings->bias.x, settings->bias.y,
                          settings->bias.z};
}

static int fit_maps(const Lighting *lighting, const ShadowFrame *frame, int number,
                    ShadowFrustum frusta[SHADOW_FACES])
{
    static const double RADIANS = 0.017453292519943295;
    const Light light = scene_world_light(frame->scene, number);
    const bool spot = light.kind == LIGHT_SPOT;
    const ShadowFitting fitting = {.light = light_place(&light),
                                   .axis = spot ? light.direction : (Vec3){0, 0, 0},
                                   .reach = spot ? tan(light.cutoff * RADIANS) : 0,
                                   .boxes = frame->plan->placed,
                                   .throws = frame->plan->throws,
                                   .receives = frame->plan->receives,
                                   .count = frame->plan->count,
                                   .number = number};
    return shadow_frusta(&fitting, lighting->shadows.map_size, frusta);
}

static bool draw_map(Lighting *lighting, const ShadowFrame *frame, int number, Message *message)
{
    ShadowFrustum frusta[SHADOW_FACES];
    const Scene *scene = frame->scene;
    ShadowMapCaster *casters = calloc((size_t)scene->object_count + 1, sizeof *casters);
    int count = 0;
    if (!casters)
        return message_set(message, "shadows: not enough memory");
    for (int o = 0; o < scene->object_count; o++)
        if (frame->plan->throws[o] >> number & 1)
            casters[count++] = (ShadowMapCaster){
                &lighting_buffer(lighting, scene->objects[o].mesh, INTERPOLATION_PHONG, NULL)
                     ->buffer,
                scene->objects[o].world_from_object};
    const int faces = fit_maps(lighting, frame, number, frusta);
    const bool done = shadow_map_draw(&lighting->maps, number, lighting->shadows.map_size, frusta,
                                      faces, casters, count, message);
    free(casters);
    return done;
}

static bool open_maps(Lighting *lighting, Message *message)
{
    return lighting->maps.framebuffer ||
           shadow_maps_open(&lighting->maps, &lighting->loader, message);
}

static bool draw_maps(Lighting *lighting, const ShadowFrame *frame, Message *message)
{
    if (!open_maps(lighting, message))
        return false;
    for (int l = 0; l < frame->scene->light_count; l++)
        if (frame->plan->all >> l & 1 && !draw_map(lighting, frame, l, message))
            return false;
    return true;
}

static bool look_up_map(Lighting *lighting, const ShadowFrame *frame, int number, Message *message)
{
    const ShadowLookup lookup = lighting_lookup(lighting);
    bool done = true;
    for (int r = frame->plan->count - 1; r >= 0 && done; r--) {
        if (!(frame->plan->receives[r] >> number & 1))
            continue;
        const ShadowSurface surface = surface_of(lighting, frame, r);
        done = shadow_map_mark(&lighting->maps, &lighting->mask, number,
                               effects_channel(frame->scene, number), &surface,
                               frame->scene->objects[r].world_from_object, &lookup, message);
    }
    return done;
}

/* The number of maps that a program has room for. It has two varyings for each; what is lit at the
 * vertices, two for each light with shadows; and six others. */
static int map_room(const ShadowFrame *frame)
{
    GLint varyings = 0, units = 0;
    int lights = 0;
    for (int l = 0; l < frame->scene->light_count; l++)
        lights += (int)(frame->plan->all >> l & 1);
    glGetIntegerv(GL_MAX_VARYING_VECTORS, &varyings);
    glGetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &units);
    varyings -= 6 + (frame->scene->interpolation == INTERPOLATION_PHONG ? 0 : 2 * lights);
    units -= (frame->scene->light_count + SHADOW_CHANNELS - 1) / SHADOW_CHANNELS; /* masks */
    return varyings / 2 < units ? varyings / 2 : units;
}

/* The lights whose maps programs look up themselves: those that have one, as far as there is room.
 * Full programs have masks of all lights, with or without a map. */
static void find_map_lights(Lighting *lighting, const ShadowFrame *frame)
{
    ShadowFrustum frusta[SHADOW_FACES];
    const ShadowLookup lookup = lighting_lookup(lighting);
    int room = map_room(frame);
    for (int l = 0; l < frame->scene->light_count && !frame->full; l++) {
        if (!(frame->plan->all >> l & 1) || fit_maps(lighting, frame, l, frusta) != 1 ||
            room-- <= 0)
            continue;
        lighting->map_lights |= (uint32_t)1 << l;
        lighting->looks[l] = shadow_map_look(&lighting->maps, &frusta[0], &lookup);
    }
}

bool lighting_find_maps(Lighting *lighting, const Scene *scene, bool full, Message *message)
{
    ShadowPlan plan;
    lighting->map_lights = 0;
    if (lighting->shadows.way != SHADOWS_MAP)
        return true;
    if (!open_maps(lighting, message) || !shadow_plan_open(&plan, lighting, scene, message))
        return false;
    find_map_lights(lighting, &(ShadowFrame){.scene = scene, .plan = &plan, .full = full});
    shadow_plan_close(&plan);
    return true;
}

static bool draw_light_mask(Lighting *lighting, const ShadowFrame *frame, int number,
                            Message *message)
{
    Light light = scene_world_light(frame->scene, number);
    vec3_normalize(light.direction, &light.direction);
    bool done = true;
    if (lighting->shadows.way == SHADOWS_MAP)
        return look_up_map(lighting, frame, number, message);
    if (lighting->shadows.way != SHADOWS_VOLUMES && not_flat(frame, number, &light) < 0)
        done = flatten_shadows(lighting, frame, &light, number, message);
    else
        for (int o = 0; o < frame->scene->object_count && done; o++)
            done = !(frame->plan->throws[o] >> number & 1) ||
                   cast_shadow(lighting, frame, &light, number, o, message);
    if (done)
        shadow_mask_light(&lighting->mask, effects_channel(frame->scene, number));
    return done;
}

/* The number of masks that the programs of this scene look up. */
static int mask_count(const Lighting *lighting, const ShadowFrame *frame)
{
    int count = 0;
    for (int l = 0; l < frame->scene->light_count; l++)
        if (frame->full ? frame->scene->lights[l].shadows
                        : frame->plan->all & ~lighting->map_lights & (uint32_t)1 << l)
            count = effects_channel(frame->scene, l) / SHADOW_CHANNELS + 1;
    return count;
}

static bool draw_masks(Lighting *lighting, const ShadowFrame *frame, int count, Message *message)
{
    ShadowMask *mask = &lighting->mask;
    if ((!mask->framebuffer && !shadow_mask_open(mask, &lighting->loader, message)) ||
        !shadow_mask_begin(mask, count, frame->scene->camera.near, message))
        return false;
    for (int o = 0; o < frame->scene->object_count; o++) {
        const ShadowSurface surface = surface_of(lighting, frame, o);
        shadow_mask_surface(mask, &surface);
    }
    bool done = true;
    for (int l = 0; l < frame->scene->light_count && done; l++)
        if ((frame->plan->all & ~lighting->map_lights) >> l & 1)
            done = draw_light_mask(lighting, frame, l, message);
    return shadow_mask_end(mask, message) && done;
}

bool lighting_draw_shadows(Lighting *lighting, const ShadowFrame *frame, int *masks,
                           Message *message)
{
    const bool maps = lighting->shadows.way == SHADOWS_MAP && frame->plan->all;
    lighting->map_lights = 0;
    if (maps && !draw_maps(lighting, frame, message))
        return false;
    if (maps)
        find_map_lights(lighting, frame);
    *masks = mask_count(lighting, frame);
    return *masks == 0 || draw_masks(lighting, frame, *masks, message);
}

/* To units from `first` on, of the lights in their order; `bind` false: no longer. */
static void bind_maps(const Lighting *lighting, int first, bool bind)
{
    GLenum unit = GL_TEXTURE0 + (GLenum)first;
    for (int l = 0; l < SHADOW_MAPS; l++) {
        if (!(lighting->map_lights >> l & 1))
            continue;
        glActiveTexture(unit++);
        glBindTexture(GL_TEXTURE_2D, bind ? lighting->maps.lights[l].textures[0] : 0);
    }
    glActiveTexture(GL_TEXTURE0);
}

/* `first` as bind_maps was given it. */
static void set_maps(GLuint program, const Lighting *lighting, int first, const Object *object)
{
    const ShadowLookup lookup = lighting_lookup(lighting);
    char name[32], suffix[8];
    for (int l = 0, unit = first; l < SHADOW_MAPS; l++) {
        if (!(lighting->map_lights >> l & 1))
            continue;
        snprintf(suffix, sizeof suffix, "%d", l);
        snprintf(name, sizeof name, "u_Map%s", suffix);
        const GLint map = glGetUniformLocation(program, name);
        glUniform1i(map, unit++);
        if (map >= 0)
            shadow_map_uniforms(&lighting->maps, l, 0, &lookup, object->world_from_object, program,
                                suffix);
    }
}

/* Where the masks are looked up: at places in the framebuffer, or in mediump in its viewport, from
 * -1 to 1. */
static void set_masks(GLuint program, const ShadowMask *mask, bool mediump, int count)
{
    const double size[2] = {mask->width, mask->height};
    float place[4] = {0};
    char name[32];
    for (int i = 0; i < 2; i++) {
        const double half = mask->place[2 + i] / 2.0;
        place[i] = (float)((mediump ? half : 1) / size[i]);
        place[2 + i] = (float)((mediump ? mask->place[i] + half : 0) / size[i]);
    }
    for (int i = 0; i < count; i++) {
        snprintf(name, sizeof name, "u_Mask%d", i);
        glUniform1i(glGetUniformLocation(program, name), i);
    }
    if (count)
        glUniform4fv(glGetUniformLocation(program, "u_MaskPlace"), 1, place);
}

void lighting_bind_shadows(const Lighting *lighting, int masks, bool bind)
{
    shadow_mask_bind(bind ? &lighting->mask : NULL, masks);
    bind_maps(lighting, masks, bind);
}

void lighting_set_shadows(GLuint program, const Lighting *lighting, int masks, const Object *object)
{
    set_masks(program, &lighting->mask, lighting_is_mediump(lighting), masks);
    set_maps(program, lighting, masks, object);
}

static void explain_maps(const Lighting *lighting, const ShadowFrame *frame, int number, FILE *file)
{
    ShadowFrustum frusta[SHADOW_FACES];
    const int count = fit_maps(lighting, frame, number, frusta);
    const int size = lighting->shadows.map_size, bits = lighting->maps.bits;
    for (int i = 0; i < count; i++) {
        const double near = frusta[i].near, far = frusta[i].far;
        fprintf(
            file,
            "light %d: map %d of %d, %dx%d: a texel is %.2g wide at the back; depths of %d bits%s"
            " from %.4g to %.4g, in steps of %.1g in front and %.1g at the back\n",
            number, i, count, size, size,
            frusta[i].width / size * (frusta[i].perspective ? far : 1), bits,
            lighting->maps.packed ? " in colours" : "", near, far,
            shadow_depth_step(&frusta[i], bits, near), shadow_depth_step(&frusta[i], bits, far));
    }
}

/* The sides of the volumes of all objects, whether there is need of them or not. */
static size_t count_triangles(Lighting *lighting, const ShadowFrame *frame, const Light *light)
{
    ShadowVolume volume = {.capacity = 0};
    ShadowThrow thrown;
    size_t indices = 0;
    for (int o = 0; o < frame->plan->count; o++) {
        if (frame->scene->objects[o].lamp ||
            !make_throw(lighting, frame, light, o, (Vec4){0, 0, 0, 1}, &thrown, NULL))
            continue;
        const Silhouette *silhouette = &thrown.caster->silhouette;
        const SilhouetteFacing facing =
            facing_of(frame, o, silhouette->closed, thrown.light_object);
        if (shadow_volume_make(&volume, silhouette, thrown.light_object, facing, SHADOW_END_OPEN,
                               false, NULL))
            indices += volume.side_count;
    }
    shadow_volume_close(&volume);
    return indices / 3;
}

static void explain_none(Lighting *lighting, const ShadowFrame *frame, int number, FILE *file)
{
    const Light light = scene_world_light(frame->scene, number);
    const int size = lighting->shadows.map_size;
    fprintf(file, "light %d: none, because nothing can come between; that saves ", number);
    if (lighting->shadows.way == SHADOWS_MAP)
        fprintf(file, "a map of %dx%d", size, size);
    else
        fprintf(file, "volumes of %zu triangles, the depths of all surfaces once more,",
                count_triangles(lighting, frame, &light));
    fprintf(file, " and a look-up for each fragment\n");
}

static void explain_light(Lighting *lighting, const ShadowFrame *frame, int number, FILE *file)
{
    Light light = scene_world_light(frame->scene, number);
    const int curved = not_flat(frame, number, &light);
    if (!(frame->plan->all >> number & 1))
        explain_none(lighting, frame, number, file);
    else if (lighting->shadows.way == SHADOWS_MAP)
        explain_maps(lighting, frame, number, file);
    else if (lighting->shadows.way == SHADOWS_VOLUMES)
        fprintf(file, "light %d: volumes\n", number);
    else if (curved < 0)
        fprintf(file, "light %d: planar, because all that they may fall on is flat\n", number);
    else
        fprintf(file, "light %d: volumes, because object %d, on which they may fall, is not flat\n",
                number, curved);
}

bool lighting_explain_shadows(Lighting *lighting, const Scene *scene, FILE *file, Message *message)
{
    ShadowPlan plan;
    bool any = false;
    for (int l = 0; l < scene->light_count; l++)
        any |= scene->lights[l].shadows && !scene->lights[l].off;
    if (!any)
        return true;
    if ((lighting->shadows.way == SHADOWS_MAP && !open_maps(lighting, message)) ||
        !shadow_plan_open(&plan, lighting, scene, message))
        return false;
    const ShadowFrame frame = {.scene = scene, .plan = &plan};
    fprintf(file, "# shadows\n");
    for (int l = 0; l < scene->light_count; l++)
        if (scene->lights[l].shadows && !scene->lights[l].off)
            explain_light(lighting, &frame, l, file);
    shadow_plan_close(&plan);
    return true;
}
