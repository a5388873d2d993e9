/* Texts are compared and searched without their comments. */
#include "labs/diagnosis/text_facts.h"

#include "base/memory.h"
#include "base/text.h"

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

bool text_has_word(const SubmissionFiles *files, const char *word)
{
    bool found = false;
    for (int i = 0; i < files->count && !found; i++) {
        char *plain = plain_text(files->texts[i].text);
        found = text_count_word(plain, word) > 0;
        free(plain);
    }
    return found;
}
