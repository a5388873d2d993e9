#include "study/arithmetic/arithmetic.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/progress.h"

#include <pthread.h>
#include <stdlib.h>

enum { WAYS = METER_STAGES * METER_PRECISIONS };

static Arithmetic *way_of(Arithmetics *found, int way)
{
    return &found->of[way / METER_PRECISIONS][way % METER_PRECISIONS];
}

/* Formats and claims alone. */
static bool arithmetic_formats(const Meter *meter, Arithmetics *found, Message *message)
{
    *found = (Arithmetics){.inputs = 0};
    snprintf(found->renderer, sizeof found->renderer, "%s", meter->canvas.renderer);
    snprintf(found->version, sizeof found->version, "%s", meter->canvas.version);
    for (int way = 0; way < WAYS; way++) {
        const MeterStage stage = (MeterStage)(way / METER_PRECISIONS);
        const MeterPrecision precision = (MeterPrecision)(way % METER_PRECISIONS);
        Arithmetic *of = way_of(found, way);
        of->claim = meter_claim(stage, precision);
        if (!meter_format(meter, stage, precision, &of->format, message))
            return false;
    }
    return true;
}

/* One batch of a function, for all ways with numbers of one format. */
typedef struct Work {
    Batch batch;
    float results[WAYS][BATCH_COUNT][4];
    Function function;
    int number;
} Work;

/* Of one format. Two batches are at work: while the driver computes one, a helper judges the one
 * before, and fills in the next in its place. */
typedef struct Survey {
    const Meter *meter;
    Arithmetics *found;
    const Format *format;
    bool ways[WAYS]; /* those with this format */
    GLuint programs[WAYS];
    Work *works[2];
    Progress *progress;
    int done, total; /* batches times ways */
} Survey;

/* What the helper does with a work: judge what was computed, then fill it again. */
typedef struct Help {
    Survey *survey;
    Work *work;
    bool judges, fills, right;
    Function function; /* to fill in */
    int number;
    Message message;
} Help;

static void *help(void *argument)
{
    Help *help = argument;
    Survey *survey = help->survey;
    Work *work = help->work;
    help->right = true;
    for (int way = 0; way < WAYS && help->judges; way++)
        if (survey->ways[way])
            batch_judge(&work->batch, work->function, survey->format,
                        (const float(*)[4])work->results[way],
                        &way_of(survey->found, way)->accuracies[work->function]);
    if (help->fills) {
        work->function = help->function;
        work->number = help->number;
        batch_fill(&work->batch, work->function, survey->format, work->number);
        help->right = work->number > 0 || truth_check(&work->batch, work->function, &help->message);
    }
    return NULL;
}

static void drop_programs(Survey *survey)
{
    for (int way = 0; way < WAYS; way++) {
        glDeleteProgram(survey->programs[way]);
        survey->programs[way] = 0;
    }
}

static bool compile(Survey *survey, Function function, Message *message)
{
    drop_programs(survey);
    for (int way = 0; way < WAYS; way++)
        if (survey->ways[way]) {
            survey->programs[way] =
                meter_program(FUNCTIONS[function].code, (MeterStage)(way / METER_PRECISIONS),
                              (MeterPrecision)(way % METER_PRECISIONS), message);
            if (!survey->programs[way])
                return false;
        }
    return true;
}

static bool compute(Survey *survey, Work *work, Message *message)
{
    bool done = work->number > 0 || compile(survey, work->function, message);
    meter_load(survey->meter, (const float(*)[4])work->batch.a, (const float(*)[4])work->batch.b,
               BATCH_COUNT);
    for (int way = 0; way < WAYS && done; way++)
        if (survey->ways[way]) {
            const MeterStage stage = (MeterStage)(way / METER_PRECISIONS);
            done = meter_run(survey->meter, survey->programs[way], stage, work->results[way],
                             BATCH_COUNT, message);
            progress_update(survey->progress, ++survey->done, survey->total);
        }
    return done;
}

/* The batches of a format, function by function: false after the last. */
static bool next_batch(const Survey *survey, Function *function, int *number)
{
    if (++*number < batch_count(*function, survey->format, survey->found->inputs))
        return true;
    *number = 0;
    return ++*function < FUNCTION_COUNT;
}

static bool measure_format(Survey *survey, Message *message)
{
    Help task = {.survey = survey, .work = survey->works[0], .fills = true};
    help(&task);
    for (int i = 0;; i++) {
        pthread_t thread;
        if (!task.right)
            return message_set(message, "%s", task.message.text);
        task.work = survey->works[(i + 1) % 2];
        task.judges = i > 0;
        task.fills = next_batch(survey, &task.function, &task.number);
        const bool parallel = pthread_create(&thread, NULL, help, &task) == 0;
        const bool done = compute(survey, survey->works[i % 2], message);
        if (parallel)
            pthread_join(thread, NULL);
        else
            help(&task);
        if (!done)
            return false;
        if (!task.fills) {
            help(&(Help){.survey = survey, .work = survey->works[i % 2], .judges = true});
            return true;
        }
    }
}

/* How many batches all formats have, times the ways that compute them. */
static int count_runs(Arithmetics *found)
{
    int runs = 0;
    for (int way = 0; way < WAYS; way++)
        for (int function = 0; function < FUNCTION_COUNT; function++)
            runs += batch_count((Function)function, &way_of(found, way)->format, found->inputs);
    return runs;
}

/* As many inputs as take less than a minute, at most 2^24, from the time that one run takes in each
 * stage. */
static bool choose_inputs(Survey *survey, Message *message)
{
    static const double LIMIT = 40; /* seconds */
    double each = 0;
    Work *work = survey->works[0];
    survey->format = &survey->found->of[METER_FRAGMENT][METER_HIGHP].format;
    batch_fill(&work->batch, FUNCTION_REFLECT, survey->format, 0);
    meter_load(survey->meter, (const float(*)[4])work->batch.a, (const float(*)[4])work->batch.b,
               BATCH_COUNT);
    for (int stage = 0; stage < METER_STAGES; stage++) {
        const GLuint program = meter_program(FUNCTIONS[FUNCTION_REFLECT].code, (MeterStage)stage,
                                             METER_HIGHP, message);
        double start = 0;
        for (int i = 0; i < 2; i++) { /* the first compiles */
            start = clock_now();
            if (!program || !meter_run(survey->meter, program, (MeterStage)stage, work->results[0],
                                       BATCH_COUNT, message))
                return false;
        }
        each += (clock_now() - start) / METER_STAGES;
        glDeleteProgram(program);
    }
    survey->found->inputs = 1L << 24;
    while (survey->found->inputs > 4L * BATCH_COUNT && each * count_runs(survey->found) > LIMIT)
        survey->found->inputs /= 2;
    return true;
}

static bool measure(Survey *survey, Message *message)
{
    Arithmetics *found = survey->found;
    bool measured[WAYS] = {false};
    if (found->inputs == 0 && !choose_inputs(survey, message))
        return false;
    survey->total = count_runs(found);
    for (int first = 0; first < WAYS; first++) {
        if (measured[first])
            continue;
        survey->format = &way_of(found, first)->format;
        for (int way = 0; way < WAYS; way++) {
            survey->ways[way] = format_equal(&way_of(found, way)->format, survey->format);
            measured[way] |= survey->ways[way];
        }
        if (!measure_format(survey, message))
            return false;
    }
    return true;
}

bool arithmetic_measure(const Meter *meter, long inputs, Arithmetics *found, Message *message)
{
    const double start = clock_now();
    Progress progress = progress_start("precision");
    if (!arithmetic_formats(meter, found, message) ||
        !raster_measure(meter, &found->raster, message))
        return false;
    found->inputs = inputs;
    Survey survey = {.meter = meter,
                     .found = found,
                     .works = {memory_new(1, sizeof(Work)), memory_new(1, sizeof(Work))},
                     .progress = &progress};
    const bool done = measure(&survey, message);
    progress_end(&progress);
    drop_programs(&survey);
    free(survey.works[0]);
    free(survey.works[1]);
    found->seconds = clock_now() - start;
    return done;
}

void arithmetic_line(const Arithmetics *found, char line[ARITHMETIC_LINE])
{
    size_t used = 0;
    line[0] = '\0';
    for (int stage = METER_STAGES - 1; stage >= 0; stage--) {
        const Arithmetic *of = found->of[stage];
        used += (size_t)snprintf(line + used, ARITHMETIC_LINE - used,
                                 "%s%s shaders compute with %d bits in highp, %d in mediump, %d in "
                                 "lowp",
                                 used ? "; " : "", METER_STAGE_NAMES[stage],
                                 of[METER_HIGHP].format.bits, of[METER_MEDIUMP].format.bits,
                                 of[METER_LOWP].format.bits);
    }
}
