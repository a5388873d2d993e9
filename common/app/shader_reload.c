/* The files that a load has read or missed are watched. A load that fails is not kept: what was
 * read before is opened again from memory, whatever is on disk by then. */
#include "app/shader_reload.h"

#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

void shader_reload_open(ShaderReload *reload, const Example *example, const Canvas *canvas,
                        DrawRequest *request)
{
    *reload = (ShaderReload){
        .example = example, .canvas = canvas, .request = request, .watch = watch_open()};
    request->shaders.files = &reload->files;
}

static bool open_renderer(ShaderReload *reload, Message *message)
{
    return renderer_open(&reload->renderer, reload->example, reload->canvas, reload->request,
                         message);
}

/* Opens the example with the files on disk. Checks the folders last, after recording which files
 * were read or missed. */
static bool open_new(ShaderReload *reload, Message *message)
{
    const DrawRequest *request = reload->request;
    const bool done = open_renderer(reload, message) &&
                      (!reload->renderer.kind->compiles_late ||
                       renderer_draw(&reload->renderer, request, request->seconds, message)) &&
                      shader_loader_check(&request->shaders, message);
    if (!done)
        renderer_close(&reload->renderer);
    return done;
}

/* The files that a change on disk is compared with. */
static const ShaderFiles *last_load(const ShaderReload *reload)
{
    return reload->refused.count ? &reload->refused : &reload->files;
}

static void replace_files(ShaderFiles *files, ShaderFiles *by)
{
    shader_files_close(files);
    *files = *by;
    *by = (ShaderFiles){0};
}

static ReloadResult load(ShaderReload *reload, Message *error)
{
    ShaderFiles good = reload->files;
    reload->files = (ShaderFiles){0};
    renderer_close(&reload->renderer);
    if (open_new(reload, error)) {
        replace_files(&reload->earlier, &good);
        shader_files_close(&reload->refused);
        return RELOAD_LOADED;
    }
    replace_files(&reload->refused, &reload->files);
    reload->files = good;
    if (good.count)
        open_renderer(reload, NULL);
    return last_load(reload)->count ? RELOAD_BROKEN : RELOAD_FAILED;
}

/* Watches the files of the last load; a draw may have added some. */
static void watch_files(ShaderReload *reload)
{
    const ShaderFiles *files = last_load(reload);
    const char **paths = memory_new((size_t)files->count, sizeof *paths);
    for (int i = 0; i < files->count; i++)
        paths[i] = files->files[i].path;
    watch_set(reload->watch, paths, files->count);
    free(paths);
    reload->watched = files->count;
}

ReloadResult shader_reload_poll(ShaderReload *reload, double wait, Message *error)
{
    if (reload->watched != last_load(reload)->count)
        watch_files(reload);
    const bool renewed = reload->renewed;
    reload->renewed = false;
    reload->changed[0] = '\0';
    reload->gone = false;
    if (!renewed && !watch_wait(reload->watch, wait))
        return RELOAD_UNCHANGED;
    reload->began = clock_now();
    if (reload->watched && !renewed) {
        const char *path = shader_files_changed(last_load(reload));
        if (!path)
            return RELOAD_UNCHANGED;
        snprintf(reload->changed, sizeof reload->changed, "%s", path);
        reload->gone = access(path, F_OK) != 0;
    }
    const ReloadResult result = load(reload, error);
    watch_files(reload);
    return result;
}

void shader_reload_renew(ShaderReload *reload)
{
    reload->renewed = true;
}

bool shader_reload_revert(ShaderReload *reload, const Message *error)
{
    if (!error->located || !reload->earlier.count)
        return false;
    renderer_close(&reload->renderer);
    replace_files(&reload->refused, &reload->files);
    replace_files(&reload->files, &reload->earlier);
    return open_renderer(reload, NULL);
}

void shader_reload_close(ShaderReload *reload)
{
    if (!reload || !reload->watch)
        return;
    renderer_close(&reload->renderer);
    reload->request->shaders.files = NULL;
    watch_close(reload->watch);
    shader_files_close(&reload->files);
    shader_files_close(&reload->earlier);
    shader_files_close(&reload->refused);
    *reload = (ShaderReload){0};
}
