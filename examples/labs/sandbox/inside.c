#include "labs/sandbox/inside.h"

#include "base/output.h"
#include "base/paths.h"
#include "base/process.h"
#include "base/sanitized.h"
#include "labs/check/supervise.h"
#include "labs/sandbox/bundle.h"
#include "labs/sandbox/sandbox.h"
#include "labs/sandbox/unpack.h"
#include "labs/submission/verdict_json.h"

#include <arpa/inet.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <grp.h>
#include <netinet/in.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* Of processor time beyond the submission's. */
enum { DIAGNOSIS_SECONDS = 70 };

static bool set_limit(__rlimit_resource_t which, rlim_t soft, rlim_t hard, Message *message)
{
    /* Never more than the current limit. */
    struct rlimit limit;
    if (getrlimit(which, &limit) != 0)
        return message_set(message, "getrlimit: %s", strerror(errno));
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
    if (!ADDRESS_SANITIZER &&
        !set_limit(RLIMIT_AS, SANDBOX_MEMORY * megabyte, SANDBOX_MEMORY * megabyte, message))
        return false;
    return set_limit(RLIMIT_CPU, seconds, seconds + 1, message) &&
           set_limit(RLIMIT_FSIZE, SANDBOX_FILE * megabyte, SANDBOX_FILE * megabyte, message) &&
           set_limit(RLIMIT_NPROC, SANDBOX_PROCESSES, SANDBOX_PROCESSES, message) &&
           set_limit(RLIMIT_CORE, 0, 0, message) && set_limit(RLIMIT_NOFILE, 128, 128, message);
}

/* Keeps only what drawing needs. One thread draws, because there is one submission per processor.
 */
static bool set_environment(const char *folder, Message *message)
{
    static const char *const kept[] = {
        "LIGHTING_BACKEND", "ASAN_OPTIONS", "LSAN_OPTIONS", "UBSAN_OPTIONS",
        /* of --deterministic */
        "GALLIUM_OVERRIDE_CPU_CAPS", "LP_NATIVE_VECTOR_WIDTH", "GLIBC_TUNABLES"};
    enum { KEPT = sizeof kept / sizeof kept[0] };
    const char *values[KEPT];
    for (int i = 0; i < KEPT; i++)
        values[i] = getenv(kept[i]);
    bool done = clearenv() == 0; /* the texts stay where they are */
    for (int i = 0; i < KEPT; i++)
        if (values[i])
            done = setenv(kept[i], values[i], 1) == 0 && done;
    const char *const own[][2] = {{"PATH", "/usr/bin:/bin"}, {"HOME", folder},
                                  {"TMPDIR", folder},        {"LC_ALL", "C.UTF-8"},
                                  {"LP_NUM_THREADS", "0"},   {"MESA_SHADER_CACHE_DISABLE", "true"}};
    for (size_t i = 0; i < sizeof own / sizeof own[0]; i++)
        done = setenv(own[i][0], own[i][1], 1) == 0 && done;
    return done ? true : message_set(message, "the environment: %s", strerror(errno));
}

/* Starts up to SANDBOX_PROCESSES and a few processes, ends them, and returns how many started. */
static int count_processes(void)
{
    enum { TRIED = SANDBOX_PROCESSES + 16 };
    pid_t children[TRIED];
    int count = 0;
    while (count < TRIED && (children[count] = fork()) >= 0) {
        if (children[count] == 0) {
            pause();
            _exit(0);
        }
        count++;
    }
    for (int i = 0; i < count; i++)
        kill(children[i], SIGKILL);
    for (int i = 0; i < count; i++)
        waitpid(children[i], NULL, 0);
    return count;
}

static bool memory_is_limited(void)
{
    if (ADDRESS_SANITIZER)
        return true; /* cannot be limited in such a build */
    const size_t size = ((size_t)SANDBOX_MEMORY + 1) << 20;
    void *memory = mmap(NULL, size, PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory != MAP_FAILED)
        munmap(memory, size);
    return memory == MAP_FAILED;
}

static bool files_are_limited(void)
{
    static const char byte = 0;
    const int file = open("large", O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0)
        return false;
    const bool limited = pwrite(file, &byte, 1, (off_t)SANDBOX_FILE << 20) < 0;
    const bool works = pwrite(file, &byte, 1, 0) == 1;
    close(file);
    unlink("large");
    return limited && works;
}

static bool reaches(int port)
{
    const struct sockaddr_in address = {.sin_family = AF_INET,
                                        .sin_port = htons((uint16_t)port),
                                        .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    const int file = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const bool reached =
        file >= 0 && connect(file, (const struct sockaddr *)&address, sizeof address) == 0;
    if (file >= 0)
        close(file);
    return reached;
}

static bool can_write(const char *folder)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/check-XXXXXX", folder);
    const int file = mkostemp(path, O_CLOEXEC);
    if (file < 0)
        return false;
    unlink(path);
    close(file);
    return true;
}

/* False, with a message that names the closed folder, if other users may not use the path. */
static bool may_use(const char *path, int mode, Message *message)
{
    char closed[PATH_MAX];
    if (access(path, mode) == 0 || errno != EACCES)
        return true;
    snprintf(closed, sizeof closed, "%s", path);
    for (char *slash = strchr(closed + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        if (access(closed, X_OK) != 0)
            break;
        *slash = '/';
    }
    return message_set(
        message,
        "%s: is closed to other users, but submissions are judged as user %ld instead "
        "of root; open it (chmod o+rx), or install the package bubblewrap",
        closed, (long)getuid());
}

static bool prove(Bundle *bundle, const char *hidden, const char *port, const char *labs,
                  Message *message)
{
    char text[16], program[PATH_MAX];
    if (!paths_program(program, message) || !may_use(program, X_OK, message) ||
        !may_use(labs, R_OK | X_OK, message))
        return false;
    const int processes = count_processes();
    if (processes < 5)
        return message_set(message,
                           "only %d processes can be started; before Linux 5.14 other "
                           "programs of this user count",
                           processes);
    unsigned proven = 0;
    struct stat status;
    if (stat(hidden, &status) != 0 && !can_write("/") && !can_write("/usr") &&
        !can_write("/var/tmp") && !can_write("/dev/shm"))
        proven |= SANDBOX_NO_FILES;
    if (!reaches(atoi(port)))
        proven |= SANDBOX_NO_NETWORK;
    if (processes <= SANDBOX_PROCESSES && memory_is_limited() && files_are_limited())
        proven |= SANDBOX_LIMITS;
    const int length = snprintf(text, sizeof text, "%u", proven);
    return bundle_add(bundle, "proof", text, (size_t)length, message);
}

/* Reads all of standard input. */
static bool read_input(Bundle *bundle, Message *message)
{
    enum { MAX = BUNDLE_BYTES_MAX + (1 << 20) };
    unsigned char *bytes = malloc(MAX);
    size_t size = 0;
    ssize_t count = 1;
    while (bytes && size < MAX && count > 0) {
        count = read(STDIN_FILENO, bytes + size, MAX - size);
        size += count > 0 ? (size_t)count : 0;
    }
    const bool done = bytes && count == 0 && bundle_read(bundle, bytes, size, message);
    free(bytes);
    return done ? true : message_set(message, "the submission cannot be read");
}

static bool write_file(const char *path, const BundleFile *from, Message *message)
{
    const int file = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    const bool done = file >= 0 && output_append(file, from->bytes, from->size);
    if (!done)
        message_set(message, "%s: %s", from->name, strerror(errno));
    if (file >= 0)
        close(file);
    return done;
}

/* Writes the files, whose names are safe, below `folder`. */
static bool write_files(const Bundle *bundle, const char *folder, Message *message)
{
    for (int i = 0; i < bundle->count; i++) {
        char path[PATH_MAX];
        snprintf(path, sizeof path, "%s/%s", folder, bundle->files[i].name);
        for (char *slash = strchr(path + strlen(folder) + 1, '/'); slash;
             slash = strchr(slash + 1, '/')) {
            *slash = '\0';
            if (mkdir(path, 0755) != 0 && errno != EEXIST)
                return message_set(message, "%s: %s", bundle->files[i].name, strerror(errno));
            *slash = '/';
        }
        if (!write_file(path, &bundle->files[i], message))
            return false;
    }
    return true;
}

enum { RESULT_FILE_MAX = 4 << 20 };

static bool take_file(Bundle *bundle, const char *folder, const char *name, Message *message)
{
    char path[PATH_MAX];
    struct stat status;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    const int file = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0)
        return errno == ENOENT ? true : message_set(message, "%s: %s", name, strerror(errno));
    const bool good =
        fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_size <= RESULT_FILE_MAX;
    unsigned char *bytes = good ? malloc((size_t)status.st_size + 1) : NULL;
    const bool done = bytes &&
                      read(file, bytes, (size_t)status.st_size) == (ssize_t)status.st_size &&
                      bundle_add(bundle, name, bytes, (size_t)status.st_size, message);
    free(bytes);
    close(file);
    return done ? true : message_set(message, "%s: not a regular file, or too large", name);
}

/* Takes the verdict and the pictures beside it. */
static bool take_results(Bundle *bundle, const char *folder, Message *message)
{
    enum { PICTURES_MAX = 16 };
    int pictures = 0;
    if (!take_file(bundle, folder, "verdict.json", message))
        return false;
    DIR *stream = opendir(folder);
    if (!stream)
        return message_set(message, "the results: %s", strerror(errno));
    bool done = true;
    for (struct dirent *entry; done && (entry = readdir(stream)) != NULL;) {
        const char *ending = strrchr(entry->d_name, '.');
        if (ending && strcmp(ending, ".png") == 0 && pictures++ < PICTURES_MAX)
            done = take_file(bundle, folder, entry->d_name, message);
    }
    closedir(stream);
    return done;
}

/* Runs this program on the submission; its status as from waitpid, or -1. */
static int run_check(const char *lab, const char *seed, const char *seconds, Message *message)
{
    char program[PATH_MAX];
    if (!paths_program(program, message))
        return -1;
    const char *const arguments[] = {program, "--inside", "check", lab, seed, seconds, NULL};
    pid_t child;
    const int error = process_start(&child, arguments, (int[]){-1, -1, STDERR_FILENO, -1});
    if (error) {
        message_set(message, "a process: %s", strerror(error));
        return -1;
    }
    return process_wait(child);
}

/* Exit code of the step. */
static int judge_bundle(Bundle *bundle, const char *lab, const char *seed, const char *seconds,
                        Message *message)
{
    if (!read_input(bundle, message) || mkdir("submission", 0755) != 0 || mkdir("out", 0755) != 0 ||
        !write_files(bundle, "submission", message)) {
        message_set(message, "the submission's folder: %s", strerror(errno));
        return INSIDE_BROKEN;
    }
    bundle_close(bundle);
    const int status = run_check(lab, seed, seconds, message);
    if (status == -1)
        return INSIDE_BROKEN;
    if (WIFSIGNALED(status)) {
        message_set(message, "the check was ended by signal %d (%s)", WTERMSIG(status),
                    strsignal(WTERMSIG(status)));
        return WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL ? INSIDE_TIMEOUT
                                                                          : INSIDE_BROKEN;
    }
    if (!take_results(bundle, "out", message))
        return INSIDE_BROKEN;
    return bundle_find(bundle, "verdict.json") ? 0 : INSIDE_BROKEN; /* it has printed why */
}

/* The check itself, below the limits of the process that started it: LAB SEED SECONDS. */
static int check(char *arguments[])
{
    static Verdict verdict; /* large */
    Message message = {.text = ""};
    const Lab *lab = lab_find(arguments[0], &message);
    const JudgeOptions judged = {.lab = lab,
                                 .folder = "submission",
                                 .seed = strtoull(arguments[1], NULL, 10),
                                 .pictures = "out"};
    if (lab && supervise(&judged, strtod(arguments[2], NULL), &verdict, &message) &&
        verdict_write(&verdict, lab, judged.folder, "out/verdict.json", &message))
        return 0;
    fprintf(stderr, "%s\n", message.text);
    return 1;
}

int inside_main(int count, char *arguments[])
{
    if (count == 4 && strcmp(arguments[0], "check") == 0)
        return check(arguments + 1);
    Message message = {.text = ""};
    Bundle *bundle = calloc(1, sizeof *bundle);
    if (count < 4 || !bundle) {
        free(bundle);
        fputs("--inside: only for internal use\n", stderr);
        return 2;
    }
    const char *step = arguments[3];
    int code = INSIDE_BROKEN;
    signal(SIGXFSZ, SIG_IGN);
    /* The check limits its own processes further. */
    if (!become_user(strtol(arguments[0], NULL, 10), &message) ||
        !take_limits((rlim_t)strtoul(arguments[1], NULL, 10) + DIAGNOSIS_SECONDS, &message) ||
        !set_environment(arguments[2], &message)) {
        ;
    } else if (chdir(arguments[2]) != 0) {
        message_set(&message, "%s: %s", arguments[2], strerror(errno));
    } else if (strcmp(step, "prove") == 0 && count == 7) {
        code =
            prove(bundle, arguments[4], arguments[5], arguments[6], &message) ? 0 : INSIDE_BROKEN;
    } else if (strcmp(step, "unpack") == 0 && count == 4) {
        code = unpack_sources(bundle, STDIN_FILENO, &message) ? 0 : INSIDE_REFUSED;
    } else if (strcmp(step, "judge") == 0 && count == 6) {
        code = judge_bundle(bundle, arguments[4], arguments[5], arguments[1], &message);
    }
    if (code == 0 && !bundle_write(bundle, STDOUT_FILENO, &message))
        code = INSIDE_BROKEN;
    if (code != 0 && message.text[0])
        fprintf(stderr, "%s\n", message.text);
    bundle_close(bundle);
    free(bundle);
    return code;
}
