/*
 * probing: --probe and --show: what the shaders of a program's picture compute.
 */
#ifndef PROBING_H
#define PROBING_H

#include "app/options.h"
#include "app/renderer.h"
#include "probe/probe_plugin.h"

/* A program whose picture is drawn and captured, and the device that is imitated. */
typedef struct Probing {
    GlslArithmetic driver;
    Renderer renderer;
    Capture capture;
    DrawRequest request;
} Probing;

/* Draws in the canvas, which has the options' size. To be closed whatever it returns, before the
 * canvas. */
bool probing_open(Probing *probing, const Example *example, const Options *options,
                  const Canvas *canvas, Message *message);
void probing_close(Probing *probing); /* a zeroed one is fine */

const ProbePlugin *probing_plugin(Message *message); /* NULL: it cannot be loaded */

/* What the plugin tells of a pixel, column and row, for free(); NULL: nothing, and why. */
char *probing_pixel(Probing *probing, const ProbePlugin *plugin, const int pixel[2], bool json,
                    Message *message);

/* --probe: on standard output. */
bool probing_tell(const Example *example, const Options *options, Message *message);

/* --show: writes the picture, and what its colours mean to standard error. A name that no shader
 * has sets options->show_unknown. */
bool probing_show(const Example *example, Options *options, Message *message);

#endif
