/* A table of options. */
#include "labs/class/class_judge.h"

#include "app/arguments.h"
#include "app/help.h"
#include "app/options.h"
#include "labs/sandbox/sandbox.h"

#include <stdio.h>
#include <unistd.h>

static bool check_together(const ClassOptions *options, bool merge, Message *message)
{
    const char *folder = options->merged[0];
    if (merge && options->folder)
        return message_set(message, "--class and --merge: one of them");
    if (options->partial && !merge)
        return message_set(message, "--partial: is for --merge");
    if (merge && !folder)
        return message_set(message, "--merge: needs the folders to merge");
    if (!merge && folder)
        return message_set(message, "%s: not an option; --class takes one folder", folder);
    return true;
}

bool class_options_read(ClassOptions *options, int argc, char *argv[], Message *message)
{
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    const Parameter *answer;
    int limit = 10, seed = 1;
    bool merge = false;
    *options = (ClassOptions){.output = "results",
                              .jobs = processors < 1                ? 1
                                      : processors > CLASS_JOBS_MAX ? CLASS_JOBS_MAX
                                                                    : (int)processors};
    const Parameter table[] = {
        {"class",
         "judge every submission in DIR, or in a platform's .zip: folders, archives or files, one for "
         "each student, as people or learning platforms name them; each in a sandboxed process",
         PARAMETER_TEXT, &options->folder, .min = 1, .placeholder = "DIR", .standard = ""},
        {"lab",
         "which lab, or the folder of a lab of your own; default: the one that the names in DIR say",
         PARAMETER_TEXT, &options->lab, .placeholder = "LAB"},
        {"output",
         "the folder for results. A run continues an interrupted one: what is finished is judged "
         "again only if the submission has changed",
         PARAMETER_TEXT, &options->output, .min = 1, .letter = 'o', .placeholder = "OUT"},
        {"jobs", "submissions at a time", PARAMETER_WHOLE, &options->jobs, 1, CLASS_JOBS_MAX,
         .placeholder = "N", .standard = "one for each processor"},
        {"limit", "computing time for each submission", PARAMETER_WHOLE, &limit, 1,
         SANDBOX_SECONDS_MAX, .placeholder = "SECONDS"},
        {"seed", "of the scenes that the students do not know", PARAMETER_WHOLE, &seed, 0,
         2147483647, .placeholder = "N"},
        {"late", "who is late: names or numbers, each with a comma and days or a time",
         PARAMETER_TEXT, &options->late, .placeholder = "FILE"},
        {"part", "only the I-th of N parts; -o another folder for each part", PARAMETER_TEXT,
         &options->part, .codec = &OPTION_PART},
        {"merge",
         "join the results in the folders that are named, if no part or student is missing, double, "
         "or judged otherwise",
         PARAMETER_FLAG, .value = &merge},
        {"partial", "merge what there is, and say what is missing", PARAMETER_FLAG,
         .value = &options->partial},
        {"deterministic", "judge alike on different x86 processors", PARAMETER_FLAG,
         .value = &options->deterministic},
        {"again", "judge everything again; a worse result replaces none", PARAMETER_FLAG,
         .value = &options->again},
        {"help", "print this text", PARAMETER_FLAG, .letter = 'h'},
        {.name = NULL},
    };
    if (!arguments_read(table, argc, argv, &answer, message))
        return false;
    options->limit = limit;
    options->seed = (uint64_t)seed;
    options->merged = argv + 1;
    options->help = answer != NULL;
    if (answer) {
        printf("A whole class:  check --class DIR [options]\n"
               "                check --merge DIR... -o OUT\n");
        help_options(table);
        return true;
    }
    return check_together(options, merge, message);
}
