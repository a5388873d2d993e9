/* A black picture says nothing about where it is drawn, so pictures of other mistakes match it. The
 * evaluator knows whether its places are right, and which value is the first that is 0, or no
 * number. */
#include "labs/diagnosis/undefined.h"

#include "base/memory.h"
#include "labs/diagnosis/derivation.h"
#include "labs/diagnosis/derive.h"

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

/* Of a black picture whose places are right. */
static bool explain_black(Derivation *all, const Facts *facts, Verdict *verdict)
{
    static const int kinds[] = {GLSL_NOTE_ZERO, GLSL_NOTE_POW, GLSL_NOTE_ROOT,
                                GLSL_NOTE_LOG,  GLSL_NOTE_ARC, GLSL_NOTE_NAN};
    char place[VERDICT_SENTENCE_SIZE];
    if (facts->discarded) {
        blame(verdict, "every pixel discarded", "No pixel of an object is drawn.",
              "the conditions of discard");
        return true;
    }
    for (int i = 0; i < (int)(sizeof kinds / sizeof kinds[0]) && facts->no_number; i++) {
        const int kind = kinds[i];
        if (facts->nodes[kind] < 0)
            continue;
        derivation_place(all, facts->stages[kind], facts->nodes[kind], place, sizeof place);
        blame(verdict, "no number", glsl_note_text(kind), place);
        return true;
    }
    return false;
}

static bool explain_unset(Derivation *all, const Facts *facts, Verdict *verdict)
{
    char place[VERDICT_SENTENCE_SIZE];
    const GlslStage stage = facts->stages[GLSL_NOTE_UNSET];
    if (facts->nodes[GLSL_NOTE_UNSET] < 0)
        return false;
    derivation_place(all, stage, facts->nodes[GLSL_NOTE_UNSET], place, sizeof place);
    blame(verdict, "variable never set",
          "A variable is read before it has a value, so anything may be drawn.", place);
    return true;
}

bool undefined_explain(const LabPictures *pictures, const SubmissionFiles *files, Verdict *verdict,
                       bool *found, Message *message)
{
    Derivation *all = derivation_open(pictures, files, message);
    Facts facts;
    *found = false;
    if (!all)
        return !message->text[0];
    gather(all, &facts);
    bool done = true;
    *found = explain_unset(all, &facts, verdict);
    if (*found || !facts.black || !facts.places_right || explain_black(all, &facts, verdict)) {
        *found |= facts.black && facts.places_right;
    } else {
        char place[VERDICT_SENTENCE_SIZE];
        bool product = false;
        const bool zero = find_zero(all, place, sizeof place, &product);
        if (!product)
            done = derive_name(pictures, files, verdict, found, message);
        if (zero && done && !*found) {
            blame(verdict, "black: 0 from here on",
                  "All is black though all is in its place: a colour is 0, or is multiplied by 0.",
                  place);
            *found = true;
        }
    }
    derivation_close(all);
    return done;
}

bool undefined_warn(const LabPictures *pictures, const SubmissionFiles *files, Verdict *verdict,
                    Message *message)
{
    static const int kinds[] = {GLSL_NOTE_POW, GLSL_NOTE_ROOT, GLSL_NOTE_LOG, GLSL_NOTE_ARC};
    Derivation *all = derivation_open(pictures, files, message);
    char place[VERDICT_SENTENCE_SIZE];
    Facts facts;
    if (!all)
        return !message->text[0];
    gather(all, &facts);
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
