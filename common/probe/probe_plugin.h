/*
 * probe_plugin: the plugin that runs shaders (probe_plugin.c), as app calls it; so programs compile
 * and link no evaluator.
 */
#ifndef PROBE_PLUGIN_H
#define PROBE_PLUGIN_H

#include "base/image.h"
#include "base/plugin.h"
#include "probe/probe.h"

#include <stdio.h>

typedef enum ShowResult { SHOW_DONE, SHOW_UNKNOWN, SHOW_FAILED } ShowResult; /* see Show.unknown */

/* The variable `probe_plugin`. */
typedef struct ProbePlugin {
    /* What probe_text or probe_json write; NULL: a shader cannot be run, and why. */
    char *(*tell)(const ProbeQuestion *question, bool json, Message *message);
    /* What show_open computes, as show_paint paints it. */
    ShowResult (*show)(const Capture *capture, const GlslArithmetic *driver, const char *what,
                       Image *picture, FILE *legend, Message *message);
    /* What show_names writes. */
    bool (*names)(const Capture *capture, const GlslArithmetic *driver, int stage, FILE *file,
                  Message *message);
    bool (*exact)(const ProbeQuestion *question, double color[4], int *draw); /* probe_exact */
} ProbePlugin;

#endif
