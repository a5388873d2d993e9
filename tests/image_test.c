/*
 * Pictures to files and back: PNG of libpng, everything else of OpenImageIO; damaged files; the
 * numbers that comparing gives. The files' sizes are those of the lecture's own pictures.
 */
#include "image.h"

#include "picture_check.h"
#include "stage.h"
#include "testing.h"

#include <fcntl.h>
#include <float.h>
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cmocka.h>

extern const Example LightedCube, LightedCube_animation, LightedCube_ambient,
    LightedTranslatedRotatedCube, PointLightedCube, PointLightedCube_animation,
    PointLightedCube_perFragment, PointLightedSphere, PointLightedSphere_perFragment;

static char folder[] = "/tmp/image_test_XXXXXX";
static unsigned short seed[3];
static bool has_module, has_driver;

static int open_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    return rmdir(folder); /* fails where a test left a file */
}

static const char *in_folder(const char *name)
{
    static char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static Image new_image(int width, int height, ImageType type)
{
    Image image;
    assert_true(image_open(&image, width, height, type, NULL));
    return image;
}

static size_t value_count(const Image *image)
{
    return 4 * (size_t)image->width * (size_t)image->height;
}

/* Bytes without any pattern: a row, column or channel in the wrong place would be seen. */
static Image random_bytes(int width, int height, bool opaque)
{
    Image image = new_image(width, height, IMAGE_BYTE);
    unsigned char *values = image.pixels;
    for (size_t i = 0; i < value_count(&image); i++)
        values[i] = opaque && i % 4 == 3 ? 255 : (unsigned char)(nrand48(seed) & 255);
    return image;
}

/* Floats from below 0 to far above 1. */
static Image random_floats(int width, int height, bool opaque)
{
    Image image = new_image(width, height, IMAGE_FLOAT);
    float *values = image.pixels;
    for (size_t i = 0; i < value_count(&image); i++) {
        values[i] = (float)(1000 * erand48(seed) - 200);
        if (i % 4 == 3)
            values[i] = opaque ? 1 : (float)erand48(seed);
    }
    return image;
}

static void assert_same(const Image *got, const Image *expected)
{
    assert_int_equal(got->width, expected->width);
    assert_int_equal(got->height, expected->height);
    assert_int_equal(got->type, expected->type);
    assert_memory_equal(got->pixels, expected->pixels, image_row_size(got) * (size_t)got->height);
}

static void need_module(void)
{
    if (!has_module)
        skip();
}

static Image read_file(const char *path)
{
    Image image;
    Message message = {0};
    if (!image_read(&image, path, &message))
        fail_msg("%s", message.text);
    return image;
}

/* To a file and back. */
static Image write_and_read(const Image *image, const char *name, const ImageOptions *options)
{
    const char *path = in_folder(name);
    Message message = {0};
    if (!image_write(image, path, options, &message))
        fail_msg("%s", message.text);
    Image back = read_file(path);
    assert_int_equal(unlink(path), 0);
    return back;
}

/* PNG. */

static ImageFile encode_png(const Image *image, const ImageOptions *options)
{
    ImageFile file;
    Message message = {0};
    if (!image_encode(image, "png", options, &file, &message))
        fail_msg("%s", message.text);
    return file;
}

/* By libpng's own reader; an opaque file gives an alpha of 255. */
static Image decode_png(const ImageFile *file, bool alpha)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_memory(&png, file->bytes, file->size));
    assert_int_equal(png.format, alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB);
    Image image = new_image((int)png.width, (int)png.height, IMAGE_BYTE);
    png.format = PNG_FORMAT_RGBA;
    assert_true(png_image_finish_read(&png, NULL, image.pixels, 0, NULL));
    assert_int_equal(png.warning_or_error, 0);
    return image;
}

static void a_png_is_read_back_byte_for_byte_at_every_level(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {3, 5}, {257, 3}, {100, 70}};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        for (int alpha = 0; alpha < 2; alpha++) {
            Image image = random_bytes(sizes[s][0], sizes[s][1], !alpha);
            for (int level = 0; level <= 9; level++) {
                const ImageOptions options = {.compress = level, .alpha = alpha};
                ImageFile file = encode_png(&image, &options);
                Image back = decode_png(&file, alpha);
                assert_same(&back, &image);
                image_close(&back);
                image_file_close(&file);
            }
            image_close(&image);
        }
    }
}

static void image_read_gives_back_the_bytes_of_a_png(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {3, 5}, {257, 3}};
    need_module();
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        for (int alpha = 0; alpha < 2; alpha++) {
            for (int level = 0; level <= 9; level += 3) {
                const ImageOptions options = {.compress = level, .alpha = alpha};
                Image image = random_bytes(sizes[s][0], sizes[s][1], !alpha);
                Image back = write_and_read(&image, "bytes.png", &options);
                assert_same(&back, &image);
                image_close(&back);
                image_close(&image);
            }
        }
    }
}

static void a_png_without_alpha_leaves_it_out_and_is_opaque(void **state)
{
    (void)state;
    Image image = random_bytes(20, 10, false);
    ImageFile file = encode_png(&image, &(ImageOptions){.compress = 1});
    Image back = decode_png(&file, false);
    unsigned char *values = image.pixels;
    for (size_t i = 3; i < value_count(&image); i += 4)
        values[i] = 255;
    assert_same(&back, &image);
    image_close(&back);
    image_close(&image);
    image_file_close(&file);
}

/* What stands after "KEY\0" in a chunk of this type; NULL where there is none. */
static const char *png_text_of(const ImageFile *file, const char *type, const char *key,
                               size_t *size)
{
    size_t length;
    for (size_t at = 8; at + 12 <= file->size; at += length + 12) {
        const unsigned char *chunk = file->bytes + at;
        length = (size_t)chunk[0] << 24 | (size_t)chunk[1] << 16 | (size_t)chunk[2] << 8 | chunk[3];
        if (memcmp(chunk + 4, type, 4) == 0 && length > strlen(key) &&
            memcmp(chunk + 8, key, strlen(key) + 1) == 0) {
            *size = length - strlen(key) - 1;
            return (const char *)chunk + 8 + strlen(key) + 1;
        }
    }
    return NULL;
}

static void a_png_carries_its_texts(void **state)
{
    (void)state;
    const ImageText text[] = {
        {"Title", "LightedCube"}, {"Time", "1.5 s"}, {"Comment", "30\u00b0 up"}, {NULL, NULL}};
    Image image = random_bytes(8, 8, true);
    ImageFile file = encode_png(&image, &(ImageOptions){.compress = 1, .text = text});
    Image back = decode_png(&file, false);
    assert_same(&back, &image);
    size_t size = 0;
    for (int i = 0; i < 2; i++) {
        const char *found = png_text_of(&file, "tEXt", text[i].key, &size);
        assert_non_null(found);
        assert_int_equal(size, strlen(text[i].text));
        assert_memory_equal(found, text[i].text, size);
    }
    /* Beyond ASCII: international text, after two bytes and two empty strings about it. */
    const char *found = png_text_of(&file, "iTXt", "Comment", &size);
    assert_non_null(found);
    assert_int_equal(size, 4 + strlen(text[2].text));
    assert_memory_equal(found, "\0\0\0\0", 4);
    assert_memory_equal(found + 4, text[2].text, size - 4);
    image_close(&back);
    image_close(&image);
    image_file_close(&file);
}

static void floats_go_to_a_png_clamped_and_rounded(void **state)
{
    (void)state;
    static const struct {
        float value;
        unsigned char level;
    } known[] = {{NAN, 0},          {-NAN, 0},           {-INFINITY, 0},
                 {-1, 0},           {-0.0F, 0},          {1e-30F, 0},
                 {0.499F / 255, 0}, {0.501F / 255, 1},   {127.4F / 255, 127},
                 {0.502F, 128},     {254.4F / 255, 254}, {254.6F / 255, 255},
                 {1, 255},          {1.001F, 255},       {FLT_MAX, 255},
                 {INFINITY, 255}};
    enum { KNOWN = sizeof known / sizeof known[0] };
    Image image = new_image(256 + KNOWN, 1, IMAGE_FLOAT);
    float *values = image.pixels;
    for (int x = 0; x < image.width; x++)
        for (int c = 0; c < 4; c++)
            values[4 * x + c] = x < 256 ? (float)x / 255 : known[x - 256].value;
    ImageFile file = encode_png(&image, &(ImageOptions){.compress = 1, .alpha = true});
    Image back = decode_png(&file, true);
    const unsigned char *levels = back.pixels;
    for (int x = 0; x < image.width; x++)
        for (int c = 0; c < 4; c++)
            assert_int_equal(levels[4 * x + c], x < 256 ? x : known[x - 256].level);
    image_close(&back);
    image_close(&image);
    image_file_close(&file);
}

/* With libpng's default settings: level 6, and for each row the best of all filters. */
static size_t default_png_size(const Image *image)
{
    const size_t pixels = value_count(image) / 4;
    const unsigned char *rgba = image->pixels;
    unsigned char *rgb = malloc(3 * pixels);
    assert_non_null(rgb);
    for (size_t i = 0; i < pixels; i++)
        memcpy(rgb + 3 * i, rgba + 4 * i, 3);
    png_image png = {.version = PNG_IMAGE_VERSION,
                     .width = (png_uint_32)image->width,
                     .height = (png_uint_32)image->height,
                     .format = PNG_FORMAT_RGB};
    png_alloc_size_t size = 0;
    assert_true(png_image_write_get_memory_size(png, size, 0, rgb, 0, NULL));
    free(rgb);
    return size;
}

static void the_lectures_pictures_take_at_most_1_8_times_what_libpng_makes_of_them(void **state)
{
    (void)state;
    static const Example *const examples[] = {
        &LightedCube,
        &LightedCube_animation,
        &LightedCube_ambient,
        &LightedTranslatedRotatedCube,
        &PointLightedCube,
        &PointLightedCube_animation,
        &PointLightedCube_perFragment,
        &PointLightedSphere,
        &PointLightedSphere_perFragment,
    };
    if (!has_driver)
        skip();
    const Options options = {.width = 400, .height = 400, .compress = IMAGE_COMPRESS_DEFAULT};
    Canvas canvas;
    Picture picture = {.path = ""};
    Message message = {0};
    if (!stage_open(&canvas, &options, "picture.png", &message))
        fail_msg("%s", message.text);
    picture.image = new_image(400, 400, IMAGE_BYTE);
    for (size_t i = 0; i < sizeof examples / sizeof examples[0]; i++) {
        if (!stage_enter(examples[i], &options, &message) ||
            !stage_picture(examples[i], &canvas, &options, 0.5, &picture, &message))
            fail_msg("%s: %s", examples[i]->name, message.text);
        stage_leave(examples[i]);
        ImageFile file = encode_png(&picture.image, &(ImageOptions){.compress = options.compress});
        const size_t usual = default_png_size(&picture.image);
        print_message("%s: %zu bytes, %.2f times libpng's %zu\n", examples[i]->name, file.size,
                      (double)file.size / (double)usual, usual);
        assert_true(usual > 1000); /* not an empty picture */
        assert_true((double)file.size <= 1.8 * (double)usual);
        image_file_close(&file);
    }
    image_close(&picture.image);
    canvas_close(&canvas);
}

/* Other formats. */

static void an_exr_keeps_every_float_bit_for_bit(void **state)
{
    (void)state;
    static const float known[] = {0,       -0.0F,    -1.5F,     1e30F,    -1e30F, 1e-42F,
                                  FLT_MAX, INFINITY, -INFINITY, 1.0F / 3, 65504,  65505};
    need_module();
    Image image = random_floats(37, 21, true);
    float *values = image.pixels;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        values[4 * i + i % 3] = known[i];
    Image back = write_and_read(&image, "floats.exr", &(ImageOptions){.alpha = false});
    assert_same(&back, &image);
    image_close(&back);
    image_close(&image);
}

/* By its definition EXR holds colours multiplied by alpha. */
static void an_exr_with_alpha_keeps_colours_to_two_roundings(void **state)
{
    (void)state;
    need_module();
    Image image = random_floats(37, 21, true);
    const size_t count = 37 * 21;
    float *values = image.pixels;
    for (size_t i = 0; i < count; i++)
        values[4 * i + 3] = (float)(1 + i % 255) / 255;
    Image back = write_and_read(&image, "floats.exr", &(ImageOptions){.alpha = true});
    const float *read = back.pixels;
    /* One rounding, of 2^-24 in relative terms, in the product and one in the quotient; doubled for
     * a quotient that is computed as a product with the reciprocal. */
    for (size_t i = 0; i < 4 * count; i++)
        assert_true(fabsf(read[i] - values[i]) <= 2 * FLT_EPSILON * fabsf(values[i]));
    image_close(&back);
    image_close(&image);
}

static void a_tiff_keeps_bytes_and_floats_bit_for_bit(void **state)
{
    (void)state;
    need_module();
    for (int alpha = 0; alpha < 2; alpha++) {
        for (int real = 0; real < 2; real++) {
            Image image = real ? random_floats(37, 21, !alpha) : random_bytes(37, 21, !alpha);
            Image back = write_and_read(&image, "values.tif", &(ImageOptions){.alpha = alpha});
            assert_same(&back, &image);
            image_close(&back);
            image_close(&image);
        }
    }
}

static Image smooth_bytes(void)
{
    Image image = new_image(96, 64, IMAGE_BYTE);
    unsigned char *values = image.pixels;
    for (int y = 0; y < image.height; y++) {
        for (int x = 0; x < image.width; x++, values += 4) {
            values[0] = (unsigned char)(x * 255 / 95);
            values[1] = (unsigned char)(y * 255 / 63);
            values[2] = (unsigned char)(255 - (x + y) * 255 / 158);
            values[3] = 255;
        }
    }
    return image;
}

static void a_jpeg_or_a_webp_is_near_the_picture(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double rms, maximum;
    } kinds[] = {
        /* At quality 95 the steps of the coefficients are a tenth of the standard's, 2 to 12; an
         * even error of a step of 10 has an rms of 10 / sqrt(12). In a smooth picture nearly all
         * are 0 and exact, so that this is plenty, for the colours' halved resolution too. */
        {"smooth.jpg", 3, 12},
        /* Without loss, but from whole luma and chroma: each is wrong by 0.5 at the most, and blue
         * is 1.164 of one and 2.018 of the other, rounded: 2. Chroma, of half resolution, is half a
         * pixel away at the border, where it goes by up to 4 levels a pixel: 4 more. */
        {"smooth.webp", 1, 6},
    };
    need_module();
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        Image image = smooth_bytes();
        Image back = write_and_read(&image, kinds[i].name, &(ImageOptions){.alpha = false});
        ImageDifference difference;
        assert_true(image_compare(&back, &image, &difference, NULL));
        print_message("%s: rms %.2f, maximum %.0f levels\n", kinds[i].name, difference.rms,
                      difference.maximum);
        assert_true(difference.rms < kinds[i].rms);
        assert_true(difference.maximum <= kinds[i].maximum);
        image_close(&back);
        image_close(&image);
    }
}

static void floats_go_to_a_jpeg_or_a_webp_clamped(void **state)
{
    (void)state;
    static const struct {
        float value;
        int level;
    } known[] = {{-5, 0}, {0, 0}, {0.2F, 51}, {0.8F, 204}, {1, 255}, {7, 255}};
    static const char *const names[] = {"even.jpg", "even.webp"};
    need_module();
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        for (size_t n = 0; n < 2; n++) {
            Image image = new_image(16, 16, IMAGE_FLOAT);
            for (size_t v = 0; v < value_count(&image); v++)
                ((float *)image.pixels)[v] = known[i].value;
            Image back = write_and_read(&image, names[n], &(ImageOptions){.alpha = false});
            assert_int_equal(back.type, IMAGE_BYTE);
            const unsigned char *levels = back.pixels;
            for (size_t v = 0; v < value_count(&back); v++) {
                const int expected = v % 4 == 3 ? 255 : known[i].level;
                assert_true(abs(levels[v] - expected) <= 1); /* grey by way of luma */
            }
            image_close(&back);
            image_close(&image);
        }
    }
}

static void a_grey_or_partly_transparent_file_becomes_rgba(void **state)
{
    (void)state;
    static const struct {
        png_uint_32 format;
        unsigned char pixels[2][4], expected[2][4];
    } kinds[] = {
        {PNG_FORMAT_GRAY, {{10}, {200}}, {{10, 10, 10, 255}, {200, 200, 200, 255}}},
        {PNG_FORMAT_GA, {{10, 0}, {200, 99}}, {{10, 10, 10, 0}, {200, 200, 200, 99}}},
        {PNG_FORMAT_RGB, {{1, 2, 3}, {4, 5, 6}}, {{1, 2, 3, 255}, {4, 5, 6, 255}}},
        {PNG_FORMAT_RGBA, {{1, 2, 3, 0}, {4, 5, 6, 77}}, {{1, 2, 3, 0}, {4, 5, 6, 77}}},
    };
    need_module();
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        const size_t channels = PNG_IMAGE_SAMPLE_CHANNELS(kinds[i].format);
        unsigned char packed[8];
        png_image png = {
            .version = PNG_IMAGE_VERSION, .width = 2, .height = 1, .format = kinds[i].format};
        memcpy(packed, kinds[i].pixels[0], channels);
        memcpy(packed + channels, kinds[i].pixels[1], channels);
        const char *path = in_folder("channels.png");
        assert_true(png_image_write_to_file(&png, path, 0, packed, 0, NULL));
        Image image = read_file(path);
        assert_int_equal(image.type, IMAGE_BYTE);
        assert_true(image.width == 2 && image.height == 1);
        assert_memory_equal(image.pixels, kinds[i].expected, 8);
        image_close(&image);
        unlink(path);
    }
}

/* Formats by name. */

static void the_extension_names_the_format(void **state)
{
    (void)state;
    static const struct {
        const char *path, *format;
    } known[] = {{"a.png", "png"},     {"A.PNG", "png"},       {"x.y/b.z.pNg", "png"},
                 {"-", "png"},         {"/dev/stdout", "png"}, {"/proc/self/fd/1", "png"},
                 {"dir/.x.png", "png"}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        char format[16];
        assert_true(image_format(known[i].path, format, NULL));
        assert_string_equal(format, known[i].format);
    }
    static const char *const nameless[] = {"a", "a.b/c", "a.", ".png", "dir/.png", ""};
    for (size_t i = 0; i < sizeof nameless / sizeof nameless[0]; i++) {
        char format[16];
        Message message = {0};
        assert_false(image_format(nameless[i], format, &message));
        assert_non_null(strstr(message.text, ": the extension names the format; give one, as in "));
    }
    assert_true(image_format_is_float("exr") && image_format_is_float("tif"));
    assert_false(image_format_is_float("png") || image_format_is_float("jpg"));
}

static void an_unknown_extension_is_refused_and_nothing_is_written(void **state)
{
    (void)state;
    static const char *const unknown[] = {"a.xyz", "a.p", "a.pngg", "a.averyveryverylongextension",
                                          "a.png "};
    Image image = random_bytes(2, 2, true);
    for (size_t i = 0; i < sizeof unknown / sizeof unknown[0]; i++) {
        const char *path = in_folder(unknown[i]);
        Message message = {0};
        assert_false(image_write(&image, path, &(ImageOptions){.compress = 1}, &message));
        assert_memory_equal(message.text, path, strlen(path));
        assert_non_null(strstr(message.text,
                               has_module ? ": no picture format is named ." : ": OpenImageIO: "));
        assert_int_equal(access(path, F_OK), -1);
    }
    image_close(&image);
}

/* Damaged files. */

static void write_bytes(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void assert_says_what_cannot_be_read(const Image *image, const char *path,
                                            const Message *message)
{
    char start[5000];
    snprintf(start, sizeof start, "%s: cannot read: ", path);
    assert_null(image->pixels);
    assert_true(image->width == 0 && image->height == 0);
    assert_memory_equal(message->text, start, strlen(start));
    assert_true(strlen(message->text) > strlen(start));
    assert_null(strchr(message->text, '\n'));
    assert_null(strstr(message->text, "no reason given"));
}

/* Turns standard error away; what it was is returned. */
static int silence(void)
{
    const int shown = dup(STDERR_FILENO), nothing = open("/dev/null", O_WRONLY);
    assert_true(shown >= 0 && nothing >= 0);
    assert_int_equal(dup2(nothing, STDERR_FILENO), STDERR_FILENO);
    close(nothing);
    return shown;
}

/* A damaged file is refused, or what was damaged had no part in the pixels. True: refused. */
static bool refused_or_same(const void *bytes, size_t size, const Image *expected)
{
    const char *path = in_folder("damaged.png");
    Image image;
    Message message = {0};
    write_bytes(path, bytes, size);
    const int shown = silence(); /* libpng has its say too, 400 times */
    const bool read = image_read(&image, path, &message);
    assert_int_equal(dup2(shown, STDERR_FILENO), STDERR_FILENO);
    close(shown);
    if (read)
        assert_same(&image, expected);
    else
        assert_says_what_cannot_be_read(&image, path, &message);
    image_close(&image);
    unlink(path);
    return !read;
}

static void a_damaged_png_is_refused_or_read_right(void **state)
{
    (void)state;
    enum { FLIPS = 300 };
    need_module();
    const ImageText text[] = {{"Title", "a picture that will be damaged"}, {NULL, NULL}};
    Image image = random_bytes(41, 31, true);
    ImageFile file = encode_png(&image, &(ImageOptions){.compress = 1, .text = text});
    assert_false(refused_or_same(file.bytes, file.size, &image));
    const int files = testing_open_files();
    int refused = 0;
    /* The last 12 bytes, the end's chunk, have no part in the pixels. */
    for (size_t size = 0; size < file.size - 12; size += 64)
        assert_true(refused_or_same(file.bytes, size, &image));
    for (int i = 0; i < FLIPS; i++) {
        const size_t bit = (size_t)(erand48(seed) * 8 * (double)file.size);
        file.bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        refused += refused_or_same(file.bytes, file.size, &image);
        file.bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
    print_message("%d of %d files with one wrong bit are refused\n", refused, FLIPS);
    assert_true(refused > FLIPS * 9 / 10); /* nearly all of the file is pixels, guarded by sums */
    assert_int_equal(testing_open_files(), files);
    image_file_close(&file);
    image_close(&image);
}

static void what_is_no_picture_cannot_be_read(void **state)
{
    (void)state;
    static const char words[] = "This is no picture, whatever its name says.\n";
    static const char *const names[] = {"none.png",  "none.exr", "none.jpg", "none.tif",
                                        "none.webp", "none.xyz", "none"};
    need_module();
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const char *path = in_folder(names[i]);
        for (int kind = 0; kind < 4; kind++) {
            Image image;
            Message message = {0};
            if (kind == 1)
                write_bytes(path, "", 0);
            else if (kind == 2)
                write_bytes(path, words, strlen(words));
            else if (kind == 3)
                assert_int_equal(mkdir(path, 0700), 0);
            memset(&image, 0xa5, sizeof image);
            assert_false(image_read(&image, path, &message));
            assert_says_what_cannot_be_read(&image, path, &message);
            remove(path);
        }
    }
}

/* Comparing. */

static void comparing_gives_the_known_numbers(void **state)
{
    (void)state;
    need_module();
    for (int real = 0; real < 2; real++) {
        const ImageType type = real ? IMAGE_FLOAT : IMAGE_BYTE;
        Image a = real ? random_floats(20, 10, false) : random_bytes(20, 10, false);
        Image b = new_image(20, 10, type);
        ImageDifference difference;
        const size_t one = 4 * (20 * 7 + 13), other = 4 * (20 * 2 + 5);
        memcpy(b.pixels, a.pixels, image_row_size(&a) * 10);
        assert_true(image_compare(&a, &b, &difference, NULL));
        assert_true(difference.rms == 0 && difference.maximum == 0 && difference.differing == 0);
        /* 3 and 4 steps in colours; 200 in alpha, which is not compared. */
        if (real) {
            float *p = a.pixels, *q = b.pixels;
            p[one + 2] = q[other] = 2;
            q[one + 2] = 2 + 4 / 255.0F;
            p[other] = 2 + 3 / 255.0F;
            p[one + 3] = 1;
            q[one + 3] = 0.2F;
        } else {
            unsigned char *p = a.pixels, *q = b.pixels;
            p[one + 2] = q[other] = 100;
            q[one + 2] = 104;
            p[other] = 103;
            p[one + 3] = 255;
            q[one + 3] = 55;
        }
        /* Floats near 2 have steps of 2.4e-7, 6e-5 of a level. */
        const double tolerance = 1e-4;
        for (int swapped = 0; swapped < 2; swapped++) {
            assert_true(image_compare(swapped ? &b : &a, swapped ? &a : &b, &difference, NULL));
            assert_true(fabs(difference.maximum - 4) < tolerance);
            assert_int_equal(difference.x, 13);
            assert_int_equal(difference.y, 7);
            assert_int_equal(difference.differing, 2);
            /* Over 200 pixels of three channels: sqrt((9 + 16) / 600). */
            assert_true(fabs(difference.rms - 5 / sqrt(600)) < tolerance);
        }
        image_close(&a);
        image_close(&b);
    }
}

static void the_difference_is_told_by_its_amount_times_the_gain(void **state)
{
    (void)state;
    static const struct {
        unsigned char a, b, levels;
        double gain;
    } known[] = {{10, 10, 0, 1},   {10, 13, 3, 1},   {13, 10, 3, 1},     {255, 0, 255, 1},
                 {0, 255, 255, 1}, {10, 13, 30, 10}, {13, 10, 255, 100}, {200, 100, 50, 0.5},
                 {0, 255, 255, 2}, {10, 13, 0, 0}};
    need_module();
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        for (int real = 0; real < 2; real++) {
            Image a = new_image(3, 2, real ? IMAGE_FLOAT : IMAGE_BYTE);
            Image b = new_image(3, 2, a.type), difference;
            for (size_t v = 0; v < value_count(&a); v++) {
                if (real) {
                    ((float *)a.pixels)[v] = (float)known[i].a / 255;
                    ((float *)b.pixels)[v] = (float)known[i].b / 255;
                } else {
                    ((unsigned char *)a.pixels)[v] = known[i].a;
                    ((unsigned char *)b.pixels)[v] = known[i].b;
                }
            }
            assert_true(image_difference(&a, &b, known[i].gain, &difference, NULL));
            assert_int_equal(difference.type, IMAGE_BYTE);
            assert_true(difference.width == 3 && difference.height == 2);
            const unsigned char *levels = difference.pixels;
            for (size_t v = 0; v < value_count(&difference); v++)
                assert_int_equal(levels[v], v % 4 == 3 ? 255 : known[i].levels);
            image_close(&a);
            image_close(&b);
            image_close(&difference);
        }
    }
}

static void pictures_of_unlike_sizes_or_types_are_not_compared(void **state)
{
    (void)state;
    const Image a = {.width = 4, .height = 3, .type = IMAGE_BYTE};
    static const struct {
        Image b;
        const char *message;
    } unlike[] = {
        {{5, 3, IMAGE_BYTE, NULL}, "comparing pictures: 4x3 byte against 5x3 byte"},
        {{4, 2, IMAGE_BYTE, NULL}, "comparing pictures: 4x3 byte against 4x2 byte"},
        {{3, 4, IMAGE_BYTE, NULL}, "comparing pictures: 4x3 byte against 3x4 byte"},
        {{4, 3, IMAGE_FLOAT, NULL}, "comparing pictures: 4x3 byte against 4x3 float"},
    };
    for (size_t i = 0; i < sizeof unlike / sizeof unlike[0]; i++) {
        ImageDifference numbers;
        Image difference;
        Message message = {0};
        assert_false(image_compare(&a, &unlike[i].b, &numbers, &message));
        assert_string_equal(message.text, unlike[i].message);
        message = (Message){0};
        assert_false(image_difference(&a, &unlike[i].b, 1, &difference, &message));
        assert_string_equal(message.text, unlike[i].message);
        assert_null(difference.pixels);
    }
}

/* Labels, opening and closing. */

static void a_label_is_white_where_it_was_asked_for(void **state)
{
    (void)state;
    enum { WIDTH = 200, HEIGHT = 60, BASELINE = 40, LETTERS = 20 };
    need_module();
    Image image = new_image(WIDTH, HEIGHT, IMAGE_BYTE);
    Message message = {0};
    if (!image_label(&image, WIDTH / 2, BASELINE, LETTERS, "HHHHH", &message)) {
        print_message("%s\n", message.text); /* no font here */
        image_close(&image);
        skip();
    }
    const unsigned char *values = image.pixels;
    int white = 0, left = WIDTH, right = 0;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++, values += 4) {
            if (values[0] == 0)
                continue;
            assert_true(y >= BASELINE - LETTERS && y <= BASELINE);
            white += values[0] == 255 && values[1] == 255 && values[2] == 255;
            left = x < left ? x : left;
            right = x > right ? x : right;
        }
    }
    assert_true(white > LETTERS); /* ten stems and five bars */
    /* Centred, but for the letters' own margins, a tenth of their size. */
    assert_true(abs(left + right - WIDTH) <= 2 * LETTERS / 10 + 1);
    image_close(&image);
}

static void an_image_without_pixels_is_refused(void **state)
{
    (void)state;
    static const int bad[][2] = {{0, 1}, {1, 0}, {-1, 5}, {5, INT32_MIN}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        Image image;
        Message message = {0};
        char expected[128];
        memset(&image, 0xa5, sizeof image);
        assert_false(image_open(&image, bad[i][0], bad[i][1], IMAGE_BYTE, &message));
        assert_null(image.pixels);
        snprintf(expected, sizeof expected, "image: size %dx%d: must be at least 1x1", bad[i][0],
                 bad[i][1]);
        assert_string_equal(message.text, expected);
    }
}

static void an_image_may_be_closed_twice_and_nothing_may_be_closed(void **state)
{
    (void)state;
    Image image = new_image(3, 2, IMAGE_FLOAT);
    ImageFile file = {0};
    assert_int_equal(image_row_size(&image), 48);
    image_close(NULL);
    image_close(&image);
    assert_true(!image.pixels && image.width == 0);
    image_close(&image);
    image_file_close(NULL);
    image_file_close(&file);
    image_file_close(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_png_is_read_back_byte_for_byte_at_every_level),
        cmocka_unit_test(image_read_gives_back_the_bytes_of_a_png),
        cmocka_unit_test(a_png_without_alpha_leaves_it_out_and_is_opaque),
        cmocka_unit_test(a_png_carries_its_texts),
        cmocka_unit_test(floats_go_to_a_png_clamped_and_rounded),
        cmocka_unit_test(the_lectures_pictures_take_at_most_1_8_times_what_libpng_makes_of_them),
        cmocka_unit_test(an_exr_keeps_every_float_bit_for_bit),
        cmocka_unit_test(an_exr_with_alpha_keeps_colours_to_two_roundings),
        cmocka_unit_test(a_tiff_keeps_bytes_and_floats_bit_for_bit),
        cmocka_unit_test(a_jpeg_or_a_webp_is_near_the_picture),
        cmocka_unit_test(floats_go_to_a_jpeg_or_a_webp_clamped),
        cmocka_unit_test(a_grey_or_partly_transparent_file_becomes_rgba),
        cmocka_unit_test(the_extension_names_the_format),
        cmocka_unit_test(an_unknown_extension_is_refused_and_nothing_is_written),
        cmocka_unit_test(a_damaged_png_is_refused_or_read_right),
        cmocka_unit_test(what_is_no_picture_cannot_be_read),
        cmocka_unit_test(comparing_gives_the_known_numbers),
        cmocka_unit_test(the_difference_is_told_by_its_amount_times_the_gain),
        cmocka_unit_test(pictures_of_unlike_sizes_or_types_are_not_compared),
        cmocka_unit_test(a_label_is_white_where_it_was_asked_for),
        cmocka_unit_test(an_image_without_pixels_is_refused),
        cmocka_unit_test(an_image_may_be_closed_twice_and_nothing_may_be_closed),
    };
    const char *text = getenv("LIGHTING_TEST_SEED");
    const unsigned long number = text ? strtoul(text, NULL, 0) : 20240229;
    seed[0] = 0x330e;
    seed[1] = (unsigned short)number;
    seed[2] = (unsigned short)(number >> 16);
    printf("seed %lu\n", number);
    has_driver = picture_check_driver("image_test");
    has_module = image_doctor();
    const int failed = cmocka_run_group_tests(tests, open_folder, remove_folder);
    return failed || (has_driver && has_module) ? failed : EXIT_SKIPPED;
}
