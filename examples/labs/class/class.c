/* `check --class` and `--merge` from the command line to the exit code. */
#include "labs/class/class.h"

#include "app/options.h"
#include "base/memory.h"
#include "base/output.h"
#include "labs/class/class_report.h"
#include "labs/class/class_judge.h"
#include "labs/class/class_run.h"
#include "labs/sandbox/sandbox.h"
#include "labs/sandbox/source.h"
#include "labs/submission/lab_json.h"

#include <ctype.h>
#include <errno.h>
#include <libgen.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

static const char PROGRAM[] = "check";

static volatile sig_atomic_t interrupted;

static void interrupt(int signal)
{
    interrupted = signal;
}

static void say(const Message *notes)
{
    for (const char *line = notes->text; *line;) {
        const size_t length = strcspn(line, "\n");
        fprintf(stderr, "%s: %.*s\n", PROGRAM, (int)length, line);
        line += length + (line[length] == '\n');
    }
}

/* The number after "lab" in a name; 0: none. */
static int lab_in_name(const char *name)
{
    const char *at = strcasestr(name, "lab");
    return at && isdigit((unsigned char)at[3]) ? atoi(at + 3) : 0;
}

/* The lab's number in the file names of the first submissions; 0: none. */
static int lab_in_files(const FoundList *list)
{
    enum { LOOKED_AT = 20 };
    int number = 0;
    Bundle *bundle = memory_new(1, sizeof *bundle);
    for (int i = 0; i < list->count && i < LOOKED_AT && !number; i++) {
        char archive[PATH_MAX];
        if (class_read(&list->items[i], bundle, archive, NULL))
            for (int j = 0; j < bundle->count && !number; j++)
                number = lab_in_name(bundle->files[j].name);
        bundle_close(bundle);
    }
    free(bundle);
    return number;
}

static const Lab *choose_lab(const ClassOptions *options, const FoundList *list, Message *message)
{
    char path[PATH_MAX], text[16];
    if (options->lab)
        return lab_open(options->lab, message);
    const char *name = realpath(options->folder, path) ? strrchr(path, '/') : NULL;
    int number = name ? lab_in_name(name) : 0;
    if (!number)
        number = lab_in_files(list);
    snprintf(text, sizeof text, "%d", number);
    const Lab *lab = number ? lab_find(text, NULL) : NULL;
    if (!lab)
        message_set(message, "%s: no file name contains the lab; name it with --lab",
                    options->folder);
    return lab;
}

static bool report(const ClassStore *store, Message *message)
{
    bool front = false;
    Message why = {.text = ""};
    if (!pareto_front_draw(store, &front, &why)) {
        front = false; /* report the rest anyway */
        say(&why);
    }
    return class_table_csv(store, message) && class_table_json(store, message) &&
           class_table_junit(store, message) && class_table_gradescope(store, message) &&
           class_html_write(store, front, message) && class_platform_write(store, message);
}

/* Opens the sandbox and prints what it guarantees. False: too little to go on. */
static bool open_sandbox(const ClassOptions *options, const Lab *lab, Sandbox *sandbox,
                         Message *message)
{
    char hidden[PATH_MAX], text[256];
    Message why = {.text = ""};
    if (!realpath(options->folder, hidden))
        return message_set(message, "%s: %s", options->folder, strerror(errno));
    if (!sandbox_open(sandbox, lab, options->limit, hidden, &why))
        return message_set(message, "no submission is judged: %s", why.text);
    sandbox_describe(sandbox, text);
    fprintf(stderr, "%s: %s\n", PROGRAM, text);
    if (!sandbox->bubblewrap)
        say(&why);
    return sandbox_admits(sandbox, lab, message);
}

static bool same_lab(const ClassStore *store, const Lab *lab, Message *message)
{
    if (store->count == 0 || strcmp(store->results[0].lab, lab->name) == 0)
        return true;
    return message_set(message, "%s: has results of %s; choose another folder with -o",
                       store->folder, store->results[0].lab);
}

static bool judge_class(const ClassOptions *options, const FoundList *list, const Lab *lab,
                        Message *message)
{
    static Sandbox sandbox; /* large */
    ClassStore store = {.lock = -1};
    const ClassJudging judging = {options, lab, list, &sandbox, &store, &interrupted};
    Message notes = {.text = ""};
    bool done = class_store_open(&store, options->output, &notes, message) &&
                same_lab(&store, lab, message) && open_sandbox(options, lab, &sandbox, message) &&
                class_run_write(options, lab, list, message);
    say(&notes);
    options_catch_signals(interrupt, (int)SA_RESETHAND); /* the second ends it at once */
    done = done && class_judge(&judging, message);
    /* Report what is known, even after a failure. */
    if (store.lock >= 0 && store.count > 0 && !report(&store, message))
        done = false;
    class_store_close(&store);
    return done;
}

/* The entry of the class's folder that contains the results, if they are below it; empty: none. */
static void find_results(const ClassOptions *options, char entry[NAME_MAX + 1])
{
    char folder[PATH_MAX], output[PATH_MAX], above[PATH_MAX];
    entry[0] = '\0';
    snprintf(above, sizeof above, "%s", options->output);
    if (!realpath(options->folder, folder) ||
        (!realpath(options->output, output) && !realpath(dirname(above), output)))
        return;
    const size_t length = strlen(folder);
    if (strncmp(output, folder, length) != 0 || output[length] != '/')
        return;
    const char *name = output + length + 1;
    snprintf(entry, NAME_MAX + 1, "%.*s", (int)strcspn(name, "/"), name);
}

/* An archive of the class is unpacked beside its results, which then are of that folder. */
static bool open_archive(ClassOptions *options, char folder[PATH_MAX], Message *message)
{
    if (!unpack_is_archive(options->folder))
        return true;
    if (!output_folder(options->output, message) ||
        !output_path(folder, options->output, "submissions", message) ||
        !class_unpack(options->folder, folder, message))
        return false;
    options->folder = folder;
    return true;
}

static int run_class(ClassOptions *options, Message *message)
{
    char folder[PATH_MAX];
    FoundList list;
    char results[NAME_MAX + 1];
    Message notes = {.text = ""};
    if (!open_archive(options, folder, message))
        return options_fail(PROGRAM, message, EXIT_FAILED);
    find_results(options, results);
    if (!class_find(options->folder, results, &list, &notes, message))
        return options_fail(PROGRAM, message, EXIT_FAILED);
    const Lab *lab = choose_lab(options, &list, message);
    bool done = lab && class_late_find(&list, lab, options->late, &notes, message);
    say(&notes);
    done = done && judge_class(options, &list, lab, message);
    class_found_close(&list);
    if (!done)
        return options_fail(PROGRAM, message, lab ? EXIT_FAILED : EXIT_USAGE);
    if (interrupted) {
        message_set(message, "interrupted; run the same command again to continue");
        return options_fail(PROGRAM, message, EXIT_FAILED);
    }
    printf("%s/index.html\n", options->output);
    return options_finish(PROGRAM, 0);
}

static int run_merge(const ClassOptions *options, Message *message)
{
    ClassStore store = {.lock = -1};
    Message notes = {.text = ""}, missing = {.text = ""};
    bool done = class_runs_join(options, &missing, message) &&
                class_store_open(&store, options->output, &notes, message);
    for (char *const *folder = options->merged; done && *folder; folder++) {
        ClassStore part = {.lock = -1};
        done = class_store_read(&part, *folder, &notes, message) &&
               class_store_merge(&store, &part, message);
        class_store_close(&part);
    }
    say(&notes);
    if (done)
        say(&missing);
    done = done && report(&store, message);
    class_store_close(&store);
    if (!done)
        return options_fail(PROGRAM, message, EXIT_FAILED);
    printf("%s/index.html\n", options->output);
    return options_finish(PROGRAM, 0);
}

static bool is_given(int argc, char *argv[])
{
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++)
        if (strcmp(argv[i], "--class") == 0 || strncmp(argv[i], "--class=", 8) == 0 ||
            strcmp(argv[i], "--merge") == 0)
            return true;
    return false;
}

bool class_main(int argc, char *argv[], int *code)
{
    ClassOptions options;
    Message message = {.text = ""};
    if (argc > 1 && strcmp(argv[1], "--inside") == 0) {
        *code = sandboxed_main(argc - 2, argv + 2);
        return true;
    }
    if (!is_given(argc, argv))
        return false;
    options_prepare_process();
    for (int i = 1; i < argc; i++) {
        /* Also where --class has no folder. */
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            argv[1] = argv[i];
            argv[2] = NULL;
            argc = 2;
        }
    }
    const size_t size = ((size_t)argc + 1) * sizeof *argv;
    char **given = memory_copy(argv, size); /* the names are moved to the front */
    if (!class_options_read(&options, argc, argv, &message)) {
        *code = options_fail(PROGRAM, &message, EXIT_USAGE);
    } else if (options.help) {
        *code = options_finish(PROGRAM, 0);
    } else if (options.deterministic && !options_restart(given, &message)) {
        *code = options_fail(PROGRAM, &message, EXIT_FAILED);
    } else {
        *code = options.folder ? run_class(&options, &message) : run_merge(&options, &message);
    }
    free(given);
    return true;
}
