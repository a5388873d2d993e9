/* What a compiler's message usually means, in a sentence for learners. */
#include "core/shader_advice.h"

#include "base/text.h"

#include <ctype.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#define PRECISION "Floats have no default precision here: add `precision highp float;` at the top."
#define BRACE "A closing brace } is missing."
#define TEXTURES "GLSL ES 1.00 reads a sampler2D by texture2D(sampler, point)."
#define SHORTEN "use .xyz or .rgb of the longer one, or vec4(..., 1.0) of the shorter one."
#define NARROW "A vec4 does not fit into a vec3: write .xyz or .rgb of it."
#define WIDEN                                                                                      \
    "A vec3 does not fill a vec4: write vec4(value, 1.0), or vec4(value, 0.0) for a direction."
#define LATER(name) "GLSL ES 1.00 has no " name ": "
#define INVERSE LATER("inverse") "compute the inverse in the program, and pass it as a uniform."
#define TRANSPOSE                                                                                  \
    LATER("transpose")                                                                             \
    "write vector * matrix in the place of transpose(matrix) * vector, or pass "                   \
    "it as a uniform."
#define TEXTURE_SIZE LATER("textureSize") "pass the size as a uniform."
#define SATURATE "saturate is HLSL's: write clamp(x, 0.0, 1.0)."
#define SHADOW_SAMPLER                                                                             \
    LATER("sampler2DShadow")                                                                       \
    "take a sampler2D, and compare the depth that texture2D returns with the "                     \
    "point's own."
#define SPELLING "This name is not declared: check its spelling and case"
#define VARYING "Declare the varying in both shaders with the same name and type"

#define READ_ONLY                                                                                    \
    "Uniforms, attributes and, in the fragment shader, varyings are read-only: copy the value to a " \
    "variable of your own."
#define IN_OUT "`in` and `out` belong to a later GLSL: use attribute and varying."
#define COMPONENTS "Only vectors have components (.xyzw or .rgba), and only as many as their size."
#define NO_MAIN "Each of the two files needs a function `void main()`."
#define COMMENT "A comment that begins with /* does not end with */."
#define CONDITION "An #if, #ifdef or #ifndef has no #endif."
#define LOOPS                                                                                       \
    "WebGL takes only loops like for (int i = 0; i < 2; i++), with constant bounds (GLSL ES 1.00, " \
    "appendix A)."

/* The line contains both parts, in this order. Special cases come first. First ANGLE's words, which
 * browsers have, then Mesa's and others'. */
static const struct {
    const char *part, *then, *advice;
} ADVICE[] = {
    {"sampler2DShadow", "", SHADOW_SAMPLER},
    {"'inverse' : no matching overloaded function", "", INVERSE},
    {"no function with name 'inverse'", "", INVERSE},
    {"'transpose' : no matching overloaded function", "", TRANSPOSE},
    {"no function with name 'transpose'", "", TRANSPOSE},
    {"'textureSize' : no matching overloaded function", "", TEXTURE_SIZE},
    {"no function with name 'textureSize'", "", TEXTURE_SIZE},
    {"'saturate' : no matching overloaded function", "", SATURATE},
    {"no function with name 'saturate'", "", SATURATE},
    {"'' : syntax error", "", BRACE},
    {"wrong operand types", "'const int'",
     "GLSL ES does not convert int to float: write 2.0 instead of 2."},
    {"wrong operand types", "matrix of float'",
     "A mat4 multiplies a vec4: write vec4(position, 1.0), or vec4(normal, 0.0) for a direction."},
    {"wrong operand types", "component vector",
     "Vectors of different sizes cannot be added or multiplied: " SHORTEN},
    {"cannot convert from 'const int'", "",
     "The value and the variable have different types: write 1.0 instead of 1."},
    {"dimension mismatch", "",
     "The value and the variable have different types: write .xyz or .rgb of a vec4, and vec4(..., "
     "1.0) of a vec3."},
    {"cannot convert from", "",
     "The value and the variable have different types, and GLSL ES never converts."},
    {"'max' : no matching overloaded function", "",
     "max takes two numbers of the same type: write max(x, 0.0), not max(x, 0)."},
    {"'pow' : no matching overloaded function", "",
     "pow takes two floats: write pow(x, 2.0), not pow(x, 2)."},
    {"'texture' : no matching overloaded function", "", TEXTURES},
    {"no matching overloaded function", "",
     "No function of this name takes these types: check its spelling, count the components, and "
     "write 0.0 instead of 0."},
    {"not enough data provided for construction", "",
     "Count the components: a vec4 needs four numbers, or vec4(rgb, 1.0) from a vec3."},
    {"too many arguments", "",
     "Count the components: a vec3 needs three numbers or one vec3; use .xyz or .rgb."},
    {"l-value required", "", READ_ONLY},
    {"Missing main()", "", NO_MAIN},
    {"storage qualifier supported in GLSL ES 3.00", "", IN_OUT},
    {"field selection", "", COMPONENTS},
    {"Loop index", "", LOOPS},
    {"loop is not allowed", "", LOOPS},
    {"No precision specified", "", PRECISION},
    {"has no declared precision", "", PRECISION},
    {"could not implicitly convert", "",
     "The two sides have different types, and GLSL ES never converts: write vec3(...) or vec4(...), "
     "and 2.0 instead of 2."},
    {"type mismatch", "int", "GLSL ES does not convert int to float: write 2.0 instead of 2."},
    {"operands to arithmetic operators must be numeric", "",
     "An operand is not a number: check whether a name is a function or a bool."},
    {"vector size mismatch", "",
     "Vectors of different sizes cannot be added or multiplied: " SHORTEN},
    {"vector", "mismatch", "Vectors of different sizes: " SHORTEN},
    {"size mismatch for matrix", "",
     "A mat4 multiplies a vec4: write vec4(position, 1.0), or vec4(normal, 0.0) for a direction."},
    {"no matching function for call to `max(", "",
     "max takes two numbers of the same type: write max(x, 0.0), not max(x, 0)."},
    {"no matching function for call to `pow(", "",
     "pow takes two floats: write pow(x, 2.0), not pow(x, 2)."},
    {"no matching function for call to", "vec",
     "No function of this name takes these arguments: count the components, and write 1.0 instead "
     "of 1."},
    {"no matching function", "",
     "No function of this name takes these types: write 0.0 instead of 0, and vectors of equal "
     "size."},
    {"too few components", "",
     "Count the components: a vec4 needs four numbers, or vec4(rgb, 1.0) from a vec3."},
    {"too many components", "",
     "Count the components: a vec3 needs three numbers or one vec3; use .xyz or .rgb."},
    {"cannot construct", "", "A value in the parentheses is not a number: check each name."},
    {"cannot access field", "", COMPONENTS},
    {"illegal use of reserved word", "",
     "This word belongs to C or a later GLSL: GLSL ES 1.00 has float, int, bool, vec, mat."},
    {"must be declared at global scope", "",
     "Declare attributes, uniforms and varyings outside all functions, above main."},
    {"no function with name 'texture'", "", TEXTURES},
    {"no function with name", "", "There is no such function: check its spelling."},
    {"undeclared", "", SPELLING "; declare a varying or uniform in each shader that uses it."},
    {"redeclar", "", "This name is declared twice: remove one declaration, or only its type."},
    {"of type vec4 cannot be assigned", "of type vec3", NARROW},
    {"of type vec3 cannot be assigned", "of type vec4", WIDEN},
    {"of type vec", "to variable of type float",
     "The value is a vector, the variable a number: write one component (.x), or dot or length."},
    {"of type float cannot be assigned", "of type vec",
     "The value is a number, the variable a vector: write vec3(value) or vec4(value)."},
    {"of type int cannot be assigned", "",
     "The value and the variable have different types: write 1.0 instead of 1."},
    {"of type", "cannot be assigned",
     "The value and the variable have different types, and GLSL ES never converts."},
    {"assignment to", "read-only", READ_ONLY},
    {"`in' qualifier", "", IN_OUT},
    {"texture", "", TEXTURES},
    {"swizzle", "", "This vector has no such component: .xyzw or .rgba, up to its size."},
    {"does not write to", "gl_Position",
     "The vertex shader must set gl_Position, the fragment shader gl_FragColor."},
    {"end of file found in comment", "", COMMENT},
    {"end of file found in conditional", "", CONDITION},
    {"Unterminated comment", "", COMMENT},
    {"Unterminated #if", "", CONDITION},
    {"unexpected $end", "", BRACE},
    {"unexpected end", "", BRACE},
    {"unexpected NEW_IDENTIFIER", "",
     "Check the end of the line before too: a semicolon is missing, or a type is misspelled."},
    {"unexpected IDENTIFIER", "",
     "Check the end of the line before too: usually a semicolon is missing."},
    {"syntax error", "",
     "Check the line before too: usually a semicolon, bracket or operator is missing."},
    {"not linked", "declared", "Declare it the same way in both shaders."},
    {"linking", "but fragment shader input declared", VARYING "."},
    {"linking", "has no matching output",
     "The vertex shader has no varying of this name: compare the names in both files."},
    {"linking", "varying", VARYING ", and set it in the vertex shader."},
    {"not written", "",
     "The fragment shader reads a varying that the vertex shader lacks: compare the names."},
    {"not declared", "", SPELLING "."},
    {"initializer of global variable", "constant",
     "A variable outside all functions starts as a constant: set it in main instead."},
    {"global variable initializers", "constant",
     "A variable outside all functions starts as a constant: set it in main instead."},
    {"must be", "constant",
     "In GLSL ES 1.00 loop bounds and, in the fragment shader, array indices must be constant."},
    {"only #version 100", "", "Remove the #version line, or write #version 100."},
    {"no such file beside it", "", "A submission may include only files from its own folder."},
    {"is empty", "", "This file is empty."},
    {"lacks `main'", "", NO_MAIN},
    {"static recursion", "", "A GLSL function must not call itself: use a loop."},
    {"memory exhausted", "", "An expression is nested too deeply."},
    {"linking", "", "The two shaders do not match: compare what both declare."},
};

/* The line of the first error: later ones are candidates or consequences. */
static const char *first_error(const char *message)
{
    const char *start = strstr(message, "error: ");
    while (start && start > message && start[-1] != '\n')
        start--;
    return start ? start : message;
}

static const char *usual_meaning(const char *line)
{
    for (size_t i = 0; i < sizeof ADVICE / sizeof ADVICE[0]; i++) {
        const char *part = strstr(line, ADVICE[i].part);
        if (part && strstr(part, ADVICE[i].then))
            return ADVICE[i].advice;
    }
    return NULL;
}

enum { WORD_SIZE = 64, WORDS_MAX = 128 };

/* Often misspelled. */
static const char *const BUILT_IN[] = {
    "attribute", "clamp",  "dot",       "float",   "gl_FragColor", "gl_Position",
    "highp",     "length", "max",       "mediump", "min",          "mix",
    "normalize", "pow",    "precision", "reflect", "texture2D",    "uniform",
    "varying",   "vec2",   "vec3",      "vec4",    "mat3",         "mat4",
};

/* Functions of GLSL that ANGLE says the same of with wrong arguments as of what is no function. */
static const char FUNCTIONS[] =
    " abs acos all any asin atan bool ceil clamp cos cross degrees distance dot equal exp exp2 "
    "faceforward float floor fract int inversesqrt length lessThan log log2 mat2 mat3 mat4 "
    "matrixCompMult max min mix mod normalize not notEqual pow radians reflect refract sign sin "
    "smoothstep sqrt step tan texture2D vec2 vec3 vec4 ";

static bool is_function(const char *name)
{
    char word[WORD_SIZE + 2];
    snprintf(word, sizeof word, " %s ", name);
    return strstr(FUNCTIONS, word) != NULL;
}

/* The word between quotes. */
static bool quoted(const char *open, char name[WORD_SIZE])
{
    const size_t length = strcspn(open + 1, "'");
    snprintf(name, WORD_SIZE, "%.*s", (int)length, open + 1);
    return length > 0 && length < WORD_SIZE;
}

/* The name that the compiler does not know. Mesa: "`v_Colour' undeclared", "no function with name
 * 'normalise'"; ANGLE: "'v_Colour' : undeclared identifier", "'normalise' : no matching overloaded
 * function found". */
static bool unknown_name(const char *line, char name[WORD_SIZE])
{
    const char *function = strstr(line, "no function with name '");
    const char *quote = strchr(line, '\'');
    if (function)
        return quoted(strchr(function, '\''), name);
    if (strstr(line, "' undeclared") && strchr(line, '`'))
        return quoted(strchr(line, '`'), name);
    if (quote && strstr(line, "' : undeclared identifier"))
        return quoted(quote, name);
    return quote && strstr(line, "' : no matching overloaded function") && quoted(quote, name) &&
           !is_function(name);
}

/* Skips a comment and what is not a word. */
static const char *next_word(const char *text)
{
    while (*text && !isalpha((unsigned char)*text) && *text != '_') {
        const char *end = text_comment_end(text);
        text = end ? end : text + 1;
    }
    return text;
}

/* Adds a name to a list that NULL ends, unless it is there or is the unknown one. */
static void add_name(const char *names[], int *count, const char *name, const char *unknown)
{
    bool seen = strcmp(name, unknown) == 0 || *count >= WORDS_MAX;
    for (int i = 0; i < *count && !seen; i++)
        seen = strcmp(names[i], name) == 0;
    if (!seen)
        names[(*count)++] = name;
}

/* The name, of the source or of GLSL, that an unknown one was probably meant to be. */
static bool find_meant(const char *source, const char *unknown, char meant[WORD_SIZE])
{
    char words[WORDS_MAX][WORD_SIZE];
    const char *names[WORDS_MAX + 1] = {NULL};
    int count = 0;
    for (size_t i = 0; i < sizeof BUILT_IN / sizeof BUILT_IN[0]; i++)
        add_name(names, &count, BUILT_IN[i], unknown);
    for (const char *word = next_word(source); *word && count < WORDS_MAX;) {
        size_t length = 0;
        while (text_is_word(word[length]))
            length++;
        snprintf(words[count], WORD_SIZE, "%.*s", (int)length, word);
        add_name(names, &count, words[count], unknown);
        word = next_word(word + length);
    }
    names[count] = NULL;
    const char *nearest = text_nearest(unknown, names);
    if (nearest)
        snprintf(meant, WORD_SIZE, "%s", nearest);
    return nearest != NULL;
}

bool shader_advice(const char *source, const char *message, char *advice, size_t size)
{
    char line[1024], unknown[WORD_SIZE], meant[WORD_SIZE];
    const char *error = first_error(message);
    snprintf(line, sizeof line, "%.*s", (int)strcspn(error, "\n"), error);
    const char *meaning = usual_meaning(line);
    const bool found = unknown_name(line, unknown) && find_meant(source, unknown, meant);
    snprintf(advice, size, "%s%s%s%s%s", found ? "did you mean " : "", found ? meant : "",
             found ? "?" : "", found && meaning ? " " : "", meaning ? meaning : "");
    return found || meaning;
}

void shader_advise(const char *source, Message *message)
{
    char advice[512];
    if (!message || !message->text[0] ||
        !shader_advice(source, message->text, advice, sizeof advice))
        return;
    const char *error = first_error(message->text), *end = error + strcspn(error, "\n");
    if (*end && text_is_quote(end + 1))
        end += 1 + strcspn(end + 1, "\n");
    Message after = {0};
    message_set(&after, "%s", end);
    message->text[end - message->text] = '\0';
    message_add(message, "\n  hint: %s%s", advice, after.text);
}
