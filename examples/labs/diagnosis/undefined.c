/* Only what is wrong is diagnosed, and from its numbers: first what is undefined, then what is
 * derived from a right program, then, without a name, which part is wrong.
 *
 * A black picture says nothing about where it is drawn, so pictures of other mistakes match it. The
 * evaluator knows whether its places are right, and which value is the first that is 0, or no
 * number. */
#include "labs/diagnosis/diagnose.h"

#include "base/memory.h"
#include "labs/diagnosis/derivation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What all points have in common, and the first note of each kind. */
typedef struct Facts {
    bool black, places_right, discarded, no_number;
    int nodes[GLSL_NOTE_INDEX + 1]; /* -1: none */
    GlslStage stages[GLSL_NOTE_INDEX + 1];
} Facts;

static void take_notes(Facts *facts, const PointShader *shader, GlslStage stage)
{
    for (int i = 0; i < shader->run->note_count; i++) {
        const GlslNote *note = &shader->run->notes[i];
        if (facts->nodes[note->kind] < 0) {
            facts->nodes[note->kind] = note->node;
            facts->stages[note->kind] = stage;
        }
    }
}

static void gather(Derivation *all, Facts *facts)
{
    *facts = (Facts){.black = true, .places_right = true};
    memset(facts->nodes, -1, sizeof facts->nodes);
    for (int i = 0; i < all->points.count; i++) {
        double numbers[POINT_NUMBERS], right[3];
        points_run(&all->points, &all->own[0], &all->own[1], i, numbers);
        take_notes(facts, &all->own[0], GLSL_VERTEX);
        take_notes(facts, &all->own[1], GLSL_FRAGMENT);
        points_place(&all->points, i, right);
        for (int c = 0; c < 3; c++) {
            facts->black &= numbers[c] < 0.5 / 255;
            facts->discarded |= numbers[c] == -1;
            facts->no_number |= numbers[c] == -2;
            facts->places_right &= fabs(numbers[3 + c] - right[c]) < 1e-3;
        }
    }
}

static void blame(Verdict *verdict, const char *name, const char *sentence, const char *place)
{
    verdict_add_mistake(verdict, name, sentence, place, 0.9);
    snprintf(verdict->message, sizeof verdict->message, "%.63s: %.400s", name, place);
}

/* The first value that is 0 though it is computed, in the shader that makes the colour. */
static bool find_zero(Derivation *all, char *place, size_t size, bool *product)
{
    Values *values = memory_new(1, sizeof *values);
    bool found = false;
    values_trace(&all->points, &all->own[0], &all->own[1], 0, values);
    for (int i = 0; i < values->count && !found; i++) {
        const GlslStage stage = values->items[i].stage;
        const GlslNode *node = &all->own[stage].tree->nodes[values->items[i].node];
        const GlslNode *last = &all->own[stage].tree->nodes[node->first];
        while (last->next)
            last = &all->own[stage].tree->nodes[last->next];
        double most = 0;
        for (int c = 0; c < values->items[i].size && c < 3; c++)
            most = fmax(most, fabs(values->items[i].numbers[c]));
        found = most == 0 && values->items[i].size >= 3 && !last->constant;
        *product = found && node->kind == GLSL_ASSIGN && node->op == GLSL_MULTIPLY;
        if (found)
            derivation_place(all, stage, values->items[i].node, place, size);
    }
    free(values);
    return found;
}

/* The first note of a kind; false: there is none. */
static bool explain_note(Derivation *all, const Facts *facts, int kind, const char *name,
                         const char *sentence, Verdict *verdict)
{
    char place[VERDICT_SENTENCE_SIZE];
    if (facts->nodes[kind] < 0)
        return false;
    derivation_place(all, facts->stages[kind], facts->nodes[kind], place, sizeof place);
    blame(verdict, name, sentence, place);
    return true;
}

/* Of a black picture whose places are right. */
static bool explain_black(Derivation *all, const Facts *facts, Verdict *verdict)
{
    static const int kinds[] = {GLSL_NOTE_ZERO, GLSL_NOTE_POW, GLSL_NOTE_ROOT,
                                GLSL_NOTE_LOG,  GLSL_NOTE_ARC, GLSL_NOTE_NAN};
    bool found = facts->discarded;
    if (found)
        blame(verdict, "every pixel discarded", "No pixel of an object is drawn.",
              "the conditions of discard");
    for (int i = 0; i < (int)(sizeof kinds / sizeof kinds[0]) && facts->no_number && !found; i++)
        found = explain_note(all, facts, kinds[i], "no number", glsl_note_text(kinds[i]), verdict);
    return found;
}

static bool explain_unset(Derivation *all, const Facts *facts, Verdict *verdict)
{
    return explain_note(all, facts, GLSL_NOTE_UNSET, "variable never set",
                        "A variable is read before it has a value, so anything may be drawn.",
                        verdict);
}

/* A loop that counts too far reads what lies behind an array, or its last element again: that
 * depends on the driver. */
static bool explain_index(Derivation *all, const Facts *facts, Verdict *verdict)
{
    const bool found = explain_note(
        all, facts, GLSL_NOTE_INDEX, "index beyond the array",
        "An index is beyond the last element, where anything may be: 0 with one driver, the last "
        "light once more with another.",
        verdict);
    verdict->undefined |= found;
    return found;
}

static int find_symbol(const GlslTree *tree, const char *name)
{
    int found = 0;
    for (int i = 1; i < tree->symbol_count; i++)
        if (tree->symbols[i].kind == GLSL_VARIABLE && strcmp(tree->symbols[i].name, name) == 0)
            found = i;
    return found;
}

/* A colour, a position or a varying that no line sets. */
static bool explain_missing(Derivation *all, Verdict *verdict)
{
    const GlslTree *vertex = all->own[0].tree, *fragment = all->own[1].tree;
    char place[128];
    if (!fragment->symbols[find_symbol(fragment, "gl_FragColor")].written &&
        !fragment->symbols[find_symbol(fragment, "gl_FragData")].written) {
        blame(verdict, "no gl_FragColor",
              "The fragment shader sets no colour, so anything may be drawn.",
              "the end of the fragment shader's main: gl_FragColor = ...");
        return true;
    }
    if (!vertex->symbols[find_symbol(vertex, "gl_Position")].written) {
        blame(verdict, "no gl_Position",
              "The vertex shader sets no position, so nothing may be drawn, or anything.",
              "the vertex shader's main: gl_Position = u_MvpMatrix * a_Position");
        return true;
    }
    for (int i = 1; i < vertex->symbol_count; i++) {
        const GlslSymbol *symbol = &vertex->symbols[i];
        if (symbol->storage != GLSL_VARYING || symbol->written ||
            !derivation_uses(fragment, symbol->name))
            continue;
        snprintf(place, sizeof place, "the vertex shader: set %.60s in main", symbol->name);
        blame(verdict, "varying never set",
              "The vertex shader declares a varying and never sets it; the fragment shader reads "
              "what is there by chance.",
              place);
        return true;
    }
    return false;
}

/* What is undefined, then what is derived. */
static bool explain(Derivation *all, Verdict *verdict)
{
    Facts facts;
    char place[VERDICT_SENTENCE_SIZE];
    bool product = false;
    gather(all, &facts);
    const bool black = facts.black && facts.places_right;
    if (explain_missing(all, verdict) || explain_unset(all, &facts, verdict) ||
        explain_index(all, &facts, verdict) || (black && explain_black(all, &facts, verdict)))
        return true;
    const bool zero = black && find_zero(all, place, sizeof place, &product);
    if (!(zero && product) && derive_mistake(all, verdict))
        return true;
    if (zero)
        blame(verdict, "black: 0 from here on",
              "All is black though all is in its place: a colour is 0, or is multiplied by 0.",
              place);
    return zero;
}

bool diagnose(const LabPictures *pictures, Canvas *canvas, const SubmissionFiles *files,
              Verdict *verdict, FirstWrong *first, Message *message)
{
    Derivation *all = derivation_open(pictures, files, message);
    if (!all && message->text[0])
        return false;
    if (all)
        all->canvas = canvas;
    if (all && !explain(all, verdict))
        wrong_part_describe(all, verdict);
    if (all && first)
        first_wrong_find(all, verdict, first);
    derivation_close(all);
    if (!verdict->message[0])
        snprintf(verdict->message, sizeof verdict->message, "Unknown mistake");
    return true;
}

bool undefined_warn(const LabPictures *pictures, const SubmissionFiles *files, Verdict *verdict,
                    bool *wrong, Message *message)
{
    static const int kinds[] = {GLSL_NOTE_POW, GLSL_NOTE_ROOT, GLSL_NOTE_LOG, GLSL_NOTE_ARC};
    Derivation *all = derivation_open(pictures, files, message);
    char place[VERDICT_SENTENCE_SIZE];
    Facts facts;
    *wrong = false;
    if (!all)
        return !message->text[0];
    gather(all, &facts);
    *wrong = explain_index(all, &facts, verdict);
    for (int i = 0; i < (int)(sizeof kinds / sizeof kinds[0]); i++) {
        const int kind = kinds[i];
        if (facts.nodes[kind] < 0)
            continue;
        derivation_place(all, facts.stages[kind], facts.nodes[kind], place, sizeof place);
        verdict_add_symptom(verdict, "Right with this driver, but undefined: %s, in %s.",
                            glsl_note_text(kind), place);
    }
    derivation_close(all);
    return true;
}
