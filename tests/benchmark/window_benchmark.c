/*
 * The time of a window's frame relative to its parts: the headless frame and the copy to the
 * screen. Same context, vertical sync off, every step finished before the next is timed.
 */
#include "app/options.h"
#include "app/renderer.h"
#include "benchmark/bench.h"
#include "window/window.h"

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

static bool draw_frame(const Run *run, int number, Message *message)
{
    return renderer_draw(run->renderer, run->request, 0.1 * number, message);
}

static bool headless_frames(void *argument, Message *message)
{
    for (int i = 0; i < FRAMES; i++) {
        if (!draw_frame(argument, i, message))
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

static bool copies(void *argument, __attribute__((unused)) Message *message)
{
    for (int i = 0; i < FRAMES; i++)
        copy(argument);
    return true;
}

static bool window_frames(void *argument, Message *message)
{
    const Run *run = argument;
    WindowInput input;
    for (int i = 0; i < FRAMES; i++) {
        window_input(window_of(run->canvas), 0, &input);
        if (!draw_frame(run, i, message))
            return false;
        copy(run);
    }
    return true;
}

static bool measure_example(const Example *example, Canvas *canvas, Table *table, Message *message)
{
    enum { HEADLESS, COPY, WINDOW, AGAIN, COUNT };
    static const BenchColumn columns[] = {{BENCH_MEDIAN(HEADLESS, 1e3 / FRAMES, 2)},
                                          {BENCH_MEDIAN(COPY, 1e3 / FRAMES, 2)},
                                          {BENCH_MEDIAN(WINDOW, 1e3 / FRAMES, 2)},
                                          {1, 2, WINDOW, -1, HEADLESS, COPY, false},
                                          {BENCH_RATIO(AGAIN, WINDOW, 2)}};
    const DrawRequest request = {.fps = 30};
    Renderer renderer;
    Run drawn = {&renderer, canvas, &request};
    BenchRun runs[COUNT] = {{"a headless frame", headless_frames, &drawn, NULL, 0},
                            {"the copy", copies, &drawn, NULL, 0},
                            {"a window's frame", window_frames, &drawn, NULL, 0},
                            {"the same again", window_frames, &drawn, NULL, 0}};
    if (!renderer_open(&renderer, example, canvas, &request, message))
        return false;
    const bool done = bench_rounds(runs, COUNT, ROUNDS, message);
    if (done)
        bench_row(table, runs, columns, 5, "%s|%dx%d", example->name, canvas->width,
                  canvas->height);
    bench_finish(runs, COUNT);
    renderer_close(&renderer);
    return done;
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

static const char *platform;

static bool run(Message *message)
{
    Table table;
    bool done = true;
    table_open(&table, "a frame, in ms|size|headless|copy|window|window over both|the same again");
    for (int i = 0; i < SIZE_COUNT && done; i++)
        done = measure_size(SIZES[i][0], SIZES[i][1], &table, message);
    bench_print(platform, &table);
    return done;
}

static bool can_run(Message *message)
{
    void *window;
    const bool opened =
        CANVAS_WINDOW.open(&window, &(CanvasOptions){.width = 1, .height = 1}, &platform, message);
    if (opened)
        CANVAS_WINDOW.close(window);
    return opened;
}

const Bench BENCH = {.name = "window_benchmark", .can_run = can_run, .run = run};
