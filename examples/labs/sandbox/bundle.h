/*
 * bundle: a few small files in memory, so that no name chosen by a student reaches the file system.
 */
#ifndef BUNDLE_H
#define BUNDLE_H

#include "base/message.h"

#include <stddef.h>

enum {
    BUNDLE_FILES_MAX = 128,
    BUNDLE_NAME_SIZE = 256,
    BUNDLE_DEPTH_MAX = 8,
    BUNDLE_BYTES_MAX = 24 << 20, /* of all files together */
};

typedef struct BundleFile {
    char name[BUNDLE_NAME_SIZE];
    unsigned char *bytes;
    size_t size;
} BundleFile;

/* Zeroed, it is empty. */
typedef struct Bundle {
    BundleFile files[BUNDLE_FILES_MAX];
    int count;
    size_t size;
} Bundle;

/* Whether a name is a relative path that stays in its folder: no leading "/", no ".", "..", empty
 * part or control character; at most BUNDLE_DEPTH_MAX parts. */
bool bundle_name_is_safe(const char *name);

/* Adds a copy of the bytes. */
bool bundle_add(Bundle *bundle, const char *name, const void *bytes, size_t size, Message *message);

/* The file of this name; NULL: there is none. */
const BundleFile *bundle_find(const Bundle *bundle, const char *name);

/* NULL or zeroed is fine. */
void bundle_close(Bundle *bundle);

#endif
