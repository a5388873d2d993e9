#include "measure.h"

#include "progress.h"
#include "statistics.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool measure_rounds(Measured *measured, int count, int rounds)
{
    Progress progress = progress_start("measuring");
    for (int i = 0; i < count; i++) {
        measured[i].seconds = calloc((size_t)rounds, sizeof(double));
        if (!measured[i].seconds)
            return false;
    }
    for (int round = -1; round < rounds; round++) {
        for (int i = 0; i < count; i++) {
            const double start = progress_now();
            if (!measured[i].run(measured[i].argument)) {
                progress_end(&progress);
                fprintf(stderr, "%s: failed\n", measured[i].name);
                return false;
            }
            if (round >= 0)
                measured[i].seconds[round] = progress_now() - start;
        }
        progress_update(&progress, round + 1, rounds);
    }
    progress_end(&progress);
    return true;
}

void measure_finish(Measured *measured, int count)
{
    for (int i = 0; i < count; i++)
        free(measured[i].seconds);
}

Summary measure_summary(const double *values, int count)
{
    double *sorted = malloc((size_t)count * sizeof *sorted);
    if (!sorted)
        return (Summary){0};
    memcpy(sorted, values, (size_t)count * sizeof *sorted);
    const Summary summary = {.median = statistics_quantile(sorted, count, 0.5),
                             .lower = statistics_quantile(sorted, count, 0.25),
                             .upper = statistics_quantile(sorted, count, 0.75)};
    free(sorted);
    return summary;
}

Summary measure_ratio(const Measured *a, const Measured *b, double scale, int rounds)
{
    double *ratios = malloc((size_t)rounds * sizeof *ratios);
    if (!ratios)
        return (Summary){0};
    for (int i = 0; i < rounds; i++)
        ratios[i] = scale * a->seconds[i] / b->seconds[i];
    const Summary summary = measure_summary(ratios, rounds);
    free(ratios);
    return summary;
}

void measure_print_machine(void)
{
    char line[256], model[200] = "unknown processor";
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (file && fgets(line, sizeof line, file))
        if (sscanf(line, "model name : %199[^\n]", model) == 1)
            break;
    if (file)
        fclose(file);
    printf("%s, %ld cores. Medians of interleaved rounds; in brackets the quartiles.\n", model,
           sysconf(_SC_NPROCESSORS_ONLN));
}
