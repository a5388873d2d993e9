/* Text in pictures: where its ink lies, clipping, UTF-8, alpha, and fonts that cannot be read. */
#include "images/label.h"
#include "support/testing.h"

enum { WIDTH = 240, HEIGHT = 80, X = 120, BASELINE = 50, SIZE = 20 };

static Message message;

static Image new_image(int width, int height)
{
    Image image;
    require(image_open(&image, width, height, IMAGE_BYTE, &message), &message);
    return image;
}

/* A label on transparent black, whose alpha is then its coverage. */
static Image labelled(int x, int size, const char *text)
{
    Image image = new_image(WIDTH, HEIGHT);
    require(image_label(&image, x, BASELINE, size, text, &message), &message);
    return image;
}

static int alpha_at(const Image *image, int x, int y)
{
    return ((unsigned char *)image->pixels)[4 * (y * image->width + x) + 3];
}

/* The pixels that any ink touches; right and bottom are one further. */
typedef struct Box {
    int left, top, right, bottom;
} Box;

static Box ink(const Image *image)
{
    Box box = {image->width, image->height, 0, 0};
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++) {
            if (!alpha_at(image, x, y))
                continue;
            box.left = x < box.left ? x : box.left;
            box.right = x + 1 > box.right ? x + 1 : box.right;
            box.top = y < box.top ? y : box.top;
            box.bottom = y + 1 > box.bottom ? y + 1 : box.bottom;
        }
    return box;
}

static Box ink_of(int x, int size, const char *text)
{
    Image image = labelled(x, size, text);
    const Box box = ink(&image);
    image_close(&image);
    return box;
}

static void assert_same_text(const char *a, const char *b, bool same)
{
    CLOSED(image_close) Image first = labelled(X, SIZE, a), second = labelled(X, SIZE, b);
    assert_int_equal(memcmp(first.pixels, second.pixels, 4 * WIDTH * HEIGHT) == 0, same);
}

FOLDER_TEST(letters_stand_on_the_baseline)
{
    static const int sizes[] = {12, 14, 20, 24};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        const int size = sizes[i];
        const Box capital = ink_of(X, size, "HHHHH"), small = ink_of(X, size, "xzx");
        assert_int_equal(capital.bottom, BASELINE);
        assert_int_equal(small.bottom, BASELINE);
        assert_true(ink_of(X, size, "g").bottom > BASELINE);
        /* The font's capitals are 0.73 em high, its small letters 0.55. */
        assert_in_range(BASELINE - capital.top, 0.68 * size, 0.78 * size + 1);
        assert_in_range(BASELINE - small.top, 0.50 * size, 0.60 * size + 1);
    }
}

FOLDER_TEST(stems_are_white)
{
    CLOSED(image_close) Image image = labelled(X, 40, "HHHHH");
    int white = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            white += alpha_at(&image, x, y) == 255;
    assert_true(white > 10 * 29 * 2); /* of ten stems, 29 pixels high and nearly 4 wide */
}

FOLDER_TEST(ink_is_centred_within_a_pixel)
{
    static const char *const texts[] = {"H", "i", "AV To", "jf", "directional", " left", "right  "};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        for (int x = 100; x < 104; x++) {
            const Box box = ink_of(x, SIZE, texts[i]);
            assert_in_range(box.left + box.right, 2 * x - 2, 2 * x + 2);
        }
}

FOLDER_TEST(pairs_are_kerned)
{
    const Box a = ink_of(X, 40, "A"), v = ink_of(X, 40, "V"), both = ink_of(X, 40, "AV");
    assert_true(both.right - both.left < a.right - a.left + v.right - v.left - 2);
}

/* A label at or beyond a border is what a larger picture has there. */
FOLDER_TEST(labels_are_clipped_at_every_border)
{
    enum { W = 40, H = 24 };
    CLOSED(image_close) Image large = labelled(X, SIZE, "Mgj@W");
    const Box box = ink(&large);
    int clipped = 0;
    assert_true(box.right - box.left > W && box.bottom - box.top < H);
    for (int top = box.top - H; top <= box.bottom; top++)
        for (int left = box.left - W; left <= box.right; left += 3) {
            CLOSED(image_close) Image image = new_image(W, H);
            require(image_label(&image, X - left, BASELINE - top, SIZE, "Mgj@W", &message),
                    &message);
            for (int y = 0; y < H; y++)
                for (int x = 0; x < W; x++)
                    assert_in_range(alpha_at(&image, x, y) + 1,
                                    (unsigned)alpha_at(&large, left + x, top + y),
                                    (unsigned)alpha_at(&large, left + x, top + y) + 2);
            clipped += ink(&image).left == 0 || ink(&image).top == 0;
        }
    assert_true(clipped > 100);
}

FOLDER_TEST(text_without_ink_leaves_the_picture_as_it_is)
{
    static const char *const texts[] = {"", " ", "\n", "\t \r"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        assert_int_equal(ink_of(X, SIZE, texts[i]).right, 0);
    assert_int_equal(ink_of(-1000000, SIZE, "far").right, 0);
    assert_int_equal(ink_of(1000000, SIZE, "far").right, 0);
    assert_int_equal(ink_of(X, 0, "none").right, 0);
}

FOLDER_TEST(utf8_is_decoded_and_malformed_bytes_are_replaced)
{
    assert_same_text("caf\u00e9", "cafe", false);
    const Box accented = ink_of(X, SIZE, "\u00ed"), plain = ink_of(X, SIZE, "\u0131");
    assert_true(accented.bottom == BASELINE && accented.top < plain.top - 2);
    assert_true(accented.right - accented.left < 8); /* one letter */
    assert_same_text("30\u00b0 \u2264 \u03b1", "30  ", false);
    assert_same_text("a\nb", "a b", true);
    static const char *const malformed[] = {"\xff", "\x80", "\xc3", "\xe2\x89", "\xf0\x9f\x98"};
    for (size_t i = 0; i < sizeof malformed / sizeof malformed[0]; i++)
        assert_same_text(malformed[i], "\ufffd", true);
    assert_same_text("\xc3(", "\ufffd(", true);
    /* Not in the font: both give the same box. */
    assert_same_text("\U0010fffd", "\U000ffffd", true);
    assert_true(ink_of(X, SIZE, "\U0010fffd").right > 0);
}

FOLDER_TEST(the_color_stays_white_over_transparency_and_opaque_stays_opaque)
{
    CLOSED(image_close) Image image = labelled(X, SIZE, "edges");
    const unsigned char *pixel = image.pixels;
    for (int i = 0; i < WIDTH * HEIGHT; i++, pixel += 4)
        assert_true(pixel[0] == pixel[1] && pixel[1] == pixel[2] &&
                    pixel[2] == (pixel[3] ? 255 : 0));
    CLOSED(image_close) Image opaque = new_image(WIDTH, HEIGHT);
    unsigned char *bytes = opaque.pixels;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        memcpy(bytes + 4 * i, (unsigned char[]){255, 100, 0, 255}, 4);
    require(image_label(&opaque, X, BASELINE, SIZE, "edges", &message), &message);
    for (int i = 0; i < WIDTH * HEIGHT; i++, bytes += 4) {
        const int coverage = alpha_at(&image, i % WIDTH, i / WIDTH);
        assert_int_equal(bytes[0], 255);
        assert_in_range(bytes[1] + 1, 100 + 155 * coverage / 255, 100 + 155 * coverage / 255 + 2);
        assert_in_range(bytes[2] + 1, (unsigned)coverage, (unsigned)coverage + 2);
        assert_int_equal(bytes[3], 255);
    }
}

/* However narrow: the ink lies within the middle of its rectangle, in one line where there is room.
 */
FOLDER_TEST(captions_stay_within_their_rectangle)
{
    static const char *const texts[] = {"spot", "spot with an exponent",
                                        "all but specular: 134 + 134 op, 10.21 ms"};
    int lines[3] = {0};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        int height = HEIGHT;
        for (int width = WIDTH; width > 0; width -= 3) {
            CLOSED(image_close) Image image = new_image(WIDTH, HEIGHT);
            const int place[4] = {(WIDTH - width) / 2, 0, width, HEIGHT};
            int size = 12;
            require(image_caption_size(place, texts[i], &size, &message) &&
                        image_caption(&image, place, size, texts[i], &message),
                    &message);
            const Box box = ink(&image);
            assert_int_equal(box.right == 0, size == 0); /* too small to read */
            if (size == 0)
                continue;
            assert_true(box.left >= place[0] && box.right <= place[0] + width);
            assert_true(box.top >= 2 * HEIGHT / 3 - 13 && box.bottom <= HEIGHT);
            lines[i] += box.bottom - box.top > 16 && height <= 16;
            height = box.bottom - box.top;
        }
    }
    assert_true(lines[0] == 0 && lines[1] > 0); /* a word is not broken */
    CLOSED(image_close) Image one = new_image(WIDTH, HEIGHT), same = labelled(X, 12, texts[1]);
    require(image_caption(&one, (const int[4]){0, 0, WIDTH, BASELINE + 6}, 12, texts[1], &message),
            &message);
    const Box box = ink(&one), letters = ink(&same);
    assert_true(box.left == letters.left - 1 && box.right == letters.right + 1 &&
                box.top == letters.top - 1 && box.bottom == letters.bottom + 1); /* their edge */
}

static void assert_no_font(const char *path, const char *reason)
{
    Image image = new_image(WIDTH, HEIGHT);
    const char *expected = formatted(
        "%s: cannot read the font: %s; install the package fonts-dejavu-core", path, reason);
    message = (Message){0};
    setenv("LIGHTING_FONT", path, 1);
    assert_false(image_label(&image, X, BASELINE, SIZE, "text", &message));
    unsetenv("LIGHTING_FONT");
    assert_string_equal(message.text, expected);
    assert_int_equal(ink(&image).right, 0);
    image_close(&image);
    message = (Message){0};
}

FOLDER_TEST(a_font_that_cannot_be_read_is_named_with_its_package)
{
    static const char partial[] = "not a complete TrueType font";
    size_t size;
    char *bytes = testing_read("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", &size);
    assert_no_font("missing.ttf", "No such file or directory");
    assert_no_font("/", "No such device");
    const size_t lengths[] = {1, 4, 11, 12, 100, 300, 5000, size / 2, size - 8};
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
        testing_write("partial.ttf", bytes, lengths[i]);
        assert_no_font("partial.ttf", partial);
    }
    memset(bytes, 'x', 1000);
    testing_write("words.ttf", bytes, 1000);
    assert_no_font("words.ttf", partial);
    free(bytes);
}

/* Whether a pixel within two of this one is black. */
static bool has_dark_beside(const Image *image, int x, int y)
{
    for (int v = y - 2; v <= y + 2; v++)
        for (int u = x - 2; u <= x + 2; u++)
            if (u >= 0 && v >= 0 && u < image->width && v < image->height &&
                ((unsigned char *)image->pixels)[4 * (v * image->width + u)] < 64)
                return true;
    return false;
}

FOLDER_TEST(captions_are_read_over_white)
{
    static const int place[4] = {0, 0, WIDTH, HEIGHT};
    CLOSED(image_close) Image dark = new_image(WIDTH, HEIGHT), bright = new_image(WIDTH, HEIGHT);
    int white = 0;
    memset(bright.pixels, 255, 4 * WIDTH * HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        ((unsigned char *)dark.pixels)[4 * i + 3] = 255;
    require(image_caption(&dark, place, 12, "spot, attenuated", &message), &message);
    require(image_caption(&bright, place, 12, "spot, attenuated", &message), &message);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const int at = 4 * (y * WIDTH + x);
            if (((unsigned char *)dark.pixels)[at] < 200)
                continue;
            white++;
            assert_true(((unsigned char *)bright.pixels)[at] >= 200);
            assert_true(has_dark_beside(&bright, x, y));
        }
    assert_true(white > 100);
}

int main(void)
{
    Image image;
    if (!image_open(&image, 1, 1, IMAGE_BYTE, &message) ||
        !image_label(&image, 0, 0, SIZE, "", &message)) {
        printf("label_test: skipped: %s\n", message.text);
        return EXIT_SKIPPED;
    }
    image_close(&image);
    return testing_run(0, "label", NULL, NULL);
}
