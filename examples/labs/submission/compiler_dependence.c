/* Reads a text's directives line by line with a stack of conditions. A macro that depends on an
 * allowed one is as dependent; the branches of such a condition may only differ in precisions.
 * Compilers differ in whether a backslash joins lines, so both readings have to pass. */
#include "labs/submission/submission.h"

#include "base/memory.h"
#include "base/text.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_SIZE = 64, MAX_DEPTH = 64, MAX_NAMES = 32 };

/* Reading. */

/* Makes every line end \n. Compilers differ in whether a backslash joins two lines: `join`. */
static void unify_lines(char *text, bool join)
{
    char *to = text;
    for (const char *p = text; *p; p++) {
        if (*p == '\r' && p[1] == '\n')
            continue;
        if (join && *p == '\\' && (p[1] == '\n' || p[1] == '\r'))
            p += p[1] == '\r' && p[2] == '\n' ? 2 : 1;
        else
            *to++ = *p == '\r' ? '\n' : *p;
    }
    *to = '\0';
}

/* The next word, number or other character, into `token`; the place after it, or NULL at the end of
 * the line. */
static const char *next_token(const char *p, char token[NAME_SIZE])
{
    p += strspn(p, " \t\v\f");
    size_t length = 0;
    while (text_is_word(p[length]))
        length++;
    if (!length && *p && *p != '\n')
        length = 1;
    snprintf(token, NAME_SIZE, "%.*s", (int)length, p);
    return length ? p + length : NULL;
}

/* The word after # of a directive; false: the line is none. */
static bool is_directive(const char *line, char word[NAME_SIZE], const char **rest)
{
    char mark[NAME_SIZE];
    const char *p = next_token(line, mark);
    if (!p || strcmp(mark, "#") != 0)
        return false;
    const char *after = next_token(p, word);
    *rest = after ? after : p;
    return true;
}

static const char *next_line(const char *line)
{
    line += strcspn(line, "\n");
    return *line ? line + 1 : line;
}

static const char *const CONDITIONS[] = {"if", "ifdef", "ifndef", "elif", NULL};
static const char *const PRECISIONS[] = {"lowp", "mediump", "highp", NULL};
static const char *const UNREAD[] = {"extension", "version", "pragma", "line", "error", NULL};
static const char *const ALLOWED[] = {"GL_ES", "GL_FRAGMENT_PRECISION_HIGH", NULL};

/* A condition, and what its branches have but precisions. */
typedef struct Condition {
    bool restricted; /* it, or one around it, names an allowed macro */
    bool compared, otherwise;
    uint64_t first, now; /* hashes: of its first branch, and of what is read */
    char token[NAME_SIZE];
} Condition;

/* What a text depends on so far. */
typedef struct Reader {
    Condition conditions[MAX_DEPTH + 1]; /* by depth */
    int depth;
    char names[MAX_NAMES][NAME_SIZE]; /* macros that were defined there */
    int name_count;
    Message *message;
} Reader;

static bool is_dependent(const Reader *reader, const char *token)
{
    for (int i = 0; i < reader->name_count; i++)
        if (strcmp(token, reader->names[i]) == 0)
            return true;
    return text_among(token, ALLOWED) >= 0;
}

/* Whether a line names an allowed macro, or one that depends on such; false, with a message, in
 * *allowed: it names what nothing may depend on. */
static bool names_macro(const Reader *reader, const char *p, bool condition, bool *allowed)
{
    char token[NAME_SIZE];
    bool found = false;
    while ((p = next_token(p, token)) && *allowed) {
        const bool macro = strncmp(token, "GL_", 3) == 0;
        if (strcmp(token, "__VERSION__") == 0 || strncmp(token, "gl_Max", 6) == 0 ||
            (macro && (!condition || text_among(token, ALLOWED) < 0)))
            *allowed = message_set(reader->message,
                                   "depends on %s, which another compiler gives another value; "
                                   "remove it",
                                   token);
        if (strcmp(token, "gl_PointCoord") == 0)
            *allowed = message_set(
                reader->message, "reads gl_PointCoord, which has no value in triangles; remove it");
        found |= is_dependent(reader, token);
    }
    return found;
}

static bool refuse(const Reader *reader, const char *token)
{
    return message_set(reader->message,
                       "depends on GL_ES or GL_FRAGMENT_PRECISION_HIGH in more than precision, at "
                       "\"%s\"; remove the condition",
                       token);
}

static void add_hash(Condition *condition, uint64_t hash)
{
    condition->now = (condition->now ^ hash) * 0x9e3779b97f4a7c15u + 1;
}

/* Within such a condition: what is no precision is as in the other branches. A macro is a precision
 * or nothing. */
static bool read_restricted(Reader *reader, const char *p, bool define)
{
    Condition *condition = &reader->conditions[reader->depth];
    char token[NAME_SIZE];
    bool precision = false;
    if (define)
        p = next_token(p, token); /* its name */
    while (p && (p = next_token(p, token))) {
        precision |= strcmp(token, "precision") == 0 && !define;
        if (!precision && text_among(token, PRECISIONS) < 0) {
            if (define)
                return refuse(reader, token);
            if (!condition->token[0])
                memcpy(condition->token, token, sizeof token);
            for (const char *at = token; *at; at++)
                add_hash(condition, (unsigned char)*at);
            add_hash(condition, ' ');
        }
        precision &= token[0] != ';';
    }
    return true;
}

/* What is read is a branch. */
static bool end_branch(Reader *reader)
{
    Condition *condition = &reader->conditions[reader->depth];
    if (condition->compared && condition->now != condition->first)
        return refuse(reader, condition->token);
    condition->compared = condition->restricted;
    condition->first = condition->now;
    condition->now = 0;
    return true;
}

/* Without #else there is a branch of nothing, too. */
static bool end_condition(Reader *reader)
{
    const Condition *condition = &reader->conditions[reader->depth];
    if (!end_branch(reader) || (!condition->otherwise && !end_branch(reader)))
        return false;
    reader->depth -= reader->depth > 0;
    Condition *outer = &reader->conditions[reader->depth];
    if (!outer->token[0])
        memcpy(outer->token, condition->token, sizeof outer->token);
    if (condition->first)
        add_hash(outer, condition->first);
    return true;
}

static bool read_define(Reader *reader, const char *rest, bool dependent)
{
    const bool restricted = reader->conditions[reader->depth].restricted;
    if (!dependent && !restricted)
        return true;
    if (reader->name_count == MAX_NAMES)
        return message_set(reader->message, "has too many macros that depend on GL_ES");
    next_token(rest, reader->names[reader->name_count++]);
    return !restricted || read_restricted(reader, rest, true);
}

static bool read_line(Reader *reader, const char *line)
{
    char word[NAME_SIZE] = "";
    const char *rest = line;
    const bool directive = is_directive(line, word, &rest);
    const bool condition = directive && text_among(word, CONDITIONS) >= 0;
    bool allowed = true;
    if (directive && text_among(word, UNREAD) >= 0)
        return true;
    const bool dependent = names_macro(reader, rest, condition, &allowed);
    if (!allowed)
        return false;
    Condition *at = &reader->conditions[reader->depth];
    if (condition && strcmp(word, "elif") != 0) {
        if (reader->depth == MAX_DEPTH)
            return message_set(reader->message, "has conditions that are nested too deep");
        reader->conditions[++reader->depth] =
            (Condition){.restricted = at->restricted || dependent};
    } else if (condition || (directive && strcmp(word, "else") == 0)) {
        if (!end_branch(reader))
            return false;
        at->restricted |= dependent;
        at->otherwise |= !condition;
    } else if (directive && strcmp(word, "endif") == 0) {
        return end_condition(reader);
    } else if (directive && strcmp(word, "define") == 0) {
        return read_define(reader, rest, dependent);
    } else {
        return !at->restricted || read_restricted(reader, line, false);
    }
    return true;
}

static bool check_as(const char *text, bool join, Message *message)
{
    char *clean = memory_text(text);
    unify_lines(clean, join);
    text_strip_comments(clean);
    Reader reader = {.message = message};
    bool done = true;
    for (const char *line = clean; *line && done; line = next_line(line))
        done = read_line(&reader, line);
    free(clean);
    return done;
}

bool compiler_dependence_check(const char *text, Message *message)
{
    return check_as(text, false, message) && check_as(text, true, message);
}
