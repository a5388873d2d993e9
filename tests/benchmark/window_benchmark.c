/*
 * A window's frame over what it is made of: the frame as a headless program draws it, and the copy
 * to the screen. Both are of the same context, the screen waits for nothing (vertical sync is off),
 * and every step is finished before the next is timed.
 */
#include "measure.h"
#include "stage.h"
#include "window.h"

#include <stdio.h>
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

/* "at most 1.2 times" */
static const double BOUND = 1.2;

typedef struct Run {
    const Example *example;
    Canvas *canvas;
    const Options *options;
} Run;

static bool draw(const Run *run, int number)
{
    Message message = {0};
    return stage_draw(run->example, run->canvas, run->options, 0.1 * number, &message) ||
           options_fail("window_benchmark", &message, 0);
}

static bool headless_frames(void *argument)
{
    for (int i = 0; i < FRAMES; i++) {
        if (!draw(argument, i))
            return false;
        glFinish();
    }
    return true;
}

static void copy(const Run *run)
{
    canvas_present(run->canvas, run->canvas->width, run->canvas->height);
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
        if (!draw(run, i))
            return false;
        copy(run);
    }
    return true;
}

/* Of the rounds' ratios frame / (headless + copy). */
static Summary frame_ratio(const Measured *headless, const Measured *copied, const Measured *frame)
{
    double ratios[ROUNDS];
    for (int i = 0; i < ROUNDS; i++)
        ratios[i] = frame->seconds[i] / (headless->seconds[i] + copied->seconds[i]);
    return measure_summary(ratios, ROUNDS);
}

static bool measure_example(const Example *example, Canvas *canvas, Message *message)
{
    const Options options = {.fps = 30};
    Run run = {example, canvas, &options};
    Measured measured[] = {{"a headless frame", headless_frames, &run, NULL},
                           {"the copy", copies, &run, NULL},
                           {"a window's frame", window_frames, &run, NULL},
                           {"the same again", window_frames, &run, NULL}};
    enum { COUNT = sizeof measured / sizeof measured[0] };
    if (!stage_enter(example, &options, message))
        return false;
    const bool done = measure_rounds(measured, COUNT, ROUNDS);
    if (done) {
        printf("%-32s %4dx%-4d", example->name, canvas->width, canvas->height);
        for (int i = 0; i < 3; i++)
            printf(" %6.2f", 1e3 * measure_summary(measured[i].seconds, ROUNDS).median / FRAMES);
        const Summary ratio = frame_ratio(&measured[0], &measured[1], &measured[2]);
        const Summary again = measure_ratio(&measured[3], &measured[2], 1, ROUNDS);
        printf("   %.2f [%.2f, %.2f]   %.2f [%.2f, %.2f]\n", ratio.median, ratio.lower, ratio.upper,
               again.median, again.lower, again.upper);
    }
    measure_finish(measured, COUNT);
    stage_leave(example);
    return done || message_set(message, "%s: measuring failed", example->name);
}

static bool measure_size(int width, int height, Message *message)
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
        done = measure_example(EXAMPLES_SHOWN[i], &canvas, message);
    canvas_close(&canvas);
    return done;
}

int main(void)
{
    Message message = {0};
    void *window;
    const char *platform;
    if (!CANVAS_WINDOW.open(&window, &(CanvasOptions){.width = 1, .height = 1}, &platform,
                            &message))
        return options_fail("window_benchmark", &message, 77);
    CANVAS_WINDOW.close(window);
    measure_print_machine();
    printf("%s\n%-42s %20s   over both, at most %.1f    the same again\n", platform, "milliseconds",
           "headless  copy window", BOUND);
    for (int i = 0; i < SIZE_COUNT; i++)
        if (!measure_size(SIZES[i][0], SIZES[i][1], &message))
            return options_fail("window_benchmark", &message, EXIT_FAILED);
    return 0;
}
