/* A program as a process: reads the command line, and draws pictures. */
#include "app/run.h"

#include "app/command.h"
#include "app/frames.h"
#include "app/options.h"
#include "app/run_more.h"
#include "base/clock.h"
#include "base/output.h"

#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool run_check_first(const Options *options, Message *message)
{
    char first[PATH_MAX];
    return frames_path(options, 0, first, message) && output_check(first, message);
}

bool run_open_canvas(Canvas *canvas, const Example *example, const Options *options,
                     Message *message)
{
    char first[PATH_MAX];
    const bool bytes = options->animation || example_kind(example)->bytes;
    return frames_path(options, 0, first, message) &&
           options_open_canvas(canvas, options, bytes ? "x.png" : first, message);
}

void run_warn(const Renderer *renderer)
{
    if (renderer->warning.text[0])
        options_warn(renderer->example->name, &renderer->warning);
}

void run_close(Renderer *renderer, ShaderFiles *files, const char *name, bool done,
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

bool run_drawing(const Example *example, Options *options, Message *message)
{
    Canvas canvas = {.width = options->width, .height = options->height};
    Renderer renderer = {.example = NULL};
    FrameSink sink = {.queue = NULL};
    ShaderFiles files = {.count = 0};
    const bool gl = !example_kind(example)->without_gl;
    options->shaders.files = &files;
    /* llvmpipe's threads would compete with those that encode pictures: on two cores PNG takes 1.08
     * times as long with them, but raw pictures 0.7 times. */
    if (options->frames > 1 && !animation_is_raw(options->animation))
        setenv("LP_NUM_THREADS", "0", 0);
    const DrawRequest request = options_request(options, example);
    if (gl && !run_open_canvas(&canvas, example, options, message))
        return false;
    bool done = renderer_open(&renderer, example, &canvas, &request, message);
    if (done)
        run_warn(&renderer);
    done = done && frames_open(&sink, &canvas, options, message) &&
           frames_draw(&renderer, options, sink.queue, message);
    run_close(&renderer, &files, example->name, done, options);
    /* Closing the driver takes as long as encoding the last picture: do both at once. */
    const double start = clock_now();
    canvas_close(&canvas);
    done = frames_close(&sink, done, message);
    if (done && options->verbose && gl)
        fprintf(stderr, "closing, and encoding and writing the last picture, took %.1f ms\n",
                1e3 * (clock_now() - start));
    return done;
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

/* One picture, or some. */
static bool only_draws(const Example *example, const Options *options)
{
    return !options->merge && !options->vector && !options->save_scene && !options->shaders.print &&
           !options->explain && !options->probe.asked && !options->show && !options->arithmetic &&
           !options->watch && !(options->part.count && options->animation) &&
           !options_in_window(options) && !example_kind(example)->without_gl;
}

static bool run(const Example *example, Options *options, const ParameterValue *defaults,
                Message *message)
{
    if (!only_draws(example, options))
        return run_more(example, options, defaults, message);
    return shader_loader_check(&options->shaders, message) && run_check_first(options, message) &&
           run_drawing(example, options, message);
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
#ifdef M_TRIM_THRESHOLD
    /* Else a large mesh's memory in Mesa is cleared in each frame, in half its time. */
    mallopt(M_TRIM_THRESHOLD, 1 << 29);
#endif
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
