/*
 * page_error: how far off a page's picture is. Each view's exact picture is computed and compared;
 * the bits of all of them tell whether the same is exact here and natively.
 */
#include "web/page.h"

#include "base/json_writer.h"
#include "choose/error_worker.h"
#include "kinds/scene_views.h"
#include "web/page_state.h"

#include <stdint.h>
#include <string.h>

static uint64_t add_hash(uint64_t hash, const float *values, size_t count)
{
    const unsigned char *bytes = (const unsigned char *)values;
    for (size_t i = 0; i < count * sizeof *values; i++)
        hash = (hash ^ bytes[i]) * 0x100000001b3u; /* FNV-1a */
    return hash;
}

/* A view's part of what the page shows: the exact picture, or the map of the errors. */
static bool paint(Image *to, const Image *drawn, const ExactView *view, bool exact,
                  Message *message)
{
    Image part = {.pixels = NULL};
    if (!exact)
        picture_error_map(to, drawn, view);
    else if (!reference_image(view->exact, &part, message))
        return false;
    for (int y = 0; y < part.height; y++)
        memcpy((unsigned char *)to->pixels + image_row_size(to) * (size_t)(view->top + y) +
                   4 * (size_t)view->left,
               (unsigned char *)part.pixels + image_row_size(&part) * (size_t)y,
               image_row_size(&part));
    image_close(&part);
    return true;
}

static bool compute(const ErrorPicture *drawn, PictureError *error, bool paints_exact,
                    uint64_t *hash, Message *message)
{
    Image *map = &page.image;
    for (int i = 0; i < drawn->view_count; i++) {
        const ErrorView *view = &drawn->views[i];
        Reference exact, meshes;
        const ReferenceOptions options = {
            .width = view->place[2], .height = view->place[3], .threads = 1};
        if (!reference_open(&exact, &view->scene.scene, &options, message))
            return false;
        if (!error_view_drawn(view, &options, &meshes, message)) {
            reference_close(&exact);
            return false;
        }
        const ExactView part = {.exact = &exact,
                                .scene = &view->scene.scene,
                                .drawn = meshes.lights ? &meshes : NULL,
                                .left = view->place[0],
                                .top = view->place[1]};
        picture_error_add(error, &drawn->image, &part);
        reference_close(&meshes);
        const bool painted = paint(map, &drawn->image, &part, paints_exact, message);
        *hash = add_hash(*hash, exact.color, 3 * (size_t)exact.width * (size_t)exact.height);
        reference_close(&exact);
        if (!painted)
            return false;
    }
    return true;
}

static void put_sum(JsonWriter *json, const char *name, const ErrorSum *sum)
{
    json_write_object(json, name);
    json_write_whole(json, "pixels", sum->pixels);
    json_write_whole(json, "wrong", sum->wrong);
    json_write_number(json, "rms", sum->pixels ? error_sum_rms(sum) : 0);
    json_write_number(json, "maximum", sum->maximum);
    json_write_end(json);
}

const char *page_error(int exact)
{
    ErrorPicture drawn = {.views = NULL};
    PictureError error = {.all = {0}};
    uint64_t hash = 0xcbf29ce484222325u;
    page.message = (Message){0};
    if (!page.example || !example_scene(page.example)) {
        message_set(&page.message, "no exact picture: this program draws no scene");
        return "";
    }
    const DrawRequest request = options_request(&page.options, page.example);
    if (!scene_error_picture(&page.renderer, &request, request.seconds, &drawn, &page.message))
        return "";
    Image *map = &page.image;
    for (size_t i = 0; i < image_row_size(map) * (size_t)map->height; i++)
        ((unsigned char *)map->pixels)[i] = i % 4 == 3 ? 255 : 0;
    const bool done = compute(&drawn, &error, exact != 0, &hash, &page.message);
    error_picture_close(&drawn);
    FILE *file = done ? page_text_begin() : NULL;
    if (!file)
        return "";
    char bits[20];
    snprintf(bits, sizeof bits, "%016llx", (unsigned long long)hash);
    JsonWriter json = {.file = file};
    json_write_object(&json, NULL);
    put_sum(&json, "inside", &error.interior);
    put_sum(&json, "all", &error.all);
    json_write_text(&json, "bits", bits);
    json_write_end(&json);
    return page_text_end(file);
}
