#include "study/measure/setting_picture.h"

#include "base/clock.h"
#include "base/memory.h"
#include "reference/picture_error.h"
#include "scene/shader_cost.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_CANVASES = 16, MAX_LIGHTINGS = 16 };

struct SettingRenderer {
    ShaderLoader loader;
    int width, height;
    Canvas first; /* owns the context */
    struct {
        CanvasOptions options;
        Canvas canvas;
    } canvases[MAX_CANVASES];
    int canvas_count;
    struct {
        QualityLoader loader;
        Lighting *lighting;
    } lightings[MAX_LIGHTINGS];
    int lighting_count;
    SolidMeshes meshes;
    GLuint timer;
};

bool setting_renderer_open(SettingRenderer **opened, const ShaderLoader *loader,
                           const CanvasBackend *backend, int width, int height, Message *message)
{
    SettingRenderer *renderer = memory_new(1, sizeof *renderer);
    *opened = renderer;
    const CanvasOptions options = {.backend = backend, .width = width, .height = height};
    renderer->loader = *loader;
    renderer->width = width;
    renderer->height = height;
    if (!canvas_open(&renderer->first, &options, message)) {
        setting_renderer_close(renderer);
        *opened = NULL;
        return false;
    }
    if (glGenQueriesEXT) {
        GLint bits = 0;
        glGetQueryivEXT(GL_TIME_ELAPSED_EXT, GL_QUERY_COUNTER_BITS_EXT, &bits);
        if (bits > 0)
            glGenQueriesEXT(1, &renderer->timer);
    }
    return true;
}

const char *setting_renderer_version(const SettingRenderer *renderer)
{
    return renderer->first.version;
}

const char *setting_renderer_name(const SettingRenderer *renderer)
{
    return renderer->first.renderer;
}

void setting_renderer_forget(SettingRenderer *renderer)
{
    for (const SolidMesh *made = renderer->meshes.first; made; made = made->next)
        for (int i = 0; i < renderer->lighting_count; i++)
            lighting_forget(renderer->lightings[i].lighting, &made->mesh);
    solid_meshes_close(&renderer->meshes);
}

static const Canvas *find_canvas(SettingRenderer *renderer, const Quality *quality,
                                 Message *message)
{
    const CanvasOptions wanted = quality_canvas(quality, renderer->width, renderer->height);
    for (int i = 0; i < renderer->canvas_count; i++) {
        const CanvasOptions *have = &renderer->canvases[i].options;
        if (have->samples == wanted.samples && have->supersample == wanted.supersample &&
            have->real == wanted.real)
            return &renderer->canvases[i].canvas;
    }
    if (renderer->canvas_count == MAX_CANVASES) {
        message_set(message, "study: more than %d kinds of framebuffers", MAX_CANVASES);
        return NULL;
    }
    Canvas *canvas = &renderer->canvases[renderer->canvas_count].canvas;
    if (!canvas_open_beside(canvas, &renderer->first, &wanted, message))
        return NULL;
    renderer->canvases[renderer->canvas_count++].options = wanted;
    return canvas;
}

static Lighting *find_lighting(SettingRenderer *renderer, const Quality *quality, Message *message)
{
    QualityLoader loader;
    quality_loader(&loader, &renderer->loader, quality);
    for (int i = 0; i < renderer->lighting_count; i++) {
        const QualityLoader *have = &renderer->lightings[i].loader;
        if (have->loader.precision == loader.loader.precision &&
            memcmp(have->replacements, loader.replacements, sizeof loader.replacements) == 0)
            return renderer->lightings[i].lighting;
    }
    if (renderer->lighting_count == MAX_LIGHTINGS) {
        message_set(message, "study: more than %d kinds of programs", MAX_LIGHTINGS);
        return NULL;
    }
    /* The loader points into itself, so it must not move. */
    QualityLoader *place = &renderer->lightings[renderer->lighting_count].loader;
    Lighting **lighting = &renderer->lightings[renderer->lighting_count].lighting;
    quality_loader(place, &renderer->loader, quality);
    if (!lighting_open(lighting, &place->loader, message))
        return NULL;
    renderer->lighting_count++;
    return *lighting;
}

static void clear(const SettingPicture *drawing)
{
    canvas_clear(drawing->canvas, drawing->made.scene.background, 0); /* see pixel_is_interior */
}

bool setting_picture_open(SettingPicture *drawing, SettingRenderer *renderer, const Scene *scene,
                          const Quality *quality, Message *message)
{
    double wall, gpu;
    *drawing = (SettingPicture){.quality = *quality};
    if (!quality_scene_open(&drawing->made, scene, quality, &renderer->meshes, message))
        return false;
    drawing->canvas = find_canvas(renderer, quality, message);
    drawing->lighting = drawing->canvas ? find_lighting(renderer, quality, message) : NULL;
    if (!drawing->lighting || !scene_check(&drawing->made.scene, message) ||
        !image_open(&drawing->image, renderer->width, renderer->height,
                    drawing->canvas->real ? IMAGE_FLOAT : IMAGE_BYTE, message) ||
        !setting_picture_frame(drawing, renderer, &wall, &gpu, message)) {
        setting_picture_close(drawing);
        return false;
    }
    return true;
}

bool setting_picture_frame(SettingPicture *drawing, SettingRenderer *renderer, double *wall,
                           double *gpu, Message *message)
{
    lighting_use_transforms(drawing->lighting, transforms_of(&drawing->quality));
    glFinish();
    const double start = clock_now();
    if (renderer->timer)
        glBeginQueryEXT(GL_TIME_ELAPSED_EXT, renderer->timer);
    clear(drawing);
    if (!lighting_show(drawing->lighting,
                       &(LightingFrame){.scene = &drawing->made.scene,
                                        .aspect = (double)renderer->width / renderer->height},
                       message))
        return false;
    if (renderer->timer)
        glEndQueryEXT(GL_TIME_ELAPSED_EXT);
    glFinish();
    if (!canvas_read(drawing->canvas, &drawing->image, message))
        return false;
    *wall = clock_now() - start;
    *gpu = NAN;
    if (renderer->timer) {
        GLuint64 nanoseconds = 0;
        GLint disjoint = 0;
        glGetQueryObjectui64vEXT(renderer->timer, GL_QUERY_RESULT_EXT, &nanoseconds);
        glGetIntegerv(GL_GPU_DISJOINT_EXT, &disjoint);
        if (!disjoint && nanoseconds > 0)
            *gpu = 1e-9 * (double)nanoseconds;
    }
    return true;
}

bool setting_picture_empty(SettingPicture *drawing, double *wall, Message *message)
{
    glFinish();
    const double start = clock_now();
    clear(drawing);
    glFinish();
    if (!canvas_read(drawing->canvas, &drawing->image, message))
        return false;
    *wall = clock_now() - start;
    return true;
}

void setting_picture_error(const SettingPicture *drawing, const Reference *exact, ResultRow *row)
{
    PictureError found = {.all = {0}};
    picture_error_add(&found, &drawing->image,
                      &(ExactView){.exact = exact, .scene = &drawing->made.scene});
    row->interior_rms = error_sum_rms(&found.interior);
    row->interior_maximum = found.interior.pixels ? found.interior.maximum : NAN;
    row->all_rms = error_sum_rms(&found.all);
    row->all_maximum = found.all.maximum;
    row->interior_pixels = (int)found.interior.pixels;
}

/* -1: they cannot be counted. */
static int count_operations(const ShaderSource *source, ShaderStage stage)
{
    ShaderCost operations;
    return shader_cost(source->text, stage, &operations, NULL)
               ? operations.arithmetic + operations.special
               : -1;
}

static bool is_covered(const Image *image, size_t pixel)
{
    return image->type == IMAGE_BYTE ? ((const unsigned char *)image->pixels)[4 * pixel + 3] >= 128
                                     : ((const float *)image->pixels)[4 * pixel + 3] >= 0.5F;
}

bool setting_picture_counts(const SettingPicture *drawing, SettingRenderer *renderer,
                            ResultRow *row, Message *message)
{
    const Scene *scene = &drawing->made.scene;
    const int side = drawing->canvas->supersample;
    row->vertices = row->fragments = 0;
    row->vertex_operations = row->fragment_operations = -1;
    for (int i = 0; i < scene->object_count; i++) {
        ShaderSource sources[2];
        const Object *object = &scene->objects[i];
        const bool flattened = scene->interpolation == INTERPOLATION_FLAT && !object->flat;
        row->vertices +=
            (long long)(flattened ? object->mesh->index_count : object->mesh->vertex_count);
        if (!lighting_sources(drawing->lighting, scene, object, false, sources, message))
            return false;
        const int vertex = count_operations(&sources[SHADER_VERTEX], SHADER_VERTEX);
        const int fragment = count_operations(&sources[SHADER_FRAGMENT], SHADER_FRAGMENT);
        shader_source_close(&sources[SHADER_VERTEX]);
        shader_source_close(&sources[SHADER_FRAGMENT]);
        if (vertex > row->vertex_operations)
            row->vertex_operations = vertex;
        if (fragment > row->fragment_operations)
            row->fragment_operations = fragment;
    }
    for (size_t i = 0; i < (size_t)renderer->width * (size_t)renderer->height; i++)
        row->fragments += is_covered(&drawing->image, i) ? side * side : 0;
    return true;
}

void setting_picture_close(SettingPicture *drawing)
{
    if (!drawing)
        return;
    scene_copy_close(&drawing->made);
    image_close(&drawing->image);
    *drawing = (SettingPicture){.lighting = NULL};
}

void setting_renderer_close(SettingRenderer *renderer)
{
    if (!renderer)
        return;
    setting_renderer_forget(renderer);
    for (int i = 0; i < renderer->lighting_count; i++)
        lighting_close(renderer->lightings[i].lighting);
    for (int i = 0; i < renderer->canvas_count; i++)
        canvas_close(&renderer->canvases[i].canvas);
    if (renderer->timer)
        glDeleteQueriesEXT(1, &renderer->timer);
    canvas_close(&renderer->first);
    free(renderer);
}
