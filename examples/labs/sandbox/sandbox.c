#include "labs/sandbox/sandbox.h"

#include "base/clock.h"
#include "base/paths.h"
#include "base/process.h"
#include "labs/check/scratch.h"
#include "labs/sandbox/bundle.h"
#include "labs/sandbox/inside.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
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

enum { ARGUMENTS_MAX = 1000 };

/* A command line; it owns its strings. */
typedef struct Arguments {
    char *words[ARGUMENTS_MAX + 1];
    int count;
    bool full; /* or no memory */
} Arguments;

static void add_word(Arguments *arguments, const char *word)
{
    char *copy = arguments->count < ARGUMENTS_MAX ? strdup(word) : NULL;
    if (copy)
        arguments->words[arguments->count++] = copy;
    else
        arguments->full = true;
}

static void add_words(Arguments *arguments, const char *const words[])
{
    for (; *words; words++)
        add_word(arguments, *words);
}

static void close_arguments(Arguments *arguments)
{
    for (int i = 0; i < arguments->count; i++)
        free(arguments->words[i]);
    *arguments = (Arguments){.count = 0};
}

/* Makes the folders above `path` accessible: bubblewrap's own are only for its user. */
static void add_folders_above(Arguments *arguments, const char *path)
{
    char folder[PATH_MAX];
    snprintf(folder, sizeof folder, "%s", path);
    for (char *slash = strchr(folder + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        add_words(arguments, (const char *const[]){"--perms", "0755", "--dir", folder, NULL});
        *slash = '/';
    }
}

static void add_readable(Arguments *arguments, const char *path)
{
    if (!path[0] || access(path, F_OK) != 0 || strncmp(path, "/usr/", 5) == 0)
        return;
    add_folders_above(arguments, path);
    add_words(arguments, (const char *const[]){"--ro-bind", path, path, NULL});
}

/* The system's programs and libraries, in /usr or beside it. */
static void add_system(Arguments *arguments)
{
    static const char *const folders[] = {"/bin", "/lib", "/lib32", "/lib64", "/sbin"};
    add_words(arguments, (const char *const[]){"--ro-bind", "/usr", "/usr", NULL});
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        char target[PATH_MAX];
        const ssize_t length = readlink(folders[i], target, sizeof target - 1);
        target[length > 0 ? length : 0] = '\0';
        if (length > 0)
            add_words(arguments, (const char *const[]){"--symlink", target, folders[i], NULL});
        else
            add_readable(arguments, folders[i]);
    }
    add_readable(arguments, "/etc/ld.so.cache");
    add_readable(arguments, "/etc/alternatives"); /* the link "cc" */
}

/* What the program needs to draw and to compile. */
static void add_own(Arguments *arguments)
{
    char path[PATH_MAX];
    for (int i = 0; i < PATHS_PLACE_COUNT; i++) {
        const PathsPlace place = (PathsPlace)i;
        if (paths_data(place, "shaders", "", path))
            add_readable(arguments, path);
        if (place == PATHS_SOURCE && paths_data(place, "common", "", path))
            add_readable(arguments, path);
        if (paths_plugin(place, "", path))
            add_readable(arguments, path);
    }
}

static void add_bubblewrap(Arguments *arguments, const Sandbox *sandbox)
{
    char size[32];
    snprintf(size, sizeof size, "%d", SANDBOX_FOLDER << 20);
    add_words(arguments,
              (const char *const[]){"bwrap", "--unshare-pid", "--unshare-net", "--unshare-ipc",
                                    "--unshare-uts", "--die-with-parent", NULL});
    /* As root no user namespace, because in it the process limit would not hold. Only the rights to
     * change the user remain. */
    if (getuid() == 0)
        add_words(arguments, (const char *const[]){"--cap-drop", "ALL", "--cap-add", "CAP_SETUID",
                                                   "--cap-add", "CAP_SETGID", NULL});
    else
        add_word(arguments, "--unshare-user");
    add_system(arguments);
    add_words(arguments, (const char *const[]){"--proc", "/proc", "--dev", "/dev", "--perms",
                                               "1777", "--size", size, "--tmpfs", "/tmp", NULL});
    add_readable(arguments, sandbox->program);
    add_own(arguments);
    add_readable(arguments, sandbox->folder);
    /* These folders in memory have no size limit, and are not needed. */
    add_words(arguments, (const char *const[]){"--remount-ro", "/dev", "--remount-ro", "/",
                                               "--chdir", "/tmp", "--", NULL});
}

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
    _exit(child > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : INSIDE_BROKEN);
}

/* The process after fork: nothing here may allocate. */
static void become(char *const words[], const int files[3], bool isolate, pid_t parent)
{
    keep_group(parent);
    write_text("/proc/self/oom_score_adj", "1000"); /* killed first if memory runs out */
    if (isolate)
        leave_network();
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    for (int i = 0; i < 3; i++)
        if (dup2(files[i], i) < 0)
            _exit(INSIDE_BROKEN);
    execvp(words[0], words);
    dprintf(STDERR_FILENO, "%s: %s\n", words[0], strerror(errno));
    _exit(INSIDE_BROKEN);
}

static bool spawn(SandboxRun *run, char *const words[], int input, bool isolate, Message *message)
{
    int output[2] = {-1, -1}, errors[2] = {-1, -1};
    if (pipe2(output, O_CLOEXEC) != 0 || pipe2(errors, O_CLOEXEC) != 0)
        goto failed;
    const int files[3] = {input, output[1], errors[1]};
    const pid_t self = getpid();
    run->pid = fork();
    if (run->pid < 0)
        goto failed;
    if (run->pid == 0)
        become(words, files, isolate, self);
    close(output[1]);
    close(errors[1]);
    fcntl(output[0], F_SETFL, O_NONBLOCK);
    fcntl(errors[0], F_SETFL, O_NONBLOCK);
    run->output = output[0];
    run->errors = errors[0];
    run->running = true;
    return true;

failed:
    message_set(message, "a sandboxed process: %s", strerror(errno));
    for (int i = 0; i < 2; i++) {
        if (output[i] >= 0)
            close(output[i]);
        if (errors[i] >= 0)
            close(errors[i]);
    }
    return false;
}

/* Without bubblewrap: a folder on disk for this run. */
static bool make_folder(SandboxRun *run, uid_t user, Message *message)
{
    if (!scratch_open(run->folder, message))
        return false;
    if (getuid() == 0 && chown(run->folder, user, user) != 0)
        return message_set(message, "%s: %s", run->folder, strerror(errno));
    return true;
}

double sandbox_patience(double seconds)
{
    /* Compiling and drawing are limited by processor time: this is for a machine with many others
     * at work. */
    return 20 * seconds + 100;
}

bool sandbox_start(const Sandbox *sandbox, SandboxRun *run, int slot, int input,
                   const char *const arguments[], Message *message)
{
    char user[16], seconds[32];
    Arguments line = {.count = 0};
    *run = (SandboxRun){.output = -1, .errors = -1};
    const uid_t id = getuid() == 0 ? USER_FIRST + (uid_t)(getpid() + slot) % USER_COUNT : getuid();
    if (!sandbox->bubblewrap && !make_folder(run, id, message))
        return false;
    snprintf(user, sizeof user, "%ld", (long)id);
    snprintf(seconds, sizeof seconds, "%.0f", sandbox->seconds);
    if (sandbox->bubblewrap)
        add_bubblewrap(&line, sandbox);
    add_words(&line, (const char *const[]){sandbox->program, "--inside", user, seconds,
                                           run->folder[0] ? run->folder : "/tmp", NULL});
    add_words(&line, arguments);
    run->deadline = clock_now() + sandbox_patience(sandbox->seconds) + 1;
    const bool done = line.full ? message_set(message, "a sandboxed process: too many arguments")
                                : spawn(run, line.words, input, !sandbox->bubblewrap, message);
    close_arguments(&line);
    if (!done)
        sandbox_close(run);
    return done;
}

static void close_file(int *file)
{
    if (*file >= 0)
        close(*file);
    *file = -1;
}

static void kill_run(SandboxRun *run)
{
    /* Its process group, if it is one yet. */
    kill(-run->pid, SIGKILL);
    kill(run->pid, SIGKILL);
    close_file(&run->output);
    close_file(&run->errors);
}

static void reap(SandboxRun *run)
{
    /* Its pipes are closed: it ends, or would never end. */
    kill(-run->pid, SIGKILL);
    run->status = process_wait(run->pid);
    run->running = false;
}

static bool keep_output(SandboxRun *run, const unsigned char *bytes, size_t size)
{
    if (run->size + size > SANDBOX_OUTPUT_MAX)
        return false;
    if (run->size + size > run->capacity) {
        const size_t capacity = 2 * (run->size + size);
        unsigned char *larger = realloc(run->bytes, capacity);
        if (!larger)
            return false;
        run->bytes = larger;
        run->capacity = capacity;
    }
    memcpy(run->bytes + run->size, bytes, size);
    run->size += size;
    return true;
}

static void keep_said(SandboxRun *run, const unsigned char *bytes, size_t size)
{
    enum { MAX = SANDBOX_SAID_SIZE };
    if (size > MAX) {
        bytes += size - MAX;
        size = MAX;
    }
    const size_t kept = run->said_size + size > MAX ? MAX - size : run->said_size;
    memmove(run->said, run->said + run->said_size - kept, kept);
    memcpy(run->said + kept, bytes, size);
    run->said_size = kept + size;
}

/* Reads once; closes the pipe at its end. */
static void read_pipe(SandboxRun *run, int *file)
{
    unsigned char block[65536];
    const ssize_t count = read(*file, block, sizeof block);
    if (count < 0 && (errno == EAGAIN || errno == EINTR))
        return;
    if (count <= 0)
        close_file(file);
    else if (file == &run->errors)
        keep_said(run, block, (size_t)count);
    else if (!keep_output(run, block, (size_t)count))
        run->too_much = true;
}

/* True when it has ended. */
static bool attend(SandboxRun *run, const struct pollfd polled[2])
{
    if (run->output >= 0 && polled[0].revents)
        read_pipe(run, &run->output);
    if (run->errors >= 0 && polled[1].revents)
        read_pipe(run, &run->errors);
    run->timed_out = clock_now() >= run->deadline;
    if (run->timed_out || run->too_much)
        kill_run(run);
    if (run->output >= 0 || run->errors >= 0)
        return false;
    reap(run);
    return true;
}

void sandbox_wait(SandboxRun *const runs[], int count, double seconds)
{
    struct pollfd polled[2 * SANDBOX_RUNS_MAX];
    const double until = clock_now() + seconds;
    for (bool ended = false; !ended;) {
        double next = until;
        for (int i = 0; i < count; i++) {
            polled[2 * i] = (struct pollfd){.fd = runs[i]->output, .events = POLLIN};
            polled[2 * i + 1] = (struct pollfd){.fd = runs[i]->errors, .events = POLLIN};
            if (runs[i]->deadline < next)
                next = runs[i]->deadline;
        }
        const double wait = 1000 * (next - clock_now());
        if (poll(polled, (nfds_t)(2 * count), wait > 0 ? (int)wait + 1 : 0) < 0)
            return; /* a signal */
        for (int i = 0; i < count; i++)
            if (attend(runs[i], polled + 2 * (size_t)i))
                ended = true;
        if (clock_now() >= until)
            return;
    }
}

SandboxEnd sandbox_end(const SandboxRun *run)
{
    if (run->timed_out)
        return SANDBOX_TIMEOUT;
    if (run->too_much || !WIFEXITED(run->status))
        return SANDBOX_FAILED;
    switch (WEXITSTATUS(run->status)) {
    case 0:
        return SANDBOX_DONE;
    case INSIDE_REFUSED:
        return SANDBOX_REFUSED;
    case INSIDE_TIMEOUT:
        return SANDBOX_TIMEOUT;
    default:
        return SANDBOX_FAILED;
    }
}

/* The start of the line that ends before `end`. */
static size_t line_start(const SandboxRun *run, size_t end)
{
    while (end > 0 && run->said[end - 1] != '\n')
        end--;
    return end;
}

void sandbox_last_line(const SandboxRun *run, char text[1024])
{
    size_t end = run->said_size, start = end;
    do {
        end = start;
        while (end > 0 && run->said[end - 1] == '\n')
            end--;
        start = line_start(run, end);
    } while (start > 0 && run->said[start] == ' ');
    const size_t length = end - start < 1000 ? end - start : 1000;
    memcpy(text, run->said + start, length);
    text[length] = '\0';
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
    *run = (SandboxRun){.output = -1, .errors = -1};
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
    char port[16], line[1024];
    SandboxRun run = {.output = -1, .errors = -1};
    SandboxRun *const runs[] = {&run};
    Bundle *bundle = calloc(1, sizeof *bundle);
    const int server = listen_here(port), input = open("/dev/null", O_RDONLY | O_CLOEXEC);
    bool done = bundle && server >= 0 && input >= 0;
    if (!done)
        message_set(message, "%s", strerror(errno));
    done =
        done &&
        sandbox_start(sandbox, &run, 0, input,
                      (const char *const[]){"prove", hidden, port, sandbox->folder, NULL}, message);
    while (run.running)
        sandbox_wait(runs, 1, 1);
    if (done && sandbox_end(&run) != SANDBOX_DONE) {
        sandbox_last_line(&run, line);
        done = message_set(message, "%s", line[0] ? line : "it exits at once");
    }
    done = done && bundle_read(bundle, run.bytes, run.size, message);
    const BundleFile *proof = done ? bundle_find(bundle, "proof") : NULL;
    sandbox->proven = proof ? (unsigned)strtoul((const char *)proof->bytes, NULL, 10) : 0;
    sandbox_close(&run);
    bundle_close(bundle);
    free(bundle);
    if (server >= 0)
        close(server);
    if (input >= 0)
        close(input);
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
    if (slash)
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
