/*
 * Frame time of every example over that of a frame which is only cleared, drawn and finished
 * without reading back; in the shader's own precision, and in highp.
 */
#include "measure.h"
#include "stage.h"

#include <stdio.h>
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
    const Example *example; /* NULL: only clear */
    Canvas *canvas;
    Options *options;
} Run;

static bool draw_frames(void *argument)
{
    const Run *run = argument;
    Message message = {0};
    for (int i = 0; i < FRAMES; i++) {
        if (!run->example) {
            canvas_clear(run->canvas, (Vec3){0, 0, 0}, 1);
        } else if (!stage_draw(run->example, run->canvas, run->options, 0.1 * i, &message)) {
            return false;
        }
        glFinish();
    }
    return true;
}

/* One example against a cleared frame, for its state is the context's while it is entered. */
static bool measure_example(const Example *example, Canvas *canvas, const char *precision,
                            Message *message)
{
    Options options = {.shaders = {.precision = precision}};
    Run clear = {.canvas = canvas}, draw = {example, canvas, &options};
    Measured measured[2] = {{example->name, draw_frames, &draw, NULL},
                            {"a cleared frame", draw_frames, &clear, NULL}};
    if (!stage_enter(example, &options, message))
        return false;
    const bool done = measure_rounds(measured, 2, ROUNDS);
    if (done) {
        const Summary time = measure_summary(measured[0].seconds, ROUNDS);
        const Summary ratio = measure_ratio(&measured[0], &measured[1], 1, ROUNDS);
        printf("%-32s %-8s %6.2f [%5.2f, %5.2f]   %5.1f [%.1f, %.1f]\n", example->name,
               precision ? precision : "its own", 1e3 * time.median / FRAMES,
               1e3 * time.lower / FRAMES, 1e3 * time.upper / FRAMES, ratio.median, ratio.lower,
               ratio.upper);
    }
    measure_finish(measured, 2);
    stage_leave(example);
    return done ? true : message_set(message, "%s: measuring failed", example->name);
}

int main(void)
{
    Message message = {0};
    Canvas canvas;
    const CanvasOptions size = {.width = 400, .height = 400};
    if (!canvas_open(&canvas, &size, &message))
        return options_fail("frame_time_benchmark", &message, 77);
    measure_print_machine();
    printf("%s\n%-32s %-8s %22s   %s\n", canvas.renderer, "a frame of 400x400", "precision", "ms",
           "over a cleared frame");
    bool done = true;
    for (int i = 0; i < COUNT && done; i++)
        done = measure_example(ALL[i], &canvas, NULL, &message) &&
               measure_example(ALL[i], &canvas, "highp", &message);
    canvas_close(&canvas);
    return done ? 0 : options_fail("frame_time_benchmark", &message, 1);
}
