#include "lessons/changes.h"

#include "base/memory.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINES_MAX = 4096 }; /* of a file: the table of lengths is then 32 MiB */

typedef struct Line {
    const char *text;
    int length;
} Line;

static bool begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

/* The end of what begins a line of code and does not count: blanks, a comment of its own lines, the
 * texts of --help. NULL: it counts. */
static const char *skip_uncounted(const char *text)
{
    const char *word = text + strspn(text, " \t"), *end = word;
    if (begins(word, "/*"))
        end = strstr(word, "*/");
    else if (begins(word, ".tries =") || begins(word, ".looks ="))
        end = strstr(word, "}");
    else if (*word != '\n' && !begins(word, ".summary ="))
        return NULL;
    end = end ? end : word;
    return end + strcspn(end, "\n");
}

/* The number of lines; -1 if there are too many. */
static int split(ChangeText file, Line lines[LINES_MAX])
{
    const char *text = file.text;
    int count = 0;
    while (*text && count < LINES_MAX) {
        const char *skipped = file.code ? skip_uncounted(text) : NULL;
        const int length = (int)strcspn(text, "\n");
        if (!skipped)
            lines[count++] = (Line){text, length};
        text = skipped ? skipped : text + length;
        text += *text == '\n';
    }
    return *text ? -1 : count;
}

void changes_add(Changes *changes, ChangeKind kind, const char *text, int length)
{
    ChangeLine *line =
        memory_add(&changes->lines, &changes->count, &changes->room, sizeof *changes->lines);
    line->kind = kind;
    snprintf(line->text, sizeof line->text, "%.*s", length, text);
}

void changes_add_text(Changes *changes, const char *text)
{
    while (*text) {
        const int length = (int)strcspn(text, "\n");
        changes_add(changes, CHANGE_SAME, text, length);
        text += length + (text[length] == '\n');
    }
}

/* Whether a line begins with the name of its program at `i`; its length. */
static int name_at(Line line, int i, const char *name)
{
    const int length = (int)strlen(name);
    return length <= line.length - i && memcmp(line.text + i, name, (size_t)length) == 0 ? length
                                                                                         : 0;
}

static bool same(Line a, const char *name_a, Line b, const char *name_b)
{
    int i = 0, j = 0;
    while (i < a.length && j < b.length) {
        const int skip_a = name_at(a, i, name_a), skip_b = name_at(b, j, name_b);
        const bool named = skip_a && skip_b;
        if (!named && a.text[i] != b.text[j])
            return false;
        i += named ? skip_a : 1;
        j += named ? skip_b : 1;
    }
    return i == a.length && j == b.length;
}

/* Two files, and for each pair of lines the length of the longest common subsequence from there to
 * the ends. */
typedef struct Pair {
    Line lines[2][LINES_MAX];
    const char *names[2];
    int count[2];
    uint16_t *common; /* (count[0] + 1) rows of count[1] + 1 */
} Pair;

static uint16_t *common_at(const Pair *pair, int i, int j)
{
    return &pair->common[(size_t)i * (size_t)(pair->count[1] + 1) + (size_t)j];
}

static bool same_at(const Pair *pair, int i, int j)
{
    return same(pair->lines[0][i], pair->names[0], pair->lines[1][j], pair->names[1]);
}

/* All lines of both files, in order. */
static void merge(Changes *all, const Pair *pair)
{
    for (int i = 0, j = 0; i < pair->count[0] || j < pair->count[1];) {
        const bool old = i < pair->count[0], new = j < pair->count[1];
        ChangeKind kind = CHANGE_ADDED;
        if (old && new &&same_at(pair, i, j))
            kind = CHANGE_SAME;
        else if (old && (!new || *common_at(pair, i + 1, j) >= *common_at(pair, i, j + 1)))
            kind = CHANGE_REMOVED;
        const Line line = kind == CHANGE_REMOVED ? pair->lines[0][i] : pair->lines[1][j];
        changes_add(all, kind, line.text, line.length);
        i += kind != CHANGE_ADDED;
        j += kind != CHANGE_REMOVED;
    }
}

static bool is_near_change(const Changes *all, int line, int around)
{
    for (int i = line - around; i <= line + around; i++)
        if (i >= 0 && i < all->count && all->lines[i].kind != CHANGE_SAME)
            return true;
    return false;
}

bool changes_between(Changes *changes, ChangeText before, ChangeText after, int around,
                     int *changed, Message *message)
{
    Changes all = {.count = 0};
    Pair *pair = memory_new(1, sizeof *pair);
    pair->names[0] = before.name;
    pair->names[1] = after.name;
    pair->count[0] = split(before, pair->lines[0]);
    pair->count[1] = split(after, pair->lines[1]);
    if (pair->count[0] < 0 || pair->count[1] < 0) {
        const char *name = pair->count[0] < 0 ? before.name : after.name;
        free(pair);
        return message_set(message, "%s: more than %d lines", name, LINES_MAX);
    }
    const size_t cells = (size_t)(pair->count[0] + 1) * (size_t)(pair->count[1] + 1);
    pair->common = memory_new(cells, sizeof *pair->common);
    for (int i = pair->count[0] - 1; i >= 0; i--)
        for (int j = pair->count[1] - 1; j >= 0; j--) {
            const uint16_t left = *common_at(pair, i, j + 1), below = *common_at(pair, i + 1, j);
            *common_at(pair, i, j) = same_at(pair, i, j)
                                         ? (uint16_t)(*common_at(pair, i + 1, j + 1) + 1)
                                     : left > below ? left
                                                    : below;
        }
    merge(&all, pair);
    bool gap = false;
    *changed = 0;
    for (int i = 0; i < all.count; i++) {
        const ChangeLine *line = &all.lines[i];
        *changed += line->kind != CHANGE_SAME;
        if (!is_near_change(&all, i, around)) {
            gap = around > 0;
            continue;
        }
        if (gap)
            changes_add(changes, CHANGE_GAP, "", 0);
        changes_add(changes, line->kind, line->text, (int)strlen(line->text));
        gap = false;
    }
    changes_close(&all);
    free(pair->common);
    free(pair);
    return true;
}

void changes_close(Changes *changes)
{
    free(changes->lines);
    *changes = (Changes){.count = 0};
}
