/*
 * Everything that is the same for all rays is computed once: for a solid the inverse of its matrix,
 * the eye in its coordinates and a ball around it; for a mesh its vertices and normals as seen from
 * the eye, a hierarchy of its triangles, and the colors of its corners where light is computed
 * there. A solid whose matrix is singular has no inverse: it is its mesh.
 */
#include "reference/reference_object.h"

#include "shapes/mesh_solids.h"

#include <stdlib.h>

static Real3 column(const double m[16], int number)
{
    return (Real3){m[4 * number], m[4 * number + 1], m[4 * number + 2]};
}

static Real3 transform(const Real3 columns[3], Real3 v)
{
    return real3_along(real3_along(real3_scale(columns[0], v.x), v.y, columns[1]), v.z, columns[2]);
}

/* The cofactor matrix's columns: the inverse transpose is they over the determinant. */
static void cofactors(const Real3 columns[3], Real3 out[3])
{
    out[0] = real3_cross(columns[1], columns[2]);
    out[1] = real3_cross(columns[2], columns[0]);
    out[2] = real3_cross(columns[0], columns[1]);
}

/* Whether a matrix with these columns, whose determinant is `determinant`, flattens what it
 * transforms; but for rounding, since it may be a product. */
static bool singular(const Real3 columns[3], Real determinant)
{
    const Real size =
        real3_length(columns[0]) * real3_length(columns[1]) * real3_length(columns[2]);
    return !(real_abs(determinant) > (Real)1e-14 * size);
}

/* Normals are transformed with the inverse transpose up to a positive factor: the cofactors by the
 * sign of the determinant. (Turkowski, Properties of Surface-Normal Transformations, Graphics Gems,
 * 1990) */
static void set_normal_columns(TraceObject *ready, const Real3 turned[3])
{
    Real largest = 0, size = 0;
    for (int k = 0; k < 3; k++) {
        ready->normal_columns[k] = ready->columns[k];
        largest = real_max(largest, real3_length(turned[k]));
        size = real_max(size, real3_dot(ready->columns[k], ready->columns[k]));
    }
    if (ready->object->wrong_normals)
        return;
    /* Rank below 2: no surface is left, and no normal; the cofactors are rounding at most. */
    const Real factor = largest > (Real)1e-15 * size ? (ready->mirrored ? -1 : 1) / largest : 0;
    for (int k = 0; k < 3; k++)
        ready->normal_columns[k] = real3_scale(turned[k], factor);
}

Real3 trace_object_normal(const TraceObject *ready, Real3 normal_object)
{
    return real3_unit(transform(ready->normal_columns, normal_object));
}

Real3 trace_object_place(const TraceObject *ready, Real3 point_object)
{
    return real3_add(transform(ready->columns, point_object), ready->offset);
}

static Real3 to_real3(const float v[3])
{
    return (Real3){v[0], v[1], v[2]};
}

/* A light at the corners, with the normal of the vertex or of the triangle. */
static Real3 light_corner(const TraceObject *ready, const TraceLayers *layers, int layer,
                          size_t vertex, Real3 normal, bool back)
{
    const Object *object = ready->object;
    ShadeSides sides;
    const bool reversed = back && object->two_sided;
    Material material = reversed ? object->back : object->front;
    if (ready->mesh->colors)
        material.ambient = material.diffuse = vec3_from_float(ready->mesh->colors[vertex]);
    if (layer > 0)
        material.emission = (Vec3){0, 0, 0};
    const ShadePoint point = {&material, ready->points[vertex],
                              real3_scale(normal, reversed ? -1 : 1)};
    return shade_point(&layers->layers[layer], &point, &sides);
}

/* The normal of a triangle of the mesh, in object coordinates. */
static Real3 face_normal(const Mesh *mesh, size_t triangle)
{
    Real3 v[3];
    for (size_t k = 0; k < 3; k++)
        v[k] = to_real3(mesh->vertices[mesh->indices[3 * triangle + k]].position);
    return real3_unit(real3_cross(real3_subtract(v[1], v[0]), real3_subtract(v[2], v[0])));
}

static bool light_corners(TraceObject *ready, const Scene *scene, const TraceLayers *layers)
{
    const Mesh *mesh = ready->mesh;
    const size_t count = ready->own_corners ? mesh->index_count : mesh->vertex_count;
    const size_t all = count * (size_t)layers->count;
    ready->color_count = count;
    const bool constant = scene->interpolation == INTERPOLATION_CONSTANT;
    for (int side = 0; side < (ready->object->two_sided ? 2 : 1); side++) {
        ready->colors[side] = malloc((all + 1) * sizeof *ready->colors[side]);
        if (!ready->colors[side])
            return false;
        for (size_t k = 0; k < all; k++) {
            const size_t i = k % count;
            const size_t corner = constant ? i - i % 3 + 2 : i; /* a triangle's last */
            const size_t vertex = ready->own_corners ? mesh->indices[corner] : i;
            const Real3 normal = ready->own_corners && !constant
                                     ? trace_object_normal(ready, face_normal(mesh, i / 3))
                                     : ready->normals[vertex];
            ready->colors[side][k] =
                light_corner(ready, layers, (int)(k / count), vertex, normal, side == 1);
        }
    }
    return true;
}

static Ball ball_around_box(const Box *box)
{
    Real middle[3], square = 0, reach = 0;
    for (int k = 0; k < 3; k++) {
        const Real half = (box->high[k] - box->low[k]) / 2;
        middle[k] = box->low[k] + half;
        square += half * half;
        reach = real_max(reach, real_abs(middle[k]) + half);
    }
    const Real around = (1 + (Real)1e-9) * real_sqrt(square) + (Real)1e-13 * reach;
    return (Ball){{middle[0], middle[1], middle[2]}, around * around};
}

static bool open_triangles(TraceObject *ready, const Scene *scene, const TraceLayers *layers,
                           const ReferenceOptions *options)
{
    const Mesh *mesh = ready->mesh;
    const bool at_corners = options->meshes && scene->interpolation != INTERPOLATION_PHONG;
    const bool flatten = scene->interpolation == INTERPOLATION_FLAT && !ready->object->flat;
    ready->own_corners = at_corners && (flatten || scene->interpolation == INTERPOLATION_CONSTANT);
    Real3 *points = malloc((mesh->vertex_count + 1) * sizeof *points);
    ready->points = points;
    ready->normals = malloc((mesh->vertex_count + 1) * sizeof *ready->normals);
    bool done = points && ready->normals;
    Box box = box_empty();
    for (size_t i = 0; done && i < mesh->vertex_count; i++) {
        const MeshVertex *vertex = &mesh->vertices[i];
        points[i] = trace_object_place(ready, to_real3(vertex->position));
        const Real place[3] = {points[i].x, points[i].y, points[i].z};
        box_extend(&box, place, place);
        ready->normals[i] = trace_object_normal(ready, to_real3(vertex->normal));
    }
    ready->ball = ball_around_box(&box);
    return done &&
           triangles_open(&ready->triangles, mesh, points, ready->own_corners, options->threads,
                          options->stop) &&
           (!at_corners || light_corners(ready, scene, layers));
}

/* Around a solid's middle. A linear map makes a vector longer by at most the root of the largest
 * sum of a row of M^T M. (Gershgorin, 1931) */
static Ball ball_around(const TraceObject *ready)
{
    const Solid *solid = &ready->object->solid;
    const Real radius = solid->radius, half = (Real)solid->height / 2;
    const bool high = solid->kind == SOLID_CYLINDER || solid->kind == SOLID_CONE;
    const Real reach = solid->kind == SOLID_BOX     ? real_sqrt(3) * radius
                       : solid->kind == SOLID_TORUS ? radius + solid->tube
                       : solid->kind == SOLID_QUAD  ? real_sqrt(2)
                       : high                       ? real_sqrt(radius * radius + half * half)
                                                    : radius;
    const Ball ball = {.center = trace_object_place(ready, (Real3){0, 0, high ? half : 0})};
    Real longer = 0;
    for (int i = 0; i < 3; i++) {
        Real sum = 0;
        for (int k = 0; k < 3; k++)
            sum += real_abs(real3_dot(ready->columns[i], ready->columns[k]));
        longer = real_max(longer, sum);
    }
    const Real around = (1 + (Real)1e-9) * reach * real_sqrt(longer) +
                        (Real)1e-13 * (real3_reach(ball.center) + real3_reach(ready->offset));
    return (Ball){ball.center, around * around};
}

bool trace_object_open(TraceObject *ready, const Object *object, const Scene *scene,
                       const TraceLayers *layers, const ReferenceOptions *options)
{
    const double *m = object->world_from_object.m;
    Real3 rows[3];
    *ready = (TraceObject){.object = object, .mesh = object->mesh};
    for (int k = 0; k < 3; k++)
        ready->columns[k] = column(m, k);
    ready->offset = real3_subtract(column(m, 3), real3(scene->camera.eye));
    cofactors(ready->columns, rows);
    const Real determinant = real3_dot(ready->columns[0], rows[0]);
    const bool flattened = singular(ready->columns, determinant);
    ready->mirrored = determinant < 0;
    set_normal_columns(ready, rows);
    const bool exact = !options->meshes && !flattened && !(object->mesh && object->mesh->colors);
    ready->exact = exact && object->solid.kind != SOLID_NONE && object->solid.kind != SOLID_TEAPOT;
    if (ready->exact) {
        for (int k = 0; k < 3; k++)
            ready->inverse[k] = real3_scale(rows[k], 1 / determinant);
        const Real3 eye = real3_scale(ready->offset, -1);
        ready->eye = (Real3){real3_dot(ready->inverse[0], eye), real3_dot(ready->inverse[1], eye),
                             real3_dot(ready->inverse[2], eye)};
        ready->ball = ball_around(ready);
        return true;
    }
    if (exact && object->solid.kind == SOLID_TEAPOT) {
        if (!mesh_teapot_until(&ready->own, object->solid.radius, REFERENCE_TEAPOT_DIVISIONS,
                               options->stop, NULL))
            return false;
        ready->mesh = &ready->own;
        ready->smooth = true;
    }
    return open_triangles(ready, scene, layers, options);
}

void trace_object_close(TraceObject *ready)
{
    triangles_close(&ready->triangles);
    mesh_close(&ready->own);
    free(ready->points);
    free(ready->normals);
    free(ready->colors[0]);
    free(ready->colors[1]);
    *ready = (TraceObject){.object = NULL};
}
