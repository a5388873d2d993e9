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
#include "glsl/glsl_bound_rules.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* A number on the tape. `slope`: by s and t; `by`: of the result by the operands `from`. */
typedef struct Entry {
    GlslRange exact, driver, slope[2], by[2];
    double middle, slack; /* exactly, where s and t are 0, and how exact a double is */
    double error, born;
    int from[2], node; /* -1: none */
    int converted;     /* to another precision, 0: not yet */
    unsigned char op, precision, converted_to;
    bool narrowed; /* only for a way of a branch */
} Entry;

typedef struct GlslBoundState {
    Entry *entries;
    GlslRange *weights; /* the result's derivatives by each, backward */
    int *map;           /* the entry of each register, -1: as the inputs say */
    int *leaves;        /* what the inputs say, -1: not yet asked for */
    int *meets;         /* where the ways of each instruction's branches meet */
    int count, room, weight_room;
    int apart; /* how many branches are open in which the driver may go another way */
    int depth, operations;
    double *lines; /* errors by line; 0: of the inputs */
    int *nodes, line_count;
} State;

enum { DEAD = -1, DEEPEST = 200 };

static const GlslRange ONE = {1, 1}, NONE = {0, 0};

/* Numbers */

static int add(GlslBoundRun *run, const Entry *entry)
{
    State *state = run->state;
    *(Entry *)memory_add(&state->entries, &state->count, &state->room, sizeof(Entry)) = *entry;
    return state->count - 1;
}

static int add_constant(GlslBoundRun *run, double value)
{
    const GlslRange range = {value, value};
    return add(run, &(Entry){.exact = range, .driver = range, .middle = value, .from = {-1, -1}});
}

/* The entry of a register. */
static int read(GlslBoundRun *run, int at)
{
    int *map = run->state->map;
    if (map[at] >= 0)
        return map[at];
    if (run->state->leaves[at] >= 0)
        return map[at] = run->state->leaves[at];
    const GlslInput *input = &run->inputs[at];
    double reach = 0;
    for (int i = 0; i < 2; i++)
        reach += run->radius > 0 ? run->radius * magnitude(input->slope[i]) : 0;
    reach += reach > 0 ? (fabs(input->middle) + reach) * 0x1p-51 : 0;
    const GlslRange exact = {input->middle - reach, input->middle + reach};
    const Entry leaf = {.exact = exact,
                        .driver = {exact.low - input->error, exact.high + input->error},
                        .middle = input->middle,
                        .slack = reach > 0 ? magnitude(exact) * 0x1p-50 : 0,
                        .error = input->error,
                        .born = input->error,
                        .slope = {input->slope[0], input->slope[1]},
                        .precision = GLSL_HIGHP,
                        .from = {-1, -1}};
    return map[at] = run->state->leaves[at] = add(run, &leaf);
}

static double difference(GlslRange exact, GlslRange driver)
{
    const double most = larger(driver.high - exact.low, exact.high - driver.low);
    return isnan(most) ? (double)INFINITY : most;
}

/* The computation of ranges is rounded, too; whole numbers are not. */
static GlslRange widened(GlslRange a)
{
    if (is_point(a) && a.low == rint(a.low))
        return a;
    return (GlslRange){a.low - fabs(a.low) * 0x1p-51, a.high + fabs(a.high) * 0x1p-51};
}

/* From what is known of the operands: slopes, the narrower of ranges, the smaller of errors. */
static void complete(const GlslBoundRun *run, Entry *entry)
{
    const Entry *entries = run->state->entries;
    double error = entry->born, reach = 0;
    entry->slack = magnitude(entry->exact) * 0x1p-51;
    for (int k = 0; k < 2; k++)
        entry->slope[k] = NONE;
    for (int i = 0; i < 2; i++) {
        if (entry->from[i] < 0 || (entry->by[i].low == 0 && entry->by[i].high == 0))
            continue;
        const Entry *from = &entries[entry->from[i]];
        error += from->error > 0 ? magnitude(entry->by[i]) * from->error : 0;
        entry->slack += from->slack > 0 ? magnitude(entry->by[i]) * from->slack : 0;
        for (int k = 0; k < 2; k++)
            entry->slope[k] =
                range_sum(entry->slope[k], range_product(entry->by[i], from->slope[k]));
    }
    if (run->radius > 0) {
        reach = entry->slack;
        for (int k = 0; k < 2; k++)
            reach += run->radius * magnitude(entry->slope[k]);
        if (entry->middle - reach > entry->exact.low)
            entry->exact.low = entry->middle - reach;
        if (entry->middle + reach < entry->exact.high)
            entry->exact.high = entry->middle + reach;
    }
    entry->exact = widened(entry->exact);
    const double apart = difference(entry->exact, entry->driver);
    if (!(error <= 4 * apart)) { /* less is known of the way here */
        entry->born = error = apart;
        for (int i = 0; i < 2; i++)
            entry->by[i] = NONE;
    }
    entry->error = error;
    if (run->state->apart == 0) {
        entry->driver.low = larger(entry->driver.low, entry->exact.low - error);
        entry->driver.high = smaller(entry->driver.high, entry->exact.high + error);
    }
}

/* A number as one of a precision with fewer bits. */
static int converted(GlslBoundRun *run, int at, int precision)
{
    const GlslErrors *errors = run->errors;
    Entry *entry = &run->state->entries[at];
    const int bits = errors->numbers.of[precision].bits;
    if (bits >= 24 || errors->numbers.of[entry->precision].bits <= bits ||
        (entry->error == 0 && is_point(entry->exact) &&
         is_of_precision(errors, precision, entry->exact.low)))
        return at;
    if (entry->converted && entry->converted_to == precision)
        return entry->converted;
    Entry made = *entry;
    made.converted = 0;
    made.precision = (unsigned char)precision;
    made.op = OP_SET;
    made.from[0] = at;
    made.from[1] = -1;
    made.by[0] = ONE;
    made.by[1] = NONE;
    made.born = conversion_of(errors, precision, entry->driver);
    made.driver.low -= made.born;
    made.driver.high += made.born;
    complete(run, &made);
    const int added = add(run, &made);
    run->state->entries[at].converted = added;
    run->state->entries[at].converted_to = (unsigned char)precision;
    return added;
}

/* Whether an edge at which `difference` of two numbers is 0 runs through each pixel in which the
 * driver's can be on its other side. */
static bool is_edge(const GlslBoundRun *run, const GlslRange slope[2], double error)
{
    for (int i = 0; i < 2; i++) {
        const GlslRange change =
            range_sum(range_product(slope[0], (GlslRange){run->pixel[i][0], run->pixel[i][0]}),
                      range_product(slope[1], (GlslRange){run->pixel[i][1], run->pixel[i][1]}));
        if (smaller(fabs(change.low), fabs(change.high)) > 2 * error &&
            change.low * change.high > 0)
            return true;
    }
    return false;
}

/* Comparisons, and what jumps where a number is 0: errors only near to there. */
static void compare(GlslBoundRun *run, Entry *entry)
{
    static const Entry zero = {.op = OP_SET};
    const Entry *a = &run->state->entries[entry->from[0]];
    const Entry *b = entry->op == OP_SIGN ? &zero : &run->state->entries[entry->from[1]];
    const double error = a->error + b->error;
    const GlslRange apart = range_of(OP_SUBTRACT, a->exact, b->exact, false);
    const bool whole = entry->op == OP_EQUAL || entry->op == OP_NOT_EQUAL;
    entry->by[0] = entry->by[1] = NONE;
    entry->born = 0;
    for (int k = 0; k < 2; k++)
        entry->slope[k] = is_point(entry->exact) ? NONE : ANY;
    if (error == 0 || (!whole && (apart.low > error || apart.high < -error))) {
        entry->driver = entry->exact;
    } else if (is_point(entry->exact) && is_point(entry->driver) &&
               entry->exact.low == entry->driver.low) {
    } else {
        GlslRange slope[2];
        for (int k = 0; k < 2; k++)
            slope[k] = range_sum(a->slope[k], range_product(b->slope[k], (GlslRange){-1, -1}));
        if (!whole && is_edge(run, slope, error)) {
            entry->driver = entry->exact;
            run->edges = true;
        } else {
            entry->born = difference(entry->exact, entry->driver);
        }
    }
    entry->error = entry->born;
}

static double middle_of(const GlslInstruction *at, double a, double b)
{
    const GlslRange x = {a, a}, y = {b, b}, result = range_of(at->op, x, y, false);
    return is_point(result) && !isnan(a) && !isnan(b) ? result.low : (double)NAN;
}

/* Where its middle is not known, nor are slopes. */
static void compute_entry(GlslBoundRun *run, const GlslInstruction *at, int a, int b)
{
    Entry entry = {.op = at->op, .precision = at->precision, .node = at->node, .from = {a, b}};
    const Entry *x = &run->state->entries[a], *y = &run->state->entries[b];
    const bool same = a == b;
    entry.exact = range_of(at->op, x->exact, y->exact, same);
    entry.driver = range_of(at->op, x->driver, y->driver, same);
    entry.middle = middle_of(at, x->middle, y->middle);
    if ((at->op >= OP_NOT && at->op <= OP_XOR) || at->op == OP_BOOL || at->op == OP_SIGN) {
        if (at->op == OP_LESS || at->op == OP_LESS_EQUAL || at->op == OP_EQUAL ||
            at->op == OP_NOT_EQUAL || at->op == OP_SIGN) {
            compare(run, &entry);
        } else {
            const bool known = x->error == 0 && y->error == 0;
            entry.driver = known ? entry.exact : entry.driver;
            entry.born = entry.error = known ? 0 : difference(entry.exact, entry.driver);
            for (int k = 0; k < 2; k++)
                entry.slope[k] = is_point(entry.exact) ? NONE : ANY;
        }
    } else {
        const GlslRange p = hull(x->exact, x->driver), q = hull(y->exact, y->driver);
        slopes_of(at->op, p, q, same, hull(entry.exact, entry.driver), entry.by);
        entry.born = rounding_of(run->errors, at, x->driver, y->driver, entry.driver);
        entry.driver.low -= entry.born;
        entry.driver.high += entry.born;
        if (at->op == OP_SQRT || at->op == OP_POW || (same && at->op == OP_MULTIPLY))
            entry.driver.low = larger(entry.driver.low, 0);
        complete(run, &entry);
    }
    const int made = add(run, &entry); /* may move what x and y point to */
    run->state->map[at->d] = made;
}

/* Joining */

/* Ways that the exact numbers and the driver's may take, as bits. */
enum { BOTH_FIRST = 1, BOTH_SECOND = 2, FIRST_SECOND = 4, SECOND_FIRST = 8 };

/* One of two numbers; `near`: the same where the two may go different ways, -1: as these. */
static int join(GlslBoundRun *run, const int of[2], const int near[2], int ways, int node)
{
    const Entry a = run->state->entries[of[0]], b = run->state->entries[of[1]];
    const Entry c = run->state->entries[near[0]], d = run->state->entries[near[1]];
    const bool exact_a = ways & (BOTH_FIRST | FIRST_SECOND),
               exact_b = ways & (BOTH_SECOND | SECOND_FIRST);
    const bool driver_a = ways & (BOTH_FIRST | SECOND_FIRST),
               driver_b = ways & (BOTH_SECOND | FIRST_SECOND);
    Entry made = {.node = node, .op = OP_SELECT, .from = {of[0], of[1]}};
    made.precision =
        run->errors->numbers.of[a.precision].bits > run->errors->numbers.of[b.precision].bits
            ? a.precision
            : b.precision;
    made.exact = exact_a && exact_b ? hull(a.exact, b.exact) : exact_a ? a.exact : b.exact;
    made.driver = driver_a && driver_b ? hull(a.driver, b.driver) : driver_a ? a.driver : b.driver;
    made.by[0] = (GlslRange){ways & BOTH_FIRST && !(ways & BOTH_SECOND), !!(ways & BOTH_FIRST)};
    made.by[1] = (GlslRange){ways & BOTH_SECOND && !(ways & BOTH_FIRST), !!(ways & BOTH_SECOND)};
    double error = 0;
    if (ways & FIRST_SECOND)
        made.born = larger(made.born, difference(c.exact, d.driver));
    if (ways & SECOND_FIRST)
        made.born = larger(made.born, difference(d.exact, c.driver));
    if (ways & BOTH_FIRST)
        error = a.error;
    if (ways & BOTH_SECOND)
        error = larger(error, b.error);
    made.error = larger(error, made.born);
    const bool alone = !(exact_a && exact_b);
    made.middle = alone ? (exact_a ? a.middle : b.middle) : (double)NAN;
    made.slack = alone ? (exact_a ? a.slack : b.slack) : 0;
    for (int k = 0; k < 2; k++)
        made.slope[k] = alone ? (exact_a ? a.slope[k] : b.slope[k]) : ANY;
    return add(run, &made);
}

static int ways_of(const Entry *condition)
{
    const bool yes = condition->exact.high > 0, no = condition->exact.low < 1;
    const bool driver_yes = condition->driver.high > 0, driver_no = condition->driver.low < 1;
    const bool differ = condition->error > 0;
    return (yes && driver_yes ? BOTH_FIRST : 0) | (no && driver_no ? BOTH_SECOND : 0) |
           (yes && driver_no && differ ? FIRST_SECOND : 0) |
           (no && driver_yes && differ ? SECOND_FIRST : 0);
}

/* Branches */

static int run_from(GlslBoundRun *run, int at, int stop);

static void narrow_range(GlslRange *a, GlslRange to)
{
    const GlslRange narrow = {larger(a->low, to.low), smaller(a->high, to.high)};
    if (narrow.low <= narrow.high) /* else this way is not taken */
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
        entry.slope[0] = entry.slope[1] = ANY;
    }
    const int made = add(run, &entry);
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

/* Runs one way of a branch; its registers are put into `map`. False: it ends before. */
static bool run_way(GlslBoundRun *run, const GlslInstruction *branch, int next, bool yes, bool near,
                    int *map)
{
    State *state = run->state;
    const size_t size = (size_t)run->code->register_count * sizeof *map;
    int *before = memory_new((size_t)run->code->register_count, sizeof *before);
    memcpy(before, state->map, size);
    narrow(run, read(run, branch->a), yes, near);
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
            of[k] = read(run, i);
        }
        const int first = widest(state, of[0]);
        state->map[i] = first == widest(state, of[1]) ? first : join(run, of, of + 2, ways, node);
    }
}

/* Returns where the ways of an uncertain branch meet. */
static int run_branch(GlslBoundRun *run, const GlslInstruction *at, int next)
{
    State *state = run->state;
    const int condition = read(run, at->a), meets = state->meets[next - 1];
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
    return a == b ? a
                  : join(run, of, of,
                         BOTH_FIRST | BOTH_SECOND | (error > 0 ? FIRST_SECOND | SECOND_FIRST : 0),
                         node);
}

/* Elements of an array whose index is not known are all of them. */
static void run_element(GlslBoundRun *run, const GlslInstruction *at)
{
    State *state = run->state;
    const Entry address = state->entries[read(run, at->b)];
    const bool loads = at->op == OP_LOAD;
    const int base = loads ? at->a : at->d;
    const int first = base + (int)hull(address.exact, address.driver).low;
    const int last = base + (int)hull(address.exact, address.driver).high;
    const int stored = loads ? 0 : read(run, at->a);
    int found = read(run, first);
    for (int i = first; i <= last && loads; i++)
        found = joined(run, found, read(run, i), address.error, at->node);
    for (int i = first; i <= last && !loads; i++)
        state->map[i] =
            first == last ? stored : joined(run, read(run, i), stored, address.error, at->node);
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
    const int start = at->a < 0 ? add_constant(run, 0) : read(run, at->a);
    const int chosen = read(run, at->b);
    const Entry *base = &state->entries[start], *index = &state->entries[chosen];
    Entry made = {.node = at->node, .from = {-1, -1}};
    made.exact = index_range(at, base->exact, index->exact);
    made.driver = index_range(at, base->driver, index->driver);
    made.middle = is_point(made.exact) ? made.exact.low : (double)NAN;
    made.born = made.error =
        base->error + index->error > 0 ? difference(made.exact, made.driver) : 0;
    made.slope[0] = made.slope[1] = is_point(made.exact) ? NONE : ANY;
    const int entry = add(run, &made);
    state->map[at->d] = entry;
}

/* A texture's colours are the same for both, but at edges of what it shows. */
static void run_texture(GlslBoundRun *run, const GlslInstruction *at)
{
    State *state = run->state;
    GlslRange places[16], color[4] = {{0, 1}, {0, 1}, {0, 1}, {0, 1}};
    const int count = at->n < 16 ? at->n : 16, unit = read(run, at->a);
    for (int i = 0; i < count; i++) {
        const Entry *place = &state->entries[read(run, at->b + i)];
        places[i] = place->exact;
    }
    if (run->texture)
        run->texture(run->context, (int)state->entries[unit].exact.low, at->c, places, count,
                     color);
    for (int i = 0; i < 4; i++) {
        const GlslRange slope = is_point(color[i]) ? NONE : ANY;
        const int made =
            add(run, &(Entry){.exact = color[i],
                              .driver = color[i],
                              .middle = is_point(color[i]) ? color[i].low : (double)NAN,
                              .slope = {slope, slope},
                              .precision = GLSL_HIGHP,
                              .from = {-1, -1}});
        state->map[at->d + i] = made;
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
    const int a = converted(run, read(run, at->a), at->precision);
    if (at->op == OP_SET) {
        map[at->d] = a;
        return;
    }
    const int b = is_of_one(at->op) ? a : converted(run, read(run, at->b), at->precision);
    if (at->op == OP_SELECT) {
        const int of[2] = {b, converted(run, read(run, at->c), at->precision)};
        const int ways = ways_of(&run->state->entries[a]);
        const int made = ways == BOTH_FIRST    ? of[0]
                         : ways == BOTH_SECOND ? of[1]
                                               : join(run, of, of, ways, at->node);
        map[at->d] = made;
        return;
    }
    compute_entry(run, at, a, b);
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
            const int ways = ways_of(&state->entries[read(run, at->a)]);
            next = ways == BOTH_FIRST    ? next
                   : ways == BOTH_SECOND ? at->d
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
    run->node = 0;
    add_constant(run, 0);
    run->discarded = run_from(run, 0, run->code->instruction_count) == DEAD && !run->stopped;
    return !run->stopped;
}

/* Backward */

static GlslRange *weigh(State *state, int result)
{
    if (state->weight_room < state->count) {
        state->weights = memory_grow(state->weights, (size_t)state->room, sizeof(GlslRange));
        state->weight_room = state->room;
    }
    memset(state->weights, 0, (size_t)(result + 1) * sizeof(GlslRange));
    state->weights[result] = ONE;
    return state->weights;
}

GlslBound glsl_bound(GlslBoundRun *run, int at)
{
    State *state = run->state;
    const int result = read(run, at);
    GlslRange *weights = weigh(state, result);
    const Entry last = state->entries[result];
    GlslBound bound = {.exact = last.exact, .driver = last.driver};
    memset(state->lines, 0, (size_t)state->line_count * sizeof *state->lines);
    for (int i = result; i >= 0; i--) {
        const Entry *entry = &state->entries[i];
        if (weights[i].low == 0 && weights[i].high == 0)
            continue;
        if (entry->born > 0) {
            const double share = magnitude(weights[i]) * entry->born;
            const int line = run->code->tree->nodes[entry->node].place.line;
            bound.error += share;
            state->lines[line] += share;
            state->nodes[line] = entry->node;
        }
        for (int k = 0; k < 2; k++)
            if (entry->from[k] >= 0)
                weights[entry->from[k]] =
                    range_sum(weights[entry->from[k]], range_product(weights[i], entry->by[k]));
    }
    int most = 0;
    for (int i = 1; i < state->line_count; i++)
        most = state->lines[i] > state->lines[most] ? i : most;
    bound.node = most ? state->nodes[most] : 0;
    bound.share = state->lines[most];
    if (!(bound.error <= last.error))
        bound.error = last.error;
    return bound;
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
    state->line_count = 1;
    for (int i = 0; i < code->tree->node_count; i++)
        if (code->tree->nodes[i].place.line >= state->line_count)
            state->line_count = code->tree->nodes[i].place.line + 1;
    state->lines = memory_new((size_t)state->line_count, sizeof(double));
    state->nodes = memory_new((size_t)state->line_count, sizeof(int));
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
    free(run->state->nodes);
    free(run->state);
    free(run->inputs);
    free(run);
}
