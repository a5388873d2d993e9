/* Statements. */
#include "glsl/glsl_parser.h"

static int parse_statement(Parser *parser);
static int parse_branch(Parser *parser);

bool at_declaration(const Parser *parser)
{
    const Token *token = peek(parser, 0);
    if (token->kind != TOKEN_NAME)
        return false;
    if (token->name < parser->words) /* a type that is called is a constructor */
        return token->name <= WORD_STRUCT &&
               (token->name >= GLSL_TYPES || peek(parser, 1)->kind != '(');
    const bool type = parser->tree->symbols[symbol_of(parser, token->name)].kind == GLSL_STRUCT;
    /* Two names: the first should be a type. */
    return (type && peek(parser, 1)->kind != '(') ||
           (!symbol_of(parser, token->name) && peek(parser, 1)->kind == TOKEN_NAME &&
            peek(parser, 1)->name >= parser->words);
}

static int nothing(Parser *parser)
{
    return node_new(parser, GLSL_NOTHING, GLSL_ERROR, peek(parser, 0)->place);
}

/* A condition in an opened parenthesis. */
static int parse_condition(Parser *parser, bool declares)
{
    if (declares && at_declaration(parser))
        return parse_condition_variable(parser);
    const int node = parse_expression(parser), type = node_at(parser, node)->type;
    if (type != GLSL_BOOL && type != GLSL_ERROR && !parser->stopped)
        complain(parser, node_at(parser, node)->place,
                 "a condition must be a bool; %s is %s: compare it", text_phrase(parser, node).text,
                 type_phrase(parser, type).text);
    return node;
}

static void parse_if(Parser *parser, List *list)
{
    expect(parser, '(', "the parenthesis ( of the condition");
    list_add(parser, list, parse_condition(parser, false));
    expect(parser, ')', "the closing parenthesis ) of the condition");
    list_add(parser, list, parse_branch(parser));
    list_add(parser, list, take_word(parser, WORD_ELSE) ? parse_branch(parser) : nothing(parser));
}

static int parse_simple(Parser *parser)
{
    const GlslPlace place = peek(parser, 0)->place;
    if (take_if(parser, ';'))
        return node_new(parser, GLSL_EXPRESSION, GLSL_VOID, place);
    if (at_declaration(parser))
        return parse_declaration(parser, false);
    const int node = node_new(parser, GLSL_EXPRESSION, GLSL_VOID, place);
    const int expression = parse_expression(parser);
    set_children(parser, node, (List){expression, expression});
    expect(parser, ';', "a semicolon");
    return node;
}

static int parse_body(Parser *parser)
{
    return peek(parser, 0)->kind == '{' ? parse_block(parser) : parse_statement(parser);
}

static void parse_for(Parser *parser, List *list)
{
    expect(parser, '(', "the parenthesis ( of the loop");
    list_add(parser, list, parse_simple(parser));
    list_add(parser, list,
             peek(parser, 0)->kind == ';' ? nothing(parser) : parse_condition(parser, true));
    expect(parser, ';', "a semicolon");
    list_add(parser, list,
             peek(parser, 0)->kind == ')' ? nothing(parser) : parse_expression(parser));
    expect(parser, ')', "the closing parenthesis ) of the loop");
    list_add(parser, list, parse_body(parser));
}

static void parse_loop(Parser *parser, List *list, int word)
{
    const Scope outer = scope_open(parser);
    parser->loops++;
    if (word == WORD_FOR) {
        parse_for(parser, list);
    } else if (word == WORD_WHILE) {
        expect(parser, '(', "the parenthesis ( of the condition");
        list_add(parser, list, parse_condition(parser, true));
        expect(parser, ')', "the closing parenthesis ) of the condition");
        list_add(parser, list, parse_body(parser));
    } else {
        list_add(parser, list, parse_branch(parser));
        if (!take_word(parser, WORD_WHILE))
            syntax_error(parser, "`while` is missing after the body of `do`");
        expect(parser, '(', "the parenthesis ( of the condition");
        list_add(parser, list, parse_condition(parser, false));
        expect(parser, ')', "the closing parenthesis ) of the condition");
        expect(parser, ';', "a semicolon");
    }
    parser->loops--;
    scope_close(parser, outer);
}

static void parse_return(Parser *parser, List *list, GlslPlace place)
{
    GlslTree *tree = parser->tree;
    const GlslSymbol *function = &tree->symbols[parser->function];
    const bool empty = peek(parser, 0)->kind == ';';
    const int node = empty ? nothing(parser) : parse_expression(parser);
    const int type = empty ? GLSL_VOID : node_at(parser, node)->type;
    list_add(parser, list, node);
    parser->returns = true;
    expect(parser, ';', "a semicolon");
    if (parser->stopped || type == GLSL_ERROR || function->type == GLSL_ERROR)
        return;
    if (!empty && function->type == GLSL_VOID)
        complain(parser, place, "%.60s is void: it cannot return a value", function->name);
    else if (type != function->type)
        complain(parser, place, "%.60s must return %s, not %s%s", function->name,
                 type_phrase(parser, function->type).text, type_phrase(parser, type).text,
                 empty ? "" : conversion(parser, node, function->type).text);
}

int parse_block(Parser *parser)
{
    const int node = node_new(parser, GLSL_BLOCK, GLSL_VOID, peek(parser, 0)->place);
    List list = {0};
    if (!expect(parser, '{', "the opening brace {") || !deeper(parser))
        return node;
    while (!parser->stopped && peek(parser, 0)->kind != '}' && peek(parser, 0)->kind != TOKEN_END) {
        list_add(parser, &list, parse_statement(parser));
        while (node_at(parser, list.last)->next)
            list.last = node_at(parser, list.last)->next;
    }
    expect(parser, '}', "the closing brace }");
    parser->depth--;
    set_children(parser, node, list);
    return node;
}

/* What begins with a word of its own. */
static int parse_keyword(Parser *parser)
{
    /* clang-format off */
    static const struct {
        unsigned char word, kind;
    } KINDS[] = {
        {WORD_IF, GLSL_IF}, {WORD_FOR, GLSL_FOR}, {WORD_WHILE, GLSL_WHILE}, {WORD_DO, GLSL_DO},
        {WORD_RETURN, GLSL_RETURN}, {WORD_BREAK, GLSL_BREAK}, {WORD_CONTINUE, GLSL_CONTINUE},
        {WORD_DISCARD, GLSL_DISCARD}};
    /* clang-format on */
    const GlslPlace place = peek(parser, 0)->place;
    int kind = 0, word = 0;
    for (size_t i = 0; i < sizeof KINDS / sizeof KINDS[0] && !kind; i++)
        if (take_word(parser, KINDS[i].word)) {
            kind = KINDS[i].kind;
            word = KINDS[i].word;
        }
    if (!kind)
        return 0;
    const int node = node_new(parser, kind, GLSL_VOID, place);
    List list = {0};
    if (kind == GLSL_IF) {
        parse_if(parser, &list);
    } else if (kind == GLSL_FOR || kind == GLSL_WHILE || kind == GLSL_DO) {
        parse_loop(parser, &list, word);
    } else if (kind == GLSL_RETURN) {
        parse_return(parser, &list, place);
    } else {
        if ((kind == GLSL_BREAK || kind == GLSL_CONTINUE) && !parser->loops)
            complain(parser, place, "break and continue belong into a loop");
        if (kind == GLSL_DISCARD && parser->tree->stage == GLSL_VERTEX)
            complain(parser, place, "only a fragment shader can discard");
        expect(parser, ';', "a semicolon");
    }
    set_children(parser, node, list);
    return node;
}

static int parse_statement(Parser *parser)
{
    int node = 0;
    if (!deeper(parser)) {
        node = nothing(parser);
    } else if (peek(parser, 0)->kind == '{') {
        const Scope outer = scope_open(parser);
        node = parse_block(parser);
        scope_close(parser, outer);
    } else {
        node = parse_keyword(parser);
    }
    node = node ? node : parse_simple(parser);
    parser->depth--;
    return node;
}

/* What a condition decides on; a loop's body is in the scope of its head instead. */
static int parse_branch(Parser *parser)
{
    const Scope outer = scope_open(parser);
    const int node = parse_statement(parser);
    scope_close(parser, outer);
    return node;
}
