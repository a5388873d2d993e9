/*
 * viewer: --window: an example in a window, animated in real time.
 *
 * Each frame is drawn into the canvas as in a headless program and copied to the window, so a saved
 * picture equals that of the saved command.
 */
#ifndef VIEWER_H
#define VIEWER_H

#include "app/options.h"
#include "core/canvas.h"
#include "core/example.h"

/* Shows the example until the user leaves. The canvas has a window (window_of); `defaults` are
 * those of the example's parameters. False, with a message, if it cannot continue. */
bool viewer_run(const Example *example, Canvas *canvas, const Options *options,
                const ParameterValue *defaults, Message *message);

#endif
