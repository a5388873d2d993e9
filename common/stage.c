#include "stage.h"

#include "progress.h"

#include <dlfcn.h>
#include <stdio.h>

bool stage_open(Canvas *canvas, const Options *options, const char *output, Message *message)
{
    const double start = progress_now();
    char format[16];
    CanvasOptions wanted = options->canvas;
    wanted.width = options->width;
    wanted.height = options->height;
    if (!image_format(output, format, message))
        return false;
    wanted.real = image_format_is_float(format);
    if (!canvas_open(canvas, &wanted, message))
        return false;
    if (!options->verbose)
        return true;
    fprintf(stderr, "backend: %s, %s\nrenderer: %s, %s\n", canvas->backend->name, canvas->platform,
            canvas->renderer, canvas->version);
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
    fprintf(stderr, "\nprecision of fragment shaders: %s\nopening took %.1f ms\n",
            options->shaders.precision ? options->shaders.precision : "as they say",
            1e3 * (progress_now() - start));
    return true;
}

bool stage_enter(const Example *example, const Options *options, Message *message)
{
    const double start = progress_now();
    if (!example->init(&options->shaders, message)) {
        stage_leave(example);
        return false;
    }
    if (options->verbose)
        fprintf(stderr, "%s: init took %.1f ms\n", example->name, 1e3 * (progress_now() - start));
    return true;
}

void stage_leave(const Example *example)
{
    GLint attributes = 0;
    example->finish();
    glUseProgram(0);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glGetIntegerv(GL_MAX_VERTEX_ATTRIBS, &attributes);
    for (GLint i = 0; i < attributes; i++)
        glDisableVertexAttribArray((GLuint)i);
}

bool stage_draw(const Example *example, const Canvas *canvas, const Options *options,
                double seconds, Message *message)
{
    const Frame frame = {.seconds = seconds, .aspect = (double)canvas->width / canvas->height};
    const float *color = example->clear_color;
    canvas_begin(canvas);
    if (options->alpha)
        glClearColor(0, 0, 0, 0);
    else
        glClearColor(color[0], color[1], color[2], 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    if (example->draw(&frame))
        return true;
    return message_set(message, "no matrix can be made for time %g s at %dx%d", seconds,
                       canvas->width, canvas->height);
}

/* Where samples of an object and of the transparent background, which is black, were averaged, the
 * colour is that of the object times its share, which alpha tells. */
static void divide_by_alpha(Image *image)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; i++) {
        float *real = (float *)image->pixels + 4 * i;
        unsigned char *byte = (unsigned char *)image->pixels + 4 * i;
        for (int c = 0; c < 3; c++) {
            if (image->type == IMAGE_FLOAT && real[3] > 0 && real[3] < 1) {
                real[c] /= real[3];
            } else if (image->type == IMAGE_BYTE && byte[3] > 0 && byte[3] < 255) {
                const int color = (255 * byte[c] + byte[3] / 2) / byte[3];
                byte[c] = (unsigned char)(color < 255 ? color : 255);
            }
        }
    }
}

bool stage_picture(const Example *example, const Canvas *canvas, const Options *options,
                   double seconds, Picture *picture, Message *message)
{
    if (!stage_draw(example, canvas, options, seconds, message) ||
        !canvas_read(canvas, &picture->image, message))
        return false;
    if (options->alpha && (canvas->samples || canvas->supersample > 1))
        divide_by_alpha(&picture->image);
    picture->compress = options->compress;
    picture->alpha = options->alpha;
    snprintf(picture->title, sizeof picture->title, "%s", example->name);
    snprintf(picture->moment, sizeof picture->moment, "%.17g s", seconds);
    snprintf(picture->settings, sizeof picture->settings,
             "--size %dx%d --samples %d%s%s%s; backend %s, %s; %s", canvas->width, canvas->height,
             options->canvas.samples, options->shaders.precision ? " --precision " : "",
             options->shaders.precision ? options->shaders.precision : "",
             options->alpha ? " --alpha" : "", canvas->backend->name, canvas->platform,
             canvas->renderer);
    return true;
}

/* Libraries that other backends load; each is optional. */
static void doctor_library(const char *what, const char *const *names, const char *package)
{
    for (; *names; names++) {
        void *library = dlopen(*names, RTLD_LAZY | RTLD_LOCAL);
        if (library) {
            printf("  %-10s %s: found\n", what, *names);
            dlclose(library);
            return;
        }
    }
    printf("  %-10s missing; install the package %s if you want it\n", what, package);
}

int stage_doctor(void)
{
    static const char *const osmesa[] = {"libOSMesa.so.8", "libOSMesa.so.6", NULL};
    static const char *const glfw[] = {"libglfw.so.3", NULL};
    bool works = false;
    for (int i = 0; CANVAS_BACKENDS[i]; i++) {
        printf("%s: %s\n", CANVAS_BACKENDS[i]->name, CANVAS_BACKENDS[i]->summary);
        works |= CANVAS_BACKENDS[i]->doctor();
    }
    printf("pictures:\n");
    image_doctor();
    printf("libraries that nothing needs yet:\n");
    doctor_library("OSMesa", osmesa, "libosmesa6");
    doctor_library("GLFW", glfw, "libglfw3");
    printf(works ? "This machine can draw.\n" : "This machine cannot draw yet.\n");
    return works ? 0 : EXIT_FAILED;
}
