/*
 * shader_cost: operations per invocation of a shader, counted in its text. No GL.
 *
 * Counts do not depend on the machine or the driver, which may optimize further. They are scalar
 * operations: a sum of two vec3 is 3, a dot product of two vec3 is 5, a mat4 times a vec4 is 28.
 * Built-in functions are what the specification says they are: clamp is 2 for each component, fract
 * 2, mix 3, reflect of vec3 12; normalize of n components is 3 n - 1 and 1 special, length 2 n - 1
 * and 1 special, smoothstep 8 and 1 special. mod, tan, exp and log are 1 special, and so is a
 * lookup of a texture, whatever its coordinates. A division by a known number is a product.
 *
 * Functions count where they are called, loops in each turn, and all branches, because neighboring
 * invocations may take different ones. What costs nothing: copies, parts and constructors; what no
 * output needs; what is known; sums with 0, products with 0 or 1, and what was computed before of
 * the same, if that holds for all components; the choice between ways that compute what differs.
 * A choice between values that are there on both ways is 1 for each component that is needed. Terms
 * count as they are written: nothing is factored out of a sum, and no product is fused with one.
 */
#ifndef SHADER_COST_H
#define SHADER_COST_H

#include "core/shader.h"

typedef struct ShaderCost {
    int arithmetic; /* sums, products, comparisons, choices, minima, conversions... */
    int special;    /* divisions, roots, powers, exponentials, logarithms, sines, lookups... */
} ShaderCost;

/* `text` is GLSL ES 1.00, as the driver receives it. False, with zeros, if it is in error, or a
 * loop does not turn a known number of times. */
bool shader_cost(const char *text, ShaderStage stage, ShaderCost *cost, Message *message);

#endif
