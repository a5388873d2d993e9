/* Which parts of the points a wrong submission has. A part of the light is right if each of its
 * terms is, seen alone. A variable of the solution is right if the submission computes its value at
 * every point, under whatever name: registers hold each intermediate result of a run. */
#include "labs/diagnosis/derivation.h"

#include "base/memory.h"
#include "labs/diagnosis/diagnose.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static PartState judge_light(Derivation *all, const char *name)
{
    Term terms[MAX_TERMS];
    PartState state = PART_UNSEEN;
    const int count = wrong_part_list(all->lab, terms);
    for (int i = 0; i < count && state != PART_WRONG; i++) {
        if (!strstr(terms[i].name, name))
            continue;
        const PartState of_term = wrong_part_judge(all, &terms[i]);
        state = of_term == PART_UNSEEN ? state : of_term;
    }
    return state;
}

/* Rules out the registers, of both stages, that do not hold a number or what to divide by instead.
 * *any: one is left. */
static void rule_out(const Derivation *all, double number, bool *ruled_out, bool *any)
{
    *any = false;
    for (int stage = 0; stage < 2; stage++) {
        const GlslRun *run = all->own[stage].run;
        for (int i = 0; i < run->code->register_count; i++, ruled_out++) {
            const double held = run->registers[i];
            *ruled_out |= !(fabs(held - number) <= 1e-5 * (1 + fabs(number)) ||
                            fabs(held * number - 1) <= 1e-5);
            *any |= !*ruled_out;
        }
    }
}

static PartState judge_variable(Derivation *all, const char *name)
{
    enum { MOST = 16 }; /* numbers, of a matrix */
    const int registers =
        all->own[0].run->code->register_count + all->own[1].run->code->register_count;
    bool *ruled_out = memory_new(MOST * (size_t)registers, 1), any = true;
    Values *values = memory_new(1, sizeof *values);
    PartState state = PART_UNSEEN;
    for (int i = 0; i < all->points.count && any; i++) {
        values_trace(&all->points, &all->right[0], &all->right[1], i, values);
        const GlslRun *run = all->right[glsl_last(all->right[1].run, name) ? 1 : 0].run;
        const GlslEvent *event = glsl_last(run, name);
        if (!event)
            continue;
        values_trace(&all->points, &all->own[0], &all->own[1], i, values);
        for (int k = 0; k < event->count && k < MOST && any; k++)
            rule_out(all, run->values[event->value + k], ruled_out + k * registers, &any);
        state = any ? PART_RIGHT : PART_WRONG;
    }
    free(ruled_out);
    free(values);
    return state;
}

bool parts_judge(const LabPictures *pictures, const SubmissionFiles *files, Verdict *verdict,
                 Message *message)
{
    Derivation *all = verdict->part_count ? derivation_open(pictures, files, message) : NULL;
    if (!all)
        return !message->text[0];
    const bool known = derive_use_right(all, "", LIT_NEAREST);
    for (int i = 0; i < verdict->part_count && known; i++) {
        VerdictPart *part = &verdict->parts[i];
        part->state = lab_has_light(all->lab, part->name) ? judge_light(all, part->name)
                                                          : judge_variable(all, part->name);
    }
    derivation_close(all);
    return true;
}
