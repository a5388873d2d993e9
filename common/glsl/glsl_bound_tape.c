/*
 * The numbers of glsl_bound_run.c: what is known of each, from what it is made of; and backward, of
 * what a result's error is made.
 */
#include "glsl/glsl_bound_tape.h"

#include "base/memory.h"

#include <string.h>

void tape_slope(Entry *entry, GlslRange slope)
{
    for (int k = 0; k < GLSL_WAYS; k++)
        entry->slope[k] = slope;
}

int tape_add(GlslBoundRun *run, const Entry *entry)
{
    State *state = run->state;
    *(Entry *)memory_add(&state->entries, &state->count, &state->room, sizeof(Entry)) = *entry;
    return state->count - 1;
}

int tape_add_constant(GlslBoundRun *run, double value)
{
    const GlslRange range = {value, value};
    return tape_add(run,
                    &(Entry){.exact = range, .driver = range, .middle = value, .from = {-1, -1}});
}

/* By how much a number with these slopes is from its middle. */
static double reach_of(const GlslBoundRun *run, const GlslRange *slope)
{
    double reach = 0;
    for (int k = 0; k < run->state->ways; k++)
        reach += run->radius[k] > 0 ? run->radius[k] * magnitude(slope[k]) : 0;
    return reach;
}

/* The entry of a register. */
int tape_read(GlslBoundRun *run, int at)
{
    int *map = run->state->map;
    if (map[at] >= 0)
        return map[at];
    if (run->state->leaves[at] >= 0)
        return map[at] = run->state->leaves[at];
    const GlslInput *input = &run->inputs[at];
    double reach = reach_of(run, input->slope) + input->slack;
    reach += reach > 0 ? (fabs(input->middle) + reach) * 0x1p-51 : 0;
    const GlslRange exact = {input->middle - reach, input->middle + reach};
    Entry leaf = {.exact = exact,
                  .driver = {exact.low - input->error, exact.high + input->error},
                  .middle = input->middle,
                  .slack = input->slack + (reach > 0 ? magnitude(exact) * 0x1p-50 : 0),
                  .error = input->error,
                  .born = input->error,
                  .precision = GLSL_HIGHP,
                  .from = {-1, -1}};
    memcpy(leaf.slope, input->slope, sizeof leaf.slope);
    return map[at] = run->state->leaves[at] = tape_add(run, &leaf);
}

double range_difference(GlslRange exact, GlslRange driver)
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
    double error = entry->born;
    entry->slack = magnitude(entry->exact) * 0x1p-51;
    const int ways = run->state->ways;
    for (int k = 0; k < ways; k++)
        entry->slope[k] = NONE;
    for (int i = 0; i < 2; i++) {
        if (entry->from[i] < 0 || (entry->by[i].low == 0 && entry->by[i].high == 0))
            continue;
        const Entry *from = &entries[entry->from[i]];
        error += from->error > 0 ? magnitude(entry->by[i]) * from->error : 0;
        entry->slack += from->slack > 0 ? magnitude(entry->by[i]) * from->slack : 0;
        for (int k = 0; k < ways; k++)
            entry->slope[k] =
                range_sum(entry->slope[k], range_product(entry->by[i], from->slope[k]));
    }
    if (run->state->wide) {
        const double reach = entry->slack + reach_of(run, entry->slope);
        if (entry->middle - reach > entry->exact.low)
            entry->exact.low = entry->middle - reach;
        if (entry->middle + reach < entry->exact.high)
            entry->exact.high = entry->middle + reach;
    }
    entry->exact = widened(entry->exact);
    const double apart = range_difference(entry->exact, entry->driver);
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
int tape_convert(GlslBoundRun *run, int at, int precision)
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
    const int added = tape_add(run, &made);
    run->state->entries[at].converted = added;
    run->state->entries[at].converted_to = (unsigned char)precision;
    return added;
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

/* Of a number on the tape. */
static GlslBound bound_of(GlslBoundRun *run, int result)
{
    State *state = run->state;
    GlslRange *weights = weigh(state, result);
    const Entry last = state->entries[result];
    GlslBound bound = {.exact = last.exact, .driver = last.driver};
    for (int i = result; i >= 0; i--) {
        const Entry *entry = &state->entries[i];
        if (weights[i].low == 0 && weights[i].high == 0)
            continue;
        if (entry->born > 0) {
            const double share = magnitude(weights[i]) * entry->born;
            const int line = state->line_of[entry->node];
            bound.error += share;
            state->lines[line] += share;
        }
        for (int k = 0; k < 2; k++)
            if (entry->from[k] >= 0)
                weights[entry->from[k]] =
                    range_sum(weights[entry->from[k]], range_product(weights[i], entry->by[k]));
    }
    for (int i = result; i >= 0; i--) {
        const int node = state->entries[i].node;
        double *line = &state->lines[state->line_of[node]];
        if (*line >= bound.share && *line > 0) { /* of those without bound the first */
            bound.share = *line;
            bound.node = node;
        }
        *line = 0;
    }
    if (!(bound.error <= last.error)) {
        bound.share *= isfinite(bound.error) ? last.error / bound.error : 1;
        bound.error = last.error;
    }
    return bound;
}

/* Makes an error, and with it the driver's range, smaller where much depends on it. */
static void tighten(GlslBoundRun *run, int at)
{
    if (!(run->state->entries[at].error > 0))
        return;
    const GlslBound bound = bound_of(run, at);
    Entry *entry = &run->state->entries[at];
    entry->error = bound.error;
    if (run->state->apart == 0) {
        entry->driver.low = larger(entry->driver.low, entry->exact.low - bound.error);
        entry->driver.high = smaller(entry->driver.high, entry->exact.high + bound.error);
    }
}

/* Whether an edge at which two numbers are equal runs through each pixel in which the driver's can
 * be on its other side; `slope`: of their difference. */
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
    if (!isfinite(error)) /* the driver's may be no number, which is neither less nor more */
        entry->driver = (GlslRange){entry->op == OP_SIGN ? -1 : 0, 1};
    tape_slope(entry, is_point(entry->exact) ? NONE : ANY);
    if (error == 0 || (!whole && (apart.low > error || apart.high < -error)))
        entry->driver = entry->exact;
    else if (!is_point(entry->exact) || !is_point(entry->driver) ||
             entry->exact.low != entry->driver.low) {
        GlslRange slope[2];
        for (int k = 0; k < 2; k++)
            slope[k] = range_minus(a->slope[k], b->slope[k]);
        entry->edge = !whole && is_edge(run, slope, error);
        entry->born = range_difference(entry->exact, entry->driver);
    }
    entry->error = entry->born;
}

static double middle_of(const GlslInstruction *at, double a, double b)
{
    const GlslRange x = {a, a}, y = {b, b}, result = range_of(at->op, x, y, false);
    return is_point(result) && !isnan(a) && !isnan(b) ? result.low : (double)NAN;
}

/* Where its middle is not known, nor are slopes. */
static double secant(double from, double to, double exponent)
{
    return to - from > 1e-6 * to ? (pow(to, exponent) - pow(from, exponent)) / (to - from)
                                 : exponent * pow(to, exponent - 1);
}

/* The slope of a power between exact and driver's numbers: that of a secant, which grows with both
 * ends. */
static void narrow_power(const Entry *x, const Entry *y, Entry *power)
{
    const double low = smaller(x->exact.low, x->driver.low);
    const double high = larger(x->exact.high, x->driver.high), exponent = y->exact.low;
    if (low < 0 || !is_point(y->exact) || !is_point(y->driver) || !(exponent >= 1))
        return;
    power->by[0].high = smaller(power->by[0].high, secant(x->exact.high, high, exponent));
    power->by[0].low = 0;
}

/* What is too large becomes infinite; how the least result of positive numbers is rounded. */
static double least_rounding(const GlslBoundRun *run, const GlslInstruction *at, const Entry *x,
                             const Entry *y)
{
    const GlslRange a = {x->driver.low, x->driver.low}, b = {y->driver.low, y->driver.low};
    if ((at->op != OP_ADD && at->op != OP_MULTIPLY) || !(a.low >= 0) || !(b.low >= 0))
        return (double)INFINITY;
    return rounding_of(run->errors, at, a, b, range_of(at->op, a, b, false));
}

int tape_compute(GlslBoundRun *run, const GlslInstruction *at, int a, int b)
{
    Entry entry = {.op = at->op, .precision = at->precision, .node = at->node, .from = {a, b}};
    const bool same = a == b;
    const Entry *x = &run->state->entries[a], *y = &run->state->entries[b];
    if (at->op == OP_POW || at->op == OP_LESS || at->op == OP_LESS_EQUAL) {
        tighten(run, a);
        tighten(run, b);
    }
    entry.exact = range_of(at->op, x->exact, y->exact, same);
    entry.driver = range_of(at->op, x->driver, y->driver, same);
    if (at->op == OP_ADD && at->n && isfinite(magnitude(entry.exact)) &&
        isfinite(magnitude(entry.driver)))
        tape_narrow_dot(run, at->n, a, b, &entry.exact);
    entry.middle = middle_of(at, x->middle, y->middle);
    if ((at->op >= OP_NOT && at->op <= OP_XOR) || at->op == OP_BOOL || at->op == OP_SIGN) {
        if (at->op == OP_LESS || at->op == OP_LESS_EQUAL || at->op == OP_EQUAL ||
            at->op == OP_NOT_EQUAL || at->op == OP_SIGN) {
            compare(run, &entry);
        } else {
            const bool known = x->error == 0 && y->error == 0;
            entry.driver = known ? entry.exact : entry.driver;
            entry.edge = (x->error == 0 || x->edge) && (y->error == 0 || y->edge) && !known;
            entry.born = entry.error = known ? 0 : range_difference(entry.exact, entry.driver);
            tape_slope(&entry, is_point(entry.exact) ? NONE : ANY);
        }
    } else {
        const GlslRange p = hull(x->exact, x->driver), q = hull(y->exact, y->driver);
        slopes_of(at->op, p, q, hull(entry.exact, entry.driver), entry.by);
        if (at->op == OP_POW)
            narrow_power(x, y, &entry);
        entry.born = rounding_of(run->errors, at, x->driver, y->driver, entry.driver);
        entry.driver.low -= isfinite(entry.born) ? entry.born : least_rounding(run, at, x, y);
        entry.driver.high += entry.born;
        if (!is_any(entry.driver) &&
            (at->op == OP_SQRT || at->op == OP_POW || (same && at->op == OP_MULTIPLY)))
            entry.driver.low = larger(entry.driver.low, 0);
        complete(run, &entry);
    }
    return tape_add(run, &entry); /* may move what x and y point to */
}

/* Joining */

/* One of two numbers; `near`: the same where the two may go different ways, -1: as these. */
int tape_join(GlslBoundRun *run, const int of[2], const int near[2], int ways, int node)
{
    /* Less than a quarter of a step is no edge that can be seen. */
    static const double SEEN = .25 / 255;
    const Entry a = run->state->entries[of[0]], b = run->state->entries[of[1]];
    const Entry c = run->state->entries[near[0]], d = run->state->entries[near[1]];
    const bool exact_a = ways & (BOTH_FIRST | FIRST_SECOND),
               exact_b = ways & (BOTH_SECOND | SECOND_FIRST);
    Entry made = {.node = node, .op = OP_SELECT, .from = {of[0], of[1]}};
    made.precision =
        run->errors->numbers.of[a.precision].bits > run->errors->numbers.of[b.precision].bits
            ? a.precision
            : b.precision;
    if (ways & FIRST_SECOND)
        made.born = larger(made.born, range_difference(c.exact, d.driver));
    if (ways & SECOND_FIRST)
        made.born = larger(made.born, range_difference(d.exact, c.driver));
    if (ways & EDGE && made.born > SEEN) {
        run->edges = true;
        made.born = 0;
        ways = (exact_a ? BOTH_FIRST : 0) | (exact_b ? BOTH_SECOND : 0);
    }
    const bool driver_a = ways & (BOTH_FIRST | SECOND_FIRST),
               driver_b = ways & (BOTH_SECOND | FIRST_SECOND);
    made.exact = exact_a && exact_b ? hull(a.exact, b.exact) : exact_a ? a.exact : b.exact;
    made.driver = driver_a && driver_b ? hull(a.driver, b.driver) : driver_a ? a.driver : b.driver;
    ways &= ~EDGE;
    made.by[0] = (GlslRange){ways == BOTH_FIRST, !!(ways & BOTH_FIRST)};
    made.by[1] = (GlslRange){ways == BOTH_SECOND, !!(ways & BOTH_SECOND)};
    made.error = larger(made.born,
                        larger(ways & BOTH_FIRST ? a.error : 0, ways & BOTH_SECOND ? b.error : 0));
    const bool alone = !(exact_a && exact_b);
    made.middle = alone ? (exact_a ? a.middle : b.middle) : (double)NAN;
    made.slack = alone ? (exact_a ? a.slack : b.slack) : 0;
    for (int k = 0; k < GLSL_WAYS; k++)
        made.slope[k] = alone ? (exact_a ? a.slope[k] : b.slope[k]) : ANY;
    return tape_add(run, &made);
}

int ways_of(const Entry *condition)
{
    const bool yes = condition->exact.high > 0, no = condition->exact.low < 1;
    const bool driver_yes = condition->driver.high > 0, driver_no = condition->driver.low < 1;
    const bool differ = condition->error > 0;
    return (yes && driver_yes ? BOTH_FIRST : 0) | (no && driver_no ? BOTH_SECOND : 0) |
           (yes && driver_no && differ ? FIRST_SECOND : 0) |
           (no && driver_yes && differ ? SECOND_FIRST : 0) | (condition->edge ? EDGE : 0);
}

GlslBound glsl_bound(GlslBoundRun *run, int at)
{
    const int read = tape_read(run, at);
    const Entry *entry = &run->state->entries[read];
    GlslBound bound = bound_of(run, read);
    const double half = (entry->exact.high - entry->exact.low) / 2;
    bound.middle = (entry->exact.low + entry->exact.high) / 2;
    bound.slack = half;
    if (isfinite(entry->middle + reach_of(run, entry->slope))) {
        bound.middle = entry->middle;
        bound.slack = entry->slack;
        memcpy(bound.slope, entry->slope, sizeof bound.slope);
    }
    return bound;
}
