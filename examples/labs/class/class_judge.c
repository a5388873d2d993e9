#include "labs/class/class_judge.h"

#include "base/progress.h"
#include "labs/sandbox/source.h"
#include "labs/submission/verdict_json.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { LATE_MAX = 4096 };        /* submissions */
enum { ARCHIVE_MAX = 64 << 20 }; /* bytes */

/* One submission being judged. */
typedef struct Job {
    const Found *found;
    ClassResult result;
    SandboxRun run;
    Bundle files; /* the submission's, later the result's */
    bool unpacking;
} Job;

typedef struct Judging {
    const ClassOptions *options;
    const Lab *lab;
    const Sandbox *sandbox;
    ClassStore *store;
    Job *jobs[CLASS_JOBS_MAX];
    const Found *late[LATE_MAX]; /* timed out beside others */
    int late_count;
    bool alone; /* these are tried again, one at a time */
    int done, total;
    Progress progress;
} Judging;

bool class_in_part(const ClassOptions *options, const char *folder)
{
    const uint64_t hash = source_hash_bytes(SOURCE_HASH_START, folder, strlen(folder));
    return part_has(options->part, hash ^ hash >> 32);
}

/* Ends a job: puts its result into the store. */
static bool settle(Judging *judging, Job *job, Message *message)
{
    bool kept;
    ClassResult *result = &job->result;
    const VerdictKind kind = result->verdict.kind;
    result->when = (long long)time(NULL);
    const bool done = class_store_put(judging->store, result, &job->files, &kept, message);
    if (done && kind != VERDICT_RIGHT && kind != VERDICT_WRONG) {
        progress_end(&judging->progress);
        fprintf(stderr, "check: %s: %s: %s%s\n", result->student, VERDICT_NAMES[kind],
                result->verdict.message, kept ? "" : " (the earlier, better result stays)");
    }
    judging->done++;
    progress_update(&judging->progress, judging->done, judging->total);
    return done;
}

/* Settles on a verdict without points, made here instead of in the sandbox. */
static bool give(Judging *judging, Job *job, VerdictKind kind, const char *sentence,
                 Message *message)
{
    Verdict *verdict = &job->result.verdict;
    verdict->kind = kind;
    verdict->points = 0;
    job->result.finished = kind == VERDICT_REFUSED;
    verdict_clean(verdict->message, sizeof verdict->message, sentence, false);
    return settle(judging, job, message);
}

static bool give_timeout(Judging *judging, Job *job, Message *message)
{
    char sentence[200];
    if (!judging->alone && judging->late_count < LATE_MAX) {
        judging->late[judging->late_count++] = job->found;
        return true;
    }
    snprintf(sentence, sizeof sentence,
             "stopped after %.0f s of processor time: look for an endless loop",
             judging->options->limit);
    return give(judging, job, VERDICT_TIMEOUT, sentence, message);
}

/* The verdict for a run without a result. */
static bool settle_failed(Judging *judging, Job *job, SandboxEnd end, Message *message)
{
    char line[1024], sentence[1200];
    sandbox_last_line(&job->run, line);
    if (end == SANDBOX_REFUSED)
        return give(judging, job, VERDICT_REFUSED, line[0] ? line : "could not be read", message);
    if (end == SANDBOX_TIMEOUT)
        return give_timeout(judging, job, message);
    snprintf(sentence, sizeof sentence, "judging failed: %s",
             job->run.too_much ? "too much output"
             : line[0]         ? line
                               : "no result");
    return give(judging, job, VERDICT_ERROR, sentence, message);
}

/* A file in memory for the sandbox to read; -1, with a message: failed. */
static int open_input(const Bundle *files, Message *message)
{
    const int file = memfd_create("submission", MFD_CLOEXEC);
    if (file >= 0 && bundle_write(files, file, message) && lseek(file, 0, SEEK_SET) == 0)
        return file;
    message_set(message, "a file in memory: %s", strerror(errno));
    if (file >= 0)
        close(file);
    return -1;
}

/* Starts judging the job's files. *ended: it is settled already. */
static bool start_judging(Judging *judging, Job *job, int slot, bool *ended, Message *message)
{
    char seed[32];
    Message why = {.text = ""};
    *ended = !source_choose(&job->files, judging->lab, &why);
    if (*ended)
        return give(judging, job, VERDICT_REFUSED, why.text, message);
    source_normalize(&job->files, judging->lab);
    const int input = open_input(&job->files, message);
    bundle_close(&job->files);
    if (input < 0)
        return false;
    job->unpacking = false;
    snprintf(seed, sizeof seed, "%llu", (unsigned long long)judging->options->seed);
    const bool done =
        sandbox_start(judging->sandbox, &job->run, slot, input,
                      (const char *const[]){"judge", judging->lab->name, seed, NULL}, message);
    close(input);
    return done;
}

/* The hash of an open file; rewinds it. */
static bool hash_archive(int file, uint64_t *hash, Message *message)
{
    unsigned char block[16384];
    struct stat status;
    ssize_t count;
    if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode))
        return message_set(message, "the archive is a link or a device; submit the file itself");
    if (status.st_size > ARCHIVE_MAX)
        return message_set(message, "the archive has %.0f MB; at most %d MB",
                           (double)status.st_size / (1 << 20), ARCHIVE_MAX >> 20);
    *hash = SOURCE_HASH_START;
    while ((count = read(file, block, sizeof block)) > 0)
        *hash = source_hash_bytes(*hash, block, (size_t)count);
    return count == 0 && lseek(file, 0, SEEK_SET) == 0
               ? true
               : message_set(message, "the archive cannot be read: %s", strerror(errno));
}

static bool stands(const Judging *judging, const Job *job)
{
    return !judging->options->again &&
           class_result_stands(class_store_find(judging->store, job->found->folder),
                               judging->lab->name, job->result.hash, judging->options->limit);
}

static bool start_archive(Judging *judging, Job *job, const char *path, int slot, bool *ended,
                          Message *message)
{
    Message why = {.text = ""};
    bool done = true;
    const int file = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0)
        message_set(&why, "the archive cannot be read: %s", strerror(errno));
    *ended = true;
    if (file < 0 || !hash_archive(file, &job->result.hash, &why)) {
        done = give(judging, job, VERDICT_REFUSED, why.text, message);
    } else if (stands(judging, job)) {
        judging->done++;
    } else {
        *ended = false;
        job->unpacking = true;
        done = sandbox_start(judging->sandbox, &job->run, slot, file,
                             (const char *const[]){"unpack", NULL}, message);
    }
    if (file >= 0)
        close(file);
    return done;
}

/* Starts one submission. *ended: it is settled already. */
static bool start(Judging *judging, Job *job, const Found *found, int slot, bool *ended,
                  Message *message)
{
    char archive[PATH_MAX];
    Message why = {.text = ""};
    job->found = found;
    job->result =
        (ClassResult){.limit = judging->options->limit, .verdict.seed = judging->options->seed};
    memcpy(job->result.student, found->name.student, sizeof job->result.student);
    memcpy(job->result.id, found->name.id, sizeof job->result.id);
    job->result.attempt = found->attempt;
    memcpy(job->result.folder, found->folder, sizeof job->result.folder);
    snprintf(job->result.lab, sizeof job->result.lab, "%s", judging->lab->name);
    *ended = true;
    if (!class_read(found, &job->files, archive, &why)) {
        /* Unreadable: no content to hash, so hash the reason. */
        job->result.hash = source_hash_bytes(SOURCE_HASH_START, why.text, strlen(why.text));
        return give(judging, job, VERDICT_REFUSED, why.text, message);
    }
    if (archive[0])
        return start_archive(judging, job, archive, slot, ended, message);
    job->result.hash = source_hash(&job->files);
    if (stands(judging, job)) {
        judging->done++;
        return true;
    }
    return start_judging(judging, job, slot, ended, message);
}

/* Reads the verdict that the sandbox wrote; false if it is invalid. */
static bool take_verdict(Judging *judging, Job *job, Message *why)
{
    char lab[64];
    const BundleFile *file = bundle_find(&job->files, "verdict.json");
    if (!file)
        return message_set(why, "no result");
    if (!verdict_read(file->bytes, file->size, lab, &job->result.verdict, why))
        return false;
    if (strcmp(lab, judging->lab->name) != 0 || job->result.verdict.seed != judging->options->seed)
        return message_set(why, "it is of another lab or seed");
    return true;
}

static bool settle_judged(Judging *judging, Job *job, Message *message)
{
    char sentence[1200];
    Message why = {.text = ""};
    if (!take_verdict(judging, job, &why)) {
        job->result.verdict = (Verdict){.seed = judging->options->seed};
        snprintf(sentence, sizeof sentence, "invalid result: %.1000s", why.text);
        return give(judging, job, VERDICT_ERROR, sentence, message);
    }
    if (job->result.verdict.kind == VERDICT_TIMEOUT)
        return give_timeout(judging, job, message);
    job->result.finished = true;
    return settle(judging, job, message);
}

/* Continues after a run. *ended: the submission is settled. */
static bool advance_job(Judging *judging, Job *job, int slot, bool *ended, Message *message)
{
    Message why = {.text = ""};
    *ended = true;
    const SandboxEnd end = sandbox_end(&job->run);
    if (end != SANDBOX_DONE)
        return settle_failed(judging, job, end, message);
    bundle_close(&job->files);
    if (!bundle_read(&job->files, job->run.bytes, job->run.size, &why))
        return give(judging, job, VERDICT_ERROR, why.text, message);
    sandbox_close(&job->run);
    if (!job->unpacking)
        return settle_judged(judging, job, message);
    return start_judging(judging, job, slot, ended, message);
}

static void free_job(Job *job)
{
    if (!job)
        return;
    sandbox_close(&job->run);
    bundle_close(&job->files);
    free(job);
}

/* Starts submissions until every slot is busy or none are left. */
static bool fill(Judging *judging, const FoundList *list, int *next, Message *message)
{
    for (int slot = 0; slot < judging->options->jobs; slot++) {
        while (!judging->jobs[slot] && *next < list->count) {
            const Found *found = &list->items[(*next)++];
            bool ended = true;
            if (!class_in_part(judging->options, found->folder))
                continue;
            Job *job = calloc(1, sizeof *job);
            if (!job)
                return message_set(message, "%s", strerror(ENOMEM));
            const bool done = start(judging, job, found, slot, &ended, message);
            if (done && !ended)
                judging->jobs[slot] = job;
            else
                free_job(job);
            if (!done)
                return false;
        }
    }
    return true;
}

/* Waits for a run to end and continues with those that did. *busy: some are left. */
static bool advance(Judging *judging, bool *busy, Message *message)
{
    SandboxRun *runs[CLASS_JOBS_MAX];
    int count = 0;
    for (int slot = 0; slot < judging->options->jobs; slot++)
        if (judging->jobs[slot])
            runs[count++] = &judging->jobs[slot]->run;
    *busy = count > 0;
    if (!*busy)
        return true;
    sandbox_wait(runs, count, 0.2);
    progress_update(&judging->progress, judging->done, judging->total);
    for (int slot = 0; slot < judging->options->jobs; slot++) {
        Job *job = judging->jobs[slot];
        bool ended = false;
        if (!job || job->run.running)
            continue;
        if (!advance_job(judging, job, slot, &ended, message))
            return false;
        if (ended) {
            free_job(job);
            judging->jobs[slot] = NULL;
        }
    }
    return true;
}

bool class_judge(const ClassOptions *options, const Lab *lab, const FoundList *list,
                 const Sandbox *sandbox, ClassStore *store,
                 const volatile sig_atomic_t *interrupted, Message *message)
{
    Judging judging = {.options = options,
                       .lab = lab,
                       .sandbox = sandbox,
                       .store = store,
                       .progress = progress_start(lab->name)};
    int next = 0;
    bool done = true, busy = true;
    for (int i = 0; i < list->count; i++)
        judging.total += class_in_part(options, list->items[i].folder);
    while (done && busy && !*interrupted)
        done = fill(&judging, list, &next, message) && advance(&judging, &busy, message);
    judging.alone = true;
    for (int i = 0; i < judging.late_count && done && !*interrupted; i++) {
        bool ended = true;
        Job *job = calloc(1, sizeof *job);
        done = job ? start(&judging, job, judging.late[i], 0, &ended, message)
                   : message_set(message, "%s", strerror(ENOMEM));
        if (done && !ended)
            judging.jobs[0] = job;
        else
            free_job(job);
        for (busy = true; done && busy && !*interrupted;)
            done = advance(&judging, &busy, message);
    }
    for (int slot = 0; slot < options->jobs; slot++)
        free_job(judging.jobs[slot]);
    progress_end(&judging.progress);
    return done;
}
