#include "trials.h"

#include "progress.h"
#include "statistics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Lists. */

bool setting_list_add(SettingList *list, const Setting *setting, Message *message)
{
    for (int i = 0; i < list->count; i++)
        if (setting_equal(&list->settings[i], setting))
            return true;
    if (list->count == list->capacity) {
        const int capacity = list->capacity ? 2 * list->capacity : 64;
        Setting *more = realloc(list->settings, (size_t)capacity * sizeof *more);
        if (!more)
            return message_set(message, "study: not enough memory");
        list->settings = more;
        list->capacity = capacity;
    }
    list->settings[list->count++] = *setting;
    return true;
}

void setting_list_close(SettingList *list)
{
    free(list->settings);
    *list = (SettingList){.settings = NULL};
}

static bool add_text(SettingList *list, const char *text, Message *message)
{
    Setting setting;
    return setting_parse(&setting, text, message) && setting_list_add(list, &setting, message);
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

/* Each choice of `axis`, from `least` to `most`, with what the setting has on the others. */
static bool add_axis(SettingList *list, Setting setting, SettingAxis axis, int least, int most,
                     Message *message)
{
    for (int choice = least; choice <= most; choice++) {
        const Setting other = setting_with(setting, axis, choice);
        if (!setting_list_add(list, &other, message))
            return false;
    }
    return true;
}

/* What makes the light's computation cheaper, in all combinations, with this interpolation. */
static bool add_cheaper(SettingList *list, int interpolation, const char *const *divisions,
                        Message *message)
{
    for (int i = 0; divisions[i]; i++) {
        for (int k = 0; k < 8; k++) {
            Setting setting = setting_with(setting_usual(), AXIS_INTERPOLATION, interpolation);
            if (!setting_choose(&setting, "divisions", divisions[i], message))
                return false;
            setting = setting_with(setting, AXIS_VIEWER, k & 1);
            setting = setting_with(setting, AXIS_LIGHTS, k >> 1 & 1);
            setting = setting_with(setting, AXIS_NORMALS,
                                   interpolation == INTERPOLATION_PHONG ? k >> 2 : 0);
            if (!setting_list_add(list, &setting, message))
                return false;
        }
    }
    return true;
}

bool trials_plan(bool quick, SettingList *list, Message *message)
{
    static const char *const PHONG_DIVISIONS[] = {"12", "16", "24", "32", "64", "128", NULL};
    static const char *const GOURAUD_DIVISIONS[] = {"24", "48", "96", "192", NULL};
    const Setting usual = setting_usual();
    *list = (SettingList){.settings = NULL};
    if (!setting_list_add(list, &usual, message))
        return false;
    if (quick) {
        for (size_t i = 0; i < sizeof QUICK / sizeof QUICK[0]; i++)
            if (!add_text(list, QUICK[i], message))
                return false;
        return true;
    }
    for (int axis = 0; axis < AXIS_COUNT; axis++)
        if (!add_axis(list, usual, (SettingAxis)axis, 0, SETTING_AXES[axis].count - 1, message))
            return false;
    const int most = SETTING_AXES[AXIS_DIVISIONS].count - 1;
    const Setting gouraud = setting_with(usual, AXIS_INTERPOLATION, INTERPOLATION_GOURAUD);
    const Setting flat = setting_with(usual, AXIS_INTERPOLATION, INTERPOLATION_FLAT);
    if (!add_axis(list, gouraud, AXIS_DIVISIONS, 0, most, message) ||
        !add_axis(list, flat, AXIS_DIVISIONS, 0, most - 2, message) ||
        !add_cheaper(list, INTERPOLATION_PHONG, PHONG_DIVISIONS, message) ||
        !add_cheaper(list, INTERPOLATION_GOURAUD, GOURAUD_DIVISIONS, message))
        return false;
    for (size_t i = 0; i < sizeof COMBINED / sizeof COMBINED[0]; i++)
        if (!add_text(list, COMBINED[i], message))
            return false;
    return true;
}

/* Measuring. */

/* What is timed: the settings of a batch, and behind them: */
enum { USUAL = TRIALS_BATCH, AGAIN, EMPTY, TIMED };

typedef struct Timed {
    int rounds;                                   /* of each run */
    double wall[RESULT_RUNS][TRIALS_MOST_ROUNDS]; /* seconds */
    double gpu[RESULT_RUNS * TRIALS_MOST_ROUNDS];
    int gpu_count;
} Timed;

typedef struct Batch {
    Drawing drawings[USUAL + 1];
    Timed timed[TIMED];
    int count;
} Batch;

/* xorshift64* (Vigna, An experimental exploration of Marsaglia's xorshift generators, 2016). */
static unsigned random_below(unsigned long long *state, unsigned limit)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (unsigned)((*state * 2685821657736338717ULL >> 33) % limit);
}

static bool visit(Trials *trials, Batch *batch, int number, int run, int round, Message *message)
{
    Timed *timed = &batch->timed[number];
    double wall = 0, gpu = NAN;
    if (round >= timed->rounds)
        return true;
    if (number == EMPTY) {
        if (!drawing_empty(&batch->drawings[USUAL], trials->studio, &wall, message) ||
            !drawing_empty(&batch->drawings[USUAL], trials->studio, &wall, message))
            return false;
    } else {
        Drawing *drawing = &batch->drawings[number < USUAL ? number : USUAL];
        if (!drawing_frame(drawing, trials->studio, &wall, &gpu, message) ||
            !drawing_frame(drawing, trials->studio, &wall, &gpu, message))
            return false;
    }
    timed->wall[run][round] = wall;
    if (isfinite(gpu))
        timed->gpu[timed->gpu_count++] = gpu;
    return true;
}

static bool run_rounds(Trials *trials, Batch *batch, Message *message)
{
    unsigned long long state = 0x9E3779B97F4A7C15ULL ^ trials->like.seed;
    int order[TIMED], most = 0, count = 0;
    for (int i = 0; i < TIMED; i++) {
        if (i >= batch->count && i < USUAL)
            continue;
        order[count++] = i;
        most = batch->timed[i].rounds > most ? batch->timed[i].rounds : most;
    }
    for (int run = 0; run < RESULT_RUNS; run++) {
        for (int round = 0; round < most; round++) {
            for (int i = count - 1; i > 0; i--) {
                const int k = (int)random_below(&state, (unsigned)i + 1), kept = order[i];
                order[i] = order[k];
                order[k] = kept;
            }
            for (int i = 0; i < count; i++) {
                if (*trials->interrupted || !visit(trials, batch, order[i], run, round, message))
                    return false;
            }
        }
    }
    return true;
}

/* Rounds for each, so that all together take about `seconds`, and no setting takes most of it. */
static void share_rounds(Batch *batch, const double *frames, double seconds)
{
    const double share = seconds / (2 * RESULT_RUNS * (batch->count + 3));
    int most = 2; /* of the usual one, for the noise */
    for (int i = 0; i < batch->count; i++) {
        const double rounds = share / frames[i];
        batch->timed[i].rounds = rounds < 1                    ? 1
                                 : rounds > TRIALS_MOST_ROUNDS ? TRIALS_MOST_ROUNDS
                                                               : (int)rounds;
        most = batch->timed[i].rounds > most ? batch->timed[i].rounds : most;
    }
    for (int i = USUAL; i < TIMED; i++)
        batch->timed[i].rounds = most;
}

/* The ratios of a setting to the usual one, round by round; their number. */
static int ratios_of(const Batch *batch, int number, int run, double *ratios)
{
    const Timed *timed = &batch->timed[number], *usual = &batch->timed[USUAL];
    for (int i = 0; i < timed->rounds; i++)
        ratios[i] = timed->wall[run][i] / usual->wall[run][i];
    return timed->rounds;
}

static double median_ratio(const Batch *batch, int number, double *lower, double *upper)
{
    double all[RESULT_RUNS * TRIALS_MOST_ROUNDS];
    int count = 0;
    for (int run = 0; run < RESULT_RUNS; run++)
        count += ratios_of(batch, number, run, all + count);
    *lower = statistics_quantile(all, count, 0.25);
    *upper = statistics_quantile(all, count, 0.75);
    return statistics_quantile(all, count, 0.5);
}

/* The usual setting against itself: how far from 1 the median of the ratios came out, and the
 * standard error of the median of as many ratios as a setting has (0.93 interquartile ranges over
 * the root of their number, for errors of a normal distribution). */
static double noise_of(const Batch *batch, int number)
{
    double lower, upper;
    const double median = median_ratio(batch, AGAIN, &lower, &upper);
    const int count = RESULT_RUNS * batch->timed[number].rounds;
    return fabs(median - 1) + 0.93 * (upper - lower) / sqrt(count);
}

static double usual_milliseconds(const Batch *batch)
{
    double all[RESULT_RUNS * TRIALS_MOST_ROUNDS];
    int count = 0;
    for (int run = 0; run < RESULT_RUNS; run++)
        for (int i = 0; i < batch->timed[USUAL].rounds; i++)
            all[count++] = 1e3 * batch->timed[USUAL].wall[run][i];
    return statistics_quantile(all, count, 0.5);
}

/* As the driver's timer has it; NAN where that cannot be believed: where it says that the usual
 * setting takes longer than it took in all, or less than a fifth of that. (A driver that draws
 * later than it is told to measures nothing.) */
static double gpu_milliseconds(Batch *batch, int number)
{
    Timed *usual = &batch->timed[USUAL], *timed = &batch->timed[number];
    const double known = 1e3 * statistics_quantile(usual->gpu, usual->gpu_count, 0.5);
    const double whole = usual_milliseconds(batch);
    if (!(known > 0.2 * whole && known < whole))
        return NAN;
    return 1e3 * statistics_quantile(timed->gpu, timed->gpu_count, 0.5);
}

static void fill_times(const Trials *trials, Batch *batch, int number, ResultRow *row)
{
    const Setting usual = setting_usual();
    /* The usual setting against itself tells its own spread. */
    const int from = setting_equal(&row->setting, &usual) ? AGAIN : number;
    double lower, upper, ignored[2];
    const double ratio = median_ratio(batch, from, &lower, &upper);
    row->time = from == AGAIN ? trials->usual : trials->usual * ratio;
    row->time_lower = fmin(trials->usual * lower, row->time);
    row->time_upper = fmax(trials->usual * upper, row->time);
    for (int run = 0; run < RESULT_RUNS; run++) {
        double ratios[TRIALS_MOST_ROUNDS];
        const int count = ratios_of(batch, from, run, ratios);
        row->run_times[run] = trials->usual * statistics_quantile(ratios, count, 0.5);
    }
    row->net_time =
        row->time - trials->usual * median_ratio(batch, EMPTY, &ignored[0], &ignored[1]);
    row->gpu_time = gpu_milliseconds(batch, number);
    row->noise = noise_of(batch, from);
}

/* Everything of a row but times; and how long a frame takes, about. */
static bool look_at(Trials *trials, Drawing *drawing, ResultRow *row, double *frame,
                    Message *message)
{
    DrawingError error;
    DrawingCounts counts;
    double gpu;
    *row = trials->like;
    row->setting = drawing->setting;
    if (!drawing_frame(drawing, trials->studio, frame, &gpu, message) ||
        !drawing_error(drawing, trials->studio, trials->exact, &error, message) ||
        !drawing_counts(drawing, trials->studio, &counts, message))
        return false;
    row->interior_rms = error.interior_rms;
    row->interior_maximum = error.interior_maximum;
    row->all_rms = error.all_rms;
    row->all_maximum = error.all_maximum;
    row->interior_pixels = error.interior_pixels;
    row->vertices = counts.vertices;
    row->fragments = counts.fragments;
    row->vertex_operations = counts.vertex_operations;
    row->fragment_operations = counts.fragment_operations;
    return true;
}

bool trials_measure(Trials *trials, const Setting *settings, int count, double seconds,
                    ResultRow *rows, Message *message)
{
    const Setting usual = setting_usual();
    const double start = progress_now();
    double frames[TRIALS_BATCH];
    bool done = true;
    Batch *batch = calloc(1, sizeof *batch);
    if (!batch)
        return message_set(message, "study: not enough memory");
    batch->count = count;
    for (int i = 0; i < count && done && !*trials->interrupted; i++)
        done = drawing_open(&batch->drawings[i], trials->studio, trials->scene, &settings[i],
                            message) &&
               look_at(trials, &batch->drawings[i], &rows[i], &frames[i], message);
    done = done && !*trials->interrupted &&
           drawing_open(&batch->drawings[USUAL], trials->studio, trials->scene, &usual, message);
    if (done) {
        share_rounds(batch, frames, seconds - (progress_now() - start));
        done = run_rounds(trials, batch, message);
    }
    if (done && trials->usual == 0)
        trials->usual = usual_milliseconds(batch);
    for (int i = 0; i < count && done; i++)
        fill_times(trials, batch, i, &rows[i]);
    for (int i = 0; i <= USUAL; i++)
        drawing_close(&batch->drawings[i]);
    free(batch);
    return done;
}
