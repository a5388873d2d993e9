/*
 * Which encoder writes which format, and a whole file in memory before any of it is on disk: a full
 * disk, a crash or a wrong option then leaves the file that was there.
 */
#include "images/image_file.h"

#include "base/input.h"
#include "base/output.h"
#include "images/image_plugin.h"

#include <ctype.h>
#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

void image_file_close(ImageFile *file)
{
    if (!file)
        return;
    free(file->bytes);
    *file = (ImageFile){0};
}

bool image_file_read(ImageFile *file, const char *path, Message *message)
{
    Message why = {0};
    *file = (ImageFile){.bytes = NULL};
    file->bytes = (unsigned char *)input_whole(path, &file->size, &why);
    return file->bytes || message_set(message, "%s: cannot read: %s", path, why.text);
}

Plugin image_openimageio = {"image_oiio.so",      "image_plugin",
                            "OpenImageIO",        "picture files other than PNG",
                            "libopenimageio-dev", NULL};

bool image_probe(Message *findings)
{
    return plugin_probe(&image_openimageio, findings);
}

/* Formats. */

typedef struct Format {
    const char *name;
    bool real, alpha; /* holds floats, an alpha channel */
} Format;

/* OpenImageIO names more formats, but writes nothing for some, or to the terminal. */
static const Format FORMATS[] = {
    {"png", false, true},  {"exr", true, true},    {"tif", true, true},   {"tiff", true, true},
    {"jpg", false, false}, {"jpeg", false, false}, {"webp", false, true}, {"bmp", false, true},
    {"tga", false, true},  {"ppm", false, false},  {"hdr", true, false},  {"dpx", false, true},
    {"gif", false, false},
};

static const Format *find_format(const char *name)
{
    for (size_t i = 0; i < sizeof FORMATS / sizeof FORMATS[0]; i++)
        if (strcmp(name, FORMATS[i].name) == 0)
            return &FORMATS[i];
    return NULL;
}

bool image_format(const char *path, char format[16], Message *message)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    const bool named = dot && dot != name && dot[1];
    /* Standard output, devices and pipes have no extension. */
    struct stat status;
    const bool device =
        strcmp(path, "-") == 0 || strncmp(path, "/dev/", 5) == 0 ||
        strncmp(path, "/proc/", 6) == 0 ||
        (stat(path, &status) == 0 && (S_ISFIFO(status.st_mode) || S_ISCHR(status.st_mode)));
    if (!named && !device)
        return message_set(message, "%s: the extension names the format; give one, as in %s.png",
                           path, name);
    size_t length = 0;
    for (const char *p = named ? dot + 1 : "png"; *p && length < 15; p++)
        format[length++] = (char)tolower((unsigned char)*p);
    format[length] = '\0';
    if (find_format(format))
        return true;
    return message_set(
        message,
        "%s: unknown picture format .%s; supported are .png, .exr, .tif, .jpg, .webp "
        "and .gif",
        path, format);
}

int image_format_names(const char *names[], int max)
{
    int count = 0;
    for (; count < max && count < (int)(sizeof FORMATS / sizeof FORMATS[0]); count++)
        names[count] = FORMATS[count].name;
    return count;
}

bool image_format_is_float(const char *format)
{
    const Format *found = find_format(format);
    return found && found->real;
}

bool image_format_has_alpha(const char *format)
{
    const Format *found = find_format(format);
    return found && found->alpha;
}

/* ulimit -f also limits files in memory, which not every encoder can handle: the limit is lifted,
 * as far as it may be, while one runs, and applies when the file itself is written. */
static struct rlimit lift_file_limit(void)
{
    struct rlimit limit = {RLIM_INFINITY, RLIM_INFINITY};
    if (getrlimit(RLIMIT_FSIZE, &limit) == 0) {
        const struct rlimit lifted = {limit.rlim_max, limit.rlim_max};
        setrlimit(RLIMIT_FSIZE, &lifted);
    }
    return limit;
}

/* Encodes into a memory file, because OpenImageIO writes some formats to files only, and a full
 * disk must not end a file halfway. */
static bool plugin_encode(const Image *image, const char *format, const ImageOptions *options,
                          ImageFile *file, Message *message)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* the limit is the whole process's */
    const ImagePlugin *plugin = plugin_open(&image_openimageio, message);
    char reason[1024] = "", path[32];
    if (!plugin)
        return false;
    const int memory = memfd_create("picture", MFD_CLOEXEC);
    if (memory < 0)
        return message_set(message, "%s: %s", format, strerror(errno));
    pthread_mutex_lock(&lock);
    const struct rlimit limit = lift_file_limit();
    const bool encoded = plugin->encode(image, format, options, memory, reason, sizeof reason);
    setrlimit(RLIMIT_FSIZE, &limit);
    pthread_mutex_unlock(&lock);
    snprintf(path, sizeof path, "/proc/self/fd/%d", memory);
    /* A file as long as the limit was cut there, which OpenImageIO may not notice. */
    const char *why = !encoded                             ? reason
                      : !image_file_read(file, path, NULL) ? "not enough memory for the file"
                      : file->size >= limit.rlim_max       ? strerror(EFBIG)
                      : !file->size                        ? "nothing was written"
                                                           : NULL;
    close(memory);
    /* DPX stores the path that the library was given. (SMPTE 268M: 100 bytes from 36 on) */
    if (!why && strcmp(format, "dpx") == 0 && file->size > 136)
        memset(file->bytes + 36, 0, 100);
    return !why || message_set(message, "cannot write %s: %s", format, why);
}

bool image_encode(const Image *image, const char *format, const ImageOptions *options,
                  ImageFile *file, Message *message)
{
    *file = (ImageFile){0};
    const bool done = strcmp(format, "png") == 0
                          ? image_png_encode(image, options, file, message)
                          : plugin_encode(image, format, options, file, message);
    if (!done)
        image_file_close(file);
    return done;
}

bool image_write(const Image *image, const char *path, const ImageOptions *options,
                 Message *message)
{
    char format[16];
    ImageFile file;
    if (!image_format(path, format, message) ||
        !image_encode(image, format, options, &file, message))
        return false;
    const bool written = output_write(path, file.bytes, file.size, message);
    image_file_close(&file);
    return written;
}
