/*
 * glsl: GLSL ES 1.00 as a typed tree: preprocessor, types, constants, names, and back to text.
 *
 * The text is read as the driver gets it. Nothing needs GL, and nothing of a text can do harm:
 * sizes are limited, and what exceeds a limit is a message like any other.
 *
 * The tree is a few flat arrays that refer to each other by index; index 0 of each list is "none".
 * A node's children are a list: `first` is the first of them, `next` the one after. A
 * transformation may change nodes in place, or append new ones.
 */
#ifndef GLSL_H
#define GLSL_H

#include <stdbool.h>
#include <stddef.h>

typedef enum GlslStage { GLSL_VERTEX, GLSL_FRAGMENT } GlslStage;

/* Types that the language has; those with an index from GLSL_TYPES on are the text's own. Scalars
 * and vectors come in fours: type - 1 is 4 * what + size - 1. */
/* clang-format off */
enum {
    GLSL_ERROR, GLSL_FLOAT, GLSL_VEC2, GLSL_VEC3, GLSL_VEC4, GLSL_INT, GLSL_IVEC2, GLSL_IVEC3,
    GLSL_IVEC4, GLSL_BOOL, GLSL_BVEC2, GLSL_BVEC3, GLSL_BVEC4, GLSL_MAT2, GLSL_MAT3, GLSL_MAT4,
    GLSL_SAMPLER_2D, GLSL_SAMPLER_CUBE, GLSL_VOID, GLSL_TYPES
};
/* clang-format on */

/* Arrays have an element, structures have fields; other types neither. */
typedef struct GlslType {
    const char *name; /* "vec3", "Light"; of an array, its element's; "" of a nameless structure */
    int element, length;
    int field, fields;   /* the first of them in the tree's list, how many */
    int scalars;         /* how many numbers it holds */
    bool array, sampler; /* is, or has a field that is, such a type */
} GlslType;

enum { GLSL_NO_PRECISION, GLSL_LOWP, GLSL_MEDIUMP, GLSL_HIGHP };

/* `precision` is what holds; `said`, what the declaration itself says. */
typedef struct GlslField {
    const char *name;
    int type;
    unsigned char precision, said;
} GlslField;

/* Lines and columns begin with 1; a column counts bytes. `file` is the source string number. What a
 * macro expands to is where the macro is used. */
typedef struct GlslPlace {
    int file, line, column;
} GlslPlace;

/* clang-format off */
enum {
    GLSL_LOCAL, GLSL_CONST, GLSL_ATTRIBUTE, GLSL_UNIFORM, GLSL_VARYING, GLSL_IN, GLSL_OUT,
    GLSL_INOUT
};
/* clang-format on */

enum { GLSL_VARIABLE = 1, GLSL_FUNCTION, GLSL_STRUCT };

/* A variable, parameter, function or structure. Built-in variables are symbols, too. */
typedef struct GlslSymbol {
    const char *name;
    GlslPlace place;
    int kind;
    unsigned char storage, precision, said;
    bool invariant, built_in;
    bool global, written;      /* `written`: something assigns it, or a part of it */
    int type;                  /* of a function, what it returns */
    int value;                 /* of a constant: the first of its numbers in `values` */
    int node;                  /* of a function: its definition's */
    int parameter, parameters; /* of a function: the first of these symbols, how many */
    int hidden, overload;      /* of the same name: what this hides; the next function */
    int id, position;          /* its name and place in the parser's lists */
} GlslSymbol;

/* Kinds of nodes, with their children. The last child of a list may be GLSL_NOTHING where the text
 * leaves out what belongs there. */
enum {
    GLSL_NOTHING,
    /* Expressions, which have a type. */
    GLSL_LITERAL,     /* `value` */
    GLSL_NAME,        /* `symbol`: a variable */
    GLSL_UNARY,       /* `op`; operand */
    GLSL_BINARY,      /* `op`; left, right */
    GLSL_ASSIGN,      /* `op`; left, right */
    GLSL_CONDITIONAL, /* condition, then, else */
    GLSL_INDEX,       /* base, index */
    GLSL_FIELD,       /* `symbol`: which of the structure's fields, from 0; base */
    GLSL_SWIZZLE,     /* `op`: see glsl_swizzle; base */
    GLSL_CALL,        /* `symbol`: a function of the text; arguments */
    GLSL_BUILT_IN,    /* `symbol`: of GLSL_FUNCTIONS; arguments */
    GLSL_CONSTRUCT,   /* arguments */
    /* Statements. */
    GLSL_BLOCK,      /* statements */
    GLSL_EXPRESSION, /* expression */
    GLSL_DECLARE,    /* `type`; `symbol`: the structure that it defines or 0; `op`: invariant;
                        GLSL_VARIABLE_NODEs */
    GLSL_IF,         /* condition, then, else or nothing */
    GLSL_FOR,        /* statement, condition, expression, body */
    GLSL_WHILE,      /* condition (may be GLSL_DECLARE), body */
    GLSL_DO,         /* body, condition */
    GLSL_RETURN,     /* expression or nothing */
    GLSL_BREAK,
    GLSL_CONTINUE,
    GLSL_DISCARD,
    /* Declarations. */
    GLSL_VARIABLE_NODE, /* `symbol`; its first value or nothing */
    GLSL_FUNCTION_NODE, /* `symbol`; GLSL_VARIABLE_NODE of each parameter, block or nothing */
    GLSL_PRECISION,     /* `type`, `precision` */
    GLSL_INVARIANT,     /* `symbol` */
    GLSL_UNIT           /* all of the text */
};

/* Operators; those of assignments are = with GLSL_SET, += with GLSL_ADD, and so on. */
/* clang-format off */
enum {
    GLSL_SET, GLSL_ADD, GLSL_SUBTRACT, GLSL_MULTIPLY, GLSL_DIVIDE, GLSL_LESS, GLSL_GREATER,
    GLSL_LESS_EQUAL, GLSL_GREATER_EQUAL, GLSL_EQUAL, GLSL_NOT_EQUAL, GLSL_AND, GLSL_OR,
    GLSL_XOR, GLSL_COMMA, GLSL_PLUS, GLSL_MINUS, GLSL_NOT, GLSL_PRE_INCREMENT,
    GLSL_PRE_DECREMENT, GLSL_POST_INCREMENT, GLSL_POST_DECREMENT
};
/* clang-format on */

typedef struct GlslNode {
    unsigned char kind, precision; /* `precision`: the highest of its operands', or none */
    unsigned short op, height;     /* `height`: over its deepest descendant */
    bool constant;                 /* a constant expression, of `value` */
    int type, symbol;
    int value; /* of a constant: the first of its numbers in `values` */
    int first, next;
    GlslPlace place; /* of its first token */
} GlslNode;

typedef struct GlslMessage {
    GlslPlace place;
    char text[256]; /* what is wrong, and what to write instead */
} GlslMessage;

enum { GLSL_MESSAGES = 10 };

/* Extensions, as bits. */
enum { GLSL_DERIVATIVES = 1, GLSL_TEXTURE_LOD = 2, GLSL_FRAG_DEPTH = 4 };

/* The driver's constants, and what a text may demand of the compiler. */
typedef struct GlslLimits {
    int vertex_attribs, vertex_uniforms, varyings, vertex_textures, combined_textures, textures,
        fragment_uniforms, draw_buffers;
    int extensions; /* that there are */
    bool no_highp;  /* in fragment shaders */
    int tokens;     /* of the text after, and of all macros during, preprocessing */
    int depth;      /* of parentheses, blocks, macros' arguments and conditions in each other */
    bool silent;    /* the first message ends reading, and says nothing of what is similar */
} GlslLimits;

/* The least that the specification demands, three extensions, 500,000 tokens, 200 deep. */
extern const GlslLimits GLSL_LIMITS;

typedef struct GlslTree {
    GlslStage stage;
    GlslLimits limits;
    int extensions; /* that the text enables */
    bool invariant; /* #pragma STDGL invariant(all) */
    bool grown;     /* its macros expand to more tokens than the limit */
    int root;       /* GLSL_UNIT */
    int main;       /* the function, 0: it has none */
    GlslNode *nodes;
    GlslSymbol *symbols;
    GlslType *types;
    GlslField *fields;
    double *
        values; /* of a vector its components, of a matrix its columns, of a structure its fields */
    int node_count, symbol_count, type_count, field_count, value_count;
    int node_room, symbol_room, type_room, field_room, value_room;
    GlslMessage messages[GLSL_MESSAGES]; /* in the order of the text; none: it is valid */
    int message_count;
    char **texts; /* of all names */
    int text_count, text_room;
} GlslTree;

/* Never NULL. `limits` may be NULL. */
GlslTree *glsl_parse(const char *text, GlslStage stage, const GlslLimits *limits);
void glsl_tree_free(GlslTree *tree);

/* What linking asks of one stage alone, and compilers do not: a main, a body for each function that
 * is called, no recursion, and only one of gl_FragColor and gl_FragData. Adds messages; false if
 * there are some. */
bool glsl_check_whole(GlslTree *tree);

/* Whether loops and indices are as restricted as appendix A says, which WebGL asks for. Likewise.
 */
bool glsl_check_loops(GlslTree *tree);

/* The most that main does while it runs once, of a text that passed both checks; a loop that turns
 * more often than GLSL_TURNS_MAX counts as that. */
typedef struct GlslWork {
    double size;     /* nodes, with functions put where they are called */
    double turns;    /* of all loops together */
    double steps;    /* nodes, as often as they run */
    GlslPlace place; /* the loop that turns most; without one main */
} GlslWork;
enum { GLSL_TURNS_MAX = 1000000 };
GlslWork glsl_count_work(const GlslTree *tree);

/* What linking asks of both: a varying that the fragment shader uses is one of the vertex shader's,
 * and what both declare has one type, uniforms also one precision. Adds messages to `fragment`. */
bool glsl_check_pair(const GlslTree *vertex, GlslTree *fragment);

/* The tree as text, which parses to the same tree. An expression or statement prints alone, too. */
char *glsl_print(const GlslTree *tree, int node); /* for free() */

/* An expression's text in at most `size` bytes, with "..." if it is longer. */
void glsl_expression_text(const GlslTree *tree, int node, char *text, size_t size);

/* "vec3", "float[2]", "Light". */
const char *glsl_type_text(const GlslTree *tree, int type, char text[64]);

/* The i-th child; 0 if there are fewer. */
int glsl_child(const GlslTree *tree, int node, int i);

/* Scalars and vectors. */
static inline bool glsl_is_vector(int type) /* or a scalar */
{
    return type >= GLSL_FLOAT && type <= GLSL_BVEC4;
}
static inline int glsl_size(int type)
{
    return glsl_is_vector(type)                     ? (type - 1) % 4 + 1
           : type >= GLSL_MAT2 && type <= GLSL_MAT4 ? type - GLSL_MAT2 + 2
                                                    : 0;
}
static inline int glsl_scalar(int type)
{
    return glsl_is_vector(type)                     ? (type - 1) / 4 * 4 + 1
           : type >= GLSL_MAT2 && type <= GLSL_MAT4 ? GLSL_FLOAT
                                                    : 0;
}
static inline bool glsl_is_matrix(int type)
{
    return type >= GLSL_MAT2 && type <= GLSL_MAT4;
}

/* GLSL_SWIZZLE's `op`: the number of components, and each of them, in three bits each. Above, the
 * letters that the text uses: 0 xyzw, 1 rgba, 2 stpq. */
static inline int glsl_swizzle_count(int op)
{
    return op & 7;
}
static inline int glsl_swizzle(int op, int i)
{
    return op >> (3 + 3 * i) & 3;
}

/* Built-in functions, whatever their parameters. */
/* clang-format off */
enum {
    GLSL_RADIANS, GLSL_DEGREES, GLSL_SIN, GLSL_COS, GLSL_TAN, GLSL_ASIN, GLSL_ACOS, GLSL_ATAN,
    GLSL_POW, GLSL_EXP, GLSL_LOG, GLSL_EXP2, GLSL_LOG2, GLSL_SQRT, GLSL_INVERSESQRT, GLSL_ABS,
    GLSL_SIGN, GLSL_FLOOR, GLSL_CEIL, GLSL_FRACT, GLSL_MOD, GLSL_MIN, GLSL_MAX, GLSL_CLAMP,
    GLSL_MIX, GLSL_STEP, GLSL_SMOOTHSTEP, GLSL_LENGTH, GLSL_DISTANCE, GLSL_DOT, GLSL_CROSS,
    GLSL_NORMALIZE, GLSL_FACEFORWARD, GLSL_REFLECT, GLSL_REFRACT, GLSL_MATRIX_COMP_MULT,
    GLSL_LESS_THAN, GLSL_LESS_THAN_EQUAL, GLSL_GREATER_THAN, GLSL_GREATER_THAN_EQUAL,
    GLSL_EQUAL_TO, GLSL_NOT_EQUAL_TO, GLSL_ANY, GLSL_ALL, GLSL_NOT_EACH, GLSL_DFDX, GLSL_DFDY,
    GLSL_FWIDTH, GLSL_TEXTURE_2D, GLSL_TEXTURE_2D_PROJ, GLSL_TEXTURE_2D_LOD,
    GLSL_TEXTURE_2D_PROJ_LOD, GLSL_TEXTURE_2D_GRAD, GLSL_TEXTURE_2D_PROJ_GRAD,
    GLSL_TEXTURE_CUBE, GLSL_TEXTURE_CUBE_LOD, GLSL_TEXTURE_CUBE_GRAD
};
/* clang-format on */

/* A line of the table of built-in functions, one for each list of parameters. `types` is what it
 * returns, then what it takes: f float, 2 3 4 vectors, b bool, s sampler2D, c samplerCube; g float
 * or vector, V I B vectors of floats, ints and bools, all of one size; m matrices of one size. */
typedef struct GlslFunction {
    const char *name, *types;
    int id, stages; /* a bit for each stage that has it */
    int extension;  /* that has to be enabled, 0: none */
} GlslFunction;
extern const GlslFunction GLSL_FUNCTIONS[];
extern const int GLSL_FUNCTION_COUNT;

#endif
