/*
 * The frame time of every example relative to a cleared frame, both finished and not read back; in
 * the shader's own precision and in highp.
 */
#include "app/renderer.h"
#include "benchmark/bench.h"
#include "web/all_examples.h"

enum { ROUNDS = 31, FRAMES = 10 };

typedef struct Run {
    Renderer *renderer; /* NULL: only clears */
    const DrawRequest *request;
} Run;

static bool draw_frames(void *argument, Message *message)
{
    const Run *run = argument;
    for (int i = 0; i < FRAMES; i++) {
        if (!run->renderer)
            canvas_clear(&bench_canvas, (Vec3){0, 0, 0}, 1);
        else if (!renderer_draw(run->renderer, run->request, 0.1 * i, message))
            return false;
        glFinish();
    }
    return true;
}

/* Compares one example with a cleared frame, for which its GL state stays in the context. */
static bool measure_example(const Example *example, const char *precision, Table *table,
                            Message *message)
{
    static const BenchColumn columns[] = {{BENCH_TIME(0, 1e3 / FRAMES, 2)}, {BENCH_RATIO(0, 1, 1)}};
    const DrawRequest request = {.shaders = {.precision = precision}};
    Renderer renderer;
    Run draw = {&renderer, &request}, clear = {NULL, &request};
    BenchRun runs[] = {{example->name, draw_frames, &draw, NULL, 0},
                       {"a cleared frame", draw_frames, &clear, NULL, 0}};
    if (!renderer_open(&renderer, example, &bench_canvas, &request, message))
        return false;
    const bool done = bench_rounds(runs, 2, ROUNDS, message);
    if (done)
        bench_row(table, runs, columns, 2, "%s|%s", example->name,
                  precision ? precision : "its own");
    bench_finish(runs, 2);
    renderer_close(&renderer);
    return done;
}

static bool run(Message *message)
{
    Table table;
    bool done = true;
    table_open(&table, "a frame of 400x400|precision|ms|over a cleared frame");
    for (int i = 0; i < COUNT && done; i++)
        done = example_kind(ALL[i])->without_gl || /* drawn without OpenGL */
               (measure_example(ALL[i], NULL, &table, message) &&
                measure_example(ALL[i], "highp", &table, message));
    bench_print(NULL, &table);
    return done;
}

const Bench BENCH = {.name = "frame_time_benchmark", .width = 400, .height = 400, .run = run};
