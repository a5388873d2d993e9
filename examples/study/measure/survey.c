#include "study/measure/survey.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/output.h"
#include "base/progress.h"
#include "study/measure/scenes.h"
#include "study/measure/setting_times.h"

#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Seconds for a survey of all scenes, without tables and plots: fewer rows take less. */
static const double WHOLE = 260, QUICK = 13;

static volatile sig_atomic_t interrupted;

static void interrupt(int number)
{
    (void)number;
    interrupted = 1;
}

static void part_path(const Survey *survey, Part part, char path[PATH_MAX])
{
    if (part.count)
        snprintf(path, PATH_MAX, "%s/results-%d-of-%d.csv", survey->folder, part.number,
                 part.count);
    else
        snprintf(path, PATH_MAX, "%s/results.csv", survey->folder);
}

bool survey_open(Survey *survey, const Options *options, const SurveyPlan *plan, Message *message)
{
    *survey =
        (Survey){.folder = options->output,
                 .plan = *plan,
                 .like = {.width = options->width, .height = options->height, .seed = plan->seed}};
    const char *threads = getenv("LP_NUM_THREADS");
    if (!output_folder(options->output, message) ||
        !shader_loader_check(&options->shaders, message) ||
        !setting_renderer_open(&survey->renderer, &options->shaders, options->canvas.backend,
                               options->width, options->height, message))
        return false;
    part_path(survey, plan->part, survey->path);
    snprintf(survey->like.renderer, sizeof survey->like.renderer, "%s; %s",
             setting_renderer_name(survey->renderer), setting_renderer_version(survey->renderer));
    snprintf(survey->like.threads, sizeof survey->like.threads, "%s",
             threads && threads[0] ? threads : "default");
    if (plan->fresh && !plan->merge &&
        !(unlink(survey->path) == 0 || errno == ENOENT ||
          message_set(message, "%s: cannot be removed: %s", survey->path, strerror(errno)))) {
        survey_close(survey);
        return false;
    }
    if (results_read(&survey->results, survey->path, &survey->like, message))
        return true;
    survey_close(survey);
    return false;
}

bool survey_exact(const Survey *survey, const Scene *scene, Reference *exact, Message *message)
{
    const ReferenceOptions options = {.width = survey->like.width, .height = survey->like.height};
    return reference_open(exact, scene, &options, message);
}

/* NULL if the setting has no row or its row no time. */
static const ResultRow *find_timed(const Survey *survey, const char *scene, const Quality *quality)
{
    const ResultRow *row = results_find(&survey->results, scene, quality);
    return row && row->time > 0 ? row : NULL;
}

/* Whether it differs from the usual one in interpolation, divisions, precision and normals alone.
 */
static bool is_common(Quality quality)
{
    static const QualityAxis axes[] = {AXIS_INTERPOLATION, AXIS_DIVISIONS, AXIS_PRECISION,
                                       AXIS_NORMALS};
    const Quality usual = quality_usual();
    for (size_t i = 0; i < sizeof axes / sizeof axes[0]; i++)
        quality = quality_with(quality, axes[i], usual.choice[axes[i]]);
    return quality_equal(&quality, &usual);
}

static bool has_usual_divisions(const Quality *quality)
{
    return quality->choice[AXIS_DIVISIONS] == quality_usual().choice[AXIS_DIVISIONS];
}

/* The planned settings of a scene, the usual one first. */
static void planned(const Survey *survey, int scene, QualityList *list)
{
    QualityList all;
    setting_times_plan(survey->plan.quick, &all);
    *list = (QualityList){.qualities = NULL};
    for (int i = 0; i < all.count; i++)
        if ((!STUDY_SCENES[scene].few || is_common(all.qualities[i])) &&
            (scene != STUDY_FILE || has_usual_divisions(&all.qualities[i])))
            quality_list_add(list, &all.qualities[i]);
    quality_list_close(&all);
}

/* The settings of a scene and a part without rows; all of them if the usual one has none, because
 * times are ratios to its time. */
static void missing(const Survey *survey, int scene, QualityList *list)
{
    const StudySceneInfo *info = &STUDY_SCENES[scene];
    const Quality usual = quality_usual();
    const bool based = find_timed(survey, info->name, &usual) != NULL;
    QualityList plan;
    planned(survey, scene, &plan);
    *list = (QualityList){.qualities = NULL};
    for (int i = 0; i < plan.count; i++)
        if ((i == 0 || part_has(survey->plan.part, (uint64_t)i)) &&
            !(based && find_timed(survey, info->name, &plan.qualities[i])))
            quality_list_add(list, &plan.qualities[i]);
    quality_list_close(&plan);
}

/* Progress in all scenes, in settings. */
typedef struct Work {
    Progress progress;
    double deadline; /* by clock_now */
    int done, total;
} Work;

static SettingTimes times_of(Survey *survey, int scene, const StudyScene *made,
                             const Reference *exact)
{
    const Quality usual = quality_usual();
    SettingTimes times = {.renderer = survey->renderer,
                          .scene = &made->scene,
                          .exact = exact,
                          .like = survey->like,
                          .interrupted = &interrupted};
    snprintf(times.like.scene, sizeof times.like.scene, "%s", STUDY_SCENES[scene].name);
    const ResultRow *known = find_timed(survey, times.like.scene, &usual);
    if (known)
        times.usual = known->time;
    return times;
}

static bool measure_batches(Survey *survey, SettingTimes *times, const QualityList *list,
                            Work *work, Message *message)
{
    for (int first = 0; first < list->count; first += SETTING_TIMES_BATCH) {
        ResultRow rows[SETTING_TIMES_BATCH];
        const int left = list->count - first;
        const int count = left < SETTING_TIMES_BATCH ? left : SETTING_TIMES_BATCH;
        const double seconds = work->deadline - clock_now();
        if (!setting_times_measure(times, list->qualities + first, count,
                                   seconds * count / (work->total - work->done), rows, message) ||
            !results_append(survey->path, rows, count, message))
            return false;
        for (int i = 0; i < count; i++)
            results_add(&survey->results, &rows[i]);
        work->done += count;
        progress_update(&work->progress, work->done, work->total);
    }
    return true;
}

static bool survey_scene(Survey *survey, int scene, Work *work, Message *message)
{
    QualityList list;
    StudyScene made;
    Reference exact;
    missing(survey, scene, &list);
    if (list.count == 0)
        return true;
    study_scene(scene, &made);
    if (!survey_exact(survey, &made.scene, &exact, message)) {
        quality_list_close(&list);
        return false;
    }
    SettingTimes times = times_of(survey, scene, &made, &exact);
    const bool done = measure_batches(survey, &times, &list, work, message);
    setting_renderer_forget(survey->renderer);
    reference_close(&exact);
    quality_list_close(&list);
    return done;
}

bool survey_run(Survey *survey, const int *scenes, int count, Message *message)
{
    struct sigaction old[2], action = {.sa_handler = interrupt};
    Work work = {.progress = progress_start("measuring")};
    bool done = true;
    int whole = 0;
    for (int i = 0; i < STUDY_SCENE_COUNT; i++) {
        QualityList list;
        planned(survey, i, &list);
        whole += list.count;
        quality_list_close(&list);
    }
    for (int i = 0; i < count; i++) {
        QualityList list;
        missing(survey, scenes[i], &list);
        work.total += list.count;
        quality_list_close(&list);
    }
    work.deadline = clock_now() + (survey->plan.quick ? QUICK : WHOLE) * work.total / whole;
    interrupted = 0;
    sigaction(SIGINT, &action, &old[0]);
    sigaction(SIGTERM, &action, &old[1]);
    for (int i = 0; i < count && done; i++)
        done = survey_scene(survey, scenes[i], &work, message);
    sigaction(SIGINT, &old[0], NULL);
    sigaction(SIGTERM, &old[1], NULL);
    progress_end(&work.progress);
    if (interrupted && !message->text[0])
        done =
            message_set(message, "interrupted; %d of %d rows are in %s; the same command goes on",
                        work.done, work.total, survey->path);
    return done;
}

/* How many parts have left their rows in the folder, by a file's name; 0, with a message, if there
 * are none or some of other numbers. */
static int count_parts(const Survey *survey, Message *message)
{
    int count = 0;
    DIR *folder = opendir(survey->folder);
    for (const struct dirent *entry; folder && (entry = readdir(folder));) {
        Part part;
        int end = 0;
        if (sscanf(entry->d_name, "results-%d-of-%d.csv%n", &part.number, &part.count, &end) != 2 ||
            end == 0 || entry->d_name[end] || part.count < 1 || part.count > PARTS_MAX)
            continue;
        if (count && part.count != count) {
            message_set(message, "%s: has parts of %d and of %d; remove those of one survey",
                        survey->folder, count, part.count);
            count = 0;
            break;
        }
        count = part.count;
    }
    if (folder)
        closedir(folder);
    if (!count)
        message_set(message, "%s: has no results of parts, which --part 1/N to N/N measure",
                    survey->folder);
    return count;
}

/* The row with its times as the first part's machine would have them. */
static ResultRow scaled(const ResultRow *row, double scale)
{
    ResultRow made = *row;
    double *const times[] = {&made.time,         &made.time_lower,  &made.time_upper,
                             &made.net_time,     &made.gpu_time,    &made.run_times[0],
                             &made.run_times[1], &made.run_times[2]};
    _Static_assert(RESULT_RUNS == 3, "run_times are listed");
    for (size_t i = 0; i < sizeof times / sizeof times[0]; i++)
        *times[i] *= scale;
    return made;
}

/* Adds the rows of a scene to the survey's. `parts` has each part's rows; `missing` counts
 * those that each lacks. */
static void merge_scene(Survey *survey, int scene, Results *parts, int count, int *missing)
{
    const char *name = STUDY_SCENES[scene].name;
    const Quality usual = quality_usual();
    QualityList plan;
    planned(survey, scene, &plan);
    const ResultRow *base = results_find(&parts[0], name, &usual);
    for (int i = 0; i < plan.count; i++) {
        const Results *part = &parts[i % count];
        const ResultRow *own = results_find(part, name, &usual);
        const ResultRow *row = results_find(part, name, &plan.qualities[i]);
        if (!row || !own || !base || !(row->time > 0 && own->time > 0 && base->time > 0)) {
            missing[base && base->time > 0 ? i % count : 0]++;
            continue;
        }
        const ResultRow made = part == parts ? *row : scaled(row, base->time / own->time);
        results_add(&survey->results, &made);
    }
    quality_list_close(&plan);
}

bool survey_merge(Survey *survey, const int *scenes, int count, Message *message)
{
    const int parts = count_parts(survey, message);
    Results *read = memory_new((size_t)parts, sizeof *read);
    int *missing = memory_new((size_t)parts + 1, sizeof *missing);
    bool done = parts > 0;
    if (survey->plan.fresh)
        results_close(&survey->results);
    if (survey->results.count)
        done = message_set(message, "%s: has rows already; --fresh drops them", survey->path);
    for (int i = 0; i < parts && done; i++) {
        char path[PATH_MAX];
        part_path(survey, (Part){i + 1, parts}, path);
        done = results_read(&read[i], path, &survey->like, message);
    }
    for (int i = 0; i < count && done; i++)
        merge_scene(survey, scenes[i], read, parts, missing);
    for (int i = 0; i < parts && done; i++)
        if (missing[i])
            done =
                message_set(message, "%s: %d rows of its part %d/%d are missing; run it to the end",
                            survey->folder, missing[i], i + 1, parts);
    done =
        done && results_append(survey->path, survey->results.rows, survey->results.count, message);
    for (int i = 0; i < parts; i++)
        results_close(&read[i]);
    free(missing);
    free(read);
    return done;
}

bool survey_again(Survey *survey, int scene, const Quality *qualities, int count, ResultRow *rows,
                  Message *message)
{
    Quality all[SETTING_TIMES_BATCH] = {quality_usual()};
    ResultRow measured[SETTING_TIMES_BATCH];
    StudyScene made;
    Reference exact;
    study_scene(scene, &made);
    if (!survey_exact(survey, &made.scene, &exact, message))
        return false;
    for (int i = 0; i < count; i++)
        all[1 + i] = qualities[i];
    SettingTimes times = times_of(survey, scene, &made, &exact);
    times.usual = 0; /* as of now */
    const bool done = setting_times_measure(&times, all, 1 + count, survey->plan.quick ? 1 : 4,
                                            measured, message);
    setting_renderer_forget(survey->renderer);
    reference_close(&exact);
    for (int i = 0; i < count && done; i++)
        rows[i] = measured[1 + i];
    return done;
}

void survey_close(Survey *survey)
{
    if (!survey)
        return;
    setting_renderer_close(survey->renderer);
    results_close(&survey->results);
    *survey = (Survey){.renderer = NULL};
}
