/*
 * Compiling expressions: each gives a value, which is where its numbers are. Names, fields,
 * swizzles and elements are no copies, so that they can be assigned; all else is in new registers.
 */
#include "glsl/glsl_code.h"

#include <string.h>

Value value_at(int base, int count)
{
    return (Value){.base = base, .count = count, .address = -1};
}

int compute(Compiler *compiler, int op, int a, int b)
{
    const int d = reserve(compiler, 1);
    emit(compiler, op, d, a, b);
    return d;
}

int number(Compiler *compiler, double value)
{
    GlslCode *code = compiler->code;
    const int d = reserve(compiler, 1);
    if (!code->message.text[0])
        code->start[d] = value;
    return d;
}

int register_of(Compiler *compiler, Value value, int i)
{
    const int at = value.base + (value.picked ? value.pick[i] : i);
    return value.address < 0 ? at : compute(compiler, OP_LOAD, at, value.address);
}

/* Reads what cannot change while the rest of an expression is computed. */
static Value loaded(Compiler *compiler, Value value)
{
    if (value.address < 0)
        return value;
    const Value copy = value_at(reserve(compiler, value.count), value.count);
    for (int i = 0; i < value.count && !compiler->code->message.text[0]; i++)
        emit(compiler, OP_LOAD, copy.base + i, value.base + (value.picked ? value.pick[i] : i),
             value.address);
    return copy;
}

static void store(Compiler *compiler, Value to, int i, int from)
{
    const int at = to.base + (to.picked ? to.pick[i] : i);
    if (to.address < 0)
        emit(compiler, OP_SET, at, from, 0);
    else
        emit(compiler, OP_STORE, at, from, to.address);
}

/* An operation that ends as OP_INDEX says; returns its register. */
static int compile_step(Compiler *compiler, int address, int index, int step, int length)
{
    const int d = reserve(compiler, 1), at = emit(compiler, OP_INDEX, d, address, index);
    if (!compiler->code->message.text[0]) {
        compiler->code->instructions[at].c = step;
        compiler->code->instructions[at].n = length;
    }
    return d;
}

/* Of a swizzle, whose components are looked up in a list. */
static Value compile_picked_index(Compiler *compiler, Value value, int index)
{
    const int list = reserve(compiler, value.count), place = reserve(compiler, 1);
    const int at = register_of(compiler, compile_expression(compiler, index), 0);
    for (int i = 0; i < value.count && !compiler->code->message.text[0]; i++)
        compiler->code->start[list + i] = value.pick[i];
    emit(compiler, OP_LOAD, place, list, compile_step(compiler, -1, at, 1, value.count));
    const int address =
        value.address < 0 ? place : compile_step(compiler, value.address, place, 1, 4);
    return (Value){.base = value.base, .count = 1, .address = address};
}

static Value compile_index(Compiler *compiler, int node)
{
    const GlslTree *tree = compiler->tree;
    const int first = tree->nodes[node].first, second = tree->nodes[first].next;
    const GlslNode *index = &tree->nodes[second];
    Value value = compile_expression(compiler, first);
    const int step = scalars_of(tree, tree->nodes[node].type);
    const int length = step ? value.count / step : 0;
    if (value.picked)
        return compile_picked_index(compiler, value, second);
    value.count = step;
    if (index->constant) {
        const double at = tree->values[index->value];
        value.base += (at < 0 || at >= length ? 0 : (int)at) * step;
        return value;
    }
    const int b = register_of(compiler, compile_expression(compiler, second), 0);
    value.address = compile_step(compiler, value.address, b, step, length);
    return value;
}

static Value compile_field(Compiler *compiler, int node)
{
    const GlslTree *tree = compiler->tree;
    const GlslNode *at = &tree->nodes[node];
    Value value = compile_expression(compiler, at->first);
    const GlslType *type = &tree->types[tree->nodes[at->first].type];
    for (int i = 0; i < at->symbol; i++)
        value.base += scalars_of(tree, tree->fields[type->field + i].type);
    value.count = scalars_of(tree, at->type);
    return value;
}

static Value compile_swizzle(Compiler *compiler, int node)
{
    const GlslNode *at = &compiler->tree->nodes[node];
    Value value = compile_expression(compiler, at->first);
    unsigned char pick[4] = {0};
    const int count = glsl_swizzle_count(at->op);
    for (int i = 0; i < count; i++) {
        const int from = glsl_swizzle(at->op, i);
        pick[i] = (unsigned char)(value.picked ? value.pick[from] : from);
    }
    memcpy(value.pick, pick, sizeof pick);
    value.picked = true;
    value.count = count;
    return value;
}

static Value compile_name(Compiler *compiler, int node)
{
    const int symbol = compiler->tree->nodes[node].symbol;
    const Value value = value_at(compiler->where[symbol],
                                 scalars_of(compiler->tree, compiler->tree->symbols[symbol].type));
    return value;
}

/* Whether what is read has a value; asked where a variable is read, not where it is assigned. */
static void check_read(Compiler *compiler, int node, Value value)
{
    const GlslTree *tree = compiler->tree;
    int root = node;
    while (tree->nodes[root].kind == GLSL_INDEX || tree->nodes[root].kind == GLSL_FIELD ||
           tree->nodes[root].kind == GLSL_SWIZZLE)
        root = tree->nodes[root].first;
    if (tree->nodes[root].kind != GLSL_NAME || tree->nodes[root].constant ||
        !compiler->unset[tree->nodes[root].symbol])
        return;
    for (int i = 0; i < value.count && value.count <= 16 && value.address < 0; i++)
        if (!compiler->code->message.text[0])
            emit_counted(compiler, OP_CHECK, 0, register_of(compiler, value, i), 1);
}

Value compile_read(Compiler *compiler, int node)
{
    const Value value = compile_expression(compiler, node);
    check_read(compiler, node, value);
    return loaded(compiler, value);
}

/* Products of a matrix: sums of its columns, or of a vector and a column as dot sums. */
static Value multiply(Compiler *compiler, Value a, int a_type, Value b, int b_type, int type)
{
    const int rows = glsl_is_matrix(a_type) ? glsl_size(a_type) : 1, inner = glsl_size(b_type);
    const int columns = glsl_is_matrix(b_type) ? glsl_size(b_type) : 1;
    const Value result = value_at(reserve(compiler, scalars_of(compiler->tree, type)),
                                  scalars_of(compiler->tree, type));
    for (int k = 0; k < columns && !compiler->code->message.text[0]; k++)
        for (int i = 0; i < rows; i++) {
            int sum = -1;
            for (int n = 0; n < inner; n++) {
                const int j = rows > 1 ? n : inner - 1 - n;
                const int product =
                    compute(compiler, OP_MULTIPLY, register_of(compiler, a, rows * j + i),
                            register_of(compiler, b, inner * k + j));
                sum = n ? compute(compiler, OP_ADD, sum, product) : product;
            }
            emit(compiler, OP_SET, result.base + rows * k + i, sum, 0);
        }
    return result;
}

static Value compile_equal(Compiler *compiler, Value a, Value b, bool differ)
{
    int all = -1;
    for (int i = 0; i < a.count && !compiler->code->message.text[0]; i++) {
        const int one = compute(compiler, differ ? OP_NOT_EQUAL : OP_EQUAL,
                                register_of(compiler, a, i), register_of(compiler, b, i));
        all = i ? compute(compiler, differ ? OP_OR : OP_AND, all, one) : one;
    }
    return value_at(all, 1);
}

/* `types` are those of the operands and the result. */
static Value operate(Compiler *compiler, int op, Value a, Value b, const int types[3])
{
    const int a_type = types[0], b_type = types[1], type = types[2];
    const bool matrices = glsl_is_matrix(a_type) || glsl_is_matrix(b_type);
    if (op == GLSL_EQUAL || op == GLSL_NOT_EQUAL)
        return compile_equal(compiler, a, b, op == GLSL_NOT_EQUAL);
    if (op == GLSL_MULTIPLY && matrices && glsl_size(a_type) > 1 && glsl_size(b_type) > 1)
        return multiply(compiler, a, a_type, b, b_type, type);
    int what = OP_ADD;
    /* clang-format off */
    switch (op) {
    case GLSL_ADD: what = OP_ADD; break;
    case GLSL_SUBTRACT: what = OP_SUBTRACT; break;
    case GLSL_MULTIPLY: what = OP_MULTIPLY; break;
    case GLSL_DIVIDE: what = glsl_scalar(type) == GLSL_INT ? OP_INT_DIVIDE : OP_DIVIDE; break;
    case GLSL_LESS: case GLSL_GREATER: what = OP_LESS; break;
    case GLSL_LESS_EQUAL: case GLSL_GREATER_EQUAL: what = OP_LESS_EQUAL; break;
    default: what = OP_XOR; break;
    }
    /* clang-format on */
    const bool swap = op == GLSL_GREATER || op == GLSL_GREATER_EQUAL;
    const int count = scalars_of(compiler->tree, type);
    const Value result = value_at(reserve(compiler, count), count);
    for (int i = 0; i < count && !compiler->code->message.text[0]; i++) {
        const int x = register_of(compiler, a, a.count > 1 ? i : 0);
        const int y = register_of(compiler, b, b.count > 1 ? i : 0);
        emit(compiler, what, result.base + i, swap ? y : x, swap ? x : y);
    }
    return result;
}

/* && and || and ?: compute only what they need. */
static Value compile_choice(Compiler *compiler, int node)
{
    const GlslTree *tree = compiler->tree;
    const GlslNode *at = &tree->nodes[node];
    const int second = glsl_child(tree, node, 1), third = glsl_child(tree, node, 2);
    const int count = scalars_of(tree, at->type), result = reserve(compiler, count);
    const int condition = register_of(compiler, compile_read(compiler, at->first), 0);
    const bool is_or = at->kind == GLSL_BINARY && at->op == GLSL_OR;
    const int skip = emit(compiler, OP_JUMP_FALSE, 0, condition, 0);
    const Value yes = is_or ? value_at(condition, 1) : compile_read(compiler, second);
    for (int i = 0; i < count; i++)
        emit(compiler, OP_SET, result + i, register_of(compiler, yes, i), 0);
    const int over = emit(compiler, OP_JUMP, 0, 0, 0);
    const int other = compiler->code->instruction_count;
    const Value no = at->kind == GLSL_CONDITIONAL ? compile_read(compiler, third)
                     : is_or                      ? compile_read(compiler, second)
                                                  : value_at(condition, 1);
    for (int i = 0; i < count; i++)
        emit(compiler, OP_SET, result + i, register_of(compiler, no, i), 0);
    if (!compiler->code->message.text[0]) {
        compiler->code->instructions[skip].d = other;
        compiler->code->instructions[over].d = compiler->code->instruction_count;
    }
    return value_at(result, count);
}

static Value compile_binary(Compiler *compiler, int node)
{
    const GlslTree *tree = compiler->tree;
    const GlslNode *at = &tree->nodes[node];
    const int second = glsl_child(tree, node, 1);
    if (at->op == GLSL_AND || at->op == GLSL_OR)
        return compile_choice(compiler, node);
    const Value a = compile_read(compiler, at->first), b = compile_read(compiler, second);
    if (at->op == GLSL_COMMA)
        return b;
    return operate(compiler, at->op, a, b,
                   (int[]){tree->nodes[at->first].type, tree->nodes[second].type, at->type});
}

static int root_symbol(const GlslTree *tree, int node)
{
    while (node && tree->nodes[node].kind != GLSL_NAME)
        node = tree->nodes[node].first;
    return tree->nodes[node].symbol;
}

/* What is assigned, for the log: all of a small variable, else the part. */
static void log_assigned(Compiler *compiler, int node, Value part)
{
    const GlslTree *tree = compiler->tree;
    const int symbol = root_symbol(tree, tree->nodes[node].first);
    const int count = scalars_of(tree, tree->symbols[symbol].type);
    compile_event(compiler, node, symbol,
                  count <= 16 ? value_at(compiler->where[symbol], count) : part);
}

static Value compile_assign(Compiler *compiler, int node)
{
    const GlslTree *tree = compiler->tree;
    const GlslNode *at = &tree->nodes[node];
    const int second = glsl_child(tree, node, 1), type = tree->nodes[at->first].type;
    Value from = compile_read(compiler, second);
    const Value to = compile_expression(compiler, at->first);
    if (at->op != GLSL_SET) {
        check_read(compiler, at->first, to);
        from = operate(compiler, at->op, loaded(compiler, to), from,
                       (int[]){type, tree->nodes[second].type, at->type});
    } else if (to.picked && from.picked) { /* v.xy = v.yx */
        const Value copy = value_at(reserve(compiler, from.count), from.count);
        for (int i = 0; i < from.count; i++)
            emit(compiler, OP_SET, copy.base + i, register_of(compiler, from, i), 0);
        from = copy;
    }
    for (int i = 0; i < to.count && !compiler->code->message.text[0]; i++)
        store(compiler, to, i, register_of(compiler, from, i));
    log_assigned(compiler, node, from);
    return to;
}

static Value compile_unary(Compiler *compiler, int node)
{
    const GlslNode *at = &compiler->tree->nodes[node];
    const Value to = compile_expression(compiler, at->first);
    check_read(compiler, at->first, to);
    const Value old = loaded(compiler, to);
    if (at->op == GLSL_PLUS)
        return old;
    const bool step = at->op >= GLSL_PRE_INCREMENT;
    const bool down = at->op == GLSL_PRE_DECREMENT || at->op == GLSL_POST_DECREMENT;
    const bool after = at->op == GLSL_POST_INCREMENT || at->op == GLSL_POST_DECREMENT;
    const int one = number(compiler, 1), result = reserve(compiler, old.count);
    for (int i = 0; i < old.count && !compiler->code->message.text[0]; i++) {
        const int x = register_of(compiler, old, i);
        if (!step) {
            emit(compiler, at->op == GLSL_NOT ? OP_NOT : OP_NEGATE, result + i, x, 0);
            continue;
        }
        emit(compiler, OP_SET, result + i, x, 0);
        const int next = compute(compiler, down ? OP_SUBTRACT : OP_ADD, x, one);
        store(compiler, to, i, next);
        if (!after)
            emit(compiler, OP_SET, result + i, next, 0);
    }
    if (step)
        log_assigned(compiler, node, old);
    return value_at(result, old.count);
}

static Value compile_construct(Compiler *compiler, int node)
{
    const GlslTree *tree = compiler->tree;
    const GlslNode *at = &tree->nodes[node];
    const int count = scalars_of(tree, at->type), scalar = glsl_scalar(at->type);
    const int result = reserve(compiler, count);
    const bool matrix = glsl_is_matrix(at->type);
    int set = 0;
    for (int i = at->first; i && !compiler->code->message.text[0]; i = tree->nodes[i].next) {
        const Value part = compile_read(compiler, i);
        const int type = tree->nodes[i].type, from = glsl_scalar(type), size = glsl_size(type);
        const int op = !scalar || scalar == from ? OP_SET
                       : scalar == GLSL_BOOL     ? OP_BOOL
                                                 : OP_TRUNCATE;
        const bool alone = i == at->first && !tree->nodes[i].next;
        const int wanted = glsl_size(at->type);
        if (alone && matrix && (part.count == 1 || glsl_is_matrix(type))) {
            const int one = number(compiler, 1), zero = number(compiler, 0);
            for (set = 0; set < count; set++) {
                const int column = set / wanted, row = set % wanted;
                const int source =
                    part.count == 1 ? column == row ? register_of(compiler, part, 0) : zero
                    : column < size && row < size ? register_of(compiler, part, size * column + row)
                    : column == row               ? one
                                                  : zero;
                emit(compiler, op, result + set, source, 0);
            }
        } else if (alone && part.count == 1) {
            for (; set < count; set++)
                emit(compiler, op, result + set, register_of(compiler, part, 0), 0);
        }
        for (int k = 0; k < part.count && set < count; k++)
            emit(compiler, op, result + set++, register_of(compiler, part, k), 0);
    }
    return value_at(result, count);
}

Value compile_expression(Compiler *compiler, int node)
{
    const GlslTree *tree = compiler->tree;
    const GlslNode *at = &tree->nodes[node];
    const int outer = compiler->node;
    Value value = value_at(0, 0);
    if (compiler->code->message.text[0])
        return value;
    compiler->node = node;
    /* clang-format off */
    if (at->constant) {
        value = value_at(reserve(compiler, scalars_of(tree, at->type)), scalars_of(tree, at->type));
        for (int i = 0; i < value.count && !compiler->code->message.text[0]; i++)
            compiler->code->start[value.base + i] = tree->values[at->value + i];
    } else switch (at->kind) {
    case GLSL_NAME: value = compile_name(compiler, node); break;
    case GLSL_UNARY: value = compile_unary(compiler, node); break;
    case GLSL_BINARY: value = compile_binary(compiler, node); break;
    case GLSL_ASSIGN: value = compile_assign(compiler, node); break;
    case GLSL_CONDITIONAL: value = compile_choice(compiler, node); break;
    case GLSL_INDEX: value = compile_index(compiler, node); break;
    case GLSL_FIELD: value = compile_field(compiler, node); break;
    case GLSL_SWIZZLE: value = compile_swizzle(compiler, node); break;
    case GLSL_CALL: value = compile_call(compiler, node); break;
    case GLSL_BUILT_IN: value = compile_built_in(compiler, node); break;
    case GLSL_CONSTRUCT: value = compile_construct(compiler, node); break;
    default: break;
    }
    /* clang-format on */
    compiler->node = outer;
    return value;
}
