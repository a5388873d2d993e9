/*
 * The times of an animated GIF. A picture is shown for a whole number of hundredths of a second,
 * and at 30 per second no number is right: 3 makes 33 per second. So delays differ: picture i
 * begins at the hundredth nearest to i / fps, and is shown until the next begins, which keeps the
 * error below half a hundredth however long the animation is. OpenImageIO writes the same delay for
 * all, ffmpeg other ones; when the file is complete, its blocks are walked and each delay is
 * replaced in place. (GIF89a specification, sections 17 to 23)
 */
#include "images/image_options.h"

#include "base/memory.h"
#include "images/image_plugin.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct ImageGif {
    const ImagePlugin *plugin;
    PluginGif *own;
    int file;
    GifOptions options;
    bool failed;
};

bool image_gif_open(ImageGif **opened, int file, const GifOptions *options, Message *message)
{
    char reason[1024] = "";
    ImageGif *gif = *opened = memory_new(1, sizeof *gif);
    *gif = (ImageGif){.plugin = plugin_open(&image_openimageio, message),
                      .file = file,
                      .options = *options,
                      .failed = true};
    if (!gif->plugin)
        return false;
    if (!gif->plugin->gif_open(&gif->own, file, options, reason, sizeof reason))
        return message_set(message, "GIF: %s", reason);
    gif->failed = false;
    return true;
}

bool image_gif_add(ImageGif *gif, const Image *image, Message *message)
{
    char reason[1024] = "";
    gif->failed = !gif->plugin->gif_add(gif->own, image, reason, sizeof reason);
    return gif->failed ? message_set(message, "GIF: %s", reason) : true;
}

/* Skips sub-blocks: each is a length and as many bytes; the last length is 0. */
static bool gif_skip_blocks(FILE *file)
{
    int length;
    while ((length = getc(file)) > 0)
        for (; length > 0; length--)
            getc(file);
    return length == 0;
}

/* Skips a color table if the flags before it announce one. */
static void gif_skip_colors(FILE *file, int flags)
{
    for (int left = flags & 0x80 ? 3 << ((flags & 7) + 1) : 0; left > 0; left--)
        getc(file);
}

/* In hundredths of a second. */
static long gif_delay(double fps, int number)
{
    return lround(100 * (number + 1) / fps) - lround(100 * number / fps);
}

/* Replaces the delay in the graphic control extension of each picture. */
static bool gif_set_delays(int descriptor, const GifOptions *options, FILE *file)
{
    int kind, flags, number = 0;
    fseek(file, 10, SEEK_SET);
    flags = getc(file);
    fseek(file, 13, SEEK_SET);
    gif_skip_colors(file, flags);
    while ((kind = getc(file)) == 0x21 || kind == 0x2C) {
        if (kind == 0x21 && getc(file) == 0xF9) {
            const long delay = gif_delay(options->fps, number++);
            const unsigned char bytes[2] = {(unsigned char)(delay & 255),
                                            (unsigned char)(delay >> 8)};
            if (pwrite(descriptor, bytes, 2, ftell(file) + 2) != 2)
                return false;
        } else if (kind == 0x2C) {
            for (int i = 0; i < 8; i++)
                getc(file);
            gif_skip_colors(file, getc(file));
            getc(file); /* LZW minimum code size */
        }
        if (!gif_skip_blocks(file))
            break;
    }
    errno = EILSEQ;
    return kind == 0x3B && number == options->count;
}

bool image_gif_set_times(int file, const GifOptions *options, Message *message)
{
    const int again = dup(file);
    FILE *stream = again < 0 ? NULL : fdopen(again, "rb");
    const bool done = (stream && gif_set_delays(file, options, stream)) ||
                      message_set(message, "GIF: cannot set the times: %s", strerror(errno));
    if (stream)
        fclose(stream);
    else if (again >= 0)
        close(again);
    return done;
}

bool image_gif_close(ImageGif *gif, Message *message)
{
    char reason[1024] = "";
    if (!gif)
        return true;
    bool done = !gif->plugin || gif->plugin->gif_close(gif->own, reason, sizeof reason);
    if (!done)
        message_set(message, "GIF: %s", reason);
    if (done && !gif->failed)
        done = image_gif_set_times(gif->file, &gif->options, message);
    done = done && !gif->failed;
    free(gif);
    return done;
}
