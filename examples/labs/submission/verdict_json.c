#include "labs/submission/verdict_json.h"

#include "base/output.h"
#include "study/results/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* U+202A to U+202E and U+2066 to U+2069, which reorder the characters of a line. */
static bool turns_direction(const unsigned char *at)
{
    return at[0] == 0xE2 && ((at[1] == 0x80 && at[2] >= 0xAA && at[2] <= 0xAE) ||
                             (at[1] == 0x81 && at[2] >= 0xA6 && at[2] <= 0xA9));
}

static size_t character_size(unsigned char first)
{
    return first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
}

void verdict_clean(char *text, size_t size, const char *from, bool lines)
{
    size_t length = 0;
    const unsigned char *at = (const unsigned char *)from;
    while (*at) {
        const size_t count = strnlen((const char *)at, character_size(*at));
        if (turns_direction(at)) {
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

static bool read_text(const json_t *object, const char *name, char *text, size_t size, bool lines,
                      Message *message)
{
    const json_t *value = json_object_get(object, name);
    if (!json_is_string(value))
        return message_set(message, "\"%s\": must be a text", name);
    verdict_clean(text, size, json_string_value(value), lines);
    return true;
}

bool verdict_text(const json_t *object, const char *name, char *text, size_t size, Message *message)
{
    return read_text(object, name, text, size, false, message);
}

bool verdict_number(const json_t *object, const char *name, double min, double max, double *number,
                    Message *message)
{
    const json_t *value = json_object_get(object, name);
    if (!json_is_number(value))
        return message_set(message, "\"%s\": must be a number", name);
    *number = json_number_value(value);
    if (!(*number >= min && *number <= max))
        return message_set(message, "\"%s\": must be %g to %g", name, min, max);
    return true;
}

/* null is infinite. */
static bool read_error(const json_t *object, const char *name, double *number, Message *message)
{
    if (json_is_null(json_object_get(object, name))) {
        *number = INFINITY;
        return true;
    }
    return verdict_number(object, name, 0, 1e9, number, message);
}

static bool read_whole(const json_t *object, const char *name, int max, int *number,
                       Message *message)
{
    double value;
    if (!verdict_number(object, name, 0, max, &value, message))
        return false;
    *number = (int)value;
    return true;
}

static bool read_flag(const json_t *object, const char *name, bool *flag, Message *message)
{
    const json_t *value = json_object_get(object, name);
    *flag = json_is_true(value);
    return json_is_boolean(value) ? true
                                  : message_set(message, "\"%s\": must be true or false", name);
}

static bool read_choice(const json_t *object, const char *name, const char *const *choices,
                        int *choice, Message *message)
{
    const char *text = json_string_value(json_object_get(object, name));
    for (*choice = 0; text && choices[*choice]; ++*choice)
        if (strcmp(text, choices[*choice]) == 0)
            return true;
    return message_set(message, "\"%s\": is none of the known values", name);
}

/* A list and its length. */
static bool read_list(const json_t *object, const char *name, int max, const json_t **list,
                      int *count, Message *message)
{
    *list = json_object_get(object, name);
    if (!json_is_array(*list) || json_array_size(*list) > (size_t)max)
        return message_set(message, "\"%s\": must be a list of at most %d", name, max);
    *count = (int)json_array_size(*list);
    return true;
}

static bool read_mistakes(const json_t *object, Verdict *verdict, Message *message)
{
    const json_t *list;
    if (!read_list(object, "mistakes", VERDICT_MAX_MISTAKES, &list, &verdict->mistake_count,
                   message))
        return false;
    for (int i = 0; i < verdict->mistake_count; i++) {
        const json_t *from = json_array_get(list, (size_t)i);
        VerdictMistake *mistake = &verdict->mistakes[i];
        if (!verdict_text(from, "name", mistake->name, sizeof mistake->name, message) ||
            !verdict_text(from, "sentence", mistake->sentence, sizeof mistake->sentence, message) ||
            !verdict_text(from, "look", mistake->look, sizeof mistake->look, message) ||
            !verdict_number(from, "sure", 0, 1, &mistake->sure, message))
            return false;
    }
    return true;
}

static bool read_symptoms(const json_t *object, Verdict *verdict, Message *message)
{
    const json_t *list;
    if (!read_list(object, "symptoms", VERDICT_MAX_SYMPTOMS, &list, &verdict->symptom_count,
                   message))
        return false;
    for (int i = 0; i < verdict->symptom_count; i++) {
        const json_t *text = json_array_get(list, (size_t)i);
        if (!json_is_string(text))
            return message_set(message, "\"symptoms\": must be texts");
        verdict_clean(verdict->symptoms[i], sizeof verdict->symptoms[i], json_string_value(text),
                      false);
    }
    return true;
}

static bool read_probes(const json_t *object, Verdict *verdict, Message *message)
{
    static const char *const sets[] = {"seed", "known", NULL};
    const json_t *list;
    if (!read_list(object, "probes", VERDICT_MAX_PROBES, &list, &verdict->probe_count, message))
        return false;
    for (int i = 0; i < verdict->probe_count; i++) {
        const json_t *from = json_array_get(list, (size_t)i);
        VerdictProbe *probe = &verdict->probes[i];
        int set;
        if (!verdict_text(from, "name", probe->name, sizeof probe->name, message) ||
            !read_choice(from, "set", sets, &set, message) ||
            !read_whole(from, "width", 16384, &probe->width, message) ||
            !read_whole(from, "height", 16384, &probe->height, message) ||
            !verdict_number(from, "seconds", -1e9, 1e9, &probe->seconds, message) ||
            !read_error(from, "maximum", &probe->maximum, message) ||
            !read_error(from, "rms", &probe->rms, message) ||
            !read_flag(from, "passed", &probe->passed, message))
            return false;
        probe->known = set == 1;
    }
    return true;
}

/* Operations are null if no tool counted them. */
static bool read_operations(const json_t *from, VerdictCost *cost, Message *message)
{
    double operations;
    cost->operations = -1;
    cost->operations_ratio = -1;
    if (json_is_null(json_object_get(from, "operations")))
        return true;
    if (!verdict_number(from, "operations", 0, 1e15, &operations, message) ||
        !verdict_number(from, "operations_ratio", 0, 1e9, &cost->operations_ratio, message))
        return false;
    cost->operations = (long)operations;
    return true;
}

static bool read_cost(const json_t *object, VerdictCost *cost, Message *message)
{
    const json_t *from = json_object_get(object, "cost");
    if (json_is_null(from))
        return true;
    if (!json_is_object(from))
        return message_set(message, "\"cost\": must be an object or null");
    cost->known = verdict_number(from, "error", 0, 1e9, &cost->error, message) &&
                  verdict_number(from, "time_ratio", 0, 1e9, &cost->time_ratio, message) &&
                  read_operations(from, cost, message);
    return cost->known;
}

/* A plain file name: safe in shells, pages and file systems. */
static bool read_picture(const json_t *object, char picture[64], Message *message)
{
    static const char allowed[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    const json_t *list;
    int count;
    if (!read_list(object, "pictures", 1, &list, &count, message))
        return false;
    if (count == 0)
        return true;
    const char *name = json_string_value(json_array_get(list, 0));
    const size_t length = name ? strspn(name, allowed) : 0;
    if (length == 0 || length > 50 || strcmp(name + length, ".png") != 0)
        return message_set(message, "\"pictures\": must be names like worst.png");
    memcpy(picture, name, length + sizeof ".png");
    return true;
}

bool verdict_from_json(const json_t *object, char lab[64], Verdict *verdict, Message *message)
{
    int kind = 0;
    double seed = 0;
    *verdict = (Verdict){.points = 0};
    if (!json_is_object(object))
        return message_set(message, "must be an object");
    if (!verdict_text(object, "lab", lab, 64, message) ||
        !verdict_number(object, "seed", 0, 9007199254740992.0, &seed, message) ||
        !verdict_number(object, "points", 0, VERDICT_MAX_POINTS, &verdict->points, message) ||
        !read_choice(object, "verdict", VERDICT_NAMES, &kind, message) ||
        !verdict_text(object, "message", verdict->message, sizeof verdict->message, message) ||
        !read_text(object, "details", verdict->details, sizeof verdict->details, true, message) ||
        !read_flag(object, "one_of", &verdict->one_of, message) ||
        !verdict_number(object, "seconds", 0, 1e9, &verdict->seconds, message))
        return false;
    verdict->kind = (VerdictKind)kind;
    verdict->seed = (uint64_t)seed;
    return read_mistakes(object, verdict, message) && read_symptoms(object, verdict, message) &&
           read_probes(object, verdict, message) &&
           read_picture(object, verdict->picture, message) &&
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

/* JSON has neither infinities nor NaN. */
static json_t *number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

/* Drivers and compilers may quote bytes that are not UTF-8, and a cut text may end inside a
 * character. */
static json_t *text(const char *bytes)
{
    json_t *string = json_string(bytes);
    char *quoted = NULL;
    size_t size = 0;
    FILE *file = string ? NULL : open_memstream(&quoted, &size);
    if (!file)
        return string;
    json_put_string(file, bytes);
    if (fclose(file) == 0)
        string = json_loadb(quoted, size, JSON_DECODE_ANY, NULL);
    free(quoted);
    return string;
}

static json_t *mistakes_to_json(const Verdict *verdict)
{
    json_t *list = json_array();
    for (int i = 0; i < verdict->mistake_count; i++) {
        const VerdictMistake *mistake = &verdict->mistakes[i];
        json_array_append_new(list, json_pack("{s:o, s:o, s:o, s:o}", "name", text(mistake->name),
                                              "sentence", text(mistake->sentence), "look",
                                              text(mistake->look), "sure", number(mistake->sure)));
    }
    return list;
}

static json_t *probes_to_json(const Verdict *verdict)
{
    json_t *list = json_array();
    for (int i = 0; i < verdict->probe_count; i++) {
        const VerdictProbe *probe = &verdict->probes[i];
        json_array_append_new(list,
                              json_pack("{s:o, s:s, s:i, s:i, s:o, s:o, s:o, s:b}", "name",
                                        text(probe->name), "set", probe->known ? "known" : "seed",
                                        "width", probe->width, "height", probe->height, "seconds",
                                        number(probe->seconds), "maximum", number(probe->maximum),
                                        "rms", number(probe->rms), "passed", (int)probe->passed));
    }
    return list;
}

static json_t *symptoms_to_json(const Verdict *verdict)
{
    json_t *list = json_array();
    for (int i = 0; i < verdict->symptom_count; i++)
        json_array_append_new(list, text(verdict->symptoms[i]));
    return list;
}

static json_t *cost_to_json(const VerdictCost *cost)
{
    const bool counted = cost->operations >= 0;
    if (!cost->known)
        return json_null();
    return json_pack("{s:o, s:o, s:o, s:o}", "error", number(cost->error), "time_ratio",
                     number(cost->time_ratio), "operations",
                     counted ? json_integer(cost->operations) : json_null(), "operations_ratio",
                     counted ? number(cost->operations_ratio) : json_null());
}

json_t *verdict_to_json(const Verdict *verdict, const char *lab)
{
    json_t *pictures = json_array();
    if (verdict->picture[0])
        json_array_append_new(pictures, text(verdict->picture));
    return json_pack("{s:s, s:I, s:o, s:i, s:s, s:o, s:o, s:o, s:b, s:o, s:o, s:o, s:o, s:o}",
                     "lab", lab, "seed", (json_int_t)verdict->seed, "points",
                     number(verdict->points), "most", VERDICT_MAX_POINTS, "verdict",
                     VERDICT_NAMES[verdict->kind], "message", text(verdict->message), "details",
                     text(verdict->details), "mistakes", mistakes_to_json(verdict), "one_of",
                     (int)verdict->one_of, "symptoms", symptoms_to_json(verdict), "probes",
                     probes_to_json(verdict), "pictures", pictures, "seconds",
                     number(verdict->seconds), "cost", cost_to_json(&verdict->cost));
}

bool verdict_write(const Verdict *verdict, const Lab *lab, const char *submission, const char *path,
                   Message *message)
{
    json_t *object = verdict_to_json(verdict, lab->name);
    json_object_set_new(object, "path", text(submission));
    json_object_set_new(object, "student", json_null());
    char *file = json_dumps(object, JSON_INDENT(2) | JSON_REAL_PRECISION(9));
    size_t size = file ? strlen(file) : 0;
    json_decref(object);
    if (!file)
        return message_set(message, "%s: not enough memory", path);
    file[size++] = '\n'; /* replaces the NUL */
    const bool done = output_write(path, file, size, message);
    free(file);
    return done;
}
