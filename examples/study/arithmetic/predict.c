/*
 * How far a picture can be off because of the driver's arithmetic, without drawing it: the lighting
 * equation is computed twice at points of each triangle, in intervals that hold for the driver's
 * numbers and its interpolation (see interval.h), and exactly; what can lie between the two, after
 * clamping, is the bound in steps of 1/255. A pixel through which an edge of light runs, where N.L
 * or a cone's angle passes its limit, may be on either side, and is left out as the measured errors
 * leave it out. It is a bound at the points that are looked at, some thousands of an object, not
 * everywhere; tests compare it with pictures.
 */
#include "study/arithmetic/arithmetic.h"

#include "study/arithmetic/interval.h"

#include <math.h>

/* An edge of light, where N.L or the angle to a spot's axis passes a limit: it runs through a pixel
 * if the cosine is nearer to the limit than it changes over a pixel, and such a pixel is no inside
 * of an object. */
typedef struct LightEdges {
    double facing, cone; /* the change over a pixel */
} LightEdges;

/* A point of a surface, and whether an edge of light may run through its pixel. */
typedef struct Surface {
    Interval3 normal, position, viewer;
    Material material;
    bool colored;
    Vec3 color;              /* of the vertices */
    const LightEdges *edges; /* by light */
    bool on_edge;
} Surface;

static Vec3 product3(Vec3 a, Vec3 b)
{
    return (Vec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

static Interval3 colored(Machine m, const Surface *surface, Vec3 light, Vec3 material)
{
    if (!surface->colored)
        return interval_input3(m, product3(light, material));
    const Interval3 own = interval_input3(m, surface->color), from = interval_input3(m, light);
    return (Interval3){interval_multiply(m, own.x, from.x), interval_multiply(m, own.y, from.y),
                       interval_multiply(m, own.z, from.z)};
}

/* The share of a point light or spot that arrives. */
static Interval fading(Machine m, const Light *light, Interval square)
{
    if (!light_fades(light)) {
        const double constant = light->constant > 0 ? light->constant : 1;
        return interval_input(m, interval_just(1 / constant));
    }
    Interval root = {sqrt(square.low), sqrt(square.high)};
    root = interval_widened(m, root, m ? interval_units(m, FUNCTION_SQRT) : 0, 0);
    const Interval parts[] = {
        interval_input(m, interval_just(light->constant)),
        interval_exact_product(interval_input(m, interval_just(light->linear)), root),
        light->quadratic > 0
            ? interval_exact_product(interval_input(m, interval_just(light->quadratic)), square)
            : interval_just(0)};
    const Interval sum = interval_sum_of_three(m, parts[0], parts[1], parts[2]);
    const double least = interval_least(m);
    const Interval share = {1 / interval_larger(sum.high, least),
                            1 / interval_larger(sum.low, least)};
    return interval_widened(m, share, m ? interval_units(m, FUNCTION_DIVIDE) : 0, 0);
}

/* Whether an interval is on both sides of 0; where it is narrow, because of an edge. */
static bool undecided(Interval a, double change, Surface *surface)
{
    const bool both = a.low <= 0 && a.high >= 0;
    if (both && a.high - a.low < change)
        surface->on_edge = true;
    return both;
}

static Interval in_cone(Machine m, const Light *light, Vec3 axis, Interval3 to_light, double change,
                        Surface *surface)
{
    const Interval along = interval_dot(m, interval_negative3(to_light), interval_input3(m, axis));
    const Interval cutoff = interval_input(m, interval_just(cos(light->cutoff * acos(-1) / 180)));
    if (along.high < cutoff.low)
        return interval_just(0);
    const Interval share =
        light->exponent > 0 ? interval_power(m, along, light->exponent) : interval_just(1);
    const Interval beyond = {along.low - cutoff.high, along.high - cutoff.low};
    return (Interval){undecided(beyond, change, surface) ? 0 : share.low, share.high};
}

static Interval highlight(Machine m, const Scene *scene, Surface *surface, Interval3 to_light,
                          Interval n_dot_l, double change)
{
    Interval cosine;
    if (scene->reflection == REFLECTION_PHONG) {
        const Interval3 twice =
            interval_scaled(m, surface->normal, interval_multiply(m, interval_just(2), n_dot_l));
        cosine =
            interval_dot(m, interval_sum3(m, twice, interval_negative3(to_light)), surface->viewer);
    } else {
        cosine = interval_dot(m, surface->normal,
                              interval_unit(m, interval_sum3(m, to_light, surface->viewer)));
    }
    const Interval result = interval_power(m, cosine, surface->material.shininess);
    if (surface->material.shininess < 1) /* another edge: where the cosine is 0 */
        undecided(cosine, 2 * change, surface);
    return n_dot_l.high <= 0                     ? interval_just(0)
           : undecided(n_dot_l, change, surface) ? (Interval){0, result.high}
                                                 : result;
}

/* Of one light, added to a colour. `light` is in eye coordinates. */
static Interval3 lit_by(Machine m, const Scene *scene, const Light *light, const LightEdges *edges,
                        Surface *surface, Interval3 color)
{
    Interval share = interval_just(1);
    Interval3 to_light = interval_input3(m, vec3_unit(light->direction));
    if (light->kind != LIGHT_DIRECTIONAL) {
        const Interval3 way = interval_sum3(m, interval_input3(m, light->position),
                                            interval_negative3(surface->position));
        const Interval square = interval_square_length(m, way);
        to_light = interval_unit(m, way);
        share = fading(m, light, square);
    }
    if (light->kind == LIGHT_SPOT && light->cutoff < 180)
        share = interval_multiply(
            m, share,
            in_cone(m, light, vec3_unit(light->direction), to_light, edges->cone, surface));
    const Material *material = &surface->material;
    const Interval n_dot_l = interval_dot(m, surface->normal, to_light);
    const Interval cosine = {interval_larger(n_dot_l.low, 0), interval_larger(n_dot_l.high, 0)};
    Interval3 sum = colored(m, surface, light->ambient, material->ambient);
    if (!color_is_black(light->diffuse))
        sum = interval_sum3(
            m, sum,
            interval_scaled(m, colored(m, surface, light->diffuse, material->diffuse), cosine));
    const Vec3 specular = product3(light->specular, material->specular);
    if (!color_is_black(specular))
        sum = interval_sum3(
            m, sum,
            interval_scaled(m, interval_input3(m, specular),
                            highlight(m, scene, surface, to_light, n_dot_l, edges->facing)));
    return interval_sum3(m, color, interval_scaled(m, sum, share));
}

enum { MAX_LIGHTS = 64 };

/* A scene in eye coordinates. */
typedef struct Seen {
    const Scene *scene;
    Light lights[MAX_LIGHTS];
    int light_count;
} Seen;

static Interval3 lit(Machine m, const Seen *seen, Surface *surface)
{
    Interval3 color =
        interval_sum3(m, interval_input3(m, surface->material.emission),
                      colored(m, surface, seen->scene->global_ambient, surface->material.ambient));
    for (int i = 0; i < seen->light_count; i++)
        color = lit_by(m, seen->scene, &seen->lights[i], &surface->edges[i], surface, color);
    return color;
}

static double encoded(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

/* As the framebuffer gets it, clamped. */
static Interval shown(Machine m, const Scene *scene, Interval a)
{
    if (!(a.low <= a.high))
        return (Interval){0, 1};
    a = (Interval){fmin(interval_larger(a.low, 0), 1), fmin(interval_larger(a.high, 0), 1)};
    if (!scene->linear)
        return a;
    a = (Interval){encoded(a.low), encoded(a.high)};
    const double error = m ? 2 * interval_power_error(m, 0.5) + 8 * format_unit(&m->format) : 0;
    return (Interval){interval_larger(a.low - error, 0), fmin(a.high + error, 1)};
}

/* By how much what is shown can differ from the exact colour, in steps. */
static double difference(Machine m, const Scene *scene, Interval3 is, Interval3 exact)
{
    const Interval a[3] = {is.x, is.y, is.z}, b[3] = {exact.x, exact.y, exact.z};
    double most = 0;
    for (int c = 0; c < 3; c++) {
        const Interval drawn = shown(m, scene, a[c]), right = shown(NULL, scene, b[c]);
        most =
            interval_larger(most, interval_larger(drawn.high - right.low, right.high - drawn.low));
    }
    return 255 * most;
}

/* A corner of a triangle, in eye coordinates, in double precision. */
typedef struct Corner {
    Vec3 position, normal, color;
} Corner;

static double largest_of(Vec3 v)
{
    return interval_larger(fabs(v.x), interval_larger(fabs(v.y), fabs(v.z)));
}

/* What a varying may be: what the vertex shader computed, interpolated, and rounded again. */
static Interval varying(Machine vertex, Machine fragment, const Raster *raster, double exact,
                        double largest, double range)
{
    /* A row of the matrix times a vector: a dot product of four terms, and rounded coefficients. */
    const double transform = 2 * interval_units(vertex, FUNCTION_DOT) + 2;
    const double ulp = format_ulp(&vertex->format, interval_larger(largest, 1e-30));
    const double error = (transform + interval_larger(raster->flat, raster->perspective)) * ulp +
                         raster->small * format_unit(&vertex->format) * range;
    return interval_input(fragment, (Interval){exact - error, exact + error});
}

static Interval3 varying3(Machine vertex, Machine fragment, const Raster *raster, Vec3 exact,
                          double largest, double range)
{
    return (Interval3){varying(vertex, fragment, raster, exact.x, largest, range),
                       varying(vertex, fragment, raster, exact.y, largest, range),
                       varying(vertex, fragment, raster, exact.z, largest, range)};
}

/* The exact surface at weights of a triangle's corners. */
static Corner between(const Corner corners[3], const double weights[3])
{
    Corner at = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    for (int i = 0; i < 3; i++) {
        at.position = vec3_add(at.position, vec3_scale(corners[i].position, weights[i]));
        at.normal = vec3_add(at.normal, vec3_scale(corners[i].normal, weights[i]));
        at.color = vec3_add(at.color, vec3_scale(corners[i].color, weights[i]));
    }
    return at;
}

/* The extent of values over three corners. */
static double range_of(Vec3 a, Vec3 b, Vec3 c)
{
    return interval_larger(
        largest_of(vec3_subtract(a, b)),
        interval_larger(largest_of(vec3_subtract(b, c)), largest_of(vec3_subtract(a, c))));
}

typedef struct Prediction {
    const Seen *seen;
    double pixels;                /* of the picture's height, over tan(fovy / 2) */
    LightEdges edges[MAX_LIGHTS]; /* of the triangle */
    const Object *object;
    Machine vertex, fragment;
    const Raster *raster;
    double steps;
} Prediction;

static Surface surface_of(const Prediction *p, Machine m, Interval3 normal, Interval3 position,
                          Vec3 color, bool back)
{
    const Scene *scene = p->seen->scene;
    Surface surface = {.position = position,
                       .material = back ? p->object->back : p->object->front,
                       .colored = p->object->mesh->colors != NULL,
                       .color = color,
                       .edges = p->edges};
    surface.normal = scene->skip_renormalization ? normal : interval_unit(m, normal);
    if (back)
        surface.normal = interval_negative3(surface.normal);
    surface.viewer = scene->distant_viewer
                         ? (Interval3){interval_just(0), interval_just(0), interval_just(1)}
                         : interval_unit(m, interval_negative3(position));
    return surface;
}

static Interval3 exact3(Vec3 v)
{
    return (Interval3){interval_just(v.x), interval_just(v.y), interval_just(v.z)};
}

/* A point of a triangle, lit there. */
static void predict_point(Prediction *p, const Corner corners[3], const double weights[3],
                          bool back)
{
    const Corner at = between(corners, weights);
    const double reach = interval_larger(
        largest_of(corners[0].position),
        interval_larger(largest_of(corners[1].position), largest_of(corners[2].position)));
    const double range = range_of(corners[0].position, corners[1].position, corners[2].position);
    const double turn = range_of(corners[0].normal, corners[1].normal, corners[2].normal);
    const Interval3 position =
        varying3(p->vertex, p->fragment, p->raster, at.position, reach, range);
    const Interval3 normal = varying3(p->vertex, p->fragment, p->raster, at.normal, 1, turn);
    Surface is = surface_of(p, p->fragment, normal, position, at.color, back);
    Surface exact = surface_of(p, NULL, exact3(at.normal), exact3(at.position), at.color, back);
    const Interval3 color = lit(p->fragment, p->seen, &is), right = lit(NULL, p->seen, &exact);
    if (!is.on_edge)
        p->steps = interval_larger(p->steps, difference(p->fragment, p->seen->scene, color, right));
}

/* A corner, lit there; its colour is interpolated and rounded. */
static void predict_corner(Prediction *p, const Corner *corner, bool back)
{
    /* Nothing is interpolated before. */
    const Raster none = {.flat = 0};
    const Interval3 position =
        varying3(p->vertex, p->vertex, &none, corner->position, largest_of(corner->position), 0);
    const Interval3 normal = varying3(p->vertex, p->vertex, &none, corner->normal, 1, 0);
    Surface is = surface_of(p, p->vertex, normal, position, corner->color, back);
    Surface exact =
        surface_of(p, NULL, exact3(corner->normal), exact3(corner->position), corner->color, back);
    Interval3 color = lit(p->vertex, p->seen, &is);
    const Interval3 right = lit(NULL, p->seen, &exact);
    Interval *const parts[] = {&color.x, &color.y, &color.z};
    for (int c = 0; c < 3; c++) {
        const double most = fmin(interval_larger(interval_magnitude(*parts[c]), 1), 4);
        const double error =
            (interval_larger(p->raster->flat, p->raster->perspective) * 2 + p->raster->small) *
            format_unit(&p->vertex->format) * most;
        parts[c]->low -= error;
        parts[c]->high += error;
        *parts[c] = interval_input(p->fragment, *parts[c]);
    }
    p->steps = interval_larger(p->steps, difference(p->fragment, p->seen->scene, color, right));
}

static Corner corner_of(const Object *object, const Mesh *mesh, Mat4 eye_from_object, Mat4 normal,
                        uint32_t vertex)
{
    const MeshVertex *from = &mesh->vertices[vertex];
    Corner corner = {
        .position = mat4_transform_point(
            eye_from_object,
            vec3_from_float(mesh->lit_positions ? mesh->lit_positions[vertex] : from->position)),
        .normal = vec3_unit(mat4_transform_direction(
            object->wrong_normals ? eye_from_object : normal, vec3_from_float(from->normal)))};
    if (mesh->colors)
        corner.color = vec3_from_float(mesh->colors[vertex]);
    return corner;
}

/* Whether the eye sees the back of a triangle. */
static bool from_behind(const Corner corners[3])
{
    const Vec3 normal = vec3_cross(vec3_subtract(corners[1].position, corners[0].position),
                                   vec3_subtract(corners[2].position, corners[0].position));
    return vec3_dot(normal, corners[0].position) > 0;
}

/* The exact cosines of a light at a corner. */
static void cosines_at(const Light *light, const Corner *corner, double *facing, double *cone)
{
    const Vec3 to_light = vec3_unit(light->kind == LIGHT_DIRECTIONAL
                                        ? light->direction
                                        : vec3_subtract(light->position, corner->position));
    *facing = vec3_dot(vec3_unit(corner->normal), to_light);
    *cone = light->kind == LIGHT_SPOT ? -vec3_dot(to_light, vec3_unit(light->direction)) : 0;
}

/* How much the cosines of each light change over a pixel, from the corners. */
static void find_edges(Prediction *p, const Corner corners[3])
{
    double size = 0; /* of the longest side, in pixels */
    for (int k = 0; k < 3; k++) {
        const Vec3 a = corners[k].position, b = corners[(k + 1) % 3].position;
        const double depth = interval_larger(-interval_larger(a.z, b.z), 1e-6);
        const Vec3 side = vec3_subtract(a, b);
        size = interval_larger(size, sqrt(vec3_dot(side, side)) * p->pixels / depth);
    }
    for (int i = 0; i < p->seen->light_count; i++) {
        double facing[3], cone[3];
        for (int k = 0; k < 3; k++)
            cosines_at(&p->seen->lights[i], &corners[k], &facing[k], &cone[k]);
        const double turn = interval_larger(interval_larger(facing[0], facing[1]), facing[2]) -
                            fmin(fmin(facing[0], facing[1]), facing[2]);
        const double along = interval_larger(interval_larger(cone[0], cone[1]), cone[2]) -
                             fmin(fmin(cone[0], cone[1]), cone[2]);
        p->edges[i] =
            (LightEdges){turn / interval_larger(size, 1), along / interval_larger(size, 1)};
    }
}

static void predict_triangle(Prediction *p, const Corner corners[3], int parts)
{
    const Scene *scene = p->seen->scene;
    const bool behind = from_behind(corners) != p->object->clockwise;
    if (behind && p->object->closed)
        return;
    const bool back = behind && p->object->two_sided;
    find_edges(p, corners);
    if (scene->interpolation != INTERPOLATION_PHONG) {
        for (int i = 0; i < 3; i++)
            predict_corner(p, &corners[i], back);
        return;
    }
    for (int i = 0; i <= parts; i++)
        for (int k = 0; k <= parts - i; k++) {
            const double weights[3] = {(double)i / parts, (double)k / parts,
                                       (double)(parts - i - k) / parts};
            predict_point(p, corners, weights, back);
        }
}

static void predict_object(Prediction *p, Mat4 eye_from_object)
{
    enum { POINTS = 5000 };
    const Mesh *mesh = p->object->mesh;
    const Mat4 normal = mat4_normal(eye_from_object);
    const double triangles = interval_larger((double)mesh->index_count / 3, 1);
    int parts = (int)ceil(sqrt(2 * POINTS / triangles));
    parts = parts < 1 ? 1 : parts;
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        Corner corners[3];
        for (int k = 0; k < 3; k++)
            corners[k] =
                corner_of(p->object, mesh, eye_from_object, normal, mesh->indices[i + (size_t)k]);
        predict_triangle(p, corners, parts);
    }
}

double predict_scene(const Scene *scene, int height, const Arithmetic *vertex,
                     const Arithmetic *fragment, const Raster *raster)
{
    Mat4 eye_from_world, clip_from_eye;
    Seen seen = {.scene = scene};
    if (!scene_camera(&scene->camera, 1, &eye_from_world, &clip_from_eye, NULL))
        return 255;
    for (int i = 0; i < scene->light_count && seen.light_count < MAX_LIGHTS; i++) {
        Light light = scene_world_light(scene, i);
        if (light.off)
            continue;
        light.position = scene_eye_point(&scene->camera, eye_from_world, light.position);
        light.direction = mat4_transform_direction(eye_from_world, light.direction);
        seen.lights[seen.light_count++] = light;
    }
    Prediction prediction = {.seen = &seen,
                             .pixels = height / 2.0 / tan(scene->camera.fovy / 2 * acos(-1) / 180),
                             .vertex = vertex,
                             .fragment = fragment,
                             .raster = raster};
    for (int i = 0; i < scene->object_count; i++) {
        prediction.object = &scene->objects[i];
        predict_object(&prediction, scene_eye_from_object(&scene->camera, eye_from_world,
                                                          scene->objects[i].world_from_object));
    }
    return fmin(prediction.steps + raster->bytes, 255);
}

double predict_pow(const Arithmetic *fragment, double shininess)
{
    return 255 * interval_power_error(fragment, shininess);
}
