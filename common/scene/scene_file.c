/*
 * Lists that grow, where nodes are at a time, and whether a mesh is closed.
 *
 * A mesh is closed and consistently turned where its boundary is nothing: each edge is passed as
 * often in one direction as in the other. With a random number for each pair of places, added for
 * one direction and subtracted for the other, the sum is 0 then, and otherwise only by a chance of
 * 1 in 2^64: no table of edges is needed. (Carter and Wegman, Universal classes of hash functions,
 * 1979.) Connected parts are found by union and find with path halving (Tarjan and van Leeuwen,
 * 1984): one that holds a negative volume is turned inside out.
 */
#include "scene/scene_file.h"

#include "base/memory.h"
#include "base/random.h"
#include "core/matrix_vectors.h"
#include "core/mesh_make.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Lists */

FileListPlace scene_file_list(SceneFile *file, FileList list)
{
#define LIST(items, name, most)                                                                    \
    name, (void **)&file->items##s, &file->items##_count, sizeof *file->items##s, most
    const FileListPlace places[FILE_LISTS] = {
        [FILE_NODES] = {LIST(node, "nodes", FILE_ITEMS_MAX)},
        [FILE_OBJECTS] = {LIST(object, "objects", FILE_ITEMS_MAX)},
        [FILE_LIGHTS] = {LIST(light, "lights", FILE_ITEMS_MAX)},
        [FILE_CAMERAS] = {LIST(camera, "cameras", FILE_ITEMS_MAX)},
        [FILE_CHANNELS] = {LIST(channel, "channels of animations", FILE_ITEMS_MAX)},
        [FILE_KEYS] = {LIST(key, "keys of animations", FILE_KEYS_MAX)},
        [FILE_NOTES] = {LIST(note, "notes", 100)},
        [FILE_MESHES] = {"meshes", (void **)&file->meshes, &file->mesh_count, sizeof *file->meshes,
                         FILE_ITEMS_MAX},
    };
#undef LIST
    return places[list];
}

void *scene_file_add(SceneFile *file, FileList list, Message *reason)
{
    const FileListPlace place = scene_file_list(file, list);
    const int count = *place.count;
    if (count >= place.most) {
        message_set(reason, "more than %d %s", place.most, place.name);
        return NULL;
    }
    if ((count & (count - 1)) == 0) /* a power of two is full */
        *place.items = memory_grow(*place.items, count ? 2 * (size_t)count : 1, place.size);
    *place.count = count + 1;
    return memset((char *)*place.items + (size_t)count * place.size, 0, place.size);
}

float *scene_file_add_channel(SceneFile *file, FileChannel channel, size_t numbers, Message *reason)
{
    FileChannel *added = scene_file_add(file, FILE_CHANNELS, reason);
    if (!added)
        return NULL;
    channel.first = file->key_count;
    for (size_t i = 0; i < (size_t)channel.count + numbers; i++)
        if (!scene_file_add(file, FILE_KEYS, reason))
            return NULL;
    *added = channel;
    file->nodes[channel.node].moving = true;
    return file->keys + channel.first;
}

bool scene_file_fits(size_t vertices, size_t indices, Message *reason)
{
    return (vertices <= MODEL_VERTICES_MAX && indices / 3 <= MODEL_TRIANGLES_MAX) ||
           message_set(reason, "%zu vertices and %zu triangles; at most %d and %d are read",
                       vertices, indices / 3, MODEL_VERTICES_MAX, MODEL_TRIANGLES_MAX);
}

void scene_file_note(SceneFile *file, bool occurs, const char *text)
{
    FileNote *note = file->notes;
    for (int i = 0; i < file->note_count && occurs; i++, note++)
        if (strcmp(note->text, text) == 0) {
            note->count++;
            return;
        }
    if (!occurs || !(note = scene_file_add(file, FILE_NOTES, NULL)))
        return;
    snprintf(note->text, sizeof note->text, "%s", text);
    note->count = 1;
}

void scene_file_close(SceneFile *file)
{
    if (!file)
        return;
    for (int i = 0; i < file->mesh_count; i++)
        mesh_close(&file->meshes[i]);
    for (int list = 0; list < FILE_LISTS; list++)
        free(*scene_file_list(file, (FileList)list).items);
    *file = (SceneFile){.photometric = false};
}

/* Poses */

/* A rotation by a quaternion of any length. (Shoemake, Animating rotation with quaternion curves,
 * 1985) */
static Mat4 rotate_by(Vec4 q)
{
    const double norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    const double s = norm > 0 ? 2 / norm : 0;
    return (Mat4){{1 - s * (q.y * q.y + q.z * q.z), s * (q.x * q.y + q.w * q.z),
                   s * (q.x * q.z - q.w * q.y), 0, s * (q.x * q.y - q.w * q.z),
                   1 - s * (q.x * q.x + q.z * q.z), s * (q.y * q.z + q.w * q.x), 0,
                   s * (q.x * q.z + q.w * q.y), s * (q.y * q.z - q.w * q.x),
                   1 - s * (q.x * q.x + q.y * q.y), 0, 0, 0, 0, 1}};
}

Mat4 scene_file_moved(const FileNode *node)
{
    return mat4_product(mat4_translate(node->translation),
                        mat4_product(rotate_by(node->rotation), mat4_scale(node->scale)));
}

/* Spherical interpolation on the shorter arc; nearly equal ones linearly. */
static void slerp(const float *a, const float *b, double t, double *value)
{
    double dot = 0;
    for (int k = 0; k < 4; k++)
        dot += (double)a[k] * (double)b[k];
    const double sign = dot < 0 ? -1 : 1, angle = acos(fmin(fabs(dot), 1));
    const double s = sin(angle);
    const double from = s > 1e-6 ? sin((1 - t) * angle) / s : 1 - t;
    const double to = sign * (s > 1e-6 ? sin(t * angle) / s : t);
    for (int k = 0; k < 4; k++)
        value[k] = from * (double)a[k] + to * (double)b[k];
}

/* Between the keys i and i + 1, at the part t of `step` seconds: glTF 2.0, appendix C. */
static void interpolate(const FileChannel *channel, const float *values, double t, double step,
                        double *value)
{
    const int size = channel->path == FILE_ROTATION ? 4 : 3;
    if (channel->step == FILE_LINEAR && channel->path == FILE_ROTATION) {
        slerp(values, values + size, t, value);
        return;
    }
    for (int k = 0; k < size; k++) {
        if (channel->step == FILE_CUBIC) { /* in-tangent, value, out-tangent */
            const double a = (double)values[size + k], b = (double)values[4 * size + k];
            const double out = step * (double)values[2 * size + k];
            const double in = step * (double)values[3 * size + k];
            value[k] =
                a + t * (out + t * (3 * (b - a) - 2 * out - in + t * (2 * (a - b) + out + in)));
        } else {
            const double a = (double)values[k], b = (double)values[size + k];
            value[k] = channel->step == FILE_STEP ? a : a + t * (b - a);
        }
    }
}

/* The value at a time; before the first key and after the last, theirs. */
static void channel_value(const SceneFile *file, const FileChannel *channel, double seconds,
                          double value[4])
{
    const float *times = file->keys + channel->first, *values = times + channel->count;
    const int size = channel->path == FILE_ROTATION ? 4 : 3;
    const int stride = channel->step == FILE_CUBIC ? 3 * size : size, last = channel->count - 1;
    int i = 0;
    if (!(seconds > (double)times[0]) || last == 0 || seconds >= (double)times[last]) {
        const float *end = values + stride * (seconds > (double)times[0] ? last : 0);
        for (int k = 0; k < size; k++)
            value[k] = (double)end[k + (channel->step == FILE_CUBIC ? size : 0)];
        return;
    }
    for (int high = last; high - i > 1;) {
        const int middle = (i + high) / 2;
        *(seconds >= (double)times[middle] ? &i : &high) = middle;
    }
    const double step = (double)times[i + 1] - (double)times[i];
    interpolate(channel, values + stride * i, step > 0 ? (seconds - (double)times[i]) / step : 0,
                step, value);
}

/* Sets what the channels change, at a time that begins again after the last key. */
static void animate(const SceneFile *file, double seconds)
{
    double end = 0;
    for (int i = 0; i < file->channel_count; i++)
        end = fmax(end, (double)file->keys[file->channels[i].first + file->channels[i].count - 1]);
    if (end > 0 && seconds > end)
        seconds = fmod(seconds, end);
    for (int i = 0; i < file->channel_count; i++) {
        const FileChannel *channel = &file->channels[i];
        FileNode *node = &file->nodes[channel->node];
        double v[4];
        channel_value(file, channel, seconds, v);
        if (channel->path == FILE_ROTATION)
            node->rotation = (Vec4){v[0], v[1], v[2], v[3]};
        else
            *(channel->path == FILE_SCALE ? &node->scale : &node->translation) =
                (Vec3){v[0], v[1], v[2]};
    }
}

void scene_file_pose(const SceneFile *file, double seconds, Mat4 *world_from_nodes)
{
    const bool moves = seconds > 0;
    if (moves)
        animate(file, seconds);
    for (int i = 0; i < file->node_count; i++) {
        const FileNode *node = &file->nodes[i];
        const Mat4 own = node->moving && moves ? scene_file_moved(node) : node->parent_from_node;
        world_from_nodes[i] =
            node->parent < 0 ? own : mat4_product(world_from_nodes[node->parent], own);
    }
}

Mat4 scene_file_upright(int axis, bool down)
{
    const Mat4 turned = axis == 0   ? mat4_rotate(90, (Vec3){0, 0, 1})
                        : axis == 2 ? mat4_rotate(-90, (Vec3){1, 0, 0})
                                    : mat4_identity();
    return down ? mat4_product(mat4_rotate(180, (Vec3){0, 0, 1}), turned) : turned;
}

/* Of the light ((cos - cos outer) / (cos inner - cos outer))^2: KHR_lights_punctual. */
double scene_file_spot_exponent(double inner, double outer)
{
    const double edge = cos(fmin(fmax(outer, 0), 1.5707963267948966));
    const double core = fmax(cos(fmin(fmax(inner, 0), outer)), edge);
    const double half = edge + sqrt(0.5) * (core - edge);
    return core - edge > 1e-3 && half > 0 && half < 1 ? fmin(log(0.5) / log(half), 128) : 0;
}

/* Closed meshes */

static uint32_t root_of(uint32_t *parents, uint32_t i)
{
    while (parents[i] != i)
        i = parents[i] = parents[parents[i]];
    return i;
}

static uint64_t edge(uint64_t a, uint64_t b)
{
    Random ends = {a < b ? (a << 1 | a >> 63) ^ b : (b << 1 | b >> 63) ^ a};
    const uint64_t number = random_bits(&ends);
    return a < b ? number : -number;
}

static void unite(uint32_t *parents, uint32_t i, uint32_t j)
{
    i = root_of(parents, i);
    j = root_of(parents, j);
    parents[i < j ? j : i] = i < j ? i : j;
}

/* The connected parts of the vertices, those at equal places connected. */
static bool find_parts(const Mesh *mesh, uint32_t *parents, uint32_t *first)
{
    bool one = true;
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        parents[i] = i;
    for (size_t i = 0; i < mesh->index_count; i += 3) {
        unite(parents, mesh->indices[i], mesh->indices[i + 1]);
        unite(parents, mesh->indices[i], mesh->indices[i + 2]);
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        one &= root_of(parents, i) == 0;
    if (!one && !mesh_weld(mesh, false, first))
        return false;
    for (uint32_t i = 0; i < mesh->vertex_count && !one; i++)
        unite(parents, i, first[i]);
    return true;
}

/* Six times the volumes of the parts, at their roots, about a point of the mesh. */
static bool have_volume(const Mesh *mesh, uint32_t *parents, double *volumes)
{
    const Vec3 origin = vec3_from_float(mesh->vertices[0].position);
    for (size_t i = 0; i < mesh->index_count; i += 3) {
        Vec3 v[3];
        for (size_t k = 0; k < 3; k++)
            v[k] = vec3_subtract(vec3_from_float(mesh->vertices[mesh->indices[i + k]].position),
                                 origin);
        volumes[root_of(parents, mesh->indices[i])] += vec3_dot(v[0], vec3_cross(v[1], v[2]));
    }
    for (size_t i = 0; i < mesh->index_count; i++)
        if (!(volumes[root_of(parents, mesh->indices[i])] > 0))
            return false;
    return true;
}

bool scene_file_is_closed(const Mesh *mesh)
{
    uint64_t sum = 0, *places = calloc(mesh->vertex_count + 1, sizeof *places);
    for (size_t i = 0; i < mesh->vertex_count && places; i++)
        places[i] = mesh_hash(&mesh->vertices[i], false);
    for (size_t i = 0; i < mesh->index_count && places; i += 3) {
        const uint64_t a = places[mesh->indices[i]], b = places[mesh->indices[i + 1]];
        const uint64_t c = places[mesh->indices[i + 2]];
        sum += edge(a, b) + edge(b, c) + edge(c, a);
    }
    free(places);
    if (!places || sum || mesh->index_count == 0)
        return false;
    uint32_t *parents = calloc(2 * mesh->vertex_count + 1, sizeof *parents);
    double *volumes = calloc(mesh->vertex_count, sizeof *volumes);
    const bool closed = parents && volumes &&
                        find_parts(mesh, parents, parents + mesh->vertex_count) &&
                        have_volume(mesh, parents, volumes);
    free(volumes);
    free(parents);
    return closed;
}
