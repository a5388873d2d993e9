#include "compile_advice.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* Both parts are in the line, in this order. What is more special comes first. */
static const struct {
    const char *part, *then, *advice;
} ADVICE[] = {
    {"No precision specified", "",
     "A fragment shader has no default precision of floats: write `precision highp float;` at its "
     "top."},
    {"has no declared precision", "",
     "A fragment shader has no default precision of floats: write `precision highp float;` at its "
     "top."},
    {"could not implicitly convert", "",
     "The two sides have different types, and GLSL ES converts none by itself: write vec3(...) or "
     "vec4(...), and 2.0 for 2."},
    {"type mismatch", "int", "GLSL ES does not turn whole numbers into floats: write 2.0 for 2."},
    {"operands to arithmetic operators must be numeric", "",
     "One of the operands is not a number: see whether a name is a function or a boolean."},
    {"vector size mismatch", "",
     "Vectors of different sizes cannot be added or multiplied: take .xyz or .rgb of the longer "
     "one, or vec4(..., 1.0) of the shorter."},
    {"vector", "mismatch",
     "Vectors of different sizes: take .xyz of the longer one, or vec4(..., 1.0) of the shorter."},
    {"size mismatch for matrix", "",
     "A mat4 takes a vec4: write vec4(position, 1.0), or vec4(normal, 0.0) for a direction."},
    {"no matching function for call to `max(", "",
     "max takes two numbers of the same kind: write max(x, 0.0), not max(x, 0)."},
    {"no matching function for call to `pow(", "",
     "pow takes two floats: write pow(x, 2.0), not pow(x, 2)."},
    {"no matching function for call to", "vec",
     "No function of this name takes these arguments: count the components, and write 1.0 for 1."},
    {"no matching function", "",
     "No function of this name takes arguments of these types: a float is written 0.0, not 0, and "
     "vectors must be equally long."},
    {"too few components", "",
     "Count the components: a vec4 is made of four numbers, vec4(rgb, 1.0) of a vec3 and one."},
    {"too many components", "",
     "Count the components: a vec3 is made of three numbers, or of one vec3; take .xyz or .rgb."},
    {"cannot construct", "", "What is in the brackets is no number: look at each name in them."},
    {"cannot access field", "",
     "Only a vector has components, .xyzw or .rgba, and only as many as it has."},
    {"illegal use of reserved word", "",
     "This word is of C or of another GLSL: GLSL ES 1.00 has float, int, bool, vec, mat."},
    {"must be declared at global scope", "",
     "Attributes, uniforms and varyings are declared outside of all functions, above main."},
    {"no function with name 'texture'", "", "This lab has no textures."},
    {"no function with name", "", "There is no such function: look at its spelling."},
    {"undeclared", "",
     "This name is not declared here: look at its spelling and its case; a varying or uniform is "
     "to be declared in each of the two shaders that uses it."},
    {"redeclar", "", "This name is declared twice: leave out one, or only its type."},
    {"value of type", "cannot be assigned",
     "The value is of another type than the variable: a vec4 does not fit into a vec3; take .xyz "
     "or .rgb."},
    {"initializer of type", "cannot be assigned",
     "The value is of another type than the variable: write 1.0 for 1, and .xyz or .rgb of a "
     "vec4."},
    {"assignment to", "read-only",
     "Uniforms, attributes and, in the fragment shader, varyings can only be read: copy it to a "
     "variable of your own."},
    {"`in' qualifier", "",
     "`in` and `out` are of a later GLSL: here they are called attribute and "
     "varying."},
    {"texture", "", "This lab has no textures."},
    {"swizzle", "", "This vector has no such component: .xyzw or .rgba, as many as it has."},
    {"does not write to", "gl_Position",
     "The vertex shader has to set gl_Position, and the fragment shader gl_FragColor."},
    {"unexpected $end", "", "A closing brace } is missing."},
    {"unexpected end", "", "A closing brace } is missing."},
    {"unexpected NEW_IDENTIFIER", "",
     "Look at the end of the line before, too: a semicolon is missing there, or a type is not "
     "spelled right."},
    {"unexpected IDENTIFIER", "",
     "Look at the end of the line before, too: most often a semicolon is missing there."},
    {"syntax error", "",
     "Look at the line before, too: most often a semicolon, a bracket or an operator is missing."},
    {"not linked", "declared", "Vertex and fragment shader must declare it alike."},
    {"linking", "but fragment shader input declared",
     "A varying is to be declared in both shaders with the same name and type."},
    {"linking", "has no matching output",
     "The vertex shader has no varying of this name: compare the names in both files."},
    {"linking", "varying",
     "A varying is to be declared in both shaders with the same name and type, and set by the "
     "vertex shader."},
    {"not written", "",
     "The fragment shader reads a varying that the vertex shader does not have; "
     "compare the two names."},
    {"not declared", "", "This name is not declared: look at its spelling."},
    {"must be", "constant",
     "In GLSL ES 1.00 a loop's bounds and, in the fragment shader, an array's index are constant."},
    {"only #version 100", "", "Leave out the #version line, or write #version 100."},
    {"no such file beside it", "",
     "A submission may include only files that are handed in with it, in the same folder."},
    {"is empty", "", "There is nothing in this file."},
    {"lacks `main'", "", "Each of the two files needs a function `void main()`."},
    {"static recursion", "", "A function of GLSL must not call itself: write a loop."},
    {"memory exhausted", "", "An expression is nested too deeply."},
    {"linking", "", "The two shaders do not go together: look at what both declare."},
};

/* The line of the first error: what follows it, candidates and what depends on it, says less. */
static void first_error(const char *message, char *line, size_t size)
{
    const char *start = strstr(message, "error: ");
    while (start && start > message && start[-1] != '\n')
        start--;
    if (!start)
        start = message;
    snprintf(line, size, "%.*s", (int)strcspn(start, "\n"), start);
}

const char *compile_advice(const char *message)
{
    char line[1024];
    first_error(message, line, sizeof line);
    for (size_t i = 0; i < sizeof ADVICE / sizeof ADVICE[0]; i++) {
        const char *part = strstr(line, ADVICE[i].part);
        if (part && strstr(part, ADVICE[i].then))
            return ADVICE[i].advice;
    }
    return NULL;
}
