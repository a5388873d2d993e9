#include "example.h"

#include "animation.h"
#include "live.h"
#include "output.h"
#include "progress.h"
#include "stage.h"
#include "viewer.h"
#include "window.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void example_annotate(double seconds, int view, const Scene *scene, Annotations *annotations)
{
    (void)seconds, (void)view;
    marks_add_axes(&annotations->lines, 2);
    marks_add_lights(&annotations->points, scene);
}

bool frame_look_at(const Frame *frame, Vec3 eye, Vec3 center, Vec3 up, Mat4 *eye_from_world)
{
    orbit_move(frame->orbit, &eye, center, &up);
    return mat4_look_at(eye, center, up, eye_from_world);
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

/* The threads that write, and where to, if that is one file or stream. */
typedef struct Sink {
    PictureQueue *queue;
    Animation *animation;
} Sink;

static bool sink_open(Sink *sink, const Canvas *canvas, const Options *options, Message *message)
{
    const AnimationOptions animation = {.format = options->animation,
                                        .path = options->output,
                                        .width = canvas->width,
                                        .height = canvas->height,
                                        .frames = options->frames,
                                        .fps = options->fps,
                                        .alpha = options->alpha,
                                        .compress = options->compress};
    *sink = (Sink){.queue = NULL};
    if (options->animation && !animation_open(&sink->animation, &animation, message))
        return false;
    const PictureSink in_order = {.write = animation_add, .data = sink->animation, .threads = 1};
    return picture_queue_open(&sink->queue, canvas->width, canvas->height,
                              canvas->real ? IMAGE_FLOAT : IMAGE_BYTE, options->frames,
                              sink->animation ? &in_order : NULL, message);
}

/* Waits for the last picture to be written. `drawn`: they all were, and without it no animation is
 * made. */
static bool sink_close(Sink *sink, bool drawn, Message *message)
{
    const bool written = picture_queue_close(sink->queue, message) && drawn;
    return animation_close(sink->animation, written, message);
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

/* Draws with the shaders that are on the stage now, to the end of the last file. */
static bool redraw(const Live *live, Message *message)
{
    const Canvas *canvas = live->canvas;
    const Options *options = live->options;
    Sink sink;
    const bool drawn = sink_open(&sink, canvas, options, message) &&
                       draw(live->example, canvas, options, sink.queue, message);
    if (!sink_close(&sink, drawn, message))
        return false;
    fprintf(stderr, "%s: %s%sdrew %s in %.0f ms\n", live->example->name, live->changed,
            live->changed[0] ? " changed; " : "", options->output,
            1e3 * (progress_now() - live->began));
    return true;
}

/* --watch: draws whenever a shader changes, and ends with the process. What fails is said, and may
 * be mended. */
static bool watch(const Example *example, const Canvas *canvas, const Options *options,
                  Message *message)
{
    Options watched = *options;
    Live live;
    if (!live_open(&live, example, canvas, &watched, message))
        return false;
    LiveResult result;
    for (bool begun = false; (result = live_poll(&live, HUGE_VAL, message)) != LIVE_FAILED;) {
        if (result == LIVE_UNCHANGED)
            continue;
        if (result == LIVE_BROKEN || !redraw(&live, message))
            options_fail(example->name, message, EXIT_FAILED);
        *message = (Message){0};
        if (!begun)
            fprintf(stderr, "%s: watching its shader files; Ctrl-C ends\n", example->name);
        begun = true;
    }
    live_close(&live);
    return false;
}

static bool run(const Example *example, const Options *options, const ParameterValue *defaults,
                Message *message)
{
    char first[PATH_MAX];
    Canvas canvas = {0};
    Sink sink = {.queue = NULL};
    const bool drawing = !options->shaders.print && !options->explain;
    if (!shader_loader_check(&options->shaders, message))
        return false;
    if (drawing && (!picture_path(options, 0, first, message) || !output_check(first, message)))
        return false;
    /* While other threads encode one picture after another, llvmpipe's own are in their way. */
    if (options->frames > 1)
        setenv("LP_NUM_THREADS", "0", 0);
    if (!stage_open(&canvas, options, drawing && !options->animation ? first : "x.png", message))
        return false;
    if (drawing && window_of(&canvas)) {
        const bool shown = viewer_run(example, &canvas, options, defaults, message);
        canvas_close(&canvas);
        return shown;
    }
    if (options->watch) {
        const bool done = watch(example, &canvas, options, message);
        canvas_close(&canvas);
        return done;
    }
    bool done = stage_enter(example, options, message);
    if (done) {
        if (options->explain)
            done = stage_explain(example, options, message);
        else if (options->shaders.print && example->scene)
            done = stage_draw(example, &canvas, options, options->seconds, message);
        else if (drawing)
            done = sink_open(&sink, &canvas, options, message) &&
                   draw(example, &canvas, options, sink.queue, message);
        stage_leave(example);
    }
    /* The driver takes as long to close as the last picture to encode: both at once. */
    const double start = progress_now();
    canvas_close(&canvas);
    done = sink_close(&sink, done, message);
    if (done && options->verbose)
        fprintf(stderr, "closing, and encoding and writing the last picture, took %.1f ms\n",
                1e3 * (progress_now() - start));
    return done;
}

int example_main(const Example *example, int argc, char *argv[])
{
    Options options;
    ParameterValue defaults[OPTIONS_MOST_PARAMETERS] = {{.number = 0}};
    int code;
    Message message = {0};
    const Usage usage = {.name = example->name,
                         .summary = example->summary,
                         .scene = example->scene != NULL,
                         .width = example->width,
                         .height = example->height,
                         .parameters = example->parameters};
    for (int i = 0; example->parameters && example->parameters[i].name; i++)
        defaults[i] = parameter_save(&example->parameters[i]);
    if (!options_begin(&options, &usage, argc, argv, &code))
        return code;
    options.canvas.title = example->name;
    if (options.explain) /* with the shaders, as the driver is given them */
        options.shaders.print = SHADER_PRINT_VERTEX | SHADER_PRINT_FRAGMENT;
    if (options.doctor)
        return options_finish(example->name, stage_doctor());
    if (!run(example, &options, defaults, &message))
        return options_fail(example->name, &message, EXIT_FAILED);
    return options_finish(example->name, 0);
}
