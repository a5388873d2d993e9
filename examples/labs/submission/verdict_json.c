/* The reader trusts nothing: every member is there, of its type and in its range, or the whole is
 * refused. The tables are the writer's. */
#include "labs/submission/verdict_json.h"

#include "base/output_text.h"
#include "base/text.h"
#include "labs/submission/verdict_fields.h"

#include <math.h>
#include <string.h>

void verdict_clean(char *text, size_t size, const char *from, bool lines)
{
    size_t length = 0;
    const unsigned char *at = (const unsigned char *)from;
    while (*at) {
        const int character = text_character((const char *)at);
        const size_t count = character ? (size_t)character : 1;
        if (text_turns_direction((const char *)at)) {
            at += count;
            continue;
        }
        if (length + count >= size)
            break;
        const bool control = *at < ' ' || *at == 0x7F;
        if (control && !(lines && *at == '\n'))
            text[length] = ' ';
        else
            memcpy(text + length, at, count);
        length += count;
        at += count;
    }
    text[length] = '\0';
}

bool verdict_text(const json_t *object, const char *name, char *text, size_t size, Message *message)
{
    const json_t *value = json_object_get(object, name);
    if (!json_is_string(value))
        return message_set(message, "\"%s\": must be a text", name);
    verdict_clean(text, size, json_string_value(value), false);
    return true;
}

static bool to_number(const json_t *value, const char *name, double min, double max, double *number,
                      Message *message)
{
    if (!json_is_number(value))
        return message_set(message, "\"%s\": must be a number", name);
    *number = json_number_value(value);
    if (!(*number >= min && *number <= max))
        return message_set(message, "\"%s\": must be %g to %g", name, min, max);
    return true;
}

bool verdict_number(const json_t *object, const char *name, double min, double max, double *number,
                    Message *message)
{
    return to_number(json_object_get(object, name), name, min, max, number, message);
}

static bool read_fields(const json_t *object, const Field *fields, char *record, Message *message);

static bool read_list(const json_t *list, const Field *field, char *record, Message *message)
{
    if (!json_is_array(list) || (double)json_array_size(list) > field->max)
        return message_set(message, "\"%s\": must be a list of at most %g", field->name,
                           field->max);
    const int count = (int)json_array_size(list);
    for (int i = 0; i < count; i++)
        if (!read_fields(json_array_get(list, (size_t)i), field->items,
                         record + field->offset + (size_t)i * field->item_size, message))
            return false;
    *(int *)(record + field->count) = count;
    return true;
}

static bool read_field(const json_t *value, const Field *field, char *record, Message *message)
{
    void *at = record + field->offset;
    const char *name = field->name ? field->name : "symptoms";
    const int choice = field->choices ? text_among(json_string_value(value), field->choices) : 0;
    double number = 0;
    if (choice < 0)
        return message_set(message, "\"%s\": is none of the known values", name);
    switch (field->kind) {
    case FIELD_TEXT:
    case FIELD_LINES:
        if (!json_is_string(value))
            return message_set(message, "\"%s\": must be a text", name);
        verdict_clean(at, (size_t)field->max, json_string_value(value), field->kind == FIELD_LINES);
        return true;
    case FIELD_ERROR:
        *(double *)at = INFINITY;
        return json_is_null(value) || to_number(value, name, field->min, field->max, at, message);
    case FIELD_NUMBER:
        return to_number(value, name, field->min, field->max, at, message);
    case FIELD_WHOLE:
        if (!to_number(value, name, field->min, field->max, &number, message))
            return false;
        *(int *)at = (int)number;
        return true;
    case FIELD_CHOICE:
        *(int *)at = choice;
        return true;
    case FIELD_LIST:
        return read_list(value, field, record, message);
    default: /* FIELD_FLAG */
        *(bool *)at = field->choices ? choice == 1 : json_is_true(value);
        return field->choices || json_is_boolean(value) ||
               message_set(message, "\"%s\": must be true or false", name);
    }
}

static bool read_fields(const json_t *object, const Field *fields, char *record, Message *message)
{
    for (const Field *field = fields; (int)field->kind >= 0; field++) {
        const json_t *value = field->name ? json_object_get(object, field->name) : object;
        if (!(field->optional && !value) && !read_field(value, field, record, message))
            return false;
    }
    return true;
}

static bool read_cost(const json_t *object, VerdictCost *cost, Message *message)
{
    const json_t *from = json_object_get(object, "cost");
    if (json_is_null(from))
        return true;
    if (!json_is_object(from))
        return message_set(message, "\"cost\": must be an object or null");
    cost->known = read_fields(from, VERDICT_COST_FIELDS, (char *)cost, message);
    return cost->known;
}

/* A plain file name: safe in shells, pages and file systems. */
static bool read_picture(const json_t *object, char picture[64], Message *message)
{
    static const char allowed[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    const json_t *list = json_object_get(object, "pictures");
    if (json_is_array(list) && json_array_size(list) == 0)
        return true;
    const char *name = json_string_value(json_array_get(list, 0));
    const size_t length = name ? strspn(name, allowed) : 0;
    if (json_array_size(list) != 1 || length == 0 || length > 50 ||
        strcmp(name + length, ".png") != 0)
        return message_set(message, "\"pictures\": must be a list of at most one, like worst.png");
    memcpy(picture, name, length + sizeof ".png");
    return true;
}

bool verdict_from_json(const json_t *object, char lab[64], Verdict *verdict, Message *message)
{
    double seed = 0;
    *verdict = (Verdict){.points = 0};
    if (!json_is_object(object))
        return message_set(message, "must be an object");
    if (!verdict_text(object, "lab", lab, 64, message) ||
        !verdict_number(object, "seed", 0, 9007199254740992.0, &seed, message) ||
        !verdict_number(object, "most", 1, VERDICT_POINTS_END, &verdict->most, message) ||
        !read_fields(object, VERDICT_FIELDS, (char *)verdict, message))
        return false;
    verdict->seed = (uint64_t)seed;
    if (verdict->points > verdict->most)
        return message_set(message, "\"points\": must be 0 to %g", verdict->most);
    return read_picture(object, verdict->picture, message) &&
           read_cost(object, &verdict->cost, message);
}

bool verdict_read(const void *bytes, size_t size, char lab[64], Verdict *verdict, Message *message)
{
    json_error_t error;
    if (size > VERDICT_JSON_MAX)
        return message_set(message, "%zu bytes; at most %d", size, VERDICT_JSON_MAX);
    json_t *object = json_loadb(bytes, size, JSON_REJECT_DUPLICATES, &error);
    if (!object)
        return message_set(message, "line %d: %s", error.line, error.text);
    const bool done = verdict_from_json(object, lab, verdict, message);
    json_decref(object);
    return done;
}

bool verdict_write(const Verdict *verdict, const Lab *lab, const char *submission, const char *path,
                   Message *message)
{
    OutputText out;
    output_text_open(&out);
    JsonWriter json = {.file = out.file, .lines = 2};
    json_write_object(&json, NULL);
    verdict_put(&json, verdict, lab->name);
    json_write_text(&json, "path", submission);
    json_write_text(&json, "student", NULL);
    json_write_end(&json);
    return output_text_write(&out, path, message);
}
