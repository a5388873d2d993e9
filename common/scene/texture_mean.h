/*
 * texture_mean: the mean colour of an image file. In the plugin that reads scenes, for a child
 * process.
 */
#ifndef TEXTURE_MEAN_H
#define TEXTURE_MEAN_H

#include "scene/scene_file.h"

/* Of the bytes, which are freed, of a PNG, JPEG, BMP or TGA, whose colours are encoded as sRGB: the
 * mean of its light, encoded as the scene's colours are. White, with a note that begins with the
 * texture's name and says why, where there are none (NULL, with `why`) or they cannot be read.
 *
 * A process reads so many pixels of an image, and of all, and has a second more of time for each
 * 2^23 of them (RLIMIT_CPU, up to its hard limit). */
enum { TEXTURE_PIXELS = 1 << 25, TEXTURE_ALL_PIXELS = 1 << 28 };
Vec3 texture_mean(SceneFile *file, const char *name, char *bytes, size_t size, const Message *why);

#endif
