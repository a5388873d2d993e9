#include "benchmark/measure.h"

#include "base/clock.h"
#include "base/progress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool markdown, brief, processor;

void measure_begin(int *argc, char *argv[])
{
    int kept = 1;
    for (int i = 1; i < *argc; i++) {
        if (strcmp(argv[i], "--markdown") == 0) {
            markdown = true;
        } else if (strcmp(argv[i], "--short") == 0) {
            brief = true;
        } else if (strcmp(argv[i], "--processor") == 0) {
            processor = true;
        } else if (strncmp(argv[i], "--", 2) == 0) {
            fprintf(stderr, "%s: no such option; there are --markdown, --processor and --short\n",
                    argv[i]);
            exit(2);
        } else {
            argv[kept++] = argv[i];
        }
    }
    *argc = kept;
}

static double now(void)
{
    return processor ? clock_processor() : clock_now();
}

bool measure_rounds(Measured *measured, int count, int rounds)
{
    Progress progress = progress_start("measuring");
    for (int i = 0; i < count; i++) {
        measured[i].seconds = calloc((size_t)rounds, sizeof(double));
        if (!measured[i].seconds)
            return false;
    }
    for (int round = brief ? 0 : -1; round < (brief ? 1 : rounds); round++) {
        for (int i = 0; i < count; i++) {
            const double start = now();
            if (!measured[i].run(measured[i].argument)) {
                progress_end(&progress);
                fprintf(stderr, "%s: failed\n", measured[i].name);
                return false;
            }
            if (round >= 0)
                measured[i].seconds[round] = now() - start;
        }
        progress_update(&progress, round + 1, rounds);
    }
    progress_end(&progress);
    for (int i = 0; i < count && brief; i++)
        for (int round = 1; round < rounds; round++)
            measured[i].seconds[round] = measured[i].seconds[0];
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
    const Summary summary = {.median = clock_median(sorted, count),
                             .lower = clock_quantile(sorted, count, 0.25),
                             .upper = clock_quantile(sorted, count, 0.75)};
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

void measure_print_machine(const char *renderer, const char *version)
{
    char driver[256];
    snprintf(driver, sizeof driver, "%s; %s", renderer ? renderer : "", version ? version : "");
    table_machine(renderer ? driver : NULL, stdout);
    puts(brief       ? "One round, to see that it works: no measurement."
         : processor ? "Processor time of all threads; medians of interleaved rounds; quartiles in "
                       "brackets."
                     : "Medians of interleaved rounds; quartiles in brackets.");
}

void measure_print_table(const char *title, Table *table)
{
    if (title)
        printf("\n%s\n", title);
    putchar('\n');
    if (!table_close(table, markdown, stdout))
        fprintf(stderr, "not enough memory for a table\n");
}

Cell measure_cell(Summary summary, double scale, int digits)
{
    Cell cell;
    snprintf(cell.text, sizeof cell.text, "%.*f [%.*f, %.*f]", digits, scale * summary.median,
             digits, scale * summary.lower, digits, scale * summary.upper);
    return cell;
}
