/*
 * Three ways to write pictures one after the other: GIF (image_gif.c); an ffmpeg process, which is
 * sent raw pictures through a pipe and writes to a file that is already open, so that it is renamed
 * into place only when it is whole, as every output; and two raw streams for pipes, y4m and rgb,
 * written here. One table says for each format what it can hold, and the words for ffmpeg.
 *
 * Formats count time in different units. A rate F is sent as a fraction of integers, the nearest
 * whose terms a format can hold, found by the continued fraction of F: its convergents are the best
 * fractions of their size (Hardy and Wright, An introduction to the theory of numbers, chapter 10).
 */
#include "images/animation.h"

#include "base/memory.h"
#include "base/output.h"
#include "base/plugin.h"
#include "base/process.h"
#include "images/image_options.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* ITU-R BT.709 in 16..235, which players assume, with the sRGB transfer function; the file names
 * all of these. */
#define BT709                                                                                      \
    "-vf scale=out_color_matrix=bt709:out_range=tv:flags=bicubic+accurate_rnd+full_chroma_int "    \
    "-colorspace bt709 -color_primaries bt709 -color_trc iec61966-2-1 -color_range tv"

/* Both codecs compress differently with another number of threads, whose default is the machine's
 * number of processors. */
#define THREADS "-threads 4"

/* ffmpeg's limit for the numbers of a rate is 1001000. */
enum { MAX_RATE = 1000000 };

typedef enum Writer { WRITER_FFMPEG, WRITER_GIF, WRITER_Y4M, WRITER_RGB } Writer;

typedef struct Format {
    const char *name;
    Writer writer;
    bool single;             /* a file of one picture is an animation too */
    double slowest, fastest; /* pictures per second; 0: the limit of --fps */
    const char *limit;       /* the reason, for a message */
    int max;                 /* of the rate's numerator and denominator; 0: MAX_RATE */
    int max_side;            /* pixels; 0: no limit */
    /* For ffmpeg. Lossless codecs: as small as possible in no more time than a GIF takes; others:
     * the quality at which no difference is visible. */
    const char *codec;
    const char *pixels;       /* its pixel format */
    const char *odd_pixels;   /* if width or height is odd; NULL: as `pixels` */
    const char *alpha_pixels; /* with alpha; NULL: the format has none */
} Format;

static const Format FORMATS[] = {
    {.name = "gif",
     .writer = WRITER_GIF,
     .slowest = IMAGE_GIF_SLOWEST,
     .fastest = IMAGE_GIF_FASTEST,
     .limit = "its times are hundredths of a second, up to 655.35 per picture"},
    {.name = "webp",
     .fastest = 1000,
     .limit = "its times are milliseconds",
     .max_side = 16383,
     .codec = "-c:v libwebp_anim -lossless 1 -compression_level 0 -quality 20 "
              "-enc_time_base 1/1000 -loop 0",
     .pixels = "bgra",
     .alpha_pixels = "bgra"},
    {.name = "apng",
     .single = true,
     .fastest = 65535,
     .limit = "its times are fractions of 16 bits",
     .max = 65535,
     .codec = "-c:v apng -pred avg -compression_level 6 -plays 0",
     .pixels = "rgb24",
     .alpha_pixels = "rgba"},
    {.name = "mp4",
     .single = true,
     .codec = "-c:v libx264 " THREADS " -crf 17 -movflags +faststart " BT709,
     .pixels = "yuv420p",
     .odd_pixels = "yuv444p"},
    {.name = "webm",
     .single = true,
     .fastest = 1000,
     .limit = "its times are milliseconds",
     .codec =
         "-c:v libvpx-vp9 " THREADS " -deadline good -cpu-used 4 -row-mt 1 -crf 20 -b:v 0 " BT709,
     .pixels = "yuv420p",
     .alpha_pixels = "yuva420p"},
    {.name = "y4m", .writer = WRITER_Y4M, .single = true},
    {.name = "rgb", .writer = WRITER_RGB, .single = true},
};

static const Format *find_format(const char *name)
{
    for (size_t i = 0; i < sizeof FORMATS / sizeof FORMATS[0]; i++)
        if (strcasecmp(name, FORMATS[i].name) == 0)
            return &FORMATS[i];
    return NULL;
}

static bool in_file(const Format *format)
{
    return format->writer != WRITER_Y4M && format->writer != WRITER_RGB;
}

bool animation_is_raw(const char *format)
{
    const Format *found = format ? find_format(format) : NULL;
    return found && !in_file(found);
}

int animation_format_names(const char *names[], int max)
{
    int count = 0;
    for (size_t i = 0; count < max && i < sizeof FORMATS / sizeof FORMATS[0]; i++)
        if (in_file(&FORMATS[i]))
            names[count++] = FORMATS[i].name;
    return count;
}

const char *animation_format(const char *path, int frames)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    const Format *format = dot && dot > name ? find_format(dot + 1) : NULL;
    return format && in_file(format) && (frames > 1 || format->single) ? format->name : NULL;
}

/* The size limit of ffmpeg. (av_image_check_size2 in libavutil, which assumes 8 bytes a pixel) */
static bool fits_ffmpeg(int width, int height)
{
    return (8 * (int64_t)width + 8 * 128) * ((int64_t)height + 128) < INT_MAX;
}

bool animation_check(const AnimationOptions *options, Message *message)
{
    const Format *format = find_format(options->format);
    if (options->alpha && !format->alpha_pixels)
        return message_set(message, "alpha: %s has no alpha channel; .webp, .apng and .webm have",
                           format->name);
    if (options->fps < format->slowest || (format->fastest > 0 && options->fps > format->fastest))
        return message_set(message, "%.15g pictures per second: %s has %.4g to %.15g, because %s",
                           options->fps, format->name, fmax(format->slowest, 1e-3), format->fastest,
                           format->limit);
    const int max = format->max_side;
    if (max > 0 && (options->width > max || options->height > max))
        return message_set(message, "size %dx%d: %s has at most %d pixels a side", options->width,
                           options->height, format->name, max);
    if (format->writer == WRITER_FFMPEG && !fits_ffmpeg(options->width, options->height))
        return message_set(message,
                           "size %dx%d: too large for ffmpeg, which writes .%s; write numbered "
                           "files instead, as in picture%%03d.png",
                           options->width, options->height, format->name);
    return true;
}

/* Pictures per second. */
typedef struct Rate {
    long numerator, denominator;
} Rate;

/* The first convergent of the continued fraction that equals `value`, or the last up to `max`. */
static Rate nearest_rate(double value, long max)
{
    Rate before = {0, 1}, rate = {1, 0};
    double rest = value;
    for (;;) {
        const double whole = floor(rest);
        const double numerator = whole * (double)rate.numerator + (double)before.numerator;
        const double denominator = whole * (double)rate.denominator + (double)before.denominator;
        if (numerator > (double)max || denominator > (double)max)
            break;
        before = rate;
        rate = (Rate){(long)numerator, (long)denominator};
        if (rest == whole || numerator / denominator == value)
            break;
        rest = 1 / (rest - whole);
    }
    return rate;
}

/* An ffmpeg process, which writes to its file descriptor 3. */
typedef struct Encoder {
    pid_t process; /* 0: none */
    int pictures;  /* a pipe to it; -1: closed */
    int said;      /* its standard error, a memory file */
} Encoder;

struct Animation {
    AnimationOptions options;
    const Format *format;
    Rate rate;
    Output *output; /* NULL: standard output */
    Encoder encoder;
    ImageGif *gif;
    unsigned char *stream; /* one picture in the layout of y4m or rgb */
    int added;
    bool reader_gone;
};

/* y4m and rgb. */

/* ITU-R BT.601-7, section 2.5: Y = 16 + 219 E'Y, Cb = 128 + 224 (E'B - E'Y) / 1.772 and Cr = 128 +
 * 224 (E'R - E'Y) / 1.402 with E'Y = 0.299 E'R + 0.587 E'G + 0.114 E'B, rounded to nearest. With
 * E' = c / 255 these are fractions of integers, computed here without error. */
static void write_y4m(const Image *image, unsigned char *stream)
{
    enum { Y_UNIT = 1000 * 255, CB_UNIT = 886 * 255, CR_UNIT = 701 * 255 };
    const size_t count = (size_t)image->width * (size_t)image->height;
    const unsigned char *pixel = image->pixels;
    unsigned char *luma = stream, *blue = luma + count, *red = blue + count;
    for (size_t i = 0; i < count; i++, pixel += 4) {
        const int r = pixel[0], g = pixel[1], b = pixel[2];
        luma[i] = (unsigned char)((219 * (299 * r + 587 * g + 114 * b) + 16 * Y_UNIT + Y_UNIT / 2) /
                                  Y_UNIT);
        blue[i] =
            (unsigned char)((112 * (886 * b - 299 * r - 587 * g) + 128 * CB_UNIT + CB_UNIT / 2) /
                            CB_UNIT);
        red[i] =
            (unsigned char)((112 * (701 * r - 587 * g - 114 * b) + 128 * CR_UNIT + CR_UNIT / 2) /
                            CR_UNIT);
    }
}

static void write_rgb(const Image *image, unsigned char *stream)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    const unsigned char *pixel = image->pixels;
    for (size_t i = 0; i < count; i++, pixel += 4, stream += 3)
        memcpy(stream, pixel, 3);
}

static bool send(Animation *animation, const void *bytes, size_t size, Message *message)
{
    if (output_append(STDOUT_FILENO, bytes, size))
        return true;
    animation->reader_gone = errno == EPIPE;
    return animation->reader_gone ? false : output_failed("standard output", errno, message);
}

static bool stream_add(Animation *animation, const Image *image, Message *message)
{
    const bool y4m = animation->format->writer == WRITER_Y4M;
    const size_t size = 3 * (size_t)image->width * (size_t)image->height;
    char header[128] = "";
    int length = 0;
    (y4m ? write_y4m : write_rgb)(image, animation->stream);
    /* Progressive, square pixels. (yuv4mpeg(5), of mjpegtools) */
    if (y4m)
        length = snprintf(header, sizeof header,
                          animation->added ? "FRAME\n"
                                           : "YUV4MPEG2 W%d H%d F%ld:%ld Ip A1:1 C444 "
                                             "XCOLORRANGE=LIMITED\nFRAME\n",
                          image->width, image->height, animation->rate.numerator,
                          animation->rate.denominator);
    return send(animation, header, (size_t)length, message) &&
           send(animation, animation->stream, size, message);
}

/* ffmpeg. */

/* The command. -xerror because otherwise ffmpeg ignores a full disk; bitexact for the same bytes
 * every time. */
static bool encoder_words(const Animation *animation, char *text, size_t size, const char *words[],
                          int max)
{
    const AnimationOptions *options = &animation->options;
    const Format *format = animation->format;
    const bool odd = options->width % 2 || options->height % 2;
    const char *pixels = options->alpha              ? format->alpha_pixels
                         : odd && format->odd_pixels ? format->odd_pixels
                                                     : format->pixels;
    char level[64] = "";
    if (options->compress >= 0 && strcmp(format->name, "apng") == 0)
        snprintf(level, sizeof level, "-compression_level %d", options->compress);
    const int length =
        snprintf(text, size,
                 "ffmpeg -nostdin -hide_banner -loglevel error -xerror -y -f rawvideo "
                 "-pix_fmt %s -s %dx%d -r %ld/%ld -i pipe:0 -fflags +bitexact -flags:v +bitexact "
                 "%s %s -pix_fmt %s -f %s /proc/self/fd/3",
                 options->alpha ? "rgba" : "rgb0", options->width, options->height,
                 animation->rate.numerator, animation->rate.denominator, format->codec, level,
                 pixels, format->name);
    int count = 0;
    for (char *rest, *word = strtok_r(text, " ", &rest); word && count < max - 1;
         word = strtok_r(NULL, " ", &rest))
        words[count++] = word;
    words[count] = NULL;
    return length < (int)size && count < max - 1;
}

/* A full disk has one message, however ffmpeg words it. */
static bool encoder_failed(const Animation *animation, const char *reason, Message *message)
{
    static const int full[] = {ENOSPC, EDQUOT, EFBIG};
    for (size_t i = 0; i < sizeof full / sizeof full[0]; i++)
        if (strstr(reason, strerror(full[i])))
            return output_failed(animation->options.path, full[i], message);
    return message_set(message, "%s: cannot write: %s", animation->options.path, reason);
}

static bool encoder_open(Animation *animation, Message *message)
{
    Encoder *encoder = &animation->encoder;
    char text[1024];
    const char *words[64];
    int ends[2] = {-1, -1};
    if (!encoder_words(animation, text, sizeof text, words, sizeof words / sizeof words[0]))
        return encoder_failed(animation, "the command for ffmpeg is too long", message);
    encoder->said = memfd_create("ffmpeg", MFD_CLOEXEC);
    if (encoder->said < 0 || pipe2(ends, O_CLOEXEC) != 0)
        return encoder_failed(animation, strerror(errno), message);
    const int error =
        process_start(&encoder->process, words,
                      (int[]){ends[0], -1, encoder->said, output_file(animation->output)});
    close(ends[0]);
    encoder->pictures = ends[1];
    if (!error)
        return true;
    encoder->process = 0;
    return message_set(message, "%s: ffmpeg, which writes .%s, %s%s", animation->options.path,
                       animation->format->name,
                       error == ENOENT ? "is missing; install the package ffmpeg"
                                       : "cannot be started: ",
                       error == ENOENT ? "" : strerror(error));
}

/* Waits for ffmpeg to end. At its log level all output is an error, whatever its exit status. */
static bool encoder_wait(Animation *animation, Message *message)
{
    Encoder *encoder = &animation->encoder;
    char said[1024], reason[1100];
    if (encoder->pictures >= 0)
        close(encoder->pictures);
    encoder->pictures = -1;
    const int status = process_wait(encoder->process);
    encoder->process = 0;
    const bool speaks = process_last_line(encoder->said, said, sizeof said);
    if (status == 0 && !speaks)
        return true;
    if (speaks)
        snprintf(reason, sizeof reason, "ffmpeg: %s", said);
    else if (WIFSIGNALED(status))
        snprintf(reason, sizeof reason, "ffmpeg was ended by a signal: %s",
                 WTERMSIG(status) == SIGXFSZ ? strerror(EFBIG) : strsignal(WTERMSIG(status)));
    else
        snprintf(reason, sizeof reason, "ffmpeg ended with status %d, and gave no reason",
                 WEXITSTATUS(status));
    return encoder_failed(animation, reason, message);
}

static bool encoder_add(Animation *animation, const Image *image, Message *message)
{
    if (output_append(animation->encoder.pictures, image->pixels,
                      (size_t)image->height * image_row_size(image)))
        return true;
    const int error = errno;
    if (error != EPIPE)
        return encoder_failed(animation, strerror(error), message);
    return encoder_wait(animation, message)
               ? encoder_failed(animation, "ffmpeg ended before the last picture", message)
               : false;
}

static bool encoder_close(Animation *animation, bool whole, Message *message)
{
    Encoder *encoder = &animation->encoder;
    struct stat status;
    if (encoder->process && !whole)
        kill(encoder->process, SIGKILL);
    if (encoder->process)
        whole = encoder_wait(animation, whole ? message : NULL) && whole;
    if (whole && (fstat(output_file(animation->output), &status) != 0 || status.st_size == 0))
        whole = encoder_failed(animation, "ffmpeg wrote nothing", message);
    if (encoder->pictures >= 0)
        close(encoder->pictures);
    if (encoder->said >= 0)
        close(encoder->said);
    return whole;
}

/* All formats. */

static bool open_writer(Animation *animation, Message *message)
{
    const AnimationOptions *options = &animation->options;
    Message why = {0};
    switch (animation->format->writer) {
    case WRITER_FFMPEG:
        return encoder_open(animation, message);
    case WRITER_GIF:
        return image_gif_open(&animation->gif, fdopen(dup(output_file(animation->output)), "wb"),
                              options->width, options->height, options->fps, &why) ||
               encoder_failed(animation, why.text, message);
    default:
        animation->stream = malloc(3 * (size_t)options->width * (size_t)options->height);
        return animation->stream || message_set(message, "animation: not enough memory");
    }
}

bool animation_open(Animation **opened, const AnimationOptions *options, Message *message)
{
    Animation *animation = *opened = memory_new(1, sizeof *animation);
    const Format *format = find_format(options->format);
    animation->options = *options;
    animation->format = format;
    animation->rate = nearest_rate(options->fps, format->max ? format->max : MAX_RATE);
    animation->encoder = (Encoder){.pictures = -1, .said = -1};
    bool done = true;
    if (format->writer == WRITER_FFMPEG || format->writer == WRITER_GIF)
        done = (animation->output = output_begin(options->path, message)) != NULL;
    if (done && open_writer(animation, message))
        return true;
    animation_close(animation, false, message);
    *opened = NULL;
    return false;
}

bool animation_add(void *data, const Picture *picture, Message *message)
{
    Animation *animation = data;
    const Image *image = &picture->image;
    Message why = {0};
    bool done;
    if (image->type != IMAGE_BYTE || image->width != animation->options.width ||
        image->height != animation->options.height)
        return message_set(message, "animation: all pictures must have %dx%d byte pixels",
                           animation->options.width, animation->options.height);
    switch (animation->format->writer) {
    case WRITER_FFMPEG:
        done = encoder_add(animation, image, message);
        break;
    case WRITER_GIF:
        done = image_gif_add(animation->gif, image, &why) ||
               encoder_failed(animation, why.text, message);
        break;
    default:
        done = stream_add(animation, image, message);
    }
    animation->added++;
    return done;
}

bool animation_close(Animation *animation, bool whole, Message *message)
{
    Message why = {0};
    if (!animation)
        return whole;
    if (animation->format->writer == WRITER_FFMPEG)
        whole = encoder_close(animation, whole, message);
    if (!image_gif_close(animation->gif, &why) && whole)
        whole = encoder_failed(animation, why.text, message);
    if (animation->output && whole)
        whole = output_commit(animation->output, message);
    else
        output_abort(animation->output);
    whole = whole || animation->reader_gone;
    free(animation->stream);
    free(animation);
    return whole;
}

bool animation_probe(Message *findings)
{
    static const char *const words[] = {"ffmpeg", "-version", NULL};
    pid_t process;
    const bool found =
        process_start(&process, words, (int[]){-1, -1, -1, -1}) == 0 && process_wait(process) == 0;
    return package_tell(findings, "ffmpeg", NULL, "animations: .webp, .apng, .mp4 and .webm",
                        found ? NULL : "install the package ffmpeg");
}
