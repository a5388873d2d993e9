#include "base/json_writer.h"

#include "base/text.h"

#include <math.h>

static void put_string(FILE *file, const char *text)
{
    fputc('"', file);
    while (*text) {
        const int size = text_character(text);
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

static void new_line(const JsonWriter *json)
{
    fprintf(json->file, "\n%*s", 2 * json->depth, "");
}

/* What comes before an item's value. */
static void begin_item(JsonWriter *json, const char *name)
{
    const bool line = json->depth && json->depth <= json->lines;
    if (json->filled)
        fputs(line ? "," : ", ", json->file);
    if (line)
        new_line(json);
    json->filled = true;
    if (!name)
        return;
    put_string(json->file, name);
    fputs(": ", json->file);
}

static void open_items(JsonWriter *json, const char *name, char begin, char end)
{
    begin_item(json, name);
    fputc(begin, json->file);
    json->ends[json->depth++] = end;
    json->filled = false;
}

void json_write_object(JsonWriter *json, const char *name)
{
    open_items(json, name, '{', '}');
}

void json_write_list(JsonWriter *json, const char *name)
{
    open_items(json, name, '[', ']');
}

void json_write_end(JsonWriter *json)
{
    json->depth--;
    if (json->filled && json->depth < json->lines)
        new_line(json);
    fputc(json->ends[json->depth], json->file);
    json->filled = true;
    if (json->depth == 0 && json->lines)
        fputc('\n', json->file);
}

void json_write_value(JsonWriter *json, const char *name, const char *value)
{
    begin_item(json, name);
    fputs(value[0] ? value : "null", json->file);
}

void json_write_text(JsonWriter *json, const char *name, const char *text)
{
    begin_item(json, name);
    if (text)
        put_string(json->file, text);
    else
        fputs("null", json->file);
}

void json_write_number(JsonWriter *json, const char *name, double value)
{
    char text[32] = "";
    if (isfinite(value))
        snprintf(text, sizeof text, "%.9g", value);
    json_write_value(json, name, text);
}

void json_write_whole(JsonWriter *json, const char *name, long long value)
{
    begin_item(json, name);
    fprintf(json->file, "%lld", value);
}

void json_write_flag(JsonWriter *json, const char *name, bool value)
{
    json_write_value(json, name, value ? "true" : "false");
}
