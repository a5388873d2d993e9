#include "labs/sandbox/bundle.h"

#include "base/output.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool bundle_name_is_safe(const char *name)
{
    int depth = 1;
    if (!name[0] || strlen(name) >= BUNDLE_NAME_SIZE)
        return false;
    for (const char *part = name;; depth++) {
        const size_t length = strcspn(part, "/");
        if (length == 0 || (length == 1 && part[0] == '.') ||
            (length == 2 && part[0] == '.' && part[1] == '.'))
            return false;
        if (!part[length])
            break;
        part += length + 1;
    }
    for (const char *at = name; *at; at++)
        if ((unsigned char)*at < ' ' || *at == 0x7F)
            return false;
    return depth <= BUNDLE_DEPTH_MAX;
}

bool bundle_add(Bundle *bundle, const char *name, const void *bytes, size_t size, Message *message)
{
    if (!bundle_name_is_safe(name))
        return message_set(message, "invalid file name: empty, too long, or outside its folder");
    if (bundle->count == BUNDLE_FILES_MAX)
        return message_set(message, "%s: more than %d files", name, BUNDLE_FILES_MAX);
    if (size > BUNDLE_BYTES_MAX - bundle->size)
        return message_set(message, "%s: more than %d MB in all", name, BUNDLE_BYTES_MAX >> 20);
    if (bundle_find(bundle, name))
        return message_set(message, "%s: exists twice", name);
    unsigned char *copy = malloc(size + 1);
    if (!copy)
        return message_set(message, "%s: %s", name, strerror(ENOMEM));
    if (size)
        memcpy(copy, bytes, size);
    copy[size] = '\0'; /* safe to read as text */
    BundleFile *file = &bundle->files[bundle->count++];
    memcpy(file->name, name, strlen(name) + 1);
    file->bytes = copy;
    file->size = size;
    bundle->size += size;
    return true;
}

const BundleFile *bundle_find(const Bundle *bundle, const char *name)
{
    for (int i = 0; i < bundle->count; i++)
        if (strcmp(bundle->files[i].name, name) == 0)
            return &bundle->files[i];
    return NULL;
}

bool bundle_write(const Bundle *bundle, int file, Message *message)
{
    bool done = true;
    for (int i = 0; i < bundle->count && done; i++) {
        const BundleFile *of = &bundle->files[i];
        char line[BUNDLE_NAME_SIZE + 32];
        const int length = snprintf(line, sizeof line, "%zu %s\n", of->size, of->name);
        done =
            output_append(file, line, (size_t)length) && output_append(file, of->bytes, of->size);
    }
    if (!done || !output_append(file, "end\n", 4))
        return message_set(message, "the sandbox's files: %s", strerror(errno));
    return true;
}

/* Reads "SIZE NAME\n" and advances *text. */
static bool read_line(const char **text, const char *end, size_t *size, char name[BUNDLE_NAME_SIZE])
{
    const char *at = *text;
    const char *line_end = memchr(at, '\n', (size_t)(end - at));
    int digits = 0;
    *size = 0;
    for (; line_end && at < line_end && *at >= '0' && *at <= '9' && digits < 9; at++, digits++)
        *size = *size * 10 + (size_t)(*at - '0');
    if (!line_end || digits == 0 || at == line_end || *at++ != ' ')
        return false;
    const size_t length = (size_t)(line_end - at);
    if (length >= BUNDLE_NAME_SIZE || memchr(at, '\0', length))
        return false;
    memcpy(name, at, length);
    name[length] = '\0';
    *text = line_end + 1;
    return true;
}

bool bundle_read(Bundle *bundle, const void *bytes, size_t size, Message *message)
{
    const char *text = bytes, *end = text + size;
    while (end - text != 4 || memcmp(text, "end\n", 4) != 0) {
        char name[BUNDLE_NAME_SIZE];
        size_t length;
        if (text == end || !read_line(&text, end, &length, name) || length > (size_t)(end - text))
            return message_set(message, "its output is cut or broken");
        if (!bundle_add(bundle, name, text, length, message))
            return false;
        text += length;
    }
    return true;
}

void bundle_close(Bundle *bundle)
{
    if (!bundle)
        return;
    for (int i = 0; i < bundle->count; i++)
        free(bundle->files[i].bytes);
    *bundle = (Bundle){.count = 0};
}
