/*
 * image_plugin: the plugin that links OpenImageIO (image_oiio.cpp), as image_file.c calls
 * it.
 */
#ifndef IMAGE_PLUGIN_H
#define IMAGE_PLUGIN_H

#include "base/plugin.h"
#include "images/image_options.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The variable `image_plugin`. `encode` returns false with a reason, without a subject, if it
 * fails. Images go to the file descriptor `file`. */
typedef struct ImagePlugin {
    PluginVersion *version;
    bool (*encode)(const Image *image, const char *format, const ImageOptions *options, int file,
                   char *reason, size_t reason_size);
} ImagePlugin;

/* Defined in image_file.c. */
extern Plugin image_openimageio;

#ifdef __cplusplus
}
#endif
#endif
