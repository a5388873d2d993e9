/* What a run was is read back as JSON; two runs were alike if their objects are, but for the part's
 * number and its students. */
#include "labs/class/class_run.h"

#include "base/input.h"
#include "base/memory.h"
#include "base/output.h"
#include "base/paths.h"
#include "base/version.h"
#include "labs/sandbox/source.h"

#include <fcntl.h>
#include <inttypes.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_MAX = 4 << 20, NAMED_MAX = 5 };

static const char NAME[] = "run.json";
static const char FIELDS[] = "{s:s, s:s, s:s, s:s, s:s, s:i, s:i, s:I, s:i, s:b, s:o}";

/* "60 submissions, 0123456789abcdef": the whole class, of which each part has some, with who is
 * late. */
static void describe_class(const FoundList *list, char text[64])
{
    uint64_t hash = SOURCE_HASH_START;
    for (int i = 0; i < list->count; i++) {
        const Found *found = &list->items[i];
        hash = source_hash_bytes(hash, found->folder, strlen(found->folder) + 1);
        hash = source_hash_bytes(hash, &found->days_late, sizeof found->days_late);
    }
    snprintf(text, 64, "%d submissions, %016" PRIx64, list->count, hash);
}

bool class_run_write(const ClassOptions *options, const Lab *lab, const FoundList *list,
                     Message *message)
{
    char path[PATH_MAX], class[64], files[20], program[20];
    uint64_t hash;
    if (!paths_program(path, message) || !source_hash_file(path, path, &hash, message))
        return false;
    snprintf(files, sizeof files, "%016" PRIx64, lab->hash);
    snprintf(program, sizeof program, "%016" PRIx64, hash);
    json_t *students = json_array();
    describe_class(list, class);
    for (int i = 0; i < list->count; i++)
        if (class_in_part(options, list->items[i].folder))
            json_array_append_new(students, json_string(list->items[i].folder));
    json_t *run = json_pack(FIELDS, "lab", lab->name, "class", class, "version", VERSION,
                            "lab's files", files, "program", program, "part", options->part.number,
                            "parts", options->part.count, "seed", (json_int_t)options->seed,
                            "limit", (int)options->limit, "deterministic", options->deterministic,
                            "students", students);
    char *text = run ? json_dumps(run, JSON_INDENT(2)) : NULL;
    const bool done = text ? output_path(path, options->output, NAME, message) &&
                                 output_write(path, text, strlen(text), message)
                           : message_set(message, "%s: not enough memory", NAME);
    free(text);
    json_decref(run);
    return done;
}

static int whole_number(const json_t *run, const char *key)
{
    return (int)json_integer_value(json_object_get(run, key));
}

static bool is_whole(json_t *run)
{
    const json_t *students = json_object_get(run, "students");
    bool whole = json_unpack_ex(run, NULL, JSON_VALIDATE_ONLY, FIELDS, "lab", "class", "version",
                                "lab's files", "program", "part", "parts", "seed", "limit",
                                "deterministic", "students") == 0 &&
                 whole_number(run, "parts") <= PARTS_MAX;
    for (size_t i = 0; i < json_array_size(students); i++)
        whole &= json_is_string(json_array_get(students, i));
    return whole;
}

static json_t *read_run(const char *folder, Message *message)
{
    char path[PATH_MAX];
    size_t size;
    json_t *run = NULL;
    char *text = output_path(path, folder, NAME, message)
                     ? input_read(AT_FDCWD, path, path, FILE_MAX, &size, message)
                     : NULL;
    if (text)
        run = json_loadb(text, size, JSON_REJECT_DUPLICATES, NULL);
    free(text);
    if (text && !(run && is_whole(run))) {
        message_set(message, "%s: does not say what was judged; judge this part again", path);
        json_decref(run);
        return NULL;
    }
    return run;
}

/* The same class, judged in the same way. */
static bool is_alike(const json_t *a, const json_t *b, char *const folders[2], Message *message)
{
    static const char *const keys[] = {"lab",   "lab's files", "class", "version",      "program",
                                       "parts", "seed",        "limit", "deterministic"};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        const json_t *values[2] = {json_object_get(a, keys[i]), json_object_get(b, keys[i])};
        if (json_equal(values[0], values[1]))
            continue;
        char *texts[2];
        for (int k = 0; k < 2; k++)
            texts[k] = json_dumps(values[k], JSON_ENCODE_ANY);
        message_set(message, "%s and %s were not judged alike: %s is %s and %s", folders[0],
                    folders[1], keys[i], texts[0] ? texts[0] : "", texts[1] ? texts[1] : "");
        free(texts[0]);
        free(texts[1]);
        return false;
    }
    return true;
}

/* A number that each run of a class in parts has once. */
static bool has_each_part(json_t *const runs[], char *const folders[], int count, Message *missing,
                          Message *message)
{
    const int parts = whole_number(runs[0], "parts");
    for (int part = 1; part <= parts; part++) {
        int found = -1;
        for (int i = 0; i < count; i++) {
            if (whole_number(runs[i], "part") != part)
                continue;
            if (found >= 0)
                return message_set(message, "part %d of %d is there twice: %s and %s", part, parts,
                                   folders[found], folders[i]);
            found = i;
        }
        if (found < 0)
            message_add(missing, "%spart %d of %d is missing", missing->text[0] ? "; " : "", part,
                        parts);
    }
    return true;
}

/* Students of a run that have no result. */
static bool find_unjudged(const json_t *run, const char *folder, Message *missing, Message *message)
{
    ClassStore store;
    Message notes = {.text = ""};
    size_t i;
    json_t *name;
    int count = 0;
    if (!class_store_read(&store, folder, &notes, message))
        return false;
    json_array_foreach(json_object_get(run, "students"), i, name)
    {
        if (class_store_find(&store, json_string_value(name)))
            continue;
        if (count == 0)
            message_add(missing, "%s%s: without a result:", missing->text[0] ? "; " : "", folder);
        if (count++ < NAMED_MAX)
            message_add(missing, " %s", json_string_value(name));
    }
    if (count > NAMED_MAX)
        message_add(missing, " and %d more", count - NAMED_MAX);
    class_store_close(&store);
    return true;
}

bool class_runs_join(const ClassOptions *options, Message *missing, Message *message)
{
    char *const *folders = options->merged;
    int count = 0;
    while (folders[count])
        count++;
    json_t **runs = memory_new((size_t)count, sizeof *runs);
    bool done = true;
    for (int i = 0; i < count && done; i++) {
        runs[i] = read_run(folders[i], message);
        done = runs[i] && is_alike(runs[0], runs[i], (char *[]){folders[0], folders[i]}, message);
    }
    done = done && has_each_part(runs, folders, count, missing, message);
    for (int i = 0; i < count && done; i++)
        done = find_unjudged(runs[i], folders[i], missing, message);
    if (done && missing->text[0] && !options->partial)
        done = message_set(message,
                           "%s; judge that (the same command goes on), or join the rest with "
                           "--partial",
                           missing->text);
    for (int i = 0; i < count; i++)
        json_decref(runs[i]);
    free(runs);
    return done;
}
