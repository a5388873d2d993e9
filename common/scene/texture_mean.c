/* Images are decoded by stb_image, which is one header, and only for formats that scenes have. */
#include "scene/texture_mean.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_HDR
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>

/* sRGB: IEC 61966-2-1. */
static double decoded(double c)
{
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static double encoded(double c)
{
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}

static void take_time(long long pixels)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_CPU, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return;
    limit.rlim_cur += 1 + (rlim_t)(pixels >> 23);
    if (limit.rlim_cur > limit.rlim_max)
        limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_CPU, &limit);
}

static Vec3 mean_of(const unsigned char *pixels, size_t count)
{
    double values[256], sums[3] = {0};
    size_t counts[3][256] = {{0}};
    for (size_t i = 0; i < 3 * count; i++)
        counts[i % 3][pixels[i]]++;
    for (int i = 0; i < 256; i++) {
        values[i] = decoded(i / 255.0);
        for (int k = 0; k < 3; k++)
            sums[k] += values[i] * (double)counts[k][i];
    }
    return vec3_scale((Vec3){sums[0], sums[1], sums[2]}, 1 / (double)count);
}

static bool read_mean(const char *bytes, size_t size, Vec3 *mean, Message *reason)
{
    static long long all;
    const stbi_uc *file = (const stbi_uc *)bytes;
    const int length = size < 1 << 30 ? (int)size : 1 << 30;
    int width, height, channels;
    if (!stbi_info_from_memory(file, length, &width, &height, &channels))
        return message_set(reason, strcmp(stbi_failure_reason(), "too large") == 0
                                       ? "too many pixels"
                                       : "no PNG, JPEG, BMP or TGA");
    const long long pixels = (long long)width * height;
    if (pixels < 1 || pixels > TEXTURE_PIXELS || all + pixels > TEXTURE_ALL_PIXELS)
        return message_set(reason, "%d x %d pixels, too many", width, height);
    all += pixels;
    take_time(pixels);
    unsigned char *image = stbi_load_from_memory(file, length, &width, &height, &channels, 3);
    if (!image) {
        message_set(reason, "damaged: %.40s", stbi_failure_reason());
        for (char *at = reason->text; *at; at++) /* it may quote bytes of the file */
            if (*at < ' ' || *at > '~')
                *at = '?';
        return false;
    }
    *mean = mean_of(image, (size_t)width * (size_t)height);
    stbi_image_free(image);
    return true;
}

Vec3 texture_mean(SceneFile *file, const char *name, char *bytes, size_t size, const Message *why)
{
    Vec3 mean = {1, 1, 1};
    Message reason = *why;
    if (!bytes || !read_mean(bytes, size, &mean, &reason)) {
        char text[120];
        snprintf(text, sizeof text, "%.40s: white, for it cannot be read: %.45s", name,
                 reason.text);
        text[strcspn(text, "\n")] = '\0';
        scene_file_note(file, true, text);
    }
    free(bytes);
    return file->scene.linear ? mean : (Vec3){encoded(mean.x), encoded(mean.y), encoded(mean.z)};
}
