/*
 * Nodes: one for each object, then for each light, then the camera. Each distinct mesh is a part of
 * the buffer: vertices, indices, and what else it has of each vertex. All members that decide the
 * picture go into `extras` in full precision; what other readers draw follows from them.
 */
#include "kinds/scene_views.h"

#include "base/json_writer.h"
#include "base/memory.h"
#include "base/output_text.h"
#include "base/parse.h"
#include "scene/scene_fields.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.141592653589793, RADIANS = 0.017453292519943295;

static void put_number(JsonWriter *json, const char *name, double value)
{
    char text[32];
    parse_number_text(value, text);
    json_write_value(json, name, text);
}

static void put_numbers(JsonWriter *json, const char *name, int count, const double *numbers)
{
    json_write_list(json, name);
    for (int i = 0; i < count; i++)
        put_number(json, NULL, numbers[i]);
    json_write_end(json);
}

static void put_vector(JsonWriter *json, const char *name, Vec3 v)
{
    put_numbers(json, name, 3, (const double[]){v.x, v.y, v.z});
}

static void put_fields(JsonWriter *json, const char *name, const Field *fields, const void *from)
{
    json_write_object(json, name);
    for (; fields->name; fields++) {
        const void *place = (const char *)from + fields->place;
        if (fields->kind == FIELD_NUMBER)
            put_number(json, fields->name, *(const double *)place);
        else if (fields->kind == FIELD_VECTOR)
            put_vector(json, fields->name, *(const Vec3 *)place);
        else if (fields->kind == FIELD_WHOLE)
            json_write_whole(json, fields->name, *(const int *)place);
        else
            json_write_flag(json, fields->name, *(const bool *)place);
    }
}

/* All of a struct, as extras. */
static void put_extras(JsonWriter *json, const Field *fields, const void *from)
{
    json_write_object(json, "extras");
    put_fields(json, FIELDS_MEMBER, fields, from);
    json_write_end(json);
    json_write_end(json);
}

/* Nodes */

static void put_node(JsonWriter *json, Mat4 world_from_node)
{
    json_write_object(json, NULL);
    put_numbers(json, "matrix", 16, world_from_node.m);
}

static Mat4 looking(Vec3 from, Vec3 way, Vec3 up)
{
    Mat4 world_from_eye;
    mat4_inverse(mat4_look_at(from, vec3_add(from, way), up), &world_from_eye);
    return world_from_eye;
}

static void put_object(JsonWriter *json, const Object *object, int number)
{
    put_node(json, object->world_from_object);
    json_write_whole(json, "mesh", number);
    json_write_object(json, "extras");
    put_fields(json, FIELDS_MEMBER, OBJECT_FIELDS, object);
    put_fields(json, "solid", SOLID_FIELDS, &object->solid);
    json_write_end(json);
    put_fields(json, "front", MATERIAL_FIELDS, &object->front);
    json_write_end(json);
    put_fields(json, "back", MATERIAL_FIELDS, &object->back);
    json_write_end(json);
    json_write_end(json);
    json_write_end(json);
    json_write_end(json);
}

static void put_nodes(JsonWriter *json, const Scene *scene)
{
    const Camera *camera = &scene->camera;
    json_write_list(json, "nodes");
    for (int i = 0; i < scene->object_count; i++)
        put_object(json, &scene->objects[i], i);
    for (int i = 0; i < scene->light_count; i++) {
        const Light light = scene_world_light(scene, i);
        const Vec3 unit = vec3_unit(light.direction);
        put_node(json,
                 light.kind == LIGHT_POINT
                     ? mat4_translate(light.position)
                     : looking(light.position, vec3_scale(unit, light.kind == LIGHT_SPOT ? 1 : -1),
                               (Vec3){0, 1, 0}));
        json_write_object(json, "extensions");
        json_write_object(json, "KHR_lights_punctual");
        json_write_whole(json, "light", i);
        json_write_end(json);
        json_write_end(json);
        json_write_end(json);
    }
    put_node(json, looking(camera->eye, vec3_unit(vec3_subtract(camera->center, camera->eye)),
                           camera->up));
    json_write_whole(json, "camera", 0);
    json_write_end(json);
    json_write_end(json);
}

/* Lights, the camera, materials */

static void put_lights(JsonWriter *json, const Scene *scene)
{
    static const char *const types[] = {"directional", "point", "spot"};
    json_write_object(json, "extensions");
    json_write_object(json, "KHR_lights_punctual");
    json_write_list(json, "lights");
    for (int i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        const double most = fmax(fmax(light->diffuse.x, light->diffuse.y), light->diffuse.z);
        json_write_object(json, NULL);
        json_write_text(json, "type", types[light->kind]);
        put_vector(json, "color", vec3_scale(light->diffuse, most > 0 ? 1 / most : 0));
        put_number(json, "intensity", light->off ? 0 : PI * most);
        if (light->kind == LIGHT_SPOT) {
            json_write_object(json, "spot");
            put_number(json, "outerConeAngle", RADIANS * fmax(light->cutoff, 0.01));
            json_write_end(json);
        }
        put_extras(json, LIGHT_FIELDS, light);
        json_write_end(json);
    }
    json_write_end(json);
    json_write_end(json);
    json_write_end(json);
}

static void put_camera(JsonWriter *json, const Camera *camera)
{
    json_write_list(json, "cameras");
    json_write_object(json, NULL);
    json_write_text(json, "type", "perspective");
    json_write_object(json, "perspective");
    put_number(json, "yfov", RADIANS * camera->fovy);
    put_number(json, "znear", camera->near);
    if (isfinite(camera->far))
        put_number(json, "zfar", camera->far);
    json_write_end(json);
    put_extras(json, CAMERA_FIELDS, camera);
    json_write_end(json);
    json_write_end(json);
}

static double decoded(double c, bool linear) /* IEC 61966-2-1 */
{
    return linear ? c : c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static void put_materials(JsonWriter *json, const Scene *scene)
{
    json_write_list(json, "materials");
    for (int i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        const Material *from = &object->front;
        const Vec3 color = object->mesh->colors ? (Vec3){1, 1, 1} : from->diffuse;
        const bool linear = scene->linear;
        json_write_object(json, NULL);
        json_write_object(json, "pbrMetallicRoughness");
        put_numbers(json, "baseColorFactor", 4,
                    (const double[]){decoded(color.x, linear), decoded(color.y, linear),
                                     decoded(color.z, linear), from->alpha});
        json_write_whole(json, "metallicFactor", 0);
        /* The inverse of what scene/gltf_mesh.c has. */
        put_number(json, "roughnessFactor", pow(2 / (from->shininess + 2), 0.25));
        json_write_end(json);
        put_vector(json, "emissiveFactor", from->emission);
        if (from->alpha < 1)
            json_write_text(json, "alphaMode", "BLEND");
        json_write_flag(json, "doubleSided", !object->closed);
        json_write_end(json);
    }
    json_write_end(json);
}

/* Meshes: parts of the buffer, a view each, and one accessor each but for vertices, of which
 * normals are another. */

typedef struct Parts {
    size_t size; /* of the buffer so far */
    int views, accessors;
    JsonWriter view, accessor;
    OutputText view_text, accessor_text, bytes;
} Parts;

typedef struct Accessor {
    const char *type;
    int component;
    size_t count, offset;
    const MeshBox *box; /* NULL: its range is not said */
} Accessor;

static void add_accessor(Parts *parts, Accessor added)
{
    JsonWriter *json = &parts->accessor;
    json_write_object(json, NULL);
    json_write_whole(json, "bufferView", parts->views - 1);
    json_write_whole(json, "byteOffset", (long long)added.offset);
    json_write_whole(json, "componentType", added.component);
    json_write_whole(json, "count", (long long)added.count);
    json_write_text(json, "type", added.type);
    if (added.box) {
        put_vector(json, "min", added.box->low);
        put_vector(json, "max", added.box->high);
    }
    json_write_end(json);
    parts->accessors++;
}

static void add_view(Parts *parts, const void *bytes, size_t size, size_t stride)
{
    JsonWriter *json = &parts->view;
    json_write_object(json, NULL);
    json_write_whole(json, "buffer", 0);
    json_write_whole(json, "byteOffset", (long long)parts->size);
    json_write_whole(json, "byteLength", (long long)size);
    if (stride)
        json_write_whole(json, "byteStride", (long long)stride);
    json_write_whole(json, "target", stride ? 34962 : 34963); /* vertices, indices */
    json_write_end(json);
    fwrite(bytes, 1, size, parts->bytes.file);
    parts->size += size;
    parts->views++;
}

static void add_vectors(Parts *parts, float (*const vectors)[3], size_t count)
{
    if (!vectors)
        return;
    add_view(parts, vectors, count * sizeof *vectors, sizeof *vectors);
    add_accessor(parts, (Accessor){"VEC3", 5126, count, 0, NULL});
}

/* The primitive's attributes and indices; `first` is the accessor where an earlier object of the
 * same mesh has them, or -1. */
static int put_primitive(JsonWriter *json, Parts *parts, const Mesh *mesh, int first)
{
    const MeshBox box = mesh_bounds(mesh);
    const size_t count = mesh->vertex_count;
    const int begin = first < 0 ? parts->accessors : first;
    if (first < 0) {
        add_view(parts, mesh->indices, mesh->index_count * sizeof *mesh->indices, 0);
        add_accessor(parts, (Accessor){"SCALAR", 5125, mesh->index_count, 0, NULL});
        add_view(parts, mesh->vertices, count * sizeof *mesh->vertices, sizeof *mesh->vertices);
        add_accessor(parts, (Accessor){"VEC3", 5126, count, 0, &box});
        add_accessor(parts, (Accessor){"VEC3", 5126, count, offsetof(MeshVertex, normal), NULL});
        add_vectors(parts, mesh->colors, count);
        add_vectors(parts, mesh->lit_positions, count);
    }
    json_write_whole(json, "indices", begin);
    json_write_object(json, "attributes");
    json_write_whole(json, "POSITION", begin + 1);
    json_write_whole(json, "NORMAL", begin + 2);
    if (mesh->colors)
        json_write_whole(json, "COLOR_0", begin + 3);
    if (mesh->lit_positions)
        json_write_whole(json, "_LIT_POSITION", begin + 3 + (mesh->colors != NULL));
    json_write_end(json);
    return begin;
}

/* A mesh of each object, because its primitive names the material. */
static void put_meshes(JsonWriter *json, const Scene *scene, Parts *parts)
{
    int *firsts = memory_new((size_t)scene->object_count + 1, sizeof *firsts);
    json_write_list(json, "meshes");
    for (int i = 0; i < scene->object_count; i++) {
        int same = 0;
        while (scene->objects[same].mesh != scene->objects[i].mesh)
            same++;
        json_write_object(json, NULL);
        json_write_list(json, "primitives");
        json_write_object(json, NULL);
        firsts[i] =
            put_primitive(json, parts, scene->objects[i].mesh, same < i ? firsts[same] : -1);
        json_write_whole(json, "material", i);
        json_write_end(json);
        json_write_end(json);
        json_write_end(json);
    }
    json_write_end(json);
    free(firsts);
}

/* RFC 4648. */
static void put_base64(FILE *file, const unsigned char *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        const unsigned word = (unsigned)bytes[i] << 16 | (i + 1 < size ? bytes[i + 1] * 256u : 0u) |
                              (i + 2 < size ? bytes[i + 2] : 0u);
        for (unsigned k = 0; k < 4; k++)
            fputc(i + k > size ? '=' : digits[word >> (18 - 6 * k) & 63], file);
    }
}

static void put_buffer(JsonWriter *json, Parts *parts)
{
    json_write_end(&parts->view);
    json_write_end(&parts->accessor);
    char *views = output_text_close(&parts->view_text);
    char *accessors = output_text_close(&parts->accessor_text);
    char *bytes = output_text_close(&parts->bytes);
    json_write_value(json, "bufferViews", views);
    json_write_value(json, "accessors", accessors);
    json_write_list(json, "buffers");
    json_write_object(json, NULL);
    json_write_whole(json, "byteLength", (long long)parts->size);
    json_write_value(json, "uri", "\"data:application/octet-stream;base64,");
    put_base64(json->file, (const unsigned char *)bytes, parts->size);
    fputc('"', json->file);
    json_write_end(json);
    json_write_end(json);
    free(views);
    free(accessors);
    free(bytes);
}

static void put_head(JsonWriter *json, const Scene *scene)
{
    const int nodes = scene->object_count + scene->light_count + 1;
    json_write_object(json, "asset");
    json_write_text(json, "version", "2.0");
    json_write_text(json, "generator", "lighting");
    json_write_end(json);
    json_write_list(json, "extensionsUsed");
    json_write_text(json, NULL, "KHR_lights_punctual");
    json_write_end(json);
    json_write_whole(json, "scene", 0);
    json_write_list(json, "scenes");
    json_write_object(json, NULL);
    json_write_list(json, "nodes");
    for (int i = 0; i < nodes; i++)
        json_write_whole(json, NULL, i);
    json_write_end(json);
    put_extras(json, SCENE_FIELDS, scene);
    json_write_end(json);
    json_write_end(json);
}

bool scene_save(const Scene *scene, const char *path, Message *message)
{
    OutputText text;
    Parts parts = {.size = 0};
    output_text_open(&text);
    output_text_open(&parts.view_text);
    output_text_open(&parts.accessor_text);
    output_text_open(&parts.bytes);
    JsonWriter json = {.file = text.file, .lines = 3};
    parts.view = (JsonWriter){.file = parts.view_text.file};
    parts.accessor = (JsonWriter){.file = parts.accessor_text.file};
    json_write_list(&parts.view, NULL);
    json_write_list(&parts.accessor, NULL);
    json_write_object(&json, NULL);
    put_head(&json, scene);
    put_nodes(&json, scene);
    put_lights(&json, scene);
    put_camera(&json, &scene->camera);
    put_materials(&json, scene);
    put_meshes(&json, scene, &parts);
    put_buffer(&json, &parts);
    json_write_end(&json);
    return output_text_write(&text, path, message);
}
