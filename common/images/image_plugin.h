/*
 * image_plugin: the plugin that links OpenImageIO (image_oiio.cpp), as image_file.c and image_gif.c
 * call it.
 */
#ifndef IMAGE_PLUGIN_H
#define IMAGE_PLUGIN_H

#include "base/plugin.h"
#include "images/image_options.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct PluginGif PluginGif;

/* The variable `image_plugin`. Every function returns false with a reason, without a subject, if it
 * fails. Images go to the file descriptor `file`. */
typedef struct ImagePlugin {
    PluginVersion *version;
    bool (*encode)(const Image *image, const char *format, const ImageOptions *options, int file,
                   char *reason, size_t reason_size);
    /* Byte images with equal delays. After a failure gif_close is still called; NULL is fine. */
    bool (*gif_open)(PluginGif **gif, int file, const GifOptions *options, char *reason,
                     size_t reason_size);
    bool (*gif_add)(PluginGif *gif, const Image *image, char *reason, size_t reason_size);
    bool (*gif_close)(PluginGif *gif, char *reason, size_t reason_size);
} ImagePlugin;

/* Defined in image_file.c. */
extern Plugin image_openimageio;

#ifdef __cplusplus
}
#endif
#endif
