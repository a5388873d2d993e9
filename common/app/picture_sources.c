/* What a picture was drawn from. Parts that other processes have drawn are recognised by their
 * texts. */
#include "app/picture_texts.h"

#include "base/cache.h"
#include "base/memory.h"
#include "base/paths.h"
#include "core/shader_files.h"

#include <dirent.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* "side.glsl 0123456789abcdef\n". What does not fit goes, mixed, into the last line. */
static void add_source(char sources[PICTURE_SOURCES_SIZE], const char *path, const void *bytes,
                       size_t size)
{
    enum { LINE = 19, LAST = sizeof "others " + LINE };
    CacheKey key = {{0, 0}};
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    size_t used = strlen(sources);
    cache_key_add(&key, bytes, size);
    if (used + strlen(name) + LINE + LAST > PICTURE_SOURCES_SIZE) {
        name = "others";
        cache_key_add(&key, sources, used);
        if (used + LAST > PICTURE_SOURCES_SIZE)
            used -= LAST - 1;
    }
    snprintf(sources + used, PICTURE_SOURCES_SIZE - used, "%s %016" PRIx64 "\n", name, key.bits[0]);
}

/* The value of a name in lines of names and values, and its length; NULL: it is not there. */
static const char *source_value(const char *sources, const char *name, size_t length)
{
    for (const char *line = sources; *line; line = strchr(line, '\n') + 1)
        if (strncmp(line, name, length) == 0 && line[length] == ' ')
            return line + length + 1;
    return NULL;
}

/* Whether a file names another; of a large one only what stands near its ends counts. */
static bool is_named(const ImageFile *by, const char *name)
{
    enum { NEAR = 1 << 20 };
    const size_t part = by->size < NEAR ? by->size : NEAR, length = strlen(name);
    return name[0] != '.' && (memmem(by->bytes, part, name, length) ||
                              memmem(by->bytes + by->size - part, part, name, length));
}

/* What a model names in its folder, or in one below: buffers, materials, and what those name. */
static void add_named(char sources[PICTURE_SOURCES_SIZE], const char *folder, const ImageFile *by,
                      int depth)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, NULL, alphasort);
    for (int i = 0; i < count; i++) {
        const char *name = entries[i]->d_name;
        char path[PATH_MAX];
        ImageFile file = {.bytes = NULL};
        if (is_named(by, name) && !source_value(sources, name, strlen(name)) &&
            snprintf(path, sizeof path, "%s/%s", folder, name) < PATH_MAX) {
            if (image_file_read(&file, path, NULL))
                add_source(sources, name, file.bytes, file.size);
            if (depth > 0)
                add_named(sources, file.bytes ? folder : path, file.bytes ? &file : by, depth - 1);
        }
        image_file_close(&file);
        free(entries[i]);
    }
    if (count >= 0)
        free(entries);
}

/* A file that cannot be read now has the hash of nothing. `model`: it may name others. */
static void add_file(char sources[PICTURE_SOURCES_SIZE], const char *path, bool model)
{
    ImageFile file = {.bytes = NULL};
    char folder[PATH_MAX];
    const char *slash = strrchr(path, '/');
    image_file_read(&file, path, NULL);
    add_source(sources, path, file.bytes, file.size);
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path + 1) : 1,
             slash ? path : ".");
    if (model && file.bytes)
        add_named(sources, folder, &file, 2);
    image_file_close(&file);
}

void picture_texts_sources(PictureSources *sources, const Example *example, const Options *options,
                           Picture *picture)
{
    char program[PATH_MAX];
    const ShaderFiles *read = options->shaders.files;
    const int files = read ? read->count : 0;
    if (!sources->text[0] || files != sources->files) {
        sources->text[0] = '\0';
        sources->files = files;
        if (paths_program(program, NULL))
            add_file(sources->text, program, false);
        for (const Parameter *own = example->parameters; own && own->name; own++) {
            const char *path = own->kind == PARAMETER_TEXT ? *(const char **)own->value : NULL;
            if (path && own->placeholder && strcmp(own->placeholder, "FILE") == 0)
                add_file(sources->text, path, true);
        }
        for (int i = 0; i < files; i++)
            if (read->files[i].text)
                add_source(sources->text, read->files[i].path, read->files[i].text,
                           read->files[i].size);
    }
    snprintf(picture->sources, sizeof picture->sources, "%s", sources->text);
}

bool picture_texts_kept(Picture *picture)
{
    Picture *wanted = memory_copy(picture, sizeof *picture);
    Message none = {0};
    const bool kept = access(picture->path, F_OK) == 0 && picture_read(picture, &none) &&
                      picture->image.width == wanted->image.width &&
                      picture->image.height == wanted->image.height &&
                      strcmp(picture->command, wanted->command) == 0 &&
                      strcmp(picture->driver, wanted->driver) == 0 &&
                      strcmp(picture->sources, wanted->sources) == 0;
    free(wanted);
    return kept;
}

/* Adds the lines of a picture to those of the ones before it. */
static bool add_sources(PictureOrigin *origin, const Picture *picture, Message *message)
{
    const char *line = picture->sources;
    for (const char *end; (end = strchr(line, '\n')) != NULL; line = end + 1) {
        const char *space = memrchr(line, ' ', (size_t)(end - line));
        if (!space)
            break;
        const int length = (int)(space - line);
        const size_t used = strlen(origin->sources);
        const char *before = source_value(origin->sources, line, (size_t)length);
        if (before && strncmp(before, space + 1, (size_t)(end - space)) != 0)
            return message_set(message,
                               "%s: was drawn from another %.*s than those before it, which has "
                               "changed between the parts; draw all parts again",
                               picture->path, length, line);
        if (!before && used + (size_t)(end - line) + 2 < sizeof origin->sources)
            snprintf(origin->sources + used, sizeof origin->sources - used, "%.*s\n",
                     (int)(end - line), line);
    }
    return (picture->sources[0] && !line[0]) ||
           message_set(message, "%s: does not say what it was drawn from; draw its part again",
                       picture->path);
}

bool picture_texts_check(Picture *picture, PictureOrigin *origin, Message *message)
{
    char wanted[sizeof picture->command];
    memcpy(wanted, picture->command, sizeof wanted);
    if (!picture_read(picture, message))
        return false;
    if (strcmp(picture->command, wanted) != 0)
        return message_set(message, "%s: is not of this command but of: %s; draw its part again",
                           picture->path, picture->command);
    if (origin->driver[0] && strcmp(picture->driver, origin->driver) != 0)
        return message_set(message,
                           "%s: was drawn by %s, and the one before it by %s; draw all parts with "
                           "the same (--deterministic, for different processors)",
                           picture->path, picture->driver, origin->driver);
    snprintf(origin->driver, sizeof origin->driver, "%s", picture->driver);
    return add_sources(origin, picture, message);
}
