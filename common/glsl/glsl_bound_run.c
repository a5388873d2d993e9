/*
 * Forward, each operation gives a range of its exact result, one of the driver's, and a bound of
 * their difference; what was computed is kept on a tape. Backward from a result, each operation's
 * own rounding counts as often as the result's derivative by it says, over all that the numbers
 * between can be (as FPTaylor does: Solovyev, Jacobsen, Rakamaric and Gopalakrishnan, Rigorous
 * estimation of floating-point round-off errors with symbolic Taylor expansions, FM 2015; with the
 * mean value theorem instead of a remainder): that errors of the same number depend on each other
 * is so known. The same holds of the two directions of the piece, which makes exact ranges narrow.
 *
 * Where a condition may be either, both ways run until they meet, with the compared numbers
 * narrowed to what the way is taken for, and the results are joined; that the driver takes another
 * way than the exact numbers can only be near to where the condition changes, and for that both
 * ways run again, narrowed to there.
 */
#include "glsl/glsl_bound_tape.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

enum { DEAD = -1, DEEPEST = 200 };

/* Branches */

static int run_from(GlslBoundRun *run, int at, int stop);

static void narrow_range(GlslRange *a, GlslRange to)
{
    const GlslRange narrow = {larger(a->low, to.low), smaller(a->high, to.high)};
    if (narrow.low <= narrow.high && !is_any(*a)) /* else this way is not taken */
        *a = narrow;
}

/* All registers with a number get it narrowed. */
static void replace(GlslBoundRun *run, int old, GlslRange exact, GlslRange driver)
{
    State *state = run->state;
    Entry entry = state->entries[old];
    narrow_range(&entry.exact, exact);
    narrow_range(&entry.driver, driver);
    entry.from[0] = old;
    entry.from[1] = -1;
    entry.op = OP_SET;
    entry.by[0] = ONE;
    entry.born = 0;
    entry.converted = 0;
    entry.narrowed = true;
    if (!(entry.middle >= entry.exact.low && entry.middle <= entry.exact.high)) {
        entry.middle = (double)NAN; /* what slopes are from is not here */
        tape_slope(&entry, ANY);
    }
    const int made = tape_add(run, &entry);
    for (int i = 0; i < run->code->register_count; i++)
        if (state->map[i] == old)
            state->map[i] = made;
}

/* What is known of compared numbers where the condition is true, or not; `near`: to where it
 * changes. */
static void narrow(GlslBoundRun *run, int condition, bool yes, bool near)
{
    const Entry *at = &run->state->entries[condition];
    while (at->op == OP_NOT || at->op == OP_BOOL || at->op == OP_SET) {
        if (at->from[0] < 0)
            return;
        yes ^= at->op == OP_NOT;
        at = &run->state->entries[at->from[0]];
    }
    if (at->op != OP_LESS && at->op != OP_LESS_EQUAL)
        return;
    const bool less = yes && at->op == OP_LESS;
    const int of[2] = {at->from[0], at->from[1]};
    const Entry a = run->state->entries[of[0]], b = run->state->entries[of[1]];
    const double z = near ? a.error + b.error : (double)INFINITY;
    const double none = (double)INFINITY;
    GlslRange low[2], high[2]; /* of a and b; exact and driver */
    const GlslRange ends[2][2] = {{a.exact, b.exact}, {a.driver, b.driver}};
    for (int i = 0; i < 2; i++) {
        const GlslRange p = ends[i][0], q = ends[i][1];
        low[i] = (GlslRange){yes ? q.low - z : q.low, yes ? q.high : q.high + z};
        high[i] = (GlslRange){yes ? p.low : p.low - z, yes ? p.high + z : p.high};
        high[i].low = less ? nextafter(high[i].low, none) : high[i].low; /* as pow needs it */
        if (yes) {
            low[i].low = near ? low[i].low : -none;
            high[i].high = near ? high[i].high : none;
        } else {
            low[i].high = near ? low[i].high : none;
            high[i].low = near ? high[i].low : -none;
        }
    }
    replace(run, of[0], low[0], low[1]);
    if (of[1] != of[0])
        replace(run, of[1], high[0], high[1]);
}

/* Reading may move the entries. */
static const Entry *read_entry(GlslBoundRun *run, int at)
{
    const int read = tape_read(run, at);
    return &run->state->entries[read];
}

/* Runs one way of a branch; its registers are put into `map`. False: it ends before. */
static bool run_way(GlslBoundRun *run, const GlslInstruction *branch, int next, bool yes, bool near,
                    int *map)
{
    State *state = run->state;
    const size_t size = (size_t)run->code->register_count * sizeof *map;
    int *before = memory_new((size_t)run->code->register_count, sizeof *before);
    memcpy(before, state->map, size);
    narrow(run, tape_read(run, branch->a), yes, near);
    const int meets = state->meets[next - 1];
    const bool arrives = run_from(run, yes ? next : branch->d, meets) != DEAD;
    memcpy(map, state->map, size);
    memcpy(state->map, before, size);
    free(before);
    return arrives;
}

static void stop(GlslBoundRun *run, int node)
{
    if (!run->stopped)
        run->node = node;
    run->stopped = true;
}

/* Without what narrowed it. */
static int widest(const State *state, int at)
{
    while (state->entries[at].narrowed)
        at = state->entries[at].from[0];
    return at;
}

/* What each register holds where ways meet; `maps` after each way, and after each near to where the
 * condition changes. */
static void join_all(GlslBoundRun *run, int *const maps[4], int ways, int node)
{
    State *state = run->state;
    for (int i = 0; i < run->code->register_count; i++) {
        int of[4];
        if (maps[0][i] == maps[1][i]) {
            state->map[i] = maps[0][i];
            continue;
        }
        for (int k = 0; k < 4; k++) {
            state->map[i] = maps[k][i];
            of[k] = tape_read(run, i);
        }
        const int first = widest(state, of[0]);
        state->map[i] =
            first == widest(state, of[1]) ? first : tape_join(run, of, of + 2, ways, node);
    }
}

/* Returns where the ways of an uncertain branch meet. */
static int run_branch(GlslBoundRun *run, const GlslInstruction *at, int next)
{
    State *state = run->state;
    const int condition = tape_read(run, at->a), meets = state->meets[next - 1];
    const int ways = ways_of(&state->entries[condition]);
    const bool differ = ways & (FIRST_SECOND | SECOND_FIRST);
    const size_t registers = (size_t)run->code->register_count;
    int *all = memory_new(registers * 4, sizeof *all);
    int *maps[4] = {all, all + registers, all, all + registers};
    bool arrives[2];
    if (++state->depth > DEEPEST)
        stop(run, at->node);
    state->apart += differ;
    for (int i = 0; i < 2; i++)
        arrives[i] = !run->stopped && run_way(run, at, next, i == 0, false, maps[i]);
    for (int i = 0; i < 2 && differ && arrives[0] && arrives[1]; i++) {
        maps[2 + i] = all + registers * (size_t)(2 + i);
        run_way(run, at, next, i == 0, true, maps[2 + i]);
    }
    state->apart -= differ;
    state->depth--;
    if (arrives[0] && arrives[1])
        join_all(run, maps, ways, at->node);
    else if (arrives[0] || arrives[1])
        memcpy(state->map, maps[arrives[0] ? 0 : 1], registers * sizeof *all);
    if (differ && arrives[0] != arrives[1]) /* discarded or not */
        stop(run, at->node);
    free(all);
    return run->stopped || !(arrives[0] || arrives[1]) ? DEAD : meets;
}

/* Running */

static int joined(GlslBoundRun *run, int a, int b, double error, int node)
{
    const int of[2] = {a, b};
    return a == b
               ? a
               : tape_join(run, of, of,
                           BOTH_FIRST | BOTH_SECOND | (error > 0 ? FIRST_SECOND | SECOND_FIRST : 0),
                           node);
}

/* Elements of an array whose index is not known are all of them. */
static void run_element(GlslBoundRun *run, const GlslInstruction *at)
{
    State *state = run->state;
    const Entry address = *read_entry(run, at->b);
    const bool loads = at->op == OP_LOAD;
    const int base = loads ? at->a : at->d;
    const int first = base + (int)hull(address.exact, address.driver).low;
    const int last = base + (int)hull(address.exact, address.driver).high;
    const int stored = loads ? 0 : tape_read(run, at->a);
    int found = tape_read(run, first);
    for (int i = first; i <= last && loads; i++)
        found = joined(run, found, tape_read(run, i), address.error, at->node);
    for (int i = first; i <= last && !loads; i++)
        state->map[i] = first == last
                            ? stored
                            : joined(run, tape_read(run, i), stored, address.error, at->node);
    if (loads)
        state->map[at->d] = found;
}

static GlslRange index_range(const GlslInstruction *at, GlslRange base, GlslRange index)
{
    const double low = trunc(smaller(larger(index.low, 0), at->n - 1));
    const double high = trunc(smaller(larger(index.high, 0), at->n - 1));
    return range_sum(base, (GlslRange){at->c * low, at->c * high});
}

static void run_index(GlslBoundRun *run, const GlslInstruction *at)
{
    const State *state = run->state;
    const int start = at->a < 0 ? tape_add_constant(run, 0) : tape_read(run, at->a);
    const int chosen = tape_read(run, at->b);
    const Entry *base = &state->entries[start], *index = &state->entries[chosen];
    Entry made = {.node = at->node, .from = {-1, -1}};
    made.exact = index_range(at, base->exact, index->exact);
    made.driver = index_range(at, base->driver, index->driver);
    made.middle = is_point(made.exact) ? made.exact.low : (double)NAN;
    made.born = made.error =
        base->error + index->error > 0 ? range_difference(made.exact, made.driver) : 0;
    tape_slope(&made, is_point(made.exact) ? NONE : ANY);
    const int entry = tape_add(run, &made);
    state->map[at->d] = entry;
}

/* A texture's colours are the same for both, but at edges of what it shows. */
static void run_texture(GlslBoundRun *run, const GlslInstruction *at)
{
    State *state = run->state;
    GlslRange places[16], color[4] = {{0, 1}, {0, 1}, {0, 1}, {0, 1}};
    const int count = at->n < 16 ? at->n : 16, unit = tape_read(run, at->a);
    for (int i = 0; i < count; i++) {
        const Entry *place = read_entry(run, at->b + i);
        places[i] = place->exact;
    }
    if (run->texture)
        run->texture(run->context, (int)state->entries[unit].exact.low, at->c, places, count,
                     color);
    for (int i = 0; i < 4; i++) {
        Entry made = {.exact = color[i],
                      .driver = color[i],
                      .middle = is_point(color[i]) ? color[i].low : (double)NAN,
                      .precision = GLSL_HIGHP,
                      .from = {-1, -1}};
        tape_slope(&made, is_point(color[i]) ? NONE : ANY);
        const int added = tape_add(run, &made);
        state->map[at->d + i] = added;
    }
}

static bool is_of_one(int op)
{
    static const bool one[OP_NUMBERS] = {
        [OP_NEGATE] = true, [OP_NOT] = true,  [OP_ABS] = true,          [OP_SIGN] = true,
        [OP_FLOOR] = true,  [OP_CEIL] = true, [OP_SIN] = true,          [OP_COS] = true,
        [OP_ASIN] = true,   [OP_ACOS] = true, [OP_ATAN] = true,         [OP_EXP2] = true,
        [OP_LOG2] = true,   [OP_SQRT] = true, [OP_INVERSE_SQRT] = true, [OP_TRUNCATE] = true,
        [OP_BOOL] = true};
    return one[op];
}

static void run_operation(GlslBoundRun *run, const GlslInstruction *at)
{
    int *map = run->state->map;
    const int a = tape_convert(run, tape_read(run, at->a), at->precision);
    if (at->op == OP_SET) {
        map[at->d] = a;
        return;
    }
    const int b = is_of_one(at->op) ? a : tape_convert(run, tape_read(run, at->b), at->precision);
    if (at->op == OP_SELECT) {
        const int of[2] = {b, tape_convert(run, tape_read(run, at->c), at->precision)};
        const int ways = ways_of(&run->state->entries[a]);
        const int made = (ways & ~EDGE) == BOTH_FIRST    ? of[0]
                         : (ways & ~EDGE) == BOTH_SECOND ? of[1]
                                                         : tape_join(run, of, of, ways, at->node);
        map[at->d] = made;
        return;
    }
    const int made = tape_compute(run, at, a, b);
    map[at->d] = made;
}

/* Until an instruction, or the end; DEAD if it is discarded or stops. */
static int run_from(GlslBoundRun *run, int next, int until)
{
    State *state = run->state;
    const GlslCode *code = run->code;
    while (next != until && next < code->instruction_count && next != DEAD) {
        const GlslInstruction *at = &code->instructions[next++];
        if (++state->operations > run->most)
            stop(run, at->node);
        if (run->stopped)
            return DEAD;
        if (at->op < OP_NUMBERS)
            run_operation(run, at);
        else if (at->op == OP_JUMP)
            next = at->d;
        else if (at->op == OP_JUMP_FALSE) {
            const int ways = ways_of(read_entry(run, at->a));
            next = (ways & ~EDGE) == BOTH_FIRST    ? next
                   : (ways & ~EDGE) == BOTH_SECOND ? at->d
                                                   : run_branch(run, at, next);
        } else if (at->op == OP_INDEX)
            run_index(run, at);
        else if (at->op == OP_LOAD || at->op == OP_STORE)
            run_element(run, at);
        else if (at->op == OP_UNSET)
            for (int i = 0; i < at->n; i++)
                state->map[at->d + i] = 0; /* which is 0 here, too */
        else if (at->op == OP_TEXTURE)
            run_texture(run, at);
        else if (at->op == OP_DISCARD)
            return DEAD;
        else if (at->op == OP_END)
            return code->instruction_count;
    }
    return next;
}

bool glsl_bound_run(GlslBoundRun *run)
{
    State *state = run->state;
    const size_t registers = (size_t)run->code->register_count;
    memset(state->map, -1, registers * sizeof(int));
    memset(state->leaves, -1, registers * sizeof(int));
    state->count = state->apart = state->depth = state->operations = 0;
    run->stopped = run->edges = false;
    state->ways = 2;
    state->wide = false;
    for (int k = 0; k < GLSL_WAYS; k++)
        if (run->radius[k] > 0) {
            state->wide = true;
            state->ways = k < 2 ? 2 : k + 1;
        }
    run->node = 0;
    tape_add_constant(run, 0);
    run->discarded = run_from(run, 0, run->code->instruction_count) == DEAD && !run->stopped;
    return !run->stopped;
}

/* Opening */

/* Where ways meet: the first instruction that is on all ways from here to the end; jumps back count
 * as ways out of their loop (Cooper, Harvey and Kennedy, A simple, fast dominance algorithm). */
static void find_meets(const GlslCode *code, int *meets)
{
    const int count = code->instruction_count;
    meets[count] = count;
    for (int i = count - 1; i >= 0; i--) {
        const GlslInstruction *at = &code->instructions[i];
        int a = at->op == OP_JUMP && at->d > i             ? at->d
                : at->op == OP_DISCARD || at->op == OP_END ? count
                                                           : i + 1;
        int b = at->op == OP_JUMP_FALSE ? at->d : a;
        while (a != b)
            if (a < b)
                a = meets[a];
            else
                b = meets[b];
        meets[i] = a;
    }
}

/* A text's lines may have large numbers, those of its files. */
static void number_lines(const GlslTree *tree, State *state)
{
    int *firsts = memory_new((size_t)tree->node_count + 1, sizeof *firsts), count = 1;
    state->line_of = memory_new((size_t)tree->node_count + 1, sizeof(int));
    for (int i = 1; i < tree->node_count; i++) {
        int at = count - 1; /* most often the last */
        while (at > 0 && tree->nodes[firsts[at]].place.line != tree->nodes[i].place.line)
            at--;
        if (at == 0)
            firsts[at = count++] = i;
        state->line_of[i] = at;
    }
    state->lines = memory_new((size_t)count, sizeof(double));
    free(firsts);
}

GlslBoundRun *glsl_bound_open(const GlslCode *code, const GlslErrors *errors)
{
    GlslBoundRun *run = memory_new(1, sizeof *run);
    State *state = run->state = memory_new(1, sizeof *state);
    const size_t registers = (size_t)code->register_count + 1;
    run->code = code;
    run->errors = errors;
    run->most = 1000000;
    run->inputs = memory_new(registers, sizeof *run->inputs);
    state->map = memory_new(registers, sizeof(int));
    state->leaves = memory_new(registers, sizeof(int));
    state->meets = memory_new((size_t)code->instruction_count + 1, sizeof(int));
    find_meets(code, state->meets);
    for (int i = 0; i < code->register_count; i++) {
        const double value = code->start[i];
        const bool kept = is_of_precision(errors, GLSL_HIGHP, value);
        run->inputs[i] = (GlslInput){
            .middle = value,
            .error = kept ? 0 : conversion_of(errors, GLSL_HIGHP, (GlslRange){value, value})};
    }
    number_lines(code->tree, state);
    return run;
}

void glsl_bound_close(GlslBoundRun *run)
{
    if (!run)
        return;
    free(run->state->entries);
    free(run->state->weights);
    free(run->state->map);
    free(run->state->leaves);
    free(run->state->meets);
    free(run->state->lines);
    free(run->state->line_of);
    free(run->state);
    free(run->inputs);
    free(run);
}
