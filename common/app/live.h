/*
 * live: an example whose shaders are edited while it is shown.
 *
 * Shaders are loaded again when a file they were read from changes, or when one appears that would
 * have been found earlier. If that fails, the last good ones are restored as they were read,
 * whatever is on disk by then.
 */
#ifndef LIVE_H
#define LIVE_H

#include "app/stage.h"
#include "base/clock.h"
#include "base/watch.h"

typedef enum LiveResult {
    LIVE_UNCHANGED,
    LIVE_LOADED, /* the stage has the shaders on disk */
    LIVE_BROKEN, /* the shaders on disk have an error; the stage has the last good ones, if any */
    LIVE_FAILED, /* the example cannot be drawn, and not because of a shader */
} LiveResult;

typedef struct Live {
    const Example *example;
    const Canvas *canvas;
    Options *options;
    Watch *watch;
    Stage stage;            /* closed until there is a good shader */
    ShaderFiles files;      /* of the shaders on the stage */
    ShaderFiles earlier;    /* of those before */
    ShaderFiles refused;    /* of the last load, if it failed */
    bool renewed;           /* the next live_poll loads */
    int watched;            /* how many of the last load's files */
    double began;           /* clock_now of the last load */
    char changed[PATH_MAX]; /* the file that caused it; empty for the first load */
} Live;

/* Loads nothing: the first live_poll does. What is pointed to must outlive the Live, which must not
 * be moved; the options may change between calls, except those about shaders. */
bool live_open(Live *live, const Example *example, const Canvas *canvas, Options *options,
               Message *message);

/* Waits at most `wait` seconds for a change (HUGE_VAL: no limit) and loads changed shaders. Those
 * of a scene are tried by drawing it at the options' time. An error holds until the next
 * LIVE_LOADED, which comes after a correction, even back to the earlier text. Without a change and
 * a wait this costs one system call. */
LiveResult live_poll(Live *live, double wait, Message *error);

/* The options about shaders have changed: the next live_poll loads them again. */
void live_renew(Live *live);

/* After a draw failed with `error`: a scene compiles some programs only when it first needs them,
 * perhaps long after loading. If the error is a shader's, restores the shaders before it and
 * returns true: the draw can be tried again. As after LIVE_BROKEN, the error holds. */
bool live_revert(Live *live, const Message *error);

/* NULL or zeroed is fine. */
void live_close(Live *live);

#endif
