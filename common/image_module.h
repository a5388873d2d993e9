/*
 * image_module: what image.c asks of the module that links OpenImageIO (image_oiio.cpp), and how
 * the two agree on it. Only these two files include it.
 */
#ifndef IMAGE_MODULE_H
#define IMAGE_MODULE_H

#include "image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Every function returns true, or false with the reason in `reason` (without a subject). */
typedef struct ImageModule {
    const char *version;
    bool (*can_write)(const char *format);
    bool (*encode)(const Image *image, const char *format, const ImageOptions *options, int file,
                   char *reason, size_t reason_size); /* to the file descriptor `file` */
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

#ifdef __cplusplus
}
#endif
#endif
