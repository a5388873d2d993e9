/* The program draws once while its draws are captured. */
#include "app/probing.h"

#include "base/input.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>

enum { MEASURED_MAX = 1 << 20 }; /* bytes */

/* A device's name, a link, or a file with the same text. */
static bool find_driver(const char *name, GlslArithmetic *driver, Message *message)
{
    size_t size;
    if (glsl_arithmetic_read(name ? name : "llvmpipe", driver))
        return true;
    char *text = input_read(AT_FDCWD, name, name, MEASURED_MAX, &size, NULL);
    const bool read = text && glsl_arithmetic_read(text, driver);
    free(text);
    if (read)
        return true;
    message_set(message, "--arithmetic %s: neither a file with what precision measured nor one of",
                name);
    for (const GlslDevice *device = GLSL_DEVICES; device->name; device++)
        message_add(message, " %s", device->name);
    return false;
}

bool probing_open(Probing *probing, const Example *example, const Options *options,
                  const Canvas *canvas, Message *message)
{
    *probing = (Probing){.request = options_request(options, example)};
    if (!find_driver(options->arithmetic, &probing->driver, message))
        return false;
    capture_begin(&probing->capture, canvas);
    const bool done =
        renderer_open(&probing->renderer, example, canvas, &probing->request, message) &&
        renderer_draw(&probing->renderer, &probing->request, probing->request.seconds, message);
    capture_end(&probing->capture);
    return done;
}

void probing_close(Probing *probing)
{
    capture_close(&probing->capture);
    renderer_close(&probing->renderer);
}

char *probing_pixel(Probing *probing, const ProbePlugin *plugin, const int pixel[2], bool json,
                    Message *message)
{
    Renderer *renderer = &probing->renderer;
    const Canvas *canvas = renderer->canvas;
    ProbeQuestion question = {.capture = &probing->capture,
                              .driver = &probing->driver,
                              .column = pixel[0],
                              .row = pixel[1],
                              .height = canvas->height};
    ExactPixel exact = {.equation = NULL};
    Image image = {.width = 0};
    if (!image_open(&image, canvas->width, canvas->height, IMAGE_BYTE, message))
        return NULL;
    const bool read = canvas_read(canvas, &image, message);
    memcpy(question.drawn,
           (unsigned char *)image.pixels +
               4 * ((size_t)pixel[1] * (size_t)image.width + (size_t)pixel[0]),
           sizeof question.drawn);
    image_close(&image);
    if (renderer->kind->exact && renderer->kind->exact(renderer, &probing->request, pixel, &exact))
        question.exact = &exact;
    char *text = read ? plugin->tell(&question, json, message) : NULL;
    free(exact.equation);
    free(exact.terms);
    return text;
}
