/* Sums and products are taken as chains: operands, and the operators between them, without the
 * parentheses that the tree's shape needs. */
#include "labs/diagnosis/mutation_forms.h"

#include <stdio.h>
#include <string.h>

enum { MOST = 12, NAME_SIZE = 72, TEXT_SIZE = 512 };

bool forms_is_name(const GlslNode *node)
{
    return node->kind == GLSL_NAME || node->kind == GLSL_INDEX || node->kind == GLSL_SWIZZLE;
}

int forms_parent(const GlslTree *tree, int node)
{
    for (int i = 1; i < tree->node_count; i++)
        for (int k = tree->nodes[i].first; k; k = tree->nodes[k].next)
            if (k == node)
                return i;
    return 0;
}

/* Exchanges. */

/* Names, elements and components below a node. */
typedef struct Leaves {
    int nodes[MOST], count;
    char texts[MOST][NAME_SIZE];
} Leaves;

static void take_leaves(const GlslTree *tree, int node, Leaves *leaves)
{
    if (forms_is_name(&tree->nodes[node]) && leaves->count < MOST) {
        leaves->nodes[leaves->count] = node;
        glsl_expression_text(tree, node, leaves->texts[leaves->count++], NAME_SIZE);
        return;
    }
    for (int i = tree->nodes[node].first; i; i = tree->nodes[i].next)
        take_leaves(tree, i, leaves);
}

/* Whether the text stands once only. */
static bool is_sole(const Leaves *leaves, int leaf)
{
    int count = 0;
    for (int i = 0; i < leaves->count; i++)
        count += strcmp(leaves->texts[i], leaves->texts[leaf]) == 0;
    return count == 1;
}

static void exchange(GlslTree *tree, int a, int b)
{
    const GlslNode was = tree->nodes[a];
    tree->nodes[a] = tree->nodes[b];
    tree->nodes[b] = was;
    tree->nodes[b].next = tree->nodes[a].next;
    tree->nodes[a].next = was.next;
}

/* Not both operands of a sum or product. What stands more than once is rather one taken for
 * another.
 */
void forms_exchanges(GlslTree *tree, int node, FormTake *take, void *context)
{
    const GlslNode *at = &tree->nodes[node];
    const bool commutes = at->kind == GLSL_BINARY && at->op <= GLSL_MULTIPLY;
    const int second = tree->nodes[at->first].next;
    Leaves all = {.count = 0};
    int operands[MOST]; /* that the leaves are in */
    if (at->kind != GLSL_BINARY && (at->kind < GLSL_CALL || at->kind > GLSL_CONSTRUCT))
        return;
    for (int i = at->first, from = 0; i; i = tree->nodes[i].next) {
        take_leaves(tree, i, &all);
        while (from < all.count)
            operands[from++] = i;
    }
    for (int i = 0; i < all.count; i++) {
        for (int k = i + 1; k < all.count; k++) {
            const int a = all.nodes[i], b = all.nodes[k];
            char name[2 * NAME_SIZE + 8], text[TEXT_SIZE];
            if (operands[i] == operands[k] || tree->nodes[a].type != tree->nodes[b].type ||
                !is_sole(&all, i) || !is_sole(&all, k) ||
                (commutes && a == at->first && b == second))
                continue;
            exchange(tree, a, b);
            glsl_expression_text(tree, node, text, sizeof text);
            exchange(tree, a, b);
            snprintf(name, sizeof name, "%s and %s", all.texts[i], all.texts[k]);
            take(context, &(Form){.text = text, .name = name});
        }
    }
}

/* Chains. */

typedef struct Chain {
    int nodes[MOST], ops[MOST]; /* ops: before it */
    bool grouped[MOST];
    int count;
} Chain;

enum { SUM = 1, PRODUCT, ATOM };

static int strength_of(int op)
{
    return op == GLSL_ADD || op == GLSL_SUBTRACT      ? SUM
           : op == GLSL_MULTIPLY || op == GLSL_DIVIDE ? PRODUCT
                                                      : ATOM;
}

static int strength(const GlslNode *node)
{
    return node->kind == GLSL_BINARY ? strength_of(node->op) : ATOM;
}

static void take_chain(const GlslTree *tree, int node, int weakest, int op, Chain *chain)
{
    const GlslNode *at = &tree->nodes[node];
    const int own = strength(at);
    if (own == ATOM || own < weakest) {
        if (chain->count < MOST) {
            chain->nodes[chain->count] = node;
            chain->ops[chain->count] = op;
            chain->grouped[chain->count++] = own < weakest;
        }
        return;
    }
    take_chain(tree, at->first, own, op, chain);
    take_chain(tree, tree->nodes[at->first].next, own + 1, at->op, chain);
}

/* Nothing above it is in the same chain, of this strength or of any. */
static bool is_top(const GlslTree *tree, int node, int weakest)
{
    const GlslNode *at = &tree->nodes[node], *above = &tree->nodes[forms_parent(tree, node)];
    const int own = strength(at), other = strength(above);
    return own != ATOM && own >= weakest &&
           (other == ATOM || other < weakest ||
            (above->first == node ? own < other : own <= other));
}

/* Of a node at the top of one. */
static bool open_chain(const GlslTree *tree, int node, int weakest, Chain *chain)
{
    const bool top = is_top(tree, node, weakest);
    chain->count = 0;
    if (top)
        take_chain(tree, node, weakest, 0, chain);
    return top;
}

static void add(char text[TEXT_SIZE], const char *form, const char *put)
{
    const size_t used = strlen(text);
    snprintf(text + used, TEXT_SIZE - used, form, put);
}

static void add_op(char text[TEXT_SIZE], int op)
{
    static const char *const OPS[] = {[GLSL_ADD] = " + ",
                                      [GLSL_SUBTRACT] = " - ",
                                      [GLSL_MULTIPLY] = " * ",
                                      [GLSL_DIVIDE] = " / "};
    add(text, "%s", OPS[op]);
}

static void add_item(const GlslTree *tree, const Chain *chain, int i, bool grouped,
                     char text[TEXT_SIZE])
{
    char item[TEXT_SIZE];
    glsl_expression_text(tree, chain->nodes[i], item, sizeof item);
    add(text, grouped ? "(%.500s)" : "%.500s", item);
}

/* Items from `at[0]` to `at[1]`, with parentheses around those from `at[2]` to `at[3]`, or without
 * those of `open`. */
static void put_chain(const GlslTree *tree, const Chain *chain, const int at[4], int open,
                      char text[TEXT_SIZE])
{
    text[0] = '\0';
    for (int i = at[0]; i <= at[1]; i++) {
        if (i > at[0])
            add_op(text, chain->ops[i]);
        add(text, "%s", i == at[2] ? "(" : "");
        add_item(tree, chain, i, chain->grouped[i] && i != open, text);
        add(text, "%s", i == at[3] ? ")" : "");
    }
}

/* Whether parentheses around items that are joined by operators of this strength and weaker ones
 * say something. */
static bool matters(const Chain *chain, int from, int to, int lowest)
{
    const int before = from > 0 ? chain->ops[from] : 0;
    const int after = to + 1 < chain->count ? chain->ops[to + 1] : 0;
    return (before && (strength_of(before) > lowest || before == GLSL_DIVIDE ||
                       (before == GLSL_SUBTRACT && lowest == SUM))) ||
           (after && strength_of(after) > lowest);
}

void forms_brackets(GlslTree *tree, int node, FormTake *take, void *context)
{
    Chain chain;
    if (!open_chain(tree, node, SUM, &chain))
        return;
    for (int from = 0; from < chain.count; from++) {
        int lowest = ATOM;
        for (int to = from + 1; to < chain.count; to++) {
            const int own = strength_of(chain.ops[to]);
            char text[TEXT_SIZE], inner[TEXT_SIZE];
            lowest = own < lowest ? own : lowest;
            if (!matters(&chain, from, to, lowest))
                continue;
            put_chain(tree, &chain, (int[]){0, chain.count - 1, from, to}, -1, text);
            put_chain(tree, &chain, (int[]){from, to, -1, -1}, -1, inner);
            take(context, &(Form){.text = text, .name = inner});
        }
    }
}

void forms_unbrackets(GlslTree *tree, int node, FormTake *take, void *context)
{
    Chain chain;
    if (!open_chain(tree, node, SUM, &chain))
        return;
    for (int i = 0; i < chain.count; i++) {
        char text[TEXT_SIZE], inner[TEXT_SIZE] = "";
        if (!chain.grouped[i] || !matters(&chain, i, i, strength(&tree->nodes[chain.nodes[i]])))
            continue;
        put_chain(tree, &chain, (int[]){0, chain.count - 1, -1, -1}, i, text);
        add_item(tree, &chain, i, false, inner);
        take(context, &(Form){.text = text, .name = inner});
    }
}

/* Which factor of a product moves, by its number, or all but the sum: the product's count. */
typedef struct Spread {
    const Chain *chain, *sum;
    int factor, at, term; /* at: where the sum is; term: that has them not */
} Spread;

static bool is_moved(const Spread *spread, int i)
{
    return i != spread->at && spread->chain->ops[i] != GLSL_DIVIDE &&
           (spread->factor == i || spread->factor == spread->chain->count);
}

static void put_moved_factors(const GlslTree *tree, const Spread *spread, char text[TEXT_SIZE])
{
    bool any = false;
    for (int i = 0; i < spread->chain->count; i++) {
        if (!is_moved(spread, i))
            continue;
        if (any)
            add_op(text, GLSL_MULTIPLY);
        add_item(tree, spread->chain, i, spread->chain->grouped[i], text);
        any = true;
    }
}

/* The product without them, and the sum in it with them at all terms but one. */
static void put_spread(const GlslTree *tree, const Spread *spread, char text[TEXT_SIZE])
{
    const Chain *chain = spread->chain, *sum = spread->sum;
    text[0] = '\0';
    for (int i = 0; i < chain->count; i++)
        if (i != spread->at && !is_moved(spread, i) && chain->ops[i] != GLSL_DIVIDE) {
            add_item(tree, chain, i, chain->grouped[i], text);
            add_op(text, GLSL_MULTIPLY);
        }
    add(text, "%s", "(");
    for (int i = 0; i < sum->count; i++) {
        if (i > 0)
            add_op(text, sum->ops[i]);
        if (i != spread->term) {
            put_moved_factors(tree, spread, text);
            add_op(text, GLSL_MULTIPLY);
        }
        add_item(tree, sum, i, sum->grouped[i], text);
    }
    add(text, "%s", ")");
    for (int i = 0; i < chain->count; i++)
        if (chain->ops[i] == GLSL_DIVIDE) {
            add_op(text, GLSL_DIVIDE);
            add_item(tree, chain, i, chain->grouped[i], text);
        }
}

/* The terms of a sum, whose products stay whole. */
static void take_terms(const GlslTree *tree, int node, int op, Chain *sum)
{
    const GlslNode *at = &tree->nodes[node];
    const bool more = strength(at) == SUM;
    if (more)
        take_terms(tree, at->first, op, sum);
    const int term = more ? tree->nodes[at->first].next : node;
    if (sum->count < MOST) {
        sum->nodes[sum->count] = term;
        sum->ops[sum->count] = more ? at->op : op;
        sum->grouped[sum->count++] = strength(&tree->nodes[term]) == SUM;
    }
}

void forms_spreads(GlslTree *tree, int node, FormTake *take, void *context)
{
    Chain chain;
    if (!open_chain(tree, node, PRODUCT, &chain))
        return;
    for (int s = 0; s < chain.count; s++) {
        Chain sum = {.count = 0};
        if (!chain.grouped[s] || chain.ops[s] == GLSL_DIVIDE)
            continue;
        take_terms(tree, chain.nodes[s], 0, &sum);
        for (int i = 0; i <= chain.count; i++) {
            char text[TEXT_SIZE], name[TEXT_SIZE] = "", term[TEXT_SIZE];
            if (i < chain.count ? i == s || chain.ops[i] == GLSL_DIVIDE : i < 3)
                continue;
            Spread spread = {&chain, &sum, i, s, 0};
            put_moved_factors(tree, &spread, name);
            /* All factors but for the last of two terms: without parentheses. */
            const int count = i == chain.count && s + 1 == i && sum.count == 2 ? 1 : sum.count;
            for (int t = 0; t < count; t++) {
                spread.term = t;
                put_spread(tree, &spread, text);
                glsl_expression_text(tree, sum.nodes[t], term, sizeof term);
                take(context, &(Form){.text = text, .name = name, .other = term});
            }
        }
    }
}

void forms_reciprocals(GlslTree *tree, int node, FormTake *take, void *context)
{
    Chain sum = {.count = 0};
    char text[TEXT_SIZE] = "", divided[TEXT_SIZE] = "", divisors[TEXT_SIZE] = "";
    if (!is_top(tree, node, SUM) || strength(&tree->nodes[node]) != SUM)
        return;
    take_terms(tree, node, 0, &sum);
    for (int i = 0; i < sum.count; i++) {
        const GlslNode *term = &tree->nodes[sum.nodes[i]];
        char first[TEXT_SIZE];
        glsl_expression_text(tree, term->first, first, sizeof first);
        if (term->kind != GLSL_BINARY || term->op != GLSL_DIVIDE || sum.ops[i] == GLSL_SUBTRACT ||
            (i > 0 && strcmp(first, divided) != 0))
            return;
        strcpy(divided, first);
        glsl_expression_text(tree, tree->nodes[term->first].next, first, sizeof first);
        add(divisors, i > 0 ? " + %s" : "%s", first);
    }
    add(text, "%s", divided);
    add(text, " / (%s)", divisors);
    take(context, &(Form){.text = text, .name = divisors});
}
