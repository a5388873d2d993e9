#include "app/live.h"

#include "base/clock.h"

#include <stdio.h>
#include <stdlib.h>

bool live_open(Live *live, const Example *example, const Canvas *canvas, Options *options,
               Message *message)
{
    *live = (Live){.example = example, .canvas = canvas, .options = options};
    if (!watch_open(&live->watch, message))
        return false;
    options->shaders.files = &live->files;
    return true;
}

static bool open_stage(Live *live, Message *message)
{
    return stage_open(&live->stage, live->example, live->canvas, live->options, message);
}

/* Opens the stage with the files on disk. Checks the folders last, after recording which files were
 * read or missed. */
static bool open_new(Live *live, Message *message)
{
    const Options *options = live->options;
    const bool done =
        open_stage(live, message) &&
        (!live->example->scene || stage_draw(&live->stage, options, options->seconds, message)) &&
        shader_loader_check(&options->shaders, message);
    if (!done)
        stage_close(&live->stage);
    return done;
}

/* The files that a change on disk is compared with. */
static const ShaderFiles *last_load(const Live *live)
{
    return live->refused.count ? &live->refused : &live->files;
}

static void replace_files(ShaderFiles *files, ShaderFiles *by)
{
    shader_files_close(files);
    *files = *by;
    *by = (ShaderFiles){0};
}

static LiveResult load(Live *live, Message *error)
{
    ShaderFiles good = live->files;
    live->files = (ShaderFiles){0};
    stage_close(&live->stage);
    if (open_new(live, error)) {
        replace_files(&live->earlier, &good);
        shader_files_close(&live->refused);
        return LIVE_LOADED;
    }
    replace_files(&live->refused, &live->files);
    live->files = good;
    if (good.count)
        open_stage(live, NULL);
    return last_load(live)->count ? LIVE_BROKEN : LIVE_FAILED;
}

/* Watches the files of the last load; a draw may have added some. */
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

LiveResult live_poll(Live *live, double wait, Message *error)
{
    if (live->watched != last_load(live)->count && !watch_files(live, error))
        return LIVE_FAILED;
    const bool renewed = live->renewed;
    live->renewed = false;
    live->changed[0] = '\0';
    if (!renewed && !watch_wait(live->watch, wait))
        return LIVE_UNCHANGED;
    live->began = clock_now();
    if (live->watched && !renewed) {
        const char *path = shader_files_changed(last_load(live));
        if (!path)
            return LIVE_UNCHANGED;
        snprintf(live->changed, sizeof live->changed, "%s", path);
    }
    const LiveResult result = load(live, error);
    return watch_files(live, error) ? result : LIVE_FAILED;
}

void live_renew(Live *live)
{
    live->renewed = true;
}

bool live_revert(Live *live, const Message *error)
{
    if (!error->located || !live->earlier.count)
        return false;
    stage_close(&live->stage);
    replace_files(&live->refused, &live->files);
    replace_files(&live->files, &live->earlier);
    return open_stage(live, NULL);
}

void live_close(Live *live)
{
    if (!live || !live->watch)
        return;
    stage_close(&live->stage);
    live->options->shaders.files = NULL;
    watch_close(live->watch);
    shader_files_close(&live->files);
    shader_files_close(&live->earlier);
    shader_files_close(&live->refused);
    *live = (Live){0};
}
