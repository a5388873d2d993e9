/*
 * Edges are found once for each mesh: vertices at the same place are welded, and by a hash the two
 * directions of an edge. For a volume each triangle then adds 1 or -1 to the net of its three
 * edges, by whether it faces the light; edges whose net is not zero are the silhouette, and each
 * gets as many sides. The time is linear in the triangles.
 *
 * A triangle that the light lies on, at a vertex, say, does not keep it from anything, as in the
 * exact picture: floats do not know which way from the light such a vertex is.
 */
#include "shadows/silhouette.h"

#include "base/random.h"
#include "core/mesh_make.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The sine of an angle that rounding to floats does not change the sign of, by far. */
static const double CLEARLY = 0.02;

/* A hash table of numbers of items, with a comparison by the caller: open addressing. */
typedef struct Table {
    uint32_t *slots; /* a number plus 1; 0: free */
    size_t mask;
} Table;

static bool table_open(Table *table, size_t items)
{
    size_t size = 16;
    while (size < 2 * items)
        size *= 2;
    *table = (Table){calloc(size, sizeof *table->slots), size - 1};
    return table->slots != NULL;
}

static uint64_t mix(uint64_t a, uint64_t b)
{
    Random first = {a}, second = {random_bits(&first) ^ b};
    return random_bits(&second);
}

/* The number of the edge between two vertices, new or known, doubled, plus 1 if `from` is not its
 * lesser end. */
static uint32_t find_edge(Silhouette *made, Table *table, uint32_t from, uint32_t to)
{
    const uint32_t low = from < to ? from : to, high = from < to ? to : from;
    size_t slot = mix(low, high) & table->mask;
    for (; table->slots[slot]; slot = (slot + 1) & table->mask) {
        const uint32_t *ends = made->ends[table->slots[slot] - 1];
        if (ends[0] == low && ends[1] == high)
            break;
    }
    if (!table->slots[slot]) {
        made->ends[made->edge_count][0] = low;
        made->ends[made->edge_count][1] = high;
        table->slots[slot] = (uint32_t)++made->edge_count;
    }
    return 2 * (table->slots[slot] - 1) + (from > to);
}

static Vec3 corner(const Mesh *mesh, size_t index)
{
    return vec3_from_float(mesh->vertices[mesh->indices[index]].position);
}

/* Nets of zero when all triangles are as they are, and a positive volume. */
static bool is_closed(const Silhouette *made)
{
    double volume = 0;
    memset(made->nets, 0, made->edge_count * sizeof *made->nets);
    for (size_t t = 0; t < made->triangle_count; t++) {
        volume +=
            vec3_dot(vec3_subtract(corner(made->mesh, 3 * t), made->center), made->normals[t]);
        for (size_t k = 3 * t; k < 3 * t + 3 && made->edges[k] != UINT32_MAX; k++)
            made->nets[made->edges[k] / 2] += made->edges[k] % 2 ? -1 : 1;
    }
    for (size_t e = 0; e < made->edge_count; e++)
        if (made->nets[e] != 0)
            return false;
    return volume > 0;
}

/* For is_dark. */
static void find_lows(Silhouette *made)
{
    const Mesh *mesh = made->mesh;
    for (size_t i = 0; i < 3 * made->triangle_count; i++) {
        const Vec3 normal = vec3_from_float(mesh->vertices[mesh->indices[i]].normal);
        const size_t first = i - i % 3;
        made->lows[i] = vec3_dot(normal, corner(mesh, first));
        for (size_t k = first + 1; k < first + 3; k++)
            made->lows[i] = fmin(made->lows[i], vec3_dot(normal, corner(mesh, k)));
    }
}

static bool find_edges(Silhouette *made, uint32_t *first)
{
    const Mesh *mesh = made->mesh;
    Table table;
    if (!mesh_weld(mesh, false, first) || !table_open(&table, mesh->index_count))
        return false;
    for (size_t t = 0; t < made->triangle_count; t++) {
        const uint32_t *indices = mesh->indices + 3 * t;
        const Vec3 a = corner(mesh, 3 * t);
        made->normals[t] = vec3_cross(vec3_subtract(corner(mesh, 3 * t + 1), a),
                                      vec3_subtract(corner(mesh, 3 * t + 2), a));
        const bool flat = vec3_length(made->normals[t]) == 0;
        Vec3 shading = {0, 0, 0};
        for (size_t k = 0; k < 3; k++)
            shading = vec3_add(shading, vec3_from_float(mesh->vertices[indices[k]].normal));
        made->turned[t] = vec3_dot(shading, made->normals[t]) < 0;
        for (size_t k = 0; k < 3; k++)
            made->edges[3 * t + k] =
                flat ? UINT32_MAX
                     : find_edge(made, &table, first[indices[k]], first[indices[(k + 1) % 3]]);
    }
    free(table.slots);
    return true;
}

bool silhouette_open(Silhouette *silhouette, const Mesh *mesh, Message *message)
{
    const MeshBox box = mesh_bounds(mesh);
    const size_t edges = mesh->index_count + 1;
    uint32_t *first = malloc((mesh->vertex_count + 1) * sizeof *first);
    float center[3];
    const Vec3 half = vec3_scale(vec3_subtract(box.high, box.low), 0.5);
    vec3_to_float(vec3_add(box.low, half), center);
    *silhouette = (Silhouette){.mesh = mesh,
                               .triangle_count = mesh->index_count / 3,
                               .normals = malloc(edges * sizeof(Vec3)),
                               .turned = malloc(edges * sizeof(bool)),
                               .edges = malloc(edges * sizeof(uint32_t)),
                               .ends = malloc(edges * sizeof(uint32_t[2])),
                               .nets = malloc(edges * sizeof(int)),
                               .lows = malloc(edges * sizeof(double)),
                               .center = vec3_from_float(center),
                               .radius = 1.001 * vec3_length(half)};
    const bool done = first && silhouette->normals && silhouette->turned && silhouette->edges &&
                      silhouette->ends && silhouette->nets && silhouette->lows &&
                      find_edges(silhouette, first);
    free(first);
    if (!done) {
        silhouette_close(silhouette);
        return message_set(message, "shadows: not enough memory for the edges of %zu triangles",
                           mesh->index_count / 3);
    }
    silhouette->closed = is_closed(silhouette);
    find_lows(silhouette);
    return true;
}

void silhouette_close(Silhouette *silhouette)
{
    if (!silhouette)
        return;
    free(silhouette->normals);
    free(silhouette->turned);
    free(silhouette->edges);
    free(silhouette->ends);
    free(silhouette->nets);
    free(silhouette->lows);
    *silhouette = (Silhouette){.mesh = NULL};
}

/* Volumes */

static bool make_room(ShadowVolume *volume, const Silhouette *silhouette)
{
    const size_t count = silhouette->triangle_count + 1;
    if (count > volume->capacity) {
        shadow_volume_close(volume);
        /* Two triangles for each of three edges, and the far cap. */
        volume->sides = malloc(21 * count * sizeof(uint32_t));
        for (int i = 0; i < 4; i++)
            volume->caps[i] = malloc(3 * count * sizeof(uint32_t));
        if (!volume->sides || !volume->caps[0] || !volume->caps[1] || !volume->caps[2] ||
            !volume->caps[3]) {
            shadow_volume_close(volume);
            return false;
        }
        volume->capacity = count;
    }
    volume->side_count = 0;
    memset(volume->cap_counts, 0, sizeof volume->cap_counts);
    return true;
}

static void add_triangle(ShadowVolume *volume, const Silhouette *silhouette, size_t triangle,
                         bool lit)
{
    const int which = shadow_volume_caps(lit, silhouette->turned[triangle]);
    memcpy(volume->caps[which] + volume->cap_counts[which],
           silhouette->mesh->indices + 3 * triangle, 3 * sizeof(uint32_t));
    volume->cap_counts[which] += 3;
}

/* Whether light falls on no point of a triangle, whose normal is the vertices' interpolated:
 * N.(L - P) is negative for all pairs of its corners. `reach`: no point is farther from the light.
 */
static bool is_dark(const Silhouette *silhouette, size_t triangle, Vec3 light, bool near,
                    double reach)
{
    for (size_t i = 3 * triangle; i < 3 * triangle + 3; i++) {
        const Mesh *mesh = silhouette->mesh;
        const Vec3 normal = vec3_from_float(mesh->vertices[mesh->indices[i]].normal);
        const double most = vec3_dot(normal, light) - (near ? silhouette->lows[i] : 0);
        const double least = CLEARLY * reach;
        if (!(most < 0 && most * most > least * least * vec3_dot(normal, normal)))
            return false;
    }
    return true;
}

/* Whether the light lies on a triangle, as far as the shader's floats tell: `distance` is some of
 * their roundings. */
static bool is_touched(const Silhouette *silhouette, size_t triangle, Vec3 light, double distance)
{
    const Vec3 normal = silhouette->normals[triangle];
    const double least = distance * vec3_length(normal);
    const Vec3 from = corner(silhouette->mesh, 3 * triangle);
    if (fabs(vec3_dot(normal, vec3_subtract(light, from))) > least)
        return false;
    for (size_t k = 0; k < 3; k++) {
        const Vec3 a = corner(silhouette->mesh, 3 * triangle + k);
        const Vec3 side = vec3_subtract(corner(silhouette->mesh, 3 * triangle + (k + 1) % 3), a);
        if (vec3_dot(vec3_cross(normal, side), vec3_subtract(light, a)) <
            -least * vec3_length(side))
            return false;
    }
    return true;
}

/* The share of a triangle of the volume in its edges' nets, and in the cap at the end. */
static void add_edges(ShadowVolume *volume, const Silhouette *silhouette, size_t triangle, bool lit,
                      bool far)
{
    const uint32_t *indices = silhouette->mesh->indices + 3 * triangle;
    const uint32_t *edges = silhouette->edges + 3 * triangle;
    for (size_t k = 0; k < 3; k++) {
        silhouette->nets[edges[k] / 2] += (edges[k] % 2 == 1) == lit ? -1 : 1;
        if (far)
            volume->sides[volume->side_count++] = 2 * indices[lit ? 2 - k : k] + 1;
    }
}

/* The side below an edge from a to b, seen counter-clockwise from the light. */
static void add_side(ShadowVolume *volume, uint32_t a, uint32_t b, ShadowEnd end)
{
    const uint32_t quad[6] = {2 * b, 2 * a, 2 * a + 1, 2 * b, 2 * a + 1, 2 * b + 1};
    const size_t count = end == SHADOW_END_POINT ? 3 : 6;
    memcpy(volume->sides + volume->side_count, quad, count * sizeof *quad);
    volume->side_count += count;
}

bool shadow_volume_make(ShadowVolume *volume, const Silhouette *silhouette,
                        const ShadowVolumeKind *kind, Message *message)
{
    const Vec4 light = kind->light;
    const SilhouetteFacing facing = kind->facing;
    const Vec3 place = {light.x, light.y, light.z};
    const bool near = light.w != 0;
    const double reach =
        near ? vec3_length(vec3_subtract(place, silhouette->center)) + silhouette->radius
             : vec3_length(place);
    const double touching = ldexp(reach, -22);
    const bool may_touch = near && reach <= 2 * silhouette->radius + touching;
    if (!make_room(volume, silhouette))
        return message_set(message, "shadows: not enough memory for a volume of %zu triangles",
                           silhouette->triangle_count);
    memset(silhouette->nets, 0, silhouette->edge_count * sizeof *silhouette->nets);
    for (size_t t = 0; t < silhouette->triangle_count; t++) {
        if (silhouette->edges[3 * t] == UINT32_MAX ||
            (may_touch && is_touched(silhouette, t, place, touching)))
            continue;
        const Vec3 way = near ? vec3_subtract(place, corner(silhouette->mesh, 3 * t)) : place;
        const bool lit = vec3_dot(silhouette->normals[t], way) > 0;
        if (facing == SILHOUETTE_ALL || lit == (facing == SILHOUETTE_LIT))
            add_edges(volume, silhouette, t, lit, kind->end == SHADOW_END_CAPS);
        if (kind->dark || lit || silhouette->turned[t] ||
            !is_dark(silhouette, t, place, near, reach))
            add_triangle(volume, silhouette, t, lit);
    }
    for (size_t e = 0; e < silhouette->edge_count; e++) {
        const uint32_t *two = silhouette->ends[e];
        for (int net = silhouette->nets[e]; net > 0; net--)
            add_side(volume, two[0], two[1], kind->end);
        for (int net = silhouette->nets[e]; net < 0; net++)
            add_side(volume, two[1], two[0], kind->end);
    }
    return true;
}

void shadow_volume_close(ShadowVolume *volume)
{
    if (!volume)
        return;
    for (int i = 0; i < 4; i++)
        free(volume->caps[i]);
    free(volume->sides);
    *volume = (ShadowVolume){.capacity = 0};
}
