/*
 * web_frames: frames of the pages' module (examples/web/page.h), natively, for web_benchmark.py.
 * Prints the machine; then, for each line "START COUNT NAME ARGUMENTS..." of standard input, the
 * milliseconds of a frame, drawn and read back.
 */
#include "base/clock.h"
#include "benchmark/bench.h"
#include "core/canvas.h"
#include "web/page.h"

#include <stdio.h>
#include <string.h>

static bool print_machine(void)
{
    const CanvasOptions size = {.width = 16, .height = 16};
    Message message = {0};
    Canvas canvas;
    if (!canvas_open(&canvas, &size, &message)) {
        fprintf(stderr, "web_frames: %s\n", message.text);
        return false;
    }
    bench_machine(&canvas);
    canvas_close(&canvas);
    return true;
}

/* The first frame, which may compile, is not timed. */
static double frame_time(const char *lines, double start, int count)
{
    if (page_open(lines) != 0 || !page_draw(start, 0, 0, 1, 0))
        return -1;
    const double begin = clock_now();
    for (int i = 0; i < count; i++)
        if (!page_draw(start + 0.1 * i, 0, 0, 1, 0))
            return -1;
    return 1e3 * (clock_now() - begin) / count;
}

int main(int argc, char *argv[])
{
    char line[1024];
    double start;
    int count, at;
    bench_begin(&argc, argv);
    if (!print_machine())
        return 77;
    puts("");
    fflush(stdout);
    while (fgets(line, sizeof line, stdin)) {
        line[strcspn(line, "\n")] = '\0';
        if (sscanf(line, "%lf %d %n", &start, &count, &at) != 2 || count < 1)
            return 2;
        for (char *space = line + at; (space = strchr(space, ' '));)
            *space = '\n';
        const double time = frame_time(line + at, start, count);
        if (time < 0) {
            fprintf(stderr, "web_frames: %s\n", page_message());
            return 1;
        }
        printf("%.6f\n", time);
        fflush(stdout);
    }
    page_close();
    return 0;
}
