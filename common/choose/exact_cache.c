/*
 * The key is everything that the picture depends on, by value: the program (a build computes its
 * own pictures), the size, the scene with its lights and objects, and of meshes the vertices, where
 * they are the shape. Pointers are not content. Padding of structs may differ: that is a miss,
 * never a wrong picture.
 *
 * Colors are kept in 16 bits, 0.002 steps at most from the exact ones. All arrays are one block,
 * which is what the file holds.
 */
#include "choose/cheapest_task.h"

#include "reference/reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void exact_key_scene(CacheKey *key, const Scene *scene, bool meshes)
{
    Scene plain = *scene;
    plain.lights = NULL;
    plain.objects = NULL;
    cache_key_add(key, &plain, sizeof plain);
    cache_key_add(key, scene->lights, (size_t)scene->light_count * sizeof *scene->lights);
    for (int i = 0; i < scene->object_count; i++) {
        Object object = scene->objects[i];
        const Mesh *mesh = object.mesh;
        object.mesh = NULL;
        cache_key_add(key, &object, sizeof object);
        const bool seen = i > 0 && scene->objects[i - 1].mesh == mesh;
        if ((meshes || object.solid.kind == SOLID_NONE) && !seen)
            scene_key_mesh(key, mesh);
    }
}

void exact_close(Exact *exact)
{
    free(exact->colors);
    *exact = (Exact){.colors = NULL};
}

/* One block of colors, owners, objects and lights. */
static bool set_block(Exact *exact, uint16_t *block, size_t pixels, bool casts, Message *message)
{
    if (!block)
        return message_set(message, "exact picture: not enough memory");
    *exact =
        (Exact){.colors = block,
                .owner = (int16_t *)(block + 3 * pixels),
                .seen = (int16_t *)(block + 4 * pixels),
                .lights = casts ? (uint32_t *)(void *)(block + 5 * pixels + pixels % 2) : NULL};
    return true;
}

bool exact_open(Exact *exact, const Scene *scene, const int area[2], Progress *progress,
                Message *message)
{
    const bool casts = scene_has_shadows(scene);
    const size_t pixels = (size_t)area[0] * (size_t)area[1];
    const size_t size = ((casts ? 7 : 5) * pixels + (casts ? pixels % 2 : 0)) * sizeof(uint16_t);
    CacheKey key = {{0, 0}};
    size_t have = 0;
    cache_key_add_program(&key);
    cache_key_add(&key, area, 2 * sizeof *area);
    exact_key_scene(&key, scene, false);
    uint16_t *block = cache_read("exact", &key, &have);
    if (block && have == size)
        return set_block(exact, block, pixels, casts, message);
    free(block);
    Reference reference;
    const ReferenceOptions options = {.width = area[0], .height = area[1], .progress = progress};
    if (!set_block(exact, calloc(1, size), pixels, casts, message))
        return false;
    if (!reference_open(&reference, scene, &options, message)) {
        exact_close(exact);
        return false;
    }
    for (size_t i = 0; i < pixels; i++) {
        for (size_t k = 0; k < 3; k++)
            exact->colors[3 * i + k] = (uint16_t)lround(65535 * (double)reference.color[3 * i + k]);
        exact->seen[i] = (int16_t)reference.object[i];
        exact->owner[i] = reference.interior[i]                                 ? exact->seen[i]
                          : exact->seen[i] < 0 && reference.coverage[i] >= 1.0F ? -2
                                                                                : -1;
    }
    if (exact->lights)
        memcpy(exact->lights, reference.lights, pixels * sizeof *exact->lights);
    reference_close(&reference);
    cache_write("exact", &key, exact->colors, size);
    return true;
}
