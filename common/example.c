#include "example.h"

#include "output.h"
#include "progress.h"
#include "stage.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void example_annotate(double seconds, int view, const Scene *scene, Annotations *annotations)
{
    (void)seconds, (void)view;
    marks_add_axes(&annotations->lines, 2);
    marks_add_lights(&annotations->points, scene);
}

Mat4 example_turned(double seconds)
{
    Mat4 turned;
    mat4_rotate(OPTIONS_DEGREES_PER_SECOND * seconds, (Vec3){0, 1, 0}, &turned);
    return turned;
}

Vec3 example_turn(Vec3 point, double seconds)
{
    return mat4_transform_point(example_turned(seconds), point);
}

/* Where picture `number` goes. */
static bool picture_path(const Options *options, int number, char path[PATH_MAX], Message *message)
{
    if (options->numbered)
        return output_numbered(options->output, number, path, PATH_MAX, message);
    if (snprintf(path, PATH_MAX, "%s", options->output) >= PATH_MAX)
        return message_set(message, "%s: %s", options->output, strerror(ENAMETOOLONG));
    return true;
}

/* Draws every picture that the options ask for, and gives it to the threads that write. */
static bool draw(const Example *example, const Canvas *canvas, const Options *options,
                 PictureQueue *queue, Message *message)
{
    Progress progress = progress_start(example->name);
    bool done = true;
    for (int i = 0; i < options->frames && done; i++) {
        const double seconds = options->seconds + i / options->fps;
        Picture *picture = picture_queue_take(queue);
        done = picture_path(options, i, picture->path, message) &&
               stage_picture(example, canvas, options, seconds, picture, message) &&
               picture_queue_give(queue, picture, message);
        progress_update(&progress, i + 1, options->frames);
    }
    progress_end(&progress);
    if (done && options->verbose)
        fprintf(stderr, "drawing and reading took %.1f ms\n",
                1e3 * (progress_now() - progress.start));
    return done;
}

static bool run(const Example *example, const Options *options, Message *message)
{
    char first[PATH_MAX];
    Canvas canvas = {0};
    PictureQueue *queue = NULL;
    const bool drawing = !options->shaders.print && !options->explain;
    if (!shader_loader_check(&options->shaders, message))
        return false;
    if (drawing && (!picture_path(options, 0, first, message) || !output_check(first, message)))
        return false;
    /* While other threads encode one picture after another, llvmpipe's own are in their way. */
    if (options->frames > 1)
        setenv("LP_NUM_THREADS", "0", 0);
    if (!stage_open(&canvas, options, drawing ? first : "x.png", message))
        return false;
    bool done = stage_enter(example, options, message);
    if (done) {
        if (options->explain)
            done = stage_explain(example, options, message);
        else if (options->shaders.print && example->scene)
            done = stage_draw(example, &canvas, options, options->seconds, message);
        else if (drawing)
            done = picture_queue_open(&queue, canvas.width, canvas.height,
                                      canvas.real ? IMAGE_FLOAT : IMAGE_BYTE, options->frames,
                                      message) &&
                   draw(example, &canvas, options, queue, message);
        stage_leave(example);
    }
    /* The driver takes as long to close as the last picture to encode: both at once. */
    const double start = progress_now();
    canvas_close(&canvas);
    done = picture_queue_close(queue, message) && done;
    if (done && options->verbose)
        fprintf(stderr, "closing, and encoding and writing the last picture, took %.1f ms\n",
                1e3 * (progress_now() - start));
    return done;
}

int example_main(const Example *example, int argc, char *argv[])
{
    Options options;
    int code;
    Message message = {0};
    const Usage usage = {.name = example->name,
                         .summary = example->summary,
                         .scene = example->scene != NULL,
                         .width = example->width,
                         .height = example->height,
                         .parameters = example->parameters};
    if (!options_begin(&options, &usage, argc, argv, &code))
        return code;
    if (options.explain) /* with the shaders, as the driver is given them */
        options.shaders.print = SHADER_PRINT_VERTEX | SHADER_PRINT_FRAGMENT;
    if (options.doctor)
        return options_finish(example->name, stage_doctor());
    if (!run(example, &options, &message))
        return options_fail(example->name, &message, EXIT_FAILED);
    return options_finish(example->name, 0);
}
