/*
 * Newell's teapot: 32 bicubic Bezier patches.
 *
 * Control points: M. Newell, The utilization of procedure models in digital image synthesis, 1975;
 * the bottom: F. Crow, The origins of the teapot, IEEE CG&A 7(1), 1987. Body and lid are profiles
 * turned round the axis, handle and spout tubes with symmetric cross sections, so that a line of
 * numbers gives a row of control points. Coordinates in this file are Newell's: z up, the table at
 * z = 0, the mirror plane y = 0.
 */
#include "base/memory.h"
#include "core/mesh_make.h"
#include "shapes/mesh_solids.h"

#include <stdlib.h>
#include <string.h>

/* Makes four control points from a line of numbers; `number` is that of the patch around. */
typedef void RowControl(const double *line, int number, Vec3 control[4]);

/* Neighbouring patches share the first and last of their four lines. */
typedef struct Part {
    int patches_down, patches_around;
    MeshPoles poles;
    RowControl *control;
    const double (*lines)[5];
} Part;

/* A quarter turn around z: {radius, bulge, z}. The bulge is Newell's 0.56 radius; 0.5523 would
 * approximate a circle best. */
static void turned(const double *line, int number, Vec3 control[4])
{
    const double radius = line[0], bulge = line[1], z = line[2];
    const double x[4] = {radius, radius, bulge, 0}, y[4] = {0, bulge, radius, radius};
    for (int i = 0; i < 4; i++) {
        const Vec3 quarters[4] = {
            {x[i], y[i], z}, {-y[i], x[i], z}, {-x[i], -y[i], z}, {y[i], -x[i], z}};
        control[i] = quarters[number];
    }
}

/* Half a cross section, from its outer to its inner end at y < 0, or back at y > 0: {outer x, outer
 * z, inner x, inner z, half the width}. */
static void tube(const double *line, int number, Vec3 control[4])
{
    const double width = number == 0 ? -line[4] : line[4];
    const Vec3 half[4] = {{line[0], 0, line[1]},
                          {line[0], width, line[1]},
                          {line[2], width, line[3]},
                          {line[2], 0, line[3]}};
    for (int i = 0; i < 4; i++)
        control[i] = half[number == 0 ? i : 3 - i];
}

/* From the inside of the rim to the bottom. */
static const double BODY[][5] = {
    {1.4, 0.784, 2.4}, {1.3375, 0.749, 2.53125}, {1.4375, 0.805, 2.53125},
    {1.5, 0.84, 2.4},  {1.75, 0.98, 1.875},      {2, 1.12, 1.35},
    {2, 1.12, 0.9},    {2, 1.12, 0.45},          {1.5, 0.84, 0.225},
    {1.5, 0.84, 0.15}, {1.5, 0.84, 0.075},       {1.425, 0.798, 0},
    {0, 0, 0}};

static const double LID[][5] = {{0, 0, 3.15},      {0.8, 0.45, 3.15},  {0, 0, 2.85},
                                {0.2, 0.112, 2.7}, {0.4, 0.224, 2.55}, {1.3, 0.728, 2.55},
                                {1.3, 0.728, 2.4}};

static const double HANDLE[][5] = {
    {-1.5, 2.25, -1.6, 2.025, 0.3}, {-2.5, 2.25, -2.3, 2.025, 0.3},
    {-3, 2.25, -2.7, 2.025, 0.3},   {-3, 1.8, -2.7, 1.8, 0.3},
    {-3, 1.35, -2.7, 1.575, 0.3},   {-2.65, 0.9375, -2.5, 1.125, 0.3},
    {-1.9, 0.6, -2, 0.9, 0.3}};

static const double SPOUT[][5] = {
    {1.7, 0.6, 1.7, 1.425, 0.66},       {3.1, 0.825, 2.6, 1.425, 0.66},
    {2.4, 2.025, 2.3, 2.1, 0.25},       {3.3, 2.4, 2.7, 2.4, 0.25},
    {3.525, 2.49375, 2.8, 2.475, 0.25}, {3.45, 2.5125, 2.9, 2.475, 0.15},
    {3.2, 2.4, 2.8, 2.4, 0.15}};

static const Part PARTS[] = {
    {4, 4, MESH_POLE_LAST, turned, BODY},
    {2, 4, MESH_POLE_FIRST, turned, LID},
    {2, 2, MESH_POLE_NONE, tube, HANDLE},
    {2, 2, MESH_POLE_NONE, tube, SPOUT},
};
enum { PART_COUNT = sizeof PARTS / sizeof PARTS[0] };

/* The cubic Bernstein polynomials and their derivatives at part / divisions. */
typedef struct Basis {
    double value[4], slope[4];
} Basis;

static Basis basis_at(int part, int divisions)
{
    const double t = (double)part / divisions, s = (double)(divisions - part) / divisions;
    return (Basis){
        .value = {s * s * s, 3 * (s * s) * t, 3 * (t * t) * s, t * t * t},
        .slope = {-3 * (s * s), 3 * (s * s) - 6 * (s * t), 6 * (s * t) - 3 * (t * t), 3 * (t * t)},
    };
}

/* Summed from both ends, so that a patch and its mirror image are bitwise equal. */
static Vec3 weighted(const Vec3 points[4], const double weights[4])
{
    return vec3_add(vec3_add(vec3_scale(points[0], weights[0]), vec3_scale(points[3], weights[3])),
                    vec3_add(vec3_scale(points[1], weights[1]), vec3_scale(points[2], weights[2])));
}

/* Converts to GLUT's coordinates: y up, 1.5 lower, half the size. (x, y, z) to (x, z, -y) is a
 * rotation. */
static void set_vertex(MeshVertex *vertex, Vec3 position, Vec3 normal, double size)
{
    const double scale = size / 2;
    /* Adding 0 turns -0 into 0: equal vertices are then bitwise equal. */
    vec3_to_float((Vec3){scale * position.x + 0.0, scale * (position.z - 1.5) + 0.0,
                         -scale * position.y + 0.0},
                  vertex->position);
    vec3_to_float((Vec3){normal.x + 0.0, normal.z + 0.0, -normal.y + 0.0}, vertex->normal);
}

/* A curve down a patch, by its control points, and their derivatives around it. */
typedef struct Curve {
    Vec3 value[4], slope[4];
} Curve;

static Curve curve_at(const Vec3 control[4][4], const Basis *around)
{
    Curve curve;
    for (int i = 0; i < 4; i++) {
        curve.value[i] = weighted(control[i], around->value);
        curve.slope[i] = weighted(control[i], around->slope);
    }
    return curve;
}

static void curve_vertex(MeshVertex *vertex, const Curve *curve, const Basis *down, double size)
{
    const Vec3 along_down = weighted(curve->value, down->slope);
    Vec3 along_around = weighted(curve->slope, down->value);
    Vec3 normal;
    /* Where a row degenerates to a point, the limit direction: the mixed derivative, away from the
     * point. */
    if (vec3_length(along_around) == 0)
        along_around =
            vec3_scale(weighted(curve->slope, down->slope), down->value[0] == 1 ? 1 : -1);
    vec3_normalize(vec3_cross(along_down, along_around), &normal);
    set_vertex(vertex, weighted(curve->value, down->value), normal, size);
}

/* False if stopped. */
static bool part_vertices(MeshVertex *vertices, const Part *part, double size, int divisions,
                          const atomic_bool *stop)
{
    const size_t row = (size_t)(part->patches_around * divisions) + 1;
    const int rows = part->patches_down * divisions;
    for (int patch = 0; patch < part->patches_down * part->patches_around; patch++) {
        const int across = patch % part->patches_around, down = patch / part->patches_around;
        Vec3 control[4][4];
        if (stop_asked(stop))
            return false;
        for (int i = 0; i < 4; i++)
            part->control(part->lines[3 * down + i], across, control[i]);
        for (int i = 0; i <= divisions; i++) {
            const Basis around = basis_at(i, divisions);
            const Curve curve = curve_at(control, &around);
            MeshVertex *column =
                &vertices[(size_t)(down * divisions) * row + (size_t)(across * divisions + i)];
            for (int j = 0; j <= divisions; j++) {
                const Basis at_row = basis_at(j, divisions);
                curve_vertex(&column[(size_t)j * row], &curve, &at_row, size);
            }
        }
    }
    for (int j = 0; j <= rows; j++) {
        MeshVertex *first = &vertices[(size_t)j * row];
        const bool pole = (j == 0 && part->poles & MESH_POLE_FIRST) ||
                          (j == rows && part->poles & MESH_POLE_LAST);
        for (size_t i = pole ? 1 : row - 1; i < row; i++)
            first[i] = first[0];
    }
    return true;
}

bool mesh_teapot(Mesh *mesh, double size, int divisions, Message *message)
{
    return mesh_teapot_until(mesh, size, divisions, NULL, message);
}

/* The slip moves the third control point of the first row of the third patch. */
static void slip(Mesh *mesh, double size)
{
    for (int j = 0; j < 4; j++) {
        const Basis down = basis_at(j, 4);
        for (int i = 1; i < 4; i++) {
            const Basis around = basis_at(i, 4);
            mesh->vertices[17 * j + 8 + i].position[0] -=
                (float)(0.09 * size / 2 * down.value[0] * around.value[2]);
        }
    }
}

/* Seams and poles are bitwise equal, and no two parts touch: of each place the first vertex gets
 * all triangles that meet there, and the others its normal. */
bool mesh_teapot_textbook(Mesh *mesh, double size, Message *message)
{
    if (!mesh_teapot(mesh, size, 4, message))
        return false;
    slip(mesh, size);
    uint32_t *first = memory_new(mesh->vertex_count, sizeof *first);
    bool done = mesh_weld(mesh, false, first);
    for (size_t i = 0; i < mesh->index_count; i++)
        mesh->indices[i] = first[mesh->indices[i]];
    done = done && mesh_compute_normals(mesh, MESH_WEIGHT_ANGLE, false, message);
    for (size_t i = 0; i < mesh->vertex_count && done; i++)
        memcpy(mesh->vertices[i].normal, mesh->vertices[first[i]].normal,
               sizeof mesh->vertices->normal);
    free(first);
    if (!done)
        mesh_close(mesh);
    return done;
}

bool mesh_teapot_until(Mesh *mesh, double size, int divisions, const atomic_bool *stop,
                       Message *message)
{
    size_t vertex_count = 0, index_count = 0;
    *mesh = (Mesh){0};
    if (!mesh_check_length("teapot", "size", size, message) ||
        !mesh_check_count("teapot", "divisions", divisions, 2, MESH_TEAPOT_MAX, message))
        return false;
    for (int i = 0; i < PART_COUNT; i++) {
        const int rows = PARTS[i].patches_down * divisions;
        const int columns = PARTS[i].patches_around * divisions;
        vertex_count += (size_t)(rows + 1) * (size_t)(columns + 1);
        index_count += mesh_grid_size(rows, columns, PARTS[i].poles);
    }
    if (!mesh_open(mesh, vertex_count, index_count, message))
        return false;
    uint32_t first = 0, *indices = mesh->indices;
    for (int i = 0; i < PART_COUNT; i++) {
        const int rows = PARTS[i].patches_down * divisions;
        const int columns = PARTS[i].patches_around * divisions;
        if (!part_vertices(mesh->vertices + first, &PARTS[i], size, divisions, stop)) {
            mesh_close(mesh);
            return message_set(message, "teapot: stopped");
        }
        indices = mesh_grid(indices, first, rows, columns, PARTS[i].poles);
        first += (uint32_t)(rows + 1) * (uint32_t)(columns + 1);
    }
    return true;
}
