#include "results_row.h"

#include "output.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* How many bytes of `text` are one character of UTF-8 (RFC 3629); 0 where they are none. */
static int character_size(const unsigned char *text)
{
    static const struct {
        unsigned char least, most, second_least, second_most;
        int size;
    } kinds[] = {
        {0x01, 0x7F, 0, 0, 1},       {0xC2, 0xDF, 0x80, 0xBF, 2}, {0xE0, 0xE0, 0xA0, 0xBF, 3},
        {0xE1, 0xEC, 0x80, 0xBF, 3}, {0xED, 0xED, 0x80, 0x9F, 3}, {0xEE, 0xEF, 0x80, 0xBF, 3},
        {0xF0, 0xF0, 0x90, 0xBF, 4}, {0xF1, 0xF3, 0x80, 0xBF, 4}, {0xF4, 0xF4, 0x80, 0x8F, 4}};
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (text[0] < kinds[i].least || text[0] > kinds[i].most)
            continue;
        if (kinds[i].size > 1 &&
            (text[1] < kinds[i].second_least || text[1] > kinds[i].second_most))
            return 0;
        for (int j = 2; j < kinds[i].size; j++)
            if ((text[j] & 0xC0) != 0x80)
                return 0;
        return kinds[i].size;
    }
    return 0;
}

static void put_string(FILE *file, const char *text)
{
    fputc('"', file);
    while (*text) {
        const int size = character_size((const unsigned char *)text);
        if (size == 0)
            fputs("\\ufffd", file);
        else if (*text == '"' || *text == '\\')
            fprintf(file, "\\%c", *text);
        else if ((unsigned char)*text < ' ')
            fprintf(file, "\\u%04x", (unsigned)*text);
        else
            fwrite(text, 1, (size_t)size, file);
        text += size ? size : 1;
    }
    fputc('"', file);
}

static void put_value(FILE *file, const ResultRow *row, const Column *column)
{
    char text[RESULTS_FIELD_SIZE];
    column_text(row, column, text);
    put_string(file, column->name);
    fputs(": ", file);
    if (column->kind == COLUMN_TEXT || column->kind == COLUMN_CHOICE)
        put_string(file, text);
    else
        fputs(text[0] ? text : "null", file);
}

static void put_row(FILE *file, const ResultRow *row)
{
    fputs("    {\"setting\": {", file);
    for (int i = 0, count = 0; i < RESULTS_COLUMNS; i++) {
        const Column column = column_at(i);
        if (column.kind != COLUMN_CHOICE)
            continue;
        fputs(count++ ? ", " : "", file);
        put_value(file, row, &column);
    }
    fputs("}", file);
    for (int i = 0; i < RESULTS_COLUMNS; i++) {
        const Column column = column_at(i);
        if (column.kind == COLUMN_CHOICE)
            continue;
        fputs(", ", file);
        put_value(file, row, &column);
    }
    fputs("}", file);
}

/* What there is to choose, by axis; the usual choices. */
static void put_axes(FILE *file)
{
    fputs("  \"axes\": {\n", file);
    for (int axis = 0; axis < AXIS_COUNT; axis++) {
        const SettingAxisInfo *info = &SETTING_AXES[axis];
        fputs("    ", file);
        put_string(file, info->name);
        fputs(": {\"usual\": ", file);
        put_string(file, info->choices[info->usual]);
        fputs(", \"choices\": [", file);
        for (int i = 0; i < info->count; i++) {
            fputs(i ? ", " : "", file);
            put_string(file, info->choices[i]);
        }
        fprintf(file, "]}%s\n", axis + 1 < AXIS_COUNT ? "," : "");
    }
    fputs("  },\n", file);
}

bool results_write_json(const Results *results, const char *path, Message *message)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return message_set(message, "%s: %s", path, strerror(errno));
    fputs("{\n"
          "  \"units\": {\"errors\": \"steps of 1/255\", \"times\": \"milliseconds\", "
          "\"noise\": \"a fraction of the time\"},\n",
          file);
    put_axes(file);
    fputs("  \"rows\": [", file);
    for (int i = 0; i < results->count; i++) {
        fputs(i ? ",\n" : "\n", file);
        put_row(file, &results->rows[i]);
    }
    fputs(results->count ? "\n  ]\n}\n" : "]\n}\n", file);
    const bool failed = ferror(file) != 0;
    bool done = fclose(file) == 0 && !failed;
    if (!done)
        message_set(message, "%s: %s", path, strerror(ENOMEM));
    done = done && output_write(path, text, size, message);
    free(text);
    return done;
}
