/* A change is of a tree; here it becomes one of the student's text, and is said. */
#include "labs/diagnosis/derivation.h"
#include "labs/diagnosis/mutation_forms.h"

#include "base/memory.h"
#include "base/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double UNIQUE = 0.9, ONE_OF_SEVERAL = 0.75;

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

/* The student's line that a change is in; NULL: it is not in the file. */
static const char *line_of(const Derivation *all, const Found *found, char *file, size_t size)
{
    const GlslPlace *place = &all->own[found->stage].tree->nodes[found->mutation.node].place;
    snprintf(file, size, "%s.%s", all->lab->file, found->stage == GLSL_VERTEX ? "vert" : "frag");
    const char *line = place->file == 0 ? submission_file(all->files, file) : NULL;
    for (int i = 1; i < place->line && line; i++)
        line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL;
    return line;
}

/* The next place in a line, from `at` on, where the text is; NULL: none. */
static const char *next_match(const char *line, const char *at, const char *text, size_t *length)
{
    for (; at && *at && *at != '\n'; at++) {
        *length = at > line && text_is_word(at[-1]) && text_is_word(*at) ? 0 : match(at, text);
        if (*length > 0)
            return at;
    }
    return NULL;
}

/* What is in its line more than once, and a number, becomes the operation around it. */
static void widen(const Derivation *all, Found *found)
{
    GlslTree *tree = all->own[found->stage].tree;
    Mutation *mutation = &found->mutation;
    char file[64], put[MUTATION_TEXT + 2], text[MUTATION_TEXT];
    const char *line = line_of(all, found, file, sizeof file);
    const bool grouped = strchr(mutation->by, ' ');
    size_t length;
    GlslNode was;
    snprintf(put, sizeof put, grouped ? "(%s)" : "%s", mutation->by);
    const int changed = mutation->node;
    while (true) {
        const char *once = next_match(line, line, mutation->was, &length);
        const int above = forms_parent(tree, mutation->node), kind = tree->nodes[above].kind;
        glsl_expression_text(tree, above, text, sizeof text);
        /* A number alone says nothing. */
        const bool number = mutation->node == changed &&
                            tree->nodes[changed].kind == GLSL_LITERAL && strlen(text) < 60;
        if (mutation->moves || !once ||
            (!number && !next_match(line, once + length, mutation->was, &length)) ||
            kind < GLSL_LITERAL || kind > GLSL_CONSTRUCT || strlen(text) + 1 == sizeof text)
            return;
        mutation->node = above;
        memcpy(mutation->was, text, sizeof text);
        mutation_put(tree, changed, put, &was);
        glsl_expression_text(tree, above, mutation->by, sizeof mutation->by);
        mutation_take_back(tree, changed, &was);
    }
}

/* Fills in which of the student's text a change replaces, and by what: not where a macro is. */
static void take_text(const Derivation *all, const Found *found, VerdictMistake *mistake)
{
    const GlslNode *node = &all->own[found->stage].tree->nodes[found->mutation.node];
    const Mutation *mutation = &found->mutation;
    const bool whole = node->kind == GLSL_EXPRESSION || node->kind == GLSL_ASSIGN;
    const char *line = line_of(all, found, mistake->file, sizeof mistake->file);
    size_t length;
    const char *at = mutation->moves ? NULL : next_match(line, line, mutation->was, &length);
    if (!at || length >= sizeof mistake->text ||
        strlen(mutation->by) + 1 == sizeof mutation->by) /* cut */
        return;
    mistake->line = node->place.line;
    mistake->column = (int)(at - line) + 1;
    snprintf(mistake->text, sizeof mistake->text, "%.*s", (int)length, at);
    snprintf(mistake->change, sizeof mistake->change,
             whole || !strchr(mutation->by, ' ') ? "%s" : "(%s)", mutation->by);
}

/* After a colon the right program's words become the submission's at the place, if that is known.
 */
static void name_mutation(const Mutation *mutation, const char *place, char name[MUTATION_TEXT * 2])
{
    const char *colon = strstr(mutation->name, ": "), *own = place ? strstr(place, ": ") : NULL;
    const bool number = !mutation->was[strspn(mutation->was, ".0123456789")];
    const bool lacks =
        strstr(mutation->name, "missing: ") || !strncmp(mutation->name, "left out", 8);
    /* What is missing, a number or a condition, the submission may not have. */
    const bool both = colon && own && !number && !lacks && !strpbrk(mutation->was, "<>?");
    snprintf(name, MUTATION_TEXT * 2, "%.*s%.190s",
             (int)(both ? colon - mutation->name : MUTATION_TEXT), mutation->name, both ? own : "");
}

/* `place` is its name's; NULL: of one of two mistakes it is not known. */
static void add(const Found *found, const char *place, const char *look, double sure,
                Verdict *verdict)
{
    const Mutation *mutation = &found->mutation;
    char name[MUTATION_TEXT * 2], sentence[VERDICT_SENTENCE_SIZE];
    name_mutation(mutation, place, name);
    snprintf(
        sentence, sizeof sentence,
        "%s%sIt draws what the solution would draw if it had %.120s where it has %.120s%s%.120s.",
        mutation->sentence, mutation->sentence[0] ? " " : "",
        mutation->by[0] ? mutation->by : "nothing", mutation->was,
        found->where[0] ? ", where " : "", found->where);
    verdict_add_mistake(verdict, name, sentence, look, sure);
}

/* Whether it undoes something by a formula around it, and has no name: 2 c - 1 for c. */
static bool wraps(const Mutation *mending)
{
    const size_t length = strlen(mending->was);
    return strncmp(mending->mends, mending->was, length) == 0 &&
           strncmp(mending->mends + length, " for ", 5) == 0 && strstr(mending->by, mending->was);
}

/* The line that has to change, and to what. */
static void say_mending(Derivation *all, Found *found, Verdict *verdict)
{
    widen(all, found);
    const Mutation *mending = &found->mutation, *best = &all->best.mutation;
    const bool sole = all->mended_twice ? all->unique : all->mending.apart <= DERIVATION_EQUAL;
    const bool known = all->best.text && best->general && all->unique && all->mending.there;
    const bool likelier = known && best->rank < mending->rank && wraps(mending);
    char place[VERDICT_SENTENCE_SIZE], sentence[VERDICT_SENTENCE_SIZE], look[VERDICT_SENTENCE_SIZE];
    char name[MUTATION_TEXT * 2];
    derivation_place(all, found->stage, mending->node, place, sizeof place);
    name_mutation(best, place, name);
    snprintf(look, sizeof look, "%.220s; all is right with %s%s%s", place,
             mending->by[0] ? mending->by : "nothing there",
             all->mended_twice ? " and the other change" : "",
             strncmp(mending->mends, "times ", 6) == 0 && strstr(mending->by, " / ")
                 ? ": a factor too many comes further on"
                 : "");
    snprintf(sentence, sizeof sentence, "%s%sIt draws what is right with %s instead of %s%s.",
             known ? best->sentence : "", known && best->sentence[0] ? " " : "",
             mending->by[0] ? mending->by : "nothing", mending->was,
             all->mended_twice ? ", once the other mistake is mended, too" : "");
    take_text(all, found,
              verdict_add_mistake(verdict, likelier ? name : mending->mends, sentence, look,
                                  known || sole ? UNIQUE : ONE_OF_SEVERAL));
}

/* Whether the first wrong value is known, and not just the result. */
static bool is_inside(const Derivation *all)
{
    const GlslTree *tree = all->own[all->place_stage].tree;
    const GlslNode *node = &tree->nodes[all->place_node];
    while (node->kind != GLSL_NAME && node->kind != GLSL_VARIABLE_NODE && node->first)
        node = &tree->nodes[node->first];
    const GlslSymbol *symbol = &tree->symbols[node->symbol];
    return all->place_node && !symbol->built_in && symbol->storage != GLSL_VARYING;
}

/* "term at another place: a" of "term missing: a" and of "term too many: a", "clamped at another
 * place" of "clamped: a" and of "not clamped: a". True: it is missing. */
static bool name_moved(const Found *found, char name[VERDICT_SENTENCE_SIZE])
{
    const char *text = found->mutation.mends, *missing = strstr(text, " missing: "),
               *many = strstr(text, " too many: "), *what = strstr(text, ": ");
    const int negated = strncmp(text, "not ", 4) == 0 ? 4 : 0;
    const char *end = missing ? missing : many ? many : what ? what : text + negated;
    snprintf(name, VERDICT_SENTENCE_SIZE, "%.*s at another place%s", (int)(end - text) - negated,
             text + negated, missing || many ? what : "");
    return negated || missing;
}

/* Two changes that are one: what is left out at one place is put in at another. */
static bool say_moved(Derivation *all, Verdict *verdict)
{
    char name[VERDICT_SENTENCE_SIZE], first[VERDICT_SENTENCE_SIZE], then[VERDICT_SENTENCE_SIZE];
    const bool missing = name_moved(&all->mending, first), other = name_moved(&all->second, name);
    const Found *from = missing ? &all->second : &all->mending;
    const Found *to = missing ? &all->mending : &all->second;
    if (missing == other || name[0] == ' ' || strcmp(name, first) != 0)
        return false;
    derivation_place(all, from->stage, from->mutation.node, first, sizeof first);
    derivation_place(all, to->stage, to->mutation.node, then, sizeof then);
    char *look = memory_format("%s; all is right with %s there and with %s at %s", first,
                               from->mutation.by, to->mutation.by, then);
    verdict_add_mistake(verdict, name, "It belongs elsewhere.", look,
                        all->unique ? UNIQUE : ONE_OF_SEVERAL);
    free(look);
    return true;
}

/* A change elsewhere than at the first wrong value makes up for a mistake, but of a shadow, which a
 * function returns. */
void change_say(Derivation *all, Verdict *verdict)
{
    const Found *found = all->two_found ? &all->second : &all->best;
    const double sure = all->unique ? UNIQUE : ONE_OF_SEVERAL;
    char place[VERDICT_SENTENCE_SIZE], look[VERDICT_SENTENCE_SIZE];
    const bool other = found->text && found->mutation.general && all->unique && is_inside(all);
    if (all->mended_twice) {
        if (!say_moved(all, verdict)) {
            say_mending(all, &all->mending, verdict);
            say_mending(all, &all->second, verdict);
        }
    } else if (all->mended && (all->mending.there || !other || all->lab->shadow)) {
        say_mending(all, &all->mending, verdict);
    } else {
        derivation_place(all, all->place_stage, all->place_node, place, sizeof place);
        if (all->shown.node)
            derivation_place(all, all->shown.stage, all->shown.node, look, sizeof look);
        else
            snprintf(look, sizeof look, "where %s should be", found->mutation.was);
        if (found->first)
            add(found->first, NULL, look, sure, verdict);
        add(found, !found->first && !found->where[0] && is_inside(all) ? place : NULL, look, sure,
            verdict);
        wrong_part_say(all, verdict);
        all->mended = false;
    }
    const bool same = found->first && found->first->mutation.rank == found->mutation.rank;
    snprintf(verdict->message, sizeof verdict->message, "%s%s%s%s",
             verdict->mistake_count < 2 ? ""
             : same                     ? "Twice the same mistake: "
                                        : "Two mistakes: ",
             verdict->mistakes[0].name, verdict->mistake_count > 1 ? "; " : "",
             verdict->mistake_count > 1 ? verdict->mistakes[1].name : "");
}
