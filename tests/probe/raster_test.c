/*
 * The evaluator against the driver: in highp the colour that is computed for a pixel inside an
 * object is the picture's byte, of all programs. A pixel is inside if its neighbours show the same
 * draw and side, and no line or point is drawn over it.
 */
#include "probe/raster.h"

#include "app/renderer.h"
#include "support/examples.h"
#include "support/testing.h"

#include <limits.h>

enum { SIDE = 160 };

static Canvas canvas;
static long compared, equal;

FIXTURE(open_canvas)
{
    SUCCEEDS(canvas_open(&canvas, &(CanvasOptions){.width = SIDE, .height = SIDE}, message));
}

FIXTURE(close_canvas)
{
    canvas_close(&canvas);
}

static RasterPixel pixels[SIDE * SIDE]; /* row 0 is the bottom */

static bool is_inside(int column, int row)
{
    static const int around[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const RasterPixel *pixel = &pixels[row * SIDE + column];
    for (int i = 0; i < 4 && pixel->draw >= 0; i++) {
        const int x = column + around[i][0], y = row + around[i][1];
        const bool out = x < 0 || y < 0 || x >= SIDE || y >= SIDE;
        const RasterPixel *next = out ? pixel : &pixels[y * SIDE + x];
        if (out || next->draw != pixel->draw || next->front != pixel->front)
            return false;
    }
    return pixel->draw >= 0;
}

static void compare(Raster *raster, const Image *image, const char *name)
{
    long here = 0, same = 0;
    raster_scan(raster, (const int[4]){0, 0, SIDE, SIDE}, pixels);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const unsigned char *drawn = (unsigned char *)image->pixels + 4 * i;
        const int column = i % SIDE, row = SIDE - 1 - i / SIDE;
        double color[4];
        bool is_same = true;
        if (!is_inside(column, row))
            continue;
        raster_run(raster, &pixels[row * SIDE + column], &GLSL_LLVMPIPE, INT_MAX, color);
        for (int c = 0; c < 3; c++)
            is_same &= drawn[c] == (int)(255 * fmin(fmax(color[c], 0), 1) + 0.5);
        here++;
        same += is_same;
        if (!is_same && here - same <= 3)
            printf("%s %d,%d: drawn %d %d %d, computed %.4f %.4f %.4f\n", name, column, i / SIDE,
                   drawn[0], drawn[1], drawn[2], 255 * color[0], 255 * color[1], 255 * color[2]);
    }
    printf("%s: %ld of %ld\n", name, same, here);
    compared += here;
    equal += same;
}

/* Lines and points, which are drawn as arrays, stay away. */
static PFNGLDRAWARRAYSPROC draw_arrays;

static void GL_APIENTRY draw_filled(GLenum mode, GLint first, GLsizei count)
{
    if (mode == GL_TRIANGLES || mode == GL_TRIANGLE_STRIP)
        draw_arrays(mode, first, count);
}

static void check(const Example *example)
{
    CLOSED(capture_close) Capture capture;
    CLOSED(image_close) Image drawn = {.width = 0};
    const DrawRequest request = {.seconds = 0.7, .shaders = {.precision = "highp"}};
    Renderer renderer;
    Raster *raster;
    SUCCEEDS(image_open(&drawn, SIDE, SIDE, IMAGE_BYTE, message));
    draw_arrays = glDrawArrays;
    glDrawArrays = draw_filled;
    capture_begin(&capture, &canvas);
    SUCCEEDS(renderer_open(&renderer, example, &canvas, &request, message) &&
             renderer_draw(&renderer, &request, request.seconds, message));
    capture_end(&capture);
    glDrawArrays = draw_arrays;
    SUCCEEDS(canvas_read(&canvas, &drawn, message));
    renderer_close(&renderer);
    SUCCEEDS(raster_open(&raster, &capture, &GLSL_LLVMPIPE, message));
    compare(raster, &drawn, example->name);
    raster_close(raster);
}

TEST(computed_colours_are_the_pictures)
{
    for (int i = 0; i < LECTURE_COUNT; i++)
        check(LECTURES[i]);
    for (int i = 0; i < EXAMPLE_COUNT; i++)
        check(EXAMPLES[i]);
    printf("%ld of %ld pixels inside objects have the picture's bytes\n", equal, compared);
    assert_true(compared > 100000); /* else nothing is seen */
    assert_true((double)equal >= 0.999 * (double)compared);
}

TEST(frag_data_is_a_colour)
{
    unsigned vertices[3] = {0, 1, 2};
    CaptureDraw draw = {.sources = {"void main() { gl_Position = vec4(1.0); }",
                                    "void main() { gl_FragData[0] = vec4(0.25); }"},
                        .mode = GL_TRIANGLES,
                        .vertex_count = 3,
                        .vertices = vertices};
    const Capture capture = {.draws = &draw, .draw_count = 1};
    const RasterPixel pixel = {.weights = {1, 0, 0}};
    Raster *raster;
    double color[4];
    SUCCEEDS(raster_open(&raster, &capture, &GLSL_LLVMPIPE, message));
    raster_run(raster, &pixel, &GLSL_EXACT, INT_MAX, color);
    assert_true(color[0] == 0.25);
    raster_close(raster);
}

TEST_MAIN("raster", open_canvas, close_canvas)
