#include "base/json_writer.h"
#include "base/output_text.h"
#include "study/results/results.h"

static void put_value(JsonWriter *json, const ResultRow *row, const Column *column)
{
    char text[RESULTS_FIELD_SIZE];
    column_text(row, column, text);
    if (column->kind == COLUMN_TEXT || column->kind == COLUMN_CHOICE)
        json_write_text(json, column->name, text);
    else
        json_write_value(json, column->name, text);
}

static void put_row(JsonWriter *json, const ResultRow *row)
{
    json_write_object(json, NULL);
    json_write_object(json, "setting");
    for (int i = 0; i < RESULTS_COLUMNS; i++) {
        const Column column = column_at(i);
        if (column.kind == COLUMN_CHOICE)
            put_value(json, row, &column);
    }
    json_write_end(json);
    for (int i = 0; i < RESULTS_COLUMNS; i++) {
        const Column column = column_at(i);
        if (column.kind != COLUMN_CHOICE)
            put_value(json, row, &column);
    }
    json_write_end(json);
}

bool results_write_json(const Results *results, const char *path, Message *message)
{
    OutputText text;
    output_text_open(&text);
    JsonWriter json = {.file = text.file, .lines = 2};
    json_write_object(&json, NULL);
    json_write_object(&json, "units");
    json_write_text(&json, "errors", "steps of 1/255");
    json_write_text(&json, "times", "milliseconds");
    json_write_text(&json, "noise", "a fraction of the time");
    json_write_end(&json);
    /* The axes, their choices and the usual one. */
    json_write_object(&json, "axes");
    for (int axis = 0; axis < AXIS_COUNT; axis++) {
        const QualityAxisInfo *info = &QUALITY_AXES[axis];
        json_write_object(&json, info->name);
        json_write_text(&json, "usual", info->choices[info->usual]);
        json_write_list(&json, "choices");
        for (int i = 0; i < info->count; i++)
            json_write_text(&json, NULL, info->choices[i]);
        json_write_end(&json);
        json_write_end(&json);
    }
    json_write_end(&json);
    json_write_list(&json, "rows");
    for (int i = 0; i < results->count; i++)
        put_row(&json, &results->rows[i]);
    json_write_end(&json);
    json_write_end(&json);
    return output_text_write(&text, path, message);
}
