#include "study/report/report_page.h"

#include "base/output.h"
#include "study/measure/scenes.h"
#include "study/report/report.h"
#include "study/results/front.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char HEAD[] =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width\">\n"
    "<title>Accuracy and time</title>\n<style>\n"
    "body { font: 1rem/1.4 sans-serif; color: #222; max-width: 75rem; margin: 0 auto; "
    "padding: 0 1rem; }\n"
    "h1 { font-size: 1.4rem; margin: .5rem 0; }\nh2 { font-size: 1.2rem; margin: .5rem 0 0; }\n"
    "p { margin: .3rem 0; }\n.says { font-size: 1.2rem; }\n"
    "section { margin-bottom: 3rem; }\n"
    ".plot { overflow: auto; border: 1px solid #ccc; }\n"
    ".plot img { display: block; margin: auto; width: 100%; min-width: 36rem; "
    "max-width: calc((100vh - 11rem) * 10 / 7); transform-origin: 0 0; }\n"
    ".zoom { overflow: hidden; cursor: zoom-in; }\n"
    "table { border-collapse: collapse; margin: .5rem 0; }\n"
    "td, th { padding: .15rem .6rem; border-bottom: 1px solid #ddd; text-align: right; }\n"
    "td:last-child, th:last-child { text-align: left; }\n.wide { overflow-x: auto; }\n"
    "@media (prefers-color-scheme: dark) { body { background: #222; color: #eee; } "
    "a { color: #9cf; } }\n"
    "</style>\n</head>\n<body>\n<h1>Accuracy and time</h1>\n";

/* Without scripts the page has all of this but the zoom. */
static const char TAIL[] =
    "<script>\n"
    "for (const box of document.querySelectorAll('.plot')) {\n"
    "  const image = box.firstElementChild;\n"
    "  let zoom = 1, x = 0, y = 0, from = null, moved = false;\n"
    "  const show = () => {\n"
    "    const room = 1 - zoom;\n"
    "    x = Math.min(0, Math.max(x, room * image.offsetWidth));\n"
    "    y = Math.min(0, Math.max(y, room * image.offsetHeight));\n"
    "    image.style.transform = `translate(${x}px,${y}px) scale(${zoom})`;\n"
    "    box.classList.toggle('zoom', zoom > 1);\n"
    "  };\n"
    "  const at = (event, factor) => {\n"
    "    const place = image.getBoundingClientRect();\n"
    "    const next = Math.min(Math.max(zoom * factor, 1), 16);\n"
    "    x -= (event.clientX - place.left) * (next / zoom - 1);\n"
    "    y -= (event.clientY - place.top) * (next / zoom - 1);\n"
    "    zoom = next;\n    show();\n  };\n"
    "  box.addEventListener('wheel', event => {\n"
    "    if (zoom === 1 && !event.ctrlKey)\n      return;\n"
    "    event.preventDefault();\n    at(event, event.deltaY < 0 ? 1.25 : 0.8);\n"
    "  }, {passive: false});\n"
    "  image.addEventListener('dragstart', event => event.preventDefault());\n"
    "  box.addEventListener('pointerdown', event => {\n"
    "    from = [event.clientX - x, event.clientY - y];\n    moved = false;\n  });\n"
    "  addEventListener('pointermove', event => {\n"
    "    if (!from)\n      return;\n"
    "    moved = moved || Math.hypot(event.clientX - x - from[0], event.clientY - y - from[1]) > 4;\n"
    "    if (moved && zoom > 1) {\n"
    "      x = event.clientX - from[0];\n      y = event.clientY - from[1];\n      show();\n    }\n"
    "  });\n"
    "  addEventListener('pointerup', () => { from = null; });\n"
    "  box.addEventListener('click', event => {\n"
    "    if (!moved)\n      at(event, zoom < 8 ? 2 : 1 / zoom);\n  });\n"
    "}\n"
    "document.getElementById('hint').hidden = false;\n"
    "</script>\n</body>\n</html>\n";

/* Text, or the value of an attribute. */
static void put_text(FILE *file, const char *text)
{
    for (; *text; text++) {
        if (*text == '&')
            fputs("&amp;", file);
        else if (*text == '<')
            fputs("&lt;", file);
        else if (*text == '"')
            fputs("&quot;", file);
        else
            fputc(*text, file);
    }
}

static bool has(const char *folder, const char *name)
{
    char path[PATH_MAX];
    return snprintf(path, sizeof path, "%s/%s", folder, name) < (int)sizeof path &&
           access(path, R_OK) == 0;
}

/* Its plot is as vectors, with a link to the pixels. */
static void put_plot(FILE *file, const char *folder, const char *name, const char *description)
{
    char path[NAME_MAX];
    snprintf(path, sizeof path, "%s.svg", name);
    if (!has(folder, path))
        return;
    fprintf(file, "<div class=\"plot\"><img src=\"%s.svg\" alt=\"", name);
    put_text(file, description);
    fprintf(file,
            "\" width=\"1000\" height=\"700\" style=\"height: auto\"></div>\n<p>"
            "<a href=\"%s.svg\">SVG</a>, <a href=\"%s.png\">PNG</a>",
            name, name);
}

static void put_scene(FILE *file, const Results *results, const StudySceneInfo *scene,
                      const char *folder)
{
    static const char *const sheets[] = {"usual", "gouraud", "mediump"};
    char says[CONCLUSION_SIZE], description[CONCLUSION_SIZE + 256];
    conclusion_of_scene(results, scene->name, says);
    fprintf(file, "<section id=\"%s\">\n<h2>%s: ", scene->name, scene->name);
    put_text(file, scene->what);
    fputs("</h2>\n<p class=\"says\">", file);
    put_text(file, says);
    fputs("</p>\n", file);
    snprintf(description, sizeof description,
             "Error over time of the settings of %s; the efficient ones are joined, with their "
             "pictures and differences above. %s",
             scene->name, says);
    put_plot(file, folder, scene->name, description);
    for (size_t i = 0; i < sizeof sheets / sizeof sheets[0]; i++) {
        char path[NAME_MAX];
        snprintf(path, sizeof path, "%s-%s.png", scene->name, sheets[i]);
        if (has(folder, path))
            fprintf(file, ", <a href=\"%s\">drawn, exact and difference: %s</a>", path, sheets[i]);
    }
    fputs("</p>\n</section>\n", file);
}

static void put_findings(FILE *file, const Conclusions *conclusions, const char *folder)
{
    static const char *const findings[][2] = {
        {"interpolation", "Error over time of Phong, Gouraud and flat interpolation"},
        {"precision", "The error of highp and mediump, scene by scene"},
        {"guards", "The time with guards over that without, scene by scene"},
        {"viewer", "The error of a local viewer and one at infinity, scene by scene"},
        {"antialiasing", "The error of all pixels over time"},
        {"matrices", "The error by arithmetic and order of the matrices"},
        {"shadows-sphere", "The error of a sphere's shadow by the size of the map"},
        {"shadows-sphere-time", "The time of a sphere's shadow by the size of the map"},
        {"shadows-teapot", "The error of a teapot's and a torus' shadows by the size of the map"},
        {"shadows-teapot-time",
         "The time of a teapot's and a torus' shadows by the size of the map"},
    };
    fputs("<section id=\"findings\">\n<h2>Conclusions</h2>\n<ul>\n", file);
    for (int i = 0; i < conclusions->count; i++) {
        fputs("<li>", file);
        put_text(file, conclusions->lines[i]);
        fputs("</li>\n", file);
    }
    fputs("</ul>\n", file);
    for (size_t i = 0; i < sizeof findings / sizeof findings[0]; i++) {
        char name[64], path[80];
        snprintf(name, sizeof name, "finding-%s", findings[i][0]);
        snprintf(path, sizeof path, "%s.svg", name);
        if (!has(folder, path))
            continue;
        put_plot(file, folder, name, findings[i][1]);
        fputs("</p>\n", file);
    }
    fputs("</section>\n", file);
}

/* The efficient settings. */
static bool put_table(FILE *file, const Results *results, const char *scene, Message *message)
{
    Front front;
    if (!front_open(&front, results, scene, ERROR_INTERIOR_MAXIMUM, message))
        return false;
    fprintf(file,
            "<h3>%s</h3>\n<div class=\"wide\"><table>\n<tr><th>ms</th><th>quartiles</th>"
            "<th>largest error</th><th>rms</th><th>rms of all pixels</th><th>noise</th>"
            "<th>setting</th></tr>\n",
            scene);
    for (int i = 0; i < front.count; i++) {
        const ResultRow *row = front.rows[i];
        char setting[QUALITY_TEXT_SIZE];
        quality_text(&row->quality, setting);
        fprintf(file,
                "<tr><td>%.2f</td><td>%.2f to %.2f</td><td>%.2f</td><td>%.2f</td>"
                "<td>%.2f</td><td>%.0f%%</td><td>",
                row->time, row->time_lower, row->time_upper, row->interior_maximum,
                row->interior_rms, row->all_rms, 100 * row->noise);
        put_text(file, setting);
        fputs("</td></tr>\n", file);
    }
    fputs("</table></div>\n", file);
    front_close(&front);
    return true;
}

static bool put_tables(FILE *file, const Results *results, const int *scenes, int count,
                       Message *message)
{
    bool done = true;
    fputs("<section id=\"tables\">\n<h2>Efficient settings</h2>\n<p>No other setting beats them in "
          "both error and time. Errors in steps of 1/255, inside the objects. All settings: "
          "<a href=\"table.txt\">table.txt</a>, <a href=\"results.csv\">results.csv</a>, "
          "<a href=\"results.json\">results.json</a>.</p>\n",
          file);
    for (int i = 0; i < count && done; i++)
        if (isfinite(front_noise(results, STUDY_SCENES[scenes[i]].name)))
            done = put_table(file, results, STUDY_SCENES[scenes[i]].name, message);
    fputs("</section>\n", file);
    return done;
}

bool report_page(const Results *results, const int *scenes, int count,
                 const Conclusions *conclusions, const char *folder, Message *message)
{
    char *text = NULL, path[PATH_MAX], with[RESULT_WITH_SIZE] = "";
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return message_set(message, "index.html: %s", strerror(errno));
    if (results->count)
        results_measured_with(&results->rows[results->count - 1], with);
    fputs(HEAD, file);
    for (int i = 0; i < count; i++) {
        put_scene(file, results, &STUDY_SCENES[scenes[i]], folder);
        if (i == 0) {
            fputs("<p id=\"hint\" hidden>Click into a plot to enlarge it, drag to move it; or use "
                  "the wheel with Ctrl.</p>\n<p>Measured with ",
                  file);
            put_text(file, with);
            fputs(".</p>\n", file);
        }
    }
    put_findings(file, conclusions, folder);
    bool done = put_tables(file, results, scenes, count, message);
    fputs(TAIL, file);
    if (fclose(file) != 0 && done)
        done = message_set(message, "index.html: not enough memory");
    snprintf(path, sizeof path, "%s/index.html", folder);
    done = done && output_write(path, text, size, message);
    free(text);
    return done;
}
