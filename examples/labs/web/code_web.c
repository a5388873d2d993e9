/*
 * A page has no C compiler. Lab 3's matrices need one; of lab 10's budget.c it reads the usual
 * form, assignments of numbers that may have names, and leaves everything else to the native check.
 */
#include "base/text.h"
#include "labs/check/code.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool code_matrices(const Code *code, const double *seconds, int count, CodeMatrices *matrices,
                   Message *message)
{
    (void)seconds, (void)count, (void)matrices;
    return message_set(message,
                       "%s: the browser compiles no C; check natively: examples/run check %s mine",
                       code->lab->code, code->lab->name);
}

/* Skips white space, comments and #include. */
static const char *next_token(const char *text)
{
    for (;;) {
        text += strspn(text, " \t\r\n");
        if (strncmp(text, "//", 2) == 0 || strncmp(text, "#include", 8) == 0)
            text += strcspn(text, "\n");
        else if (strncmp(text, "/*", 2) == 0 && strstr(text + 2, "*/"))
            text = strstr(text + 2, "*/") + 2;
        else
            return text;
    }
}

/* Takes a token if it is the next one. */
static bool take(const char **at, const char *token)
{
    const char *text = next_token(*at);
    const size_t length = strlen(token);
    if (strncmp(text, token, length) != 0 || (text_is_word(token[0]) && text_is_word(text[length])))
        return false;
    *at = text + length;
    return true;
}

static bool take_word(const char **at, char *word, size_t size)
{
    const char *text = next_token(*at);
    size_t length = 0;
    while (text_is_word(text[length]))
        length++;
    if (length == 0 || length >= size || isdigit((unsigned char)text[0]))
        return false;
    snprintf(word, size, "%.*s", (int)length, text);
    *at = text + length;
    return true;
}

static bool take_number(const char **at, int *number)
{
    const char *text = next_token(*at);
    const size_t length = strspn(text, "0123456789");
    if (length == 0 || length > 5 || text_is_word(text[length]) || (text[0] == '0' && length > 1))
        return false;
    *number = atoi(text);
    *at = text + length;
    return true;
}

static bool take_truth(const char **at, bool *truth)
{
    *truth = take(at, "true") || take(at, "1");
    return *truth || take(at, "false") || take(at, "0");
}

/* Numbers by name; the parameter's name has -1. */
typedef struct {
    char names[8][64];
    int values[8];
    int count;
} Constants;

static int find_constant(const Constants *constants, const char *name)
{
    int i = 0;
    while (i < constants->count && strcmp(constants->names[i], name) != 0)
        i++;
    return i;
}

/* A name that means nothing else here or in C. */
static bool take_new_name(const char **at, Constants *constants)
{
    static const char TAKEN[] =
        " auto bool break case char const continue default do double else enum extern false float "
        "for goto if inline int long register restrict return short signed sizeof static struct "
        "switch true typedef union unsigned void volatile while lab_budget LabBudget asm typeof "
        "linux unix ";
    char name[64], word[66];
    const int i = constants->count;
    if (i == 8 || !take_word(at, name, sizeof name) || find_constant(constants, name) < i)
        return false;
    snprintf(word, sizeof word, " %s ", name);
    if (strstr(TAKEN, word))
        return false;
    snprintf(constants->names[i], sizeof constants->names[i], "%s", name);
    constants->count++;
    return true;
}

/* "#define SLICES 64", on a line of its own, with what a comment adds to it. */
static bool take_macro(const char **at, Constants *constants)
{
    static const char *const MEMBERS[] = {"slices", "stacks", "cull"};
    const char *line = next_token(*at), *end = line + strcspn(line, "\n");
    if (!take(at, "#define") || !isblank((unsigned char)**at) || !take_new_name(at, constants) ||
        !take_number(at, &constants->values[constants->count - 1]))
        return false;
    for (int i = 0; i < 3; i++)
        if (strcmp(constants->names[constants->count - 1], MEMBERS[i]) == 0)
            return false;
    /* What a comment or a backslash continues is not read. */
    const char *comment = strstr(*at, "/*"), *closed = comment ? strstr(comment, "*/") : NULL;
    const bool whole = !comment || comment > end || (closed && closed < end);
    return *at <= end && *end && end[-1] != '\\' && whole && next_token(*at) > end;
}

/* "const int slices = 64;", of which "const" is taken already. */
static bool take_constant(const char **at, Constants *constants)
{
    return take(at, "int") && take_new_name(at, constants) && take(at, "=") &&
           take_number(at, &constants->values[constants->count - 1]) && take(at, ";");
}

static bool take_value(const char **at, const Constants *constants, int *value)
{
    char name[64];
    if (take_number(at, value))
        return true;
    if (!take_word(at, name, sizeof name))
        return false;
    const int i = find_constant(constants, name);
    if (i == constants->count || constants->values[i] < 0)
        return false;
    *value = constants->values[i];
    return true;
}

/* "budget->slices = 12;" */
static bool take_assignment(const char **at, const Constants *constants, const char *name,
                            LabBudget *budget)
{
    if (!take(at, name) || !take(at, "->"))
        return false;
    if (take(at, "slices"))
        return take(at, "=") && take_value(at, constants, &budget->slices) && take(at, ";");
    if (take(at, "stacks"))
        return take(at, "=") && take_value(at, constants, &budget->stacks) && take(at, ";");
    return take(at, "cull") && take(at, "=") && take_truth(at, &budget->cull) && take(at, ";");
}

static int line_of(const char *text, const char *at)
{
    int line = 1;
    for (; text < at; text++)
        line += *text == '\n';
    return line;
}

bool code_budget(const Code *code, LabBudget *budget, Message *message)
{
    Constants constants = {.count = 0};
    const char *at = code->text, *before = code->text;
    *budget = (LabBudget){.slices = 16, .stacks = 16};
    bool done = true;
    while (done && *next_token(at) == '#') {
        before = at;
        done = take_macro(&at, &constants);
    }
    before = done ? at : before;
    done = done && take(&at, "void") && take(&at, "lab_budget") && take(&at, "(") &&
           take(&at, "LabBudget") && take(&at, "*") && take_new_name(&at, &constants);
    const int parameter = constants.count - 1;
    if (done)
        constants.values[parameter] = -1;
    done = done && take(&at, ")") && take(&at, "{");
    while (done && !take(&at, "}")) {
        before = at;
        done = take(&at, "const")
                   ? take_constant(&at, &constants)
                   : take_assignment(&at, &constants, constants.names[parameter], budget);
    }
    if (!done || *next_token(at))
        return message_set(message,
                           "%s:%d: error: the browser compiles no C; it reads lines like "
                           "budget->slices = 64; and what is more is for the native check",
                           code->lab->code, line_of(code->text, next_token(done ? at : before)));
    if (budget->slices >= 3 && budget->slices <= 512 && budget->stacks >= 2 &&
        budget->stacks <= 512)
        return true;
    code->verdict->kind = VERDICT_ERROR;
    snprintf(code->verdict->message, sizeof code->verdict->message,
             "%s: slices must be 3 to 512, stacks 2 to 512", code->lab->code);
    return false;
}
