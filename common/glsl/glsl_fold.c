/*
 * The values of constant expressions: the code of one operation, run exactly.
 */
#include "glsl/glsl_code.h"
#include "glsl/glsl_parser.h"

#include <math.h>
#include <stdlib.h>

/* Ints wrap around. */
static double wrapped(double value)
{
    return fabs(value) < 9e18 ? (int)(unsigned)(unsigned long long)(long long)value : 0;
}

void fold(GlslTree *tree, int node)
{
    const int type = tree->nodes[node].type, count = tree->types[type].scalars;
    const int value = values_new(tree, count);
    GlslCode code = {.tree = tree};
    Compiler compiler = {.code = &code, .tree = tree};
    tree->nodes[node].constant = false; /* it has no value yet */
    const Value result = compile_read(&compiler, node);
    tree->nodes[node].constant = true;
    tree->nodes[node].value = value;
    emit(&compiler, OP_END, 0, 0, 0);
    GlslRun *run = glsl_run_open(&code);
    glsl_run(run);
    for (int i = 0; i < count; i++) {
        const double number = run->registers[register_of(&compiler, result, i)];
        tree->values[value + i] = glsl_scalar(type) == GLSL_INT ? wrapped(number) : number;
    }
    glsl_run_close(run);
    free(code.instructions);
    free(code.start);
}
