/*
 * A ray meets every object, solids in their own coordinates, triangles in the world's, and the
 * smallest parameter wins: it is the depth, since a ray's direction has depth 1. The eye is the
 * origin, and what is far from the world's origin loses no digits.
 *
 * Light that is computed at the corners of triangles is computed there once, when the trace is
 * opened. With shadows the lights that cast them are kept apart, in layers: at each point the
 * layers whose lights reach it are added and interpolated.
 */
#include "reference/reference_trace.h"

#include "reference/reference_shadow.h"
#include "reference/reference_solid.h"

#include <stdlib.h>

/* What TraceLayers point at. */
typedef struct Layers {
    Shading *layers;
    ShadeLight *shades;
    Light *lights;
    int *number; /* of the light of a layer but the first */
    int count;
} Layers;

struct Trace {
    const Scene *scene;
    bool at_corners; /* light is computed there */
    bool show_clipped;
    /* A ray's direction is corner + x across + y down, of depth 1: t is the depth. */
    Real3 corner, across, down;
    Shading shading;
    ShadeLight *lights;
    TraceObject *objects;
    bool casts; /* a light casts shadows */
    Shadows shadows;
    Layers layers;
};

/* From eye coordinates. */
static Real3 turn_to_world(Real3 v, Mat4 eye_from_world)
{
    const double *m = eye_from_world.m;
    const Real3 right = {m[0], m[4], m[8]}, up = {m[1], m[5], m[9]}, back = {m[2], m[6], m[10]};
    return real3_along(real3_along(real3_scale(right, v.x), v.y, up), v.z, back);
}

static ShadeLight prepare_light(const Light *light, Vec3 eye, Mat4 eye_from_world)
{
    ShadeLight ready = {.light = light};
    Vec3 direction;
    vec3_normalize(light->direction, &direction); /* whatever its size; then exactly unit */
    ready.position = real3(light->position);
    ready.direction = real3_unit(real3(direction));
    if (light->space == LIGHT_WORLD) {
        ready.position = real3_subtract(ready.position, real3(eye));
    } else {
        ready.position = turn_to_world(ready.position, eye_from_world);
        ready.direction = turn_to_world(ready.direction, eye_from_world);
    }
    ready.cosine_cutoff = real_cos(light->cutoff * (REAL_PI / 180));
    return ready;
}

static void layers_close(Layers *layers)
{
    free(layers->layers);
    free(layers->shades);
    free(layers->lights);
    free(layers->number);
    *layers = (Layers){.layers = NULL};
}

/* See TraceLayers. */
static bool layers_open(Layers *layers, const Shading *shading, bool apart)
{
    static const Vec3 black = {0, 0, 0};
    const size_t count = (size_t)shading->light_count;
    *layers = (Layers){.layers = malloc((count + 1) * sizeof *layers->layers),
                       .shades = malloc((2 * count + 1) * sizeof *layers->shades),
                       .lights = malloc((2 * count + 1) * sizeof *layers->lights),
                       .number = malloc((count + 1) * sizeof *layers->number),
                       .count = 1};
    if (!layers->layers || !layers->shades || !layers->lights || !layers->number)
        return false;
    layers->layers[0] = *shading;
    for (size_t i = 0; i < count && apart; i++) {
        ShadeLight *both[2] = {&layers->shades[i], &layers->shades[count + i]};
        for (size_t k = 0; k < 2; k++) {
            layers->lights[k * count + i] = *shading->lights[i].light;
            *both[k] = shading->lights[i];
            both[k]->light = &layers->lights[k * count + i];
        }
        if (!shading->lights[i].light->shadows)
            continue;
        layers->lights[i].diffuse = layers->lights[i].specular = black;
        layers->lights[count + i].ambient = black;
        layers->number[layers->count] = (int)i;
        layers->layers[layers->count] = *shading;
        layers->layers[layers->count].global_ambient = (Real3){0, 0, 0};
        layers->layers[layers->count].lights = both[1];
        layers->layers[layers->count++].light_count = 1;
    }
    if (apart)
        layers->layers[0].lights = layers->shades;
    return true;
}

static bool fill(Trace *trace, const Scene *scene, Mat4 eye_from_world,
                 const ReferenceOptions *options)
{
    trace->lights = calloc((size_t)scene->light_count + 1, sizeof *trace->lights);
    trace->objects = calloc((size_t)scene->object_count + 1, sizeof *trace->objects);
    if (!trace->lights || !trace->objects)
        return false;
    for (int i = 0; i < scene->light_count; i++)
        if (!scene->lights[i].off)
            trace->lights[trace->shading.light_count++] =
                prepare_light(&scene->lights[i], scene->camera.eye, eye_from_world);
    trace->shading.lights = trace->lights;
    for (int i = 0; i < trace->shading.light_count; i++)
        trace->casts |= trace->lights[i].light->shadows;
    if (!layers_open(&trace->layers, &trace->shading, trace->casts && trace->at_corners))
        return false;
    const TraceLayers layers = {trace->layers.layers, trace->layers.count};
    for (int i = 0; i < scene->object_count; i++)
        if (!trace_object_open(&trace->objects[i], &scene->objects[i], scene, &layers, options))
            return false;
    return shadows_open(&trace->shadows, trace->objects, scene->object_count, trace->lights,
                        trace->casts ? trace->shading.light_count : 0);
}

bool trace_open(Trace **opened, const Scene *scene, const ReferenceOptions *options,
                Message *message)
{
    const int width = options->width, height = options->height;
    Mat4 eye_from_world, clip_from_eye;
    *opened = NULL;
    if (!scene_camera(&scene->camera, (double)width / height, &eye_from_world, &clip_from_eye,
                      message))
        return false;
    Trace *trace = calloc(1, sizeof *trace);
    if (!trace)
        return message_set(message, "reference: not enough memory");
    trace->scene = scene;
    trace->at_corners = options->meshes && scene->interpolation != INTERPOLATION_PHONG;
    trace->show_clipped = scene->show_clipped && !(trace->at_corners && scene->clamp_vertex);
    trace->shading.global_ambient = real3(scene->global_ambient);
    trace->shading.reflection_phong = scene->reflection == REFLECTION_PHONG;
    trace->shading.distant_viewer = scene->distant_viewer;
    trace->shading.signed_dots = scene->signed_dots;
    const Real tangent =
        real_tan(scene_fovy(&scene->camera, (double)width / height) * (REAL_PI / 360));
    const Real aspect = (Real)width / height;
    trace->across = turn_to_world((Real3){2 * tangent * aspect / width, 0, 0}, eye_from_world);
    trace->down = turn_to_world((Real3){0, -2 * tangent / height, 0}, eye_from_world);
    trace->corner = turn_to_world((Real3){-tangent * aspect, tangent, -1}, eye_from_world);
    trace->shading.view = turn_to_world((Real3){0, 0, 1}, eye_from_world);
    if (!fill(trace, scene, eye_from_world, options)) {
        trace_close(trace);
        return message_set(message, "reference: %s",
                           stop_asked(options->stop) ? "stopped"
                                                     : "not enough memory for the scene");
    }
    *opened = trace;
    return true;
}

void trace_close(Trace *trace)
{
    if (!trace)
        return;
    for (int i = 0; trace->objects && i < trace->scene->object_count; i++)
        trace_object_close(&trace->objects[i]);
    shadows_close(&trace->shadows);
    layers_close(&trace->layers);
    free(trace->objects);
    free(trace->lights);
    free(trace);
}

/* The nearest point. */
typedef struct Nearest {
    int object; /* -1: none */
    Real t;
    SolidHit solid;
    TriangleHit triangle;
} Nearest;

static void meet_object(const Trace *trace, int number, Real3 direction, Nearest *nearest)
{
    const TraceObject *ready = &trace->objects[number];
    const Real near = trace->scene->camera.near, far = trace->scene->camera.far;
    if (ball_missed(&ready->ball, (Real3){0, 0, 0}, direction, true))
        return;
    if (!ready->exact) {
        TriangleHit hit = {.t = nearest->t};
        if (triangles_ray(&ready->triangles, direction, near, far, &hit))
            *nearest = (Nearest){.object = number, .t = hit.t, .triangle = hit};
        return;
    }
    SolidHit hits[SOLID_MAX_HITS];
    const Real3 d = {real3_dot(ready->inverse[0], direction),
                     real3_dot(ready->inverse[1], direction),
                     real3_dot(ready->inverse[2], direction)};
    const int count = ray_solid(&ready->object->solid, ready->eye, d, hits);
    for (int i = 0; i < count; i++) {
        if (hits[i].t >= near && hits[i].t <= far) {
            if (hits[i].t < nearest->t)
                *nearest = (Nearest){.object = number, .t = hits[i].t, .solid = hits[i]};
            return;
        }
    }
}

/* Their mean by the weights of the triangle's corners. */
static Real3 interpolate(Real3 a, Real3 b, Real3 c, const Real weights[3])
{
    return real3_along(real3_along(real3_scale(a, weights[0]), weights[1], b), weights[2], c);
}

/* What light needs of the point that was hit. */
typedef struct Surface {
    Real3 geometric;         /* the surface's own unit normal */
    Real3 normal;            /* that which light sees */
    Real3 position;          /* as seen from the eye */
    const uint32_t *indices; /* of the triangle's corners */
    Real3 local;             /* of a solid: the point in its coordinates */
} Surface;

static Surface solid_surface(const TraceObject *ready, const Nearest *nearest, Real3 direction,
                             Sample *sample)
{
    const Solid *solid = &ready->object->solid;
    const Real3 d = {real3_dot(ready->inverse[0], direction),
                     real3_dot(ready->inverse[1], direction),
                     real3_dot(ready->inverse[2], direction)};
    const Real3 local = real3_along(ready->eye, nearest->t, d);
    const Real3 normal = solid_normal(solid, nearest->solid.part, local);
    Surface surface = {.normal = trace_object_normal(ready, normal), .local = local};
    surface.geometric = surface.normal;
    if (ready->object->wrong_normals) {
        /* n . inverse: the columns of the inverse transpose. */
        surface.geometric =
            real3_unit(interpolate(ready->inverse[0], ready->inverse[1], ready->inverse[2],
                                   (const Real[3]){normal.x, normal.y, normal.z}));
    }
    sample->front = (real3_dot(normal, d) < 0) != ready->object->clockwise;
    sample->piece = (uint32_t)nearest->solid.part;
    return surface;
}

static Surface triangle_surface(const TraceObject *ready, const Nearest *nearest, Real3 direction,
                                Sample *sample)
{
    const Triangle *triangle = &ready->triangles.triangles[nearest->triangle.index];
    const uint32_t *indices = ready->mesh->indices + 3 * (size_t)triangle->number;
    const Real3 *n = ready->normals;
    const Real3 normal = triangle_normal(triangle);
    Surface surface = {.geometric = real3_unit(normal), .indices = indices};
    surface.normal = real3_unit(
        interpolate(n[indices[0]], n[indices[1]], n[indices[2]], nearest->triangle.weights));
    sample->front =
        (real3_dot(normal, direction) < 0) != (ready->mirrored != ready->object->clockwise);
    sample->piece = triangle->piece;
    sample->triangle = nearest->triangle.index;
    return surface;
}

/* Where a segment to a light begins. */
static ShadowPoint shadow_start(const Trace *trace, const Nearest *nearest, const Surface *surface,
                                Real3 normal)
{
    if (trace->objects[nearest->object].exact)
        return shadow_start_solid(&trace->shadows, nearest->object, nearest->solid.part,
                                  surface->local, surface->geometric, normal);
    return shadow_start_triangle(&trace->shadows, nearest->object, nearest->triangle.index,
                                 nearest->triangle.weights, surface->geometric, normal);
}

/* The color of a layer at the triangle's corner. */
static Real3 corner(const TraceObject *ready, const Nearest *nearest, const uint32_t *indices,
                    bool front, int layer, int k)
{
    const Real3 *colors = ready->colors[!front && ready->object->two_sided];
    const Triangle *triangle = &ready->triangles.triangles[nearest->triangle.index];
    return colors[(size_t)layer * ready->color_count +
                  (ready->own_corners ? 3 * (size_t)triangle->number + (size_t)k : indices[k])];
}

/* Interpolated: what is left of the light at the corners where some lights are in shadow. */
static Real3 corner_color(const Trace *trace, const Nearest *nearest, const Surface *surface,
                          Sample *sample)
{
    const TraceObject *ready = &trace->objects[nearest->object];
    const Real *weights = nearest->triangle.weights;
    const bool reversed = ready->object->two_sided && !sample->front;
    ShadowPoint point;
    ShadeSides sides = {.bits = 0};
    Real3 sum[3];
    for (int layer = 0; layer < trace->layers.count; layer++) {
        Real3 c[3];
        for (int k = 0; k < 3; k++)
            c[k] = corner(ready, nearest, surface->indices, sample->front, layer, k);
        if (layer == 0) {
            for (int k = 0; k < 3; k++)
                sum[k] = c[k];
            continue;
        }
        if (layer == 1)
            point = shadow_start(trace, nearest, surface,
                                 real3_scale(surface->normal, reversed ? -1 : 1));
        const Real arriving = real3_largest(interpolate(c[0], c[1], c[2], weights));
        const int number = trace->layers.number[layer];
        const bool hidden = arriving > 0 && shadow_falls(&point, number);
        shade_note_side(&sides, 2 * number + 1, arriving > 0 && !hidden, hidden ? arriving : 0);
        if (arriving > 0)
            shade_note_light(&sides, number, hidden);
        for (int k = 0; k < 3 && !hidden; k++)
            sum[k] = real3_add(sum[k], c[k]);
    }
    sample->sides = sides.bits;
    sample->sides_matter = sides.matters;
    sample->lights = sides.lights;
    for (int k = 0; k < 3 && trace->scene->clamp_vertex; k++)
        sum[k] = (Real3){real_max(real_min(sum[k].x, 1), 0), real_max(real_min(sum[k].y, 1), 0),
                         real_max(real_min(sum[k].z, 1), 0)};
    return interpolate(sum[0], sum[1], sum[2], weights);
}

/* The mean of a triangle's vertex colors. */
static Real3 vertex_color(const Mesh *mesh, const uint32_t *indices, const Real weights[3])
{
    Real3 c[3];
    for (int k = 0; k < 3; k++)
        c[k] = real3(vec3_from_float(mesh->colors[indices[k]]));
    return interpolate(c[0], c[1], c[2], weights);
}

/* IEC 61966-2-1. */
static Real encode(Real linear)
{
    return linear <= (Real)0.0031308 ? (Real)12.92 * linear
                                     : (Real)1.055 * real_pow(linear, 1 / (Real)2.4) - (Real)0.055;
}

static void put_out(const Trace *trace, Real3 color, Sample *sample)
{
    Real channels[3] = {color.x, color.y, color.z};
    sample->clipped = trace->show_clipped && real3_largest(color) > 1;
    for (int k = 0; k < 3; k++) {
        Real channel = real_max(real_min(channels[k], 1), 0);
        if (sample->clipped)
            channel = k == 1 ? 0 : 1;
        sample->linear[k] = (double)channel;
        sample->color[k] = (float)(trace->scene->linear ? encode(channel) : channel);
    }
}

/* Where the ray meets the scene; false: nowhere. The sample gets what is known without light. */
static bool meet(const Trace *trace, double x, double y, Nearest *nearest, Surface *surface,
                 Sample *sample)
{
    const Scene *scene = trace->scene;
    const Real3 direction =
        real3_along(real3_along(trace->corner, x, trace->across), y, trace->down);
    *nearest = (Nearest){.object = -1, .t = INFINITY};
    *sample = (Sample){.object = -1, .depth = INFINITY};
    for (int i = 0; i < scene->object_count; i++)
        meet_object(trace, i, direction, nearest);
    if (nearest->object < 0)
        return false;
    const TraceObject *ready = &trace->objects[nearest->object];
    *surface = ready->exact ? solid_surface(ready, nearest, direction, sample)
                            : triangle_surface(ready, nearest, direction, sample);
    surface->position = real3_scale(direction, nearest->t);
    sample->object = nearest->object;
    sample->depth = (double)nearest->t;
    sample->position = real3_round(surface->position);
    sample->normal = real3_round(surface->geometric);
    return true;
}

static ShadePoint lit_point(const Trace *trace, const Nearest *nearest, const Surface *surface,
                            bool front, Material *material)
{
    const TraceObject *ready = &trace->objects[nearest->object];
    const bool reversed = ready->object->two_sided && !front;
    *material = reversed ? ready->object->back : ready->object->front;
    if (!ready->exact && ready->mesh->colors)
        material->ambient = material->diffuse =
            real3_round(vertex_color(ready->mesh, surface->indices, nearest->triangle.weights));
    return (ShadePoint){material, surface->position,
                        real3_scale(surface->normal, reversed ? -1 : 1)};
}

void trace_sample(const Trace *trace, double x, double y, Sample *sample)
{
    const Vec3 background = trace->scene->background;
    Nearest nearest;
    Surface surface;
    if (!meet(trace, x, y, &nearest, &surface, sample)) {
        sample->color[0] = (float)background.x;
        sample->color[1] = (float)background.y;
        sample->color[2] = (float)background.z;
        return;
    }
    if (trace->at_corners) {
        put_out(trace, corner_color(trace, &nearest, &surface, sample), sample);
        return;
    }
    Material material;
    ShadeSides sides;
    const ShadePoint point = lit_point(trace, &nearest, &surface, sample->front, &material);
    Real3 color;
    if (trace->casts) {
        const ShadowPoint start = shadow_start(trace, &nearest, &surface, point.normal);
        color = shadow_shade(&trace->shading, &point, &start, &sides);
    } else {
        color = shade_point(&trace->shading, &point, &sides);
    }
    sample->sides = sides.bits;
    sample->sides_matter = sides.matters;
    sample->lights = sides.lights;
    put_out(trace, color, sample);
}

bool trace_point(const Trace *trace, double x, double y, TracePoint *point)
{
    Nearest nearest;
    Surface surface;
    Sample sample;
    *point = (TracePoint){.shading = &trace->shading};
    if (!meet(trace, x, y, &nearest, &surface, &sample) || trace->at_corners)
        return false;
    point->point = lit_point(trace, &nearest, &surface, sample.front, &point->material);
    return true;
}

void trace_place(const Trace *trace, Vec3 position, double at[2])
{
    /* position = t (corner + x across + y down), and these are perpendicular but for the corner. */
    const Real3 p = real3(position);
    const Real t = -real3_dot(p, trace->shading.view);
    const Real3 from = real3_subtract(real3_scale(p, 1 / t), trace->corner);
    at[0] = (double)(real3_dot(from, trace->across) / real3_dot(trace->across, trace->across));
    at[1] = (double)(real3_dot(from, trace->down) / real3_dot(trace->down, trace->down));
}

bool trace_casts(const Trace *trace)
{
    return trace->casts;
}

const TraceObject *trace_object(const Trace *trace, int number)
{
    return &trace->objects[number];
}
