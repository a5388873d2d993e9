/*
 * exact_cache: exact pictures of moments of a scene, as much as the search for the cheapest quality
 * needs, kept in base/cache.
 */
#ifndef EXACT_CACHE_H
#define EXACT_CACHE_H

#include "base/cache.h"
#include "scene/scene.h"

typedef struct Exact {
    uint16_t *colors; /* 65535 is 1 */
    int16_t *owner;   /* the object whose inside the pixel is; -1: none, and an edge may run through
                         it; -2: it is wholly background */
    int16_t *seen;    /* the object at its center; -1: none */
    uint32_t *lights; /* see Reference; NULL: no light casts shadows */
    size_t inside;    /* pixels with an owner */
} Exact;

/* From the cache, or computed and put there. The scene has at most INT16_MAX objects. */
bool exact_open(Exact *exact, const Scene *scene, int width, int height, Message *message);
void exact_close(Exact *exact); /* a zeroed one is fine */

/* Adds to a key all that a scene's exact picture depends on; with `meshes` those that stand for
 * solids, too. */
void exact_key_scene(CacheKey *key, const Scene *scene, bool meshes);

#endif
