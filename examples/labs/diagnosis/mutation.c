/* A mutant is made as text: the tree is printed with a mark for one node, and what a rule says
 * replaces the mark. So the parser checks the types, and a rule is one line. In a rule $0 is the
 * node's own text, $1 to $3 are its operands, $4 what its variable begins with, $5 the condition of
 * an `if` right before the statement, $6 and $7 those of the first, $8 and $9 those of the second,
 * # is a number, @ any name of the rule's type, ~ any of a float; of a rule with forms % is the
 * form's text, and @ and # its names. */
#include "labs/diagnosis/mutation.h"

#include "labs/diagnosis/mutation_forms.h"

#include "base/memory.h"
#include "base/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of rules for all expressions of a type. */
enum { ANY_FLOAT = 100, ANY_VEC3, ANY_NAME, ANY_BOTH, ANY_VEC2, LONE_FLOAT };

/* Of rules whose texts code makes: see mutation_forms.h. */
enum {
    EXCHANGE = 200,
    BRACKET,
    UNBRACKET,
    SPREAD,
    TURNS,
    BEGINS,
    OTHER_LIGHT,
    TWIN,
    MOVE,
    ELSE_IF,
    EXPONENT,
    SUMMED,
    RECIPROCALS,
    FACING,
    INOUT,
    DECLARED
};
/* In their order. */
static FormsEach *const EACH[] = {
    forms_exchanges,   forms_brackets, forms_unbrackets, forms_spreads,
    forms_turns,       forms_begins,   forms_lights,     forms_twins,
    forms_moves,       forms_else_ifs, forms_exponents,  forms_summed,
    forms_reciprocals, forms_facing,   forms_inout,      forms_declared};

typedef struct Rule {
    int kind, op; /* `op`: of a built-in function its number, -1: any; of one component: 1 for
                     xyzw, 2 for rgba */
    const char *by, *name, *sentence; /* name: of a right program's mutant; "": there is none */
    const char *mends; /* the mistake's name where this change mends it; "": "$0 for" the new, "!":
                          so, too, but no right program of the chapter has it */
} Rule;

/* What is likelier comes first. */
static const Rule RULES[] = {
#include "labs/diagnosis/mutation_likely.def"
/* The others. */
#include "labs/diagnosis/mutation_rules.def"
};
enum {
    RULE_COUNT = sizeof RULES / sizeof RULES[0],
    LIKELY_COUNT = sizeof((const Rule[]){
#include "labs/diagnosis/mutation_likely.def"
                   }) /
                   sizeof(Rule),
    MAX_NAMES = 48,
    NAME_SIZE = 72,
    OPERANDS = 10
};

typedef struct Maker {
    GlslTree *tree;
    const double *numbers;
    int number_count;
    MutationTake *take;
    void *context;
    bool ended;
    const char *name, *number;    /* that are tried */
    const Form *form;             /* of a rule that has forms */
    char *before, *after;         /* the text around the node */
    char operands[OPERANDS][512]; /* the node's text, those of its children, what its variable
                                     begins with, the condition before it; from 6 on: those of the
                                     children of its first and of its second child */
    int node, variant, rule;
    const Mutation *only; /* NULL: all */
    unsigned *puts;       /* of what was tried at the node, the hashes */
    int put_count, put_room;
} Maker;

static const char MARK[] = "mutated_here";

/* A statement stays one. */
static void set_mark(GlslNode *node, int mark)
{
    const GlslNode was = *node;
    *node = (GlslNode){
        .kind = GLSL_NAME, .symbol = mark, .type = was.type, .next = was.next, .place = was.place};
}

static int add_mark(GlslTree *tree, const char *name)
{
    *(GlslSymbol *)memory_add(&tree->symbols, &tree->symbol_count, &tree->symbol_room,
                              sizeof(GlslSymbol)) = (GlslSymbol){.name = name};
    return tree->symbol_count - 1;
}

/* Of a statement its expression. */
static GlslNode *target_of(GlslTree *tree, int node)
{
    const GlslNode *at = &tree->nodes[node];
    return &tree->nodes[at->kind == GLSL_EXPRESSION ? at->first : node];
}

void mutation_put(GlslTree *tree, int node, const char *put, GlslNode *was)
{
    GlslNode *target = target_of(tree, node);
    *was = *target;
    set_mark(target, add_mark(tree, put[0] ? put : "0")); /* left out: 0; */
}

void mutation_take_back(GlslTree *tree, int node, const GlslNode *was)
{
    *target_of(tree, node) = *was;
    tree->symbol_count--;
}

/* Prints the tree with a mark for the node. */
static bool cut(Maker *maker, int mark)
{
    GlslNode *target = target_of(maker->tree, maker->node);
    const GlslNode was = *target;
    set_mark(target, mark);
    char *text = glsl_print(maker->tree, maker->tree->root);
    *target = was;
    char *at = strstr(text, MARK);
    if (at) {
        maker->before = memory_copy(text, (size_t)(at - text));
        maker->after = memory_text(at + strlen(MARK));
    }
    free(text);
    return at;
}

static bool is_jump(const GlslNode *node)
{
    return node->kind >= GLSL_RETURN && node->kind <= GLSL_DISCARD;
}

/* The condition of an `if` right before a statement; 0: there is none. */
static int condition_before(const GlslTree *tree, int statement)
{
    for (int i = 1; i < tree->node_count; i++) {
        const int child = tree->nodes[i].kind == GLSL_BLOCK ? tree->nodes[i].first : 0;
        for (int k = child; k; k = tree->nodes[k].next)
            if (tree->nodes[k].next == statement && tree->nodes[k].kind == GLSL_IF)
                return tree->nodes[k].first;
    }
    return 0;
}

/* What a variable begins with. */
static int first_value(const GlslTree *tree, int symbol)
{
    int value = 0;
    for (int i = 1; i < tree->node_count && !value; i++)
        if (tree->nodes[i].kind == GLSL_VARIABLE_NODE && tree->nodes[i].symbol == symbol)
            value = tree->nodes[i].first;
    return value;
}

/* Of a node and those after it, at most `count`; "" where there is none. */
static void read_texts(Maker *maker, int node, int first, int count)
{
    for (int i = first; i < first + count; i++) {
        maker->operands[i][0] = '\0';
        if (node)
            glsl_expression_text(maker->tree, node, maker->operands[i], sizeof maker->operands[i]);
        node = maker->tree->nodes[node].next; /* of node 0: 0 */
    }
}

static void read_operands(Maker *maker)
{
    const GlslNode *nodes = maker->tree->nodes, *node = &nodes[maker->node];
    const bool statement = node->kind == GLSL_EXPRESSION;
    read_texts(maker, statement ? node->first : maker->node, 0, 1);
    read_texts(maker, node->first, 1, 3);
    read_texts(maker, nodes[node->first].first, 6, 2);
    read_texts(maker, nodes[nodes[node->first].next].first, 8, 2);
    const GlslNode *variable = node->kind == GLSL_ASSIGN ? &nodes[node->first] : node;
    const bool named = variable->kind == GLSL_NAME;
    read_texts(maker, named ? first_value(maker->tree, variable->symbol) : 0, 4, 1);
    read_texts(maker, statement ? condition_before(maker->tree, maker->node) : 0, 5, 1);
}

/* Whether an operand has to stand in parentheses: any operator binds it. */
static bool is_compound(const char *text)
{
    int depth = 0;
    for (const char *at = text; *at; at++) {
        depth += (*at == '(' || *at == '[') - (*at == ')' || *at == ']');
        if (depth == 0 && (*at == ' ' || *at == '-'))
            return true;
    }
    return false;
}

/* Fills in a rule's operands, name and number. `grouped`: as code, else as words. */
static void fill(const Maker *maker, const char *form, bool grouped, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (const char *at = form; *at && used + 1 < size; at++) {
        const char *put = NULL;
        if (*at == '$' && at[1] >= '0' && at[1] <= '9')
            put = maker->operands[*++at - '0'];
        else if (*at == '@' || *at == '~')
            put = maker->name;
        else if (*at == '#')
            put = maker->number;
        else if (*at == '%')
            put = maker->form->text;
        if (!put) {
            text[used++] = *at;
            text[used] = '\0';
            continue;
        }
        const bool alone = used > 0 && text[used - 1] == '(' && at[1] == ')'; /* normalize($1) */
        const bool group = grouped && *at != '%' && !alone && is_compound(put);
        used += (size_t)snprintf(text + used, size - used, group ? "(%s)" : "%s", put);
    }
}

/* Whether no likelier rule put the same there. */
static bool is_fresh(Maker *maker, const char *by)
{
    const unsigned hash = text_hash(by, strlen(by));
    for (int i = 0; i < maker->put_count; i++)
        if (maker->puts[i] == hash)
            return false;
    *(unsigned *)memory_add(&maker->puts, &maker->put_count, &maker->put_room, sizeof hash) = hash;
    return true;
}

/* "a for b", each of them whole or shortened. */
static void put_exchange(Mutation *mutation)
{
    char was[MUTATION_TEXT], by[MUTATION_TEXT];
    memcpy(was, mutation->was, sizeof was);
    memcpy(by, mutation->by, sizeof by);
    text_shorten(was, MUTATION_TEXT / 2 - 4);
    text_shorten(by, MUTATION_TEXT / 2 - 4);
    snprintf(mutation->mends, sizeof mutation->mends, "%.96s for %.96s", was, by);
}

/* Whether a name is in another operand of the operation around the node, or around its sign. */
static bool stands_beside(const Maker *maker, const char *name)
{
    const GlslNode *nodes = maker->tree->nodes;
    bool found = false;
    int node = maker->node, above = forms_parent(maker->tree, node);
    for (; nodes[above].kind == GLSL_UNARY; above = forms_parent(maker->tree, node))
        node = above;
    for (int i = nodes[above].first; i; i = nodes[i].next) {
        char text[512];
        glsl_expression_text(maker->tree, i, text, sizeof text);
        found |=
            i != node && (text_count_word(text, name) > 0 || strcmp(text, maker->operands[0]) == 0);
    }
    return found;
}

static void make(Maker *maker, int rule)
{
    Mutation mutation = {.node = maker->node,
                         .sentence = RULES[rule].sentence,
                         .rank = rule,
                         .variant = maker->variant,
                         .likely = rule < LIKELY_COUNT && RULES[rule].kind != GLSL_CONSTRUCT,
                         .formula = !strpbrk(RULES[rule].by, "$@") && strchr(RULES[rule].by, '('),
                         .general =
                             !strpbrk(RULES[rule].by, "#@~") && RULES[rule].kind != GLSL_LITERAL};
    const GlslNode *node = &maker->tree->nodes[maker->node];
    const bool jump = is_jump(node), statement = node->kind == GLSL_EXPRESSION;
    char by[2048];
    fill(maker, RULES[rule].by, !statement, by, sizeof by);
    if (strcmp(by, maker->operands[0]) == 0 || (!by[0] && RULES[rule].by[0]) ||
        (!maker->operands[5][0] && strstr(RULES[rule].by, "$5")) || !is_fresh(maker, by) ||
        (maker->tree->stage == GLSL_VERTEX && strstr(RULES[rule].by, "v_Color"))) /* not set yet */
        return;
    fill(maker, RULES[rule].name, false, mutation.name, sizeof mutation.name);
    snprintf(mutation.was, sizeof mutation.was, "%.199s",
             maker->form && maker->form->was ? maker->form->was : maker->operands[0]);
    snprintf(mutation.by, sizeof mutation.by, "%.199s", by);
    mutation.odd = RULES[rule].mends[0] == '!';
    if (RULES[rule].mends[0] && !mutation.odd)
        fill(maker, RULES[rule].mends, false, mutation.mends, sizeof mutation.mends);
    else
        put_exchange(&mutation);
    /* An expression's statement is followed by its semicolon; within one anything is grouped. */
    const bool whole = statement || node->kind == GLSL_ASSIGN || !is_compound(by);
    char *put = memory_format(jump ? "%s;" : whole ? "%s" : "(%s)", by);
    char *text = maker->form && maker->form->whole
                     ? memory_text(maker->form->whole)
                     : memory_format("%s%s%s", maker->before, put, maker->after);
    mutation.anew = RULES[rule].kind == OTHER_LIGHT;
    mutation.moves = maker->form && maker->form->whole;
    mutation.put = put;
    mutation.doubled = strcmp(RULES[rule].by, "@") == 0 && stands_beside(maker, maker->name);
    maker->ended = !maker->take(maker->context, &mutation, text);
    free(text);
    free(put);
}

/* Those of a structure. */
static void add_fields(const GlslTree *tree, const GlslSymbol *symbol, int type, int *count,
                       char names[MAX_NAMES][NAME_SIZE])
{
    const GlslType *of = &tree->types[symbol->type];
    for (int i = of->field; i < of->field + of->fields && *count < MAX_NAMES; i++)
        if (tree->fields[i].type == type)
            snprintf(names[(*count)++], NAME_SIZE, "%s.%s", symbol->name, tree->fields[i].name);
}

/* What may stand for a value of this type: other variables, their elements, fields and colours. A
 * uniform that the text lacks has no line. */
static int names_of(const GlslTree *tree, int type, bool declared, char names[MAX_NAMES][NAME_SIZE])
{
    static const char *const FORMS[] = {"%s", "%s[0]", "%s[1]", "%s[i]", "%s.rgb"};
    int count = 0;
    for (int i = 1; i < tree->symbol_count; i++) {
        const GlslSymbol *symbol = &tree->symbols[i];
        if (symbol->kind != GLSL_VARIABLE || symbol->built_in || !symbol->name[0] ||
            (declared && !symbol->place.line) ||
            (tree->stage == GLSL_VERTEX && symbol->storage == GLSL_VARYING)) /* not set yet */
            continue;
        add_fields(tree, symbol, type, &count, names);
        const bool element = tree->types[symbol->type].element == type;
        const bool color = type == GLSL_VEC3 && symbol->type == GLSL_VEC4;
        const int first = element ? 1 : color ? 4 : 0, last = element ? 3 : first;
        if (symbol->type != type && !element && !color)
            continue;
        for (int k = first; k <= last && count < MAX_NAMES; k++)
            snprintf(names[count++], NAME_SIZE, FORMS[k], symbol->name);
    }
    return count;
}

static void take_form(void *context, const Form *form)
{
    Maker *maker = context;
    maker->variant++;
    if (maker->ended || (maker->only && maker->only->variant != maker->variant))
        return;
    maker->form = form;
    maker->name = form->name;
    maker->number = form->other;
    make(maker, maker->rule);
    maker->form = NULL;
}

static void apply_forms(Maker *maker, int rule)
{
    maker->variant = 0;
    maker->rule = rule;
    EACH[RULES[rule].kind - EXCHANGE](maker->tree, maker->node, take_form, maker);
}

/* With each name and each number that the rule has. */
static void apply(Maker *maker, int rule)
{
    char names[MAX_NAMES][NAME_SIZE] = {""}, number[32] = "";
    const bool scalar = strchr(RULES[rule].by, '~'), named = scalar || strchr(RULES[rule].by, '@'),
               numbered = strchr(RULES[rule].by, '#');
    const int type = scalar                           ? GLSL_FLOAT
                     : RULES[rule].kind == GLSL_INDEX ? GLSL_INT
                     : RULES[rule].kind == LONE_FLOAT ? GLSL_VEC3
                                                      : maker->tree->nodes[maker->node].type;
    const int name_count =
        named ? names_of(maker->tree, type, strcmp(RULES[rule].by, "@") != 0, names) : 1;
    for (int i = 0; i < name_count; i++) {
        for (int k = 0; k < (numbered ? maker->number_count : 1) && !maker->ended; k++) {
            if (numbered) {
                snprintf(number, sizeof number, "%.9g", maker->numbers[k]);
                strcat(number, strpbrk(number, ".e") ? "" : ".0");
            }
            maker->variant = i * MUTATION_NUMBERS + k;
            if ((named && strcmp(names[i], maker->operands[0]) == 0) ||
                (maker->only && maker->only->variant != maker->variant))
                continue;
            maker->name = names[i];
            maker->number = number;
            make(maker, rule);
        }
    }
}

/* Products of numbers and vectors are the same in either order. */
static bool has_matrix(const GlslTree *tree, const GlslNode *node)
{
    return glsl_is_matrix(tree->nodes[node->first].type) ||
           glsl_is_matrix(tree->nodes[tree->nodes[node->first].next].type);
}

static bool matches(const GlslTree *tree, const GlslNode *node, const Rule *rule)
{
    const bool literal = node->kind == GLSL_LITERAL || node->kind == GLSL_ASSIGN;
    switch (rule->kind) {
    case ANY_FLOAT:
        return node->type == GLSL_FLOAT && !literal;
    case LONE_FLOAT: { /* of a sum of vectors */
        const GlslNode *above = &tree->nodes[forms_parent(tree, (int)(node - tree->nodes))];
        const bool sum = (above->kind == GLSL_BINARY || above->kind == GLSL_ASSIGN) &&
                         (above->op == GLSL_ADD || above->op == GLSL_SUBTRACT);
        return node->type == GLSL_FLOAT && !literal && above->type == GLSL_VEC3 && sum;
    }
    case ANY_VEC3:
        return node->type == GLSL_VEC3 && !literal;
    case ANY_VEC2:
        return node->type == GLSL_VEC2 && !literal;
    case ANY_BOTH:
        return (node->type == GLSL_VEC3 || node->type == GLSL_FLOAT) && !literal;
    case ANY_NAME:
        return rule->op == GLSL_BOOL ? node->type == GLSL_BOOL && !literal
               : rule->op            ? node->type == rule->op && forms_is_name(node)
                                     : node->kind == GLSL_NAME;
    default:
        break;
    }
    if (node->kind != rule->kind || (strcmp(rule->by, "$2 * $1") == 0 && !has_matrix(tree, node)))
        return false;
    return rule->kind == GLSL_SWIZZLE && rule->op
               ? glsl_swizzle_count(node->op) == 1 && node->op >> 14 == rule->op - 1
           : rule->kind == GLSL_RETURN && !rule->by[0]
               ? !node->first || tree->nodes[node->first].kind == GLSL_NOTHING
           : rule->kind == GLSL_BUILT_IN
               ? rule->op < 0 || GLSL_FUNCTIONS[node->symbol].id == rule->op
           : rule->kind == GLSL_LITERAL || rule->kind == GLSL_CONSTRUCT ? node->type == rule->op
           : rule->kind == GLSL_BINARY || rule->kind == GLSL_UNARY || rule->kind == GLSL_ASSIGN
               ? node->op == rule->op
               : true;
}

static void mutate(Maker *maker, int node, int mark)
{
    maker->node = node;
    maker->before = maker->after = NULL;
    if (cut(maker, mark)) {
        read_operands(maker);
        for (int i = 0; i < RULE_COUNT && !maker->ended; i++)
            if ((!maker->only || maker->only->rank == i) &&
                (RULES[i].kind >= EXCHANGE ||
                 matches(maker->tree, &maker->tree->nodes[node], &RULES[i])))
                (RULES[i].kind >= EXCHANGE ? apply_forms : apply)(maker, i);
    }
    maker->put_count = 0;
    free(maker->before);
    free(maker->after);
}

/* All nodes below, but what is assigned to. */
static void walk(Maker *maker, int node, int mark)
{
    const GlslNode *at = &maker->tree->nodes[node];
    const bool expression = at->kind >= GLSL_LITERAL && at->kind <= GLSL_CONSTRUCT;
    if (maker->ended)
        return;
    if ((expression && at->type != GLSL_VOID) || at->kind == GLSL_EXPRESSION || is_jump(at))
        mutate(maker, node, mark);
    for (int i = at->first; i; i = maker->tree->nodes[i].next)
        if (at->kind != GLSL_ASSIGN || i != at->first)
            walk(maker, i, mark);
}

void mutations_each(GlslTree *tree, const Mutation *only, const double *numbers, int count,
                    MutationTake *take, void *context)
{
    Maker maker = {.tree = tree,
                   .only = only,
                   .numbers = numbers,
                   .number_count = count,
                   .take = take,
                   .context = context};
    const int mark = add_mark(tree, MARK);
    if (only)
        mutate(&maker, only->node, mark);
    else
        walk(&maker, tree->root, mark);
    free(maker.puts);
    tree->symbol_count--;
}

int mutation_number_rank(void)
{
    int rank = 0;
    while (RULES[rank].kind != GLSL_LITERAL || RULES[rank].op != GLSL_FLOAT)
        rank++;
    return rank;
}
