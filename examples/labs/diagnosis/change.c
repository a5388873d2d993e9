/* A change is of a tree; here it becomes one of the student's text. */
#include "labs/diagnosis/derivation.h"

#include "base/text.h"

#include <stdio.h>
#include <string.h>

/* How much of a text is the other one, whatever its spaces; 0: it does not begin with it. */
static size_t match(const char *own, const char *text)
{
    const char *at = own;
    while (*text) {
        at += strspn(at, " \t\r\n");
        if (*at++ != *text++)
            return 0;
        text += strspn(text, " ");
    }
    return text_is_word(at[-1]) && text_is_word(*at) ? 0 : (size_t)(at - own);
}

void change_take_text(const Derivation *all, const Found *found, VerdictMistake *mistake)
{
    const GlslNode *node = &all->own[found->stage].tree->nodes[found->mutation.node];
    const Mutation *mutation = &found->mutation;
    const bool whole = node->kind == GLSL_EXPRESSION || node->kind == GLSL_ASSIGN;
    snprintf(mistake->file, sizeof mistake->file, "%s.%s", all->lab->file,
             found->stage == GLSL_VERTEX ? "vert" : "frag");
    const char *line = node->place.file == 0 ? submission_file(all->files, mistake->file) : NULL;
    for (int i = 1; i < node->place.line && line; i++)
        line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL;
    for (const char *at = mutation->moves ? NULL : line; at && *at && *at != '\n' && !mistake->line;
         at++) {
        const size_t length =
            at > line && text_is_word(at[-1]) && text_is_word(*at) ? 0 : match(at, mutation->was);
        if (length == 0 || length >= sizeof mistake->text ||
            strlen(mutation->by) + 1 == sizeof mutation->by) /* cut */
            continue;
        mistake->line = node->place.line;
        mistake->column = (int)(at - line) + 1;
        snprintf(mistake->text, sizeof mistake->text, "%.*s", (int)length, at);
        snprintf(mistake->change, sizeof mistake->change,
                 whole || !strchr(mutation->by, ' ') ? "%s" : "(%s)", mutation->by);
    }
}
