/* A command line from values: each option whose value is not the default, in words that a shell
 * reads back. What follows from another option is not written: options are set in turn, as when
 * they are read, and compared after each.
 */
#include "app/command.h"

#include "base/output_text.h"
#include "window/backends.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Between single quotes all but these stand for themselves (POSIX.1-2017, Shell Command Language,
 * section 2.2.2). Plain letters need no quotes anywhere in a word. */
static void put_quoted(FILE *line, const char *text)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "%+,-./:@_";
    const bool quoted = !text[0] || text[strspn(text, plain)];
    fputs(quoted ? "'" : "", line);
    for (; *text; text++)
        fprintf(line, "%s%c", *text == '\'' ? "'\\'" : "", *text);
    fputs(quoted ? "'" : "", line);
}

/* Writes an option whose value is not the default, or which was given. A value that begins with a
 * hyphen is joined to its option. False if no option sets the value. */
static bool put_changed(FILE *line, const Parameter *option, const Parameter *usual)
{
    char own[PARAMETER_TEXT_SIZE], other[PARAMETER_TEXT_SIZE];
    const char *value = parameter_text(option, own), *usual_value = parameter_text(usual, other);
    const bool given = option->given && *option->given;
    if (!value || (usual_value && strcmp(value, usual_value) == 0 && !given))
        return value || !usual_value;
    fprintf(line, " --%s", option->name);
    if (option->kind != PARAMETER_FLAG) {
        fputc(value[0] == '-' ? '=' : ' ', line);
        put_quoted(line, value);
    }
    return true;
}

/* Writes a program's own options: sets the defaults, then each option in turn, as they take effect
 * when they are read, so that what follows from one of them is not written again. */
static bool put_own(FILE *line, const Parameter *table, const ParameterValue *defaults)
{
    ParameterValue values[OPTIONS_MAX_PARAMETERS];
    bool done = true;
    int count = 0;
    for (; table[count].name; count++) {
        values[count] = parameter_save(&table[count]);
        parameter_restore(&table[count], defaults[count]);
    }
    for (int turn = 0; turn < 2 * count; turn++) {
        const int i = turn % count;
        Parameter wanted = table[i];
        if ((turn < count) != (table[i].changed != NULL))
            continue;
        wanted.value = &values[i];
        done &= put_changed(line, &wanted, &table[i]);
        const bool same = parameter_equal(&table[i], &values[i]);
        parameter_restore(&table[i], values[i]);
        if (!same && table[i].changed)
            table[i].changed(&table[i]);
    }
    for (int i = 0; i < count; i++)
        parameter_restore(&table[i], values[i]);
    return done;
}

/* Ends a line and copies it, or nothing if it does not fit or was not done. */
static bool take(OutputText *line, bool done, char *text, size_t size)
{
    char *written = output_text_close(line);
    done = done && line->size < size;
    if (size > 0)
        snprintf(text, size, "%s", done ? written : "");
    free(written);
    return done;
}

bool command_start(const char *name, const char *argv0, char *text, size_t size)
{
    const char *script = getenv("LIGHTING_RUN");
    OutputText line;
    output_text_open(&line);
    if (script && script[0]) {
        put_quoted(line.file, script);
        fputc(' ', line.file);
        put_quoted(line.file, name);
    } else {
        put_quoted(line.file, argv0 && argv0[0] ? argv0 : name);
    }
    return take(&line, true, text, size);
}

static bool put_command(FILE *line, const Usage *usage, Options *own,
                        const ParameterValue *defaults)
{
    Options usual = options_default(usage);
    Parameter table[OPTIONS_MAX], usual_table[OPTIONS_MAX];
    own->size_given = false; /* the size alone counts */
    if (!own->output_given)
        own->output = NULL;
    if (options_in_window(own)) /* which draws as the first does */
        own->canvas.backend = CANVAS_HEADLESS[0];
    /* The first goes without saying, but not where the environment may say otherwise. */
    if (backend_default(NULL) != CANVAS_HEADLESS[0])
        usual.canvas.backend = backend_find("window", NULL);
    const int common = options_table(usage, &usual, OPTIONS_TO_WRITE, usual_table);
    options_table(usage, own, OPTIONS_TO_WRITE, table);
    if (own->start)
        fputs(own->start, line);
    else
        put_quoted(line, usage->name);
    for (int i = 0; i < common; i++)
        if (!put_changed(line, &table[i], &usual_table[i]))
            return false;
    return !defaults || put_own(line, table + common, defaults);
}

bool command_write(const Example *example, const Options *options, const ParameterValue *defaults,
                   char *text, size_t size)
{
    const Usage usage = options_usage(example);
    Options own = *options;
    OutputText line;
    output_text_open(&line);
    const bool done = put_command(line.file, &usage, &own, defaults);
    return take(&line, done, text, size);
}
