#include "supervise.h"

#include "child.h"
#include "output.h"
#include "progress.h"
#include "sanitized.h"
#include "scratch.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* What the judging process sends. */
typedef struct Report {
    bool done;
    Message message; /* where it is not done */
    Verdict verdict;
} Report;

/* In the second process. The group is for what it starts; it ends with its parent. */
static _Noreturn void judge_apart(const JudgeOptions *options, double limit, int pipe_end)
{
    static Report report;
    const rlim_t seconds = (rlim_t)ceil(limit) + 1;
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    setrlimit(RLIMIT_CPU, &(struct rlimit){seconds, seconds + 1});
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
    /* Address space: the driver's compiler alone asks for more than 1 GB of it. */
    const rlim_t most = (rlim_t)2 << 30;
    if (!ADDRESS_SANITIZER)
        setrlimit(RLIMIT_AS, &(struct rlimit){most, most});
    /* One thread draws: what is drawn is small. */
    setenv("LP_NUM_THREADS", "0", 0);
    report.done = judge(options, &report.verdict, &report.message);
    output_append(pipe_end, &report, sizeof report);
    _exit(0);
}

/* Reads a whole report until the deadline. */
static bool receive(int pipe_end, double deadline, Report *report, bool *late)
{
    size_t got = 0;
    while (got < sizeof *report) {
        struct pollfd ready = {.fd = pipe_end, .events = POLLIN};
        const double left = deadline - progress_now();
        *late = left <= 0;
        if (*late)
            return false;
        const int count = poll(&ready, 1, (int)fmin(ceil(1e3 * left), 1e6));
        if (count < 0 && errno != EINTR)
            return false;
        if (count <= 0)
            continue;
        const ssize_t part = read(pipe_end, (char *)report + got, sizeof *report - got);
        if (part < 0 && errno == EINTR)
            continue;
        if (part <= 0)
            return false;
        got += (size_t)part;
    }
    return true;
}

static void explain_end(Verdict *verdict, bool late, double limit, int status)
{
    verdict->kind = late ? VERDICT_TIMEOUT : VERDICT_ERROR;
    if (late || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)) {
        verdict->kind = VERDICT_TIMEOUT;
        snprintf(
            verdict->message, sizeof verdict->message,
            "It was not drawn within %g s: look for a loop that does not end, or for an array or a "
            "macro that is far too large.",
            limit);
    } else if (WIFSIGNALED(status)) {
        snprintf(verdict->message, sizeof verdict->message,
                 "The driver broke down on it (signal %d, %s): it is too large or too deeply "
                 "nested.",
                 WTERMSIG(status), strsignal(WTERMSIG(status)));
    } else {
        snprintf(verdict->message, sizeof verdict->message,
                 "The driver ended on it (status %d): it needs too much memory.",
                 WIFEXITED(status) ? WEXITSTATUS(status) : 0);
    }
}

static bool supervise_in(const JudgeOptions *options, double limit, Verdict *verdict,
                         Message *message)
{
    static Report report;
    int end;
    bool late = false;
    const double start = progress_now();
    fflush(NULL);
    const pid_t child = child_start(&end, message);
    if (child < 0)
        return false;
    if (child == 0)
        judge_apart(options, limit, end);
    setpgid(child, child);
    const bool received = receive(end, start + limit, &report, &late);
    close(end);
    kill(-child, SIGKILL);
    kill(child, SIGKILL);
    const int status = child_wait(child);
    if (received) {
        *verdict = report.verdict;
        return report.done ? true : message_set(message, "%s", report.message.text);
    }
    *verdict = (Verdict){.seed = options->seed, .seconds = progress_now() - start};
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
