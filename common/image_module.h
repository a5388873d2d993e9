/*
 * image_module: what image.c and image_gif.c ask of the module that links OpenImageIO
 * (image_oiio.cpp), and how they agree on it. Only these files include it.
 */
#ifndef IMAGE_MODULE_H
#define IMAGE_MODULE_H

#include "image.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ModuleGif ModuleGif;

/* Every function returns true, or false with the reason in `reason` (without a subject). */
typedef struct ImageModule {
    const char *version;
    bool (*can_write)(const char *format);
    bool (*encode)(const Image *image, const char *format, const ImageOptions *options, int file,
                   char *reason, size_t reason_size); /* to the file descriptor `file` */
    /* A GIF of several byte pictures, which all stand equally long, to the file descriptor `file`.
     * After a failure too, gif_close is called, and NULL is fine. */
    bool (*gif_open)(ModuleGif **gif, int file, int width, int height, int count, char *reason,
                     size_t reason_size);
    bool (*gif_add)(ModuleGif *gif, const Image *image, char *reason, size_t reason_size);
    bool (*gif_close)(ModuleGif *gif, char *reason, size_t reason_size);
    bool (*read)(const char *path, Image *image, char *reason, size_t reason_size);
    bool (*compare)(const Image *a, const Image *b, ImageDifference *difference, char *reason,
                    size_t reason_size);
    bool (*difference)(const Image *a, const Image *b, double gain, Image *difference, char *reason,
                       size_t reason_size);
    bool (*label)(Image *image, int x, int y, int size, const char *text, char *reason,
                  size_t reason_size);
} ImageModule;

#define IMAGE_MODULE_SYMBOL "image_module"
typedef const ImageModule *(*ImageModuleEntry)(void);

/* Of image.c: loads the module at the first call. */
bool image_module_open(const ImageModule **module, Message *message);

#ifdef __cplusplus
}
#endif
#endif
