/*
 * Macros. What is expanded is read again from a stack of sources: the text itself at the bottom, on
 * it the bodies of the macros that are being expanded, whose names are not expanded until their end
 * is reached. A macro's arguments are expanded on their own, as a source that ends. Every token
 * that comes out of a macro counts, also those that vanish, so that time and memory are bounded by
 * the limit even where each macro doubles the one before.
 */
#include "glsl/glsl_preprocess.h"

#include "base/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ARGUMENTS = 64 };

void tokens_add(Tokens *tokens, Token token)
{
    *(Token *)memory_add(&tokens->items, &tokens->count, &tokens->room, sizeof token) = token;
}

void preprocess_fail(Preprocessor *all, GlslPlace place, const char *format, ...)
{
    if (all->failed)
        return;
    all->failed = true;
    all->message->place = place;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(all->message->text, sizeof all->message->text, format, arguments);
    va_end(arguments);
}

static void grown(Preprocessor *all, GlslPlace place)
{
    all->tree->grown = true;
    preprocess_fail(all, place, "the macros expand to more than %d tokens",
                    all->tree->limits.tokens);
}

static void push(Preprocessor *all, Tokens tokens, int macro, bool barrier)
{
    *(Source *)memory_add(&all->sources, &all->source_count, &all->source_room, sizeof(Source)) =
        (Source){.tokens = tokens, .macro = macro, .barrier = barrier};
    if (macro)
        all->macros[macro].active = true;
}

static void pop(Preprocessor *all)
{
    const Source source = all->sources[--all->source_count];
    free(source.tokens.items);
    if (source.macro)
        all->macros[source.macro].active = false;
}

static Token end_token(const Preprocessor *all)
{
    return (Token){.kind = TOKEN_END, .text = "", .place = {all->lexer.file, all->lexer.line, 1}};
}

/* Not expanded yet. */
static void next_raw(Preprocessor *all, Token *token)
{
    while (!all->failed && all->source_count) {
        Source *top = &all->sources[all->source_count - 1];
        if (top->at < top->tokens.count) {
            *token = top->tokens.items[top->at++];
            if (++all->expanded > all->tree->limits.tokens)
                grown(all, token->place);
            return;
        }
        if (top->barrier) {
            *token = end_token(all);
            return;
        }
        pop(all);
    }
    if (all->failed)
        *token = end_token(all);
    else
        preprocess_text(all, token);
}

static void push_back(Preprocessor *all, Token token)
{
    Tokens one = {0};
    tokens_add(&one, token);
    push(all, one, 0, false);
    all->expanded--;
}

/* A name that is a macro is replaced by a source, anything else returned. */
static bool expand(Preprocessor *all, Token *token);

static Tokens expand_all(Preprocessor *all, Tokens tokens)
{
    Tokens expanded = {0};
    push(all, tokens, 0, true);
    for (;;) {
        Token token;
        next_raw(all, &token);
        if (token.kind == TOKEN_END)
            break;
        if (!expand(all, &token))
            tokens_add(&expanded, token);
    }
    if (all->source_count)
        pop(all);
    return expanded;
}

Tokens preprocess_line(Preprocessor *all, Tokens line)
{
    return expand_all(all, line);
}

/* After the opening parenthesis, to the closing one; how many. */
static int read_arguments(Preprocessor *all, Token name, Tokens *arguments)
{
    int count = 1, depth = 0;
    for (;;) {
        Token token;
        next_raw(all, &token);
        if (token.kind == TOKEN_END) {
            preprocess_fail(all, name.place, "the call of macro %.*s has no closing parenthesis",
                            name.length > 80 ? 80 : name.length, name.text);
            return count;
        }
        if (token.kind == ')' && depth == 0)
            return count;
        depth += (token.kind == '(') - (token.kind == ')');
        if (token.kind == ',' && depth == 0 && count < ARGUMENTS)
            count++;
        else
            tokens_add(&arguments[count - 1], token);
    }
}

static void substitute(Preprocessor *all, const Macro *macro, GlslPlace place,
                       const Tokens *arguments, Tokens *result)
{
    for (int i = 0; i < macro->body.count && !all->failed; i++) {
        Token token = macro->body.items[i];
        token.place = place;
        if (token.kind != TOKEN_PARAMETER) {
            tokens_add(result, token);
            continue;
        }
        const Tokens *argument = &arguments[token.name];
        all->expanded += argument->count;
        if (all->expanded > all->tree->limits.tokens)
            grown(all, place);
        for (int k = 0; k < argument->count && !all->failed; k++)
            tokens_add(result, argument->items[k]);
    }
}

static void expand_call(Preprocessor *all, Token name, int index)
{
    Tokens arguments[ARGUMENTS] = {{0}}, result = {0};
    if (++all->depth > all->tree->limits.depth)
        preprocess_fail(all, name.place, "macros are nested more than %d deep",
                        all->tree->limits.depth);
    int count = read_arguments(all, name, arguments);
    const int wanted = all->macros[index].parameters;
    if (count == 1 && wanted == 0 && arguments[0].count == 0)
        count = 0;
    if (!all->failed && count != wanted)
        preprocess_fail(all, name.place, "macro %.*s takes %d argument%s, not %d",
                        name.length > 80 ? 80 : name.length, name.text, wanted,
                        wanted == 1 ? "" : "s", count);
    for (int i = 0; i < count && !all->failed; i++)
        arguments[i] = expand_all(all, arguments[i]);
    substitute(all, &all->macros[index], name.place, arguments, &result);
    for (int i = 0; i < ARGUMENTS; i++)
        free(arguments[i].items);
    all->depth--;
    push(all, result, index, false);
}

/* __LINE__ and such are numbers of their place. */
static void expand_number(Token *token, int number)
{
    token->kind = TOKEN_INT;
    token->name = number; /* see token_integer */
    token->length = 0;
}

static bool expand(Preprocessor *all, Token *token)
{
    const int index = token->kind == TOKEN_NAME ? all->names->items[token->name].macro : 0;
    if (!index || token->painted || all->failed)
        return false;
    Macro *macro = &all->macros[index];
    if (macro->number != NO_NUMBER) {
        expand_number(token, macro->number == LINE_NUMBER   ? token->place.line
                             : macro->number == FILE_NUMBER ? token->place.file
                                                            : macro->number);
        return false;
    }
    if (macro->active) {
        token->painted = true;
        return false;
    }
    if (macro->parameters < 0) {
        Tokens body = {0};
        substitute(all, macro, token->place, NULL, &body);
        push(all, body, index, false);
        return true;
    }
    Token after;
    next_raw(all, &after);
    if (after.kind != '(') {
        if (after.kind != TOKEN_END)
            push_back(all, after);
        return false;
    }
    expand_call(all, *token, index);
    return true;
}

static void predefine(Preprocessor *all, const char *name, int number)
{
    const int found = names_find(all->names, name, (int)strlen(name));
    all->names->items[found].macro = all->macro_count;
    *(Macro *)memory_add(&all->macros, &all->macro_count, &all->macro_room, sizeof(Macro)) =
        (Macro){.parameters = -1, .number = number};
}

static void predefine_all(Preprocessor *all)
{
    const GlslLimits *limits = &all->tree->limits;
    *(Macro *)memory_add(&all->macros, &all->macro_count, &all->macro_room, sizeof(Macro)) =
        (Macro){0};
    predefine(all, "__LINE__", LINE_NUMBER);
    predefine(all, "__FILE__", FILE_NUMBER);
    predefine(all, "__VERSION__", 100);
    predefine(all, "GL_ES", 1);
    if (!limits->no_highp)
        predefine(all, "GL_FRAGMENT_PRECISION_HIGH", 1);
    for (int i = 0; i < EXTENSION_COUNT; i++)
        if (limits->extensions & EXTENSIONS[i].bit)
            predefine(all, EXTENSIONS[i].name, 1);
    all->predefined = all->macro_count;
}

bool preprocess(GlslTree *tree, Names *names, const char *text, Tokens *tokens,
                GlslMessage *message)
{
    Preprocessor all = {.tree = tree, .names = names, .message = message, .fresh = true};
    all.lexer = (Lexer){.at = text, .line_start = text, .line = 1};
    predefine_all(&all);
    for (;;) {
        Token *token =
            memory_add(&tokens->items, &tokens->count, &tokens->room, sizeof *tokens->items);
        next_raw(&all, token);
        if (token->kind != TOKEN_END && expand(&all, token)) {
            tokens->count--;
            continue;
        }
        if (tokens->count > tree->limits.tokens && token->kind != TOKEN_END)
            preprocess_fail(&all, token->place, "the shader has more than %d words and signs",
                            tree->limits.tokens);
        if (all.failed)
            *token = end_token(&all);
        if (token->kind == TOKEN_END)
            break;
    }
    while (all.source_count)
        pop(&all);
    for (int i = 0; i < all.macro_count; i++)
        free(all.macros[i].body.items);
    free(all.macros);
    free(all.sources);
    free(all.conditions);
    return !all.failed;
}
