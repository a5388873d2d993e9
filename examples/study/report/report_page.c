#include "study/report/conclusions.h"

#include "base/output.h"
#include "base/template.h"
#include "study/measure/scenes.h"
#include "study/results/results.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <unistd.h>

static const char TEMPLATE[] = "examples/study/report/report.html";

static bool has(const char *folder, const char *name)
{
    char path[PATH_MAX];
    return output_path(path, folder, name, NULL) && access(path, R_OK) == 0;
}

static bool has_plot(const char *folder, const char *name)
{
    char file[NAME_MAX];
    snprintf(file, sizeof file, "%s.svg", name);
    return has(folder, file);
}

static TemplateValues *set_scene(TemplateValues *page, const Results *results,
                                 const StudySceneInfo *scene, const char *folder)
{
    static const char *const sheets[] = {"usual", "gouraud", "mediump"};
    TemplateValues *values = template_add(page, "scene");
    char says[CONCLUSION_SIZE];
    conclusion_of_scene(results, scene->name, says);
    if (front_busy(results, scene->name))
        template_set(template_add(values, "busy"), "noise", "%.0f",
                     100 * front_noise(results, scene->name));
    else
        template_set(template_add(values, "quiet"), "says", "%s", says);
    template_set(values, "name", "%s", scene->name);
    template_set(values, "what", "%s", scene->what);
    if (has_plot(folder, scene->name))
        template_set(template_add(values, "plot"), "marks", "%s",
                     front_busy(results, scene->name)
                         ? "none is marked as efficient, because the machine was busy."
                         : "the efficient ones are joined, with their pictures and differences "
                           "above.");
    for (size_t i = 0; i < sizeof sheets / sizeof sheets[0]; i++) {
        char file[NAME_MAX];
        snprintf(file, sizeof file, "%s-%s.png", scene->name, sheets[i]);
        if (!has(folder, file))
            continue;
        TemplateValues *sheet = template_add(values, "sheet");
        template_set(sheet, "file", "%s", file);
        template_set(sheet, "setting", "%s", sheets[i]);
    }
    return values;
}

/* A bar of a ratio is in hundredths of its half's width. */
static void set_glance(TemplateValues *page, const Glance *glance, const char *folder)
{
    TemplateValues *values = template_add(page, "glance");
    const double bar = 50 * glance_bar(glance->ratio);
    char path[PATH_MAX];
    template_set(values, "name", "%s", glance->name);
    template_set(values, "time", "%s", glance->time);
    template_set(values, "error", "%s", glance->error);
    template_set(values, "verdict", "%s", glance->verdict);
    if (fabs(bar) > 0) {
        TemplateValues *drawn = template_add(values, "bar");
        template_set(drawn, "from", "%.1f", bar < 0 ? 50 + bar : 50);
        template_set(drawn, "width", "%.1f", fabs(bar));
        template_set(drawn, "kind", "%s", bar < 0 ? "faster" : "slower");
    }
    glance_path(glance->file, folder, path);
    if (access(path, R_OK) == 0)
        template_set(values, "picture", "glance-%s.png", glance->file);
}

static void set_findings(TemplateValues *page, const Conclusions *conclusions, const char *folder)
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
    template_set(page, "measured", "%s", conclusions->lines[0]);
    template_set(page, "kind", "%s", conclusions->busy ? "busy" : "measured");
    for (int i = 0; i < conclusions->glance_count; i++)
        set_glance(page, &conclusions->glances[i], folder);
    for (int i = 0; i < conclusions->count; i++)
        template_set(template_add(page, "conclusion"), "text", "%s", conclusions->lines[i]);
    for (size_t i = 0; i < sizeof findings / sizeof findings[0]; i++) {
        char name[64];
        snprintf(name, sizeof name, "finding-%s", findings[i][0]);
        if (!has_plot(folder, name))
            continue;
        TemplateValues *finding = template_add(page, "finding");
        template_set(finding, "name", "%s", name);
        template_set(finding, "description", "%s", findings[i][1]);
    }
}

bool report_page(const Results *results, const int *scenes, int count,
                 const Conclusions *conclusions, const char *folder, Message *message)
{
    char path[PATH_MAX], with[RESULT_WITH_SIZE];
    TemplateValues *page = template_values();
    results_with(results, with);
    template_set(page, "with", "%s", with);
    for (int i = 0; i < count; i++) {
        TemplateValues *scene = set_scene(page, results, &STUDY_SCENES[scenes[i]], folder);
        if (i == 0)
            template_add(scene, "measured");
    }
    set_findings(page, conclusions, folder);
    const bool done = output_path(path, folder, "index.html", message) &&
                      template_write(TEMPLATE, page, path, message);
    template_close(page);
    return done;
}
