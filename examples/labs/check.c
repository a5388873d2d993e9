/*
 * check: says what is wrong with a lab's submission, within a second.
 *
 * Draws it in scenes that reveal mistakes, compares with the exact pictures, and names the mistake
 * whose pictures match. A second process judges, because submitted shaders may hang or crash the
 * driver.
 */
#include "app/options.h"
#include "base/output.h"
#include "labs/check/judge.h"
#include "labs/check/new_lab.h"
#include "labs/class/class.h"
#include "labs/sandbox/sandboxed_check.h"
#include "labs/submission/lab_json.h"
#include "labs/submission/verdict_json.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>

static int seed = -1, late;
static double limit = 10;
static bool report;
static const char *json, *pictures, *expected, *own, *fresh, *solution;

static const Parameter parameters[] = {
    {"lab", "the folder of a lab of your own, instead of LAB; see TEACHING.md", PARAMETER_TEXT,
     .value = &own, .placeholder = "DIR"},
    {"report", "with --lab DIR: which changes of its solution no scene shows", PARAMETER_FLAG,
     .value = &report},
    {"new-lab", "make this folder, a lab to edit, from the shaders of --solution", PARAMETER_TEXT,
     .value = &fresh, .placeholder = "DIR"},
    {"solution", "with --new-lab: its two shaders, which work", PARAMETER_TEXT, .value = &solution,
     .placeholder = "FILE.vert FILE.frag"},
    {"seed", "seed of the second set of scenes; -1: random", PARAMETER_WHOLE, .value = &seed,
     .min = -1, .max = 2147483647},
    {"json", "the result as JSON; - is standard output", PARAMETER_TEXT, .value = &json,
     .placeholder = "FILE"},
    {"pictures", "where to write a picture of the worst scene: drawn, right, difference",
     PARAMETER_TEXT, .value = &pictures, .placeholder = "DIR"},
    {"limit", "processor time for the submission, in seconds", PARAMETER_NUMBER, .value = &limit,
     .min = 0.1, .max = 3600},
    {"late", "with --lab DIR: handed in so many days late, by the rule in lab.json",
     PARAMETER_WHOLE, .value = &late, .min = 0, .max = 10000},
    {"expected", "only write the exact picture of LAB's own scene to this file", PARAMETER_TEXT,
     .value = &expected, .placeholder = "FILE"},
    {.name = NULL},
};

static const Usage usage = {
    .name = "check",
    .summary = "says what is wrong with a lab's submission, and where to look",
    .names = "LAB PATH",
    .details =
        "LAB is 5, lab05 or lab05_per_fragment; PATH is a folder, an archive or a file; the\n"
        "exit status is 0 if the submission is right.\n"
        "\nTry:  check lab05 mine\n"
        "      check lab05 mine --pictures found --json found/result.json\n"
        "      check --new-lab mylab --solution my.vert my.frag\n"
        "      check --lab mylab mine\n"
        "      check --class DIR --lab 5 -o results\n"
        "The last judges a whole class: see check --class DIR --help.\n",
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
                                 .seed = choose_seed(),
                                 .backend = options->canvas.backend,
                                 .pictures = pictures};
    struct stat status;
    if (stat(folder, &status) != 0) {
        message_set(message, "%s: %s", folder, strerror(errno));
        return options_fail(usage.name, message, EXIT_USAGE);
    }
    if (json && !output_check(json, message))
        return options_fail(usage.name, message, EXIT_FAILED);
    if (!sandboxed_check(&judged, folder, limit, &verdict, message))
        return options_fail(usage.name, message, EXIT_FAILED);
    verdict_late(&verdict, lab, late);
    const bool quiet = json && json[0] == '-' && !json[1];
    if (!quiet)
        verdict_print(&verdict, lab, pictures, stdout);
    if (json && !verdict_write(&verdict, lab, folder, json, message))
        return options_fail(usage.name, message, EXIT_FAILED);
    if (json && !quiet)
        options_tell(usage.name, "wrote %s", json);
    return options_finish(usage.name, verdict.kind == VERDICT_RIGHT ? 0 : EXIT_FAILED);
}

static int make_lab(char *const *names, Message *message)
{
    if (!fresh || !solution || !names[0] || names[1]) {
        message_set(message, "a new lab needs two shaders: check --new-lab mylab --solution "
                             "my.vert my.frag");
        return options_fail(usage.name, message, EXIT_USAGE);
    }
    if (!new_lab_write(fresh, solution, names[0], message))
        return options_fail(usage.name, message, EXIT_FAILED);
    printf("%s: edit TASK.md, lab.json and the starter; then check --lab %s %s/solution\n", fresh,
           fresh, fresh);
    return options_finish(usage.name, 0);
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
    char *const *names = options.names;
    if (fresh || solution)
        return make_lab(names, &message);
    const int count = !own + !(expected || report);
    int given = 0;
    while (names[given])
        given++;
    if (given != count) {
        message_set(&message, expected ? "--expected FILE takes only LAB or --lab DIR"
                              : own    ? "needs a submission: check --lab mylab mine"
                                       : "needs a lab and a folder: check lab05 mine");
        return options_fail(usage.name, &message, EXIT_USAGE);
    }
    const Lab *lab = lab_open(own ? own : names[0], &message);
    if (!lab)
        return options_fail(usage.name, &message, EXIT_USAGE);
    if (late && lab->points.day_count == 0) {
        message_set(&message, "--late: lab.json of %s has no \"late\"", lab->name);
        return options_fail(usage.name, &message, EXIT_USAGE);
    }
    if (report)
        return lab_report(lab, stdout, &message) ? options_finish(usage.name, 0)
                                                 : options_fail(usage.name, &message, EXIT_FAILED);
    if (!expected)
        return check(&options, lab, names[count - 1], &message);
    if (!judge_expected(lab, expected, &message))
        return options_fail(usage.name, &message, EXIT_FAILED);
    options_tell(usage.name, "wrote %s", expected);
    return options_finish(usage.name, 0);
}
