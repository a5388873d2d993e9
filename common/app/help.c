/* A table of options as --help, as a man page, and as completions for three shells. */
#include "app/help.h"

#include "base/text.h"
#include "base/version.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define EXIT_STATUS "0, 1 if something failed, 2 if the command line is wrong."
#define HEADLESS "Draws one picture without a window or a display."

enum { WIDTH = 88, INDENT = 25, TEXT_SIZE = 1024, DETAILS_SIZE = 8192 };

static bool takes_file(const Parameter *option)
{
    return option->kind == PARAMETER_TEXT && !option->choices && !option->codec;
}

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

/* A hyphen is typeset as a dash unless it is escaped, a line that begins with a period or a quote
 * is a request, and \: allows a break. (groff_man(7)) */
static void print_roff(const char *text)
{
    for (bool begin = true; *text; begin = *text++ == '\n') {
        if (begin && (*text == '.' || *text == '\''))
            printf("\\&");
        printf("%s%c%s", *text == '-' || *text == '\\' ? "\\" : "", *text == '\\' ? 'e' : *text,
               *text == '|' ? "\\:" : "");
    }
}

/* Variables for which there is an option too only where it is in the table. */
static void print_environment(const Parameter *table)
{
    static const struct {
        const char *name, *option, *help;
    } variables[] = {
        {"LIGHTING_BACKEND", "backend", "What draws, unless --backend says so."},
        {"LIGHTING_SHADERS", "shaders", "A folder with shader files, after that of --shaders."},
        {"LIGHTING_FONT", NULL, "The TrueType file for labels in pictures."},
        {"LP_NUM_THREADS", NULL, "The threads of Mesa's llvmpipe."},
        {"NO_COLOR", NULL, "If set and not empty, messages on a terminal have no colour."},
        {"SOURCE_DATE_EPOCH", NULL,
         "The date in EXR and TIFF files, in seconds since 1970; 0 if it is not set."},
        {"XDG_CACHE_HOME", NULL,
         "Where lighting/ keeps what takes long to compute; ~/.cache if it is not set."},
    };
    printf(".SH ENVIRONMENT\n");
    for (size_t i = 0; i < sizeof variables / sizeof variables[0]; i++) {
        const Parameter *option = table;
        while (option->name && variables[i].option && strcmp(option->name, variables[i].option))
            option++;
        if (!option->name)
            continue;
        printf(".TP\n.B %s\n", variables[i].name);
        print_roff(variables[i].help);
        printf("\n");
    }
}

static void print_man(const Usage *usage, const Parameter *table)
{
    char text[DETAILS_SIZE];
    const Parameter *first = table;
    printf(".TH %s 1 \"\" \"lighting %s\" \"User Commands\"\n.ad l\n.SH NAME\n%s \\- ", usage->name,
           VERSION, usage->name);
    print_roff(usage->summary);
    printf("\n.SH SYNOPSIS\n.B %s\n[\\fIoptions\\fR] %s\n%s.SH OPTIONS\n", usage->name,
           operands(usage),
           usage->gallery || usage->study ? "" : ".SH DESCRIPTION\n" HEADLESS "\n");
    for (; table->name; table++) {
        printf(table->letter ? ".TP\n\\fB\\-%c\\fR, \\fB\\-\\-" : ".TP\n\\fB\\-\\-", table->letter);
        print_roff(table->name);
        const char *value = placeholder(table, text);
        const bool optional = value[0] && table->kind == PARAMETER_FLAG;
        printf("\\fR%s\\fI", optional ? "[=" : value[0] ? " " : "");
        print_roff(value);
        printf("\\fR%s\n", optional ? "]" : "");
        print_roff(meaning(table, text));
        printf("\n");
    }
    print_environment(first);
    const char *last = details(usage, text);
    printf(".SH EXIT STATUS\n.TP\n0\nEverything was done.\n"
           ".TP\n%d\nSomething failed: a file, the driver, the machine.\n"
           ".TP\n%d\nThe command line is wrong; nothing was written.\n%s",
           EXIT_FAILED, EXIT_USAGE, last[0] ? ".SH NOTES\n.nf\n" : "");
    print_roff(last);
}

/* The first clause of what the option is, in single quotes; zsh needs brackets escaped. */
static void print_clause(const Parameter *option, const char *special)
{
    const char *end = option->help + strcspn(option->help, ";:(");
    for (const char *p = option->help; p < end; p++)
        printf("%s%c", *p == '\'' ? "'\\'" : strchr(special, *p) ? "\\" : "", *p);
}

/* Bash splits --NAME=VALUE into three words. */
static void print_bash(const Usage *usage, const Parameter *table)
{
    char text[TEXT_SIZE];
    printf("_%s()\n{\n"
           "    local word=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]} words\n"
           "    [[ $word == = ]] && word=\n"
           "    [[ $option == = ]] && option=${COMP_WORDS[COMP_CWORD - 2]}\n"
           "    case $option in\n",
           usage->name);
    for (const Parameter *option = table; option->name; option++) {
        const char letter[] = {option->letter, '\0'};
        if (parameter_choices(option) && option->kind != PARAMETER_FLAG)
            printf("    --%s%s%s) words='%s' ;;\n", option->name, letter[0] ? " | -" : "", letter,
                   join_choices(option, " ", text));
    }
    printf("    *)\n        [[ $word == -* ]] || return\n        words='");
    for (; table->name; table++)
        printf("--%s ", table->name);
    printf("'\n        ;;\n    esac\n"
           "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n}\n"
           "complete -o default -F _%s %s\n",
           usage->name, usage->name);
}

/* (zshcompsys(1), _arguments) */
static void print_zsh(const Usage *usage, const Parameter *table)
{
    char text[TEXT_SIZE];
    printf("#compdef %s\n_arguments -s -S%s", usage->name,
           operands(usage)[0] ? " '*:file:_files'" : "");
    for (; table->name; table++) {
        const bool flag = table->kind == PARAMETER_FLAG;
        const char *choices = join_choices(table, " ", text);
        if (table->letter)
            printf(" \\\n    '(-%c --%s)'{-%c%s,--%s%s}'[", table->letter, table->name,
                   table->letter, flag ? "" : "+", table->name, flag ? "" : "=");
        else
            printf(" \\\n    '--%s%s[", table->name, !flag ? "=" : choices[0] ? "=-" : "");
        print_clause(table, "[]\\");
        printf("]");
        if (!flag || choices[0])
            printf(choices[0] ? "%s%s:(%s)" : "%s%s:%s", flag ? "::" : ":", table->name,
                   choices[0]          ? choices
                   : takes_file(table) ? "_files"
                                       : " ");
        printf("'");
    }
    printf("\n");
}

static void print_fish(const Usage *usage, const Parameter *table)
{
    char text[TEXT_SIZE];
    if (!operands(usage)[0])
        printf("complete -c %s -f\n", usage->name);
    for (; table->name; table++) {
        const char *choices = join_choices(table, " ", text);
        printf("complete -c %s -l %s", usage->name, table->name);
        if (table->letter)
            printf(" -s %c", table->letter);
        printf(choices[0] ? "%s -a '%s'" : "%s",
               table->kind == PARAMETER_FLAG ? ""
               : takes_file(table)           ? " -rF"
                                             : " -x",
               choices);
        printf(" -d '");
        print_clause(table, "\\");
        printf("'\n");
    }
}

void help_generate(const char *form, const Usage *usage, const Parameter *table)
{
    (form[0] == 'm'   ? print_man
     : form[0] == 'b' ? print_bash
     : form[0] == 'z' ? print_zsh
                      : print_fish)(usage, table);
}
