/*
 * cache: bytes kept between runs by a key of their contents, in lighting/ of XDG_CACHE_HOME or
 * ~/.cache. A convenience: whatever fails (no folder, no room, a damaged file) is a miss.
 *
 * Trusted as the user's own files are: the folder is the user's and only the user can write to it,
 * so is the file, and it ends in a miss unless its bytes have the hash that it begins with. The
 * hash finds damage, not forgery by the user. Where files of others run as the user, as in the
 * sandbox of a class, there must be no cache: XDG_CACHE_HOME is /dev/null there.
 *
 * At most CACHE_MAX bytes: the least recently used files go first. Files appear whole, by rename,
 * and one process writes at a time (others then keep nothing), so that any number may use it at
 * once.
 */
#ifndef CACHE_H
#define CACHE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { CACHE_MAX = 100000000 };

/* 128 bits of a hash; zeroed: of nothing. */
typedef struct CacheKey {
    uint64_t bits[2];
} CacheKey;
void cache_key_add(CacheKey *key, const void *bytes, size_t size);

/* The program that runs, which another or an older one is not. */
void cache_key_add_program(CacheKey *key);

/* The bytes kept under a key, to be freed; NULL: none. */
void *cache_read(const char *kind, const CacheKey *key, size_t *size);

/* Keeps bytes; `kind` is the beginning of the file's name. */
void cache_write(const char *kind, const CacheKey *key, const void *bytes, size_t size);

/* Before a driver, or fontconfig, is loaded. Mesa keeps compiled shaders in the same place, and
 * complains on standard error if it cannot make its folder, as in a home that is read-only: it is
 * then told to keep none. A pipe in its folder, for which it would wait, is removed after 3 s. */
void cache_prepare_driver(void);

#endif
