/* Expressions, by precedence; tokens. */
#include "glsl/glsl_parser.h"

#include <stdlib.h>
#include <string.h>

static const Token NO_TOKEN = {.text = ""};

const Token *peek(const Parser *parser, int ahead)
{
    const int at = parser->at + ahead, last = parser->tokens.count - 1;
    return parser->stopped ? &NO_TOKEN : &parser->tokens.items[at < last ? at : last];
}

const Token *take(Parser *parser)
{
    const Token *token = peek(parser, 0);
    parser->at += token->kind != TOKEN_END;
    return token;
}

bool at_word(const Parser *parser, int word)
{
    return peek(parser, 0)->kind == TOKEN_NAME && peek(parser, 0)->name == word;
}

bool take_if(Parser *parser, int kind)
{
    const bool found = kind && peek(parser, 0)->kind == kind;
    if (found)
        parser->at++;
    return found;
}

bool take_word(Parser *parser, int word)
{
    const bool found = at_word(parser, word);
    if (found)
        parser->at++;
    return found;
}

bool expect(Parser *parser, int kind, const char *what)
{
    if (take_if(parser, kind))
        return true;
    const Token *token = peek(parser, 0);
    if (token->kind == TOKEN_END)
        syntax_error(parser, "the text ends here, where %s is missing", what);
    else if (parser->at && token->place.line > peek(parser, -1)->place.line)
        syntax_error(parser, "%s is missing, probably at the end of line %d", what,
                     peek(parser, -1)->place.line);
    else
        syntax_error(parser, "%s is missing before `%.*s`", what,
                     token->length < 60 ? token->length : 60, token->text);
    return false;
}

/* The caller decreases the depth again. */
bool deeper(Parser *parser)
{
    if (++parser->depth > parser->tree->limits.depth)
        syntax_error(parser, "this is nested more than %d deep", parser->tree->limits.depth);
    return !parser->stopped;
}

static int literal(Parser *parser, int type, double value, GlslPlace place)
{
    const int node = node_new(parser, GLSL_LITERAL, type, place);
    const int at = values_new(parser->tree, 1);
    parser->tree->values[at] = value;
    node_at(parser, node)->value = at;
    node_at(parser, node)->constant = true;
    return node;
}

static int parse_number(Parser *parser)
{
    const Token *token = take(parser);
    if (token->kind == TOKEN_FLOAT) {
        char text[64];
        const int length = token->length < 63 ? token->length : 63;
        memcpy(text, token->text, (size_t)length);
        text[length] = '\0';
        return literal(parser, GLSL_FLOAT, strtod(text, NULL), token->place);
    }
    const long long value = token_integer(token);
    if (value < 0)
        complain(parser, token->place, "this number has more than 32 bits");
    return literal(parser, GLSL_INT, (int)(unsigned)value, token->place);
}

static int parse_name(Parser *parser)
{
    const Token *token = take(parser);
    GlslTree *tree = parser->tree;
    const int symbol = symbol_of(parser, token->name);
    const GlslSymbol *variable = &tree->symbols[symbol];
    const int node = node_new(parser, GLSL_NAME, GLSL_ERROR, token->place);
    if (variable->kind != GLSL_VARIABLE) {
        undeclared(parser, token, symbol);
        return node;
    }
    GlslNode *name = node_at(parser, node);
    name->symbol = symbol;
    name->type = variable->type;
    name->precision = variable->precision;
    name->constant = variable->storage == GLSL_CONST && variable->value;
    name->value = name->constant ? variable->value : 0;
    return node;
}

/* After the opening parenthesis, to the closing one. */
static List parse_arguments(Parser *parser)
{
    List list = {0};
    if (at_word(parser, GLSL_VOID) && peek(parser, 1)->kind == ')')
        take(parser);
    if (take_if(parser, ')'))
        return list;
    do
        list_add(parser, &list, parse_assignment(parser));
    while (!parser->stopped && take_if(parser, ','));
    expect(parser, ')', "the closing parenthesis ) of the arguments");
    return list;
}

static int parse_call(Parser *parser)
{
    const Token *token = take(parser);
    const bool type = token->name < GLSL_TYPES;
    const int symbol = type ? 0 : symbol_of(parser, token->name);
    const GlslSymbol *called = &parser->tree->symbols[symbol];
    const bool constructs = type || called->kind == GLSL_STRUCT;
    const int node = node_new(parser, constructs ? GLSL_CONSTRUCT : GLSL_CALL,
                              type         ? token->name
                              : constructs ? called->type
                                           : GLSL_ERROR,
                              token->place);
    take(parser);
    set_children(parser, node, parse_arguments(parser));
    if (constructs)
        check_construct(parser, node);
    else
        check_call(parser, node, token->name);
    return node;
}

static void no_expression(Parser *parser, const Token *token)
{
    const int length = token->length < 40 ? token->length : 40;
    if (token->kind == TOKEN_BAD && token->text[0] >= '0' && token->text[0] <= '9')
        syntax_error(parser, "%.*s is no number of GLSL ES 1.00: it has no suffixes such as f",
                     length, token->text);
    else if (token->kind == TOKEN_BAD)
        syntax_error(parser, "the language has no such character");
    else if (token->kind == TOKEN_NAME && token->name >= WORD_RESERVED &&
             token->name < parser->words)
        syntax_error(parser, "%s", reserved(parser, token->name).text);
    else if (token->kind == TOKEN_END)
        syntax_error(parser, "the text ends here, in the middle of an expression");
    else
        syntax_error(parser, "a value is missing before `%.*s`: check the line before, too", length,
                     token->text);
}

static int parse_primary(Parser *parser)
{
    const Token *token = peek(parser, 0);
    if (token->kind == TOKEN_INT || token->kind == TOKEN_FLOAT)
        return parse_number(parser);
    if (at_word(parser, WORD_TRUE) || at_word(parser, WORD_FALSE))
        return literal(parser, GLSL_BOOL, take(parser)->name == WORD_TRUE, token->place);
    if (token->kind == TOKEN_NAME && (token->name < GLSL_TYPES || token->name >= parser->words) &&
        peek(parser, 1)->kind == '(')
        return parse_call(parser);
    if (token->kind == TOKEN_NAME && token->name >= parser->words)
        return parse_name(parser);
    if (take_if(parser, '(')) {
        const int node = parse_expression(parser);
        expect(parser, ')', "the closing parenthesis )");
        return node;
    }
    no_expression(parser, token);
    return node_new(parser, GLSL_NOTHING, GLSL_ERROR, token->place);
}

static int unary(Parser *parser, int op, int operand, GlslPlace place)
{
    const int node = node_new(parser, GLSL_UNARY, GLSL_ERROR, place);
    node_at(parser, node)->op = (unsigned short)op;
    set_children(parser, node, (List){operand, operand});
    check_unary(parser, node);
    return node;
}

static int parse_postfix(Parser *parser)
{
    int node = parse_primary(parser);
    while (!parser->stopped) {
        const GlslPlace place = node_at(parser, node)->place;
        if (take_if(parser, '[')) {
            const int base = node, index = parse_expression(parser);
            List list = {0};
            list_add(parser, &list, base);
            list_add(parser, &list, index);
            expect(parser, ']', "the closing bracket ]");
            node = node_new(parser, GLSL_INDEX, GLSL_ERROR, place);
            set_children(parser, node, list);
            check_index(parser, node);
        } else if (take_if(parser, '.')) {
            if (peek(parser, 0)->kind == TOKEN_NAME)
                node = select_field(parser, node, take(parser));
            else
                syntax_error(parser, "the name of a component or field is missing after the dot");
        } else if (take_if(parser, TOKEN_INCREMENT)) {
            node = unary(parser, GLSL_POST_INCREMENT, node, place);
        } else if (take_if(parser, TOKEN_DECREMENT)) {
            node = unary(parser, GLSL_POST_DECREMENT, node, place);
        } else {
            break;
        }
    }
    return node;
}

static int parse_unary(Parser *parser)
{
    static const struct {
        unsigned char kind, op;
    } OPERATORS[] = {{'+', GLSL_PLUS},
                     {'-', GLSL_MINUS},
                     {'!', GLSL_NOT},
                     {TOKEN_INCREMENT, GLSL_PRE_INCREMENT},
                     {TOKEN_DECREMENT, GLSL_PRE_DECREMENT}};
    const Token *token = peek(parser, 0);
    int node = 0;
    if (!deeper(parser))
        return node_new(parser, GLSL_NOTHING, GLSL_ERROR, token->place);
    for (size_t i = 0; i < sizeof OPERATORS / sizeof OPERATORS[0] && !node; i++)
        if (take_if(parser, OPERATORS[i].kind))
            node = unary(parser, OPERATORS[i].op, parse_unary(parser), token->place);
    if (!node)
        node = parse_postfix(parser);
    parser->depth--;
    return node;
}

/* The precedence of a binary operator; 0: it is none. */
static int binary_operator(int kind, int *op)
{
    /* clang-format off */
    static const struct {
        unsigned char kind, op, precedence;
    } OPERATORS[] = {
        {TOKEN_OR, GLSL_OR, 1}, {TOKEN_XOR, GLSL_XOR, 2}, {TOKEN_AND, GLSL_AND, 3},
        {TOKEN_EQUAL, GLSL_EQUAL, 4}, {TOKEN_NOT_EQUAL, GLSL_NOT_EQUAL, 4},
        {'<', GLSL_LESS, 5}, {'>', GLSL_GREATER, 5}, {TOKEN_LESS_EQUAL, GLSL_LESS_EQUAL, 5},
        {TOKEN_GREATER_EQUAL, GLSL_GREATER_EQUAL, 5}, {'+', GLSL_ADD, 6},
        {'-', GLSL_SUBTRACT, 6}, {'*', GLSL_MULTIPLY, 7}, {'/', GLSL_DIVIDE, 7}};
    /* clang-format on */
    for (size_t i = 0; i < sizeof OPERATORS / sizeof OPERATORS[0]; i++)
        if (OPERATORS[i].kind == kind) {
            *op = OPERATORS[i].op;
            return OPERATORS[i].precedence;
        }
    return 0;
}

static int pair(Parser *parser, int kind, int op, int left, int right)
{
    const int node = node_new(parser, kind, GLSL_ERROR, node_at(parser, left)->place);
    List list = {0};
    list_add(parser, &list, left);
    list_add(parser, &list, right);
    node_at(parser, node)->op = (unsigned short)op;
    set_children(parser, node, list);
    if (kind == GLSL_ASSIGN)
        check_assign(parser, node);
    else
        check_binary(parser, node);
    return node;
}

static int parse_binary(Parser *parser, int precedence)
{
    int left = parse_unary(parser), op = 0, own;
    while ((own = binary_operator(peek(parser, 0)->kind, &op)) >= precedence && own) {
        take(parser);
        const int mine = op;
        left = pair(parser, GLSL_BINARY, mine, left, parse_binary(parser, own + 1));
    }
    const Token *token = peek(parser, 0);
    if (token->kind && (strchr("%^&|", token->kind) || token->kind == TOKEN_LEFT ||
                        token->kind == TOKEN_RIGHT || token->kind == TOKEN_LATER))
        syntax_error(parser, "GLSL ES 1.00 has no operator %.*s%s", token->length, token->text,
                     token->kind == '%' ? ": write mod(x, y), or a - a / b * b for ints" : "");
    return left;
}

int parse_conditional(Parser *parser)
{
    const int condition = parse_binary(parser, 1);
    if (!take_if(parser, '?'))
        return condition;
    const int node =
        node_new(parser, GLSL_CONDITIONAL, GLSL_ERROR, node_at(parser, condition)->place);
    List list = {0};
    list_add(parser, &list, condition);
    if (deeper(parser)) {
        list_add(parser, &list, parse_expression(parser));
        if (expect(parser, ':', "the colon after ?"))
            list_add(parser, &list, parse_assignment(parser));
    }
    parser->depth--;
    set_children(parser, node, list);
    if (!parser->stopped)
        check_conditional(parser, node);
    return node;
}

int parse_assignment(Parser *parser)
{
    static const struct {
        unsigned char kind, op;
    } OPERATORS[] = {{'=', GLSL_SET},
                     {TOKEN_ADD, GLSL_ADD},
                     {TOKEN_SUBTRACT, GLSL_SUBTRACT},
                     {TOKEN_MULTIPLY, GLSL_MULTIPLY},
                     {TOKEN_DIVIDE, GLSL_DIVIDE}};
    int left = parse_conditional(parser);
    for (size_t i = 0; i < sizeof OPERATORS / sizeof OPERATORS[0]; i++)
        if (take_if(parser, OPERATORS[i].kind)) {
            const int right = deeper(parser) ? parse_assignment(parser) : 0;
            parser->depth--;
            return right ? pair(parser, GLSL_ASSIGN, OPERATORS[i].op, left, right) : left;
        }
    return left;
}

int parse_expression(Parser *parser)
{
    int left = parse_assignment(parser);
    while (take_if(parser, ','))
        left = pair(parser, GLSL_BINARY, GLSL_COMMA, left, parse_assignment(parser));
    return left;
}
