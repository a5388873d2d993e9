/*
 * The frame time of every example relative to a cleared frame, both finished and not read back; in
 * the shader's own precision and in highp.
 */
#include "app/options.h"
#include "app/renderer.h"
#include "benchmark/measure.h"

#include <string.h>

#define X(name) extern const Example name;
EXAMPLES
#undef X

static const Example *const ALL[] = {
#define X(name) &name,
    EXAMPLES
#undef X
};

enum { COUNT = sizeof ALL / sizeof ALL[0], ROUNDS = 31, FRAMES = 10 };

typedef struct Run {
    Renderer *renderer; /* NULL: only clears */
    Canvas *canvas;
    const DrawRequest *request;
} Run;

static bool draw_frames(void *argument)
{
    const Run *run = argument;
    Message message = {0};
    for (int i = 0; i < FRAMES; i++) {
        if (!run->renderer) {
            canvas_clear(run->canvas, (Vec3){0, 0, 0}, 1);
        } else if (!renderer_draw(run->renderer, run->request, 0.1 * i, &message)) {
            return false;
        }
        glFinish();
    }
    return true;
}

/* Compares one example with a cleared frame, for which its GL state stays in the context. */
static bool measure_example(const Example *example, Canvas *canvas, const char *precision,
                            Table *table, Message *message)
{
    const DrawRequest request = {.shaders = {.precision = precision}};
    Renderer renderer;
    Run clear = {.canvas = canvas}, draw = {&renderer, canvas, &request};
    Measured measured[2] = {{example->name, draw_frames, &draw, NULL},
                            {"a cleared frame", draw_frames, &clear, NULL}};
    if (!renderer_open(&renderer, example, canvas, &request, message))
        return false;
    const bool done = measure_rounds(measured, 2, ROUNDS);
    if (done) {
        const Summary time = measure_summary(measured[0].seconds, ROUNDS);
        const Summary ratio = measure_ratio(&measured[0], &measured[1], 1, ROUNDS);
        table_row(table, "%s|%s|%s|%s", example->name, precision ? precision : "its own",
                  measure_cell(time, 1e3 / FRAMES, 2).text, measure_cell(ratio, 1, 1).text);
    }
    measure_finish(measured, 2);
    renderer_close(&renderer);
    return done ? true : message_set(message, "%s: measuring failed", example->name);
}

int main(int argc, char *argv[])
{
    measure_begin(&argc, argv);
    Message message = {0};
    Canvas canvas;
    const CanvasOptions size = {.width = 400, .height = 400};
    if (!canvas_open(&canvas, &size, &message))
        return options_fail("frame_time_benchmark", &message, 77);
    Table table;
    measure_print_machine(canvas.renderer, canvas.version);
    table_open(&table, "a frame of 400x400|precision|ms|over a cleared frame");
    bool done = true;
    for (int i = 0; i < COUNT && done; i++)
        done = example_kind(ALL[i])->without_gl || /* drawn without OpenGL */
               (measure_example(ALL[i], &canvas, NULL, &table, &message) &&
                measure_example(ALL[i], &canvas, "highp", &table, &message));
    measure_print_table(NULL, &table);
    canvas_close(&canvas);
    return done ? 0 : options_fail("frame_time_benchmark", &message, 1);
}
