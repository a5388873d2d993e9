/*
 * What was drawn, read back or shown in a window: samples are resolved by the driver, the pixels of
 * supersampling are averaged here, in the numbers that they are stored as, and rows are flipped,
 * because OpenGL's first is the bottom.
 */
#include "core/canvas.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* OpenGL's row 0 is the bottom. */
static void flip_rows(Image *image)
{
    const size_t row = image_row_size(image);
    unsigned char *spare = memory_new(row, 1), *pixels = image->pixels;
    for (int y = 0; y < image->height / 2; y++) {
        unsigned char *upper = pixels + (size_t)y * row;
        unsigned char *lower = pixels + (size_t)(image->height - 1 - y) * row;
        memcpy(spare, upper, row);
        memcpy(upper, lower, row);
        memcpy(lower, spare, row);
    }
    free(spare);
}

/* Adds row `y` of `large` to `sums`, `side` pixels per sum. */
static void add_row(const Image *large, size_t y, size_t side, double *sums)
{
    const size_t channels = 4, width = (size_t)large->width / side;
    const size_t first = y * (size_t)large->width * channels;
    const unsigned char *bytes = (const unsigned char *)large->pixels + first;
    const float *floats = (const float *)large->pixels + first;
    for (size_t x = 0; x < width; x++)
        for (size_t i = 0; i < side; i++) {
            const size_t from = (x * side + i) * channels;
            for (size_t c = 0; c < channels; c++)
                sums[x * channels + c] +=
                    large->type == IMAGE_FLOAT ? (double)floats[from + c] : bytes[from + c];
        }
}

/* Each pixel of `image` is the mean of `side` x `side` of `large`. */
static void average(Image *image, const Image *large, int side)
{
    const size_t count = 4 * (size_t)image->width;
    const double squares = side * side;
    double *sums = memory_new(count, sizeof *sums);
    for (size_t y = 0; y < (size_t)image->height; y++) {
        for (size_t i = 0; i < count; i++)
            sums[i] = 0;
        for (size_t j = 0; j < (size_t)side; j++)
            add_row(large, y * (size_t)side + j, (size_t)side, sums);
        for (size_t i = 0; i < count; i++) {
            const double mean = sums[i] / squares;
            if (image->type == IMAGE_FLOAT)
                ((float *)image->pixels)[y * count + i] = (float)mean;
            else
                ((unsigned char *)image->pixels)[y * count + i] = (unsigned char)lrint(mean);
        }
    }
    free(sums);
}

/* Averages the samples of each pixel. Leaves the framebuffer with the result bound. */
static void resolve(const Canvas *canvas)
{
    const int width = canvas->width * canvas->supersample;
    const int height = canvas->height * canvas->supersample;
    if (!canvas->samples)
        return glBindFramebuffer(GL_FRAMEBUFFER, canvas->framebuffer);
    glDisable(GL_SCISSOR_TEST); /* it would clip the copy */
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER_ANGLE, canvas->resolve_framebuffer);
    glBindFramebuffer(GL_READ_FRAMEBUFFER_ANGLE, canvas->framebuffer);
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, canvas->resolve_framebuffer);
}

static bool read_pixels(const Canvas *canvas, Image *image, Message *message)
{
    resolve(canvas);
    const bool reverses = gl_has("GL_ANGLE_pack_reverse_row_order");
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    if (reverses)
        glPixelStorei(GL_PACK_REVERSE_ROW_ORDER_ANGLE, 1);
    glReadPixels(0, 0, image->width, image->height, GL_RGBA,
                 canvas->real ? GL_FLOAT : GL_UNSIGNED_BYTE, image->pixels);
    glBindFramebuffer(GL_FRAMEBUFFER, canvas->framebuffer);
    const GLenum error = glGetError();
    if (error != GL_NO_ERROR)
        return message_set(message, "canvas: drawing and reading back a %dx%d picture: %s",
                           image->width, image->height, gl_error_name(error));
    if (!reverses)
        flip_rows(image);
    return true;
}

/* Copies the bound framebuffer to framebuffer 0; `flipped`: its first row is the top. */
static void present(int from_width, int from_height, const int place[4], bool flipped)
{
    const bool equal = place[2] == from_width && place[3] == from_height;
    const int bottom = place[1], top = place[1] + place[3];
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER_ANGLE, 0);
    glBlitFramebuffer(0, 0, from_width, from_height, place[0], flipped ? top : bottom,
                      place[0] + place[2], flipped ? bottom : top, GL_COLOR_BUFFER_BIT,
                      equal ? GL_NEAREST : GL_LINEAR);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(place[0], place[1], place[2], place[3]);
}

void canvas_present(const Canvas *canvas, const int place[4])
{
    const int side = canvas->supersample;
    resolve(canvas);
    present(canvas->width * side, canvas->height * side, place, false);
}

bool canvas_present_image(const Image *image, int columns, const int place[4], Message *message)
{
    const bool real = image->type == IMAGE_FLOAT;
    GLuint texture = 0, framebuffer = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, real ? GL_RGBA32F_EXT : GL_RGBA, image->width, image->height, 0,
                 GL_RGBA, real ? GL_FLOAT : GL_UNSIGNED_BYTE, image->pixels);
    glBindTexture(GL_TEXTURE_2D, 0);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    present(columns, image->height, place, true);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &texture);
    const GLenum error = glGetError();
    return error == GL_NO_ERROR || message_set(message, "window: showing a %dx%d picture: %s",
                                               image->width, image->height, gl_error_name(error));
}

bool canvas_read(const Canvas *canvas, Image *image, Message *message)
{
    if (!canvas_check(canvas, message))
        return false;
    if (image->width != canvas->width || image->height != canvas->height ||
        image->type != (canvas->real ? IMAGE_FLOAT : IMAGE_BYTE))
        return message_set(message, "canvas: a %dx%d %s image cannot take a %dx%d %s picture",
                           image->width, image->height,
                           image->type == IMAGE_FLOAT ? "float" : "byte", canvas->width,
                           canvas->height, canvas->real ? "float" : "byte");
    if (canvas->supersample == 1)
        return read_pixels(canvas, image, message);
    Image large;
    if (!image_open(&large, canvas->width * canvas->supersample,
                    canvas->height * canvas->supersample, image->type, message))
        return false;
    const bool done = read_pixels(canvas, &large, message);
    if (done)
        average(image, &large, canvas->supersample);
    image_close(&large);
    return done;
}
