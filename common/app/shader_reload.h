/*
 * shader_reload: an example whose shaders are edited while it is shown.
 *
 * Shaders are loaded again when a file they were read from changes, or when one appears that would
 * have been found earlier. If that fails, the last good ones are restored as they were read,
 * whatever is on disk by then.
 */
#ifndef SHADER_RELOAD_H
#define SHADER_RELOAD_H

#include "app/renderer.h"
#include "base/clock.h"
#include "base/watch.h"
#include "core/shader_files.h"

typedef enum ReloadResult {
    RELOAD_UNCHANGED,
    RELOAD_LOADED, /* the renderer has the shaders on disk */
    RELOAD_BROKEN, /* the shaders on disk have an error; the renderer has the last good ones, if any
                    */
    RELOAD_FAILED, /* the example cannot be drawn, and not because of a shader */
} ReloadResult;

typedef struct ShaderReload {
    const Example *example;
    const Canvas *canvas;
    DrawRequest *request;
    Watch *watch;
    Renderer renderer;      /* closed until there is a good shader */
    ShaderFiles files;      /* of the shaders in the renderer */
    ShaderFiles earlier;    /* of those before */
    ShaderFiles refused;    /* of the last load, if it failed */
    bool renewed;           /* the next shader_reload_poll loads */
    int watched;            /* how many of the last load's files */
    double began;           /* clock_now of the last load */
    char changed[PATH_MAX]; /* the file that caused it; empty for the first load */
    bool gone;              /* which is no longer there */
} ShaderReload;

/* Loads nothing: the first shader_reload_poll does. What is pointed to must outlive the
 * ShaderReload, which must not be moved; the request may change between calls, except in its
 * shaders. */
void shader_reload_open(ShaderReload *reload, const Example *example, const Canvas *canvas,
                        DrawRequest *request);

/* Waits at most `wait` seconds for a change (HUGE_VAL: no limit) and loads changed shaders. Those
 * of a scene are tried by drawing it at the request's time. An error holds until the next
 * RELOAD_LOADED, which comes after a correction, even back to the earlier text. Without a change
 * and a wait this costs one system call. */
ReloadResult shader_reload_poll(ShaderReload *reload, double wait, Message *error);

/* What is asked of shaders has changed: the next shader_reload_poll loads them again. */
void shader_reload_renew(ShaderReload *reload);

/* After a draw failed with `error`: a scene compiles some programs only when it first needs them,
 * perhaps long after loading. If the error is a shader's, restores the shaders before it and
 * returns true: the draw can be tried again. As after RELOAD_BROKEN, the error holds. */
bool shader_reload_revert(ShaderReload *reload, const Message *error);

/* NULL or zeroed is fine. */
void shader_reload_close(ShaderReload *reload);

#endif
