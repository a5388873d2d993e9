/* What is asked of a whole, valid text: by the linker, and by appendix A of the specification. */
#include "glsl/glsl.h"

#include "base/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void complain(GlslTree *tree, GlslPlace place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void complain(GlslTree *tree, GlslPlace place, const char *format, ...)
{
    if (tree->message_count == GLSL_MESSAGES)
        return;
    va_list arguments;
    va_start(arguments, format);
    GlslMessage *message = &tree->messages[tree->message_count++];
    message->place = place;
    vsnprintf(message->text, sizeof message->text, format, arguments);
    va_end(arguments);
}

/* Functions that are being walked, and those that have been: depth first. */
typedef struct Walk {
    GlslTree *tree;
    enum { NEW, OPEN, DONE } * states;
    int depth;
} Walk;

enum { CALLS_MAX = 200 };

static void walk_calls(Walk *walk, int node);

static void walk_function(Walk *walk, int symbol, GlslPlace place)
{
    GlslTree *tree = walk->tree;
    const GlslSymbol *function = &tree->symbols[symbol];
    if (walk->states[symbol] == DONE)
        return;
    if (walk->states[symbol] == OPEN)
        complain(tree, place, "%.60s calls itself: a GLSL function must not: use a loop",
                 function->name);
    else if (!function->node)
        complain(tree, place, "%.60s has no body: { ... } is missing", function->name);
    else if (walk->depth > CALLS_MAX)
        complain(tree, place, "functions call each other more than %d deep", CALLS_MAX);
    else {
        walk->states[symbol] = OPEN;
        walk->depth++;
        walk_calls(walk, function->node);
        walk->depth--;
    }
    walk->states[symbol] = DONE;
}

static void walk_calls(Walk *walk, int node)
{
    const GlslTree *tree = walk->tree;
    if (tree->nodes[node].kind == GLSL_CALL)
        walk_function(walk, tree->nodes[node].symbol, tree->nodes[node].place);
    for (int i = tree->nodes[node].first; i; i = tree->nodes[i].next)
        walk_calls(walk, i);
}

static bool written(const GlslTree *tree, const char *built_in)
{
    for (int i = 1; i < tree->symbol_count; i++)
        if (tree->symbols[i].built_in && strcmp(tree->symbols[i].name, built_in) == 0)
            return tree->symbols[i].written;
    return false;
}

bool glsl_check_whole(GlslTree *tree)
{
    if (tree->message_count)
        return false;
    Walk walk = {.tree = tree,
                 .states = memory_new((size_t)tree->symbol_count, sizeof *walk.states)};
    if (written(tree, "gl_FragColor") && written(tree, "gl_FragData"))
        complain(tree, (GlslPlace){0, 1, 1}, "set gl_FragColor or gl_FragData, not both");
    if (!tree->main)
        complain(tree, (GlslPlace){0, 1, 1}, "a function `void main()` is missing");
    for (int i = 1; i < tree->symbol_count; i++)
        if (tree->symbols[i].kind == GLSL_FUNCTION && tree->symbols[i].node)
            walk_function(&walk, i, tree->symbols[i].place);
    free(walk.states);
    return tree->message_count == 0;
}

/* Structures in global ones have unique names, so that each is `compared` once. */
static bool same_type(const GlslTree *a, int type, const GlslTree *b, int other, bool *compared)
{
    const GlslType *mine = &a->types[type], *its = &b->types[other];
    bool same = strcmp(mine->name, its->name) == 0 && mine->length == its->length &&
                mine->fields == its->fields && mine->scalars == its->scalars;
    const int fields = compared[type] ? 0 : mine->fields;
    compared[type] = true;
    for (int i = 0; i < fields && same; i++) {
        const GlslField *field = &a->fields[mine->field + i],
                        *its_field = &b->fields[its->field + i];
        same = strcmp(field->name, its_field->name) == 0 &&
               same_type(a, field->type, b, its_field->type, compared);
    }
    return same;
}

static bool is_same(const GlslTree *a, int type, const GlslTree *b, int other)
{
    bool *compared = memory_new((size_t)a->type_count, sizeof *compared);
    const bool same = same_type(a, type, b, other, compared);
    free(compared);
    return same;
}

static bool is_named(const GlslTree *tree, int symbol)
{
    for (int i = 1; i < tree->node_count; i++)
        if (tree->nodes[i].kind == GLSL_NAME && tree->nodes[i].symbol == symbol)
            return true;
    return false;
}

/* A global variable of the text; 0: there is none. */
static int find_global(const GlslTree *tree, const char *name)
{
    for (int i = 1; i < tree->symbol_count; i++)
        if (tree->symbols[i].kind == GLSL_VARIABLE && tree->symbols[i].global &&
            tree->symbols[i].storage >= GLSL_ATTRIBUTE && strcmp(tree->symbols[i].name, name) == 0)
            return i;
    return 0;
}

static void check_shared(const GlslTree *vertex, GlslTree *fragment, int symbol)
{
    const GlslSymbol *mine = &fragment->symbols[symbol];
    const int found = find_global(vertex, mine->name);
    const GlslSymbol *its = &vertex->symbols[found];
    const bool varying = mine->storage == GLSL_VARYING;
    char type[64], other[64];
    if (!found && varying && is_named(fragment, symbol))
        complain(fragment, mine->place,
                 "the vertex shader has no varying %.60s: compare the names in both files",
                 mine->name);
    else if (found && its->storage != mine->storage)
        complain(fragment, mine->place, "%.60s is something else in the vertex shader: rename one",
                 mine->name);
    else if (found && !is_same(vertex, its->type, fragment, mine->type))
        complain(fragment, mine->place,
                 "%.60s is %s here and %s in the vertex shader: declare it alike in both",
                 mine->name, glsl_type_text(fragment, mine->type, type),
                 glsl_type_text(vertex, its->type, other));
    else if (found && !varying && its->precision != mine->precision)
        complain(fragment, mine->place,
                 "%.60s has another precision in the vertex shader: write highp or mediump before "
                 "its type in both",
                 mine->name);
}

bool glsl_check_pair(const GlslTree *vertex, GlslTree *fragment)
{
    for (int i = 1; i < fragment->symbol_count; i++) {
        const GlslSymbol *symbol = &fragment->symbols[i];
        if (symbol->kind == GLSL_VARIABLE && symbol->global && !symbol->built_in &&
            (symbol->storage == GLSL_VARYING || symbol->storage == GLSL_UNIFORM))
            check_shared(vertex, fragment, i);
    }
    return fragment->message_count == 0;
}

/* Loops. `indices` are the symbols of the loops around; `depth`, how many. */
typedef struct Loops {
    GlslTree *tree;
    int indices[CALLS_MAX];
    int depth;
} Loops;

#define LOOPS                                                                                      \
    "write loops like for (int i = 0; i < 2; i++), with constant bounds (GLSL ES 1.00, appendix A)"

static const GlslNode *at(const GlslTree *tree, int node)
{
    return &tree->nodes[node];
}

static bool is_index(const GlslTree *tree, int node, int symbol)
{
    return at(tree, node)->kind == GLSL_NAME && at(tree, node)->symbol == symbol;
}

/* i < constant, with any comparison. */
static bool is_bound(const GlslTree *tree, int node, int symbol)
{
    const int right = glsl_child(tree, node, 1);
    return at(tree, node)->kind == GLSL_BINARY && at(tree, node)->op >= GLSL_LESS &&
           at(tree, node)->op <= GLSL_NOT_EQUAL && is_index(tree, at(tree, node)->first, symbol) &&
           at(tree, right)->constant;
}

/* i++, i--, i += constant, i -= constant. */
static bool is_step(const GlslTree *tree, int node, int symbol)
{
    const GlslNode *step = at(tree, node);
    if (!step->first || !is_index(tree, step->first, symbol))
        return false;
    return step->kind == GLSL_UNARY
               ? step->op >= GLSL_PRE_INCREMENT
               : step->kind == GLSL_ASSIGN && (step->op == GLSL_ADD || step->op == GLSL_SUBTRACT) &&
                     at(tree, glsl_child(tree, node, 1))->constant;
}

/* The loop's index; 0: the loop is none of these. */
static int loop_index(GlslTree *tree, int node)
{
    const int start = glsl_child(tree, node, 0), variable = at(tree, start)->first;
    const GlslNode *declared = at(tree, variable);
    if (at(tree, start)->kind != GLSL_DECLARE || declared->kind != GLSL_VARIABLE_NODE ||
        declared->next || !declared->first || !at(tree, declared->first)->constant ||
        (declared->type != GLSL_INT && declared->type != GLSL_FLOAT) ||
        !is_bound(tree, glsl_child(tree, node, 1), declared->symbol) ||
        !is_step(tree, glsl_child(tree, node, 2), declared->symbol))
        return 0;
    return declared->symbol;
}

/* What a statement may not do to the index of a loop around it. */
static void check_change(Loops *loops, int node)
{
    GlslTree *tree = loops->tree;
    for (int target = node; target; target = at(tree, target)->first)
        for (int i = 0; i < loops->depth; i++)
            if (is_index(tree, target, loops->indices[i])) {
                complain(tree, at(tree, node)->place,
                         "%.60s counts a loop: only its head may "
                         "change it (GLSL ES 1.00, appendix A)",
                         tree->symbols[loops->indices[i]].name);
                return;
            }
}

static void check_changes(Loops *loops, int node)
{
    const GlslTree *tree = loops->tree;
    const GlslNode *own = at(tree, node);
    if (own->kind == GLSL_ASSIGN || (own->kind == GLSL_UNARY && own->op >= GLSL_PRE_INCREMENT))
        check_change(loops, own->first);
    int k = 0;
    if (own->kind == GLSL_CALL)
        for (int i = own->first; i; i = at(tree, i)->next, k++)
            if (tree->symbols[tree->symbols[own->symbol].parameter + k].storage >= GLSL_OUT)
                check_change(loops, i);
}

/* Constants and loop indices, and what is made of them. */
static bool is_constant_index(const Loops *loops, int node)
{
    const GlslTree *tree = loops->tree;
    const GlslNode *own = at(tree, node);
    if (own->constant)
        return true;
    if (own->kind == GLSL_NAME) {
        for (int i = 0; i < loops->depth; i++)
            if (own->symbol == loops->indices[i])
                return true;
        return false;
    }
    if (own->kind == GLSL_CALL || own->kind == GLSL_ASSIGN || !own->first)
        return false;
    for (int i = own->first; i; i = at(tree, i)->next)
        if (!is_constant_index(loops, i))
            return false;
    return true;
}

static void check_index(const Loops *loops, int node)
{
    GlslTree *tree = loops->tree;
    const int base = at(tree, node)->first;
    const bool sampler = tree->types[at(tree, base)->type].sampler;
    if ((sampler || tree->stage == GLSL_FRAGMENT) &&
        !is_constant_index(loops, at(tree, base)->next))
        complain(tree, at(tree, node)->place,
                 "an index here must be constant or count a loop (GLSL ES 1.00, appendix A)");
}

static void walk_loops(Loops *loops, int node)
{
    GlslTree *tree = loops->tree;
    const int kind = at(tree, node)->kind;
    int index = 0, last = 0;
    if (kind == GLSL_WHILE || kind == GLSL_DO)
        complain(tree, at(tree, node)->place, LOOPS);
    else if (kind == GLSL_FOR && !(index = loop_index(tree, node)))
        complain(tree, at(tree, node)->place, LOOPS);
    else if (kind == GLSL_INDEX)
        check_index(loops, node);
    check_changes(loops, node);
    for (int i = at(tree, node)->first; i; i = at(tree, i)->next)
        last = i;
    for (int i = at(tree, node)->first; i; i = at(tree, i)->next) {
        const bool body = index && i == last && loops->depth < CALLS_MAX;
        if (body)
            loops->indices[loops->depth++] = index;
        walk_loops(loops, i);
        loops->depth -= body;
    }
}

bool glsl_check_loops(GlslTree *tree)
{
    Loops loops = {.tree = tree};
    if (!tree->message_count)
        walk_loops(&loops, tree->root);
    return tree->message_count == 0;
}
