#include "labs/class/class_table.h"

#include "base/memory.h"
#include "base/output.h"
#include "base/template.h"
#include "labs/submission/verdict_json.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static bool file_path(const char *folder, const char *name, char path[PATH_MAX], Message *message)
{
    return snprintf(path, PATH_MAX, "%s/%s", folder, name) < PATH_MAX ||
           message_set(message, "%s: %s", folder, strerror(ENAMETOOLONG));
}

static int by_count(const void *a, const void *b)
{
    const ClassMistake *first = a, *second = b;
    return first->count != second->count ? second->count - first->count
                                         : strcmp(first->name, second->name);
}

ClassMistake *class_mistakes(const ClassStore *store, int *count)
{
    ClassMistake *list = memory_new((size_t)store->count * VERDICT_MAX_MISTAKES + 1, sizeof *list);
    *count = 0;
    for (int i = 0; i < store->count; i++) {
        const Verdict *verdict = &store->results[i].verdict;
        for (int j = 0; j < verdict->mistake_count; j++) {
            int at = 0;
            while (at < *count && strcmp(list[at].name, verdict->mistakes[j].name) != 0)
                at++;
            list[at].name = verdict->mistakes[j].name;
            list[at].count++;
            *count += at == *count;
        }
    }
    qsort(list, (size_t)*count, sizeof *list, by_count);
    return list;
}

void class_table_csv_field(FILE *file, const char *text)
{
    fputc('"', file);
    if (text[0] && strchr("=+-@\t\r", text[0]))
        fputc('\'', file);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', file);
        fputc(*text, file);
    }
    fputc('"', file);
}

void class_mistake_names(const Verdict *verdict, char names[CLASS_NAMES_SIZE])
{
    names[0] = '\0';
    for (int i = 0, used = 0; i < verdict->mistake_count; i++)
        used += snprintf(names + used, CLASS_NAMES_SIZE - (size_t)used, "%s%s", i ? "; " : "",
                         verdict->mistakes[i].name);
}

static void put_row(FILE *file, const ClassResult *result)
{
    const Verdict *verdict = &result->verdict;
    char names[CLASS_NAMES_SIZE];
    class_table_csv_field(file, result->student);
    fputc(',', file);
    class_table_csv_field(file, result->id);
    fprintf(file, ",%d,", result->attempt);
    class_table_csv_field(file, result->lab);
    fprintf(file, ",%g,%d,%s,", verdict->points, VERDICT_MAX_POINTS, VERDICT_NAMES[verdict->kind]);
    class_mistake_names(verdict, names);
    class_table_csv_field(file, names);
    fputc(',', file);
    class_table_csv_field(file, verdict->message);
    if (verdict->cost.known)
        fprintf(file, ",%g,%g,%ld", verdict->cost.error, verdict->cost.time_ratio,
                verdict->cost.operations);
    else
        fputs(",,,", file);
    fprintf(file, ",%.3g,", verdict->seconds);
    class_table_csv_field(file, result->folder);
    fputs("\r\n", file);
}

bool class_table_csv(const ClassStore *store, Message *message)
{
    char path[PATH_MAX];
    char *text = NULL;
    size_t size = 0;
    FILE *file =
        file_path(store->folder, "class.csv", path, message) ? open_memstream(&text, &size) : NULL;
    if (!file)
        return false;
    fputs("student,id,attempt,lab,points,most,verdict,mistakes,message,error,time_ratio,operations,"
          "seconds,folder\r\n",
          file);
    for (int i = 0; i < store->count; i++)
        put_row(file, &store->results[i]);
    const bool done = fclose(file) == 0 ? output_write(path, text, size, message)
                                        : message_set(message, "%s: not enough memory", path);
    free(text);
    return done;
}

/* Takes over `object`. */
static bool write_json(json_t *object, const char *folder, const char *name, Message *message)
{
    char path[PATH_MAX];
    char *text = object ? json_dumps(object, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) : NULL;
    json_decref(object);
    const bool done = text ? file_path(folder, name, path, message) &&
                                 output_write(path, text, strlen(text), message)
                           : message_set(message, "%s: %s", name, strerror(ENOMEM));
    free(text);
    return done;
}

bool class_table_json(const ClassStore *store, Message *message)
{
    int count;
    json_t *students = json_array(), *mistakes = json_array();
    ClassMistake *made = class_mistakes(store, &count);
    for (int i = 0; i < count; i++)
        json_array_append_new(
            mistakes, json_pack("{s:s, s:i}", "name", made[i].name, "students", made[i].count));
    free(made);
    for (int i = 0; i < store->count; i++) {
        const ClassResult *result = &store->results[i];
        json_t *object = verdict_to_json(&result->verdict, result->lab);
        json_object_set_new(object, "student", json_string(result->student));
        json_object_set_new(object, "id", json_string(result->id));
        json_object_set_new(object, "attempt", json_integer(result->attempt));
        json_object_set_new(object, "folder", json_string(result->folder));
        json_object_set_new(object, "finished", json_boolean(result->finished));
        json_array_append_new(students, object);
    }
    return write_json(json_pack("{s:s, s:o, s:o}", "lab", store->count ? store->results[0].lab : "",
                                "mistakes", mistakes, "students", students),
                      store->folder, "class.json", message);
}

/* Everything said about a submission, as lines of plain text, which the caller frees; NULL: out of
 * memory. */
static char *advice_text(const Verdict *verdict)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return NULL;
    fprintf(file, "%s\n", verdict->message);
    for (int i = 0; i < verdict->mistake_count; i++)
        fprintf(file, "%s\nLook at %s.\n", verdict->mistakes[i].sentence,
                verdict->mistakes[i].look);
    for (int i = 0; i < verdict->symptom_count; i++)
        fprintf(file, "%s\n", verdict->symptoms[i]);
    fputs(verdict->details, file);
    if (fclose(file) == 0)
        return text;
    free(text);
    return NULL;
}

static void add_case(TemplateValues *suite, const ClassResult *result)
{
    const Verdict *verdict = &result->verdict;
    TemplateValues *values = template_add(suite, "case");
    template_set(values, "student", "%s", result->student);
    template_set(values, "time", "%.3f", verdict->seconds);
    if (verdict->kind == VERDICT_RIGHT)
        return;
    char *text = advice_text(verdict);
    TemplateValues *fault = template_add(values, "fault");
    template_set(fault, "element", "%s", verdict->kind == VERDICT_WRONG ? "failure" : "error");
    template_set(fault, "verdict", "%s", VERDICT_NAMES[verdict->kind]);
    template_set(fault, "points", "%g", verdict->points);
    template_set(fault, "most", "%d", VERDICT_MAX_POINTS);
    template_set(fault, "message", "%s", verdict->message);
    template_set(fault, "text", "%s", text ? text : "");
    free(text);
}

bool class_table_junit(const ClassStore *store, Message *message)
{
    char path[PATH_MAX];
    int wrong = 0, errors = 0;
    double seconds = 0;
    TemplateValues *suite = template_values();
    for (int i = 0; i < store->count; i++) {
        const VerdictKind kind = store->results[i].verdict.kind;
        wrong += kind == VERDICT_WRONG;
        errors += kind != VERDICT_WRONG && kind != VERDICT_RIGHT;
        seconds += store->results[i].verdict.seconds;
        add_case(suite, &store->results[i]);
    }
    template_set(suite, "lab", "%s", store->count ? store->results[0].lab : "");
    template_set(suite, "tests", "%d", store->count);
    template_set(suite, "failures", "%d", wrong);
    template_set(suite, "errors", "%d", errors);
    template_set(suite, "time", "%.3f", seconds);
    const bool done = file_path(store->folder, "junit.xml", path, message) &&
                      template_write("examples/labs/class/class_junit.xml", suite, path, message);
    template_close(suite);
    return done;
}

/* The scenes as tests without points of their own. */
static json_t *gradescope_tests(const Verdict *verdict)
{
    json_t *tests = json_array();
    for (int i = 0; i < verdict->probe_count; i++) {
        const VerdictProbe *probe = &verdict->probes[i];
        char name[80], output[120];
        snprintf(name, sizeof name, "scene %s, %s, %dx%d, at %.3f s", probe->name,
                 probe->known ? "known" : "of a seed", probe->width, probe->height, probe->seconds);
        snprintf(output, sizeof output, "largest error: %.2f steps of 1/255", probe->maximum);
        json_array_append_new(tests, json_pack("{s:s, s:s, s:s, s:s}", "name", name, "status",
                                               probe->passed ? "passed" : "failed", "output",
                                               output, "visibility", "visible"));
    }
    return tests;
}

static bool write_gradescope(const ClassStore *store, const ClassResult *result, Message *message)
{
    char folder[PATH_MAX];
    const Verdict *verdict = &result->verdict;
    if (!class_store_path(store->folder, result->folder, NULL, folder, message))
        return false;
    char *text = advice_text(verdict);
    if (!text)
        return message_set(message, "%s: %s", result->folder, strerror(ENOMEM));
    json_t *object = json_pack(
        "{s:f, s:f, s:s, s:s, s:s, s:o, s:{s:s, s:s, s:I}}", "score", verdict->points,
        "execution_time", verdict->seconds, "output", text, "output_format", "text", "visibility",
        "visible", "tests", gradescope_tests(verdict), "extra_data", "lab", result->lab, "verdict",
        VERDICT_NAMES[verdict->kind], "seed", (json_int_t)verdict->seed);
    free(text);
    return write_json(object, folder, "results.json", message);
}

bool class_table_gradescope(const ClassStore *store, Message *message)
{
    for (int i = 0; i < store->count; i++)
        if (!write_gradescope(store, &store->results[i], message))
            return false;
    return true;
}
