#include "code.h"

#include "child.h"
#include "confine.h"
#include "output.h"
#include "sanitized.h"

#include <ctype.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* Seconds of computing, bytes of memory and of what the compiler writes. */
enum { CALL_SECONDS = 2, BUILD_SECONDS = 10, MOST_WRITTEN = 32 << 20 };
static const rlim_t CALL_MEMORY = (rlim_t)256 << 20, BUILD_MEMORY = (rlim_t)1 << 30;

/* The text. */

/* Joins continued lines and blanks comments and the insides of strings that are no file names, so
 * that directives and words can be told; lines stay where they were. */
static char *without_comments(const char *text)
{
    char *clean = malloc(strlen(text) + 1), *to = clean;
    char quote = 0;
    if (!clean)
        return NULL;
    for (const char *p = text; *p; p++) {
        if (p[0] == '\\' && (p[1] == '\n' || (p[1] == '\r' && p[2] == '\n'))) {
            p += p[1] == '\r' ? 2 : 1;
        } else if (quote) {
            if (p[0] == '\\' && p[1])
                *to++ = *p++;
            else if (*p == quote || *p == '\n')
                quote = 0;
            *to++ = *p;
        } else if (p[0] == '/' && p[1] == '*') {
            const char *end = strstr(p + 2, "*/");
            for (; *p && p != (end ? end + 1 : NULL); p++)
                if (*p == '\n')
                    *to++ = '\n';
            *to++ = ' ';
            if (!*p)
                break;
        } else if (p[0] == '/' && p[1] == '/') {
            while (p[1] && p[1] != '\n')
                p++;
        } else {
            quote = *p == '"' || *p == '\'' ? *p : 0;
            *to++ = *p;
        }
    }
    *to = '\0';
    return clean;
}

static bool refuse(const char *name, int line, const char *what, Message *message)
{
    return message_set(message, "%s:%d: %s", name, line, what);
}

/* A line that begins with #, without that. */
static bool check_directive(const char *name, int number, const char *line, Message *message)
{
    static const char *const WORDS[] = {"define", "undef", "if",    "ifdef", "ifndef",
                                        "else",   "elif",  "endif", "error"};
    static const char *const HEADERS[] = {"<math.h>",      "<stdbool.h>", "<stddef.h>",
                                          "<string.h>",    "<float.h>",   "\"matrix.h\"",
                                          "\"lab_code.h\""};
    while (*line == ' ' || *line == '\t')
        line++;
    const size_t length = strspn(line, "abcdefghijklmnopqrstuvwxyz_");
    if (length == 7 && strncmp(line, "include", 7) == 0) {
        line += 7;
        while (*line == ' ' || *line == '\t')
            line++;
        for (size_t i = 0; i < sizeof HEADERS / sizeof HEADERS[0]; i++) {
            const size_t size = strlen(HEADERS[i]);
            if (strncmp(line, HEADERS[i], size) == 0 &&
                (line[size] == '\0' || strchr(" \t\r\n", line[size])))
                return true;
        }
        return refuse(
            name, number,
            "only matrix.h, lab_code.h, <math.h>, <stdbool.h>, <stddef.h>, <string.h> and "
            "<float.h> may be included",
            message);
    }
    for (size_t i = 0; i < sizeof WORDS / sizeof WORDS[0]; i++)
        if (length == strlen(WORDS[i]) && strncmp(line, WORDS[i], length) == 0)
            return true;
    return length == 0 && (*line == '\n' || *line == '\0' || *line == '\r')
               ? true
               : refuse(name, number, "a submission may not use this directive", message);
}

/* Whether it may be compiled; the message, "matrices.c:3: ...", says why not. */
static bool check_text(const char *name, const char *text, Message *message)
{
    static const char *const FORBIDDEN[] = {"asm",     "__asm",         "__asm__",
                                            "_Pragma", "__has_include", "__has_embed"};
    char *clean = without_comments(text);
    bool done = clean != NULL, begins = true;
    int line = 1;
    if (!clean)
        return message_set(message, "%s: not enough memory", name);
    for (const char *p = clean; *p && done;) {
        const bool digraph = p[0] == '%' && p[1] == ':';
        if (begins && (*p == '#' || digraph)) {
            done = check_directive(name, line, p + (digraph ? 2 : 1), message);
            p += digraph ? 2 : 1;
            begins = false;
        } else if ((p[0] == '#' && p[1] == '#') || (digraph && p[2] == '%')) {
            done = refuse(name, line, "## may not be used", message);
        } else if (isalpha((unsigned char)*p) || *p == '_') {
            size_t length = 0;
            while (isalnum((unsigned char)p[length]) || p[length] == '_')
                length++;
            for (size_t i = 0; i < sizeof FORBIDDEN / sizeof FORBIDDEN[0] && done; i++)
                if (length == strlen(FORBIDDEN[i]) && strncmp(p, FORBIDDEN[i], length) == 0)
                    done = refuse(name, line, "assembler and pragmas may not be used", message);
            p += length;
            begins = false;
        } else {
            if (*p == '\n')
                line++;
            begins = *p == '\n' || (begins && isspace((unsigned char)*p));
            p++;
        }
    }
    free(clean);
    return done;
}

/* Building. */

/* The folders of lab_code.h and of matrix.h, from a lab's: one where they are installed, two in the
 * source tree. */
static bool find_headers(const Lab *lab, char labs[PATH_MAX], char common[PATH_MAX],
                         Message *message)
{
    static const char *const PLACES[][2] = {{"../include", "../include"},
                                            {"..", "../../../common"}};
    char folder[PATH_MAX], path[PATH_MAX + 16];
    if (!lab_folder(lab, folder, message))
        return false;
    for (size_t i = 0; i < sizeof PLACES / sizeof PLACES[0]; i++) {
        if (snprintf(labs, PATH_MAX, "%s/%s", folder, PLACES[i][0]) >= PATH_MAX ||
            snprintf(common, PATH_MAX, "%s/%s", folder, PLACES[i][1]) >= PATH_MAX)
            continue;
        snprintf(path, sizeof path, "%s/matrix.c", common);
        if (access(path, R_OK) == 0)
            return true;
    }
    return message_set(message, "matrix.c: neither beside %s nor in %s", folder, common);
}

static void limit(rlim_t seconds, rlim_t memory, rlim_t written)
{
    setrlimit(RLIMIT_CPU, &(struct rlimit){seconds, seconds + 1});
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
    setrlimit(RLIMIT_FSIZE, &(struct rlimit){written, written});
    if (!ADDRESS_SANITIZER)
        setrlimit(RLIMIT_AS, &(struct rlimit){memory, memory});
}

/* In the child: the compiler, its messages going to a pipe. */
static _Noreturn void compile(const Lab *lab, const char *folder, const char *labs,
                              const char *common, int errors)
{
    char include[2][PATH_MAX + 8], matrix[PATH_MAX + 16];
    snprintf(include[0], sizeof include[0], "-I%s", labs);
    snprintf(include[1], sizeof include[1], "-I%s", common);
    snprintf(matrix, sizeof matrix, "%s/matrix.c", common);
    limit(BUILD_SECONDS, BUILD_MEMORY, MOST_WRITTEN);
    const int nothing = open("/dev/null", O_RDWR);
    dup2(nothing, STDIN_FILENO);
    dup2(nothing, STDOUT_FILENO);
    dup2(errors, STDERR_FILENO);
    setenv("LC_ALL", "C", 1);
    setenv("TMPDIR", folder, 1);
    /* Not for -I: a lab's folder has files of everybody's name. */
    if (chdir(folder) == 0)
        execlp("cc", "cc", "-std=gnu11", "-fno-asm", "-O0", "-fPIC", "-shared", "-Wall",
               "-Werror=implicit-function-declaration", "-fno-diagnostics-show-caret", include[0],
               include[1], "-o", "module.so", lab->code, matrix, "-lm", (char *)NULL);
    _exit(127);
}

static size_t read_all(int from, char *bytes, size_t size)
{
    size_t got = 0;
    ssize_t part;
    char rest[4096];
    while (got < size && ((part = read(from, bytes + got, size - got)) > 0 || errno == EINTR)) {
        if (part <= 0)
            continue;
        got += (size_t)part;
    }
    while (read(from, rest, sizeof rest) > 0) {
    }
    return got;
}

static bool blame(Verdict *verdict, VerdictKind kind, const char *format, const char *text)
{
    verdict->kind = kind;
    snprintf(verdict->message, sizeof verdict->message, format, text);
    return false;
}

/* The compiler's first error, as the message, and all it said. */
static bool blame_text(Verdict *verdict, VerdictKind kind, const char *said)
{
    const char *error = strstr(said, "error:"), *begin = error ? error : said;
    while (begin > said && begin[-1] != '\n')
        begin--;
    verdict->kind = kind;
    snprintf(verdict->message, sizeof verdict->message, "%.*s", (int)strcspn(begin, "\n"), begin);
    snprintf(verdict->details, sizeof verdict->details, "%s", said);
    return false;
}

static bool build(const Lab *lab, const char *text, const char *folder, Verdict *verdict,
                  Message *message)
{
    char path[PATH_MAX], labs[PATH_MAX], common[PATH_MAX], said[VERDICT_DETAILS_SIZE];
    Message own = {0};
    int end;
    if (!check_text(lab->code, text, &own))
        return blame_text(verdict, VERDICT_REFUSED, own.text);
    if (snprintf(path, sizeof path, "%s/%s", folder, lab->code) >= (int)sizeof path)
        return message_set(message, "%s: the path is too long", folder);
    if (!find_headers(lab, labs, common, message) ||
        !output_write(path, text, strlen(text), message))
        return false;
    const pid_t child = child_start(&end, message);
    if (child < 0)
        return false;
    if (child == 0)
        compile(lab, folder, labs, common, end);
    const size_t size = read_all(end, said, sizeof said - 1);
    close(end);
    said[size] = '\0';
    const int status = child_wait(child);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
        return message_set(message, "cc: no C compiler was found; apt-get install gcc");
    if (!WIFEXITED(status) || size == 0)
        return blame(verdict, VERDICT_ERROR, "%s: the compiler gave up on it", lab->code);
    return blame_text(verdict, VERDICT_ERROR, said);
}

/* Calling. */

/* What is called for, and what comes back. */
typedef struct Call {
    const double *seconds;
    int count;
    CodeMatrices *matrices; /* NULL: the budget */
    LabBudget budget;
} Call;

/* In the child. What was not written when it is loaded is never. */
static _Noreturn void call(const char *module, const Call *wanted, int results)
{
    Message message = {0};
    typedef void (*MatricesFunction)(double, Mat4 *, Mat4 *);
    typedef void (*BudgetFunction)(LabBudget *);
    union {
        void *object;
        MatricesFunction matrices;
        BudgetFunction budget;
    } function;
    const int nothing = open("/dev/null", O_RDWR);
    for (int i = 0; i <= 2; i++)
        dup2(nothing, i);
    dup2(results, 3);
    close_range(4, ~0u, 0);
    limit(CALL_SECONDS, CALL_MEMORY, MOST_WRITTEN);
    if (!confine_process(&message))
        _exit(3);
    void *library = dlopen(module, RTLD_NOW | RTLD_LOCAL);
    function.object =
        library ? dlsym(library, wanted->matrices ? "lab_matrices" : "lab_budget") : NULL;
    if (!function.object)
        _exit(4);
    for (int i = 0; i < wanted->count; i++) {
        CodeMatrices matrices = {mat4_identity(), mat4_identity()};
        LabBudget budget = {.slices = 16, .stacks = 16};
        if (wanted->matrices)
            function.matrices(wanted->seconds[i], &matrices.world_from_model,
                              &matrices.normal_matrix);
        else
            function.budget(&budget);
        const void *bytes = wanted->matrices ? (void *)&matrices : (void *)&budget;
        const size_t size = wanted->matrices ? sizeof matrices : sizeof budget;
        if (write(3, bytes, size) != (ssize_t)size)
            _exit(5);
    }
    _exit(0);
}

static bool run(const Lab *lab, const char *folder, Call *wanted, Verdict *verdict,
                Message *message)
{
    char module[PATH_MAX];
    int end;
    const size_t each = wanted->matrices ? sizeof *wanted->matrices : sizeof wanted->budget;
    const size_t size = each * (size_t)wanted->count;
    if (snprintf(module, sizeof module, "%s/module.so", folder) >= (int)sizeof module)
        return message_set(message, "%s: the path is too long", folder);
    const pid_t child = child_start(&end, message);
    if (child < 0)
        return false;
    if (child == 0)
        call(module, wanted, end);
    const size_t got =
        read_all(end, wanted->matrices ? (char *)wanted->matrices : (char *)&wanted->budget, size);
    close(end);
    const int status = child_wait(child);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 3)
        return message_set(message,
                           "this kernel cannot confine a process: the C of a submission is "
                           "not run");
    if (WIFEXITED(status) && WEXITSTATUS(status) == 4)
        return blame(verdict, VERDICT_ERROR,
                     "%s: it cannot be loaded, or has not the function that "
                     "the lab asks for",
                     lab->code);
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
        return blame(verdict, VERDICT_TIMEOUT, "%s: it does not end: look for a loop without end",
                     lab->code);
    if (WIFSIGNALED(status))
        return blame(verdict, VERDICT_ERROR,
                     "%s: it crashes: look for a bad pointer, a division of "
                     "whole numbers by zero, or too much on the stack",
                     lab->code);
    if (got != size || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        return blame(verdict, VERDICT_ERROR, "%s: it ends the program itself", lab->code);
    return true;
}

static bool is_finite(const Mat4 *matrix)
{
    for (int i = 0; i < 16; i++)
        if (!isfinite(matrix->m[i]) || fabs(matrix->m[i]) > 1e30)
            return false;
    return true;
}

bool code_matrices(const Lab *lab, const char *text, const char *folder, const double *seconds,
                   int count, CodeMatrices *matrices, Verdict *verdict, Message *message)
{
    Call wanted = {.seconds = seconds, .count = count, .matrices = matrices};
    if (!build(lab, text, folder, verdict, message) || !run(lab, folder, &wanted, verdict, message))
        return false;
    for (int i = 0; i < count; i++)
        if (!is_finite(&matrices[i].world_from_model) || !is_finite(&matrices[i].normal_matrix))
            return blame(verdict, VERDICT_ERROR,
                         "%s: a matrix has numbers that are not finite, or beyond 1e30: look for "
                         "what is divided by zero, or not set",
                         lab->code);
    return true;
}

bool code_budget(const Lab *lab, const char *text, const char *folder, LabBudget *budget,
                 Verdict *verdict, Message *message)
{
    Call wanted = {.count = 1};
    if (!build(lab, text, folder, verdict, message) || !run(lab, folder, &wanted, verdict, message))
        return false;
    *budget = wanted.budget;
    /* A bool of another process may be any byte. */
    unsigned char cull;
    memcpy(&cull, &wanted.budget.cull, 1);
    budget->cull = cull != 0;
    if (budget->slices >= 3 && budget->slices <= 512 && budget->stacks >= 2 &&
        budget->stacks <= 512)
        return true;
    return blame(verdict, VERDICT_ERROR, "%s: slices must be 3 to 512, stacks 2 to 512", lab->code);
}
