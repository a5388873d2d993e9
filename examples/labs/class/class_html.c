/* What class.html needs of the results, as values; an empty one leaves its part of a page out. */
#include "labs/class/class_report.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/output.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static bool write_page(TemplateValues *page, const char *folder, Message *message)
{
    char path[PATH_MAX];
    const bool done = output_path(path, folder, "index.html", message) &&
                      template_write("examples/labs/class/class.html", page, path, message);
    template_close(page);
    return done;
}

static TemplateValues *begin_page(const char *title, const char *lab)
{
    TemplateValues *page = template_values();
    template_set(page, "title", "%s", title);
    template_set(page, "lab", "%s", lab);
    return page;
}

/* The student's page. */

static void set_cost(TemplateValues *page, const VerdictCost *cost)
{
    if (!cost->known)
        return;
    TemplateValues *values = template_add(page, "cost");
    template_set(values, "error", "%.2f", cost->error);
    template_set(values, "time", "%.2f", cost->time_ratio);
    template_set(values, "operations", "%.0f", cost->operations);
    template_set(values, "ratio", "%.3f", cost->operations_ratio);
}

static void set_mistakes(TemplateValues *page, const Verdict *verdict)
{
    template_set(page, "mistakes", "%s",
                 verdict->mistake_count == 0   ? ""
                 : verdict->mistake_count == 1 ? "The likely mistake"
                                               : "Likely mistakes: all of these");
    for (int i = 0; i < verdict->mistake_count; i++) {
        const VerdictMistake *mistake = &verdict->mistakes[i];
        TemplateValues *values = template_add(page, "mistake");
        template_set(values, "name", "%s", mistake->name);
        template_set(values, "sure", "%.0f", 100 * mistake->sure);
        template_set(values, "sentence", "%s", mistake->sentence);
        template_set(values, "look", "%s", mistake->look);
    }
    template_set(page, "symptoms", "%s", verdict->symptom_count ? "Symptoms" : "");
    for (int i = 0; i < verdict->symptom_count; i++)
        template_set(template_add(page, "symptom"), "text", "%s", verdict->symptoms[i]);
}

static void set_error(TemplateValues *values, const char *name, double error)
{
    if (isfinite(error))
        template_set(values, name, "%.2f", error);
    else
        template_set(values, name, "none");
}

static void set_scenes(TemplateValues *page, const Verdict *verdict)
{
    template_set(page, "scenes", "%s", verdict->probe_count ? "Scenes" : "");
    for (int i = 0; i < verdict->probe_count; i++) {
        const VerdictProbe *probe = &verdict->probes[i];
        TemplateValues *values = template_add(page, "scene");
        template_set(values, "name", "%s", probe->name);
        template_set(values, "set", "%s", probe->known ? "known" : "seed");
        template_set(values, "width", "%d", probe->width);
        template_set(values, "height", "%d", probe->height);
        template_set(values, "seconds", "%.3f", probe->seconds);
        set_error(values, "maximum", probe->maximum);
        set_error(values, "rms", probe->rms);
        template_set(values, "result", "%s", probe->passed ? "right" : "wrong");
    }
}

static void set_verdict(TemplateValues *values, const Verdict *verdict)
{
    template_set(values, "points", "%g", verdict->points);
    template_set(values, "most", "%g", verdict->most);
    template_set(values, "verdict", "%s", VERDICT_NAMES[verdict->kind]);
    template_set(values, "picture", "%s", verdict->picture);
}

static bool write_student(const ClassStore *store, const ClassResult *result, Message *message)
{
    char folder[PATH_MAX], when[64] = "";
    const Verdict *verdict = &result->verdict;
    const time_t judged = (time_t)result->when;
    struct tm parts;
    if (!class_store_path(store->folder, result->folder, NULL, folder, message))
        return false;
    if (gmtime_r(&judged, &parts))
        strftime(when, sizeof when, "%Y-%m-%d %H:%M UTC", &parts);
    TemplateValues *page = begin_page(result->student, result->lab);
    TemplateValues *values = template_add(page, "student");
    set_verdict(values, verdict);
    template_set(values, "message", "%s", verdict->message);
    template_set(values, "details", "%s", verdict->details);
    template_set(values, "when", "%s", when);
    template_set(values, "seed", "%llu", (unsigned long long)verdict->seed);
    for (int i = 0; i < verdict->part_count; i++) {
        const VerdictPart *part = &verdict->parts[i];
        TemplateValues *row = template_add(values, "part");
        template_set(row, "name", "%s", part->name);
        template_set(row, "state", "%s", PART_NAMES[part->state]);
        template_set(row, "points", "%g", part->points);
        template_set(row, "most", "%g", part->most);
    }
    set_cost(values, &verdict->cost);
    set_mistakes(values, verdict);
    set_scenes(values, verdict);
    return write_page(page, folder, message);
}

/* The class's page. */

static double median(const ClassStore *store)
{
    double *points = memory_new((size_t)store->count, sizeof *points);
    for (int i = 0; i < store->count; i++)
        points[i] = store->results[i].verdict.points;
    const double middle = store->count > 0 ? clock_median(points, store->count) : 0;
    free(points);
    return middle;
}

static double most_of(const ClassStore *store)
{
    double most = 1;
    for (int i = 0; i < store->count; i++)
        most = fmax(most, store->results[i].verdict.most);
    return most;
}

static void set_summary(TemplateValues *page, const ClassStore *store)
{
    int kinds[VERDICT_TIMEOUT + 1] = {0};
    double sum = 0;
    for (int i = 0; i < store->count; i++) {
        kinds[store->results[i].verdict.kind]++;
        sum += store->results[i].verdict.points;
    }
    template_set(page, "count", "%d", store->count);
    for (int kind = 0; kind <= VERDICT_TIMEOUT; kind++)
        template_set(page, VERDICT_NAMES[kind], "%d", kinds[kind]);
    template_set(page, "mean", "%.1f", store->count ? sum / store->count : 0);
    template_set(page, "median", "%.1f", median(store));
    template_set(page, "most", "%g", most_of(store));
}

/* A bar chart. */
static TemplateValues *add_bars(TemplateValues *page, const char *heading, const char *caption)
{
    TemplateValues *bars = template_add(page, "bars");
    template_set(bars, "heading", "%s", heading);
    template_set(bars, "caption", "%s", caption);
    return bars;
}

static void add_bar(TemplateValues *bars, const char *name, int count, int max)
{
    TemplateValues *bar = template_add(bars, "bar");
    template_set(bar, "name", "%s", name);
    template_set(bar, "count", "%d", count);
    template_set(bar, "width", "%d", max > 0 ? 100 * count / max : 0);
}

static void set_parts(TemplateValues *page, const ClassStore *store)
{
    const Verdict *first = store->count ? &store->results[0].verdict : NULL;
    const bool any = first && first->part_count > 0 && first->parts[0].state != PART_LATE;
    TemplateValues *bars =
        any ? add_bars(page, "Parts", "Number of students who have it right.") : NULL;
    for (int k = 0; any && k < first->part_count && first->parts[k].state != PART_LATE; k++) {
        int right = 0;
        for (int i = 0; i < store->count; i++)
            right += store->results[i].verdict.parts[k].state == PART_RIGHT;
        add_bar(bars, first->parts[k].name, right, store->count);
    }
}

static void set_bars(TemplateValues *page, const ClassStore *store)
{
    int counts[VERDICT_POINTS_END + 1] = {0}, max = 0, count;
    const int most = (int)most_of(store), step = (most + 19) / 20; /* at most 20 bars */
    for (int i = 0; i < store->count; i++) {
        const int points = (int)store->results[i].verdict.points / step * step;
        if (++counts[points] > max)
            max = counts[points];
    }
    TemplateValues *points =
        add_bars(page, "Points", "Number of students, half points rounded down.");
    for (int i = most / step * step; i >= 0; i -= step) {
        char name[16];
        snprintf(name, sizeof name, "%d", i);
        add_bar(points, name, counts[i], max);
    }
    ClassMistake *made = class_mistakes(store, &count);
    TemplateValues *mistakes =
        count > 0
            ? add_bars(page, "Mistakes", "Number of students, the most frequent mistake first.")
            : NULL;
    for (int i = 0; i < count; i++)
        add_bar(mistakes, made[i].name, made[i].count, made[0].count);
    free(made);
    set_parts(page, store);
}

/* A result in a list of them. */
static TemplateValues *add_result(TemplateValues *page, const char *list, const ClassResult *result)
{
    TemplateValues *values = template_add(page, list);
    template_set(values, "folder", "%s", result->folder); /* needs no escape in a URL */
    template_set(values, "name", "%s", result->student);
    template_set(values, "id", "%s", strcmp(result->id, result->student) != 0 ? result->id : "");
    if (result->attempt > 1)
        template_set(values, "attempt", "%d", result->attempt);
    set_verdict(values, &result->verdict);
    return values;
}

static void set_front(TemplateValues *page, const ClassStore *store)
{
    TemplateValues *front = template_add(page, "front");
    for (int i = 0, count = 0; i < store->count; i++) {
        const VerdictCost *cost = &store->results[i].verdict.cost;
        if (!pareto_front_has(store, &store->results[i]))
            continue;
        TemplateValues *values = add_result(front, "efficient", &store->results[i]);
        template_set(values, "separator", "%s", count++ ? ", " : "");
        template_set(values, "ratio", "%.3f", cost->operations_ratio);
        template_set(values, "time", "%.2f", cost->time_ratio);
        template_set(values, "error", "%.2f", cost->error);
    }
}

static void set_results(TemplateValues *page, const ClassStore *store)
{
    bool pictures = false;
    for (int i = 0; i < store->count; i++) {
        const ClassResult *result = &store->results[i];
        const Verdict *verdict = &result->verdict;
        char names[CLASS_NAMES_SIZE];
        class_mistake_names(verdict, names);
        const bool unnamed = verdict->mistake_count == 0 && verdict->kind != VERDICT_RIGHT;
        TemplateValues *values = add_result(page, "result", result);
        template_set(values, "fault", "%s%s", names, unnamed ? verdict->message : "");
        const VerdictPart *last =
            &verdict->parts[verdict->part_count ? verdict->part_count - 1 : 0];
        if (verdict->part_count && last->state == PART_LATE)
            template_set(values, "late", "%s", last->name);
        if (verdict->picture[0])
            add_result(page, "thumbnail", result);
        pictures |= verdict->picture[0] != '\0';
    }
    template_set(page, "pictures", "%s", pictures ? "Pictures" : "");
}

bool class_html_write(const ClassStore *store, bool front, Message *message)
{
    for (int i = 0; i < store->count; i++)
        if (!write_student(store, &store->results[i], message))
            return false;
    TemplateValues *page = begin_page("The class", store->count ? store->results[0].lab : "");
    TemplateValues *values = template_add(page, "class");
    set_summary(values, store);
    if (front)
        set_front(values, store);
    set_bars(values, store);
    class_similar_set(values, store);
    set_results(values, store);
    return write_page(page, store->folder, message);
}
