/* What a picture's file says of itself: the program, the moment, the driver, and the command that
 * makes the file again. */
#include "app/picture_texts.h"

#include "app/command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The command that makes the same file again, of the program's own name: where this one went does
 * not change what is in it. */
static void write_command(const Example *example, const Canvas *canvas, const Options *options,
                          double seconds, Picture *picture)
{
    char format[16], output[96];
    const char *folder = getenv("LIGHTING_SHADERS");
    Options own = *options;
    own.width = canvas->width;
    own.height = canvas->height;
    own.seconds = seconds;
    own.frames = 1;
    own.fps = OPTIONS_FPS;
    own.numbered = false;
    own.format = NULL;
    own.start = NULL;
    own.canvas.backend = canvas->backend;
    own.output_given = image_format(picture->path, format, NULL) && strcmp(format, "png") != 0;
    if (own.output_given)
        snprintf(output, sizeof output, "%s.%s", example->name, format);
    own.output = output;
    if (!own.shaders.folder && folder && folder[0])
        own.shaders.folder = folder;
    command_write(example, &own, options->defaults, picture->command, sizeof picture->command);
}

void picture_texts_set(const Example *example, const Canvas *canvas, const Options *options,
                       double seconds, Picture *picture)
{
    char number[32];
    picture->compress = options->compress;
    picture->alpha = options->alpha;
    snprintf(picture->title, sizeof picture->title, "%s", example->name);
    parse_number_text(seconds, number);
    snprintf(picture->moment, sizeof picture->moment, "%s s", number);
    if (example_kind(example)->without_gl)
        snprintf(picture->driver, sizeof picture->driver, "cairo");
    else if (canvas->renderer) /* --merge draws nothing */
        snprintf(picture->driver, sizeof picture->driver, "%s, %s; %s", canvas->backend->name,
                 canvas->platform, canvas->renderer);
    write_command(example, canvas, options, seconds, picture);
}
