/*
 * glTF 2.0 as a scene. Nodes are walked from the scene's roots, each once, so that a cycle is
 * found.
 *
 * Lights are as KHR_lights_punctual has them: of an intensity I, a white surface that faces it
 * reflects I / pi. What our own files have besides is in `extras`.
 */
#include "scene/gltf.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.141592653589793, DEGREES = 57.29577951308232;

static size_t count_of(const Reading *reading, const char *list)
{
    return json_array_size(json_object_get(reading->gltf.root, list));
}

/* Lights and cameras */

/* A LightKind; -1: unknown. */
static int kind_of_light(const json_t *light)
{
    static const char *const types[] = {
        [LIGHT_DIRECTIONAL] = "directional", [LIGHT_POINT] = "point", [LIGHT_SPOT] = "spot"};
    const char *type = json_string_value(json_object_get(light, "type"));
    int kind = LIGHT_SPOT;
    while (kind >= 0 && !(type && strcmp(type, types[kind]) == 0))
        kind--;
    return kind;
}

static bool add_light(Reading *reading, const json_t *node, int number)
{
    const json_t *placed = gltf_extension(node, "KHR_lights_punctual");
    const json_int_t index = gltf_whole(placed, "light", -1);
    const json_t *all =
        json_object_get(gltf_extension(reading->gltf.root, "KHR_lights_punctual"), "lights");
    const json_t *from = index >= 0 ? json_array_get(all, (size_t)index) : NULL;
    if (!placed)
        return true;
    if (!from)
        return message_set(reading->gltf.reason, "lights %lld: there is none; the file has %zu",
                           (long long)index, json_array_size(all));
    const int kind = kind_of_light(from);
    const bool sun = kind == LIGHT_DIRECTIONAL, spot = kind == LIGHT_SPOT;
    const json_t *cone = json_object_get(from, "spot");
    const double inner = gltf_number(cone, "innerConeAngle", 0);
    const double outer = gltf_number(cone, "outerConeAngle", PI / 4);
    if (kind < 0)
        return message_set(reading->gltf.reason,
                           "lights %lld: its type must be directional, point or spot",
                           (long long)index);
    if (spot && !(inner >= 0 && inner <= outer && outer < PI / 2 + 1e-3)) /* rounded */
        return message_set(reading->gltf.reason,
                           "lights %lld: innerConeAngle %g and outerConeAngle %g: must be "
                           "0 <= inner <= outer <= pi / 2",
                           (long long)index, inner, outer);
    static const double FAR = 1e15; /* nothing is farther */
    const double range = gltf_number(from, "range", 0);
    FileLight *to = scene_file_add(reading->file, FILE_LIGHTS, reading->gltf.reason);
    if (!to)
        return false;
    const Vec3 color = vec3_scale(gltf_vector(from, "color", (Vec3){1, 1, 1}),
                                  gltf_number(from, "intensity", 1) / PI);
    gltf_name(to->name, json_object_get(from, "name") ? from : node);
    to->node = number;
    to->light = (Light){.kind = (LightKind)kind,
                        .direction = {0, 0, sun ? 1 : -1},
                        .diffuse = color,
                        .specular = color,
                        .cutoff = fmin(outer * DEGREES, 90),
                        .quadratic = !sun,
                        .range = sun || range > FAR ? 0 : fmax(range, 0)};
    if (spot)
        to->light.exponent = scene_file_spot_exponent(inner, outer);
    if (gltf_own(from)) {
        to->node = -1;
        gltf_fields(gltf_own(from), LIGHT_FIELDS, &to->light);
    } else {
        reading->file->photometric = true;
        scene_file_note(reading->file, to->light.exponent > 0, NOTE_SPOT);
    }
    return true;
}

static bool add_camera(Reading *reading, const json_t *node, int number)
{
    const json_int_t index = gltf_whole(node, "camera", -1);
    const json_t *from = index >= 0 ? gltf_item(&reading->gltf, "cameras", index) : NULL;
    const json_t *flat = json_object_get(from, "orthographic"),
                 *lens = json_object_get(from, flat ? "orthographic" : "perspective");
    if (!from)
        return index < 0;
    FileCamera *to = scene_file_add(reading->file, FILE_CAMERAS, reading->gltf.reason);
    if (!to)
        return false;
    gltf_name(to->name, from);
    gltf_name(to->place, node);
    to->node = number;
    to->half_height = flat && !gltf_own(from) ? fabs(gltf_number(lens, "ymag", 1)) : 0;
    to->camera = (Camera){.center = {0, 0, -1},
                          .up = {0, 1, 0},
                          .fovy = DEGREES * gltf_number(lens, "yfov", 0.8),
                          .near = gltf_number(lens, "znear", 0),
                          .far = fmax(gltf_number(lens, "zfar", 0), 0)};
    scene_file_note(reading->file, flat, NOTE_ORTHOGRAPHIC);
    if (gltf_own(from)) {
        to->node = -1;
        gltf_fields(gltf_own(from), CAMERA_FIELDS, &to->camera);
    }
    return true;
}

/* Nodes */

static void place_node(const json_t *from, FileNode *to)
{
    double m[16], v[4];
    to->translation = gltf_vector(from, "translation", (Vec3){0, 0, 0});
    to->scale = gltf_vector(from, "scale", (Vec3){1, 1, 1});
    to->rotation = (Vec4){0, 0, 0, 1};
    if (gltf_numbers(from, "rotation", 4, v))
        to->rotation = (Vec4){v[0], v[1], v[2], v[3]};
    to->parent_from_node = scene_file_moved(to);
    if (gltf_numbers(from, "matrix", 16, m))
        memcpy(to->parent_from_node.m, m, sizeof m);
}

/* A node that is to be visited, from the parent in the SceneFile. */
typedef struct Visit {
    json_int_t node;
    int parent;
} Visit;

typedef struct Visits {
    Visit *all;
    size_t count;
} Visits;

/* In their order: the last of the list is visited first. */
static void push_all(Visits *visits, const json_t *list, int parent)
{
    const size_t count = json_array_size(list);
    visits->all = memory_grow(visits->all, visits->count + count + 1, sizeof *visits->all);
    for (size_t i = count; i-- > 0;) {
        const json_t *item = json_array_get(list, i);
        visits->all[visits->count++] =
            (Visit){json_is_integer(item) ? json_integer_value(item) : -1, parent};
    }
}

static bool visit(Reading *reading, Visit now, Visits *visits)
{
    const json_t *node = gltf_item(&reading->gltf, "nodes", now.node);
    if (!node)
        return false;
    if (reading->nodes[now.node] >= 0)
        return message_set(reading->gltf.reason,
                           "nodes %lld: is reached twice: it has two parents, or is its own",
                           (long long)now.node);
    FileNode *added = scene_file_add(reading->file, FILE_NODES, reading->gltf.reason);
    if (!added)
        return false;
    const int number = reading->nodes[now.node] = reading->file->node_count - 1;
    added->parent = now.parent;
    place_node(node, added);
    scene_file_note(reading->file, gltf_extension(node, "EXT_mesh_gpu_instancing"), NOTE_INSTANCES);
    push_all(visits, json_object_get(node, "children"), number);
    return gltf_add_objects(reading, node, number) && add_light(reading, node, number) &&
           add_camera(reading, node, number);
}

/* The roots of the scene; of a file without scenes all nodes that are no children. */
static json_t *find_roots(const Reading *reading)
{
    const json_t *nodes = json_object_get(reading->gltf.root, "nodes");
    const size_t count = json_array_size(nodes);
    if (count_of(reading, "scenes")) {
        const json_t *scene =
            gltf_item(&reading->gltf, "scenes", gltf_whole(reading->gltf.root, "scene", 0));
        return json_incref(json_object_get(scene, "nodes"));
    }
    bool *child = memory_new(count + 1, sizeof *child);
    json_t *roots = json_array();
    for (size_t i = 0; i < count; i++) {
        const json_t *list = json_object_get(json_array_get(nodes, i), "children");
        for (size_t k = 0; k < json_array_size(list); k++) {
            const json_int_t number = json_integer_value(json_array_get(list, k));
            if (number >= 0 && number < (json_int_t)count)
                child[number] = true;
        }
    }
    for (size_t i = 0; i < count; i++)
        if (!child[i])
            json_array_append_new(roots, json_integer((json_int_t)i));
    free(child);
    return roots;
}

static bool read_nodes(Reading *reading)
{
    Visits visits = {.count = 0};
    json_t *roots = find_roots(reading);
    FileNode *world = scene_file_add(reading->file, FILE_NODES, NULL);
    *world = (FileNode){.parent = -1, .parent_from_node = mat4_identity()};
    push_all(&visits, roots, 0);
    while (visits.count > 0 && !gltf_failed(reading))
        visit(reading, visits.all[--visits.count], &visits);
    json_decref(roots);
    free(visits.all);
    if (!gltf_failed(reading) && reading->file->node_count == 1)
        message_set(reading->gltf.reason, "its scene has no nodes");
    return !gltf_failed(reading);
}

/* Animations: the first */

static bool add_channel(Reading *reading, const json_t *channel, const json_t *samplers)
{
    static const char *const paths[] = {"translation", "rotation", "scale"};
    const json_t *target = json_object_get(channel, "target");
    const json_int_t node = gltf_whole(target, "node", -1);
    const json_int_t sampler = gltf_whole(channel, "sampler", -1);
    const json_t *from = sampler >= 0 ? json_array_get(samplers, (size_t)sampler) : NULL;
    const char *path = json_string_value(json_object_get(target, "path"));
    const char *step = json_string_value(json_object_get(from, "interpolation"));
    int kind = 0, sizes[2] = {0};
    size_t counts[2] = {0};
    while (kind < 3 && (!path || strcmp(path, paths[kind]) != 0))
        kind++;
    if (kind == 3 || !from || node < 0 || node >= (json_int_t)count_of(reading, "nodes") ||
        reading->nodes[node] < 0)
        return true; /* weights of morph targets; a node that is not drawn */
    const size_t cubic = step && strcmp(step, "CUBICSPLINE") == 0 ? 3 : 1;
    double *times =
        gltf_accessor(&reading->gltf, gltf_whole(from, "input", -1), &counts[0], &sizes[0]);
    double *values =
        times ? gltf_accessor(&reading->gltf, gltf_whole(from, "output", -1), &counts[1], &sizes[1])
              : NULL;
    const FileChannel made = {.node = reading->nodes[node],
                              .path = kind,
                              .step = cubic == 3                          ? FILE_CUBIC
                                      : step && strcmp(step, "STEP") == 0 ? FILE_STEP
                                                                          : FILE_LINEAR,
                              .count = (int)counts[0]};
    const size_t numbers = counts[1] * (size_t)sizes[1];
    float *keys = NULL;
    if (values &&
        (sizes[0] != 1 || counts[1] != cubic * counts[0] || sizes[1] != (kind == 1 ? 4 : 3)))
        message_set(reading->gltf.reason, "an animation's input and output do not match");
    else if (values)
        keys = scene_file_add_channel(reading->file, made, numbers, reading->gltf.reason);
    for (size_t i = 0; keys && i < counts[0] + numbers; i++)
        keys[i] = (float)(i < counts[0] ? times[i] : values[i - counts[0]]);
    free(times);
    free(values);
    return !gltf_failed(reading);
}

static bool read_animation(Reading *reading)
{
    const size_t count = count_of(reading, "animations");
    const json_t *first = count ? gltf_item(&reading->gltf, "animations", 0) : NULL;
    const json_t *channels = json_object_get(first, "channels");
    for (size_t i = 1; i < count; i++)
        scene_file_note(reading->file, true, NOTE_ANIMATION);
    for (size_t i = 0; i < json_array_size(channels); i++)
        if (!add_channel(reading, json_array_get(channels, i), json_object_get(first, "samplers")))
            return false;
    return !gltf_failed(reading);
}

bool gltf_read(const char *path, SceneFile *file, bool *other, Message *reason)
{
    Reading reading = {.file = file};
    bool read = gltf_open(&reading.gltf, path, other, reason);
    if (read) {
        const size_t nodes = count_of(&reading, "nodes");
        const json_t *scene = json_array_get(json_object_get(reading.gltf.root, "scenes"),
                                             (size_t)gltf_whole(reading.gltf.root, "scene", 0));
        reading.nodes = memory_new(nodes + 1, sizeof *reading.nodes);
        reading.meshes = memory_new(count_of(&reading, "meshes") + 1, sizeof *reading.meshes);
        reading.means = memory_new(count_of(&reading, "textures") + 1, sizeof *reading.means);
        for (size_t i = 0; i < nodes; i++)
            reading.nodes[i] = -1;
        for (size_t i = 0; i < count_of(&reading, "textures"); i++)
            reading.means[i].x = -1;
        file->scene.linear = true;
        file->own = gltf_own(scene) != NULL;
        gltf_fields(gltf_own(scene), SCENE_FIELDS, &file->scene);
        read = read_nodes(&reading) && read_animation(&reading);
        for (size_t i = 0; i < count_of(&reading, "meshes"); i++)
            free(reading.meshes[i]);
        free(reading.meshes);
        free(reading.means);
        free(reading.nodes);
    }
    gltf_close(&reading.gltf);
    return read;
}
