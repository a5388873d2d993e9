/* A program as a process: reads the command line, and does one of the things it can ask for. */
#include "app/run.h"

#include "app/command.h"
#include "app/frames.h"
#include "app/options.h"
#include "app/probing.h"
#include "app/shader_reload.h"
#include "app/viewer.h"
#include "base/clock.h"
#include "base/output.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The first file can be written. */
static bool check_first(const Options *options, Message *message)
{
    char first[PATH_MAX];
    return frames_path(options, 0, first, message) && output_check(first, message);
}

/* A canvas for pictures to be written; of bytes if all are painted or go to one file. */
static bool open_canvas(Canvas *canvas, const Example *example, const Options *options,
                        Message *message)
{
    char first[PATH_MAX];
    const bool bytes = options->animation || example_kind(example)->bytes;
    return frames_path(options, 0, first, message) &&
           options_open_canvas(canvas, options, bytes ? "x.png" : first, message);
}

static void warn(const Renderer *renderer)
{
    if (renderer->warning.text[0])
        options_warn(renderer->example->name, &renderer->warning);
}

static bool run_window(const Example *example, const Options *options,
                       const ParameterValue *defaults, Message *message)
{
    Canvas canvas = {0};
    if (!open_canvas(&canvas, example, options, message))
        return false;
    const bool shown = viewer_run(example, &canvas, options, defaults, message);
    canvas_close(&canvas);
    return shown;
}

static bool redraw(ShaderReload *reload, const Options *options, Message *message)
{
    FrameSink sink;
    const bool drawn = frames_open(&sink, reload->canvas, options, message) &&
                       frames_draw(&reload->renderer, options, sink.queue, message);
    if (!frames_close(&sink, drawn, message))
        return false;
    const char *changed = reload->changed;
    const char *how = access(changed, F_OK) == 0 ? " changed; " : " is gone; ";
    fprintf(stderr, "%s: %s%sdrew %s in %.0f ms\n", reload->example->name, changed,
            changed[0] ? how : "", options->output, 1e3 * (clock_now() - reload->began));
    return true;
}

/* --watch: draws whenever a shader changes, until the process ends. Errors are reported and can be
 * corrected. */
static void watch_shaders(ShaderReload *reload, const Options *options, Message *message)
{
    const char *name = reload->example->name;
    ReloadResult result;
    for (bool begun = false;
         (result = shader_reload_poll(reload, HUGE_VAL, message)) != RELOAD_FAILED;) {
        if (result == RELOAD_UNCHANGED)
            continue;
        if (result == RELOAD_LOADED)
            warn(&reload->renderer);
        if (result == RELOAD_BROKEN || !redraw(reload, options, message))
            options_fail(name, message, EXIT_FAILED);
        *message = (Message){0};
        if (!begun)
            fprintf(stderr, "%s: watching its shader files; Ctrl-C ends\n", name);
        begun = true;
    }
}

static bool run_watching(const Example *example, Options *options, Message *message)
{
    Canvas canvas = {0};
    ShaderReload reload;
    DrawRequest request = options_request(options, example);
    if (!open_canvas(&canvas, example, options, message))
        return false;
    shader_reload_open(&reload, example, &canvas, &request);
    options->shaders.files = request.shaders.files;
    watch_shaders(&reload, options, message);
    shader_reload_close(&reload);
    canvas_close(&canvas);
    return false;
}

/* Closes the renderer, and says whether --shaders was of any use. */
static void close_renderer(Renderer *renderer, ShaderFiles *files, const char *name, bool done,
                           const Options *options)
{
    renderer_close(renderer);
    Message unused = {0};
    if (done && options->shaders.folder)
        shader_files_unused(files, options->shaders.folder, &unused);
    if (unused.text[0])
        options_warn(name, &unused);
    shader_files_close(files);
}

/* --explain, --print-shader. */
static bool run_printing(const Example *example, Options *options, Message *message)
{
    Canvas canvas = {0};
    Renderer renderer = {.example = NULL};
    ShaderFiles files = {.count = 0};
    options->shaders.files = &files;
    const DrawRequest request = options_request(options, example);
    if (!options_open_canvas(&canvas, options, "x.png", message))
        return false;
    bool done = renderer_open(&renderer, example, &canvas, &request, message);
    if (done)
        warn(&renderer);
    if (done && options->explain)
        done = renderer_explain(&renderer, &request, message);
    else if (done && renderer.kind->compiles_late)
        done = renderer_draw(&renderer, &request, request.seconds, message);
    close_renderer(&renderer, &files, example->name, done, options);
    canvas_close(&canvas);
    return done;
}

static bool run_drawing(const Example *example, Options *options, Message *message)
{
    Canvas canvas = {0};
    Renderer renderer = {.example = NULL};
    FrameSink sink = {.queue = NULL};
    ShaderFiles files = {.count = 0};
    options->shaders.files = &files;
    const DrawRequest request = options_request(options, example);
    if (!open_canvas(&canvas, example, options, message))
        return false;
    bool done = renderer_open(&renderer, example, &canvas, &request, message);
    if (done)
        warn(&renderer);
    done = done && frames_open(&sink, &canvas, options, message) &&
           frames_draw(&renderer, options, sink.queue, message);
    close_renderer(&renderer, &files, example->name, done, options);
    /* Closing the driver takes as long as encoding the last picture: do both at once. */
    const double start = clock_now();
    canvas_close(&canvas);
    done = frames_close(&sink, done, message);
    if (done && options->verbose)
        fprintf(stderr, "closing, and encoding and writing the last picture, took %.1f ms\n",
                1e3 * (clock_now() - start));
    return done;
}

/* Neither a driver nor a display is needed. */
static bool run_without_gl(const Example *example, const Options *options, Message *message)
{
    const Canvas size = {.width = options->width, .height = options->height};
    const DrawRequest request = options_request(options, example);
    Renderer renderer = {.example = NULL};
    FrameSink sink = {.queue = NULL};
    const bool done = renderer_open(&renderer, example, &size, &request, message) &&
                      frames_open(&sink, &size, options, message) &&
                      frames_draw(&renderer, options, sink.queue, message);
    renderer_close(&renderer);
    return frames_close(&sink, done, message);
}

/* Says which of the options do nothing here. */
static void tell_ineffective(const Example *example, const Options *options,
                             const ParameterValue *defaults)
{
    char names[512] = "";
    const ExampleKind *kind = example_kind(example);
    if (!kind->find_ineffective || !example->parameters || options->shaders.print ||
        options_in_window(options)) /* where they can be changed */
        return;
    kind->find_ineffective(example, options, defaults, names, sizeof names);
    if (names[0])
        fprintf(stderr, "%s: %s: ignored: has no effect here\n", example->name, names);
}

/* Does what the options ask for, drawing unless they ask for something else. */
static bool run(const Example *example, Options *options, const ParameterValue *defaults,
                Message *message)
{
    FrameParts parts;
    if (options->merge)
        return frames_merge(example, options, message);
    if (options->vector && !options_in_window(options))
        return check_first(options, message) && frames_write_vectors(example, options, message);
    if (options->save_scene) {
        const DrawRequest request = options_request(options, example);
        return example_kind(example)->save(example, &request, options->save_scene, message);
    }
    if (!example_kind(example)->without_gl && !shader_loader_check(&options->shaders, message))
        return false;
    if (options->shaders.print || options->explain)
        return run_printing(example, options, message);
    if (options->probe.asked)
        return probing_tell(example, options, message);
    if (options->show || options->arithmetic)
        return check_first(options, message) && probing_show(example, options, message);
    if (options->part.count && options->animation) {
        if (!frames_find_parts(&parts, options, message) || !output_folder(parts.folder, message))
            return false;
        options = &parts.options;
    }
    if (!check_first(options, message))
        return false;
    if (options_in_window(options))
        return run_window(example, options, defaults, message);
    if (example_kind(example)->without_gl)
        return run_without_gl(example, options, message);
    /* llvmpipe's threads would compete with those that encode pictures: on two cores PNG takes 1.08
     * times as long with them, but raw pictures 0.7 times. */
    if (options->frames > 1 && !animation_is_raw(options->animation))
        setenv("LP_NUM_THREADS", "0", 0);
    return options->watch ? run_watching(example, options, message)
                          : run_drawing(example, options, message);
}

static void tell_written(const Example *example, const Options *options)
{
    const int count = options->frames;
    char first[PATH_MAX], last[PATH_MAX];
    if (options_in_window(options) || options->shaders.print || options->explain ||
        options->save_scene || options->probe.asked || options->part.count ||
        strcmp(options->output, "-") == 0 || !frames_path(options, 0, first, NULL) ||
        !frames_path(options, count - 1, last, NULL))
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
    for (int i = 0; example->parameters && example->parameters[i].name; i++)
        defaults[i] = parameter_save(&example->parameters[i]);
    if (!options_begin(&options, &usage, argc, argv, &code))
        return code;
    options.defaults = defaults;
    if (command_start(example->name, argc > 0 ? argv[0] : NULL, start, sizeof start))
        options.start = start;
    options.canvas.title = example->name;
    const DrawRequest request = options_request(&options, example);
    const ExampleKind *kind = example_kind(example);
    if (kind->check && !kind->check(example, &request, &message))
        return options_fail(example->name, &message, EXIT_USAGE);
    tell_ineffective(example, &options, defaults);
    if (!run(example, &options, defaults, &message))
        return options_fail(example->name, &message,
                            options.show_unknown ? EXIT_USAGE : EXIT_FAILED);
    tell_written(example, &options);
    return options_finish(example->name, 0);
}
