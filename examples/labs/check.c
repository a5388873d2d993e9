/*
 * check: what is wrong with a lab's submission, within a second.
 *
 * Draws it in scenes that show mistakes, compares with the exact pictures, and names the mistake
 * whose pictures match. The judging is done by a second process, which may hang or crash as the
 * driver does with somebody's shaders.
 */
#include "class.h"
#include "judge.h"
#include "options.h"
#include "output.h"
#include "stage.h"
#include "supervise.h"
#include "verdict_json.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/random.h>

static int seed = -1;
static double limit = 10;
static const char *json, *pictures, *expected;

static const Parameter parameters[] = {
    {.name = "seed",
     .help = "of the second set of scenes; -1: another one each time",
     .kind = PARAMETER_WHOLE,
     .value = &seed,
     .least = -1,
     .most = 2147483647},
    {.name = "json",
     .help = "a file for the result as JSON; - is standard output",
     .kind = PARAMETER_TEXT,
     .value = &json},
    {.name = "pictures",
     .help = "a folder for the worst scene: as drawn, as it should be, and the difference",
     .kind = PARAMETER_TEXT,
     .value = &pictures},
    {.name = "limit",
     .help = "seconds that the judging may take",
     .kind = PARAMETER_NUMBER,
     .value = &limit,
     .least = 0.1,
     .most = 3600},
    {.name = "expected",
     .help = "draws the exact picture of a LAB's own scene into this file, and checks nothing",
     .kind = PARAMETER_TEXT,
     .value = &expected},
    {.name = NULL},
};

static const Usage usage = {
    .name = "check",
    .summary = "says what is wrong with a submission of a lab, and where to look",
    .names = "LAB PATH",
    .details = "LAB is 5, lab05 or lab05_per_fragment; PATH is the folder with its files. The\n"
               "exit status is 0 where it is right.\n"
               "\nTry:  check lab05 mine\n"
               "      check lab05 mine --pictures found --json found/result.json\n"
               "      check --class DIR --lab 5 -o results\n"
               "The last is for a whole class; check --class DIR --help tells more.\n",
    .study = true,
    .parameters = parameters,
};

static uint64_t choose_seed(void)
{
    uint32_t random = 0;
    if (seed >= 0)
        return (uint64_t)seed;
    if (getrandom(&random, sizeof random, 0) != (ssize_t)sizeof random)
        return 1;
    return random & 0x7FFFFFFF;
}

static int check(const Options *options, const Lab *lab, const char *folder, Message *message)
{
    static Verdict verdict; /* large */
    const JudgeOptions judged = {.lab = lab,
                                 .folder = folder,
                                 .seed = choose_seed(),
                                 .backend = options->canvas.backend,
                                 .pictures = pictures};
    if (json && !output_check(json, message))
        return options_fail(usage.name, message, EXIT_FAILED);
    if (!supervise(&judged, limit, &verdict, message))
        return options_fail(usage.name, message, EXIT_FAILED);
    const bool quiet = json && json[0] == '-' && !json[1];
    if (!quiet)
        verdict_print(&verdict, lab, pictures, stdout);
    if (json && !verdict_write(&verdict, lab, folder, json, message))
        return options_fail(usage.name, message, EXIT_FAILED);
    return options_finish(usage.name, verdict.kind == VERDICT_RIGHT ? 0 : EXIT_FAILED);
}

int main(int argc, char *argv[])
{
    Options options;
    int code;
    Message message = {0};
    if (class_main(argc, argv, &code))
        return code;
    if (!options_begin(&options, &usage, argc, argv, &code))
        return code;
    if (options.doctor)
        return options_finish(usage.name, stage_doctor());
    char *const *names = options.names;
    if (!names[0] || (expected ? names[1] != NULL : !names[1] || names[2])) {
        message_set(&message, expected ? "--expected FILE goes with LAB alone"
                                       : "names a lab and a folder: check lab05 mine");
        return options_fail(usage.name, &message, EXIT_USAGE);
    }
    const Lab *lab = lab_find(names[0], &message);
    if (!lab)
        return options_fail(usage.name, &message, EXIT_USAGE);
    if (!expected)
        return check(&options, lab, names[1], &message);
    if (!judge_expected(lab, expected, &message))
        return options_fail(usage.name, &message, EXIT_FAILED);
    return options_finish(usage.name, 0);
}
