/*
 * drawing_plugin: the plugin that links cairo (drawing_cairo.c), as drawing.c calls it.
 */
#ifndef DRAWING_PLUGIN_H
#define DRAWING_PLUGIN_H

#include "base/image.h"
#include "base/plugin.h"
#include "images/drawing_list.h"

#include <stdio.h>

/* The variable `drawing_plugin`. Functions return NULL, or why they failed. */
typedef struct DrawingPlugin {
    PluginVersion *version;
    const char *(*paint)(const Drawing *drawing, Image *image, bool transparent);
    const char *(*encode)(const Drawing *drawing, const char *format, bool transparent, FILE *to);
} DrawingPlugin;

#endif
