/* The program draws once while its draws are captured. */
#include "app/probing.h"

#include "app/frames.h"
#include "app/picture_texts.h"
#include "app/renderer.h"
#include "base/clock.h"
#include "base/input.h"
#include "probe/probe_plugin.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A program whose picture is drawn and captured, and the device that is imitated. */
typedef struct Probing {
    GlslArithmetic driver;
    Canvas canvas;
    Renderer renderer;
    Capture capture;
    DrawRequest request;
} Probing;

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

/* To be closed whatever it returns. */
static bool open_probing(Probing *probing, const Example *example, const Options *options,
                         Message *message)
{
    *probing = (Probing){.request = options_request(options, example)};
    if (options->canvas.samples > 1 || options->canvas.supersample > 1)
        return message_set(message,
                           "--%s: a pixel of several samples has no one colour; leave out "
                           "--samples",
                           options->probe.asked ? "probe"
                           : options->show      ? "show"
                                                : "arithmetic");
    if (!find_driver(options->arithmetic, &probing->driver, message) ||
        !options_open_canvas(&probing->canvas, options, "x.png", message))
        return false;
    capture_begin(&probing->capture, &probing->canvas);
    const bool done =
        renderer_open(&probing->renderer, example, &probing->canvas, &probing->request, message) &&
        renderer_draw(&probing->renderer, &probing->request, probing->request.seconds, message);
    capture_end(&probing->capture);
    return done;
}

static void end(Probing *probing)
{
    capture_close(&probing->capture);
    renderer_close(&probing->renderer);
    canvas_close(&probing->canvas);
}

static const ProbePlugin *evaluator(Message *message)
{
    static Plugin plugin = {"probe.so",           "probe_plugin", "probe",
                            "--probe and --show", "lighting",     NULL};
    return plugin_open(&plugin, message);
}

static bool tell_pixel(Probing *probing, const Options *options, Message *message)
{
    Renderer *renderer = &probing->renderer;
    const int pixel[2] = {options->probe.column, options->probe.row};
    char object[64];
    ProbeQuestion question = {.capture = &probing->capture,
                              .driver = &probing->driver,
                              .column = pixel[0],
                              .row = pixel[1],
                              .height = options->height};
    Image image = {.width = 0};
    if (!image_open(&image, options->width, options->height, IMAGE_BYTE, message))
        return false;
    const bool read = canvas_read(renderer->canvas, &image, message);
    memcpy(question.drawn,
           (unsigned char *)image.pixels +
               4 * ((size_t)pixel[1] * (size_t)image.width + (size_t)pixel[0]),
           sizeof question.drawn);
    image_close(&image);
    if (renderer->kind->exact &&
        renderer->kind->exact(renderer, &probing->request, pixel, question.exact, object))
        question.object = object;
    const bool json = options->format && strcmp(options->format, "json") == 0;
    const ProbePlugin *plugin = read ? evaluator(message) : NULL;
    char *text = plugin ? plugin->tell(&question, json, message) : NULL;
    fputs(text ? text : "", stdout);
    free(text);
    return text != NULL;
}

bool probing_tell(const Example *example, const Options *options, Message *message)
{
    Probing probing;
    if (options->probe.column >= options->width || options->probe.row >= options->height)
        return message_set(message, "--probe %d,%d: the picture has %dx%d pixels",
                           options->probe.column, options->probe.row, options->width,
                           options->height);
    const bool done =
        open_probing(&probing, example, options, message) && tell_pixel(&probing, options, message);
    end(&probing);
    return done;
}

static bool write_shown(Probing *probing, Options *options, Message *message)
{
    Picture picture = {.image = {.width = 0}};
    Message why = {.located = false};
    const ProbePlugin *plugin = evaluator(message);
    bool done = plugin &&
                image_open(&picture.image, options->width, options->height, IMAGE_BYTE, message) &&
                frames_path(options, 0, picture.path, message);
    const ShowResult result = done ? plugin->show(&probing->capture, &probing->driver,
                                                  options->show, &picture.image, stderr, &why)
                                   : SHOW_FAILED;
    options->show_unknown = result == SHOW_UNKNOWN;
    if (done && result != SHOW_DONE)
        done = message_set(message, options->show ? "--show %s" : "--arithmetic: %s", why.text);
    if (done)
        picture_texts_set(probing->renderer.example, &probing->canvas, options, options->seconds,
                          &picture);
    done = done && picture_write(&picture, message);
    image_close(&picture.image);
    return done;
}

bool probing_show(const Example *example, Options *options, Message *message)
{
    Probing probing;
    const double start = clock_now();
    bool done = open_probing(&probing, example, options, message);
    const double drawn = clock_now();
    done = done && write_shown(&probing, options, message);
    if (done && options->verbose)
        fprintf(stderr, "drawing took %.1f ms, running its shaders and writing %.1f ms\n",
                1e3 * (drawn - start), 1e3 * (clock_now() - drawn));
    end(&probing);
    return done;
}
