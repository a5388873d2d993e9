/*
 * plugin: a shared library of this project, loaded on first use, because what it links is large,
 * slow to load or may be missing.
 */
#ifndef PLUGIN_H
#define PLUGIN_H

#include "base/message.h"

/* What a plugin that links a library exports: a variable of a struct type, whose first member this
 * is. */
typedef const char *PluginVersion(void); /* of the library: "1.16.0" */

typedef struct Plugin {
    const char *file;    /* "image_oiio.so" */
    const char *symbol;  /* the variable's name */
    const char *library; /* what the plugin links, for messages: "OpenImageIO" */
    const char *purpose; /* in findings: "model files" */
    const char *package; /* to install if it is missing */
    const void *loaded;  /* the variable; plugin_open sets it */
} Plugin;

/* Of modules that a program may lack, and --doctor reports all the same. */
#define PLUGIN_MODELS                                                                              \
    "model_assimp.so", "model_module", "Assimp", "model files", "libassimp-dev", NULL
#define PLUGIN_DRAWINGS                                                                            \
    "drawing_cairo.so", "drawing_plugin", "cairo", "diagrams", "libcairo2-dev", NULL

/* Loads the plugin at the first call, from any thread, and returns its variable; NULL on failure,
 * with a message that names the package. */
const void *plugin_open(Plugin *plugin, Message *message);

/* The same of a plugin that links a library, and appends package_tell's line; true if the plugin
 * was found. */
bool plugin_probe(Plugin *plugin, Message *findings);

/* Appends the line of a package to --doctor's findings: whether it is there, its version up to the
 * first blank (NULL: unknown), and what it gives. `missing` says why it is not there; NULL: it is.
 * True if it is. */
bool package_tell(Message *findings, const char *name, const char *version, const char *gives,
                  const char *missing);

#endif
