#include "study/measure/survey.h"

#include "base/clock.h"
#include "base/output.h"
#include "base/progress.h"
#include "study/measure/scenes.h"
#include "study/measure/trials.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Seconds for a whole survey, without tables and plots. */
static const double WHOLE = 260, QUICK = 13;

static volatile sig_atomic_t interrupted;

static void interrupt(int number)
{
    (void)number;
    interrupted = 1;
}

bool survey_open(Survey *survey, const Options *options, unsigned seed, bool quick, bool fresh,
                 Message *message)
{
    *survey = (Survey){.quick = quick,
                       .seconds = quick ? QUICK : WHOLE,
                       .like = {.width = options->width, .height = options->height, .seed = seed}};
    const char *threads = getenv("LP_NUM_THREADS");
    if (!output_folder(options->output, message) ||
        !shader_loader_check(&options->shaders, message) ||
        !studio_open(&survey->studio, &options->shaders, options->canvas.backend, options->width,
                     options->height, message))
        return false;
    snprintf(survey->path, sizeof survey->path, "%s/results.csv", options->output);
    snprintf(survey->like.renderer, sizeof survey->like.renderer, "%s; %s",
             studio_renderer(survey->studio), studio_version(survey->studio));
    snprintf(survey->like.threads, sizeof survey->like.threads, "%s",
             threads && threads[0] ? threads : "default");
    if (fresh && unlink(survey->path) != 0 && errno != ENOENT) {
        message_set(message, "%s: cannot be removed: %s", survey->path, strerror(errno));
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

/* The settings of a scene without rows; all of them if the usual one has none, because times are
 * ratios to its time. */
static bool missing(const Survey *survey, int scene, QualityList *list, Message *message)
{
    const StudySceneInfo *info = &STUDY_SCENES[scene];
    const Quality usual = quality_usual();
    const bool based = find_timed(survey, info->name, &usual) != NULL;
    QualityList plan;
    bool done = trials_plan(survey->quick, &plan, message);
    *list = (QualityList){.qualities = NULL};
    for (int i = 0; i < plan.count && done; i++)
        if ((!info->few || is_common(plan.qualities[i])) &&
            !(based && find_timed(survey, info->name, &plan.qualities[i])))
            done = quality_list_add(list, &plan.qualities[i], message);
    quality_list_close(&plan);
    return done;
}

/* Progress in all scenes, in settings. */
typedef struct Work {
    Progress progress;
    double deadline; /* by clock_now */
    int done, total;
} Work;

static Trials trials_of(Survey *survey, int scene, const StudyScene *made, const Reference *exact)
{
    const Quality usual = quality_usual();
    Trials trials = {.studio = survey->studio,
                     .scene = &made->scene,
                     .exact = exact,
                     .like = survey->like,
                     .interrupted = &interrupted};
    snprintf(trials.like.scene, sizeof trials.like.scene, "%s", STUDY_SCENES[scene].name);
    const ResultRow *known = find_timed(survey, trials.like.scene, &usual);
    if (known)
        trials.usual = known->time;
    return trials;
}

static bool measure_batches(Survey *survey, Trials *trials, const QualityList *list, Work *work,
                            Message *message)
{
    for (int first = 0; first < list->count; first += TRIALS_BATCH) {
        ResultRow rows[TRIALS_BATCH];
        const int left = list->count - first;
        const int count = left < TRIALS_BATCH ? left : TRIALS_BATCH;
        const double seconds = work->deadline - clock_now();
        if (!trials_measure(trials, list->qualities + first, count,
                            seconds * count / (work->total - work->done), rows, message) ||
            !results_append(survey->path, rows, count, message))
            return false;
        for (int i = 0; i < count; i++)
            if (!results_add(&survey->results, &rows[i], message))
                return false;
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
    if (!missing(survey, scene, &list, message) || list.count == 0) {
        quality_list_close(&list);
        return list.count == 0 && !message->text[0];
    }
    study_scene(scene, &made);
    if (!survey_exact(survey, &made.scene, &exact, message)) {
        quality_list_close(&list);
        return false;
    }
    Trials trials = trials_of(survey, scene, &made, &exact);
    const bool done = measure_batches(survey, &trials, &list, work, message);
    studio_forget(survey->studio);
    reference_close(&exact);
    quality_list_close(&list);
    return done;
}

bool survey_run(Survey *survey, const int *scenes, int count, Message *message)
{
    struct sigaction old[2], action = {.sa_handler = interrupt};
    Work work = {.progress = progress_start("measuring"),
                 .deadline = clock_now() + survey->seconds};
    bool done = true;
    for (int i = 0; i < count && done; i++) {
        QualityList list;
        done = missing(survey, scenes[i], &list, message);
        work.total += list.count;
        quality_list_close(&list);
    }
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

bool survey_again(Survey *survey, int scene, const Quality *qualities, int count, ResultRow *rows,
                  Message *message)
{
    static const double SECONDS = 2;
    Quality all[TRIALS_BATCH] = {quality_usual()};
    ResultRow measured[TRIALS_BATCH];
    StudyScene made;
    Reference exact;
    study_scene(scene, &made);
    if (!survey_exact(survey, &made.scene, &exact, message))
        return false;
    for (int i = 0; i < count; i++)
        all[1 + i] = qualities[i];
    Trials trials = trials_of(survey, scene, &made, &exact);
    trials.usual = 0; /* as of now */
    const bool done = trials_measure(&trials, all, 1 + count, SECONDS, measured, message);
    studio_forget(survey->studio);
    reference_close(&exact);
    for (int i = 0; i < count && done; i++)
        rows[i] = measured[1 + i];
    return done;
}

void survey_close(Survey *survey)
{
    if (!survey)
        return;
    studio_close(survey->studio);
    results_close(&survey->results);
    *survey = (Survey){.studio = NULL};
}
