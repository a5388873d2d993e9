/* Types of operators, and what to write where they do not fit. */
#include "glsl/glsl_parser.h"

#include <stdio.h>
#include <string.h>

static int type_at(const Parser *parser, int node)
{
    return node_at(parser, node)->type;
}

static bool is_number(int type)
{
    return glsl_scalar(type) == GLSL_FLOAT || glsl_scalar(type) == GLSL_INT;
}

/* The child's type is unknown: something was said about it. */
static bool any_error(const Parser *parser, int node)
{
    for (int i = node_at(parser, node)->first; i; i = node_at(parser, i)->next)
        if (type_at(parser, i) == GLSL_ERROR)
            return true;
    return parser->stopped;
}

static void settle(Parser *parser, int node, int type)
{
    GlslNode *result = node_at(parser, node);
    result->type = type;
    result->constant = result->first != 0;
    for (int i = result->first; i; i = node_at(parser, i)->next) {
        if (node_at(parser, i)->precision > result->precision)
            result->precision = node_at(parser, i)->precision;
        result->constant &= node_at(parser, i)->constant;
    }
    if (result->constant)
        fold(parser->tree, node);
}

Phrase conversion(const Parser *parser, int node, int type)
{
    Phrase phrase = {""};
    const int from = type_at(parser, node);
    const Phrase own = text_phrase(parser, node);
    const char *text = own.text;
    const GlslNode *value = node_at(parser, node);
    if (from == GLSL_INT && glsl_scalar(type) == GLSL_FLOAT) {
        if (value->kind == GLSL_LITERAL)
            snprintf(phrase.text, sizeof phrase.text, ": write %.0f.0",
                     parser->tree->values[value->value]);
        else
            snprintf(phrase.text, sizeof phrase.text, ": write float(%.40s)", text);
    } else if (from == GLSL_VEC4 && (type == GLSL_VEC3 || type == GLSL_VEC2)) {
        snprintf(phrase.text, sizeof phrase.text, ": write .%s of it",
                 type == GLSL_VEC3 ? "xyz" : "xy");
    } else if (from == GLSL_VEC3 && type == GLSL_VEC4) {
        snprintf(phrase.text, sizeof phrase.text,
                 ": write vec4(%.40s, 1.0), or 0.0 for a direction", text);
    } else if (glsl_is_vector(from) && glsl_size(from) > 1 && glsl_is_vector(type) &&
               glsl_size(type) == 1) {
        snprintf(phrase.text, sizeof phrase.text, ": write one component (.x), or dot or length");
    } else if (glsl_scalar(from) == glsl_scalar(type) && glsl_size(from) == 1 &&
               glsl_is_vector(type)) {
        char name[64];
        snprintf(phrase.text, sizeof phrase.text, ": write %s(%.30s)",
                 glsl_type_text(parser->tree, type, name), text);
    } else if (glsl_size(from) == 1 && glsl_is_vector(type) && glsl_size(type) == 1) {
        char name[64];
        snprintf(phrase.text, sizeof phrase.text, ": write %s(%.30s)",
                 glsl_type_text(parser->tree, type, name), text);
    }
    return phrase;
}

/* "x * 2: x is a float, 2 an int: write 2.0". */
static void mismatch(Parser *parser, int node)
{
    const int left = node_at(parser, node)->first, right = node_at(parser, left)->next;
    const int a = type_at(parser, left), b = type_at(parser, right);
    Phrase advice = conversion(parser, right, a);
    if (a == GLSL_INT && glsl_scalar(b) == GLSL_FLOAT)
        advice = conversion(parser, left, GLSL_FLOAT);
    else if (b == GLSL_INT && glsl_scalar(a) == GLSL_FLOAT)
        advice = conversion(parser, right, GLSL_FLOAT);
    else if ((a == GLSL_MAT4 && b == GLSL_VEC3) || (b == GLSL_MAT4 && a == GLSL_VEC3))
        advice = conversion(parser, a == GLSL_VEC3 ? left : right, GLSL_VEC4);
    else if (glsl_is_matrix(a) || glsl_is_matrix(b))
        snprintf(advice.text, sizeof advice.text, ": their sizes differ");
    else if (glsl_size(a) > 1 && glsl_size(b) > 1 && glsl_scalar(a) == glsl_scalar(b))
        snprintf(advice.text, sizeof advice.text,
                 ": use .xyz of the longer one, or vec4(..., 1.0)");
    complain(parser, node_at(parser, node)->place, "%s: %s is %s, %s %s%s",
             text_phrase(parser, node).text, text_phrase(parser, left).text,
             type_phrase(parser, a).text, text_phrase(parser, right).text,
             type_phrase(parser, b).text, advice.text);
}

/* What + - * / make of two types; GLSL_ERROR: nothing. */
static int arithmetic(int op, int a, int b)
{
    if (!is_number(a) || !is_number(b) || glsl_scalar(a) != glsl_scalar(b))
        return GLSL_ERROR;
    if (a == b)
        return a;
    if (glsl_size(a) == 1 || glsl_size(b) == 1)
        return glsl_size(a) == 1 ? b : a;
    if (op == GLSL_MULTIPLY && glsl_size(a) == glsl_size(b))
        return glsl_is_matrix(a) ? b : a;
    return GLSL_ERROR;
}

static bool comparable(const Parser *parser, int type)
{
    const GlslType *of = &parser->tree->types[type];
    return type != GLSL_VOID && !of->array && !of->sampler;
}

void check_binary(Parser *parser, int node)
{
    const int op = node_at(parser, node)->op;
    const int left = node_at(parser, node)->first, right = node_at(parser, left)->next;
    const int a = type_at(parser, left), b = type_at(parser, right);
    int type = GLSL_ERROR;
    if (any_error(parser, node))
        return;
    if (op == GLSL_COMMA)
        type = b;
    else if (op <= GLSL_DIVIDE)
        type = arithmetic(op, a, b);
    else if (op <= GLSL_GREATER_EQUAL)
        type = a == b && (a == GLSL_INT || a == GLSL_FLOAT) ? GLSL_BOOL : GLSL_ERROR;
    else if (op <= GLSL_NOT_EQUAL)
        type = a == b && comparable(parser, a) ? GLSL_BOOL : GLSL_ERROR;
    else
        type = a == GLSL_BOOL && b == GLSL_BOOL ? GLSL_BOOL : GLSL_ERROR;
    if (type != GLSL_ERROR)
        settle(parser, node, type);
    else if (a == b)
        complain(parser, node_at(parser, node)->place, "%s: this operator does not take %s%s",
                 text_phrase(parser, node).text, type_phrase(parser, a).text,
                 op >= GLSL_AND && op <= GLSL_XOR ? ": compare it first, as in x > 0.0" : "");
    else
        mismatch(parser, node);
    if (op == GLSL_COMMA)
        node_at(parser, node)->constant = false;
}

void check_unary(Parser *parser, int node)
{
    const int op = node_at(parser, node)->op, operand = node_at(parser, node)->first;
    const int type = type_at(parser, operand);
    if (any_error(parser, node))
        return;
    const bool fits = op == GLSL_NOT ? type == GLSL_BOOL : is_number(type);
    if (!fits)
        complain(parser, node_at(parser, node)->place, "%s: this operator does not take %s",
                 text_phrase(parser, node).text, type_phrase(parser, type).text);
    else if (op >= GLSL_PRE_INCREMENT && !check_writable(parser, operand))
        return;
    else
        settle(parser, node, type);
    if (op >= GLSL_PRE_INCREMENT)
        node_at(parser, node)->constant = false;
}

static bool read_only(Parser *parser, int node, const GlslSymbol *variable)
{
    const bool varying = variable->storage == GLSL_VARYING && parser->tree->stage == GLSL_FRAGMENT;
    const bool input = variable->storage == GLSL_IN && variable->built_in;
    if (!varying && !input && variable->storage != GLSL_CONST &&
        variable->storage != GLSL_ATTRIBUTE && variable->storage != GLSL_UNIFORM)
        return false;
    complain(parser, node_at(parser, node)->place,
             variable->storage == GLSL_CONST
                 ? "%.60s is a constant: remove const, or copy the value to another variable"
                 : "%.60s is read-only here: copy the value to a variable of your own",
             variable->name);
    return true;
}

/* What is written to: a variable, or a part of it; which. */
bool check_writable(Parser *parser, int node)
{
    GlslTree *tree = parser->tree;
    const GlslPlace place = node_at(parser, node)->place;
    const GlslNode *at = node_at(parser, node);
    while (at->kind == GLSL_INDEX || at->kind == GLSL_FIELD || at->kind == GLSL_SWIZZLE) {
        for (int i = 0; at->kind == GLSL_SWIZZLE && i < glsl_swizzle_count(at->op); i++)
            for (int k = 0; k < i; k++)
                if (glsl_swizzle(at->op, i) == glsl_swizzle(at->op, k)) {
                    complain(parser, place, "%s: each component can be set only once",
                             text_phrase(parser, node).text);
                    return false;
                }
        at = node_at(parser, at->first);
    }
    if (at->type == GLSL_ERROR)
        return false;
    if (at->kind != GLSL_NAME) {
        complain(parser, place, "%s is a value, not a variable: nothing can be written to it",
                 text_phrase(parser, node).text);
        return false;
    }
    if (read_only(parser, node, &tree->symbols[at->symbol]))
        return false;
    if (tree->types[type_at(parser, node)].sampler) {
        complain(parser, place, "nothing can be written to a sampler");
        return false;
    }
    tree->symbols[at->symbol].written = true;
    return true;
}

/* A value for a variable of another type. */
static void cannot_assign(Parser *parser, const char *name, int type, int value, GlslPlace place)
{
    complain(parser, place, "%.60s is %s, %s %s%s", name, type_phrase(parser, type).text,
             text_phrase(parser, value).text, type_phrase(parser, type_at(parser, value)).text,
             conversion(parser, value, type).text);
}

void check_assign(Parser *parser, int node)
{
    const int op = node_at(parser, node)->op;
    const int left = node_at(parser, node)->first, right = node_at(parser, left)->next;
    const int a = type_at(parser, left), b = type_at(parser, right);
    const GlslPlace place = node_at(parser, node)->place;
    if (any_error(parser, node) || !check_writable(parser, left))
        return;
    if (parser->tree->types[a].array)
        complain(parser, place, "arrays cannot be assigned: copy each element");
    else if (op == GLSL_SET && a != b)
        cannot_assign(parser, text_phrase(parser, left).text, a, right, place);
    else if (op != GLSL_SET && arithmetic(op, a, b) == GLSL_ERROR)
        mismatch(parser, node);
    else if (op != GLSL_SET && arithmetic(op, a, b) != a)
        complain(parser, place, "%s: the result is %s, %s %s", text_phrase(parser, node).text,
                 type_phrase(parser, arithmetic(op, a, b)).text, text_phrase(parser, left).text,
                 type_phrase(parser, a).text);
    else
        settle(parser, node, a);
    node_at(parser, node)->constant = false;
}

bool check_initial(Parser *parser, int symbol, int value, GlslPlace place)
{
    GlslSymbol *variable = &parser->tree->symbols[symbol];
    const GlslNode *initial = node_at(parser, value);
    const bool constant = variable->storage == GLSL_CONST;
    if (initial->type == GLSL_ERROR || variable->type == GLSL_ERROR || parser->stopped)
        return false;
    if (variable->storage != GLSL_LOCAL && !constant)
        complain(parser, place, "%.60s cannot have a first value: the program sets it",
                 variable->name);
    else if (parser->tree->types[variable->type].array)
        complain(parser, place, "an array has no first value in GLSL ES 1.00: set each element");
    else if (initial->type != variable->type)
        cannot_assign(parser, variable->name, variable->type, value, place);
    else if ((constant || variable->global) && !initial->constant)
        complain(parser, place,
                 constant ? "%.60s is const: its value must be a constant expression"
                          : "%.60s is outside all functions: its first value must be constant; "
                            "set it in main instead",
                 variable->name);
    else if (constant)
        variable->value = initial->value;
    else
        return true;
    return constant;
}

void check_conditional(Parser *parser, int node)
{
    const int condition = node_at(parser, node)->first, then = node_at(parser, condition)->next;
    const int otherwise = node_at(parser, then)->next;
    const int a = type_at(parser, then), b = type_at(parser, otherwise);
    if (any_error(parser, node))
        return;
    if (type_at(parser, condition) != GLSL_BOOL)
        complain(parser, node_at(parser, node)->place, "before ? must be a bool; %s is %s",
                 text_phrase(parser, condition).text,
                 type_phrase(parser, type_at(parser, condition)).text);
    else if (a != b)
        cannot_assign(parser, text_phrase(parser, then).text, a, otherwise,
                      node_at(parser, node)->place);
    else if (parser->tree->types[a].array || parser->tree->types[a].sampler)
        complain(parser, node_at(parser, node)->place, "? does not take %s",
                 type_phrase(parser, a).text);
    else
        settle(parser, node, a);
}

void check_index(Parser *parser, int node)
{
    const int base = node_at(parser, node)->first, index = node_at(parser, base)->next;
    const int type = type_at(parser, base);
    const GlslType *of = &parser->tree->types[type];
    const GlslPlace place = node_at(parser, node)->place;
    if (any_error(parser, node))
        return;
    const int count = of->element ? of->length : glsl_size(type);
    const GlslNode *at = node_at(parser, index);
    if (count < 2 && !of->element)
        complain(parser, place, "%s is %s: only arrays, vectors and matrices have elements",
                 text_phrase(parser, base).text, type_phrase(parser, type).text);
    else if (at->type != GLSL_INT)
        complain(parser, place, "the index %s must be an int, not %s",
                 text_phrase(parser, index).text, type_phrase(parser, at->type).text);
    else if (at->constant &&
             (parser->tree->values[at->value] < 0 || parser->tree->values[at->value] >= count))
        complain(parser, place, "%s: the elements are 0 to %d", text_phrase(parser, node).text,
                 count - 1);
    else
        settle(parser, node,
               of->element            ? of->element
               : glsl_is_matrix(type) ? GLSL_FLOAT + count - 1
                                      : glsl_scalar(type));
}

/* A swizzle's `op`; 0: these are no components of the type. */
static int components(const char *name, int length, int type)
{
    static const char *const SETS[] = {"xyzw", "rgba", "stpq"};
    if (!glsl_is_vector(type) || glsl_size(type) < 2 || length > 4)
        return 0;
    for (int set = 0; set < 3; set++) {
        int op = length | set << 14, i = 0;
        for (; i < length; i++) {
            const char *found = strchr(SETS[set], name[i]);
            if (!found || found - SETS[set] >= glsl_size(type))
                break;
            op |= (int)(found - SETS[set]) << (3 + 3 * i);
        }
        if (i == length)
            return op;
    }
    return 0;
}

static int find_field(const GlslTree *tree, int type, const char *name)
{
    const GlslType *of = &tree->types[type];
    for (int i = 0; i < of->fields; i++)
        if (strcmp(tree->fields[of->field + i].name, name) == 0)
            return i;
    return -1;
}

int select_field(Parser *parser, int base, const Token *token)
{
    GlslTree *tree = parser->tree;
    const int type = type_at(parser, base);
    const GlslPlace place = node_at(parser, base)->place;
    const char *name = keep_name(parser, token->name);
    const int field = find_field(tree, type, name), op = components(name, token->length, type);
    const int node = node_new(parser, op ? GLSL_SWIZZLE : GLSL_FIELD, GLSL_ERROR, place);
    set_children(parser, node, (List){base, base});
    if (type == GLSL_ERROR)
        return node;
    if (op) {
        node_at(parser, node)->op = (unsigned short)op;
        settle(parser, node, glsl_scalar(type) + glsl_swizzle_count(op) - 1);
    } else if (field >= 0 && !tree->types[type].element) {
        const GlslField of = tree->fields[tree->types[type].field + field];
        node_at(parser, node)->symbol = field;
        settle(parser, node, of.type);
        node_at(parser, node)->precision = of.precision;
    } else {
        complain(parser, token->place, "%s is %s, which has no %s .%.60s%s",
                 text_phrase(parser, base).text, type_phrase(parser, type).text,
                 glsl_is_vector(type) ? "component" : "field", name,
                 glsl_size(type) == 1 ? ": only vectors have components" : "");
    }
    return node;
}
