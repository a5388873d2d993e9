/* The one writer of verdicts, natively and in a page, for which a JSON library is too large. */
#include "labs/submission/verdict_fields.h"

static const char *const SETS[] = {"seed", "known", NULL};

#define SIZE(type, member) sizeof(((type *)0)->member)
#define AT(type, member) .offset = offsetof(type, member)
#define TEXT(type, member)                                                                         \
    {                                                                                              \
        .name = #member, .kind = FIELD_TEXT, AT(type, member), .max = SIZE(type, member)           \
    }
#define LINES(type, member)                                                                        \
    {                                                                                              \
        .name = #member, .kind = FIELD_LINES, AT(type, member), .max = SIZE(type, member)          \
    }
#define WHOLE(type, member)                                                                        \
    {                                                                                              \
        .name = #member, .kind = FIELD_WHOLE, AT(type, member), .max = 1 << 20                     \
    }
#define NUMBER(type, member, low, high)                                                            \
    {                                                                                              \
        .name = #member, .kind = FIELD_NUMBER, AT(type, member), .min = low, .max = high           \
    }
#define LIST(name_, list, number, fields, may_lack)                                                \
    {                                                                                              \
        .name = name_, .kind = FIELD_LIST, AT(Verdict, list),                                      \
        .max = (double)(SIZE(Verdict, list) / SIZE(Verdict, list[0])), .items = fields,            \
        .item_size = SIZE(Verdict, list[0]), .count = offsetof(Verdict, number),                   \
        .optional = may_lack                                                                       \
    }

static const Field MISTAKE[] = {
    TEXT(VerdictMistake, name),    TEXT(VerdictMistake, sentence),
    TEXT(VerdictMistake, look),    NUMBER(VerdictMistake, sure, 0, 1),
    TEXT(VerdictMistake, file),    WHOLE(VerdictMistake, line),
    WHOLE(VerdictMistake, column), LINES(VerdictMistake, text),
    TEXT(VerdictMistake, change),  FIELD_END,
};

static const Field SYMPTOM[] = {{.kind = FIELD_TEXT, .max = VERDICT_SENTENCE_SIZE}, FIELD_END};

static const Field PROBE[] = {
    TEXT(VerdictProbe, name),
    {.name = "set", .kind = FIELD_FLAG, AT(VerdictProbe, known), .choices = SETS},
    WHOLE(VerdictProbe, width),
    WHOLE(VerdictProbe, height),
    NUMBER(VerdictProbe, seconds, -1e9, 1e9),
    {.name = "maximum", .kind = FIELD_ERROR, AT(VerdictProbe, maximum), .max = 1e9},
    {.name = "rms", .kind = FIELD_ERROR, AT(VerdictProbe, rms), .max = 1e9},
    {.name = "passed", .kind = FIELD_FLAG, AT(VerdictProbe, passed)},
    FIELD_END,
};

static const Field PART[] = {
    TEXT(VerdictPart, name),
    NUMBER(VerdictPart, points, -VERDICT_POINTS_END, VERDICT_POINTS_END),
    NUMBER(VerdictPart, most, 0, VERDICT_POINTS_END),
    {.name = "state", .kind = FIELD_CHOICE, AT(VerdictPart, state), .choices = PART_NAMES},
    FIELD_END,
};

const Field VERDICT_FIELDS[] = {
    NUMBER(Verdict, points, 0, VERDICT_POINTS_END),
    LIST("parts", parts, part_count, PART, true),
    {.name = "verdict", .kind = FIELD_CHOICE, AT(Verdict, kind), .choices = VERDICT_NAMES},
    TEXT(Verdict, message),
    LINES(Verdict, details),
    LIST("mistakes", mistakes, mistake_count, MISTAKE, false),
    LIST("symptoms", symptoms, symptom_count, SYMPTOM, false),
    LIST("probes", probes, probe_count, PROBE, false),
    NUMBER(Verdict, seconds, 0, 1e9),
    FIELD_END,
};

const Field VERDICT_COST_FIELDS[] = {
    NUMBER(VerdictCost, error, 0, 1e9),
    NUMBER(VerdictCost, time_ratio, 0, 1e9),
    NUMBER(VerdictCost, operations, 0, 1e15),
    NUMBER(VerdictCost, operations_ratio, 0, 1e9),
    FIELD_END,
};

static void put_fields(JsonWriter *json, const Field *fields, const void *record);

static void put_list(JsonWriter *json, const Field *field, const char *record)
{
    const int count = *(const int *)(record + field->count);
    const bool named = field->items->name != NULL;
    json_write_list(json, field->name);
    for (int i = 0; i < count; i++) {
        if (named)
            json_write_object(json, NULL);
        put_fields(json, field->items, record + field->offset + (size_t)i * field->item_size);
        if (named)
            json_write_end(json);
    }
    json_write_end(json);
}

static void put_field(JsonWriter *json, const Field *field, const char *record)
{
    const void *at = record + field->offset;
    const int number = field->kind == FIELD_FLAG ? *(const bool *)at
                       : field->kind == FIELD_CHOICE || field->kind == FIELD_WHOLE
                           ? *(const int *)at
                           : 0;
    if (field->kind == FIELD_TEXT || field->kind == FIELD_LINES)
        json_write_text(json, field->name, at);
    else if (field->kind == FIELD_NUMBER || field->kind == FIELD_ERROR)
        json_write_number(json, field->name, *(const double *)at);
    else if (field->kind == FIELD_LIST)
        put_list(json, field, record);
    else if (field->choices)
        json_write_text(json, field->name, field->choices[number]);
    else if (field->kind == FIELD_FLAG)
        json_write_flag(json, field->name, number);
    else
        json_write_whole(json, field->name, number);
}

static void put_fields(JsonWriter *json, const Field *fields, const void *record)
{
    for (const Field *field = fields; (int)field->kind >= 0; field++)
        if (!field->optional || *(const int *)((const char *)record + field->count) > 0)
            put_field(json, field, record);
}

static void put_cost(JsonWriter *json, const VerdictCost *cost)
{
    if (!cost->known) {
        json_write_text(json, "cost", NULL);
        return;
    }
    json_write_object(json, "cost");
    put_fields(json, VERDICT_COST_FIELDS, cost);
    json_write_end(json);
}

void verdict_put(JsonWriter *json, const Verdict *verdict, const char *lab)
{
    char seed[24];
    snprintf(seed, sizeof seed, "%llu", (unsigned long long)verdict->seed);
    json_write_text(json, "lab", lab);
    json_write_value(json, "seed", seed);
    json_write_number(json, "most", verdict->most);
    put_fields(json, VERDICT_FIELDS, verdict);
    json_write_list(json, "pictures");
    if (verdict->picture[0])
        json_write_text(json, NULL, verdict->picture);
    json_write_end(json);
    put_cost(json, &verdict->cost);
}
