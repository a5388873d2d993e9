/* Characters to tokens. */
#include "glsl/glsl_preprocess.h"

#include "base/memory.h"
#include "base/text.h"

#include <stdlib.h>
#include <string.h>

enum { HASHES = 4096 };

void names_open(Names *names)
{
    *names = (Names){.hashed = memory_new(HASHES, sizeof(int))};
    *(Name *)memory_add(&names->items, &names->count, &names->room, sizeof(Name)) = (Name){0};
}

void names_copy(Names *names, const Names *from)
{
    *names = *from;
    names->items = memory_grow(NULL, (size_t)from->room, sizeof(Name));
    memcpy(names->items, from->items, (size_t)from->count * sizeof(Name));
    names->hashed = memory_copy(from->hashed, HASHES * sizeof(int));
}

void names_close(Names *names)
{
    free(names->items);
    free(names->hashed);
    *names = (Names){0};
}

int names_find(Names *names, const char *text, int length)
{
    unsigned hash = 2166136261u; /* FNV-1a */
    for (int i = 0; i < length; i++)
        hash = (hash ^ (unsigned char)text[i]) * 16777619u;
    int *first = &names->hashed[(hash ^ hash >> 15) % HASHES];
    for (int i = *first; i; i = names->items[i].next)
        if (names->items[i].length == length &&
            memcmp(names->items[i].text, text, (size_t)length) == 0)
            return i;
    *(Name *)memory_add(&names->items, &names->count, &names->room, sizeof(Name)) =
        (Name){.text = text, .length = length, .next = *first};
    *first = names->count - 1;
    return *first;
}

static bool is_end(char c)
{
    return c == '\n' || c == '\r';
}

/* Carriage return and line feed together are one end. */
static void next_line(Lexer *lexer)
{
    const char c = *lexer->at++;
    if (is_end(*lexer->at) && *lexer->at != c)
        lexer->at++;
    lexer->line++;
    lexer->line_start = lexer->at;
}

static void skip_comment(Lexer *lexer)
{
    lexer->comment = lexer->line;
    const bool block = lexer->at[1] == '*';
    for (lexer->at += 2; *lexer->at;)
        if (block && lexer->at[0] == '*' && lexer->at[1] == '/') {
            lexer->at += 2;
            return;
        } else if (is_end(*lexer->at)) {
            if (!block)
                return;
            next_line(lexer);
        } else {
            lexer->at++;
        }
    lexer->unended = block;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static int lex_number(const char *text, unsigned char *kind)
{
    int n = 0;
    *kind = TOKEN_INT;
    if (text[0] == '0' && (text[1] == 'x' || text[1] == 'X')) {
        n = 2 + (int)strspn(text + 2, "0123456789abcdefABCDEF");
        *kind = n > 2 ? TOKEN_INT : TOKEN_BAD;
    } else {
        while (is_digit(text[n]))
            n++;
        if (text[n] == '.') {
            *kind = TOKEN_FLOAT;
            for (n++; is_digit(text[n]);)
                n++;
        }
        const int sign =
            text[n] && strchr("eE", text[n]) && text[n + 1] && strchr("+-", text[n + 1]);
        if (text[n] && strchr("eE", text[n]) && is_digit(text[n + 1 + sign])) {
            *kind = TOKEN_FLOAT;
            for (n += 1 + sign; is_digit(text[n]);)
                n++;
        }
        if (*kind == TOKEN_INT && text[0] == '0' && (int)strspn(text, "01234567") < n)
            *kind = TOKEN_BAD;
    }
    if (text_is_word(text[n]))
        *kind = TOKEN_BAD;
    while (text_is_word(text[n]))
        n++;
    return n;
}

static int lex_operator(const char *text, unsigned char *kind)
{
    static const struct {
        char text[4];
        unsigned char kind;
    } LONG[] = {{"<<=", TOKEN_LATER},    {">>=", TOKEN_LATER},     {"<<", TOKEN_LEFT},
                {">>", TOKEN_RIGHT},     {"<=", TOKEN_LESS_EQUAL}, {">=", TOKEN_GREATER_EQUAL},
                {"==", TOKEN_EQUAL},     {"!=", TOKEN_NOT_EQUAL},  {"&&", TOKEN_AND},
                {"||", TOKEN_OR},        {"^^", TOKEN_XOR},        {"++", TOKEN_INCREMENT},
                {"--", TOKEN_DECREMENT}, {"+=", TOKEN_ADD},        {"-=", TOKEN_SUBTRACT},
                {"*=", TOKEN_MULTIPLY},  {"/=", TOKEN_DIVIDE},     {"%=", TOKEN_LATER},
                {"&=", TOKEN_LATER},     {"|=", TOKEN_LATER},      {"^=", TOKEN_LATER}};
    for (size_t i = 0; i < sizeof LONG / sizeof LONG[0]; i++)
        if (text[0] == LONG[i].text[0] && text[1] == LONG[i].text[1] &&
            strncmp(text, LONG[i].text, strlen(LONG[i].text)) == 0) {
            *kind = LONG[i].kind;
            return (int)strlen(LONG[i].text);
        }
    *kind = strchr(".+-/*%<>[](){}^|&~=!:;,?#", text[0]) ? (unsigned char)text[0] : TOKEN_BAD;
    return 1;
}

/* Blanks and comments; whether there are some. */
static bool skip_space(Lexer *lexer)
{
    const char *start = lexer->at;
    for (;;)
        if (*lexer->at == ' ' || *lexer->at == '\t' || *lexer->at == '\v' || *lexer->at == '\f')
            lexer->at++;
        else if (lexer->at[0] == '/' && (lexer->at[1] == '/' || lexer->at[1] == '*'))
            skip_comment(lexer);
        else
            return lexer->at > start;
}

void lexer_next(Lexer *lexer, Names *names, Token *token)
{
    const bool spaced = skip_space(lexer);
    *token = (Token){.text = lexer->at, .length = 1, .kind = TOKEN_END, .spaced = spaced};
    token->place = (GlslPlace){lexer->file, lexer->line, (int)(lexer->at - lexer->line_start) + 1};
    if (!*lexer->at)
        return;
    if (is_end(*lexer->at)) {
        token->kind = TOKEN_LINE;
        next_line(lexer);
        return;
    }
    if (is_digit(*lexer->at) || (*lexer->at == '.' && is_digit(lexer->at[1]))) {
        token->length = lex_number(lexer->at, &token->kind);
    } else if (text_is_word(*lexer->at)) {
        int length = 1;
        while (text_is_word(lexer->at[length]))
            length++;
        token->length = length;
        token->kind = TOKEN_NAME;
        token->name = names_find(names, lexer->at, length);
    } else {
        token->length = lex_operator(lexer->at, &token->kind);
    }
    lexer->at += token->length;
}

/* What a macro of a number expands to has no text, but is the number of its name. */
long long token_integer(const Token *token)
{
    if (!token->length)
        return token->name;
    const unsigned long long value = strtoull(token->text, NULL, 0);
    return value > 0xFFFFFFFFu ? -1 : (long long)value;
}
