/*
 * live: an example whose shaders are edited while it is shown.
 *
 * When a file changes that its shaders were read from, or one comes that would have been found
 * earlier, they are loaded anew. Where that fails, the last that were good are put back as they
 * were read, whatever is on disk by then.
 */
#ifndef LIVE_H
#define LIVE_H

#include "stage.h"
#include "watch.h"

typedef enum LiveResult {
    LIVE_UNCHANGED,
    LIVE_LOADED, /* the shaders on disk are on the stage */
    LIVE_BROKEN, /* they are refused, and the error says why; the last good ones are on the stage */
    LIVE_FAILED, /* the example cannot be put on the stage, and no shader is at fault */
} LiveResult;

typedef struct Live {
    const Example *example;
    const Canvas *canvas;
    Options *options;
    Watch *watch;
    ShaderFiles files;      /* of the shaders on the stage */
    ShaderFiles earlier;    /* of those before */
    ShaderFiles refused;    /* of the last load, where it was refused */
    bool on_stage;          /* else there has been no good shader yet, and nothing can be drawn */
    int watched;            /* as many of the last load's files */
    bool said;              /* with --verbose, why the watch is slow */
    double began;           /* when the last load did, as progress_now tells it */
    char changed[PATH_MAX]; /* the file for whose sake that was; empty for the first load */
} Live;

/* Loads nothing yet: the first live_poll does. What is pointed to must outlive the Live, which must
 * not be moved; the options may change between calls, those about shaders excepted. */
bool live_open(Live *live, const Example *example, const Canvas *canvas, Options *options,
               Message *message);

/* Looks for changes, waiting for one at most so many seconds (HUGE_VAL: for ever), and loads
 * shaders that have changed. A scene's are tried by drawing the moment that the options name. An
 * error holds until the next LIVE_LOADED, which comes when it is mended, even to what was good
 * before. Without a change and a wait this costs one system call. */
LiveResult live_poll(Live *live, double wait, Message *error);

/* After a draw has failed with `error`: a scene makes some programs only at the moment that needs
 * them, which may be long after shaders were loaded. If the error is a shader's, the shaders before
 * are put back, and the draw can be tried again: true. As after LIVE_BROKEN, the error holds. */
bool live_revert(Live *live, const Message *error);

/* Takes the example off the stage. NULL or zeroed is fine. */
void live_close(Live *live);

#endif
