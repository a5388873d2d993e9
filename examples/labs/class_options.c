#include "class_options.h"

#include "options.h"
#include "parse.h"
#include "sandbox.h"

#include <getopt.h>
#include <string.h>
#include <unistd.h>

enum {
    OPTION_CLASS = 256,
    OPTION_LAB,
    OPTION_MERGE,
    OPTION_JOBS,
    OPTION_PART,
    OPTION_LIMIT,
    OPTION_SEED,
    OPTION_AGAIN,
};

static const struct option LONG_OPTIONS[] = {
    {"class", required_argument, NULL, OPTION_CLASS},
    {"lab", required_argument, NULL, OPTION_LAB},
    {"merge", no_argument, NULL, OPTION_MERGE},
    {"output", required_argument, NULL, 'o'},
    {"jobs", required_argument, NULL, OPTION_JOBS},
    {"part", required_argument, NULL, OPTION_PART},
    {"limit", required_argument, NULL, OPTION_LIMIT},
    {"seed", required_argument, NULL, OPTION_SEED},
    {"again", no_argument, NULL, OPTION_AGAIN},
    {"help", no_argument, NULL, 'h'},
    {NULL, 0, NULL, 0},
};

void class_options_help(FILE *file)
{
    fputs(
        "A whole class:  check --class DIR [options]\n"
        "                check --merge DIR... -o OUT\n"
        "      --class DIR        judges every submission in DIR: folders, archives or files, one\n"
        "                         for each student, as people or learning platforms name them;\n"
        "                         each in a process of its own that can do little\n"
        "      --lab LAB          which lab; default: as the names of DIR or of the files tell\n"
        "  -o, --output OUT       the folder for results; default results. A run goes on where\n"
        "                         another stopped; what is finished is judged again only when the\n"
        "                         submission has changed\n"
        "      --jobs N           submissions at a time; default: one for each processor\n"
        "      --limit SECONDS    of computing, for each submission; default 10\n"
        "      --seed N           of the scenes that the students do not know; default 1\n"
        "      --part K/N         only the K-th of N parts; -o another folder for each part\n"
        "      --merge            joins the results in the folders that are named\n"
        "      --again            judges everything again; a worse result replaces none\n",
        file);
}

static bool bad(const char *option, const char *value, const char *wanted, Message *message)
{
    return message_set(message, "--%s %s: must be %s", option, value, wanted);
}

/* "3/8". */
static bool read_part(const char *text, ClassOptions *options, Message *message)
{
    char first[16];
    const char *slash = strchr(text, '/');
    const size_t length = slash ? (size_t)(slash - text) : 0;
    snprintf(first, sizeof first, "%.*s", (int)(length < 15 ? length : 15), text);
    if (!slash || length > 14 || !parse_whole(slash + 1, 1, CLASS_PARTS_MOST, &options->parts) ||
        !parse_whole(first, 1, options->parts, &options->part))
        return bad("part", text, "K/N, 1/N to N/N, as in 3/8", message);
    return true;
}

static bool read_option(ClassOptions *options, int option, const char *value, Message *message)
{
    int number = 0;
    switch (option) {
    case OPTION_CLASS:
        options->folder = value;
        return value[0] ? true : message_set(message, "--class: the name is empty");
    case OPTION_LAB:
        options->lab = value;
        return true;
    case 'o':
        options->output = value;
        return value[0] ? true : message_set(message, "--output: the name is empty");
    case OPTION_JOBS:
        if (!parse_whole(value, 1, CLASS_JOBS_MOST, &options->jobs))
            return bad("jobs", value, "a whole number, 1 to 256", message);
        return true;
    case OPTION_PART:
        return read_part(value, options, message);
    case OPTION_LIMIT:
        if (!parse_whole(value, 1, SANDBOX_SECONDS_MOST, &number))
            return bad("limit", value, "whole seconds, 1 to 3600", message);
        options->limit = number;
        return true;
    case OPTION_SEED:
        if (!parse_whole(value, 0, 2147483647, &number))
            return bad("seed", value, "a whole number, 0 to 2147483647", message);
        options->seed = (uint64_t)number;
        return true;
    case OPTION_AGAIN:
        options->again = true;
        return true;
    case 'h':
        options->help = true;
        return true;
    default: /* OPTION_MERGE */
        return true;
    }
}

bool class_options_read(ClassOptions *options, int argc, char *argv[], Message *message)
{
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    bool merge = false;
    *options = (ClassOptions){.output = "results",
                              .jobs = processors < 1                 ? 1
                                      : processors > CLASS_JOBS_MOST ? CLASS_JOBS_MOST
                                                                     : (int)processors,
                              .part = 1,
                              .parts = 1,
                              .limit = 10,
                              .seed = 1};
    optind = 0;
    opterr = 0;
    for (int option; (option = getopt_long(argc, argv, ":o:h", LONG_OPTIONS, NULL)) != -1;) {
        if (option == '?' || option == ':')
            return options_refuse(LONG_OPTIONS, option, argc, argv, message);
        merge = merge || option == OPTION_MERGE;
        if (!read_option(options, option, optarg, message))
            return false;
    }
    options->merged = argv + optind;
    if (options->help)
        return true;
    if (merge && options->folder)
        return message_set(message, "--class and --merge: one of them");
    if (merge && !argv[optind])
        return message_set(message, "--merge: needs the folders to merge");
    if (!merge && argv[optind])
        return message_set(message, "%s: not an option; --class takes one folder", argv[optind]);
    return true;
}
