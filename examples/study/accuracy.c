/*
 * accuracy: what accuracy costs in time.
 *
 * Draws scenes with many settings and compares every picture with the exact one. The result is, for
 * each scene, which settings are efficient: no other beats them in both error and time. --budget
 * and --time-budget choose one.
 */
#include "base/output_text.h"
#include "base/progress.h"
#include "study/arithmetic/proof.h"
#include "study/measure/survey.h"
#include "study/measure/scenes.h"
#include "study/report/compare.h"
#include "study/report/conclusions.h"
#include "study/report/report.h"
#include "study/results/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int scene = STUDY_SCENE_COUNT; /* all */
static double budget = -1, time_budget = -1;
static bool by_rms, quick, fresh, all_rows, markdown, merge;
static Part part;
static const char *quality_asked, *compared, *scene_file;
static int seed = 1;
static int proved = STUDY_SCENE_COUNT; /* none */
static ProofCameras cameras;           /* zeroed: those of the scenes */

/* The names of the study's scenes, and the last: all of them, or none. */
static const char *SCENES[STUDY_SCENE_COUNT + 2], *PROVED[STUDY_SCENE_COUNT + 2];

static const Parameter parameters[] = {
    {"scene", "what is drawn", PARAMETER_CHOICE, .value = &scene, .choices = SCENES},
    {"scene-file", "what is drawn instead: a scene of your own, as Scene draws it", PARAMETER_TEXT,
     .value = &scene_file, .placeholder = "FILE", .min = 1, .standard = ""},
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
    {"all-rows",
     "print tables of every setting, not only of the efficient ones as --verbose does; with "
     "--compare, too",
     PARAMETER_FLAG, .value = &all_rows},
    {"markdown", "print tables of the findings as Markdown, with processor, driver and compiler",
     PARAMETER_FLAG, .value = &markdown},
    {"compare",
     "measure nothing: show the results in DIR beside those in the folder that follows on the "
     "command line, of another driver or machine: errors, and times over the usual setting's",
     PARAMETER_TEXT, .value = &compared, .placeholder = "DIR", .min = 1, .standard = ""},
    {"prove",
     "measure no settings: prove how large the error can be at any point of each object of a "
     "scene, from what is measured of the driver's arithmetic",
     PARAMETER_CHOICE, .value = &proved, .choices = PROVED},
    {"cameras",
     "with --prove: for all cameras in these ranges: azimuth and elevation in degrees and factors "
     "of the distance, as --orbit moves the scene's",
     PARAMETER_TEXT, .value = &cameras, .standard = "", .codec = &PROOF_CAMERAS},
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
            "interrupted run continues; table.txt; and for each scene a plot of error over\n"
            "time and sheets of drawn, exact and difference; index.html shows them.\n"
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

/* A scene of the study and its exact picture. */
typedef struct Subject {
    Survey *survey;
    const char *name;
    StudyScene made;
    Reference exact;
} Subject;

static bool open_subject(Subject *subject, Survey *survey, int number, Message *message)
{
    *subject = (Subject){.survey = survey, .name = STUDY_SCENES[number].name};
    study_scene(number, &subject->made);
    return survey_exact(survey, &subject->made.scene, &subject->exact, message);
}

/* Drawn, exact and difference of one setting; or without the exact picture and text, small. */
static bool write_sheet(Subject *subject, const Quality *quality, bool small, const char *path,
                        Message *message)
{
    const Survey *survey = subject->survey;
    SettingPicture picture;
    char text[QUALITY_TEXT_SIZE], caption[QUALITY_TEXT_SIZE + 320];
    if (!setting_picture_open(&picture, survey->renderer, &subject->made.scene, quality, message))
        return false;
    ResultRow error;
    setting_picture_error(&picture, &subject->exact, &error);
    quality_text(quality, text);
    snprintf(caption, sizeof caption,
             "%s: %s. Interior: largest error %.2f, rms %.3f; all: rms %.2f. %s, LP_NUM_THREADS %s",
             subject->name, text, error.interior_maximum, error.interior_rms, error.all_rms,
             survey->like.renderer, survey->like.threads);
    const bool done = small ? report_pair(&picture.image, &subject->exact, path, message)
                            : report_sheet(&picture.image, &subject->exact, caption, path, message);
    setting_picture_close(&picture);
    return done;
}

/* The small pictures of a scene's plot; those of an earlier run are removed. */
static bool write_pins(Subject *subject, const char *folder, Message *message)
{
    const Results *results = &subject->survey->results;
    ReportPins pins = {.count = 0};
    char path[PATH_MAX];
    bool done =
        !has_errors(results, subject->name) || report_pins(&pins, results, subject->name, message);
    for (int i = 0; i < REPORT_PINS && done; i++) {
        report_pin_path(folder, subject->name, i, path);
        if (i < pins.count)
            done = write_sheet(subject, &pins.rows[i]->quality, true, path, message);
        else
            unlink(path);
    }
    return done;
}

/* The settings that a sheet shows, by the end of its file's name. */
typedef struct Sheet {
    const char *name;
    Quality quality;
} Sheet;

static bool write_sheets(Subject *subject, const Options *options, const Sheet *sheets, int count,
                         Message *message)
{
    bool done = true;
    for (int i = 0; i < count && done; i++) {
        char name[64], path[PATH_MAX];
        snprintf(name, sizeof name, "%s-%s.png", subject->name, sheets[i].name);
        done = write_sheet(subject, &sheets[i].quality, false, in_folder(options, name, path),
                           message);
    }
    return done;
}

static void close_subject(Subject *subject)
{
    setting_renderer_forget(subject->survey->renderer);
    reference_close(&subject->exact);
}

/* All tables: a scene's settings, then `more`. */
static bool write_tables(const Survey *survey, const Options *options, const char *more,
                         Message *message)
{
    OutputText text;
    char path[PATH_MAX];
    bool done = true;
    output_text_open(&text);
    for (int i = 0; i < STUDY_SCENE_COUNT && done; i++)
        if (has_errors(&survey->results, STUDY_SCENES[i].name))
            done = report_table(&survey->results, STUDY_SCENES[i].name, false, text.file, message);
    fputs(more, text.file);
    if (done)
        return output_text_write(&text, in_folder(options, "table.txt", path), message);
    free(output_text_close(&text));
    return false;
}

/* The tables of models, matrices and shadows, as text of its own. */
static bool measure_more(Survey *survey, ModelsApart *apart, ShadowWays *ways, char **text,
                         Message *message)
{
    OutputText more;
    output_text_open(&more);
    const bool done = models_report(survey, markdown, more.file, apart, message);
    if (done) {
        findings_matrices(&survey->results, markdown, more.file);
        shadow_ways_report(survey, markdown, more.file, ways);
    }
    *text = output_text_close(&more);
    return done;
}

/* Without gnuplot there are no plots, and one line says so. `ways`, `progress`: NULL of a file. */
static void draw_plots(const Survey *survey, const Options *options, const int *scenes, int count,
                       const ShadowWays *ways, Progress *progress)
{
    Message message = {0};
    for (int i = 0; i < count; i++) {
        const StudySceneInfo *info = &STUDY_SCENES[scenes[i]];
        if (has_errors(&survey->results, info->name) &&
            !report_plot(&survey->results, info->name, info->what, options->output, &message))
            break;
        if (progress)
            progress_update(progress, count + i + 1, 2 * count);
    }
    if (!message.text[0] && ways)
        (void)(findings_plot(&survey->results, options->output, &message) &&
               shadow_ways_plot(ways, options->output, &message));
    if (message.text[0])
        fprintf(stderr, "accuracy: no plots: %s\n", message.text);
}

/* The tables that are asked for. */
static bool print_tables(const Survey *survey, const int *scenes, int count, const char *more,
                         Message *message)
{
    for (int i = 0; i < count && !markdown; i++)
        if (!report_table(&survey->results, STUDY_SCENES[scenes[i]].name, !all_rows, stdout,
                          message))
            return false;
    if (markdown) {
        table_machine(survey->like.renderer, stdout);
        findings_tables(&survey->results, stdout);
    }
    printf("%s%s", more, markdown ? "" : "\n");
    return true;
}

/* The pictures of the first screen: each where its error is the largest. */
static bool write_glances(Survey *survey, const Conclusions *conclusions, const char *folder,
                          Message *message)
{
    bool done = true;
    for (int i = 0; i < conclusions->glance_count && done; i++) {
        const Glance *glance = &conclusions->glances[i];
        Quality quality;
        Subject subject;
        char path[PATH_MAX];
        if (!glance->setting)
            continue;
        glance_path(glance->file, folder, path);
        done = quality_parse(&quality, glance->setting, message) &&
               open_subject(&subject, survey, glance->scene, message);
        if (done) {
            done = write_sheet(&subject, &quality, true, path, message);
            close_subject(&subject);
        }
    }
    return done;
}

static bool draw_sheets(Survey *survey, const Options *options, int number, Message *message)
{
    Subject subject;
    Sheet sheets[] = {
        {"usual", quality_usual()},
        {"gouraud", quality_with(quality_usual(), AXIS_INTERPOLATION, INTERPOLATION_GOURAUD)},
        {"mediump", quality_with(quality_usual(), AXIS_PRECISION, PRECISION_MEDIUMP)}};
    if (!quality_choose(&sheets[1].quality, "divisions", "24", message) ||
        !open_subject(&subject, survey, number, message))
        return false;
    const bool done = write_sheets(&subject, options, sheets, quick ? 1 : 3, message) &&
                      write_pins(&subject, options->output, message);
    close_subject(&subject);
    return done;
}

static bool report(Survey *survey, const Options *options, const int *scenes, int count,
                   Message *message)
{
    char *more = NULL;
    ModelsApart apart;
    ShadowWays ways;
    bool done = measure_more(survey, &apart, &ways, &more, message) &&
                write_tables(survey, options, more, message);
    Progress progress = progress_start("plots and sheets");
    for (int i = 0; i < count && done; i++) {
        done = draw_sheets(survey, options, scenes[i], message);
        progress_update(&progress, i + 1, 2 * count);
    }
    if (done)
        draw_plots(survey, options, scenes, count, &ways, &progress);
    progress_end(&progress);
    if (done) {
        const Conclusions conclusions =
            conclusions_of(&survey->results, scenes, count, &apart, &ways);
        done = write_glances(survey, &conclusions, options->output, message) &&
               report_page(&survey->results, scenes, count, &conclusions, options->output, message);
        if (done && (markdown || options->verbose || all_rows))
            done = print_tables(survey, scenes, count, more, message);
        if (done && !markdown)
            conclusions_print(&conclusions, options->output, stdout);
        fflush(stdout);
    }
    free(more);
    return done;
}

/* Of a file: what is found besides is of the study's scenes. */
static bool report_file(Survey *survey, const Options *options, Message *message)
{
    draw_plots(survey, options, &(int){STUDY_FILE}, 1, NULL, NULL);
    return draw_sheets(survey, options, STUDY_FILE, message) &&
           report_table(&survey->results, STUDY_SCENES[STUDY_FILE].name, !all_rows, stdout,
                        message);
}

/* --setting: one row, one sheet. */
static bool measure_one(Survey *survey, const Options *options, const Quality *quality,
                        Message *message)
{
    ResultRow row;
    Results results = {.rows = NULL};
    Subject subject;
    const Sheet sheet = {"setting", *quality};
    if (!survey_again(survey, scene, quality, 1, &row, message))
        return false;
    results_add(&results, &row);
    bool done = report_table(&results, STUDY_SCENES[scene].name, false, stdout, message) &&
                open_subject(&subject, survey, scene, message);
    if (done) {
        done = write_sheets(&subject, options, &sheet, 1, message);
        close_subject(&subject);
    }
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
    if (scene_file)
        scenes[0] = STUDY_FILE, count = 1;
    const SurveyPlan plan = {
        .seed = (unsigned)seed, .quick = quick, .fresh = fresh, .merge = merge, .part = part};
    if ((scene_file && !study_open_file(scene_file, message)) ||
        !survey_open(&survey, options, &plan, message))
        return false;
    if (options->verbose)
        fprintf(stderr, "renderer: %s\nLP_NUM_THREADS: %s\n", survey.like.renderer,
                survey.like.threads);
    const bool done = quality
                          ? measure_one(&survey, options, quality, message)
                          : (merge ? survey_merge : survey_run)(&survey, scenes, count, message) &&
                                (part.count         ? true
                                 : limit.value >= 0 ? choose(&survey, scene, &limit, message)
                                 : scene_file       ? report_file(&survey, options, message)
                                              : report(&survey, options, scenes, count, message));
    if (done && !quality && !part.count && limit.value < 0)
        options_tell("accuracy", "wrote %s", options->output);
    survey_close(&survey);
    return done;
}

/* Options that contradict each other. */
static bool check(const Options *options, Message *message)
{
    const bool one = scene < STUDY_SCENE_COUNT || scene_file;
    const bool limited = budget >= 0 || time_budget >= 0, below = budget < 0 && budget != -1;
    const char *const *names = (const char *const *)options->names;
    if (compared && (!names[0] || names[1]))
        return message_set(message, "--compare %s: needs one other folder, as in --compare A B",
                           compared);
    if (names[0] && !compared)
        return message_set(message, "%s: not an option; --help lists them, -o DIR names the folder",
                           names[0]);
    if (scene_file && scene < STUDY_SCENE_COUNT)
        return message_set(message, "--scene and --scene-file: one of them");
    if (below || (time_budget < 0 && time_budget != -1))
        return message_set(message, "--%s %g: must be 0 or more, or -1: off",
                           below ? "budget" : "time-budget", below ? budget : time_budget);
    if (budget >= 0 && time_budget >= 0)
        return message_set(message, "--budget and --time-budget: one of them");
    if ((limited || quality_asked) && !one)
        return message_set(message, "%s: needs a scene, as in --scene shiny32",
                           budget >= 0        ? "--budget"
                           : time_budget >= 0 ? "--time-budget"
                                              : "--setting");
    if (quality_asked && limited)
        return message_set(message, "--setting: measures one; there is nothing to choose");
    if (part.count && merge)
        return message_set(message, "--part and --merge: one of them");
    if ((part.count || merge) && (quality_asked || limited))
        return message_set(
            message, "--%s: goes with a survey, not with --budget, --time-budget or --setting",
            part.count ? "part" : "merge");
    if (quality_asked && fresh)
        return message_set(message, "--fresh: --setting keeps no rows, so there are none to drop");
    if (proved < STUDY_SCENE_COUNT && (one || quality_asked || part.count || merge || fresh))
        return message_set(message, "--prove: names its scene, and measures no settings");
    if (cameras.high[2] > 0 && proved == STUDY_SCENE_COUNT)
        return message_set(message, "--cameras: goes with --prove, as in --prove shiny32");
    if (by_rms && !limited)
        return message_set(message, "--rms: goes with --budget or --time-budget");
    return true;
}

static const Usage usage = {
    .name = "accuracy",
    .summary = "what accuracy costs in time, scene by scene and setting by setting",
    .details = details,
    .study = true,
    .names = "[DIR]",
    .parameters = parameters,
};

int main(int argc, char *argv[])
{
    Options options;
    int code;
    Quality quality;
    Message message = {0};
    for (int i = 0; i < STUDY_SCENE_COUNT; i++)
        SCENES[i] = PROVED[i] = STUDY_SCENES[i].name;
    SCENES[STUDY_SCENE_COUNT] = "all";
    PROVED[STUDY_SCENE_COUNT] = "none";
    make_details();
    if (!options_begin(&options, &usage, argc, argv, &code))
        return code;
    if (!check(&options, &message))
        return options_fail(usage.name, &message, EXIT_USAGE);
    if (quality_asked && !quality_parse(&quality, quality_asked, &message)) {
        Message said = {0};
        message_set(&said, "--setting: %s", message.text);
        return options_fail(usage.name, &said, EXIT_USAGE);
    }
    const char *const folders[2] = {compared, options.names[0]};
    if (compared ? !compare_folders(folders, all_rows, stdout, &message)
        : proved < STUDY_SCENE_COUNT
            ? !prove_study(proved, cameras.high[2] > 0 ? &cameras : NULL, options.canvas.backend,
                           options.height, stdout, &message)
            : !measure(&options, quality_asked ? &quality : NULL, &message))
        return options_fail(usage.name, &message, EXIT_FAILED);
    return options_finish(usage.name, 0);
}
