/*
 * glsl_code: the operations of code, and what the compiler's files share.
 */
#ifndef GLSL_CODE_H
#define GLSL_CODE_H

#include "glsl/glsl_run.h"

/* clang-format off */
enum {
    OP_SET, OP_ADD, OP_SUBTRACT, OP_MULTIPLY, OP_DIVIDE, OP_INT_DIVIDE, OP_NEGATE, OP_NOT, OP_LESS,
    OP_LESS_EQUAL, OP_EQUAL, OP_NOT_EQUAL, OP_AND, OP_OR, OP_XOR, OP_MIN, OP_MAX, OP_ABS, OP_SIGN,
    OP_FLOOR, OP_CEIL, OP_SIN, OP_COS, OP_ASIN, OP_ACOS, OP_ATAN, OP_ATAN2, OP_POW, OP_EXP2, OP_LOG2,
    OP_SQRT, OP_INVERSE_SQRT, OP_TRUNCATE, OP_BOOL, OP_SELECT, /* d = f(a, b, c) */
    OP_NUMBERS, /* those before make one number of numbers */
    OP_JUMP = OP_NUMBERS, /* to d */
    OP_JUMP_FALSE, /* to d, if a is 0 */
    OP_LOOP,       /* counts an iteration */
    OP_INDEX,      /* d = a (-1: 0) + c * b, b less than n */
    OP_LOAD,       /* d = the register a + b's value */
    OP_STORE,      /* the register d + b's value = a */
    OP_UNSET,      /* n from d on have no value */
    OP_CHECK,      /* n from a on are read */
    OP_EDGES,      /* a and b should differ */
    OP_EVENT,      /* n from a on were assigned to symbol c */
    OP_TEXTURE,    /* 4 from d on = function c of sampler a, n numbers from b on */
    OP_DISCARD, OP_END
};
/* clang-format on */

/* A value, or what can be assigned: where its numbers are. */
typedef struct Value {
    int base, count;
    int address; /* a register with what to add to `base`, -1: none */
    bool picked; /* its numbers are base + pick[i], else base + i */
    unsigned char pick[4];
} Value;

/* A function that is being inlined, or a loop: jumps that wait for the place they go to. */
typedef struct Waiting {
    int *jumps, count, room;
} Waiting;

typedef struct Compiler {
    GlslCode *code;
    const GlslTree *tree;
    int *where;                     /* the first register of each symbol, -1 */
    bool *unset;                    /* may be read before it has a value */
    int node, depth, calls, result; /* result: of the function that is inlined */
    Waiting returns, breaks, continues;
} Compiler;

int emit(Compiler *compiler, int op, int d, int a, int b);
void emit_counted(Compiler *compiler, int op, int d, int a, int n);
int reserve(Compiler *compiler, int count); /* registers */
void cannot(Compiler *compiler, const char *why);
int number(Compiler *compiler, double value);            /* a register that holds it */
int register_of(Compiler *compiler, Value value, int i); /* the i-th number, loaded */
int scalars_of(const GlslTree *tree, int type);
Value value_at(int base, int count);
int compute(Compiler *compiler, int op, int a, int b); /* into a new register */

Value compile_expression(Compiler *compiler, int node);
Value compile_read(Compiler *compiler, int node); /* not to be assigned */
Value compile_built_in(Compiler *compiler, int node);
Value compile_call(Compiler *compiler, int node); /* a function of the text */
void compile_event(Compiler *compiler, int node, int symbol, Value value);

#endif
