/* Two students who share a statement that k of n have tell log2(n / k) bits: so unlikely it is that
 * the second has it by chance. What everybody writes weighs nothing, so short labs name nobody. A
 * pair is shown if its bits make it unlikely in any class of n: n (n - 1) / 2 pairs had the chance.
 * Statements depend on each other, so the number is a guide to what to read, not a probability. */
#include "labs/class/class_report.h"

#include "base/memory.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* With SURPRISE more bits than there are pairs, 1 class in 8 has one by chance. What tells less
 * than two bits, more than a quarter of the class has. */
enum { SHOWN_MAX = 50, HASH_DIGITS = 8, SURPRISE = 3, TELLS_LEAST = 2 };

/* A statement of a student, and the list of those who have it. */
typedef struct Written {
    uint32_t hash;
    int student;
    size_t first, size; /* of the statements by hash */
} Written;

typedef struct Statements {
    Written *by_hash, *by_student;
    size_t count;
    char **texts; /* of each student; NULL: not known */
} Statements;

typedef struct Pair {
    int one, two;
    double bits;
} Pair;

static int compare_hash(const void *a, const void *b)
{
    const Written *x = a, *y = b;
    return x->hash != y->hash ? (x->hash > y->hash) - (x->hash < y->hash) : x->student - y->student;
}

static int compare_student(const void *a, const void *b)
{
    const Written *x = a, *y = b;
    return x->student != y->student ? x->student - y->student : compare_hash(a, b);
}

static int compare_bits(const void *a, const void *b)
{
    const Pair *x = a, *y = b;
    return (x->bits < y->bits) - (x->bits > y->bits);
}

/* The next of the hashes that a line begins with. False: no more, and the line's text follows,
 * which may begin with what strtoul takes for a number, after blanks. */
static bool next_hash(const char **at, uint32_t *hash)
{
    char *end;
    *hash = (uint32_t)strtoul(*at, &end, 16);
    const bool found = **at != ' ' && end == *at + HASH_DIGITS;
    *at = found ? end + (*end == ',') : *at + (**at == '-');
    return found;
}

static void read_student(Statements *all, size_t *room, int student)
{
    for (const char *line = all->texts[student]; line && *line;) {
        uint32_t hash;
        for (const char *at = line; next_hash(&at, &hash);) {
            if (all->count == *room)
                all->by_hash =
                    memory_grow(all->by_hash, *room = 2 * *room + 1024, sizeof *all->by_hash);
            all->by_hash[all->count++] = (Written){.hash = hash, .student = student};
        }
        line += strcspn(line, "\n");
        line += *line == '\n';
    }
}

static void open_statements(Statements *all, const ClassStore *store)
{
    size_t room = 0, kept = 0;
    *all = (Statements){.texts = memory_new((size_t)store->count + 1, sizeof *all->texts)};
    for (int i = 0; i < store->count; i++) {
        all->texts[i] = class_store_statements(store, &store->results[i]);
        read_student(all, &room, i);
    }
    all->by_hash = memory_grow(all->by_hash, all->count + 1, sizeof *all->by_hash);
    qsort(all->by_hash, all->count, sizeof *all->by_hash, compare_hash);
    for (size_t i = 0; i < all->count; i++) /* each once a student */
        if (i == 0 || compare_hash(&all->by_hash[i], &all->by_hash[kept - 1]) != 0)
            all->by_hash[kept++] = all->by_hash[i];
    all->count = kept;
    for (size_t first = 0, end = 0; first < kept; first = end) {
        while (end < kept && all->by_hash[end].hash == all->by_hash[first].hash)
            end++;
        for (size_t i = first; i < end; i++) {
            all->by_hash[i].first = first;
            all->by_hash[i].size = end - first;
        }
    }
    all->by_student = memory_copy(all->by_hash, (kept + 1) * sizeof *all->by_student);
    qsort(all->by_student, kept, sizeof *all->by_student, compare_student);
}

/* The pairs that are unlikely, the most unlikely first; for free(). */
static Pair *find_pairs(const Statements *all, int students, int *count)
{
    const double least = SURPRISE + log2(fmax(1, 0.5 * students * (students - 1)));
    double *bits = memory_new((size_t)students + 1, sizeof *bits);
    Pair *pairs = NULL;
    *count = 0;
    for (size_t at = 0; at < all->count;) {
        const int one = all->by_student[at].student;
        memset(bits, 0, (size_t)students * sizeof *bits);
        for (; at < all->count && all->by_student[at].student == one; at++) {
            const Written *has = &all->by_student[at];
            const double tells = log2(students / (double)has->size);
            for (size_t i = has->first; tells >= TELLS_LEAST && i < has->first + has->size; i++)
                bits[all->by_hash[i].student] += tells;
        }
        for (int two = one + 1; two < students; two++) {
            if (bits[two] < least)
                continue;
            pairs = memory_grow(pairs, (size_t)*count + 1, sizeof *pairs);
            pairs[(*count)++] = (Pair){one, two, bits[two]};
        }
    }
    free(bits);
    if (*count > 0)
        qsort(pairs, (size_t)*count, sizeof *pairs, compare_bits);
    return pairs;
}

/* Whether a student has what a line of the other begins with, if few have it. */
static int count_shared(const Statements *all, int students, const char *line, int other)
{
    uint32_t hash;
    int shared = 0;
    for (const char *at = line; next_hash(&at, &hash);) {
        const Written key = {.hash = hash, .student = other};
        const Written *has =
            bsearch(&key, all->by_hash, all->count, sizeof *all->by_hash, compare_hash);
        shared += has && log2(students / (double)has->size) >= TELLS_LEAST;
    }
    return shared;
}

/* A text's lines; returns how many statements are shared. */
static int set_lines(TemplateValues *pair, const char *side, const Statements *all, int students,
                     const Pair *of)
{
    const bool left = side[0] == 'l';
    int shared = 0;
    for (const char *line = all->texts[left ? of->one : of->two]; *line;) {
        const int same = count_shared(all, students, line, left ? of->two : of->one);
        const char *text = line + strcspn(line, " \n");
        text += *text == ' ';
        TemplateValues *values = template_add(pair, side);
        template_set(values, "line", "%.*s", (int)strcspn(text, "\n"), text);
        template_set(values, "same", "%s", same ? "same" : "");
        shared += same;
        line = text + strcspn(text, "\n");
        line += *line == '\n';
    }
    return shared;
}

void class_similar_set(TemplateValues *page, const ClassStore *store)
{
    Statements all;
    int count;
    open_statements(&all, store);
    Pair *pairs = find_pairs(&all, store->count, &count);
    template_set(page, "similar_heading", "%s", count ? "Similar submissions" : "");
    for (int i = 0; i < count && i < SHOWN_MAX; i++) {
        TemplateValues *pair = template_add(page, "similar");
        template_set(pair, "one", "%s", store->results[pairs[i].one].student);
        template_set(pair, "two", "%s", store->results[pairs[i].two].student);
        set_lines(pair, "left", &all, store->count, &pairs[i]);
        template_set(pair, "shared", "%d", set_lines(pair, "right", &all, store->count, &pairs[i]));
    }
    for (int i = 0; i < store->count; i++)
        free(all.texts[i]);
    free(all.texts);
    free(all.by_hash);
    free(all.by_student);
    free(pairs);
}
