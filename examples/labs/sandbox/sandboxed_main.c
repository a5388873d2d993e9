/* A submission passes three gates. With the caller's rights its files are read, as bytes: the
 * folder may be closed to others, and of it only regular files count (source.h, submission.h). Then
 * all rights are given up for good. Only then is anything looked into: an archive unpacked, text
 * taken for what it is, shaders compiled and drawn, C compiled and called. */
#include "labs/sandbox/sandbox.h"

#include "app/options.h"
#include "base/output.h"
#include "base/process.h"
#include "base/sanitized.h"
#include "labs/check/judge.h"
#include "labs/sandbox/source.h"
#include "labs/submission/lab_json.h"
#include "labs/submission/statements.h"
#include "labs/submission/verdict_json.h"

#include <errno.h>
#include <fcntl.h>
#include <grp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

/* Of processor time beyond the submission's. */
enum { DIAGNOSIS_SECONDS = 70 };

/* Never more than the current limit. With a name, one that is less is an error, because what does
 * not fit into it would be taken for the submission's fault. */
static bool set_limit(__rlimit_resource_t which, rlim_t soft, rlim_t hard, const char *name,
                      Message *message)
{
    struct rlimit limit;
    if (getrlimit(which, &limit) != 0)
        return message_set(message, "getrlimit: %s", strerror(errno));
    if (name && limit.rlim_max < soft)
        return message_set(message, "the limit of %s is %llu: raise it to %llu", name,
                           (unsigned long long)limit.rlim_max, (unsigned long long)soft);
    limit.rlim_max = limit.rlim_max < hard ? limit.rlim_max : hard;
    limit.rlim_cur = limit.rlim_max < soft ? limit.rlim_max : soft;
    return setrlimit(which, &limit) == 0 ? true
                                         : message_set(message, "setrlimit: %s", strerror(errno));
}

/* Becomes an unprivileged user, permanently. */
static bool become_user(long user, Message *message)
{
    const uid_t id = (uid_t)user;
    if (getuid() != 0 && (uid_t)user == getuid()) {
        ;
    } else if (user < 1 || setgroups(0, NULL) != 0 || setresgid(id, id, id) != 0 ||
               setresuid(id, id, id) != 0 || getuid() != id || setuid(0) == 0) {
        return message_set(message, "cannot become user %ld: %s", user, strerror(errno));
    }
    /* Changing the user resets this. */
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0
               ? true
               : message_set(message, "no_new_privs: %s", strerror(errno));
}

static bool take_limits(rlim_t seconds, Message *message)
{
    const rlim_t megabyte = 1 << 20;
    const rlim_t memory = SANDBOX_MEMORY * megabyte, file = SANDBOX_FILE * megabyte;
    if (!ADDRESS_SANITIZER && !set_limit(RLIMIT_AS, memory, memory, NULL, message))
        return false;
    return set_limit(RLIMIT_CPU, seconds, seconds + 1, "processor seconds (ulimit -t)", message) &&
           set_limit(RLIMIT_FSIZE, file, file, "a file's bytes (ulimit -f)", message) &&
           set_limit(RLIMIT_NPROC, SANDBOX_PROCESSES, SANDBOX_PROCESSES, NULL, message) &&
           set_limit(RLIMIT_CORE, 0, 0, NULL, message) &&
           set_limit(RLIMIT_NOFILE, 128, 128, "open files (ulimit -n)", message);
}

/* Keeps only what drawing needs. One thread draws, because there is one submission per processor.
 * No cache, because a submission could write to it. What draws a few small pictures is not worth
 * optimizing, which takes half of the time of a check; but a lab's `budget` is measured. */
static bool set_environment(const char *folder, bool measured, Message *message)
{
    static const char *const kept[] = {"LIGHTING_BACKEND", "ASAN_OPTIONS", "LSAN_OPTIONS",
                                       "UBSAN_OPTIONS"};
    enum { KEPT = sizeof kept / sizeof kept[0] };
    const char *values[KEPT];
    /* No other values of these: some let the driver draw something else, or crash. */
    unsigned least = 0;
    for (int i = 0; i < KEPT; i++)
        values[i] = getenv(kept[i]);
    for (int i = 0; OPTIONS_LEAST[i]; i++)
        least |= (unsigned)process_has(OPTIONS_LEAST[i]) << i;
    bool done = clearenv() == 0; /* the texts stay where they are */
    for (int i = 0; OPTIONS_LEAST[i]; i++)
        if (least >> i & 1)
            done = putenv((char *)OPTIONS_LEAST[i]) == 0 && done;
    for (int i = 0; i < KEPT; i++)
        if (values[i])
            done = setenv(kept[i], values[i], 1) == 0 && done;
    const char *const own[][2] = {{"PATH", "/usr/bin:/bin"},
                                  {"HOME", folder},
                                  {"TMPDIR", folder},
                                  {"LC_ALL", "C.UTF-8"},
                                  {"LP_NUM_THREADS", "0"},
                                  {"MESA_SHADER_CACHE_DISABLE", "true"},
                                  {"GALLIVM_PERF", measured ? "" : "nopt"},
                                  {"XDG_CACHE_HOME", "/dev/null"}};
    for (size_t i = 0; i < sizeof own / sizeof own[0]; i++)
        done = setenv(own[i][0], own[i][1], 1) == 0 && done;
    return done ? true : message_set(message, "the environment: %s", strerror(errno));
}

/* A zero byte divides what is written: see SandboxRun. */
static bool put_part(const void *bytes, size_t size, Message *message)
{
    fflush(stdout);
    return (output_append(STDOUT_FILENO, "", 1) && output_append(STDOUT_FILENO, bytes, size)) ||
           message_set(message, "the result: %s", strerror(errno));
}

static bool put_file(const char *path, Message *message)
{
    char block[65536];
    ssize_t size = 0;
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    bool done = put_part("", 0, message);
    while (done && file >= 0 && (size = read(file, block, sizeof block)) > 0)
        done = output_append(STDOUT_FILENO, block, (size_t)size);
    if (file >= 0)
        close(file);
    return done && size == 0;
}

/* HIDDEN PORT LABS */
static bool prove(char *arguments[], Message *message)
{
    char text[16];
    unsigned failed;
    if (!breakout_try(arguments[0], atoi(arguments[1]), arguments[2], &failed, message))
        return false;
    const int length = snprintf(text, sizeof text, "%u", failed);
    return put_part("", 0, message) && put_part(text, (size_t)length, message);
}

/* A submission on its way through the gates. */
typedef struct Submitted {
    const Lab *lab;
    uint64_t seed;
    SandboxSource kind;
    Bundle bundle;
    int archive; /* open; -1: none */
    SubmissionFiles files;
    bool refused;
    Message why;
} Submitted;

/* LAB SEED KIND, then a place and a name for each file. */
static void read_submitted(Submitted *of, int count, char *arguments[])
{
    char *const place = arguments[3];
    bool read = true;
    *of = (Submitted){.lab = lab_open(arguments[0], &of->why),
                      .seed = strtoull(arguments[1], NULL, 10),
                      .kind = (SandboxSource)atoi(arguments[2]),
                      .archive = -1};
    switch (of->kind) {
    case SOURCE_FOLDER:
        read = source_read_folder(&of->bundle, place, &of->why);
        break;
    case SOURCE_FILES:
        for (int i = 3; i + 1 < count && read; i += 2)
            read = source_read_file(&of->bundle, arguments[i], arguments[i + 1], &of->why);
        break;
    case SOURCE_ARCHIVE:
        of->archive = open(place, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        read = of->archive >= 0 ||
               message_set(&of->why, "the archive cannot be read: %s", strerror(errno));
        break;
    }
    of->refused = !read;
}

/* Takes the lab's files from what was read. */
static bool look_into(Submitted *of)
{
    if (of->refused)
        return false;
    if (of->kind == SOURCE_ARCHIVE && !unpack_sources(&of->bundle, of->archive, &of->why))
        return false;
    if (!source_choose(&of->bundle, of->lab, &of->why))
        return false;
    source_normalize(&of->bundle, of->lab);
    return source_files(&of->bundle, of->lab, &of->files, &of->why);
}

static bool check(Submitted *of, double seconds, const char *folder, Message *message)
{
    static Verdict verdict; /* large */
    if (!look_into(of)) {
        verdict_refuse(&verdict, of->lab, of->seed, &of->why);
        return put_part("", 0, message) && put_part("", 0, message) &&
               verdict_write(&verdict, of->lab, "", "-", message);
    }
    const JudgeOptions judged = {.lab = of->lab,
                                 .files = &of->files,
                                 .seed = of->seed,
                                 .scratch = folder,
                                 .pictures = folder};
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/%s", folder, JUDGE_WORST);
    judge_limit((rlim_t)seconds);
    bool done = put_part("", 0, message) && judge(&judged, &verdict, message) &&
                put_part("", 0, message) && verdict_write(&verdict, of->lab, "", "-", message);
    char *statements = statements_text(of->lab, &of->files);
    done = done && put_part(statements, strlen(statements), message) &&
           (!verdict.picture[0] || put_file(path, message));
    free(statements);
    return done;
}

int sandboxed_main(int count, char *arguments[])
{
    static Submitted submitted; /* large */
    Message message = {.text = ""};
    const bool proves = count == 7 && strcmp(arguments[0], "prove") == 0;
    const bool checks = count >= 8 && strcmp(arguments[0], "check") == 0;
    if (!proves && !checks) {
        fputs("--inside: only for internal use\n", stderr);
        return 2;
    }
    const double seconds = strtod(arguments[2], NULL);
    const char *folder = arguments[3];
    if (checks)
        read_submitted(&submitted, count - 4, arguments + 4);
    signal(SIGXFSZ, SIG_IGN);
    bool done = become_user(strtol(arguments[1], NULL, 10), &message) &&
                take_limits((rlim_t)seconds + DIAGNOSIS_SECONDS, &message) &&
                set_environment(folder, checks && submitted.lab->budget, &message);
    if (done && chdir(folder) != 0)
        done = message_set(&message, "%s: %s", folder, strerror(errno));
    done = done &&
           (proves ? prove(arguments + 4, &message) : check(&submitted, seconds, folder, &message));
    if (!done)
        fprintf(stderr, "%s\n", message.text);
    return done ? 0 : SANDBOX_BROKEN;
}
