/* Each slot holds a submission that is judged in a process of its own; when one ends, its verdict
 * goes into the store, and the slot to the next submission. What timed out beside others is judged
 * once more, alone, at the end: wall time is shared, and a busy machine is no fault of a student.
 */
#include "labs/class/class_judge.h"

#include "base/memory.h"
#include "base/progress.h"
#include "labs/sandbox/sandboxed_check.h"
#include "labs/sandbox/source.h"
#include "labs/submission/verdict_json.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

/* One submission being judged. */
typedef struct Job {
    const Found *found;
    ClassResult result;
    SandboxRun run;
} Job;

typedef struct Judging {
    const ClassJudging *of;
    Job *jobs[CLASS_JOBS_MAX];
    const Found **late; /* timed out beside others */
    int late_count;
    bool alone; /* these are tried again, one at a time */
    int done, total, failed;
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
    ClassFiles files;
    verdict_late(&result->verdict, judging->of->lab, job->found->days_late);
    files.picture = sandbox_part(&job->run, SANDBOX_PICTURE, &files.picture_size);
    files.statements = sandbox_part(&job->run, SANDBOX_STATEMENTS, &files.statements_size);
    result->when = (long long)time(NULL);
    const bool done = class_store_put(judging->of->store, result, files, &kept, message);
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
    verdict_begin(verdict, judging->of->lab, judging->of->options->seed);
    verdict->kind = kind;
    job->result.finished = kind == VERDICT_REFUSED;
    verdict_clean(verdict->message, sizeof verdict->message, sentence, false);
    return settle(judging, job, message);
}

static bool stands(const Judging *judging, const Job *job)
{
    return !judging->of->options->again &&
           class_result_stands(class_store_find(judging->of->store, job->found->folder),
                               judging->of->lab->name, job->result.hash,
                               judging->of->options->limit);
}

/* What the sandbox is to judge. The caller frees the inputs. */
static SandboxedCheck check_of(const Judging *judging, const Found *found, const char *archive)
{
    const int count = archive[0] || found->kind == FOUND_FOLDER ? 1 : found->count;
    SandboxInput *inputs = memory_new((size_t)count, sizeof *inputs);
    inputs[0] = (SandboxInput){archive[0] ? archive : found->path, ""};
    if (!archive[0] && found->kind == FOUND_FILES)
        for (int i = 0; i < count; i++)
            inputs[i] = (SandboxInput){found->files[i].path, found->files[i].name};
    return (SandboxedCheck){.lab = judging->of->lab,
                            .seed = judging->of->options->seed,
                            .kind = archive[0]                    ? SOURCE_ARCHIVE
                                    : found->kind == FOUND_FOLDER ? SOURCE_FOLDER
                                                                  : SOURCE_FILES,
                            .inputs = {inputs, count}};
}

/* Hashes a submission, which has to be readable. *archive: it is in this one. */
static bool hash_found(const Found *found, const Lab *lab, char archive[PATH_MAX], uint64_t *hash,
                       Message *why)
{
    Bundle *files = memory_new(1, sizeof *files);
    const bool done = class_read(found, files, archive, why);
    if (done && !archive[0])
        *hash = source_hash(files);
    bundle_close(files);
    free(files);
    const bool hashed =
        done && (!archive[0] || source_hash_file(archive, "the archive", hash, why));
    *hash ^= lab->hash + (uint64_t)found->days_late;
    return hashed;
}

/* Starts one submission. *ended: it is settled already. */
static bool start(Judging *judging, Job *job, const Found *found, int slot, bool *ended,
                  Message *message)
{
    char archive[PATH_MAX];
    Message why = {.text = ""};
    job->found = found;
    job->result = (ClassResult){.limit = judging->of->options->limit};
    memcpy(job->result.student, found->name.student, sizeof job->result.student);
    memcpy(job->result.id, found->name.id, sizeof job->result.id);
    job->result.attempt = found->attempt;
    memcpy(job->result.folder, found->folder, sizeof job->result.folder);
    snprintf(job->result.lab, sizeof job->result.lab, "%s", judging->of->lab->name);
    *ended = true;
    if (!hash_found(found, judging->of->lab, archive, &job->result.hash, &why)) {
        /* Unreadable: no content to hash, so hash the reason. */
        if (!archive[0])
            job->result.hash = source_hash_bytes(SOURCE_HASH_START, why.text, strlen(why.text));
        return give(judging, job, VERDICT_REFUSED, why.text, message);
    }
    if (stands(judging, job)) {
        judging->done++;
        return true;
    }
    *ended = false;
    const SandboxedCheck check = check_of(judging, found, archive);
    const bool done = sandboxed_check_start(judging->of->sandbox, &job->run, slot, &check, message);
    free((void *)check.inputs.items);
    return done;
}

/* Settles a run that has ended, or puts it off. */
static bool end(Judging *judging, Job *job, Message *message)
{
    Verdict *verdict = &job->result.verdict;
    Message why = {.text = ""};
    const SandboxedCheck check = {.lab = judging->of->lab, .seed = judging->of->options->seed};
    if (!sandboxed_check_end(judging->of->sandbox, &job->run, &check, verdict, &why)) {
        judging->failed++;
        return give(judging, job, VERDICT_ERROR, why.text, message);
    }
    job->result.finished = verdict->kind != VERDICT_TIMEOUT;
    if (job->result.finished || judging->alone)
        return settle(judging, job, message);
    judging->late[judging->late_count++] = job->found;
    return true;
}

static void free_job(Job *job)
{
    if (!job)
        return;
    sandbox_close(&job->run);
    free(job);
}

static Job *new_job(void)
{
    Job *job = memory_new(1, sizeof *job);
    job->run.pipe = -1;
    return job;
}

/* Starts submissions until each slot is busy or none are left. */
static bool fill(Judging *judging, const Found *const queue[], int *next, int slots,
                 Message *message)
{
    for (int slot = 0; slot < slots; slot++)
        while (!judging->jobs[slot] && queue[*next]) {
            bool ended = true;
            Job *job = new_job();
            const bool done = start(judging, job, queue[(*next)++], slot, &ended, message);
            if (done && !ended)
                judging->jobs[slot] = job;
            else
                free_job(job);
            if (!done)
                return false;
        }
    return true;
}

/* Waits for a run to end and continues with those that did. *busy: some are left. */
static bool advance(Judging *judging, bool *busy, Message *message)
{
    SandboxRun *runs[CLASS_JOBS_MAX];
    int count = 0;
    for (int slot = 0; slot < CLASS_JOBS_MAX; slot++)
        if (judging->jobs[slot])
            runs[count++] = &judging->jobs[slot]->run;
    *busy = count > 0;
    if (!*busy)
        return true;
    sandbox_wait(runs, count, 0.2);
    progress_update(&judging->progress, judging->done, judging->total);
    for (int slot = 0; slot < CLASS_JOBS_MAX; slot++) {
        Job *job = judging->jobs[slot];
        if (!job || job->run.running)
            continue;
        if (!end(judging, job, message))
            return false;
        free_job(job);
        judging->jobs[slot] = NULL;
    }
    return true;
}

/* Judges those of the queue, which ends with NULL, so many at a time. */
static bool judge_queue(Judging *judging, const Found *const queue[], int slots, Message *message)
{
    int next = 0;
    bool done = true;
    for (bool busy = true; done && busy && !*judging->of->interrupted;)
        done = fill(judging, queue, &next, slots, message) && advance(judging, &busy, message);
    for (int slot = 0; slot < slots; slot++) {
        free_job(judging->jobs[slot]);
        judging->jobs[slot] = NULL;
    }
    return done;
}

bool class_judge(const ClassJudging *of, Message *message)
{
    Judging judging = {.of = of, .progress = progress_start(of->lab->name)};
    const size_t size = (size_t)of->list->count + 1;
    const Found **queue = memory_new(size, sizeof *queue);
    judging.late = memory_new(size, sizeof *queue);
    for (int i = 0; i < of->list->count; i++)
        if (class_in_part(of->options, of->list->items[i].folder))
            queue[judging.total++] = &of->list->items[i];
    bool done = judge_queue(&judging, queue, of->options->jobs, message);
    judging.alone = true;
    done = done && judge_queue(&judging, judging.late, 1, message);
    free(queue);
    free(judging.late);
    progress_end(&judging.progress);
    return done && judging.failed
               ? message_set(message,
                             "%d of %d could not be judged, which is no fault of theirs; the same "
                             "command tries them again",
                             judging.failed, judging.total)
               : done;
}
