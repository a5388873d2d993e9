/*
 * plugin: a shared library of this project, loaded on first use, because what it links is large,
 * slow to load or may be missing.
 */
#ifndef PLUGIN_H
#define PLUGIN_H

#include "base/message.h"

typedef struct PluginName {
    const char *file;    /* "image_oiio.so" */
    const char *entry;   /* the exported function */
    const char *library; /* what the plugin links, for messages: "OpenImageIO" */
    const char *package; /* to install if that is missing */
} PluginName;

/* Loads the plugin and returns the address of its entry; NULL on failure, with a message that names
 * the package. */
void *plugin_entry(const PluginName *name, Message *message);

#endif
