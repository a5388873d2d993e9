/*
 * PNG, at a speed that fits pictures drawn by the thousand. Compression has two parts: a filter,
 * which replaces each byte by its difference from a neighbour, and zlib. libpng tries all five
 * filters on each row, at zlib's level 6; here one filter (the left neighbour) and level 3 are
 * fixed, which takes a quarter of the time. Where nearly all neighbours are equal, runs are all
 * there is to find, and zlib is told to look for nothing else.
 */
#include "images/image_options.h"

#include <math.h>
#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <zlib.h>

/* libpng requires an error handler that does not return. */
static void png_failed(png_structp png, png_const_charp text)
{
    Message *message = png_get_error_ptr(png);
    message_set(message, "PNG: %s", text);
    png_longjmp(png, 1);
}

static void png_warned(png_structp png, png_const_charp text)
{
    (void)png;
    (void)text;
}

static void png_put_text(png_structp png, png_infop info, const ImageText *text)
{
    for (; text && text->key; text++) {
        png_text chunk = {.compression = PNG_ITXT_COMPRESSION_NONE,
                          .key = (char *)(uintptr_t)text->key,
                          .text = (char *)(uintptr_t)text->text};
        bool ascii = true;
        for (const char *p = text->text; *p; p++)
            ascii = ascii && (unsigned char)*p < 128;
        if (ascii)
            chunk.compression = PNG_TEXT_COMPRESSION_NONE;
        png_set_text(png, info, &chunk, 1);
    }
}

static unsigned char to_byte(float value)
{
    const float clamped = value > 0 ? (value < 1 ? value : 1) : 0; /* NaN becomes 0 */
    return (unsigned char)lrintf(255 * clamped);
}

/* Row y as RGBA bytes: the image's own, or converted into `spare`. */
static const unsigned char *png_row(const Image *image, int y, unsigned char *spare)
{
    const size_t values = 4 * (size_t)image->width;
    if (image->type == IMAGE_BYTE)
        return (const unsigned char *)image->pixels + (size_t)y * values;
    const float *row = (const float *)image->pixels + (size_t)y * values;
    for (size_t i = 0; i < values; i++)
        spare[i] = to_byte(row[i]);
    return spare;
}

/* Whether under 2% of the pixels differ from their left neighbor. */
static bool has_flat_colors(const Image *image)
{
    const size_t width = (size_t)image->width, height = (size_t)image->height;
    const uint32_t *pixels = image->pixels;
    size_t changes = 0;
    if (image->type != IMAGE_BYTE)
        return false;
    for (size_t y = 0; y < height; y++)
        for (size_t x = 1; x < width; x++)
            changes += pixels[y * width + x] != pixels[y * width + x - 1];
    return changes < width * height / 50;
}

static bool write_png(const Image *image, const ImageOptions *options, FILE *stream,
                      Message *message)
{
    const bool fast = options->compress < 0;
    const int level = fast ? 3 : options->compress;
    unsigned char *spare = malloc(4 * (size_t)image->width);
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, message, png_failed, png_warned);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    bool done = false;
    if (!spare || !info) {
        message_set(message, "PNG: not enough memory");
        goto end;
    }
    if (setjmp(png_jmpbuf(png)))
        goto end;
    png_init_io(png, stream);
    png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8,
                 options->alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(png, level);
    if (fast && has_flat_colors(image))
        png_set_compression_strategy(png, Z_RLE);
    /* Choosing a filter for every row takes longer than the fast levels of zlib gain by it. */
    if (level < 6)
        png_set_filter(png, PNG_FILTER_TYPE_BASE, level ? PNG_FILTER_SUB : PNG_FILTER_NONE);
    png_put_text(png, info, options->text);
    png_write_info(png, info);
    if (!options->alpha)
        png_set_filler(png, 0, PNG_FILLER_AFTER); /* drops every fourth byte */
    for (int y = 0; y < image->height; y++)
        png_write_row(png, png_row(image, y, spare));
    png_write_end(png, info);
    done = true;
end:
    png_destroy_write_struct(&png, &info);
    free(spare);
    return done;
}

bool image_png_encode(const Image *image, const ImageOptions *options, ImageFile *file,
                      Message *message)
{
    char *bytes = NULL;
    FILE *stream = open_memstream(&bytes, &file->size);
    bool done = stream && write_png(image, options, stream, message);
    if (stream)
        done = fclose(stream) == 0 && done;
    file->bytes = (unsigned char *)bytes;
    return done || message_set(message, "PNG: not enough memory for the file");
}

const char *image_png_version(void)
{
    return png_get_libpng_ver(NULL);
}
