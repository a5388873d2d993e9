/* Constructors and calls: which function is meant, and whether the arguments fit. */
#include "glsl/glsl_parser.h"

#include "base/message.h"
#include "base/text.h"

#include <stdio.h>
#include <string.h>

enum { ARGUMENTS = 64 };

/* Arguments of a call. */
typedef struct Arguments {
    int count, nodes[ARGUMENTS], types[ARGUMENTS];
    bool unknown; /* something was said about one of them */
} Arguments;

static Arguments arguments_of(const Parser *parser, int node)
{
    Arguments arguments = {.unknown = parser->stopped};
    for (int i = node_at(parser, node)->first; i; i = node_at(parser, i)->next) {
        if (arguments.count < ARGUMENTS) {
            arguments.nodes[arguments.count] = i;
            arguments.types[arguments.count] = node_at(parser, i)->type;
        }
        arguments.count++;
        arguments.unknown |= node_at(parser, i)->type == GLSL_ERROR;
    }
    return arguments;
}

/* The type that a letter of GlslFunction's `types` means, where the generic ones have a size. */
static int meant(char letter, int size)
{
    /* clang-format off */
    switch (letter) {
    case 'g': case 'V': return GLSL_FLOAT + size - 1;
    case 'I': return GLSL_INT + size - 1;
    case 'B': return GLSL_BOOL + size - 1;
    case 'm': return GLSL_MAT2 + size - 2;
    case 'f': return GLSL_FLOAT;
    case 'b': return GLSL_BOOL;
    case 's': return GLSL_SAMPLER_2D;
    case 'c': return GLSL_SAMPLER_CUBE;
    default: return GLSL_FLOAT + letter - '1';
    }
    /* clang-format on */
}

/* The size that makes a list of types this function's, 0: none. */
static int match(const GlslFunction *function, const int *types, int count)
{
    if ((int)strlen(function->types) != count + 1)
        return 0;
    const char *generic = strpbrk(function->types + 1, "gVIBm");
    const int least = generic && *generic != 'g' ? 2 : 1, most = generic ? 4 : 1;
    for (int size = least; size <= most; size++) {
        int i = 0;
        while (i < count && types[i] == meant(function->types[i + 1], size))
            i++;
        if (i == count)
            return size;
    }
    return 0;
}

static bool enabled(const Parser *parser, const GlslFunction *function)
{
    return (function->stages & 1 << parser->tree->stage) &&
           (function->extension & ~parser->tree->extensions) == 0;
}

int find_built_in(const Parser *parser, int name, const int *types, int count)
{
    const int first = parser->names.items[name].function;
    const char *text = first ? GLSL_FUNCTIONS[first - 1].name : "";
    for (int i = first; first && i <= GLSL_FUNCTION_COUNT; i++) {
        const GlslFunction *function = &GLSL_FUNCTIONS[i - 1];
        if (strcmp(function->name, text) == 0 && enabled(parser, function) &&
            match(function, types, count))
            return i;
    }
    return 0;
}

static void settle_call(Parser *parser, int node, int type, bool constant)
{
    GlslNode *call = node_at(parser, node);
    call->type = type;
    for (int i = call->first; i; i = node_at(parser, i)->next) {
        constant &= node_at(parser, i)->constant;
        if (node_at(parser, i)->precision > call->precision)
            call->precision = node_at(parser, i)->precision;
    }
    call->constant = constant;
    if (constant)
        fold(parser->tree, node);
}

/* What to write instead of words of other languages. */
#define DERIVATIVES "write #extension GL_OES_standard_derivatives : enable first"
#define SHADOW "take a sampler2D, and compare the depth that texture2D returns with the point's own"
#define TEXTURE "write texture2D(sampler, point)"
#define UNIFORM "compute it in the program, and pass it as a uniform"
#define EXP "write it with exp"
static const char *const REPLACEMENTS[][2] = {
    {"inverse", UNIFORM},
    {"determinant", UNIFORM},
    {"transpose", "write vector * matrix instead of transpose(matrix) * vector"},
    {"texture", TEXTURE},
    {"textureLod", TEXTURE},
    {"texelFetch", TEXTURE},
    {"tex2D", TEXTURE},
    {"textureSize", "pass the size as a uniform"},
    {"saturate", "write clamp(x, 0.0, 1.0)"},
    {"lerp", "write mix(a, b, x)"},
    {"frac", "write fract(x)"},
    {"round", "write floor(x + 0.5)"},
    {"trunc", "write sign(x) * floor(abs(x))"},
    {"mul", "write matrix * vector"},
    {"fma", "write a * b + c"},
    {"sinh", EXP},
    {"cosh", EXP},
    {"tanh", EXP},
    {"isnan", "write x != x"},
    {"fmod", "write mod(x, y)"},
    {"atan2", "write atan(y, x)"},
    {"rsqrt", "write inversesqrt(x)"},
    {"fabs", "write abs(x)"},
    {"powf", "write pow(x, y)"},
    {"dFdx", DERIVATIVES},
    {"dFdy", DERIVATIVES},
    {"fwidth", DERIVATIVES},
    {"float2", "write vec2"},
    {"float3", "write vec3"},
    {"float4", "write vec4"},
    {"float3x3", "write mat3"},
    {"float4x4", "write mat4"},
    {"double", "write float"},
    {"half", "write mediump float"},
    {"long", "write int"},
    {"short", "write int"},
    {"unsigned", "write int"},
    {"uint", "write int"},
    {"layout", "remove it and its parentheses"},
    {"static", "remove it"},
    {"inline", "remove it"},
    {"switch", "write if and else"},
    {"goto", "write a loop"},
    {"sampler2DShadow", SHADOW},
    {"sampler3D", "there are sampler2D and samplerCube"},
};

const char *replacement_for(const Parser *parser, const char *name)
{
    const bool vertex = parser->tree->stage == GLSL_VERTEX;
    if (strcmp(name, "in") == 0)
        return vertex ? "write attribute" : "write varying";
    if (strcmp(name, "out") == 0)
        return vertex ? "write varying" : "set gl_FragColor";
    for (size_t i = 0; i < sizeof REPLACEMENTS / sizeof REPLACEMENTS[0]; i++)
        if (strcmp(REPLACEMENTS[i][0], name) == 0)
            return REPLACEMENTS[i][1];
    return NULL;
}

enum { NAMES_MAX = 2000 };

const char *nearest(Parser *parser, const char *name, int kind)
{
    const char *names[NAMES_MAX + 1];
    int count = 0;
    if (parser->tree->limits.silent)
        return NULL;
    for (int i = 0; i < parser->names.count && count < NAMES_MAX; i++) {
        const Name *item = &parser->names.items[i];
        const GlslSymbol *symbol = &parser->tree->symbols[item->symbol];
        if (item->symbol && symbol->kind == kind && item->kept)
            names[count++] = item->kept;
        else if (kind == GLSL_FUNCTION && item->function)
            names[count++] = GLSL_FUNCTIONS[item->function - 1].name;
        else if (kind == GLSL_STRUCT && i > 0 && i < WORD_STRUCT)
            names[count++] = keep_name(parser, i);
    }
    names[count] = NULL;
    return text_nearest(name, names);
}

void undeclared(Parser *parser, const Token *token, int symbol)
{
    const char *name = keep_name(parser, token->name);
    const char *near = nearest(parser, name, GLSL_VARIABLE);
    if (symbol)
        complain(parser, token->place, "%.60s is a %s, not a variable", name,
                 parser->tree->symbols[symbol].kind == GLSL_STRUCT ? "structure" : "function");
    else if (near)
        complain(parser, token->place, "%.60s is not declared: did you mean %.60s?", name, near);
    else
        complain(parser, token->place,
                 "%.60s is not declared: check its spelling and case; declare a varying or uniform "
                 "in each shader that uses it",
                 name);
}

/* "max(float or vec, the same)". */
static void add_built_in(Message *said, const GlslFunction *function)
{
    bool generic = false;
    for (const char *letter = function->types + 1; *letter; letter++) {
        const char *name = *letter == 'g'   ? "float or vec"
                           : *letter == 'V' ? "vec"
                           : *letter == 'I' ? "ivec"
                           : *letter == 'B' ? "bvec"
                           : *letter == 'm' ? "mat"
                                            : NULL;
        char type[8];
        snprintf(type, sizeof type, "vec%c", *letter);
        if (name && generic)
            name = "the same";
        generic |= name != NULL;
        message_add(said, "%s%s", letter == function->types + 1 ? "" : ", ",
                    name             ? name
                    : *letter == 'f' ? "float"
                    : *letter == 'b' ? "bool"
                    : *letter == 's' ? "sampler2D"
                    : *letter == 'c' ? "samplerCube"
                                     : type);
    }
}

/* The parameters of each function of this name: "; there is max(float or vec, the same)". */
static void add_signatures(const Parser *parser, int name, Message *said)
{
    const GlslTree *tree = parser->tree;
    const int first = parser->names.items[name].function;
    const char *text = parser->names.items[name].kept, *before = "; there is ";
    for (int i = symbol_of(parser, name); i; i = tree->symbols[i].overload, before = ", ") {
        const GlslSymbol *function = &tree->symbols[i];
        message_add(said, "%s%.40s(", before, text);
        for (int k = 0; k < function->parameters; k++) {
            char type[64];
            message_add(said, "%s%s", k ? ", " : "",
                        glsl_type_text(tree, tree->symbols[function->parameter + k].type, type));
        }
        message_add(said, ")");
    }
    for (int i = first; first && i <= GLSL_FUNCTION_COUNT; i++)
        if (strcmp(GLSL_FUNCTIONS[i - 1].name, GLSL_FUNCTIONS[first - 1].name) == 0 &&
            enabled(parser, &GLSL_FUNCTIONS[i - 1])) {
            message_add(said, "%s%s(", before, text);
            add_built_in(said, &GLSL_FUNCTIONS[i - 1]);
            message_add(said, ")");
            before = ", ";
        }
}

/* "max(x, 0): x is a float, 0 an int: write 0.0". */
static void no_match(Parser *parser, int node, int name, const Arguments *arguments)
{
    Message said = {0};
    Phrase advice = {""};
    for (int i = 0; i < arguments->count && i < 4; i++) {
        message_add(&said, "%s%s %s%s", i ? ", " : "",
                    text_phrase(parser, arguments->nodes[i]).text, i ? "" : "is ",
                    type_phrase(parser, arguments->types[i]).text);
        if (!advice.text[0] && arguments->types[i] == GLSL_INT)
            advice = conversion(parser, arguments->nodes[i], GLSL_FLOAT);
    }
    if (advice.text[0])
        message_add(&said, "%s", advice.text);
    else
        add_signatures(parser, name, &said);
    complain(parser, node_at(parser, node)->place, "%s: %s%s", text_phrase(parser, node).text,
             arguments->count ? "" : "there are no arguments", said.text);
}

static int find_function(const GlslTree *tree, int symbol, const Arguments *arguments)
{
    for (; symbol; symbol = tree->symbols[symbol].overload) {
        const GlslSymbol *function = &tree->symbols[symbol];
        bool fits = function->parameters == arguments->count && arguments->count <= ARGUMENTS;
        for (int i = 0; i < function->parameters && fits; i++)
            fits = tree->symbols[function->parameter + i].type == arguments->types[i];
        if (fits)
            return symbol;
    }
    return 0;
}

static void no_function(Parser *parser, int node, const char *name)
{
    const char *advice = replacement_for(parser, name),
               *near = nearest(parser, name, GLSL_FUNCTION);
    if (advice)
        complain(parser, node_at(parser, node)->place, "GLSL ES 1.00 has no %.60s here: %s", name,
                 advice);
    else if (near)
        complain(parser, node_at(parser, node)->place,
                 "there is no function %.60s: did you mean %.60s?", name, near);
    else
        complain(parser, node_at(parser, node)->place,
                 "there is no function %.60s: check its spelling, and declare it before its use",
                 name);
}

void check_call(Parser *parser, int node, int name)
{
    GlslTree *tree = parser->tree;
    const Arguments arguments = arguments_of(parser, node);
    const int symbol = symbol_of(parser, name);
    const char *text = keep_name(parser, name);
    const bool own = tree->symbols[symbol].kind == GLSL_FUNCTION;
    if (symbol && !own) {
        complain(parser, node_at(parser, node)->place, "%.60s is a variable, not a function", text);
        return;
    }
    if (arguments.unknown)
        return;
    const int function = own ? find_function(tree, symbol, &arguments) : 0;
    const int built_in = function || arguments.count > ARGUMENTS
                             ? 0
                             : find_built_in(parser, name, arguments.types, arguments.count);
    GlslNode *call = node_at(parser, node);
    if (function) {
        call->symbol = function;
        settle_call(parser, node, tree->symbols[function].type, false);
        node_at(parser, node)->precision = tree->symbols[function].precision;
        for (int i = 0; i < tree->symbols[function].parameters; i++)
            if (parser->tree->symbols[tree->symbols[function].parameter + i].storage >= GLSL_OUT)
                check_writable(parser, arguments.nodes[i]);
    } else if (built_in) {
        const GlslFunction *found = &GLSL_FUNCTIONS[built_in - 1];
        call->kind = GLSL_BUILT_IN;
        call->symbol = built_in - 1;
        settle_call(parser, node,
                    meant(found->types[0], match(found, arguments.types, arguments.count)),
                    found->id < GLSL_DFDX);
    } else if (own || (parser->names.items[name].function && !replacement_for(parser, text))) {
        call->kind = own ? GLSL_CALL : GLSL_BUILT_IN;
        call->symbol = own ? symbol : parser->names.items[name].function - 1;
        no_match(parser, node, name, &arguments);
    } else {
        no_function(parser, node, text);
    }
}

static void construct_struct(Parser *parser, int node, const Arguments *arguments)
{
    GlslTree *tree = parser->tree;
    const GlslType *type = &tree->types[node_at(parser, node)->type];
    const GlslPlace place = node_at(parser, node)->place;
    if (type->array)
        complain(parser, place, "%.60s has an array: set its fields one by one", type->name);
    else if (arguments->count != type->fields)
        complain(parser, place, "%.60s has %d field%s, not %d", type->name, type->fields,
                 type->fields == 1 ? "" : "s", arguments->count);
    else
        for (int i = 0; i < type->fields && i < ARGUMENTS; i++) {
            const GlslField *field = &tree->fields[type->field + i];
            if (field->type != arguments->types[i]) {
                complain(parser, place, "%.60s is %s, %s %s%s", field->name,
                         type_phrase(parser, field->type).text,
                         text_phrase(parser, arguments->nodes[i]).text,
                         type_phrase(parser, arguments->types[i]).text,
                         conversion(parser, arguments->nodes[i], field->type).text);
                return;
            }
        }
}

/* Numbers of a scalar, vector or matrix. */
static void construct_numbers(Parser *parser, int node, const Arguments *arguments)
{
    const GlslTree *tree = parser->tree;
    const int type = node_at(parser, node)->type, wanted = tree->types[type].scalars;
    const GlslPlace place = node_at(parser, node)->place;
    int given = 0, before = 0, matrices = 0;
    for (int i = 0; i < arguments->count; i++) {
        const int part = i < ARGUMENTS ? arguments->types[i] : GLSL_FLOAT;
        before = given;
        given += glsl_size(part) ? tree->types[part].scalars : 0;
        matrices += glsl_is_matrix(part);
        if (!glsl_size(part)) {
            complain(parser, place, "%s is %s: %s is made of numbers",
                     text_phrase(parser, arguments->nodes[i]).text, type_phrase(parser, part).text,
                     type_phrase(parser, type).text);
            return;
        }
    }
    const Phrase own = text_phrase(parser, node);
    const char *text = own.text;
    if (matrices && glsl_is_matrix(type) && arguments->count == 1)
        return;
    if (matrices && glsl_is_matrix(type))
        complain(parser, place, "%.50s: a matrix is made of one other matrix, or of none", text);
    else if (given == 1 && arguments->count == 1)
        return;
    else if (given < wanted)
        complain(parser, place, "%.50s: %s needs %d numbers, not %d%s", text,
                 type_phrase(parser, type).text, wanted, given,
                 wanted == 4 && given == 3 ? ": add one, as in vec4(..., 1.0)" : "");
    else if (before >= wanted)
        complain(parser, place, "%.50s: %s takes %d number%s, here are more: remove some", text,
                 type_phrase(parser, type).text, wanted, wanted == 1 ? "" : "s");
}

void check_construct(Parser *parser, int node)
{
    const Arguments arguments = arguments_of(parser, node);
    const int type = node_at(parser, node)->type, before = parser->tree->message_count;
    if (arguments.unknown)
        return;
    if (parser->tree->types[type].fields)
        construct_struct(parser, node, &arguments);
    else if (glsl_size(type))
        construct_numbers(parser, node, &arguments);
    else
        complain(parser, node_at(parser, node)->place, "%s cannot be made",
                 type_phrase(parser, type).text);
    if (before == parser->tree->message_count)
        settle_call(parser, node, type, true);
}
