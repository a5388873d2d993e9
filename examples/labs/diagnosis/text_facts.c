#include "labs/diagnosis/text_facts.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A copy without comments, which the caller frees; also without white space unless `spaces`. NULL:
 * out of memory. */
static char *plain_text(const char *text, bool spaces)
{
    char *plain = malloc(strlen(text) + 2), *to = plain;
    for (const char *p = text; plain && *p;) {
        if (p[0] == '/' && p[1] == '/') {
            p += strcspn(p, "\n");
        } else if (p[0] == '/' && p[1] == '*') {
            const char *end = strstr(p + 2, "*/");
            p = end ? end + 2 : p + strlen(p);
            if (spaces)
                *to++ = ' ';
        } else {
            if (spaces || !isspace((unsigned char)*p))
                *to++ = *p;
            p++;
        }
    }
    if (plain)
        *to = '\0';
    return plain;
}

bool text_is_same(const char *a, const char *b)
{
    char *first = a && b ? plain_text(a, false) : NULL, *second = b ? plain_text(b, false) : NULL;
    const bool same = first && second && strcmp(first, second) == 0;
    free(first);
    free(second);
    return same;
}

bool text_is_starter(const Lab *lab, const SubmissionFiles *files)
{
    SubmissionFiles starter;
    char folder[PATH_MAX], name[64];
    static const char *const endings[] = {".vert", ".frag"};
    if (!lab_folder(lab, folder, NULL) || !submission_files_open(&starter, lab, folder, NULL))
        return false;
    bool same = true;
    for (int i = 0; i < 2 && !lab->given; i++) {
        snprintf(name, sizeof name, "%s%s", lab->file, endings[i]);
        same = same && text_is_same(submission_file(files, name), submission_file(&starter, name));
    }
    if (lab->code)
        same = same && text_is_same(submission_file(files, lab->code),
                                    submission_file(&starter, lab->code));
    submission_files_close(&starter);
    return same;
}

static bool is_word(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

static int count_word(const char *text, const char *word)
{
    int count = 0;
    const size_t length = strlen(word);
    for (const char *at = text; (at = strstr(at, word)); at += length)
        count += (at == text || !is_word(at[-1])) && !is_word(at[length]);
    return count;
}

/* A varying that the vertex shader only declares, and the fragment shader uses. */
static bool find_unset(const char *vertex, const char *fragment, char name[64])
{
    for (const char *at = vertex; (at = strstr(at, "varying")); at += 7) {
        const size_t length = strcspn(at, ";");
        const char *end = at + length;
        /* The last word of the declaration. */
        while (end > at && !is_word(end[-1]))
            end--;
        const char *start = end;
        while (start > at && is_word(start[-1]))
            start--;
        if (!at[length] || memchr(at, ',', length) || memchr(at, '[', length))
            continue;
        snprintf(name, 64, "%.*s", (int)(end - start), start);
        if (count_word(vertex, name) == 1 && count_word(fragment, name) > 1)
            return true;
    }
    return false;
}

/* The name in "`x' used uninitialized" of the shaders' logs. */
static bool find_uninitialized(GLuint program, char name[64])
{
    GLuint shaders[2];
    GLsizei count = 0;
    glGetAttachedShaders(program, 2, &count, shaders);
    for (int i = 0; i < count; i++) {
        static char log[4096];
        log[0] = '\0';
        /* In a browser a shader that only the program keeps has no name. */
        if ((GLint)shaders[i] <= 0)
            continue;
        glGetShaderInfoLog(shaders[i], sizeof log, NULL, log);
        const char *used = strstr(log, "' used uninitialized");
        const char *start = used;
        while (start && start > log && start[-1] != '`')
            start--;
        if (used && start > log) {
            snprintf(name, 64, "%.*s", (int)(used - start), start);
            return true;
        }
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

bool text_find_fault(const Lab *lab, const SubmissionFiles *files, GLuint program, Verdict *verdict)
{
    char name[64];
    snprintf(name, sizeof name, "%s.vert", lab->file);
    const char *vertex = submission_file(files, name);
    snprintf(name, sizeof name, "%s.frag", lab->file);
    const char *fragment = submission_file(files, name);
    char *first = vertex ? plain_text(vertex, true) : NULL;
    char *second = fragment ? plain_text(fragment, true) : NULL;
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
    } else if (find_uninitialized(program, name)) {
        blame(verdict, "variable never set", name,
              "A variable is read before it has a value, so anything may be drawn.",
              "its declaration: float x = 0.0");
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
        char *plain = plain_text(files->texts[i].text, true);
        found = plain && count_word(plain, word) > 0;
        free(plain);
    }
    return found;
}

bool text_find_suspicion(const Lab *lab, const SubmissionFiles *files, Verdict *verdict)
{
    char name[64];
    snprintf(name, sizeof name, "%s.frag", lab->file);
    const char *fragment = submission_file(files, name);
    char *plain = fragment ? plain_text(fragment, true) : NULL;
    const bool found = plain && count_word(plain, "lowp") > 0;
    free(plain);
    if (found)
        blame(verdict, "lowp", "it may have too few bits",
              "lowp has as few as 9 bits, for numbers from -2 to 2.",
              "the fragment shader's precision: highp float");
    return found;
}
