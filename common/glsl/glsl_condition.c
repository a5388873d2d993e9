/* The expressions of #if: integers, by precedence. */
#include "glsl/glsl_preprocess.h"

enum { DEEPEST = 100, UNARY = 11 };

static long long value_of(Condition *condition, int precedence);

static long long fail(Condition *condition, const char *error)
{
    if (!condition->error)
        condition->error = error;
    return 0;
}

static int precedence_of(int kind)
{
    /* clang-format off */
    static const struct {
        unsigned char kind, precedence;
    } TABLE[] = {
        {TOKEN_OR, 1}, {TOKEN_AND, 2}, {'|', 3}, {'^', 4}, {'&', 5}, {TOKEN_EQUAL, 6},
        {TOKEN_NOT_EQUAL, 6}, {'<', 7}, {'>', 7}, {TOKEN_LESS_EQUAL, 7},
        {TOKEN_GREATER_EQUAL, 7}, {TOKEN_LEFT, 8}, {TOKEN_RIGHT, 8}, {'+', 9}, {'-', 9},
        {'*', 10}, {'/', 10}, {'%', 10}};
    /* clang-format on */
    for (size_t i = 0; i < sizeof TABLE / sizeof TABLE[0]; i++)
        if (TABLE[i].kind == kind)
            return TABLE[i].precedence;
    return 0;
}

static long long operand(Condition *condition)
{
    const Token *token = &condition->tokens[condition->at];
    if (token->kind == TOKEN_END)
        return fail(condition, "a value is missing");
    condition->at++;
    if (token->kind == TOKEN_INT)
        return (int)(unsigned)token_integer(token);
    if (token->kind == TOKEN_NAME)
        return condition->unused ? 0
                                 : fail(condition, "a name here must be a macro: ask #ifdef, or "
                                                   "defined(NAME) &&, first");
    if (token->kind == '(') {
        const long long value = value_of(condition, 1);
        if (condition->tokens[condition->at].kind != ')')
            return fail(condition, "a closing parenthesis is missing");
        condition->at++;
        return value;
    }
    /* clang-format off */
    switch (token->kind) {
    case '+': return value_of(condition, UNARY);
    case '-': return -value_of(condition, UNARY);
    case '~': return ~value_of(condition, UNARY);
    case '!': return !value_of(condition, UNARY);
    default: return fail(condition, "only integers, macros and their operators may stand here");
    }
    /* clang-format on */
}

/* In 32 bits, as the language's integers have. */
static long long apply(Condition *condition, int kind, long long a, long long b)
{
    if ((kind == '/' || kind == '%') && b == 0)
        return condition->unused ? 0 : fail(condition, "division by zero");
    /* clang-format off */
    switch (kind) {
    case TOKEN_OR: return a || b;
    case TOKEN_AND: return a && b;
    case '|': return a | b;
    case '^': return a ^ b;
    case '&': return a & b;
    case TOKEN_EQUAL: return a == b;
    case TOKEN_NOT_EQUAL: return a != b;
    case '<': return a < b;
    case '>': return a > b;
    case TOKEN_LESS_EQUAL: return a <= b;
    case TOKEN_GREATER_EQUAL: return a >= b;
    case TOKEN_LEFT: return (long long)((unsigned long long)a << (b & 31));
    case TOKEN_RIGHT: return a >> (b & 31);
    case '+': return a + b;
    case '-': return a - b;
    case '*': return a * b;
    case '/': return a / b;
    default: return a % b;
    }
    /* clang-format on */
}

static long long value_of(Condition *condition, int precedence)
{
    if (++condition->depth > DEEPEST)
        return fail(condition, "nested too deeply");
    long long value = operand(condition);
    for (;;) {
        const int kind = condition->tokens[condition->at].kind, own = precedence_of(kind);
        if (condition->error || !own || own < precedence)
            break;
        condition->at++;
        const bool known = kind == TOKEN_OR ? value != 0 : kind == TOKEN_AND && value == 0;
        condition->unused += known;
        const long long right = value_of(condition, own + 1);
        condition->unused -= known;
        value = (int)(unsigned)(unsigned long long)apply(condition, kind, value, right);
    }
    condition->depth--;
    return value;
}

bool condition_holds(Condition *condition)
{
    const long long value = value_of(condition, 1);
    if (condition->tokens[condition->at].kind != TOKEN_END)
        fail(condition, "an operator is missing");
    return value != 0;
}
