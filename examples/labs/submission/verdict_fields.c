/* The one writer of verdicts, natively and in a page, for which a JSON library is too large. */
#include "labs/submission/verdict_fields.h"

#include "study/results/json.h"

#include <math.h>

static const char *const SETS[] = {"seed", "known", NULL};

#define SIZE(type, member) sizeof(((type *)0)->member)
#define AT(type, member) .offset = offsetof(type, member)
#define TEXT(type, member)                                                                         \
    {                                                                                              \
        .name = #member, .kind = FIELD_TEXT, AT(type, member), .max = SIZE(type, member)           \
    }
#define NUMBER(type, member, low, high)                                                            \
    {                                                                                              \
        .name = #member, .kind = FIELD_NUMBER, AT(type, member), .min = low, .max = high           \
    }
#define LIST(name_, list, number, fields)                                                          \
    {                                                                                              \
        .name = name_, .kind = FIELD_LIST, AT(Verdict, list),                                      \
        .max = (double)(SIZE(Verdict, list) / SIZE(Verdict, list[0])), .items = fields,            \
        .item_size = SIZE(Verdict, list[0]), .count = offsetof(Verdict, number)                    \
    }

static const Field MISTAKE[] = {
    TEXT(VerdictMistake, name),
    TEXT(VerdictMistake, sentence),
    TEXT(VerdictMistake, look),
    NUMBER(VerdictMistake, sure, 0, 1),
    FIELD_END,
};

static const Field SYMPTOM[] = {{.kind = FIELD_TEXT, .max = VERDICT_SENTENCE_SIZE}, FIELD_END};

static const Field PROBE[] = {
    TEXT(VerdictProbe, name),
    {.name = "set", .kind = FIELD_FLAG, AT(VerdictProbe, known), .choices = SETS},
    {.name = "width", .kind = FIELD_WHOLE, AT(VerdictProbe, width), .max = 16384},
    {.name = "height", .kind = FIELD_WHOLE, AT(VerdictProbe, height), .max = 16384},
    NUMBER(VerdictProbe, seconds, -1e9, 1e9),
    {.name = "maximum", .kind = FIELD_ERROR, AT(VerdictProbe, maximum), .max = 1e9},
    {.name = "rms", .kind = FIELD_ERROR, AT(VerdictProbe, rms), .max = 1e9},
    {.name = "passed", .kind = FIELD_FLAG, AT(VerdictProbe, passed)},
    FIELD_END,
};

const Field VERDICT_FIELDS[] = {
    NUMBER(Verdict, points, 0, VERDICT_MAX_POINTS),
    {.name = "verdict", .kind = FIELD_CHOICE, AT(Verdict, kind), .choices = VERDICT_NAMES},
    TEXT(Verdict, message),
    {.name = "details", .kind = FIELD_LINES, AT(Verdict, details), .max = VERDICT_DETAILS_SIZE},
    LIST("mistakes", mistakes, mistake_count, MISTAKE),
    {.name = "one_of", .kind = FIELD_FLAG, AT(Verdict, one_of)},
    LIST("symptoms", symptoms, symptom_count, SYMPTOM),
    LIST("probes", probes, probe_count, PROBE),
    NUMBER(Verdict, seconds, 0, 1e9),
    FIELD_END,
};

const Field VERDICT_COST_FIELDS[] = {
    NUMBER(VerdictCost, error, 0, 1e9),
    NUMBER(VerdictCost, time_ratio, 0, 1e9),
    FIELD_END,
};

static void put_fields(FILE *file, const Field *fields, const void *record, const char *between);

/* JSON has neither infinities nor NaN. */
static void put_number(FILE *file, double number)
{
    if (isfinite(number))
        fprintf(file, "%.9g", number);
    else
        fputs("null", file);
}

static void put_list(FILE *file, const Field *field, const char *record)
{
    const int count = *(const int *)(record + field->count);
    fputc('[', file);
    for (int i = 0; i < count; i++) {
        const char *item = record + field->offset + (size_t)i * field->item_size;
        const bool named = field->items->name != NULL;
        fprintf(file, "%s\n    %s", i ? "," : "", named ? "{" : "");
        put_fields(file, field->items, item, ", ");
        fputs(named ? "}" : "", file);
    }
    fputc(']', file);
}

static void put_field(FILE *file, const Field *field, const char *record)
{
    const void *at = record + field->offset;
    const int number = field->kind == FIELD_FLAG ? *(const bool *)at
                       : field->kind == FIELD_CHOICE || field->kind == FIELD_WHOLE
                           ? *(const int *)at
                           : 0;
    if (field->kind == FIELD_TEXT || field->kind == FIELD_LINES)
        json_put_string(file, at);
    else if (field->kind == FIELD_NUMBER || field->kind == FIELD_ERROR)
        put_number(file, *(const double *)at);
    else if (field->kind == FIELD_LIST)
        put_list(file, field, record);
    else if (field->choices)
        json_put_string(file, field->choices[number]);
    else if (field->kind == FIELD_FLAG)
        fputs(number ? "true" : "false", file);
    else
        fprintf(file, "%d", number);
}

static void put_fields(FILE *file, const Field *fields, const void *record, const char *between)
{
    for (const Field *field = fields; (int)field->kind >= 0; field++) {
        fputs(field == fields ? "" : between, file);
        if (field->name)
            fprintf(file, "\"%s\": ", field->name);
        put_field(file, field, record);
    }
}

static void put_cost(FILE *file, const VerdictCost *cost)
{
    if (!cost->known) {
        fputs("null", file);
        return;
    }
    fputc('{', file);
    put_fields(file, VERDICT_COST_FIELDS, cost, ", ");
    if (cost->operations >= 0)
        fprintf(file, ", \"operations\": %ld, \"operations_ratio\": ", cost->operations);
    else
        fputs(", \"operations\": null, \"operations_ratio\": ", file);
    put_number(file, cost->operations >= 0 ? cost->operations_ratio : NAN);
    fputc('}', file);
}

void verdict_put(FILE *file, const Verdict *verdict, const char *lab)
{
    fputs("\"lab\": ", file);
    json_put_string(file, lab);
    fprintf(file, ",\n  \"seed\": %llu,\n  \"most\": %d,\n  ", (unsigned long long)verdict->seed,
            VERDICT_MAX_POINTS);
    put_fields(file, VERDICT_FIELDS, verdict, ",\n  ");
    fputs(",\n  \"pictures\": [", file);
    if (verdict->picture[0])
        json_put_string(file, verdict->picture);
    fputs("],\n  \"cost\": ", file);
    put_cost(file, &verdict->cost);
}
