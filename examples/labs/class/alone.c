#include "labs/class/alone.h"

#include "base/output.h"
#include "labs/check/judge_pictures.h"
#include "labs/sandbox/bundle.h"
#include "labs/sandbox/png_copy.h"
#include "labs/sandbox/sandbox.h"
#include "labs/submission/submission.h"
#include "labs/submission/verdict_json.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* The files in memory, as the sandbox reads them; -1, with a message: failed. */
static int open_input(const SubmissionFiles *files, Message *message)
{
    Bundle *bundle = calloc(1, sizeof *bundle);
    bool done = bundle ? true : message_set(message, "%s", strerror(ENOMEM));
    for (int i = 0; i < files->count && done; i++)
        done = bundle_add(bundle, files->texts[i].name, files->texts[i].text,
                          strlen(files->texts[i].text), message);
    int input = done ? memfd_create("submission", MFD_CLOEXEC) : -1;
    if (done &&
        (input < 0 || !bundle_write(bundle, input, message) || lseek(input, 0, SEEK_SET) != 0)) {
        message_set(message, "a file in memory: %s", strerror(errno));
        if (input >= 0)
            close(input);
        input = -1;
    }
    bundle_close(bundle);
    free(bundle);
    return input;
}

static bool take_picture(const Bundle *bundle, const char *folder, Verdict *verdict,
                         Message *message)
{
    char path[PATH_MAX];
    const BundleFile *file = bundle_find(bundle, verdict->picture);
    size_t size = file ? file->size : 0;
    if (!folder || !file || !png_copy(file->bytes, &size, NULL)) {
        verdict->picture[0] = '\0';
        return true;
    }
    if (snprintf(path, sizeof path, "%s/%s", folder, verdict->picture) >= (int)sizeof path)
        return message_set(message, "%s: the path is too long", folder);
    return output_folder(folder, message) && output_write(path, file->bytes, size, message);
}

static bool take_result(const JudgeOptions *options, const SandboxRun *run, double limit,
                        Verdict *verdict, Message *message)
{
    char line[1024], lab[64];
    Message why = {.text = ""};
    const SandboxEnd end = sandbox_end(run);
    sandbox_last_line(run, line);
    if (end == SANDBOX_TIMEOUT) {
        *verdict = (Verdict){.seed = options->seed, .kind = VERDICT_TIMEOUT};
        snprintf(verdict->message, sizeof verdict->message,
                 "stopped after %g s of processor time: look for an endless loop", limit);
        return true;
    }
    if (end != SANDBOX_DONE)
        return message_set(message, "judging failed: %s", line[0] ? line : "no result");
    Bundle *bundle = calloc(1, sizeof *bundle);
    bool done = bundle ? bundle_read(bundle, run->bytes, run->size, message)
                       : message_set(message, "%s", strerror(ENOMEM));
    const BundleFile *file = done ? bundle_find(bundle, "verdict.json") : NULL;
    if (done && (!file || !verdict_read(file->bytes, file->size, lab, verdict, &why) ||
                 strcmp(lab, options->lab->name) != 0))
        done = message_set(message, "judging failed: %s", why.text[0] ? why.text : "no result");
    done = done && take_picture(bundle, options->pictures, verdict, message);
    bundle_close(bundle);
    free(bundle);
    return done;
}

static bool judge_in(const JudgeOptions *options, const SubmissionFiles *files, double limit,
                     Verdict *verdict, Message *message)
{
    Sandbox *sandbox = calloc(1, sizeof *sandbox);
    SandboxRun run = {.output = -1, .errors = -1};
    SandboxRun *const runs[] = {&run};
    char seed[32];
    bool done = sandbox ? true : message_set(message, "%s", strerror(ENOMEM));
    /* Nothing in a sandbox needs this file, and every system has it. */
    done = done && sandbox_open(sandbox, options->lab, ceil(limit), "/etc/passwd", message) &&
           sandbox_admits(sandbox, options->lab, message);
    const int input = done ? open_input(files, message) : -1;
    snprintf(seed, sizeof seed, "%llu", (unsigned long long)options->seed);
    if (options->backend)
        setenv("LIGHTING_BACKEND", options->backend->name, 1);
    done = input >= 0 &&
           sandbox_start(sandbox, &run, 0, input,
                         (const char *const[]){"judge", options->lab->name, seed, NULL}, message);
    while (run.running)
        sandbox_wait(runs, 1, 1);
    done = done && take_result(options, &run, limit, verdict, message);
    if (input >= 0)
        close(input);
    sandbox_close(&run);
    free(sandbox);
    return done;
}

bool alone_judge(const JudgeOptions *options, double limit, Verdict *verdict, Message *message)
{
    SubmissionFiles files;
    Message own = {.text = ""};
    *verdict = (Verdict){.seed = options->seed};
    if (!submission_files_open(&files, options->lab, options->folder, &own)) {
        verdict->kind = VERDICT_REFUSED;
        snprintf(verdict->message, sizeof verdict->message, "%.500s", own.text);
        return true;
    }
    const bool done = judge_in(options, &files, limit, verdict, message);
    submission_files_close(&files);
    return done;
}
