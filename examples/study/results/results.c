#include "study/results/results.h"

#include "base/input.h"
#include "base/memory.h"
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
    if (size == 0 || is_cut_header(text, size))
        return true;
    const char *next = text, *end = text + size;
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

static bool size_check(const char *path, long long size, Message *message)
{
    if (size <= RESULTS_SIZE_MAX)
        return true;
    return message_set(message, "%s: %lld bytes; results have at most %d; name another folder",
                       path, size, RESULTS_SIZE_MAX);
}

/* The bytes of a regular file, to be freed; none if there is no such file. */
static bool read_text(const char *path, char **text, size_t *size, Message *message)
{
    struct stat status;
    Message why = {0};
    *text = NULL;
    *size = 0;
    /* Checked first, because opening some devices has side effects. */
    if (stat(path, &status) != 0)
        return errno == ENOENT ||
               message_set(message, "%s: cannot read: %s", path, strerror(errno));
    if (!S_ISREG(status.st_mode))
        return message_set(message, "%s: is %s; results need a file", path,
                           S_ISDIR(status.st_mode) ? "a folder" : "no regular file");
    if (!size_check(path, status.st_size, message))
        return false;
    *text = input_whole(path, size, &why);
    return *text || message_set(message, "%s: cannot read: %s", path, why.text);
}

bool results_read(Results *results, const char *path, const ResultRow *like, Message *message)
{
    char *text;
    size_t size;
    const bool done = read_text(path, &text, &size, message) &&
                      results_parse(results, path, text, size, like, message);
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

/* What the file has, if it is whole, and the rows. */
static bool put_rows(OutputText *text, const char *path, const ResultRow *rows, int count,
                     Message *message)
{
    char header[RESULTS_HEADER_SIZE], *old;
    const char *next;
    size_t size;
    if (!read_text(path, &old, &size, message))
        return false;
    const bool cut = size == 0 || is_cut_header(old, size);
    const bool known = cut || header_check(path, old, old + size, &next, message);
    header_text(header);
    if (cut)
        fprintf(text->file, "%s\n", header);
    else if (fwrite(old, 1, size, text->file) == size && old[size - 1] != '\n')
        fputc('\n', text->file);
    free(old);
    for (int i = 0; i < count && known; i++) {
        const long start = ftell(text->file);
        put_row(text->file, &rows[i]);
        fflush(text->file);
        if (!row_check(&rows[i], path, text->text + start, text->size - (size_t)start, message))
            return false;
    }
    fflush(text->file);
    return known && size_check(path, (long long)text->size, message);
}

/* Two programs may append to one file: its folder is locked. -1: it cannot be, which is no reason
 * to fail. */
static int lock_folder(const char *path)
{
    char folder[PATH_MAX];
    const char *slash = strrchr(path, '/');
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path) + 1 : 1,
             slash ? path : ".");
    const int lock = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    while (lock >= 0 && flock(lock, LOCK_EX) != 0 && errno == EINTR)
        continue;
    return lock;
}

bool results_append(const char *path, const ResultRow *rows, int count, Message *message)
{
    OutputText text;
    const int lock = lock_folder(path);
    output_text_open(&text);
    bool done = put_rows(&text, path, rows, count, message);
    if (done)
        done = output_text_write(&text, path, message);
    else
        free(output_text_close(&text));
    if (lock >= 0)
        close(lock);
    return done;
}
