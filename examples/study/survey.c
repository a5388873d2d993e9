#include "survey.h"

#include "efficient.h"
#include "output.h"
#include "progress.h"
#include "scenes.h"
#include "trials.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What a whole survey may take, in seconds, with something left for tables and plots. */
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

/* What is known of a setting; NULL where that has no time, and must be measured anew. */
static const ResultRow *find_timed(const Survey *survey, const char *scene, const Setting *setting)
{
    const ResultRow *row = results_find(&survey->results, scene, setting);
    return row && row->time > 0 ? row : NULL;
}

/* The settings of a scene that have no rows: all of them where the usual one has none, for times
 * are told in terms of its own. */
static bool missing(const Survey *survey, int scene, SettingList *list, Message *message)
{
    const StudySceneInfo *info = &STUDY_SCENES[scene];
    const Setting usual = setting_usual();
    const bool based = find_timed(survey, info->name, &usual) != NULL;
    SettingList plan;
    bool done = trials_plan(survey->quick, &plan, message);
    *list = (SettingList){.settings = NULL};
    for (int i = 0; i < plan.count && done; i++)
        if ((!info->few || efficient_allows(&plan.settings[i])) &&
            !(based && find_timed(survey, info->name, &plan.settings[i])))
            done = setting_list_add(list, &plan.settings[i], message);
    setting_list_close(&plan);
    return done;
}

/* What there is to measure in all, and how much of it is done. */
typedef struct Work {
    Progress progress;
    double deadline; /* by progress_now */
    int done, total;
} Work;

static Trials trials_of(Survey *survey, int scene, const StudyScene *made, const Reference *exact)
{
    const Setting usual = setting_usual();
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

static bool measure_batches(Survey *survey, Trials *trials, const SettingList *list, Work *work,
                            Message *message)
{
    for (int first = 0; first < list->count; first += TRIALS_BATCH) {
        ResultRow rows[TRIALS_BATCH];
        const int left = list->count - first;
        const int count = left < TRIALS_BATCH ? left : TRIALS_BATCH;
        const double seconds = work->deadline - progress_now();
        if (!trials_measure(trials, list->settings + first, count,
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
    SettingList list;
    StudyScene made;
    Reference exact;
    if (!missing(survey, scene, &list, message) || list.count == 0) {
        setting_list_close(&list);
        return list.count == 0 && !message->text[0];
    }
    study_scene(scene, &made);
    if (!survey_exact(survey, &made.scene, &exact, message)) {
        setting_list_close(&list);
        return false;
    }
    Trials trials = trials_of(survey, scene, &made, &exact);
    const bool done = measure_batches(survey, &trials, &list, work, message);
    studio_forget(survey->studio);
    reference_close(&exact);
    setting_list_close(&list);
    return done;
}

bool survey_run(Survey *survey, const int *scenes, int count, Message *message)
{
    struct sigaction old[2], action = {.sa_handler = interrupt};
    Work work = {.progress = progress_start("measuring"),
                 .deadline = progress_now() + survey->seconds};
    bool done = true;
    for (int i = 0; i < count && done; i++) {
        SettingList list;
        done = missing(survey, scenes[i], &list, message);
        work.total += list.count;
        setting_list_close(&list);
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

bool survey_once(Survey *survey, int scene, const Setting *setting, ResultRow *row,
                 Message *message)
{
    static const double SECONDS = 2;
    const Setting settings[2] = {setting_usual(), *setting};
    ResultRow rows[2];
    StudyScene made;
    Reference exact;
    study_scene(scene, &made);
    if (!survey_exact(survey, &made.scene, &exact, message))
        return false;
    Trials trials = trials_of(survey, scene, &made, &exact);
    const bool done = trials_measure(&trials, settings, 2, SECONDS, rows, message);
    studio_forget(survey->studio);
    reference_close(&exact);
    *row = rows[1];
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
