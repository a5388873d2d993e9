#include "app/run.h"

#include "app/command.h"
#include "app/doctor.h"
#include "app/explain.h"
#include "app/live.h"
#include "app/unused.h"
#include "app/viewer.h"
#include "base/clock.h"
#include "base/output.h"
#include "base/progress.h"
#include "core/example.h"
#include "images/animation.h"
#include "scene/scene_example.h"
#include "window/backends.h"
#include "window/window.h"

/* See stage.h. */
#pragma weak explain_programs
#pragma weak unused_options
#pragma weak unused_terms_check

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The file of picture `number`. */
static bool picture_path(const Options *options, int number, char path[PATH_MAX], Message *message)
{
    if (options->numbered)
        return output_numbered(options->output, number, path, PATH_MAX, message);
    if (snprintf(path, PATH_MAX, "%s", options->output) >= PATH_MAX)
        return message_set(message, "%s: %s", options->output, strerror(ENAMETOOLONG));
    return true;
}

/* The threads that write pictures, and the animation if all go to one file or stream. */
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
    const PictureQueueOptions pictures = {.width = canvas->width,
                                          .height = canvas->height,
                                          .type = canvas->real ? IMAGE_FLOAT : IMAGE_BYTE,
                                          .count = options->frames,
                                          .write = sink->animation ? animation_add : NULL,
                                          .data = sink->animation};
    return picture_queue_open(&sink->queue, &pictures, message);
}

/* Waits for the last picture to be written. Unless all were drawn, no animation is left. */
static bool sink_close(Sink *sink, bool drawn, Message *message)
{
    const bool written = picture_queue_close(sink->queue, message) && drawn;
    return animation_close(sink->animation, written, message);
}

static bool draw_pictures(Stage *stage, const Options *options, PictureQueue *queue,
                          Message *message)
{
    Progress progress = progress_start(stage->example->name);
    bool done = true;
    for (int i = 0; i < options->frames && done; i++) {
        const double seconds = options->seconds + i / options->fps;
        if (!part_has(options->part, (uint64_t)i))
            continue;
        Picture *picture = picture_queue_take(queue);
        done = picture_path(options, i, picture->path, message) &&
               stage_picture(stage, options, seconds, picture, message) &&
               picture_queue_give(queue, picture, message);
        progress_update(&progress, i + 1, options->frames);
    }
    progress_end(&progress);
    if (done && options->verbose)
        fprintf(stderr, "drawing and reading took %.1f ms\n", 1e3 * (clock_now() - progress.start));
    return done;
}

static bool redraw(Live *live, Message *message)
{
    const Options *options = live->options;
    Sink sink;
    const bool drawn = sink_open(&sink, live->canvas, options, message) &&
                       draw_pictures(&live->stage, options, sink.queue, message);
    if (!sink_close(&sink, drawn, message))
        return false;
    fprintf(stderr, "%s: %s%sdrew %s in %.0f ms\n", live->example->name, live->changed,
            live->changed[0] ? " changed; " : "", options->output,
            1e3 * (clock_now() - live->began));
    return true;
}

/* Where the parts of an animation are: pictures in a folder of its name. */
typedef struct Parts {
    char folder[PATH_MAX], pictures[2 * PATH_MAX];
    Options options; /* with which they are drawn */
} Parts;

static bool parts_of(Parts *parts, const Options *options, Message *message)
{
    size_t length = 0;
    parts->options = *options;
    parts->options.animation = NULL;
    parts->options.numbered = true;
    parts->options.output = parts->pictures;
    if (snprintf(parts->folder, sizeof parts->folder, "%s.parts", options->output) >= PATH_MAX)
        return message_set(message, "%s: %s", options->output, strerror(ENAMETOOLONG));
    for (const char *p = parts->folder; *p; p++) {
        parts->pictures[length++] = *p;
        if (*p == '%')
            parts->pictures[length++] = '%';
    }
    snprintf(parts->pictures + length, sizeof parts->pictures - length, "/%%06d.png");
    return true;
}

static bool parts_are_whole(const Parts *parts, Message *message)
{
    int missing = 0, first = 0;
    for (int i = parts->options.frames - 1; i >= 0; i--) {
        char path[PATH_MAX];
        if (!picture_path(&parts->options, i, path, message))
            return false;
        if (access(path, F_OK) != 0) {
            missing++;
            first = i;
        }
    }
    return !missing || message_set(message,
                                   "%s: %d of %d pictures are missing, the first is %06d.png; "
                                   "--part draws them",
                                   parts->folder, missing, parts->options.frames, first);
}

/* --merge. */
static bool merge_parts(const Example *example, const Options *options, Message *message)
{
    const CanvasBackend *given = options->canvas.backend;
    const Canvas canvas = {.width = options->width,
                           .height = options->height,
                           .backend = example->diagram ? NULL
                                      : given          ? given
                                                       : backend_default(message)};
    const Stage stage = {.example = example, .canvas = &canvas};
    Parts parts;
    Sink sink = {.queue = NULL};
    char driver[STAGE_DRIVER_SIZE] = "";
    if (!parts_of(&parts, options, message) || !parts_are_whole(&parts, message))
        return false;
    bool done = sink_open(&sink, &canvas, options, message);
    for (int i = 0; i < options->frames && done; i++) {
        Picture *picture = picture_queue_take(sink.queue);
        done = picture_path(&parts.options, i, picture->path, message) &&
               stage_picture_part(&stage, &parts.options, options->seconds + i / options->fps,
                                  driver, picture, message) &&
               picture_queue_give(sink.queue, picture, message);
    }
    return sink_close(&sink, done, message);
}

/* --watch: draws whenever a shader changes, until the process ends. Errors are reported and can be
 * corrected. */
static bool watch_shaders(const Example *example, const Canvas *canvas, const Options *options,
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
        if (result == LIVE_LOADED)
            stage_warn(&live.stage);
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

/* Vector files of a diagram. */
static bool write_drawings(const Example *example, const Options *options, Message *message)
{
    bool done = true;
    for (int i = 0; i < options->frames && done; i++) {
        if (!part_has(options->part, (uint64_t)i))
            continue;
        char path[PATH_MAX];
        Drawing drawing = {.width = 0};
        done = picture_path(options, i, path, message) &&
               stage_drawing(example, options->seconds + i / options->fps, options->width,
                             options->height, &drawing, message) &&
               drawing_write(&drawing, path, options->vector, options->alpha, message);
        drawing_end(&drawing);
    }
    return done;
}

/* A diagram without a window, which needs neither a driver nor a display. */
static bool run_diagram(const Example *example, const Options *options, Message *message)
{
    const Canvas size = {.width = options->width, .height = options->height};
    char first[PATH_MAX];
    Stage stage = {.example = NULL};
    Sink sink = {.queue = NULL};
    if (!picture_path(options, 0, first, message) || !output_check(first, message))
        return false;
    if (options->vector)
        return write_drawings(example, options, message);
    const bool done = stage_open(&stage, example, &size, options, message) &&
                      sink_open(&sink, &size, options, message) &&
                      draw_pictures(&stage, options, sink.queue, message);
    stage_close(&stage);
    return sink_close(&sink, done, message);
}

/* A folder without a shader of this program is probably the wrong one. */
static void tell_unused_folder(const char *program, const char *folder, const ShaderFiles *files)
{
    const size_t length = strlen(folder);
    for (int i = 0; i < files->count; i++)
        if (files->files[i].text && strncmp(files->files[i].path, folder, length) == 0 &&
            files->files[i].path[length] == '/')
            return;
    fprintf(stderr, "%s: --shaders %s: no effect here; no shader file of this program is there\n",
            program, folder);
}

static bool run_example(const Example *example, const Options *given,
                        const ParameterValue *defaults, Message *message)
{
    ShaderFiles files = {.count = 0};
    Options own = *given, *options = &own;
    char first[PATH_MAX];
    Canvas canvas = {0};
    Stage stage = {.example = NULL};
    Sink sink = {.queue = NULL};
    const bool drawing = !options->shaders.print && !options->explain;
    if (example->diagram && !options_in_window(options))
        return run_diagram(example, options, message);
    if (!shader_loader_check(&options->shaders, message))
        return false;
    if (drawing && (!picture_path(options, 0, first, message) || !output_check(first, message)))
        return false;
    /* llvmpipe's threads would compete with those that encode pictures. */
    if (options->frames > 1)
        setenv("LP_NUM_THREADS", "0", 0);
    /* Diagrams and pages are painted in bytes, whatever format a key saves them in. */
    const bool bytes = !drawing || options->animation || example->diagram || example->page;
    if (!stage_open_canvas(&canvas, options, bytes ? "x.png" : first, message))
        return false;
    if (drawing && window_of(&canvas)) {
        const bool shown = viewer_run(example, &canvas, options, defaults, message);
        canvas_close(&canvas);
        return shown;
    }
    if (options->watch) {
        const bool done = watch_shaders(example, &canvas, options, message);
        canvas_close(&canvas);
        return done;
    }
    options->shaders.files = &files;
    bool done = stage_open(&stage, example, &canvas, options, message);
    if (done)
        stage_warn(&stage);
    if (done && options->explain)
        done = explain_programs(&stage, options, message);
    else if (done && options->shaders.print && example->scene)
        done = stage_draw(&stage, options, options->seconds, message);
    else if (done && drawing)
        done = sink_open(&sink, &canvas, options, message) &&
               draw_pictures(&stage, options, sink.queue, message);
    stage_close(&stage);
    if (done && options->shaders.folder)
        tell_unused_folder(example->name, options->shaders.folder, &files);
    shader_files_close(&files);
    /* Closing the driver takes as long as encoding the last picture: do both at once. */
    const double start = clock_now();
    canvas_close(&canvas);
    done = sink_close(&sink, done, message);
    if (done && options->verbose)
        fprintf(stderr, "closing, and encoding and writing the last picture, took %.1f ms\n",
                1e3 * (clock_now() - start));
    return done;
}

/* Says which of the options do nothing here. */
static void tell_unused(const Example *example, const Options *options,
                        const ParameterValue *defaults)
{
    char names[512];
    unused_options(example, options, defaults, names, sizeof names);
    if (names[0])
        fprintf(stderr, "%s: %s: no effect here; the picture is the same without\n", example->name,
                names);
}

/* Drawing, or all parts of an animation together. */
static bool run_once(const Example *example, const Options *options, const ParameterValue *defaults,
                     Message *message)
{
    Parts parts;
    if (options->merge)
        return merge_parts(example, options, message);
    if (!options->part.count || !options->animation)
        return run_example(example, options, defaults, message);
    return parts_of(&parts, options, message) && output_folder(parts.folder, message) &&
           run_example(example, &parts.options, defaults, message);
}

static void tell_written(const Example *example, const Options *options)
{
    const int count = options->frames;
    char first[PATH_MAX], last[PATH_MAX];
    if (options_in_window(options) || options->shaders.print || options->explain ||
        options->part.count || strcmp(options->output, "-") == 0 ||
        !picture_path(options, 0, first, NULL) || !picture_path(options, count - 1, last, NULL))
        return;
    if (count == 1)
        options_tell(example->name, "wrote %s, %dx%d", first, options->width, options->height);
    else if (options->animation)
        options_tell(example->name, "wrote %s, %d pictures, %dx%d", first, count, options->width,
                     options->height);
    else
        options_tell(example->name, "wrote %s to %s, %dx%d", first, last, options->width,
                     options->height);
}

int example_main(const Example *example, int argc, char *argv[])
{
    Options options;
    ParameterValue defaults[OPTIONS_MAX_PARAMETERS] = {{.number = 0}};
    char start[PATH_MAX];
    int code;
    Message message = {0};
    const Usage usage = options_usage(example);
    for (int i = 0; example_parameters(example) && example_parameters(example)[i].name; i++)
        defaults[i] = parameter_save(&example_parameters(example)[i]);
    if (!options_begin(&options, &usage, argc, argv, &code))
        return code;
    options.defaults = defaults;
    if (command_start(example->name, argc > 0 ? argv[0] : NULL, start, sizeof start))
        options.start = start;
    options.canvas.title = example->name;
    if (options.doctor)
        return options_finish(example->name, doctor_run());
    if (example->scene && !unused_terms_check(example, &options, &message))
        return options_fail(example->name, &message, EXIT_USAGE);
    if ((example->scene || example->diagram) && example_parameters(example) &&
        !options.shaders.print && !options_in_window(&options)) /* where they can be changed */
        tell_unused(example, &options, defaults);
    if (!run_once(example, &options, defaults, &message))
        return options_fail(example->name, &message, EXIT_FAILED);
    tell_written(example, &options);
    return options_finish(example->name, 0);
}
