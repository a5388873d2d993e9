#include "benchmark/bench.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/progress.h"

#include <ftw.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool markdown, brief, processor;
static char folder[] = "/tmp/lighting-benchmark-XXXXXX";
static bool has_folder;

void bench_begin(int *argc, char *argv[])
{
    static const struct {
        const char *name;
        bool *value;
    } options[] = {
        {"--markdown", &markdown}, {"--short", &brief}, {"--processor", &processor}, {"--", NULL}};
    int kept = 1;
    for (int i = 1; i < *argc; i++) {
        int k = 0;
        while (options[k].value && strcmp(argv[i], options[k].name) != 0)
            k++;
        if (options[k].value) {
            *options[k].value = true;
        } else if (strncmp(argv[i], "--", 2) == 0) {
            fprintf(stderr, "%s: no such option; there are --markdown, --processor and --short\n",
                    argv[i]);
            exit(2);
        } else {
            argv[kept++] = argv[i];
        }
    }
    argv[ *argc = kept] = NULL;
}

void bench_machine(const Canvas *canvas)
{
    char driver[256] = "";
    if (canvas)
        snprintf(driver, sizeof driver, "%s; %s", canvas->renderer, canvas->version);
    table_machine(canvas ? driver : NULL, stdout);
    puts(brief       ? "One round, to see that it works: no measurement."
         : processor ? "Processor time of all threads; medians of interleaved rounds; quartiles in "
                       "brackets."
                     : "Medians of interleaved rounds; quartiles in brackets.");
}

const char *bench_folder(Message *message)
{
    has_folder = has_folder || mkdtemp(folder);
    if (!has_folder)
        message_set(message, "%s: cannot be made", folder);
    return has_folder ? folder : NULL;
}

static int remove_entry(const char *path, const struct stat *status, int type, struct FTW *walk)
{
    (void)status, (void)type, (void)walk;
    return remove(path);
}

void bench_remove_folder(void)
{
    if (has_folder)
        nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
}

static double now(void)
{
    return processor ? clock_processor() : clock_now();
}

bool bench_rounds(BenchRun *runs, int count, int rounds, Message *message)
{
    Progress progress = progress_start("measuring");
    bool done = true;
    rounds = brief ? 1 : rounds;
    for (int i = 0; i < count; i++) {
        runs[i].seconds = memory_new((size_t)rounds, sizeof(double));
        runs[i].rounds = rounds;
    }
    for (int round = brief ? 0 : -1; round < rounds && done; round++) {
        for (int i = 0; i < count && done; i++) {
            const double start = now();
            done = runs[i].run(runs[i].argument, message) ||
                   message_set(message, "%s: failed", runs[i].name);
            if (round >= 0)
                runs[i].seconds[round] = now() - start;
        }
        progress_update(&progress, round + 1, rounds);
    }
    progress_end(&progress);
    return done;
}

void bench_finish(BenchRun *runs, int count)
{
    for (int i = 0; i < count; i++)
        free(runs[i].seconds);
}

static double seconds_of(const BenchRun *runs, int number, int round)
{
    return number < 0 ? 0 : runs[number].seconds[round];
}

BenchCell bench_cell(const BenchRun *runs, const BenchColumn *column)
{
    BenchCell cell = {""};
    if (column->scale == 0)
        return cell;
    const int rounds = runs[column->of < 0 ? column->over : column->of].rounds;
    double *values = memory_new((size_t)rounds, sizeof *values);
    for (int i = 0; i < rounds; i++) {
        const double of = column->of < 0 ? 1 : seconds_of(runs, column->of, i);
        const double over = column->over < 0 ? 1 : seconds_of(runs, column->over, i);
        values[i] = column->scale * (of - seconds_of(runs, column->minus, i)) /
                    (over + seconds_of(runs, column->plus, i));
    }
    const int size =
        snprintf(cell.text, sizeof cell.text, "%.*f", column->digits, clock_median(values, rounds));
    if (!column->alone)
        snprintf(cell.text + size, sizeof cell.text - (size_t)size, " [%.*f, %.*f]", column->digits,
                 clock_quantile(values, rounds, 0.25), column->digits,
                 clock_quantile(values, rounds, 0.75));
    free(values);
    return cell;
}

void bench_row(Table *table, const BenchRun *runs, const BenchColumn *columns, int count,
               const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    size_t used = (size_t)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (int i = 0; i < count && used < sizeof text; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "|%s",
                                 bench_cell(runs, &columns[i]).text);
    table_row(table, "%s", text);
}

bool bench_rows(const BenchRows *rows, Table *table, Message *message)
{
    const int count = rows->rows * rows->runs_each;
    const bool done = bench_rounds(rows->runs, count, rows->rounds, message);
    for (int i = 0; i < count && done; i += rows->runs_each)
        bench_row(table, &rows->runs[i], rows->columns, rows->column_count, "%s",
                  rows->runs[i].name);
    return done;
}

void bench_print(const char *title, Table *table)
{
    if (title)
        printf("\n%s\n", title);
    putchar('\n');
    table_close(table, markdown, stdout);
}
