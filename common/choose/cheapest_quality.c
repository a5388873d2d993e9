/*
 * A choice depends on the scene, the allowed error, the canvas, the driver and the shaders, which
 * may have been edited: all are the key under which it is kept in base/cache.
 */
#include "choose/cheapest_quality.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

static bool choice_key(CacheKey *key, const CheapestQualityTask *task, Message *message)
{
    const Canvas *canvas = task->canvas;
    const double numbers[] = {task->error,    task->kept,      task->full,   task->moments,
                              task->moving,   canvas->samples, canvas->real, canvas->supersample,
                              task->place[2], task->place[3]};
    const ShadowSettings shadows = lighting_shadows(task->lighting);
    const double ways[] = {shadows.way,    shadows.map_size, shadows.smooth,
                           shadows.bias.x, shadows.bias.y,   shadows.bias.z};
    *key = (CacheKey){{1, 0}};
    cache_key_add_program(key);
    cache_key_add(key, ways, sizeof ways);
    cache_key_add(key, numbers, sizeof numbers);
    cache_key_add(key, canvas->renderer, strlen(canvas->renderer));
    cache_key_add(key, canvas->version, strlen(canvas->version));
    for (int moment = 0; moment < task->moments; moment++) {
        Scene scene;
        if (!task->scene(task->data, moment, &scene, message))
            return false;
        exact_key_scene(key, &scene, true);
        /* The shaders may have been edited. */
        for (int full = 0; full < 2 && moment == 0 && scene.object_count; full++) {
            ShaderSource sources[2];
            if (!lighting_sources(task->lighting, &scene, &scene.objects[0], full, sources,
                                  message))
                return false;
            for (int stage = 0; stage < 2; stage++) {
                cache_key_add(key, sources[stage].text, strlen(sources[stage].text));
                shader_source_close(&sources[stage]);
            }
        }
    }
    return true;
}

static bool read_choice(CheapestQuality *cheapest, const CacheKey *key, int count)
{
    const size_t objects = (size_t)count * sizeof *cheapest->objects;
    size_t size = 0;
    char *bytes = cache_read("choice", key, &size);
    const bool found = bytes && size == sizeof *cheapest + objects;
    if (found) {
        ObjectQuality *own = cheapest->objects;
        memcpy(cheapest, bytes, sizeof *cheapest);
        cheapest->objects = own;
        cheapest->cached = true;
        memcpy(own, bytes + sizeof *cheapest, objects);
    }
    free(bytes);
    return found && cheapest->count == count;
}

static void write_choice(const CheapestQuality *cheapest, const CacheKey *key)
{
    const size_t objects = (size_t)cheapest->count * sizeof *cheapest->objects;
    char *bytes = memory_new(1, sizeof *cheapest + objects);
    CheapestQuality plain = *cheapest;
    plain.objects = NULL;
    memcpy(bytes, &plain, sizeof plain);
    memcpy(bytes + sizeof plain, cheapest->objects, objects);
    cache_write("choice", key, bytes, sizeof plain + objects);
    free(bytes);
}

bool cheapest_quality_find(CheapestQuality *cheapest, const CheapestQualityTask *task,
                           Message *message)
{
    Scene scene;
    CacheKey key;
    *cheapest = (CheapestQuality){.count = 0};
    if (!choice_key(&key, task, message) || !task->scene(task->data, 0, &scene, message))
        return false;
    const int count = scene.object_count;
    if (count > INT16_MAX)
        return message_set(message, "cheapest: %d objects: at most %d", count, INT16_MAX);
    *cheapest = (CheapestQuality){.objects = memory_new((size_t)count, sizeof *cheapest->objects),
                                  .count = count};
    if (count == 0 || read_choice(cheapest, &key, count))
        return true;
    cheapest->count = count;
    cheapest->cached = false;
    const bool done = cheapest_search(cheapest, task, message);
    canvas_begin(task->canvas);
    if (done)
        write_choice(cheapest, &key);
    else
        cheapest_quality_close(cheapest);
    return done;
}

void cheapest_quality_close(CheapestQuality *cheapest)
{
    if (!cheapest)
        return;
    free(cheapest->objects);
    *cheapest = (CheapestQuality){.objects = NULL};
}

/* What was simplified: "object 0: 24 divisions, lit per vertex, viewer at infinity". */
static void write_simplified(const CheapestQuality *cheapest, const Scene *scene, FILE *file)
{
    const ObjectQuality plain = object_quality_plain(scene);
    int written = 0;
    for (int i = 0; i < cheapest->count; i++) {
        const ObjectQuality *quality = &cheapest->objects[i];
        const char *before = "";
        if (object_quality_equal(quality, &plain))
            continue;
        fprintf(file, "%sobject %d: ", written++ ? "; " : "", i);
        if (quality->divisions) {
            fprintf(file, "%d divisions", quality->divisions);
            before = ", ";
        }
        const struct {
            bool there;
            const char *what;
            int count;
        } all[] = {
            {quality->interpolation != plain.interpolation,
             quality->interpolation == INTERPOLATION_PHONG ? "lit per fragment" : "lit per vertex",
             0},
            {quality->distant_viewer && !plain.distant_viewer, "viewer at infinity", 0},
            {quality->skip_renormalization && !plain.skip_renormalization,
             "normals as interpolated", 0},
            {quality->far_lights != 0, "at infinity", __builtin_popcount(quality->far_lights)},
            {quality->matte_lights != 0, "without highlight",
             __builtin_popcount(quality->matte_lights)},
            {quality->dark_lights != 0, "off", __builtin_popcount(quality->dark_lights)},
        };
        for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
            if (!all[k].there)
                continue;
            fputs(before, file);
            if (all[k].count)
                fprintf(file, "%d of %d lights ", all[k].count, scene->light_count);
            fputs(all[k].what, file);
            before = ", ";
        }
    }
    if (!written)
        fprintf(file, "as the scene says");
}

static void write_left_out(const LeftOut *left_out, const LeftOut *plain, const char *where,
                           FILE *file)
{
    fprintf(file, "%lld %s", left_out->pixels, where);
    if (left_out->pixels)
        fprintf(file, ", by up to %.1f", left_out->largest);
    fprintf(file, " (plain: %lld", plain->pixels);
    if (plain->pixels)
        fprintf(file, ", by up to %.1f", plain->largest);
    fprintf(file, ")");
}

void cheapest_quality_write(const CheapestQuality *cheapest, const Scene *scene, double allowed,
                            FILE *file)
{
    write_simplified(cheapest, scene, file);
    fprintf(file, "; error %.2f of %g allowed inside objects (plain: %.2f)", cheapest->error,
            allowed, cheapest->plain_error);
    fprintf(file, ", expected cost %.0f (plain: %.0f)", cheapest->cost, cheapest->plain_cost);
    if (cheapest->moments > 1)
        fprintf(file, ", at %d moments, and %.2f in reserve", cheapest->moments, cheapest->margin);
    fprintf(file, "; not counted, but off by more than %g: ", allowed);
    if (scene_has_shadows(scene)) {
        char where[80];
        snprintf(where, sizeof where, "of %lld pixels inside objects, at edges of shadows",
                 cheapest->inside);
        write_left_out(&cheapest->left_out[LEFT_OUT_SHADOWS],
                       &cheapest->plain_left_out[LEFT_OUT_SHADOWS], where, file);
        fprintf(file, "; ");
    }
    write_left_out(&cheapest->left_out[LEFT_OUT_OUTLINES],
                   &cheapest->plain_left_out[LEFT_OUT_OUTLINES], "pixels at outlines", file);
}
