#include "class_html.h"

#include "class_front.h"
#include "class_table.h"
#include "statistics.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

/* No page loads anything but its own pictures, whatever text may have slipped into it. */
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
    ".bars td:last-child { width: 60%; }\n"
    ".right { color: var(--good); } .wrong, .error, .refused, .timeout { color: var(--bad); }\n"
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

static void put(FILE *file, const char *text)
{
    class_table_markup(file, text);
}

static void put_head(FILE *file, const char *title, const char *lab)
{
    fputs(HEAD, file);
    fputs("<title>", file);
    put(file, title);
    fputs(": ", file);
    put(file, lab);
    fputs("</title>\n", file);
    fputs(STYLE, file);
}

/* The student's page. */

static void put_mistakes(FILE *file, const Verdict *verdict)
{
    if (verdict->mistake_count == 0)
        return;
    fprintf(file, "<h2>The likely mistake</h2>\n%s<ul>\n",
            verdict->mistake_count == 1 ? ""
            : verdict->one_of           ? "<p>One of these, which look alike in every scene:</p>\n"
                                        : "<p>All of these:</p>\n");
    for (int i = 0; i < verdict->mistake_count; i++) {
        const VerdictMistake *mistake = &verdict->mistakes[i];
        fputs("<li><strong>", file);
        put(file, mistake->name);
        fprintf(file, "</strong> <span class=\"dim\">(%.0f%% sure)</span><br>\n",
                100 * mistake->sure);
        put(file, mistake->sentence);
        fputs("<br>\nLook at ", file);
        put(file, mistake->look);
        fputs(".</li>\n", file);
    }
    fputs("</ul>\n", file);
}

static void put_symptoms(FILE *file, const Verdict *verdict)
{
    if (verdict->symptom_count > 0) {
        fputs("<h2>What is seen</h2>\n<ul>\n", file);
        for (int i = 0; i < verdict->symptom_count; i++) {
            fputs("<li>", file);
            put(file, verdict->symptoms[i]);
            fputs("</li>\n", file);
        }
        fputs("</ul>\n", file);
    }
    if (verdict->details[0]) {
        fputs("<h2>What the driver says</h2>\n<pre>", file);
        put(file, verdict->details);
        fputs("</pre>\n", file);
    }
}

static void put_picture(FILE *file, const Verdict *verdict)
{
    if (!verdict->picture[0])
        return;
    fputs("<h2>The worst scene</h2>\n<figure>\n<img src=\"", file);
    put(file, verdict->picture);
    fputs("\" alt=\"The worst scene: as submitted, as it should be, and the difference\">\n"
          "<figcaption class=\"dim\">As submitted; as it should be; the "
          "difference.</figcaption>\n</figure>\n",
          file);
}

static void put_probes(FILE *file, const Verdict *verdict)
{
    if (verdict->probe_count == 0)
        return;
    fputs("<h2>Scenes</h2>\n<div class=\"wide\"><table>\n"
          "<caption>Errors in steps of 1/255, inside the object.</caption>\n"
          "<thead><tr><th scope=\"col\">Scene</th><th scope=\"col\">Set</th>"
          "<th scope=\"col\" class=\"number\">Size</th><th scope=\"col\" class=\"number\">Time"
          "</th><th scope=\"col\" class=\"number\">Largest error</th><th scope=\"col\" "
          "class=\"number\">RMS</th><th scope=\"col\">Result</th></tr></thead>\n<tbody>\n",
          file);
    for (int i = 0; i < verdict->probe_count; i++) {
        const VerdictProbe *probe = &verdict->probes[i];
        fputs("<tr><th scope=\"row\">", file);
        put(file, probe->name);
        fprintf(file,
                "</th><td>%s</td><td class=\"number\">%d&times;%d</td><td class=\"number\">%.3f s"
                "</td>",
                probe->known ? "known" : "of a seed", probe->width, probe->height, probe->seconds);
        for (int j = 0; j < 2; j++) {
            const double error = j ? probe->rms : probe->maximum;
            if (isfinite(error))
                fprintf(file, "<td class=\"number\">%.2f</td>", error);
            else
                fputs("<td class=\"number\">none</td>", file);
        }
        fprintf(file, "<td class=\"%s\">%s</td></tr>\n", probe->passed ? "right" : "wrong",
                probe->passed ? "right" : "wrong");
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
    fputs("<h1>", out.file);
    put(out.file, result->student);
    fputs(": ", out.file);
    put(out.file, result->lab);
    fprintf(out.file,
            "</h1>\n<p class=\"points\"><strong>%g of %d points</strong>, <span "
            "class=\"%s\">%s</span></p>\n<p>",
            verdict->points, VERDICT_MOST_POINTS, VERDICT_NAMES[verdict->kind],
            VERDICT_NAMES[verdict->kind]);
    put(out.file, verdict->message);
    fputs("</p>\n", out.file);
    put_cost(out.file, &verdict->cost);
    put_mistakes(out.file, verdict);
    put_symptoms(out.file, verdict);
    put_picture(out.file, verdict);
    put_probes(out.file, verdict);
    put_when(out.file, result);
    fputs("</main>\n</body>\n</html>\n", out.file);
    return class_file_write(&out, folder, "index.html", message);
}

/* The class's page. */

static double median(const ClassStore *store)
{
    double middle = 0;
    double *points = calloc((size_t)store->count + 1, sizeof *points);
    for (int i = 0; points && i < store->count; i++)
        points[i] = store->results[i].verdict.points;
    if (points && store->count > 0)
        middle = statistics_quantile(points, store->count, 0.5);
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
            "<p>%d submissions: %d right, %d wrong, %d with errors, %d refused, %d that did not "
            "end. Points: mean %.1f, median %.1f of %d.</p>\n",
            store->count, kinds[VERDICT_RIGHT], kinds[VERDICT_WRONG], kinds[VERDICT_ERROR],
            kinds[VERDICT_REFUSED], kinds[VERDICT_TIMEOUT], store->count ? sum / store->count : 0,
            median(store), VERDICT_MOST_POINTS);
    fputs("<p class=\"dim\">The same as a table: <a href=\"class.csv\">class.csv</a>, "
          "<a href=\"class.json\">class.json</a>, <a href=\"junit.xml\">junit.xml</a>.</p>\n",
          file);
}

/* One row of a bar chart that is a table. */
static void put_bar(FILE *file, const char *name, int count, int most)
{
    fputs("<tr><th scope=\"row\">", file);
    put(file, name);
    fprintf(file,
            "</th><td class=\"number\">%d</td><td><span class=\"bar\" style=\"width:%d%%\">"
            "</span></td></tr>\n",
            count, most > 0 ? 100 * count / most : 0);
}

static void put_points(FILE *file, const ClassStore *store)
{
    int counts[VERDICT_MOST_POINTS + 1] = {0}, most = 0;
    for (int i = 0; i < store->count; i++) {
        const int points = (int)store->results[i].verdict.points;
        if (++counts[points] > most)
            most = counts[points];
    }
    fputs("<h2>Points</h2>\n<table class=\"bars\">\n<caption>How many students have so many "
          "points, halves rounded down.</caption>\n<tbody>\n",
          file);
    for (int i = VERDICT_MOST_POINTS; i >= 0; i--) {
        char name[16];
        snprintf(name, sizeof name, "%d", i);
        put_bar(file, name, counts[i], most);
    }
    fputs("</tbody>\n</table>\n", file);
}

static void put_class_mistakes(FILE *file, const ClassStore *store)
{
    int count;
    ClassMistake *mistakes = class_mistakes(store, &count);
    if (count > 0) {
        fputs(
            "<h2>Mistakes</h2>\n<table class=\"bars\">\n<caption>How many students make each, the "
            "most frequent first.</caption>\n<tbody>\n",
            file);
        for (int i = 0; i < count; i++)
            put_bar(file, mistakes[i].name, mistakes[i].count, mistakes[0].count);
        fputs("</tbody>\n</table>\n", file);
    }
    free(mistakes);
}

/* Names of folders are made such that they need no escape in an address. */
static void put_link(FILE *file, const ClassResult *result)
{
    fprintf(file, "<a href=\"students/%s/index.html\">", result->folder);
    put(file, result->student);
    fputs("</a>", file);
}

static void put_students(FILE *file, const ClassStore *store)
{
    fputs("<h2>Students</h2>\n<div class=\"wide\"><table>\n<thead><tr>"
          "<th scope=\"col\">Student</th><th scope=\"col\" class=\"number\">Points</th>"
          "<th scope=\"col\">Verdict</th><th scope=\"col\">What is wrong</th></tr></thead>\n"
          "<tbody>\n",
          file);
    for (int i = 0; i < store->count; i++) {
        const ClassResult *result = &store->results[i];
        const Verdict *verdict = &result->verdict;
        fputs("<tr><th scope=\"row\">", file);
        put_link(file, result);
        fprintf(file, "</th><td class=\"number\">%g</td><td class=\"%s\">%s</td><td>",
                verdict->points, VERDICT_NAMES[verdict->kind], VERDICT_NAMES[verdict->kind]);
        for (int j = 0; j < verdict->mistake_count; j++) {
            fputs(j ? "; " : "", file);
            put(file, verdict->mistakes[j].name);
        }
        if (verdict->mistake_count == 0 && verdict->kind != VERDICT_RIGHT)
            put(file, verdict->message);
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
    fputs("<h2>Pictures</h2>\n<p class=\"dim\">Of each the worst scene: as submitted, as it should "
          "be, the difference.</p>\n<ul class=\"thumbs\">\n",
          file);
    for (int i = 0; i < store->count; i++) {
        const ClassResult *result = &store->results[i];
        if (!result->verdict.picture[0])
            continue;
        fprintf(file, "<li><img loading=\"lazy\" src=\"students/%s/", result->folder);
        put(file, result->verdict.picture);
        fputs("\" alt=\"The worst scene of ", file);
        put(file, result->student);
        fputs("\">", file);
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
    fputs("<h1>The class: ", out.file);
    put(out.file, lab);
    fputs("</h1>\n", out.file);
    put_summary(out.file, store);
    if (front)
        put_front(out.file, store);
    put_points(out.file, store);
    put_class_mistakes(out.file, store);
    put_students(out.file, store);
    put_thumbnails(out.file, store);
    fputs("</main>\n</body>\n</html>\n", out.file);
    return class_file_write(&out, store->folder, "index.html", message);
}
