#include "study/arithmetic/predict.h"

#include <math.h>

/* All values between two. Where anything may be, also NaN, it is ANYTHING. */
typedef struct Interval {
    double low, high;
} Interval;

typedef struct Interval3 {
    Interval x, y, z;
} Interval3;

static const Interval ANYTHING = {-(double)INFINITY, (double)INFINITY};

static Interval just(double value)
{
    return (Interval){value, value};
}

/* What computes; NULL: exactly. */
typedef const Arithmetic *Machine;

/* fmax of numbers that are not NaN, without a call: this is computed often. */
static double larger(double a, double b)
{
    return a > b ? a : b;
}

/* The largest error of a function in units; where it can fail, any. */
static double units(Machine machine, Function function)
{
    const Accuracy *accuracy = &machine->accuracies[function];
    return accuracy->wrong ? (double)INFINITY : accuracy->largest;
}

/* With an error of so many units of the larger of the result and `magnitude`, the largest term. */
static Interval widened(Machine machine, Interval a, double ulps, double magnitude)
{
    if (!(a.low <= a.high))
        return ANYTHING;
    if (!machine)
        return a;
    const Format *format = &machine->format;
    const double largest = larger(larger(fabs(a.low), fabs(a.high)), magnitude);
    if (largest == 0)
        return a;
    const double most = format_max(format);
    double error = ulps * format_ulp(format, largest < most ? largest : most);
    if (!format->denormals)
        error = larger(error, power_of_two(format->min_exponent)); /* taken for 0 */
    if (a.low > -INFINITY)
        a.low -= error;
    if (a.high < INFINITY)
        a.high += error;
    a.high = a.high > most ? (double)INFINITY : a.high;
    a.low = a.low < -most ? -(double)INFINITY : a.low;
    /* What overflows may also stay at the largest number. */
    a.low = a.low > most ? most : a.low;
    a.high = a.high < -most ? -most : a.high;
    return a;
}

/* As a number of the machine: an input. */
static Interval input(Machine machine, Interval a)
{
    return widened(machine, a, 0.5, 0);
}

static double magnitude_of(Interval a)
{
    return larger(fabs(a.low), fabs(a.high));
}

static Interval add(Machine m, Interval a, Interval b)
{
    const Interval sum = {a.low + b.low, a.high + b.high};
    return widened(m, sum, m ? units(m, FUNCTION_ADD) : 0,
                   larger(magnitude_of(a), magnitude_of(b)));
}

static Interval exact_product(Interval a, Interval b)
{
    const double ends[4] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
    Interval product = just(ends[0]);
    for (int i = 0; i < 4; i++) {
        if (isnan(ends[i])) /* 0 times infinity */
            return ANYTHING;
        product.low = ends[i] < product.low ? ends[i] : product.low;
        product.high = larger(product.high, ends[i]);
    }
    return product;
}

static Interval multiply(Machine m, Interval a, Interval b)
{
    return widened(m, exact_product(a, b), m ? units(m, FUNCTION_MULTIPLY) : 0, 0);
}

static Interval negative(Interval a)
{
    return (Interval){-a.high, -a.low};
}

static Interval square_of(Interval a)
{
    const double low = a.low > 0 ? a.low : a.high < 0 ? -a.high : 0, high = magnitude_of(a);
    return (Interval){low * low, high * high};
}

static Interval sum_of_three(Machine m, Interval x, Interval y, Interval z)
{
    const Interval sum = {x.low + y.low + z.low, x.high + y.high + z.high};
    return widened(m, sum, m ? units(m, FUNCTION_DOT) : 0,
                   larger(magnitude_of(x), larger(magnitude_of(y), magnitude_of(z))));
}

static Interval dot(Machine m, Interval3 a, Interval3 b)
{
    return sum_of_three(m, exact_product(a.x, b.x), exact_product(a.y, b.y),
                        exact_product(a.z, b.z));
}

static Interval square_length(Machine m, Interval3 a)
{
    const Interval sum = sum_of_three(m, square_of(a.x), square_of(a.y), square_of(a.z));
    return (Interval){larger(sum.low, 0), sum.high};
}

static Interval3 scaled(Machine m, Interval3 a, Interval by)
{
    return (Interval3){multiply(m, a.x, by), multiply(m, a.y, by), multiply(m, a.z, by)};
}

static Interval3 sum3(Machine m, Interval3 a, Interval3 b)
{
    return (Interval3){add(m, a.x, b.x), add(m, a.y, b.y), add(m, a.z, b.z)};
}

static Interval3 negative3(Interval3 a)
{
    return (Interval3){negative(a.x), negative(a.y), negative(a.z)};
}

static Interval3 input3(Machine m, Vec3 v)
{
    return (Interval3){input(m, just(v.x)), input(m, just(v.y)), input(m, just(v.z))};
}

/* shaders/lighting/guards.glsl: LEAST and MOST of either kind of numbers. */
static double least_of(Machine m)
{
    return m && m->format.max_exponent < 100 ? 6.2e-5 : 1e-37;
}

static Interval inverse_root(Machine m, Interval square)
{
    const double least = least_of(m);
    const Interval root = {1 / sqrt(larger(square.high, least)),
                           1 / sqrt(larger(square.low, least))};
    return widened(m, root, m ? units(m, FUNCTION_INVERSESQRT) : 0, 0);
}

/* x / sqrt(x^2 + others), which grows with x. */
static double unit_end(double x, Interval others, bool lower)
{
    const double rest = (x > 0) == lower ? others.high : others.low;
    return x == 0 ? 0 : x / sqrt(x * x + rest);
}

static Interval unit_part(Interval x, Interval y, Interval z)
{
    const Interval a = square_of(y), b = square_of(z), others = {a.low + b.low, a.high + b.high};
    return (Interval){unit_end(x.low, others, true), unit_end(x.high, others, false)};
}

/* safe_normalize. Where no guard is in the way, it is bounded as a whole, as normalize was
 * measured: the parts of a vector do not vary apart from its length. */
static Interval3 unit(Machine m, Interval3 a)
{
    const Interval square = square_length(m, a);
    if (!(square.low >= least_of(m) && square.high < INFINITY))
        return scaled(m, a, inverse_root(m, square));
    const double error = m ? units(m, FUNCTION_NORMALIZE) : 0;
    return (Interval3){widened(m, unit_part(a.x, a.y, a.z), error, 0),
                       widened(m, unit_part(a.y, a.z, a.x), error, 0),
                       widened(m, unit_part(a.z, a.x, a.y), error, 0)};
}

/* The largest absolute error of pow for bases up to 1. */
static double power_error(Machine m, double exponent)
{
    enum { FIRST = -4, LAST = 11 };
    double error = 0;
    const int last = exponent > 0 ? ilogb(exponent) : FIRST;
    for (int i = FIRST; i <= LAST && i <= (last < FIRST ? FIRST : last); i++)
        error = larger(error, (double)m->accuracies[FUNCTION_POW].absolute[i - FIRST]);
    return error;
}

static Interval power(Machine m, Interval base, double exponent)
{
    if (base.high <= 0)
        return just(exponent == 0);
    /* Above 1 colours are clamped; the error grows with the result. */
    const double high = pow(base.high, exponent), low = base.low > 0    ? pow(base.low, exponent)
                                                        : exponent == 0 ? 1
                                                                        : 0;
    const double error = m ? power_error(m, exponent) : 0;
    return (Interval){larger(low - error, 0), high + error * larger(high * high, 1)};
}

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
        return input3(m, product3(light, material));
    const Interval3 own = input3(m, surface->color), from = input3(m, light);
    return (Interval3){multiply(m, own.x, from.x), multiply(m, own.y, from.y),
                       multiply(m, own.z, from.z)};
}

/* The share of a point light or spot that arrives. */
static Interval fading(Machine m, const Light *light, Interval square)
{
    if (!light_fades(light)) {
        const double constant = light->constant > 0 ? light->constant : 1;
        return input(m, just(1 / constant));
    }
    Interval root = {sqrt(square.low), sqrt(square.high)};
    root = widened(m, root, m ? units(m, FUNCTION_SQRT) : 0, 0);
    const Interval parts[] = {
        input(m, just(light->constant)), exact_product(input(m, just(light->linear)), root),
        light->quadratic > 0 ? exact_product(input(m, just(light->quadratic)), square) : just(0)};
    const Interval sum = sum_of_three(m, parts[0], parts[1], parts[2]);
    const double least = least_of(m);
    const Interval share = {1 / larger(sum.high, least), 1 / larger(sum.low, least)};
    return widened(m, share, m ? units(m, FUNCTION_DIVIDE) : 0, 0);
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
    const Interval along = dot(m, negative3(to_light), input3(m, axis));
    const Interval cutoff = input(m, just(cos(light->cutoff * acos(-1) / 180)));
    if (along.high < cutoff.low)
        return just(0);
    const Interval share = light->exponent > 0 ? power(m, along, light->exponent) : just(1);
    const Interval beyond = {along.low - cutoff.high, along.high - cutoff.low};
    return (Interval){undecided(beyond, change, surface) ? 0 : share.low, share.high};
}

static Interval highlight(Machine m, const Scene *scene, Surface *surface, Interval3 to_light,
                          Interval n_dot_l, double change)
{
    Interval cosine;
    if (scene->reflection == REFLECTION_PHONG) {
        const Interval3 twice = scaled(m, surface->normal, multiply(m, just(2), n_dot_l));
        cosine = dot(m, sum3(m, twice, negative3(to_light)), surface->viewer);
    } else {
        cosine = dot(m, surface->normal, unit(m, sum3(m, to_light, surface->viewer)));
    }
    const Interval result = power(m, cosine, surface->material.shininess);
    if (surface->material.shininess < 1) /* another edge: where the cosine is 0 */
        undecided(cosine, 2 * change, surface);
    return n_dot_l.high <= 0                     ? just(0)
           : undecided(n_dot_l, change, surface) ? (Interval){0, result.high}
                                                 : result;
}

/* Of one light, added to a colour. `light` is in eye coordinates. */
static Interval3 lit_by(Machine m, const Scene *scene, const Light *light, const LightEdges *edges,
                        Surface *surface, Interval3 color)
{
    Interval share = just(1);
    Interval3 to_light = input3(m, vec3_unit(light->direction));
    if (light->kind != LIGHT_DIRECTIONAL) {
        const Interval3 way = sum3(m, input3(m, light->position), negative3(surface->position));
        const Interval square = square_length(m, way);
        to_light = unit(m, way);
        share = fading(m, light, square);
    }
    if (light->kind == LIGHT_SPOT && light->cutoff < 180)
        share = multiply(
            m, share,
            in_cone(m, light, vec3_unit(light->direction), to_light, edges->cone, surface));
    const Material *material = &surface->material;
    const Interval n_dot_l = dot(m, surface->normal, to_light);
    const Interval cosine = {larger(n_dot_l.low, 0), larger(n_dot_l.high, 0)};
    Interval3 sum = colored(m, surface, light->ambient, material->ambient);
    if (!color_is_black(light->diffuse))
        sum =
            sum3(m, sum, scaled(m, colored(m, surface, light->diffuse, material->diffuse), cosine));
    const Vec3 specular = product3(light->specular, material->specular);
    if (!color_is_black(specular))
        sum = sum3(m, sum,
                   scaled(m, input3(m, specular),
                          highlight(m, scene, surface, to_light, n_dot_l, edges->facing)));
    return sum3(m, color, scaled(m, sum, share));
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
        sum3(m, input3(m, surface->material.emission),
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
    a = (Interval){fmin(larger(a.low, 0), 1), fmin(larger(a.high, 0), 1)};
    if (!scene->linear)
        return a;
    a = (Interval){encoded(a.low), encoded(a.high)};
    const double error = m ? 2 * power_error(m, 0.5) + 8 * format_unit(&m->format) : 0;
    return (Interval){larger(a.low - error, 0), fmin(a.high + error, 1)};
}

/* By how much what is shown can differ from the exact colour, in steps. */
static double difference(Machine m, const Scene *scene, Interval3 is, Interval3 exact)
{
    const Interval a[3] = {is.x, is.y, is.z}, b[3] = {exact.x, exact.y, exact.z};
    double most = 0;
    for (int c = 0; c < 3; c++) {
        const Interval drawn = shown(m, scene, a[c]), right = shown(NULL, scene, b[c]);
        most = larger(most, larger(drawn.high - right.low, right.high - drawn.low));
    }
    return 255 * most;
}

/* A corner of a triangle, in eye coordinates, in double precision. */
typedef struct Corner {
    Vec3 position, normal, color;
} Corner;

static double largest_of(Vec3 v)
{
    return larger(fabs(v.x), larger(fabs(v.y), fabs(v.z)));
}

/* What a varying may be: what the vertex shader computed, interpolated, and rounded again. */
static Interval varying(Machine vertex, Machine fragment, const Raster *raster, double exact,
                        double largest, double range)
{
    /* A row of the matrix times a vector: a dot product of four terms, and rounded coefficients. */
    const double transform = 2 * units(vertex, FUNCTION_DOT) + 2;
    const double ulp = format_ulp(&vertex->format, larger(largest, 1e-30));
    const double error = (transform + larger(raster->flat, raster->perspective)) * ulp +
                         raster->small * format_unit(&vertex->format) * range;
    return input(fragment, (Interval){exact - error, exact + error});
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
    return larger(largest_of(vec3_subtract(a, b)),
                  larger(largest_of(vec3_subtract(b, c)), largest_of(vec3_subtract(a, c))));
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
    surface.normal = scene->skip_renormalization ? normal : unit(m, normal);
    if (back)
        surface.normal = negative3(surface.normal);
    surface.viewer = scene->distant_viewer ? (Interval3){just(0), just(0), just(1)}
                                           : unit(m, negative3(position));
    return surface;
}

static Interval3 exact3(Vec3 v)
{
    return (Interval3){just(v.x), just(v.y), just(v.z)};
}

/* A point of a triangle, lit there. */
static void predict_point(Prediction *p, const Corner corners[3], const double weights[3],
                          bool back)
{
    const Corner at = between(corners, weights);
    const double reach =
        larger(largest_of(corners[0].position),
               larger(largest_of(corners[1].position), largest_of(corners[2].position)));
    const double range = range_of(corners[0].position, corners[1].position, corners[2].position);
    const double turn = range_of(corners[0].normal, corners[1].normal, corners[2].normal);
    const Interval3 position =
        varying3(p->vertex, p->fragment, p->raster, at.position, reach, range);
    const Interval3 normal = varying3(p->vertex, p->fragment, p->raster, at.normal, 1, turn);
    Surface is = surface_of(p, p->fragment, normal, position, at.color, back);
    Surface exact = surface_of(p, NULL, exact3(at.normal), exact3(at.position), at.color, back);
    const Interval3 color = lit(p->fragment, p->seen, &is), right = lit(NULL, p->seen, &exact);
    if (!is.on_edge)
        p->steps = larger(p->steps, difference(p->fragment, p->seen->scene, color, right));
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
        const double most = fmin(larger(magnitude_of(*parts[c]), 1), 4);
        const double error =
            (larger(p->raster->flat, p->raster->perspective) * 2 + p->raster->small) *
            format_unit(&p->vertex->format) * most;
        parts[c]->low -= error;
        parts[c]->high += error;
        *parts[c] = input(p->fragment, *parts[c]);
    }
    p->steps = larger(p->steps, difference(p->fragment, p->seen->scene, color, right));
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
        const double depth = larger(-larger(a.z, b.z), 1e-6);
        const Vec3 side = vec3_subtract(a, b);
        size = larger(size, sqrt(vec3_dot(side, side)) * p->pixels / depth);
    }
    for (int i = 0; i < p->seen->light_count; i++) {
        double facing[3], cone[3];
        for (int k = 0; k < 3; k++)
            cosines_at(&p->seen->lights[i], &corners[k], &facing[k], &cone[k]);
        const double turn = larger(larger(facing[0], facing[1]), facing[2]) -
                            fmin(fmin(facing[0], facing[1]), facing[2]);
        const double along =
            larger(larger(cone[0], cone[1]), cone[2]) - fmin(fmin(cone[0], cone[1]), cone[2]);
        p->edges[i] = (LightEdges){turn / larger(size, 1), along / larger(size, 1)};
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
    const double triangles = larger((double)mesh->index_count / 3, 1);
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
    return 255 * power_error(fragment, shininess);
}
