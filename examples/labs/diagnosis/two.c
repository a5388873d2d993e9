/* Two changes at once, of the submission until it is right or of the right program until it is as
 * wrong. Light is a sum, so one of the two makes some of its terms, each seen alone, equal to the
 * other program's, or the colours nearer, or computes a value that the other has. What does most of
 * that is tried with a second change: with all that do something, too, then with any.
 */
#include "labs/diagnosis/derivation.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    KEPT = 200,
    SAME = 3,
    WITH_ANY = 9,
    SHARING = 4,
    MOST_PAIRS = 5000, /* half a second */
    MOST_ANY = 8000,
    SEEN = 6,
    MAX_VIEWS = MAX_TERMS,
    TRACES = 2
};

/* A change that does something. */
typedef struct Step {
    Mutation mutation;
    GlslStage stage;
    char *text, *put;
    int gain;            /* of the goal's values */
    double score, print; /* print: steps that compute the same have the same */
    PointShader shader;  /* open when it is asked for */
} Step;

typedef struct Search {
    Derivation *all;
    bool mends, likely;
    PointShader *base, *goal; /* what is changed, until it computes what */
    const double *numbers;    /* that changes try */
    int number_count;
    bool general; /* only changes that try no name and no number */
    Step steps[KEPT + 1], sharing[SHARING];
    int sharing_count; /* those that compute most of the goal's values */
    int step_count, first, pairs, best_first, best_rank;
    bool any;              /* each second change is tried */
    Term views[MAX_VIEWS]; /* all of the light; then its terms */
    int view_count;
    double wanted[MAX_VIEWS][SEEN][POINT_NUMBERS], was[MAX_VIEWS][SEEN];
    Values *values; /* of the goal, TRACES points; then room */
    int shared;     /* of these the base computes */
} Search;

/* Runs a pair in all views: how many are as wanted, and by how much nearer the others are than the
 * base's; and what equal pairs have in common. */
static double look(Search *search, PointShader *const pair[2], double *print)
{
    Derivation *all = search->all;
    double score = 0, numbers[POINT_NUMBERS];
    *print = 0;
    for (int v = 0; v < search->view_count; v++) {
        all->points.without = search->views[v].without;
        for (int i = 0; i < SEEN; i++) {
            points_run(&all->points, pair[0], pair[1], all->order[i], numbers);
            const double apart = points_apart(numbers, search->wanted[v][i]);
            const double was = search->was[v][i];
            for (int k = 0; k < POINT_NUMBERS; k++)
                *print += numbers[k] * (1 + k + 7 * i + 43 * v);
            score += (apart <= DERIVATION_EQUAL) - (was <= DERIVATION_EQUAL);
            score += was > DERIVATION_EQUAL ? 0.5 * fmax(-1, (was - apart) / was) : 0;
        }
    }
    all->points.without = 0;
    return score;
}

/* How many of the goal's values a pair computes. */
static int count_shared(Search *search, PointShader *const pair[2])
{
    Values *values = &search->values[TRACES];
    int shared = 0;
    for (int i = 0; i < TRACES; i++) {
        values_trace(&search->all->points, pair[0], pair[1], search->all->order[2 * i], values);
        shared += values_shared(&search->values[i], values);
    }
    return shared;
}

static void begin(Search *search)
{
    Derivation *all = search->all;
    PointShader *base = search->base, *goal = search->goal;
    search->view_count = wrong_part_list(all->lab, search->views);
    search->views[0] = (Term){.without = 0};
    for (int v = 0; v < search->view_count; v++) {
        all->points.without = search->views[v].without;
        for (int i = 0; i < SEEN; i++) {
            double numbers[POINT_NUMBERS], *wanted = search->wanted[v][i];
            points_run(&all->points, &goal[0], &goal[1], all->order[i], wanted);
            points_run(&all->points, &base[0], &base[1], all->order[i], numbers);
            search->was[v][i] = points_apart(numbers, wanted);
        }
    }
    all->points.without = 0;
    search->values = memory_new(TRACES + 1, sizeof(Values));
    for (int i = 0; i < TRACES; i++)
        values_trace(&all->points, &goal[0], &goal[1], all->order[2 * i], &search->values[i]);
    search->shared = count_shared(search, (PointShader *[]){&base[0], &base[1]});
}

static void close_step(Step *step)
{
    point_shader_close(&step->shader);
    free(step->text);
    free(step->put);
}

static bool is_better(const Step *a, const Step *b)
{
    return a->score != b->score ? a->score > b->score : a->mutation.rank < b->mutation.rank;
}

/* In a right program that is changed, names and numbers that are tried come last. */
static int rank_of(const Search *search, const Mutation *mutation)
{
    return mutation->rank + (search->mends || mutation->general ? 0 : 1000);
}

/* Of steps that compute the same where it was looked, and may not elsewhere, the likeliest; of the
 * others the best. */
static void keep(Search *search, const Step *step)
{
    int at = search->step_count, same = 0, worst = -1;
    for (int i = 0; i < search->step_count; i++) {
        const Step *other = &search->steps[i];
        if (fabs(other->print - step->print) > 1e-9 * (1 + fabs(step->print)))
            continue;
        same++;
        if (worst < 0 ||
            rank_of(search, &other->mutation) >= rank_of(search, &search->steps[worst].mutation))
            worst = i;
    }
    if (same == SAME &&
        rank_of(search, &search->steps[worst].mutation) <= rank_of(search, &step->mutation))
        return;
    if (same == SAME) {
        at = worst;
        close_step(&search->steps[at]);
    } else {
        search->step_count++;
        for (; at > 0 && is_better(step, &search->steps[at - 1]); at--)
            search->steps[at] = search->steps[at - 1];
    }
    search->steps[at] = *step;
    search->steps[at].text = memory_text(step->text);
    search->steps[at].put = memory_text(step->put);
    if (search->step_count > KEPT)
        close_step(&search->steps[--search->step_count]);
}

static void keep_sharing(Search *search, const Step *step)
{
    Step *steps = search->sharing;
    int at = search->sharing_count;
    for (int i = 0; i < at; i++)
        if (fabs(steps[i].print - step->print) <= 1e-9 * (1 + fabs(step->print)))
            return;
    for (; at > 0 && steps[at - 1].gain < step->gain; at--)
        if (at < SHARING)
            steps[at] = steps[at - 1];
        else
            close_step(&steps[at - 1]);
    if (at == SHARING)
        return;
    steps[at] = *step;
    steps[at].text = memory_text(step->text);
    steps[at].put = memory_text(step->put);
    search->sharing_count += search->sharing_count < SHARING;
}

static bool open_changed(const Search *search, const char *text, PointShader *shader)
{
    return mend_open(search->all, text, search->mends, shader);
}

/* A shadow is all or nothing, and many curves make all or nothing of a number. */
static bool is_curve_of_shadow(const Derivation *all, const Mutation *mutation)
{
    static const char *const CURVES[] = {"pow(", "exp(", "sqrt(", "min(", "max("};
    bool curve = false;
    for (int i = 0; i < 5 && all->lab->shadow; i++)
        curve |= strstr(mutation->by, CURVES[i]) && !strstr(mutation->was, CURVES[i]);
    return curve;
}

/* What a submission has too many is found where it is left out. */
static bool is_left_out(const Search *search, const Mutation *mutation)
{
    const bool added = !mutation->general && strstr(mutation->by, mutation->was);
    return mutation->moves || (!search->mends && !mutation->name[0]) ||
           (search->general && !mutation->general) || (search->likely && !mutation->likely) ||
           (!search->mends && added) ||
           (search->mends &&
            (mend_is_given(search->all, mutation) || mend_is_odd(search->all, mutation))) ||
           is_curve_of_shadow(search->all, mutation);
}

static bool try_first(void *context, const Mutation *mutation, const char *text)
{
    Search *search = context;
    Derivation *all = search->all;
    PointShader shader, *pair[2] = {&search->base[0], &search->base[1]};
    if (is_left_out(search, mutation) || !open_changed(search, text, &shader))
        return true;
    pair[all->stage] = &shader;
    if (search->mends && mutation->by[0] == '-' && mend_takes_light(all, pair)) {
        point_shader_close(&shader);
        return true;
    }
    Step step = {.mutation = *mutation,
                 .stage = all->stage,
                 .text = (char *)text,
                 .put = (char *)mutation->put};
    step.score = look(search, pair, &step.print);
    step.gain = count_shared(search, pair) - search->shared;
    step.score += 1.5 * step.gain;
    if (search->mends && step.gain > 0 && mutation->general)
        keep_sharing(search, &step);
    if (step.score > 0.2 || search->likely)
        keep(search, &step);
    point_shader_close(&shader);
    return true;
}

/* Whether it has the names of the pair that was found. */
static bool is_found(const Search *search, const Mutation *second)
{
    const char *first = search->steps[search->first].mutation.mends;
    const char *a = search->all->mending.mutation.mends, *b = search->all->second.mutation.mends;
    return (strcmp(first, a) == 0 && strcmp(second->mends, b) == 0) ||
           (strcmp(first, b) == 0 && strcmp(second->mends, a) == 0);
}

/* Of the submission's changes the likelier ones; of the right program's those that have most of the
 * submission's values on the way, then those without a name or number that was tried. */
static void take_pair(Search *search, const Mutation *second, int rank, const char *text)
{
    Derivation *all = search->all;
    const Step *step = &search->steps[search->first];
    Found first = {.mutation = step->mutation, .stage = step->stage, .text = step->text};
    Found found = {.mutation = *second, .stage = all->stage, .text = (char *)text, .first = &first};
    if (!search->mends)
        derive_compare_values(all, &found);
    const bool better = !all->two_found || found.shared > all->second.shared ||
                        (found.shared == all->second.shared && rank < search->best_rank);
    const char *texts[2] = {NULL};
    texts[step->stage] = step->text;
    texts[all->stage] = text;
    if (better && search->mends && !mend_passes(all, texts))
        return;
    if (!better) {
        all->unique &= found.shared < all->second.shared || rank > search->best_rank ||
                       is_found(search, second);
        return;
    }
    free(all->mending.text);
    free(all->second.text);
    all->unique = all->two_found = true;
    search->best_rank = rank;
    search->best_first = search->first;
    all->mending = first;
    all->mending.text = memory_text(first.text);
    all->second = found;
    all->second.text = memory_text(text);
    all->second.first = &all->mending;
}

/* Beside a second of the other stage. */
static PointShader *open_step(Search *search, Step *step)
{
    const GlslStage stage = search->all->stage;
    search->all->stage = step->stage;
    if (!step->shader.tree)
        open_changed(search, step->text, &step->shader);
    search->all->stage = stage;
    return &step->shader;
}

static bool try_second(void *context, const Mutation *mutation, const char *text)
{
    Search *search = context;
    Derivation *all = search->all;
    Step *first = &search->steps[search->first];
    const bool tried = !search->mends && !(first->mutation.general && mutation->general);
    const int rank = first->mutation.rank + mutation->rank + (tried ? 1000 : 0);
    PointShader shader, *pair[2] = {&search->base[0], &search->base[1]};
    if ((search->mends && all->two_found && rank > search->best_rank) ||
        is_left_out(search, mutation))
        return true;
    search->pairs++;
    if (!open_changed(search, text, &shader))
        return true;
    if (first->stage != all->stage)
        pair[first->stage] = open_step(search, first);
    pair[all->stage] = &shader;
    if (search->mends ? mend_apart(all, pair, DERIVATION_EQUAL) <= DERIVATION_EQUAL &&
                            !mend_takes_light(all, pair)
                      : derive_is_same(all, pair))
        take_pair(search, mutation, rank, text);
    point_shader_close(&shader);
    return search->pairs < (search->any ? MOST_ANY : MOST_PAIRS);
}

static void mutate_all(Search *search, GlslStage stage, MutationTake *take)
{
    search->all->stage = stage;
    mutations_each(search->base[stage].tree, NULL, search->numbers, search->number_count, take,
                   search);
}

static void try_pairs(Search *search)
{
    const Step *first = &search->steps[search->first];
    GlslTree *tree = search->base[first->stage].tree;
    GlslNode was;
    mutation_put(tree, first->mutation.node, first->put, &was);
    mutate_all(search, first->stage, try_second);
    mutation_take_back(tree, first->mutation.node, &was);
    mutate_all(search, 1 - first->stage, try_second);
}

/* Each of the best steps with any second, as one that hides the other; of the submission's the best
 * with any, the others with likely ones. One that computes what the one before does is left out. */
static void try_any(Search *search)
{
    const Step *steps = search->steps;
    search->any = true;
    search->pairs = 0;
    for (int i = 0; i < search->step_count && i < WITH_ANY && search->pairs < MOST_ANY; i++) {
        search->first = i;
        search->likely = search->mends && i > 0;
        if (i == 0 || steps[i].score != steps[i - 1].score)
            try_pairs(search);
    }
}

/* What computes a value of the right program may look farther from it, and so may each of two
 * changes whose mistakes make up for each other. */
static void try_sharing(Search *search)
{
    search->pairs = 0;
    search->likely = false;
    for (int i = 0, count = search->sharing_count;
         count > 0 && i <= count && !search->all->two_found; i++) {
        const Step kept = search->steps[0];
        Step *sharing = &search->sharing[i % count];
        search->first = 0;
        search->general = i < count; /* the best also with what tries names and numbers */
        search->pairs = search->general ? search->pairs : 0;
        search->steps[0] = *sharing;
        try_pairs(search);
        *sharing = search->steps[0];
        search->steps[0] = kept;
    }
    search->general = true;
    search->likely = true;
    for (int i = WITH_ANY; i < search->step_count && !search->all->two_found; i++) {
        search->first = i;
        if (search->steps[i].score != search->steps[i - 1].score)
            try_pairs(search);
    }
}

/* The second step where the first has been put. */
static void try_after(Search *search, int first, const Step *second)
{
    const Mutation *mutation = &search->steps[first].mutation;
    GlslTree *tree = search->base[second->stage].tree;
    GlslNode was;
    search->first = first;
    mutation_put(tree, mutation->node, search->steps[first].put, &was);
    mutations_each(tree, &second->mutation, search->numbers, search->number_count, try_second,
                   search);
    mutation_take_back(tree, mutation->node, &was);
}

static void try_steps(Search *search, int i, int k)
{
    const Step *a = &search->steps[i], *b = &search->steps[k];
    GlslTree *tree = search->base[b->stage].tree;
    GlslNode was[2];
    search->all->stage = b->stage;
    search->first = i;
    if (a->stage != b->stage) {
        try_second(search, &b->mutation, b->text);
        return;
    }
    const bool above = mend_holds(tree, b->mutation.node, a->mutation.node);
    const bool below = mend_holds(tree, a->mutation.node, b->mutation.node);
    if (above)
        try_after(search, i, b);
    if (below)
        try_after(search, k, a);
    if (above || below)
        return;
    mutation_put(tree, a->mutation.node, a->put, &was[0]);
    mutation_put(tree, b->mutation.node, b->put, &was[1]);
    char *text = glsl_print(tree, tree->root);
    mutation_take_back(tree, b->mutation.node, &was[1]);
    mutation_take_back(tree, a->mutation.node, &was[0]);
    try_second(search, &b->mutation, text);
    free(text);
}

/* The best first: by the sum of their places. */
static void try_all_steps(Search *search)
{
    const int count = search->step_count;
    search->pairs = 0;
    for (int sum = 1; sum < 2 * count - 2; sum++)
        for (int i = sum < count ? 0 : sum - count + 1; 2 * i < sum; i++)
            if (search->pairs < MOST_PAIRS)
                try_steps(search, i, sum - i);
}

bool two_find(Derivation *all, TwoOf of)
{
    const bool mends = of == TWO_MEND;
    Search *search = memory_new(1, sizeof *search);
    *search = (Search){.all = all,
                       .mends = mends,
                       .likely = of == TWO_LIKELY,
                       .base = mends ? all->own : all->right,
                       .goal = mends ? all->right : all->own,
                       .numbers = mends ? all->right_numbers : all->numbers,
                       .number_count = mends ? all->right_number_count : all->number_count};
    all->drawn = 0;
    begin(search);
    for (int stage = GLSL_VERTEX; stage <= GLSL_FRAGMENT; stage++)
        mutate_all(search, (GlslStage)stage, try_first);
    try_all_steps(search);
    if (all->two_found && mends) { /* the second may have looked farther from right, alone */
        search->first = search->best_first;
        search->pairs = 0;
        try_pairs(search);
    }
    if (!all->two_found && of != TWO_LIKELY)
        try_any(search);
    if (!all->two_found && mends)
        try_sharing(search);
    all->mended_twice = mends && all->two_found;
    for (int i = 0; i < search->step_count; i++)
        close_step(&search->steps[i]);
    for (int i = 0; i < search->sharing_count; i++)
        close_step(&search->sharing[i]);
    free(search->values);
    free(search);
    return all->two_found;
}
