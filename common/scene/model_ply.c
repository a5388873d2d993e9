/*
 * PLY files: a header names elements, each with a number of rows and with properties, a number or a
 * list of numbers each, in words or in bytes. Of vertices places, normals and colours are read, of
 * faces their corners; all else is skipped, number by number, for the end of a row is known only
 * from its lists' lengths. (Greg Turk, The PLY polygon file format, 1994.)
 */
#include "base/memory.h"
#include "base/text.h"
#include "core/mesh_make.h"
#include "scene/model_module.h"
#include "scene/polygon.h"
#include "scene/texture_mean.h"

#include <endian.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Type {
    int bytes; /* 0: none */
    bool real, negative;
} Type;

/* What a number is: of a vertex its position, normal or color, 0 to 8. */
enum { COLORS = 6, ROLES = 9, CORNERS = ROLES, SKIPPED };

static const uint32_t NO_VERTEX = UINT32_MAX;
static const char PLAIN[] = " x y z nx ny nz red green blue ", BLANKS[] = " \t\r\n";

typedef struct Property {
    Type length, type; /* of a list's length; of a number */
    int role;
    double scale;
} Property;

typedef struct Element {
    char name[32];
    size_t rows;
    int first, count; /* properties */
} Element;

typedef struct Ply {
    SceneFile *file;
    Message *reason;
    int folder;
    const char *next, *end;
    bool words, big_endian;
    Element *elements;
    Property *properties;
    int element_count, element_room, property_count, property_room;
    double values[SKIPPED + 1]; /* of a row, by their roles */
    uint32_t *corners;
    int corner_count, corner_room;
    Mesh *mesh; /* NULL: none yet */
    TriangleList triangles;
    Vec3 mean; /* color of the texture */
} Ply;

/* The words of `all` before this one; -1: it is not there. */
static int place_in(const char *all, const char *name)
{
    char word[34];
    int count = 0;
    snprintf(word, sizeof word, " %.31s ", name);
    const char *found = strstr(all, word);
    for (const char *c = all; found && c < found; c++)
        count += *c == ' ';
    return found ? count : -1;
}

static Type type_of(const char *name)
{
    const int old = place_in(" char uchar short ushort int uint float double ", name);
    const int new = place_in(" int8 uint8 int16 uint16 int32 uint32 float32 float64 ", name);
    const int place = old >= 0 ? old : new;
    return (Type){place < 0 ? 0 : place == 6 ? 4 : 1 << place / 2, place >= 6, place % 2 == 0};
}

/* The header */

/* What is not known is skipped, as long as it is known how long it is. */
static bool read_header_line(Ply *ply, const char *line)
{
    Element element = {.first = ply->property_count};
    char word[256], length[32] = "", type[32];
    if (sscanf(line, "format %255s", word) == 1) {
        ply->words = strcmp(word, "ascii") == 0;
        ply->big_endian = strcmp(word, "binary_big_endian") == 0;
    } else if (sscanf(line, "comment TextureFile %255[^\r]", word) == 1) {
        ply->mean = own_mean(ply->file, ply->folder, word);
        scene_file_note(ply->file, true, NOTE_MEAN);
    } else if (strncmp(line, "element ", 8) == 0) {
        if (sscanf(line, "element %31s %18[0-9]%1[^ \t\r]", element.name, length, type) != 2)
            return false;
        element.rows = strtoull(length, NULL, 10);
        *(Element *)memory_add(&ply->elements, &ply->element_count, &ply->element_room,
                               sizeof *ply->elements) = element;
    } else if (sscanf(line, "property list %31s %31s %31s", length, type, word) == 3 ||
               sscanf(line, "property %31s %31s", type, word) == 2) {
        const bool list = length[0];
        const char *name = strncmp(word, "diffuse_", 8) == 0 ? word + 8 : word;
        const int role = place_in(list ? " vertex_index vertex_indices " : PLAIN, name);
        Property made = {type_of(length), type_of(type),
                         role < 0 ? SKIPPED
                         : list   ? CORNERS
                                  : role,
                         1};
        if (made.role >= COLORS && !made.type.real) /* of the largest integer */
            made.scale = 1 / (ldexp(1, 8 * made.type.bytes - made.type.negative) - 1);
        *(Property *)memory_add(&ply->properties, &ply->property_count, &ply->property_room,
                                sizeof *ply->properties) = made;
        if (ply->element_count > 0)
            ply->elements[ply->element_count - 1].count++;
        return ply->element_count > 0 && made.type.bytes && (made.length.bytes || !list);
    }
    return true;
}

static bool read_header(Ply *ply)
{
    char line[300] = "";
    if (strncmp(ply->next, "ply", 3) != 0)
        return message_set(ply->reason, "it is no PLY file");
    for (int number = 1; strncmp(line, "end_header", 10) != 0; number++) {
        const char *end = memchr(ply->next, '\n', (size_t)(ply->end - ply->next));
        if (!end)
            return message_set(ply->reason, "its header has no end");
        snprintf(line, sizeof line, "%.*s", (int)(end - ply->next), ply->next);
        ply->next = end + 1;
        if (!read_header_line(ply, line))
            return message_set(ply->reason, "line %d: %.60s", number, line);
    }
    return true;
}

/* Rows */

static bool take(Ply *ply, Type type, double *number)
{
    const int bytes = type.bytes, rest = 64 - 8 * bytes;
    const ptrdiff_t left = ply->end - ply->next;
    uint64_t bits = 0;
    if (ply->words) {
        char *end;
        *number = text_decimal(ply->next, &end);
        const bool found = end != ply->next;
        ply->next = end;
        return found;
    }
    if (left < bytes)
        return false;
    memcpy(&bits, ply->next, left < 8 ? (size_t)left : sizeof bits);
    bits = ply->big_endian ? be64toh(bits) >> rest : le64toh(bits) << rest >> rest;
    ply->next += bytes;
    if (type.real && bytes == 4) {
        const uint32_t low = (uint32_t)bits;
        float value;
        memcpy(&value, &low, sizeof value);
        *number = (double)value;
    } else if (type.real) {
        memcpy(number, &bits, sizeof *number);
    } else {
        *number = type.negative ? (double)((int64_t)(bits << rest) >> rest) : (double)bits;
    }
    return true;
}

/* Why there is no number to be taken. */
static const char *what_is_missing(const Ply *ply)
{
    const char *word = ply->next + strspn(ply->next, BLANKS);
    const bool cut = !ply->words || word + strcspn(word, BLANKS) >= ply->end;
    return cut ? "the file ends" : "there is no number";
}

/* The numbers of a row by their roles, and its corners; returns what is wrong, or NULL. */
static const char *take_row(Ply *ply, const Element *element)
{
    ply->corner_count = 0;
    for (int i = 0; i < element->count; i++) {
        const Property *property = &ply->properties[element->first + i];
        double length = 1, number = 0;
        if (property->length.bytes && !take(ply, property->length, &length))
            return what_is_missing(ply);
        if (length < 0)
            return "a list has a negative length";
        for (double k = 0; k < length; k++) {
            if (!take(ply, property->type, &number))
                return what_is_missing(ply);
            if (property->role == CORNERS) {
                const uint32_t corner = number >= 0 && number < NO_VERTEX ? (uint32_t)number : 0;
                *(uint32_t *)memory_add(&ply->corners, &ply->corner_count, &ply->corner_room,
                                        sizeof *ply->corners) =
                    (double)corner == number ? corner : NO_VERTEX;
            }
        }
        ply->values[property->role] = number * property->scale;
    }
    return NULL;
}

/* Elements */

static void set_vertex(const Ply *ply, size_t row)
{
    const double *v = ply->values;
    vec3_to_float((Vec3){v[0], v[1], v[2]}, ply->mesh->vertices[row].position);
    vec3_to_float((Vec3){v[3], v[4], v[5]}, ply->mesh->vertices[row].normal);
    if (ply->mesh->colors)
        vec3_to_float(color_product(color_within_one((Vec3){v[6], v[7], v[8]}), ply->mean),
                      ply->mesh->colors[row]);
}

static Vec3 place_of(const void *mesh, uint32_t vertex)
{
    return vec3_from_float(((const Mesh *)mesh)->vertices[vertex].position);
}

/* The corners of a face, or of strips: each after two others; NO_VERTEX ends a strip. */
static bool add_faces(Ply *ply, bool strips)
{
    const size_t vertices = ply->mesh ? ply->mesh->vertex_count : 0;
    int first = 0;
    for (int i = 0; i < ply->corner_count; i++) {
        const bool ends = strips && ply->corners[i] == NO_VERTEX;
        if (!ends && ply->corners[i] >= vertices)
            return message_set(ply->reason, "a face names a vertex that is none of the %zu before",
                               vertices);
        first = ends ? i + 1 : first;
        const uint32_t *last = &ply->corners[i];
        const int odd = (i - first) % 2;
        if (strips && i - first >= 2)
            polygon_add(&ply->triangles, (uint32_t[]){last[odd - 2], last[-1 - odd], *last}, 3,
                        place_of, NULL);
    }
    if (!strips && ply->corner_count < 3)
        scene_file_note(ply->file, true, NOTE_LINES);
    else if (!strips)
        polygon_add(&ply->triangles, ply->corners, ply->corner_count, place_of, ply->mesh);
    return scene_file_fits(vertices, (size_t)ply->triangles.count, ply->reason);
}

/* An object of both sides, for a file does not say which is in front. */
static bool open_mesh(Ply *ply, const Element *element)
{
    const Vec3 black = {0, 0, 0};
    const Material material = {ply->mean, ply->mean, black, black, 1, 0};
    unsigned has = 0;
    for (int i = 0; i < element->count; i++)
        has |= 1U << ply->properties[element->first + i].role;
    if ((has & 7) != 7) /* the roles of a position */
        return message_set(ply->reason, "its vertices need x, y and z");
    *(FileNode *)scene_file_add(ply->file, FILE_NODES, NULL) =
        (FileNode){.parent = -1, .parent_from_node = mat4_identity()};
    ((FileObject *)scene_file_add(ply->file, FILE_OBJECTS, NULL))->object =
        (Object){.front = material, .back = material, .two_sided = true};
    memset(ply->values, 0, sizeof ply->values);
    ply->mesh = scene_file_add(ply->file, FILE_MESHES, ply->reason);
    return scene_file_fits(element->rows, 0, ply->reason) &&
           mesh_open(ply->mesh, element->rows, 1, ply->reason) &&
           (!(has & 1U << COLORS) || mesh_open_colors(ply->mesh, ply->reason));
}

static bool read_element(Ply *ply, const Element *element)
{
    const bool vertices = strcmp(element->name, "vertex") == 0 && !ply->mesh;
    const bool strips = strcmp(element->name, "tristrips") == 0;
    const bool faces = strips || strcmp(element->name, "face") == 0;
    if (vertices && !open_mesh(ply, element))
        return false;
    for (size_t row = 0; row < element->rows && element->count > 0; row++) {
        const char *wrong = take_row(ply, element);
        if (wrong)
            return message_set(ply->reason, "%s within %s %zu of %zu", wrong, element->name,
                               row + 1, element->rows);
        if (vertices)
            set_vertex(ply, row);
        else if (faces && !add_faces(ply, strips))
            return false;
    }
    return true;
}

bool ply_read(const char *bytes, size_t size, int folder, SceneFile *file, Message *reason)
{
    Ply ply = {.file = file,
               .reason = reason,
               .folder = folder,
               .next = bytes,
               .end = bytes + size,
               .mean = {1, 1, 1}};
    bool done = read_header(&ply);
    for (int i = 0; i < ply.element_count && done; i++)
        done = read_element(&ply, &ply.elements[i]);
    if (done && ply.triangles.count == 0)
        done = message_set(reason, "it has no faces");
    if (done) {
        free(ply.mesh->indices);
        ply.mesh->indices = ply.triangles.corners;
        ply.mesh->index_count = (size_t)ply.triangles.count;
        ply.triangles.corners = NULL;
    }
    free(ply.elements);
    free(ply.properties);
    free(ply.corners);
    free(ply.triangles.corners);
    return done;
}
