/* The process around a program: how it begins and ends, what it says on standard error. */
#include "app/options.h"

#include "app/doctor.h"
#include "base/memory.h"
#include "base/process.h"
#include "base/text.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

/* The rest of a line, and other lines: on a terminal broken between words, but for a quoted source
 * line, "  3 | ...". `column` is where the first begins. */
static void print_lines(const char *text, int column)
{
    struct winsize window;
    const bool wraps =
        ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 20 + column;
    for (const char *line = text; line; column = 0) {
        char words[sizeof((Message *)0)->text];
        const int length = (int)strcspn(line, "\n"), blanks = (int)strspn(line, " ");
        snprintf(words, sizeof words, "%.*s", length, line);
        if (!wraps || length + column <= window.ws_col || text_is_quote(words)) {
            fputs(words, stderr);
        } else {
            fprintf(stderr, "%.*s", blanks, line);
            text_wrap(stderr, words + blanks, column + blanks, blanks + 4, window.ws_col);
        }
        fputc('\n', stderr);
        line = line[length] ? line + length + 1 : NULL;
    }
}

/* The beginning, a program's name or a file and line, in colour on a terminal. */
static void print_message(const char *program, const Message *message, int color)
{
    const char *begin = message_color(color, STDERR_FILENO);
    const char *end = message_color(MESSAGE_PLAIN, STDERR_FILENO);
    const char *text = message->text[0] ? message->text : "failed";
    const char *rest = message->located ? strstr(text, ": ") : NULL;
    const int length = rest ? (int)(rest - text) : (int)strlen(program);
    fprintf(stderr, "%s%.*s:%s ", begin, length, rest ? text : program, end);
    print_lines(rest ? rest + 2 : text, length + 2);
}

int options_fail(const char *program, const Message *message, int code)
{
    fflush(stdout);
    print_message(program, message, MESSAGE_RED);
    return code;
}

void options_warn(const char *program, const Message *message)
{
    print_message(program, message, MESSAGE_YELLOW);
}

void options_tell(const char *program, const char *format, ...)
{
    va_list arguments;
    if (!isatty(STDERR_FILENO))
        return;
    va_start(arguments, format);
    fprintf(stderr, "%s: ", program);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
}

int options_finish(const char *program, int code)
{
    Message message = {0};
    errno = 0;
    if (fflush(stdout) != 0 || ferror(stdout)) {
        /* An earlier write may have failed, whose errno is lost. */
        message_set(&message, "standard output: cannot write%s%s", errno ? ": " : "",
                    errno ? strerror(errno) : "");
        return options_fail(program, &message, EXIT_FAILED);
    }
    return code;
}

/* What is read when a library is loaded. Mesa's llvmpipe and OSMesa choose instructions by the
 * processor: F16C is what computes mediump in 16 bits. glibc's libm has its own variants of sin,
 * pow and others for processors with FMA, whose results differ in the last bit. */
const char *const OPTIONS_LEAST[] = {"GALLIUM_OVERRIDE_CPU_CAPS=sse4.1",
                                     "LP_NATIVE_VECTOR_WIDTH=128",
                                     "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4", NULL};

bool options_restart(char *const *arguments, Message *message)
{
    return process_restart(arguments, OPTIONS_LEAST, message);
}

bool options_begin(Options *options, const Usage *usage, int argc, char *argv[], int *code)
{
    Message message = {0};
    /* options_read moves the names to the front. */
    char **given = memory_copy(argv, ((size_t)argc + 1) * sizeof *argv);
    options_prepare_process();
    const OptionsResult result = options_read(options, usage, argc, argv, &message);
    bool run = false;
    if (result != OPTIONS_RUN)
        *code = result == OPTIONS_ANSWERED ? options_finish(usage->name, 0)
                                           : options_fail(usage->name, &message, EXIT_USAGE);
    else if (options->deterministic && !options_restart(given, &message))
        *code = options_fail(usage->name, &message, EXIT_FAILED);
    else if (options->doctor)
        *code = options_finish(usage->name, doctor_run());
    else
        run = true;
    free(given);
    return run;
}
