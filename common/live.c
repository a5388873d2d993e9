#include "live.h"

#include "progress.h"

#include <stdio.h>
#include <stdlib.h>

bool live_open(Live *live, const Example *example, const Canvas *canvas, Options *options,
               Message *message)
{
    *live = (Live){.example = example, .canvas = canvas, .options = options};
    if (!watch_open(&live->watch, message) || !watch_set(live->watch, NULL, 0, message)) {
        live_close(live);
        return false;
    }
    options->shaders.files = &live->files;
    return true;
}

static void leave(Live *live)
{
    if (live->on_stage)
        stage_leave(live->example);
    live->on_stage = false;
}

static bool enter(Live *live, Message *message)
{
    live->on_stage = stage_enter(live->example, live->options, message);
    return live->on_stage;
}

/* Puts the example on the stage with what is on disk. */
static bool enter_new(Live *live, Message *message)
{
    const Options *options = live->options;
    /* The folders at the end, for what was read and missed is to be known. */
    const bool done = enter(live, message) &&
                      (!live->example->scene || stage_draw(live->example, live->canvas, options,
                                                           options->seconds, message)) &&
                      shader_loader_check(&options->shaders, message);
    if (!done)
        leave(live);
    return done;
}

/* The files that decide whether there is something new on disk. */
static const ShaderFiles *last_load(const Live *live)
{
    return live->refused.count ? &live->refused : &live->files;
}

static void replace(ShaderFiles *files, ShaderFiles *by)
{
    shader_files_close(files);
    *files = *by;
    *by = (ShaderFiles){0};
}

static LiveResult load(Live *live, Message *error)
{
    ShaderFiles good = live->files;
    live->files = (ShaderFiles){0};
    leave(live);
    if (enter_new(live, error)) {
        replace(&live->earlier, &good);
        shader_files_close(&live->refused);
        return LIVE_LOADED;
    }
    replace(&live->refused, &live->files);
    live->files = good;
    if (good.count)
        enter(live, NULL);
    return last_load(live)->count ? LIVE_BROKEN : LIVE_FAILED;
}

/* Watches the files of the last load, to which a draw may have added some. */
static bool watch_files(Live *live, Message *message)
{
    const ShaderFiles *files = last_load(live);
    const char **paths = malloc(((size_t)files->count + 1) * sizeof *paths);
    if (!paths)
        return message_set(message, "watching files: not enough memory");
    for (int i = 0; i < files->count; i++)
        paths[i] = files->files[i].path;
    const bool done = watch_set(live->watch, paths, files->count, message);
    free(paths);
    live->watched = files->count;
    return done;
}

static void say_slow(Live *live)
{
    const char *why = watch_polls(live->watch);
    if (why && !live->said && live->options->verbose)
        fprintf(stderr, "%s: looks for changes ten times a second: %s\n", live->example->name, why);
    live->said |= why != NULL;
}

LiveResult live_poll(Live *live, double wait, Message *error)
{
    if (live->watched != last_load(live)->count && !watch_files(live, error))
        return LIVE_FAILED;
    if (!watch_wait(live->watch, wait))
        return LIVE_UNCHANGED;
    say_slow(live);
    live->began = progress_now();
    if (live->watched) {
        const char *path = shader_files_changed(last_load(live));
        if (!path)
            return LIVE_UNCHANGED;
        snprintf(live->changed, sizeof live->changed, "%s", path);
    }
    const LiveResult result = load(live, error);
    return watch_files(live, error) ? result : LIVE_FAILED;
}

bool live_revert(Live *live, const Message *error)
{
    if (!error->located || !live->earlier.count)
        return false;
    leave(live);
    replace(&live->refused, &live->files);
    replace(&live->files, &live->earlier);
    return enter(live, NULL);
}

void live_close(Live *live)
{
    if (!live || !live->watch)
        return;
    leave(live);
    live->options->shaders.files = NULL;
    watch_close(live->watch);
    shader_files_close(&live->files);
    shader_files_close(&live->earlier);
    shader_files_close(&live->refused);
    *live = (Live){0};
}
