/*
 * animation: several pictures in one file or stream.
 *
 * GIF, WebP, APNG, MP4 and WebM are written by an ffmpeg process that reads raw pictures from a
 * pipe, GIF by OpenImageIO where there is none; y4m and rgb, for pipes, are written here. Picture i
 * starts at i / fps:
 *
 *   gif   256 colors per picture, no alpha; to the nearest hundredth of a second
 *   webp  lossless, alpha; to the nearest millisecond
 *   apng  lossless, alpha; exact
 *   mp4   H.264, visually lossless; exact. Chroma 4:2:0, which all players support; 4:4:4, which
 *         fewer support, if width or height is odd
 *   webm  VP9, visually lossless, 4:2:0, alpha; to the nearest millisecond
 *   y4m   YUV4MPEG2, 4:4:4, BT.601 in 16..235; exact
 *   rgb   raw bytes: red, green, blue, rows from the top
 *
 * Exact: --fps becomes the nearest fraction of integers up to a million, for apng 65535: 29.97 is
 * 2997/100. Files other than mp4 and webm, which cannot say so, loop forever.
 */
#ifndef ANIMATION_H
#define ANIMATION_H

#include "images/picture_queue.h"

typedef struct AnimationOptions {
    const char *format; /* as above */
    const char *path;   /* as for output_begin; y4m and rgb go to standard output. Must outlive the
                           animation */
    int width, height;
    int frames;
    double fps;
    bool alpha;
    int compress; /* apng only, as in ImageOptions */
} AnimationOptions;

/* The animation format that `path` names, or NULL if it names single pictures. One picture in a
 * .gif or .webp is not an animation; in a .apng, .mp4 or .webm it is. */
const char *animation_format(const char *path, int frames);

/* Whether a format, or NULL, is written as it is, with nothing to encode: y4m, rgb. */
bool animation_is_raw(const char *format);

/* The names of the formats that a file may have; at most `max`. Returns their number. */
int animation_format_names(const char *names[], int max);

/* Whether the format supports these options. Opens nothing. */
bool animation_check(const AnimationOptions *options, Message *message);

typedef struct Animation Animation;

/* False, with nothing left open, if the file cannot be created or ffmpeg is missing. */
bool animation_open(Animation **animation, const AnimationOptions *options, Message *message);

/* Adds a byte picture; a PictureWrite, with an Animation as its data. False
 * without a message if the reader of standard output has closed it. */
bool animation_add(void *animation, const Picture *picture, Message *message);

/* Finishes the file if it is `whole`, that is, if no earlier call failed; otherwise leaves nothing
 * of it. Returns whether it is whole, or true if the reader of standard output has closed it,
 * having read what it wanted. NULL returns `whole`. */
bool animation_close(Animation *animation, bool whole, Message *message);

/* Runs ffmpeg and appends a line about whether that worked, which it returns. */
bool animation_probe(Message *findings);

#endif
