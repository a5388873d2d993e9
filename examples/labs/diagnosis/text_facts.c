/* Some faults are in the text alone: an index beyond an array, a varying that is never set, a
 * colour that is never written draw one thing here and another elsewhere. Each is searched for as
 * words beside words, in a text without comments, and only in the forms that students write: what
 * is written in another way is not found, but nothing else is taken for it. */
#include "labs/diagnosis/text_facts.h"

#include "base/memory.h"
#include "base/text.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A copy without comments, which the caller frees. */
static char *plain_text(const char *text)
{
    char *plain = memory_text(text);
    text_strip_comments(plain);
    return plain;
}

static const char *skip_white(const char *text)
{
    return text + strspn(text, " \t\n\v\f\r");
}

bool text_is_same(const char *a, const char *b)
{
    if (!a || !b)
        return false;
    char *first = plain_text(a), *second = plain_text(b);
    const char *p = skip_white(first), *q = skip_white(second);
    for (; *p && *p == *q; p = skip_white(p + 1))
        q = skip_white(q + 1);
    const bool same = *p == *q;
    free(first);
    free(second);
    return same;
}

bool text_is_starter(const Lab *lab, const SubmissionFiles *files)
{
    SubmissionFiles starter;
    char folder[PATH_MAX], names[LAB_MAX_FILES][LAB_NAME_SIZE];
    if (!lab_folder(lab, folder, NULL) || !submission_files_open(&starter, lab, folder, NULL))
        return false;
    bool same = true;
    for (int i = 0, count = lab_files(lab, names); i < count && same; i++)
        same = text_is_same(submission_file(files, names[i]), submission_file(&starter, names[i]));
    submission_files_close(&starter);
    return same;
}

static int count_word(const char *text, const char *word)
{
    int count = 0;
    const size_t length = strlen(word);
    for (const char *at = text; (at = strstr(at, word)); at += length)
        count += (at == text || !text_is_word(at[-1])) && !text_is_word(at[length]);
    return count;
}

/* A varying that the vertex shader only declares, and the fragment shader uses. */
static bool find_unset(const char *vertex, const char *fragment, char name[64])
{
    for (const char *at = vertex; (at = strstr(at, "varying")); at += 7) {
        const size_t length = strcspn(at, ";");
        const char *end = at + length;
        /* The last word of the declaration. */
        while (end > at && !text_is_word(end[-1]))
            end--;
        const char *start = end;
        while (start > at && text_is_word(start[-1]))
            start--;
        if (!at[length] || memchr(at, ',', length) || memchr(at, '[', length))
            continue;
        snprintf(name, 64, "%.*s", (int)(end - start), start);
        if (count_word(vertex, name) == 1 && count_word(fragment, name) > 1)
            return true;
    }
    return false;
}

static void blame(Verdict *verdict, const char *name, const char *variable, const char *sentence,
                  const char *look)
{
    char text[VERDICT_SENTENCE_SIZE];
    verdict_add_mistake(verdict, name, sentence, look, 0.9);
    snprintf(text, sizeof text, "%s: %s", name, variable);
    snprintf(verdict->message, sizeof verdict->message, "%s", text);
}

bool text_find_fault(const Lab *lab, const SubmissionFiles *files, Verdict *verdict)
{
    char name[64];
    snprintf(name, sizeof name, "%s.vert", lab->file);
    const char *vertex = submission_file(files, name);
    snprintf(name, sizeof name, "%s.frag", lab->file);
    const char *fragment = submission_file(files, name);
    char *first = vertex ? plain_text(vertex) : NULL;
    char *second = fragment ? plain_text(fragment) : NULL;
    bool found = true;
    if (!first || !second || strstr(first, "#include") || strstr(second, "#include")) {
        found = false;
    } else if (!count_word(second, "gl_FragColor") && !count_word(second, "gl_FragData")) {
        blame(verdict, "no gl_FragColor", "the fragment shader never sets it",
              "The fragment shader sets no colour, so anything may be drawn.",
              "the end of the fragment shader's main: gl_FragColor = ...");
    } else if (find_unset(first, second, name)) {
        blame(verdict, "varying never set", name,
              "The vertex shader declares a varying and never sets it; the fragment shader reads "
              "what is there by chance.",
              "the vertex shader: set each varying in main");
    } else {
        found = false;
    }
    free(first);
    free(second);
    return found;
}

bool text_has_word(const SubmissionFiles *files, const char *word)
{
    bool found = false;
    for (int i = 0; i < files->count && !found; i++) {
        char *plain = plain_text(files->texts[i].text);
        found = count_word(plain, word) > 0;
        free(plain);
    }
    return found;
}

static const char *skip_spaces(const char *p)
{
    return p + strspn(p, " \t\r\n");
}

/* Reads an identifier and what is white after it; NULL: there is none, or it is too long. */
static const char *read_name(const char *p, char name[64])
{
    size_t length = 0;
    p = skip_spaces(p);
    while (text_is_word(p[length]))
        length++;
    if (length == 0 || length >= 64 || isdigit((unsigned char)p[0]))
        return NULL;
    snprintf(name, 64, "%.*s", (int)length, p);
    return skip_spaces(p + length);
}

/* Reads a number, or a macro of one. NULL: it is something else. */
static const char *read_size(const char *plain, const char *p, int *size)
{
    char name[64], other[64];
    char *end;
    p = skip_spaces(p);
    if (isdigit((unsigned char)*p)) {
        *size = (int)strtol(p, &end, 10);
        return text_is_word(*end) || *end == '.' ? NULL : skip_spaces(end);
    }
    const char *rest = read_name(p, name);
    const char *define = rest ? plain : NULL;
    while (define && (define = strstr(define, "#define"))) {
        define = read_name(define + 7, other);
        if (define && strcmp(name, other) == 0 && isdigit((unsigned char)*define)) {
            *size = (int)strtol(define, &end, 10);
            return *end == '\n' || *end == '\r' || *end == ' ' ? rest : NULL;
        }
    }
    return NULL;
}

/* The size of a uniform array; 0: there is none, or it is not known. */
static int array_size(const char *plain, const char *array)
{
    char name[64];
    int size = 0;
    for (const char *at = plain; (at = strstr(at, "uniform")); at += 7) {
        const char *end = strchr(at, ';');
        for (const char *p = at; end && p < end; p++) {
            if (text_is_word(*p) && (p == at || !text_is_word(p[-1]))) {
                const char *rest = read_name(p, name);
                if (rest && strcmp(name, array) == 0 && *rest == '[')
                    return read_size(plain, rest + 1, &size) ? size : 0;
            }
        }
    }
    return 0;
}

/* A loop "for (int COUNTER = N; COUNTER < N; COUNTER++)". */
typedef struct Loop {
    char counter[64];
    int last;         /* its last value */
    const char *test; /* "<" or "<=" */
    const char *body;
} Loop;

/* What follows "for"; false: something else. */
static bool read_header(const char *plain, const char *p, Loop *loop)
{
    char word[64], *counter = loop->counter;
    int first, *last = &loop->last;
    if (*(p = skip_spaces(p)) != '(' || !(p = read_name(p + 1, word)) || strcmp(word, "int") != 0 ||
        !(p = read_name(p, counter)) || *p != '=' || !(p = read_size(plain, p + 1, &first)) ||
        *p != ';' || !(p = read_name(p + 1, word)) || strcmp(word, counter) != 0 || *p != '<')
        return false;
    const bool up_to = p[1] == '=';
    loop->test = p;
    if (!(p = read_size(plain, p + 1 + up_to, last)) || *p != ';')
        return false;
    *last -= !up_to;
    const size_t length = strcspn(p + 1, ");");
    const char *step = strstr(p, "++");
    loop->body = skip_spaces(p + length + 1 + (p[1 + length] == ')'));
    return step && step < p + 1 + length && p[1 + length] == ')';
}

/* The end of a statement. NULL: one that is not a block or simple. */
static const char *statement_end(const char *p)
{
    int depth = 0;
    if (*p != '{')
        return strncmp(p, "for", 3) == 0 || strncmp(p, "if", 2) == 0 ? NULL : strchr(p, ';');
    for (; *p; p++) {
        depth += (*p == '{') - (*p == '}');
        if (depth == 0)
            return p;
    }
    return NULL;
}

/* Whether the loop's counter is an index alone, and which array ends before its last value. */
static bool overruns(const char *plain, const char *body, const char *end, const char *counter,
                     int last, char array[64])
{
    bool found = false;
    for (const char *p = body; p < end; p++) {
        char word[64];
        if (!text_is_word(*p) || text_is_word(p[-1]))
            continue;
        const char *rest = read_name(p, word);
        if (rest && (strcmp(word, "break") == 0 || strcmp(word, "return") == 0))
            return false;
        if (!rest || strcmp(word, counter) != 0)
            continue;
        const char *open = p - 1;
        while (open > body && isspace((unsigned char)*open))
            open--;
        const char *name = open;
        while (name > body && isspace((unsigned char)name[-1]))
            name--;
        while (name > body && text_is_word(name[-1]))
            name--;
        if (*open != '[' || *rest != ']')
            return false;
        const int size = read_name(name, word) ? array_size(plain, word) : 0;
        if (size > 0 && last >= size && !found) {
            snprintf(array, 64, "%s", word);
            found = true;
        }
    }
    return found;
}

/* The first loop that reads beyond an array, which it names. */
static bool find_overrun(const char *plain, Loop *loop, char array[64])
{
    for (const char *at = plain; (at = strstr(at, "for")); at += 3) {
        if ((at > plain && text_is_word(at[-1])) || text_is_word(at[3]) ||
            !read_header(plain, at + 3, loop))
            continue;
        const char *end = statement_end(loop->body);
        if (end && overruns(plain, loop->body, end, loop->counter, loop->last, array))
            return true;
    }
    return false;
}

/* Not another lab's, which may lie in the same folder. */
static bool is_drawn(const Lab *lab, const char *name)
{
    return strncmp(name, lab->file, strlen(lab->file)) == 0 || strstr(name, ".glsl");
}

bool text_find_overrun(const Lab *lab, const SubmissionFiles *files, Verdict *verdict)
{
    Loop loop;
    char array[64];
    bool found = false;
    for (int i = 0; i < files->count && !found; i++) {
        if (!is_drawn(lab, files->texts[i].name))
            continue;
        char *plain = plain_text(files->texts[i].text);
        found = find_overrun(plain, &loop, array);
        free(plain);
    }
    if (found)
        blame(verdict, "index beyond the array", array,
              "A loop reads beyond the last element, where anything may be: 0 with one driver, the "
              "last light once more with another.",
              "the loop's condition: i < 2 for an array of two");
    return found;
}

bool text_mend_overruns(const Lab *lab, const SubmissionFiles *files, SubmissionFiles *mended)
{
    Loop loop;
    char array[64];
    bool found = false;
    *mended = (SubmissionFiles){.count = 0};
    for (int i = 0; i < files->count; i++) {
        char *text = memory_text(files->texts[i].text), *plain = plain_text(text);
        while (is_drawn(lab, files->texts[i].name) && find_overrun(plain, &loop, array)) {
            const size_t size = strlen(plain) + 32;
            free(text);
            text = memory_new(size, 1);
            snprintf(text, size, "%.*s< %d%s", (int)(loop.test - plain), plain,
                     array_size(plain, array), strchr(loop.test, ';'));
            free(plain);
            plain = plain_text(text);
            found = true;
        }
        submission_files_add(mended, files->texts[i].name, text, strlen(text), NULL);
        free(text);
        free(plain);
    }
    if (!found)
        submission_files_close(mended);
    return found;
}

bool text_find_suspicion(const Lab *lab, const SubmissionFiles *files, Verdict *verdict)
{
    char name[64];
    snprintf(name, sizeof name, "%s.frag", lab->file);
    const char *fragment = submission_file(files, name);
    char *plain = fragment ? plain_text(fragment) : NULL;
    const bool found = plain && count_word(plain, "lowp") > 0;
    free(plain);
    if (found)
        blame(verdict, "lowp", "it may have too few bits",
              "lowp has as few as 9 bits, for numbers from -2 to 2.",
              "the fragment shader's precision: highp float");
    return found;
}
