#include "diagnose.h"

#include "suspects.h"
#include "symptoms.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Further scenes, the first of which what is named has to match, too, and the others tell suspects
 * apart; and their seeds. */
enum { ALWAYS_FURTHER = 2, MOST_FURTHER = 17, NEAR_FURTHER = 7 };
static const uint64_t FURTHER_SEED = 0x0F0E0D0C0B0A0908u;

/* More than these are no finding. */
enum { MOST_ALIKE = VERDICT_MOST_MISTAKES };

static const double SURE = 0.99, LESS_SURE = 0.9;

static bool same_names(const Suspect *a, const Suspect *b)
{
    return (a->mistakes[0] == b->mistakes[0] && a->mistakes[1] == b->mistakes[1]) ||
           (a->mistakes[0] == b->mistakes[1] && a->mistakes[1] == b->mistakes[0]);
}

/* Leaves one suspect of those with the same names. */
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

/* In further scenes: two, and more where several match, or one nearly does. */
static bool tell_apart(Lineup *lineup, uint64_t seed, Suspect *suspects, int *count, bool near,
                       Message *message)
{
    static const ProbeKind kinds[] = {PROBE_ALONG,  PROBE_AGAINST, PROBE_MOVED, PROBE_CROWD,
                                      PROBE_BEHIND, PROBE_COARSE,  PROBE_WIDE};
    enum { KINDS = sizeof kinds / sizeof kinds[0] };
    /* The submission's C gave no matrices for other moments. */
    if (lineup->shots->lab->given)
        return true;
    for (int i = 0; i<MOST_FURTHER && * count> 0; i++) {
        Probe probe;
        if (i >= ALWAYS_FURTHER && (!near || i >= NEAR_FURTHER) && all_same(suspects, *count))
            break;
        if (!probe_open_seed(&probe, lineup->shots->lab, kinds[i % KINDS],
                             (seed ^ FURTHER_SEED) + (uint64_t)i, message))
            return false;
        const bool done = lineup_confront(lineup, &probe, suspects, count, message);
        probe_close(&probe);
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

/* The mistake that is in all of the suspects; -1: none. */
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

static void say(Verdict *verdict, const char *text)
{
    snprintf(verdict->message, sizeof verdict->message, "%s", text);
}

/* What is left over. False where that is nothing to be named. */
static bool name(Verdict *verdict, Suspect *suspects, int count, bool near)
{
    const double sure = near ? LESS_SURE : SURE;
    unite(suspects, &count);
    if (count == 0)
        return false;
    const bool pair = suspects[0].mistakes[1] >= 0;
    const int common = common_mistake(suspects, count);
    if (count == 1) {
        add(verdict, suspects[0].mistakes[0], sure);
        if (pair)
            add(verdict, suspects[0].mistakes[1], sure);
        snprintf(verdict->message, sizeof verdict->message, "%s%s%s%s",
                 pair ? "Two mistakes: " : "", MISTAKES[suspects[0].mistakes[0]].name,
                 pair ? "; " : "", pair ? MISTAKES[suspects[0].mistakes[1]].name : "");
        return true;
    }
    if (pair && common >= 0) {
        add(verdict, common, LESS_SURE);
        snprintf(verdict->message, sizeof verdict->message,
                 "Two mistakes: %s; the other one was not identified", MISTAKES[common].name);
        return true;
    }
    if (pair || count > MOST_ALIKE)
        return false;
    verdict->one_of = true;
    for (int i = 0; i < count; i++)
        add(verdict, suspects[i].mistakes[0], 1.0 / count);
    say(verdict, "One of several mistakes that draw the same");
    return true;
}

/* Screens, verifies and tells apart; leaves those that match. */
static bool narrow(Lineup *lineup, uint64_t seed, Suspect *suspects, int *count, bool *near,
                   Message *message)
{
    return lineup_screen(lineup, suspects, count, message) &&
           lineup_verify(lineup, suspects, count, near, message) &&
           (*count == 0 || tell_apart(lineup, seed, suspects, count, *near, message));
}

/* Pairs of two single mistakes: those that move the outline only where it is moved. */
static Suspect *make_pairs(const Lineup *lineup, const Suspect *singles, int count, int *pairs)
{
    Suspect *made = malloc(((size_t)count * (size_t)count / 2 + 1) * sizeof *made);
    *pairs = 0;
    for (int i = 0; made && i < count; i++)
        for (int k = i + 1; k < count; k++)
            if (catalogue_pair(&singles[i], &singles[k], &made[*pairs]) &&
                (lineup->shots->lab->given || catalogue_moves(&made[*pairs]) == lineup->moved))
                (*pairs)++;
    return made;
}

static bool find(Lineup *lineup, Verdict *verdict, bool *named, Message *message)
{
    int count, left, pair_count = 0;
    bool near = false;
    Suspect *singles = catalogue_singles(lineup->shots->lab, &count);
    Suspect *tried = malloc(((size_t)count + 1) * sizeof *tried), *pairs = NULL;
    bool done = singles && tried;
    *named = false;
    if (!done) {
        message_set(message, "not enough memory");
        goto end;
    }
    left = count;
    memcpy(tried, singles, (size_t)count * sizeof *tried);
    done = narrow(lineup, verdict->seed, tried, &left, &near, message);
    if (!done || left > 0) {
        *named = done && name(verdict, tried, left, near);
        goto end;
    }
    pairs = make_pairs(lineup, singles, count, &pair_count);
    if (!pairs) {
        done = message_set(message, "not enough memory");
        goto end;
    }
    done = narrow(lineup, verdict->seed, pairs, &pair_count, &near, message);
    *named = done && name(verdict, pairs, pair_count, near);
end:
    free(singles);
    free(tried);
    free(pairs);
    return done;
}

bool diagnose(const Shots *shots, const Painter *painter, Canvas *canvas, Verdict *verdict,
              Message *message)
{
    Lineup lineup;
    bool named = false;
    const bool done = lineup_open(&lineup, shots, painter, canvas, message) &&
                      find(&lineup, verdict, &named, message);
    const bool moved = lineup.moved;
    lineup_close(&lineup);
    if (!done)
        return false;
    symptoms_describe(shots, moved, verdict);
    if (!named)
        say(verdict, "Not identified: no known mistake, and no two of them, draw this in every "
                     "scene");
    return true;
}
