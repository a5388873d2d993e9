/* The process that judges is not trusted: of its output only a valid verdict on this lab and seed
 * counts, and a valid picture. How it ends is a verdict, too: endless loops and what crashes a
 * driver are faults of the submission. */
#include "labs/sandbox/sandboxed_check.h"

#include "base/clock.h"
#include "base/output.h"
#include "labs/sandbox/png_copy.h"
#include "labs/sandbox/source.h"
#include "labs/submission/verdict_json.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

bool sandboxed_check_start(const Sandbox *sandbox, SandboxRun *run, int slot,
                           const SandboxedCheck *check, Message *message)
{
    char seed[32], kind[16];
    snprintf(seed, sizeof seed, "%llu", (unsigned long long)check->seed);
    snprintf(kind, sizeof kind, "%d", (int)check->kind);
    return sandbox_start(
        sandbox, run, slot,
        (const char *const[]){"check", check->lab->folder ? check->lab->folder : check->lab->name,
                              seed, kind, NULL},
        check->inputs, message);
}

static void explain_end(const SandboxRun *run, double limit, Verdict *verdict)
{
    const int signal = run->status - 128;
    verdict->seconds = clock_now() - run->start;
    if (sandbox_end(run) == SANDBOX_TIMEOUT) {
        verdict->kind = VERDICT_TIMEOUT;
        snprintf(verdict->message, sizeof verdict->message,
                 "Timed out after %g s of CPU time: look for an endless loop, or a far too large "
                 "array or macro.",
                 limit);
    } else if (signal > 0) {
        snprintf(verdict->message, sizeof verdict->message,
                 "It crashes the driver (signal %d, %s): it is too large or too deeply nested.",
                 signal, strsignal(signal));
    } else {
        snprintf(verdict->message, sizeof verdict->message,
                 "The driver exits on it (status %d): it needs too much memory.", run->status);
    }
}

/* Their names go into tables as they are, and one more is added for lateness. */
static bool has_parts(const Verdict *verdict, const LabPoints *points)
{
    bool same = verdict->part_count == points->part_count;
    for (int i = 0; i < points->part_count && same; i++)
        same = strncmp(verdict->parts[i].name, points->parts[i].name,
                       sizeof verdict->parts[i].name - 1) == 0;
    return same;
}

bool sandboxed_check_end(const Sandbox *sandbox, const SandboxRun *run, const SandboxedCheck *check,
                         Verdict *verdict, Message *message)
{
    char lab[64], reason[1024];
    size_t size;
    Message why = {.text = ""};
    const SandboxEnd end = sandbox_end(run);
    verdict_begin(verdict, check->lab, check->seed);
    if (end == SANDBOX_FAILED) {
        sandbox_reason(run, reason);
        return message_set(message, "judging failed: %s", reason);
    }
    if (end != SANDBOX_DONE) {
        explain_end(run, sandbox->seconds, verdict);
        return true;
    }
    const char *result = sandbox_part(run, SANDBOX_RESULT, &size);
    if (!verdict_read(result, size, lab, verdict, &why))
        return message_set(message, "invalid result: %.1000s", why.text);
    if (strcmp(lab, check->lab->name) != 0 || verdict->seed != check->seed ||
        !has_parts(verdict, &check->lab->points))
        return message_set(message, "invalid result: it is of another lab, seed or parts");
    return true;
}

/* Keeps the picture beside the others; a verdict without a valid one names none. */
static bool take_picture(const SandboxRun *run, const char *folder, Verdict *verdict,
                         Message *message)
{
    char path[PATH_MAX];
    size_t size;
    char *picture = sandbox_part(run, SANDBOX_PICTURE, &size);
    if (!folder || !verdict->picture[0] || !png_copy((unsigned char *)picture, &size, NULL)) {
        verdict->picture[0] = '\0';
        return true;
    }
    return output_folder(folder, message) && output_path(path, folder, verdict->picture, message) &&
           output_write(path, picture, size, message);
}

/* What is at a path that a person named. False, with a message: nothing that can be judged. */
static bool kind_of(const char *path, SandboxSource *kind, Message *message)
{
    struct stat status;
    if (stat(path, &status) != 0)
        return message_set(message, "%s: %s", path, strerror(errno));
    *kind = S_ISDIR(status.st_mode)   ? SOURCE_FOLDER
            : unpack_is_archive(path) ? SOURCE_ARCHIVE
                                      : SOURCE_FILES;
    return S_ISDIR(status.st_mode) ||
           (S_ISREG(status.st_mode) &&
            (*kind == SOURCE_ARCHIVE || source_is_wanted(strrchr(path, '/') + 1))) ||
           message_set(message, "%s: neither a folder nor an archive nor a shader", path);
}

bool sandboxed_check(const JudgeOptions *options, const char *path, double limit, Verdict *verdict,
                     Message *message)
{
    static Sandbox sandbox; /* large */
    char place[PATH_MAX];
    Message why = {.text = ""};
    SandboxRun run = {.pipe = -1};
    SandboxRun *const runs[] = {&run};
    SandboxedCheck check = {options->lab, options->seed, SOURCE_FOLDER, {NULL, 1}};
    /* A fault of the path needs no sandbox, and is said with its name. */
    if (!realpath(path, place))
        message_set(&why, "%s: %s", path, strerror(errno));
    if (why.text[0] || !kind_of(place, &check.kind, &why)) {
        verdict_refuse(verdict, options->lab, options->seed, &why);
        return true;
    }
    const SandboxInput input = {place, strrchr(place, '/') + 1};
    check.inputs.items = &input;
    /* Nothing in a sandbox needs this file, and every system has it. */
    if (!sandbox_open(&sandbox, options->lab, ceil(limit), "/etc/passwd", message) ||
        !sandbox_admits(&sandbox, options->lab, message))
        return false;
    if (options->backend)
        setenv("LIGHTING_BACKEND", options->backend->name, 1);
    bool done = sandboxed_check_start(&sandbox, &run, 0, &check, message);
    while (run.running)
        sandbox_wait(runs, 1, 1);
    done = done && sandboxed_check_end(&sandbox, &run, &check, verdict, message) &&
           take_picture(&run, options->pictures, verdict, message);
    sandbox_close(&run);
    return done;
}
