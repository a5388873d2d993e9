/* Reads back what image_png.c wrote: pixels as RGBA bytes, and the texts. */
#include "images/picture_queue.h"

#include <png.h>
#include <stdio.h>
#include <string.h>

/* libpng requires an error handler that does not return. */
static void png_failed(png_structp png, png_const_charp text)
{
    Message *message = png_get_error_ptr(png);
    message_set(message, "%s", text);
    png_longjmp(png, 1);
}

static void png_warned(png_structp png, png_const_charp text)
{
    (void)png;
    (void)text;
}

/* The texts that picture_write has written; those that are too long are cut. */
static void read_texts(png_structp png, png_infop info, Picture *picture)
{
    const struct {
        const char *key;
        char *text;
        size_t size;
    } wanted[] = {{"Title", picture->title, sizeof picture->title},
                  {"Time", picture->moment, sizeof picture->moment},
                  {"Driver", picture->driver, sizeof picture->driver},
                  {"Sources", picture->sources, sizeof picture->sources},
                  {"Command", picture->command, sizeof picture->command}};
    png_textp texts = NULL;
    const int count = png_get_text(png, info, &texts, NULL);
    for (size_t k = 0; k < sizeof wanted / sizeof wanted[0]; k++) {
        wanted[k].text[0] = '\0';
        for (int i = 0; i < count; i++)
            if (strcmp(texts[i].key, wanted[k].key) == 0)
                snprintf(wanted[k].text, wanted[k].size, "%s", texts[i].text);
    }
}

static bool fit_image(Image *image, int width, int height, Message *message)
{
    if (image->width == width && image->height == height && image->type == IMAGE_BYTE)
        return true;
    image_close(image);
    return image_open(image, width, height, IMAGE_BYTE, message);
}

static bool read_png(Picture *picture, FILE *stream, Message *message)
{
    png_structp png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, message, png_failed, png_warned);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    volatile bool done = false;
    if (!info || setjmp(png_jmpbuf(png)))
        goto end;
    png_init_io(png, stream);
    png_read_info(png, info);
    picture->alpha = png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA;
    /* Rows are read as RGBA, 8 bits each. */
    png_set_expand(png);
    png_set_strip_16(png);
    png_set_gray_to_rgb(png);
    png_set_filler(png, 255, PNG_FILLER_AFTER);
    png_read_update_info(png, info);
    if (!fit_image(&picture->image, (int)png_get_image_width(png, info),
                   (int)png_get_image_height(png, info), message))
        goto end;
    const size_t stride = image_row_size(&picture->image);
    if (png_get_rowbytes(png, info) != stride ||
        png_get_interlace_type(png, info) != PNG_INTERLACE_NONE)
        png_error(png, "not written by these programs");
    for (int y = 0; y < picture->image.height; y++)
        png_read_row(png, (png_bytep)picture->image.pixels + (size_t)y * stride, NULL);
    png_read_end(png, info);
    read_texts(png, info, picture);
    done = true;
end:
    png_destroy_read_struct(&png, &info, NULL);
    return done;
}

bool picture_read(Picture *picture, Message *message)
{
    ImageFile file;
    Message why = {0};
    if (!image_file_read(&file, picture->path, message))
        return false;
    FILE *stream = file.size ? fmemopen(file.bytes, file.size, "rb") : NULL;
    const bool done = stream && read_png(picture, stream, &why);
    if (stream)
        fclose(stream);
    image_file_close(&file);
    return done || message_set(message, "%s: is no whole PNG picture%s%s", picture->path,
                               why.text[0] ? ": " : "", why.text);
}
