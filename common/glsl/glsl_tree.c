/* Making and reading the tree: nodes, types, symbols and the scopes they are in. */
#include "glsl/glsl_parser.h"

#include "base/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEEPEST = 1000 }; /* nodes in each other, so that recursions over the tree end */

GlslNode *node_at(const Parser *parser, int node)
{
    return &parser->tree->nodes[node];
}

int node_new(Parser *parser, int kind, int type, GlslPlace place)
{
    GlslTree *tree = parser->tree;
    *(GlslNode *)memory_add(&tree->nodes, &tree->node_count, &tree->node_room, sizeof(GlslNode)) =
        (GlslNode){.kind = (unsigned char)kind, .type = type, .place = place};
    return tree->node_count - 1;
}

void list_add(Parser *parser, List *list, int node)
{
    if (list->first)
        node_at(parser, list->last)->next = node;
    else
        list->first = node;
    list->last = node;
}

void set_children(Parser *parser, int node, List list)
{
    GlslNode *parent = node_at(parser, node);
    parent->first = list.first;
    for (int i = list.first; i; i = node_at(parser, i)->next)
        if (node_at(parser, i)->height >= parent->height)
            parent->height = (unsigned short)(node_at(parser, i)->height + 1);
    if (parent->height > DEEPEST && !parser->stopped) {
        complain(parser, parent->place, "this is nested more than %d deep", DEEPEST);
        parser->stopped = true;
    }
}

int values_new(GlslTree *tree, int count)
{
    const int first = tree->value_count;
    for (int i = 0; i < count; i++)
        *(double *)memory_add(&tree->values, &tree->value_count, &tree->value_room,
                              sizeof(double)) = 0;
    return first;
}

static int type_new(GlslTree *tree, GlslType type)
{
    *(GlslType *)memory_add(&tree->types, &tree->type_count, &tree->type_room, sizeof type) = type;
    return tree->type_count - 1;
}

static void add_types(Parser *parser)
{
    GlslTree *tree = parser->tree;
    type_new(tree, (GlslType){.name = "?"});
    for (int i = 1; i < GLSL_TYPES; i++)
        type_new(tree, (GlslType){.name = keep_name(parser, i),
                                  .scalars = glsl_is_matrix(i) ? glsl_size(i) * glsl_size(i)
                                                               : glsl_size(i),
                                  .sampler = i == GLSL_SAMPLER_2D || i == GLSL_SAMPLER_CUBE});
}

/* Linear: texts have few types. The last are searched first, and of many only those. */
int type_array(GlslTree *tree, int element, int length)
{
    for (int i = tree->type_count - 1; i >= GLSL_TYPES && i > tree->type_count - 64; i--)
        if (tree->types[i].element == element && tree->types[i].length == length)
            return i;
    const GlslType of = tree->types[element];
    const long long scalars = (long long)of.scalars * length;
    return type_new(tree, (GlslType){.name = of.name,
                                     .element = element,
                                     .length = length,
                                     .scalars = scalars < 1000000000 ? (int)scalars : 1000000000,
                                     .array = true,
                                     .sampler = of.sampler});
}

int type_struct(GlslTree *tree, const char *name)
{
    return type_new(tree, (GlslType){.name = name, .field = tree->field_count});
}

void type_add_field(GlslTree *tree, int type, const char *name, int field, int precision)
{
    *(GlslField *)memory_add(&tree->fields, &tree->field_count, &tree->field_room,
                             sizeof(GlslField)) =
        (GlslField){.name = name, .type = field, .precision = (unsigned char)precision};
    const GlslType *part = &tree->types[field];
    GlslType *whole = &tree->types[type];
    whole->fields++;
    whole->array |= part->array;
    whole->sampler |= part->sampler;
    const long long scalars = (long long)whole->scalars + part->scalars;
    whole->scalars = scalars < 1000000000 ? (int)scalars : 1000000000;
}

const char *keep_name(Parser *parser, int name)
{
    Name *item = &parser->names.items[name];
    GlslTree *tree = parser->tree;
    if (!item->kept) {
        char *text = memory_copy(item->text, (size_t)item->length);
        *(char **)memory_add(&tree->texts, &tree->text_count, &tree->text_room, sizeof text) = text;
        item->kept = text;
    }
    return item->kept;
}

Scope scope_open(Parser *parser)
{
    Scope outer = {.scope = parser->scope};
    memcpy(outer.precisions, parser->precisions, sizeof outer.precisions);
    parser->scope = parser->declared_count;
    return outer;
}

void scope_close(Parser *parser, Scope outer)
{
    GlslTree *tree = parser->tree;
    while (parser->declared_count > parser->scope) {
        const GlslSymbol *symbol = &tree->symbols[parser->declared[--parser->declared_count]];
        parser->names.items[symbol->id].symbol = symbol->hidden;
    }
    parser->scope = outer.scope;
    memcpy(parser->precisions, outer.precisions, sizeof outer.precisions);
}

int symbol_of(const Parser *parser, int name)
{
    return parser->names.items[name].symbol;
}

int symbol_new(Parser *parser, int name, GlslPlace place, int kind)
{
    GlslTree *tree = parser->tree;
    const char *text = name ? keep_name(parser, name) : "";
    *(GlslSymbol *)memory_add(&tree->symbols, &tree->symbol_count, &tree->symbol_room,
                              sizeof(GlslSymbol)) =
        (GlslSymbol){.name = text, .id = name, .place = place, .kind = kind};
    return tree->symbol_count - 1;
}

int symbol_bind(Parser *parser, int symbol)
{
    GlslSymbol *bound = &parser->tree->symbols[symbol];
    if (bound->id) {
        bound->hidden = symbol_of(parser, bound->id);
        bound->position = parser->declared_count;
        parser->names.items[bound->id].symbol = symbol;
        *(int *)memory_add(&parser->declared, &parser->declared_count, &parser->declared_room,
                           sizeof(int)) = symbol;
    }
    return symbol;
}

bool name_is_free(Parser *parser, const Token *token)
{
    const char *name = keep_name(parser, token->name);
    const int old = symbol_of(parser, token->name);
    if (strncmp(name, "gl_", 3) == 0)
        complain(parser, token->place, "%.80s: names with gl_ are the language's: choose another",
                 name);
    else if (strstr(name, "__"))
        complain(parser, token->place, "%.80s: names with __ are reserved: choose another", name);
    else if (old && parser->tree->symbols[old].position >= parser->scope)
        complain(parser, token->place,
                 "%.80s is declared twice, first in line %d: remove one, or only its type", name,
                 parser->tree->symbols[old].place.line);
    else
        return true;
    return false;
}

const char *glsl_type_text(const GlslTree *tree, int type, char text[64])
{
    const GlslType *of = &tree->types[type];
    if (of->element)
        snprintf(text, 64, "%.40s[%d]", of->name, of->length);
    else
        snprintf(text, 64, "%.60s", of->name[0] ? of->name : "struct");
    return text;
}

int glsl_child(const GlslTree *tree, int node, int i)
{
    int child = tree->nodes[node].first;
    for (; i > 0 && child; i--)
        child = tree->nodes[child].next;
    return child;
}

Phrase type_phrase(const Parser *parser, int type)
{
    Phrase phrase;
    char name[64];
    glsl_type_text(parser->tree, type, name);
    snprintf(phrase.text, sizeof phrase.text, "%s%s",
             type == GLSL_VOID             ? ""
             : strchr("aeioAEIO", name[0]) ? "an "
                                           : "a ",
             type == GLSL_VOID ? "nothing" : name);
    return phrase;
}

Phrase text_phrase(const Parser *parser, int node)
{
    Phrase phrase;
    glsl_expression_text(parser->tree, node, phrase.text, 40);
    return phrase;
}

static void add_message(Parser *parser, GlslPlace place, const char *format, va_list arguments)
{
    GlslTree *tree = parser->tree;
    if (parser->stopped)
        return;
    parser->stopped = tree->limits.silent || tree->message_count + 1 == GLSL_MESSAGES;
    GlslMessage *message = &tree->messages[tree->message_count++];
    message->place = place;
    vsnprintf(message->text, sizeof message->text, format, arguments);
}

void complain(Parser *parser, GlslPlace place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add_message(parser, place, format, arguments);
    va_end(arguments);
}

void syntax_error(Parser *parser, const char *format, ...)
{
    /* Where the preprocessor stopped, it says why. */
    if (parser->stopped)
        return;
    if (parser->broken && peek(parser, 0)->kind == TOKEN_END) {
        parser->stopped = parser->cut = true;
        return;
    }
    va_list arguments;
    va_start(arguments, format);
    add_message(parser, peek(parser, 0)->place, format, arguments);
    va_end(arguments);
    parser->stopped = true;
}

GlslTree *glsl_parse(const char *text, GlslStage stage, const GlslLimits *limits)
{
    GlslTree *tree = memory_new(1, sizeof *tree);
    Parser parser = {.tree = tree};
    GlslMessage message;
    tree->stage = stage;
    tree->limits = limits ? *limits : GLSL_LIMITS;
    node_new(&parser, GLSL_NOTHING, GLSL_ERROR, (GlslPlace){0});
    values_new(tree, 1);
    /* The words first: their names are numbers of types. Symbol 0 is none. */
    *(GlslSymbol *)memory_add(&tree->symbols, &tree->symbol_count, &tree->symbol_room,
                              sizeof(GlslSymbol)) = (GlslSymbol){.name = ""};
    open_words(&parser);
    add_types(&parser);
    parser.broken = !preprocess(tree, &parser.names, text, &parser.tokens, &message);
    declare_built_ins(&parser);
    const bool vertex = parser.tree->stage == GLSL_VERTEX;
    parser.precisions[GLSL_FLOAT] = vertex ? GLSL_HIGHP : GLSL_NO_PRECISION;
    parser.precisions[GLSL_INT] = vertex ? GLSL_HIGHP : GLSL_MEDIUMP;
    parser.precisions[GLSL_SAMPLER_2D] = parser.precisions[GLSL_SAMPLER_CUBE] = GLSL_LOWP;
    tree->root = parse_unit(&parser);
    parser.stopped &= !parser.cut;
    if (parser.broken)
        complain(&parser, message.place, "%s", message.text);
    free(parser.tokens.items);
    free(parser.declared);
    names_close(&parser.names);
    return tree;
}

void glsl_tree_free(GlslTree *tree)
{
    if (!tree)
        return;
    for (int i = 0; i < tree->text_count; i++)
        free(tree->texts[i]);
    free(tree->texts);
    free(tree->nodes);
    free(tree->symbols);
    free(tree->types);
    free(tree->fields);
    free(tree->values);
    free(tree);
}
