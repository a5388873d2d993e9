#include "study/report/report_gnuplot.h"

#include "base/output_text.h"
#include "base/output.h"
#include "base/process.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

const char *const GNUPLOT_PALETTE[GNUPLOT_COLORS] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                     "#E69F00", "#56B4E9", "#000000"};

static bool fail(const char *path, const char *reason, Message *message)
{
    return message_set(message, "%s: gnuplot: %s", path, reason);
}

/* Runs gnuplot with these standard streams. It points at the place in the script over several
 * lines; the last one says what is wrong. */
static bool run_gnuplot(const int files[3], const char *path, Message *message)
{
    /* -d: without the user's settings. */
    static const char *const arguments[] = {"gnuplot", "-d", NULL};
    pid_t child;
    const int error = process_start(&child, arguments, (int[]){files[0], files[1], files[2], -1});
    if (error == ENOENT || error == EACCES)
        return message_set(message, "%s: plots need gnuplot: %s; install the package gnuplot-nox",
                           path, strerror(error));
    if (error)
        return fail(path, strerror(error), message);
    const int status = process_wait(child);
    struct stat picture;
    char said[501];
    if (status == 0 && fstat(files[1], &picture) == 0 && picture.st_size > 0)
        return true;
    if (WIFSIGNALED(status))
        return fail(path, strsignal(WTERMSIG(status)), message);
    if (!process_last_line(files[2], said, sizeof said))
        strcpy(said, "it drew nothing");
    return message_set(message, "%s: gnuplot: status %d: %s", path, WEXITSTATUS(status), said);
}

/* Script and errors are memory files, so that neither side blocks; the plot is written to a file
 * that gets its name when it is whole. */
static bool draw_plot(const char *terminal, const char *script, size_t size, const char *path,
                      Message *message)
{
    Output *output = output_begin(path, message);
    if (!output)
        return false;
    const int files[3] = {memfd_create("gnuplot", MFD_CLOEXEC), output_file(output),
                          memfd_create("gnuplot", MFD_CLOEXEC)};
    bool done = files[0] >= 0 && files[2] >= 0 &&
                dprintf(files[0], "set terminal %s\n", terminal) > 0 &&
                write(files[0], script, size) == (ssize_t)size && lseek(files[0], 0, SEEK_SET) == 0;
    done = done ? run_gnuplot(files, path, message) : fail(path, strerror(errno), message);
    for (int i = 0; i < 3; i += 2)
        if (files[i] >= 0)
            close(files[i]);
    if (done)
        return output_commit(output, message);
    output_abort(output);
    return false;
}

static bool draw_plots(const OutputText *script, const char *folder, const char *name,
                       Message *message)
{
    static const char *const extensions[] = {"svg", "png"};
    /* Scaled to equal sizes: svg counts in pixels, pngcairo in points. */
    static const char *const terminals[] = {"svg dynamic",
                                            "pngcairo fontscale 0.75 pointscale 1.4"};
    if (strchr(name, '/') || name[0] == '.')
        return message_set(message, "%s: cannot be a file's name", name);
    for (int i = 0; i < 2; i++) {
        char path[PATH_MAX], file[NAME_MAX], terminal[160];
        snprintf(terminal, sizeof terminal,
                 "%s size %d,%d noenhanced font 'DejaVu Sans,%d' background '#ffffff'",
                 terminals[i], GNUPLOT_WIDTH, GNUPLOT_HEIGHT, GNUPLOT_FONT);
        snprintf(file, sizeof file, "%s.%s", name, extensions[i]);
        if (!output_path(path, folder, file, message) ||
            !draw_plot(terminal, script->text, script->size, path, message))
            return false;
    }
    return true;
}

bool gnuplot_draw(const char *source, TemplateValues *values, const char *folder, const char *name,
                  Message *message)
{
    OutputText text;
    output_text_open(&text);
    bool done = template_print(source, values, text.file, message);
    template_close(values);
    output_text_close(&text);
    done = done && draw_plots(&text, folder, name, message);
    free(text.text);
    return done;
}

bool gnuplot_forget(const char *folder, const char *name, Message *message)
{
    static const char *const ends[] = {"svg", "png"};
    for (int i = 0; i < 2; i++) {
        char file[NAME_MAX], path[PATH_MAX];
        snprintf(file, sizeof file, "%s.%s", name, ends[i]);
        if (!output_path(path, folder, file, message))
            return false;
        if (unlink(path) != 0 && errno != ENOENT)
            return message_set(message, "%s: cannot be removed: %s", path, strerror(errno));
    }
    return true;
}

void gnuplot_set(TemplateValues *values, const char *name, const char *text)
{
    /* Within single quotes only the quote itself is special. */
    OutputText quoted;
    output_text_open(&quoted);
    for (const char *p = text; *p; p++)
        fprintf(quoted.file, "%s%c", *p == '\'' ? "'" : "", (unsigned char)*p < ' ' ? ' ' : *p);
    char *written = output_text_close(&quoted);
    template_set(values, name, "'%s'", written);
    free(written);
}

/* What was measured with, without what is in parentheses: there is no room for it. */
static void set_foot(TemplateValues *values, const char *text)
{
    char kept[256];
    size_t used = 0;
    int depth = 0;
    for (const char *p = text; *p && used + 1 < sizeof kept; p++) {
        depth += *p == '(';
        if (depth == 0 && !(p[0] == ' ' && p[1] == '('))
            kept[used++] = *p;
        depth -= *p == ')';
    }
    kept[used] = '\0';
    gnuplot_set(values, "foot", kept);
}

TemplateValues *gnuplot_values(const char *title, const char *foot)
{
    TemplateValues *values = template_values();
    gnuplot_set(values, "title", title);
    template_set(values, "title_size", "%d", GNUPLOT_TITLE);
    if (foot)
        set_foot(values, foot);
    return values;
}

/* Writes the numbers in min..max that are a factor times a power of ten; returns how many. */
static int put_decades(FILE *script, double min, double max, const double *factors, int count)
{
    int written = 0;
    for (int power = (int)floor(log10(min)); power <= (int)ceil(log10(max)); power++)
        for (int i = 0; i < count; i++) {
            const double value = factors[i] * pow(10, power);
            if (value < min * 0.9999 || value > max * 1.0001)
                continue;
            if (script)
                fprintf(script, "%s'%.6g' %.9g", written ? ", " : "", value, value);
            written++;
        }
    return written;
}

static void put_steps(FILE *script, double min, double max)
{
    static const double factors[] = {1, 2, 5, 10};
    const double rough = (max - min) / 6, power = pow(10, floor(log10(rough)));
    double step = power;
    for (int i = 0; i < 4 && step < rough; i++)
        step = factors[i] * power;
    const double first = ceil(min / step - 1e-6);
    for (int i = 0; (first + i) * step <= max + 1e-6 * step; i++) {
        const double value = (first + i) * step;
        fprintf(script, "%s'%.6g' %.9g", i ? ", " : "", value, value);
    }
}

void gnuplot_set_axis(TemplateValues *values, char axis, double min, double max, bool log)
{
    enum { FEW = 5, MANY = 16 };
    static const double factors[] = {1, 2, 5, 1, 1.5, 2, 3, 4, 5, 7};
    static const struct {
        int first, count;
    } sets[] = {{0, 3}, {0, 1}, {3, 7}};
    int set = -1;
    OutputText text;
    output_text_open(&text);
    FILE *script = text.file;
    for (int i = 0; i < 3 && log && set < 0; i++) {
        const int count = put_decades(NULL, min, max, factors + sets[i].first, sets[i].count);
        if (count >= FEW && count <= MANY)
            set = i;
    }
    if (log)
        fprintf(script, "set logscale %c\n", axis);
    fprintf(script, "set %crange [%.9g:%.9g]\n", axis, min, max);
    fprintf(script, "set %ctics nomirror out (", axis);
    if (set >= 0)
        put_decades(script, min, max, factors + sets[set].first, sets[set].count);
    else
        put_steps(script, min, max);
    fprintf(script, ")");
    char *commands = output_text_close(&text);
    template_set(values, axis == 'x' ? "x_axis" : "y_axis", "%s", commands);
    free(commands);
}
