/*
 * animation: many pictures in one file or stream.
 *
 * GIF is written through OpenImageIO; WebP, APNG, MP4 and WebM by a process of ffmpeg that is fed
 * raw pictures; y4m and rgb, for pipes, are made here. Picture i is shown from i / fps seconds on:
 *
 *   gif   256 colours a picture, no alpha; to the nearest hundredth of a second
 *   webp  every bit, alpha; to the nearest millisecond
 *   apng  every bit, alpha; exact
 *   mp4   H.264, near the picture; exact. Colours at half the resolution (4:2:0), as all players
 *         want it; where width or height are odd, at the full one (4:4:4), which fewer can show
 *   webm  VP9, near the picture, 4:2:0, alpha; to the nearest millisecond
 *   y4m   YUV4MPEG2: 4:4:4, BT.601 in 16..235; exact
 *   rgb   nothing but bytes: red, green, blue, row after row from the top
 *
 * Exact is --fps as the nearest fraction of whole numbers up to a million, for apng 65535: 29.97 is
 * 2997/100. The files but mp4 and webm, which have no such thing, repeat without end.
 */
#ifndef ANIMATION_H
#define ANIMATION_H

#include "picture.h"

typedef struct AnimationOptions {
    const char *format; /* as above */
    const char *path;   /* where it goes, as output.h has it; not used by y4m and rgb, which go to
                           standard output. Must last */
    int width, height;
    int frames;
    double fps;
    bool alpha;
    int compress; /* of apng, as for PNG; IMAGE_COMPRESS_DEFAULT */
} AnimationOptions;

/* The format that `path` names for so many pictures; NULL: none, but single pictures. One picture
 * in a .gif or .webp is no animation; in a .apng, .mp4 or .webm it is. */
const char *animation_format(const char *path, int frames);

/* Whether such an animation can be, as far as that is known before anything is opened. */
bool animation_check(const AnimationOptions *options, Message *message);

typedef struct Animation Animation;

/* Starts one. False, with nothing opened, where its file cannot be made or ffmpeg is missing. */
bool animation_open(Animation **animation, const AnimationOptions *options, Message *message);

/* Adds a byte picture; `animation` is an Animation, and this a PictureSink's `write`, for one
 * thread. False without a message where whoever read standard output has gone. */
bool animation_add(void *animation, const Picture *picture, Message *message);

/* Ends it. The file appears where it is `whole`, which is to say, no earlier call has failed; else
 * nothing is left of it. True where it is whole, and where whoever read standard output has gone:
 * it has what it wanted. NULL is fine, and returns `whole`. */
bool animation_close(Animation *animation, bool whole, Message *message);

/* For --doctor: says on standard output whether ffmpeg is there. */
void animation_doctor(void);

#endif
