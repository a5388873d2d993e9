#include "study/measure/setting_times.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

/* Lists. */

void quality_list_add(QualityList *list, const Quality *quality)
{
    for (int i = 0; i < list->count; i++)
        if (quality_equal(&list->qualities[i], quality))
            return;
    Quality *added = memory_add(&list->qualities, &list->count, &list->capacity, sizeof *added);
    *added = *quality;
}

void quality_list_close(QualityList *list)
{
    free(list->qualities);
    *list = (QualityList){.qualities = NULL};
}

/* A text of this file, which is right. */
static void add_text(QualityList *list, const char *text)
{
    Quality quality;
    if (quality_parse(&quality, text, NULL))
        quality_list_add(list, &quality);
}

static const char *const QUICK[] = {
    "divisions=12",
    "divisions=24",
    "divisions=192",
    "interpolation=gouraud divisions=12",
    "interpolation=gouraud divisions=24",
    "interpolation=gouraud",
    "interpolation=gouraud divisions=192",
    "interpolation=flat divisions=24",
    "precision=mediump",
    "guards=off",
    "viewer=infinite",
    "supersample=2",
    "samples=4",
    "output=float",
};

/* Beyond the products below. */
static const char *const COMBINED[] = {
    "precision=mediump highlight=cross",
    "precision=mediump divisions=24",
    "interpolation=gouraud precision=mediump divisions=24",
    "interpolation=gouraud precision=mediump divisions=96",
    "guards=off normals=interpolated",
    "guards=off normals=interpolated divisions=192",
    "guards=off viewer=infinite lights=infinite divisions=24",
    "output=float divisions=128",
    "output=float divisions=256",
    "output=float divisions=512",
    "output=float highlight=cross divisions=256",
    "output=float supersample=2 divisions=256",
    "order=lecture matrices=float",
    "order=lecture matrices=compensated",
    "supersample=2 samples=4",
    "supersample=2 divisions=24",
    "supersample=2 divisions=128",
    "supersample=3 divisions=24",
    "supersample=3 divisions=128",
    "supersample=4 divisions=128",
    "samples=4 divisions=24",
    "samples=4 divisions=128",
    "interpolation=gouraud samples=4 divisions=96",
    "interpolation=gouraud supersample=2 divisions=96",
    "interpolation=gouraud supersample=2 divisions=24",
};

/* The setting with each choice of `axis` from `min` to `max`. */
static void add_axis(QualityList *list, Quality quality, QualityAxis axis, int min, int max)
{
    for (int choice = min; choice <= max; choice++) {
        const Quality other = quality_with(quality, axis, choice);
        quality_list_add(list, &other);
    }
}

/* All combinations of what makes lighting cheaper, with this interpolation. */
static void add_cheaper(QualityList *list, int interpolation, const char *const *divisions)
{
    for (int i = 0; divisions[i]; i++)
        for (int k = 0; k < 8; k++) {
            Quality quality = quality_with(quality_usual(), AXIS_INTERPOLATION, interpolation);
            quality_choose(&quality, "divisions", divisions[i], NULL);
            quality = quality_with(quality, AXIS_VIEWER, k & 1);
            quality = quality_with(quality, AXIS_LIGHTS, k >> 1 & 1);
            quality = quality_with(quality, AXIS_NORMALS,
                                   interpolation == INTERPOLATION_PHONG ? k >> 2 : 0);
            quality_list_add(list, &quality);
        }
}

void setting_times_plan(bool quick, QualityList *list)
{
    static const char *const PHONG_DIVISIONS[] = {"12", "16", "24", "32", "64", "128", NULL};
    static const char *const GOURAUD_DIVISIONS[] = {"24", "48", "96", "192", NULL};
    const Quality usual = quality_usual();
    *list = (QualityList){.qualities = NULL};
    quality_list_add(list, &usual);
    for (size_t i = 0; i < sizeof QUICK / sizeof QUICK[0] && quick; i++)
        add_text(list, QUICK[i]);
    if (quick)
        return;
    for (int axis = 0; axis < AXIS_COUNT; axis++)
        add_axis(list, usual, (QualityAxis)axis, 0, QUALITY_AXES[axis].count - 1);
    const int max = QUALITY_AXES[AXIS_DIVISIONS].count - 1;
    const Quality gouraud = quality_with(usual, AXIS_INTERPOLATION, INTERPOLATION_GOURAUD);
    const Quality flat = quality_with(usual, AXIS_INTERPOLATION, INTERPOLATION_FLAT);
    add_axis(list, gouraud, AXIS_DIVISIONS, 0, max);
    add_axis(list, flat, AXIS_DIVISIONS, 0, max - 2);
    add_cheaper(list, INTERPOLATION_PHONG, PHONG_DIVISIONS);
    add_cheaper(list, INTERPOLATION_GOURAUD, GOURAUD_DIVISIONS);
    for (size_t i = 0; i < sizeof COMBINED / sizeof COMBINED[0]; i++)
        add_text(list, COMBINED[i]);
}

/* Measuring. */

/* Timed are the settings of a batch, followed by: */
enum { USUAL = SETTING_TIMES_BATCH, AGAIN, EMPTY, TIMED };

typedef struct Timed {
    int rounds;                                         /* of each run */
    double wall[RESULT_RUNS][SETTING_TIMES_MAX_ROUNDS]; /* seconds */
    double gpu[RESULT_RUNS * SETTING_TIMES_MAX_ROUNDS];
    int gpu_count;
} Timed;

typedef struct Batch {
    SettingPicture drawings[USUAL + 1];
    Timed timed[TIMED];
    int count;
} Batch;

static bool visit(SettingTimes *times, Batch *batch, int number, int run, int round,
                  Message *message)
{
    Timed *timed = &batch->timed[number];
    double wall = 0, gpu = NAN;
    if (round >= timed->rounds)
        return true;
    if (number == EMPTY) {
        if (!setting_picture_empty(&batch->drawings[USUAL], &wall, message) ||
            !setting_picture_empty(&batch->drawings[USUAL], &wall, message))
            return false;
    } else {
        SettingPicture *drawing = &batch->drawings[number < USUAL ? number : USUAL];
        if (!setting_picture_frame(drawing, times->renderer, &wall, &gpu, message) ||
            !setting_picture_frame(drawing, times->renderer, &wall, &gpu, message))
            return false;
    }
    timed->wall[run][round] = wall;
    if (isfinite(gpu))
        timed->gpu[timed->gpu_count++] = gpu;
    return true;
}

static bool run_rounds(SettingTimes *times, Batch *batch, Message *message)
{
    Random random = {times->like.seed};
    int order[TIMED], max = 0, count = 0;
    for (int i = 0; i < TIMED; i++) {
        if (i >= batch->count && i < USUAL)
            continue;
        order[count++] = i;
        max = batch->timed[i].rounds > max ? batch->timed[i].rounds : max;
    }
    for (int run = 0; run < RESULT_RUNS; run++)
        for (int round = 0; round < max; round++) {
            for (int i = count - 1; i > 0; i--) {
                const int k = random_below(&random, i + 1), kept = order[i];
                order[i] = order[k];
                order[k] = kept;
            }
            for (int i = 0; i < count; i++) {
                if (*times->interrupted || !visit(times, batch, order[i], run, round, message))
                    return false;
            }
        }
    return true;
}

/* Rounds for each, so that together they take about `seconds` and no setting takes most of it. */
static void share_rounds(Batch *batch, const double *frames, double seconds)
{
    enum { MIN_ROUNDS = 3 };
    const double share = seconds / (2 * RESULT_RUNS * (batch->count + 3));
    int max = 2; /* of the usual one, for the noise */
    for (int i = 0; i < batch->count; i++) {
        const double rounds = share / frames[i];
        batch->timed[i].rounds = rounds < MIN_ROUNDS                 ? MIN_ROUNDS
                                 : rounds > SETTING_TIMES_MAX_ROUNDS ? SETTING_TIMES_MAX_ROUNDS
                                                                     : (int)rounds;
        max = batch->timed[i].rounds > max ? batch->timed[i].rounds : max;
    }
    for (int i = USUAL; i < TIMED; i++)
        batch->timed[i].rounds = max;
}

/* The ratios of a setting to the usual one, by round; returns their number. */
static int ratios_of(const Batch *batch, int number, int run, double *ratios)
{
    const Timed *timed = &batch->timed[number], *usual = &batch->timed[USUAL];
    for (int i = 0; i < timed->rounds; i++)
        ratios[i] = timed->wall[run][i] / usual->wall[run][i];
    return timed->rounds;
}

static double median_ratio(const Batch *batch, int number, double *lower, double *upper)
{
    double all[RESULT_RUNS * SETTING_TIMES_MAX_ROUNDS];
    int count = 0;
    for (int run = 0; run < RESULT_RUNS; run++)
        count += ratios_of(batch, number, run, all + count);
    *lower = clock_quantile(all, count, 0.25);
    *upper = clock_quantile(all, count, 0.75);
    return clock_median(all, count);
}

/* The usual setting against itself: the distance of the median ratio from 1, plus the standard
 * error of the median of as many ratios as the setting has (0.93 interquartile ranges / sqrt(count)
 * for a normal distribution). */
static double noise_of(const Batch *batch, int number)
{
    double lower, upper;
    const double median = median_ratio(batch, AGAIN, &lower, &upper);
    const int count = RESULT_RUNS * batch->timed[number].rounds;
    return fabs(median - 1) + 0.93 * (upper - lower) / sqrt(count);
}

/* Seconds of a frame that nothing disturbs: what else runs only ever adds to it, up to several
 * times as much. */
static double fastest(const Batch *batch, int number)
{
    static const double SHARE = 0.1;
    const Timed *timed = &batch->timed[number];
    double all[RESULT_RUNS * SETTING_TIMES_MAX_ROUNDS];
    int count = 0;
    for (int run = 0; run < RESULT_RUNS; run++)
        for (int i = 0; i < timed->rounds; i++)
            all[count++] = timed->wall[run][i];
    return clock_quantile(all, count, SHARE);
}

static double usual_milliseconds(const Batch *batch)
{
    return 1e3 * fmin(fastest(batch, USUAL), fastest(batch, AGAIN));
}

/* By the driver's timer; NAN if it is not plausible: if for the usual setting it reports more than
 * the whole frame or less than a fifth of it. (The timer of a deferred renderer may measure
 * nothing.) */
static double gpu_milliseconds(Batch *batch, int number)
{
    Timed *usual = &batch->timed[USUAL], *timed = &batch->timed[number];
    const double known = 1e3 * clock_median(usual->gpu, usual->gpu_count);
    const double whole = usual_milliseconds(batch);
    if (!(known > 0.2 * whole && known < whole))
        return NAN;
    return 1e3 * clock_median(timed->gpu, timed->gpu_count);
}

/* To the usual setting, and its quartiles. Where so much disturbs both that the ratio of a round
 * says little: that of their fastest frames. */
static double ratio_of(const Batch *batch, int number, bool noisy, double *lower, double *upper)
{
    const double median = median_ratio(batch, number, lower, upper);
    return noisy ? 1e3 * fastest(batch, number) / usual_milliseconds(batch) : median;
}

static void fill_times(const SettingTimes *times, Batch *batch, int number, ResultRow *row)
{
    static const double NOISY = 0.05;
    const Quality usual = quality_usual();
    /* The usual setting's spread is that of the A/A measurement. */
    const int from = quality_equal(&row->quality, &usual) ? AGAIN : number;
    double lower, upper, ignored[2];
    row->noise = noise_of(batch, from);
    const bool noisy = row->noise > NOISY;
    const double ratio = ratio_of(batch, from, noisy, &lower, &upper);
    row->time = from == AGAIN ? times->usual : times->usual * ratio;
    row->time_lower = fmin(times->usual * lower, row->time);
    row->time_upper = fmax(times->usual * upper, row->time);
    for (int run = 0; run < RESULT_RUNS; run++) {
        double ratios[SETTING_TIMES_MAX_ROUNDS];
        const int count = ratios_of(batch, from, run, ratios);
        row->run_times[run] = times->usual * clock_median(ratios, count);
    }
    row->net_time =
        row->time - times->usual * ratio_of(batch, EMPTY, noisy, &ignored[0], &ignored[1]);
    row->gpu_time = gpu_milliseconds(batch, number);
}

/* The approximate time of a frame: of some, unless that takes long, the one disturbed least. */
static bool estimate(SettingTimes *times, SettingPicture *drawing, double *frame, Message *message)
{
    enum { FRAMES = 4 };
    static const double LONG = 0.05;
    double spent = 0;
    *frame = INFINITY;
    for (int i = 0; i < FRAMES && spent < LONG; i++) {
        double wall, gpu;
        if (!setting_picture_frame(drawing, times->renderer, &wall, &gpu, message))
            return false;
        *frame = fmin(*frame, wall);
        spent += wall;
    }
    return true;
}

/* Fills everything but times, and gives the approximate time of a frame. */
static bool look_at(SettingTimes *times, SettingPicture *drawing, ResultRow *row, double *frame,
                    Message *message)
{
    *row = times->like;
    row->quality = drawing->quality;
    if (!estimate(times, drawing, frame, message) ||
        !setting_picture_counts(drawing, times->renderer, row, message))
        return false;
    setting_picture_error(drawing, times->exact, row);
    return true;
}

bool setting_times_measure(SettingTimes *times, const Quality *qualities, int count, double seconds,
                           ResultRow *rows, Message *message)
{
    const Quality usual = quality_usual();
    const double start = clock_now();
    double frames[SETTING_TIMES_BATCH];
    bool done = true;
    Batch *batch = memory_new(1, sizeof *batch);
    batch->count = count;
    for (int i = 0; i < count && done && !*times->interrupted; i++)
        done = setting_picture_open(&batch->drawings[i], times->renderer, times->scene,
                                    &qualities[i], message) &&
               look_at(times, &batch->drawings[i], &rows[i], &frames[i], message);
    done = done && !*times->interrupted &&
           setting_picture_open(&batch->drawings[USUAL], times->renderer, times->scene, &usual,
                                message);
    if (done) {
        share_rounds(batch, frames, seconds - (clock_now() - start));
        done = run_rounds(times, batch, message);
    }
    if (done && times->usual == 0)
        times->usual = usual_milliseconds(batch);
    for (int i = 0; i < count && done; i++)
        fill_times(times, batch, i, &rows[i]);
    for (int i = 0; i <= USUAL; i++)
        setting_picture_close(&batch->drawings[i]);
    free(batch);
    return done;
}
