/*
 * manifest: the SHA-256 of every picture of a gallery, and how other pictures differ from them.
 *
 * The file is one of sha256sum, with comments:
 *
 *   # gallery --size 200x200          the command
 *   HASH  LightedCube.png             of the file
 *   # pixels HASH                     of its pixels: size and RGBA, without what the file says
 */
#ifndef MANIFEST_H
#define MANIFEST_H

#include "images/picture_queue.h"

enum { MANIFEST_HASH_SIZE = 65, MANIFEST_MAX = 128 };

typedef struct ManifestEntry {
    char name[64]; /* of the program */
    char file[MANIFEST_HASH_SIZE], pixels[MANIFEST_HASH_SIZE];
} ManifestEntry;

typedef struct Manifest {
    char command[1024];
    ManifestEntry entries[MANIFEST_MAX];
    int count;
} Manifest;

/* Whether this program was built with a library for SHA-256. */
bool manifest_possible(Message *message);

/* Adds a picture by its name and its file. */
bool manifest_add(Manifest *manifest, const char *name, const ImageFile *file, Message *message);

bool manifest_write(const Manifest *manifest, const char *path, Message *message);
bool manifest_read(Manifest *manifest, const char *path, Message *message);

/* NULL if there is none of that name. */
const ManifestEntry *manifest_find(const Manifest *manifest, const char *name);

typedef enum ManifestResult {
    MANIFEST_SAME,   /* the same file */
    MANIFEST_PIXELS, /* the same pixels: other texts, or compressed otherwise */
    MANIFEST_DIFFERENT,
    MANIFEST_FAILED,
} ManifestResult;

/* Compares a picture with the entry of its name. */
ManifestResult manifest_compare(const ManifestEntry *entry, const ImageFile *file,
                                Message *message);

#endif
