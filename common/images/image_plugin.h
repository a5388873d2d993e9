/*
 * image_plugin: the plugin that links OpenImageIO (image_oiio.cpp), as image_file.c and image_gif.c
 * call it.
 */
#ifndef IMAGE_PLUGIN_H
#define IMAGE_PLUGIN_H

#include "images/image_file.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct PluginGif PluginGif;

/* Every function returns false with a reason, without a subject, if it fails. Images go to the file
 * descriptor `file`. */
typedef struct ImagePlugin {
    const char *version;
    bool (*encode)(const Image *image, const char *format, const ImageOptions *options, int file,
                   char *reason, size_t reason_size);
    /* A GIF of `count` byte images with equal delays. After a failure gif_close is still called;
     * NULL is fine. */
    bool (*gif_open)(PluginGif **gif, int file, int width, int height, int count, char *reason,
                     size_t reason_size);
    bool (*gif_add)(PluginGif *gif, const Image *image, char *reason, size_t reason_size);
    bool (*gif_close)(PluginGif *gif, char *reason, size_t reason_size);
} ImagePlugin;

#define IMAGE_PLUGIN_ENTRY "image_plugin"
typedef const ImagePlugin *(*ImagePluginEntry)(void);

/* Loads the plugin at the first call; from any thread. */
bool image_plugin_open(const ImagePlugin **plugin, Message *message);

#ifdef __cplusplus
}
#endif
#endif
