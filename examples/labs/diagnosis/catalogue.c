/* The mistakes, with the labs where they can be made, their forms as choices, and what is said of
 * them. Below are the forms of a lab, alone, as numbers and in pairs. */
#include "labs/diagnosis/catalogue.h"

#include "base/memory.h"

#include <string.h>

#define L(n) (1u << (n))
enum {
    SHADED = L(1) | L(2) | L(4) | L(5) | L(6) | L(7) | L(8) | L(9) | L(10) | L(11),
    AMBIENT = L(2) | L(4) | L(5) | L(6) | L(7) | L(8) | L(9) | L(10) | L(11),
    SEVERAL = L(2) | L(4) | L(5) | L(6) | L(7),
    POINTS = L(4) | L(5) | L(6) | L(7) | L(8) | L(9) | L(10) | L(11),
    MOVING = L(4) | L(5) | L(6) | L(7) | L(8) | L(9) | L(11), /* point lights, moving objects */
    SCALED = L(3) | L(4) | L(5) | L(6) | L(7) | L(8) | L(9) | L(11),
    MOVED = L(1) | L(2) | SCALED,
    ROUND = L(5) | L(6) | L(7) | L(8) | L(10),
    SHINY = L(6) | L(7) | L(8) | L(10),
    PHONG = L(6) | L(8) | L(10),
};

/* The forms of a mistake. BOTH is one form of two changes. */
/* clang-format off */
#define CHANGE(slot, choice) {{SLOT_##slot, choice}}
#define ONE(slot, choice) {{{SLOT_##slot, choice}}}
#define EITHER(slot, a, b) {{{SLOT_##slot, a}}, {{SLOT_##slot, b}}}
#define BOTH(slot, choice, other, second) {{SLOT_##slot, choice}, {SLOT_##other, second}}
/* clang-format on */

/* Texts of several mistakes. */
#define PRODUCT "the order of the product in lab_matrices: the last factor is applied first, "
#define LIGHT_VECTOR "the light direction: u_LightPosition - point, at each point"
#define VIEW_VECTOR "the view vector: normalize(u_EyePosition - point)"
#define WHOLE_INVERSE "the normal matrix: the inverse transpose of the whole model matrix"
#define CLAMPED_COSINE "the cosine: max(dot(N, L), 0.0)"
#define AMBIENT_TERM "the ambient term: u_AmbientLight * colour"
#define ATTENUATION "the attenuation: 1.0 / (c + l d + q d d)"
#define FALL_OFF "the factor pow(cosine, u_SpotExponent)"
#define AMBIENT_OUTSIDE "the parentheses: u_AmbientLight is added outside them"

const Mistake MISTAKES[] = {
    /* The model matrix: lab 3. */
    {"moved before it is turned", L(3), ONE(ORDER, ORDER_MOVED_FIRST),
     "The cube circles around the origin: it is moved first, then turned.",
     PRODUCT "so it is move * turn * scale"},
    {"turned before it is scaled", L(3), ONE(ORDER, ORDER_SCALED_LAST),
     "The cube changes shape while it turns: it is turned first, then scaled.",
     PRODUCT "so it is move * turn * scale"},
    {"product in the reverse order", L(3), ONE(ORDER, ORDER_REVERSED),
     "Scale, turn and move are multiplied in the reverse order.",
     PRODUCT "because vectors are columns"},
    {"degrees for radians",
     L(3) | L(8),
     {CHANGE(TURN, TURN_RADIANS), CHANGE(TURN, TURN_DEGREES), CHANGE(CONE, CONE_DEGREES),
      CHANGE(CONE, CONE_DEGREES_TWICE), CHANGE(CONE, CONE_NONE)},
     "An angle in degrees is used as radians, or the reverse.",
     "every sine, cosine and rotation: mat4_rotate takes degrees, GLSL's cos takes radians(...)"},
    {"turned the wrong way", L(3), ONE(TURN_SIGN, SIGN_REVERSED),
     "The cube turns in the opposite direction.",
     "the signs of the angle and the axis: positive is counter-clockwise, seen from the axis's tip"},
    {"not turned", L(3), ONE(TURN, PART_MISSING), "The cube does not turn.",
     "the product in lab_matrices: it needs the rotation, and the rotation needs seconds"},
    {"not moved", L(3), ONE(MOVE, PART_MISSING), "The cube is not moved.",
     "the product in lab_matrices: it needs the translation"},
    {"not scaled", L(3), ONE(SCALE, PART_MISSING), "The cube is not scaled.",
     "the product in lab_matrices: it needs the scale"},
    {"model matrix transposed",
     L(3) | MOVING,
     {CHANGE(WORLD, WORLD_TRANSPOSED), CHANGE(PLACE, PLACE_TRANSPOSED)},
     "The model matrix is transposed: its translation ends up in w.",
     "the order u_ModelMatrix * a_Position; in C at m[4 * column + row]"},
    {"moved the wrong way", L(3), ONE(MOVE, PART_INVERSE),
     "The cube is moved in the opposite direction.", "the signs of the translation"},
    {"scaled inversely", L(3), ONE(SCALE, PART_INVERSE),
     "The cube is divided by the scale instead of multiplied.",
     "the scale factors, and at what you invert: only the normal matrix uses the inverse"},
    {"turned about another axis",
     L(3),
     {CHANGE(AXIS, AXIS_X), CHANGE(AXIS, AXIS_Y), CHANGE(AXIS, AXIS_Z)},
     "The cube turns about a coordinate axis instead of the task's axis.",
     "the axis of mat4_rotate"},
    {"model matrix never set", L(3), ONE(WORLD, WORLD_IDENTITY),
     "The model matrix is still the identity.", "the assignment to *world_from_model"},
    {"model matrix inverted", L(3), ONE(WORLD, WORLD_INVERSE),
     "The model matrix is inverted: it transforms from world to model space.",
     "which of the two matrices gets the inverse"},

    /* gl_Position. */
    {"upside down", SHADED, ONE(CLIP, CLIP_UPSIDE_DOWN), "The picture is upside down.",
     "the sign of y in gl_Position"},
    {"left and right swapped", SHADED, ONE(CLIP, CLIP_SWAPPED), "Left and right are swapped.",
     "the sign of x in gl_Position"},
    {"aspect ratio ignored", SHADED, ONE(CLIP, CLIP_ASPECT),
     "Shapes are stretched if the picture is not square.",
     "the projection: it contains width / height, and u_MvpMatrix contains the projection"},
    {"position matrix transposed", SHADED, ONE(CLIP, CLIP_TRANSPOSED),
     "The position is multiplied by the transposed matrix.",
     "the order: u_MvpMatrix * a_Position, not a_Position * u_MvpMatrix"},
    {"no depth test", SHADED, ONE(CLIP, CLIP_FLAT),
     "Far surfaces cover near ones: all have the same depth.",
     "the z of gl_Position: leave it as u_MvpMatrix * a_Position gives it"},
    {"depth reversed", SHADED & ~L(10), ONE(CLIP, CLIP_REVERSED),
     "Far surfaces cover near ones: the depth is reversed.", "the sign of z in gl_Position"},
    {"model matrix left out", SHADED & ~L(10), ONE(CLIP, CLIP_NO_MODEL),
     "The object is drawn without the model matrix: it neither turns nor moves.",
     "gl_Position: u_MvpMatrix includes the model matrix, u_ProjMatrix * u_ViewMatrix does not"},
    {"model matrix twice", MOVED & ~L(3), ONE(CLIP, CLIP_MODEL_TWICE),
     "The object is moved and turned twice.",
     "gl_Position: u_MvpMatrix includes the model matrix, so multiply it by a_Position"},
    {"matrices of the position in the wrong order, or one missing",
     SHADED,
     {CHANGE(CLIP, CLIP_VIEW_LAST), CHANGE(CLIP, CLIP_NO_VIEW), CHANGE(CLIP, CLIP_NO_PROJECTION)},
     "The object is elsewhere: the view or the projection is missing, or they are swapped.",
     "gl_Position: u_MvpMatrix * a_Position, or u_ProjMatrix * u_ViewMatrix * u_ModelMatrix"},
    {"front faces culled", SHADED & ~L(9), ONE(CULL, CULL_FRONT),
     "The inside shows: front faces are left out, back faces are drawn.",
     "the winding, and at what is culled or discarded by gl_FrontFacing"},

    /* The lit point. */
    {"point in object space", MOVING, ONE(PLACE, PLACE_OBJECT),
     "The light direction starts at a_Position, which is in object space, but the light is in world "
     "space.",
     "the lit point: vec3(u_ModelMatrix * a_Position)"},
    {"w = 0 for a point", MOVING, ONE(PLACE, PLACE_W_0),
     "The lit point is turned but not moved: it has w = 0, like a direction.",
     "vec4(a_Position.xyz, 1.0): points have w = 1"},
    {"point in clip space", MOVING | L(10), ONE(PLACE, PLACE_CLIP),
     "The lit point is gl_Position, which is in clip space.",
     "the lit point: vec3(u_ModelMatrix * a_Position)"},
    {"the wrong vector normalized",
     POINTS,
     {CHANGE(PLACE, PLACE_UNIT), CHANGE(LIGHT_SPACE, LIGHT_SPACE_UNIT),
      BOTH(LIGHT_SPACE, LIGHT_SPACE_UNIT, LIGHT_UNIT, UNIT_NEVER),
      BOTH(PLACE, PLACE_UNIT, LIGHT_UNIT, UNIT_NEVER)},
     "The light's position or the point is normalized instead of their difference.",
     "normalize(u_LightPosition - point)"},
    {"point by the normal matrix", MOVING, ONE(PLACE, PLACE_NORMAL_MATRIX),
     "The lit point is multiplied by the normal matrix.",
     "the lit point: vec3(u_ModelMatrix * a_Position)"},
    {"light transformed like the object",
     SCALED & ~L(3),
     {CHANGE(LIGHT_SPACE, LIGHT_SPACE_MODEL), CHANGE(LIGHT_SPACE, LIGHT_SPACE_NORMAL),
      CHANGE(LIGHT_SPACE, LIGHT_SPACE_MODEL_W_1)},
     "The light turns with the object: it is multiplied by the model or the normal matrix.",
     "the light: it is in world space already, use it as it is"},
    {"w = 0 for the light", POINTS, ONE(LIGHT_SPACE, LIGHT_SPACE_W_0),
     "The light's position is transformed to eye space like a direction, with w = 0.",
     "the light: (u_ViewMatrix * vec4(u_LightPosition, 1.0)).xyz"},
    {"world and eye space mixed",
     (MOVED & ~L(3)) | L(10),
     {CHANGE(NORMAL, NORMAL_EYE), CHANGE(PLACE, PLACE_EYE), CHANGE(LIGHT_SPACE, LIGHT_SPACE_EYE),
      BOTH(NORMAL, NORMAL_EYE, PLACE, PLACE_EYE), CHANGE(NORMAL, NORMAL_NOT_TO_EYE),
      CHANGE(PLACE, PLACE_NOT_TO_EYE), CHANGE(LIGHT_SPACE, LIGHT_SPACE_NOT_TO_EYE)},
     "Some vectors are in world space, others in eye space.",
     "the space of N, L and V: all in world space, or all in eye space"},

    /* Normals. */
    /* Without scale both draw the same. */
    {"normals not transformed, or the light too",
     L(1) | L(2),
     {CHANGE(NORMAL, NORMAL_OBJECT), CHANGE(LIGHT_SPACE, LIGHT_SPACE_MODEL),
      CHANGE(LIGHT_SPACE, LIGHT_SPACE_NORMAL), CHANGE(LIGHT_SPACE, LIGHT_SPACE_MODEL_W_1)},
     "The shading turns with the object: its normals stay in object space, or the light is "
     "multiplied by the object's matrix like them.",
     "the normal: multiply it by u_NormalMatrix, and the light by nothing"},
    {"normals not transformed", SCALED, ONE(NORMAL, NORMAL_OBJECT),
     "The shading turns with the object: its normals stay in object space.",
     "the normal: multiply it by u_NormalMatrix"},
    {"model matrix for normals", SCALED, ONE(NORMAL, NORMAL_MODEL),
     "Normals are multiplied by the model matrix: correct for rotation, wrong for uneven scaling.",
     "the normal: it needs the inverse transpose, u_NormalMatrix"},
    {"w = 1 for a direction",
     MOVED,
     {CHANGE(NORMAL, NORMAL_MODEL_W_1), BOTH(NORMAL, NORMAL_MODEL_W_1, NORMAL_UNIT, UNIT_AT_BOTH)},
     "Moving the object changes its shading: the normal is multiplied by the model matrix with "
     "w = 1, like a point.",
     "vec4(a_Normal.xyz, 0.0): directions have w = 0"},
    {"normalized with w = 1", SHADED & ~L(10), ONE(NORMAL_UNIT, UNIT_WITH_W),
     "The light is too weak: the normal is normalized as a vec4 with w = 1, so its xyz are shorter.",
     "normalize(n.xyz), or w = 0"},
    {"inverse without transpose", MOVED, ONE(NORMAL, NORMAL_INVERSE),
     "Normals are multiplied by the inverse of the model matrix instead of its inverse transpose: "
     "not transposed, transposed twice, or multiplied from the wrong side.",
     "the order u_NormalMatrix * a_Normal, and at every transpose"},
    {"transpose without inverse", SCALED, ONE(NORMAL, NORMAL_TRANSPOSE),
     "Normals are multiplied by the transposed model matrix; the inverse is missing.",
     "the normal matrix: invert, then transpose"},
    {"position for the normal", SHADED, EITHER(NORMAL, NORMAL_POSITION, NORMAL_WORLD_POSITION),
     "The normal is made from a_Position.", "the normal: u_NormalMatrix * vec4(a_Normal.xyz, 0.0)"},
    {"components of the normal swapped",
     SHADED,
     {CHANGE(NORMAL, NORMAL_XZY), CHANGE(NORMAL, NORMAL_YXZ), CHANGE(NORMAL, NORMAL_ZYX)},
     "Two components of the normal are swapped.",
     "the normal: a_Normal.xyz"},
    {"normals projected", SHADED, EITHER(NORMAL, NORMAL_CLIP, NORMAL_VIEW),
     "The normal is multiplied by the projection or the view matrix.",
     "the normal: u_NormalMatrix * vec4(a_Normal.xyz, 0.0)"},
    {"normals only turned", L(3), ONE(NORMAL, NORMAL_TURN),
     "Normals are only turned: their matrix lacks the scale.", WHOLE_INVERSE},
    {"normal matrix of another product", L(3), ONE(NORMAL, NORMAL_REVERSED),
     "Normals are transformed as if the cube were turned first, then scaled.",
     "the normal matrix: the inverse transpose of the very model matrix"},
    {"normals not turned", L(3), ONE(NORMAL, NORMAL_UNTURNED),
     "Normals are not turned: their matrix has only the scale.", WHOLE_INVERSE},
    {"normal reversed", L(3) | SHINY, ONE(NORMAL_SIGN, SIGN_REVERSED), "Normals point inwards.",
     "the sign of the normal"},
    {"normal not normalized", L(4) | L(9) | L(11), ONE(NORMAL_UNIT, UNIT_NEVER),
     "Scaled objects are too bright or too dark: the transformed normal does not have length 1.",
     "the normal: normalize(...) after u_NormalMatrix"},
    {"not renormalized per fragment",
     ROUND,
     {CHANGE(NORMAL_UNIT, UNIT_AT_VERTICES),
      CHANGE(NORMAL_UNIT, UNIT_NEVER),
      BOTH(NORMAL_UNIT, UNIT_NEVER, COSINE, COSINE_SATURATED),
      {{SLOT_NORMAL_UNIT, UNIT_NEVER},
       {SLOT_COSINE, COSINE_SATURATED},
       {SLOT_POWER, POWER_SATURATED}}},
     "The fragment shader's normal does not have length 1: interpolation may shorten it between "
     "the vertices, and scaling the object changes it everywhere.",
     "the fragment shader's normal: normalize(v_Normal)"},

    /* The direction to the light. */
    {"light direction reversed", SHINY, ONE(LIGHT_SIGN, SIGN_REVERSED),
     "The bright side is opposite the light: the light direction is reversed.",
     "the light direction: from the point to the light, light - point"},
    /* Without a highlight both draw the same. */
    {"light direction or normal reversed", SHADED & ~SHINY, ONE(LIGHT_SIGN, SIGN_REVERSED),
     "The bright side is opposite the light: the light direction or the normal is reversed.",
     "the light direction: from the point to the light, light - point; and the normal's sign"},
    {"light direction not normalized",
     POINTS,
     {CHANGE(LIGHT_UNIT, UNIT_NEVER),
      BOTH(LIGHT_UNIT, UNIT_NEVER, COSINE, COSINE_SATURATED),
      {{SLOT_LIGHT_UNIT, UNIT_NEVER},
       {SLOT_COSINE, COSINE_SATURATED},
       {SLOT_POWER, POWER_SATURATED}}},
     "The farther the light, the brighter: the light direction is not normalized.",
     "normalize(u_LightPosition - point)"},
    {"light direction normalized only at the vertices", ROUND, ONE(LIGHT_UNIT, UNIT_AT_VERTICES),
     "The light direction is normalized at the vertices and interpolated; between them it is "
     "shorter than 1.",
     "the fragment shader: normalize the direction there, or interpolate the point instead"},
    {"light direction from the object's centre",
     MOVING,
     {CHANGE(LIGHT, LIGHT_FROM_CENTER), BOTH(LIGHT, LIGHT_FROM_CENTER, VIEW, VIEW_FIXED_CENTER)},
     "The whole object has one light direction, that of its centre.",
     LIGHT_VECTOR},
    {"point light treated as directional", POINTS, ONE(LIGHT, LIGHT_FROM_ORIGIN),
     "The shading ignores the object's position: the light's position is used as a direction.",
     LIGHT_VECTOR},
    {"only the first light", SEVERAL, ONE(LIGHTS, LIGHTS_FIRST), "The second light is missing.",
     "the loop over the lights, or its sum"},
    {"only the second light", SEVERAL, ONE(LIGHTS, LIGHTS_SECOND), "The first light is missing.",
     "the sum over the lights: use +=, because = keeps only the last light"},
    {"light indices swapped", SEVERAL, ONE(LIGHTS, LIGHTS_SWAPPED),
     "Each light has the other's colour.", "the indices: u_LightColor[i] goes with light i"},
    {"one light's direction used twice", SEVERAL,
     EITHER(LIGHTS, LIGHTS_FIRST_PLACE, LIGHTS_SECOND_PLACE),
     "Both lights come from one direction.", "the indices of the lights' directions or positions"},
    {"one light's colour used twice", SEVERAL,
     EITHER(LIGHTS, LIGHTS_FIRST_COLOR, LIGHTS_SECOND_COLOR), "Both lights have one colour.",
     "the indices of u_LightColor"},
    {"one light's direction reversed", SEVERAL,
     EITHER(LIGHTS, LIGHTS_FIRST_REVERSED, LIGHTS_SECOND_REVERSED),
     "One of the two lights comes from the opposite side.", "the signs of the lights' directions"},
    {"larger of the lights", SEVERAL, ONE(LIGHTS, LIGHTS_LARGER),
     "Only the stronger light counts: the larger of the two is taken.",
     "the sum over the lights: +=, not max(...)"},
    {"lights multiplied", SEVERAL, ONE(LIGHTS, LIGHTS_PRODUCT),
     "The lights are multiplied instead of added.", "the sum over the lights: +=, not *="},
    {"mean of the lights", SEVERAL, ONE(LIGHTS, LIGHTS_MEAN),
     "The lights are averaged instead of added.", "the sum over the lights: do not divide it"},
    {"light colour ignored", SHADED, ONE(LIGHT_COLOR, LIGHT_COLOR_IGNORED), "All light is white.",
     "the diffuse term: multiply it by u_LightColor"},
    {"red for all of the light's colour", SHADED, ONE(LIGHT_COLOR, LIGHT_COLOR_RED),
     "Only the red component of the light's colour is used.", "each use of u_LightColor"},
    {"light colour twice", SHADED, ONE(LIGHT_COLOR, LIGHT_COLOR_SQUARED),
     "The light is too dark and too saturated: its colour is multiplied twice.",
     "each use of u_LightColor"},

    /* The diffuse term. */
    {"w = 1 in the dot product", L(1) | L(2), ONE(COSINE, COSINE_PLUS_ONE),
     "It is too bright by one: N and L have w = 1, and their dot product contains it.",
     "the cosine: dot(N.xyz, L.xyz)"},
    {"cosine inverted", SHADED, ONE(COSINE, COSINE_INVERTED),
     "What faces the light is dark: the cosine is subtracted from 1.", CLAMPED_COSINE},
    /* Where the cosine is negative, lab 11 has the objects' own shadows. */
    {"missing clamp",
     AMBIENT & ~L(11),
     {CHANGE(COSINE, COSINE_UNCLAMPED), CHANGE(COSINE, COSINE_UNCLAMPED_FIRST),
      CHANGE(COSINE, COSINE_UNCLAMPED_SECOND)},
     "The unlit side is darker than the ambient light: its cosine is negative.",
     CLAMPED_COSINE},
    {"sum of the lights clamped, not each cosine", SEVERAL, ONE(COSINE, COSINE_SUM_CLAMPED),
     "A light behind a face takes from the other: the sum is clamped instead of each cosine.",
     CLAMPED_COSINE ", for each light"},
    {"cosine squared", SHADED, ONE(COSINE, COSINE_SQUARED),
     "Light falls off too fast: the cosine is multiplied twice.", CLAMPED_COSINE ", once"},
    {"sine for the cosine", SHADED, ONE(COSINE, COSINE_SINE),
     "Light is strongest where it grazes the surface.", CLAMPED_COSINE},
    {"angle for the cosine", SHADED, ONE(COSINE, COSINE_ANGLE),
     "The angle itself is used instead of its cosine.", CLAMPED_COSINE},
    {"lit or not, without shades", SHADED, ONE(COSINE, COSINE_STEP),
     "Every lit part is equally bright: the cosine only decides whether it is lit.",
     "the diffuse term: multiply it by max(dot(N, L), 0.0)"},
    {"lit where it faces away, without shades", SHADED & ~L(11), ONE(COSINE, COSINE_STEP_REVERSED),
     "All that faces away from the light is lit, equally bright: the arguments of step are swapped, "
     "or the light direction is reversed and the cosine only decides whether it is lit.",
     "the diffuse term: multiply it by max(dot(N, L), 0.0)"},
    {"min for max", SHADED & ~L(11), ONE(COSINE, COSINE_MIN),
     "The lit side is dark: the cosine is clamped from above.", CLAMPED_COSINE ", not min"},
    {"cosine clamped above 0", SHADED, ONE(COSINE, COSINE_FLOOR),
     "The shade is too bright: the cosine is clamped to a number above 0.", CLAMPED_COSINE},
    {"light clamped before it is multiplied by the colour",
     SHADED,
     {CHANGE(LIMIT, LIMIT_ALL), CHANGE(LIMIT, LIMIT_DIFFUSE), CHANGE(LIMIT, LIMIT_EACH),
      CHANGE(NUMBER, FACTOR_LIMIT)},
     "Strong light is cut off at 1 before it is multiplied by the object's colour.",
     "min or clamp: the sum of the light may exceed 1"},
    {"absolute value of the cosine", SHADED & ~L(11), ONE(COSINE, COSINE_ABSOLUTE),
     "The side facing away from the light is lit too.", CLAMPED_COSINE ", not abs"},
    {"no cosine", SHADED, ONE(COSINE, COSINE_NONE),
     "Every side is equally bright: the cosine is missing.",
     "the diffuse term: multiply it by max(dot(N, L), 0.0)"},
    {"cosine shifted", SHADED, ONE(COSINE, COSINE_WRAPPED),
     "Light reaches around the object: the cosine is halved and shifted.", CLAMPED_COSINE " alone"},
    {"colour used twice", SHADED, ONE(COLOR, COLOR_SQUARED),
     "The object's colour is too dark and too saturated: it is multiplied twice.",
     "each use of a_Color, in both shaders"},
    {"colour added", SHADED, ONE(COLOR, COLOR_ADDED),
     "The object's colour is added to the light instead of multiplied.",
     "the sum: multiply the light by a_Color"},
    {"colour missing in the diffuse term", AMBIENT, ONE(COLOR, COLOR_LIT_IGNORED),
     "Where it is lit the object is white; its shade has its colour.",
     "the diffuse term: multiply it by a_Color"},
    {"colour twice in the diffuse term", AMBIENT, ONE(COLOR, COLOR_LIT_SQUARED),
     "Where it is lit the object is too dark and too saturated: the diffuse term is multiplied by "
     "its colour twice.",
     "each use of a_Color, in both shaders"},
    {"colour ignored", SHADED, ONE(COLOR, COLOR_IGNORED), "The object is white.",
     "the sum: multiply the diffuse and the ambient term by a_Color"},

    /* Ambient light. */
    {"ambient missing", AMBIENT, ONE(AMBIENT, AMBIENT_MISSING), "The shade is black.",
     "the sum: + u_AmbientLight * colour"},
    {"ambient added per light", SEVERAL, ONE(AMBIENT, AMBIENT_PER_LIGHT),
     "Every light brightens the shade too: the ambient light is added once per light.",
     "the loop: add the ambient light once, outside it"},
    {"ambient multiplied by the cosine", AMBIENT, ONE(AMBIENT, AMBIENT_COSINE),
     "The shade is black and the rest too bright: the ambient light is multiplied by the cosine.",
     "the parentheses: add the ambient light after multiplying by the cosine"},
    {"ambient without the colour", AMBIENT, ONE(AMBIENT, AMBIENT_PLAIN),
     "The shade is grey: the ambient light is not multiplied by the object's colour.",
     AMBIENT_TERM},
    {"ambient times the light's colour", AMBIENT, ONE(AMBIENT, AMBIENT_LIGHT_COLOR),
     "The shade is tinted: the ambient light is multiplied by the light's colour.",
     AMBIENT_TERM ", nothing else"},
    {"ambient light ignored", AMBIENT, ONE(AMBIENT, AMBIENT_WHITE),
     "The object's own colour is added as if the ambient light were white.", AMBIENT_TERM},
    {"ambient light twice", AMBIENT, ONE(AMBIENT, AMBIENT_SQUARED),
     "The shade is too dark: the ambient light is multiplied twice.", AMBIENT_TERM},
    {"ambient of the back in the front's colour", L(9), ONE(AMBIENT, AMBIENT_FRONT),
     "The back's ambient light has the front's colour.", "u_BackColor * u_AmbientLight"},
    {"no ambient light where it is lit", AMBIENT,
     EITHER(AMBIENT, AMBIENT_NOT_LIT, AMBIENT_NOT_CONE),
     "Lit parts lack the ambient light: there it is replaced.",
     "the assignment of the light: +=, not ="},
    {"ambient light only where it is lit", AMBIENT, ONE(AMBIENT, AMBIENT_ONLY_LIT),
     "What no light reaches is black: the ambient light is added only where a light shines.",
     "the branch: add the ambient light outside it"},
    {"no ambient light on the back", L(9), ONE(AMBIENT, AMBIENT_NOT_BACK),
     "The back lacks the ambient light.", "u_BackColor * u_AmbientLight"},
    {"larger of ambient and diffuse", AMBIENT, ONE(AMBIENT, AMBIENT_LARGER),
     "Lit parts lack the ambient light: the larger of the two is taken.",
     "the sum: ambient + diffuse, not max(...)"},

    /* The highlight. */
    {"no highlight", SHINY, ONE(REFLECTION, REFLECTION_NONE), "There is almost no highlight.",
     "the specular term: whether it is added, and the signs of L and V"},
    /* R and V of opposite signs draw the same. */
    {"reflect's or the view vector's sign",
     PHONG,
     {CHANGE(REFLECTION, REFLECTION_SIGN), CHANGE(VIEW, VIEW_REVERSED),
      CHANGE(VIEW, VIEW_NEGATED_EYE)},
     "The highlight is on the wrong side: reflect gets the direction to the light, or the view "
     "vector points away from the eye.",
     "reflect(-L, N): its first argument points to the surface; and at u_EyePosition - point"},
    {"the other reflection model", SHINY,
     EITHER(REFLECTION, REFLECTION_OTHER, REFLECTION_OTHER_FITTED),
     "The highlight is that of the other model: Blinn-Phong instead of Phong, or the reverse.",
     "the highlight's cosine: dot(R, V) is Phong's, dot(N, H) Blinn-Phong's"},
    {"half vector not normalized",
     SHINY,
     {CHANGE(REFLECTION, REFLECTION_HALF_RAW), CHANGE(REFLECTION, REFLECTION_SUM),
      BOTH(REFLECTION, REFLECTION_SUM, POWER, POWER_SATURATED)},
     "The highlight is too weak or far too strong: the half vector does not have length 1.",
     "normalize(L + V)"},
    {"half vector of vectors that are not normalized", SHINY, ONE(REFLECTION, REFLECTION_RAW_HALF),
     "The half vector is nearer to the longer of the two vectors that are added.",
     "normalize(L + V): L and V have length 1 before they are added"},
    /* The same with Blinn-Phong. */
    {"view vector reversed, or subtracted",
     L(7),
     {CHANGE(REFLECTION, REFLECTION_HALF_DIFFERENCE), CHANGE(VIEW, VIEW_REVERSED),
      CHANGE(VIEW, VIEW_NEGATED_EYE)},
     "The half vector is that of L - V: V points from the eye to the point, or is subtracted.",
     VIEW_VECTOR ", and at normalize(L + V)"},
    {"half vector of the difference", PHONG, ONE(REFLECTION, REFLECTION_HALF_DIFFERENCE),
     "The half vector is that of L - V.", "normalize(L + V)"},
    {"wrong vectors in the highlight",
     SHINY,
     {CHANGE(REFLECTION, REFLECTION_N_V), CHANGE(REFLECTION, REFLECTION_L_V),
      CHANGE(REFLECTION, REFLECTION_H_V), CHANGE(REFLECTION, REFLECTION_R_H)},
     "The highlight's cosine is that of two other vectors: N and V, L and V, H and V, or R and H.",
     "the highlight's cosine: dot(R, V) is Phong's, dot(N, H) Blinn-Phong's"},
    {"reflect's arguments swapped", PHONG,
     EITHER(REFLECTION, REFLECTION_SWAPPED, REFLECTION_SWAPPED_SIGN),
     "The highlight is in the wrong place: the normal is reflected at the light direction.",
     "reflect(-L, N): the normal is the second argument"},
    {"factor 2 of the reflection missing", PHONG, ONE(REFLECTION, REFLECTION_ONE),
     "The highlight is too dim and too wide: R lacks its factor 2, and is no unit vector.",
     "R: 2.0 * dot(N, L) * N - L, or reflect(-L, N)"},
    {"power approximated", SHINY, ONE(POWER, POWER_SCHLICK),
     "The highlight has another profile: its power is approximated by a quotient.",
     "pow(cosine, exponent)"},
    {"pow's arguments swapped", SHINY, ONE(POWER, POWER_SWAPPED),
     "The highlight covers everything: pow gets the exponent first.",
     "pow(cosine, exponent): the base comes first"},
    {"multiplied by the shininess", SHINY, ONE(POWER, POWER_FACTOR),
     "The cosine is multiplied by the shininess instead of raised to it.", "pow(cosine, exponent)"},
    {"highlight of one light only", L(6) | L(7),
     EITHER(HIGHLIGHT_LIGHTS, HIGHLIGHT_LIGHTS_FIRST, HIGHLIGHT_LIGHTS_SECOND),
     "Only one of the two lights has a highlight.",
     "the loop: the specular term is inside it, and added with +="},
    {"view vector in object space", L(6) | L(7) | L(8), ONE(VIEW, VIEW_OBJECT_SPACE),
     "The view vector ends at a_Position, which is in object space.", VIEW_VECTOR},
    {"view vector from the wrong space",
     SHINY,
     {CHANGE(VIEW, VIEW_WORLD_ORIGIN), CHANGE(VIEW, VIEW_EYE_SPACE), CHANGE(VIEW, VIEW_NOT_TO_EYE)},
     "The highlight does not follow the camera: the view vector assumes that the eye is at the "
     "origin, or it is in eye space and the others are in world space.",
     VIEW_VECTOR ", both in world space"},
    {"fixed view vector",
     SHINY,
     {CHANGE(VIEW, VIEW_FIXED_EYE), CHANGE(VIEW, VIEW_FIXED_Z), CHANGE(VIEW, VIEW_FIXED_AXIS),
      CHANGE(VIEW, VIEW_FIXED_CENTER)},
     "The view vector is the same at every point.",
     VIEW_VECTOR ", at each point"},
    {"view vector not normalized", SHINY, ONE(VIEW, VIEW_RAW),
     "The highlight is far too large: the view vector is not normalized.", VIEW_VECTOR},
    {"specular on the dark side", SHINY, ONE(GATE, GATE_OPEN),
     "The highlight also shows on the unlit side.", "the specular term: only if dot(N, L) > 0.0"},
    {"highlight times the cosine", SHINY, ONE(GATE, GATE_COSINE),
     "The highlight is too dark near the edge of the light: it is multiplied by the cosine.",
     "the parentheses: multiply only the diffuse term by the cosine"},
    {"pow of a negative number", PHONG, ONE(POWER, POWER_ANY),
     "If the highlight's cosine is negative, pow is undefined and anything may be drawn.",
     "pow(max(dot(R, V), 0.0), u_Shininess)"},
    {"absolute value in the highlight", PHONG, ONE(POWER, POWER_ABSOLUTE),
     "There is a second highlight, opposite the first.", "max(dot(R, V), 0.0), not abs"},
    {"shininess ignored", SHINY, ONE(EXPONENT, EXPONENT_ONE),
     "The highlight covers everything: its exponent is missing.", "pow(..., u_Shininess)"},
    {"shininess not fitted", L(7), ONE(EXPONENT, EXPONENT_PLAIN),
     "The highlight is about twice as wide as Phong's: the exponent is Phong's own.",
     "the exponent: Blinn-Phong needs about 4 times as much"},
    {"shininess squared", L(7), ONE(EXPONENT, EXPONENT_SQUARED),
     "The highlight is far too small: the exponent is the shininess's square.",
     "the exponent: about 4 times u_Shininess"},
    {"shininess fitted the wrong way", L(7), ONE(EXPONENT, EXPONENT_QUARTER),
     "The highlight is far too wide: the exponent is divided instead of multiplied.",
     "the exponent: about 4 times u_Shininess"},
    {"highlight in the object's colour", SHINY, ONE(HIGHLIGHT_COLOR, HIGHLIGHT_TINTED),
     "The highlight has the object's colour.", "the specular term: u_SpecularColor, not a_Color"},
    {"highlight normalized for energy", SHINY,
     EITHER(HIGHLIGHT_COLOR, HIGHLIGHT_ENERGY_2, HIGHLIGHT_ENERGY_8),
     "The highlight is multiplied by a factor that grows with the exponent, as physically based "
     "renderers do.",
     "the specular term: no (n + 2) / 2 pi, no (n + 8) / 8 pi"},
    {"light colour ignored in the highlight", SHINY, ONE(HIGHLIGHT_COLOR, HIGHLIGHT_WHITE_LIGHT),
     "The highlight ignores the light's colour.", "the specular term: multiply it by u_LightColor"},
    {"specular colour ignored", SHINY, ONE(HIGHLIGHT_COLOR, HIGHLIGHT_WHITE),
     "The highlight is too bright: the specular colour is missing.",
     "the specular term: multiply it by u_SpecularColor"},

    {"light at the vertices", ROUND | L(11), ONE(STAGE, STAGE_VERTICES),
     "The mesh shows: the light is computed at the vertices and interpolated.",
     "the fragment shader: compute the light there; pass on normal and point"},

    /* The spot light. */
    {"attenuation missing", L(8), ONE(FADE, FADE_MISSING),
     "The light is as strong far away as nearby.", ATTENUATION},
    {"attenuation inverted", L(8), ONE(FADE, FADE_INVERTED),
     "The farther, the brighter: the light is multiplied by the attenuation's divisor.",
     ATTENUATION},
    {"attenuation by the square", L(8), ONE(FADE, FADE_SQUARED),
     "The square of the distance is used as the distance.",
     "d: length(...), not dot(v, v) or d * d"},
    {"attenuation by the inverse square", L(8), ONE(FADE, FADE_INVERSE_SQUARE),
     "The light is divided by the squared distance, whatever u_Attenuation is.", ATTENUATION},
    {"attenuation where none is asked for",
     POINTS & ~L(8),
     {CHANGE(FADE, FADE_INVERSE_SQUARE), CHANGE(FADE, FADE_INVERSE),
      CHANGE(FADE, FADE_ONE_PLUS_SQUARE), CHANGE(FADE, FADE_TUTORIAL),
      CHANGE(NUMBER, FACTOR_FADE_LINEAR), CHANGE(NUMBER, FACTOR_FADE_SQUARE)},
     "The light weakens with distance; this task has no attenuation.",
     "the distance: normalize the direction to the light, and divide by nothing else"},
    {"attenuation twice", L(8), ONE(FADE, FADE_TWICE),
     "It falls off too fast: the light is divided by the attenuation's divisor twice.",
     ATTENUATION},
    {"constants for the attenuation", L(8), ONE(FADE, FADE_TUTORIAL),
     "The attenuation's factors are constants, 1, 0.09 and 0.032, not u_Attenuation.", ATTENUATION},
    {"attenuation's factors swapped", L(8), ONE(FADE, FADE_SWAPPED),
     "The linear and the quadratic factor are swapped.",
     "u_Attenuation: x constant, y linear, z quadratic"},
    {"wrong power of the distance", L(8), EITHER(FADE, FADE_ALL_LINEAR, FADE_ALL_SQUARED),
     "Both factors are multiplied by the distance, or both by its square.",
     "u_Attenuation.y * d + u_Attenuation.z * d * d"},
    {"attenuation by the distance to the eye", L(8), ONE(FADE, FADE_EYE),
     "The distance is that to the eye, not to the light.",
     "the distance: length(u_LightPosition - point)"},
    {"attenuation without the linear part", L(8), ONE(FADE, FADE_NO_LINEAR),
     "The linear part of the attenuation is missing.", "u_Attenuation.y * d"},
    {"attenuation without the quadratic part", L(8), ONE(FADE, FADE_NO_QUADRATIC),
     "The quadratic part of the attenuation is missing.", "u_Attenuation.z * d * d"},
    {"attenuation without the constant part", L(8), ONE(FADE, FADE_NO_CONSTANT),
     "The constant part of the attenuation is missing.", "u_Attenuation.x"},
    {"distance of a unit vector", L(8), ONE(FADE, FADE_UNIT),
     "The attenuation is the same everywhere: the distance is that of the normalized direction, 1.",
     "the distance: length(u_LightPosition - point), before normalize"},
    {"attenuation of the ambient light", L(8), ONE(FADE_ON, ON_AMBIENT),
     "The ambient light weakens with distance too.", AMBIENT_OUTSIDE},
    {"highlight without attenuation", L(8), ONE(FADE_ON, ON_NO_HIGHLIGHT),
     "The highlight does not weaken with distance.",
     "the parentheses: multiply the highlight by the attenuation too"},
    {"angle compared with a cosine", L(8), EITHER(CONE, CONE_ANGLE, CONE_ANGLE_DEGREES),
     "The cosine of the angle to the axis is compared with the cutoff angle itself.",
     "the comparison: dot(-L, axis) >= cos(radians(u_SpotCutoff))"},
    {"cutoff converted twice", L(8), ONE(CONE, CONE_RADIANS_TWICE),
     "The cone is too narrow for anything to be lit: the cutoff is converted to radians twice.",
     "every use of radians: cos(radians(u_SpotCutoff)), once"},
    {"neither cone nor attenuation",
     L(8),
     {{{SLOT_CONE, CONE_NONE}, {SLOT_CONE_FALL_OFF, FALL_OFF_NONE}, {SLOT_FADE, FADE_MISSING}}},
     "It is lit as by the point light of lab 6.",
     "the light: multiply it by the spot's factor and the attenuation"},
    {"no cutoff", L(8), ONE(CONE, CONE_NONE), "The cone has no edge.",
     "the comparison with cos(radians(u_SpotCutoff))"},
    {"cutoff taken for the whole angle", L(8), ONE(CONE, CONE_WHOLE),
     "The cone is half as wide: the cutoff is used as the cone's whole angle.",
     "cos(radians(u_SpotCutoff)): do not halve the angle"},
    {"light outside the cone", L(8), ONE(CONE, CONE_OUTSIDE),
     "Outside the cone it is lit, inside it is dark.",
     "the comparison: inside, the cosine is larger"},
    {"spot direction in another space",
     L(8),
     {CHANGE(CONE_SIGN, AXIS_NOT_TO_EYE), CHANGE(CONE_SIGN, AXIS_TO_EYE),
      CHANGE(CONE_SIGN, AXIS_W_1), CHANGE(CONE_SIGN, AXIS_W_1_UNIT)},
     "The cone's axis and the direction to the light are in different spaces, or the axis has w = 1.",
     "u_SpotDirection: it is in world space, so transform it, with w = 0, if the light is in eye "
     "space"},
    {"spot direction reversed", L(8), ONE(CONE_SIGN, AXIS_REVERSED),
     "The cone points in the opposite direction.", "the sign in dot(-L, u_SpotDirection)"},
    {"cutoff in degrees compared with degrees of a cosine", L(8), ONE(CONE, CONE_HARD_COSINE),
     "A cosine is converted as if it were an angle.",
     "the comparison: dot(-L, axis) >= cos(radians(u_SpotCutoff))"},
    {"fall-off of another formula",
     L(8),
     {CHANGE(CONE_FALL_OFF, FALL_OFF_LINEAR), CHANGE(CONE_FALL_OFF, FALL_OFF_SMOOTH),
      CHANGE(CONE_FALL_OFF, FALL_OFF_SHININESS), CHANGE(CONE_FALL_OFF, FALL_OFF_LINEAR_POWER)},
     "The cone's edge is linear, a smoothstep, or has the shininess as its exponent.",
     FALL_OFF},
    {"no soft edge", L(8), ONE(CONE_FALL_OFF, FALL_OFF_NONE),
     "The light is as strong at the cone's edge as on its axis.", FALL_OFF},
    {"spot exponent ignored", L(8), ONE(CONE_FALL_OFF, FALL_OFF_ONE),
     "The light falls off too slowly towards the cone's edge: the exponent is missing.", FALL_OFF},
    {"ambient only within the cone", L(8), ONE(CONE_ON, ON_AMBIENT),
     "Outside the cone it is black: the cone limits the ambient light too.", AMBIENT_OUTSIDE},
    {"highlight outside the cone", L(8), ONE(CONE_ON, ON_NO_HIGHLIGHT),
     "The highlight ignores the cone.",
     "the parentheses: multiply the highlight by the spot's factor too"},

    /* Two sides. */
    {"back not lit", L(9), ONE(FACING, FACING_NONE),
     "The back is drawn like the front, with its colour and its normal.",
     "gl_FrontFacing or the sign of dot(N, V): use one of them"},
    {"back in the front's colour", L(9), ONE(BACK, BACK_FRONT_COLOR),
     "The back has the front's colour.", "u_BackColor"},
    {"normal reversed in a mirror", L(9), ONE(NORMAL_SIGN, SIGN_MIRRORED),
     "In a mirror the normal is reversed: it is multiplied by u_Mirrored, although u_NormalMatrix "
     "mirrors it already, or its sign depends on gl_FrontFacing without u_Mirrored.",
     "what reverses the normal: only the back, and in a mirror gl_FrontFacing is true there"},
    {"colours swapped in a mirror", L(9), ONE(BACK, BACK_COLORS_MIRRORED),
     "When mirrored, front and back have each other's colour; the normals are right.",
     "the branch that chooses the colour: gl_FrontFacing is inverted if u_Mirrored is -1.0"},
    {"colours of front and back multiplied", L(9), ONE(BACK, BACK_PRODUCT),
     "The back's colour is multiplied by the front's.", "the back's colour: u_BackColor alone"},
    {"colours of front and back swapped", L(9), ONE(BACK, BACK_COLORS_SWAPPED),
     "The front has the back's colour, and the back the front's.",
     "the branch that chooses the colour"},
    {"back's normal not reversed", L(9), ONE(BACK, BACK_NOT_REVERSED),
     "The back is lit by a light in front: its normal is not reversed.",
     "the normal on the back: -N"},
    {"front and back swapped in a mirror", L(9), ONE(FACING, FACING_UNMIRRORED),
     "When mirrored, front and back are swapped: a mirror reverses the triangles' winding, and with "
     "it gl_FrontFacing; the sign of dot(N, V) it leaves as it is.",
     "u_Mirrored: gl_FrontFacing is inverted if it is -1.0; dot(N, V) needs it nowhere"},
    {"front and back swapped", L(9), EITHER(FACING, FACING_SWAPPED, FACING_VIEW_SWAPPED),
     "Front and back are swapped.", "the branch that depends on gl_FrontFacing or dot(N, V)"},
    {"side by the camera's axis", L(9), EITHER(FACING, FACING_AXIS, FACING_EYE),
     "The side depends on one direction to the camera, which is right for a parallel projection only.",
     "dot(N, V): V is u_EyePosition - point, not u_EyePosition or the normal's z in eye space"},
    {"always taken as mirrored", L(9), ONE(FACING, FACING_MIRRORED),
     "When it is not mirrored, front and back are swapped.",
     "u_Mirrored: it is -1.0 in a mirror and else 1.0, so compare it with 0.0"},
    {"side by an eye at the origin", L(9), ONE(FACING, FACING_ORIGIN),
     "The side is wrong near its edges: the direction to the eye is that to the world's origin.",
     "dot(N, V): V is u_EyePosition - point, all in world space"},
    {"back in the front's colour in a mirror", L(9), ONE(BACK, BACK_NEVER_MIRRORED),
     "When mirrored, the back has the front's colour.",
     "each branch that chooses the colour: it depends on the side only"},
    {"always the back", L(9), ONE(FACING, FACING_BACK), "Both sides are drawn like the back.",
     "gl_FrontFacing or the sign of dot(N, V)"},
    {"back not drawn", L(9), ONE(CULL, CULL_BACK), "The back is missing.",
     "discard and return in the branch of the back"},
    {"side by the light", L(9), ONE(FACING, FACING_LIGHT),
     "The side depends on the light; it must depend on the eye.",
     "dot(N, V), with the view vector, not dot(N, L)"},

    /* The shadow map. */
    {"no bias: shadow acne",
     L(11),
     {CHANGE(MAP_BIAS, MAP_BIAS_NONE), CHANGE(NUMBER, FACTOR_BIAS_SMALL),
      CHANGE(NUMBER, FACTOR_BIAS_CLIP)},
     "What is lit has dark stripes: a surface shadows itself, because a texel has one depth for all "
     "points within, and the bias is missing or too small.",
     "the comparison: place.z - 0.002 <= depth, after the division by w"},
    /* A depth that is not the map's draws the same. */
    {"all that the map shows in shadow",
     L(11),
     {CHANGE(MAP_BIAS, MAP_BIAS_REVERSED), CHANGE(NUMBER, FACTOR_BIAS_REVERSED)},
     "All that the map shows is dark: each point is behind itself. The bias has the wrong sign, or the "
     "depth is not that of the map: not divided by w, or a distance.",
     "the comparison: place.z - bias <= depth, and at what is made of place.z before"},
    {"bias too large",
     L(11),
     {CHANGE(NUMBER, FACTOR_BIAS_LARGE), CHANGE(NUMBER, FACTOR_BIAS_SLOPE)},
     "Shadows begin beside what casts them (peter-panning), and thin things cast none: the bias is "
     "too large.",
     "the bias: a few thousandths of the depth's range, 0 to 1"},
    {"not divided by w", L(11), EITHER(MAP_PLACE, MAP_PLACE_NO_W, MAP_PLACE_NO_W_RANGE),
     "The place on the map is in clip space: the light's projection needs a division by w.",
     "v_LightPosition.xyz / v_LightPosition.w, at each fragment"},
    {"range from -1 to 1",
     L(11),
     {CHANGE(MAP_PLACE, MAP_PLACE_NO_RANGE), CHANGE(MAP_PLACE, MAP_PLACE_NO_RANGE_DEPTH),
      CHANGE(MAP_PLACE, MAP_PLACE_NO_RANGE_XY)},
     "After the division by w the place, the depth or both still go from -1 to 1; those of the map "
     "go from 0 to 1.",
     "0.5 * xyz + 0.5, for all three"},
    {"map upside down", L(11), ONE(MAP_PLACE, MAP_PLACE_FLIPPED),
     "Shadows fall on the wrong side: the map's y is reversed. Both begin at the bottom.",
     "the place on the map: no 1.0 - y"},
    {"divided by w at the vertices", L(11), ONE(MAP_PLACE, MAP_PLACE_VERTICES),
     "The place on the map is divided by w at the vertices; what is interpolated after that is not "
     "the quotient between them.",
     "v_LightPosition.xyz / v_LightPosition.w: pass on all four, and divide at each fragment"},
    {"components of the place swapped", L(11), EITHER(MAP_PLACE, MAP_PLACE_YXZ, MAP_PLACE_XZY),
     "Shadows are elsewhere: two components of the place on the map are swapped.",
     "the place on the map: xy is the place, z the depth"},
    {"map mirrored", L(11), ONE(MAP_PLACE, MAP_PLACE_MIRRORED),
     "Shadows fall on the wrong side: the map's x is reversed.",
     "the place on the map: no 1.0 - x"},
    {"place on the map from the wrong space",
     L(11),
     {CHANGE(MAP_PLACE, MAP_PLACE_OBJECT), CHANGE(MAP_PLACE, MAP_PLACE_CLIP),
      CHANGE(MAP_PLACE, MAP_PLACE_ORDER)},
     "The place on the map is not u_LightMatrix times a point in world space: the point or the matrix "
     "is another, or the matrices are in the wrong order.",
     "u_LightMatrix * u_ModelMatrix * a_Position"},
    {"depth of one channel", L(11), ONE(MAP_DEPTH, MAP_DEPTH_RED),
     "The map's depth has steps: only its red channel is read.", "mapDepth: all three channels"},
    {"channels of the depth in the wrong order", L(11), ONE(MAP_DEPTH, MAP_DEPTH_BGR),
     "The map's depth is put together in the wrong order: red counts most, blue least.",
     "mapDepth: dot(texel.rgb, vec3(1.0, 1.0 / 255.0, 1.0 / 65025.0))"},
    {"comparison inverted", L(11), EITHER(MAP_TEST, MAP_TEST_INVERTED, MAP_TEST_ALL_INVERTED),
     "What is lit is dark, and shadows are lit.",
     "the comparison: in light if place.z - bias <= depth; visibility() returns 1.0 in light"},
    /* Whatever the reason: all draw the same. */
    {"no shadow", L(11), ONE(MAP_TEST, MAP_TEST_NEVER), "Nothing is in shadow.",
     "the diffuse term: multiply it by visibility(); if it is, at whether place and mapDepth(place.xy) "
     "are from 0 to 1 and from the same space, and at what visibility() returns"},
    {"all in shadow", L(11), ONE(MAP_TEST, MAP_TEST_ALWAYS), "No light arrives anywhere.",
     "the comparison and what visibility() returns"},
    {"outside of the map not asked for",
     L(11),
     {CHANGE(MAP_OUTSIDE, MAP_OUTSIDE_CLAMPED),
      BOTH(MAP_OUTSIDE, MAP_OUTSIDE_CLAMPED, MAP_BIAS, MAP_BIAS_SMALL),
      BOTH(MAP_OUTSIDE, MAP_OUTSIDE_CLAMPED, MAP_BIAS, MAP_BIAS_MIDDLE),
      BOTH(MAP_OUTSIDE, MAP_OUTSIDE_CLAMPED, MAP_BIAS, MAP_BIAS_LARGE)},
     "Beside the map it is as dark as at its edge: there texture2D returns the nearest texel.",
     "the place on the map: return 1.0 if x or y is below 0.0 or above 1.0"},
    {"outside of the map in another range", L(11),
     EITHER(MAP_OUTSIDE, MAP_OUTSIDE_UNHALVED, MAP_OUTSIDE_HALVED),
     "What counts as beside the map is not: it is asked for 0 to 1 before the place is mapped to that "
     "range, or for -1 to 1 after.",
     "the place on the map: return 1.0 if x or y is below 0.0 or above 1.0, of 0.5 * xy + 0.5"},
    {"outside of the map dark", L(11), ONE(MAP_OUTSIDE, MAP_OUTSIDE_DARK),
     "What is not on the map is dark; nothing is known to shadow it, so it is lit.",
     "the place on the map: return 1.0 if x or y is below 0.0 or above 1.0"},
    {"shadows keep off the ambient light, too", L(11), ONE(SHADOW_ON, SHADOW_ON_ALL),
     "Shadows are black; the ambient light comes from everywhere, so none keeps it off.",
     "the sum: u_AmbientLight + visibility() * diffuse"},
    {"shadow on the ambient light only", L(11), ONE(SHADOW_ON, SHADOW_ON_AMBIENT),
     "Shadows keep off the ambient light instead of the diffuse light.",
     "the sum: u_AmbientLight + visibility() * diffuse"},

    /* Not drawn: looked for in scene G, with the precision that the file asks for. */
    {"mediump overflow", L(5) | L(6) | L(7) | L(8) | L(9) | L(11), ONE(STAGE, 0),
     "It fails at large distances: their squares overflow 16 bits.",
     "the fragment shader's precision: highp float"},
    /* Found by drawing with a fine mesh, or in 32 bits. */
    {"mesh too coarse", L(10), ONE(STAGE, 0),
     "With a fine mesh the same shaders are right: this mesh has too few slices or stacks.",
     "slices and stacks in budget.c, or at what is interpolated between the vertices"},
    {"depends on the picture's size", SHADED, ONE(STAGE, 0),
     "The picture is right at small sizes, and wrong at a larger one or at another place.",
     "the uses of gl_FragCoord"},
    {"mediump too coarse", L(10), ONE(STAGE, 0),
     "In 32 bits the same shaders are right: mediump has 11 significant bits.",
     "the fragment shader's precision: highp float"},
    {"extra gamma",
     SHADED,
     {CHANGE(OUTPUT, OUTPUT_GAMMA), CHANGE(OUTPUT, OUTPUT_ROOT), CHANGE(OUTPUT, OUTPUT_POWER),
      CHANGE(OUTPUT, OUTPUT_SQUARE), CHANGE(NUMBER, FACTOR_GAMMA)},
     "The picture is too pale or too dark: its colours are raised to a power at the end.",
     "gl_FragColor: the sum, without pow or sqrt"},
    {"negative", SHADED, ONE(OUTPUT, OUTPUT_INVERTED), "The picture is its negative.",
     "gl_FragColor: the sum, not 1 minus the sum"},
    {"channels swapped",
     SHADED,
     {CHANGE(OUTPUT, OUTPUT_SWAPPED), CHANGE(COLOR, COLOR_SWAPPED),
      CHANGE(COLOR, COLOR_LIT_SWAPPED), CHANGE(LIGHT_COLOR, LIGHT_COLOR_SWAPPED),
      CHANGE(COLOR, COLOR_RBG), CHANGE(COLOR, COLOR_GRB)},
     "Two channels are swapped, in the picture, the object or the light.",
     "the order of the components: .rgb, not .bgr"},
    {"grey", SHADED, ONE(OUTPUT, OUTPUT_GREY), "The picture has lost its colours.",
     "the last line: the sum is a vec3"},

    /* Numbers. */
    {"wrong factor of all light", AMBIENT, ONE(NUMBER, FACTOR_ALL), "All light has a wrong factor.",
     "the last lines: numbers that multiply the whole sum"},
    {"wrong factor of the diffuse light", SHADED, ONE(NUMBER, FACTOR_DIFFUSE),
     "The diffuse light has a wrong factor.", "numbers in the diffuse term"},
    {"wrong power of the cosine", SHADED, ONE(NUMBER, FACTOR_COSINE_POWER),
     "The cosine is raised to a power.", CLAMPED_COSINE " alone"},
    {"cosine clamped below 1", SHADED, ONE(NUMBER, FACTOR_COSINE),
     "Bright light is cut off: the cosine is clamped from above.", CLAMPED_COSINE " alone"},
    {"wrong factor of the ambient light", AMBIENT, ONE(NUMBER, FACTOR_AMBIENT),
     "The ambient light has a wrong factor.", "numbers in the ambient term"},
    {"wrong factor of the highlight", SHINY, ONE(NUMBER, FACTOR_SPECULAR),
     "The highlight has a wrong factor.", "numbers in the specular term"},
    {"wrong exponent", SHINY, ONE(NUMBER, FACTOR_EXPONENT), "The highlight's exponent is wrong.",
     "the second argument of pow"},
    {"wrong number added to the exponent", L(7), ONE(NUMBER, FACTOR_PLUS_EXPONENT),
     "The highlight's exponent is too large or too small by the same number for every shininess.",
     "the second argument of pow"},
    {"a constant for the ambient light", AMBIENT, ONE(NUMBER, FACTOR_AMBIENT_VALUE),
     "The ambient light is a constant, not u_AmbientLight.", AMBIENT_TERM},
    {"a constant for the specular colour", SHINY, ONE(NUMBER, FACTOR_SPECULAR_VALUE),
     "The specular colour is a constant, not u_SpecularColor.",
     "the specular term: multiply it by u_SpecularColor"},
    {"a constant for the shininess", SHINY, ONE(NUMBER, FACTOR_EXPONENT_VALUE),
     "The highlight's exponent is a constant.", "pow(..., u_Shininess)"},
    {"a constant for the light's colour", SHADED, ONE(NUMBER, FACTOR_LIGHT_VALUE),
     "The light's colour is a constant, not u_LightColor.", "the uses of u_LightColor"},
    {"a constant for the cutoff", L(8), ONE(NUMBER, FACTOR_CUTOFF_VALUE),
     "The cone's angle is a constant.", "cos(radians(u_SpotCutoff))"},
    {"a constant for the spot exponent", L(8), ONE(NUMBER, FACTOR_SPOT_EXPONENT_VALUE),
     "The cone's exponent is a constant.", FALL_OFF},
    {"wrong factor of one light", SEVERAL, EITHER(NUMBER, FACTOR_FIRST, FACTOR_SECOND),
     "One of the two lights has a wrong factor.", "numbers in the sum over the lights"},
    {"wrong cutoff", L(8), ONE(NUMBER, FACTOR_CUTOFF), "The cone is too wide or too narrow.",
     "the comparison with cos(radians(u_SpotCutoff)): no factor, no half angle"},
    {"wrong spot exponent", L(8), ONE(NUMBER, FACTOR_SPOT_EXPONENT),
     "The cone's fall-off has a wrong exponent.", FALL_OFF},
    {"wrong linear attenuation", L(8), ONE(NUMBER, FACTOR_LINEAR),
     "The linear part of the attenuation has a wrong factor.", ATTENUATION},
    {"wrong quadratic attenuation", L(8), ONE(NUMBER, FACTOR_QUADRATIC),
     "The quadratic part of the attenuation has a wrong factor.", ATTENUATION},
    {"wrong constant attenuation", L(8), ONE(NUMBER, FACTOR_CONSTANT),
     "The constant part of the attenuation has a wrong factor.", ATTENUATION},
    {"light in the shadow", L(11), EITHER(NUMBER, FACTOR_SHADOW, FACTOR_SHADOW_ALL),
     "A share of the light arrives in shadows.", "what visibility() returns: 1.0 or 0.0"},
    {"shadow darker than none", L(11), ONE(NUMBER, FACTOR_SHADOW_BELOW),
     "Shadows take from the ambient light: the visibility is below 0 there.",
     "what visibility() returns: 1.0 or 0.0; the weights of several texels sum to 1"},
    {"wrong weights of the map's texels", L(11), ONE(NUMBER, FACTOR_MAP_LIGHT),
     "What the map shows in light has a wrong factor, what is beside the map has not.",
     "what visibility() returns: at most 1.0; the weights of several texels sum to 1"},
    {"light from nowhere", SHADED, ONE(NUMBER, FACTOR_PLUS_LIGHT),
     "A constant is added to the light.", "numbers that are added to the light"},
    {"picture clamped below 1", SHADED, ONE(NUMBER, FACTOR_RESULT),
     "Bright parts are cut off: the colour is clamped to a number below 1.",
     "min or clamp at the end: nothing need be clamped there"},
    {"colour from nowhere", SHADED, ONE(NUMBER, FACTOR_PLUS_COLOR),
     "A constant is added to the colour.", "numbers that are added at the end"},
};

static const int MISTAKE_COUNT = sizeof MISTAKES / sizeof MISTAKES[0];

/* False for a form with a slot that this lab lacks. */
static bool form_applies(const Lab *lab, const Change *form)
{
    for (int i = 0; i < MISTAKE_MAX_CHANGES && form[i].choice; i++) {
        const Slot slot = form[i].slot;
        const int choice = form[i].choice;
        if (slot == SLOT_LIGHT_SPACE && choice >= LIGHT_SPACE_MODEL && choice < LIGHT_SPACE_UNIT &&
            (lab->given || lab->budget ||
             (choice == LIGHT_SPACE_MODEL_W_1) == (lab->light == LIGHT_DIRECTIONAL)))
            return false;
        if ((slot >= SLOT_ORDER && slot <= SLOT_WORLD && !lab->given) ||
            (slot == SLOT_VIEW && !lab->specular) ||
            (slot == SLOT_PLACE && (lab->given || lab->light == LIGHT_DIRECTIONAL)) ||
            (slot == SLOT_LIGHT_SPACE && lab->given) ||
            (slot == SLOT_CONE && lab->light != LIGHT_SPOT) ||
            (slot == SLOT_AMBIENT && choice == AMBIENT_NOT_CONE && lab->light != LIGHT_SPOT &&
             !lab->shadow))
            return false;
    }
    return true;
}

static Choices with_changes(Choices choices, const Change *form)
{
    for (int i = 0; i < MISTAKE_MAX_CHANGES && form[i].choice; i++)
        choices.of[form[i].slot] = form[i].choice;
    return choices;
}

static Suspect *make(const Lab *lab, bool numbers, int *count)
{
    const int truths = lab->either || lab->two_sided ? 2 : lab->fitted ? 3 : 1;
    Suspect *suspects =
        memory_new((size_t)(truths * MISTAKE_COUNT * MISTAKE_MAX_FORMS), sizeof *suspects);
    *count = 0;
    for (int truth = 0; truth < truths; truth++) {
        Choices right = {.value = 1};
        right.of[lab->fitted      ? SLOT_FIT
                 : lab->two_sided ? SLOT_FACING
                                  : SLOT_STAGE] =
            truth && lab->two_sided ? FACING_VIEW : truth; /* STAGE_OTHER; FIT_MIN, FIT_FOUR */
        for (int i = 0; i < MISTAKE_COUNT; i++) {
            if (!(MISTAKES[i].labs & L(lab->number)))
                continue;
            for (int k = 0; k < MISTAKE_MAX_FORMS && MISTAKES[i].forms[k][0].choice; k++)
                if (form_applies(lab, MISTAKES[i].forms[k]) &&
                    (MISTAKES[i].forms[k][0].slot == SLOT_NUMBER) == numbers)
                    suspects[(*count)++] = (Suspect){
                        .mistakes = {i, -1}, .choices = with_changes(right, MISTAKES[i].forms[k])};
        }
    }
    return suspects;
}

Suspect *catalogue_singles(const Lab *lab, int *count)
{
    return make(lab, false, count);
}

Suspect *catalogue_numbers(const Lab *lab, int *count)
{
    Suspect *suspects = make(lab, true, count);
    for (int i = 0; i < *count; i++) {
        suspects[i].choices.factor = (Factor)suspects[i].choices.of[SLOT_NUMBER];
        suspects[i].choices.value = 1;
    }
    return suspects;
}

/* Rare mistakes are not looked for in pairs, which would be too many. */
static bool is_common(const Suspect *suspect)
{
    static const int LAST[SLOT_COUNT] = {
        [SLOT_STAGE] = STAGE_VERTICES,
        [SLOT_FIT] = FIT_FOUR,
        [SLOT_ORDER] = ORDER_REVERSED,
        [SLOT_MOVE] = PART_INVERSE,
        [SLOT_TURN] = TURN_DEGREES,
        [SLOT_TURN_SIGN] = SIGN_REVERSED,
        [SLOT_AXIS] = AXIS_Z,
        [SLOT_SCALE] = PART_INVERSE,
        [SLOT_WORLD] = WORLD_INVERSE,
        [SLOT_CLIP] = CLIP_NO_MODEL,
        [SLOT_PLACE] = PLACE_TRANSPOSED,
        [SLOT_NORMAL] = NORMAL_UNTURNED,
        [SLOT_NORMAL_UNIT] = UNIT_AT_BOTH,
        [SLOT_NORMAL_SIGN] = SIGN_REVERSED,
        [SLOT_LIGHT] = LIGHT_FROM_ORIGIN,
        [SLOT_LIGHT_UNIT] = UNIT_AT_VERTICES,
        [SLOT_LIGHT_SIGN] = SIGN_REVERSED,
        [SLOT_LIGHT_SPACE] = LIGHT_SPACE_EYE,
        [SLOT_LIGHTS] = LIGHTS_MEAN,
        [SLOT_LIGHT_COLOR] = LIGHT_COLOR_SQUARED,
        [SLOT_COSINE] = COSINE_WRAPPED,
        [SLOT_COLOR] = COLOR_IGNORED,
        [SLOT_AMBIENT] = AMBIENT_LARGER,
        [SLOT_REFLECTION] = REFLECTION_SUM,
        [SLOT_VIEW] = VIEW_RAW,
        [SLOT_GATE] = GATE_COSINE,
        [SLOT_POWER] = POWER_ABSOLUTE,
        [SLOT_EXPONENT] = EXPONENT_QUARTER,
        [SLOT_HIGHLIGHT_COLOR] = HIGHLIGHT_WHITE,
        [SLOT_FADE] = FADE_INVERSE_SQUARE,
        [SLOT_FADE_ON] = ON_NO_HIGHLIGHT,
        [SLOT_CONE] = CONE_OUTSIDE,
        [SLOT_CONE_SIGN] = AXIS_REVERSED,
        [SLOT_CONE_FALL_OFF] = FALL_OFF_ONE,
        [SLOT_CONE_ON] = ON_NO_HIGHLIGHT,
        [SLOT_FACING] = FACING_LIGHT, /* not with FACING_VIEW */
        [SLOT_BACK] = BACK_NOT_REVERSED,
        [SLOT_CULL] = CULL_FRONT,
        [SLOT_OUTPUT] = OUTPUT_GAMMA,
        [SLOT_MAP_PLACE] = MAP_PLACE_FLIPPED,
        [SLOT_MAP_DEPTH] = MAP_DEPTH_RED,
        [SLOT_MAP_BIAS] = MAP_BIAS_NONE, /* reversed, with the comparison inverted: no shadow */
        [SLOT_MAP_TEST] = MAP_TEST_INVERTED,
        [SLOT_MAP_OUTSIDE] = MAP_OUTSIDE_DARK,
        [SLOT_SHADOW_ON] = SHADOW_ON_ALL,
    };
    for (int i = 0; i < SLOT_COUNT; i++)
        if (suspect->choices.of[i] > LAST[i])
            return false;
    return true;
}

bool catalogue_pair(const Suspect *a, const Suspect *b, Suspect *pair)
{
    const int stage = a->choices.of[SLOT_STAGE], other = b->choices.of[SLOT_STAGE];
    if (!is_common(a) || !is_common(b) || a->mistakes[0] == b->mistakes[0] ||
        a->choices.of[SLOT_FIT] || b->choices.of[SLOT_FIT])
        return false;
    if ((stage == STAGE_OTHER) != (other == STAGE_OTHER) && stage != STAGE_VERTICES &&
        other != STAGE_VERTICES)
        return false;
    *pair = *a;
    pair->mistakes[1] = b->mistakes[0];
    for (int i = 0; i < SLOT_COUNT; i++) {
        if (i != SLOT_STAGE && a->choices.of[i] && b->choices.of[i])
            return false;
        if (b->choices.of[i])
            pair->choices.of[i] = b->choices.of[i];
    }
    /* Lit at the vertices, nothing is normalized at the fragments. */
    return stage != STAGE_VERTICES || other != STAGE_VERTICES;
}

bool catalogue_moves(const Suspect *suspect)
{
    const int *of = suspect->choices.of;
    /* Depth does not change the outline. */
    return of[SLOT_CLIP] && of[SLOT_CLIP] != CLIP_FLAT && of[SLOT_CLIP] != CLIP_REVERSED;
}

double factor_value(const Choices *choices)
{
    const double value = choices->value;
    switch (choices->factor) {
    case FACTOR_PLUS_EXPONENT:
        return 20 * value;
    case FACTOR_BIAS_CLIP:
        return 0.016 / (1 + value);
    case FACTOR_BIAS_LARGE:
        return 0.004 + value / 512;
    case FACTOR_BIAS_SMALL:
        return 0.0005 / (1 + value);
    case FACTOR_BIAS_REVERSED:
        return -value / 512;
    case FACTOR_BIAS_SLOPE:
        return value / 512;
    default:
        return value;
    }
}

int catalogue_find(const char *name)
{
    for (int i = 0; i < MISTAKE_COUNT; i++)
        if (strcmp(MISTAKES[i].name, name) == 0)
            return i;
    return -1;
}
