/* Of two costs, operations and error, neither is worth more: a result is efficient if no other has
 * less of one and no more of the other, compared pair by pair. */
#include "labs/class/class_report.h"

#include "base/memory.h"
#include "study/report/report_gnuplot.h"

#include <stdlib.h>

bool pareto_front_has(const ClassStore *store, const ClassResult *result)
{
    const VerdictCost *cost = &result->verdict.cost;
    if (!cost->known)
        return false;
    for (int i = 0; i < store->count; i++) {
        const VerdictCost *other = &store->results[i].verdict.cost;
        if (other->known && other->error <= cost->error && other->operations <= cost->operations &&
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

/* The efficient submissions or the others, the cheapest first. */
static void set_points(TemplateValues *plot, const ClassStore *store, bool efficient)
{
    int count = 0;
    TemplateValues *points = NULL;
    const VerdictCost **costs = memory_new((size_t)store->count, sizeof *costs);
    for (int i = 0; i < store->count; i++)
        if (store->results[i].verdict.cost.known &&
            pareto_front_has(store, &store->results[i]) == efficient)
            costs[count++] = &store->results[i].verdict.cost;
    qsort(costs, (size_t)count, sizeof *costs, by_operations);
    for (int i = 0; i < count; i++) {
        points = points ? points : template_add(plot, efficient ? "front" : "others");
        TemplateValues *point = template_add(points, "point");
        template_set(point, "operations", "%.9g", costs[i]->operations_ratio);
        template_set(point, "error", "%.9g", costs[i]->error);
    }
    if (points && !efficient)
        template_set(points, "color", "%s", GNUPLOT_PALETTE[5]);
    free(costs);
}

bool pareto_front_draw(const ClassStore *store, bool *drawn, Message *message)
{
    *drawn = false;
    for (int i = 0; i < store->count && !*drawn; i++)
        *drawn = store->results[i].verdict.cost.known;
    if (!*drawn)
        return true;
    TemplateValues *plot = template_values();
    template_set(plot, "color", "%s", GNUPLOT_PALETTE[1]);
    set_points(plot, store, false);
    set_points(plot, store, true);
    return gnuplot_draw("examples/labs/class/front.gp", plot, store->folder, "front", message);
}
