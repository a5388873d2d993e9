/* The canvas that a command line asks for. */
#include "app/options.h"

#include "base/clock.h"
#include "images/image_file.h"
#include "window/backends.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Nothing is half-written: the thread that called Xlib is the one that writes files. Not exit():
 * drivers would contact the display. */
static void end_without_display(const char *program)
{
    fflush(stdout);
    fprintf(stderr,
            "%s: window: the connection to the display was lost; leave out --window to draw "
            "without one\n",
            program);
    _exit(EXIT_FAILED);
}

bool options_open_canvas(Canvas *canvas, const Options *options, const char *output,
                         Message *message)
{
    const double start = clock_now();
    char format[16];
    Message why = {0};
    CanvasOptions wanted = options->canvas;
    wanted.width = options->width;
    wanted.height = options->height;
    wanted.lost = end_without_display;
    wanted.supersampled = options_have_shadows(options);
    if (!wanted.backend) /* canvas_open does not know the window */
        wanted.backend = backend_default(message);
    if (!wanted.backend || !image_format(output, format, message))
        return false;
    wanted.real = image_format_is_float(format);
    if (!canvas_open(canvas, &wanted, &why)) {
        const bool window = strncmp(why.text, "window: ", 8) == 0;
        return message_set(message, "%s%s", why.text,
                           window ? "; leave out --window to draw to a file, which needs none"
                                  : "");
    }
    if (options->verbose) {
        fprintf(stderr, "backend: %s, %s\nrenderer: %s, %s\n", canvas->backend->name,
                canvas->platform, canvas->renderer, canvas->version);
        fprintf(stderr, "canvas: %dx%d, RGBA %d %d %d %d, depth %d", canvas->width, canvas->height,
                canvas->red_bits, canvas->green_bits, canvas->blue_bits, canvas->alpha_bits,
                canvas->depth_bits);
        if (wanted.real && !canvas->real)
            fprintf(stderr, ", not float: the driver cannot draw to it");
        if (canvas->samples)
            fprintf(stderr, "; %d samples for each pixel, resolved by the driver", canvas->samples);
        else if (canvas->supersample > 1)
            fprintf(stderr, "; %dx%d supersampling, averaged here", canvas->supersample,
                    canvas->supersample);
        fprintf(stderr, "\n");
        fprintf(stderr, "precision of fragment shaders: %s\nopening took %.1f ms\n",
                options->shaders.precision ? options->shaders.precision : "as in the files",
                1e3 * (clock_now() - start));
    }
    return true;
}
