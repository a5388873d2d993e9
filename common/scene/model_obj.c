/*
 * OBJ files and their materials (Wavefront's Advanced Visualizer, appendix B). A mesh for each
 * group and material, whose corners of equal position and normal are one vertex.
 */
#include "base/input.h"
#include "base/memory.h"
#include "base/text.h"
#include "core/mesh_make.h"
#include "scene/model_module.h"
#include "scene/polygon.h"
#include "scene/texture_mean.h"

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

typedef struct Corner {
    int position, normal; /* normal -1: none */
    int other;            /* vertex of the mesh at this position; -1: none */
} Corner;

typedef struct Paint {
    char *name;
    Object object;
    Vec3 mean;
    bool base, textures;
} Paint;

typedef struct Vectors {
    float (*all)[3];
    int count, room;
} Vectors;

typedef struct Obj {
    SceneFile *file;
    Message *reason;
    int folder, line;
    const char *at;
    Vectors positions, colors, normals; /* a color of each position, if one has any */
    bool colored;
    int *first, first_count, first_room; /* vertex of the mesh at each position; -1: none */
    Corner *corners;
    uint32_t *polygon;
    TriangleList faces;
    int corner_count, corner_room, polygon_count, polygon_room;
    size_t vertices, indices; /* of the meshes before */
    Paint *paints;            /* the first is that of faces without */
    int paint_count, paint_room, paint;
    char name[FILE_NAME];
} Obj;

/* Words and numbers of a line, which goes on after a backslash. */

static bool at_end(const char **at)
{
    *at += strspn(*at, " \t\r");
    for (; **at == '\\' && (*at)[1 + ((*at)[1] == '\r')] == '\n'; *at += strspn(*at, " \t\r"))
        *at += 2 + ((*at)[1] == '\r');
    return !**at || **at == '\n' || **at == '#';
}

static int take_numbers(const char **at, int most, float *numbers)
{
    int count = 0;
    for (char *end; count < most && !at_end(at); count++, *at = end) {
        numbers[count] = (float)text_decimal(*at, &end);
        if (end == *at)
            break;
    }
    return count;
}

/* Whether the line's next word is this one, which is taken then. */
static bool take_word(const char **at, const char *word)
{
    const size_t length = strlen(word);
    *at += strspn(*at, " \t\r");
    if (strncmp(*at, word, length) != 0 || !strchr(" \t\r\n", (*at)[length]))
        return false;
    *at += length;
    return true;
}

/* The rest of the line without blanks around it, to be freed. */
static char *take_rest(const char **at)
{
    *at += strspn(*at, " \t\r");
    size_t length = strcspn(*at, "\n");
    while (length > 0 && strchr(" \t\r", (*at)[length - 1]))
        length--;
    return memory_format("%.*s", (int)length, *at);
}

/* Materials */

static char *read_beside(SceneFile *file, int folder, const char *path, size_t *size, Message *why)
{
    if (!input_leaves(path) && !strchr(path, ':'))
        return input_read(folder, path, path, MODEL_BYTES_MAX, size, why);
    scene_file_note(file, true, NOTE_OUTSIDE);
    message_set(why, "refused");
    return NULL;
}

Vec3 own_mean(SceneFile *file, int folder, const char *path)
{
    Message why = {0};
    size_t size = 0;
    char *bytes = read_beside(file, folder, path, &size, &why);
    return texture_mean(file, path, bytes, size, &why);
}

static void add_paint(Obj *obj, char *name)
{
    static const Vec3 grey = {0.6, 0.6, 0.6};
    Paint *paint =
        memory_add(&obj->paints, &obj->paint_count, &obj->paint_room, sizeof *obj->paints);
    *paint = (Paint){.name = name, .mean = {1, 1, 1}};
    paint->object.front = (Material){.diffuse = grey, .alpha = 1};
}

static void read_material_line(Obj *obj, const char *at, Paint *paint)
{
    Material *to = &paint->object.front;
    const struct {
        const char *word;
        Vec3 *color;
        double *number, sign, most;
    } all[] = {{"Ka", .color = &to->ambient},        {"Kd", .color = &to->diffuse},
               {"Ks", .color = &to->specular},       {"Ke", .color = &to->emission},
               {"Ns", NULL, &to->shininess, 1, 128}, {"d", NULL, &to->alpha, 1, 1},
               {"Tr", NULL, &to->alpha, -1, 1}};
    float v[3];
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        const int count = take_word(&at, all[i].word) ? take_numbers(&at, 3, v) : 0;
        if (count == 0)
            continue;
        if (all[i].color) /* one is of all three */
            *all[i].color = color_within_one(
                (Vec3){(double)v[0], (double)v[count > 1 ? 1 : 0], (double)v[count > 2 ? 2 : 0]});
        else
            *all[i].number =
                fmin(fmax((double)v[0] * all[i].sign + (all[i].sign < 0), 0), all[i].most);
    }
    paint->textures |= strncmp(at, "map_", 4) == 0 && strncmp(at, "map_Kd", 6) != 0;
    if (!take_word(&at, "map_Kd"))
        return;
    char *rest = take_rest(&at), *space = rest[0] == '-' ? strrchr(rest, ' ') : NULL;
    paint->mean = own_mean(obj->file, obj->folder, space ? space + 1 : rest); /* after options */
    paint->base = true;
    free(rest);
}

static void read_materials(Obj *obj, const char *path)
{
    Message why = {0};
    size_t size = 0;
    const int first = obj->paint_count;
    char *bytes = read_beside(obj->file, obj->folder, path, &size, &why);
    scene_file_note(obj->file, !bytes, "files of materials that cannot be read: grey");
    for (const char *at = bytes; at; at = strchr(at, '\n'), at = at ? at + 1 : NULL)
        if (take_word(&at, "newmtl"))
            add_paint(obj, take_rest(&at));
        else if (obj->paint_count > first)
            read_material_line(obj, at, &obj->paints[obj->paint_count - 1]);
    free(bytes);
}

/* The material as the scene has it: Assimp's way with those of other formats. */
static Object painted(const Paint *paint)
{
    Object object = paint->object;
    Material *to = &object.front;
    to->ambient =
        color_product(color_is_black(to->ambient) ? to->diffuse : to->ambient, paint->mean);
    to->diffuse = color_product(to->diffuse, paint->mean);
    if (to->shininess == 0) /* no exponent: no highlight */
        to->specular = (Vec3){0, 0, 0};
    object.back = *to;
    return object;
}

/* Meshes */

static bool fill_mesh(Obj *obj, Mesh *mesh, Vec3 diffuse)
{
    if (!mesh_open(mesh, (size_t)obj->corner_count, (size_t)obj->faces.count, obj->reason) ||
        (obj->colored && !mesh_open_colors(mesh, obj->reason)))
        return false;
    memcpy(mesh->indices, obj->faces.corners, mesh->index_count * sizeof *mesh->indices);
    for (int i = 0; i < obj->corner_count; i++) {
        const Corner *corner = &obj->corners[i];
        const size_t bytes = sizeof *obj->positions.all;
        memcpy(mesh->vertices[i].position, obj->positions.all[corner->position], bytes);
        if (corner->normal >= 0)
            memcpy(mesh->vertices[i].normal, obj->normals.all[corner->normal], bytes);
        if (obj->colored)
            vec3_to_float(color_within_one(color_product(
                              vec3_from_float(obj->colors.all[corner->position]), diffuse)),
                          mesh->colors[i]);
    }
    return true;
}

/* The mesh of the faces so far, and an object with it. */
static bool end_mesh(Obj *obj)
{
    const Paint *paint = &obj->paints[obj->paint];
    if (obj->faces.count == 0)
        return true;
    Mesh *mesh = scene_file_add(obj->file, FILE_MESHES, obj->reason);
    FileObject *object = mesh ? scene_file_add(obj->file, FILE_OBJECTS, obj->reason) : NULL;
    if (!object)
        return false;
    object->object = painted(paint);
    object->mesh = obj->file->mesh_count - 1;
    memcpy(object->name, obj->name, sizeof object->name);
    scene_file_note(obj->file, paint->base, NOTE_MEAN);
    scene_file_note(obj->file, paint->textures, NOTE_TEXTURES);
    scene_file_note(obj->file, object->object.front.alpha < 1, NOTE_TRANSPARENT);
    if (!fill_mesh(obj, mesh, object->object.front.diffuse))
        return false;
    for (int i = 0; i < obj->corner_count; i++)
        obj->first[obj->corners[i].position] = -1;
    obj->vertices += (size_t)obj->corner_count;
    obj->indices += (size_t)obj->faces.count;
    obj->corner_count = obj->faces.count = 0;
    return true;
}

/* The number of an item that a face names: from 1 on, or back from the last one, -1. */
static bool take_index(Obj *obj, int count, const char *what, int *index)
{
    char *end;
    const long number = strtol(obj->at, &end, 10);
    if (end == obj->at || number == 0 || number > count || number < -(long)count)
        return message_set(obj->reason,
                           "line %d: a face names a %s that is none of the %d before it", obj->line,
                           what, count);
    *index = (int)(number > 0 ? number - 1 : count + number);
    obj->at = end;
    return true;
}

/* position, position/texture, position//normal or all three, as a vertex of the mesh. */
static bool take_corner(Obj *obj, int *vertex)
{
    Corner corner = {.normal = -1};
    if (!take_index(obj, obj->positions.count, "vertex", &corner.position))
        return false;
    if (*obj->at == '/')
        obj->at += 1 + strspn(obj->at + 1, "-0123456789");
    if (*obj->at == '/' && obj->at++ && !strchr(" \t\r\n", *obj->at) &&
        !take_index(obj, obj->normals.count, "normal", &corner.normal))
        return false;
    int *first = &obj->first[corner.position];
    for (*vertex = *first; *vertex >= 0; *vertex = obj->corners[*vertex].other)
        if (obj->corners[*vertex].normal == corner.normal)
            return true;
    corner.other = *first;
    *vertex = *first = obj->corner_count;
    *(Corner *)memory_add(&obj->corners, &obj->corner_count, &obj->corner_room,
                          sizeof *obj->corners) = corner;
    return true;
}

static Vec3 place_of(const void *of, uint32_t vertex)
{
    const Obj *obj = of;
    return vec3_from_float(obj->positions.all[obj->corners[vertex].position]);
}

static bool read_face(Obj *obj)
{
    for (obj->polygon_count = 0; !at_end(&obj->at);) {
        int vertex;
        if (!take_corner(obj, &vertex))
            return false;
        *(uint32_t *)memory_add(&obj->polygon, &obj->polygon_count, &obj->polygon_room,
                                sizeof *obj->polygon) = (uint32_t)vertex;
    }
    if (obj->polygon_count > 2)
        polygon_add(&obj->faces, obj->polygon, obj->polygon_count, place_of, obj);
    else
        scene_file_note(obj->file, true, NOTE_LINES);
    return scene_file_fits(obj->vertices + (size_t)obj->corner_count,
                           obj->indices + (size_t)obj->faces.count, obj->reason);
}

static bool read_vector(Obj *obj, Vectors *list)
{
    float v[7] = {0, 0, 0, 1, 1, 1, 1};
    int count = take_numbers(&obj->at, 7, v);
    if (count < 3 && !at_end(&obj->at)) { /* no number */
        v[count] = NAN;
        count = 3;
    }
    if (count < 3)
        return message_set(obj->reason, "line %d: three numbers are needed", obj->line);
    memcpy(memory_add(&list->all, &list->count, &list->room, sizeof *list->all), v,
           sizeof *list->all);
    if (list == &obj->normals)
        return true;
    obj->colored |= count > 5;
    memcpy(memory_add(&obj->colors.all, &obj->colors.count, &obj->colors.room,
                      sizeof *obj->colors.all),
           v + (count > 6 ? 4 : 3), sizeof *obj->colors.all);
    *(int *)memory_add(&obj->first, &obj->first_count, &obj->first_room, sizeof *obj->first) = -1;
    return true;
}

/* The next faces are of another group or material. */
static bool begin_part(Obj *obj, const char *name, bool material)
{
    int i = obj->paint_count - 1;
    if (!material) {
        const bool done = end_mesh(obj);
        snprintf(obj->name, sizeof obj->name, "%s", name);
        return done;
    }
    while (i > 0 && strcmp(obj->paints[i].name, name) != 0)
        i--;
    const bool done = i == obj->paint || end_mesh(obj);
    obj->paint = i;
    return done;
}

static bool read_line(Obj *obj)
{
    if (take_word(&obj->at, "v"))
        return read_vector(obj, &obj->positions);
    if (take_word(&obj->at, "vn"))
        return read_vector(obj, &obj->normals);
    if (take_word(&obj->at, "f"))
        return read_face(obj);
    scene_file_note(obj->file, take_word(&obj->at, "l") || take_word(&obj->at, "p"), NOTE_LINES);
    scene_file_note(obj->file, take_word(&obj->at, "curv") || take_word(&obj->at, "surf"),
                    "curves and surfaces: left out");
    const bool library = take_word(&obj->at, "mtllib"), material = take_word(&obj->at, "usemtl");
    if (!library && !material && !take_word(&obj->at, "o") && !take_word(&obj->at, "g"))
        return true;
    char *name = take_rest(&obj->at);
    const bool done = library || begin_part(obj, name, material);
    if (library)
        read_materials(obj, name);
    free(name);
    return done;
}

static bool read_lines(Obj *obj)
{
    FileNode *world = scene_file_add(obj->file, FILE_NODES, NULL);
    *world = (FileNode){.parent = -1, .parent_from_node = mat4_identity()};
    add_paint(obj, memory_text(""));
    for (obj->line = 1; *obj->at; obj->line++) {
        if (!read_line(obj))
            return false;
        obj->at += strcspn(obj->at, "\n");
        obj->at += *obj->at == '\n';
    }
    if (obj->positions.count == 0)
        return message_set(obj->reason, "it has no vertices; is it an OBJ file?");
    return end_mesh(obj);
}

static bool obj_read(char *bytes, int folder, SceneFile *file, Message *reason)
{
    Obj obj = {.file = file,
               .reason = reason,
               .folder = folder,
               .at = bytes + (strncmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0)}; /* UTF-8 */
    for (char *end = strchr(bytes, '\n') ? NULL : strchr(bytes, '\r'); end; end = strchr(end, '\r'))
        *end = '\n'; /* lines of old Macintoshes */
    const bool done = read_lines(&obj);
    for (int i = 0; i < obj.paint_count; i++)
        free(obj.paints[i].name);
    void *const all[] = {obj.positions.all, obj.colors.all,    obj.normals.all, obj.first,
                         obj.corners,       obj.faces.corners, obj.polygon,     obj.paints};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        free(all[i]);
    return done;
}

bool own_read(const char *path, SceneFile *file, bool *other, Message *reason)
{
    const char *dot = strrchr(path, '.'), *slash = strrchr(path, '/');
    const bool ply = dot && strcasecmp(dot, ".ply") == 0;
    bool read = false;
    *other = true;
#ifdef HAVE_JANSSON /* without it Assimp reads glTF 2.0, too */
    read = gltf_read(path, file, other, reason);
#endif
    if (*other && dot && (ply || strcasecmp(dot, ".obj") == 0)) {
        size_t size;
        char *name =
            slash ? memory_format("%.*s", (int)(slash + 1 - path), path) : memory_text(".");
        char *bytes = input_whole(path, &size, reason);
        const int folder = open(name, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        *other = false;
        read = bytes && (ply ? ply_read(bytes, size, folder, file, reason)
                             : obj_read(bytes, folder, file, reason));
        close(folder);
        free(bytes);
        free(name);
    }
    file->turns = read;
    return read;
}
