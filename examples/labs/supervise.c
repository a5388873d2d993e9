#include "supervise.h"

#include "progress.h"
#include "sanitized.h"

#include <dirent.h>
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

static void send_report(int pipe_end, const Report *report)
{
    const char *bytes = (const char *)report;
    for (size_t sent = 0; sent < sizeof *report;) {
        const ssize_t part = write(pipe_end, bytes + sent, sizeof *report - sent);
        if (part < 0 && errno == EINTR)
            continue;
        if (part <= 0)
            return;
        sent += (size_t)part;
    }
}

/* In the second process. The group is for what it starts; it ends with its parent. */
static _Noreturn void judge_apart(const JudgeOptions *options, double limit, int pipe_end)
{
    static Report report;
    const rlim_t seconds = (rlim_t)ceil(limit) + 1;
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    setrlimit(RLIMIT_CPU, &(struct rlimit){seconds, seconds + 1});
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
#ifndef ADDRESS_SANITIZER
    /* Address space: the driver's compiler alone asks for more than 1 GB of it. */
    const rlim_t most = (rlim_t)2 << 30;
    setrlimit(RLIMIT_AS, &(struct rlimit){most, most});
#endif
    /* One thread draws: what is drawn is small. */
    setenv("LP_NUM_THREADS", "0", 0);
    report.done = judge(options, &report.verdict, &report.message);
    send_report(pipe_end, &report);
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

/* Where the C of a submission is built; removed with the few files that may be in it. */
static bool open_scratch(char folder[PATH_MAX], Message *message)
{
    const char *place = getenv("TMPDIR");
    if (snprintf(folder, PATH_MAX, "%s/check-XXXXXX", place && place[0] ? place : "/tmp") >=
        PATH_MAX)
        return message_set(message, "%s: the path is too long", place);
    return mkdtemp(folder) ? true : message_set(message, "%s: %s", folder, strerror(errno));
}

static void close_scratch(const char *folder)
{
    DIR *list = opendir(folder);
    struct dirent *entry;
    while (list && (entry = readdir(list)))
        unlinkat(dirfd(list), entry->d_name, 0);
    if (list)
        closedir(list);
    rmdir(folder);
}

static bool supervise_in(const JudgeOptions *options, double limit, Verdict *verdict,
                         Message *message)
{
    static Report report;
    int ends[2], status = 0;
    bool late = false;
    const double start = progress_now();
    fflush(NULL);
    if (pipe(ends) != 0)
        return message_set(message, "a pipe: %s", strerror(errno));
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        judge_apart(options, limit, ends[1]);
    }
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        return message_set(message, "a second process: %s", strerror(errno));
    }
    setpgid(child, child);
    const bool received = receive(ends[0], start + limit, &report, &late);
    close(ends[0]);
    kill(-child, SIGKILL);
    kill(child, SIGKILL);
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
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
    if (!open_scratch(folder, message))
        return false;
    own.scratch = folder;
    const bool done = supervise_in(&own, limit, verdict, message);
    close_scratch(folder);
    return done;
}
