/* The process is started by two forks: the one between waits, passes the end on, and takes the
 * whole process group with it when this program ends. Its single pipe is read without blocking, so
 * that many runs can be waited for at once; a run ends when all ends of its pipe are closed, at its
 * deadline, or when it has written too much. */
#include "labs/sandbox/sandbox.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/paths.h"
#include "base/process.h"
#include "base/sanitized.h"
#include "labs/sandbox/bubblewrap.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <netinet/in.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

/* Unused user ids (systemd's UIDS-GIDS table: 60578 to 61183), one per run, so that runs can
 * neither signal each other nor use up each other's process limit. */
enum { USER_FIRST = 60578, USER_COUNT = 606 };

static void write_text(const char *path, const char *text)
{
    const int file = open(path, O_WRONLY | O_CLOEXEC);
    if (file >= 0) {
        (void)!write(file, text, strlen(text));
        close(file);
    }
}

/* Without bubblewrap: at least no network. Root needs no user namespace, and would lose its rights
 * in one. */
static void leave_network(void)
{
    char map[64];
    if (getuid() == 0) {
        (void)!unshare(CLONE_NEWNET | CLONE_NEWIPC);
        return;
    }
    snprintf(map, sizeof map, "%ld %ld 1", (long)getuid(), (long)getuid());
    if (unshare(CLONE_NEWUSER | CLONE_NEWNET | CLONE_NEWIPC) == 0)
        write_text("/proc/self/uid_map", map);
}

static void end_group(int signal)
{
    (void)signal;
    kill(0, SIGKILL);
}

/* Forks once more. The process between waits, and ends its whole process group when its parent
 * ends; bubblewrap alone may leave its sandbox behind if it is killed at its start, in spite of
 * --die-with-parent. */
static void keep_group(pid_t parent)
{
    int status = 0;
    setsid(); /* also without a terminal */
    signal(SIGTERM, end_group);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const pid_t child = getppid() == parent ? fork() : -1;
    if (child == 0)
        return;
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR)
        continue;
    _exit(child < 0             ? SANDBOX_BROKEN
          : WIFSIGNALED(status) ? 128 + WTERMSIG(status) /* as bubblewrap has it */
                                : WEXITSTATUS(status));
}

/* The process after fork: nothing here may allocate. */
static void become(char *const words[], int output, bool isolate, pid_t parent)
{
    keep_group(parent);
    write_text("/proc/self/oom_score_adj", "1000"); /* killed first if memory runs out */
    if (isolate)
        leave_network();
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    process_null(STDIN_FILENO, STDIN_FILENO);
    if (dup2(output, STDOUT_FILENO) < 0 || dup2(output, STDERR_FILENO) < 0)
        _exit(SANDBOX_BROKEN);
    execvp(words[0], words);
    dprintf(STDERR_FILENO, "%s: %s\n", words[0], strerror(errno));
    _exit(SANDBOX_BROKEN);
}

static bool spawn(SandboxRun *run, char *const words[], bool isolate, Message *message)
{
    const pid_t self = getpid();
    int end;
    run->pid = process_fork(&end, message);
    if (run->pid < 0)
        return false;
    if (run->pid == 0)
        become(words, end, isolate, self);
    fcntl(end, F_SETFL, O_NONBLOCK);
    run->pipe = end;
    run->running = true;
    return true;
}

/* Makes a folder in $TMPDIR or /tmp that only its user can enter. The name is empty on failure. */
static bool scratch_open(char folder[PATH_MAX], Message *message)
{
    const char *place = getenv("TMPDIR");
    const int length =
        snprintf(folder, PATH_MAX, "%s/check-XXXXXX", place && place[0] ? place : "/tmp");
    if (length < PATH_MAX && mkdtemp(folder))
        return true;
    message_set(message, "a temporary folder in %s: %s", place && place[0] ? place : "/tmp",
                strerror(length < PATH_MAX ? errno : ENAMETOOLONG));
    folder[0] = '\0';
    return false;
}

static int remove_one(const char *path, const struct stat *status, int kind, struct FTW *walk)
{
    (void)status;
    (void)kind;
    (void)walk;
    remove(path);
    return 0;
}

/* Removes it with its contents; follows no link, stays on its file system. An empty name is fine.
 */
static void scratch_close(const char *folder)
{
    if (folder[0])
        nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS | FTW_MOUNT);
}

/* Without bubblewrap: a folder on disk for this run. */
static bool make_folder(SandboxRun *run, uid_t user, Message *message)
{
    if (!scratch_open(run->folder, message))
        return false;
    if (getuid() == 0 && chown(run->folder, user, user) != 0)
        return message_set(message, "cannot give %s to user %ld: %s%s", run->folder, (long)user,
                           strerror(errno),
                           errno == EINVAL ? " (run it outside of this user namespace)" : "");
    return true;
}

/* The wall time allowed for so many seconds of processor time, which runs share: for a machine with
 * many others at work. */
static double patience(double seconds)
{
    return 20 * seconds + 101;
}

bool sandbox_start(const Sandbox *sandbox, SandboxRun *run, int slot, const char *const arguments[],
                   SandboxInputs inputs, Message *message)
{
    char user[16], seconds[32], place[32];
    Words words = {.count = 0}, files = {.count = 0};
    *run = (SandboxRun){.pipe = -1};
    const uid_t id = getuid() == 0 ? USER_FIRST + (uid_t)(getpid() + slot) % USER_COUNT : getuid();
    if (!sandbox->bubblewrap && !make_folder(run, id, message))
        return false;
    if (sandbox->bubblewrap)
        bubblewrap_begin(&words, (const char *const[]){sandbox->program, sandbox->folder, NULL},
                         SANDBOX_FOLDER << 20);
    for (int i = 0; i < inputs.count; i++) {
        snprintf(place, sizeof place, "/submission/%d", i);
        const char *seen = sandbox->bubblewrap ? place : inputs.items[i].path;
        words_add(&files, (const char *const[]){seen, inputs.items[i].name, NULL});
        if (sandbox->bubblewrap)
            bubblewrap_bind(&words, inputs.items[i].path, place);
    }
    if (sandbox->bubblewrap)
        bubblewrap_end(&words);
    snprintf(user, sizeof user, "%ld", (long)id);
    snprintf(seconds, sizeof seconds, "%.0f", sandbox->seconds);
    words_add(&words, (const char *const[]){sandbox->program, "--inside", arguments[0], user,
                                            seconds, run->folder[0] ? run->folder : "/tmp", NULL});
    words_add(&words, arguments + 1);
    if (inputs.count > 0)
        words_add(&words, (const char *const *)files.words);
    run->start = clock_now();
    run->deadline = run->start + patience(sandbox->seconds);
    const bool done = spawn(run, words.words, !sandbox->bubblewrap, message);
    words_close(&words);
    words_close(&files);
    if (!done)
        sandbox_close(run);
    return done;
}

static void close_pipe(SandboxRun *run)
{
    if (run->pipe >= 0)
        close(run->pipe);
    run->pipe = -1;
}

static void kill_run(SandboxRun *run)
{
    /* Its process group, if it is one yet. */
    kill(-run->pid, SIGKILL);
    kill(run->pid, SIGKILL);
    close_pipe(run);
}

static void reap(SandboxRun *run)
{
    /* Its pipe is closed: it ends, or would never end. */
    kill(-run->pid, SIGKILL);
    const int status = process_wait(run->pid);
    run->status = WIFEXITED(status) ? WEXITSTATUS(status) : SANDBOX_BROKEN;
    run->running = false;
}

/* Reads once; closes the pipe at its end. */
static void read_pipe(SandboxRun *run)
{
    enum { BLOCK = 65536 };
    if (run->capacity - run->size < BLOCK + 1) {
        run->capacity = 2 * run->capacity + BLOCK + 1;
        run->bytes = memory_grow(run->bytes, run->capacity, 1);
    }
    const ssize_t count = read(run->pipe, run->bytes + run->size, BLOCK);
    if (count < 0 && (errno == EAGAIN || errno == EINTR))
        return;
    if (count <= 0)
        close_pipe(run);
    else
        run->size += (size_t)count;
    run->bytes[run->size] = '\0';
    run->too_much = run->size > SANDBOX_OUTPUT_MAX;
}

/* True when it has ended. */
static bool attend(SandboxRun *run, const struct pollfd *polled)
{
    if (run->pipe >= 0 && polled->revents)
        read_pipe(run);
    run->timed_out = clock_now() >= run->deadline;
    if (run->timed_out || run->too_much)
        kill_run(run);
    if (run->pipe >= 0)
        return false;
    reap(run);
    return true;
}

void sandbox_wait(SandboxRun *const runs[], int count, double seconds)
{
    struct pollfd polled[SANDBOX_RUNS_MAX];
    const double until = clock_now() + seconds;
    for (bool ended = false; !ended;) {
        double next = until;
        for (int i = 0; i < count; i++) {
            polled[i] = (struct pollfd){.fd = runs[i]->pipe, .events = POLLIN};
            if (runs[i]->deadline < next)
                next = runs[i]->deadline;
        }
        const double wait = 1000 * (next - clock_now());
        if (poll(polled, (nfds_t)count, wait > 0 ? (int)wait + 1 : 0) < 0)
            return; /* a signal */
        for (int i = 0; i < count; i++)
            if (attend(runs[i], &polled[i]))
                ended = true;
        if (clock_now() >= until)
            return;
    }
}

char *sandbox_part(const SandboxRun *run, SandboxPart part, size_t *size)
{
    char *at = run->bytes; /* NULL: nothing was said */
    size_t left = at ? run->size : 0;
    for (int i = 0; at && i < (int)part; i++) {
        char *const zero = memchr(at, '\0', left);
        left = zero ? left - (size_t)(zero + 1 - at) : 0;
        at = zero ? zero + 1 : NULL;
    }
    const char *const zero = at && part < SANDBOX_PICTURE ? memchr(at, '\0', left) : NULL;
    *size = zero ? (size_t)(zero - at) : left;
    return at;
}

/* What a sanitizer said, if `check` is built with one: then it is at fault, not what it judges. In
 * other builds a submission that prints the like is as wrong as any. */
static const char *sanitizer_said(const SandboxRun *run)
{
    static const char *const marks[] = {"runtime error: ", "SUMMARY: ", "Sanitizer"};
    const char *found = NULL;
    const size_t count = ADDRESS_SANITIZER && run->bytes ? sizeof marks / sizeof marks[0] : 0;
    for (size_t i = 0; i < count && !found; i++)
        found = memmem(run->bytes, run->size, marks[i], strlen(marks[i]));
    return found;
}

SandboxEnd sandbox_end(const SandboxRun *run)
{
    size_t size;
    const bool begun = sandbox_part(run, SANDBOX_WORK, &size) != NULL;
    if (run->status == 1 && sanitizer_said(run))
        return SANDBOX_FAILED;
    if (run->timed_out || run->status == 128 + SIGXCPU)
        return SANDBOX_TIMEOUT;
    if (run->status == 0 && !run->too_much && sandbox_part(run, SANDBOX_RESULT, &size))
        return SANDBOX_DONE;
    return begun && !run->too_much && run->status != SANDBOX_BROKEN ? SANDBOX_CRASHED
                                                                    : SANDBOX_FAILED;
}

/* The start of the line that ends before `end`. */
static size_t line_start(const char *said, size_t end)
{
    while (end > 0 && said[end - 1] != '\n' && said[end - 1] != '\0')
        end--;
    return end;
}

void sandbox_reason(const SandboxRun *run, char text[1024])
{
    const char *said = run->bytes;
    size_t rest, end, start;
    const char *result = sandbox_part(run, SANDBOX_RESULT, &rest);
    start = result ? (size_t)(result - said) : run->size;
    const char *const fault = sanitizer_said(run);
    if (fault)
        start = (size_t)(fault - said) + strcspn(fault, "\n");
    do {
        end = start;
        while (end > 0 && (said[end - 1] == '\n' || said[end - 1] == '\0'))
            end--;
        start = line_start(said, end);
    } while (start > 0 && said[start] == ' ');
    snprintf(text, 1024, "%.*s", end - start < 1000 ? (int)(end - start) : 1000,
             said ? said + start : "");
    if (run->too_much)
        snprintf(text, 1024, "too much output");
    else if (!text[0])
        snprintf(text, 1024, "no result");
    for (char *at = text; *at; at++)
        if ((unsigned char)*at < ' ' || *at == 0x7F)
            *at = ' ';
}

void sandbox_close(SandboxRun *run)
{
    if (!run)
        return;
    if (run->running) {
        kill_run(run);
        reap(run);
    }
    scratch_close(run->folder);
    free(run->bytes);
    *run = (SandboxRun){.pipe = -1};
}

/* An open port of this machine, which the process tries to reach. */
static int listen_here(char port[16])
{
    struct sockaddr_in address = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    socklen_t size = sizeof address;
    const int file = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const bool open = file >= 0 && bind(file, (struct sockaddr *)&address, size) == 0 &&
                      listen(file, 8) == 0 &&
                      getsockname(file, (struct sockaddr *)&address, &size) == 0;
    snprintf(port, 16, "%d", open ? ntohs(address.sin_port) : 0);
    return file;
}

/* Runs a process that tries to break out. */
static bool prove(Sandbox *sandbox, const char *hidden, Message *message)
{
    char port[16], reason[1024];
    size_t size;
    SandboxRun run = {.pipe = -1};
    SandboxRun *const runs[] = {&run};
    const int server = listen_here(port);
    if (server < 0)
        return message_set(message, "%s", strerror(errno));
    bool done = sandbox_start(sandbox, &run, 0,
                              (const char *const[]){"prove", hidden, port, sandbox->folder, NULL},
                              (SandboxInputs){NULL, 0}, message);
    while (run.running)
        sandbox_wait(runs, 1, 1);
    if (done && sandbox_end(&run) != SANDBOX_DONE) {
        sandbox_reason(&run, reason);
        done = message_set(message, "%s", reason);
    }
    const char *proof = done ? sandbox_part(&run, SANDBOX_RESULT, &size) : NULL;
    sandbox->proven = proof ? (unsigned)strtoul(proof, NULL, 10) : 0;
    sandbox_close(&run);
    close(server);
    return done;
}

bool sandbox_open(Sandbox *sandbox, const Lab *lab, double seconds, const char *hidden,
                  Message *message)
{
    Message why = {.text = ""};
    *sandbox = (Sandbox){.bubblewrap = true, .seconds = seconds};
    if (!lab_folder(lab, sandbox->folder, message) || !paths_program(sandbox->program, message))
        return false;
    char *slash = strrchr(sandbox->folder, '/');
    if (slash && (!lab->folder || lab->code))
        *slash = '\0';
    if (prove(sandbox, hidden, &why) && (sandbox->proven & SANDBOX_LIMITS))
        return true;
    message_set(message, "bubblewrap: %s", why.text[0] ? why.text : "the limits do not hold");
    sandbox->bubblewrap = false;
    why.text[0] = '\0';
    if (prove(sandbox, hidden, &why) && (sandbox->proven & SANDBOX_LIMITS))
        return true;
    message_add(message, "; and without it: %s",
                why.text[0] ? why.text : "the limits do not hold either");
    return false;
}

bool sandbox_admits(const Sandbox *sandbox, const Lab *lab, Message *message)
{
    return !lab->code || (sandbox->proven & SANDBOX_NO_FILES)
               ? true
               : message_set(message,
                             "%s: has C, which runs only in a sandbox; install the package "
                             "bubblewrap",
                             lab->name);
}

void sandbox_describe(const Sandbox *sandbox, char text[256])
{
    const bool files = sandbox->proven & SANDBOX_NO_FILES;
    const bool network = sandbox->proven & SANDBOX_NO_NETWORK;
    snprintf(text, 256,
             "each submission runs %s: %s, %s, at most %.0f s, %d MB of memory, %d processes",
             sandbox->bubblewrap ? "in bubblewrap" : "without bubblewrap",
             network ? "no network" : "WITH the network",
             files ? "no files but its own" : "WITH files that others can read", sandbox->seconds,
             SANDBOX_MEMORY, SANDBOX_PROCESSES);
}
