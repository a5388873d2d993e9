/*
 * Meshes and materials of glTF 2.0. Materials have a base colour, metal and roughness; the lighting
 * model has of them what it can show: a metal has no diffuse and a coloured specular reflection,
 * all else one of 0.04; the highlight's exponent is 2 / roughness^4 - 2, and it is as high as the
 * same light spread over it makes it, (exponent + 8) / 8. (glTF 2.0, appendix B; Walter et al.,
 * Microfacet models for refraction through rough surfaces, EGSR 2007; Akenine-Moeller et al.,
 * Real-time rendering, 3rd ed., 7.6)
 */
#include "scene/gltf.h"

#include "base/memory.h"
#include "core/mesh_make.h"
#include "scene/texture_mean.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What both share */

bool gltf_failed(const Reading *reading)
{
    return reading->gltf.reason->text[0];
}

Vec3 gltf_vector(const json_t *object, const char *key, Vec3 usual)
{
    double v[4];
    return gltf_numbers(object, key, 3, v) || gltf_numbers(object, key, 4, v)
               ? (Vec3){v[0], v[1], v[2]}
               : usual;
}

void gltf_fields(const json_t *object, const Field *fields, void *to)
{
    for (; json_is_object(object) && fields->name; fields++) {
        void *place = (char *)to + fields->place;
        const json_t *value = json_object_get(object, fields->name);
        if (!value)
            continue;
        if (fields->kind == FIELD_NUMBER)
            *(double *)place = gltf_number(object, fields->name, 0);
        else if (fields->kind == FIELD_VECTOR)
            *(Vec3 *)place = gltf_vector(object, fields->name, (Vec3){0, 0, 0});
        else if (fields->kind == FIELD_WHOLE)
            *(int *)place = (int)gltf_whole(object, fields->name, 0);
        else
            *(bool *)place = json_is_true(value);
    }
}

const json_t *gltf_own(const json_t *object)
{
    return json_object_get(json_object_get(object, "extras"), FIELDS_MEMBER);
}

void gltf_name(char name[FILE_NAME], const json_t *object)
{
    const char *text = json_string_value(json_object_get(object, "name"));
    snprintf(name, FILE_NAME, "%s", text ? text : "");
}

/* Materials */

static void note_material(const Reading *reading, const json_t *material)
{
    const json_t *value;
    const char *key, *mode = json_string_value(json_object_get(material, "alphaMode"));
    bool textures = false, base = false;
    scene_file_note(reading->file, mode && strcmp(mode, "OPAQUE") != 0, NOTE_TRANSPARENT);
    json_object_foreach(json_object_get(material, "pbrMetallicRoughness"), key, value) *
        (strcmp(key, "baseColorTexture") == 0 ? &base : &textures) |=
        strstr(key, "Texture") != NULL;
    json_object_foreach((json_t *)material, key, value) textures |= strstr(key, "Texture") != NULL;
    scene_file_note(reading->file, base, NOTE_MEAN);
    scene_file_note(reading->file, textures, NOTE_TEXTURES);
    json_object_foreach(json_object_get(material, "extensions"), key, value)
    {
        char text[120];
        if (strcmp(key, "KHR_materials_unlit") == 0 ||
            strcmp(key, "KHR_materials_emissive_strength") == 0 ||
            strcmp(key, "KHR_materials_pbrSpecularGlossiness") == 0)
            continue;
        snprintf(text, sizeof text, "%.60s: left out", key);
        scene_file_note(reading->file, true, text);
    }
}

/* Of the texture of a base colour; white: it has none. */
static Vec3 texture_color(Reading *reading, const json_t *texture)
{
    const json_int_t index = gltf_whole(texture, "index", -1);
    const size_t count = json_array_size(json_object_get(reading->gltf.root, "textures"));
    Message why = {0};
    char name[40];
    size_t size = 0;
    if (!texture)
        return (Vec3){1, 1, 1};
    snprintf(name, sizeof name, "texture %lld", (long long)index);
    const bool known = index >= 0 && index < (json_int_t)count;
    if (!known)
        message_set(&why, "there is none");
    else if (reading->means[index].x >= 0)
        return reading->means[index];
    char *bytes = known ? gltf_texture(&reading->gltf, index, &size, &why) : NULL;
    const Vec3 mean = texture_mean(reading->file, name, bytes, size, &why);
    if (known)
        reading->means[index] = mean;
    return mean;
}

/* A highlight of this reflectance and roughness. */
static void set_highlight(Material *to, Vec3 reflectance, double roughness)
{
    const double a = fmax(roughness * roughness, 1e-3);
    to->shininess = fmin(fmax(2 / (a * a) - 2, 1), 128);
    to->specular = color_within_one(vec3_scale(reflectance, (to->shininess + 8) / 8));
}

/* With colours at the vertices, which are diffuse, none is a metal or unlit. */
static void set_material(Reading *reading, const json_t *from, bool colored, Object *object)
{
    static const Vec3 white = {1, 1, 1};
    const json_t *pbr = json_object_get(from, "pbrMetallicRoughness");
    const json_t *gloss = gltf_extension(from, "KHR_materials_pbrSpecularGlossiness");
    const char *mode = json_string_value(json_object_get(from, "alphaMode"));
    const double factor = fmin(fmax(gltf_number(pbr, "metallicFactor", 1), 0), 1);
    const double metal = colored ? 0 : factor;
    const bool unlit = gltf_extension(from, "KHR_materials_unlit");
    double color[4] = {1, 1, 1, 1};
    Material *to = &object->front;
    if (!gltf_numbers(gloss, "diffuseFactor", 4, color))
        gltf_numbers(pbr, "baseColorFactor", 4, color);
    const Vec3 mean = texture_color(reading, gloss ? json_object_get(gloss, "diffuseTexture")
                                                   : json_object_get(pbr, "baseColorTexture"));
    const Vec3 base =
        color_within_one((Vec3){color[0] * mean.x, color[1] * mean.y, color[2] * mean.z});
    *to = (Material){.alpha = mode && strcmp(mode, "BLEND") == 0 ? fmin(fmax(color[3], 0), 1) : 1,
                     .diffuse = gloss ? base : vec3_scale(base, 1 - metal)};
    if (gloss)
        set_highlight(to, gltf_vector(gloss, "specularFactor", white),
                      1 - gltf_number(gloss, "glossinessFactor", 1));
    else
        set_highlight(to, vec3_add(vec3_scale(white, 0.04 * (1 - metal)), vec3_scale(base, metal)),
                      gltf_number(pbr, "roughnessFactor", 1));
    to->ambient = base; /* a metal reflects its surroundings */
    to->emission = color_within_one(
        vec3_scale(gltf_vector(from, "emissiveFactor", (Vec3){0, 0, 0}),
                   gltf_number(gltf_extension(from, "KHR_materials_emissive_strength"),
                               "emissiveStrength", 1)));
    if (unlit && colored)
        to->specular = to->emission = (Vec3){0, 0, 0};
    else if (unlit)
        *to = (Material){.emission = base, .alpha = to->alpha};
    scene_file_note(reading->file, colored && (unlit || (factor > 0 && !gloss)),
                    unlit ? NOTE_UNLIT : NOTE_METAL);
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
    if (mode > 6) {
        message_set(reading->gltf.reason, "a primitive's mode is %lld; there are 0 to 6",
                    (long long)mode);
        return NULL;
    }
    double *list = accessor >= 0 ? gltf_accessor(&reading->gltf, accessor, count, &size) : NULL;
    if (gltf_failed(reading) || mode < 4 || *count < 3) {
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

/* One attribute of the vertices, whose number is 0 before their positions are read; NULL: it has
 * none, or it failed. */
static double *read_attribute(Reading *reading, const json_t *primitive, const char *name,
                              size_t *vertices, int *size)
{
    const json_int_t accessor = gltf_whole(json_object_get(primitive, "attributes"), name, -1);
    size_t count = 0;
    double *numbers = accessor >= 0 ? gltf_accessor(&reading->gltf, accessor, &count, size) : NULL;
    if (numbers &&
        (*size < 3 || *size > (*vertices ? 4 : 3) || (*vertices && count != *vertices))) {
        message_set(reading->gltf.reason, "accessors %lld: no %s of %zu vertices",
                    (long long)accessor, name, *vertices ? *vertices : count);
        free(numbers);
        return NULL;
    }
    *vertices = numbers ? count : *vertices;
    return numbers;
}

static void copy3(float to[3], const double *from)
{
    for (int k = 0; k < 3; k++)
        to[k] = (float)from[k];
}

/* Of a primitive. */
typedef struct Attributes {
    double *positions, *normals, *colors, *lit;
    int size, normal_size, color_size, lit_size;
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
            color_within_one((Vec3){c[0] * from->tint.x, c[1] * from->tint.y, c[2] * from->tint.z}),
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
    const json_int_t places = gltf_whole(json_object_get(primitive, "attributes"), "POSITION", -1);
    const json_t *accessors = json_object_get(reading->gltf.root, "accessors");
    if (gltf_extension(primitive, "KHR_draco_mesh_compression") &&
        !json_object_get(json_array_get(accessors, (size_t)places), "bufferView"))
        message_set(reading->gltf.reason, "its meshes are compressed by Draco; save it without");
    from.positions = read_attribute(reading, primitive, "POSITION", &vertices, &from.size);
    uint32_t *corners = from.positions ? read_corners(reading, primitive, vertices, &count) : NULL;
    if (corners && !gltf_failed(reading)) {
        from.normals = read_attribute(reading, primitive, "NORMAL", &vertices, &from.normal_size);
        from.colors = read_attribute(reading, primitive, "COLOR_0", &vertices, &from.color_size);
        from.lit = read_attribute(reading, primitive, "_LIT_POSITION", &vertices, &from.lit_size);
        reading->indices += count;
        reading->vertices += from.normals && vertices < count ? vertices : count;
        if (!gltf_failed(reading) &&
            scene_file_fits(reading->vertices, reading->indices, reading->gltf.reason))
            mesh = scene_file_add(reading->file, FILE_MESHES, reading->gltf.reason);
    }
    if (mesh)
        fill_mesh(&from, corners, count, vertices, mesh, reading->gltf.reason);
    free(from.positions);
    free(from.normals);
    free(from.colors);
    free(from.lit);
    free(corners);
    return mesh && !gltf_failed(reading) ? reading->file->mesh_count - 1 : -2;
}

static void set_own(const json_t *own, Object *object)
{
    if (!own)
        return;
    gltf_fields(own, OBJECT_FIELDS, object);
    gltf_fields(json_object_get(own, "solid"), SOLID_FIELDS, &object->solid);
    gltf_fields(json_object_get(own, "front"), MATERIAL_FIELDS, &object->front);
    gltf_fields(json_object_get(own, "back"), MATERIAL_FIELDS, &object->back);
}

bool gltf_add_objects(Reading *reading, const json_t *node, int number)
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
    for (size_t i = 0; i < count && !gltf_failed(reading); i++) {
        const json_t *primitive = json_array_get(list, i);
        const json_int_t material = gltf_whole(primitive, "material", -1);
        int *known = &reading->meshes[index][i];
        FileObject object = {.node = number};
        set_material(
            reading, material >= 0 ? gltf_item(&reading->gltf, "materials", material) : NULL,
            json_object_get(json_object_get(primitive, "attributes"), "COLOR_0"), &object.object);
        if (*known == -1 && !gltf_failed(reading))
            *known = read_primitive(reading, primitive, object.object.front.ambient);
        scene_file_note(reading->file, *known == -2, NOTE_LINES);
        if (gltf_failed(reading) || *known < 0)
            continue;
        FileObject *added = scene_file_add(reading->file, FILE_OBJECTS, reading->gltf.reason);
        if (!added)
            return false;
        object.mesh = *known;
        gltf_name(object.name, json_object_get(node, "name") ? node : mesh);
        set_own(gltf_own(node), &object.object);
        *added = object;
        scene_file_note(reading->file, json_object_get(node, "skin"), NOTE_SKIN);
        scene_file_note(reading->file, json_object_get(primitive, "targets"), NOTE_MORPH);
    }
    return !gltf_failed(reading);
}
