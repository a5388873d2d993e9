/*
 * The errors of pictures written pixel by pixel, so that every error, its place and every count is
 * known.
 */
#include "reference/picture_error.h"
#include "support/testing.h"

#include <float.h>

enum { WIDTH = 7, HEIGHT = 5, COUNT = WIDTH * HEIGHT };

/* An exact picture of one color, all of it interior. */
typedef struct Plain {
    float color[3 * COUNT];
    unsigned char interior[COUNT];
    int object[COUNT];
    float coverage[COUNT];
    Reference exact;
    Object objects[3];
    Scene scene;
} Plain;

static void plain_open(Plain *plain, int width, int height, float value)
{
    for (int i = 0; i < 3 * COUNT; i++)
        plain->color[i] = value;
    memset(plain->interior, 1, sizeof plain->interior);
    memset(plain->object, 0, sizeof plain->object);
    for (int i = 0; i < COUNT; i++)
        plain->coverage[i] = 1;
    memset(plain->objects, 0, sizeof plain->objects);
    plain->objects[0].front.alpha = 1; /* no alpha is less than theirs */
    plain->exact = (Reference){.width = width,
                               .height = height,
                               .color = plain->color,
                               .interior = plain->interior,
                               .object = plain->object,
                               .coverage = plain->coverage};
    plain->scene = (Scene){.objects = plain->objects, .object_count = 3};
}

static Image open_image(int width, int height, ImageType type, double value)
{
    Image image;
    require(image_open(&image, width, height, type, FAILURE), FAILURE);
    for (int i = 0; i < 4 * width * height; i++) {
        if (type == IMAGE_FLOAT)
            ((float *)image.pixels)[i] = i % 4 == 3 ? 1 : (float)value;
        else
            ((unsigned char *)image.pixels)[i] =
                i % 4 == 3 ? 255 : (unsigned char)lround(255 * value);
    }
    return image;
}

static void put_byte(Image *image, int x, int y, int channel, int value)
{
    ((unsigned char *)image->pixels)[4 * (y * image->width + x) + channel] = (unsigned char)value;
}

static void put_float(Image *image, int x, int y, int channel, double value)
{
    ((float *)image->pixels)[4 * (y * image->width + x) + channel] = (float)value;
}

static PictureError compare(const Image *image, const Plain *plain)
{
    PictureError error = {.all = {0}};
    picture_error_add(&error, image, &(ExactView){.exact = &plain->exact, .scene = &plain->scene});
    return error;
}

TEST(a_map_has_a_color_for_each_error)
{
    static const struct {
        double value;
        unsigned char color[3];
    } cases[] = {{0, {0, 0, 0}},
                 {0.5, {0, 0, 0}},
                 {0.51, {70, 110, 255}},
                 {4, {0, 200, 120}},
                 {32, {255, 200, 0}},
                 {255, {255, 255, 255}},
                 {(double)NAN, {255, 255, 255}}};
    Plain plain;
    plain_open(&plain, WIDTH, HEIGHT, 0);
    CLOSED(image_close) Image image = open_image(WIDTH + 1, HEIGHT + 2, IMAGE_FLOAT, 0);
    Image map = open_image(WIDTH + 1, HEIGHT + 2, IMAGE_BYTE, 1);
    for (int i = 0; i < 7; i++)
        put_float(&image, 1 + i, 2, 1, cases[i].value / 255);
    picture_error_map(&map, &image, &(ExactView){.exact = &plain.exact, .left = 1, .top = 2});
    const unsigned char *pixels = map.pixels;
    for (int i = 0; i < 7; i++)
        for (int c = 0; c < 3; c++)
            assert_in_range(pixels[4 * (2 * (WIDTH + 1) + 1 + i) + c] + 3, cases[i].color[c],
                            cases[i].color[c] + 6);
    for (int i = 0; i < 4 * (WIDTH + 1); i++) /* beside it, and its alpha, are as they were */
        assert_int_equal(pixels[i], 255);
    assert_int_equal(pixels[4 * (2 * (WIDTH + 1) + 1) + 3], 255);
    image_close(&map);
}

TEST(equal_pictures_have_no_error)
{
    Plain plain;
    for (int value = 0; value <= 255; value++) {
        /* The float next to value / 255 is less than 255 2^-24 = 1.6e-5 steps away. */
        plain_open(&plain, WIDTH, HEIGHT, (float)value / 255);
        CLOSED(image_close) Image bytes = open_image(WIDTH, HEIGHT, IMAGE_BYTE, value / 255.0);
        const PictureError error = compare(&bytes, &plain);
        assert_int_equal(error.all.pixels, COUNT);
        assert_int_equal(error.interior.pixels, COUNT);
        assert_int_equal(error.all.wrong, 0);
        assert_true(error.all.maximum < 1.6e-5);
        assert_true(error_sum_rms(&error.all) < 1.6e-5);
        CLOSED(image_close)
        Image floats = open_image(WIDTH, HEIGHT, IMAGE_FLOAT, (double)plain.color[0]);
        const PictureError none = compare(&floats, &plain);
        assert_true(none.all.maximum == 0 && error_sum_rms(&none.all) == 0);
    }
}

/* Two channels of one pixel off by 3 and 4, one of another by 12: the largest is the worst
 * channel's, the mean is over all channels, the place that of the pixel. */
TEST(errors_are_of_the_worst_channel_and_the_mean_of_all)
{
    Plain plain;
    plain_open(&plain, WIDTH, HEIGHT, 0);
    CLOSED(image_close) Image image = open_image(WIDTH, HEIGHT, IMAGE_BYTE, 0);
    put_byte(&image, 2, 1, 0, 3);
    put_byte(&image, 2, 1, 2, 4);
    put_byte(&image, 5, 3, 1, 12);
    put_byte(&image, 0, 0, 3, 200); /* alpha does not count */
    put_byte(&image, 6, 4, 0, 1);   /* one step is not wrong */
    const PictureError error = compare(&image, &plain);
    assert_true(error.all.maximum == 12);
    assert_int_equal(error.all.worst, 3 * WIDTH + 5);
    assert_int_equal(error.all.wrong, 2);
    assert_true(error.all.squares == 9 + 16 + 144 + 1);
    /* Two roundings of a double, of a quotient and a root. */
    assert_true(fabs(error_sum_rms(&error.all) - sqrt(170.0 / (3 * COUNT))) < 4 * DBL_EPSILON);
}

TEST(the_first_of_equal_maxima_is_named)
{
    Plain plain;
    plain_open(&plain, WIDTH, HEIGHT, 1);
    CLOSED(image_close) Image image = open_image(WIDTH, HEIGHT, IMAGE_BYTE, 1);
    put_byte(&image, 4, 2, 1, 250);
    put_byte(&image, 1, 2, 0, 250);
    put_byte(&image, 6, 4, 2, 250);
    const PictureError error = compare(&image, &plain);
    assert_true(error.all.maximum == 5);
    assert_int_equal(error.all.worst, 2 * WIDTH + 1);
}

TEST(edges_count_in_the_whole_alone)
{
    Plain plain;
    plain_open(&plain, WIDTH, HEIGHT, 0.4F);
    CLOSED(image_close) Image image = open_image(WIDTH, HEIGHT, IMAGE_BYTE, 0.4); /* 102 */
    put_byte(&image, 3, 2, 0, 202);
    put_byte(&image, 1, 1, 0, 105);
    plain.interior[2 * WIDTH + 3] = plain.interior[0] = 0;
    const PictureError error = compare(&image, &plain);
    assert_int_equal(error.all.pixels, COUNT);
    assert_int_equal(error.interior.pixels, COUNT - 2);
    /* 0.4 as a float is 0.4 + 6e-9. */
    assert_true(fabs(error.all.maximum - 100) < 1e-5);
    assert_true(fabs(error.interior.maximum - 3) < 1e-5);
    assert_int_equal(error.interior.worst, WIDTH + 1);
    assert_int_equal(error.all.wrong, 2);
    assert_int_equal(error.interior.wrong, 1);
}

TEST(nothing_compared_has_no_mean)
{
    Plain plain;
    plain_open(&plain, 1, 1, 0);
    plain.interior[0] = 0;
    CLOSED(image_close) Image image = open_image(1, 1, IMAGE_BYTE, 1);
    const PictureError error = compare(&image, &plain);
    assert_int_equal(error.all.pixels, 1);
    assert_true(error.all.maximum == 255 && error_sum_rms(&error.all) == 255);
    assert_int_equal(error.interior.pixels, 0);
    assert_true(error.interior.maximum == 0);
    assert_true(isnan(error_sum_rms(&error.interior)));
}

/* The exact picture is what a framebuffer would hold, so floats are clamped to 0..1 like bytes; the
 * error of a value that is not finite is the largest, even if the exact value is 0 or 1. */
TEST(floats_are_clamped_and_values_not_finite_are_wrong)
{
    static const struct {
        double drawn, exact, error;
    } cases[] = {
        {1.7, 1, 0},        {-0.3, 0, 0},        {1.7, 0.2, 204},      {-5, 0.2, 51},
        {FLT_MAX, 1, 0},    {0.5, 0.25, 63.75},  {NAN, 1, 255},        {NAN, 0.5, 255},
        {INFINITY, 1, 255}, {-INFINITY, 0, 255}, {FLT_TRUE_MIN, 0, 0}, {-0.0, 0, 0},
    };
    Plain plain;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        plain_open(&plain, WIDTH, HEIGHT, (float)cases[i].exact);
        CLOSED(image_close) Image image = open_image(WIDTH, HEIGHT, IMAGE_FLOAT, cases[i].exact);
        put_float(&image, 4, 3, (int)i % 3, cases[i].drawn);
        put_float(&image, 1, 1, 3, NAN); /* alpha does not count */
        const PictureError error = compare(&image, &plain);
        /* 0.2 as a float is 0.2 + 3e-9. */
        if (!(fabs(error.all.maximum - cases[i].error) < 1e-6))
            fail_msg("%g for %g: %g steps, not %g", cases[i].drawn, cases[i].exact,
                     error.all.maximum, cases[i].error);
        if (cases[i].error > 0)
            assert_int_equal(error.all.worst, 3 * WIDTH + 4);
        assert_true(isfinite(error_sum_rms(&error.all)));
    }
}

/* A pixel that the drawn objects do not cover wholly is not inside; whichever covers it. */
TEST(what_is_drawn_limits_the_interior)
{
    Plain plain;
    for (int type = IMAGE_BYTE; type <= IMAGE_FLOAT; type++) {
        plain_open(&plain, WIDTH, HEIGHT, 0);
        plain.objects[1].front.alpha = 1;
        plain.objects[1].two_sided = true; /* its back is half opaque */
        plain.objects[1].back.alpha = 0.5;
        plain.objects[2].front.alpha = 0.25;
        CLOSED(image_close) Image image = open_image(WIDTH, HEIGHT, (ImageType)type, 1);
        static const struct {
            int object;
            double alpha;
            bool inside;
        } cases[] = {{0, 1, true},   {0, 0.9985, true}, {0, 0.75, false}, {0, 0, false},
                     {1, 0.5, true}, {1, 0.4, false},   {2, 0.25, true},  {2, 0.2, false},
                     {2, 0.5, true}, {0, 0.25, true},   {2, 0.6, false},  {-1, 1, false},
                     {-1, 0, false}};
        int inside = COUNT;
        for (int i = 0; i < (int)(sizeof cases / sizeof cases[0]); i++) {
            plain.object[i] = cases[i].object;
            plain.interior[i] = cases[i].object >= 0;
            for (int c = 1; c <= 3; c++) {
                const double value = c == 3            ? cases[i].alpha
                                     : cases[i].inside ? 2.0 / 255
                                                       : 100.0 / 255;
                if (type == IMAGE_BYTE)
                    put_byte(&image, i % WIDTH, i / WIDTH, c, (int)lround(255 * value));
                else
                    put_float(&image, i % WIDTH, i / WIDTH, c, value);
            }
            inside -= !cases[i].inside;
        }
        for (int i = 0; i < COUNT; i++) /* the rest is not wrong */
            for (int c = 0; c < 3; c++)
                if (i >= (int)(sizeof cases / sizeof cases[0]) || c == 0)
                    plain.color[3 * i + c] = 1;
        const PictureError error = compare(&image, &plain);
        assert_int_equal(error.interior.pixels, inside);
        assert_int_equal(error.edges.pixels, COUNT - inside - 1); /* all but the background */
        assert_true(fabs(error.interior.maximum - 2) < 1e-5);
        assert_true(fabs(error.all.maximum - 100) < 1e-5);
    }
}

TEST_MAIN("picture error", NULL, NULL)
