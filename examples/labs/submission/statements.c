/* A statement ends with a semicolon, a brace or, if it is a directive, its line: that holds in GLSL
 * and in C, and in texts that do not compile. Its hash is a sum over its words and marks, so that
 * operands may be exchanged; 32 bits are enough for a hint. */
#include "labs/submission/statements.h"

#include "base/memory.h"
#include "base/output_text.h"
#include "base/text.h"
#include "glsl/glsl.h"

#include <ctype.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { STATEMENTS_MAX = 4096, FEWEST_WORDS = 4 };

typedef struct Statements {
    uint32_t hashes[STATEMENTS_MAX];
    int lines[STATEMENTS_MAX]; /* from 0 */
    int count;
} Statements;

/* murmur3's last step (Appleby). */
static uint32_t mix(uint32_t hash)
{
    hash = (hash ^ hash >> 16) * 0x85EBCA6Bu;
    hash = (hash ^ hash >> 13) * 0xC2B2AE35u;
    return hash ^ hash >> 16;
}

static bool has_word(const char *text, const char *word, size_t size)
{
    for (const char *at = text; (at = strchr(at, word[0])) != NULL; at++)
        if (strncmp(at, word, size) == 0 && !text_is_word(at[size]) &&
            (at == text || !(text_is_word(at[-1]) || at[-1] == '.')))
            return true;
    return false;
}

/* Whether a name is the lab's or the language's, as all members' names are, not the student's. */
static bool is_given(const SubmissionFiles *starter, const char *word, size_t size, bool member)
{
    if (member)
        return true;
    for (int i = 0; i < GLSL_FUNCTION_COUNT; i++)
        if (strlen(GLSL_FUNCTIONS[i].name) == size &&
            strncmp(GLSL_FUNCTIONS[i].name, word, size) == 0)
            return true;
    for (int i = 0; i < starter->count; i++)
        if (has_word(starter->texts[i].text, word, size))
            return true;
    return false;
}

/* The hash of the word, number or mark that a text begins with; *end: behind it. */
static uint32_t hash_word(const char *text, const SubmissionFiles *starter, bool member,
                          const char **end)
{
    char *after;
    if (isdigit((unsigned char)*text) || (*text == '.' && isdigit((unsigned char)text[1]))) {
        const double number = strtod(text, &after);
        for (*end = after; text_is_word(**end);)
            ++*end;
        return mix(text_hash(&number, sizeof number));
    }
    for (*end = text; text_is_word(**end);)
        ++*end;
    if (*end == text)
        return mix(text_hash((*end)++, 1));
    const size_t size = (size_t)(*end - text);
    return mix(is_given(starter, text, size, member) ? text_hash(text, size) : text_hash("x", 1));
}

static Statements *read_statements(const char *text, const SubmissionFiles *starter,
                                   Statements *found)
{
    uint32_t sum = 0;
    int words = 0, line = 0, begin = 0;
    bool directive = false;
    for (const char *at = text, *end;; at = end) {
        const char *comment = text_comment_end(at);
        end = comment ? comment : at + 1;
        const bool ends = !*at || strchr(";{}", *at) || (directive && *at == '\n');
        if (ends && words >= FEWEST_WORDS && found->count < STATEMENTS_MAX) {
            found->hashes[found->count] = mix(sum);
            found->lines[found->count++] = begin;
        }
        if (!*at)
            return found;
        if (ends)
            words = 0;
        else if (!comment && !isspace((unsigned char)*at)) {
            sum = words++ ? sum : 0;
            begin = words == 1 ? line : begin;
            directive = words == 1 ? *at == '#' : directive;
            sum += hash_word(at, starter, at > text && at[-1] == '.', &end);
        }
        directive = directive && !ends;
        for (; at < end; at++)
            line += *at == '\n';
    }
}

static bool contains(const Statements *all, uint32_t hash)
{
    for (int i = 0; i < all->count; i++)
        if (all->hashes[i] == hash)
            return true;
    return false;
}

/* The lines of a file, with the hashes of those that are not given. */
static void put_file(FILE *file, const char *text, const Statements *own, const Statements *given)
{
    int next = 0;
    for (int line = 0; *text; line++) {
        const int length = (int)strcspn(text, "\n");
        int put = 0;
        for (; next < own->count && own->lines[next] == line; next++)
            if (!contains(given, own->hashes[next]))
                fprintf(file, "%s%08x", put++ ? "," : "", own->hashes[next]);
        fprintf(file, "%s %.*s\n", put ? "" : "-", length, text);
        text += length + (text[length] == '\n');
    }
}

char *statements_text(const Lab *lab, const SubmissionFiles *files)
{
    char names[LAB_MAX_FILES][LAB_NAME_SIZE], folder[PATH_MAX];
    SubmissionFiles starter = {.count = 0};
    Message why = {.text = ""};
    OutputText out;
    Statements *given = memory_new(2, sizeof *given), *own = given + 1;
    output_text_open(&out);
    if (lab_folder(lab, folder, &why) && submission_files_open(&starter, lab, folder, &why)) {
        for (int i = 0; i < starter.count; i++)
            text_strip_comments((char *)starter.texts[i].text); /* words there are not names */
        for (int i = 0; i < starter.count; i++)
            read_statements(starter.texts[i].text, &starter, given);
        for (int i = 0, count = lab_files(lab, names); i < count; i++) {
            const char *text = submission_file(files, names[i]);
            own->count = 0;
            fprintf(out.file, "- %s\n", names[i]);
            if (text)
                put_file(out.file, text, read_statements(text, &starter, own), given);
        }
    }
    submission_files_close(&starter);
    free(given);
    return output_text_close(&out);
}
