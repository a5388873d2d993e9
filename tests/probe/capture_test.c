/*
 * A capture holds all that a picture depends on: drawn again from its data alone, each program's
 * picture is the same, byte for byte. Shadows are not compared here.
 */
#include "probe/capture.h"

#include "app/renderer.h"
#include "probe/replay.h"
#include "support/examples.h"
#include "support/testing.h"

enum { SIDE = 96 };

static Canvas canvas;

FIXTURE(open_canvas)
{
    SUCCEEDS(canvas_open(&canvas, &(CanvasOptions){.width = SIDE, .height = SIDE}, message));
}

FIXTURE(close_canvas)
{
    canvas_close(&canvas);
}

/* Labels, which are painted afterwards, are not in it. */
static void check(const Example *example, const DrawRequest *request, const char *what)
{
    CLOSED(capture_close) Capture capture;
    CLOSED(image_close) Image drawn = {.width = 0}, again = {.width = 0};
    Renderer renderer;
    long differ = 0;
    SUCCEEDS(image_open(&drawn, SIDE, SIDE, IMAGE_BYTE, message) &&
             image_open(&again, SIDE, SIDE, IMAGE_BYTE, message));
    capture_begin(&capture, &canvas);
    SUCCEEDS(renderer_open(&renderer, example, &canvas, request, message) &&
             renderer_draw(&renderer, request, request->seconds, message));
    capture_end(&capture);
    SUCCEEDS(canvas_read(&canvas, &drawn, message));
    assert_true(capture.draw_count > 0);
    SUCCEEDS(replay_draw(&capture, &canvas, NULL, NULL, message) &&
             canvas_read(&canvas, &again, message));
    renderer_close(&renderer);
    for (int i = 0; i < SIDE * SIDE; i++)
        differ += memcmp((unsigned char *)drawn.pixels + 4 * i,
                         (unsigned char *)again.pixels + 4 * i, 4) != 0;
    if (differ)
        fail_msg("%s%s: %ld of %d pixels are others when drawn again from what was captured",
                 example->name, what, differ, SIDE * SIDE);
}

TEST(a_capture_draws_the_lectures_pictures_again)
{
    const DrawRequest request = {.seconds = 0.7};
    for (int i = 0; i < LECTURE_COUNT; i++)
        check(LECTURES[i], &request, "");
}

TEST(a_capture_draws_scenes_again)
{
    const DrawRequest request = {.seconds = 0.7};
    for (int i = 0; i < EXAMPLE_COUNT; i++)
        check(EXAMPLES[i], &request, "");
}

TEST_MAIN("capture", open_canvas, close_canvas)
