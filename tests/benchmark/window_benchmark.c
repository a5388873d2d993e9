/*
 * The time of a window's frame relative to its parts: the headless frame and the copy to the
 * screen. Same context, vertical sync off, every step finished before the next is timed.
 */
#include "app/options.h"
#include "app/renderer.h"
#include "benchmark/measure.h"
#include "window/window.h"

#include <stdlib.h>

extern const Example LightedCube_animation, PointLightedSphere_perFragment, ShadingModels;

static const Example *const EXAMPLES_SHOWN[] = {&LightedCube_animation,
                                                &PointLightedSphere_perFragment, &ShadingModels};
static const int SIZES[][2] = {{400, 400}, {1000, 800}};

enum {
    EXAMPLE_COUNT = sizeof EXAMPLES_SHOWN / sizeof EXAMPLES_SHOWN[0],
    SIZE_COUNT = sizeof SIZES / sizeof SIZES[0],
    ROUNDS = 41,
    FRAMES = 10,
};

typedef struct Run {
    Renderer *renderer;
    Canvas *canvas;
    const DrawRequest *request;
} Run;

static bool draw_frame(const Run *run, int number)
{
    Message message = {0};
    return renderer_draw(run->renderer, run->request, 0.1 * number, &message) ||
           options_fail("window_benchmark", &message, 0);
}

static bool headless_frames(void *argument)
{
    for (int i = 0; i < FRAMES; i++) {
        if (!draw_frame(argument, i))
            return false;
        glFinish();
    }
    return true;
}

static void copy(const Run *run)
{
    canvas_present(run->canvas, (const int[4]){0, 0, run->canvas->width, run->canvas->height});
    window_swap(window_of(run->canvas));
    glFinish();
}

static bool copies(void *argument)
{
    for (int i = 0; i < FRAMES; i++)
        copy(argument);
    return true;
}

static bool window_frames(void *argument)
{
    const Run *run = argument;
    WindowInput input;
    for (int i = 0; i < FRAMES; i++) {
        window_input(window_of(run->canvas), 0, &input);
        if (!draw_frame(run, i))
            return false;
        copy(run);
    }
    return true;
}

/* Of each round's ratio frame / (headless + copy). */
static Summary frame_ratio(const Measured *headless, const Measured *copied, const Measured *frame)
{
    double ratios[ROUNDS];
    for (int i = 0; i < ROUNDS; i++)
        ratios[i] = frame->seconds[i] / (headless->seconds[i] + copied->seconds[i]);
    return measure_summary(ratios, ROUNDS);
}

static bool measure_example(const Example *example, Canvas *canvas, Table *table, Message *message)
{
    const DrawRequest request = {.fps = 30};
    Renderer renderer;
    Run run = {&renderer, canvas, &request};
    Measured measured[] = {{"a headless frame", headless_frames, &run, NULL},
                           {"the copy", copies, &run, NULL},
                           {"a window's frame", window_frames, &run, NULL},
                           {"the same again", window_frames, &run, NULL}};
    enum { COUNT = sizeof measured / sizeof measured[0] };
    if (!renderer_open(&renderer, example, canvas, &request, message))
        return false;
    const bool done = measure_rounds(measured, COUNT, ROUNDS);
    if (done) {
        double ms[3];
        for (int i = 0; i < 3; i++)
            ms[i] = 1e3 * measure_summary(measured[i].seconds, ROUNDS).median / FRAMES;
        const Summary ratio = frame_ratio(&measured[0], &measured[1], &measured[2]);
        const Summary again = measure_ratio(&measured[3], &measured[2], 1, ROUNDS);
        table_row(table, "%s|%dx%d|%.2f|%.2f|%.2f|%s|%s", example->name, canvas->width,
                  canvas->height, ms[0], ms[1], ms[2], measure_cell(ratio, 1, 2).text,
                  measure_cell(again, 1, 2).text);
    }
    measure_finish(measured, COUNT);
    renderer_close(&renderer);
    return done || message_set(message, "%s: measuring failed", example->name);
}

static bool measure_size(int width, int height, Table *table, Message *message)
{
    Canvas canvas;
    const CanvasOptions options = {
        .backend = &CANVAS_WINDOW, .width = width, .height = height, .title = "window_benchmark"};
    if (!canvas_open(&canvas, &options, message))
        return false;
    window_show(window_of(&canvas));
    window_wait_for_screen(window_of(&canvas), false);
    bool done = true;
    for (int i = 0; i < EXAMPLE_COUNT && done; i++)
        done = measure_example(EXAMPLES_SHOWN[i], &canvas, table, message);
    canvas_close(&canvas);
    return done;
}

int main(int argc, char *argv[])
{
    measure_begin(&argc, argv);
    Message message = {0};
    void *window;
    const char *platform;
    Table table;
    if (!CANVAS_WINDOW.open(&window, &(CanvasOptions){.width = 1, .height = 1}, &platform,
                            &message))
        return options_fail("window_benchmark", &message, 77);
    CANVAS_WINDOW.close(window);
    measure_print_machine(NULL, NULL);
    table_open(&table, "a frame, in ms|size|headless|copy|window|window over both|the same again");
    for (int i = 0; i < SIZE_COUNT; i++)
        if (!measure_size(SIZES[i][0], SIZES[i][1], &table, &message))
            return options_fail("window_benchmark", &message, EXIT_FAILED);
    measure_print_table(platform, &table);
    return 0;
}
