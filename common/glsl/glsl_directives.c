/* Directives, and what they leave of the text. */
#include "glsl/glsl_preprocess.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

const Extension EXTENSIONS[EXTENSION_COUNT] = {
    {"GL_OES_standard_derivatives", GLSL_DERIVATIVES},
    {"GL_EXT_shader_texture_lod", GLSL_TEXTURE_LOD},
    {"GL_EXT_frag_depth", GLSL_FRAG_DEPTH},
};

/* For "%.*s". */
static int shown(const Token *token)
{
    return token->length < 80 ? token->length : 80;
}

static bool is(const Token *token, const char *word)
{
    return (size_t)token->length == strlen(word) && strncmp(token->text, word, strlen(word)) == 0;
}

static bool reading(const Preprocessor *all)
{
    return !all->condition_count || all->conditions[all->condition_count - 1].read;
}

static Tokens read_line(Preprocessor *all)
{
    Tokens line = {0};
    for (;;) {
        Token token;
        lexer_next(&all->lexer, all->names, &token);
        if (token.kind == TOKEN_LINE || token.kind == TOKEN_END) {
            token.kind = TOKEN_END;
            tokens_add(&line, token);
            return line;
        }
        if (line.count < all->tree->limits.tokens)
            tokens_add(&line, token);
        if (token.kind == TOKEN_BAD && token.text[0] == '\\' && reading(all))
            preprocess_fail(all, token.place,
                            "GLSL ES 1.00 cannot continue a line by \\: write it "
                            "as one line");
    }
}

static void nothing_after(Preprocessor *all, const Token *token)
{
    if (token->kind != TOKEN_END)
        preprocess_fail(all, token->place, "%.*s: nothing may follow on this line", shown(token),
                        token->text);
}

static bool reserved(Preprocessor *all, const Token *name)
{
    const int macro = all->names->items[name->name].macro;
    if (name->kind != TOKEN_NAME)
        preprocess_fail(all, name->place, "a name must follow");
    else if ((macro && macro < all->predefined) || is(name, "defined") ||
             strncmp(name->text, "GL_", 3) == 0)
        preprocess_fail(all, name->place, "%.*s is the language's own name: choose another",
                        shown(name), name->text);
    for (int i = 0; i + 1 < name->length && !all->failed; i++)
        if (name->text[i] == '_' && name->text[i + 1] == '_')
            preprocess_fail(all, name->place, "%.*s: names with __ are reserved: choose another",
                            shown(name), name->text);
    return all->failed;
}

/* From after the opening parenthesis; the place after the closing one. */
static int read_parameters(Preprocessor *all, const Tokens *line, Macro *macro, int *names)
{
    int at = 3;
    macro->parameters = 0;
    if (line->items[at].kind == ')')
        return at + 1;
    for (;; at++) {
        const Token *name = &line->items[at++];
        bool twice = false;
        for (int i = 0; i < macro->parameters; i++)
            twice |= names[i] == name->name;
        if (name->kind != TOKEN_NAME || twice || macro->parameters == 64) {
            preprocess_fail(all, name->place,
                            "the macro's parameters must be different names, 64 at most");
            return at;
        }
        names[macro->parameters++] = name->name;
        if (line->items[at].kind == ')')
            return at + 1;
        if (line->items[at].kind != ',') {
            preprocess_fail(all, line->items[at].place,
                            "a comma or the closing parenthesis is missing");
            return at;
        }
    }
}

static bool same_macro(const Macro *a, const Macro *b)
{
    if (a->parameters != b->parameters || a->body.count != b->body.count)
        return false;
    for (int i = 0; i < a->body.count; i++) {
        const Token *x = &a->body.items[i], *y = &b->body.items[i];
        if (x->kind != y->kind || x->name != y->name || x->length != y->length ||
            (i && x->spaced != y->spaced) || strncmp(x->text, y->text, (size_t)x->length) != 0)
            return false;
    }
    return true;
}

static void define(Preprocessor *all, const Tokens *line)
{
    const Token *name = &line->items[1];
    Macro macro = {.parameters = -1, .number = NO_NUMBER};
    int at = 2, names[64];
    if (reserved(all, name))
        return;
    if (line->items[2].kind == '(' && !line->items[2].spaced)
        at = read_parameters(all, line, &macro, names);
    for (; at < line->count - 1 && !all->failed; at++) {
        Token token = line->items[at];
        for (int i = 0; i < macro.parameters; i++)
            if (token.kind == TOKEN_NAME && token.name == names[i]) {
                token.kind = TOKEN_PARAMETER;
                token.name = i;
            }
        tokens_add(&macro.body, token);
    }
    int *old = &all->names->items[name->name].macro;
    if (*old && !same_macro(&all->macros[*old], &macro))
        preprocess_fail(all, name->place,
                        "macro %.*s is defined already, as something else: #undef it first",
                        shown(name), name->text);
    if (*old || all->failed) {
        free(macro.body.items);
        return;
    }
    *old = all->macro_count;
    *(Macro *)memory_add(&all->macros, &all->macro_count, &all->macro_room, sizeof macro) = macro;
}

/* The line from its second token on, with `defined NAME` replaced. */
static Tokens replace_defined(Preprocessor *all, const Tokens *line)
{
    static const char *const TEXT[] = {"0", "1"};
    Tokens result = {0};
    for (int i = 1; i < line->count - 1; i++) {
        Token token = line->items[i];
        if (token.kind == TOKEN_NAME && is(&token, "defined")) {
            const bool closed = line->items[i + 1].kind == '(';
            const Token *name = &line->items[i + 1 + closed];
            if (name->kind != TOKEN_NAME || (closed && name[1].kind != ')')) {
                preprocess_fail(all, token.place, "write defined NAME or defined(NAME)");
                break;
            }
            token.kind = TOKEN_INT;
            token.text = TEXT[all->names->items[name->name].macro != 0];
            token.length = 1;
            i += closed ? 3 : 1;
        }
        tokens_add(&result, token);
    }
    return result;
}

static bool holds(Preprocessor *all, const Tokens *line)
{
    Tokens tokens = preprocess_line(all, replace_defined(all, line));
    tokens_add(&tokens, line->items[line->count - 1]);
    Condition condition = {.tokens = tokens.items};
    const bool value = !all->failed && condition_holds(&condition);
    if (condition.error)
        preprocess_fail(all, line->items[0].place, "#%.*s: %s", shown(&line->items[0]),
                        line->items[0].text, condition.error);
    free(tokens.items);
    return value;
}

static void begin_group(Preprocessor *all, const Tokens *line)
{
    const bool outer = reading(all);
    const Token *word = &line->items[0], *name = &line->items[1];
    Group group = {.place = word->place, .done = !outer};
    if (outer && is(word, "if")) {
        group.read = holds(all, line);
    } else if (outer) {
        if (name->kind != TOKEN_NAME)
            preprocess_fail(all, word->place, "#%.*s: a name must follow", shown(word), word->text);
        else
            nothing_after(all, name + 1);
        group.read = (all->names->items[name->name].macro != 0) == is(word, "ifdef");
    }
    group.done |= group.read;
    if (all->condition_count >= all->tree->limits.depth)
        preprocess_fail(all, word->place, "#if is nested more than %d deep",
                        all->tree->limits.depth);
    *(Group *)memory_add(&all->conditions, &all->condition_count, &all->condition_room,
                         sizeof group) = group;
}

static void next_group(Preprocessor *all, const Tokens *line)
{
    const Token *word = &line->items[0];
    if (!all->condition_count) {
        preprocess_fail(all, word->place, "#%.*s without an #if before", shown(word), word->text);
        return;
    }
    Group *group = &all->conditions[all->condition_count - 1];
    if (group->last && !is(word, "endif"))
        preprocess_fail(all, word->place, "#%.*s after #else", shown(word), word->text);
    if (is(word, "elif")) {
        group->read = !group->done && holds(all, line);
        group->done |= group->read;
        return;
    }
    nothing_after(all, word + 1);
    group->read = !group->done;
    group->done = group->last = true;
    if (is(word, "endif"))
        all->condition_count--;
}

static void set_line(Preprocessor *all, const Tokens *written)
{
    Tokens rest = {0};
    for (int i = 1; i < written->count - 1; i++)
        tokens_add(&rest, written->items[i]);
    Tokens line = preprocess_line(all, rest);
    bool good = line.count == 1 || line.count == 2;
    long long number[2] = {0, all->lexer.file};
    for (int i = 0; i < line.count && good; i++) {
        good = line.items[i].kind == TOKEN_INT;
        number[i] = good ? token_integer(&line.items[i]) : 0;
        good &= number[i] >= 0 && number[i] < 2000000000;
    }
    if (!good)
        preprocess_fail(all, written->items[0].place,
                        "#line takes the next line's number, and perhaps a file's");
    all->lexer.line = (int)number[0];
    all->lexer.file = (int)number[1];
    free(line.items);
}

static void extension(Preprocessor *all, const Tokens *line)
{
    static const char *const BEHAVIOURS[] = {"require", "enable", "warn", "disable"};
    const Token *name = &line->items[1];
    int behaviour = -1, bit = 0;
    if (line->count == 5 && line->items[2].kind == ':')
        for (int i = 0; i < 4; i++)
            if (is(&line->items[3], BEHAVIOURS[i]))
                behaviour = i;
    const bool every = name->kind == TOKEN_NAME && is(name, "all");
    for (int i = 0; i < EXTENSION_COUNT; i++)
        if (every || is(name, EXTENSIONS[i].name))
            bit |= EXTENSIONS[i].bit & all->tree->limits.extensions;
    if (name->kind != TOKEN_NAME || behaviour < 0)
        preprocess_fail(all, line->items[0].place,
                        "write #extension NAME : enable (or require, warn, disable)");
    else if (every && behaviour < 2)
        preprocess_fail(all, name->place, "#extension all takes only warn and disable");
    else if (!bit && behaviour == 0)
        preprocess_fail(all, name->place, "there is no extension %.*s here", shown(name),
                        name->text);
    else if (behaviour == 3)
        all->tree->extensions &= ~bit;
    else
        all->tree->extensions |= bit;
}

static void version(Preprocessor *all, const Tokens *line)
{
    const Token *number = &line->items[1];
    if (all->started)
        preprocess_fail(all, line->items[0].place,
                        "#version must be the first line: only comments may be before it");
    else if (line->count != 3 || number->kind != TOKEN_INT || strtol(number->text, NULL, 0) != 100)
        preprocess_fail(all, line->items[0].place,
                        "only #version 100: remove the line, or write that");
}

/* #pragma STDGL invariant(all); others are none of ours. */
static void pragma(Preprocessor *all, const Tokens *line)
{
    if (line->count == 7 && is(&line->items[1], "STDGL") && is(&line->items[2], "invariant") &&
        is(&line->items[4], "all"))
        all->tree->invariant = true;
}

static void directive(Preprocessor *all)
{
    Tokens line = read_line(all);
    /* What is skipped is read for its #endif alone: `# #endif` is one to all compilers. */
    while (!reading(all) && line.items[0].kind == '#')
        memmove(line.items, line.items + 1, (size_t)--line.count * sizeof *line.items);
    const Token *word = &line.items[0];
    const bool named = word->kind == TOKEN_NAME;
    if (named && (is(word, "if") || is(word, "ifdef") || is(word, "ifndef")))
        begin_group(all, &line);
    else if (named && (is(word, "elif") || is(word, "else") || is(word, "endif")))
        next_group(all, &line);
    else if (!reading(all) || word->kind == TOKEN_END)
        ;
    else if (is(word, "define"))
        define(all, &line);
    else if (is(word, "undef")) {
        if (!reserved(all, &line.items[1])) {
            nothing_after(all, &line.items[2]);
            all->names->items[line.items[1].name].macro = 0;
        }
    } else if (is(word, "line"))
        set_line(all, &line);
    else if (is(word, "extension"))
        extension(all, &line);
    else if (is(word, "version"))
        version(all, &line);
    else if (is(word, "pragma"))
        pragma(all, &line);
    else if (is(word, "error"))
        preprocess_fail(all, word->place, "#error%.*s",
                        (int)(line.items[line.count - 1].text - word->text) - 5, word->text + 5);
    else
        preprocess_fail(all, word->place, "there is no directive #%.*s", shown(word), word->text);
    all->started = true;
    free(line.items);
}

void preprocess_text(Preprocessor *all, Token *token)
{
    for (;;) {
        lexer_next(&all->lexer, all->names, token);
        if (token->kind == TOKEN_END) {
            if (all->lexer.unended)
                preprocess_fail(all, (GlslPlace){all->lexer.file, all->lexer.comment, 1},
                                "a comment that begins with /* does not end with */");
            if (all->condition_count)
                preprocess_fail(all, all->conditions[all->condition_count - 1].place,
                                "this #if has no #endif");
            return;
        }
        if (token->kind == TOKEN_LINE) {
            all->fresh = true;
        } else if (token->kind == '#' && all->fresh) {
            directive(all);
            if (all->failed) {
                *token = (Token){.kind = TOKEN_END, .text = "", .place = token->place};
                return;
            }
        } else {
            all->fresh = false;
            if (reading(all)) {
                all->started = all->said = true;
                return;
            }
        }
    }
}
