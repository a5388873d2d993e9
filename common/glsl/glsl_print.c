/* A tree as text, with as few parentheses as its meaning allows. */
#include "glsl/glsl.h"

#include "base/memory.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Printer {
    const GlslTree *tree;
    char *text;
    int used, room, indent;
    int limit; /* of what is needed; 0: all */
} Printer;

static const char *const OPERATORS[] = {[GLSL_SET] = "=",
                                        [GLSL_ADD] = "+",
                                        [GLSL_SUBTRACT] = "-",
                                        [GLSL_MULTIPLY] = "*",
                                        [GLSL_DIVIDE] = "/",
                                        [GLSL_LESS] = "<",
                                        [GLSL_GREATER] = ">",
                                        [GLSL_LESS_EQUAL] = "<=",
                                        [GLSL_GREATER_EQUAL] = ">=",
                                        [GLSL_EQUAL] = "==",
                                        [GLSL_NOT_EQUAL] = "!=",
                                        [GLSL_AND] = "&&",
                                        [GLSL_OR] = "||",
                                        [GLSL_XOR] = "^^",
                                        [GLSL_COMMA] = ",",
                                        [GLSL_PLUS] = "+",
                                        [GLSL_MINUS] = "-",
                                        [GLSL_NOT] = "!",
                                        [GLSL_PRE_INCREMENT] = "++",
                                        [GLSL_PRE_DECREMENT] = "--",
                                        [GLSL_POST_INCREMENT] = "++",
                                        [GLSL_POST_DECREMENT] = "--"};
static const char *const PRECISIONS[] = {"", "lowp ", "mediump ", "highp "};
static const char *const STORAGES[] = {"",         "const ", "attribute ", "uniform ",
                                       "varying ", "",       "out ",       "inout "};

static void add(Printer *printer, const char *text, size_t length)
{
    if (length >= (size_t)(printer->room - printer->used)) {
        printer->room = 2 * (printer->used + (int)length + 1);
        printer->text = memory_grow(printer->text, (size_t)printer->room, 1);
    }
    memcpy(printer->text + printer->used, text, length);
    printer->used += (int)length;
    printer->text[printer->used] = '\0';
}

/* As printf, which takes five times as long, of %s alone. */
static void put(Printer *printer, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void put(Printer *printer, const char *format, ...)
{
    va_list strings;
    va_start(strings, format);
    for (const char *at = format;; at += 2) {
        size_t plain = 0;
        while (at[plain] && at[plain] != '%')
            plain++;
        add(printer, at, plain);
        at += plain;
        if (!*at)
            break;
        const char *string = va_arg(strings, const char *);
        add(printer, string, strlen(string));
    }
    va_end(strings);
}

static const GlslNode *at(const Printer *printer, int node)
{
    return &printer->tree->nodes[node];
}

/* How tightly an expression binds, as in the specification's table, the tightest first. */
static int strength(const GlslNode *node)
{
    static const int BINARY[] = {
        [GLSL_ADD] = 5,   [GLSL_SUBTRACT] = 5,  [GLSL_MULTIPLY] = 4,   [GLSL_DIVIDE] = 4,
        [GLSL_LESS] = 7,  [GLSL_GREATER] = 7,   [GLSL_LESS_EQUAL] = 7, [GLSL_GREATER_EQUAL] = 7,
        [GLSL_EQUAL] = 8, [GLSL_NOT_EQUAL] = 8, [GLSL_AND] = 12,       [GLSL_XOR] = 13,
        [GLSL_OR] = 14,   [GLSL_COMMA] = 17};
    /* clang-format off */
    switch (node->kind) {
    case GLSL_UNARY: return node->op >= GLSL_POST_INCREMENT ? 2 : 3;
    case GLSL_BINARY: return BINARY[node->op];
    case GLSL_CONDITIONAL: return 15;
    case GLSL_ASSIGN: return 16;
    default: return 2;
    }
    /* clang-format on */
}

static void expression(Printer *printer, int node, int weakest);

static void put_number(Printer *printer, const GlslNode *node)
{
    const double value = printer->tree->values[node->value];
    char text[64] = "1e999";
    if (node->type == GLSL_BOOL) {
        strcpy(text, value != 0 ? "true" : "false");
    } else if (node->type == GLSL_INT && value < 0) {
        /* As it was written: literals have no sign. */
        snprintf(text, sizeof text, "0x%x", (unsigned)(int)value);
    } else if (node->type == GLSL_INT) {
        snprintf(text, sizeof text, "%.0f", value);
    } else if (!isinf(value)) {
        int digits = 1;
        do
            snprintf(text, sizeof text, "%.*g", digits, value);
        while (strtod(text, NULL) != value && ++digits <= 17);
        strcat(text, strpbrk(text, ".e") ? "" : ".0");
    }
    put(printer, "%s", text);
}

static void arguments(Printer *printer, const GlslNode *node)
{
    put(printer, "(");
    for (int i = node->first; i; i = at(printer, i)->next) {
        expression(printer, i, 16);
        if (at(printer, i)->next)
            put(printer, ", ");
    }
    put(printer, ")");
}

static void unary(Printer *printer, const GlslNode *node)
{
    const GlslNode *operand = at(printer, node->first);
    if (node->op >= GLSL_POST_INCREMENT) {
        expression(printer, node->first, 2);
        put(printer, "%s", OPERATORS[node->op]);
        return;
    }
    put(printer, "%s", OPERATORS[node->op]);
    /* - -x is not --x. */
    const bool sign = node->op != GLSL_NOT && operand->kind == GLSL_UNARY &&
                      operand->op < GLSL_POST_INCREMENT && operand->op != GLSL_NOT;
    put(printer, "%s", sign ? " " : "");
    expression(printer, node->first, 3);
}

static void part(Printer *printer, const GlslNode *node)
{
    const GlslNode *base = at(printer, node->first);
    expression(printer, node->first, 2);
    if (node->kind == GLSL_SWIZZLE) {
        put(printer, ".");
        for (int i = 0; i < glsl_swizzle_count(node->op); i++)
            add(printer, &"xyzwrgbastpq"[4 * (node->op >> 14) + glsl_swizzle(node->op, i)], 1);
    } else if (node->kind == GLSL_FIELD) {
        const GlslType *type = &printer->tree->types[base->type];
        put(printer, ".%s",
            node->symbol < type->fields ? printer->tree->fields[type->field + node->symbol].name
                                        : "?");
    } else {
        put(printer, "[");
        expression(printer, base->next, 17);
        put(printer, "]");
    }
}

static void put_binary(Printer *printer, const GlslNode *node)
{
    const bool assigns = node->kind == GLSL_ASSIGN, comma = !assigns && node->op == GLSL_COMMA;
    const int own = strength(node);
    expression(printer, node->first, assigns ? 3 : own);
    put(printer, "%s%s%s ", comma ? "" : " ", OPERATORS[node->op],
        assigns && node->op != GLSL_SET ? "=" : "");
    expression(printer, at(printer, node->first)->next, assigns ? own : own - 1);
}

static void bare(Printer *printer, int index)
{
    const GlslNode *node = at(printer, index);
    const GlslTree *tree = printer->tree;
    switch (node->kind) {
    case GLSL_LITERAL:
        put_number(printer, node);
        break;
    case GLSL_UNARY:
        unary(printer, node);
        break;
    case GLSL_BINARY:
    case GLSL_ASSIGN:
        put_binary(printer, node);
        break;
    case GLSL_CONDITIONAL:
        expression(printer, glsl_child(tree, index, 0), 14);
        put(printer, " ? ");
        expression(printer, glsl_child(tree, index, 1), 17);
        put(printer, " : ");
        expression(printer, glsl_child(tree, index, 2), 16);
        break;
    case GLSL_INDEX:
    case GLSL_FIELD:
    case GLSL_SWIZZLE:
        part(printer, node);
        break;
    case GLSL_CALL:
    case GLSL_NAME:
        put(printer, "%s",
            tree->symbols[node->symbol].name[0] ? tree->symbols[node->symbol].name : "?");
        break;
    case GLSL_BUILT_IN:
        put(printer, "%s", GLSL_FUNCTIONS[node->symbol].name);
        break;
    case GLSL_CONSTRUCT:
        put(printer, "%s", tree->types[node->type].name);
        break;
    default:
        break;
    }
    if (node->kind == GLSL_CALL || node->kind == GLSL_BUILT_IN || node->kind == GLSL_CONSTRUCT)
        arguments(printer, node);
}

static void expression(Printer *printer, int node, int weakest)
{
    if (printer->limit && printer->used > printer->limit)
        return;
    const bool closed = strength(at(printer, node)) > weakest;
    put(printer, "%s", closed ? "(" : "");
    bare(printer, node);
    put(printer, "%s", closed ? ")" : "");
}

static void line(Printer *printer)
{
    put(printer, "\n");
    for (int i = 0; i < printer->indent; i++)
        put(printer, "    ");
}

/* "vec3 name[4]". */
static void put_declared(Printer *printer, int type, const char *name)
{
    const GlslType *of = &printer->tree->types[type];
    put(printer, "%s", name);
    if (of->element) {
        char length[16];
        snprintf(length, sizeof length, "[%d]", of->length);
        put(printer, "%s", length);
    }
}

static void put_struct(Printer *printer, int symbol)
{
    const GlslTree *tree = printer->tree;
    const GlslType *type = &tree->types[tree->symbols[symbol].type];
    put(printer, "struct%s%s {", type->name[0] ? " " : "", type->name);
    printer->indent++;
    for (int i = 0; i < type->fields; i++) {
        const GlslField *field = &tree->fields[type->field + i];
        line(printer);
        put(printer, "%s%s ", PRECISIONS[field->said], tree->types[field->type].name);
        put_declared(printer, field->type, field->name);
        put(printer, ";");
    }
    printer->indent--;
    line(printer);
    put(printer, "}");
}

/* Of a declaration, the qualifiers are those of its first variable. */
static void declaration(Printer *printer, const GlslNode *node)
{
    const GlslTree *tree = printer->tree;
    const GlslSymbol *first = &tree->symbols[node->first ? at(printer, node->first)->symbol : 0];
    put(printer, "%s%s%s", node->first && node->op ? "invariant " : "", STORAGES[first->storage],
        PRECISIONS[first->said]);
    if (node->symbol)
        put_struct(printer, node->symbol);
    else
        put(printer, "%s", tree->types[node->type].name);
    for (int i = node->first; i; i = at(printer, i)->next) {
        const GlslNode *variable = at(printer, i);
        put(printer, "%s", i == node->first ? " " : ", ");
        put_declared(printer, variable->type, tree->symbols[variable->symbol].name);
        if (variable->first) {
            put(printer, " = ");
            expression(printer, variable->first, 16);
        }
    }
}

static void statement(Printer *printer, int index);

static void block(Printer *printer, int index)
{
    put(printer, "{");
    printer->indent++;
    for (int i = at(printer, index)->first; i; i = at(printer, i)->next) {
        line(printer);
        statement(printer, i);
    }
    printer->indent--;
    line(printer);
    put(printer, "}");
}

static void function(Printer *printer, const GlslNode *node)
{
    const GlslTree *tree = printer->tree;
    const GlslSymbol *symbol = &tree->symbols[node->symbol];
    put(printer, "%s%s %s(", PRECISIONS[symbol->said], tree->types[symbol->type].name,
        symbol->name);
    int i = node->first;
    for (; i && at(printer, i)->kind == GLSL_VARIABLE_NODE; i = at(printer, i)->next) {
        const GlslSymbol *parameter = &tree->symbols[at(printer, i)->symbol];
        put(printer, "%s%s%s%s", i == node->first ? "" : ", ", STORAGES[parameter->storage],
            PRECISIONS[parameter->said], tree->types[parameter->type].name);
        put(printer, "%s", parameter->name[0] ? " " : "");
        put_declared(printer, parameter->type, parameter->name);
    }
    put(printer, ")");
    if (i && at(printer, i)->kind == GLSL_BLOCK) {
        put(printer, "\n");
        block(printer, i);
    } else {
        put(printer, ";");
    }
}

/* Whether an else after this statement would belong to an if inside. */
static bool dangles(const GlslTree *tree, int node)
{
    for (;;) {
        const int kind = tree->nodes[node].kind;
        if (kind != GLSL_IF && kind != GLSL_FOR && kind != GLSL_WHILE)
            return false;
        const int last = glsl_child(tree, node, kind == GLSL_FOR ? 3 : kind == GLSL_WHILE ? 1 : 2);
        if (kind == GLSL_IF && tree->nodes[last].kind == GLSL_NOTHING)
            return true;
        node = last;
    }
}

static void put_if(Printer *printer, int index)
{
    const GlslTree *tree = printer->tree;
    const int then = glsl_child(tree, index, 1), otherwise = glsl_child(tree, index, 2);
    put(printer, "if (");
    expression(printer, glsl_child(tree, index, 0), 17);
    put(printer, ") ");
    const bool other = otherwise && at(printer, otherwise)->kind != GLSL_NOTHING;
    const bool closed = other && dangles(tree, then);
    put(printer, "%s", closed ? "{ " : "");
    statement(printer, then);
    put(printer, "%s", closed ? " }" : "");
    if (other) {
        put(printer, " else ");
        statement(printer, otherwise);
    }
}

static void condition(Printer *printer, int node)
{
    if (at(printer, node)->kind == GLSL_DECLARE)
        declaration(printer, at(printer, node));
    else if (at(printer, node)->kind != GLSL_NOTHING)
        expression(printer, node, 17);
}

static void loop(Printer *printer, int index)
{
    const GlslTree *tree = printer->tree;
    const int kind = at(printer, index)->kind;
    if (kind == GLSL_DO) {
        put(printer, "do ");
        statement(printer, glsl_child(tree, index, 0));
        put(printer, " while (");
        expression(printer, glsl_child(tree, index, 1), 17);
        put(printer, ");");
        return;
    }
    put(printer, "%s", kind == GLSL_FOR ? "for (" : "while (");
    if (kind == GLSL_FOR) {
        statement(printer, glsl_child(tree, index, 0));
        put(printer, " ");
        condition(printer, glsl_child(tree, index, 1));
        put(printer, "; ");
        condition(printer, glsl_child(tree, index, 2));
    } else {
        condition(printer, glsl_child(tree, index, 0));
    }
    put(printer, ") ");
    statement(printer, glsl_child(tree, index, kind == GLSL_FOR ? 3 : 1));
}

static void jump(Printer *printer, int index)
{
    static const char *const WORDS[] = {[GLSL_RETURN] = "return",
                                        [GLSL_BREAK] = "break",
                                        [GLSL_CONTINUE] = "continue",
                                        [GLSL_DISCARD] = "discard"};
    const GlslNode *node = at(printer, index);
    put(printer, "%s", WORDS[node->kind]);
    if (node->first && at(printer, node->first)->kind != GLSL_NOTHING) {
        put(printer, " ");
        expression(printer, node->first, 17);
    }
}

static void statement(Printer *printer, int index)
{
    const GlslNode *node = at(printer, index);
    const GlslTree *tree = printer->tree;
    switch (node->kind) {
    case GLSL_BLOCK:
        block(printer, index);
        break;
    case GLSL_IF:
        put_if(printer, index);
        break;
    case GLSL_FOR:
    case GLSL_WHILE:
    case GLSL_DO:
        loop(printer, index);
        break;
    case GLSL_RETURN:
    case GLSL_BREAK:
    case GLSL_CONTINUE:
    case GLSL_DISCARD:
        jump(printer, index);
        put(printer, ";");
        break;
    case GLSL_DECLARE:
        declaration(printer, node);
        put(printer, ";");
        break;
    case GLSL_EXPRESSION:
        condition(printer, node->first);
        put(printer, ";");
        break;
    case GLSL_FUNCTION_NODE:
        function(printer, node);
        break;
    case GLSL_PRECISION:
        put(printer, "precision %s%s;", PRECISIONS[node->precision], tree->types[node->type].name);
        break;
    case GLSL_INVARIANT:
        put(printer, "invariant %s;", tree->symbols[node->symbol].name);
        break;
    default:
        condition(printer, index);
    }
}

static void unit(Printer *printer, int index)
{
    static const char *const EXTENSIONS[] = {"GL_OES_standard_derivatives",
                                             "GL_EXT_shader_texture_lod", "GL_EXT_frag_depth"};
    put(printer, "#version 100\n");
    for (int i = 0; i < 3; i++)
        if (printer->tree->extensions & 1 << i)
            put(printer, "#extension %s : enable\n", EXTENSIONS[i]);
    put(printer, "%s", printer->tree->invariant ? "#pragma STDGL invariant(all)\n" : "");
    for (int i = at(printer, index)->first; i; i = at(printer, i)->next) {
        statement(printer, i);
        put(printer, "\n");
    }
}

char *glsl_print(const GlslTree *tree, int node)
{
    Printer printer = {.tree = tree};
    put(&printer, "%s", "");
    if (tree->nodes[node].kind == GLSL_UNIT)
        unit(&printer, node);
    else
        statement(&printer, node);
    return printer.text;
}

void glsl_expression_text(const GlslTree *tree, int node, char *text, size_t size)
{
    Printer printer = {.tree = tree, .limit = (int)size};
    const int kind = tree->nodes[node].kind;
    put(&printer, "%s", "");
    if (kind >= GLSL_RETURN && kind <= GLSL_DISCARD)
        jump(&printer, node);
    else
        expression(&printer, node, 17);
    if ((size_t)printer.used < size)
        memcpy(text, printer.text, (size_t)printer.used + 1);
    else
        snprintf(text, size, "%.*s...", (int)size - 4, printer.text);
    free(printer.text);
}
