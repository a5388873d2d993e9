/* Drawings: paths and text in pixels, transparency, and that equal drawings are equal files. */
#include "images/drawing.h"
#include "images/path_box.h"
#include "support/testing.h"

static const Vec3 RED = {1, 0, 0}, BLUE = {0, 0, 1};

/* A red square and a blue line in 8 x 4. */
static Drawing opened(void)
{
    Drawing drawing;
    SUCCEEDS(drawing_begin(&drawing, 8, 4, message));
    drawing_path(&drawing, (DrawingStyle){.fill = RED, .fill_alpha = 1});
    drawing_move(&drawing, (DrawingPoint){1, 1});
    drawing_line(&drawing, (DrawingPoint){3, 1});
    drawing_line(&drawing, (DrawingPoint){3, 3});
    drawing_line(&drawing, (DrawingPoint){1, 3});
    drawing_close_path(&drawing);
    drawing_path(&drawing, (DrawingStyle){.stroke = BLUE, .width = 2});
    drawing_move(&drawing, (DrawingPoint){6, -4});
    drawing_line(&drawing, (DrawingPoint){6, 8});
    return drawing;
}

/* `color`: 0xrrggbbaa. */
static void assert_pixel(const Image *image, int x, int y, unsigned color)
{
    const unsigned char *p = (unsigned char *)image->pixels + 4 * (y * image->width + x);
    const unsigned found = (unsigned)p[0] << 24 | (unsigned)p[1] << 16 | (unsigned)p[2] << 8 | p[3];
    if (found != color)
        fail_msg("(%d, %d) is %08x", x, y, found);
}

TEST(paths_cover_their_pixels)
{
    CLOSED(drawing_end) Drawing drawing = opened();
    for (int scale = 1; scale <= 3; scale++) {
        CLOSED(image_close) Image image;
        SUCCEEDS(image_open(&image, 8 * scale, 4 * scale, IMAGE_BYTE, message));
        SUCCEEDS(drawing_paint(&drawing, &image, false, message));
        assert_pixel(&image, 0, 0, 0xffffffff);
        assert_pixel(&image, scale, scale, 0xff0000ff);
        assert_pixel(&image, 3 * scale - 1, 3 * scale - 1, 0xff0000ff);
        assert_pixel(&image, 3 * scale, 2 * scale, 0xffffffff);
        assert_pixel(&image, 5 * scale, 0, 0x0000ffff);
        assert_pixel(&image, 7 * scale - 1, 4 * scale - 1, 0x0000ffff);
    }
}

TEST(a_transparent_background_keeps_colours)
{
    CLOSED(drawing_end) Drawing drawing = opened();
    CLOSED(image_close) Image image;
    drawing.paths[0].style.fill_alpha = 0.5;
    SUCCEEDS(image_open(&image, 8, 4, IMAGE_BYTE, message));
    SUCCEEDS(drawing_paint(&drawing, &image, true, message));
    assert_pixel(&image, 0, 0, 0x00000000);
    assert_pixel(&image, 1, 1, 0xff000080);
    assert_pixel(&image, 5, 0, 0x0000ffff);
}

TEST(boxes_hold_the_ink)
{
    CLOSED(drawing_end) Drawing drawing = opened();
    const DrawingBox box = path_box(&drawing, &drawing.paths[1]);
    assert_true(box.left == 5 && box.right == 7 && box.top == -5 && box.bottom == 9);
    const DrawingBox text = drawing_text_box(&drawing, 100, "$N$");
    drawing_text(&drawing, (DrawingPoint){10, 20}, 100, RED, "$N$");
    const DrawingLabel *label = &drawing.labels[0];
    const DrawingBox path = path_box(&drawing, &drawing.paths[2]);
    /* A capital is about two thirds of an em high, and its outline is what was measured. */
    assert_true(text.top < -60 && text.top > -75 && fabs(text.bottom) < 2);
    assert_true(label->box.left == 10 + text.left && fabs(label->box.top - 20 - text.top) < 1e-9);
    assert_true(path.left == label->box.left && path.right == label->box.right &&
                path.top == label->box.top && path.bottom == label->box.bottom);
}

TEST(scripts_are_raised_and_lowered)
{
    CLOSED(drawing_end) Drawing drawing = opened();
    const DrawingBox plain = drawing_text_box(&drawing, 100, "x1");
    const DrawingBox raised = drawing_text_box(&drawing, 100, "x^{1}");
    const DrawingBox lowered = drawing_text_box(&drawing, 100, "x_{1}");
    assert_true(raised.right < plain.right && raised.top < plain.top);
    assert_true(lowered.right == raised.right && lowered.bottom > plain.bottom);
    /* A letter between $ is another font's; a digit is not. */
    assert_true(drawing_text_box(&drawing, 100, "$x$").right !=
                drawing_text_box(&drawing, 100, "x").right);
    assert_true(drawing_text_box(&drawing, 100, "$1$").right ==
                drawing_text_box(&drawing, 100, "1").right);
}

TEST(equal_drawings_are_equal_files)
{
    static const char *const FORMATS[] = {"svg", "pdf"};
    CLOSED(drawing_end) Drawing drawing = opened();
    for (int i = 0; i < 2; i++) {
        CLOSED(image_file_close) ImageFile first, second;
        SUCCEEDS(drawing_encode(&drawing, FORMATS[i], false, &first, message));
        SUCCEEDS(drawing_encode(&drawing, FORMATS[i], false, &second, message));
        assert_int_equal(first.size, second.size);
        assert_memory_equal(first.bytes, second.bytes, first.size);
        assert_null(memmem(first.bytes, first.size, "CreationDate", 12));
        assert_null(memmem(first.bytes, first.size, "surface", 7));
    }
}

FOLDER_TEST(files_are_written_whole_or_not_at_all)
{
    CLOSED(drawing_end) Drawing drawing = opened();
    assert_null(drawing_format("a.png"));
    assert_null(drawing_format("svg"));
    assert_string_equal(drawing_format("b.d/A.SVG"), "svg");
    SUCCEEDS(drawing_write(&drawing, "a.svg", "svg", false, message));
    SUCCEEDS(drawing_write(&drawing, "a.pdf", "pdf", true, message));
    FAILS_WITH(drawing_write(&drawing, "missing/a.svg", "svg", false, message), "missing/");
    assert_int_equal(testing_entries("."), 2);
}

TEST_MAIN("drawing", NULL, NULL)
