/*
 * Runs code. Numbers are doubles; with a driver's arithmetic each operation is rounded to what the
 * driver has, which for +, -, *, / and the square root of 24 bits or less is exactly what it
 * computes: a double has more than twice the bits, so that rounding twice does no harm.
 */
#include "glsl/glsl_code.h"

#include "base/memory.h"

#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* What a variable holds before it has a value: a NaN that no operation makes. */
static const uint64_t UNSET = 0x7ff8dead00000001;

static double unset(void)
{
    double value;
    memcpy(&value, &UNSET, sizeof value);
    return value;
}

static bool is_unset(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits == UNSET;
}

const char *glsl_note_text(int kind)
{
    static const char *const TEXTS[] = {
        "",
        "the loop does not end",
        "a variable is read that has no value yet: another driver may have another one",
        "the result is not a number",
        "pow of a negative number, or of 0 to the power of 0 or less, is undefined",
        "the square root of a negative number is undefined",
        "the logarithm of 0 or less is undefined",
        "a division by 0, or the inverse square root or the direction of 0, is undefined",
        "asin and acos are undefined outside -1 to 1",
        "smoothstep is undefined unless its first edge is less than the second",
        "the index is outside of what it selects from"};
    return TEXTS[kind];
}

static void note(GlslRun *run, int kind, int node)
{
    for (int i = 0; i < run->note_count; i++)
        if (run->notes[i].kind == kind && run->notes[i].node == node)
            return;
    if (run->note_count < GLSL_NOTES)
        run->notes[run->note_count++] = (GlslNote){kind, node};
}

/* Outside of what is normal. */
static double round_slowly(const GlslArithmetic *arithmetic, int precision, double x)
{
    const int bits = arithmetic->of[precision].bits;
    const int least = arithmetic->of[precision].least;
    int exponent;
    frexp(x, &exponent);
    exponent = exponent - 1 < least ? least : exponent - 1;
    const double unit = ldexp(1, exponent - bits + 1), rounded = nearbyint(x / unit) * unit;
    if (fabs(rounded) >= ldexp(1, arithmetic->of[precision].most + 1))
        return copysign(INFINITY, x);
    return arithmetic->of[precision].denormals || fabs(rounded) >= ldexp(1, least) ? rounded
                                                                                   : copysign(0, x);
}

static double round_to(const GlslArithmetic *arithmetic, int precision, double x)
{
    const int bits = arithmetic->of[precision].bits;
    if (bits == 53 || x == 0 || !isfinite(x))
        return x;
    if (bits == 24 && arithmetic->of[precision].most == 127) {
        const float single = (float)x;
        return arithmetic->of[precision].denormals || fabsf(single) >= 0x1p-126F ? (double)single
                                                                                 : copysign(0, x);
    }
    /* To the nearest, of two the even one, in the bits that are stored: a carry goes on into the
     * exponent. */
    uint64_t stored;
    memcpy(&stored, &x, sizeof stored);
    const int exponent = (int)(stored >> 52 & 2047) - 1023;
    if (exponent < arithmetic->of[precision].least || exponent >= arithmetic->of[precision].most)
        return round_slowly(arithmetic, precision, x);
    const int left_out = 53 - bits;
    stored += (UINT64_C(1) << (left_out - 1)) - 1 + (stored >> left_out & 1);
    stored &= ~((UINT64_C(1) << left_out) - 1);
    memcpy(&x, &stored, sizeof stored);
    return x;
}

static float add_product(const GlslArithmetic *arithmetic, float a, float b, float c)
{
    const float product = a * b;
    return arithmetic->fused ? fmaf(a, b, c) : product + c;
}

/* Odd and even terms apart, as gallivm's lp_build_polynomial. */
static float polynomial(const GlslArithmetic *arithmetic, float x, const double *terms, int count)
{
    float sums[2] = {0};
    for (int i = count - 1; i >= 0; i--)
        sums[i % 2] = i + 2 < count ? add_product(arithmetic, x * x, sums[i % 2], (float)terms[i])
                                    : (float)terms[i];
    return add_product(arithmetic, sums[1], x, sums[0]);
}

static float mesa_exp2(const GlslArithmetic *arithmetic, float x)
{
    static const double TERMS[] = {1,
                                   0.693153073200168932794,
                                   0.240153617044375388211,
                                   0.0558263180532956664775,
                                   0.00898934009049466391101,
                                   0.00187757667519147912699};
    if (isnan(x))
        return x;
    x = x > 128 ? 128 : x < -126.99999F ? -126.99999F : x;
    const float whole = floorf(x);
    return (float)ldexp(polynomial(arithmetic, x - whole, TERMS, 6), (int)whole);
}

static float mesa_log2(const GlslArithmetic *arithmetic, float x)
{
    static const double TERMS[] = {2.88539009343309178325, 0.961791550404184197881,
                                   0.577440339438736392009, 0.403343858251329912514,
                                   0.406718052498846252698};
    if (!(x > 0) || isinf(x))
        return x == 0 ? -INFINITY : x > 0 ? x : NAN;
    int exponent;
    const float part = frexpf(x, &exponent) * 2;
    const float y = (part - 1) / (part + 1);
    const float series = polynomial(arithmetic, y * y, TERMS, 5);
    return add_product(arithmetic, y, series, (float)(exponent - 1));
}

/* A function's correct result, cut if the device cuts it. */
static double as_cut(const GlslArithmetic *arithmetic, int precision, double x)
{
    const GlslNumbers *numbers = &arithmetic->of[precision];
    if (!numbers->cut || x == 0 || !isfinite(x))
        return x;
    const double unit = ldexp(1, ilogb(x) - numbers->bits + 1);
    return round_to(arithmetic, precision, trunc(x / unit) * unit);
}

static double power_of_2(const GlslArithmetic *arithmetic, int precision, double x)
{
    return arithmetic->mesa ? mesa_exp2(arithmetic, (float)x)
                            : as_cut(arithmetic, precision, exp2(x));
}

static double logarithm(const GlslArithmetic *arithmetic, int precision, double x)
{
    return arithmetic->mesa ? mesa_log2(arithmetic, (float)x)
                            : as_cut(arithmetic, precision, log2(x));
}

/* Mesa, and what cuts, makes it of the other two; of others it is taken as correct. */
static double power(const GlslArithmetic *arithmetic, int precision, double x, double y)
{
    if (!arithmetic->mesa && !(arithmetic->of[precision].cut && x > 0))
        return pow(x, y);
    const double log = round_to(arithmetic, precision, logarithm(arithmetic, precision, x));
    return power_of_2(arithmetic, precision, round_to(arithmetic, precision, log * y));
}

static double reciprocal_root(const GlslArithmetic *arithmetic, int precision, double x)
{
    return arithmetic->of[precision].cut ? as_cut(arithmetic, precision, 1 / sqrt(x))
                                         : 1 / round_to(arithmetic, precision, sqrt(x));
}

static double quotient(const GlslArithmetic *arithmetic, int precision, double a, double b)
{
    return arithmetic->of[precision].cut ? a * as_cut(arithmetic, precision, 1 / b) : a / b;
}

/* What is undefined of a function, 0: nothing. */
static int undefined(int op, double a, double b)
{
    /* clang-format off */
    switch (op) {
    case OP_DIVIDE: return a == 0 && b == 0 ? GLSL_NOTE_ZERO : 0;
    case OP_INT_DIVIDE: return b == 0 ? GLSL_NOTE_ZERO : 0;
    case OP_POW: return a < 0 || (a == 0 && b <= 0) ? GLSL_NOTE_POW : 0;
    case OP_LOG2: return a <= 0 ? GLSL_NOTE_LOG : 0;
    case OP_SQRT: return a < 0 ? GLSL_NOTE_ROOT : 0;
    case OP_INVERSE_SQRT: return a < 0 ? GLSL_NOTE_ROOT : a == 0 ? GLSL_NOTE_ZERO : 0;
    case OP_ASIN: case OP_ACOS: return fabs(a) > 1 ? GLSL_NOTE_ARC : 0;
    case OP_ATAN2: return a == 0 && b == 0 ? GLSL_NOTE_ZERO : 0;
    default: return 0;
    }
    /* clang-format on */
}

static double function(const GlslArithmetic *arithmetic, const GlslInstruction *at, double a,
                       double b)
{
    const int precision = at->precision;
    /* clang-format off */
    switch (at->op) {
    case OP_SIN: return sin(a);
    case OP_COS: return cos(a);
    case OP_ASIN: return asin(a);
    case OP_ACOS: return acos(a);
    case OP_ATAN: return atan(a);
    case OP_ATAN2: return atan2(a, b);
    case OP_POW: return power(arithmetic, precision, a, b);
    case OP_EXP2: return power_of_2(arithmetic, precision, a);
    case OP_LOG2: return logarithm(arithmetic, precision, a);
    case OP_SQRT: return as_cut(arithmetic, precision, sqrt(a));
    case OP_INVERSE_SQRT: return reciprocal_root(arithmetic, precision, a);
    case OP_DIVIDE: return quotient(arithmetic, precision, a, b);
    default: return b == 0 ? 0 : trunc(a / b); /* of ints */
    }
    /* clang-format on */
}

/* From the first product on, each added with one rounding; `at` is the last sum, and what dot
 * compiled is before it. */
static double fused_dot(const double *r, const GlslInstruction *at,
                        const GlslArithmetic *arithmetic)
{
    double sum = 0;
    for (int i = 0; i < at->n; i++) {
        const GlslInstruction *product = at - 2 * i - (i < at->n - 1);
        const double a = round_to(arithmetic, at->precision, r[product->a]);
        sum = round_to(arithmetic, at->precision,
                       sum + a * round_to(arithmetic, at->precision, r[product->b]));
    }
    return sum;
}

static double operate(GlslRun *run, const GlslInstruction *at, const GlslArithmetic *arithmetic)
{
    const double *r = run->registers;
    const GlslNumbers *numbers = &arithmetic->of[at->precision];
    const bool narrow = numbers->bits < 24;
    const double a = narrow ? round_to(arithmetic, at->precision, r[at->a]) : r[at->a];
    const double b = narrow ? round_to(arithmetic, at->precision, r[at->b]) : r[at->b];
    double result;
    /* clang-format off */
    switch (at->op) {
    case OP_ADD: result = at->n && numbers->cut ? fused_dot(r, at, arithmetic) : a + b; break;
    case OP_SUBTRACT: result = a - b; break;
    case OP_MULTIPLY: result = a * b; break;
    case OP_SET: return numbers->cut ? r[at->a] : a; /* rounded where it is computed with */
    case OP_NEGATE: return -a;
    case OP_NOT: return a == 0;
    case OP_LESS: return a < b;
    case OP_LESS_EQUAL: return a <= b;
    case OP_EQUAL: return a == b;
    case OP_NOT_EQUAL: return a != b;
    case OP_AND: return a != 0 && b != 0;
    case OP_OR: return a != 0 || b != 0;
    case OP_XOR: return (a != 0) != (b != 0);
    case OP_MIN: return isnan(a) || b < a ? b : a;
    case OP_MAX: return isnan(a) || a < b ? b : a;
    case OP_ABS: return fabs(a);
    case OP_SIGN: return (a > 0) - (a < 0);
    case OP_FLOOR: return floor(a);
    case OP_CEIL: return ceil(a);
    case OP_TRUNCATE: return trunc(a);
    case OP_BOOL: return a != 0;
    case OP_SELECT: return a != 0 ? b : r[at->c];
    default: {
        const int kind = undefined(at->op, a, b);
        if (kind)
            note(run, kind, at->node);
        result = function(arithmetic, at, a, b);
    }
    }
    /* clang-format on */
    result = round_to(arithmetic, at->precision, result);
    if (isnan(result) && !isnan(a) && !isnan(b))
        note(run, GLSL_NOTE_NAN, at->node);
    return result;
}

static void add_event(GlslRun *run, const GlslInstruction *at)
{
    *(GlslEvent *)memory_add(&run->events, &run->event_count, &run->event_room, sizeof(GlslEvent)) =
        (GlslEvent){at->node, at->c, at->a, at->n, run->value_count};
    for (int i = 0; i < at->n; i++)
        *(double *)memory_add(&run->values, &run->value_count, &run->value_room, sizeof(double)) =
            run->registers[at->a + i];
}

static void look_up(GlslRun *run, const GlslInstruction *at)
{
    double *r = run->registers, color[4] = {0, 0, 0, 1};
    if (run->texture)
        run->texture(run->context, (int)r[at->a], at->c, r + at->b, at->n, color);
    memcpy(r + at->d, color, sizeof color);
}

static double select_index(GlslRun *run, const GlslInstruction *at)
{
    const double *r = run->registers, index = r[at->b];
    const bool low = !(index >= 0), high = index >= at->n;
    if (low || high)
        note(run, GLSL_NOTE_INDEX, at->node);
    return (at->a < 0 ? 0 : r[at->a]) + at->c * (low ? 0 : high ? at->n - 1 : trunc(index));
}

static void check(GlslRun *run, const GlslInstruction *at, double *value)
{
    if (!is_unset(*value))
        return;
    note(run, GLSL_NOTE_UNSET, at->node);
    *value = 0;
}

/* What is no operation on numbers; returns which instruction is next, -1: none. */
static int control(GlslRun *run, const GlslInstruction *at, int next, int *loops)
{
    double *r = run->registers;
    /* clang-format off */
    switch (at->op) {
    case OP_JUMP: return at->d;
    case OP_JUMP_FALSE: return r[at->a] == 0 ? at->d : next;
    case OP_LOOP:
        if (++*loops <= run->loops)
            return next;
        note(run, GLSL_NOTE_LOOP, at->node);
        run->stopped = true;
        return -1;
    case OP_INDEX: r[at->d] = select_index(run, at); return next;
    case OP_LOAD:
        r[at->d] = r[at->a + (int)r[at->b]];
        check(run, at, &r[at->d]);
        return next;
    case OP_STORE: r[at->d + (int)r[at->b]] = r[at->a]; return next;
    case OP_UNSET:
        *loops += at->n / 100; /* large arrays in loops take as long as turns */
        for (int i = 0; i < at->n; i++)
            r[at->d + i] = unset();
        return next;
    case OP_CHECK: check(run, at, &r[at->a]); return next;
    case OP_EDGES:
        if (!(r[at->a] < r[at->b]))
            note(run, GLSL_NOTE_EDGES, at->node);
        return next;
    case OP_TEXTURE: look_up(run, at); return next;
    case OP_DISCARD: run->discarded = true; return -1;
    default: return -1;
    }
    /* clang-format on */
}

/* Constants, as this arithmetic has them: registers that begin with another value than 0. */
static void prepare(GlslRun *run, const GlslArithmetic *arithmetic)
{
    const GlslCode *code = run->code;
    if (run->prepared == arithmetic)
        return;
    for (int i = 0; i < code->register_count; i++)
        if (code->start[i] != 0)
            run->registers[i] = round_to(arithmetic, GLSL_HIGHP, code->start[i]);
    run->prepared = arithmetic;
}

/* Where a run is. */
typedef struct Spot {
    int next, loops, events; /* the instruction, -1: the end; how many were executed */
} Spot;

static Spot start(GlslRun *run, const GlslArithmetic *arithmetic)
{
    prepare(run, arithmetic);
    run->discarded = run->stopped = false;
    run->event_count = run->value_count = run->note_count = 0;
    return (Spot){.next = run->code->message.text[0] ? -1 : 0};
}

/* Up to an event, or the end; true: the event. */
static bool go_on(GlslRun *run, Spot *spot, const GlslArithmetic *arithmetic, int event)
{
    while (spot->next >= 0) {
        const GlslInstruction *at = &run->code->instructions[spot->next++];
        run->operations++;
        if (at->op < OP_NUMBERS) {
            run->registers[at->d] = operate(run, at, arithmetic);
        } else if (at->op == OP_EVENT) {
            if (!at->c && !run->details)
                continue;
            if (run->trace)
                add_event(run, at);
            if (run->assigned && at->c)
                run->assigned(run, &(GlslEvent){at->node, at->c, at->a, at->n, -1}, run->observer);
            if (spot->events++ == event)
                return true;
        } else {
            spot->next = control(run, at, spot->next, &spot->loops);
        }
    }
    return false;
}

bool glsl_run(GlslRun *run)
{
    const GlslArithmetic *arithmetic = run->exact_from < 0 ? &GLSL_EXACT : run->arithmetic;
    Spot spot = start(run, arithmetic);
    if (go_on(run, &spot, arithmetic, run->exact_from))
        go_on(run, &spot, &GLSL_EXACT, INT_MAX);
    return !run->stopped;
}

void glsl_run_each(GlslRun *run, int first, int last, int step, GlslEach *each, void *context)
{
    const size_t size = (size_t)run->code->register_count * sizeof *run->registers;
    double *saved = memory_new(2 * size + 1, 1), *expected = saved + run->code->register_count;
    Spot spot = start(run, run->arithmetic);
    bool expects = false;
    for (int i = first; go_on(run, &spot, run->arithmetic, i);
         i = i + step < last ? i + step : last) {
        const bool same = expects && memcmp(expected, run->registers, size) == 0;
        Spot exact = spot;
        memcpy(saved, run->registers, size);
        expects = go_on(run, &exact, &GLSL_EXACT, i + 1) && step == 1;
        memcpy(expected, run->registers, size);
        if (!same)
            go_on(run, &exact, &GLSL_EXACT, INT_MAX);
        each(run, i, same, context);
        memcpy(run->registers, saved, size);
        if (i >= last)
            break;
    }
    free(saved);
}

GlslRun *glsl_run_open(const GlslCode *code)
{
    GlslRun *run = memory_new(1, sizeof *run);
    const size_t count = (size_t)code->register_count;
    run->code = code;
    run->arithmetic = &GLSL_EXACT;
    run->exact_from = INT_MAX;
    run->loops = 100000;
    run->registers = memory_new(count, sizeof(double));
    if (count)
        memcpy(run->registers, code->start, count * sizeof(double));
    return run;
}

void glsl_run_close(GlslRun *run)
{
    if (!run)
        return;
    free(run->registers);
    free(run->events);
    free(run->values);
    free(run);
}

int glsl_event_symbol(const GlslCode *code, int instruction)
{
    const GlslInstruction *at = &code->instructions[instruction];
    return at->op == OP_EVENT ? at->c : 0;
}

bool glsl_noted(const GlslRun *run, int kind)
{
    bool noted = false;
    for (int i = 0; i < run->note_count && !noted; i++)
        noted = run->notes[i].kind == kind;
    return noted;
}

const GlslEvent *glsl_last(const GlslRun *run, const char *name)
{
    for (int i = run->event_count - 1; i >= 0; i--)
        if (strcmp(run->code->tree->symbols[run->events[i].symbol].name, name) == 0)
            return &run->events[i];
    return NULL;
}
