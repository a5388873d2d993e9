/*
 * Whether a PLY file ends where its header says. Assimp draws what there is of one that was cut,
 * for example by a download that broke off.
 *
 * The header names elements, each with a number of rows and with properties: a number each, or a
 * list, which begins with its length. So the end of a row is known only by reading the lists'
 * lengths: one pass over the file's words or bytes. Of 500,000 triangles it takes 4% of Assimp's
 * time in bytes, and a quarter in words. (Greg Turk, "The PLY Polygon File Format", 1994.)
 */
#include "scene/assimp_files.h"

#include <ctype.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PROPERTIES_MAX = 64, LINE_SIZE = 256 };

typedef struct Property {
    int length_bytes; /* of a list's length; 0: no list */
    int bytes;        /* of a number */
} Property;

typedef struct Ply {
    const char *next, *end;
    bool words, big_endian;
} Ply;

static int type_bytes(const char *name)
{
    static const struct {
        const char *names;
        int bytes;
    } types[] = {{" char uchar int8 uint8 ", 1},
                 {" short ushort int16 uint16 ", 2},
                 {" int uint float int32 uint32 float32 ", 4},
                 {" double float64 ", 8}};
    char word[34];
    snprintf(word, sizeof word, " %.31s ", name);
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++)
        if (strstr(types[i].names, word))
            return types[i].bytes;
    return 0;
}

static bool next_line(Ply *ply, char line[LINE_SIZE])
{
    const char *end = memchr(ply->next, '\n', (size_t)(ply->end - ply->next));
    if (!end)
        return false;
    snprintf(line, LINE_SIZE, "%.*s", (int)(end - ply->next), ply->next);
    ply->next = end + 1;
    return true;
}

/* Skips numbers, the first of which, not negative, is stored unless `first` is NULL. */
static bool skip(Ply *ply, size_t count, int bytes, size_t *first)
{
    const size_t left = (size_t)(ply->end - ply->next);
    size_t value = 0;
    if (!ply->words) {
        if (count > left / (size_t)bytes)
            return false;
        for (int i = 0; first && i < bytes; i++)
            value = value << 8 | (uint8_t)ply->next[ply->big_endian ? i : bytes - 1 - i];
        ply->next += count * (size_t)bytes;
    }
    for (size_t i = 0; ply->words && i < count; i++) {
        while (ply->next < ply->end && isspace((unsigned char)*ply->next))
            ply->next++;
        if (ply->next == ply->end)
            return false;
        for (; ply->next < ply->end && !isspace((unsigned char)*ply->next); ply->next++)
            value = isdigit((unsigned char)*ply->next) ? 10 * value + (size_t)(*ply->next - '0')
                                                       : value;
    }
    if (first)
        *first = value;
    return true;
}

static bool skip_row(Ply *ply, const Property *properties, int count)
{
    for (int i = 0; i < count; i++) {
        size_t length = 1;
        if (properties[i].length_bytes && !skip(ply, 1, properties[i].length_bytes, &length))
            return false;
        if (!skip(ply, length, properties[i].bytes, NULL))
            return false;
    }
    return true;
}

typedef struct Element {
    char name[32];
    size_t rows;
    Property properties[PROPERTIES_MAX];
    int count;
} Element;

enum { ELEMENTS_MAX = 16 };

/* The elements of the header; 0 where it is not as in the paper: Assimp may still read it. */
static int read_header(Ply *ply, Element elements[ELEMENTS_MAX])
{
    char line[LINE_SIZE], first[32], second[32], word[32];
    int count = 0;
    if (!next_line(ply, line) || strncmp(line, "ply", 3) != 0)
        return 0;
    while (next_line(ply, line) && strncmp(line, "end_header", 10) != 0) {
        Element *last = count ? &elements[count - 1] : NULL;
        const bool room = last && last->count < PROPERTIES_MAX;
        if (sscanf(line, "format %31s", word) == 1) {
            ply->words = strcmp(word, "ascii") == 0;
            ply->big_endian = strcmp(word, "binary_big_endian") == 0;
        } else if (strncmp(line, "property ", 9) == 0 && !room) {
            return 0;
        } else if (sscanf(line, "property list %31s %31s", first, second) == 2) {
            last->properties[last->count++] = (Property){type_bytes(first), type_bytes(second)};
        } else if (sscanf(line, "property %31s", first) == 1) {
            last->properties[last->count++] = (Property){.bytes = type_bytes(first)};
        } else if (strncmp(line, "element ", 8) == 0) {
            Element element = {.count = 0};
            if (count == ELEMENTS_MAX ||
                sscanf(line, "element %31s %zu", element.name, &element.rows) != 2)
                return 0;
            elements[count++] = element;
        }
    }
    for (int i = 0; i < count; i++)
        for (int k = 0; k < elements[i].count; k++)
            if (!elements[i].properties[k].bytes)
                return 0;
    return count;
}

static bool is_whole(Ply *ply, char *reason, size_t reason_size)
{
    Element elements[ELEMENTS_MAX];
    const int count = read_header(ply, elements);
    for (int i = 0; i < count; i++) {
        for (size_t row = 0; row < elements[i].rows && elements[i].count > 0; row++)
            if (!skip_row(ply, elements[i].properties, elements[i].count)) {
                snprintf(reason, reason_size, "the file ends within %s %zu of %zu",
                         elements[i].name, row + 1, elements[i].rows);
                return false;
            }
    }
    return true;
}

bool model_ply_is_whole(const char *path, char *reason, size_t reason_size)
{
    struct stat status;
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    bool whole = true;
    if (file >= 0 && fstat(file, &status) == 0 && status.st_size > 0) {
        const size_t size = (size_t)status.st_size;
        const char *bytes = mmap(NULL, size, PROT_READ, MAP_PRIVATE, file, 0);
        if (bytes != MAP_FAILED) {
            whole = is_whole(&(Ply){.next = bytes, .end = bytes + size}, reason, reason_size);
            munmap((void *)bytes, size);
        }
    }
    if (file >= 0)
        close(file);
    return whole;
}
