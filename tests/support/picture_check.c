#include "support/picture_check.h"

#include "window/backends.h"

#include <limits.h>
#include <sys/stat.h>

/* One step of 1/255 becomes a visible grey. */
static const int DIFFERENCE_GAIN = 32;

bool picture_check_driver(const char *test)
{
    void *context;
    const char *platform;
    Message message = {0};
    const CanvasBackend *backend = backend_default(&message);
    if (!backend ||
        !backend->open(&context, &(CanvasOptions){.width = 1, .height = 1}, &platform, &message)) {
        printf("%s: skipped, no driver: %s\n", test, message.text);
        return false;
    }
    backend->close(context);
    return true;
}

int picture_check_run(const char *name, CMFixtureFunction setup, CMFixtureFunction teardown)
{
    return picture_check_driver(name) ? testing_run(0, name, setup, teardown) : EXIT_SKIPPED;
}

void picture_draw(const Canvas *canvas, Lighting *lighting, const LightingFrame *frame,
                  Image *image)
{
    LightingFrame own = *frame;
    own.aspect = (double)canvas->width / canvas->height;
    canvas_clear(canvas, frame->scene->background, 1);
    SUCCEEDS(scene_check(frame->scene, message));
    SUCCEEDS(lighting_show(lighting, &own, message));
    SUCCEEDS(canvas_read(canvas, image, message));
}

static void keep(const char *name, const char *what, const Image *image)
{
    const ImageOptions options = {.compress = IMAGE_COMPRESS_DEFAULT};
    const char *folder = getenv("LIGHTING_FAILURES");
    char path[PATH_MAX];
    Message message = {0};
    if (!folder || !folder[0])
        folder = "failures";
    mkdir(folder, 0777); /* if that fails, writing reports it */
    snprintf(path, sizeof path, "%s/%s-%s.png", folder, name, what);
    if (image_write(image, path, &options, &message))
        printf("  %s\n", path);
    else
        printf("  %s\n", message.text);
}

void picture_check_keep(const char *name, const Image *picture, const Image *expected)
{
    Image difference;
    Message message = {0};
    keep(name, "picture", picture);
    keep(name, "expected", expected);
    if (!image_open(&difference, picture->width, picture->height, IMAGE_BYTE, &message)) {
        printf("  %s\n", message.text);
        return;
    }
    const unsigned char *a = picture->pixels, *b = expected->pixels;
    unsigned char *to = difference.pixels;
    const size_t size = image_row_size(picture) * (size_t)picture->height;
    for (size_t i = 0; i < size; i++) {
        const int bright = abs(a[i] - b[i]) * DIFFERENCE_GAIN;
        to[i] = (unsigned char)(bright < 255 ? bright : 255);
    }
    keep(name, "difference", &difference);
    image_close(&difference);
}

void picture_check_keep_exact(const char *name, const Image *picture, const Reference *expected)
{
    Image image;
    if (!image_open(&image, expected->width, expected->height, IMAGE_BYTE, NULL))
        return;
    unsigned char *to = image.pixels;
    for (int i = 0; i < 4 * image.width * image.height; i++)
        to[i] = (unsigned char)(i % 4 < 3 ? lrintf(255 * expected->color[i / 4 * 3 + i % 4]) : 255);
    picture_check_keep(name, picture, &image);
    image_close(&image);
}

int pixel_levels(const unsigned char a[4], const unsigned char b[4])
{
    int most = 0;
    for (int c = 0; c < 4; c++)
        most = abs(a[c] - b[c]) > most ? abs(a[c] - b[c]) : most;
    return most;
}

int pixels_apart(const void *a, const void *b, int count, int levels)
{
    const unsigned char *p = a, *q = b;
    int apart = 0;
    for (int i = 0; i < count; i++, p += 4, q += 4)
        apart += pixel_levels(p, q) > levels;
    return apart;
}

bool picture_check_same(const char *name, const Image *picture, const Image *expected, int levels)
{
    if (picture->type != IMAGE_BYTE || expected->type != IMAGE_BYTE ||
        picture->width != expected->width || picture->height != expected->height) {
        printf("%s: %dx%d against %dx%d, or not bytes\n", name, picture->width, picture->height,
               expected->width, expected->height);
        return false;
    }
    const unsigned char *a = picture->pixels, *b = expected->pixels;
    const size_t row = image_row_size(picture), size = row * (size_t)picture->height;
    size_t worst = 0;
    for (size_t i = 0; i < size; i++)
        if (abs(a[i] - b[i]) > abs(a[worst] - b[worst]))
            worst = i;
    if (abs(a[worst] - b[worst]) <= levels)
        return true;
    printf("%s: at column %zu, row %zu, channel %zu there is %d and not %d\n", name,
           worst % row / 4, worst / row, worst % 4, a[worst], b[worst]);
    picture_check_keep(name, picture, expected);
    return false;
}
