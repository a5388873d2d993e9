/*
 * Compiling statements and functions. A call is inlined with new registers for what the function
 * declares; a return jumps to the end of that copy.
 */
#include "glsl/glsl_code.h"

#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Instructions or registers; calls in each other, and all. */
enum { MOST = 1000000, DEEPEST = 64, CALLS = 100000 };

void cannot(Compiler *compiler, const char *why)
{
    GlslMessage *message = &compiler->code->message;
    if (message->text[0])
        return;
    message->place = compiler->tree->nodes[compiler->node].place;
    snprintf(message->text, sizeof message->text, "%s", why);
}

int emit(Compiler *compiler, int op, int d, int a, int b)
{
    GlslCode *code = compiler->code;
    const GlslNode *node = &compiler->tree->nodes[compiler->node];
    const bool is_float = glsl_scalar(node->type) == GLSL_FLOAT;
    if (code->instruction_count >= MOST) {
        cannot(compiler,
               "this shader is too large to run here: its functions make a million steps");
        return 0;
    }
    GlslInstruction *at = memory_add(&code->instructions, &code->instruction_count,
                                     &code->instruction_room, sizeof *at);
    *at = (GlslInstruction){.op = (unsigned char)op,
                            .precision = (unsigned char)(!is_float         ? GLSL_NO_PRECISION
                                                         : node->precision ? node->precision
                                                                           : GLSL_HIGHP),
                            .d = d,
                            .a = a,
                            .b = b,
                            .node = compiler->node};
    return code->instruction_count - 1;
}

/* The list may move while it grows. */
void emit_counted(Compiler *compiler, int op, int d, int a, int n)
{
    const int at = emit(compiler, op, d, a, 0);
    compiler->code->instructions[at].n = n;
}

int reserve(Compiler *compiler, int count)
{
    GlslCode *code = compiler->code;
    const int first = code->register_count;
    if (count > MOST - first) {
        cannot(compiler, "this shader is too large to run here: it has a million numbers");
        return 0;
    }
    for (int i = 0; i < count; i++)
        *(double *)memory_add(&code->start, &code->register_count, &code->register_room,
                              sizeof(double)) = 0;
    return first;
}

int scalars_of(const GlslTree *tree, int type)
{
    const GlslType *of = &tree->types[type];
    long long count = of->scalars;
    if (!of->sampler)
        return of->scalars;
    if (of->element) {
        count = (long long)of->length * scalars_of(tree, of->element);
    } else if (of->fields) {
        count = 0;
        for (int i = 0; i < of->fields && count < MOST; i++) /* else 2^n of n structures */
            count += scalars_of(tree, tree->fields[of->field + i].type);
    } else {
        count = 1;
    }
    return count < MOST ? (int)count : MOST + 1;
}

void compile_event(Compiler *compiler, int node, int symbol, Value value)
{
    if (value.count < 1 || value.count > 16)
        return;
    const int outer = compiler->node;
    compiler->node = node;
    int first = value.base;
    if (value.address >= 0 || value.picked) {
        first = reserve(compiler, value.count);
        for (int i = 0; i < value.count; i++)
            emit(compiler, OP_SET, first + i, register_of(compiler, value, i), 0);
    }
    const int at = emit(compiler, OP_EVENT, 0, first, 0);
    if (!compiler->code->message.text[0]) {
        compiler->code->instructions[at].c = symbol;
        compiler->code->instructions[at].n = value.count;
    }
    compiler->node = outer;
}

static void wait_at(Waiting *waiting, int jump)
{
    *(int *)memory_add(&waiting->jumps, &waiting->count, &waiting->room, sizeof(int)) = jump;
}

static int here(const Compiler *compiler)
{
    return compiler->code->instruction_count;
}

static void arrive(Compiler *compiler, int jump)
{
    if (!compiler->code->message.text[0])
        compiler->code->instructions[jump].d = here(compiler);
}

static void arrive_all(Compiler *compiler, Waiting *waiting, Waiting outer)
{
    for (int i = 0; i < waiting->count; i++)
        arrive(compiler, waiting->jumps[i]);
    free(waiting->jumps);
    *waiting = outer;
}

static void compile_statement(Compiler *compiler, int node);

static void compile_variable(Compiler *compiler, int node)
{
    const GlslNode *at = &compiler->tree->nodes[node];
    const GlslSymbol *symbol = &compiler->tree->symbols[at->symbol];
    const int first = at->first, count = scalars_of(compiler->tree, symbol->type);
    const bool valued = first && compiler->tree->nodes[first].kind != GLSL_NOTHING;
    compiler->node = node;
    if (symbol->storage != GLSL_LOCAL && symbol->storage != GLSL_CONST)
        return;
    const Value from = valued ? compile_read(compiler, first) : value_at(0, 0);
    if (!symbol->global)
        compiler->where[at->symbol] = reserve(compiler, count);
    const Value to = value_at(compiler->where[at->symbol], count);
    if (compiler->code->message.text[0])
        return;
    compiler->node = node;
    for (int i = 0; i < from.count; i++)
        emit(compiler, OP_SET, to.base + i, register_of(compiler, from, i), 0);
    if (valued)
        compile_event(compiler, node, at->symbol, to);
    else
        emit_counted(compiler, OP_UNSET, to.base, 0, count);
    compiler->unset[at->symbol] = !valued;
}

/* Numbers that round. */
static bool is_computed(const GlslNode *at)
{
    const int kind = at->kind;
    return glsl_scalar(at->type) == GLSL_FLOAT && !at->constant && kind != GLSL_NAME &&
           (kind < GLSL_INDEX || kind > GLSL_SWIZZLE);
}

static bool rounds(const GlslTree *tree, int node)
{
    bool found = is_computed(&tree->nodes[node]);
    for (int i = tree->nodes[node].first; i && !found; i = tree->nodes[i].next)
        found = rounds(tree, i);
    return found;
}

/* What a condition or a return computes is an event without a symbol. */
static Value compile_computed(Compiler *compiler, int node)
{
    const Value value = compile_read(compiler, node);
    if (rounds(compiler->tree, node))
        compile_event(compiler, node, 0, value);
    return value;
}

static int compile_condition(Compiler *compiler, int node)
{
    const GlslNode *at = &compiler->tree->nodes[node];
    if (at->kind == GLSL_NOTHING)
        return number(compiler, 1);
    if (at->kind == GLSL_DECLARE) {
        int variable = at->first;
        compile_statement(compiler, node);
        while (compiler->tree->nodes[variable].next)
            variable = compiler->tree->nodes[variable].next;
        return compiler->where[compiler->tree->nodes[variable].symbol];
    }
    return register_of(compiler, compile_computed(compiler, node), 0);
}

static void compile_loop(Compiler *compiler, int node)
{
    const GlslTree *tree = compiler->tree;
    const GlslNode *at = &tree->nodes[node];
    const Waiting breaks = compiler->breaks, continues = compiler->continues;
    compiler->breaks = compiler->continues = (Waiting){0};
    const int children[4] = {at->first, glsl_child(tree, node, 1), glsl_child(tree, node, 2),
                             glsl_child(tree, node, 3)};
    const bool is_for = at->kind == GLSL_FOR, is_do = at->kind == GLSL_DO;
    if (is_for)
        compile_statement(compiler, children[0]);
    const int start = here(compiler);
    compiler->node = node;
    emit(compiler, OP_LOOP, 0, 0, 0);
    const int condition = is_for ? children[1] : is_do ? children[1] : children[0];
    if (!is_do)
        wait_at(&compiler->breaks,
                emit(compiler, OP_JUMP_FALSE, 0, compile_condition(compiler, condition), 0));
    compile_statement(compiler, is_for ? children[3] : is_do ? children[0] : children[1]);
    arrive_all(compiler, &compiler->continues, continues);
    if (is_for && tree->nodes[children[2]].kind != GLSL_NOTHING)
        compile_expression(compiler, children[2]);
    if (is_do)
        wait_at(&compiler->breaks,
                emit(compiler, OP_JUMP_FALSE, 0, compile_condition(compiler, condition), 0));
    emit(compiler, OP_JUMP, start, 0, 0);
    arrive_all(compiler, &compiler->breaks, breaks);
}

static void compile_if(Compiler *compiler, int node)
{
    const GlslTree *tree = compiler->tree;
    const int condition = compile_condition(compiler, tree->nodes[node].first);
    const int skip = emit(compiler, OP_JUMP_FALSE, 0, condition, 0);
    compile_statement(compiler, glsl_child(tree, node, 1));
    const int other = glsl_child(tree, node, 2);
    if (other && tree->nodes[other].kind != GLSL_NOTHING) {
        const int over = emit(compiler, OP_JUMP, 0, 0, 0);
        arrive(compiler, skip);
        compile_statement(compiler, other);
        arrive(compiler, over);
    } else {
        arrive(compiler, skip);
    }
}

static void compile_return(Compiler *compiler, int node)
{
    const int first = compiler->tree->nodes[node].first;
    if (first && compiler->tree->nodes[first].kind != GLSL_NOTHING) {
        const Value value = compile_computed(compiler, first);
        for (int i = 0; i < value.count; i++)
            emit(compiler, OP_SET, compiler->result + i, register_of(compiler, value, i), 0);
    }
    wait_at(&compiler->returns, emit(compiler, OP_JUMP, 0, 0, 0));
}

static void compile_statement(Compiler *compiler, int node)
{
    const GlslNode *at = &compiler->tree->nodes[node];
    const int outer = compiler->node;
    if (compiler->code->message.text[0])
        return;
    compiler->node = node;
    /* clang-format off */
    switch (at->kind) {
    case GLSL_BLOCK: case GLSL_DECLARE:
        for (int i = at->first; i; i = compiler->tree->nodes[i].next)
            compile_statement(compiler, i);
        break;
    case GLSL_VARIABLE_NODE: compile_variable(compiler, node); break;
    case GLSL_EXPRESSION: compile_expression(compiler, at->first); break;
    case GLSL_IF: compile_if(compiler, node); break;
    case GLSL_FOR: case GLSL_WHILE: case GLSL_DO: compile_loop(compiler, node); break;
    case GLSL_RETURN: compile_return(compiler, node); break;
    case GLSL_BREAK: wait_at(&compiler->breaks, emit(compiler, OP_JUMP, 0, 0, 0)); break;
    case GLSL_CONTINUE:
        wait_at(&compiler->continues, emit(compiler, OP_JUMP, 0, 0, 0));
        break;
    case GLSL_DISCARD: emit(compiler, OP_DISCARD, 0, 0, 0); break;
    default: break;
    }
    /* clang-format on */
    compiler->node = outer;
}

static void pass_in(Compiler *compiler, int symbol, Value value, int to)
{
    const GlslSymbol *parameter = &compiler->tree->symbols[symbol];
    compiler->unset[symbol] = parameter->storage == GLSL_OUT;
    if (parameter->storage == GLSL_OUT)
        emit_counted(compiler, OP_UNSET, to, 0, value.count);
    else
        for (int i = 0; i < value.count; i++)
            emit(compiler, OP_SET, to + i, register_of(compiler, value, i), 0);
}

static void pass_out(Compiler *compiler, const GlslSymbol *parameter, Value value, int from)
{
    if (parameter->storage < GLSL_OUT)
        return;
    for (int i = 0; i < value.count; i++) {
        const int to = value.base + (value.picked ? value.pick[i] : i);
        if (value.address >= 0)
            emit(compiler, OP_STORE, to, from + i, value.address);
        else
            emit(compiler, OP_SET, to, from + i, 0);
    }
}

/* Its arguments are assignments only if others follow in it, which else would be taken for where
 * they are rounded. */
static void forget_arguments(Compiler *compiler, int first, int end)
{
    GlslCode *code = compiler->code;
    bool follow = false;
    for (int i = end; i < code->instruction_count; i++)
        follow |= glsl_event_symbol(code, i) != 0;
    for (int i = first; i < end && !follow; i++)
        if (code->instructions[i].op == OP_EVENT)
            code->instructions[i].c = 0;
}

Value compile_call(Compiler *compiler, int node)
{
    enum { PARAMETERS = 64 };
    const GlslTree *tree = compiler->tree;
    const GlslSymbol *function = &tree->symbols[tree->nodes[node].symbol];
    const int block = function->node ? glsl_child(tree, function->node, function->parameters) : 0;
    const Value result = value_at(reserve(compiler, scalars_of(tree, function->type)),
                                  scalars_of(tree, function->type));
    if (++compiler->calls > CALLS)
        cannot(compiler, "this shader is too large to run here: 100,000 calls");
    if (++compiler->depth > DEEPEST || !block || function->parameters > PARAMETERS)
        cannot(compiler, block ? "a function calls itself, or calls are too deep"
                               : "a function is called that has no body");
    Value arguments[PARAMETERS];
    int old[PARAMETERS] = {0}, count = 0;
    const int outer_result = compiler->result;
    const Waiting returns = compiler->returns, breaks = compiler->breaks,
                  continues = compiler->continues;
    for (int i = tree->nodes[node].first; i && !compiler->code->message.text[0];
         i = tree->nodes[i].next)
        arguments[count] = tree->symbols[function->parameter + count].storage >= GLSL_OUT
                               ? compile_expression(compiler, i)
                               : compile_read(compiler, i),
        count++;
    const int passing = here(compiler);
    for (int i = 0, at = tree->nodes[node].first; i < count && !compiler->code->message.text[0];
         i++, at = tree->nodes[at].next) {
        const int to = reserve(compiler, arguments[i].count);
        pass_in(compiler, function->parameter + i, arguments[i], to);
        if (is_computed(&tree->nodes[at]))
            compile_event(compiler, at, function->parameter + i, value_at(to, arguments[i].count));
        old[i] = to;
    }
    const int passed = here(compiler);
    compiler->returns = compiler->breaks = compiler->continues = (Waiting){0};
    compiler->result = result.base;
    for (int i = 0; i < count; i++)
        compiler->where[function->parameter + i] = old[i];
    compile_statement(compiler, block);
    forget_arguments(compiler, passing, passed);
    arrive_all(compiler, &compiler->returns, returns);
    compiler->breaks = breaks;
    compiler->continues = continues;
    for (int i = 0; i < count && !compiler->code->message.text[0]; i++)
        pass_out(compiler, &tree->symbols[function->parameter + i], arguments[i], old[i]);
    compiler->result = outer_result;
    compiler->depth--;
    return result;
}

static void add_variable(Compiler *compiler, const char *name, int symbol, int type, int first)
{
    GlslCode *code = compiler->code;
    const GlslTree *tree = compiler->tree;
    const GlslType *of = &tree->types[type];
    const int element = of->element ? of->element : type;
    const int step = scalars_of(tree, element);
    char part[128];
    if (!tree->types[element].fields) {
        GlslVariable *variable = memory_add(&code->variables, &code->variable_count,
                                            &code->variable_room, sizeof *variable);
        *variable = (GlslVariable){.symbol = symbol,
                                   .type = type,
                                   .storage = tree->symbols[symbol].storage,
                                   .first = first,
                                   .count = scalars_of(tree, type)};
        snprintf(variable->name, sizeof variable->name, "%s", name);
        return;
    }
    for (int i = 0; i < (of->element ? of->length : 1) && code->variable_count < 10000; i++) {
        int at = first + i * step;
        for (int k = 0; k < tree->types[element].fields; k++) {
            const GlslField *field = &tree->fields[tree->types[element].field + k];
            if (of->element)
                snprintf(part, sizeof part, "%.80s[%d].%.30s", name, i, field->name);
            else
                snprintf(part, sizeof part, "%.80s.%.30s", name, field->name);
            add_variable(compiler, part, symbol, field->type, at);
            at += scalars_of(tree, field->type);
        }
    }
}

/* Globals have registers, the built-in ones and those of the text alike. */
static void place_globals(Compiler *compiler)
{
    const GlslTree *tree = compiler->tree;
    for (int i = 1; i < tree->symbol_count && !compiler->code->message.text[0]; i++) {
        const GlslSymbol *symbol = &tree->symbols[i];
        if (symbol->kind != GLSL_VARIABLE || !symbol->global)
            continue;
        compiler->where[i] = reserve(compiler, scalars_of(tree, symbol->type));
        if (symbol->storage != GLSL_CONST && !compiler->code->message.text[0])
            add_variable(compiler, symbol->name, i, symbol->type, compiler->where[i]);
    }
}

GlslCode *glsl_compile(const GlslTree *tree)
{
    GlslCode *code = memory_new(1, sizeof *code);
    Compiler compiler = {.code = code, .tree = tree};
    code->tree = tree;
    compiler.where = memory_new((size_t)tree->symbol_count, sizeof(int));
    compiler.unset = memory_new((size_t)tree->symbol_count, sizeof(bool));
    if (tree->message_count || !tree->main || !tree->symbols[tree->main].node) {
        cannot(&compiler, "only a shader that is valid and has a main can run");
    } else {
        const GlslSymbol *main = &tree->symbols[tree->main];
        place_globals(&compiler);
        for (int i = tree->nodes[tree->root].first; i; i = tree->nodes[i].next)
            if (tree->nodes[i].kind == GLSL_DECLARE)
                compile_statement(&compiler, i);
        compiler.node = main->node;
        compile_statement(&compiler, glsl_child(tree, main->node, 0));
        arrive_all(&compiler, &compiler.returns, (Waiting){0});
        emit(&compiler, OP_END, 0, 0, 0);
    }
    free(compiler.where);
    free(compiler.unset);
    free(compiler.breaks.jumps);
    free(compiler.continues.jumps);
    free(compiler.returns.jumps);
    return code;
}

void glsl_code_free(GlslCode *code)
{
    if (!code)
        return;
    free(code->instructions);
    free(code->start);
    free(code->variables);
    free(code);
}

bool glsl_find(const GlslCode *code, const char *name, GlslVariable *found)
{
    const char *bracket = strrchr(name, '[');
    const bool element = bracket && strchr(bracket, ']') && !strchr(bracket, ']')[1];
    const size_t length = element ? (size_t)(bracket - name) : strlen(name);
    for (int i = 0; i < code->variable_count; i++) {
        const GlslVariable *at = &code->variables[i];
        if (strlen(at->name) != length || strncmp(at->name, name, length) != 0)
            continue;
        const GlslType *type = &code->tree->types[at->type];
        const int index = element ? atoi(bracket + 1) : 0;
        *found = *at;
        if (element && (!type->element || index < 0 || index >= type->length))
            return false;
        if (element) {
            found->type = type->element;
            found->count = scalars_of(code->tree, type->element);
            found->first += index * found->count;
        }
        return true;
    }
    return false;
}
