/*
 * A ray is taken into an object's coordinates, where a solid is a quadratic equation in its
 * parameter; only the torus is searched, in steps shorter than its tube. Its parameter there is
 * that of the world, so that the smallest of all objects is the nearest. Of meshes every triangle
 * is asked (Moller and Trumbore, Fast, Minimum Storage Ray-Triangle Intersection, 1997).
 *
 * The bounds for mediump are of the kind of Higham, Accuracy and Stability of Numerical Algorithms,
 * sections 2.2 and 3.1: rounding to 11 bits errs by a factor within 1 +- u, and a driver may
 * shorten any operation, in any order. The length of an error vector is at most u times the
 * vector's, for each of its components is.
 */
#include "support/oracle.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* Rays. */

typedef struct Ray {
    Vec3 from, along;
    double near, far; /* of the parameter */
} Ray;

typedef struct Hit {
    double t;
    Vec3 normal; /* towards the outside or the triangle's front; of a mesh in world coordinates */
    Vec3 face;   /* the same of the surface itself, in object coordinates */
} Hit;

static void meet(Hit *nearest, const Ray *ray, double t, Vec3 normal, Vec3 face)
{
    if (t >= ray->near && t <= ray->far && t < nearest->t)
        *nearest = (Hit){t, normal, face};
}

static Vec3 at(const Ray *ray, double t)
{
    return vec3_add(ray->from, vec3_scale(ray->along, t));
}

/* a t^2 + 2 b t + c = 0. */
static int roots(double a, double b, double c, double t[2])
{
    const double d = b * b - a * c;
    if (a == 0 || d < 0)
        return 0;
    t[0] = (-b - sqrt(d)) / a;
    t[1] = (-b + sqrt(d)) / a;
    return 2;
}

static void meet_sphere(Hit *hit, const Ray *ray, double r)
{
    double t[2];
    for (int i = roots(vec3_dot(ray->along, ray->along), vec3_dot(ray->along, ray->from),
                       vec3_dot(ray->from, ray->from) - r * r, t);
         i-- > 0;) {
        const Vec3 n = vec3_scale(at(ray, t[i]), 1 / r);
        meet(hit, ray, t[i], n, n);
    }
}

static void meet_disc(Hit *hit, const Ray *ray, double z, double radius, double up)
{
    const double t = (z - ray->from.z) / ray->along.z;
    const Vec3 p = at(ray, t), n = {0, 0, up};
    if (ray->along.z != 0 && hypot(p.x, p.y) <= radius)
        meet(hit, ray, t, n, n);
}

/* x^2 + y^2 = (r - k z)^2, from z = 0 to `height`: of a cylinder k is 0, of a cone r / height. */
static void meet_side(Hit *hit, const Ray *ray, double r, double k, double height)
{
    const Vec3 o = ray->from, d = ray->along;
    const double inside = r - k * o.z;
    double t[2];
    for (int i = roots(d.x * d.x + d.y * d.y - k * k * d.z * d.z,
                       d.x * o.x + d.y * o.y + k * inside * d.z,
                       o.x * o.x + o.y * o.y - inside * inside, t);
         i-- > 0;) {
        const Vec3 p = at(ray, t[i]);
        const Vec3 n = vec3_unit((Vec3){p.x, p.y, k * hypot(p.x, p.y)});
        if (p.z >= 0 && p.z <= height)
            meet(hit, ray, t[i], n, n);
    }
}

double oracle_outside(const Solid *solid, Vec3 p)
{
    const double r = solid->radius, h = solid->height, across = hypot(p.x, p.y);
    switch (solid->kind) {
    case SOLID_BOX:
        return fmax(fabs(p.x), fmax(fabs(p.y), fabs(p.z))) - r;
    case SOLID_CYLINDER:
        return fmax(across - r, fmax(-p.z, p.z - h));
    case SOLID_CONE:
        return fmax(-p.z, (across * h - r * (h - p.z)) / hypot(r, h));
    case SOLID_TORUS:
        return hypot(across - r, p.z) - solid->tube;
    default:
        return vec3_length(p) - r;
    }
}

static void meet_torus(Hit *hit, const Ray *ray, const Solid *solid)
{
    enum { STEPS = 2000 };
    double t[2];
    const double bound = solid->radius + solid->tube;
    if (!roots(vec3_dot(ray->along, ray->along), vec3_dot(ray->along, ray->from),
               vec3_dot(ray->from, ray->from) - bound * bound, t))
        return;
    const double step = (t[1] - t[0]) / STEPS;
    double before = oracle_outside(solid, at(ray, t[0]));
    for (int i = 1; i <= STEPS; i++) {
        double low = t[0] + (i - 1) * step, high = low + step;
        const double after = oracle_outside(solid, at(ray, high));
        if ((before < 0) != (after < 0)) {
            for (int k = 0; k < 50; k++) {
                const double middle = (low + high) / 2;
                if ((oracle_outside(solid, at(ray, middle)) < 0) == (before < 0))
                    low = middle;
                else
                    high = middle;
            }
            const Vec3 p = at(ray, low);
            const double r = hypot(p.x, p.y), share = (r - solid->radius) / r;
            const Vec3 n = vec3_unit((Vec3){p.x * share, p.y * share, p.z});
            meet(hit, ray, low, n, n);
        }
        before = after;
    }
}

/* Normals are of unit length at the vertices, where the transform has put them. */
static void meet_mesh(Hit *hit, const Ray *ray, const Mesh *mesh, Mat4 world_normals)
{
    for (size_t i = 0; i < mesh->index_count; i += 3) {
        const MeshVertex *corner[3];
        Vec3 v[3], normal = {0, 0, 0};
        for (size_t k = 0; k < 3; k++) {
            corner[k] = &mesh->vertices[mesh->indices[i + k]];
            v[k] = vec3_from_float(corner[k]->position);
        }
        const Vec3 a = vec3_subtract(v[1], v[0]), b = vec3_subtract(v[2], v[0]);
        const Vec3 face = vec3_cross(a, b), s = vec3_subtract(ray->from, v[0]);
        const double determinant = -vec3_dot(ray->along, face);
        if (determinant == 0)
            continue;
        const Vec3 m = vec3_cross(s, ray->along);
        const double first = vec3_dot(b, m) / determinant, second = -vec3_dot(a, m) / determinant;
        if (first < 0 || second < 0 || first + second > 1)
            continue;
        const double parts[3] = {1 - first - second, first, second};
        for (size_t k = 0; k < 3; k++) {
            const Vec3 n = vec3_from_float(corner[k]->normal);
            normal =
                vec3_add(normal, vec3_scale(vec3_unit(mat4_transform_direction(world_normals, n)),
                                            parts[k]));
        }
        meet(hit, ray, vec3_dot(s, face) / determinant, normal, face);
    }
}

/* Boxes and squares are the mesh as given. */
static bool is_mesh(const Object *object)
{
    const SolidKind kind = object->solid.kind;
    return kind == SOLID_NONE || kind == SOLID_BOX || kind == SOLID_QUAD;
}

static void meet_object(Hit *hit, const Ray *ray, const Object *object, Mat4 world_normals)
{
    const Solid *solid = &object->solid;
    const double r = solid->radius, h = solid->height;
    if (is_mesh(object)) {
        meet_mesh(hit, ray, object->mesh, world_normals);
    } else if (solid->kind == SOLID_SPHERE) {
        meet_sphere(hit, ray, r);
    } else if (solid->kind == SOLID_TORUS) {
        meet_torus(hit, ray, solid);
    } else if (solid->kind == SOLID_DISC) {
        meet_disc(hit, ray, 0, r, 1);
    } else if (solid->kind == SOLID_CONE) {
        meet_side(hit, ray, r, r / h, h);
        meet_disc(hit, ray, 0, r, -1);
    } else {
        meet_side(hit, ray, r, 0, h);
        if (solid->caps & MESH_CAP_BOTTOM)
            meet_disc(hit, ray, 0, r, -1);
        if (solid->caps & MESH_CAP_TOP)
            meet_disc(hit, ray, h, r, 1);
    }
}

static bool has_formula(const Scene *scene)
{
    for (int i = 0; i < scene->light_count; i++)
        if (scene->lights[i].shadows)
            return false;
    for (int i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        if (object->solid.kind == SOLID_TEAPOT || object->mesh->colors ||
            object->mesh->lit_positions)
            return false;
    }
    return true;
}

/* The viewer's axes: right, up, back. */
static void viewer_axes(const Camera *camera, Vec3 axes[3])
{
    axes[2] = vec3_unit(vec3_subtract(camera->eye, camera->center));
    axes[0] = vec3_unit(vec3_cross(camera->up, axes[2]));
    axes[1] = vec3_cross(axes[2], axes[0]);
}

static Vec3 of_axes(const Vec3 axes[3], Vec3 v)
{
    return vec3_add(vec3_scale(axes[0], v.x),
                    vec3_add(vec3_scale(axes[1], v.y), vec3_scale(axes[2], v.z)));
}

/* What the ray through a pixel's centre meets first. */
static bool trace(const Scene *scene, int width, int height, int x, int y, OraclePoint *hit)
{
    const Camera *camera = &scene->camera;
    /* What is seen of the width stays in narrow pictures. */
    const double aspect = (double)width / height;
    const double size = tan(camera->fovy * PI / 360) * fmax(1, camera->aspect / aspect);
    Vec3 axes[3];
    Hit nearest = {.t = INFINITY};
    if (!has_formula(scene))
        return false;
    viewer_axes(camera, axes);
    const Vec3 way = of_axes(axes, (Vec3){((2 * x + 1.0) / width - 1) * size * aspect,
                                          (1 - (2 * y + 1.0) / height) * size, -1});
    for (int i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        const Mat4 m = object->world_from_object;
        Mat4 inverse;
        if (!mat4_inverse(m, &inverse))
            return false;
        const Mat4 normals = object->wrong_normals ? m : mat4_transpose(inverse);
        const Ray ray = {mat4_transform_point(inverse, camera->eye),
                         mat4_transform_direction(inverse, way), camera->near, camera->far};
        const double before = nearest.t;
        meet_object(&nearest, &ray, object, normals);
        if (nearest.t == before)
            continue;
        const bool behind = vec3_dot(nearest.face, ray.along) > 0;
        const Vec3 outside = vec3_unit(
            is_mesh(object) ? nearest.normal : mat4_transform_direction(normals, nearest.normal));
        *hit = (OraclePoint){.object = object,
                             .back = behind != object->clockwise && object->two_sided,
                             .point = vec3_add(camera->eye, vec3_scale(way, nearest.t))};
        hit->normal = vec3_scale(outside, hit->back ? -1 : 1);
        hit->viewer = scene->distant_viewer ? axes[2] : vec3_unit(vec3_scale(way, -1));
    }
    return nearest.t < (double)INFINITY;
}

/* Light. */

static Vec3 times(Vec3 a, Vec3 b)
{
    return (Vec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

/* The direction to the light, and the share of it that arrives. */
static Vec3 arrival(const Scene *scene, const Light *light, OraclePoint *at, double *share)
{
    const bool in_world = light->space == LIGHT_WORLD;
    Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (!in_world)
        viewer_axes(&scene->camera, axes);
    const Vec3 axis = vec3_unit(of_axes(axes, light->direction));
    *share = 1;
    if (light->kind == LIGHT_DIRECTIONAL)
        return axis;
    const Vec3 origin = in_world ? (Vec3){0, 0, 0} : scene->camera.eye;
    const Vec3 place = vec3_add(origin, of_axes(axes, light->position));
    const Vec3 way = vec3_subtract(place, at->point), to_light = vec3_unit(way);
    const double d = vec3_length(way);
    const double loss = light->constant + d * (light->linear + d * light->quadratic);
    if (light->constant != 0 || light->linear != 0 || light->quadratic != 0)
        *share = 1 / loss;
    if (light->kind == LIGHT_SPOT) {
        const double along = -vec3_dot(to_light, axis), edge = cos(light->cutoff * PI / 180);
        *share *= along >= edge ? pow(fmax(along, 0), light->exponent) : 0;
        at->from_jump = fmin(at->from_jump, fabs(along - edge));
    }
    return to_light;
}

Vec3 oracle_light(const Scene *scene, OraclePoint *at)
{
    static const double VISIBLE = 1e-3; /* of a highlight */
    const Material *material = at->back ? &at->object->back : &at->object->front;
    Vec3 sum = vec3_add(material->emission, times(scene->global_ambient, material->ambient));
    at->from_jump = INFINITY;
    for (int i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        double share;
        if (light->off)
            continue;
        const Vec3 to_light = arrival(scene, light, at, &share);
        const double facing = vec3_dot(at->normal, to_light);
        const Vec3 mirrored = vec3_subtract(vec3_scale(at->normal, 2 * facing), to_light);
        const Vec3 half = vec3_unit(vec3_add(to_light, at->viewer));
        const double cosine = scene->reflection == REFLECTION_PHONG ? vec3_dot(mirrored, at->viewer)
                                                                    : vec3_dot(at->normal, half);
        const double highlight = pow(fmax(cosine, 0), material->shininess);
        Vec3 one = times(light->ambient, material->ambient);
        if (facing > 0 || (scene->signed_dots && !light->shadows))
            one = vec3_add(one, vec3_scale(times(light->diffuse, material->diffuse), facing));
        if (facing > 0)
            one = vec3_add(one, vec3_scale(times(light->specular, material->specular), highlight));
        if (highlight > VISIBLE)
            at->from_jump = fmin(at->from_jump, fabs(facing));
        sum = vec3_add(sum, vec3_scale(one, share));
    }
    return sum;
}

bool oracle_color(const Scene *scene, int width, int height, int x, int y, double color[3])
{
    OraclePoint hit;
    if (!trace(scene, width, height, x, y, &hit))
        return false;
    const Vec3 sum = oracle_light(scene, &hit);
    const double channels[3] = {sum.x, sum.y, sum.z};
    const bool clipped = scene->show_clipped && fmax(sum.x, fmax(sum.y, sum.z)) > 1;
    for (int k = 0; k < 3; k++) {
        double value = clipped ? k != 1 : fmin(fmax(channels[k], 0), 1);
        if (scene->linear)
            value = value <= 0.0031308 ? 12.92 * value : 1.055 * pow(value, 1 / 2.4) - 0.055;
        color[k] = 255 * value;
    }
    return true;
}

/* mediump. */

const double ORACLE_MEDIUMP_UNIT = 0x1p-11;

static double largest_product(Vec3 a, Vec3 b)
{
    return fmax(a.x * b.x, fmax(a.y * b.y, a.z * b.z));
}

/*
 * Of one light on one side of an object; in units of u, to first order:
 *   normalizing            3.5: the square 3, halved by the root; the root, the product, 1 each
 *   normal, viewer         rounded as a varying, 1, then normalized
 *   direction to a light   light, point and difference rounded: `reach`; then normalized
 *   a dot product          the errors of both, and 3
 *   half vector            the errors of light and viewer, over |L + V|, at least 1.58 where they
 *                          lie at most 75 degrees apart; 4.5 for the sum and its length
 *   reflection             2 (N.L) N - L: twice those of N.L and N, that of L, and 3
 * The power s of a cosine that is 1 + e is off by exp(s e) - 1 at most. The power function itself,
 * exp2(s log2(x)), adds less than 2. Where N.L turns negative the highlight stops: a pixel for
 * which the signs differ is off by all of it, sin(37.5 degrees)^s for Blinn and 0^s for Phong.
 * Color, product and the sum of two terms are rounded once each, and the sum of all lights; 4 where
 * light gets less with distance or angle.
 */
static double mediump_of_light(const Light *from, const Material *material, bool phong,
                               double reach)
{
    const double u = ORACLE_MEDIUMP_UNIT, normal = 4.5 * u, viewer = 4.5 * u;
    const double light = ((from->kind == LIGHT_DIRECTIONAL ? 1 : reach) + 3.5) * u;
    const double cosine = normal + light + 3 * u;
    const double half = (light + viewer) / 1.58 + 4.5 * u;
    const double reflected = 2 * (cosine + normal) + light + 3 * u;
    const double angle = (phong ? reflected + viewer : half + normal) + 3 * u;
    const double diffuse = largest_product(from->diffuse, material->diffuse);
    const double specular = largest_product(from->specular, material->specular);
    const double stops = pow(phong ? 0 : sin(37.5 * PI / 180), material->shininess);
    const bool less = from->kind == LIGHT_SPOT || from->constant != 0 || from->linear != 0 ||
                      from->quadratic != 0;
    return diffuse * cosine + specular * fmax(expm1(material->shininess * angle) + 2 * u, stops) +
           (less ? 4 : fmin(3 * (diffuse + specular) + 1, 4)) * u;
}

double oracle_mediump_max(const Scene *scene, double reach)
{
    double max = 0;
    for (int i = 0; i < 2 * scene->object_count; i++) {
        const Object *object = &scene->objects[i / 2];
        double sum = ORACLE_MEDIUMP_UNIT;
        for (int k = 0; k < scene->light_count; k++)
            if (!scene->lights[k].off)
                sum += mediump_of_light(&scene->lights[k], i % 2 ? &object->back : &object->front,
                                        scene->reflection == REFLECTION_PHONG, reach);
        max = fmax(max, sum);
    }
    return fmin(0.5 + 255 * max, 255);
}
