/* The flat code of a shader (glsl/glsl_run.h) is followed once, with numbers where the shader has
 * values: a number is known, an input, or what an operation makes of others. Known conditions
 * choose the way, so that loops unroll; others split it, and where ways meet, what differs is a
 * choice. The instructions of one operation of the text, as a matrix times a vector, are a group,
 * which is needed whole or not at all. What outputs need, and what that needs, is counted. */
#include "scene/shader_cost.h"

#include "base/memory.h"
#include "glsl/glsl_code.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* The work that is done at most, in units of a nanosecond or so. */
enum { MOST = 200000000, STEP = 400, HOP = 10, BUCKETS = 1 << 14 };

/* What no operation makes; above those of code. The number 0 is none: not assigned yet. */
enum { NUMBER_KNOWN = OP_END + 1, NUMBER_INPUT, NUMBER_CHOICE };

typedef struct Number {
    int op, a, b;    /* a and b: the operands */
    double value;    /* of a known one; else it tells similar ones apart */
    int group, next; /* next: of the same hash */
    int same;        /* within its group, the number that a sum with 0 or the like is; or itself */
} Number;

/* Numbers that were not there before. */
typedef struct Group {
    int first, count, block; /* of numbers from the first on those that say so */
    ShaderCost cost;         /* of all its operations */
    bool needed, whole;      /* whole: an operation is not the same as a number */
} Group;

/* What runs from a split, or a meeting, of ways on. A number is there in its block and in those
 * whose parents, which come before them, lead to it. */
typedef struct Block {
    int parent;
    int condition; /* of a split's */
    int from[2];   /* of a meeting's: the blocks that meet */
} Block;

/* The numbers of the registers, on the way to an instruction. */
typedef struct Way {
    int *numbers, block, target;
} Way;

typedef struct Counter {
    const GlslCode *code;
    Number *numbers;
    Group *groups;
    Block *blocks;
    Way *ways;                                /* that wait */
    int *needed, *assigned, buckets[BUCKETS]; /* groups; registers, by the last group */
    int number_count, number_room, group_count, group_room, block_count, block_room, way_count,
        way_room, needed_count, needed_room, assigned_count, assigned_room;
    Way way;  /* numbers NULL: it has ended */
    int node; /* of the last group */
    long long work;
} Counter;

static Group *last_group(const Counter *counter)
{
    return &counter->groups[counter->group_count - 1];
}

static bool is_within(Counter *counter, int block, int outer)
{
    for (; block > outer && outer; counter->work++)
        block = counter->blocks[block].parent;
    return !outer || block == outer;
}

static int block_new(Counter *counter, Block block)
{
    *(Block *)memory_add(&counter->blocks, &counter->block_count, &counter->block_room,
                         sizeof block) = block;
    return counter->block_count - 1;
}

static bool is_there(Counter *counter, int number, int block)
{
    return is_within(counter, block, counter->groups[counter->numbers[number].group].block);
}

static bool is_known(const Counter *counter, int number, double *value)
{
    *value = counter->numbers[number].value;
    return counter->numbers[number].op == NUMBER_KNOWN;
}

/* The number that is there already, or a new one. */
static int number_of(Counter *counter, int op, int a, int b, double value)
{
    static const uint64_t FACTOR = 0x9e3779b97f4a7c15;
    uint64_t hash;
    memcpy(&hash, &value, sizeof hash);
    hash =
        (((hash * FACTOR ^ (unsigned)op) * FACTOR ^ (unsigned)a) * FACTOR ^ (unsigned)b) * FACTOR;
    int *bucket = &counter->buckets[(hash >> 40) % BUCKETS];
    for (int i = *bucket; i; i = counter->numbers[i].next, counter->work += HOP) {
        const Number *there = &counter->numbers[i];
        if (there->op == op && there->a == a && there->b == b &&
            memcmp(&there->value, &value, sizeof value) == 0 &&
            is_there(counter, i, counter->way.block))
            return i;
    }
    const bool made = op != NUMBER_KNOWN && op != NUMBER_INPUT;
    counter->work += STEP;
    Number *number = memory_add(&counter->numbers, &counter->number_count, &counter->number_room,
                                sizeof *number);
    *number = (Number){
        op, a, b, value, made ? counter->group_count - 1 : 0, *bucket, counter->number_count - 1};
    *bucket = number->same;
    last_group(counter)->whole |= made && op >= OP_NUMBERS;
    return number->same;
}

static int known(Counter *counter, double value)
{
    return number_of(counter, NUMBER_KNOWN, 0, 0, value);
}

static void assign(Counter *counter, int target, int number)
{
    counter->way.numbers[target] = number;
    *(int *)memory_add(&counter->assigned, &counter->assigned_count, &counter->assigned_room,
                       sizeof(int)) = target;
}

/* Ends the last group, and begins one. Operations that are all the same as numbers are none. */
static void group_new(Counter *counter, int node)
{
    if (counter->group_count) {
        Group *group = last_group(counter);
        int *numbers = counter->way.numbers;
        for (int i = 0; i < counter->assigned_count && !group->whole; i++)
            numbers[counter->assigned[i]] = counter->numbers[numbers[counter->assigned[i]]].same;
        for (int i = group->first; i < counter->number_count; i++)
            counter->numbers[i].same = i;
        if (!group->whole)
            group->cost = (ShaderCost){0};
        group->count = counter->number_count - group->first;
    }
    counter->assigned_count = 0;
    counter->node = node;
    *(Group *)memory_add(&counter->groups, &counter->group_count, &counter->group_room,
                         sizeof(Group)) =
        (Group){.first = counter->number_count, .block = counter->way.block};
}

/* Which of two operands a sum with 0, a product with 0 or 1 or the like is; 0: neither. */
static int shortcut(const Counter *counter, int op, int a, int b)
{
    double x, y;
    const bool a_known = is_known(counter, a, &x), b_known = is_known(counter, b, &y);
    const bool sum = op == OP_ADD || op == OP_SUBTRACT || op == OP_OR;
    const bool product = op == OP_MULTIPLY || op == OP_AND;
    if (!sum && !product && op != OP_DIVIDE)
        return 0;
    if (b_known && y == !sum)
        return a;
    if (a_known && x == !sum && op != OP_SUBTRACT && op != OP_DIVIDE)
        return b;
    if (!sum && a_known && x == 0)
        return a;
    return product && b_known && y == 0 ? b : 0;
}

/* The number that an operation leaves; 0: another one. */
static int simplify(Counter *counter, const GlslInstruction *at, int a, int b)
{
    double registers[3] = {0};
    if (!is_known(counter, a, &registers[0]) || (b && !is_known(counter, b, &registers[1])))
        return shortcut(counter, at->op, a, b);
    GlslInstruction two[] = {
        {.op = at->op, .precision = at->precision ? GLSL_HIGHP : 0, .d = 2, .b = 1},
        {.op = OP_END}};
    const GlslCode code = {.instructions = two};
    GlslRun run = {
        .code = &code, .arithmetic = &GLSL_LLVMPIPE, .exact_from = INT_MAX, .registers = registers};
    glsl_run(&run);
    return known(counter, registers[2]);
}

static void add_cost(Counter *counter, int op, int divisor)
{
    const GlslNode *node = &counter->code->tree->nodes[counter->node];
    const int id = node->kind == GLSL_BUILT_IN ? GLSL_FUNCTIONS[node->symbol].id : -1;
    const bool one = id == GLSL_EXP || id == GLSL_LOG || id == GLSL_MOD || id == GLSL_TAN;
    const bool function = (op >= OP_SIN && op <= OP_INVERSE_SQRT) || op == OP_TEXTURE;
    const bool division = op == OP_INT_DIVIDE || op == OP_DIVIDE;
    ShaderCost *cost = &last_group(counter)->cost;
    if (one ? op == OP_DIVIDE || op == OP_EXP2 || op == OP_LOG2
            : function || (division && counter->numbers[divisor].op != NUMBER_KNOWN))
        cost->special++;
    else if (!one)
        cost->arithmetic++;
}

static void operate(Counter *counter, const GlslInstruction *at)
{
    const int op = at->op, *numbers = counter->way.numbers;
    const bool unary = op == OP_NEGATE || op == OP_NOT || (op >= OP_ABS && op <= OP_ATAN) ||
                       (op >= OP_EXP2 && op <= OP_BOOL);
    const bool symmetric = op == OP_ADD || op == OP_MULTIPLY || (op >= OP_EQUAL && op <= OP_MAX);
    const int a = numbers[at->a];
    const int b = unary             ? 0
                  : op == OP_SELECT ? number_of(counter, op, numbers[at->b], numbers[at->c], 0)
                                    : numbers[at->b];
    const int x = counter->numbers[a].same, y = counter->numbers[b].same;
    const bool turn = symmetric && a > b;
    const int number = number_of(counter, op, turn ? b : a, turn ? a : b, 0);
    const int same = simplify(counter, at, x, y);
    add_cost(counter, op, b);
    if (same)
        counter->numbers[number].same = same;
    last_group(counter)->whole |= !same;
    assign(counter, at->d, number);
}

/* An index that is not known has as its value how many registers it may select from. */
static void index_array(Counter *counter, const GlslInstruction *at)
{
    double base = 0, index;
    const int *numbers = counter->way.numbers, from = at->a < 0 ? 0 : numbers[at->a];
    const bool base_known = at->a < 0 || is_known(counter, from, &base);
    const bool index_known = is_known(counter, numbers[at->b], &index) && base_known;
    const double most = at->n - 1, in = index < 0 ? 0 : index > most ? most : (int)index;
    assign(counter, at->d,
           index_known
               ? known(counter, base + at->c * in)
               : number_of(counter, OP_INDEX, from, numbers[at->b], base + 1.0 * at->c * at->n));
}

/* Reads or assigns a register, or each that it may be. */
static void select_register(Counter *counter, const GlslInstruction *at)
{
    const bool load = at->op == OP_LOAD;
    const int base = load ? at->a : at->d, *numbers = counter->way.numbers;
    double value;
    const bool chosen = is_known(counter, numbers[at->b], &value);
    const int room = counter->code->register_count - base;
    const int extent = value < room ? (int)value : room - 1;
    int number = numbers[at->b];
    if (!load && !chosen)
        number = number_of(counter, OP_STORE, number, numbers[at->a], 0);
    for (int i = 0; i < extent && !chosen; i++) {
        const int next = number_of(counter, at->op, number, numbers[base + i], i);
        if (load)
            number = next;
        else
            assign(counter, base + i, next);
    }
    if (load)
        assign(counter, at->d, chosen ? numbers[base + extent] : number);
    else if (chosen)
        assign(counter, base + extent, numbers[at->a]);
}

static void look_up(Counter *counter, const GlslInstruction *at)
{
    const int *numbers = counter->way.numbers;
    int number = numbers[at->a];
    add_cost(counter, OP_TEXTURE, 0);
    for (int i = 0; i < at->n; i++)
        number = number_of(counter, OP_TEXTURE, number, numbers[at->b + i], at->c);
    for (int i = 0; i < 4; i++)
        assign(counter, at->d + i, number_of(counter, OP_TEXTURE, number, 0, i));
}

/* Sends the present way to an instruction after this one. */
static void send(Counter *counter, int target)
{
    counter->way.target = target;
    *(Way *)memory_add(&counter->ways, &counter->way_count, &counter->way_room, sizeof(Way)) =
        counter->way;
    counter->way.numbers = NULL;
}

/* Two ways: one if the condition is true, and one that is sent to an instruction if not. */
static void split(Counter *counter, int condition, int target)
{
    const size_t size = (size_t)counter->code->register_count * sizeof(int);
    const Block block = {.parent = counter->way.block, .condition = condition};
    const Way on = {memory_copy(counter->way.numbers, size), block_new(counter, block), 0};
    counter->way.block = block_new(counter, block);
    counter->work += counter->code->register_count;
    send(counter, target);
    counter->way = on;
}

/* The present way and one that waited, which ends. */
static void meet(Counter *counter, Way other)
{
    Way *way = &counter->way;
    group_new(counter, 0);
    Block block = {.parent = way->block, .from = {way->block, other.block}};
    while (!is_within(counter, other.block, block.parent))
        block.parent = counter->blocks[block.parent].parent;
    way->block = block_new(counter, block);
    counter->work += counter->code->register_count;
    for (int i = 0; i < counter->code->register_count; i++) {
        const int a = way->numbers[i], b = other.numbers[i];
        if (a == b || !b)
            continue;
        way->numbers[i] = b;
        if (!a)
            continue;
        group_new(counter, 0);
        way->numbers[i] = number_of(counter, NUMBER_CHOICE, a, b, way->block);
        last_group(counter)->cost.arithmetic =
            is_there(counter, a, block.parent) && is_there(counter, b, block.parent);
    }
    free(other.numbers);
}

/* All that wait for this instruction meet, the latest first. If no way is there, the nearest one
 * goes on; returns where, -1: there is none. */
static int arrive(Counter *counter, int next)
{
    for (int i = 0; i < counter->way_count && !counter->way.numbers; i++)
        if (i == 0 || counter->ways[i].target < next)
            next = counter->ways[i].target;
    for (int i = counter->way_count - 1; i >= 0; i--) {
        const Way way = counter->ways[i];
        if (way.target != next)
            continue;
        memmove(counter->ways + i, counter->ways + i + 1,
                (size_t)(--counter->way_count - i) * sizeof way);
        if (counter->way.numbers)
            meet(counter, way);
        else
            counter->way = way;
    }
    return counter->way.numbers ? next : -1;
}

static void need(Counter *counter, int number)
{
    const int group = counter->numbers[number].group;
    if (group && !counter->groups[group].needed)
        *(int *)memory_add(&counter->needed, &counter->needed_count, &counter->needed_room,
                           sizeof(int)) = group;
    counter->groups[group].needed = true;
}

/* What leads to a block from an outer one. */
static void need_way(Counter *counter, int block, int outer)
{
    for (; block != outer; block = counter->blocks[block].parent)
        need(counter, counter->blocks[block].condition);
}

/* Where an instruction leads that is no operation on numbers; -1: it turns an unknown number of
 * times. */
static int follow(Counter *counter, const GlslInstruction *at, int next)
{
    Way *way = &counter->way;
    const int kind = counter->code->tree->nodes[at->node].kind;
    double value;
    group_new(counter, 0);
    if (at->op == OP_JUMP_FALSE && !is_known(counter, way->numbers[at->a], &value)) {
        if (kind == GLSL_FOR || kind == GLSL_WHILE || kind == GLSL_DO)
            return -1;
        split(counter, way->numbers[at->a], at->d);
    } else if (at->op == OP_JUMP || (at->op == OP_JUMP_FALSE && value == 0)) {
        if (at->d < next)
            return at->d;
        send(counter, at->d);
    } else if (at->op == OP_DISCARD) {
        need_way(counter, way->block, 0);
        free(way->numbers);
        way->numbers = NULL;
    }
    return next;
}

/* Where the next instruction is. */
static int step(Counter *counter, int next)
{
    const GlslInstruction *at = &counter->code->instructions[next++];
    if (at->node != counter->node && at->op < OP_END)
        group_new(counter, at->node);
    /* clang-format off */
    switch (at->op) {
    case OP_SET: assign(counter, at->d, counter->way.numbers[at->a]); return next;
    case OP_INDEX: index_array(counter, at); return next;
    case OP_LOAD: case OP_STORE: select_register(counter, at); return next;
    case OP_TEXTURE: look_up(counter, at); return next;
    case OP_CHECK: case OP_EDGES: case OP_EVENT: return next;
    case OP_UNSET:
        memset(counter->way.numbers + at->d, 0, (size_t)at->n * sizeof(int));
        return next;
    default:
        if (at->op >= OP_NUMBERS)
            return follow(counter, at, next);
        operate(counter, at);
        return next;
    }
    /* clang-format on */
}

static bool is_input(const GlslCode *code, const GlslVariable *variable)
{
    const int storage = variable->storage;
    return storage == GLSL_ATTRIBUTE || storage == GLSL_UNIFORM || storage == GLSL_IN ||
           (storage == GLSL_VARYING && code->tree->stage == GLSL_FRAGMENT);
}

/* What code assigns has no number yet. */
static void begin(Counter *counter)
{
    const GlslCode *code = counter->code;
    int *numbers = memory_new((size_t)code->register_count, sizeof *numbers);
    counter->way.numbers = numbers;
    block_new(counter, (Block){0});
    group_new(counter, 0);
    number_of(counter, NUMBER_INPUT, 0, 0, 0); /* none */
    for (int i = 0; i < code->register_count; i++)
        numbers[i] = known(counter, code->start[i]);
    for (int i = 0; i < code->instruction_count; i++)
        if (code->instructions[i].op < OP_NUMBERS)
            numbers[code->instructions[i].d] = 0;
    for (int i = 0; i < code->variable_count; i++)
        for (int k = 0; k < code->variables[i].count; k++)
            if (is_input(code, &code->variables[i]))
                numbers[code->variables[i].first + k] = number_of(counter, NUMBER_INPUT, i, k, 1);
}

/* To the end of main, where the outputs are set. */
static bool count(Counter *counter, ShaderCost *cost, Message *message)
{
    const GlslCode *code = counter->code;
    int next = 0;
    begin(counter);
    while ((next = arrive(counter, next)) >= 0 && code->instructions[next].op != OP_END) {
        const GlslNode *node = &code->tree->nodes[code->instructions[next].node];
        next = step(counter, next);
        counter->work += 1 + counter->way_count;
        if (next < 0)
            return message_set(message, "operations: line %d: cannot unroll a loop",
                               node->place.line);
        if (counter->work > MOST)
            return message_set(message, "operations: too many to count");
    }
    if (counter->way.numbers)
        group_new(counter, 0);
    for (int i = 0; i < code->variable_count && counter->way.numbers; i++) {
        const GlslVariable *variable = &code->variables[i];
        for (int k = 0; k < variable->count && !is_input(code, variable); k++)
            if (variable->storage == GLSL_OUT || variable->storage == GLSL_VARYING)
                need(counter, counter->way.numbers[variable->first + k]);
    }
    /* Adds up what is needed, and what that needs. */
    for (int i = 0; i < counter->needed_count; i++) {
        const int index = counter->needed[i];
        const Group group = counter->groups[index];
        const Block block = counter->blocks[group.block];
        cost->arithmetic += group.cost.arithmetic;
        cost->special += group.cost.special;
        for (int k = group.first; k < group.first + group.count; k++) {
            const Number number = counter->numbers[k];
            if (number.group == index) {
                need(counter, number.a);
                need(counter, number.b);
            }
            for (int n = 0; n < 2 && number.op == NUMBER_CHOICE; n++)
                need_way(counter, block.from[n], block.parent);
        }
    }
    return true;
}

bool shader_cost(const char *text, ShaderStage stage, ShaderCost *cost, Message *message)
{
    GlslTree *tree = glsl_parse(text, (GlslStage)stage, NULL);
    GlslCode *code = glsl_compile(tree);
    const GlslMessage *said = tree->message_count ? &tree->messages[0] : &code->message;
    Counter counter = {.code = code};
    *cost = (ShaderCost){0};
    const bool done = said->text[0] ? message_set(message, "operations: line %d: %s",
                                                  said->place.line, said->text)
                                    : count(&counter, cost, message);
    for (int i = 0; i < counter.way_count; i++)
        free(counter.ways[i].numbers);
    free(counter.way.numbers);
    free(counter.numbers);
    free(counter.groups);
    free(counter.blocks);
    free(counter.ways);
    free(counter.needed);
    free(counter.assigned);
    glsl_code_free(code);
    glsl_tree_free(tree);
    return done;
}
