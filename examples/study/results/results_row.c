#include "study/results/results.h"

#include "base/parse.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

int quality_unusual(const Quality *quality)
{
    int count = 0;
    for (int axis = 0; axis < AXIS_COUNT; axis++)
        count += quality->choice[axis] != QUALITY_AXES[axis].usual;
    return count;
}

#define ROW(field) offsetof(ResultRow, field), sizeof((ResultRow *)0)->field

static const Column SCENE = {"scene", COLUMN_TEXT, ROW(scene), 1, 0, 0};

enum { MAX = 1000000000 }; /* steps, or milliseconds */

/* The columns after the scene and the axes. */
static const Column NUMBERS[] = {
    {"width", COLUMN_COUNT, ROW(width), 1, PARSE_SIZE_MAX, 0},
    {"height", COLUMN_COUNT, ROW(height), 1, PARSE_SIZE_MAX, 0},
    {"interior_rms", COLUMN_REAL, ROW(interior_rms), 0, MAX, 0},
    {"interior_maximum", COLUMN_REAL, ROW(interior_maximum), 0, MAX, 0},
    {"all_rms", COLUMN_REAL, ROW(all_rms), 0, MAX, 0},
    {"all_maximum", COLUMN_REAL, ROW(all_maximum), 0, MAX, 0},
    {"interior_pixels", COLUMN_COUNT, ROW(interior_pixels), 0, INT_MAX, 0},
    {"time", COLUMN_REAL, ROW(time), 0, MAX, 0},
    {"time_lower", COLUMN_REAL, ROW(time_lower), 0, MAX, 0},
    {"time_upper", COLUMN_REAL, ROW(time_upper), 0, MAX, 0},
    {"run_1", COLUMN_REAL, ROW(run_times[0]), 0, MAX, 0},
    {"run_2", COLUMN_REAL, ROW(run_times[1]), 0, MAX, 0},
    {"run_3", COLUMN_REAL, ROW(run_times[2]), 0, MAX, 0},
    {"net_time", COLUMN_REAL, ROW(net_time), -MAX, MAX,
     0}, /* a tiny one may be measured as negative */
    {"gpu_time", COLUMN_REAL, ROW(gpu_time), 0, MAX, 0},
    {"noise", COLUMN_REAL, ROW(noise), 0, MAX, 0},
    {"vertices", COLUMN_LONG_COUNT, ROW(vertices), 0, 1e15, 0},
    {"fragments", COLUMN_LONG_COUNT, ROW(fragments), 0, 1e15, 0},
    {"vertex_operations", COLUMN_COUNT, ROW(vertex_operations), 0, INT_MAX, 0},
    {"fragment_operations", COLUMN_COUNT, ROW(fragment_operations), 0, INT_MAX, 0},
    {"seed", COLUMN_SEED, ROW(seed), 0, UINT_MAX, 0},
    {"renderer", COLUMN_TEXT, ROW(renderer), 0, 0, 0},
    {"threads", COLUMN_TEXT, ROW(threads), 1, 0, 0},
};

_Static_assert(RESULT_RUNS == 3, "one column for each run");
_Static_assert(sizeof NUMBERS / sizeof NUMBERS[0] == RESULTS_NUMBERS, "all are counted");

Column column_at(int number)
{
    if (number == 0)
        return SCENE;
    if (number > AXIS_COUNT)
        return NUMBERS[number - 1 - AXIS_COUNT];
    const QualityAxis axis = (QualityAxis)(number - 1);
    return (Column){QUALITY_AXES[axis].name, COLUMN_CHOICE, 0, 0, 0, 0, axis};
}

static void real_text(double value, char text[32])
{
    text[0] = '\0';
    if (isfinite(value))
        parse_number_text(value, text);
}

void column_text(const ResultRow *row, const Column *column, char text[RESULTS_FIELD_SIZE])
{
    const void *field = (const char *)row + column->offset;
    text[0] = '\0';
    switch (column->kind) {
    case COLUMN_TEXT:
        snprintf(text, RESULTS_FIELD_SIZE, "%.*s", (int)column->size, (const char *)field);
        for (char *p = text; *p; p++) /* a line break would break the row */
            if ((unsigned char)*p < ' ' || *p == 127)
                *p = ' ';
        break;
    case COLUMN_CHOICE: {
        const QualityAxisInfo *axis = &QUALITY_AXES[column->axis];
        const int choice = row->quality.choice[column->axis];
        snprintf(text, RESULTS_FIELD_SIZE, "%s", choice < axis->count ? axis->choices[choice] : "");
        break;
    }
    case COLUMN_COUNT:
        if (*(const int *)field >= 0)
            snprintf(text, RESULTS_FIELD_SIZE, "%d", *(const int *)field);
        break;
    case COLUMN_LONG_COUNT:
        if (*(const long long *)field >= 0)
            snprintf(text, RESULTS_FIELD_SIZE, "%lld", *(const long long *)field);
        break;
    case COLUMN_SEED:
        snprintf(text, RESULTS_FIELD_SIZE, "%u", *(const unsigned *)field);
        break;
    case COLUMN_REAL:
        real_text(*(const double *)field, text);
        break;
    }
}

/* Reads a field; `*next` moves behind the comma, or is NULL after the last field. */
static bool read_field(const char **next, const char *end, char field[RESULTS_FIELD_SIZE],
                       Message *message)
{
    const char *p = *next;
    const bool quoted = p < end && *p == '"';
    size_t used = 0;
    for (p += quoted;; p++) {
        if (p == end && quoted)
            return message_set(message, "a quote does not end");
        if (quoted && *p == '"' && !(p + 1 < end && p[1] == '"'))
            break;
        if (!quoted && (p == end || *p == ','))
            break;
        if (!quoted && *p == '"')
            return message_set(message, "a quote within a field");
        if (quoted && *p == '"')
            p++;
        if (*p == '\0')
            return message_set(message, "a zero byte");
        if (used + 1 >= RESULTS_FIELD_SIZE)
            return message_set(message, "a field of more than %d characters",
                               RESULTS_FIELD_SIZE - 1);
        field[used++] = *p;
    }
    field[used] = '\0';
    p += quoted;
    if (p < end && *p != ',')
        return message_set(message, "text after a quote");
    *next = p < end ? p + 1 : NULL;
    return true;
}

static bool parse_integer(const char *text, double min, double max, long long *value)
{
    const size_t length = strlen(text);
    if (!length || length > 16 || strspn(text, "0123456789") != length)
        return false;
    *value = strtoll(text, NULL, 10);
    return (double)*value >= min && (double)*value <= max;
}

static bool parse_choice(ResultRow *row, const Column *column, const char *text, Message *message)
{
    const QualityAxisInfo *axis = &QUALITY_AXES[column->axis];
    for (int i = 0; i < axis->count; i++) {
        if (strcmp(text, axis->choices[i]) == 0) {
            row->quality.choice[column->axis] = (unsigned char)i;
            return true;
        }
    }
    return message_set(message, "%s \"%.32s\": no such choice", column->name, text);
}

static bool parse_text(void *field, const Column *column, const char *text, Message *message)
{
    const size_t length = strlen(text);
    if (length < (size_t)column->min || length >= column->size)
        return message_set(message, "%s \"%.32s\": must have %.0f to %zu characters", column->name,
                           text, column->min, column->size - 1);
    for (const char *p = text; *p; p++)
        if ((unsigned char)*p < ' ' || *p == 127)
            return message_set(message, "%s \"%.32s\": a control character", column->name, text);
    /* A scene's name becomes part of a file name. */
    if (column->offset == SCENE.offset && !(text[0] != '.' && !strchr(text, '/')))
        return message_set(message, "%s \"%.32s\": must not begin with . or hold /", column->name,
                           text);
    memcpy(field, text, length + 1);
    return true;
}

static bool parse_value(ResultRow *row, const Column *column, const char *text, Message *message)
{
    void *field = (char *)row + column->offset;
    long long count = -1;
    double real = NAN;
    if (column->kind == COLUMN_TEXT)
        return parse_text(field, column, text, message);
    if (column->kind == COLUMN_CHOICE)
        return parse_choice(row, column, text, message);
    const bool unknown = !text[0] && column->kind != COLUMN_SEED && column->min < 1;
    if (!unknown &&
        !(column->kind == COLUMN_REAL ? parse_number(text, column->min, column->max, &real)
                                      : parse_integer(text, column->min, column->max, &count)))
        return message_set(message, "%s \"%.32s\": must be a %snumber from %.0f to %.0f",
                           column->name, text, column->kind == COLUMN_REAL ? "" : "whole ",
                           column->min, column->max);
    if (column->kind == COLUMN_COUNT)
        *(int *)field = (int)count;
    else if (column->kind == COLUMN_LONG_COUNT)
        *(long long *)field = count;
    else if (column->kind == COLUMN_SEED)
        *(unsigned *)field = (unsigned)count;
    else
        *(double *)field = real;
    return true;
}

static bool parse_fields(ResultRow *row, const char *line, const char *end, Message *message)
{
    const char *next = line;
    for (int i = 0; i < RESULTS_COLUMNS; i++) {
        char field[RESULTS_FIELD_SIZE];
        const Column column = column_at(i);
        if (!next)
            return message_set(message, "only %d of %d fields", i, RESULTS_COLUMNS);
        if (!read_field(&next, end, field, message) || !parse_value(row, &column, field, message))
            return false;
    }
    return !next || message_set(message, "more than %d fields", RESULTS_COLUMNS);
}

bool row_parse(ResultRow *row, const char *line, const char *end, Message *message)
{
    *row = (ResultRow){.seed = 0};
    const bool done = parse_fields(row, line, end, message);
    for (char *p = message->text; *p; p++) /* the file may hold anything */
        if ((unsigned char)*p < ' ' || (unsigned char)*p > 126)
            *p = '?';
    return done;
}

void header_text(char text[RESULTS_HEADER_SIZE])
{
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < RESULTS_COLUMNS && used < RESULTS_HEADER_SIZE; i++)
        used += (size_t)snprintf(text + used, RESULTS_HEADER_SIZE - used, "%s%s", i ? "," : "",
                                 column_at(i).name);
}
