#include "report_gnuplot.h"

#include "output.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

const char *const GNUPLOT_PALETTE[GNUPLOT_COLORS] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                     "#E69F00", "#56B4E9", "#000000"};

static bool fail(const char *path, const char *reason, Message *message)
{
    return message_set(message, "%s: gnuplot: %s", path, reason);
}

/* The bytes of an open file, with a zero behind them; NULL: no memory. */
static char *contents(int file, size_t *size)
{
    struct stat status;
    char *bytes = fstat(file, &status) == 0 ? malloc((size_t)status.st_size + 1) : NULL;
    for (*size = 0; bytes && *size < (size_t)status.st_size;) {
        const ssize_t got =
            pread(file, bytes + *size, (size_t)status.st_size - *size, (off_t)*size);
        if (got <= 0)
            break;
        *size += (size_t)got;
    }
    if (bytes)
        bytes[*size] = '\0';
    return bytes;
}

/* Starts gnuplot with these three for its standard streams, and waits for it. */
static bool run(const int files[3], const char *path, int *status, Message *message)
{
    /* Without the user's own settings. */
    char name[] = "gnuplot", plain[] = "-d";
    char *const arguments[] = {name, plain, NULL};
    posix_spawn_file_actions_t actions;
    pid_t child;
    int error = posix_spawn_file_actions_init(&actions);
    if (error)
        return fail(path, strerror(error), message);
    for (int i = 0; i < 3 && !error; i++)
        error = posix_spawn_file_actions_adddup2(&actions, files[i], i);
    if (!error)
        error = posix_spawnp(&child, name, &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error == ENOENT || error == EACCES)
        return message_set(message, "%s: plots need gnuplot: %s; install the package gnuplot-nox",
                           path, strerror(error));
    if (error)
        return fail(path, strerror(error), message);
    while (waitpid(child, status, 0) < 0)
        if (errno != EINTR)
            return fail(path, strerror(errno), message);
    return true;
}

/* gnuplot points at the place in the script, over several lines; the last one says what is wrong.
 */
static void complain(const char *path, int status, char *said, Message *message)
{
    size_t length = said ? strlen(said) : 0;
    while (length > 0 && strchr(" \t\r\n", said[length - 1]))
        said[--length] = '\0';
    const char *line = length ? strrchr(said, '\n') : NULL;
    line = line ? line + 1 : length ? said : "it drew nothing";
    if (WIFSIGNALED(status))
        message_set(message, "%s: gnuplot: %s", path, strsignal(WTERMSIG(status)));
    else
        message_set(message, "%s: gnuplot: status %d: %.500s", path, WEXITSTATUS(status), line);
}

/* The script and what comes back are files in memory, so that neither side waits for the other. */
static bool draw(const char *terminal, const char *script, size_t size, const char *path,
                 Message *message)
{
    int files[3], status = 0;
    char *picture = NULL, *said = NULL;
    size_t picture_size = 0, said_size = 0;
    bool done = true;
    for (int i = 0; i < 3; i++) {
        files[i] = memfd_create("gnuplot", MFD_CLOEXEC);
        done = done && files[i] >= 0;
    }
    done = done && dprintf(files[0], "set terminal %s\n", terminal) > 0 &&
           write(files[0], script, size) == (ssize_t)size && lseek(files[0], 0, SEEK_SET) == 0;
    if (!done)
        fail(path, strerror(errno), message);
    done = done && run(files, path, &status, message);
    if (done) {
        picture = contents(files[1], &picture_size);
        said = contents(files[2], &said_size);
        done = status == 0 && picture && picture_size > 0;
        if (!done)
            complain(path, status, said, message);
    }
    for (int i = 0; i < 3; i++)
        if (files[i] >= 0)
            close(files[i]);
    done = done && output_write(path, picture, picture_size, message);
    free(picture);
    free(said);
    return done;
}

bool gnuplot_draw(const char *script, size_t size, const char *folder, const char *name,
                  Message *message)
{
    static const char *const extensions[] = {"svg", "png"};
    /* Both with letters and points of one size: the one counts pixels, the other points. */
    static const char *const terminals[] = {"svg dynamic",
                                            "pngcairo fontscale 0.75 pointscale 1.4"};
    if (strchr(name, '/') || name[0] == '.')
        return message_set(message, "%s: cannot be a file's name", name);
    for (int i = 0; i < 2; i++) {
        char path[PATH_MAX], terminal[160];
        snprintf(terminal, sizeof terminal,
                 "%s size %d,%d noenhanced font 'DejaVu Sans,14' background '#ffffff'",
                 terminals[i], GNUPLOT_WIDTH, GNUPLOT_HEIGHT);
        if (snprintf(path, sizeof path, "%s/%s.%s", folder, name, extensions[i]) >=
            (int)sizeof path)
            return message_set(message, "%s/%s: %s", folder, name, strerror(ENAMETOOLONG));
        if (!draw(terminal, script, size, path, message))
            return false;
    }
    return true;
}

bool gnuplot_finish(FILE *file, char **script, const size_t *size, bool done, const char *folder,
                    const char *name, Message *message)
{
    const bool failed = ferror(file) != 0;
    if (fclose(file) != 0 || failed)
        done = message_set(message, "%s: the plot: %s", name, strerror(ENOMEM));
    done = done && gnuplot_draw(*script, *size, folder, name, message);
    free(*script);
    return done;
}

void gnuplot_string(FILE *script, const char *text)
{
    /* In single quotes nothing has a meaning but they themselves. */
    fputc('\'', script);
    for (const char *p = text; *p; p++) {
        if (*p == '\'')
            fputc('\'', script);
        fputc((unsigned char)*p < ' ' ? ' ' : *p, script);
    }
    fputc('\'', script);
}

void gnuplot_foot(FILE *script, const char *text)
{
    if (!text)
        return;
    fputs("set label ", script);
    gnuplot_string(script, text);
    fputs(" at screen 0.995,0.012 right font ',9' textcolor rgb '#888888'\n", script);
}

/* Writes the numbers from least to most that are a power of ten times one of these; how many. */
static int put_decades(FILE *script, double least, double most, const double *factors, int count)
{
    int written = 0;
    for (int power = (int)floor(log10(least)); power <= (int)ceil(log10(most)); power++) {
        for (int i = 0; i < count; i++) {
            const double value = factors[i] * pow(10, power);
            if (value < least * 0.9999 || value > most * 1.0001)
                continue;
            if (script)
                fprintf(script, "%s'%.6g' %.9g", written ? ", " : "", value, value);
            written++;
        }
    }
    return written;
}

static void put_steps(FILE *script, double least, double most)
{
    static const double factors[] = {1, 2, 5, 10};
    const double rough = (most - least) / 6, power = pow(10, floor(log10(rough)));
    double step = power;
    for (int i = 0; i < 4 && step < rough; i++)
        step = factors[i] * power;
    const double first = ceil(least / step - 1e-6);
    for (int i = 0; (first + i) * step <= most + 1e-6 * step; i++) {
        const double value = (first + i) * step;
        fprintf(script, "%s'%.6g' %.9g", i ? ", " : "", value, value);
    }
}

void gnuplot_axis(FILE *script, char axis, double least, double most, bool log)
{
    enum { FEW = 5, MANY = 16 };
    static const double factors[] = {1, 2, 5, 1, 1.5, 2, 3, 4, 5, 7};
    static const struct {
        int first, count;
    } sets[] = {{0, 3}, {0, 1}, {3, 7}};
    int set = -1;
    for (int i = 0; i < 3 && log && set < 0; i++) {
        const int count = put_decades(NULL, least, most, factors + sets[i].first, sets[i].count);
        if (count >= FEW && count <= MANY)
            set = i;
    }
    if (log)
        fprintf(script, "set logscale %c\n", axis);
    fprintf(script, "set %crange [%.9g:%.9g]\n", axis, least, most);
    fprintf(script, "set %ctics nomirror out (", axis);
    if (set >= 0)
        put_decades(script, least, most, factors + sets[set].first, sets[set].count);
    else
        put_steps(script, least, most);
    fprintf(script, ")\n");
}
