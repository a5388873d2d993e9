/*
 * accuracy: what accuracy costs in time.
 *
 * Draws scenes with many settings and compares every picture with the exact one. The result is, for
 * each scene, which settings are efficient: no other beats them in both error and time. --budget
 * and --time-budget choose one.
 */
#include "app/doctor.h"
#include "base/output.h"
#include "base/progress.h"
#include "study/measure/choose.h"
#include "study/measure/models.h"
#include "study/measure/scenes.h"
#include "study/report/shadow_ways.h"
#include "study/measure/survey.h"
#include "study/report/conclusions.h"
#include "study/report/findings.h"
#include "study/report/report.h"
#include "study/report/report_page.h"
#include "study/results/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int scene = STUDY_SCENE_COUNT; /* all */
static double budget = -1, time_budget = -1;
static bool by_rms, quick, fresh, all_rows, markdown, merge;
static Part part;
static const char *quality_asked;
static int seed = 1;

/* The names of the study's scenes, and the last: all of them. */
static const char *SCENES[STUDY_SCENE_COUNT + 2];

static const Parameter parameters[] = {
    {"scene", "what is drawn", PARAMETER_CHOICE, .value = &scene, .choices = SCENES},
    {"budget",
     "name the cheapest setting of --scene with at most this error, in steps of 1/255; "
     "-1: off",
     PARAMETER_NUMBER, .value = &budget, .min = -1, .max = 255},
    {"rms", "budgets are of the root mean square error instead of the largest", PARAMETER_FLAG,
     .value = &by_rms},
    {"time-budget",
     "name the most exact setting of --scene with at most this time, in milliseconds; "
     "-1: off",
     PARAMETER_NUMBER, .value = &time_budget, .min = -1, .max = 1e6},
    {"setting", "measure only this setting of --scene: \"AXIS=CHOICE ...\", or \"usual\"",
     PARAMETER_TEXT, .value = &quality_asked, .placeholder = "SETTING"},
    {"quick", "a tenth of the settings, in half a minute", PARAMETER_FLAG, .value = &quick},
    {"fresh", "drop the folder's earlier rows, and measure them again", PARAMETER_FLAG,
     .value = &fresh},
    {"part",
     "measure only the I-th of N parts of the settings, for several processes or machines, into "
     "results-I-of-N.csv",
     PARAMETER_TEXT, .value = &part, .standard = "", .codec = &OPTION_PART},
    {"merge", "measure nothing: report what all parts in DIR have measured, as one survey",
     PARAMETER_FLAG, .value = &merge},
    {"all-rows", "print tables of every setting, not only of the efficient ones as --verbose does",
     PARAMETER_FLAG, .value = &all_rows},
    {"markdown", "print tables of the findings as Markdown, with processor, driver and compiler",
     PARAMETER_FLAG, .value = &markdown},
    {"seed", "of the order in which settings are measured", PARAMETER_WHOLE, .value = &seed,
     .min = 0, .max = 1e9},
    {.name = NULL},
};

/* The end of --help: the scenes and the axes. */
static char details[6000];

static void make_details(void)
{
    FILE *file = fmemopen(details, sizeof details, "w");
    if (!file)
        return;
    fprintf(file,
            "Errors are in steps of 1/255, against the exact picture of the shapes (solids) or of "
            "the\nmesh as given (models): of the pixels inside an object (interior: wholly inside "
            "one\nsurface, and covered by what is drawn) or of all pixels. Times are of a frame, "
            "drawn and\nread back.\n"
            "\nScenes:\n");
    for (int i = 0; i < STUDY_SCENE_COUNT; i++)
        fprintf(file, "  %-14s %s\n", STUDY_SCENES[i].name, STUDY_SCENES[i].what);
    fprintf(file, "\nA setting is one choice on each of these axes; the default is in brackets:\n");
    for (int axis = 0; axis < AXIS_COUNT; axis++) {
        const QualityAxisInfo *info = &QUALITY_AXES[axis];
        fprintf(file, "  %-14s %s:\n%16s", info->name, info->help, "");
        for (int i = 0; i < info->count; i++)
            fprintf(file, i == info->usual ? " [%s]" : " %s", info->choices[i]);
        fputc('\n', file);
    }
    fprintf(file,
            "\nThe folder has results.csv, one line per scene and setting, from which an\n"
            "interrupted run continues; results.json; table.txt; and for each scene a plot\n"
            "of error over time and sheets of drawn, exact and difference; index.html has all.\n"
            "Prints the conclusions; with --verbose also the tables of efficient settings.\n"
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

/* False if nothing of the scene was measured, or its objects are too small to have an inside. */
static bool has_errors(const Results *results, const char *scene_name)
{
    for (int i = 0; i < results->count; i++)
        if (strcmp(results->rows[i].scene, scene_name) == 0 &&
            isfinite(results->rows[i].interior_maximum))
            return true;
    return false;
}

/* Drawn, exact and difference of one setting; or without the exact picture and text, small. */
static bool write_sheet(Survey *survey, const char *name, const Scene *drawn,
                        const Quality *quality, const Reference *exact, bool small,
                        const char *path, Message *message)
{
    SettingPicture drawing;
    char text[QUALITY_TEXT_SIZE], caption[QUALITY_TEXT_SIZE + 320];
    if (!setting_picture_open(&drawing, survey->renderer, drawn, quality, message))
        return false;
    const SettingError error = setting_picture_error(&drawing, exact);
    quality_text(quality, text);
    snprintf(caption, sizeof caption,
             "%s: %s. Interior: largest error %.2f, rms %.3f; all: rms %.2f. %s, LP_NUM_THREADS %s",
             name, text, error.interior_maximum, error.interior_rms, error.all_rms,
             survey->like.renderer, survey->like.threads);
    const bool done = small ? report_pair(&drawing.image, exact, path, message)
                            : report_sheet(&drawing.image, exact, caption, path, message);
    setting_picture_close(&drawing);
    return done;
}

/* The small pictures of a scene's plot; those of an earlier run are removed. */
static bool write_pins(Survey *survey, const Options *options, int number, const Scene *drawn,
                       const Reference *exact, Message *message)
{
    const char *name = STUDY_SCENES[number].name;
    ReportPins pins = {.count = 0};
    char path[PATH_MAX];
    bool done = !has_errors(&survey->results, name) ||
                report_pins(&pins, &survey->results, name, ERROR_INTERIOR_MAXIMUM, message);
    for (int i = 0; i < REPORT_PINS && done; i++) {
        report_pin_path(options->output, name, i, path);
        if (i < pins.count)
            done = write_sheet(survey, name, drawn, &pins.rows[i]->quality, exact, true, path,
                               message);
        else
            unlink(path);
    }
    return done;
}

typedef struct Sheet {
    const char *name; /* of the file, after the scene's */
    Quality quality;
} Sheet;

static bool write_sheets(Survey *survey, const Options *options, int number, const Sheet *sheets,
                         int count, bool pins, Message *message)
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
        done = write_sheet(survey, STUDY_SCENES[number].name, &made.scene, &sheets[i].quality,
                           &exact, false, in_folder(options, name, path), message);
    }
    if (pins)
        done = done && write_pins(survey, options, number, &made.scene, &exact, message);
    setting_renderer_forget(survey->renderer);
    reference_close(&exact);
    return done;
}

/* All tables, whole: a scene's settings, then `more`. */
static bool write_tables(const Survey *survey, const Options *options, const char *more,
                         Message *message)
{
    char *text = NULL, path[PATH_MAX];
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    bool done = file || message_set(message, "table.txt: not enough memory");
    for (int i = 0; i < STUDY_SCENE_COUNT && done; i++)
        if (has_errors(&survey->results, STUDY_SCENES[i].name))
            done = report_table(&survey->results, STUDY_SCENES[i].name, ERROR_INTERIOR_MAXIMUM,
                                false, file, message);
    if (file)
        fputs(more, file);
    if (file && fclose(file) != 0 && done)
        done = message_set(message, "table.txt: not enough memory");
    done = done && output_write(in_folder(options, "table.txt", path), text, size, message);
    free(text);
    return done;
}

/* The tables of models, matrices and shadows, as text of its own. */
static bool measure_more(Survey *survey, const Options *options, ModelsApart *apart,
                         ShadowWays *ways, char **text, Message *message)
{
    size_t size = 0;
    FILE *file = open_memstream(text, &size);
    bool done = file || message_set(message, "table.txt: not enough memory");
    done = done && models_report(survey, options->output, markdown, file, apart, message) &&
           (findings_matrices(&survey->results, markdown, file) ||
            message_set(message, "table.txt: not enough memory")) &&
           shadow_ways_report(survey, options->output, markdown, file, ways, message);
    if (file && fclose(file) != 0 && done)
        done = message_set(message, "table.txt: not enough memory");
    return done;
}

/* Without gnuplot there are no plots, and one line says so. */
static void draw_plots(const Survey *survey, const Options *options, const int *scenes, int count,
                       const ShadowWays *ways, Progress *progress)
{
    Message message = {0};
    for (int i = 0; i < count; i++) {
        const StudySceneInfo *info = &STUDY_SCENES[scenes[i]];
        if (has_errors(&survey->results, info->name) &&
            !report_plot(&survey->results, info->name, info->what, ERROR_INTERIOR_MAXIMUM,
                         options->output, &message))
            break;
        progress_update(progress, count + i + 1, 2 * count);
    }
    if (!message.text[0])
        (void)(findings_plot(&survey->results, options->output, &message) &&
               shadow_ways_plot(ways, options->output, &message));
    if (message.text[0])
        fprintf(stderr, "accuracy: no plots: %s\n", message.text);
}

/* The conclusions; or the tables, if asked for. */
static bool print_report(const Survey *survey, const Options *options, const int *scenes, int count,
                         const Conclusions *conclusions, const char *more, Message *message)
{
    if (markdown)
        table_machine(survey->like.renderer, stdout);
    if (markdown && !findings_tables(&survey->results, stdout))
        return message_set(message, "standard output: not enough memory for the tables");
    const bool tables = !markdown && (options->verbose || all_rows);
    for (int i = 0; i < count && tables; i++)
        if (!report_table(&survey->results, STUDY_SCENES[scenes[i]].name, ERROR_INTERIOR_MAXIMUM,
                          !all_rows, stdout, message))
            return false;
    if (markdown || tables)
        fputs(more, stdout);
    if (tables)
        putchar('\n');
    for (int i = 0; i < conclusions->count && !markdown; i++)
        puts(conclusions->lines[i]);
    if (!markdown)
        printf("%s/index.html: plots and tables; all tables: table.txt; --verbose prints them\n",
               options->output);
    fflush(stdout);
    return true;
}

static bool report(Survey *survey, const Options *options, const int *scenes, int count,
                   Message *message)
{
    char path[PATH_MAX], *more = NULL;
    ModelsApart apart;
    ShadowWays ways;
    Sheet sheets[] = {
        {"usual", quality_usual()}, {"gouraud", quality_usual()}, {"mediump", quality_usual()}};
    if (!quality_parse(&sheets[1].quality, "interpolation=gouraud divisions=24", message))
        return false;
    sheets[2].quality = quality_with(quality_usual(), AXIS_PRECISION, PRECISION_MEDIUMP);
    bool done =
        measure_more(survey, options, &apart, &ways, &more, message) &&
        write_tables(survey, options, more, message) &&
        results_write_json(&survey->results, in_folder(options, "results.json", path), message);
    Progress progress = progress_start("plots and sheets");
    for (int i = 0; i < count && done; i++) {
        done = write_sheets(survey, options, scenes[i], sheets, quick ? 1 : 3, true, message);
        progress_update(&progress, i + 1, 2 * count);
    }
    if (done)
        draw_plots(survey, options, scenes, count, &ways, &progress);
    progress_end(&progress);
    if (done) {
        const Conclusions conclusions = conclusions_of(&survey->results, scenes, count, &apart);
        done =
            report_page(&survey->results, scenes, count, &conclusions, options->output, message) &&
            print_report(survey, options, scenes, count, &conclusions, more, message);
    }
    free(more);
    return done;
}

/* --setting: one row, one sheet. */
static bool measure_one(Survey *survey, const Options *options, const Quality *quality,
                        Message *message)
{
    ResultRow row;
    Results results = {.rows = NULL};
    const Sheet sheet = {"setting", *quality};
    const bool done = survey_again(survey, scene, quality, 1, &row, message) &&
                      results_add(&results, &row, message) &&
                      report_table(&results, STUDY_SCENES[scene].name, ERROR_INTERIOR_MAXIMUM,
                                   false, stdout, message) &&
                      write_sheets(survey, options, scene, &sheet, 1, false, message);
    if (done)
        printf("%s/%s-setting.png\n", options->output, STUDY_SCENES[scene].name);
    results_close(&results);
    return done;
}

static bool measure(const Options *options, const Quality *quality, Message *message)
{
    Survey survey;
    int scenes[STUDY_SCENE_COUNT], count = 0;
    const ChooseLimit limit = {.is_time = budget < 0,
                               .value = budget < 0 ? time_budget : budget,
                               .kind = by_rms ? ERROR_INTERIOR_RMS : ERROR_INTERIOR_MAXIMUM};
    for (int i = 0; i < STUDY_SCENE_COUNT; i++)
        if (scene == STUDY_SCENE_COUNT || scene == i)
            scenes[count++] = i;
    const SurveyPlan plan = {
        .seed = (unsigned)seed, .quick = quick, .fresh = fresh, .merge = merge, .part = part};
    if (!survey_open(&survey, options, &plan, message))
        return false;
    if (options->verbose)
        fprintf(stderr, "renderer: %s\nLP_NUM_THREADS: %s\n", survey.like.renderer,
                survey.like.threads);
    bool done;
    if (quality)
        done = measure_one(&survey, options, quality, message);
    else
        done = (merge ? survey_merge : survey_run)(&survey, scenes, count, message) &&
               (part.count         ? true
                : limit.value >= 0 ? choose(&survey, scene, &limit, message)
                                   : report(&survey, options, scenes, count, message));
    if (done && !quality && !part.count && limit.value < 0)
        options_tell("accuracy", "wrote %s", options->output);
    survey_close(&survey);
    return done;
}

/* Options that contradict each other. */
static bool check(Message *message)
{
    const bool one = scene < STUDY_SCENE_COUNT;
    if ((budget < 0 && budget != -1) || (time_budget < 0 && time_budget != -1))
        return message_set(message, "--%s %g: must be 0 or more, or -1: off",
                           budget < 0 && budget != -1 ? "budget" : "time-budget",
                           budget < 0 && budget != -1 ? budget : time_budget);
    if (budget >= 0 && time_budget >= 0)
        return message_set(message, "--budget and --time-budget: one of them");
    if ((budget >= 0 || time_budget >= 0 || quality_asked) && !one)
        return message_set(message, "%s: needs a scene, as in --scene shiny32",
                           budget >= 0        ? "--budget"
                           : time_budget >= 0 ? "--time-budget"
                                              : "--setting");
    if (quality_asked && (budget >= 0 || time_budget >= 0))
        return message_set(message, "--setting: measures one; there is nothing to choose");
    if (part.count && merge)
        return message_set(message, "--part and --merge: one of them");
    if ((part.count || merge) && (quality_asked || budget >= 0 || time_budget >= 0))
        return message_set(message,
                           "--%s: goes with a survey, not with --budget, --time-budget or "
                           "--setting",
                           part.count ? "part" : "merge");
    if (quality_asked && fresh)
        return message_set(message, "--fresh: --setting keeps no rows, so there are none to drop");
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
    Quality quality;
    Message message = {0};
    for (int i = 0; i < STUDY_SCENE_COUNT; i++)
        SCENES[i] = STUDY_SCENES[i].name;
    SCENES[STUDY_SCENE_COUNT] = "all";
    make_details();
    if (!options_begin(&options, &usage, argc, argv, &code))
        return code;
    if (options.doctor)
        return options_finish(usage.name, doctor_run());
    if (!check(&message))
        return options_fail(usage.name, &message, EXIT_USAGE);
    if (quality_asked && !quality_parse(&quality, quality_asked, &message)) {
        Message said = {0};
        message_set(&said, "--setting: %s", message.text);
        return options_fail(usage.name, &said, EXIT_USAGE);
    }
    if (!measure(&options, quality_asked ? &quality : NULL, &message))
        return options_fail(usage.name, &message, EXIT_FAILED);
    return options_finish(usage.name, 0);
}
