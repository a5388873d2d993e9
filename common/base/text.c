/*
 * Names are compared by the edits that turn one into the other, by dynamic programming over their
 * prefixes: three rows of the table are enough, because an exchange of neighbours looks back two.
 */
#include "base/text.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

int text_numbers(const char *text, const char *form, int *numbers)
{
    const char *at = text;
    for (; *form; form++) {
        char *end;
        if (*form != '#') {
            if (*at++ != *form)
                return 0;
            continue;
        }
        *numbers++ = (int)strtol(at, &end, 10);
        if (end == at)
            return 0;
        at = end;
    }
    return (int)(at - text);
}

/* Digits below 2^53 and the power of ten are exact, so that only their quotient is rounded, as it
 * is there (Clinger, How to read floating point numbers accurately, PLDI 1990). */
double text_decimal(const char *text, char **end)
{
    const char *at = text + strspn(text, " \t\r\n"), *point = NULL;
    const bool negative = *at == '-';
    double power = 1;
    uint64_t digits = 0;
    int count = 0;
    for (at += negative; count < 16 && ((*at >= '0' && *at <= '9') || (*at == '.' && !point)); at++)
        if (*at == '.') {
            point = at;
        } else {
            digits = 10 * digits + (uint64_t)(*at - '0');
            power *= point ? 10 : 1;
            count++;
        }
    if (count == 0 || count == 16 || text_is_word(*at))
        return strtod(text, end);
    *end = (char *)at;
    return (negative ? -(double)digits : (double)digits) / power;
}

int text_character(const char *text)
{
    static const struct {
        unsigned char min, max, second_min, second_max;
        int size;
    } kinds[] = {
        {0x01, 0x7F, 0, 0, 1},       {0xC2, 0xDF, 0x80, 0xBF, 2}, {0xE0, 0xE0, 0xA0, 0xBF, 3},
        {0xE1, 0xEC, 0x80, 0xBF, 3}, {0xED, 0xED, 0x80, 0x9F, 3}, {0xEE, 0xEF, 0x80, 0xBF, 3},
        {0xF0, 0xF0, 0x90, 0xBF, 4}, {0xF1, 0xF3, 0x80, 0xBF, 4}, {0xF4, 0xF4, 0x80, 0x8F, 4}};
    const unsigned char *byte = (const unsigned char *)text;
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (byte[0] < kinds[i].min || byte[0] > kinds[i].max)
            continue;
        if (kinds[i].size > 1 && (byte[1] < kinds[i].second_min || byte[1] > kinds[i].second_max))
            return 0;
        for (int j = 2; j < kinds[i].size; j++)
            if ((byte[j] & 0xC0) != 0x80)
                return 0;
        return kinds[i].size;
    }
    return 0;
}

int text_count_word(const char *text, const char *word)
{
    int count = 0;
    const size_t length = strlen(word);
    for (const char *at = text; (at = strstr(at, word)); at += length)
        count += (at == text || !text_is_word(at[-1])) && !text_is_word(at[length]);
    return count;
}

bool text_turns_direction(const char *text)
{
    const unsigned char *byte = (const unsigned char *)text;
    if (byte[0] != 0xE2)
        return byte[0] == 0xD8 && byte[1] == 0x9C;
    return (byte[1] == 0x80 &&
            (byte[2] == 0x8E || byte[2] == 0x8F || (byte[2] >= 0xAA && byte[2] <= 0xAE))) ||
           (byte[1] == 0x81 && byte[2] >= 0xA6 && byte[2] <= 0xA9);
}

bool text_is_quote(const char *line)
{
    const char *number = line + strspn(line, " ");
    const size_t digits = strspn(number, "0123456789");
    return number >= line + 2 && digits > 0 && strncmp(number + digits, " |", 2) == 0;
}

const char *text_comment_end(const char *text)
{
    if (strncmp(text, "//", 2) == 0)
        return text + strcspn(text, "\n");
    if (strncmp(text, "/*", 2) != 0)
        return NULL;
    const char *end = strstr(text + 2, "*/");
    return end ? end + 2 : text + strlen(text);
}

/* What is so deep in parentheses. */
static void leave_out(char *text, int depth)
{
    int open = 0;
    char *to = text, *begin = text;
    for (const char *at = text; *at; at++) {
        if (*at == ')' && open-- == depth && to - begin > 3)
            to = (char *)memcpy(begin, "...", 3) + 3;
        *to++ = *at;
        if (*at == '(' && ++open == depth)
            begin = to;
    }
    *to = '\0';
}

void text_shorten(char *text, size_t most)
{
    for (int depth = 6; depth > 0 && strlen(text) > most; depth--)
        leave_out(text, depth);
    if (strlen(text) <= most)
        return;
    size_t end = most - 4;
    while (end > 0 && text[end] != ' ')
        end--;
    memcpy(text + (end > 0 ? end : most - 4), " ...", 5);
}

void text_strip_comments(char *text)
{
    char *to = text;
    while (*text) {
        const char *end = text_comment_end(text);
        *to++ = end ? ' ' : *text;
        text += end ? end - text : 1;
    }
    *to = '\0';
}

/* The length of a text's first piece, which is not broken. */
static int piece(const char *text)
{
    const int length = (int)strcspn(text, " |\n");
    return length + (text[length] == '|');
}

/* The length of the first line. */
static int text_line(const char *text, int width)
{
    int length = piece(text);
    while (text[length] && text[length] != '\n') {
        const int blank = text[length] == ' ';
        const int longer = length + blank + piece(text + length + blank);
        if (longer > width)
            break;
        length = longer;
    }
    return length;
}

int text_wrap(FILE *file, const char *text, int column, int indent, int width)
{
    int length = text_line(text, width - column);
    if (column > indent && column + length > width)
        length = 0;
    column += fprintf(file, "%.*s", length, text);
    for (text += length; *text; text += length) {
        text += *text == ' ' || *text == '\n';
        length = text_line(text, width - indent);
        column = fprintf(file, "\n%*s%.*s", indent, "", length, text) - 1;
    }
    return column;
}

enum { WORD_MAX = 63 };

/* The first letters of a word, in lower case. Returns their number. */
static int lower(const char *word, char letters[WORD_MAX + 1])
{
    int length = 0;
    for (; word[length] && length < WORD_MAX; length++)
        letters[length] = (char)tolower((unsigned char)word[length]);
    letters[length] = '\0';
    return length;
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

/* The edits from one word to the other: letters changed, added, left out, or exchanged with their
 * neighbour (optimal string alignment). */
static int distance(const char *a, int length_a, const char *b, int length_b)
{
    int rows[3][WORD_MAX + 1]; /* by i mod 3 */
    for (int j = 0; j <= length_b; j++)
        rows[0][j] = j;
    for (int i = 1; i <= length_a; i++) {
        int *row = rows[i % 3], *above = rows[(i + 2) % 3], *before = rows[(i + 1) % 3];
        row[0] = i;
        for (int j = 1; j <= length_b; j++) {
            row[j] = least(above[j - 1] + (a[i - 1] != b[j - 1]), 1 + least(above[j], row[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = least(row[j], 1 + before[j - 2]);
        }
    }
    return rows[length_a % 3][length_b];
}

const char *text_nearest(const char *word, const char *const *names)
{
    char own[WORD_MAX + 1], other[WORD_MAX + 1];
    const int length = lower(word, own);
    const char *nearest = NULL, *beginning = NULL;
    int min = length / 3 + 1, beginnings = 0;
    for (; *names; names++) {
        const int d = distance(own, length, other, lower(*names, other));
        if (d < min) {
            nearest = *names;
            min = d;
        }
        if (length && strncmp(own, other, (size_t)length) == 0 && beginnings++ == 0)
            beginning = *names;
    }
    return beginnings == 1 ? beginning : nearest;
}

int text_among(const char *text, const char *const *texts)
{
    int i = 0;
    while (text && texts[i] && strcmp(text, texts[i]) != 0)
        i++;
    return text && texts[i] ? i : -1;
}

uint32_t text_hash(const void *bytes, size_t size)
{
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ ((const unsigned char *)bytes)[i]) * 16777619u;
    return hash;
}
