/* A result is a file of its own, written whole, so that a run that ends at any moment loses at most
 * what it was judging, and the next one goes on with the rest. */
#include "labs/class/class_store.h"

#include "base/input.h"
#include "base/memory.h"
#include "base/output.h"
#include "base/output_text.h"
#include "labs/sandbox/png_copy.h"
#include "labs/submission/verdict_fields.h"
#include "labs/submission/verdict_json.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

enum { FILE_MAX = 4 << 20 }; /* bytes */
static const char STATEMENTS[] = "statements.txt";

bool class_store_path(const char *store, const char *folder, const char *name, char path[PATH_MAX],
                      Message *message)
{
    if (snprintf(path, PATH_MAX, "%s/students%s%s%s%s", store, folder ? "/" : "",
                 folder ? folder : "", name ? "/" : "", name ? name : "") >= PATH_MAX)
        return message_set(message, "%s: %s", store, strerror(ENAMETOOLONG));
    return true;
}

static bool from_json(const json_t *object, ClassResult *result, Message *message)
{
    char hash[32];
    double when = 0, attempt = 1;
    if (!verdict_from_json(object, result->lab, &result->verdict, message) ||
        !verdict_text(object, "student", result->student, sizeof result->student, message) ||
        !verdict_text(object, "id", result->id, sizeof result->id, message) ||
        !verdict_text(object, "hash", hash, sizeof hash, message) ||
        !verdict_number(object, "limit", 0, 1e9, &result->limit, message) ||
        !verdict_number(object, "when", 0, 1e15, &when, message) ||
        (json_object_get(object, "attempt") &&
         !verdict_number(object, "attempt", 0, 1e6, &attempt, message)))
        return false;
    result->attempt = (int)attempt;
    result->hash = strtoull(hash, NULL, 16);
    result->when = (long long)when;
    result->finished = json_is_true(json_object_get(object, "finished"));
    return true;
}

static bool read_result(const char *path, ClassResult *result, Message *message)
{
    json_error_t error;
    size_t size;
    Message why = {.text = ""};
    char *bytes = input_read(AT_FDCWD, path, path, FILE_MAX, &size, message);
    if (!bytes)
        return false;
    json_t *object = json_loadb(bytes, size, JSON_REJECT_DUPLICATES, &error);
    const bool done = object && from_json(object, result, &why);
    json_decref(object);
    free(bytes);
    return done ? true
                : message_set(message, "%s: not a valid result, judging again: %s", path,
                              object ? why.text : error.text);
}

static void add(ClassStore *store, const ClassResult *result)
{
    ClassResult *results =
        memory_grow(store->results, (size_t)store->count + 1, sizeof *store->results);
    store->results = results;
    int at = store->count++;
    for (; at > 0 && strcmp(results[at - 1].folder, result->folder) > 0; at--)
        results[at] = results[at - 1];
    results[at] = *result;
}

static bool read_one(ClassStore *store, const char *name, Message *notes, Message *message)
{
    char path[PATH_MAX];
    Message why = {.text = ""};
    if (!class_store_path(store->folder, name, "result.json", path, message))
        return false;
    if (access(path, F_OK) != 0)
        return true;
    ClassResult *result = memory_new(1, sizeof *result);
    memcpy(result->folder, name, strlen(name) + 1);
    if (read_result(path, result, &why))
        add(store, result);
    else if (notes)
        message_add(notes, "%s%s", notes->text[0] ? "\n" : "", why.text);
    free(result);
    return true;
}

bool class_store_read(ClassStore *store, const char *folder, Message *notes, Message *message)
{
    char path[PATH_MAX];
    struct dirent **entries;
    *store = (ClassStore){.lock = -1};
    if (strlen(folder) >= sizeof store->folder)
        return message_set(message, "%s: %s", folder, strerror(ENAMETOOLONG));
    memcpy(store->folder, folder, strlen(folder) + 1);
    if (!class_store_path(folder, NULL, NULL, path, message))
        return false;
    const int count = scandir(path, &entries, NULL, alphasort);
    if (count < 0)
        return message_set(message, "%s: %s; name a folder that check --class wrote", path,
                           strerror(errno));
    bool done = true;
    for (int i = 0; i < count; i++) {
        if (entries[i]->d_name[0] != '.' && strlen(entries[i]->d_name) < CLASS_FOLDER_SIZE)
            done = done && read_one(store, entries[i]->d_name, notes, message);
        free(entries[i]);
    }
    free(entries);
    if (!done)
        class_store_close(store);
    return done;
}

bool class_store_open(ClassStore *store, const char *folder, Message *notes, Message *message)
{
    char path[PATH_MAX];
    *store = (ClassStore){.lock = -1};
    if (!class_store_path(folder, NULL, NULL, path, message) || !output_folder(folder, message) ||
        !output_folder(path, message) || !output_path(path, folder, ".lock", message))
        return false;
    const int lock = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (lock < 0)
        return message_set(message, "%s: %s", path, strerror(errno));
    if (flock(lock, LOCK_EX | LOCK_NB) != 0) {
        const int error = errno;
        close(lock);
        return error == EWOULDBLOCK
                   ? message_set(message,
                                 "%s: another run writes there; wait for it, or choose another "
                                 "folder with -o and combine them with --merge",
                                 folder)
                   : message_set(message, "%s: %s", path, strerror(error));
    }
    if (!class_store_read(store, folder, notes, message)) {
        close(lock);
        return false;
    }
    store->lock = lock;
    return true;
}

ClassResult *class_store_find(const ClassStore *store, const char *folder)
{
    for (int i = 0; i < store->count; i++)
        if (strcmp(store->results[i].folder, folder) == 0)
            return &store->results[i];
    return NULL;
}

bool class_result_stands(const ClassResult *result, const char *lab, uint64_t hash, double limit)
{
    return result && result->hash == hash && strcmp(result->lab, lab) == 0 &&
           (result->finished ||
            (result->verdict.kind == VERDICT_TIMEOUT && result->limit >= limit));
}

bool class_result_is_worse(const ClassResult *next, const ClassResult *old)
{
    if (next->hash != old->hash || strcmp(next->lab, old->lab) != 0)
        return false;
    if (next->finished != old->finished)
        return old->finished;
    return next->verdict.points < old->verdict.points;
}

void class_result_put(JsonWriter *json, const ClassResult *result)
{
    verdict_put(json, &result->verdict, result->lab);
    json_write_text(json, "student", result->student);
    json_write_text(json, "id", result->id);
    json_write_whole(json, "attempt", result->attempt);
    json_write_flag(json, "finished", result->finished);
}

static bool write_result(const char *path, const ClassResult *result, Message *message)
{
    OutputText out;
    char hash[20];
    output_text_open(&out);
    snprintf(hash, sizeof hash, "%016" PRIx64, result->hash);
    JsonWriter json = {.file = out.file, .lines = 2};
    json_write_object(&json, NULL);
    class_result_put(&json, result);
    json_write_text(&json, "hash", hash);
    json_write_number(&json, "limit", result->limit);
    json_write_whole(&json, "when", result->when);
    json_write_end(&json);
    return output_text_write(&out, path, message);
}

/* Writes the result's files; if its picture is invalid, the result names none. */
static bool write_files(const ClassStore *store, ClassResult *result, ClassFiles *files,
                        Message *message)
{
    char path[PATH_MAX];
    Verdict *verdict = &result->verdict;
    char *text = memory_new(files->statements_size + 1, 1);
    if (files->statements)
        verdict_clean(text, files->statements_size + 1, files->statements, true);
    bool done = class_store_path(store->folder, result->folder, STATEMENTS, path, message) &&
                output_write(path, text, strlen(text), message);
    free(text);
    if (!verdict->picture[0] || !files->picture ||
        !png_copy((unsigned char *)files->picture, &files->picture_size, NULL)) {
        verdict->picture[0] = '\0';
        return done;
    }
    return done &&
           class_store_path(store->folder, result->folder, verdict->picture, path, message) &&
           output_write(path, files->picture, files->picture_size, message);
}

bool class_store_put(ClassStore *store, const ClassResult *result, ClassFiles files, bool *kept,
                     Message *message)
{
    char path[PATH_MAX];
    ClassResult *old = class_store_find(store, result->folder);
    ClassResult *next = memory_copy(result, sizeof *result);
    const bool keep = !old || !class_result_is_worse(next, old);
    const bool done =
        !keep || (class_store_path(store->folder, next->folder, NULL, path, message) &&
                  output_folder(path, message) && write_files(store, next, &files, message) &&
                  class_store_path(store->folder, next->folder, "result.json", path, message) &&
                  write_result(path, next, message));
    if (done && keep && old)
        *old = *next;
    else if (done && keep)
        add(store, next);
    if (kept)
        *kept = keep;
    free(next);
    return done;
}

/* A file of a result, for free(); NULL: there is none. */
static char *read_file(const ClassStore *store, const ClassResult *result, const char *name,
                       size_t *size)
{
    char path[PATH_MAX];
    return name[0] && class_store_path(store->folder, result->folder, name, path, NULL)
               ? input_read(AT_FDCWD, path, path, FILE_MAX, size, NULL)
               : NULL;
}

char *class_store_statements(const ClassStore *store, const ClassResult *result)
{
    size_t size;
    return read_file(store, result, STATEMENTS, &size);
}

bool class_store_merge(ClassStore *store, const ClassStore *from, Message *message)
{
    bool done = true;
    for (int i = 0; i < from->count && done; i++) {
        const ClassResult *next = &from->results[i];
        const ClassResult *old = class_store_find(store, next->folder);
        if (store->count > 0 && strcmp(store->results[0].lab, next->lab) != 0) {
            done = message_set(message, "%s: has results of %s, but %s has those of %s",
                               from->folder, next->lab, store->folder, store->results[0].lab);
        } else if (!old || old->hash == next->hash || old->when <= next->when) {
            ClassFiles files = {.picture_size = 0};
            files.picture = read_file(from, next, next->verdict.picture, &files.picture_size);
            files.statements = read_file(from, next, STATEMENTS, &files.statements_size);
            done = class_store_put(store, next, files, NULL, message);
            free(files.picture);
            free(files.statements);
        }
    }
    return done;
}

void class_store_close(ClassStore *store)
{
    if (!store)
        return;
    free(store->results);
    if (store->lock > 0)
        close(store->lock);
    *store = (ClassStore){.lock = -1};
}
