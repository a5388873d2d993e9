/*
 * glTF 2.0 as a scene. Nodes are walked from the scene's roots, each once, so that a cycle is
 * found. Of its materials, which have a base colour, metal and roughness, the lighting model has
 * what it can show: a metal has no diffuse and a coloured specular reflection, all else one of
 * 0.04; the highlight's exponent is 2 / roughness^4 - 2, and it is as high as the same light spread
 * over it makes it, (exponent + 8) / 8. (glTF 2.0, appendix B; Walter et al., Microfacet models for
 * refraction through rough surfaces, EGSR 2007; Akenine-Moeller et al., Real-time rendering, 3rd
 * ed., 7.6)
 *
 * Lights are as KHR_lights_punctual has them: of an intensity I, a white surface that faces it
 * reflects I / pi. What our own files have besides is in `extras`.
 */
#ifdef HAVE_JANSSON
#include "scene/gltf_data.h"
#endif
#include "core/mesh_make.h"
#include "scene/model_module.h"

#ifdef HAVE_JANSSON
#include "base/memory.h"
#include "scene/scene_fields.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.141592653589793, DEGREES = 57.29577951308232;

/* A file that is read: which node and mesh of the SceneFile are the file's. */
typedef struct Reading {
    Gltf gltf;
    SceneFile *file;
    int *nodes;   /* by the file's number; -1: not reached */
    int **meshes; /* by the file's number and primitive; -1: not read yet, -2: no triangles */
    size_t vertices, indices;
} Reading;

static bool failed(const Reading *reading)
{
    return reading->gltf.reason->text[0];
}

static size_t count_of(const Reading *reading, const char *list)
{
    return json_array_size(json_object_get(reading->gltf.root, list));
}

static bool too_many(const Reading *reading, const char *what)
{
    return message_set(reading->gltf.reason, "more than %d %s", FILE_ITEMS_MAX, what);
}

static Vec3 vector_of(const json_t *object, const char *key, Vec3 usual)
{
    double v[4];
    return gltf_numbers(object, key, 3, v) || gltf_numbers(object, key, 4, v)
               ? (Vec3){v[0], v[1], v[2]}
               : usual;
}

static Vec3 within_one(Vec3 c)
{
    return (Vec3){fmin(fmax(c.x, 0), 1), fmin(fmax(c.y, 0), 1), fmin(fmax(c.z, 0), 1)};
}

static void read_fields(const json_t *object, const Field *fields, void *to)
{
    for (; json_is_object(object) && fields->name; fields++) {
        void *place = (char *)to + fields->place;
        const json_t *value = json_object_get(object, fields->name);
        if (!value)
            continue;
        if (fields->kind == FIELD_NUMBER)
            *(double *)place = gltf_number(object, fields->name, 0);
        else if (fields->kind == FIELD_VECTOR)
            *(Vec3 *)place = vector_of(object, fields->name, (Vec3){0, 0, 0});
        else if (fields->kind == FIELD_WHOLE)
            *(int *)place = (int)gltf_whole(object, fields->name, 0);
        else
            *(bool *)place = json_is_true(value);
    }
}

/* What our own files have besides; NULL: nothing. */
static const json_t *own_fields(const json_t *object)
{
    return json_object_get(json_object_get(object, "extras"), FIELDS_MEMBER);
}

static void set_name(char name[FILE_NAME], const json_t *object)
{
    const char *text = json_string_value(json_object_get(object, "name"));
    snprintf(name, FILE_NAME, "%s", text ? text : "");
}

/* Materials */

static void note_material(const Reading *reading, const json_t *material)
{
    const json_t *value;
    const char *key, *mode = json_string_value(json_object_get(material, "alphaMode"));
    bool textures = false;
    if (mode && strcmp(mode, "OPAQUE") != 0)
        scene_file_note(reading->file, NOTE_TRANSPARENT);
    json_object_foreach(json_object_get(material, "pbrMetallicRoughness"), key, value) textures |=
        strstr(key, "Texture") != NULL;
    json_object_foreach((json_t *)material, key, value) textures |= strstr(key, "Texture") != NULL;
    if (textures)
        scene_file_note(reading->file, NOTE_TEXTURES);
    json_object_foreach(json_object_get(material, "extensions"), key, value)
    {
        char text[120];
        if (strcmp(key, "KHR_materials_unlit") == 0 ||
            strcmp(key, "KHR_materials_emissive_strength") == 0 ||
            strcmp(key, "KHR_materials_pbrSpecularGlossiness") == 0)
            continue;
        snprintf(text, sizeof text, "%.60s: left out", key);
        scene_file_note(reading->file, text);
    }
}

/* A highlight of this reflectance and roughness. */
static void set_highlight(Material *to, Vec3 reflectance, double roughness)
{
    const double a = fmax(roughness * roughness, 1e-3);
    to->shininess = fmin(fmax(2 / (a * a) - 2, 1), 128);
    to->specular = within_one(vec3_scale(reflectance, (to->shininess + 8) / 8));
}

static void set_material(const Reading *reading, const json_t *from, Object *object)
{
    static const Vec3 white = {1, 1, 1};
    const json_t *pbr = json_object_get(from, "pbrMetallicRoughness");
    const json_t *gloss = gltf_extension(from, "KHR_materials_pbrSpecularGlossiness");
    const char *mode = json_string_value(json_object_get(from, "alphaMode"));
    const double metal = fmin(fmax(gltf_number(pbr, "metallicFactor", 1), 0), 1);
    double color[4] = {1, 1, 1, 1};
    Material *to = &object->front;
    if (!gltf_numbers(gloss, "diffuseFactor", 4, color))
        gltf_numbers(pbr, "baseColorFactor", 4, color);
    const Vec3 base = within_one((Vec3){color[0], color[1], color[2]});
    *to = (Material){.alpha = mode && strcmp(mode, "BLEND") == 0 ? fmin(fmax(color[3], 0), 1) : 1,
                     .diffuse = gloss ? base : vec3_scale(base, 1 - metal)};
    if (gloss)
        set_highlight(to, vector_of(gloss, "specularFactor", white),
                      1 - gltf_number(gloss, "glossinessFactor", 1));
    else
        set_highlight(to, vec3_add(vec3_scale(white, 0.04 * (1 - metal)), vec3_scale(base, metal)),
                      gltf_number(pbr, "roughnessFactor", 1));
    to->ambient = base; /* a metal reflects its surroundings */
    to->emission =
        within_one(vec3_scale(vector_of(from, "emissiveFactor", (Vec3){0, 0, 0}),
                              gltf_number(gltf_extension(from, "KHR_materials_emissive_strength"),
                                          "emissiveStrength", 1)));
    if (gltf_extension(from, "KHR_materials_unlit"))
        *to = (Material){.emission = base, .alpha = to->alpha};
    object->two_sided = json_is_true(json_object_get(from, "doubleSided"));
    object->back = *to;
    if (from)
        note_material(reading, from);
}

/* Meshes */

/* The corners of a primitive's triangles, three each, to be freed; NULL: none, or it failed. */
static uint32_t *read_corners(Reading *reading, const json_t *primitive, size_t vertices,
                              size_t *count)
{
    const json_int_t mode = gltf_whole(primitive, "mode", 4);
    const json_int_t accessor = gltf_whole(primitive, "indices", -1);
    int size = 1;
    *count = vertices;
    double *list = accessor >= 0 ? gltf_accessor(&reading->gltf, accessor, count, &size) : NULL;
    if (failed(reading) || mode < 4 || *count < 3) {
        free(list);
        return NULL;
    }
    const size_t triangles = mode == 4 ? *count / 3 : *count - 2;
    uint32_t *corners = memory_new(3 * triangles, sizeof *corners);
    for (size_t i = 0; i < 3 * triangles; i++) {
        const size_t t = i / 3, k = i % 3;
        const size_t at = mode == 4   ? i
                          : mode == 5 ? t + (k == 0 || t % 2 == 0 ? k : 3 - k)
                                      : (k == 0 ? 0 : t + k);
        const double index = list ? list[at * (size_t)size] : (double)at;
        if (!(index >= 0 && index < (double)vertices)) {
            message_set(reading->gltf.reason, "accessors %lld: index %g; there are %zu vertices",
                        (long long)accessor, index, vertices);
            break;
        }
        corners[i] = (uint32_t)index;
    }
    free(list);
    *count = 3 * triangles;
    return corners;
}

/* One attribute of the vertices; NULL: it has none, or it failed. */
static double *read_attribute(Reading *reading, const json_t *primitive, const char *name,
                              size_t vertices, int *size)
{
    const json_int_t accessor = gltf_whole(json_object_get(primitive, "attributes"), name, -1);
    size_t count = 0;
    double *numbers = accessor >= 0 ? gltf_accessor(&reading->gltf, accessor, &count, size) : NULL;
    if (numbers && (*size < 3 || *size > 4 || (vertices && count != vertices))) {
        message_set(reading->gltf.reason, "accessors %lld: no %s of %zu vertices",
                    (long long)accessor, name, vertices ? vertices : count);
        free(numbers);
        return NULL;
    }
    return numbers;
}

static double *read_positions(Reading *reading, const json_t *primitive, size_t *count)
{
    const json_int_t accessor =
        gltf_whole(json_object_get(primitive, "attributes"), "POSITION", -1);
    int size = 0;
    if (accessor < 0)
        return NULL;
    double *positions = gltf_accessor(&reading->gltf, accessor, count, &size);
    if (positions && size != 3)
        message_set(reading->gltf.reason, "accessors %lld: positions must be VEC3",
                    (long long)accessor);
    return positions;
}

static void copy3(float to[3], const double *from)
{
    for (int k = 0; k < 3; k++)
        to[k] = (float)from[k];
}

/* Of a primitive. */
typedef struct Attributes {
    double *positions, *normals, *colors, *lit;
    int normal_size, color_size, lit_size;
    Vec3 tint;
} Attributes;

static void set_vertex(Mesh *mesh, size_t to, const Attributes *from, size_t i)
{
    copy3(mesh->vertices[to].position, from->positions + 3 * i);
    if (from->normals)
        copy3(mesh->vertices[to].normal, from->normals + (size_t)from->normal_size * i);
    if (from->lit)
        copy3(mesh->lit_positions[to], from->lit + (size_t)from->lit_size * i);
    if (from->colors) {
        const double *c = from->colors + (size_t)from->color_size * i;
        vec3_to_float(
            within_one((Vec3){c[0] * from->tint.x, c[1] * from->tint.y, c[2] * from->tint.z}),
            mesh->colors[to]);
    }
}

/* Vertices that corners use, in the order of their first use; without normals each triangle has
 * its own, as glTF 2.0 has it (3.7.2.1). */
static bool fill_mesh(const Attributes *from, const uint32_t *corners, size_t count,
                      size_t vertices, Mesh *mesh, Message *reason)
{
    const bool apart = !from->normals;
    uint32_t *used = calloc(vertices + 1, sizeof *used);
    size_t next = 0;
    if (!used || !mesh_open(mesh, apart || vertices > count ? count : vertices, count, reason) ||
        (from->colors && !mesh_open_colors(mesh, reason)) ||
        (from->lit && !(mesh->lit_positions = calloc(count + 1, sizeof *mesh->lit_positions)))) {
        free(used);
        return message_set(reason, "not enough memory for %zu vertices", vertices);
    }
    for (size_t i = 0; i < count; i++) {
        uint32_t *seen = &used[corners[i]];
        if (apart || !*seen) {
            set_vertex(mesh, next, from, corners[i]);
            *seen = (uint32_t)++next;
        }
        mesh->indices[i] = *seen - 1;
    }
    mesh->vertex_count = next;
    free(used);
    for (size_t i = 0; i < count && apart; i += 3) {
        Vec3 normal;
        mesh_face(mesh, i / 3, &normal);
        for (size_t k = 0; k < 3; k++)
            vec3_to_float(normal, mesh->vertices[i + k].normal);
    }
    return true;
}

/* A primitive as a mesh of the SceneFile; -2: it has no triangles, or it failed. */
static int read_primitive(Reading *reading, const json_t *primitive, Vec3 tint)
{
    Attributes from = {.tint = tint};
    size_t vertices = 0, count = 0;
    Mesh *mesh = NULL;
    if (gltf_extension(primitive, "KHR_draco_mesh_compression") &&
        !json_object_get(primitive, "indices"))
        message_set(reading->gltf.reason, "its meshes are compressed by Draco; save it without");
    from.positions = read_positions(reading, primitive, &vertices);
    uint32_t *corners = from.positions ? read_corners(reading, primitive, vertices, &count) : NULL;
    if (corners && !failed(reading)) {
        from.normals = read_attribute(reading, primitive, "NORMAL", vertices, &from.normal_size);
        from.colors = read_attribute(reading, primitive, "COLOR_0", vertices, &from.color_size);
        from.lit = read_attribute(reading, primitive, "_LIT_POSITION", vertices, &from.lit_size);
        reading->indices += count;
        reading->vertices += from.normals && vertices < count ? vertices : count;
        if (reading->vertices > MODEL_VERTICES_MAX || reading->indices / 3 > MODEL_TRIANGLES_MAX)
            message_set(reading->gltf.reason, "more than %d vertices or %d triangles",
                        MODEL_VERTICES_MAX, MODEL_TRIANGLES_MAX);
        else if (!failed(reading) && !(mesh = scene_file_add(reading->file, FILE_MESHES)))
            too_many(reading, "meshes");
    }
    if (mesh)
        fill_mesh(&from, corners, count, vertices, mesh, reading->gltf.reason);
    free(from.positions);
    free(from.normals);
    free(from.colors);
    free(from.lit);
    free(corners);
    return mesh && !failed(reading) ? reading->file->mesh_count - 1 : -2;
}

static void set_own(const json_t *own, Object *object)
{
    if (!own)
        return;
    read_fields(own, OBJECT_FIELDS, object);
    read_fields(json_object_get(own, "solid"), SOLID_FIELDS, &object->solid);
    read_fields(json_object_get(own, "front"), MATERIAL_FIELDS, &object->front);
    read_fields(json_object_get(own, "back"), MATERIAL_FIELDS, &object->back);
}

/* The objects of a node's mesh, one for each primitive. */
static bool add_objects(Reading *reading, const json_t *node, int number)
{
    const json_int_t index = gltf_whole(node, "mesh", -1);
    const json_t *mesh = index >= 0 ? gltf_item(&reading->gltf, "meshes", index) : NULL;
    const json_t *list = json_object_get(mesh, "primitives");
    const size_t count = json_array_size(list);
    if (mesh && !reading->meshes[index]) {
        reading->meshes[index] = memory_new(count + 1, sizeof **reading->meshes);
        for (size_t i = 0; i < count; i++)
            reading->meshes[index][i] = -1;
    }
    for (size_t i = 0; i < count && !failed(reading); i++) {
        const json_t *primitive = json_array_get(list, i);
        const json_int_t material = gltf_whole(primitive, "material", -1);
        int *known = &reading->meshes[index][i];
        FileObject object = {.node = number};
        set_material(reading,
                     material >= 0 ? gltf_item(&reading->gltf, "materials", material) : NULL,
                     &object.object);
        if (*known == -1 && !failed(reading))
            *known = read_primitive(reading, primitive, object.object.front.ambient);
        if (*known == -2)
            scene_file_note(reading->file, NOTE_LINES);
        if (failed(reading) || *known < 0)
            continue;
        FileObject *added = scene_file_add(reading->file, FILE_OBJECTS);
        if (!added)
            return too_many(reading, "objects");
        object.mesh = *known;
        set_name(object.name, json_object_get(node, "name") ? node : mesh);
        set_own(own_fields(node), &object.object);
        *added = object;
        if (json_object_get(node, "skin"))
            scene_file_note(reading->file, NOTE_SKIN);
        if (json_object_get(primitive, "targets"))
            scene_file_note(reading->file, NOTE_MORPH);
    }
    return !failed(reading);
}

/* Lights and cameras */

static bool add_light(Reading *reading, const json_t *node, int number)
{
    const json_int_t index = gltf_whole(gltf_extension(node, "KHR_lights_punctual"), "light", -1);
    const json_t *all =
        json_object_get(gltf_extension(reading->gltf.root, "KHR_lights_punctual"), "lights");
    const json_t *from = index >= 0 ? json_array_get(all, (size_t)index) : NULL;
    if (index < 0)
        return true;
    if (!from)
        return message_set(reading->gltf.reason, "lights %lld: there is none; the file has %zu",
                           (long long)index, json_array_size(all));
    const char *type = json_string_value(json_object_get(from, "type"));
    const bool sun = type && strcmp(type, "directional") == 0,
               spot = type && strcmp(type, "spot") == 0;
    const json_t *cone = json_object_get(from, "spot");
    const double outer = gltf_number(cone, "outerConeAngle", PI / 4);
    FileLight *to = scene_file_add(reading->file, FILE_LIGHTS);
    if (!to)
        return too_many(reading, "lights");
    const Vec3 color = vec3_scale(vector_of(from, "color", (Vec3){1, 1, 1}),
                                  gltf_number(from, "intensity", 1) / PI);
    set_name(to->name, json_object_get(from, "name") ? from : node);
    to->node = number;
    to->range = sun ? 0 : gltf_number(from, "range", 0);
    to->light = (Light){.kind = sun    ? LIGHT_DIRECTIONAL
                                : spot ? LIGHT_SPOT
                                       : LIGHT_POINT,
                        .direction = {0, 0, sun ? 1 : -1},
                        .diffuse = color,
                        .specular = color,
                        .cutoff = fmin(outer * DEGREES, 90),
                        .quadratic = !sun};
    if (spot)
        to->light.exponent =
            scene_file_spot_exponent(gltf_number(cone, "innerConeAngle", 0), outer);
    if (own_fields(from)) {
        to->node = -1;
        read_fields(own_fields(from), LIGHT_FIELDS, &to->light);
    } else {
        reading->file->photometric = true;
        if (to->light.exponent > 0)
            scene_file_note(reading->file, NOTE_SPOT);
    }
    return true;
}

static bool add_camera(Reading *reading, const json_t *node, int number)
{
    static const double AWAY = 100; /* an orthographic view, in its half heights */
    const json_int_t index = gltf_whole(node, "camera", -1);
    const json_t *from = index >= 0 ? gltf_item(&reading->gltf, "cameras", index) : NULL;
    const json_t *flat = json_object_get(from, "orthographic"),
                 *lens = json_object_get(from, flat ? "orthographic" : "perspective");
    if (!from)
        return index < 0;
    FileCamera *to = scene_file_add(reading->file, FILE_CAMERAS);
    if (!to)
        return too_many(reading, "cameras");
    const double half = gltf_number(lens, "ymag", 1), away = flat ? AWAY * half : 0;
    const double far = gltf_number(lens, "zfar", 0);
    set_name(to->name, json_object_get(node, "name") ? node : from);
    to->node = number;
    to->camera = (Camera){.eye = {0, 0, away},
                          .center = {0, 0, -1},
                          .up = {0, 1, 0},
                          .fovy = flat ? 2 * DEGREES * atan(1 / AWAY)
                                       : DEGREES * gltf_number(lens, "yfov", 0.8),
                          .near = gltf_number(lens, "znear", 0) + away,
                          .far = far > 0 ? far + away : 0};
    if (flat)
        scene_file_note(reading->file, NOTE_ORTHOGRAPHIC);
    if (own_fields(from)) {
        to->node = -1;
        read_fields(own_fields(from), CAMERA_FIELDS, &to->camera);
    }
    return true;
}

/* Nodes */

static void place_node(const json_t *from, FileNode *to)
{
    double m[16], v[4];
    to->translation = vector_of(from, "translation", (Vec3){0, 0, 0});
    to->scale = vector_of(from, "scale", (Vec3){1, 1, 1});
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
    FileNode *added = scene_file_add(reading->file, FILE_NODES);
    if (!added)
        return too_many(reading, "nodes");
    const int number = reading->nodes[now.node] = reading->file->node_count - 1;
    added->parent = now.parent;
    place_node(node, added);
    if (gltf_extension(node, "EXT_mesh_gpu_instancing"))
        scene_file_note(reading->file, NOTE_INSTANCES);
    push_all(visits, json_object_get(node, "children"), number);
    return add_objects(reading, node, number) && add_light(reading, node, number) &&
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
    FileNode *world = scene_file_add(reading->file, FILE_NODES);
    *world = (FileNode){.parent = -1, .parent_from_node = mat4_identity()};
    push_all(&visits, roots, 0);
    while (visits.count > 0 && !failed(reading))
        visit(reading, visits.all[--visits.count], &visits);
    json_decref(roots);
    free(visits.all);
    if (!failed(reading) && reading->file->node_count == 1)
        message_set(reading->gltf.reason, "its scene has no nodes");
    return !failed(reading);
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
    FileChannel *to = NULL;
    if (values &&
        (sizes[0] != 1 || counts[1] != cubic * counts[0] || sizes[1] != (kind == 1 ? 4 : 3)))
        message_set(reading->gltf.reason, "an animation's input and output do not match");
    else if (values && !(to = scene_file_add(reading->file, FILE_CHANNELS)))
        too_many(reading, "channels");
    if (to) {
        *to = (FileChannel){reading->nodes[node], kind,
                            cubic == 3                          ? FILE_CUBIC
                            : step && strcmp(step, "STEP") == 0 ? FILE_STEP
                                                                : FILE_LINEAR,
                            (int)counts[0], reading->file->key_count};
        reading->file->nodes[to->node].moving = true;
        const size_t numbers = counts[1] * (size_t)sizes[1];
        for (size_t i = 0; i < counts[0] + numbers && !failed(reading); i++) {
            float *key = scene_file_add(reading->file, FILE_KEYS);
            if (!key)
                message_set(reading->gltf.reason, "more than %d keys of animations", FILE_KEYS_MAX);
            else
                *key = (float)(i < counts[0] ? times[i] : values[i - counts[0]]);
        }
    }
    free(times);
    free(values);
    return !failed(reading);
}

static bool read_animation(Reading *reading)
{
    const size_t count = count_of(reading, "animations");
    const json_t *first = count ? gltf_item(&reading->gltf, "animations", 0) : NULL;
    const json_t *channels = json_object_get(first, "channels");
    for (size_t i = 1; i < count; i++)
        scene_file_note(reading->file, NOTE_ANIMATION);
    for (size_t i = 0; i < json_array_size(channels); i++)
        if (!add_channel(reading, json_array_get(channels, i), json_object_get(first, "samplers")))
            return false;
    return !failed(reading);
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
        for (size_t i = 0; i < nodes; i++)
            reading.nodes[i] = -1;
        file->scene.linear = true;
        read_fields(own_fields(scene), SCENE_FIELDS, &file->scene);
        read = read_nodes(&reading) && read_animation(&reading);
        for (size_t i = 0; i < count_of(&reading, "meshes"); i++)
            free(reading.meshes[i]);
        free(reading.meshes);
        free(reading.nodes);
    }
    gltf_close(&reading.gltf);
    return read;
}

#else

/* Without jansson Assimp reads it. */
bool gltf_read(const char *path, SceneFile *file, bool *other, Message *reason)
{
    (void)path, (void)file, (void)reason;
    *other = true;
    return false;
}

#endif
