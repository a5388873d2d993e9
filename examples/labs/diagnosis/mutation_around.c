/* What depends on more than an operation's own text: the loop around it, a variable's value, the
 * statements beside it. */
#include "labs/diagnosis/mutation.h"
#include "labs/diagnosis/mutation_forms.h"

#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 12, NAME_SIZE = 72, TEXT_SIZE = 512, DEPTH = 4 };

/* Loops. */

/* One more and one less, of an int or a float. */
static void add_one(GlslTree *tree, int node, int number, FormTake *take, void *context)
{
    const GlslNode *at = &tree->nodes[number];
    for (int by = 1; by >= -1 && (at->type == GLSL_INT || at->type == GLSL_FLOAT); by -= 2) {
        char text[TEXT_SIZE], put[TEXT_SIZE];
        GlslNode was;
        if (at->constant && at->type == GLSL_INT) {
            snprintf(put, sizeof put, "%d", (int)tree->values[at->value] + by);
        } else {
            glsl_expression_text(tree, number, put, sizeof put - 8);
            strcat(put, by > 0 ? " + 1" : " - 1");
            strcat(put, at->type == GLSL_INT ? "" : ".0");
        }
        mutation_put(tree, number, put, &was);
        glsl_expression_text(tree, node, text, sizeof text);
        mutation_take_back(tree, number, &was);
        take(context, &(Form){.text = text});
    }
}

void forms_turns(GlslTree *tree, int node, FormTake *take, void *context)
{
    const GlslNode *at = &tree->nodes[node];
    if (at->kind == GLSL_BINARY && at->op >= GLSL_LESS && at->op <= GLSL_GREATER_EQUAL &&
        tree->nodes[forms_parent(tree, node)].kind == GLSL_FOR)
        add_one(tree, node, tree->nodes[at->first].next, take, context);
}

void forms_begins(GlslTree *tree, int node, FormTake *take, void *context)
{
    const int above = forms_parent(tree, node);
    const int loop = forms_parent(tree, forms_parent(tree, above));
    if (tree->nodes[above].kind == GLSL_VARIABLE_NODE && tree->nodes[loop].kind == GLSL_FOR)
        add_one(tree, node, node, take, context);
}

/* Other lights. */

/* What a local variable is computed from: what was assigned last, else its first value; 0: nothing
 * that is known. */
static int value_of(const GlslTree *tree, const GlslNode *node)
{
    const GlslSymbol *symbol = &tree->symbols[node->symbol];
    int value = 0;
    if (node->kind != GLSL_NAME || symbol->kind != GLSL_VARIABLE || symbol->built_in ||
        symbol->global || symbol->storage != GLSL_LOCAL || node->symbol == 0)
        return 0;
    for (int i = 1; i < tree->node_count; i++) {
        const GlslNode *at = &tree->nodes[i], *first = &tree->nodes[at->first];
        if (at->kind == GLSL_VARIABLE_NODE && at->symbol == node->symbol && !value)
            value = first->kind == GLSL_NOTHING ? 0 : at->first;
        else if (at->kind == GLSL_ASSIGN && at->op == GLSL_SET && first->kind == GLSL_NAME &&
                 first->symbol == node->symbol)
            value = first->next;
    }
    return value;
}

/* Of an element of a uniform the index; 0: it is none. */
static int index_of(const GlslTree *tree, const GlslNode *node)
{
    const GlslNode *base = &tree->nodes[node->first];
    return node->kind == GLSL_INDEX && base->kind == GLSL_NAME &&
                   tree->symbols[base->symbol].storage == GLSL_UNIFORM &&
                   tree->types[base->type].element
               ? base->next
               : 0;
}

typedef struct Other {
    const char *index;   /* that uniforms get */
    char was[NAME_SIZE]; /* that they have; "": there is none */
} Other;

/* What is put into an expression. */
typedef struct Puts {
    char *texts[MOST];
    int places[MOST], count;
    GlslNode were[MOST];
} Puts;

static char *other_text(GlslTree *tree, int node, Other *other, int depth);

/* Puts other texts where uniforms' elements and variables that depend on them are. */
static void put_others(GlslTree *tree, int node, Other *other, int depth, Puts *puts)
{
    const GlslNode *at = &tree->nodes[node];
    const int index = index_of(tree, at), value = value_of(tree, at);
    char *text = NULL, base[NAME_SIZE];
    if (index) {
        glsl_expression_text(tree, index, other->was, sizeof other->was);
        glsl_expression_text(tree, at->first, base, sizeof base);
        text = memory_format("%s[%s]", base, other->index);
    } else if (value && depth > 0) {
        text = other_text(tree, value, other, depth - 1);
    }
    if (text && puts->count < MOST) {
        puts->texts[puts->count] = text;
        puts->places[puts->count] = node;
        mutation_put(tree, node, text, &puts->were[puts->count++]);
        return;
    }
    free(text);
    for (int i = at->first; i && !index; i = tree->nodes[i].next)
        put_others(tree, i, other, depth, puts);
}

/* An expression's text with the other index, in parentheses; NULL: it has none. */
static char *other_text(GlslTree *tree, int node, Other *other, int depth)
{
    Puts *puts = memory_new(1, sizeof *puts);
    char text[TEXT_SIZE];
    put_others(tree, node, other, depth, puts);
    const bool found = puts->count > 0;
    glsl_expression_text(tree, node, text, sizeof text);
    while (puts->count > 0) {
        puts->count--;
        mutation_take_back(tree, puts->places[puts->count], &puts->were[puts->count]);
        free(puts->texts[puts->count]);
    }
    free(puts);
    return found ? memory_format("(%s)", text) : NULL;
}

static const char *light_of(const char *index)
{
    return strcmp(index, "0") == 0   ? "the first light"
           : strcmp(index, "1") == 0 ? "the second light"
                                     : "each light";
}

void forms_lights(GlslTree *tree, int node, FormTake *take, void *context)
{
    const int value = value_of(tree, &tree->nodes[node]), count = tree->symbol_count;
    for (int i = -1; i < count && value; i++) {
        const GlslSymbol *symbol = &tree->symbols[i < 0 ? 0 : i];
        const bool counter = symbol->kind == GLSL_VARIABLE && symbol->type == GLSL_INT &&
                             symbol->storage == GLSL_LOCAL && !symbol->global;
        Other other = {.index = i == -1 ? "0" : i == 0 ? "1" : symbol->name};
        char *text = i < 1 || counter ? other_text(tree, value, &other, DEPTH) : NULL;
        if (text && strcmp(other.was, other.index) != 0)
            take(
                context,
                &(Form){.text = text, .name = light_of(other.index), .other = light_of(other.was)});
        free(text);
    }
}

void forms_twins(GlslTree *tree, int node, FormTake *take, void *context)
{
    static const char *const INDICES[] = {"0", "1"};
    const GlslNode *at = &tree->nodes[node];
    if (at->type != GLSL_VEC3 || (at->kind != GLSL_BINARY && at->kind != GLSL_CALL))
        return;
    for (int i = 0; i < 2; i++) {
        Other other = {.index = INDICES[i]};
        char *text = other_text(tree, node, &other, DEPTH);
        if (text && strcmp(other.was, INDICES[1 - i]) == 0)
            take(context, &(Form){.text = text, .name = light_of(other.index)});
        free(text);
    }
}

/* Moves. */

/* What a loop or an `if` does, if that is a block; 0: it is neither. */
static int block_of(const GlslTree *tree, int node)
{
    const GlslNode *at = &tree->nodes[node];
    int body = at->kind == GLSL_IF ? tree->nodes[at->first].next : 0;
    for (int i = at->kind == GLSL_FOR ? at->first : 0; i; i = tree->nodes[i].next)
        body = i;
    return tree->nodes[body].kind == GLSL_BLOCK ? body : 0;
}

static void unlink_node(GlslTree *tree, int block, int node)
{
    int *at = &tree->nodes[block].first;
    while (*at != node)
        at = &tree->nodes[*at].next;
    *at = tree->nodes[node].next;
}

/* Into a block, before a node, 0: as its last. */
static void link_node(GlslTree *tree, int block, int node, int before)
{
    int *at = &tree->nodes[block].first;
    while (*at && *at != before)
        at = &tree->nodes[*at].next;
    tree->nodes[node].next = before;
    *at = node;
}

typedef struct Move {
    GlslTree *tree;
    int node, from; /* from: the block it is in */
    FormTake *take;
    void *context;
    const char *was;
} Move;

static void put_moved(const Move *move, int to, int before, const char *name, const char *text)
{
    GlslTree *tree = move->tree;
    const size_t size = (size_t)tree->node_count * sizeof *tree->nodes;
    GlslNode *saved = memory_new(1, size);
    memcpy(saved, tree->nodes, size);
    unlink_node(tree, move->from, move->node);
    link_node(tree, to, move->node, before);
    char *whole = glsl_print(tree, tree->root);
    memcpy(tree->nodes, saved, size);
    move->take(move->context,
               &(Form){.text = text, .name = name, .whole = whole, .was = move->was});
    free(whole);
    free(saved);
}

static void move(const Move *move, int to, int before, int around, const char *was, const char *by)
{
    const char *what = move->tree->nodes[around].kind == GLSL_FOR ? "loop" : "if";
    char name[64], text[64];
    snprintf(name, sizeof name, "%s the %s, not %s it", was, what, by);
    snprintf(text, sizeof text, "it %s the %s", by, what);
    put_moved(move, to, before, name, text);
}

/* Before each of the statements right before it. */
static void move_up(const Move *move)
{
    enum { NEAR_BEFORE = 4 };
    const GlslTree *tree = move->tree;
    int befores[NEAR_BEFORE] = {0}, count = 0;
    char text[32];
    for (int i = tree->nodes[move->from].first; i != move->node; i = tree->nodes[i].next)
        befores[count++ % NEAR_BEFORE] = i;
    for (int back = 1; back <= count && back <= NEAR_BEFORE; back++) {
        snprintf(text, sizeof text,
                 back > 1 ? "it %d statements earlier" : "it one statement earlier", back);
        put_moved(move, move->from, befores[(count - back) % NEAR_BEFORE], "too late", text);
    }
}

void forms_moves(GlslTree *tree, int node, FormTake *take, void *context)
{
    if (tree->nodes[node].kind != GLSL_EXPRESSION)
        return;
    const int block = forms_parent(tree, node), around = forms_parent(tree, block);
    const Move moves = {tree, node, block, take, context, "where it is"};
    int before = 0, after = 0; /* the nearest ones */
    if (tree->nodes[block].kind != GLSL_BLOCK)
        return;
    move_up(&moves);
    bool passed = false;
    for (int i = tree->nodes[block].first; i; i = tree->nodes[i].next) {
        passed |= i == node;
        before = block_of(tree, i) && !passed ? i : before;
        after = block_of(tree, i) && passed && !after ? i : after;
    }
    if (before)
        move(&moves, block_of(tree, before), 0, before, "after", "in");
    if (after)
        move(&moves, block_of(tree, after), tree->nodes[block_of(tree, after)].first, after,
             "before", "in");
    const int outer = forms_parent(tree, around);
    if (block_of(tree, around) != block || tree->nodes[outer].kind != GLSL_BLOCK)
        return;
    move(&moves, outer, tree->nodes[around].next, around, "in", "after");
    move(&moves, outer, around, around, "in", "before");
}

void forms_else_ifs(GlslTree *tree, int node, FormTake *take, void *context)
{
    const GlslNode *nodes = tree->nodes;
    const int inner = forms_parent(tree, node), outer = forms_parent(tree, inner);
    const int then = nodes[nodes[outer].first].next, block = forms_parent(tree, outer);
    if (nodes[inner].kind == GLSL_IF && nodes[inner].first == node &&
        nodes[outer].kind == GLSL_IF && nodes[then].next == inner &&
        nodes[block].kind == GLSL_BLOCK)
        put_moved(&(Move){tree, inner, outer, take, context, "else if"}, block, nodes[outer].next,
                  "", "if");
}

/* Exponents. */

/* Whether the variable is in the second argument of a power below the node. */
static bool is_exponent(const GlslTree *tree, int node, int symbol, bool within)
{
    const GlslNode *at = &tree->nodes[node];
    const bool power = at->kind == GLSL_BUILT_IN && GLSL_FUNCTIONS[at->symbol].id == GLSL_POW;
    bool found = within && at->kind == GLSL_NAME && at->symbol == symbol;
    for (int i = at->first; i && !found; i = tree->nodes[i].next)
        found = is_exponent(tree, i, symbol, within || (power && i != at->first));
    return found;
}

void forms_exponents(GlslTree *tree, int node, FormTake *take, void *context)
{
    const GlslNode *at = &tree->nodes[node];
    if (at->type != GLSL_FLOAT)
        return;
    const GlslNode *above = &tree->nodes[forms_parent(tree, node)];
    if (above->kind == GLSL_VARIABLE_NODE && is_exponent(tree, tree->root, above->symbol, false))
        take(context, &(Form){.text = "1.0"});
}

/* Sums. */

/* The declaration of a variable without a value; 0: it has one, or is none of these. */
static int bare_declaration(const GlslTree *tree, const GlslNode *name)
{
    int found = 0;
    for (int i = 1; i < tree->node_count && name->kind == GLSL_NAME && !found; i++)
        if (tree->nodes[i].kind == GLSL_VARIABLE_NODE && tree->nodes[i].symbol == name->symbol &&
            tree->symbols[name->symbol].storage == GLSL_LOCAL && !tree->nodes[i].first)
            found = i;
    return found;
}

void forms_summed(GlslTree *tree, int node, FormTake *take, void *context)
{
    const GlslNode at = tree->nodes[node];
    const int variable = bare_declaration(tree, &tree->nodes[at.first]);
    char type[64], zero[72], text[TEXT_SIZE], name[NAME_SIZE];
    GlslNode was;
    if (at.kind != GLSL_ASSIGN || at.op != GLSL_SET || !variable)
        return;
    memory_add(&tree->nodes, &tree->node_count, &tree->node_room, sizeof *tree->nodes);
    const int value = tree->node_count - 1;
    tree->nodes[value] = (GlslNode){.kind = GLSL_LITERAL};
    tree->nodes[variable].first = value;
    snprintf(zero, sizeof zero, "%s(0.0)", glsl_type_text(tree, at.type, type));
    mutation_put(tree, value, zero, &was);
    tree->nodes[node].op = GLSL_ADD;
    glsl_expression_text(tree, node, text, sizeof text);
    glsl_expression_text(tree, at.first, name, sizeof name);
    char *whole = glsl_print(tree, tree->root);
    tree->nodes[node].op = GLSL_SET;
    mutation_take_back(tree, value, &was);
    tree->nodes[variable].first = 0;
    tree->node_count--;
    take(context, &(Form){.text = text, .name = name, .whole = whole});
    free(whole);
}

/* Declarations. */

/* Whether a local variable hides another one of its name and type. */
static bool hides(const GlslTree *tree, int symbol)
{
    const GlslSymbol *own = &tree->symbols[symbol];
    bool found = false;
    for (int i = 1; i < symbol && own->storage == GLSL_LOCAL && !found; i++)
        found = tree->symbols[i].kind == GLSL_VARIABLE && tree->symbols[i].type == own->type &&
                tree->symbols[i].name && strcmp(tree->symbols[i].name, own->name) == 0;
    return found;
}

void forms_declared(GlslTree *tree, int node, FormTake *take, void *context)
{
    const int variable = forms_parent(tree, node), declaration = forms_parent(tree, variable);
    char type[64], value[TEXT_SIZE / 2], text[TEXT_SIZE - 64], was[TEXT_SIZE];
    GlslNode kept;
    if (tree->nodes[variable].kind != GLSL_VARIABLE_NODE || tree->nodes[variable].next ||
        tree->nodes[declaration].first != variable ||
        tree->nodes[forms_parent(tree, declaration)].kind != GLSL_BLOCK ||
        !hides(tree, tree->nodes[variable].symbol))
        return;
    const GlslSymbol *symbol = &tree->symbols[tree->nodes[variable].symbol];
    const char *name = symbol->name;
    glsl_expression_text(tree, node, value, sizeof value);
    snprintf(text, sizeof text, "%.99s = %s", name, value);
    snprintf(was, sizeof was, "%s %s", glsl_type_text(tree, symbol->type, type), text);
    const GlslNode declared = tree->nodes[declaration];
    tree->nodes[declaration].kind = GLSL_EXPRESSION;
    mutation_put(tree, declaration, text, &kept);
    char *whole = glsl_print(tree, tree->root);
    mutation_take_back(tree, declaration, &kept);
    tree->nodes[declaration] = declared;
    take(context, &(Form){.text = text, .name = name, .whole = whole, .was = was});
    free(whole);
}

/* Parameters. */

void forms_inout(GlslTree *tree, int node, FormTake *take, void *context)
{
    int target = tree->nodes[node].first;
    char type[64], name[NAME_SIZE], was[TEXT_SIZE], text[TEXT_SIZE];
    while (forms_is_name(&tree->nodes[target]) && tree->nodes[target].kind != GLSL_NAME)
        target = tree->nodes[target].first;
    GlslSymbol *symbol = &tree->symbols[tree->nodes[target].symbol];
    if (tree->nodes[node].kind != GLSL_ASSIGN || tree->nodes[target].kind != GLSL_NAME ||
        symbol->storage != GLSL_IN)
        return;
    snprintf(name, sizeof name, "%s", symbol->name);
    snprintf(was, sizeof was, "%s %s", glsl_type_text(tree, symbol->type, type), name);
    snprintf(text, sizeof text, "inout %.500s", was);
    symbol->storage = GLSL_INOUT;
    char *whole = glsl_print(tree, tree->root);
    symbol->storage = GLSL_IN;
    take(context, &(Form){.text = text, .name = name, .whole = whole, .was = was});
    free(whole);
}

/* Conditions. */

static bool is_local_vector(const GlslSymbol *symbol)
{
    return symbol->kind == GLSL_VARIABLE && symbol->type == GLSL_VEC3 && !symbol->global &&
           !symbol->built_in && symbol->name[0];
}

void forms_facing(GlslTree *tree, int node, FormTake *take, void *context)
{
    const GlslNode *at = &tree->nodes[node];
    char own[TEXT_SIZE], name[2 * NAME_SIZE], text[2 * TEXT_SIZE];
    if (at->kind != GLSL_BUILT_IN || GLSL_FUNCTIONS[at->symbol].id != GLSL_POW ||
        at->type != GLSL_FLOAT)
        return;
    glsl_expression_text(tree, node, own, sizeof own);
    for (int i = 1; i < tree->symbol_count; i++) {
        for (int k = 1; k < i; k++) {
            const GlslSymbol *a = &tree->symbols[k], *b = &tree->symbols[i];
            if (!is_local_vector(a) || !is_local_vector(b))
                continue;
            snprintf(name, sizeof name, "dot(%.60s, %.60s)", a->name, b->name);
            snprintf(text, sizeof text, "(%s > 0.0 ? %s : 0.0)", name, own);
            take(context, &(Form){.text = text, .name = name});
        }
    }
}
