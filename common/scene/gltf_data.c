/*
 * The data of glTF 2.0: JSON, which names buffers, parts of buffers, and in those numbers. All of
 * it is checked against what is there before anything is read. A buffer is a file in the folder of
 * the scene's, or below; a URI that leaves the folder or names a network is refused.
 */
#include "scene/gltf.h"

#include "base/input.h"
#include "base/memory.h"
#include "scene/scene_file.h"

#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

json_int_t gltf_whole(const json_t *object, const char *key, json_int_t usual)
{
    const json_t *value = json_object_get(object, key);
    return json_is_integer(value) ? json_integer_value(value)
           : json_is_real(value) && json_real_value(value) > -1e15 && json_real_value(value) < 1e15
               ? (json_int_t)json_real_value(value)
               : usual;
}

double gltf_number(const json_t *object, const char *key, double usual)
{
    const json_t *value = json_object_get(object, key);
    return json_is_number(value) ? json_number_value(value) : usual;
}

bool gltf_numbers(const json_t *object, const char *key, int count, double *numbers)
{
    const json_t *list = json_object_get(object, key);
    if (json_array_size(list) != (size_t)count)
        return false;
    for (int i = 0; i < count; i++)
        if (!json_is_number(json_array_get(list, (size_t)i)))
            return false;
    for (int i = 0; i < count; i++)
        numbers[i] = json_number_value(json_array_get(list, (size_t)i));
    return true;
}

json_t *gltf_extension(const json_t *object, const char *name)
{
    return json_object_get(json_object_get(object, "extensions"), name);
}

json_t *gltf_item(const Gltf *gltf, const char *list, json_int_t index)
{
    const json_t *items = json_object_get(gltf->root, list);
    const size_t count = json_array_size(items);
    json_t *item = index >= 0 ? json_array_get(items, (size_t)index) : NULL;
    if (!json_is_object(item)) {
        message_set(gltf->reason, "%s %lld: there is none; the file has %zu", list,
                    (long long)index, count);
        return NULL;
    }
    return item;
}

/* The file */

static uint32_t word_at(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;
    return b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

/* The chunks of a .glb: JSON, then bytes. */
static bool find_chunks(Gltf *gltf, size_t size, const char **text, size_t *length)
{
    enum { HEAD = 12, CHUNK = 8 };
    if (size < HEAD + CHUNK || word_at(gltf->file + 8) > size)
        return message_set(gltf->reason, "it ends after %zu bytes of %lu", size,
                           size < HEAD ? 20ul : (unsigned long)word_at(gltf->file + 8));
    if (word_at(gltf->file + 4) != 2)
        return message_set(gltf->reason, "a .glb of version %lu; 2 is read",
                           (unsigned long)word_at(gltf->file + 4));
    *length = word_at(gltf->file + HEAD);
    *text = gltf->file + HEAD + CHUNK;
    if (memcmp(gltf->file + HEAD + 4, "JSON", 4) != 0 || *length > size - HEAD - CHUNK)
        return message_set(gltf->reason, "its first chunk is no JSON, or ends after the file");
    const size_t next = HEAD + CHUNK + *length;
    if (size - next < CHUNK || memcmp(gltf->file + next + 4, "BIN\0", 4) != 0)
        return true;
    gltf->bin = gltf->file + next + CHUNK;
    gltf->bin_size = word_at(gltf->file + next);
    if (gltf->bin_size > size - next - CHUNK)
        return message_set(gltf->reason, "its buffer of %zu bytes ends after the file",
                           gltf->bin_size);
    return true;
}

/* Extensions without which a file means something else. */
static bool check_required(const Gltf *gltf)
{
    static const char *const known[] = {
        "KHR_lights_punctual", "KHR_materials_", "KHR_texture_",          "KHR_mesh_quantization",
        "EXT_texture_",        "MSFT_texture_",  "KHR_animation_pointer", "KHR_node_visibility"};
    const json_t *required = json_object_get(gltf->root, "extensionsRequired");
    for (size_t i = 0; i < json_array_size(required); i++) {
        const char *name = json_string_value(json_array_get(required, i));
        bool found = !name;
        for (size_t k = 0; k < sizeof known / sizeof known[0] && name; k++)
            found |= strncmp(name, known[k], strlen(known[k])) == 0;
        if (!found)
            return message_set(gltf->reason,
                               "it requires %.60s, which is not read; save it without", name);
    }
    return true;
}

static bool check_version(const Gltf *gltf, bool *other)
{
    const char *version =
        json_string_value(json_object_get(json_object_get(gltf->root, "asset"), "version"));
    *other =
        (version && version[0] == '1') || json_is_object(json_object_get(gltf->root, "meshes"));
    if (*other)
        return false;
    if (!version)
        return message_set(gltf->reason, "asset: it has no version; is this glTF 2.0?");
    return version[0] == '2' ||
           message_set(gltf->reason, "asset: version %.20s; 2.0 is read", version);
}

static bool load(Gltf *gltf, size_t size, bool binary, bool *other)
{
    const bool marked = size >= 3 && memcmp(gltf->file, "\xef\xbb\xbf", 3) == 0; /* UTF-8 */
    const char *text = gltf->file + (marked ? 3 : 0);
    size_t length = size - (marked ? 3 : 0);
    json_error_t error;
    *other = binary && size >= 8 && word_at(gltf->file + 4) == 1;
    if (*other || (binary && !find_chunks(gltf, size, &text, &length)))
        return false;
    gltf->root = json_loadb(text, length, JSON_ALLOW_NUL, &error);
    if (!gltf->root)
        return message_set(gltf->reason, "line %d, column %d of its JSON: %s", error.line,
                           error.column, error.text);
    if (!json_is_object(gltf->root))
        return message_set(gltf->reason, "its JSON is no object");
    const size_t count = json_array_size(json_object_get(gltf->root, "buffers"));
    gltf->buffers = memory_new(count + 1, sizeof *gltf->buffers);
    gltf->sizes = memory_new(count + 1, sizeof *gltf->sizes);
    return check_version(gltf, other) && check_required(gltf);
}

bool gltf_open(Gltf *gltf, const char *path, bool *other, Message *reason)
{
    const char *dot = strrchr(path, '.'), *slash = strrchr(path, '/');
    char *folder = slash ? memory_format("%.*s", (int)(slash + 1 - path), path) : memory_text(".");
    size_t size = 0;
    *gltf = (Gltf){.folder = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC), .reason = reason};
    free(folder);
    *other = !dot || (strcasecmp(dot, ".gltf") != 0 && strcasecmp(dot, ".glb") != 0);
    if (*other)
        return false;
    gltf->file = input_whole(path, &size, reason);
    if (!gltf->file)
        return false;
    const bool binary = size >= 4 && memcmp(gltf->file, "glTF", 4) == 0;
    if (!binary && strcasecmp(dot, ".glb") == 0)
        return message_set(reason, "it does not begin as a .glb does");
    return load(gltf, size, binary, other);
}

void gltf_close(Gltf *gltf)
{
    const size_t count = json_array_size(json_object_get(gltf->root, "buffers"));
    for (size_t i = 0; i < count && gltf->buffers; i++)
        if (gltf->buffers[i] != gltf->bin)
            free(gltf->buffers[i]);
    free(gltf->buffers);
    free(gltf->sizes);
    free(gltf->file);
    json_decref(gltf->root);
    if (gltf->folder >= 0)
        close(gltf->folder);
}

/* Buffers */

/* RFC 4648; what is no digit is left out. */
static char *decode_base64(const char *text, size_t *size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned char values[256];
    memset(values, 255, sizeof values);
    for (unsigned char i = 0; i < 64; i++)
        values[(unsigned char)digits[i]] = i;
    char *bytes = malloc(strlen(text) / 4 * 3 + 4);
    uint32_t word = 0;
    int bits = 0;
    for (*size = 0; bytes && *text && *text != '='; text++) {
        const unsigned char value = values[(unsigned char)*text];
        if (value == 255)
            continue;
        word = word << 6 | value;
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes[(*size)++] = (char)(word >> bits & 255);
        }
    }
    return bytes;
}

static int hex(char c)
{
    return c >= '0' && c <= '9'                 ? c - '0'
           : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10
                                                : -1;
}

/* %20 and the like as the characters they stand for. */
static char *decode_uri(const char *uri)
{
    char *path = memory_text(uri), *to = path;
    for (const char *from = uri; *from; from++) {
        const bool coded = from[0] == '%' && hex(from[1]) >= 0 && hex(from[2]) >= 0;
        *to++ = coded ? (char)(16 * hex(from[1]) + hex(from[2])) : from[0];
        from += coded ? 2 : 0;
    }
    *to = '\0';
    return path;
}

static char *read_uri(const Gltf *gltf, const char *uri, size_t *size, Message *reason)
{
    const char *comma = strncmp(uri, "data:", 5) == 0 ? strchr(uri, ',') : NULL;
    if (comma)
        return decode_base64(comma + 1, size);
    char *path = decode_uri(uri), *bytes = NULL;
    const size_t letters =
        strspn(uri, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ+-.0123456789");
    if (uri[letters] == ':')
        message_set(reason, "%.80s: refused: no file in the scene's folder", uri);
    else if (input_leaves(path))
        message_set(reason, "%.80s: refused: outside the scene's folder", uri);
    else
        bytes = input_read(gltf->folder, path, path, MODEL_BYTES_MAX, size, reason);
    free(path);
    return bytes;
}

/* A buffer's bytes, which stay; NULL on failure. */
static const char *find_buffer(Gltf *gltf, json_int_t index, size_t *size)
{
    const json_t *buffer = gltf_item(gltf, "buffers", index);
    if (!buffer)
        return NULL;
    const char *uri = json_string_value(json_object_get(buffer, "uri"));
    char **bytes = &gltf->buffers[index];
    size_t *length = &gltf->sizes[index];
    if (!*bytes && !uri && index == 0 && gltf->bin) {
        *bytes = (char *)gltf->bin;
        *length = gltf->bin_size;
    } else if (!*bytes && uri) {
        *bytes = read_uri(gltf, uri, length, gltf->reason);
        gltf->total += *length;
        if (gltf->total > MODEL_BYTES_MAX)
            message_set(gltf->reason, "its buffers have more than %d bytes", MODEL_BYTES_MAX);
    } else if (!*bytes) {
        message_set(gltf->reason, "buffers %lld: it has neither a URI nor a chunk",
                    (long long)index);
    }
    const json_int_t said = gltf_whole(buffer, "byteLength", 0);
    if (*bytes && (said < 0 || (uint64_t)said > *length))
        message_set(gltf->reason, "buffers %lld: byteLength %lld, but it has %zu bytes",
                    (long long)index, (long long)said, *length);
    *size = (size_t)said;
    return gltf->reason->text[0] ? NULL : *bytes;
}

/* Accessors */

typedef struct Place {
    const char *bytes; /* NULL: all are 0 */
    size_t count, stride;
    int component; /* GL_FLOAT... */
    int size;      /* numbers of an element */
    bool normalized;
} Place;

static size_t bytes_of(int component)
{
    switch (component) {
    case 5120:
    case 5121:
        return 1;
    case 5122:
    case 5123:
        return 2;
    case 5125:
    case 5126:
        return 4;
    default:
        return 0;
    }
}

static int numbers_of(const char *type)
{
    static const struct {
        const char *type;
        int size;
    } types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                 {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    for (size_t i = 0; type && i < sizeof types / sizeof types[0]; i++)
        if (strcmp(types[i].type, type) == 0)
            return types[i].size;
    return 0;
}

/* The bytes of a part of a buffer. */
static const char *find_view(Gltf *gltf, const json_t *view, const char *name, json_int_t *length)
{
    size_t size = 0;
    const char *bytes = view ? find_buffer(gltf, gltf_whole(view, "buffer", -1), &size) : NULL;
    const json_int_t begin = gltf_whole(view, "byteOffset", 0);
    *length = gltf_whole(view, "byteLength", -1);
    if (bytes && begin >= 0 && *length >= 0 && begin <= (json_int_t)size &&
        *length <= (json_int_t)size - begin)
        return bytes + begin;
    if (bytes)
        message_set(gltf->reason,
                    "%s: its bufferView, %lld bytes from %lld on, leaves its buffer of %zu", name,
                    (long long)*length, (long long)begin, size);
    return NULL;
}

char *gltf_texture(Gltf *gltf, json_int_t index, size_t *size, Message *why)
{
    const json_t *texture = json_array_get(json_object_get(gltf->root, "textures"), (size_t)index);
    const json_t *image = json_array_get(json_object_get(gltf->root, "images"),
                                         (size_t)gltf_whole(texture, "source", -1));
    const char *uri = json_string_value(json_object_get(image, "uri"));
    json_int_t length = 0;
    if (uri)
        return read_uri(gltf, uri, size, why);
    if (!json_object_get(image, "bufferView")) {
        message_set(why, "there is no image");
        return NULL;
    }
    const json_t *view = gltf_item(gltf, "bufferViews", gltf_whole(image, "bufferView", -1));
    const char *bytes = find_view(gltf, view, "images", &length);
    *size = (size_t)length;
    return bytes ? memory_copy(bytes, *size) : NULL;
}

/* Sets where elements lie, of which all but where is known; `where` has bufferView and byteOffset.
 */
static bool find_place(Gltf *gltf, const json_t *where, const char *name, Place *place)
{
    const json_t *view = gltf_item(gltf, "bufferViews", gltf_whole(where, "bufferView", -1));
    json_int_t length;
    const char *bytes = find_view(gltf, view, name, &length);
    if (!bytes)
        return false;
    const json_int_t offset = gltf_whole(where, "byteOffset", 0);
    const json_int_t stride = gltf_whole(view, "byteStride", 0);
    const size_t element = bytes_of(place->component) * (size_t)place->size;
    place->stride = stride > 0 ? (size_t)stride : element;
    const uint64_t last = (place->count - 1) * (uint64_t)place->stride + element; /* limited */
    if (stride > 0 && (size_t)stride < element)
        return message_set(gltf->reason, "%s: byteStride %lld is less than an element's %zu bytes",
                           name, (long long)stride, element);
    if (offset < 0 || stride < 0 || stride > 1 << 20 || offset > length ||
        last > (uint64_t)(length - offset))
        return message_set(gltf->reason,
                           "%s: %zu elements from byte %lld on leave its bufferView of %lld bytes",
                           name, place->count, (long long)offset, (long long)length);
    place->bytes = bytes + offset;
    return true;
}

static double number_at(const char *bytes, int component, bool normalized)
{
    union {
        int8_t b;
        uint8_t ub;
        int16_t s;
        uint16_t us;
        uint32_t ui;
        float f;
    } v;
    memcpy(&v, bytes, bytes_of(component)); /* little-endian, as this machine is */
    switch (component) {
    case 5120:
        return normalized ? (v.b < -127 ? -1 : v.b / 127.0) : v.b;
    case 5121:
        return normalized ? v.ub / 255.0 : v.ub;
    case 5122:
        return normalized ? (v.s < -32767 ? -1 : v.s / 32767.0) : v.s;
    case 5123:
        return normalized ? v.us / 65535.0 : v.us;
    case 5125:
        return v.ui;
    default:
        return (double)v.f;
    }
}

static void read_element(const Place *place, size_t index, double *numbers)
{
    const char *bytes = place->bytes + index * place->stride;
    const size_t step = bytes_of(place->component);
    for (int k = 0; k < place->size; k++)
        numbers[k] = number_at(bytes + (size_t)k * step, place->component, place->normalized);
}

/* Some elements instead of those that the accessor has. */
static bool read_sparse(Gltf *gltf, const json_t *sparse, const Place *all, const char *name,
                        double *numbers)
{
    const json_t *at = json_object_get(sparse, "indices"),
                 *with = json_object_get(sparse, "values");
    const json_int_t count = gltf_whole(sparse, "count", -1);
    Place indices = {.size = 1, .component = (int)gltf_whole(at, "componentType", 0)};
    Place values = *all;
    if (count < 1 || count > (json_int_t)all->count || !bytes_of(indices.component))
        return message_set(gltf->reason, "%s: sparse: must have 1 to %zu indices", name,
                           all->count);
    indices.count = values.count = (size_t)count;
    if (!find_place(gltf, at, name, &indices) || !find_place(gltf, with, name, &values))
        return false;
    for (size_t i = 0; i < indices.count; i++) {
        double index;
        read_element(&indices, i, &index);
        if (!(index >= 0 && index < (double)all->count))
            return message_set(gltf->reason, "%s: sparse: index %g of %zu", name, index,
                               all->count);
        read_element(&values, i, numbers + (size_t)index * (size_t)all->size);
    }
    return true;
}

double *gltf_accessor(Gltf *gltf, json_int_t index, size_t *count, int *size)
{
    const json_t *accessor = gltf_item(gltf, "accessors", index);
    char name[40];
    snprintf(name, sizeof name, "accessors %lld", (long long)index);
    if (!accessor)
        return NULL;
    const json_int_t elements = gltf_whole(accessor, "count", -1),
                     most = 3 * (json_int_t)MODEL_TRIANGLES_MAX;
    const json_t *sparse = json_object_get(accessor, "sparse");
    Place place = {.component = (int)gltf_whole(accessor, "componentType", 0),
                   .size = numbers_of(json_string_value(json_object_get(accessor, "type"))),
                   .normalized = json_is_true(json_object_get(accessor, "normalized"))};
    if (!bytes_of(place.component) || !place.size)
        message_set(gltf->reason, "%s: its type is unknown", name);
    else if (elements < 1 || elements > most)
        message_set(gltf->reason, "%s: count %lld: must be 1 to %lld", name, (long long)elements,
                    (long long)most);
    place.count = (size_t)elements;
    if (gltf->reason->text[0] ||
        (json_object_get(accessor, "bufferView") && !find_place(gltf, accessor, name, &place)))
        return NULL;
    double *numbers = calloc(place.count * (size_t)place.size, sizeof *numbers);
    if (!numbers)
        message_set(gltf->reason, "%s: not enough memory", name);
    for (size_t i = 0; numbers && place.bytes && i < place.count; i++)
        read_element(&place, i, numbers + i * (size_t)place.size);
    if (numbers && sparse && !read_sparse(gltf, sparse, &place, name, numbers)) {
        free(numbers);
        return NULL;
    }
    *count = place.count;
    *size = place.size;
    return numbers;
}
