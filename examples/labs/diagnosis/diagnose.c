/* Elimination, from the simplest explanation on: single mistakes, mistakes that are one wrong
 * number, soft edges of shadows, pairs; then the mutants of a right program. What is left after the
 * submission's own scenes is drawn in further ones, until all that are left have one name. Several
 * names are given only if they look alike in all of these, and none rather than a guess: how sure a
 * name is has been measured on submissions that were not seen before (TEACHING.md). */
#include "labs/diagnosis/diagnose.h"

#include "base/memory.h"
#include "labs/diagnosis/derive.h"
#include "labs/diagnosis/suspects.h"
#include "labs/program/lab_scene_open.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Further scenes: always two; more if several suspects match, or one nearly matches. */
enum { ALWAYS_FURTHER = 2, MAX_FURTHER = 17, NEAR_FURTHER = 7 };
static const uint64_t FURTHER_SEED = 0x0F0E0D0C0B0A0908u;

/* Of names given to work that was never seen while this was written: see TEACHING.md. In lab 11
 * fewer of the latter were true. */
static const double SURE = 0.9, LESS_SURE = 0.75, HARDLY_SURE = 0.5;

static bool same_names(const Suspect *a, const Suspect *b)
{
    return (a->mistakes[0] == b->mistakes[0] && a->mistakes[1] == b->mistakes[1]) ||
           (a->mistakes[0] == b->mistakes[1] && a->mistakes[1] == b->mistakes[0]);
}

/* Keeps one suspect of each name or pair of names. */
static void unite(Suspect *suspects, int *count)
{
    int kept = 0;
    for (int i = 0; i < *count; i++) {
        bool known = false;
        for (int k = 0; k < kept; k++)
            known |= same_names(&suspects[k], &suspects[i]);
        if (!known)
            suspects[kept++] = suspects[i];
    }
    *count = kept;
}

static bool all_same(const Suspect *suspects, int count)
{
    for (int i = 1; i < count; i++)
        if (!same_names(&suspects[0], &suspects[i]))
            return false;
    return true;
}

static bool tell_apart(Lineup *lineup, uint64_t seed, Suspect *suspects, int *count, bool near,
                       Message *message)
{
    static const LabSceneKind kinds[] = {LAB_SCENE_ALONG, LAB_SCENE_AGAINST, LAB_SCENE_MOVED,
                                         LAB_SCENE_CROWD, LAB_SCENE_BEHIND,  LAB_SCENE_COARSE,
                                         LAB_SCENE_WIDE};
    enum { KINDS = sizeof kinds / sizeof kinds[0] };
    /* The submission's C gave no matrices for other times. */
    if (lineup->pictures->lab->given)
        return true;
    for (int i = 0; *count > 0 && i < MAX_FURTHER; i++) {
        LabScene lab_scene;
        if (i >= ALWAYS_FURTHER && (!near || i >= NEAR_FURTHER) && all_same(suspects, *count))
            break;
        if (!lab_scene_open_seed(&lab_scene, lineup->pictures->lab, kinds[i % KINDS],
                                 (seed ^ FURTHER_SEED) + (uint64_t)i, message))
            return false;
        const bool done = lineup_confront(lineup, &lab_scene, suspects, count, message);
        lab_scene_close(&lab_scene);
        if (!done)
            return false;
    }
    return true;
}

static void add(Verdict *verdict, int mistake, double sure)
{
    const Mistake *known = &MISTAKES[mistake];
    verdict_add_mistake(verdict, known->name, known->sentence, known->look, sure);
}

/* The mistake common to all suspects; -1: none. */
static int common_mistake(const Suspect *suspects, int count)
{
    for (int k = 0; k < 2; k++) {
        const int mistake = suspects[0].mistakes[k];
        bool in_all = mistake >= 0;
        for (int i = 1; i < count; i++)
            in_all &= suspects[i].mistakes[0] == mistake || suspects[i].mistakes[1] == mistake;
        if (in_all)
            return mistake;
    }
    return -1;
}

/* Names the suspects that are left; false if they are too many or none. */
static bool name(Verdict *verdict, Suspect *suspects, int count, double sure)
{
    unite(suspects, &count);
    if (count == 0)
        return false;
    const int *first = suspects[0].mistakes, common = common_mistake(suspects, count);
    const bool pair = first[1] >= 0;
    if (count == 1) {
        add(verdict, first[0], sure);
        if (pair)
            add(verdict, first[1], sure);
        snprintf(verdict->message, sizeof verdict->message, "%s%s%s%s",
                 pair ? "Two mistakes: " : "", MISTAKES[first[0]].name, pair ? "; " : "",
                 pair ? MISTAKES[first[1]].name : "");
        return true;
    }
    if (pair && common >= 0) {
        add(verdict, common, LESS_SURE);
        snprintf(verdict->message, sizeof verdict->message,
                 "Two mistakes: %s; the other is unknown", MISTAKES[common].name);
        return true;
    }
    if (pair || count > VERDICT_MAX_MISTAKES)
        return false;
    verdict->one_of = true;
    for (int i = 0; i < count; i++)
        add(verdict, suspects[i].mistakes[0], sure / count);
    snprintf(verdict->message, sizeof verdict->message, "One of several mistakes that look alike");
    return true;
}

/* Keeps the suspects that match in every scene. */
static bool narrow(Lineup *lineup, uint64_t seed, Suspect *suspects, int *count, bool *near,
                   Message *message)
{
    return lineup_screen(lineup, suspects, count, message) &&
           lineup_verify(lineup, suspects, count, near, message) &&
           (*count == 0 || tell_apart(lineup, seed, suspects, count, *near, message));
}

/* Pairs of single mistakes that move the outline if and only if the submission's is moved. */
static Suspect *make_pairs(const Lineup *lineup, const Suspect *singles, int count, int *pairs)
{
    Suspect *made = memory_new((size_t)count * (size_t)count / 2, sizeof *made);
    *pairs = 0;
    for (int i = 0; i < count; i++)
        for (int k = i + 1; k < count; k++)
            if (catalogue_pair(&singles[i], &singles[k], &made[*pairs]) &&
                (lineup->pictures->lab->given || catalogue_moves(&made[*pairs]) == lineup->moved))
                (*pairs)++;
    return made;
}

/* All of the lab, and what is left of them. */
typedef struct Suspects {
    Suspect *singles, *numbers, *tried;
    int single_count, number_count, left;
    bool fitted; /* the numbers have their values */
} Suspects;

/* Tries the mistakes that are one wrong number. */
static bool find_number(Lineup *lineup, Suspects *all, bool *near, Message *message)
{
    if (!all->fitted) {
        const int count = lineup->pictures->lab->given ? 0 : all->number_count;
        all->number_count = 0;
        for (int i = 0; i < count; i++)
            if (lineup_fit(lineup, &all->numbers[i]))
                all->numbers[all->number_count++] = all->numbers[i];
        all->fitted = true;
    }
    Suspect *numbers = all->tried + all->left;
    int count = all->number_count;
    memcpy(numbers, all->numbers, (size_t)count * sizeof *numbers);
    if (!lineup_verify(lineup, numbers, &count, near, message))
        return false;
    all->left += count;
    return true;
}

static bool find_alone(Lineup *lineup, uint64_t seed, Suspects *all, bool *near, Message *message)
{
    all->left = all->single_count;
    memcpy(all->tried, all->singles, (size_t)all->left * sizeof *all->tried);
    if (!lineup_screen(lineup, all->tried, &all->left, message) ||
        !lineup_verify(lineup, all->tried, &all->left, near, message))
        return false;
    /* A wrong number may be nearer than what is nearly the same. */
    if (all->left == 0 || all->tried[0].apart > LINEUP_EXACT * lineup->wrong_by) {
        if (!find_number(lineup, all, near, message))
            return false;
        lineup_nearest(lineup, all->tried, &all->left);
    }
    return all->left == 0 || tell_apart(lineup, seed, all->tried, &all->left, *near, message);
}

/* Appends the number, which is the only suspect. */
static void say_number(Verdict *verdict, const Suspect *number)
{
    const size_t used = strlen(verdict->message);
    const Factor factor = number->choices.factor;
    const int sign = factor == FACTOR_SHADOW_BELOW ? -1 : 1;
    /* Not that of the comparison; as near as it can be told it may be one that is right. */
    if (factor == FACTOR_BIAS_CLIP || factor == FACTOR_BIAS_LARGE)
        return;
    snprintf(verdict->message + used, sizeof verdict->message - used, ": %s %.2g",
             factor == FACTOR_PLUS_LIGHT || factor == FACTOR_PLUS_COLOR ||
                     factor == FACTOR_PLUS_EXPONENT
                 ? "about"
             : factor == FACTOR_GAMMA                            ? "the power is about"
             : factor == FACTOR_LIMIT || factor == FACTOR_COSINE ? "at about"
             : factor >= FACTOR_AMBIENT_VALUE                    ? "at about"
                                                                 : "it is about times",
             sign * factor_value(&number->choices));
}

/* Of several that draw the same, the text may tell which it is. */
static bool choose_one(const Lineup *lineup, Verdict *verdict, Message *message)
{
    bool named = false;
    if (!verdict->one_of)
        return true;
    Verdict *other = memory_new(1, sizeof *other);
    const bool done = derive_name(lineup->pictures, lineup->painter->files, other, &named, message);
    if (named && other->mistake_count == 1 && other->mistakes[0].sure >= SURE) {
        verdict->one_of = false;
        verdict->mistake_count = 1;
        verdict->mistakes[0] = other->mistakes[0];
        snprintf(verdict->message, sizeof verdict->message, "%s", other->message);
    }
    free(other);
    return done;
}

/* Tries single mistakes; then, where edges may be smoothed, those with other edges; then pairs. */
static bool find(Lineup *lineup, Verdict *verdict, bool *named, Message *message)
{
    const double less_sure = lineup->pictures->lab->shadow ? HARDLY_SURE : LESS_SURE;
    int pair_count = 0;
    bool near = false;
    Suspects all = {.left = 0};
    Suspect *pairs = NULL;
    *named = false;
    all.singles = catalogue_singles(lineup->pictures->lab, &all.single_count);
    all.numbers = catalogue_numbers(lineup->pictures->lab, &all.number_count);
    all.tried = memory_new((size_t)all.single_count + (size_t)all.number_count, sizeof *all.tried);
    bool done = find_alone(lineup, verdict->seed, &all, &near, message);
    if (done && all.left == 0 && lineup->pictures->lab->shadow) {
        lineup->soft = true;
        done = find_alone(lineup, verdict->seed, &all, &near, message);
        lineup->soft = false;
        near = true;
    }
    if (done) {
        *named = name(verdict, all.tried, all.left, near ? less_sure : SURE);
        if (*named && verdict->mistake_count == 1 && all.tried[0].choices.factor)
            say_number(verdict, &all.tried[0]);
    }
    if (done && all.left == 0) {
        pairs = make_pairs(lineup, all.singles, all.single_count, &pair_count);
        done = narrow(lineup, verdict->seed, pairs, &pair_count, &near, message);
        *named = done && name(verdict, pairs, pair_count, near ? less_sure : SURE);
    }
    if (done && lineup->painter->files && !lineup->pictures->lab->given)
        done = *named
                   ? choose_one(lineup, verdict, message)
                   : derive_name(lineup->pictures, lineup->painter->files, verdict, named, message);
    free(all.singles);
    free(all.numbers);
    free(all.tried);
    free(pairs);
    return done;
}

bool diagnose(const LabPictures *pictures, const Painter *painter, bool moved, Canvas *canvas,
              Verdict *verdict, Message *message)
{
    Lineup lineup;
    bool named = false;
    const bool done = lineup_open(&lineup, pictures, painter, moved, canvas, message) &&
                      find(&lineup, verdict, &named, message);
    lineup_close(&lineup);
    if (!done)
        return false;
    symptoms_describe(pictures, moved, verdict);
    if (!named && !verdict->message[0])
        snprintf(verdict->message, sizeof verdict->message,
                 "Unknown mistake: no known mistake or pair of them draws this in every scene");
    return true;
}
