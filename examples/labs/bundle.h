/*
 * bundle: a few small files in memory, and as one stream of bytes.
 *
 * What goes into a sandbox and what comes out of it goes as such a stream: no folder is shared, and
 * no name that somebody else chose ever reaches the file system outside.
 */
#ifndef BUNDLE_H
#define BUNDLE_H

#include "message.h"

#include <stddef.h>

enum {
    BUNDLE_FILES_MOST = 128,
    BUNDLE_NAME_SIZE = 256,
    BUNDLE_DEPTH_MOST = 8,
    BUNDLE_BYTES_MOST = 24 << 20, /* of all files together */
};

typedef struct BundleFile {
    char name[BUNDLE_NAME_SIZE];
    unsigned char *bytes;
    size_t size;
} BundleFile;

/* Zeroed, it is empty. */
typedef struct Bundle {
    BundleFile files[BUNDLE_FILES_MOST];
    int count;
    size_t size;
} Bundle;

/* Whether a name is a path of a file below some folder and nothing else: no "/" at its start, no
 * ".", "..", empty part or control character; of at most BUNDLE_DEPTH_MOST parts. */
bool bundle_name_is_safe(const char *name);

/* Adds a copy of the bytes. */
bool bundle_add(Bundle *bundle, const char *name, const void *bytes, size_t size, Message *message);

/* The file of this name; NULL: there is none. */
const BundleFile *bundle_find(const Bundle *bundle, const char *name);

/* Writes the stream: for each file a line "SIZE NAME" and its bytes, then a line "end". */
bool bundle_write(const Bundle *bundle, int file, Message *message);

/* Adds the files of a stream that anybody may have made. False, with a message, where anything
 * about it is not as bundle_write writes it, or too much. */
bool bundle_read(Bundle *bundle, const void *bytes, size_t size, Message *message);

/* NULL or zeroed is fine. */
void bundle_close(Bundle *bundle);

#endif
