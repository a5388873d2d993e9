/* A mutant is made as text: the tree is printed with a mark for one node, and what a rule says
 * replaces the mark. So the parser checks the types, and a rule is one line. In a rule $0 is the
 * node's own text, $1 to $3 are its operands, # is a number, and @ any name of the rule's type. */
#include "labs/diagnosis/mutation.h"

#include "base/memory.h"
#include "base/text.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of rules for all expressions of a type. */
enum { ANY_FLOAT = 100, ANY_VEC3, ANY_NAME, ANY_BOTH };

typedef struct Rule {
    int kind, op; /* `op`: of a built-in function its number, -1: any */
    const char *by, *name, *sentence;
} Rule;

#define SPACE "Two vectors are in different spaces."
#define RIM "(1.0 - max(dot(normal, normalize(u_EyePosition - v_Position)), 0.0))"
#define TONE "The colour is changed after the light is summed, which the task does not ask for."

/* What is likelier comes first. */
static const Rule RULES[] = {
    /* What is left out. */
    {GLSL_BUILT_IN, GLSL_NORMALIZE, "$1", "not normalized: $1", "A vector does not have length 1."},
    {GLSL_BUILT_IN, GLSL_MAX, "$1", "not clamped: $1", "A number may be negative."},
    {GLSL_BUILT_IN, GLSL_POW, "$1", "exponent missing: $2", ""},
    {GLSL_BUILT_IN, GLSL_RADIANS, "$1", "degrees for radians: $1", "cos takes radians."},
    {GLSL_BUILT_IN, -1, "$1", "function left out of $0", ""},
    {GLSL_BINARY, GLSL_MULTIPLY, "$1", "factor missing: $2", ""},
    {GLSL_BINARY, GLSL_MULTIPLY, "$2", "factor missing: $1", ""},
    {GLSL_BINARY, GLSL_ADD, "$1", "term missing: $2", ""},
    {GLSL_BINARY, GLSL_ADD, "$2", "term missing: $1", ""},
    {GLSL_BINARY, GLSL_SUBTRACT, "$1", "term missing: - $2", ""},
    {GLSL_BINARY, GLSL_SUBTRACT, "-$2", "term missing: $1", ""},
    {GLSL_BINARY, GLSL_DIVIDE, "$1", "not divided by $2", ""},
    {GLSL_UNARY, GLSL_MINUS, "$1", "sign of $1 reversed", ""},
    {GLSL_EXPRESSION, 0, "", "left out: $1", ""},
    /* Operands and operators. */
    {GLSL_BINARY, GLSL_SUBTRACT, "$2 - $1", "reversed: $2 - $1", "A difference has the wrong sign."},
    {GLSL_BINARY, GLSL_SUBTRACT, "$1 + $2", "$1 + $2 for -", "A sum is taken for a difference."},
    {GLSL_BINARY, GLSL_MULTIPLY, "$2 * $1", "in the wrong order: $2 * $1",
     "A matrix is multiplied from the wrong side, which transposes it."},
    {GLSL_BINARY, GLSL_MULTIPLY, "($1 + $2)", "$1 + $2 for *", "Added instead of multiplied."},
    {GLSL_BINARY, GLSL_MULTIPLY, "$1 / $2", "$1 / $2 for *", "Divided instead of multiplied."},
    {GLSL_BINARY, GLSL_ADD, "$1 * $2", "multiplied, not added: $1 and $2", ""},
    {GLSL_BINARY, GLSL_ADD, "($1 - $2)", "subtracted: $2", ""},
    {GLSL_BINARY, GLSL_ADD, "($2 - $1)", "subtracted: $1", ""},
    {GLSL_BINARY, GLSL_ADD, "max($1, $2)", "the larger of $1 and $2, not the sum", ""},
    {GLSL_BINARY, GLSL_ADD, "mix($1, $2, 0.5)", "the mean of $1 and $2, not the sum", ""},
    {GLSL_BINARY, GLSL_DIVIDE, "$1 * $2", "multiplied by $2, not divided", ""},
    {GLSL_BINARY, GLSL_DIVIDE, "$2 / $1", "reversed: $2 / $1", ""},
    {GLSL_BINARY, GLSL_DIVIDE, "$1 / ($2 * $2)", "divided by the square of $2", ""},
    {GLSL_ASSIGN, GLSL_ADD, "$1 = $2", "= for +=: $1", "What was summed before is lost."},
    {GLSL_ASSIGN, GLSL_ADD, "$1 *= $2", "*= for +=: $1", "Multiplied instead of added."},
    {GLSL_ASSIGN, GLSL_ADD, "$1 = max($1, $2)", "the larger, not the sum: $1", ""},
    {GLSL_ASSIGN, GLSL_ADD, "$1 -= $2", "-= for +=: $1", "Subtracted instead of added."},
    {GLSL_ASSIGN, GLSL_ADD, "$1 += $2 * $1", "multiplied by the sum so far: $2", ""},
    {GLSL_ASSIGN, GLSL_ADD, "$1 += 0.5 * $2", "mean of the lights", ""},
    {GLSL_BINARY, GLSL_LESS, "$1 < 1", "loop ends at the first", "The loop turns once too few."},
    {GLSL_BINARY, GLSL_LESS, "$1 <= 0", "loop ends at the first", "The loop turns once too few."},
    {GLSL_LITERAL, GLSL_INT, "1", "loop begins with the second", "The loop turns once too few."},
    {GLSL_INDEX, 0, "$1[0]", "always the first: $1", "An index is fixed."},
    {GLSL_INDEX, 0, "$1[1]", "always the second: $1", "An index is fixed."},
    {GLSL_INDEX, 0, "$1[1 - $2]", "swapped: elements of $1", ""},
    {GLSL_INDEX, 0, "normalize($0)", "normalized: $0", ""},
    {GLSL_INDEX, 0, "$1[0] * $1[1]", "product of the elements of $1", ""},
    {GLSL_INDEX, 0, "0.5 * ($1[0] + $1[1])", "mean of the elements of $1", ""},
    {ANY_NAME, 0, "@", "@ for $0", "One value is taken for another."},
    {ANY_BOTH, 0, "@", "@ for $0", "One value is taken for another."},
    {GLSL_CONDITIONAL, 0, "$1 ? $3 : $2", "swapped: $2 and $3", ""},
    {GLSL_CONDITIONAL, 0, "$2", "always $2", ""},
    {GLSL_CONDITIONAL, 0, "$3", "always $3", ""},
    {GLSL_CONDITIONAL, 0, "$1 ? $2 : #", "# for $3", ""},
    {GLSL_CONDITIONAL, 0, "$1 ? # : $3", "# for $2", ""},
    {ANY_NAME, GLSL_BOOL, "true", "not asked: $0", "A condition is missing."},
    {ANY_NAME, GLSL_BOOL, "false", "never: $0", "A condition is never true."},
    {ANY_NAME, GLSL_BOOL, "!($0)", "reversed: $0", "A condition is the wrong way round."},
    {GLSL_BINARY, GLSL_OR, "$1", "not asked: $2", "A part of a condition is missing."},
    {GLSL_BINARY, GLSL_OR, "$2", "not asked: $1", "A part of a condition is missing."},
    {GLSL_BINARY, GLSL_OR, "$6", "only asked: $6", "Parts of a condition are missing."},
    {GLSL_BINARY, GLSL_AND, "$1", "not asked: $2", "A part of a condition is missing."},
    {GLSL_BINARY, GLSL_AND, "$2", "not asked: $1", "A part of a condition is missing."},
    {GLSL_BINARY, GLSL_GREATER, "$1 > #", "compared with #: $1", ""},
    {GLSL_BINARY, GLSL_GREATER_EQUAL, "$1 >= #", "compared with #: $1", ""},
    /* Spaces and w. */
    {GLSL_CONSTRUCT, GLSL_VEC4, "vec4($1, 1.0)", "w = 1 for $1", "Directions have w = 0."},
    {GLSL_CONSTRUCT, GLSL_VEC4, "vec4($1, 0.0)", "w = 0 for $1", "Points have w = 1."},
    {ANY_NAME, GLSL_VEC4, "vec4($0.xyz, 0.0)", "w = 0 for $0", "Points have w = 1."},
    {ANY_NAME, GLSL_VEC4, "vec4($0.xyz, 1.0)", "w = 1 for $0", "Directions have w = 0."},
    {ANY_VEC3, 0, "(u_ViewMatrix * vec4($0, 1.0)).xyz", "in eye space: $0", SPACE},
    {ANY_VEC3, 0, "(u_ViewMatrix * vec4($0, 0.0)).xyz", "in eye space, with w = 0: $0", SPACE},
    {ANY_VEC3, 0, "(u_ModelMatrix * vec4($0, 1.0)).xyz", "times the model matrix: $0", SPACE},
    {ANY_VEC3, 0, "(u_ModelMatrix * vec4($0, 0.0)).xyz", "times the model matrix, w = 0: $0", SPACE},
    {ANY_VEC3, 0, "(u_NormalMatrix * vec4($0, 0.0)).xyz", "times the normal matrix: $0", SPACE},
    {ANY_VEC3, 0, "(u_MvpMatrix * vec4($0, 1.0)).xyz", "in clip space: $0", SPACE},
    {ANY_VEC3, 0, "gl_FragCoord.xyz", "gl_FragCoord for $0", SPACE},
    {ANY_VEC3, 0, "(gl_Position.xyz / gl_Position.w)", "in normalized device coordinates: $0", SPACE},
    {ANY_VEC3, 0, "u_Mirrored * normalize(v_Normal)", "u_Mirrored times the normal for $0", ""},
    {ANY_VEC3, 0, "normalize(v_Normal)", "the front's normal for $0", ""},
    {ANY_FLOAT, 0, "(front ? $0 : 0.0)", "nothing on the back: $0", ""},
    {ANY_FLOAT, 0, "(front ? $0 : # * $0)", "on the back times #: $0", ""},
    {ANY_VEC3, 0, "(front ? $0 : # * $0)", "on the back times #: $0", ""},
    {ANY_FLOAT, 0, "gl_FragCoord.z", "gl_FragCoord.z for $0", SPACE},
    {ANY_VEC3, 0, "normalize($0)", "normalized: $0", "A vector must keep its length."},
    {ANY_BOTH, 0, "-$0", "sign of $0 reversed", ""},
    {ANY_VEC3, 0, "abs($0)", "absolute value of $0", ""},
    {ANY_VEC3, 0, "$0.zyx", "components swapped: $0.zyx", ""},
    {ANY_VEC3, 0, "$0.xzy", "components swapped: $0.xzy", ""},
    {ANY_VEC3, 0, "$0.yxz", "components swapped: $0.yxz", ""},
    {ANY_VEC3, 0, "vec3($0.x)", "only one component: $0.x", ""},
    {ANY_VEC3, 0, "vec3(0.0)", "missing: $0", ""},
    {ANY_VEC3, 0, "vec3(1.0)", "1 for $0", ""},
    {ANY_FLOAT, 0, "0.0", "0 for $0", ""},
    {ANY_FLOAT, 0, "1.0", "1 for $0", ""},
    /* Of the other light. */
    {GLSL_NAME, 0, "$4", "of the first light, also in the second: $0", "An index is the other light's."},
    {GLSL_NAME, 0, "$5", "of the second light, also in the first: $0", "An index is the other light's."},
    /* The cosine. */
    {GLSL_BUILT_IN, GLSL_MAX, "abs($1)", "absolute value of $1", "What is turned away is lit, too."},
    {GLSL_BUILT_IN, GLSL_MAX, "max(-$1, $2)", "sign of $1 reversed", ""},
    {GLSL_BUILT_IN, GLSL_MAX, "min($1, $2)", "min for max: $1", ""},
    {GLSL_BUILT_IN, GLSL_MAX, "(0.5 * $1 + 0.5)", "half Lambert: $1", "The cosine is not clamped."},
    {GLSL_BUILT_IN, GLSL_MAX, "pow(0.5 * $1 + 0.5, 2.0)", "half Lambert squared: $1",
     "The cosine is not clamped."},
    {GLSL_BUILT_IN, GLSL_MAX, "max(($1 + #) / (1.0 + #), 0.0)", "wrapped by #: $1",
     "Light reaches around the edge of the shadow side."},
    {GLSL_BUILT_IN, GLSL_MAX, "max($1 + #, 0.0)", "# added to $1", ""},
    {GLSL_BUILT_IN, GLSL_MAX, "max($1, #)", "at least #: $1", "It is clamped at a wrong number."},
    {GLSL_BUILT_IN, GLSL_MAX, "step(0.0, $1)", "step of $1", "Light is all or nothing."},
    {GLSL_BUILT_IN, GLSL_MAX, "($1 > # ? $1 : 0.0)", "only where above #: $1", ""},
    {GLSL_BUILT_IN, GLSL_MAX, "max(1.0 - acos($1) / 1.57079633, 0.0)", "angle for cosine: $1",
     "Light falls off with the angle, not with its cosine."},
    {GLSL_BUILT_IN, GLSL_MAX, "acos($1)", "angle for cosine: $1", ""},
    {GLSL_BUILT_IN, GLSL_MAX, "floor($0 * #) / #", "in # steps: $1", "Toon shading."},
    {GLSL_BUILT_IN, GLSL_MAX, "smoothstep(0.0, 1.0, $1)", "smoothstep of $1", ""},
    {GLSL_BUILT_IN, GLSL_DOT, "abs($0)", "absolute value of $0", ""},
    {GLSL_BUILT_IN, GLSL_DOT, "(0.5 * $0 + 0.5)", "half Lambert: $0", "The cosine is not clamped."},
    {GLSL_BUILT_IN, GLSL_DOT, "pow(0.5 * $0 + 0.5, 2.0)", "half Lambert squared: $0", ""},
    {GLSL_BUILT_IN, GLSL_DOT, "max($0, #)", "at least #: $0", "It is clamped at a wrong number."},
    {GLSL_BUILT_IN, GLSL_DOT, "($0 + #) / (1.0 + #)", "wrapped by #: $0", ""},
    {GLSL_BUILT_IN, GLSL_DOT, "(1.0 - acos($0) / 1.57079633)", "angle for cosine: $0", ""},
    {GLSL_BUILT_IN, GLSL_DOT, "length(cross($1, $2))", "sine for cosine: $0", ""},
    /* The highlight. */
    {GLSL_BUILT_IN, GLSL_REFLECT, "reflect(-$1, $2)", "sign of reflect's argument", ""},
    {GLSL_BUILT_IN, GLSL_REFLECT, "reflect($2, $1)", "arguments of reflect swapped", ""},
    {GLSL_BUILT_IN, GLSL_REFLECT, "(2.0 * $2 + $1)", "factor N.L missing in 2 (N.L) N - L", ""},
    {GLSL_BUILT_IN, GLSL_REFLECT, "normalize(viewDirection - $1)", "half vector for reflect",
     "This is Blinn's half vector, not Phong's reflection."},
    {GLSL_BUILT_IN, GLSL_REFLECT, "refract($1, $2, #)", "refract for reflect", ""},
    {GLSL_BINARY, GLSL_ADD, "reflect(-$1, normal)", "reflect for the half vector", ""},
    {GLSL_BUILT_IN, GLSL_POW, "pow($1, $2 * #)", "exponent times #: $2", ""},
    {GLSL_BUILT_IN, GLSL_POW, "pow($1, $2 + #)", "# added to the exponent $2", ""},
    {GLSL_BUILT_IN, GLSL_POW, "pow($1, #)", "exponent # for $2", ""},
    {GLSL_BUILT_IN, GLSL_POW, "pow($2, $1)", "arguments of pow swapped", ""},
    {GLSL_BUILT_IN, GLSL_POW, "$1 * $2", "multiplied by the exponent $2", ""},
    {GLSL_BUILT_IN, GLSL_POW, "exp($2 * ($1 - 1.0))", "exp for pow: $0", ""},
    {GLSL_BUILT_IN, GLSL_POW, "($2 + 1.0) / 6.2831853 * $0", "highlight times (n + 1) / 2pi", ""},
    {GLSL_BUILT_IN, GLSL_POW, "($2 + 2.0) / 6.2831853 * $0", "highlight times (n + 2) / 2pi", ""},
    {GLSL_BUILT_IN, GLSL_POW, "($2 + 8.0) / 25.1327412 * $0", "highlight times (n + 8) / 8pi", ""},
    {GLSL_BUILT_IN, GLSL_POW, "($2 + 2.0) / 25.1327412 * $0", "highlight times (n + 2) / 8pi", ""},
    {GLSL_BUILT_IN, GLSL_POW, "(u_Shininess + 1.0) / 6.2831853 * $0",
     "highlight times (n + 1) / 2pi", ""},
    {GLSL_BUILT_IN, GLSL_POW, "(u_Shininess + 2.0) / 6.2831853 * $0",
     "highlight times (n + 2) / 2pi", ""},
    {GLSL_BUILT_IN, GLSL_POW, "(u_Shininess + 8.0) / 25.1327412 * $0",
     "highlight times (n + 8) / 8pi", ""},
    {GLSL_BUILT_IN, GLSL_POW,
     "($0 + pow(max(dot(reflect(-lightDirection, normal), viewDirection), 0.0), u_Shininess))",
     "Phong's highlight besides Blinn's", ""},
    {GLSL_BUILT_IN, GLSL_POW,
     "($0 + pow(max(dot(normal, normalize(lightDirection + viewDirection)), 0.0), u_Shininess))",
     "Blinn's highlight besides Phong's", ""},
    {ANY_FLOAT, 0, "dot(normal, viewDirection)", "N.V for $0", "One value is taken for another."},
    {ANY_FLOAT, 0, "dot(normal, lightDirection)", "N.L for $0", "One value is taken for another."},
    {ANY_FLOAT, 0, "dot(viewDirection, lightDirection)", "V.L for $0", ""},
    {GLSL_BUILT_IN, GLSL_POW, "$0 * pow(1.0 - max(dot(normal, viewDirection), 0.0), 5.0)",
     "Fresnel factor of the highlight", ""},
    {ANY_NAME, GLSL_VEC3, "($0 + (1.0 - $0) * pow(1.0 - max(dot(normal, viewDirection), 0.0), 5.0))",
     "Schlick's Fresnel term of $0", "The highlight grows towards grazing view."},
    {ANY_NAME, GLSL_VEC3, "($0 + (1.0 - $0) * pow(1.0 - max(dot(lightDirection, normalize(lightDirection "
     "+ viewDirection)), 0.0), 5.0))", "Schlick's Fresnel term of $0",
     "The highlight grows towards grazing light."},
    /* The cone, and attenuation. */
    {GLSL_BUILT_IN, GLSL_POW, "smoothstep(cos(radians(u_SpotCutoff)), 1.0, cosine)",
     "smoothstep for the cone's fall-off", "The cone's edge is that of another book."},
    {GLSL_BUILT_IN, GLSL_POW, "(cosine - cos(radians(u_SpotCutoff))) / (1.0 - cos(radians(u_SpotCutoff)))",
     "linear fall-off to the cone's edge", ""},
    {GLSL_BUILT_IN, GLSL_POW,
     "clamp((cosine - cos(radians(u_SpotCutoff))) / (cos(radians(u_SpotCutoff * #)) - "
     "cos(radians(u_SpotCutoff))), 0.0, 1.0)",
     "soft edge with an inner cutoff of # times the outer", "The cone's edge is that of another book."},
    {GLSL_BUILT_IN, GLSL_POW,
     "smoothstep(cos(radians(u_SpotCutoff)), cos(radians(u_SpotCutoff * #)), cosine)",
     "smooth edge with an inner cutoff of # times the outer", "The cone's edge is that of another book."},
    {GLSL_BUILT_IN, GLSL_POW,
     "clamp((cosine - cos(radians(u_SpotCutoff))) / (cos(radians(u_SpotCutoff - #)) - "
     "cos(radians(u_SpotCutoff))), 0.0, 1.0)",
     "soft edge with an inner cutoff # degrees smaller", "The cone's edge is that of another book."},
    {GLSL_BUILT_IN, GLSL_POW, "$0 * smoothstep(cos(radians(u_SpotCutoff)), cos(radians(u_SpotCutoff * #)), cosine)",
     "smooth edge besides the fall-off", "The cone's edge is that of another book."},
    {GLSL_BUILT_IN, GLSL_COS, "$1", "angle for cosine: $1", ""},
    {GLSL_BUILT_IN, GLSL_COS, "sin($1)", "sin for cos: $1", ""},
    {GLSL_BUILT_IN, GLSL_RADIANS, "radians(0.5 * $1)", "half of $1", ""},
    {GLSL_BUILT_IN, GLSL_RADIANS, "radians($0)", "radians twice: $1", ""},
    {GLSL_BUILT_IN, GLSL_RADIANS, "degrees($1)", "degrees for radians: $1", ""},
    {GLSL_BUILT_IN, GLSL_LENGTH, "dot($1, $1)", "squared distance: $1", ""},
    {GLSL_BUILT_IN, GLSL_LENGTH, "length(v_Position)", "distance from the origin", ""},
    {GLSL_BUILT_IN, GLSL_LENGTH, "length(u_EyePosition - v_Position)", "distance to the eye", ""},
    {GLSL_BUILT_IN, GLSL_LENGTH, "length(u_LightPosition)", "distance of the light from the origin", ""},
    /* Shadows. */
    {ANY_NAME, GLSL_VEC2, "vec2($0.x, 1.0 - $0.y)", "y flipped: $0", ""},
    {ANY_NAME, GLSL_VEC2, "(0.5 * $0 + 0.5)", "mapped to 0 to 1 twice: $0", ""},
    {ANY_NAME, GLSL_VEC2, "(2.0 * $0 - 1.0)", "from -1 to 1: $0", "It is not mapped to 0 to 1."},
    {ANY_FLOAT, 0, "(2.0 * $0 - 1.0)", "from -1 to 1: $0", "It is not mapped to 0 to 1."},
    {ANY_FLOAT, 0, "(0.5 * $0 + 0.5)", "mapped to 0 to 1 twice: $0", ""},
    {GLSL_BINARY, GLSL_DIVIDE, "$1 / v_LightPosition.z", "divided by z, not w", ""},
    {ANY_FLOAT, 0, "length(u_LightPosition - v_Position)", "distance to the light for $0", ""},
    {ANY_VEC3, 0, "($0 - (1.0 - visibility()) * #)", "shadow subtracted: # of $0", ""},
    {ANY_VEC3, 0, "($0 - (1.0 - visibility()) * # * v_Color.rgb)", "shadow subtracted: # of the colour", ""},
    {ANY_VEC3, 0, "visibility() * $0", "shadow on $0, too", ""},
    {ANY_FLOAT, 0, "texture2D(u_ShadowMap, place.xy).r", "only the map's red for $0", ""},
    /* Colours. */
    {ANY_BOTH, 0, "$0 * @", "times @: $0", ""},
    {ANY_BOTH, 0, "($0 + @)", "@ added to $0", ""},
    {ANY_BOTH, 0, "$0 / @", "divided by @: $0", ""},
    {ANY_BOTH, 0, "$0 / length(@)", "divided by the length of @: $0", ""},
    {ANY_BOTH, 0, "$0 / length(u_LightPosition[0] - v_Position)", "divided by the distance: $0", ""},
    {ANY_BOTH, 0, "$0 / length(u_LightPosition[1] - v_Position)", "divided by the distance: $0", ""},
    {ANY_BOTH, 0, "$0 / length(u_LightPosition[i] - v_Position)", "divided by the distance: $0", ""},
    {ANY_BOTH, 0, "$0 / length(u_LightPosition[i] - position)", "divided by the distance: $0", ""},
    {ANY_BOTH, 0, "$0 / length(u_LightPosition - v_Position)", "divided by the distance: $0", ""},
    {ANY_BOTH, 0, "$0 * $0", "squared: $0", ""},
    {ANY_BOTH, 0, "sqrt($0)", "square root of $0", ""},
    {ANY_BOTH, 0, "# * $0", "times #: $0", "A number has no place here."},
    {ANY_BOTH, 0, "($0 + #)", "# added to $0", "A number has no place here."},
    {ANY_FLOAT, 0, "#", "# for $0", "A constant stands for a value."},
    {ANY_VEC3, 0, "vec3(#)", "# for $0", "A constant stands for a value."},
    {ANY_FLOAT, 0, "pow($0, #)", "to the power of #: $0", ""},
    {ANY_VEC3, 0, "pow($0, vec3(#))", "to the power of #: $0", TONE},
    {ANY_VEC3, 0, "$0 / ($0 + 1.0)", "tone-mapped, x / (x + 1): $0", TONE},
    {ANY_VEC3, 0, "(1.0 - exp(-$0))", "tone-mapped, 1 - exp(-x): $0", TONE},
    {ANY_VEC3, 0, "(1.0 - exp(-$0 * #))", "tone-mapped, 1 - exp(-# x): $0", TONE},
    {ANY_VEC3, 0, "pow($0 / ($0 + 1.0), vec3(#))", "tone-mapped and to the power of #: $0", TONE},
    {ANY_BOTH, 0, "min($0, 1.0)", "at most 1: $0", ""},
    {ANY_BOTH, 0, "min($0, #)", "at most #: $0", ""},
    {ANY_BOTH, 0, "max($0, #)", "at least #: $0", ""},
    {ANY_BOTH, 0, "(1.0 - $0)", "negative of $0", ""},
    {ANY_VEC3, 0, "vec3(dot($0, vec3(0.299, 0.587, 0.114)))", "grey: $0", ""},
    {ANY_VEC3, 0, "vec3(dot($0, vec3(0.2126, 0.7152, 0.0722)))", "grey: $0", ""},
    {ANY_VEC3, 0, "# * u_LightColor", "# times u_LightColor for $0", ""},
    {ANY_VEC3, 0, "# * (u_LightColor[0] + u_LightColor[1])", "# times the lights' colours for $0", ""},
    {ANY_VEC3, 0, "($0 + # * " RIM ")", "rim light added to $0", ""},
    {ANY_VEC3, 0, "($0 + # * " RIM " * " RIM ")", "rim light added to $0", ""},
    {ANY_VEC3, 0, "($0 + # * " RIM " * " RIM " * " RIM ")", "rim light added to $0", ""},
    {GLSL_LITERAL, GLSL_FLOAT, "#", "# for $0", "A number of the formula is another."},
    {GLSL_LITERAL, GLSL_FLOAT, "0.0", "0 for $0", "A number of the formula is another."},
    {GLSL_LITERAL, GLSL_FLOAT, "1.0", "1 for $0", "A number of the formula is another."},
};

enum { RULE_COUNT = sizeof RULES / sizeof RULES[0], MAX_NAMES = 48, NAME_SIZE = 72 };

typedef struct Maker {
    GlslTree *tree;
    const double *numbers;
    int number_count;
    MutationTake *take;
    void *context;
    bool ended;
    char *before, *after;  /* the text around the node */
    char operands[7][512]; /* the node's text, those of its children, and what a variable begins with,
                              of the first and the second light; 6: its first grandchild's */
    int node;
} Maker;

static const char MARK[] = "mutated_here";

/* A statement stays one. */
static void set_mark(GlslNode *node, int mark)
{
    const GlslNode was = *node;
    *node = (GlslNode){.kind = GLSL_NAME, .symbol = mark, .type = was.type, .next = was.next,
                       .place = was.place};
}

/* Prints the tree with a mark for the node. */
static bool cut(Maker *maker, int mark)
{
    GlslNode *node = &maker->tree->nodes[maker->node];
    const int target = node->kind == GLSL_EXPRESSION ? node->first : maker->node;
    const GlslNode was = maker->tree->nodes[target];
    set_mark(&maker->tree->nodes[target], mark);
    char *text = glsl_print(maker->tree, maker->tree->root);
    maker->tree->nodes[target] = was;
    char *at = strstr(text, MARK);
    if (at) {
        maker->before = memory_copy(text, (size_t)(at - text));
        maker->after = memory_text(at + strlen(MARK));
    }
    free(text);
    return at;
}

/* Replaces words of a text by their values in parentheses: variables by what they begin with, and
 * the loop's index by a number. */
static void replace_word(char *text, size_t size, const char *word, const char *by)
{
    const size_t length = strlen(word);
    char *rest;
    for (char *at = text; (at = strstr(at, word)); at++) {
        if ((at > text && text_is_word(at[-1])) || text_is_word(at[length]) ||
            strlen(text) + strlen(by) + 3 >= size)
            continue;
        rest = memory_text(at + length);
        at += snprintf(at, size - (size_t)(at - text), isdigit((unsigned char)by[0]) ? "%s" : "(%s)",
                       by);
        snprintf(at, size - (size_t)(at - text), "%s", rest);
        free(rest);
    }
}

/* The variable's value as its declaration has it, with a light's number for the index; "": it does
 * not depend on the light. */
static void read_light(const GlslTree *tree, int symbol, int light, char *text, size_t size)
{
    const int values = tree->node_count;
    text[0] = '\0';
    for (int round = 0; round < 3; round++) {
        for (int i = values - 1; i > 0; i--) {
            const GlslNode *at = &tree->nodes[i];
            char value[256];
            if (at->kind != GLSL_VARIABLE_NODE || !at->first ||
                tree->symbols[at->symbol].global || tree->symbols[at->symbol].type == GLSL_INT)
                continue;
            glsl_expression_text(tree, at->first, value, sizeof value);
            if (round == 0 && at->symbol == symbol)
                snprintf(text, size, "%s", value);
            else if (round > 0 && (strstr(value, "[i]") || strstr(value, "Direction")))
                replace_word(text, size, tree->symbols[at->symbol].name, value);
        }
    }
    if (strstr(text, "[i]"))
        replace_word(text, size, "i", light == 0 ? "0" : "1");
    else
        text[0] = '\0';
}

static void read_operands(Maker *maker)
{
    int child = maker->tree->nodes[maker->node].first;
    const bool statement = maker->tree->nodes[maker->node].kind == GLSL_EXPRESSION;
    glsl_expression_text(maker->tree, statement ? child : maker->node, maker->operands[0],
                         sizeof maker->operands[0]);
    for (int i = 1; i < 4; i++) {
        maker->operands[i][0] = '\0';
        if (child)
            glsl_expression_text(maker->tree, child, maker->operands[i],
                                 sizeof maker->operands[i]);
        child = child ? maker->tree->nodes[child].next : 0;
    }
    child = maker->tree->nodes[maker->tree->nodes[maker->node].first].first;
    maker->operands[6][0] = '\0';
    if (child)
        glsl_expression_text(maker->tree, child, maker->operands[6], sizeof maker->operands[6]);
    for (int light = 0; light < 2; light++) {
        maker->operands[4 + light][0] = '\0';
        if (maker->tree->nodes[maker->node].kind == GLSL_NAME)
            read_light(maker->tree, maker->tree->nodes[maker->node].symbol, light,
                       maker->operands[4 + light], sizeof maker->operands[0]);
    }
}

/* Whether an operand has to stand in parentheses: any operator binds it. */
static bool is_compound(const char *text)
{
    int depth = 0;
    for (const char *at = text; *at; at++) {
        depth += (*at == '(' || *at == '[') - (*at == ')' || *at == ']');
        if (depth == 0 && (*at == ' ' || *at == '-'))
            return true;
    }
    return false;
}

/* Fills in a rule's operands, name and number. `grouped`: as code, else as words. */
static void fill(const Maker *maker, const char *form, const char *name, const char *number,
                 bool grouped, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (const char *at = form; *at && used + 1 < size; at++) {
        const char *put = NULL;
        char one[2] = {*at, '\0'};
        if (*at == '$' && at[1] >= '0' && at[1] <= '6')
            put = maker->operands[*++at - '0'];
        else if (*at == '@')
            put = name;
        else if (*at == '#')
            put = number;
        const bool group = put && grouped && is_compound(put);
        used += (size_t)snprintf(text + used, size - used, group ? "(%s)" : "%s", put ? put : one);
    }
}

static void make(Maker *maker, int rule, const char *name, const char *number)
{
    Mutation mutation = {.node = maker->node, .sentence = RULES[rule].sentence, .rank = rule};
    char by[2048];
    fill(maker, RULES[rule].by, name, number, true, by, sizeof by);
    fill(maker, RULES[rule].name, name, number, false, mutation.name, sizeof mutation.name);
    snprintf(mutation.was, sizeof mutation.was, "%.159s", maker->operands[0]);
    snprintf(mutation.by, sizeof mutation.by, "%.159s", by);
    if (strcmp(by, maker->operands[0]) == 0 || (!by[0] && RULES[rule].by[0]))
        return;
    /* A statement is followed by its semicolon; within an expression anything is grouped. */
    const GlslNode *node = &maker->tree->nodes[maker->node];
    const bool whole = node->kind == GLSL_EXPRESSION || node->kind == GLSL_ASSIGN;
    char *text = memory_format(whole || !is_compound(by) ? "%s%s%s" : "%s(%s)%s", maker->before, by,
                               maker->after);
    maker->ended = !maker->take(maker->context, &mutation, text);
    free(text);
}

/* What may stand for a value of this type: other variables, their elements and their colours. */
static int names_of(const GlslTree *tree, int type, char names[MAX_NAMES][NAME_SIZE])
{
    static const char *const FORMS[] = {"%s", "%s[0]", "%s[1]", "%s[i]", "%s.rgb"};
    int count = 0;
    for (int i = 1; i < tree->symbol_count; i++) {
        const GlslSymbol *symbol = &tree->symbols[i];
        if (symbol->kind != GLSL_VARIABLE || symbol->built_in || !symbol->name[0] ||
            strcmp(symbol->name, MARK) == 0)
            continue;
        const bool element = tree->types[symbol->type].element == type;
        const bool color = type == GLSL_VEC3 && symbol->type == GLSL_VEC4;
        const int first = element ? 1 : color ? 4 : 0, last = element ? 3 : first;
        if (symbol->type != type && !element && !color)
            continue;
        for (int k = first; k <= last && count < MAX_NAMES; k++)
            snprintf(names[count++], NAME_SIZE, FORMS[k], symbol->name);
    }
    return count;
}

/* With each name and each number that the rule has. */
static void apply(Maker *maker, int rule)
{
    char names[MAX_NAMES][NAME_SIZE] = {""}, number[32] = "";
    const bool named = strchr(RULES[rule].by, '@'), numbered = strchr(RULES[rule].by, '#');
    const int type = maker->tree->nodes[maker->node].type;
    const int name_count = named ? names_of(maker->tree, type, names) : 1;
    for (int i = 0; i < name_count; i++) {
        for (int k = 0; k < (numbered ? maker->number_count : 1) && !maker->ended; k++) {
            if (numbered) {
                snprintf(number, sizeof number, "%.9g", maker->numbers[k]);
                strcat(number, strpbrk(number, ".e") ? "" : ".0");
            }
            make(maker, rule, names[i], number);
        }
    }
}

static bool is_name(const GlslNode *node)
{
    return node->kind == GLSL_NAME || node->kind == GLSL_INDEX || node->kind == GLSL_SWIZZLE;
}

static bool matches(const GlslNode *node, const Rule *rule)
{
    const bool literal = node->kind == GLSL_LITERAL || node->kind == GLSL_ASSIGN;
    switch (rule->kind) {
    case ANY_FLOAT:
        return node->type == GLSL_FLOAT && !literal;
    case ANY_VEC3:
        return node->type == GLSL_VEC3 && !literal;
    case ANY_BOTH:
        return (node->type == GLSL_VEC3 || node->type == GLSL_FLOAT) && !literal;
    case ANY_NAME:
        return rule->op == GLSL_BOOL ? node->type == GLSL_BOOL && !literal
               : rule->op            ? node->type == rule->op && is_name(node)
                                     : node->kind == GLSL_NAME;
    default:
        break;
    }
    if (node->kind != rule->kind)
        return false;
    return rule->kind == GLSL_BUILT_IN    ? rule->op < 0 || GLSL_FUNCTIONS[node->symbol].id == rule->op
           : rule->kind == GLSL_LITERAL || rule->kind == GLSL_CONSTRUCT ? node->type == rule->op
           : rule->kind == GLSL_BINARY || rule->kind == GLSL_UNARY || rule->kind == GLSL_ASSIGN
               ? node->op == rule->op
               : true;
}

static void mutate(Maker *maker, int node, int mark)
{
    maker->node = node;
    maker->before = maker->after = NULL;
    if (cut(maker, mark)) {
        read_operands(maker);
        for (int i = 0; i < RULE_COUNT && !maker->ended; i++)
            if (matches(&maker->tree->nodes[node], &RULES[i]))
                apply(maker, i);
    }
    free(maker->before);
    free(maker->after);
}

/* All nodes below, but what is assigned to. */
static void walk(Maker *maker, int node, int mark)
{
    const GlslNode *at = &maker->tree->nodes[node];
    const bool expression = at->kind >= GLSL_LITERAL && at->kind <= GLSL_CONSTRUCT;
    if (maker->ended)
        return;
    if ((expression && at->type != GLSL_VOID) || at->kind == GLSL_EXPRESSION)
        mutate(maker, node, mark);
    for (int i = at->first; i; i = maker->tree->nodes[i].next)
        if (at->kind != GLSL_ASSIGN || i != at->first)
            walk(maker, i, mark);
}

void mutations_each(GlslTree *tree, const double *numbers, int count, MutationTake *take,
                    void *context)
{
    Maker maker = {
        .tree = tree, .numbers = numbers, .number_count = count, .take = take, .context = context};
    *(GlslSymbol *)memory_add(&tree->symbols, &tree->symbol_count, &tree->symbol_room,
                              sizeof(GlslSymbol)) =
        (GlslSymbol){.name = MARK, .kind = GLSL_VARIABLE};
    walk(&maker, tree->root, tree->symbol_count - 1);
}
