/*
 * run_more: what a command line can ask for besides pictures in files, and the steps that it shares
 * with drawing them.
 */
#ifndef RUN_MORE_H
#define RUN_MORE_H

#include "app/options.h"
#include "app/renderer.h"
#include "core/shader_files.h"

/* Does what the options ask for. */
bool run_more(const Example *example, Options *options, const ParameterValue *defaults,
              Message *message);

/* In run.c. Whether the first file can be written. */
bool run_check_first(const Options *options, Message *message);

/* A canvas for pictures to be written; of bytes if all are painted or go to one file. */
bool run_open_canvas(Canvas *canvas, const Example *example, const Options *options,
                     Message *message);
void run_warn(const Renderer *renderer);

/* Closes the renderer, and says whether --shaders was of any use. */
void run_close(Renderer *renderer, ShaderFiles *files, const char *name, bool done,
               const Options *options);

bool run_drawing(const Example *example, Options *options, Message *message);

#endif
