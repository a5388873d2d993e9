#include "base/output_text.h"
#include "study/results/json.h"
#include "study/results/results.h"

static void put_value(FILE *file, const ResultRow *row, const Column *column)
{
    char text[RESULTS_FIELD_SIZE];
    column_text(row, column, text);
    json_put_string(file, column->name);
    fputs(": ", file);
    if (column->kind == COLUMN_TEXT || column->kind == COLUMN_CHOICE)
        json_put_string(file, text);
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

/* The axes, their choices and the usual one. */
static void put_axes(FILE *file)
{
    fputs("  \"axes\": {\n", file);
    for (int axis = 0; axis < AXIS_COUNT; axis++) {
        const QualityAxisInfo *info = &QUALITY_AXES[axis];
        fputs("    ", file);
        json_put_string(file, info->name);
        fputs(": {\"usual\": ", file);
        json_put_string(file, info->choices[info->usual]);
        fputs(", \"choices\": [", file);
        for (int i = 0; i < info->count; i++) {
            fputs(i ? ", " : "", file);
            json_put_string(file, info->choices[i]);
        }
        fprintf(file, "]}%s\n", axis + 1 < AXIS_COUNT ? "," : "");
    }
    fputs("  },\n", file);
}

bool results_write_json(const Results *results, const char *path, Message *message)
{
    OutputText text;
    output_text_open(&text);
    fputs("{\n"
          "  \"units\": {\"errors\": \"steps of 1/255\", \"times\": \"milliseconds\", "
          "\"noise\": \"a fraction of the time\"},\n",
          text.file);
    put_axes(text.file);
    fputs("  \"rows\": [", text.file);
    for (int i = 0; i < results->count; i++) {
        fputs(i ? ",\n" : "\n", text.file);
        put_row(text.file, &results->rows[i]);
    }
    fputs(results->count ? "\n  ]\n}\n" : "]\n}\n", text.file);
    return output_text_write(&text, path, message);
}
