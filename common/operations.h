/*
 * operations: what a shader computes each time that it runs, counted by tools: glslangValidator
 * compiles it to SPIR-V, spirv-opt inlines its functions, unrolls its loops and drops what nothing
 * depends on, and the instructions that are left are counted. No GL, no file is written.
 *
 * The counts depend on no machine and no driver, which may do with less. They are operations on
 * single numbers: a sum of two vec3 is 3, a dot product of two vec3 is 5, a mat4 times a vec4
 * is 28. All of a shader counts, whichever branches are taken, for neighbours may take others.
 */
#ifndef OPERATIONS_H
#define OPERATIONS_H

#include "shader.h"

typedef struct Operations {
    int arithmetic; /* sums, products, comparisons, choices, minima, conversions... */
    int special;    /* divisions, roots, powers, exponentials, logarithms, sines... */
    int branches;
} Operations;

/* Counts the operations of one run of a shader: `text` is GLSL ES 1.00, as the driver is given it.
 * False where a tool is missing (naming the package that has it), where the text does not compile,
 * or where a loop cannot be unrolled. */
bool operations_count(const char *text, ShaderStage stage, Operations *operations,
                      Message *message);

#endif
