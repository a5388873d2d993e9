/* Of two costs, operations and error, neither is worth more: a result is efficient if no other has
 * less of one and no more of the other, compared pair by pair. */
#include "labs/class/class_report.h"

#include "base/memory.h"
#include "study/report/report_gnuplot.h"

#include <stdlib.h>

static bool counted(const ClassResult *result)
{
    return result->verdict.cost.known && result->verdict.cost.operations >= 0;
}

bool pareto_front_has(const ClassStore *store, const ClassResult *result)
{
    const VerdictCost *cost = &result->verdict.cost;
    if (!counted(result))
        return false;
    for (int i = 0; i < store->count; i++) {
        const VerdictCost *other = &store->results[i].verdict.cost;
        if (counted(&store->results[i]) && other->error <= cost->error &&
            other->operations <= cost->operations &&
            (other->error < cost->error || other->operations < cost->operations))
            return false;
    }
    return true;
}

static int by_operations(const void *a, const void *b)
{
    const VerdictCost *const *first = a, *const *second = b;
    return ((*first)->operations > (*second)->operations) -
           ((*first)->operations < (*second)->operations);
}

/* Writes lines "OPERATIONS ERROR", the cheapest first, of the efficient submissions or the others.
 */
static int put_points(const ClassStore *store, bool efficient, FILE *file)
{
    int count = 0;
    const VerdictCost **costs = memory_new((size_t)store->count, sizeof *costs);
    for (int i = 0; i < store->count; i++)
        if (counted(&store->results[i]) && pareto_front_has(store, &store->results[i]) == efficient)
            costs[count++] = &store->results[i].verdict.cost;
    qsort(costs, (size_t)count, sizeof *costs, by_operations);
    for (int i = 0; i < count; i++)
        fprintf(file, "%.9g %.9g\n", costs[i]->operations_ratio, costs[i]->error);
    free(costs);
    return count;
}

static void put_data(const ClassStore *store, FILE *script)
{
    fputs("$others << END\n", script);
    const int others = put_points(store, false, script);
    fputs("END\n$front << END\n", script);
    put_points(store, true, script);
    fputs("END\n", script);
    /* An empty block is an error to gnuplot. */
    fputs("plot ", script);
    if (others)
        fprintf(script, "$others using 1:2 with points pt 7 lc rgb '%s' title 'others', ",
                GNUPLOT_PALETTE[5]);
    fprintf(script,
            "$front using 1:2 with steps lw 2 lc rgb '%s' notitle, "
            "$front using 1:2 with points pt 5 lc rgb '%s' title 'efficient: no other is both "
            "cheaper and more exact'\n",
            GNUPLOT_PALETTE[1], GNUPLOT_PALETTE[1]);
}

bool pareto_front_draw(const ClassStore *store, bool *drawn, Message *message)
{
    OutputText script;
    *drawn = false;
    for (int i = 0; i < store->count && !*drawn; i++)
        *drawn = counted(&store->results[i]);
    if (!*drawn)
        return true;
    output_text_open(&script);
    FILE *file = script.file;
    fputs("set title 'Cost and error of the submissions'\n"
          "set xlabel 'operations per picture, relative to the plain program'\n"
          "set ylabel 'largest error, steps of 1/255'\n"
          "set xrange [0:*]\nset yrange [0:*]\nset key top right\n"
          "set grid lc rgb '#dddddd'\nset offsets graph 0.02, graph 0.05, graph 0.1, 0\n"
          "set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead dt 2 lc rgb '#000000'\n",
          file);
    put_data(store, file);
    return gnuplot_finish(&script, store->folder, "front", message);
}
