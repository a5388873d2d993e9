/* Functions and the whole text. */
#include "glsl/glsl_parser.h"

#include <string.h>

/* As a new symbol, not yet in scope, and its node. 0: it is (void). */
static int parse_parameter(Parser *parser, bool first)
{
    GlslTree *tree = parser->tree;
    const GlslPlace place = peek(parser, 0)->place;
    const bool constant = take_word(parser, WORD_CONST);
    int storage = GLSL_IN;
    for (int word = WORD_INOUT; word >= WORD_IN; word--)
        if (take_word(parser, word))
            storage = word - WORD_IN + GLSL_IN;
    if (constant && storage != GLSL_IN)
        complain(parser, place, "a const parameter can only be `in`");
    if (at_word(parser, WORD_STRUCT))
        syntax_error(parser, "a structure cannot be defined here: define it before the function");
    Specifier specifier = {0};
    parse_type(parser, &specifier);
    const Token *name = peek(parser, 0);
    if (specifier.type == GLSL_VOID && name->kind == ')' && first && !constant)
        return 0;
    const bool named = name->kind == TOKEN_NAME && name->name >= parser->words;
    if (named)
        take(parser);
    const int type = parse_array_type(parser, specifier.type);
    if (specifier.type == GLSL_VOID)
        complain(parser, place, "a parameter cannot be void");
    if (storage != GLSL_IN && tree->types[type].sampler)
        complain(parser, place, "a sampler can only be passed `in`");
    const int symbol = symbol_new(parser, named ? name->name : 0, name->place, GLSL_VARIABLE);
    GlslSymbol *parameter = &tree->symbols[symbol];
    parameter->type = type;
    parameter->storage = (unsigned char)(constant ? GLSL_CONST : storage);
    parameter->precision = (unsigned char)specifier.precision;
    parameter->said = (unsigned char)specifier.said;
    const int node = node_new(parser, GLSL_VARIABLE_NODE, type, place);
    node_at(parser, node)->symbol = symbol;
    return node;
}

static List parse_parameters(Parser *parser, int function)
{
    List list = {0};
    parser->tree->symbols[function].parameter = parser->tree->symbol_count;
    if (take_if(parser, ')'))
        return list;
    do {
        const int node = parse_parameter(parser, !list.first);
        if (!node)
            break;
        list_add(parser, &list, node);
        parser->tree->symbols[function].parameters++;
    } while (!parser->stopped && take_if(parser, ','));
    expect(parser, ')', "the closing parenthesis of the parameters");
    return list;
}

static bool same_parameters(const GlslTree *tree, const GlslSymbol *a, const GlslSymbol *b)
{
    bool same = a->parameters == b->parameters;
    for (int i = 0; i < a->parameters && same; i++)
        same = tree->symbols[a->parameter + i].type == tree->symbols[b->parameter + i].type;
    return same;
}

/* The function of the same name and parameters before this one. */
static int find_same(const GlslTree *tree, int overload, const GlslSymbol *function)
{
    while (overload && !same_parameters(tree, &tree->symbols[overload], function))
        overload = tree->symbols[overload].overload;
    return overload;
}

static void check_same(Parser *parser, const GlslSymbol *old, const GlslSymbol *function)
{
    const GlslTree *tree = parser->tree;
    bool same = old->type == function->type && old->precision == function->precision;
    for (int i = 0; i < function->parameters; i++) {
        const GlslSymbol *a = &tree->symbols[old->parameter + i];
        const GlslSymbol *b = &tree->symbols[function->parameter + i];
        same &= a->storage == b->storage && a->precision == b->precision;
    }
    if (!same)
        complain(parser, function->place,
                 "%.60s is declared as something else in line %d: return the same type, with the "
                 "same qualifiers",
                 function->name, old->place.line);
}

static bool is_built_in(const Parser *parser, const GlslSymbol *function)
{
    const GlslTree *tree = parser->tree;
    int types[64];
    if (function->parameters > 64)
        return false;
    for (int i = 0; i < function->parameters; i++)
        types[i] = tree->symbols[function->parameter + i].type;
    return find_built_in(parser, function->id, types, function->parameters) > 0;
}

static void check_main(Parser *parser, const GlslSymbol *function)
{
    if (strcmp(function->name, "main") == 0 &&
        (function->type != GLSL_VOID || function->parameters))
        complain(parser, function->place, "write void main(): it returns and takes nothing");
}

/* Puts a function among those of its name; returns the one that calls mean. */
static int declare(Parser *parser, int symbol, const Token *name, bool defines)
{
    GlslTree *tree = parser->tree;
    GlslSymbol *function = &tree->symbols[symbol];
    const int known = symbol_of(parser, name->name);
    const bool overloads = tree->symbols[known].kind == GLSL_FUNCTION;
    const int same = overloads ? find_same(tree, known, function) : 0;
    check_main(parser, function);
    if (is_built_in(parser, function))
        complain(parser, name->place, "%.60s is a function of the language: choose another name",
                 function->name);
    if (!same) {
        if (overloads)
            function->overload = known;
        else
            name_is_free(parser, name);
        return symbol_bind(parser, symbol);
    }
    GlslSymbol *old = &tree->symbols[same];
    check_same(parser, old, function);
    if (!defines && !old->node)
        complain(parser, name->place,
                 "function %.60s is declared twice, first in line %d: once is "
                 "enough",
                 function->name, old->place.line);
    if (defines && old->node)
        complain(parser, name->place, "function %.60s has a body already, in line %d",
                 function->name, old->place.line);
    if (defines) {
        old->parameter = function->parameter;
        old->place = function->place;
    }
    return same;
}

static int parse_body(Parser *parser, int symbol)
{
    GlslTree *tree = parser->tree;
    const GlslSymbol function = tree->symbols[symbol];
    const Scope outer = scope_open(parser);
    for (int i = 0; i < function.parameters; i++) {
        const GlslSymbol *parameter = &tree->symbols[function.parameter + i];
        const Token name = {.name = parameter->id, .place = parameter->place};
        if (parameter->id)
            name_is_free(parser, &name);
        symbol_bind(parser, function.parameter + i);
    }
    parser->function = symbol;
    parser->returns = false;
    const Scope parameters = scope_open(parser);
    const int body = parse_block(parser);
    scope_close(parser, parameters);
    scope_close(parser, outer);
    if (function.type != GLSL_VOID && !parser->returns && !parser->stopped)
        complain(parser, function.place, "%.60s returns nothing, but should return %s",
                 function.name, type_phrase(parser, function.type).text);
    parser->function = 0;
    return body;
}

int parse_function(Parser *parser, const Specifier *specifier)
{
    GlslTree *tree = parser->tree;
    const Token *name = take(parser);
    const int node = node_new(parser, GLSL_FUNCTION_NODE, specifier->type, specifier->place);
    int symbol = symbol_new(parser, name->name, name->place, GLSL_FUNCTION);
    take(parser);
    List children = parse_parameters(parser, symbol);
    GlslSymbol *function = &tree->symbols[symbol];
    function->type = specifier->type;
    function->precision = (unsigned char)specifier->precision;
    function->said = (unsigned char)specifier->said;
    function->global = true;
    if (specifier->structure)
        complain(parser, specifier->place,
                 "a structure cannot be defined here: define it before the function");
    if (tree->types[specifier->type].array || tree->types[specifier->type].sampler)
        complain(parser, specifier->place, "a function cannot return %s",
                 tree->types[specifier->type].array ? "an array" : "a sampler");
    const bool defines = peek(parser, 0)->kind == '{';
    if (!parser->stopped)
        symbol = declare(parser, symbol, name, defines);
    node_at(parser, node)->symbol = symbol;
    if (defines && !parser->stopped) {
        tree->symbols[symbol].node = node;
        if (strcmp(tree->symbols[symbol].name, "main") == 0)
            tree->main = symbol;
        list_add(parser, &children, parse_body(parser, symbol));
    } else {
        expect(parser, ';', "the body { ... } of the function, or a semicolon");
        list_add(parser, &children, node_new(parser, GLSL_NOTHING, GLSL_ERROR, name->place));
    }
    set_children(parser, node, children);
    return node;
}

int parse_unit(Parser *parser)
{
    List list = {0};
    scope_open(parser);
    const int node = node_new(parser, GLSL_UNIT, GLSL_ERROR, (GlslPlace){0, 1, 1});
    if (peek(parser, 0)->kind == TOKEN_END)
        syntax_error(parser, "the text is empty");
    while (!parser->stopped && peek(parser, 0)->kind != TOKEN_END) {
        int first = parse_declaration(parser, true);
        for (int next; first; first = next) { /* invariant a, b; are two */
            next = node_at(parser, first)->next;
            node_at(parser, first)->next = 0;
            list_add(parser, &list, first);
        }
    }
    set_children(parser, node, list);
    return node;
}
