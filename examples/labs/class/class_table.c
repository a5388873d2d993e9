/* Each table is written in memory and becomes a file at once; text of students is escaped as its
 * format wants it. */
#include "labs/class/class_report.h"

#include "base/memory.h"
#include "base/output.h"
#include "base/output_text.h"
#include "base/template.h"

#include <stdlib.h>
#include <string.h>

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

static void put_row(FILE *file, const ClassResult *result, bool parts)
{
    const Verdict *verdict = &result->verdict;
    char names[CLASS_NAMES_SIZE];
    class_table_csv_field(file, result->student);
    fputc(',', file);
    class_table_csv_field(file, result->id);
    fprintf(file, ",%d,", result->attempt);
    class_table_csv_field(file, result->lab);
    fprintf(file, ",%g,%g,%s,", verdict->points, verdict->most, VERDICT_NAMES[verdict->kind]);
    class_mistake_names(verdict, names);
    class_table_csv_field(file, names);
    fputc(',', file);
    class_table_csv_field(file, verdict->message);
    if (verdict->cost.known)
        fprintf(file, ",%g,%g,%.0f", verdict->cost.error, verdict->cost.time_ratio,
                verdict->cost.operations);
    else
        fputs(",,,", file);
    fprintf(file, ",%.3g,", verdict->seconds);
    class_table_csv_field(file, result->folder);
    fputs(parts ? ",\"" : "", file);
    verdict_parts(verdict, "", "; ", file); /* names are of lab.json, without quotes */
    fputs(parts ? "\"\r\n" : "\r\n", file);
}

bool class_table_csv(const ClassStore *store, Message *message)
{
    OutputText out;
    int parts = 0;
    for (int i = 0; i < store->count; i++)
        parts += store->results[i].verdict.part_count;
    output_text_open(&out);
    fprintf(out.file,
            "student,id,attempt,lab,points,most,verdict,mistakes,message,error,time_ratio,"
            "operations,seconds,folder%s\r\n",
            parts ? ",parts" : "");
    for (int i = 0; i < store->count; i++)
        put_row(out.file, &store->results[i], parts > 0);
    return output_text_put(&out, store->folder, "class.csv", message);
}

bool class_table_json(const ClassStore *store, Message *message)
{
    int count;
    OutputText out;
    output_text_open(&out);
    ClassMistake *made = class_mistakes(store, &count);
    JsonWriter json = {.file = out.file, .lines = 3};
    json_write_object(&json, NULL);
    json_write_text(&json, "lab", store->count ? store->results[0].lab : "");
    json_write_list(&json, "mistakes");
    for (int i = 0; i < count; i++) {
        json_write_object(&json, NULL);
        json_write_text(&json, "name", made[i].name);
        json_write_whole(&json, "students", made[i].count);
        json_write_end(&json);
    }
    free(made);
    json_write_end(&json);
    json_write_list(&json, "students");
    for (int i = 0; i < store->count; i++) {
        json_write_object(&json, NULL);
        class_result_put(&json, &store->results[i]);
        json_write_text(&json, "folder", store->results[i].folder);
        json_write_end(&json);
    }
    json_write_end(&json);
    json_write_end(&json);
    return output_text_put(&out, store->folder, "class.json", message);
}

/* Everything said about a submission, as lines of plain text, which the caller frees. */
static char *advice_text(const Verdict *verdict)
{
    OutputText text;
    output_text_open(&text);
    fprintf(text.file, "%s\n", verdict->message);
    for (int i = 0; i < verdict->mistake_count; i++)
        fprintf(text.file, "%s\nLook at %s.\n", verdict->mistakes[i].sentence,
                verdict->mistakes[i].look);
    for (int i = 0; i < verdict->symptom_count; i++)
        fprintf(text.file, "%s\n", verdict->symptoms[i]);
    verdict_parts(verdict, "", "\n", text.file);
    fputs(verdict->details, text.file);
    return output_text_close(&text);
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
    template_set(fault, "most", "%g", verdict->most);
    template_set(fault, "message", "%s", verdict->message);
    template_set(fault, "text", "%s", text);
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
    const bool done = output_path(path, store->folder, "junit.xml", message) &&
                      template_write("examples/labs/class/class_junit.xml", suite, path, message);
    template_close(suite);
    return done;
}

/* The scenes as tests without points of their own. */
static void put_tests(JsonWriter *json, const Verdict *verdict)
{
    json_write_list(json, "tests");
    for (int i = 0; i < verdict->probe_count; i++) {
        const VerdictProbe *probe = &verdict->probes[i];
        char name[80], output[120];
        snprintf(name, sizeof name, "scene %s, %s, %dx%d, at %.3f s", probe->name,
                 probe->known ? "known" : "of a seed", probe->width, probe->height, probe->seconds);
        snprintf(output, sizeof output, "largest error: %.2f steps of 1/255", probe->maximum);
        json_write_object(json, NULL);
        json_write_text(json, "name", name);
        json_write_text(json, "status", probe->passed ? "passed" : "failed");
        json_write_text(json, "output", output);
        json_write_text(json, "visibility", "visible");
        json_write_end(json);
    }
    json_write_end(json);
}

static bool write_gradescope(const ClassStore *store, const ClassResult *result, Message *message)
{
    char folder[PATH_MAX], seed[24];
    OutputText out;
    const Verdict *verdict = &result->verdict;
    if (!class_store_path(store->folder, result->folder, NULL, folder, message))
        return false;
    output_text_open(&out);
    char *text = advice_text(verdict);
    snprintf(seed, sizeof seed, "%llu", (unsigned long long)verdict->seed);
    JsonWriter json = {.file = out.file, .lines = 2};
    json_write_object(&json, NULL);
    json_write_number(&json, "score", verdict->points);
    json_write_number(&json, "execution_time", verdict->seconds);
    json_write_text(&json, "output", text);
    json_write_text(&json, "output_format", "text");
    json_write_text(&json, "visibility", "visible");
    put_tests(&json, verdict);
    json_write_object(&json, "extra_data");
    json_write_text(&json, "lab", result->lab);
    json_write_text(&json, "verdict", VERDICT_NAMES[verdict->kind]);
    json_write_value(&json, "seed", seed);
    json_write_end(&json);
    json_write_end(&json);
    free(text);
    return output_text_put(&out, folder, "results.json", message);
}

bool class_table_gradescope(const ClassStore *store, Message *message)
{
    for (int i = 0; i < store->count; i++)
        if (!write_gradescope(store, &store->results[i], message))
            return false;
    return true;
}
