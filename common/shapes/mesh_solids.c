/*
 * The solids except the teapot. A surface of revolution is rows of vertices, each a circle at its
 * height: only radius, height and the normal's slope differ from row to row. A row ends with a copy
 * of its first vertex, bit for bit, so that the seam is closed. Faces of a regular solid are
 * fans; their corners are a table, whose numbers are 0, 1 and the golden ratio.
 */
#include "shapes/mesh_solids.h"

#include "core/mesh_make.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

static size_t vertex_count(int rows, int columns)
{
    return ((size_t)rows + 1) * ((size_t)columns + 1);
}

static void set_vertex(MeshVertex *vertex, Vec3 position, Vec3 normal)
{
    /* Adding 0 turns -0 into 0: equal vertices are then bitwise equal. */
    vec3_to_float(vec3_add(position, (Vec3){0, 0, 0}), vertex->position);
    vec3_to_float(vec3_add(normal, (Vec3){0, 0, 0}), vertex->normal);
}

/* A row of vertices of a surface of revolution about z. */
typedef struct Circle {
    double radius, z;
    double normal_radius, normal_z; /* normalized */
} Circle;

/* Writes slices + 1 vertices, the first `turn` slices from the x axis; returns their end. */
static MeshVertex *revolve(MeshVertex *row, int slices, Circle circle, double turn)
{
    for (int i = 0; i < slices; i++) {
        const double a = 2 * PI * (i + turn) / slices, x = cos(a), y = sin(a);
        set_vertex(&row[i], (Vec3){circle.radius * x, circle.radius * y, circle.z},
                   (Vec3){circle.normal_radius * x, circle.normal_radius * y, circle.normal_z});
    }
    row[slices] = row[0];
    return row + slices + 1;
}

/* A disc at height z with the normal (0, 0, side): rows go outwards from the centre if side is 1,
 * inwards if it is -1. */
static MeshVertex *disc(MeshVertex *rows, int slices, int loops, double radius, double z, int side)
{
    for (int j = 0; j <= loops; j++) {
        const int loop = side > 0 ? j : loops - j;
        rows = revolve(rows, slices, (Circle){radius * loop / loops, z, 0, side}, 0);
    }
    return rows;
}

static bool check_round(const char *shape, double radius, int slices, const char *rows, int count,
                        Message *message)
{
    return mesh_check_length(shape, "radius", radius, message) &&
           mesh_check_count(shape, "slices", slices, 3, MESH_SPHERE_MAX, message) &&
           mesh_check_count(shape, rows, count, 1, MESH_SPHERE_MAX, message);
}

bool mesh_disc(Mesh *mesh, double radius, int slices, int loops, Message *message)
{
    *mesh = (Mesh){0};
    if (!check_round("disc", radius, slices, "loops", loops, message) ||
        !mesh_open(mesh, vertex_count(loops, slices),
                   mesh_grid_size(loops, slices, MESH_POLE_FIRST), message))
        return false;
    disc(mesh->vertices, slices, loops, radius, 0, 1);
    mesh_grid(mesh->indices, 0, loops, slices, MESH_POLE_FIRST);
    return true;
}

bool mesh_cone(Mesh *mesh, double radius, double height, int slices, int stacks, Message *message)
{
    const bool halving = stacks == MESH_CONE_HALVING;
    *mesh = (Mesh){0};
    if (halving)
        stacks = -MESH_CONE_HALVING;
    if (!check_round("cone", radius, slices, "stacks", stacks, message) ||
        !mesh_check_length("cone", "height", height, message) ||
        !mesh_open(mesh, vertex_count(stacks, slices) + vertex_count(1, slices),
                   mesh_grid_size(stacks, slices, MESH_POLE_FIRST) +
                       mesh_grid_size(1, slices, MESH_POLE_LAST),
                   message))
        return false;
    const double side = hypot(radius, height);
    MeshVertex *row = mesh->vertices;
    for (int j = 0; j <= stacks; j++) {
        Circle stack = {radius * j / stacks, height * (stacks - j) / stacks, height / side,
                        radius / side};
        /* At the apex, vertex i + 1 belongs to the slice from i to i + 1. */
        double turn = j == 0 ? -0.5 : 0;
        if (halving && j > 0) {
            const double share = ldexp(1, j - stacks); /* of the way from the apex to the base */
            stack.radius = radius * share;
            stack.z = height * (1 - share);
            turn = j % 2 == 0 ? 0.5 : 0;
        }
        row = revolve(row, slices, stack, turn);
    }
    const uint32_t base = (uint32_t)(row - mesh->vertices);
    disc(row, slices, 1, radius, 0, -1);
    uint32_t *indices = mesh_grid(mesh->indices, 0, stacks, slices, MESH_POLE_FIRST);
    mesh_grid(indices, base, 1, slices, MESH_POLE_LAST);
    return true;
}

bool mesh_cylinder(Mesh *mesh, MeshCylinder cylinder, Message *message)
{
    const double radius = cylinder.radius, height = cylinder.height;
    const int slices = cylinder.slices, stacks = cylinder.stacks;
    const MeshCaps caps = cylinder.caps;
    *mesh = (Mesh){0};
    if (!check_round("cylinder", radius, slices, "stacks", stacks, message) ||
        !mesh_check_length("cylinder", "height", height, message))
        return false;
    const size_t cap_count = (caps & MESH_CAP_TOP ? 1 : 0) + (caps & MESH_CAP_BOTTOM ? 1 : 0);
    if (!mesh_open(mesh, vertex_count(stacks, slices) + cap_count * vertex_count(1, slices),
                   mesh_grid_size(stacks, slices, MESH_POLE_NONE) +
                       cap_count * mesh_grid_size(1, slices, MESH_POLE_FIRST),
                   message))
        return false;
    MeshVertex *row = mesh->vertices;
    for (int j = 0; j <= stacks; j++)
        row = revolve(row, slices, (Circle){radius, height * (stacks - j) / stacks, 1, 0}, 0);
    uint32_t *indices = mesh_grid(mesh->indices, 0, stacks, slices, MESH_POLE_NONE);
    if (caps & MESH_CAP_TOP) {
        indices = mesh_grid(indices, (uint32_t)(row - mesh->vertices), 1, slices, MESH_POLE_FIRST);
        row = disc(row, slices, 1, radius, height, 1);
    }
    if (caps & MESH_CAP_BOTTOM) {
        mesh_grid(indices, (uint32_t)(row - mesh->vertices), 1, slices, MESH_POLE_LAST);
        disc(row, slices, 1, radius, 0, -1);
    }
    return true;
}

bool mesh_torus(Mesh *mesh, double tube, double ring, int sides, int rings, Message *message)
{
    *mesh = (Mesh){0};
    if (!mesh_check_length("torus", "tube radius", tube, message) ||
        !mesh_check_length("torus", "ring radius", ring, message))
        return false;
    if (!(tube < ring) || tube * MESH_TORUS_THIN < ring)
        return message_set(message,
                           "torus: tube radius %g: must be less than the ring radius, %g, and at "
                           "least 1/%d of it",
                           tube, ring, MESH_TORUS_THIN);
    if (!mesh_check_count("torus", "sides", sides, 3, MESH_SPHERE_MAX, message) ||
        !mesh_check_count("torus", "rings", rings, 3, MESH_SPHERE_MAX, message) ||
        !mesh_open(mesh, vertex_count(sides, rings), mesh_grid_size(sides, rings, MESH_POLE_NONE),
                   message))
        return false;
    MeshVertex *row = mesh->vertices;
    for (int j = 0; j < sides; j++) {
        const double b = 2 * PI * j / sides; /* from the outer rim downwards */
        const Circle side = {ring + tube * cos(b), -tube * sin(b), cos(b), -sin(b)};
        row = revolve(row, rings, side, 0);
    }
    for (int i = 0; i <= rings; i++)
        row[i] = mesh->vertices[i];
    mesh_grid(mesh->indices, 0, sides, rings, MESH_POLE_NONE);
    return true;
}

bool mesh_quad(Mesh *mesh, int divisions, Message *message)
{
    *mesh = (Mesh){0};
    if (!mesh_check_count("quad", "divisions", divisions, 1, MESH_SPHERE_MAX, message) ||
        !mesh_open(mesh, vertex_count(divisions, divisions),
                   mesh_grid_size(divisions, divisions, MESH_POLE_NONE), message))
        return false;
    MeshVertex *vertex = mesh->vertices;
    for (int j = 0; j <= divisions; j++)
        for (int i = 0; i <= divisions; i++) {
            const double x = (double)(2 * i - divisions) / divisions;
            const double y = (double)(divisions - 2 * j) / divisions;
            set_vertex(vertex++, (Vec3){x, y, 0}, (Vec3){0, 0, 1});
        }
    mesh_grid(mesh->indices, 0, divisions, divisions, MESH_POLE_NONE);
    return true;
}

/* The regular solids. */

#define G 1.61803398874989484820 /* the golden ratio, (1 + sqrt(5)) / 2 */
#define H 0.61803398874989484820 /* 1 / G */

/* Corners of any length; faces as indices of corners, counter-clockwise from outside. */

static const Vec3 TETRAHEDRON[] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
static const unsigned char TETRAHEDRON_FACES[][5] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};

static const Vec3 OCTAHEDRON[] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                  {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
static const unsigned char OCTAHEDRON_FACES[][5] = {{0, 2, 4}, {0, 3, 5}, {0, 4, 3}, {0, 5, 2},
                                                    {1, 2, 5}, {1, 3, 4}, {1, 4, 2}, {1, 5, 3}};

static const Vec3 DODECAHEDRON[] = {
    {1, 1, 1},    {1, 1, -1},  {1, -1, 1}, {1, -1, -1}, {-1, 1, 1},  {-1, 1, -1}, {-1, -1, 1},
    {-1, -1, -1}, {0, H, G},   {0, H, -G}, {0, -H, G},  {0, -H, -G}, {H, G, 0},   {H, -G, 0},
    {-H, G, 0},   {-H, -G, 0}, {G, 0, H},  {G, 0, -H},  {-G, 0, H},  {-G, 0, -H}};
static const unsigned char DODECAHEDRON_FACES[][5] = {
    {0, 8, 10, 2, 16},  {0, 12, 14, 4, 8},  {0, 16, 17, 1, 12}, {1, 9, 5, 14, 12},
    {1, 17, 3, 11, 9},  {2, 10, 6, 15, 13}, {2, 13, 3, 17, 16}, {3, 13, 15, 7, 11},
    {4, 14, 5, 19, 18}, {4, 18, 6, 10, 8},  {5, 9, 11, 7, 19},  {6, 18, 19, 7, 15}};

static const Vec3 ICOSAHEDRON[] = {{1, 0, G}, {1, 0, -G}, {-1, 0, G}, {-1, 0, -G},
                                   {0, G, 1}, {0, G, -1}, {0, -G, 1}, {0, -G, -1},
                                   {G, 1, 0}, {G, -1, 0}, {-G, 1, 0}, {-G, -1, 0}};
static const unsigned char ICOSAHEDRON_FACES[][5] = {
    {0, 2, 6},  {0, 4, 2},   {0, 6, 9},  {0, 8, 4},  {0, 9, 8},   {1, 3, 5},  {1, 5, 8},
    {1, 7, 3},  {1, 8, 9},   {1, 9, 7},  {2, 4, 10}, {2, 10, 11}, {2, 11, 6}, {3, 7, 11},
    {3, 10, 5}, {3, 11, 10}, {4, 5, 10}, {4, 8, 5},  {6, 7, 9},   {6, 11, 7}};

static const struct Regular {
    const char *name;
    size_t face_count, sides;
    const Vec3 *corners;
    const unsigned char (*faces)[5];
} REGULAR[] = {
    [MESH_TETRAHEDRON] = {"tetrahedron", 4, 3, TETRAHEDRON, TETRAHEDRON_FACES},
    [MESH_OCTAHEDRON] = {"octahedron", 8, 3, OCTAHEDRON, OCTAHEDRON_FACES},
    [MESH_DODECAHEDRON] = {"dodecahedron", 12, 5, DODECAHEDRON, DODECAHEDRON_FACES},
    [MESH_ICOSAHEDRON] = {"icosahedron", 20, 3, ICOSAHEDRON, ICOSAHEDRON_FACES},
};

bool mesh_regular(Mesh *mesh, MeshRegular kind, double radius, Message *message)
{
    const struct Regular *solid = &REGULAR[kind];
    const size_t sides = solid->sides;
    *mesh = (Mesh){0};
    if (!mesh_check_length(solid->name, "radius", radius, message) ||
        !mesh_open(mesh, solid->face_count * sides, 3 * solid->face_count * (sides - 2), message))
        return false;
    uint32_t *index = mesh->indices;
    for (size_t face = 0; face < solid->face_count; face++) {
        /* The normal of a regular solid's face points to its centre. */
        const unsigned char *corners = solid->faces[face];
        Vec3 centre = {0, 0, 0}, normal;
        for (size_t i = 0; i < sides; i++)
            centre = vec3_add(centre, solid->corners[corners[i]]);
        vec3_normalize(centre, &normal);
        const size_t first = face * sides;
        for (size_t i = 0; i < sides; i++) {
            Vec3 corner;
            vec3_normalize(solid->corners[corners[i]], &corner);
            set_vertex(&mesh->vertices[first + i], vec3_scale(corner, radius), normal);
        }
        for (size_t i = 1; i + 1 < sides; i++) {
            *index++ = (uint32_t)first;
            *index++ = (uint32_t)(first + i);
            *index++ = (uint32_t)(first + i + 1);
        }
    }
    return true;
}
