#include "image.h"

#include "image_module.h"
#include "module.h"
#include "output.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <png.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

static size_t value_size(ImageType type)
{
    return type == IMAGE_FLOAT ? sizeof(float) : 1;
}

size_t image_row_size(const Image *image)
{
    return 4 * (size_t)image->width * value_size(image->type);
}

bool image_open(Image *image, int width, int height, ImageType type, Message *message)
{
    *image = (Image){.width = width, .height = height, .type = type};
    if (width < 1 || height < 1)
        return message_set(message, "image: size %dx%d: must be at least 1x1", width, height);
    image->pixels = calloc((size_t)height, image_row_size(image));
    if (!image->pixels)
        return message_set(message, "image: not enough memory for %dx%d pixels", width, height);
    return true;
}

void image_close(Image *image)
{
    if (!image)
        return;
    free(image->pixels);
    *image = (Image){0};
}

void image_file_close(ImageFile *file)
{
    if (!file)
        return;
    free(file->bytes);
    *file = (ImageFile){0};
}

static bool image_file_append(ImageFile *file, const void *bytes, size_t size)
{
    if (file->size + size > file->capacity) {
        size_t capacity = file->capacity ? file->capacity : 64 * 1024;
        while (capacity < file->size + size)
            capacity *= 2;
        unsigned char *larger = realloc(file->bytes, capacity);
        if (!larger)
            return false;
        file->bytes = larger;
        file->capacity = capacity;
    }
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
    return true;
}

/* The module. */

/* Pictures are written by several threads: the module is loaded by one of them, and the limit that
 * module_encode lifts is the process's. */
static pthread_mutex_t module_lock = PTHREAD_MUTEX_INITIALIZER;

static bool module_find(const ImageModule **module, Message *message)
{
    static const ModuleName name = {"image_oiio.so", IMAGE_MODULE_SYMBOL, "OpenImageIO",
                                    "libopenimageio-dev"};
    static const ImageModule *loaded; /* the library cannot be unloaded: load it once */
    if (!loaded) {
        const ImageModuleEntry entry = (ImageModuleEntry)module_entry(&name, message);
        if (!entry)
            return false;
        loaded = entry();
    }
    *module = loaded;
    return true;
}

bool image_module_open(const ImageModule **module, Message *message)
{
    pthread_mutex_lock(&module_lock);
    const bool found = module_find(module, message);
    pthread_mutex_unlock(&module_lock);
    return found;
}

bool image_doctor(void)
{
    Message message = {0};
    const ImageModule *module;
    printf("  PNG        libpng %s: found\n", png_get_libpng_ver(NULL));
    if (!image_module_open(&module, &message)) {
        printf("  OpenImageIO (all other formats) missing: %s\n", message.text);
        return false;
    }
    printf("  OpenImageIO (all other formats) %s: found\n", module->version);
    return true;
}

/* Formats. */

static bool is_one_of(const char *format, const char *const *list)
{
    for (; *list; list++)
        if (strcmp(format, *list) == 0)
            return true;
    return false;
}

/* What is written through OpenImageIO: it names more formats, but some write nothing, or to the
 * terminal. */
static const char *const MODULE_FORMATS[] = {"exr", "tif", "tiff", "jpg", "jpeg", "webp", "bmp",
                                             "tga", "ppm", "hdr",  "dpx", "gif",  NULL};

bool image_format(const char *path, char format[16], Message *message)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    const bool named = dot && dot != name && dot[1];
    /* Standard output and devices have no extension. */
    const bool device =
        strcmp(path, "-") == 0 || strncmp(path, "/dev/", 5) == 0 || strncmp(path, "/proc/", 6) == 0;
    if (!named && !device)
        return message_set(message, "%s: the extension names the format; give one, as in %s.png",
                           path, name);
    size_t length = 0;
    for (const char *p = named ? dot + 1 : "png"; *p && length < 15; p++)
        format[length++] = (char)tolower((unsigned char)*p);
    format[length] = '\0';
    if (strcmp(format, "png") == 0)
        return true;
    if (is_one_of(format, MODULE_FORMATS))
        return true;
    return message_set(
        message,
        "%s: no picture format is named .%s; .png, .exr, .tif, .jpg, .webp and .gif are "
        "written here",
        path, format);
}

bool image_format_is_float(const char *format)
{
    static const char *const floats[] = {"exr", "hdr", "tif", "tiff", NULL};
    return is_one_of(format, floats);
}

bool image_format_has_alpha(const char *format)
{
    static const char *const opaque[] = {"jpg", "jpeg", "ppm", "hdr", "gif", NULL};
    return !is_one_of(format, opaque);
}

/* PNG. */

/* libpng's error handler must not return: it jumps back into png_encode. */
static void png_failed(png_structp png, png_const_charp text)
{
    Message *message = png_get_error_ptr(png);
    message_set(message, "PNG: %s", text);
    png_longjmp(png, 1);
}

static void png_warned(png_structp png, png_const_charp text)
{
    (void)png;
    (void)text;
}

static void png_append(png_structp png, png_bytep bytes, size_t size)
{
    if (!image_file_append(png_get_io_ptr(png), bytes, size))
        png_error(png, "not enough memory for the file");
}

static void png_nothing(png_structp png)
{
    (void)png;
}

static void png_put_text(png_structp png, png_infop info, const ImageText *text)
{
    for (; text && text->key; text++) {
        png_text chunk = {.compression = PNG_ITXT_COMPRESSION_NONE,
                          .key = (char *)(uintptr_t)text->key,
                          .text = (char *)(uintptr_t)text->text};
        bool ascii = true;
        for (const char *p = text->text; *p; p++)
            ascii = ascii && (unsigned char)*p < 128;
        if (ascii)
            chunk.compression = PNG_TEXT_COMPRESSION_NONE;
        png_set_text(png, info, &chunk, 1);
    }
}

static unsigned char to_byte(float value)
{
    const float clamped = value > 0 ? (value < 1 ? value : 1) : 0; /* NaN becomes 0 */
    return (unsigned char)lrintf(255 * clamped);
}

/* Row y as RGBA bytes: the image's own, or converted into `spare`. */
static const unsigned char *png_row(const Image *image, int y, unsigned char *spare)
{
    const size_t values = 4 * (size_t)image->width;
    if (image->type == IMAGE_BYTE)
        return (const unsigned char *)image->pixels + (size_t)y * values;
    const float *row = (const float *)image->pixels + (size_t)y * values;
    for (size_t i = 0; i < values; i++)
        spare[i] = to_byte(row[i]);
    return spare;
}

/* Whether hardly any pixel differs from its left neighbour, as in a picture of few even faces. */
static bool has_flat_colors(const Image *image)
{
    const size_t width = (size_t)image->width, height = (size_t)image->height;
    const uint32_t *pixels = image->pixels;
    size_t changes = 0;
    if (image->type != IMAGE_BYTE)
        return false;
    for (size_t y = 0; y < height; y++)
        for (size_t x = 1; x < width; x++)
            changes += pixels[y * width + x] != pixels[y * width + x - 1];
    return changes < width * height / 50;
}

static bool png_encode(const Image *image, const ImageOptions *options, ImageFile *file,
                       Message *message)
{
    const int level = options->compress >= 0 ? options->compress : has_flat_colors(image) ? 4 : 3;
    unsigned char *spare = malloc(4 * (size_t)image->width);
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, message, png_failed, png_warned);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    bool done = false;
    if (!spare || !info) {
        message_set(message, "PNG: not enough memory");
        goto end;
    }
    if (setjmp(png_jmpbuf(png)))
        goto end;
    png_set_write_fn(png, file, png_append, png_nothing);
    png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8,
                 options->alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(png, level);
    /* Trying every filter on every row costs more than zlib's fast levels save by it. */
    if (level < 6)
        png_set_filter(png, PNG_FILTER_TYPE_BASE, level ? PNG_FILTER_SUB : PNG_FILTER_NONE);
    png_put_text(png, info, options->text);
    png_write_info(png, info);
    if (!options->alpha)
        png_set_filler(png, 0, PNG_FILLER_AFTER); /* leaves out every fourth byte */
    for (int y = 0; y < image->height; y++)
        png_write_row(png, png_row(image, y, spare));
    png_write_end(png, info);
    done = true;
end:
    png_destroy_write_struct(&png, &info);
    free(spare);
    return done;
}

/* A limit on the size of files (ulimit -f) holds for memory too, and not every encoder bears it: it
 * is lifted as far as may be while one runs, and met when the file itself is written. */
static struct rlimit lift_file_limit(void)
{
    struct rlimit limit = {RLIM_INFINITY, RLIM_INFINITY};
    if (getrlimit(RLIMIT_FSIZE, &limit) == 0) {
        const struct rlimit lifted = {limit.rlim_max, limit.rlim_max};
        setrlimit(RLIMIT_FSIZE, &lifted);
    }
    return limit;
}

/* Through memory that has a file descriptor: OpenImageIO writes some formats to files only, and a
 * full disk must not be met half-way. */
static bool module_encode(const Image *image, const char *format, const ImageOptions *options,
                          ImageFile *file, Message *message)
{
    const ImageModule *module;
    if (!image_module_open(&module, message))
        return false;
    const int memory = memfd_create("picture", MFD_CLOEXEC);
    if (memory < 0)
        return message_set(message, "%s: %s", format, strerror(errno));
    char reason[1024] = "";
    pthread_mutex_lock(&module_lock);
    const struct rlimit limit = lift_file_limit();
    bool done = module->can_write(format);
    if (!done) {
        message_set(message, "this OpenImageIO does not write .%s", format);
    } else if (!module->encode(image, format, options, memory, reason, sizeof reason)) {
        done = message_set(message, "cannot write %s: %s", format, reason);
    } else {
        unsigned char piece[64 * 1024];
        ssize_t got;
        lseek(memory, 0, SEEK_SET);
        while (done && (got = read(memory, piece, sizeof piece)) > 0)
            done = image_file_append(file, piece, (size_t)got);
        if (!done || got < 0 || !file->size)
            done = message_set(message, "cannot write %s: %s", format,
                               !done     ? "not enough memory for the file"
                               : got < 0 ? strerror(errno)
                                         : "nothing was written");
    }
    close(memory);
    setrlimit(RLIMIT_FSIZE, &limit);
    pthread_mutex_unlock(&module_lock);
    return done;
}

bool image_encode(const Image *image, const char *format, const ImageOptions *options,
                  ImageFile *file, Message *message)
{
    *file = (ImageFile){0};
    const bool done = strcmp(format, "png") == 0
                          ? png_encode(image, options, file, message)
                          : module_encode(image, format, options, file, message);
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

/* Reading and comparing. */

bool image_read(Image *image, const char *path, Message *message)
{
    const ImageModule *module;
    char reason[1024] = "";
    *image = (Image){0};
    if (!image_module_open(&module, message))
        return false;
    if (!module->read(path, image, reason, sizeof reason)) {
        image_close(image);
        return message_set(message, "%s: cannot read: %s", path, reason);
    }
    return true;
}

static bool alike(const Image *a, const Image *b, Message *message)
{
    if (a->width == b->width && a->height == b->height && a->type == b->type)
        return true;
    return message_set(message, "comparing pictures: %dx%d %s against %dx%d %s", a->width,
                       a->height, a->type == IMAGE_FLOAT ? "float" : "byte", b->width, b->height,
                       b->type == IMAGE_FLOAT ? "float" : "byte");
}

bool image_compare(const Image *a, const Image *b, ImageDifference *difference, Message *message)
{
    const ImageModule *module;
    char reason[1024] = "";
    *difference = (ImageDifference){0};
    if (!alike(a, b, message) || !image_module_open(&module, message))
        return false;
    if (!module->compare(a, b, difference, reason, sizeof reason))
        return message_set(message, "comparing pictures: %s", reason);
    return true;
}

bool image_difference(const Image *a, const Image *b, double gain, Image *difference,
                      Message *message)
{
    const ImageModule *module;
    char reason[1024] = "";
    *difference = (Image){0};
    if (!alike(a, b, message) || !image_module_open(&module, message) ||
        !image_open(difference, a->width, a->height, IMAGE_BYTE, message))
        return false;
    if (!module->difference(a, b, gain, difference, reason, sizeof reason)) {
        image_close(difference);
        return message_set(message, "the difference of two pictures: %s", reason);
    }
    return true;
}

bool image_label(Image *image, int x, int y, int size, const char *text, Message *message)
{
    const ImageModule *module;
    char reason[1024] = "";
    if (!image_module_open(&module, message))
        return false;
    if (!module->label(image, x, y, size, text, reason, sizeof reason))
        return message_set(message, "label \"%s\": %s", text, reason);
    return true;
}
