/* Declarations: variables, structures, precisions. */
#include "glsl/glsl_parser.h"

#include <stdio.h>
#include <string.h>

static int take_precision(Parser *parser)
{
    for (int word = WORD_LOWP; word <= WORD_HIGHP; word++)
        if (take_word(parser, word))
            return word - WORD_LOWP + GLSL_LOWP;
    return GLSL_NO_PRECISION;
}

static bool has_precision(int type)
{
    return (type >= GLSL_FLOAT && type <= GLSL_IVEC4) || glsl_is_matrix(type) ||
           type == GLSL_SAMPLER_2D || type == GLSL_SAMPLER_CUBE;
}

/* The type whose default holds for a type. */
static int default_of(int type)
{
    return type == GLSL_SAMPLER_2D || type == GLSL_SAMPLER_CUBE ? type : glsl_scalar(type);
}

static void settle_precision(Parser *parser, Specifier *specifier)
{
    const int type = specifier->type;
    specifier->precision = specifier->said;
    if (specifier->said && !has_precision(type) && type != GLSL_ERROR)
        complain(parser, specifier->place, "%s has no precision: remove lowp, mediump or highp",
                 type_phrase(parser, type).text);
    if (specifier->said || !has_precision(type))
        return;
    specifier->precision = parser->precisions[default_of(type)];
    if (!specifier->precision) {
        complain(parser, specifier->place,
                 "floats have no default precision here: add `precision highp float;` at the top");
        /* Once is enough. */
        parser->precisions[GLSL_FLOAT] = GLSL_MEDIUMP;
        specifier->precision = GLSL_MEDIUMP;
    }
}

static int parse_struct(Parser *parser, Specifier *specifier);

Sentence reserved(Parser *parser, int word)
{
    Sentence sentence;
    const char *name = keep_name(parser, word), *instead = replacement_for(parser, name);
    snprintf(sentence.text, sizeof sentence.text, "%.40s has no meaning here in GLSL ES 1.00%s%s",
             name, instead ? "; " : "", instead ? instead : "");
    return sentence;
}

static void no_type(Parser *parser, const char *name)
{
    const char *instead = replacement_for(parser, name);
    const char *near = nearest(parser, name, GLSL_STRUCT);
    if (instead)
        syntax_error(parser, "GLSL ES 1.00 has no %.60s: %s", name, instead);
    else if (near)
        syntax_error(parser, "%.60s is no type: did you mean %.60s?", name, near);
    else
        syntax_error(parser,
                     "%.60s is no type: check its spelling, and the line before for a semicolon "
                     "that is missing",
                     name);
}

void parse_type(Parser *parser, Specifier *specifier)
{
    const Token *token = peek(parser, 0);
    specifier->place = token->place;
    specifier->said = take_precision(parser);
    token = peek(parser, 0);
    if (token->kind == TOKEN_NAME && token->name < GLSL_TYPES) {
        specifier->type = take(parser)->name;
    } else if (take_word(parser, WORD_STRUCT)) {
        specifier->type = parse_struct(parser, specifier);
    } else if (token->kind == TOKEN_NAME &&
               parser->tree->symbols[symbol_of(parser, token->name)].kind == GLSL_STRUCT) {
        specifier->type = parser->tree->symbols[symbol_of(parser, take(parser)->name)].type;
    } else if (token->kind == TOKEN_NAME && token->name < parser->words &&
               token->name >= WORD_RESERVED) {
        syntax_error(parser, "%s", reserved(parser, token->name).text);
    } else if (token->kind == TOKEN_NAME && token->name >= parser->words) {
        no_type(parser, keep_name(parser, token->name));
    } else {
        syntax_error(parser, "a type is missing: check the line before, too");
    }
    settle_precision(parser, specifier);
}

static int parse_array_length(Parser *parser)
{
    const GlslPlace place = peek(parser, 0)->place;
    const int node = parse_conditional(parser);
    const GlslNode *length = node_at(parser, node);
    expect(parser, ']', "the closing bracket ] of the array's length");
    if (length->type == GLSL_ERROR || parser->stopped)
        return 1;
    const double value = parser->tree->values[length->value];
    if (!length->constant || length->type != GLSL_INT)
        complain(parser, place, "an array's length must be a constant int");
    else if (value < 1)
        complain(parser, place, "an array's length must be at least 1");
    else
        return (int)value;
    return 1;
}

/* NAME or NAME[LENGTH]; the type. */
int parse_array_type(Parser *parser, int type)
{
    const GlslPlace place = peek(parser, 0)->place;
    if (!take_if(parser, '['))
        return type;
    if (parser->tree->types[type].element)
        complain(parser, place, "an array cannot be an array's element");
    if (take_if(parser, ']')) {
        complain(parser, place, "an array needs its length in the brackets");
        return type_array(parser->tree, type, 1);
    }
    return type_array(parser->tree, type, parse_array_length(parser));
}

static bool no_void(Parser *parser, int type, GlslPlace place)
{
    if (type == GLSL_VOID)
        complain(parser, place, "void is only what a function returns: write the variable's type");
    return type != GLSL_VOID;
}

static void parse_field(Parser *parser, int type, const Specifier *specifier)
{
    GlslTree *tree = parser->tree;
    const Token *name = peek(parser, 0);
    if (name->kind != TOKEN_NAME || name->name < parser->words) {
        syntax_error(parser, "the name of a field is missing");
        return;
    }
    take(parser);
    const char *text = keep_name(parser, name->name);
    const int fields = tree->types[type].fields;
    for (int i = 0; i < fields && i < 1000; i++)
        if (strcmp(tree->fields[tree->types[type].field + i].name, text) == 0)
            complain(parser, name->place, "the structure has a field %.60s already", text);
    const int of = parse_array_type(parser, specifier->type);
    type_add_field(tree, type, text, of, specifier->precision);
    tree->fields[tree->field_count - 1].said = (unsigned char)specifier->said;
}

static void parse_fields(Parser *parser, int type)
{
    while (!parser->stopped && peek(parser, 0)->kind != '}') {
        Specifier specifier = {0};
        if (at_word(parser, WORD_STRUCT)) {
            syntax_error(parser, "a structure cannot be defined inside another: define it before");
            return;
        }
        parse_type(parser, &specifier);
        no_void(parser, specifier.type, specifier.place);
        do
            parse_field(parser, type, &specifier);
        while (take_if(parser, ','));
        expect(parser, ';', "a semicolon after the field");
    }
    if (parser->tree->types[type].fields == 0)
        syntax_error(parser, "a structure needs at least one field");
}

static int parse_struct(Parser *parser, Specifier *specifier)
{
    GlslTree *tree = parser->tree;
    const Token *name = peek(parser, 0);
    const bool named = name->kind == TOKEN_NAME && name->name >= parser->words;
    if (named)
        take(parser);
    if (!expect(parser, '{', "the opening brace { of the structure"))
        return GLSL_ERROR;
    const int type = type_struct(tree, "");
    parse_fields(parser, type);
    expect(parser, '}', "the closing brace } of the structure");
    if (named)
        name_is_free(parser, name);
    specifier->structure =
        symbol_bind(parser, symbol_new(parser, named ? name->name : 0, name->place, GLSL_STRUCT));
    tree->symbols[specifier->structure].type = type;
    tree->types[type].name = tree->symbols[specifier->structure].name;
    return type;
}

/* What may be an attribute or a varying. */
static bool is_float(const GlslTree *tree, int type, bool arrays)
{
    if (arrays && tree->types[type].element)
        type = tree->types[type].element;
    return glsl_scalar(type) == GLSL_FLOAT;
}

static void check_storage(Parser *parser, const Specifier *specifier, int type, GlslPlace place,
                          bool global)
{
    const GlslTree *tree = parser->tree;
    const int storage = specifier->storage;
    if (type == GLSL_ERROR || !no_void(parser, type, place))
        return;
    if (!global && storage >= GLSL_ATTRIBUTE)
        complain(parser, specifier->place,
                 "declare attributes, uniforms and varyings outside all functions, above main");
    else if (storage == GLSL_ATTRIBUTE && tree->stage == GLSL_FRAGMENT)
        complain(parser, specifier->place,
                 "only vertex shaders have attributes: pass the value on as a varying");
    else if (storage == GLSL_ATTRIBUTE && !is_float(tree, type, false))
        complain(parser, place, "an attribute must be a float, a vec or a mat, not %s",
                 type_phrase(parser, type).text);
    else if (storage == GLSL_VARYING && !is_float(tree, type, true))
        complain(parser, place,
                 "a varying must be a float, a vec, a mat or an array of them, not %s",
                 type_phrase(parser, type).text);
    else if (storage != GLSL_UNIFORM && tree->types[type].sampler)
        complain(parser, place,
                 "a sampler must be a uniform or a function's parameter: write "
                 "`uniform` before its type");
    else if (storage == GLSL_CONST && tree->types[type].array)
        complain(parser, place, "an array cannot be a constant: it has no first value here");
}

static int parse_variable(Parser *parser, const Specifier *specifier, bool global)
{
    GlslTree *tree = parser->tree;
    const Token name = *take(parser);
    const int type = parse_array_type(parser, specifier->type);
    const int node = node_new(parser, GLSL_VARIABLE_NODE, type, name.place);
    List children = {0};
    int value = 0;
    check_storage(parser, specifier, type, name.place, global);
    const GlslPlace equals = peek(parser, 0)->place;
    if (take_if(parser, '=') && deeper(parser)) {
        value = parse_assignment(parser);
        parser->depth--;
        list_add(parser, &children, value);
    }
    name_is_free(parser, &name);
    const int symbol =
        symbol_bind(parser, symbol_new(parser, name.name, name.place, GLSL_VARIABLE));
    GlslSymbol *variable = &tree->symbols[symbol];
    variable->type = type;
    variable->storage = (unsigned char)specifier->storage;
    variable->precision = (unsigned char)specifier->precision;
    variable->said = (unsigned char)specifier->said;
    variable->invariant = specifier->invariant;
    variable->global = global;
    if (value)
        check_initial(parser, symbol, value, equals);
    else if (specifier->storage == GLSL_CONST && !parser->stopped)
        complain(parser, name.place, "a constant needs its value: %.60s = ...",
                 tree->symbols[symbol].name);
    node_at(parser, node)->symbol = symbol;
    set_children(parser, node, children);
    return node;
}

/* precision highp float; */
static int parse_precision(Parser *parser)
{
    const Token *word = take(parser);
    const int node = node_new(parser, GLSL_PRECISION, GLSL_ERROR, word->place);
    const int precision = take_precision(parser), type = peek(parser, 0)->name;
    if (!precision || peek(parser, 0)->kind != TOKEN_NAME || type <= 0 || type >= GLSL_TYPES) {
        syntax_error(parser, "write `precision highp float;` (or mediump, lowp; int, sampler2D)");
        return node;
    }
    if (default_of(type) != type || !has_precision(type))
        complain(parser, peek(parser, 0)->place,
                 "only float, int and samplers have a default precision: it holds for vec and mat");
    else
        parser->precisions[type] = (unsigned char)precision;
    take(parser);
    node_at(parser, node)->type = type;
    node_at(parser, node)->precision = (unsigned char)precision;
    expect(parser, ';', "a semicolon");
    return node;
}

/* invariant gl_Position, v_Color; after its first word. */
static int parse_invariant(Parser *parser, GlslPlace place)
{
    GlslTree *tree = parser->tree;
    int node = 0;
    List list = {0};
    do {
        const Token *name = take(parser);
        const int symbol = name->kind == TOKEN_NAME ? symbol_of(parser, name->name) : 0;
        node = node_new(parser, GLSL_INVARIANT, GLSL_ERROR, place);
        node_at(parser, node)->symbol = symbol;
        list_add(parser, &list, node);
        const GlslSymbol *variable = &tree->symbols[symbol];
        const bool built_in = variable->built_in && variable->storage != GLSL_CONST &&
                              variable->storage != GLSL_UNIFORM &&
                              strcmp(variable->name, "gl_FrontFacing") != 0;
        if (name->kind != TOKEN_NAME)
            syntax_error(parser, "the name of a varying is missing");
        else if (variable->kind != GLSL_VARIABLE ||
                 (!built_in && variable->storage != GLSL_VARYING))
            complain(parser, name->place, "only varyings and gl_ variables can be invariant");
        else if (!variable->built_in && parser->scope > variable->position)
            complain(parser, name->place, "write this outside all functions");
        else
            tree->symbols[symbol].invariant = true;
    } while (take_if(parser, ','));
    expect(parser, ';', "a semicolon");
    return list.first;
}

static void parse_qualifiers(Parser *parser, Specifier *specifier)
{
    const Token *first = peek(parser, 0);
    specifier->place = first->place;
    specifier->invariant = take_word(parser, WORD_INVARIANT);
    for (int word = WORD_CONST; word <= WORD_VARYING; word++)
        if (take_word(parser, word)) {
            specifier->storage = word - WORD_CONST + GLSL_CONST;
            break;
        }
    if (at_word(parser, WORD_IN) || at_word(parser, WORD_OUT) || at_word(parser, WORD_INOUT))
        syntax_error(parser, "%s", reserved(parser, peek(parser, 0)->name).text);
    if (specifier->invariant && specifier->storage != GLSL_VARYING)
        complain(parser, specifier->place, "only varyings can be invariant");
}

static bool at_free_name(const Parser *parser)
{
    return peek(parser, 0)->kind == TOKEN_NAME && peek(parser, 0)->name >= parser->words;
}

/* In a while's or for's condition: bool b = ... */
int parse_condition_variable(Parser *parser)
{
    Specifier specifier = {0};
    parse_qualifiers(parser, &specifier);
    parse_type(parser, &specifier);
    const int node = node_new(parser, GLSL_DECLARE, specifier.type, specifier.place);
    if (!at_free_name(parser) || peek(parser, 1)->kind != '=') {
        syntax_error(parser, "a condition declares only `bool name = value`");
        return node;
    }
    List list = {0};
    list_add(parser, &list, parse_variable(parser, &specifier, false));
    set_children(parser, node, list);
    if (specifier.type != GLSL_BOOL && !parser->stopped)
        complain(parser, specifier.place, "a condition must be a bool");
    return node;
}

int parse_declaration(Parser *parser, bool global)
{
    Specifier specifier = {0};
    List list = {0};
    const Token *first = peek(parser, 0);
    if (at_word(parser, WORD_PRECISION))
        return parse_precision(parser);
    if (at_word(parser, WORD_INVARIANT) && peek(parser, 1)->kind == TOKEN_NAME &&
        peek(parser, 1)->name >= parser->words) {
        take(parser);
        return parse_invariant(parser, first->place);
    }
    parse_qualifiers(parser, &specifier);
    parse_type(parser, &specifier);
    if (global && at_free_name(parser) && peek(parser, 1)->kind == '{')
        syntax_error(parser, "() is missing after a function's name: void main() {");
    else if (at_free_name(parser) && peek(parser, 1)->kind == '(') {
        if (global && !specifier.storage && !specifier.invariant)
            return parse_function(parser, &specifier);
        syntax_error(parser, global ? "a function has no qualifier such as const: remove it"
                                    : "a function cannot be inside another: is a brace } missing?");
        return node_new(parser, GLSL_NOTHING, GLSL_ERROR, first->place);
    }
    const int node = node_new(parser, GLSL_DECLARE, specifier.type, first->place);
    node_at(parser, node)->symbol = specifier.structure;
    node_at(parser, node)->op = specifier.invariant;
    /* The grammar lets the first name be left out. */
    if (take_if(parser, ',') || peek(parser, 0)->kind != ';')
        do {
            if (!at_free_name(parser)) {
                syntax_error(parser, "the name of the variable is missing");
                break;
            }
            list_add(parser, &list, parse_variable(parser, &specifier, global));
        } while (take_if(parser, ','));
    expect(parser, ';', "a semicolon");
    set_children(parser, node, list);
    return node;
}
