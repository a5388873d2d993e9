/* What is the same for every kind: init and finish, and how a picture is read back. */
#include "app/renderer.h"

#include "base/clock.h"

#include <stdio.h>

const ExampleKind *example_kind(const Example *example)
{
    return example->kind ? example->kind : &LECTURE_KIND;
}

/* Prints shaders on standard output and, with --verbose, compile times on standard error. */
static ShaderLoader loader_of(Renderer *renderer, const DrawRequest *request)
{
    ShaderLoader loader = request->shaders;
    loader.printed = stdout;
    loader.advise = true;
    loader.keeps = true;
    loader.log = request->verbose ? stderr : NULL;
    loader.warning = &renderer->warning;
    return loader;
}

bool renderer_open(Renderer *renderer, const Example *example, const Canvas *canvas,
                   const DrawRequest *request, Message *message)
{
    const double start = clock_now();
    const ExampleKind *kind = example_kind(example);
    *renderer = (Renderer){.example = example, .kind = kind, .canvas = canvas};
    const ShaderLoader loader = loader_of(renderer, request);
    if ((example->init && !example->init(&loader, message)) ||
        (kind->open && !kind->open(renderer, &loader, message))) {
        renderer_close(renderer);
        return false;
    }
    if (request->verbose)
        fprintf(stderr, "%s: init took %.1f ms\n", example->name, 1e3 * (clock_now() - start));
    return true;
}

void renderer_close(Renderer *renderer)
{
    GLint attributes = 0;
    if (!renderer->example)
        return;
    const ExampleKind *kind = renderer->kind;
    if (renderer->example->finish)
        renderer->example->finish();
    if (kind->close)
        kind->close(renderer);
    *renderer = (Renderer){.example = NULL};
    if (kind->without_gl) /* perhaps without a context */
        return;
    glUseProgram(0);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glGetIntegerv(GL_MAX_VERTEX_ATTRIBS, &attributes);
    for (GLint i = 0; i < attributes; i++)
        glDisableVertexAttribArray((GLuint)i);
}

bool renderer_renew(Renderer *renderer, const DrawRequest *request, Message *message)
{
    const Example *example = renderer->example;
    const ShaderLoader loader = loader_of(renderer, request);
    if (!example->init)
        return true;
    renderer->warning = (Message){0};
    example->finish();
    if (renderer->kind->forget)
        renderer->kind->forget(renderer);
    return example->init(&loader, message);
}

void renderer_clear(const Renderer *renderer, const DrawRequest *request, Vec3 background)
{
    canvas_clear(renderer->canvas, request->alpha ? (Vec3){0, 0, 0} : background,
                 request->alpha ? 0 : 1);
}

bool renderer_draw(Renderer *renderer, const DrawRequest *request, double seconds, Message *message)
{
    return renderer->kind->draw(renderer, request, seconds, message);
}

bool renderer_finishes_on_cpu(const Example *example, ImageType type)
{
    const ExampleKind *kind = example_kind(example);
    return kind->paint || (type == IMAGE_BYTE && kind->retouches && kind->retouches(example));
}

/* Averaging samples of an object and of the transparent black background has multiplied the colour
 * by alpha. */
static void divide_by_alpha(Image *image)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; i++) {
        float *real = (float *)image->pixels + 4 * i;
        unsigned char *byte = (unsigned char *)image->pixels + 4 * i;
        for (int c = 0; c < 3; c++) {
            if (image->type == IMAGE_FLOAT && real[3] > 0 && real[3] < 1) {
                real[c] /= real[3];
            } else if (image->type == IMAGE_BYTE && byte[3] > 0 && byte[3] < 255) {
                const int color = (255 * byte[c] + byte[3] / 2) / byte[3];
                byte[c] = (unsigned char)(color < 255 ? color : 255);
            }
        }
    }
}

bool renderer_picture(Renderer *renderer, const DrawRequest *request, double seconds, Image *image,
                      Message *message)
{
    const Canvas *canvas = renderer->canvas;
    const ExampleKind *kind = renderer->kind;
    if (image->width != canvas->width || image->height != canvas->height) {
        const ImageType type = image->type;
        image_close(image);
        if (!image_open(image, canvas->width, canvas->height, type, message))
            return false;
    }
    if (kind->paint)
        return kind->paint(renderer, request, seconds, image, message);
    if (!kind->draw(renderer, request, seconds, message) || !canvas_read(canvas, image, message))
        return false;
    if (request->alpha && (canvas->samples || canvas->supersample > 1))
        divide_by_alpha(image);
    if (request->verbose && kind->report)
        kind->report(renderer);
    return !renderer_finishes_on_cpu(renderer->example, image->type) ||
           kind->retouch(renderer, request, image, message);
}

bool renderer_explain(Renderer *renderer, const DrawRequest *request, Message *message)
{
    if (!renderer->kind->explain)
        return message_set(message, "--explain: this program's shaders are written by hand");
    return renderer->kind->explain(renderer, request, message);
}
