/* A table of options as --help; as a man page and as completions for three shells it fills
 * help.man, help.bash and so on. */
#include "app/help.h"

#include "base/output_text.h"
#include "base/template.h"
#include "base/text.h"
#include "base/version.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXIT_STATUS "0, 1 if something failed, 2 if the command line is wrong."
#define HEADLESS "Draws one picture without a window or a display."

enum { WIDTH = 88, INDENT = 25, TEXT_SIZE = 1024, DETAILS_SIZE = 8192 };

/* "egl|osmesa|window"; "" without choices. */
static const char *join_choices(const Parameter *option, const char *bar, char text[TEXT_SIZE])
{
    size_t length = 0;
    const char *const *choices = parameter_choices(option);
    text[0] = '\0';
    for (int i = 0; choices && choices[i] && length < TEXT_SIZE; i++)
        length +=
            (size_t)snprintf(text + length, TEXT_SIZE - length, "%s%s", i ? bar : "", choices[i]);
    return text;
}

/* The placeholder of the value; "" for a flag. */
static const char *placeholder(const Parameter *option, char text[TEXT_SIZE])
{
    if (parameter_placeholder(option))
        return parameter_placeholder(option);
    if (join_choices(option, "|", text)[0] || option->kind == PARAMETER_FLAG)
        return text;
    if (option->kind == PARAMETER_TEXT)
        return "TEXT";
    if (option->kind == PARAMETER_COLOR)
        return "R,G,B";
    if (fmax(fabs(option->min), fabs(option->max)) >= 1e6)
        return option->kind == PARAMETER_WHOLE ? "N" : "NUMBER";
    snprintf(text, TEXT_SIZE, "%.10g..%.10g", option->min, option->max);
    return text;
}

/* What the option is, the range of a colour, and the default. */
static const char *meaning(const Parameter *option, char text[TEXT_SIZE])
{
    char buffer[PARAMETER_TEXT_SIZE], range[PARAMETER_RANGE_SIZE] = "";
    const char *usual =
        option->standard || !option->value ? option->standard : parameter_text(option, buffer);
    const bool shown = usual && usual[0];
    if (option->kind == PARAMETER_COLOR)
        parameter_range(option, range);
    snprintf(text, TEXT_SIZE, "%s%s%s%s%s", option->help, range[0] ? ", each " : "", range,
             shown ? "; default " : "", shown ? usual : "");
    return text;
}

void help_options(const Parameter *table)
{
    char text[TEXT_SIZE];
    for (; table->name; table++) {
        const char *value = placeholder(table, text);
        const bool optional = value[0] && table->kind == PARAMETER_FLAG;
        int column = table->letter ? printf("  -%c, --%s", table->letter, table->name)
                                   : printf("      --%s", table->name);
        column += printf("%s", optional ? "[=" : value[0] ? " " : "");
        column = text_wrap(stdout, value, column, 14, WIDTH);
        column += printf("%s", optional ? "]" : "");
        if (column + 1 > INDENT)
            column = printf("\n") - 1;
        printf("%*s", INDENT - column, "");
        text_wrap(stdout, meaning(table, text), INDENT, INDENT, WIDTH);
        printf("\n");
    }
}

/* The last part of --help and of the man page. */
static const char *details(const Usage *usage, char text[DETAILS_SIZE])
{
    static const char *const common[] = {"--orbit 180,0 -o back.png", "--size 40x40 --samples 4",
                                         "--precision highp --print-shader=frag", NULL};
    static const char *const at_common[] = {"the scene from behind",
                                            "few pixels, but smooth edges: four samples for each",
                                            "the source that the driver gets"};
    const bool own = usage->tries && usage->tries[0];
    const char *const *tries = own ? usage->tries : common;
    const char *const *looks = own ? usage->looks : at_common;
    size_t length = 0;
    text[0] = '\0';
    for (int i = 0; tries[i] && !usage->details && !usage->gallery && length < DETAILS_SIZE; i++)
        length += (size_t)snprintf(text + length, DETAILS_SIZE - length, "%s%s %s\n          %s\n",
                                   i ? "      " : "Try:  ", usage->name, tries[i], looks[i]);
    return usage->details ? usage->details : text;
}

static const char *operands(const Usage *usage)
{
    return usage->gallery ? "[NAME...]" : usage->names ? usage->names : "";
}

void help_print(const Usage *usage, const Parameter *table)
{
    /* Written at once, at the end: then the reason is known why it does not arrive. */
    static char buffer[1 << 14];
    setvbuf(stdout, buffer, _IOFBF, sizeof buffer);
    char text[DETAILS_SIZE];
    const char *last = details(usage, text), *names = operands(usage);
    const bool has_own = usage->parameters && usage->parameters->name;
    printf("Usage: %s [options]%s%s\n\n%s\n\n%s", usage->name, names[0] ? " " : "", names,
           usage->summary, usage->gallery || usage->study ? "" : HEADLESS "\n\n");
    help_options(table);
    if (has_own)
        printf("\nOptions of this program:\n");
    if (has_own)
        help_options(usage->parameters);
    printf("\nExit status: " EXIT_STATUS "\n%s%s", last[0] ? "\n" : "", last);
}

/* A text escaped for roff: a hyphen is typeset as a dash unless it is escaped, a line that begins
 * with a period or a quote is a request, and \: allows a break (groff_man(7)). */
static void set_roff(TemplateValues *values, const char *name, const char *text)
{
    OutputText out;
    output_text_open(&out);
    for (bool begin = true; *text; begin = *text++ == '\n') {
        if (begin && (*text == '.' || *text == '\''))
            fputs("\\&", out.file);
        fprintf(out.file, "%s%c%s", *text == '-' || *text == '\\' ? "\\" : "",
                *text == '\\' ? 'e' : *text, *text == '|' ? "\\:" : "");
    }
    char *escaped = output_text_close(&out);
    template_set(values, name, "%s", escaped);
    free(escaped);
}

/* The first clause of what the option is, for single quotes of a shell; zsh needs brackets escaped.
 */
static void set_clause(TemplateValues *values, const char *name, const char *help,
                       const char *special)
{
    OutputText out;
    output_text_open(&out);
    for (const char *p = help, *end = help + strcspn(help, ";:("); p < end; p++)
        fprintf(out.file, "%s%c", *p == '\'' ? "'\\'" : strchr(special, *p) ? "\\" : "", *p);
    char *clause = output_text_close(&out);
    template_set(values, name, "%s", clause);
    free(clause);
}

static void set_flag(TemplateValues *values, const char *name, bool on)
{
    template_set(values, name, "%s", on ? "yes" : "");
}

static void set_option(TemplateValues *form, const Parameter *option)
{
    char text[TEXT_SIZE];
    TemplateValues *values = template_add(form, "option");
    const bool flag = option->kind == PARAMETER_FLAG;
    template_set(values, "name", "%s", option->name);
    template_set(values, "letter", "%s", (const char[]){option->letter, '\0'});
    const char *value = placeholder(option, text);
    set_flag(values, "optional", value[0] && flag);
    set_flag(values, "needs", value[0] && !flag);
    set_roff(values, "value", value);
    set_roff(values, "escaped", option->name);
    set_roff(values, "meaning", meaning(option, text));
    set_clause(values, "zsh", option->help, "[]\\");
    set_clause(values, "fish", option->help, "\\");
    const char *choices = join_choices(option, " ", text);
    template_set(values, "choices", "%s", choices);
    template_set(values, "words", "%s", flag ? "" : choices);
    set_flag(values, "flag", flag);
    set_flag(values, "takes", !flag || choices[0]);
    set_flag(values, "file", option->kind == PARAMETER_TEXT && !option->choices && !option->codec);
}

void help_generate(const char *form, const Usage *usage, const Parameter *table)
{
    Message message = {0};
    char text[DETAILS_SIZE], source[64];
    TemplateValues *values = template_values();
    template_set(values, "program", "%s", usage->name);
    template_set(values, "version", "%s", VERSION);
    template_set(values, "operands", "%s", operands(usage));
    set_flag(values, "draws", !usage->gallery && !usage->study);
    set_roff(values, "summary", usage->summary);
    set_roff(values, "details", details(usage, text));
    for (; table->name; table++) {
        set_option(values, table);
        if (strcmp(table->name, "backend") == 0 || strcmp(table->name, "shaders") == 0)
            set_flag(values, table->name, true);
    }
    snprintf(source, sizeof source, "common/app/help.%s", form);
    const bool done = template_print(source, values, stdout, &message);
    template_close(values);
    if (!done) {
        fprintf(stderr, "%s: %s\n", usage->name, message.text);
        exit(EXIT_FAILED);
    }
}
