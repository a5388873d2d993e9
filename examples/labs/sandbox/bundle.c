/* A list of files, few enough to search from the start. */
#include "labs/sandbox/bundle.h"

#include "base/memory.h"

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
    BundleFile *file = &bundle->files[bundle->count++];
    memcpy(file->name, name, strlen(name) + 1);
    file->bytes = memory_copy(bytes, size); /* ended by a zero byte: safe to read as text */
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

void bundle_close(Bundle *bundle)
{
    if (!bundle)
        return;
    for (int i = 0; i < bundle->count; i++)
        free(bundle->files[i].bytes);
    *bundle = (Bundle){.count = 0};
}
