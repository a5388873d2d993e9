/*
 * Images to files: PNG read back by libpng, all other formats by OpenImageIO.
 */
#include "app/options.h"
#include "app/renderer.h"
#include "images/picture_queue.h"
#include "images/image_file.h"
#include "images/image_read.h"
#include "support/picture_check.h"
#include "support/testing.h"

#include <fcntl.h>
#include <float.h>
#include <png.h>
#include <unistd.h>

extern const Example LightedCube, LightedCube_animation, LightedCube_ambient,
    LightedTranslatedRotatedCube, PointLightedCube, PointLightedCube_animation,
    PointLightedCube_perFragment, PointLightedSphere, PointLightedSphere_perFragment;

static unsigned short seed[3];
static bool has_driver;

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

/* Random bytes reveal a misplaced row, column or channel. */
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

/* PNG. */

static ImageFile encode_png(const Image *image, const ImageOptions *options)
{
    ImageFile file;
    SUCCEEDS(image_encode(image, "png", options, &file, message));
    return file;
}

/* An opaque file gives alpha 255. */
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

TEST(a_png_is_read_back_byte_for_byte_at_every_level)
{
    static const int sizes[][2] = {{1, 1}, {3, 5}, {257, 3}, {100, 70}};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++)
        for (int alpha = 0; alpha < 2; alpha++) {
            CLOSED(image_close) Image image = random_bytes(sizes[s][0], sizes[s][1], !alpha);
            for (int level = 0; level <= 9; level++) {
                const ImageOptions options = {.compress = level, .alpha = alpha};
                CLOSED(image_file_close) ImageFile file = encode_png(&image, &options);
                CLOSED(image_close) Image back = decode_png(&file, alpha);
                assert_same(&back, &image);
            }
        }
}

TEST(a_png_without_alpha_leaves_it_out_and_is_opaque)
{
    CLOSED(image_close) Image image = random_bytes(20, 10, false);
    CLOSED(image_file_close) ImageFile file = encode_png(&image, &(ImageOptions){.compress = 1});
    CLOSED(image_close) Image back = decode_png(&file, false);
    unsigned char *values = image.pixels;
    for (size_t i = 3; i < value_count(&image); i += 4)
        values[i] = 255;
    assert_same(&back, &image);
}

/* The text after "KEY\0" in a chunk of this type, or NULL. */
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

TEST(a_png_carries_its_texts)
{
    const ImageText text[] = {
        {"Title", "LightedCube"}, {"Time", "1.5 s"}, {"Comment", "30\u00b0 up"}, {NULL, NULL}};
    CLOSED(image_close) Image image = random_bytes(8, 8, true);
    CLOSED(image_file_close)
    ImageFile file = encode_png(&image, &(ImageOptions){.compress = 1, .text = text});
    CLOSED(image_close) Image back = decode_png(&file, false);
    assert_same(&back, &image);
    size_t size = 0;
    for (int i = 0; i < 2; i++) {
        const char *found = png_text_of(&file, "tEXt", text[i].key, &size);
        assert_non_null(found);
        assert_int_equal(size, strlen(text[i].text));
        assert_memory_equal(found, text[i].text, size);
    }
    /* Not ASCII: iTXt, with two bytes and two empty strings before the text. */
    const char *found = png_text_of(&file, "iTXt", "Comment", &size);
    assert_non_null(found);
    assert_int_equal(size, 4 + strlen(text[2].text));
    assert_memory_equal(found, "\0\0\0\0", 4);
    assert_memory_equal(found + 4, text[2].text, size - 4);
}

TEST(floats_go_to_a_png_clamped_and_rounded)
{
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
    CLOSED(image_close) Image image = new_image(256 + KNOWN, 1, IMAGE_FLOAT);
    float *values = image.pixels;
    for (int x = 0; x < image.width; x++)
        for (int c = 0; c < 4; c++)
            values[4 * x + c] = x < 256 ? (float)x / 255 : known[x - 256].value;
    CLOSED(image_file_close)
    ImageFile file = encode_png(&image, &(ImageOptions){.compress = 1, .alpha = true});
    CLOSED(image_close) Image back = decode_png(&file, true);
    const unsigned char *levels = back.pixels;
    for (int x = 0; x < image.width; x++)
        for (int c = 0; c < 4; c++)
            assert_int_equal(levels[4 * x + c], x < 256 ? x : known[x - 256].level);
}

/* With libpng's defaults: level 6, and the best filter for each row. */
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

TEST(pngs_have_at_most_1_8_times_the_size_of_libpngs)
{
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
    CLOSED(canvas_close) Canvas canvas;
    Renderer renderer;
    Picture picture = {.path = ""};
    Message message = {0};
    require(options_open_canvas(&canvas, &options, "picture.png", &message), &message);
    picture.image = new_image(400, 400, IMAGE_BYTE);
    for (size_t i = 0; i < sizeof examples / sizeof examples[0]; i++) {
        const DrawRequest request = options_request(&options, examples[i]);
        if (!renderer_open(&renderer, examples[i], &canvas, &request, &message) ||
            !renderer_picture(&renderer, &request, 0.5, &picture.image, &message))
            fail_msg("%s: %s", examples[i]->name, message.text);
        renderer_close(&renderer);
        CLOSED(image_file_close)
        ImageFile file = encode_png(&picture.image, &(ImageOptions){.compress = options.compress});
        const size_t usual = default_png_size(&picture.image);
        print_message("%s: %zu bytes, %.2f times libpng's %zu\n", examples[i]->name, file.size,
                      (double)file.size / (double)usual, usual);
        assert_true(usual > 1000); /* not an empty picture */
        assert_true((double)file.size <= 1.8 * (double)usual);
    }
    image_close(&picture.image);
}

#ifdef HAVE_OPENIMAGEIO
/* Other formats. */

static Image write_and_read(const Image *image, const char *name, const ImageOptions *options)
{
    Image back;
    SUCCEEDS(image_write(image, name, options, message));
    assert_true(image_read(&back, name));
    assert_int_equal(unlink(name), 0);
    return back;
}

TEST(an_exr_keeps_every_float_bit_for_bit)
{
    static const float known[] = {0,       -0.0F,    -1.5F,     1e30F,    -1e30F, 1e-42F,
                                  FLT_MAX, INFINITY, -INFINITY, 1.0F / 3, 65504,  65505};
    CLOSED(image_close) Image image = random_floats(37, 21, true);
    float *values = image.pixels;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        values[4 * i + i % 3] = known[i];
    CLOSED(image_close)
    Image back = write_and_read(&image, "floats.exr", &(ImageOptions){.alpha = false});
    assert_same(&back, &image);
}

/* EXR stores colors multiplied by alpha. */
TEST(an_exr_with_alpha_keeps_colours_to_two_roundings)
{
    CLOSED(image_close) Image image = random_floats(37, 21, true);
    const size_t count = 37 * 21;
    float *values = image.pixels;
    for (size_t i = 0; i < count; i++)
        values[4 * i + 3] = (float)(1 + i % 255) / 255;
    CLOSED(image_close)
    Image back = write_and_read(&image, "floats.exr", &(ImageOptions){.alpha = true});
    const float *read = back.pixels;
    /* A relative rounding of 2^-24 in the product and one in the quotient; doubled because the
     * quotient may be computed as a product with the reciprocal. */
    for (size_t i = 0; i < 4 * count; i++)
        assert_true(fabsf(read[i] - values[i]) <= 2 * FLT_EPSILON * fabsf(values[i]));
}

TEST(a_tiff_keeps_bytes_and_floats_bit_for_bit)
{
    for (int alpha = 0; alpha < 2; alpha++)
        for (int real = 0; real < 2; real++) {
            CLOSED(image_close)
            Image image = real ? random_floats(37, 21, !alpha) : random_bytes(37, 21, !alpha);
            CLOSED(image_close)
            Image back = write_and_read(&image, "values.tif", &(ImageOptions){.alpha = alpha});
            assert_same(&back, &image);
        }
}

static Image smooth_bytes(void)
{
    Image image = new_image(96, 64, IMAGE_BYTE);
    unsigned char *values = image.pixels;
    for (int y = 0; y < image.height; y++)
        for (int x = 0; x < image.width; x++, values += 4) {
            values[0] = (unsigned char)(x * 255 / 95);
            values[1] = (unsigned char)(y * 255 / 63);
            values[2] = (unsigned char)(255 - (x + y) * 255 / 158);
            values[3] = 255;
        }
    return image;
}

TEST(a_jpeg_or_a_webp_is_near_the_picture)
{
    static const struct {
        const char *name;
        double rms, maximum;
    } kinds[] = {
        /* At quality 95 the quantization steps are 2 to 12; uniform error within a step of 10 has
         * rms 10 / sqrt(12). In a smooth picture nearly all coefficients are 0 and exact, which
         * leaves room for the halved chroma resolution. */
        {"smooth.jpg", 3, 12},
        /* Lossless, but luma and chroma are rounded, each by up to 0.5; blue is 1.164 of one and
         * 2.018 of the other, so 2 levels. Chroma at half resolution is half a pixel off at the
         * border, where it changes by up to 4 levels per pixel: 4 more. */
        {"smooth.webp", 1, 6},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        CLOSED(image_close) Image image = smooth_bytes();
        CLOSED(image_close)
        Image back = write_and_read(&image, kinds[i].name, &(ImageOptions){.alpha = false});
        double sum = 0, maximum = 0;
        assert_true(back.width == image.width && back.height == image.height);
        assert_int_equal(back.type, IMAGE_BYTE);
        for (size_t v = 0; v < value_count(&image); v++) {
            const double step =
                ((unsigned char *)back.pixels)[v] - ((unsigned char *)image.pixels)[v];
            sum += step * step;
            maximum = fmax(maximum, fabs(step));
        }
        const double rms = sqrt(sum / (3.0 * image.width * image.height));
        print_message("%s: rms %.2f, maximum %.0f levels\n", kinds[i].name, rms, maximum);
        assert_true(rms < kinds[i].rms);
        assert_true(maximum <= kinds[i].maximum);
    }
}

TEST(floats_go_to_a_jpeg_or_a_webp_clamped)
{
    static const struct {
        float value;
        int level;
    } known[] = {{-5, 0}, {0, 0}, {0.2F, 51}, {0.8F, 204}, {1, 255}, {7, 255}};
    static const char *const names[] = {"even.jpg", "even.webp"};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        for (size_t n = 0; n < 2; n++) {
            CLOSED(image_close) Image image = new_image(16, 16, IMAGE_FLOAT);
            for (size_t v = 0; v < value_count(&image); v++)
                ((float *)image.pixels)[v] = known[i].value;
            CLOSED(image_close)
            Image back = write_and_read(&image, names[n], &(ImageOptions){.alpha = false});
            assert_int_equal(back.type, IMAGE_BYTE);
            const unsigned char *levels = back.pixels;
            for (size_t v = 0; v < value_count(&back); v++) {
                const int expected = v % 4 == 3 ? 255 : known[i].level;
                assert_true(abs(levels[v] - expected) <= 1); /* converted to luma */
            }
        }
}

#endif

/* Formats by name. */

TEST(the_extension_names_the_format)
{
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
        FAILS_WITH(image_format(nameless[i], format, message),
                   ": the extension names the format; give one, as in ");
    }
    assert_true(image_format_is_float("exr") && image_format_is_float("tif"));
    assert_false(image_format_is_float("png") || image_format_is_float("jpg"));
}

TEST(an_unknown_extension_is_refused_and_nothing_is_written)
{
    static const char *const unknown[] = {"a.xyz", "a.p", "a.pngg", "a.averyveryverylongextension",
                                          "a.png "};
    CLOSED(image_close) Image image = random_bytes(2, 2, true);
    for (size_t i = 0; i < sizeof unknown / sizeof unknown[0]; i++) {
        const char *path = unknown[i];
        Message message = {0};
        assert_false(image_write(&image, path, &(ImageOptions){.compress = 1}, &message));
        assert_memory_equal(message.text, path, strlen(path));
        assert_non_null(strstr(message.text, ": unknown picture format ."));
        assert_int_equal(access(path, F_OK), -1);
    }
}

/* Opening and closing. */

TEST(an_image_without_pixels_is_refused)
{
    static const int bad[][2] = {{0, 1}, {1, 0}, {-1, 5}, {5, INT32_MIN}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        Image image;
        Message message = {0};
        memset(&image, 0xa5, sizeof image);
        assert_false(image_open(&image, bad[i][0], bad[i][1], IMAGE_BYTE, &message));
        assert_null(image.pixels);
        assert_string_equal(message.text, formatted("image: size %dx%d: must be at least 1x1",
                                                    bad[i][0], bad[i][1]));
    }
}

TEST(an_image_may_be_closed_twice_and_nothing_may_be_closed)
{
    Image image = new_image(3, 2, IMAGE_FLOAT);
    CLOSED(image_file_close) ImageFile file = {0};
    assert_int_equal(image_row_size(&image), 48);
    image_close(NULL);
    image_close(&image);
    assert_true(!image.pixels && image.width == 0);
    image_close(&image);
    image_file_close(NULL);
    image_file_close(&file);
}

int main(void)
{
    testing_seed48(seed);
    has_driver = picture_check_driver("image_test");
    const int failed = testing_run(0, "image", testing_enter_folder, testing_leave_empty_folder);
#ifdef HAVE_OPENIMAGEIO
    return failed || has_driver ? failed : EXIT_SKIPPED;
#else
    printf("image_test: built without OpenImageIO\n");
    return failed ? failed : EXIT_SKIPPED;
#endif
}
