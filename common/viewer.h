/*
 * viewer: an example in a window, in which time runs: what --window does.
 *
 * Each frame is drawn into the canvas as a headless program draws it, and copied to the window: a
 * picture that is saved is the one that the saved command draws without a window.
 */
#ifndef VIEWER_H
#define VIEWER_H

#include "canvas.h"
#include "example.h"
#include "options.h"

/* Puts the example on the stage, shows it until somebody leaves, and takes it off. The canvas is in
 * a window (window_of); `defaults` are those of the example's parameters. False, with its message,
 * where it cannot go on. */
bool viewer_run(const Example *example, Canvas *canvas, const Options *options,
                const ParameterValue *defaults, Message *message);

#endif
