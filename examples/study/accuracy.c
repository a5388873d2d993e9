/*
 * accuracy: what accuracy costs in time.
 *
 * Draws scenes with many settings, each as often as its share of the time allows, and compares
 * every picture with the exact one. What comes out: for each scene, which settings are efficient,
 * that is, which no other beats in both error and time. --budget and --time-budget choose one.
 */
#include "choose.h"
#include "efficient.h"
#include "findings.h"
#include "models.h"
#include "report.h"
#include "scenes.h"
#include "stage.h"
#include "survey.h"
#include "transforms.h"

#include "output.h"
#include "progress.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int scene = STUDY_SCENE_COUNT; /* all */
static double budget = -1, time_budget = -1;
static bool by_rms, quick, calibrate, fresh, all_rows;
static const char *setting_asked;
static int seed = 1;

/* The names of the study's scenes, and the last: all of them. */
static const char *SCENES[STUDY_SCENE_COUNT + 2];

static const Parameter parameters[] = {
    {.name = "scene",
     .help = "what is drawn",
     .kind = PARAMETER_CHOICE,
     .value = &scene,
     .choices = SCENES},
    {.name = "budget",
     .help = "name the cheapest setting of --scene with at most this error, in steps of 1/255;\n"
             "                         -1: none is asked for",
     .kind = PARAMETER_NUMBER,
     .value = &budget,
     .least = -1,
     .most = 255},
    {.name = "rms",
     .help = "of --budget: of the root mean square error, in the place of the largest",
     .kind = PARAMETER_FLAG,
     .value = &by_rms},
    {.name = "time-budget",
     .help = "name the most exact setting of --scene with at most this time, in milliseconds;\n"
             "                         -1: none is asked for",
     .kind = PARAMETER_NUMBER,
     .value = &time_budget,
     .least = -1,
     .most = 1e6},
    {.name = "setting",
     .help = "measure only this setting of --scene: \"AXIS=CHOICE ...\", or \"usual\"",
     .kind = PARAMETER_TEXT,
     .value = &setting_asked},
    {.name = "quick",
     .help = "a tenth of the settings, in half a minute",
     .kind = PARAMETER_FLAG,
     .value = &quick},
    {.name = "fresh",
     .help = "drop all rows that the folder has from before, and measure anew",
     .kind = PARAMETER_FLAG,
     .value = &fresh},
    {.name = "all-rows",
     .help = "print every setting, not only the efficient ones",
     .kind = PARAMETER_FLAG,
     .value = &all_rows},
    {.name = "calibrate",
     .help = "renew the table that the option --error of the scenes' programs chooses from",
     .kind = PARAMETER_FLAG,
     .value = &calibrate},
    {.name = "seed",
     .help = "of the order in which settings are measured",
     .kind = PARAMETER_WHOLE,
     .value = &seed,
     .least = 0,
     .most = 1e9},
    {.name = NULL},
};

/* What --help says last: the scenes, and the axes. */
static char details[6000];

static void make_details(void)
{
    FILE *file = fmemopen(details, sizeof details, "w");
    if (!file)
        return;
    fprintf(file,
            "Errors are in steps of 1/255 of the exact picture: interior, of the pixels wholly "
            "inside\nan object; or of all pixels. Times are of a frame, drawn and read back.\n"
            "\nScenes:\n");
    for (int i = 0; i < STUDY_SCENE_COUNT; i++)
        fprintf(file, "  %-14s %s\n", STUDY_SCENES[i].name, STUDY_SCENES[i].what);
    fprintf(file, "\nA setting is a choice on each of these axes, the usual one in brackets:\n");
    for (int axis = 0; axis < AXIS_COUNT; axis++) {
        const SettingAxisInfo *info = &SETTING_AXES[axis];
        fprintf(file, "  %-14s %s:\n%17s", info->name, info->help, "");
        for (int i = 0; i < info->count; i++)
            fprintf(file, i == info->usual ? "[%s] " : "%s ", info->choices[i]);
        fputc('\n', file);
    }
    fprintf(file,
            "\nIn the folder: results.csv, one line for each scene and setting, to which an\n"
            "interrupted run comes back; results.json; table.txt; and for each scene a plot\n"
            "of error over time and sheets of drawn, exact and difference.\n"
            "\nTry:  accuracy --quick\n"
            "      accuracy --scene shiny32 --budget 2\n"
            "      accuracy --scene shiny32 --time-budget 1.5\n"
            "      accuracy --scene teapot --setting \"interpolation=gouraud divisions=24\"\n");
    fclose(file);
}

/* The folder's file of that name, in `path`. */
static const char *in_folder(const Options *options, const char *name, char path[PATH_MAX])
{
    snprintf(path, PATH_MAX, "%s/%s", options->output, name);
    return path;
}

/* Drawn, exact and difference of one setting. */
static bool write_sheet(Survey *survey, const char *name, const Scene *drawn,
                        const Setting *setting, const Reference *exact, const char *path,
                        Message *message)
{
    Drawing drawing;
    DrawingError error;
    char text[SETTING_TEXT_SIZE], caption[SETTING_TEXT_SIZE + 320];
    if (!drawing_open(&drawing, survey->studio, drawn, setting, message))
        return false;
    bool done = drawing_error(&drawing, survey->studio, exact, &error, message);
    setting_text(setting, text);
    snprintf(caption, sizeof caption,
             "%s: %s. Interior: largest error %.2f, rms %.3f; all: rms %.2f. %s, LP_NUM_THREADS %s",
             name, text, error.interior_maximum, error.interior_rms, error.all_rms,
             survey->like.renderer, survey->like.threads);
    done = done && report_sheet(&drawing.image, exact, caption, path, message);
    drawing_close(&drawing);
    return done;
}

typedef struct Sheet {
    const char *name; /* of the file, after the scene's */
    Setting setting;
} Sheet;

static bool write_sheets(Survey *survey, const Options *options, int number, const Sheet *sheets,
                         int count, Message *message)
{
    StudyScene made;
    Reference exact;
    study_scene(number, &made);
    if (!survey_exact(survey, &made.scene, &exact, message))
        return false;
    bool done = true;
    for (int i = 0; i < count && done; i++) {
        char name[64], path[PATH_MAX];
        snprintf(name, sizeof name, "%s-%s.png", STUDY_SCENES[number].name, sheets[i].name);
        done = write_sheet(survey, STUDY_SCENES[number].name, &made.scene, &sheets[i].setting,
                           &exact, in_folder(options, name, path), message);
    }
    studio_forget(survey->studio);
    reference_close(&exact);
    return done;
}

/* Whether there is anything to show of a scene. (Its objects may be too small to have an inside.)
 */
static bool anything_to_show(const Results *results, const char *scene_name)
{
    for (int i = 0; i < results->count; i++)
        if (strcmp(results->rows[i].scene, scene_name) == 0 &&
            isfinite(results->rows[i].interior_maximum))
            return true;
    return false;
}

/* All tables, whole, to a file. */
static bool write_tables(const Survey *survey, const Options *options, Message *message)
{
    char *text = NULL, path[PATH_MAX];
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    bool done = file || message_set(message, "table.txt: not enough memory");
    for (int i = 0; i < STUDY_SCENE_COUNT && done; i++)
        if (anything_to_show(&survey->results, STUDY_SCENES[i].name))
            done = report_table(&survey->results, STUDY_SCENES[i].name, ERROR_INTERIOR_MAXIMUM,
                                false, file, message);
    if (file && fclose(file) != 0 && done)
        done = message_set(message, "table.txt: not enough memory");
    done = done && output_write(in_folder(options, "table.txt", path), text, size, message);
    free(text);
    return done;
}

/* Plots need gnuplot; where it is missing the rest is still there, and one line says so. */
static void draw_plots(const Survey *survey, const Options *options, const int *scenes, int count,
                       Progress *progress)
{
    Message message = {0};
    for (int i = 0; i < count; i++) {
        const StudySceneInfo *info = &STUDY_SCENES[scenes[i]];
        if (anything_to_show(&survey->results, info->name) &&
            !report_plot(&survey->results, info->name, info->what, ERROR_INTERIOR_MAXIMUM,
                         options->output, &message))
            break;
        progress_update(progress, i + 1, 2 * count);
    }
    if (!message.text[0])
        findings_plot(&survey->results, options->output, &message);
    if (message.text[0])
        fprintf(stderr, "accuracy: no plots: %s\n", message.text);
}

static bool report(Survey *survey, const Options *options, const int *scenes, int count,
                   Message *message)
{
    char path[PATH_MAX];
    for (int i = 0; i < count; i++)
        if (!report_table(&survey->results, STUDY_SCENES[scenes[i]].name, ERROR_INTERIOR_MAXIMUM,
                          !all_rows, stdout, message))
            return false;
    if (!write_tables(survey, options, message) ||
        !results_write_json(&survey->results, in_folder(options, "results.json", path), message) ||
        !models_report(survey, options->output, stdout, message))
        return false;
    findings_matrices(&survey->results, stdout);
    fflush(stdout);
    Sheet sheets[] = {
        {"usual", setting_usual()}, {"gouraud", setting_usual()}, {"mediump", setting_usual()}};
    if (!setting_parse(&sheets[1].setting, "interpolation=gouraud divisions=24", message))
        return false;
    sheets[2].setting = setting_with(setting_usual(), AXIS_PRECISION, PRECISION_MEDIUMP);
    Progress progress = progress_start("plots and sheets");
    draw_plots(survey, options, scenes, count, &progress);
    bool done = true;
    for (int i = 0; i < count && done; i++) {
        done = write_sheets(survey, options, scenes[i], sheets, quick ? 1 : 3, message);
        progress_update(&progress, count + i + 1, 2 * count);
    }
    progress_end(&progress);
    return done;
}

/* --setting: one row, one sheet. */
static bool measure_one(Survey *survey, const Options *options, const Setting *setting,
                        Message *message)
{
    ResultRow row;
    Results results = {.rows = NULL};
    const Sheet sheet = {"setting", *setting};
    const bool done = survey_once(survey, scene, setting, &row, message) &&
                      results_add(&results, &row, message) &&
                      report_table(&results, STUDY_SCENES[scene].name, ERROR_INTERIOR_MAXIMUM,
                                   false, stdout, message) &&
                      write_sheets(survey, options, scene, &sheet, 1, message);
    if (done)
        printf("%s/%s-setting.png\n", options->output, STUDY_SCENES[scene].name);
    results_close(&results);
    return done;
}

static bool run(const Options *options, const Setting *setting, Message *message)
{
    Survey survey;
    char path[PATH_MAX];
    int scenes[STUDY_SCENE_COUNT], count = 0;
    for (int i = 0; i < STUDY_SCENE_COUNT; i++)
        if (scene == STUDY_SCENE_COUNT || scene == i)
            scenes[count++] = i;
    /* Before minutes of measuring, whether the table has a place. */
    if (calibrate && (!efficient_path_to_write(path, message) || !output_check(path, message)))
        return false;
    if (!survey_open(&survey, options, (unsigned)seed, quick, fresh, message))
        return false;
    if (options->verbose)
        fprintf(stderr, "renderer: %s\nLP_NUM_THREADS: %s\n", survey.like.renderer,
                survey.like.threads);
    bool done;
    if (setting)
        done = measure_one(&survey, options, setting, message);
    else
        done = survey_run(&survey, scenes, count, message) &&
               (budget >= 0        ? choose_by_error(&survey, scene, budget, by_rms, message)
                : time_budget >= 0 ? choose_by_time(&survey, scene, time_budget, by_rms, message)
                : calibrate        ? choose_calibrate(&survey, message)
                                   : report(&survey, options, scenes, count, message));
    survey_close(&survey);
    return done;
}

/* What options contradict each other. */
static bool check(Message *message)
{
    const bool one = scene < STUDY_SCENE_COUNT;
    if ((budget < 0 && budget != -1) || (time_budget < 0 && time_budget != -1))
        return message_set(message, "--%s %g: must be 0 or more, or -1 for none",
                           budget < 0 && budget != -1 ? "budget" : "time-budget",
                           budget < 0 && budget != -1 ? budget : time_budget);
    if (budget >= 0 && time_budget >= 0)
        return message_set(message, "--budget and --time-budget: one of them");
    if ((budget >= 0 || time_budget >= 0 || setting_asked) && !one)
        return message_set(message, "%s: needs a scene, as in --scene shiny32",
                           budget >= 0        ? "--budget"
                           : time_budget >= 0 ? "--time-budget"
                                              : "--setting");
    if (calibrate && (one || budget >= 0 || time_budget >= 0 || setting_asked))
        return message_set(message, "--calibrate: takes all scenes and settings, not one");
    if (setting_asked && (budget >= 0 || time_budget >= 0))
        return message_set(message, "--setting: measures one; there is nothing to choose");
    if (setting_asked && fresh)
        return message_set(message, "--fresh: --setting keeps no rows, and needs none dropped");
    if (by_rms && budget < 0 && time_budget < 0)
        return message_set(message, "--rms: goes with --budget or --time-budget");
    return true;
}

static const Usage usage = {
    .name = "accuracy",
    .summary = "what accuracy costs in time, scene by scene and setting by setting",
    .details = details,
    .study = true,
    .parameters = parameters,
};

int main(int argc, char *argv[])
{
    Options options;
    int code;
    Setting setting;
    Message message = {0};
    for (int i = 0; i < STUDY_SCENE_COUNT; i++)
        SCENES[i] = STUDY_SCENES[i].name;
    SCENES[STUDY_SCENE_COUNT] = "all";
    make_details();
    if (!options_begin(&options, &usage, argc, argv, &code))
        return code;
    if (options.doctor)
        return options_finish(usage.name, stage_doctor());
    if (!check(&message))
        return options_fail(usage.name, &message, EXIT_USAGE);
    if (setting_asked && !setting_parse(&setting, setting_asked, &message)) {
        Message said = {0};
        message_set(&said, "--setting: %s", message.text);
        return options_fail(usage.name, &said, EXIT_USAGE);
    }
    if (!run(&options, setting_asked ? &setting : NULL, &message))
        return options_fail(usage.name, &message, EXIT_FAILED);
    return options_finish(usage.name, 0);
}
