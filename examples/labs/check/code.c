/* A submission's C is compiled to a shared object and called in a child that has no rights left but
 * to compute and to write numbers into one pipe; what it returns is checked as any input is. */
#include "labs/check/code.h"

#include "base/clock.h"
#include "base/output.h"
#include "base/paths.h"
#include "base/process.h"

#include <dlfcn.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* Seconds of processor time, bytes of memory and of written files. CALL_WAIT is of the clock on the
 * wall: code that stops itself uses no processor; a busy machine takes less long. */
enum { CALL_SECONDS = 2, CALL_WAIT = 20, BUILD_SECONDS = 10, MAX_WRITTEN = 32 << 20 };
static const rlim_t CALL_MEMORY = (rlim_t)256 << 20, BUILD_MEMORY = (rlim_t)1 << 30;

/* Building. */

/* The folders of lab_code.h and of core/matrix.h: one if they are installed. */
static bool find_headers(char labs[PATH_MAX], char common[PATH_MAX], Message *message)
{
    return (paths_find_data("examples/labs/program", "labs/include", labs) &&
            paths_find_data("common", "labs/include", common)) ||
           message_set(message, "%s: no such folder; install the labs again", common);
}

static void limit(rlim_t seconds, rlim_t memory)
{
    process_limit(seconds, memory);
    setrlimit(RLIMIT_FSIZE, &(struct rlimit){MAX_WRITTEN, MAX_WRITTEN});
}

/* In the child: the compiler, its messages going to a pipe. */
static _Noreturn void compile(const Lab *lab, const char *folder, const char *labs,
                              const char *common, int errors)
{
    char include[3][PATH_MAX + 8], matrix[2][PATH_MAX + 32];
    snprintf(include[0], sizeof include[0], "-I%s", labs);
    snprintf(include[1], sizeof include[1], "-I%s", common);
    snprintf(include[2], sizeof include[2], "-I%s/core", common);
    for (int i = 0; i < 2; i++)
        snprintf(matrix[i], sizeof matrix[i], "%s/core/matrix%s.c", common, i ? "_vectors" : "");
    limit(BUILD_SECONDS, BUILD_MEMORY);
    process_null(STDIN_FILENO, STDOUT_FILENO);
    dup2(errors, STDERR_FILENO);
    setenv("LC_ALL", "C", 1);
    setenv("TMPDIR", folder, 1);
    /* The folder itself is no -I: a student's file could replace a header. */
    if (chdir(folder) == 0)
        execlp("cc", "cc", "-std=gnu11", "-O0", "-fPIC", "-shared", "-Wall",
               "-Werror=implicit-function-declaration", include[0], include[1], include[2], "-o",
               "module.so", lab->code, matrix[0], matrix[1], "-lm", (char *)NULL);
    _exit(127);
}

/* And skips the rest, so that the child does not wait for its reader. */
static size_t read_all(int from, char *bytes, size_t size, double deadline)
{
    char rest[4096];
    const size_t got = process_read(from, bytes, size, deadline);
    while (process_read(from, rest, sizeof rest, deadline) > 0)
        continue;
    return got;
}

static bool blame(Verdict *verdict, VerdictKind kind, const char *format, const char *text)
{
    verdict->kind = kind;
    snprintf(verdict->message, sizeof verdict->message, format, text);
    return false;
}

/* What the compiler's errors usually mean. */
static const char *advise(const char *error)
{
    static const char *const known[][2] = {
        {"Assembler", "Write it in C: the assembler does not know this instruction."},
        {"expected ';'", "A semicolon is missing where the line before ends."},
        {"expected declaration or statement at end", "A } is missing."},
        {"implicit declaration", "There is no such function: core/matrix.h, which lab_code.h "
                                 "includes, and math.h have those that the lab needs."},
        {"undeclared", "Declare it, or check its spelling."},
        {"conflicting types", "Write the function's head as lab_code.h has it."},
        {"incompatible type", "A Mat4 is a struct, returned by value: see core/matrix.h."},
        {"invalid operands", "C has no operators for matrices and vectors: call mat4_product and "
                             "the others of core/matrix.h."},
        {"No such file", "Only lab_code.h and C's own headers can be included."}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strstr(error, known[i][0]))
            return known[i][1];
    return "";
}

/* The compiler's first error as the message; its source line, a hint and what else was said as
 * details. The assembler's place is a line of the compiler's output, of which nobody knows. */
static bool blame_text(Verdict *verdict, const char *file, const char *said)
{
    const char *error = strcasestr(said, "error:"), *begin = error ? error : said;
    while (begin > said && begin[-1] != '\n')
        begin--;
    const char *rest = begin + strcspn(begin, "\n");
    const bool assembler = strstr(said, "Assembler messages") != NULL;
    char line[VERDICT_SENTENCE_SIZE];
    snprintf(line, sizeof line, "%.*s", (int)(rest - begin), begin);
    verdict->kind = VERDICT_ERROR;
    if (assembler && error)
        snprintf(verdict->message, sizeof verdict->message, "%s: %.*s", file, (int)(rest - error),
                 error);
    else
        snprintf(verdict->message, sizeof verdict->message, "%s",
                 line[0] ? line : "the compiler failed");
    rest += *rest == '\n';
    int shown = 0; /* the quoted line, and what marks its place */
    while (rest[shown] == ' ' && rest[shown + (int)strspn(rest + shown, " 0123456789")] == '|')
        shown += (int)strcspn(rest + shown, "\n") + (strchr(rest + shown, '\n') != NULL);
    snprintf(verdict->details, sizeof verdict->details, "%.*s%s\n%.*s%s", shown, rest,
             advise(assembler ? "Assembler" : line), assembler ? 0 : (int)(begin - said), said,
             assembler ? "" : rest + shown);
    return false;
}

static bool build(const Code *code, Message *message)
{
    const Lab *lab = code->lab;
    const char *folder = code->folder;
    Verdict *verdict = code->verdict;
    char path[PATH_MAX], labs[PATH_MAX], common[PATH_MAX], said[VERDICT_DETAILS_SIZE];
    int end;
    if (!output_path(path, folder, lab->code, message) || !find_headers(labs, common, message) ||
        !output_write(path, code->text, strlen(code->text), message))
        return false;
    const pid_t child = process_fork(&end, message);
    if (child < 0)
        return false;
    if (child == 0)
        compile(lab, folder, labs, common, end);
    const size_t size = read_all(end, said, sizeof said - 1, HUGE_VAL);
    close(end);
    said[size] = '\0';
    const int status = process_wait(child);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
        return message_set(message, "cc: no C compiler was found; apt-get install gcc");
    if (!WIFEXITED(status) || size == 0)
        return blame(verdict, VERDICT_ERROR, "%s: the compiler failed", lab->code);
    return blame_text(verdict, lab->code, said);
}

/* Calling. */

/* The arguments and results of a call. */
typedef struct Call {
    const double *seconds;
    int count;
    CodeMatrices *matrices; /* NULL: the budget */
    LabBudget budget;
} Call;

/* In the child. */
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
    process_null(STDIN_FILENO, STDERR_FILENO);
    dup2(results, 3);
    close_range(4, ~0u, 0);
    limit(CALL_SECONDS, CALL_MEMORY);
    /* Loading opens the module; its functions can open nothing. */
    if (!confine_process(true, &message) || write(3, "", 1) != 1)
        _exit(3);
    void *library = dlopen(module, RTLD_NOW | RTLD_LOCAL);
    function.object =
        library ? dlsym(library, wanted->matrices ? "lab_matrices" : "lab_budget") : NULL;
    if (!function.object)
        _exit(4);
    if (!confine_process(false, &message))
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

static bool run_code(const Code *code, Call *wanted, Message *message)
{
    const Lab *lab = code->lab;
    const char *folder = code->folder;
    Verdict *verdict = code->verdict;
    char module[PATH_MAX];
    int end;
    const size_t each = wanted->matrices ? sizeof *wanted->matrices : sizeof wanted->budget;
    const size_t size = each * (size_t)wanted->count;
    const pid_t child =
        output_path(module, folder, "module.so", message) ? process_fork(&end, message) : -1;
    if (child < 0)
        return false;
    if (child == 0)
        call(module, wanted, end);
    const double deadline = clock_now() + CALL_WAIT;
    char begun; /* a byte from before the submission's code, which can choose its exit status */
    const bool confined = process_read(end, &begun, 1, deadline) == 1;
    const size_t got = read_all(
        end, wanted->matrices ? (char *)wanted->matrices : (char *)&wanted->budget, size, deadline);
    const bool late = clock_now() >= deadline;
    if (late)
        kill(child, SIGKILL);
    close(end);
    const int status = process_wait(child);
    if (late)
        return blame(verdict, VERDICT_TIMEOUT,
                     "%s: it stopped, or waited, and did not go on: look for raise and the like",
                     lab->code);
    if (!confined)
        return message_set(message, "this kernel cannot confine a process, so a submission's C is "
                                    "not run");
    if (WIFEXITED(status) && WEXITSTATUS(status) == 4)
        return blame(verdict, VERDICT_ERROR, "%s: cannot be loaded, or lacks the lab's function",
                     lab->code);
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
        return blame(verdict, VERDICT_TIMEOUT, "%s: it does not end: look for an endless loop",
                     lab->code);
    if (WIFSIGNALED(status))
        return blame(
            verdict, VERDICT_ERROR,
            "%s: it crashes: look for a bad pointer, an integer division by zero, or large "
            "local arrays",
            lab->code);
    if (got != size || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        return blame(verdict, VERDICT_ERROR, "%s: it exits the program", lab->code);
    return true;
}

static bool is_finite(const Mat4 *matrix)
{
    for (int i = 0; i < 16; i++)
        if (!isfinite(matrix->m[i]) || fabs(matrix->m[i]) > 1e30)
            return false;
    return true;
}

bool code_matrices(const Code *code, const double *seconds, int count, CodeMatrices *matrices,
                   Message *message)
{
    Call wanted = {.seconds = seconds, .count = count, .matrices = matrices};
    if (!build(code, message) || !run_code(code, &wanted, message))
        return false;
    for (int i = 0; i < count; i++)
        if (!is_finite(&matrices[i].world_from_model) || !is_finite(&matrices[i].normal_matrix))
            return blame(code->verdict, VERDICT_ERROR,
                         "%s: a matrix has numbers that are not finite or beyond 1e30: look for a "
                         "division by zero or an unset value",
                         code->lab->code);
    return true;
}

bool code_budget(const Code *code, LabBudget *budget, Message *message)
{
    Call wanted = {.count = 1};
    if (!build(code, message) || !run_code(code, &wanted, message))
        return false;
    *budget = wanted.budget;
    /* A bool from another process may be any byte. */
    unsigned char cull;
    memcpy(&cull, &wanted.budget.cull, 1);
    budget->cull = cull != 0;
    if (budget->slices >= 3 && budget->slices <= 512 && budget->stacks >= 2 &&
        budget->stacks <= 512)
        return true;
    return blame(code->verdict, VERDICT_ERROR, "%s: slices must be 3 to 512, stacks 2 to 512",
                 code->lab->code);
}
