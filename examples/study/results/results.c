#include "study/results/results.h"

#include "base/input.h"
#include "base/memory.h"
#include "base/output.h"
#include "base/output_text.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MAX_LINES = 10 }; /* of messages about malformed rows */

void results_measured_with(const ResultRow *row, char text[RESULT_WITH_SIZE])
{
    snprintf(text, RESULT_WITH_SIZE, "%s, LP_NUM_THREADS %s, %dx%d, seed %u", row->renderer,
             row->threads, row->width, row->height, row->seed);
}

void results_with(const Results *results, char text[RESULT_WITH_SIZE])
{
    text[0] = '\0';
    if (results->count)
        results_measured_with(&results->rows[results->count - 1], text);
}

void results_add(Results *results, const ResultRow *row)
{
    ResultRow *added =
        memory_add(&results->rows, &results->count, &results->capacity, sizeof *added);
    *added = *row;
}

const ResultRow *results_find(const Results *results, const char *scene, const Quality *quality)
{
    for (int i = results->count - 1; i >= 0; i--) {
        const ResultRow *row = &results->rows[i];
        if (strcmp(row->scene, scene) == 0 && quality_equal(&row->quality, quality))
            return row;
    }
    return NULL;
}

const ResultRow *results_of(const Results *results, const char *scene, const char *setting)
{
    Quality quality;
    return quality_parse(&quality, setting, NULL) ? results_find(results, scene, &quality) : NULL;
}

/* Rows are in one array, so addresses have the order of insertion. */
static int by_address(const void *first, const void *second)
{
    const ResultRow *a = *(const ResultRow *const *)first, *b = *(const ResultRow *const *)second;
    return a < b ? -1 : a > b;
}

static int by_quality(const void *first, const void *second)
{
    const ResultRow *a = *(const ResultRow *const *)first, *b = *(const ResultRow *const *)second;
    const int order = memcmp(a->quality.choice, b->quality.choice, sizeof a->quality.choice);
    return order ? order : by_address(first, second);
}

const ResultRow **results_latest(const Results *results, const char *scene, int *count)
{
    int found = 0;
    const ResultRow **list = memory_new((size_t)results->count, sizeof *list);
    for (int i = 0; i < results->count; i++)
        if (strcmp(results->rows[i].scene, scene) == 0)
            list[found++] = &results->rows[i];
    qsort(list, (size_t)found, sizeof *list, by_quality);
    *count = 0;
    for (int i = 0; i < found; i++)
        if (i + 1 == found || !quality_equal(&list[i]->quality, &list[i + 1]->quality))
            list[(*count)++] = list[i];
    qsort(list, (size_t)*count, sizeof *list, by_address);
    return list;
}

void results_close(Results *results)
{
    if (!results)
        return;
    free(results->rows);
    *results = (Results){0};
}

/* Whether a write of the header was interrupted. */
static bool is_cut_header(const char *text, size_t size)
{
    char header[RESULTS_HEADER_SIZE];
    header_text(header);
    return size <= strlen(header) && memcmp(text, header, size) == 0;
}

/* The end of the line at `text`, without line break; *next: the next line, or NULL. */
static const char *line_end(const char *text, const char *end, const char **next)
{
    const char *stop = memchr(text, '\n', (size_t)(end - text));
    *next = stop ? stop + 1 : NULL;
    stop = stop ? stop : end;
    return stop > text && stop[-1] == '\r' ? stop - 1 : stop;
}

static bool header_check(const char *path, const char *text, const char *end, const char **next,
                         Message *message)
{
    char header[RESULTS_HEADER_SIZE];
    header_text(header);
    const size_t size = (size_t)(line_end(text, end, next) - text);
    if (size == strlen(header) && memcmp(text, header, size) == 0)
        return true;
    return message_set(message,
                       "%s: is not a file of results of this version; name another folder, or move "
                       "it away",
                       path);
}

static bool same_measurement(const ResultRow *a, const ResultRow *b)
{
    char texts[2][2][RESULTS_FIELD_SIZE];
    for (int i = 0; i < 2; i++) {
        const Column column = column_at(RESULTS_COLUMNS - 1 - i); /* as a file has them */
        column_text(a, &column, texts[0][i]);
        column_text(b, &column, texts[1][i]);
        if (strcmp(texts[0][i], texts[1][i]) != 0)
            return false;
    }
    return a->width == b->width && a->height == b->height;
}

bool results_parse(Results *results, const char *path, const char *text, size_t size,
                   const ResultRow *like, Message *message)
{
    int broken = 0, other = 0, number = 1;
    const char *next = text, *end = text + size;
    if (size == 0 || is_cut_header(text, size))
        return true;
    if (!header_check(path, text, end, &next, message))
        return false;
    while (next && next < end) {
        ResultRow row;
        Message fault = {0};
        const char *line = next, *stop = line_end(line, end, &next);
        number++;
        if (stop == line)
            continue;
        if (!row_parse(&row, line, stop, &fault)) {
            if (broken++ < MAX_LINES)
                fprintf(stderr, "%s:%d: %s; skipped\n", path, number, fault.text);
        } else if (like && !same_measurement(&row, like)) {
            other++;
        } else {
            results_add(results, &row);
        }
    }
    if (broken > MAX_LINES)
        fprintf(stderr, "%s: %d more broken rows; skipped\n", path, broken - MAX_LINES);
    if (other)
        fprintf(stderr,
                "%s: %d rows measured with another renderer, number of threads or size; skipped\n",
                path, other);
    return true;
}

/* Opens a regular file. -1 on failure: with a message, unless *missing is set. */
static int open_file(const char *path, int flags, bool *missing, Message *message)
{
    struct stat status;
    *missing = false;
    /* Checked first, because opening some devices has side effects. */
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode)) {
        message_set(message, "%s: is %s; results need a file", path,
                    S_ISDIR(status.st_mode) ? "a folder" : "no regular file");
        return -1;
    }
    const int file = open(path, flags | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, 0666);
    if (file < 0 && errno == ENOENT && !(flags & O_CREAT)) {
        *missing = true;
    } else if (file < 0) {
        const int error = errno;
        message_set(message, "%s: cannot %s: %s%s", path, flags & O_CREAT ? "write" : "read",
                    strerror(error), error == ENOENT ? "; make its folder first" : "");
    }
    return file;
}

static bool size_check(const char *path, long long size, Message *message)
{
    if (size <= RESULTS_SIZE_MAX)
        return true;
    return message_set(message, "%s: %lld bytes; results have at most %d; name another folder",
                       path, size, RESULTS_SIZE_MAX);
}

bool results_read(Results *results, const char *path, const ResultRow *like, Message *message)
{
    bool missing;
    struct stat status;
    char *text = NULL;
    ssize_t used = 0;
    const int file = open_file(path, O_RDONLY, &missing, message);
    if (file < 0)
        return missing;
    bool done = fstat(file, &status) == 0 && S_ISREG(status.st_mode);
    if (!done)
        message_set(message, "%s: cannot read", path);
    done = done && size_check(path, status.st_size, message);
    if (done) {
        text = malloc((size_t)status.st_size + 1);
        used = text ? input_bytes(file, text, (size_t)status.st_size) : -1;
        done = used >= 0;
        if (!done)
            message_set(message, "%s: cannot read: %s", path, strerror(errno));
    }
    close(file);
    done = done && results_parse(results, path, text, (size_t)used, like, message);
    free(text);
    return done;
}

/* Writing. */

static void put_field(FILE *file, const char *text, bool always)
{
    if (!always && !strpbrk(text, "\", ")) {
        fputs(text, file);
        return;
    }
    fputc('"', file);
    for (const char *p = text; *p; p++) {
        if (*p == '"')
            fputc('"', file);
        fputc(*p, file);
    }
    fputc('"', file);
}

static void put_row(FILE *file, const ResultRow *row)
{
    for (int i = 0; i < RESULTS_COLUMNS; i++) {
        char text[RESULTS_FIELD_SIZE];
        const Column column = column_at(i);
        column_text(row, &column, text);
        if (i)
            fputc(',', file);
        put_field(file, text, i + 1 == RESULTS_COLUMNS);
    }
    fputc('\n', file);
}

/* Whether a row can be parsed. */
static bool row_check(const ResultRow *row, const char *path, const char *text, size_t size,
                      Message *message)
{
    ResultRow again;
    Message fault = {0};
    if (row_parse(&again, text, text + size - 1, &fault))
        return true;
    return message_set(message, "%s: a row of scene \"%.31s\": %s; not written", path, row->scene,
                       fault.text);
}

/* The rows, preceded by the header if needed. */
static bool put_rows(OutputText *text, const char *path, bool header, const ResultRow *rows,
                     int count, Message *message)
{
    if (header) {
        char names[RESULTS_HEADER_SIZE];
        header_text(names);
        fprintf(text->file, "%s\n", names);
    }
    for (int i = 0; i < count; i++) {
        const long start = ftell(text->file);
        put_row(text->file, &rows[i]);
        fflush(text->file);
        if (!row_check(&rows[i], path, text->text + start, text->size - (size_t)start, message))
            return false;
    }
    return true;
}

/* How much of an open file to keep, and whether it needs a header or a line break. */
typedef struct Tail {
    off_t keep;
    bool header, line_break;
} Tail;

static bool tail_find(Tail *tail, int file, const char *path, Message *message)
{
    struct stat status;
    char start[2 * RESULTS_HEADER_SIZE], last = '\n';
    const ssize_t used = input_bytes(file, start, sizeof start);
    if (fstat(file, &status) != 0 || used < 0)
        return message_set(message, "%s: cannot read: %s", path, strerror(errno));
    *tail = (Tail){.keep = status.st_size};
    if (is_cut_header(start, (size_t)used)) {
        tail->keep = 0;
        tail->header = true;
        return true;
    }
    const char *next;
    if (!header_check(path, start, start + used, &next, message))
        return false;
    if (status.st_size > 0 && pread(file, &last, 1, status.st_size - 1) != 1)
        return message_set(message, "%s: cannot read: %s", path, strerror(errno));
    tail->line_break = last != '\n';
    return true;
}

/* Makes a new file's name durable; not every file system can. */
static void sync_folder(const char *path)
{
    char folder[PATH_MAX] = ".";
    const char *slash = strrchr(path, '/');
    if (slash && (size_t)(slash - path) + 2 < sizeof folder)
        snprintf(folder, (size_t)(slash - path) + 2, "%s", path);
    const int file = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0)
        return;
    (void)!fsync(file);
    close(file);
}

static bool append_text(int file, const char *path, const Tail *tail, const char *text, size_t size,
                        Message *message)
{
    if (!size_check(path, (long long)tail->keep + (long long)size + 1, message))
        return false;
    if (tail->header && ftruncate(file, 0) != 0)
        return message_set(message, "%s: cannot write: %s", path, strerror(errno));
    if ((!tail->line_break || output_append(file, "\n", 1)) && output_append(file, text, size) &&
        fsync(file) == 0)
        return true;
    const int error = errno;
    const bool restored = ftruncate(file, tail->keep) == 0;
    return message_set(message, "%s: cannot write: %s%s%s", path, strerror(error),
                       error == ENOSPC || error == EDQUOT ? "; make room and run again" : "",
                       restored ? "" : "; its last row may be truncated");
}

/* Opens and locks it. Who waits for the lock may get that of a file that a failed run has removed:
 * then again. -1 with a message on failure. */
static int open_locked(const char *path, Message *message)
{
    for (;;) {
        struct stat named, locked;
        bool missing;
        const int file = open_file(path, O_RDWR | O_CREAT | O_APPEND, &missing, message);
        if (file < 0)
            return -1;
        while (flock(file, LOCK_EX) != 0 && errno == EINTR) /* two programs may append to one */
            continue;
        if (fstat(file, &locked) != 0 ||
            (stat(path, &named) == 0 && named.st_ino == locked.st_ino &&
             named.st_dev == locked.st_dev))
            return file;
        close(file);
    }
}

bool results_append(const char *path, const ResultRow *rows, int count, Message *message)
{
    Tail tail;
    OutputText text;
    struct stat status;
    const bool created = access(path, F_OK) != 0;
    const int file = open_locked(path, message);
    if (file < 0)
        return false;
    output_text_open(&text);
    bool done = tail_find(&tail, file, path, message) &&
                put_rows(&text, path, tail.header, rows, count, message) &&
                append_text(file, path, &tail, text.text, text.size, message);
    if (!done && created && fstat(file, &status) == 0 && status.st_size == 0)
        unlink(path);             /* of a run that a full disk ended nothing is left */
    if (close(file) != 0 && done) /* some file systems report a full disk only here */
        done = message_set(message, "%s: cannot write: %s", path, strerror(errno));
    if (done && tail.header)
        sync_folder(path);
    free(output_text_close(&text));
    return done;
}
