#include "labs/class/class_table.h"

#include "base/output.h"
#include "labs/submission/verdict_json.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

bool class_file_open(ClassFile *file, Message *message)
{
    *file = (ClassFile){.text = NULL};
    file->file = open_memstream(&file->text, &file->size);
    return file->file ? true : message_set(message, "%s", strerror(errno));
}

static bool write_text(const char *text, size_t size, const char *folder, const char *name,
                       Message *message)
{
    char path[PATH_MAX];
    return snprintf(path, sizeof path, "%s/%s", folder, name) < (int)sizeof path
               ? output_write(path, text, size, message)
               : message_set(message, "%s: %s", folder, strerror(ENAMETOOLONG));
}

bool class_file_write(ClassFile *file, const char *folder, const char *name, Message *message)
{
    const bool good = !ferror(file->file);
    const bool done = fclose(file->file) == 0 && good
                          ? write_text(file->text, file->size, folder, name, message)
                          : message_set(message, "%s: %s", name, strerror(ENOMEM));
    free(file->text);
    return done;
}

static int by_count(const void *a, const void *b)
{
    const ClassMistake *first = a, *second = b;
    return first->count != second->count ? second->count - first->count
                                         : strcmp(first->name, second->name);
}

ClassMistake *class_mistakes(const ClassStore *store, int *count)
{
    ClassMistake *list = calloc((size_t)store->count * VERDICT_MAX_MISTAKES + 1, sizeof *list);
    *count = 0;
    for (int i = 0; list && i < store->count; i++) {
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
    if (list)
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

static void put_mistakes(FILE *file, const Verdict *verdict)
{
    char names[VERDICT_MAX_MISTAKES * 80] = "";
    for (int i = 0, used = 0; i < verdict->mistake_count; i++)
        used += snprintf(names + used, sizeof names - (size_t)used, "%s%s", i ? "; " : "",
                         verdict->mistakes[i].name);
    class_table_csv_field(file, names);
}

bool class_table_csv(const ClassStore *store, Message *message)
{
    ClassFile out;
    if (!class_file_open(&out, message))
        return false;
    fputs("student,id,attempt,lab,points,most,verdict,mistakes,message,error,time_ratio,operations,"
          "seconds,folder\r\n",
          out.file);
    for (int i = 0; i < store->count; i++) {
        const ClassResult *result = &store->results[i];
        const Verdict *verdict = &result->verdict;
        class_table_csv_field(out.file, result->student);
        fputc(',', out.file);
        class_table_csv_field(out.file, result->id);
        fprintf(out.file, ",%d,", result->attempt);
        class_table_csv_field(out.file, result->lab);
        fprintf(out.file, ",%g,%d,%s,", verdict->points, VERDICT_MAX_POINTS,
                VERDICT_NAMES[verdict->kind]);
        put_mistakes(out.file, verdict);
        fputc(',', out.file);
        class_table_csv_field(out.file, verdict->message);
        if (verdict->cost.known)
            fprintf(out.file, ",%g,%g,%ld", verdict->cost.error, verdict->cost.time_ratio,
                    verdict->cost.operations);
        else
            fputs(",,,", out.file);
        fprintf(out.file, ",%.3g,", verdict->seconds);
        class_table_csv_field(out.file, result->folder);
        fputs("\r\n", out.file);
    }
    return class_file_write(&out, store->folder, "class.csv", message);
}

/* Takes over `object`. */
static bool write_json(json_t *object, const char *folder, const char *name, Message *message)
{
    char *text = object ? json_dumps(object, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) : NULL;
    json_decref(object);
    const bool done = text ? write_text(text, strlen(text), folder, name, message)
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

void class_table_markup(FILE *file, const char *text)
{
    static const char special[] = "&<>\"'";
    static const char *const names[] = {"amp", "lt", "gt", "quot", "#39"};
    for (; *text; text++) {
        const char *at = strchr(special, *text);
        if (at)
            fprintf(file, "&%s;", names[at - special]);
        else if ((unsigned char)*text >= ' ' || *text == '\n' || *text == '\t')
            fputc(*text, file); /* XML allows no other control characters */
    }
}

void class_table_pieces(FILE *file, const char *const pieces[])
{
    for (int i = 0; pieces[i]; i++) {
        if (i % 2)
            class_table_markup(file, pieces[i]);
        else
            fputs(pieces[i], file);
    }
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

static void put_case(FILE *file, const ClassResult *result)
{
    const Verdict *verdict = &result->verdict;
    const char *element = verdict->kind == VERDICT_WRONG ? "failure" : "error";
    MARKUP(file, "    <testcase classname=\"", result->lab, "\" name=\"", result->student, "\"");
    fprintf(file, " time=\"%.3f\"", verdict->seconds);
    if (verdict->kind == VERDICT_RIGHT) {
        fputs("/>\n", file);
        return;
    }
    char *text = advice_text(verdict);
    fprintf(file, ">\n      <%s type=\"%s\" message=\"%g of %d points: ", element,
            VERDICT_NAMES[verdict->kind], verdict->points, VERDICT_MAX_POINTS);
    MARKUP(file, "", verdict->message, "\">", text ? text : "", "</");
    fprintf(file, "%s>\n    </testcase>\n", element);
    free(text);
}

bool class_table_junit(const ClassStore *store, Message *message)
{
    ClassFile out;
    int wrong = 0, errors = 0;
    double seconds = 0;
    if (!class_file_open(&out, message))
        return false;
    for (int i = 0; i < store->count; i++) {
        const VerdictKind kind = store->results[i].verdict.kind;
        wrong += kind == VERDICT_WRONG;
        errors += kind != VERDICT_WRONG && kind != VERDICT_RIGHT;
        seconds += store->results[i].verdict.seconds;
    }
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", out.file);
    for (int i = 0; i < 2; i++) {
        MARKUP(out.file, i ? "  <testsuite name=\"" : "<testsuites name=\"",
               store->count ? store->results[0].lab : "");
        fprintf(out.file, "\" tests=\"%d\" failures=\"%d\" errors=\"%d\" time=\"%.3f\">\n",
                store->count, wrong, errors, seconds);
    }
    for (int i = 0; i < store->count; i++)
        put_case(out.file, &store->results[i]);
    fputs("  </testsuite>\n</testsuites>\n", out.file);
    return class_file_write(&out, store->folder, "junit.xml", message);
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
