#include "study/measure/studio.h"

#include "base/clock.h"
#include "reference/picture_error.h"
#include "scene/shader_cost.h"
#include "study/measure/transforms.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_CANVASES = 16, MAX_LIGHTINGS = 16, MAX_COUNTED = 512 };

/* Operation counts by shader text: each text is counted once. */
typedef struct Counted {
    char *text;
    int operations;
} Counted;

struct Studio {
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
    Counted counted[2][MAX_COUNTED]; /* by ShaderStage */
    int counted_count[2];
};

bool studio_open(Studio **opened, const ShaderLoader *loader, const CanvasBackend *backend,
                 int width, int height, Message *message)
{
    Studio *studio = calloc(1, sizeof *studio);
    *opened = studio;
    if (!studio)
        return message_set(message, "study: not enough memory");
    const CanvasOptions options = {.backend = backend, .width = width, .height = height};
    studio->loader = *loader;
    studio->width = width;
    studio->height = height;
    if (!canvas_open(&studio->first, &options, message)) {
        studio_close(studio);
        *opened = NULL;
        return false;
    }
    if (glGenQueriesEXT) {
        GLint bits = 0;
        glGetQueryivEXT(GL_TIME_ELAPSED_EXT, GL_QUERY_COUNTER_BITS_EXT, &bits);
        if (bits > 0)
            glGenQueriesEXT(1, &studio->timer);
    }
    return true;
}

const char *studio_version(const Studio *studio)
{
    return studio->first.version;
}

const char *studio_renderer(const Studio *studio)
{
    return studio->first.renderer;
}

void studio_forget(Studio *studio)
{
    for (const SolidMesh *made = studio->meshes.first; made; made = made->next)
        for (int i = 0; i < studio->lighting_count; i++)
            lighting_forget(studio->lightings[i].lighting, &made->mesh);
    solid_meshes_close(&studio->meshes);
}

static const Canvas *find_canvas(Studio *studio, const Quality *quality, Message *message)
{
    const CanvasOptions wanted = quality_canvas(quality, studio->width, studio->height);
    for (int i = 0; i < studio->canvas_count; i++) {
        const CanvasOptions *have = &studio->canvases[i].options;
        if (have->samples == wanted.samples && have->supersample == wanted.supersample &&
            have->real == wanted.real)
            return &studio->canvases[i].canvas;
    }
    if (studio->canvas_count == MAX_CANVASES) {
        message_set(message, "study: more than %d kinds of framebuffers", MAX_CANVASES);
        return NULL;
    }
    Canvas *canvas = &studio->canvases[studio->canvas_count].canvas;
    if (!canvas_open_beside(canvas, &studio->first, &wanted, message))
        return NULL;
    studio->canvases[studio->canvas_count++].options = wanted;
    return canvas;
}

static Lighting *find_lighting(Studio *studio, const Quality *quality, Message *message)
{
    QualityLoader loader;
    quality_loader(&loader, &studio->loader, quality);
    for (int i = 0; i < studio->lighting_count; i++) {
        const QualityLoader *have = &studio->lightings[i].loader;
        if (have->loader.precision == loader.loader.precision &&
            memcmp(have->replacements, loader.replacements, sizeof loader.replacements) == 0)
            return studio->lightings[i].lighting;
    }
    if (studio->lighting_count == MAX_LIGHTINGS) {
        message_set(message, "study: more than %d kinds of programs", MAX_LIGHTINGS);
        return NULL;
    }
    /* The loader points into itself, so it must not move. */
    QualityLoader *place = &studio->lightings[studio->lighting_count].loader;
    Lighting **lighting = &studio->lightings[studio->lighting_count].lighting;
    quality_loader(place, &studio->loader, quality);
    if (!lighting_open(lighting, &place->loader, message))
        return NULL;
    studio->lighting_count++;
    return *lighting;
}

static void clear(const Drawing *drawing)
{
    canvas_clear(drawing->canvas, drawing->made.scene.background, 0); /* see pixel_is_interior */
}

static double aspect_of(const Studio *studio)
{
    return (double)studio->width / studio->height;
}

bool drawing_open(Drawing *drawing, Studio *studio, const Scene *scene, const Quality *quality,
                  Message *message)
{
    double wall, gpu;
    *drawing = (Drawing){.quality = *quality};
    if (!quality_scene_open(&drawing->made, scene, quality, &studio->meshes, message))
        return false;
    drawing->canvas = find_canvas(studio, quality, message);
    drawing->lighting = drawing->canvas ? find_lighting(studio, quality, message) : NULL;
    if (!drawing->lighting || !scene_check(&drawing->made.scene, message) ||
        !image_open(&drawing->image, studio->width, studio->height,
                    drawing->canvas->real ? IMAGE_FLOAT : IMAGE_BYTE, message) ||
        !drawing_frame(drawing, studio, &wall, &gpu, message)) {
        drawing_close(drawing);
        return false;
    }
    return true;
}

bool drawing_frame(Drawing *drawing, Studio *studio, double *wall, double *gpu, Message *message)
{
    lighting_use_transforms(drawing->lighting, transforms_of(&drawing->quality));
    glFinish();
    const double start = clock_now();
    if (studio->timer)
        glBeginQueryEXT(GL_TIME_ELAPSED_EXT, studio->timer);
    clear(drawing);
    if (!lighting_show(drawing->lighting,
                       &(LightingFrame){.scene = &drawing->made.scene, .aspect = aspect_of(studio)},
                       message))
        return false;
    if (studio->timer)
        glEndQueryEXT(GL_TIME_ELAPSED_EXT);
    glFinish();
    if (!canvas_read(drawing->canvas, &drawing->image, message))
        return false;
    *wall = clock_now() - start;
    *gpu = NAN;
    if (studio->timer) {
        GLuint64 nanoseconds = 0;
        GLint disjoint = 0;
        glGetQueryObjectui64vEXT(studio->timer, GL_QUERY_RESULT_EXT, &nanoseconds);
        glGetIntegerv(GL_GPU_DISJOINT_EXT, &disjoint);
        if (!disjoint && nanoseconds > 0)
            *gpu = 1e-9 * (double)nanoseconds;
    }
    return true;
}

bool drawing_empty(Drawing *drawing, Studio *studio, double *wall, Message *message)
{
    (void)studio;
    glFinish();
    const double start = clock_now();
    clear(drawing);
    glFinish();
    if (!canvas_read(drawing->canvas, &drawing->image, message))
        return false;
    *wall = clock_now() - start;
    return true;
}

DrawingError drawing_error(const Drawing *drawing, const Reference *exact)
{
    PictureError found = {.all = {0}};
    picture_error_add(&found, &drawing->image,
                      &(ExactView){.exact = exact, .scene = &drawing->made.scene});
    return (DrawingError){.interior_rms = error_sum_rms(&found.interior),
                          .interior_maximum = found.interior.pixels ? found.interior.maximum : NAN,
                          .all_rms = error_sum_rms(&found.all),
                          .all_maximum = found.all.maximum,
                          .interior_pixels = (int)found.interior.pixels};
}

/* Counting starts three processes, so results are cached by text. */
static int count_operations(Studio *studio, const char *text, ShaderStage stage)
{
    Counted *all = studio->counted[stage];
    int *count = &studio->counted_count[stage];
    ShaderCost operations;
    for (int i = 0; i < *count; i++)
        if (strcmp(all[i].text, text) == 0)
            return all[i].operations;
    const int counted = shader_cost(text, stage, &operations, NULL)
                            ? operations.arithmetic + operations.special
                            : -1;
    if (*count < MAX_COUNTED && (all[*count].text = strdup(text)))
        all[(*count)++].operations = counted;
    return counted;
}

static bool is_covered(const Image *image, size_t pixel)
{
    return image->type == IMAGE_BYTE ? ((const unsigned char *)image->pixels)[4 * pixel + 3] >= 128
                                     : ((const float *)image->pixels)[4 * pixel + 3] >= 0.5F;
}

bool drawing_counts(const Drawing *drawing, Studio *studio, DrawingCounts *counts, Message *message)
{
    const Scene *scene = &drawing->made.scene;
    const int side = drawing->canvas->supersample;
    *counts = (DrawingCounts){.vertex_operations = -1, .fragment_operations = -1};
    for (int i = 0; i < scene->object_count; i++) {
        ShaderSource sources[2];
        const Object *object = &scene->objects[i];
        const bool flattened = scene->interpolation == INTERPOLATION_FLAT && !object->flat;
        counts->vertices +=
            (long long)(flattened ? object->mesh->index_count : object->mesh->vertex_count);
        if (!lighting_sources(drawing->lighting, scene, object, false, sources, message))
            return false;
        const int vertex = count_operations(studio, sources[SHADER_VERTEX].text, SHADER_VERTEX);
        const int fragment =
            count_operations(studio, sources[SHADER_FRAGMENT].text, SHADER_FRAGMENT);
        shader_source_close(&sources[SHADER_VERTEX]);
        shader_source_close(&sources[SHADER_FRAGMENT]);
        if (vertex > counts->vertex_operations)
            counts->vertex_operations = vertex;
        if (fragment > counts->fragment_operations)
            counts->fragment_operations = fragment;
    }
    for (size_t i = 0; i < (size_t)studio->width * (size_t)studio->height; i++)
        counts->fragments += is_covered(&drawing->image, i) ? side * side : 0;
    return true;
}

void drawing_close(Drawing *drawing)
{
    if (!drawing)
        return;
    quality_scene_close(&drawing->made);
    image_close(&drawing->image);
    *drawing = (Drawing){.lighting = NULL};
}

void studio_close(Studio *studio)
{
    if (!studio)
        return;
    studio_forget(studio);
    for (int i = 0; i < studio->lighting_count; i++)
        lighting_close(studio->lightings[i].lighting);
    for (int i = 0; i < studio->canvas_count; i++)
        canvas_close(&studio->canvases[i].canvas);
    if (studio->timer)
        glDeleteQueriesEXT(1, &studio->timer);
    canvas_close(&studio->first);
    for (int stage = 0; stage < 2; stage++)
        for (int i = 0; i < studio->counted_count[stage]; i++)
            free(studio->counted[stage][i].text);
    free(studio);
}
