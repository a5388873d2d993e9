/* The functions, variables and constants that the language has. */
#include "glsl/glsl_parser.h"

#include <pthread.h>
#include <string.h>

enum { VERTEX = 1 << GLSL_VERTEX, FRAGMENT = 1 << GLSL_FRAGMENT, BOTH = VERTEX | FRAGMENT };

/* clang-format off */
const GlslFunction GLSL_FUNCTIONS[] = {
    {"radians", "gg", GLSL_RADIANS, BOTH, 0}, {"degrees", "gg", GLSL_DEGREES, BOTH, 0},
    {"sin", "gg", GLSL_SIN, BOTH, 0}, {"cos", "gg", GLSL_COS, BOTH, 0},
    {"tan", "gg", GLSL_TAN, BOTH, 0}, {"asin", "gg", GLSL_ASIN, BOTH, 0},
    {"acos", "gg", GLSL_ACOS, BOTH, 0}, {"atan", "ggg", GLSL_ATAN, BOTH, 0},
    {"atan", "gg", GLSL_ATAN, BOTH, 0}, {"pow", "ggg", GLSL_POW, BOTH, 0},
    {"exp", "gg", GLSL_EXP, BOTH, 0}, {"log", "gg", GLSL_LOG, BOTH, 0},
    {"exp2", "gg", GLSL_EXP2, BOTH, 0}, {"log2", "gg", GLSL_LOG2, BOTH, 0},
    {"sqrt", "gg", GLSL_SQRT, BOTH, 0}, {"inversesqrt", "gg", GLSL_INVERSESQRT, BOTH, 0},
    {"abs", "gg", GLSL_ABS, BOTH, 0}, {"sign", "gg", GLSL_SIGN, BOTH, 0},
    {"floor", "gg", GLSL_FLOOR, BOTH, 0}, {"ceil", "gg", GLSL_CEIL, BOTH, 0},
    {"fract", "gg", GLSL_FRACT, BOTH, 0}, {"mod", "ggg", GLSL_MOD, BOTH, 0},
    {"mod", "ggf", GLSL_MOD, BOTH, 0}, {"min", "ggg", GLSL_MIN, BOTH, 0},
    {"min", "ggf", GLSL_MIN, BOTH, 0}, {"max", "ggg", GLSL_MAX, BOTH, 0},
    {"max", "ggf", GLSL_MAX, BOTH, 0}, {"clamp", "gggg", GLSL_CLAMP, BOTH, 0},
    {"clamp", "ggff", GLSL_CLAMP, BOTH, 0}, {"mix", "gggg", GLSL_MIX, BOTH, 0},
    {"mix", "gggf", GLSL_MIX, BOTH, 0}, {"step", "ggg", GLSL_STEP, BOTH, 0},
    {"step", "gfg", GLSL_STEP, BOTH, 0}, {"smoothstep", "gggg", GLSL_SMOOTHSTEP, BOTH, 0},
    {"smoothstep", "gffg", GLSL_SMOOTHSTEP, BOTH, 0}, {"length", "fg", GLSL_LENGTH, BOTH, 0},
    {"distance", "fgg", GLSL_DISTANCE, BOTH, 0}, {"dot", "fgg", GLSL_DOT, BOTH, 0},
    {"cross", "333", GLSL_CROSS, BOTH, 0}, {"normalize", "gg", GLSL_NORMALIZE, BOTH, 0},
    {"faceforward", "gggg", GLSL_FACEFORWARD, BOTH, 0}, {"reflect", "ggg", GLSL_REFLECT, BOTH, 0},
    {"refract", "gggf", GLSL_REFRACT, BOTH, 0},
    {"matrixCompMult", "mmm", GLSL_MATRIX_COMP_MULT, BOTH, 0},
    {"lessThan", "BVV", GLSL_LESS_THAN, BOTH, 0}, {"lessThan", "BII", GLSL_LESS_THAN, BOTH, 0},
    {"lessThanEqual", "BVV", GLSL_LESS_THAN_EQUAL, BOTH, 0},
    {"lessThanEqual", "BII", GLSL_LESS_THAN_EQUAL, BOTH, 0},
    {"greaterThan", "BVV", GLSL_GREATER_THAN, BOTH, 0},
    {"greaterThan", "BII", GLSL_GREATER_THAN, BOTH, 0},
    {"greaterThanEqual", "BVV", GLSL_GREATER_THAN_EQUAL, BOTH, 0},
    {"greaterThanEqual", "BII", GLSL_GREATER_THAN_EQUAL, BOTH, 0},
    {"equal", "BVV", GLSL_EQUAL_TO, BOTH, 0}, {"equal", "BII", GLSL_EQUAL_TO, BOTH, 0},
    {"equal", "BBB", GLSL_EQUAL_TO, BOTH, 0}, {"notEqual", "BVV", GLSL_NOT_EQUAL_TO, BOTH, 0},
    {"notEqual", "BII", GLSL_NOT_EQUAL_TO, BOTH, 0},
    {"notEqual", "BBB", GLSL_NOT_EQUAL_TO, BOTH, 0}, {"any", "bB", GLSL_ANY, BOTH, 0},
    {"all", "bB", GLSL_ALL, BOTH, 0}, {"not", "BB", GLSL_NOT_EACH, BOTH, 0},
    {"texture2D", "4s2", GLSL_TEXTURE_2D, BOTH, 0},
    {"texture2D", "4s2f", GLSL_TEXTURE_2D, FRAGMENT, 0},
    {"texture2DProj", "4s3", GLSL_TEXTURE_2D_PROJ, BOTH, 0},
    {"texture2DProj", "4s4", GLSL_TEXTURE_2D_PROJ, BOTH, 0},
    {"texture2DProj", "4s3f", GLSL_TEXTURE_2D_PROJ, FRAGMENT, 0},
    {"texture2DProj", "4s4f", GLSL_TEXTURE_2D_PROJ, FRAGMENT, 0},
    {"texture2DLod", "4s2f", GLSL_TEXTURE_2D_LOD, VERTEX, 0},
    {"texture2DProjLod", "4s3f", GLSL_TEXTURE_2D_PROJ_LOD, VERTEX, 0},
    {"texture2DProjLod", "4s4f", GLSL_TEXTURE_2D_PROJ_LOD, VERTEX, 0},
    {"textureCube", "4c3", GLSL_TEXTURE_CUBE, BOTH, 0},
    {"textureCube", "4c3f", GLSL_TEXTURE_CUBE, FRAGMENT, 0},
    {"textureCubeLod", "4c3f", GLSL_TEXTURE_CUBE_LOD, VERTEX, 0},
    {"texture2DLodEXT", "4s2f", GLSL_TEXTURE_2D_LOD, FRAGMENT, GLSL_TEXTURE_LOD},
    {"texture2DProjLodEXT", "4s3f", GLSL_TEXTURE_2D_PROJ_LOD, FRAGMENT, GLSL_TEXTURE_LOD},
    {"texture2DProjLodEXT", "4s4f", GLSL_TEXTURE_2D_PROJ_LOD, FRAGMENT, GLSL_TEXTURE_LOD},
    {"textureCubeLodEXT", "4c3f", GLSL_TEXTURE_CUBE_LOD, FRAGMENT, GLSL_TEXTURE_LOD},
    {"texture2DGradEXT", "4s222", GLSL_TEXTURE_2D_GRAD, FRAGMENT, GLSL_TEXTURE_LOD},
    {"texture2DProjGradEXT", "4s322", GLSL_TEXTURE_2D_PROJ_GRAD, FRAGMENT, GLSL_TEXTURE_LOD},
    {"texture2DProjGradEXT", "4s422", GLSL_TEXTURE_2D_PROJ_GRAD, FRAGMENT, GLSL_TEXTURE_LOD},
    {"textureCubeGradEXT", "4c333", GLSL_TEXTURE_CUBE_GRAD, FRAGMENT, GLSL_TEXTURE_LOD},
    {"dFdx", "gg", GLSL_DFDX, FRAGMENT, GLSL_DERIVATIVES},
    {"dFdy", "gg", GLSL_DFDY, FRAGMENT, GLSL_DERIVATIVES},
    {"fwidth", "gg", GLSL_FWIDTH, FRAGMENT, GLSL_DERIVATIVES}
};
/* clang-format on */
const int GLSL_FUNCTION_COUNT = sizeof GLSL_FUNCTIONS / sizeof GLSL_FUNCTIONS[0];

const GlslLimits GLSL_LIMITS = {
    .vertex_attribs = 8,
    .vertex_uniforms = 128,
    .varyings = 8,
    .vertex_textures = 0,
    .combined_textures = 8,
    .textures = 8,
    .fragment_uniforms = 16,
    .draw_buffers = 1,
    .extensions = GLSL_DERIVATIVES | GLSL_TEXTURE_LOD | GLSL_FRAG_DEPTH,
    .tokens = 500000,
    .depth = 200,
};

static const char *const WORDS[] = {
    "float", "vec2", "vec3", "vec4", "int", "ivec2", "ivec3", "ivec4", "bool", "bvec2", "bvec3",
    "bvec4", "mat2", "mat3", "mat4", "sampler2D", "samplerCube", "void", "const", "attribute",
    "uniform", "varying", "in", "out", "inout", "lowp", "mediump", "highp", "precision",
    "invariant", "struct", "if", "else", "for", "while", "do", "return", "break", "continue",
    "discard", "true", "false",
    /* Reserved. */
    "asm", "class", "union", "enum", "typedef", "template", "this", "packed", "goto", "switch",
    "default", "inline", "noinline", "volatile", "public", "static", "extern", "external",
    "interface", "flat", "long", "short", "double", "half", "fixed", "unsigned", "superp", "input",
    "output", "hvec2", "hvec3", "hvec4", "dvec2", "dvec3", "dvec4", "fvec2", "fvec3", "fvec4",
    "sampler1D", "sampler3D", "sampler1DShadow", "sampler2DShadow", "sampler2DRect",
    "sampler3DRect", "sampler2DRectShadow", "sizeof", "cast", "namespace", "using"};

/* A word of the language, whose text is there as long as any tree. */
static int find(Names *names, const char *word)
{
    const int name = names_find(names, word, (int)strlen(word));
    names->items[name].kept = word;
    return name;
}

static int add_variable(Parser *parser, const char *name, int type, int storage, int precision)
{
    const int symbol = symbol_bind(
        parser, symbol_new(parser, find(&parser->names, name), (GlslPlace){0}, GLSL_VARIABLE));
    GlslSymbol *variable = &parser->tree->symbols[symbol];
    variable->type = type;
    variable->storage = (unsigned char)storage;
    variable->precision = (unsigned char)precision;
    variable->built_in = variable->global = true;
    return symbol;
}

static void add_constants(Parser *parser)
{
    const GlslLimits *limits = &parser->tree->limits;
    const struct {
        const char *name;
        int value;
    } constants[] = {{"gl_MaxVertexAttribs", limits->vertex_attribs},
                     {"gl_MaxVertexUniformVectors", limits->vertex_uniforms},
                     {"gl_MaxVaryingVectors", limits->varyings},
                     {"gl_MaxVertexTextureImageUnits", limits->vertex_textures},
                     {"gl_MaxCombinedTextureImageUnits", limits->combined_textures},
                     {"gl_MaxTextureImageUnits", limits->textures},
                     {"gl_MaxFragmentUniformVectors", limits->fragment_uniforms},
                     {"gl_MaxDrawBuffers", limits->draw_buffers}};
    for (size_t i = 0; i < sizeof constants / sizeof constants[0]; i++) {
        const int symbol =
            add_variable(parser, constants[i].name, GLSL_INT, GLSL_CONST, GLSL_MEDIUMP);
        const int value = values_new(parser->tree, 1);
        parser->tree->symbols[symbol].value = value;
        parser->tree->values[value] = constants[i].value;
    }
}

static void add_depth_range(Parser *parser)
{
    static const char *const FIELDS[] = {"near", "far", "diff"};
    GlslTree *tree = parser->tree;
    const int name = find(&parser->names, "gl_DepthRangeParameters");
    const int symbol = symbol_bind(parser, symbol_new(parser, name, (GlslPlace){0}, GLSL_STRUCT));
    const int type = type_struct(tree, tree->symbols[symbol].name);
    tree->symbols[symbol].type = type;
    tree->symbols[symbol].built_in = true;
    for (int i = 0; i < 3; i++)
        type_add_field(tree, type, keep_name(parser, find(&parser->names, FIELDS[i])), GLSL_FLOAT,
                       GLSL_HIGHP);
    add_variable(parser, "gl_DepthRange", type, GLSL_UNIFORM, GLSL_NO_PRECISION);
}

static Names all_words; /* which each text begins with */

static void make_words(void)
{
    names_open(&all_words);
    for (size_t i = 0; i < sizeof WORDS / sizeof WORDS[0]; i++)
        find(&all_words, WORDS[i]);
    for (int i = GLSL_FUNCTION_COUNT - 1; i >= 0; i--) {
        const int name = find(&all_words, GLSL_FUNCTIONS[i].name);
        all_words.items[name].function = i + 1;
    }
}

void open_words(Parser *parser)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, make_words);
    names_copy(&parser->names, &all_words);
    parser->words = (int)(sizeof WORDS / sizeof WORDS[0]) + 1;
}

void declare_built_ins(Parser *parser)
{
    GlslTree *tree = parser->tree;
    add_constants(parser);
    add_depth_range(parser);
    if (tree->stage == GLSL_VERTEX) {
        add_variable(parser, "gl_Position", GLSL_VEC4, GLSL_OUT, GLSL_HIGHP);
        add_variable(parser, "gl_PointSize", GLSL_FLOAT, GLSL_OUT, GLSL_MEDIUMP);
        return;
    }
    add_variable(parser, "gl_FragCoord", GLSL_VEC4, GLSL_IN, GLSL_MEDIUMP);
    add_variable(parser, "gl_FrontFacing", GLSL_BOOL, GLSL_IN, GLSL_NO_PRECISION);
    add_variable(parser, "gl_PointCoord", GLSL_VEC2, GLSL_IN, GLSL_MEDIUMP);
    add_variable(parser, "gl_FragColor", GLSL_VEC4, GLSL_OUT, GLSL_MEDIUMP);
    add_variable(parser, "gl_FragData", type_array(tree, GLSL_VEC4, tree->limits.draw_buffers),
                 GLSL_OUT, GLSL_MEDIUMP);
    if (tree->extensions & GLSL_FRAG_DEPTH)
        add_variable(parser, "gl_FragDepthEXT", GLSL_FLOAT, GLSL_OUT,
                     tree->limits.no_highp ? GLSL_MEDIUMP : GLSL_HIGHP);
}
