/*
 * shader_cost: operations per invocation of a shader. glslangValidator compiles it to SPIR-V,
 * spirv-opt inlines functions, unrolls loops and removes dead code, and the remaining instructions
 * are counted. No GL; writes no file but in the cache (base/cache.h), where counts are kept.
 *
 * Counts do not depend on the machine or the driver, which may optimize further. They are scalar
 * operations: a sum of two vec3 is 3, a dot product of two vec3 is 5, a mat4 times a vec4 is 28.
 * All branches count, because neighboring invocations may take different ones.
 */
#ifndef SHADER_COST_H
#define SHADER_COST_H

#include "core/shader.h"

typedef struct ShaderCost {
    int arithmetic; /* sums, products, comparisons, choices, minima, conversions... */
    int special;    /* divisions, roots, powers, exponentials, logarithms, sines... */
    int branches;
} ShaderCost;

/* `text` is GLSL ES 1.00, as the driver receives it. False if a tool is missing (the message names
 * its package), the text does not compile, or a loop cannot be unrolled. */
bool shader_cost(const char *text, ShaderStage stage, ShaderCost *cost, Message *message);

/* The text with its directives carried out as GLSL ES 1.00 has them, in memory that the caller
 * frees: what shader_cost counts. A driver that is given it draws what is counted. NULL, with a
 * message: a tool is missing, or a directive is invalid. */
char *shader_preprocess(const char *text, ShaderStage stage, Message *message);

#endif
