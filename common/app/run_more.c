/* What a command line can ask for besides pictures in files. */
#include "app/run_more.h"

#include "app/frames.h"
#include "app/probing.h"
#include "app/shader_reload.h"
#include "app/viewer.h"
#include "base/clock.h"
#include "base/output.h"

#include <math.h>
#include <stdio.h>

static bool run_window(const Example *example, const Options *options,
                       const ParameterValue *defaults, Message *message)
{
    Canvas canvas = {0};
    if (!run_open_canvas(&canvas, example, options, message))
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
    const char *how = reload->gone ? " is gone; " : " changed; ";
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
            run_warn(&reload->renderer);
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
    if (!run_open_canvas(&canvas, example, options, message))
        return false;
    shader_reload_open(&reload, example, &canvas, &request);
    options->shaders.files = request.shaders.files;
    watch_shaders(&reload, options, message);
    shader_reload_close(&reload);
    canvas_close(&canvas);
    return false;
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
        run_warn(&renderer);
    if (done && options->explain)
        done = renderer_explain(&renderer, &request, message);
    else if (done && renderer.kind->compiles_late)
        done = renderer_draw(&renderer, &request, request.seconds, message);
    run_close(&renderer, &files, example->name, done, options);
    canvas_close(&canvas);
    return done;
}

bool run_more(const Example *example, Options *options, const ParameterValue *defaults,
              Message *message)
{
    FrameParts parts;
    if (options->merge)
        return frames_merge(example, options, message);
    if (options->vector && !options_in_window(options))
        return run_check_first(options, message) && frames_write_vectors(example, options, message);
    if (options->save_scene) {
        const DrawRequest request = options_request(options, example);
        const bool done =
            example_kind(example)->save(example, &request, options->save_scene, message);
        if (done && message->text[0])
            options_warn(example->name, message);
        return done;
    }
    if (!example_kind(example)->without_gl && !shader_loader_check(&options->shaders, message))
        return false;
    if (options->shaders.print || options->explain)
        return run_printing(example, options, message);
    if (options->probe.asked)
        return probing_tell(example, options, message);
    if (options->show || options->arithmetic)
        return run_check_first(options, message) && probing_show(example, options, message);
    if (options->part.count && options->animation) {
        if (!frames_find_parts(&parts, options, message) || !output_folder(parts.folder, message))
            return false;
        options = &parts.options;
    }
    if (!run_check_first(options, message))
        return false;
    if (options_in_window(options))
        return run_window(example, options, defaults, message);
    return options->watch ? run_watching(example, options, message)
                          : run_drawing(example, options, message);
}
