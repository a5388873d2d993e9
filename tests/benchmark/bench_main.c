/*
 * The main of every benchmark.
 */
#include "app/options.h"
#include "benchmark/bench.h"

#include <stdlib.h>

Canvas bench_canvas;
char **bench_arguments;

int main(int argc, char *argv[])
{
    Message message = {0};
    const CanvasOptions size = {.width = BENCH.width, .height = BENCH.height};
    bench_begin(&argc, argv);
    bench_arguments = argv + 1;
    if (BENCH.one_thread) /* other programs disturb one thread less than several */
        setenv("LP_NUM_THREADS", "0", 0);
    if (BENCH.no_cache)
        setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    if ((BENCH.width && !canvas_open(&bench_canvas, &size, &message)) ||
        (BENCH.can_run && !BENCH.can_run(&message)))
        return options_fail(BENCH.name, &message, 77);
    bench_machine(BENCH.width ? &bench_canvas : NULL);
    const bool done = BENCH.run(&message);
    if (BENCH.close)
        BENCH.close();
    canvas_close(&bench_canvas);
    bench_remove_folder();
    return done ? 0 : options_fail(BENCH.name, &message, 1);
}
