/* --probe, --show and --arithmetic of the command line. */
#include "app/frames.h"
#include "app/picture_texts.h"
#include "app/probing.h"
#include "base/clock.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const ProbePlugin *probing_plugin(Message *message)
{
    static Plugin plugin = {"probe.so",           "probe_plugin", "probe",
                            "--probe and --show", "lighting",     NULL};
    return plugin_open(&plugin, message);
}

/* With a canvas of its own. */
static bool open_both(Probing *probing, Canvas *canvas, const Example *example,
                      const Options *options, Message *message)
{
    *probing = (Probing){.request = {.verbose = false}};
    if (options->canvas.samples > 1 || options->canvas.supersample > 1)
        return message_set(message,
                           "--%s: a pixel of several samples has no one colour; leave out "
                           "--samples",
                           options->probe.asked ? "probe"
                           : options->show      ? "show"
                                                : "arithmetic");
    return options_open_canvas(canvas, options, "x.png", message) &&
           probing_open(probing, example, options, canvas, message);
}

bool probing_tell(const Example *example, const Options *options, Message *message)
{
    Probing probing;
    Canvas canvas = {.backend = NULL};
    const int pixel[2] = {options->probe.column, options->probe.row};
    const bool json = options->format && strcmp(options->format, "json") == 0;
    const bool opened = open_both(&probing, &canvas, example, options, message);
    const ProbePlugin *plugin = opened ? probing_plugin(message) : NULL;
    char *text = plugin ? probing_pixel(&probing, plugin, pixel, json, message) : NULL;
    probing_close(&probing);
    canvas_close(&canvas);
    fputs(text ? text : "", stdout);
    free(text);
    return text != NULL;
}

static bool write_shown(Probing *probing, Options *options, Message *message)
{
    Picture picture = {.image = {.width = 0}};
    Message why = {.located = false};
    const ProbePlugin *plugin = probing_plugin(message);
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
        picture_texts_set(probing->renderer.example, probing->renderer.canvas, options,
                          options->seconds, &picture);
    done = done && picture_write(&picture, message);
    image_close(&picture.image);
    return done;
}

bool probing_show(const Example *example, Options *options, Message *message)
{
    Probing probing;
    Canvas canvas = {.backend = NULL};
    const double start = clock_now();
    bool done = open_both(&probing, &canvas, example, options, message);
    const double drawn = clock_now();
    done = done && write_shown(&probing, options, message);
    if (done && options->verbose)
        fprintf(stderr, "drawing took %.1f ms, running its shaders and writing %.1f ms\n",
                1e3 * (drawn - start), 1e3 * (clock_now() - drawn));
    probing_close(&probing);
    canvas_close(&canvas);
    return done;
}
