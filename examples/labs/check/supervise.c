#include "labs/check/supervise.h"

#include "base/clock.h"
#include "base/output.h"
#include "base/process.h"
#include "labs/check/scratch.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* Of processor time for the diagnosis, which is not the submission's; and of wall time for each
 * second of processor time, on a busy machine. */
enum { DIAGNOSIS_SECONDS = 60, BUSY = 20, BUSY_START = 60 };

/* Sent by the judging process. */
typedef struct Report {
    bool done;
    Message message; /* if not done */
    Verdict verdict;
} Report;

/* In the child, which ends with its parent; its process group includes its own children. */
static _Noreturn void judge_apart(const JudgeOptions *options, double limit, pid_t parent,
                                  int pipe_end)
{
    static Report report;
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent)
        _exit(1); /* it ended before that */
    /* The driver's compiler alone asks for more than 1 GB of address space. */
    process_limit((rlim_t)ceil(limit) + DIAGNOSIS_SECONDS, (rlim_t)2 << 30);
    judge_limit((rlim_t)ceil(limit));
    /* One thread: the pictures are small. */
    setenv("LP_NUM_THREADS", "0", 0);
    report.done = judge(options, &report.verdict, &report.message);
    output_append(pipe_end, &report, sizeof report);
    _exit(0);
}

static void explain_end(Verdict *verdict, bool late, double limit, int status)
{
    verdict->kind = late ? VERDICT_TIMEOUT : VERDICT_ERROR;
    if (late || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)) {
        verdict->kind = VERDICT_TIMEOUT;
        snprintf(
            verdict->message, sizeof verdict->message,
            "Not drawn within %g s of processor time: look for an endless loop, or a far too large array or macro.",
            limit);
    } else if (WIFSIGNALED(status)) {
        snprintf(verdict->message, sizeof verdict->message,
                 "It crashes the driver (signal %d, %s): it is too large or too deeply nested.",
                 WTERMSIG(status), strsignal(WTERMSIG(status)));
    } else {
        snprintf(verdict->message, sizeof verdict->message,
                 "The driver exits on it (status %d): it needs too much memory.",
                 WIFEXITED(status) ? WEXITSTATUS(status) : 0);
    }
}

static bool supervise_in(const JudgeOptions *options, double limit, Verdict *verdict,
                         Message *message)
{
    static Report report;
    int end;
    const double start = clock_now(), last = start + BUSY * limit + BUSY_START;
    fflush(NULL);
    const pid_t self = getpid();
    const pid_t child = process_fork(&end, message);
    if (child < 0)
        return false;
    if (child == 0)
        judge_apart(options, limit, self, end);
    setpgid(child, child);
    const bool received = process_read(end, &report, sizeof report, last) == sizeof report;
    const bool late = !received && clock_now() >= last;
    close(end);
    kill(-child, SIGKILL);
    kill(child, SIGKILL);
    const int status = process_wait(child);
    if (received) {
        *verdict = report.verdict;
        return report.done ? true : message_set(message, "%s", report.message.text);
    }
    *verdict = (Verdict){.seed = options->seed, .seconds = clock_now() - start};
    explain_end(verdict, late, limit, status);
    return true;
}

bool supervise(const JudgeOptions *options, double limit, Verdict *verdict, Message *message)
{
    char folder[PATH_MAX];
    JudgeOptions own = *options;
    if (!options->lab->code)
        return supervise_in(options, limit, verdict, message);
    if (!scratch_open(folder, message))
        return false;
    own.scratch = folder;
    const bool done = supervise_in(&own, limit, verdict, message);
    scratch_close(folder);
    return done;
}
