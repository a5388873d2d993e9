#include "labs/class/class_html.h"

#include "base/clock.h"
#include "labs/class/class_front.h"
#include "labs/class/class_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* The policy lets a page load only its own pictures, even if unescaped text slipped in. */
static const char HEAD[] =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src 'self' "
    "file:; style-src 'unsafe-inline'\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<meta name=\"color-scheme\" content=\"light dark\">\n";

static const char STYLE[] =
    "<style>\n"
    ":root { --back: #fff; --text: #1a1a1a; --dim: #595959; --line: #d0d0d0; --bar: #0072b2;\n"
    "  --good: #00684c; --bad: #a63c00; }\n"
    "@media (prefers-color-scheme: dark) { :root { --back: #16181c; --text: #e8e8e8;\n"
    "  --dim: #a8a8a8; --line: #3c4048; --bar: #56b4e9; --good: #4fd1a5; --bad: #ff9d5c; } }\n"
    "body { background: var(--back); color: var(--text); font: 16px/1.5 system-ui, sans-serif;\n"
    "  margin: 0 auto; max-width: 62rem; padding: 1rem; }\n"
    "h1 { line-height: 1.2; } h2 { margin-top: 2rem; }\n"
    "a { color: var(--bar); }\n"
    "table { border-collapse: collapse; width: 100%; }\n"
    "caption { text-align: left; color: var(--dim); padding-bottom: .3rem; }\n"
    "th, td { text-align: left; vertical-align: top; padding: .3rem .6rem .3rem 0;\n"
    "  border-bottom: 1px solid var(--line); overflow-wrap: anywhere; }\n"
    ".number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }\n"
    ".bar { display: block; height: .8rem; margin-top: .35rem; background: var(--bar); }\n"
    ".bars th, .bars td { border: 0; padding-top: 0; padding-bottom: 0; }\n"
    "thead th { overflow-wrap: normal; }\n"
    "td:last-child, .bars th { min-width: 7.5rem; }\n"
    ".bars td:last-child { width: 60%; }\n"
    ".right, .wrong, .error, .refused, .timeout { color: var(--bad); white-space: nowrap; }\n"
    ".right { color: var(--good); }\n"
    ".points { font-size: 1.4rem; } .dim { color: var(--dim); }\n"
    "img { max-width: 100%; height: auto; image-rendering: pixelated; background: #000; }\n"
    "img.plot { background: #fff; image-rendering: auto; }\n"
    ".wide { overflow-x: auto; }\n"
    ".thumbs { display: grid; grid-template-columns: repeat(auto-fill, minmax(15rem, 1fr));\n"
    "  gap: 1rem; padding: 0; list-style: none; }\n"
    ".thumbs img { width: 100%; display: block; }\n"
    "pre { white-space: pre-wrap; overflow-wrap: anywhere; border: 1px solid var(--line);\n"
    "  padding: .6rem; }\n"
    "@media print { body { max-width: none; } }\n"
    "</style>\n</head>\n<body>\n<main>\n";

static void put_head(FILE *file, const char *title, const char *lab)
{
    MARKUP(file, HEAD, "", "<title>", title, ": ", lab, "</title>\n", "", STYLE);
    MARKUP(file, "<h1>", title, ": ", lab, "</h1>\n");
}

static bool write_page(ClassFile *out, const char *folder, Message *message)
{
    fputs("</main>\n</body>\n</html>\n", out->file);
    return class_file_write(out, folder, "index.html", message);
}

/* The student's page. */

static void put_mistakes(FILE *file, const Verdict *verdict)
{
    if (verdict->mistake_count == 0)
        return;
    fprintf(file, "<h2>%s</h2>\n<ul>\n",
            verdict->mistake_count == 1 ? "The likely mistake"
            : verdict->one_of           ? "Likely mistakes: one of these"
                                        : "Likely mistakes: all of these");
    for (int i = 0; i < verdict->mistake_count; i++) {
        const VerdictMistake *mistake = &verdict->mistakes[i];
        MARKUP(file, "<li><strong>", mistake->name, "</strong>");
        fprintf(file, " <span class=\"dim\">(%.0f%% sure)</span><br>\n", 100 * mistake->sure);
        MARKUP(file, "", mistake->sentence, "<br>\nLook at ", mistake->look, ".</li>\n");
    }
    fputs("</ul>\n", file);
}

static void put_symptoms(FILE *file, const Verdict *verdict)
{
    fputs(verdict->symptom_count ? "<h2>Symptoms</h2>\n<ul>\n" : "", file);
    for (int i = 0; i < verdict->symptom_count; i++)
        MARKUP(file, "<li>", verdict->symptoms[i], "</li>\n");
    fputs(verdict->symptom_count ? "</ul>\n" : "", file);
    if (verdict->details[0])
        MARKUP(file, "<h2>Compiler output</h2>\n<pre>", verdict->details, "</pre>\n");
}

static void put_picture(FILE *file, const Verdict *verdict)
{
    if (verdict->picture[0])
        MARKUP(file, "<h2>The worst scene</h2>\n<figure>\n<img src=\"", verdict->picture,
               "\" alt=\"The worst scene: submitted, right, difference\">\n<figcaption "
               "class=\"dim\">Submitted; right; difference.</figcaption>\n</figure>\n");
}

/* A table's start: `columns` end with NULL, those that begin with "#" hold numbers. */
static void put_columns(FILE *file, const char *caption, const char *const columns[])
{
    fprintf(file, "<div class=\"wide\"><table>\n%s<thead><tr>", caption);
    for (; *columns; columns++)
        fprintf(file, "<th scope=\"col\"%s>%s</th>", **columns == '#' ? " class=\"number\"" : "",
                *columns + (**columns == '#'));
    fputs("</tr></thead>\n<tbody>\n", file);
}

static void put_probes(FILE *file, const Verdict *verdict)
{
    static const char *const columns[] = {"Scene",          "Set",  "#Size",  "#Time",
                                          "#Largest error", "#RMS", "Result", NULL};
    if (verdict->probe_count == 0)
        return;
    fputs("<h2>Scenes</h2>\n", file);
    put_columns(file, "<caption>Errors in steps of 1/255, inside the object.</caption>\n", columns);
    for (int i = 0; i < verdict->probe_count; i++) {
        const VerdictProbe *probe = &verdict->probes[i];
        const double errors[] = {probe->maximum, probe->rms};
        const char *result = probe->passed ? "right" : "wrong";
        MARKUP(file, "<tr><th scope=\"row\">", probe->name, "</th>");
        fprintf(file,
                "<td>%s</td><td class=\"number\">%d&times;%d</td><td class=\"number\">%.3f s</td>",
                probe->known ? "known" : "seed", probe->width, probe->height, probe->seconds);
        for (int j = 0; j < 2; j++)
            if (isfinite(errors[j]))
                fprintf(file, "<td class=\"number\">%.2f</td>", errors[j]);
            else
                fputs("<td class=\"number\">none</td>", file);
        fprintf(file, "<td class=\"%s\">%s</td></tr>\n", result, result);
    }
    fputs("</tbody>\n</table></div>\n", file);
}

static void put_when(FILE *file, const ClassResult *result)
{
    char text[64] = "";
    const time_t when = (time_t)result->when;
    struct tm parts;
    if (gmtime_r(&when, &parts))
        strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &parts);
    fprintf(file, "<p class=\"dim\">Judged on %s with seed %llu.</p>\n", text,
            (unsigned long long)result->verdict.seed);
}

static void put_cost(FILE *file, const VerdictCost *cost)
{
    if (!cost->known)
        return;
    fprintf(file, "<p>Error: %.2f steps. ", cost->error);
    if (cost->operations >= 0)
        fprintf(file, "Operations: %ld, %.3f of the plain program's. ", cost->operations,
                cost->operations_ratio);
    else
        fputs("Operations: not counted. ", file);
    fprintf(file, "Time: %.2f of the plain program's.</p>\n", cost->time_ratio);
}

static bool write_student(const ClassStore *store, const ClassResult *result, Message *message)
{
    ClassFile out;
    char folder[PATH_MAX];
    const Verdict *verdict = &result->verdict;
    if (!class_store_path(store->folder, result->folder, NULL, folder, message) ||
        !class_file_open(&out, message))
        return false;
    put_head(out.file, result->student, result->lab);
    fprintf(out.file,
            "<p class=\"points\"><strong>%g of %d points</strong>, <span class=\"%s\">%s</span>"
            "</p>\n",
            verdict->points, VERDICT_MAX_POINTS, VERDICT_NAMES[verdict->kind],
            VERDICT_NAMES[verdict->kind]);
    MARKUP(out.file, "<p>", verdict->message, "</p>\n");
    put_cost(out.file, &verdict->cost);
    put_mistakes(out.file, verdict);
    put_symptoms(out.file, verdict);
    put_picture(out.file, verdict);
    put_probes(out.file, verdict);
    put_when(out.file, result);
    return write_page(&out, folder, message);
}

/* The class's page. */

static double median(const ClassStore *store)
{
    double middle = 0;
    double *points = calloc((size_t)store->count + 1, sizeof *points);
    for (int i = 0; points && i < store->count; i++)
        points[i] = store->results[i].verdict.points;
    if (points && store->count > 0)
        middle = clock_median(points, store->count);
    free(points);
    return middle;
}

static void put_summary(FILE *file, const ClassStore *store)
{
    int kinds[VERDICT_TIMEOUT + 1] = {0};
    double sum = 0;
    for (int i = 0; i < store->count; i++) {
        kinds[store->results[i].verdict.kind]++;
        sum += store->results[i].verdict.points;
    }
    fprintf(file,
            "<p>%d submissions: %d right, %d wrong, %d with errors, %d refused, %d timed out. "
            "Points: mean %.1f, median %.1f of %d.</p>\n",
            store->count, kinds[VERDICT_RIGHT], kinds[VERDICT_WRONG], kinds[VERDICT_ERROR],
            kinds[VERDICT_REFUSED], kinds[VERDICT_TIMEOUT], store->count ? sum / store->count : 0,
            median(store), VERDICT_MAX_POINTS);
    fputs("<p class=\"dim\">The same as a table: <a href=\"class.csv\">class.csv</a>, "
          "<a href=\"class.json\">class.json</a>, <a href=\"junit.xml\">junit.xml</a>.</p>\n",
          file);
}

/* A bar chart as a table, starting with its caption, ending with the last row. */
static void put_bars(FILE *file, const char *title, const char *caption)
{
    fprintf(file, "<h2>%s</h2>\n<table class=\"bars\">\n<caption>%s</caption>\n<tbody>\n", title,
            caption);
}

static void put_bar(FILE *file, const char *name, int count, int max)
{
    MARKUP(file, "<tr><th scope=\"row\">", name, "</th>");
    fprintf(file,
            "<td class=\"number\">%d</td><td><span class=\"bar\" style=\"width:%d%%\"></span>"
            "</td></tr>\n",
            count, max > 0 ? 100 * count / max : 0);
}

static void put_points(FILE *file, const ClassStore *store)
{
    int counts[VERDICT_MAX_POINTS + 1] = {0}, max = 0;
    for (int i = 0; i < store->count; i++) {
        const int points = (int)store->results[i].verdict.points;
        if (++counts[points] > max)
            max = counts[points];
    }
    put_bars(file, "Points", "Number of students, half points rounded down.");
    for (int i = VERDICT_MAX_POINTS; i >= 0; i--) {
        char name[16];
        snprintf(name, sizeof name, "%d", i);
        put_bar(file, name, counts[i], max);
    }
    fputs("</tbody>\n</table>\n", file);
}

static void put_class_mistakes(FILE *file, const ClassStore *store)
{
    int count;
    ClassMistake *mistakes = class_mistakes(store, &count);
    if (count > 0)
        put_bars(file, "Mistakes", "Number of students, the most frequent mistake first.");
    for (int i = 0; i < count; i++)
        put_bar(file, mistakes[i].name, mistakes[i].count, mistakes[0].count);
    fputs(count > 0 ? "</tbody>\n</table>\n" : "", file);
    free(mistakes);
}

/* Folder names need no escape in a URL. */
static void put_link(FILE *file, const ClassResult *result)
{
    MARKUP(file, "<a href=\"students/", result->folder, "/index.html\"><bdi>", result->student,
           "</bdi></a>");
    if (result->id[0] && strcmp(result->id, result->student) != 0)
        MARKUP(file, " <span class=\"dim\">", result->id, "</span>");
    if (result->attempt > 1)
        fprintf(file, " <span class=\"dim\">attempt&nbsp;%d</span>", result->attempt);
}

static void put_students(FILE *file, const ClassStore *store)
{
    static const char *const columns[] = {"Student", "#Points", "Verdict", "What is wrong", NULL};
    fputs("<h2>Students</h2>\n", file);
    put_columns(file, "", columns);
    for (int i = 0; i < store->count; i++) {
        const Verdict *verdict = &store->results[i].verdict;
        const char *kind = VERDICT_NAMES[verdict->kind];
        fputs("<tr><th scope=\"row\">", file);
        put_link(file, &store->results[i]);
        fprintf(file, "</th><td class=\"number\">%g</td><td class=\"%s\">%s</td><td>",
                verdict->points, kind, kind);
        fputs(verdict->one_of ? "one of: " : "", file);
        for (int j = 0; j < verdict->mistake_count; j++)
            MARKUP(file, j ? "; " : "", verdict->mistakes[j].name);
        if (verdict->mistake_count == 0 && verdict->kind != VERDICT_RIGHT)
            class_table_markup(file, verdict->message);
        fputs("</td></tr>\n", file);
    }
    fputs("</tbody>\n</table></div>\n", file);
}

static void put_thumbnails(FILE *file, const ClassStore *store)
{
    int count = 0;
    for (int i = 0; i < store->count; i++)
        count += store->results[i].verdict.picture[0] != '\0';
    if (count == 0)
        return;
    fputs("<h2>Pictures</h2>\n<p class=\"dim\">Each student's worst scene: submitted, right, "
          "difference.</p>\n<ul class=\"thumbs\">\n",
          file);
    for (int i = 0; i < store->count; i++) {
        const ClassResult *result = &store->results[i];
        if (!result->verdict.picture[0])
            continue;
        MARKUP(file, "<li><img loading=\"lazy\" src=\"students/", result->folder, "/",
               result->verdict.picture, "\" alt=\"The worst scene of ", result->student, "\">");
        put_link(file, result);
        fprintf(file, ", %g points</li>\n", result->verdict.points);
    }
    fputs("</ul>\n", file);
}

static void put_front(FILE *file, const ClassStore *store)
{
    fputs("<h2>The efficient front</h2>\n<figure><img class=\"plot\" src=\"front.svg\" alt=\"Each "
          "submission by its operations and its error\">\n<figcaption>Efficient: ",
          file);
    for (int i = 0, count = 0; i < store->count; i++) {
        if (!class_front_has(store, &store->results[i]))
            continue;
        fputs(count++ ? ", " : "", file);
        put_link(file, &store->results[i]);
        const VerdictCost *cost = &store->results[i].verdict.cost;
        fprintf(file, " (%.3f of the operations, %.2f of the time, %.2f steps)",
                cost->operations_ratio, cost->time_ratio, cost->error);
    }
    fputs(".</figcaption></figure>\n", file);
}

bool class_html_write(const ClassStore *store, bool front, Message *message)
{
    ClassFile out;
    const char *lab = store->count ? store->results[0].lab : "";
    for (int i = 0; i < store->count; i++)
        if (!write_student(store, &store->results[i], message))
            return false;
    if (!class_file_open(&out, message))
        return false;
    put_head(out.file, "The class", lab);
    put_summary(out.file, store);
    if (front)
        put_front(out.file, store);
    put_points(out.file, store);
    put_class_mistakes(out.file, store);
    put_students(out.file, store);
    put_thumbnails(out.file, store);
    return write_page(&out, store->folder, message);
}
