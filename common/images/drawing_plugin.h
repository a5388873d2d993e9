/*
 * drawing_plugin: the plugin that links cairo (drawing_cairo.c), as drawing.c calls it.
 */
#ifndef DRAWING_PLUGIN_H
#define DRAWING_PLUGIN_H

#include "images/drawing.h"

#include <stdio.h>

/* Functions return NULL, or why they failed. */
typedef struct DrawingPlugin {
    const char *version;
    const char *(*paint)(const Drawing *drawing, Image *image, bool transparent);
    const char *(*encode)(const Drawing *drawing, const char *format, bool transparent, FILE *to);
} DrawingPlugin;

#define DRAWING_PLUGIN_ENTRY "drawing_plugin"
typedef const DrawingPlugin *(*DrawingPluginEntry)(void);

#endif
