#include "catalogue.h"

#include <stdlib.h>
#include <string.h>

#define L(n) (1u << (n))
enum {
    SHADED = L(1) | L(2) | L(4) | L(5) | L(6) | L(7) | L(8) | L(9) | L(10),
    AMBIENT = L(2) | L(4) | L(5) | L(6) | L(7) | L(8) | L(9) | L(10),
    SEVERAL = L(2) | L(4) | L(5) | L(6) | L(7),
    POINTS = L(4) | L(5) | L(6) | L(7) | L(8) | L(9) | L(10),
    MOVING = L(4) | L(5) | L(6) | L(7) | L(8) | L(9), /* points, of objects that move */
    SCALED = L(3) | L(4) | L(5) | L(6) | L(7) | L(8) | L(9),
    MOVED = L(1) | L(2) | SCALED,
    ROUND = L(5) | L(6) | L(7) | L(8) | L(10),
    SHINY = L(6) | L(7) | L(8) | L(10),
    PHONG = L(6) | L(8) | L(10),
};

const Mistake MISTAKES[] = {
    /* Where the model lies: lab 3. */
    {"moved before it is turned",
     L(3),
     {{{SLOT_ORDER, ORDER_MOVED_FIRST}}},
     "The cube circles about the origin: it is moved first and turned afterwards.",
     "the order of the product in lab_matrices: the last factor is done first, so it is move * turn "
     "* scale"},
    {"turned before it is scaled",
     L(3),
     {{{SLOT_ORDER, ORDER_SCALED_LAST}}},
     "The cube changes its shape while it turns: it is turned first and scaled afterwards.",
     "the order of the product in lab_matrices: the last factor is done first, so it is move * turn "
     "* scale"},
    {"product in the reverse order",
     L(3),
     {{{SLOT_ORDER, ORDER_REVERSED}}},
     "Scale, turn and move are done in the reverse order.",
     "the order of the product in lab_matrices: vectors are columns, and the last factor is done "
     "first"},
    {"degrees for radians",
     L(3) | L(8),
     {{{SLOT_TURN, TURN_RADIANS}}, {{SLOT_TURN, TURN_DEGREES}}, {{SLOT_CONE, CONE_DEGREES}}},
     "An angle in degrees is taken for one in radians, or the reverse.",
     "every sine, cosine or turn: mat4_rotate takes degrees, GLSL's cos takes radians(...)"},
    {"turned the wrong way",
     L(3),
     {{{SLOT_TURN_SIGN, SIGN_REVERSED}}},
     "The cube turns in the opposite direction.",
     "the sign of the angle and of the axis: positive is counter-clockwise, seen from the axis's "
     "tip"},
    {"not turned",
     L(3),
     {{{SLOT_TURN, PART_MISSING}}},
     "The cube does not turn.",
     "the product in lab_matrices, for the rotation, and its angle, for the time"},
    {"not moved",
     L(3),
     {{{SLOT_MOVE, PART_MISSING}}},
     "The cube is not moved.",
     "the product in lab_matrices, for the translation"},
    {"not scaled",
     L(3),
     {{{SLOT_SCALE, PART_MISSING}}},
     "The cube is not scaled.",
     "the product in lab_matrices, for the scale"},
    {"rows for columns in the model matrix",
     L(3) | MOVING,
     {{{SLOT_WORLD, WORLD_TRANSPOSED}}, {{SLOT_PLACE, PLACE_TRANSPOSED}}},
     "The model matrix is transposed: its translation lands in w.",
     "the order of matrix and vector, u_ModelMatrix * a_Position, and in C at m[4 * column + row]"},
    {"moved the wrong way",
     L(3),
     {{{SLOT_MOVE, PART_INVERSE}}},
     "The cube is moved in the opposite direction.",
     "the signs of the translation"},
    {"scaled inversely",
     L(3),
     {{{SLOT_SCALE, PART_INVERSE}}},
     "The cube is divided by the scale, not multiplied.",
     "the scale's factors, and at what is inverted: only the normal matrix is made of the inverse"},
    {"turned about another axis",
     L(3),
     {{{SLOT_AXIS, AXIS_X}}, {{SLOT_AXIS, AXIS_Y}}, {{SLOT_AXIS, AXIS_Z}}},
     "The cube turns about a coordinate axis, not about the task's.",
     "the axis of mat4_rotate"},
    {"inverse of the model matrix",
     L(3),
     {{{SLOT_WORLD, WORLD_INVERSE}}},
     "The model matrix is inverted: it takes world to model.",
     "which matrix goes where"},

    /* Where it is drawn. */
    {"upside down",
     SHADED,
     {{{SLOT_CLIP, CLIP_UPSIDE_DOWN}}},
     "The picture is upside down.",
     "the sign of y in gl_Position"},
    {"left and right swapped",
     SHADED,
     {{{SLOT_CLIP, CLIP_SWAPPED}}},
     "Left and right are swapped.",
     "the sign of x in gl_Position"},
    {"aspect ratio ignored",
     SHADED,
     {{{SLOT_CLIP, CLIP_ASPECT}}},
     "In a picture that is not square, shapes are stretched.",
     "the projection: width / height belongs in it; u_MvpMatrix has it"},
    {"rows for columns in the position",
     SHADED,
     {{{SLOT_CLIP, CLIP_TRANSPOSED}}},
     "The position is multiplied with the transposed matrix.",
     "the order: u_MvpMatrix * a_Position, not a_Position * u_MvpMatrix"},
    {"no depth test",
     SHADED,
     {{{SLOT_CLIP, CLIP_FLAT}}},
     "Far surfaces cover near ones: all have the same depth.",
     "the z of gl_Position: it is to be what u_MvpMatrix gives"},
    {"depth reversed",
     SHADED & ~L(10),
     {{{SLOT_CLIP, CLIP_REVERSED}}},
     "Far surfaces cover near ones: the depth is reversed.",
     "the sign of z in gl_Position"},
    {"model matrix left out",
     SHADED & ~L(10),
     {{{SLOT_CLIP, CLIP_NO_MODEL}}},
     "The object is drawn where it was modelled: it neither turns nor moves.",
     "gl_Position: u_MvpMatrix has the model matrix, u_ProjMatrix * u_ViewMatrix has not"},

    {"inside seen",
     SHADED & ~L(9),
     {{{SLOT_CULL, CULL_FRONT}}},
     "The inside is seen: the triangles in front are left out, those behind are drawn.",
     "the winding, and at what is culled or discarded by gl_FrontFacing"},

    /* The point that is lit. */
    {"point in the object's coordinates",
     MOVING,
     {{{SLOT_PLACE, PLACE_OBJECT}}},
     "The light's direction is taken from a_Position as it is, which is in the object's "
     "coordinates, while the light's place is in the world.",
     "where the point to be lit comes from: vec3(u_ModelMatrix * a_Position)"},
    {"w = 0 for a point",
     MOVING,
     {{{SLOT_PLACE, PLACE_W_0}}},
     "The point to be lit is turned, but not moved: it has w = 0, as a direction has.",
     "vec4(a_Position.xyz, 1.0): points have w = 1"},
    {"world and eye space mixed",
     (MOVED & ~L(3)) | L(10),
     {{{SLOT_NORMAL, NORMAL_EYE}},
      {{SLOT_PLACE, PLACE_EYE}},
      {{SLOT_LIGHT_SPACE, LIGHT_SPACE_EYE}},
      {{SLOT_NORMAL, NORMAL_EYE}, {SLOT_PLACE, PLACE_EYE}}},
     "Vectors of different spaces are compared: some are in the world, some in eye coordinates.",
     "the space of N, of L and of V: all in the world, or all in eye coordinates"},

    /* Normals. */
    {"normals not transformed",
     MOVED,
     {{{SLOT_NORMAL, NORMAL_OBJECT}}},
     "The shading turns with the object: its normals are left as they were modelled.",
     "the normal: it is to go through u_NormalMatrix"},
    {"model matrix for normals",
     SCALED,
     {{{SLOT_NORMAL, NORMAL_MODEL}}},
     "Normals go through the model matrix: right on what is only turned, wrong on what is "
     "stretched.",
     "the normal: it takes the inverse transpose, u_NormalMatrix"},
    {"w = 1 for a direction",
     MOVED,
     {{{SLOT_NORMAL, NORMAL_MODEL_W_1}},
      {{SLOT_NORMAL, NORMAL_MODEL_W_1}, {SLOT_NORMAL_UNIT, UNIT_AT_BOTH}}},
     "Moving the object changes its shade: the normal goes through the model matrix with w = 1, as "
     "a point does.",
     "vec4(a_Normal.xyz, 0.0): directions have w = 0"},
    {"inverse without transpose",
     MOVED,
     {{{SLOT_NORMAL, NORMAL_INVERSE}}},
     "Normals go through the inverse of the model matrix, not through its transpose: it is not "
     "transposed, or twice, or is multiplied from the wrong side.",
     "the order: u_NormalMatrix * a_Normal, and at what is transposed on the way"},
    {"transpose without inverse",
     SCALED,
     {{{SLOT_NORMAL, NORMAL_TRANSPOSE}}},
     "Normals go through the transposed model matrix; it is not inverted.",
     "the normal matrix: the inverse, transposed"},
    {"normals only turned",
     L(3),
     {{{SLOT_NORMAL, NORMAL_TURN}}},
     "Normals are turned, and the scale is left out of their matrix.",
     "the normal matrix: of the whole model matrix the inverse, transposed"},
    {"normals not turned",
     L(3),
     {{{SLOT_NORMAL, NORMAL_UNTURNED}}},
     "The normals' matrix has the scale, but does not turn.",
     "the normal matrix: of the whole model matrix the inverse, transposed"},
    {"normal reversed",
     L(3) | SHINY,
     {{{SLOT_NORMAL_SIGN, SIGN_REVERSED}}},
     "Normals point inwards.",
     "the sign of the normal"},
    {"normal not made unit",
     L(4) | L(9),
     {{{SLOT_NORMAL_UNIT, UNIT_NEVER}}},
     "Stretched objects are too bright or too dark: what the normal matrix gives is not unit.",
     "the normal: normalize(...) what u_NormalMatrix gives"},
    {"not renormalized per fragment",
     ROUND,
     {{{SLOT_NORMAL_UNIT, UNIT_AT_VERTICES}}, {{SLOT_NORMAL_UNIT, UNIT_NEVER}}},
     "Light and highlight are dimmer between the vertices: there the interpolated normal is shorter "
     "than 1.",
     "the fragment shader's normal: normalize(v_Normal)"},

    /* The direction to the light. */
    {"light direction reversed",
     SHADED,
     {{{SLOT_LIGHT_SIGN, SIGN_REVERSED}}},
     "The bright side is opposite the light: the direction to it, or the normal, is reversed.",
     "the light's direction: from the point towards the light, light - point"},
    {"light direction not normalized",
     POINTS,
     {{{SLOT_LIGHT_UNIT, UNIT_NEVER}}},
     "The farther the light, the brighter: its direction is not made unit.",
     "normalize(u_LightPosition - point)"},
    {"light direction unit at the vertices only",
     ROUND,
     {{{SLOT_LIGHT_UNIT, UNIT_AT_VERTICES}}},
     "The direction to the light is made unit at the vertices and interpolated; between them it is "
     "shorter.",
     "the fragment shader: normalize the direction there, or interpolate the point instead"},
    {"light direction from the object's centre",
     MOVING,
     {{{SLOT_LIGHT, LIGHT_FROM_CENTER}},
      {{SLOT_LIGHT, LIGHT_FROM_CENTER}, {SLOT_VIEW, VIEW_FIXED_CENTER}}},
     "All of the object has one light direction, that of its centre.",
     "the direction: from each point that is lit, u_LightPosition - point"},
    {"point light taken for a directional one",
     POINTS,
     {{{SLOT_LIGHT, LIGHT_FROM_ORIGIN}}},
     "The shade does not depend on where the object is: the light's place is used as a direction.",
     "the direction: from each point that is lit, u_LightPosition - point"},
    {"only the first light",
     SEVERAL,
     {{{SLOT_LIGHTS, LIGHTS_FIRST}}},
     "The second light gives nothing.",
     "the loop over the lights, or its sum"},
    {"only the second light",
     SEVERAL,
     {{{SLOT_LIGHTS, LIGHTS_SECOND}}},
     "The first light gives nothing.",
     "the sum over the lights: += is wanted, and = keeps only the last one"},
    {"mean of the lights",
     SEVERAL,
     {{{SLOT_LIGHTS, LIGHTS_MEAN}}},
     "The lights are averaged, not added.",
     "the sum over the lights: nothing divides it"},
    {"light colour ignored",
     SHADED,
     {{{SLOT_LIGHT_COLOR, LIGHT_COLOR_IGNORED}}},
     "All light is white.",
     "the diffuse term: u_LightColor is a factor of it"},
    {"light colour twice",
     SHADED,
     {{{SLOT_LIGHT_COLOR, LIGHT_COLOR_SQUARED}}},
     "Light is too dark and too colourful: its colour is a factor twice.",
     "where u_LightColor is multiplied"},

    /* The diffuse term. */
    {"missing clamp",
     AMBIENT,
     {{{SLOT_COSINE, COSINE_UNCLAMPED}}},
     "The unlit side is darker than the ambient light: the cosine is negative there.",
     "the cosine: max(dot(N, L), 0.0)"},
    {"absolute value of the cosine",
     SHADED,
     {{{SLOT_COSINE, COSINE_ABSOLUTE}}},
     "The side away from the light is lit, too.",
     "the cosine: max(dot(N, L), 0.0), not abs"},
    {"no cosine",
     SHADED,
     {{{SLOT_COSINE, COSINE_NONE}}},
     "Every side is equally bright: the cosine is missing.",
     "the diffuse term: max(dot(N, L), 0.0) is a factor of it"},
    {"cosine shifted",
     SHADED,
     {{{SLOT_COSINE, COSINE_WRAPPED}}},
     "Light reaches around the object: the cosine is halved and shifted.",
     "the cosine: max(dot(N, L), 0.0) alone"},
    {"colour used twice",
     SHADED,
     {{{SLOT_COLOR, COLOR_SQUARED}}},
     "The object's colour is too dark and too strong: it is a factor twice.",
     "where a_Color is multiplied, in both shaders"},
    {"colour ignored",
     SHADED,
     {{{SLOT_COLOR, COLOR_IGNORED}}},
     "The object is white.",
     "the sum: a_Color is a factor of the diffuse and the ambient term"},

    /* Ambient light. */
    {"ambient missing",
     AMBIENT,
     {{{SLOT_AMBIENT, AMBIENT_MISSING}}},
     "What no light reaches is black.",
     "the sum: + u_AmbientLight * colour"},
    {"ambient added per light",
     SEVERAL,
     {{{SLOT_AMBIENT, AMBIENT_PER_LIGHT}}},
     "It becomes brighter with every light, in the shade too: ambient light is added for each.",
     "the loop: ambient light is added once, outside of it"},
    {"ambient multiplied by the cosine",
     AMBIENT,
     {{{SLOT_AMBIENT, AMBIENT_COSINE}}},
     "What no light reaches is black, and the rest too bright: ambient light is multiplied by the "
     "cosine.",
     "the brackets: ambient light is added after the cosine is multiplied"},
    {"ambient without the colour",
     AMBIENT,
     {{{SLOT_AMBIENT, AMBIENT_PLAIN}}},
     "The shade is grey: ambient light is not multiplied by the object's colour.",
     "the ambient term: u_AmbientLight * colour"},
    {"ambient times the light's colour",
     AMBIENT,
     {{{SLOT_AMBIENT, AMBIENT_LIGHT_COLOR}}},
     "The shade has the light's tint: ambient light is multiplied by the light's colour.",
     "the ambient term: u_AmbientLight * colour, and nothing else"},
    {"larger of ambient and diffuse",
     AMBIENT & ~SEVERAL,
     {{{SLOT_AMBIENT, AMBIENT_LARGER}}},
     "Where light falls, ambient light is missing: the larger of the two is taken.",
     "the sum: ambient and diffuse are added, not max(...)"},

    /* The highlight. */
    {"no highlight",
     SHINY,
     {{{SLOT_REFLECTION, REFLECTION_NONE}}},
     "There is no highlight, or next to none.",
     "the specular term: whether it is added, and the signs of L and V"},
    {"reflect's sign",
     PHONG,
     {{{SLOT_REFLECTION, REFLECTION_SIGN}}},
     "The highlight is on the wrong side: reflect takes the direction from the light, or the view "
     "vector points away from the eye.",
     "reflect(-L, N): its first argument points towards the surface; and u_EyePosition - point"},
    {"the other reflection model",
     SHINY,
     {{{SLOT_REFLECTION, REFLECTION_OTHER}}, {{SLOT_REFLECTION, REFLECTION_OTHER_FITTED}}},
     "The highlight is that of the other model: Blinn-Phong's for Phong's, or the reverse.",
     "the cosine of the highlight: dot(R, V) is Phong's, dot(N, H) Blinn-Phong's"},
    {"half vector not normalized",
     L(7),
     {{{SLOT_REFLECTION, REFLECTION_HALF_RAW}}},
     "The highlight is too weak: the half vector is shorter than 1.",
     "normalize(L + V)"},
    {"view vector from the wrong space",
     SHINY,
     {{{SLOT_VIEW, VIEW_WORLD_ORIGIN}}, {{SLOT_VIEW, VIEW_EYE_SPACE}}},
     "The highlight does not follow the camera: the view vector is as if the eye were at the origin "
     "of the world, or is in eye coordinates while the others are in the world.",
     "the view vector: normalize(u_EyePosition - point), both in the world"},
    {"fixed view vector",
     SHINY,
     {{{SLOT_VIEW, VIEW_FIXED_EYE}},
      {{SLOT_VIEW, VIEW_FIXED_Z}},
      {{SLOT_VIEW, VIEW_FIXED_AXIS}},
      {{SLOT_VIEW, VIEW_FIXED_CENTER}}},
     "The view vector is the same at every point.",
     "the view vector: normalize(u_EyePosition - point), at each point"},
    {"view vector not normalized",
     SHINY,
     {{{SLOT_VIEW, VIEW_RAW}}},
     "The highlight is far too large: the view vector is not made unit.",
     "normalize(u_EyePosition - point)"},
    {"specular on the dark side",
     SHINY,
     {{{SLOT_GATE, GATE_OPEN}}},
     "The highlight also shows on the side that the light does not reach.",
     "the specular term: only where dot(N, L) > 0.0"},
    {"highlight times the cosine",
     SHINY,
     {{{SLOT_GATE, GATE_COSINE}}},
     "The highlight is too dark towards the border of the light: it is multiplied by the cosine.",
     "the brackets: the cosine is a factor of the diffuse term alone"},
    {"pow of a negative number",
     PHONG,
     {{{SLOT_POWER, POWER_ANY}}},
     "Where the highlight's cosine is negative, pow has no meaning, and anything may be drawn.",
     "pow(max(dot(R, V), 0.0), u_Shininess)"},
    {"absolute value in the highlight",
     PHONG,
     {{{SLOT_POWER, POWER_ABSOLUTE}}},
     "There is a second highlight, opposite the first.",
     "max(dot(R, V), 0.0), not abs"},
    {"shininess ignored",
     SHINY,
     {{{SLOT_EXPONENT, EXPONENT_ONE}}},
     "The highlight covers everything: its exponent is missing.",
     "pow(..., u_Shininess)"},
    {"shininess not fitted",
     L(7),
     {{{SLOT_EXPONENT, EXPONENT_PLAIN}}},
     "The highlight is about twice as wide as Phong's: the exponent is Phong's own.",
     "the exponent: Blinn-Phong needs about 4 times as much"},
    {"shininess fitted the wrong way",
     L(7),
     {{{SLOT_EXPONENT, EXPONENT_QUARTER}}},
     "The highlight is far too wide: the exponent is divided where it is to be multiplied.",
     "the exponent: about 4 times u_Shininess"},
    {"highlight in the object's colour",
     SHINY,
     {{{SLOT_HIGHLIGHT_COLOR, HIGHLIGHT_TINTED}}},
     "The highlight has the object's colour.",
     "the specular term: u_SpecularColor, without a_Color"},
    {"light colour ignored in the highlight",
     SHINY,
     {{{SLOT_HIGHLIGHT_COLOR, HIGHLIGHT_WHITE_LIGHT}}},
     "The highlight is as if all light were white.",
     "the specular term: times u_LightColor"},
    {"specular colour ignored",
     SHINY,
     {{{SLOT_HIGHLIGHT_COLOR, HIGHLIGHT_WHITE}}},
     "The highlight is too bright: the surface's specular colour is missing.",
     "the specular term: times u_SpecularColor"},

    /* Where light is computed. */
    {"light at the vertices",
     ROUND,
     {{{SLOT_STAGE, STAGE_VERTICES}}},
     "The mesh shows: light is computed at the vertices and its colour interpolated.",
     "the fragment shader: the sum belongs there; pass on normal and point"},

    /* The spot. */
    {"attenuation missing",
     L(8),
     {{{SLOT_FADE, FADE_MISSING}}},
     "The light is as strong far away as it is near.",
     "the factor 1.0 / (c + l d + q d d)"},
    {"attenuation inverted",
     L(8),
     {{{SLOT_FADE, FADE_INVERTED}}},
     "The farther, the brighter: it is multiplied by what it is to be divided by.",
     "the attenuation: 1.0 / (c + l d + q d d)"},
    {"attenuation by the square",
     L(8),
     {{{SLOT_FADE, FADE_SQUARED}}},
     "The distance's square is used in the place of the distance.",
     "d: length(...), not dot(v, v) and not d * d"},
    {"attenuation by the inverse square",
     L(8),
     {{{SLOT_FADE, FADE_INVERSE_SQUARE}}},
     "It is divided by the distance's square, whatever u_Attenuation says.",
     "the attenuation: 1.0 / (c + l d + q d d)"},
    {"attenuation's factors swapped",
     L(8),
     {{{SLOT_FADE, FADE_SWAPPED}}},
     "The linear and the quadratic factor are swapped.",
     "u_Attenuation: x constant, y linear, z quadratic"},
    {"attenuation without the linear part",
     L(8),
     {{{SLOT_FADE, FADE_NO_LINEAR}}},
     "The linear part of the attenuation is missing.",
     "u_Attenuation.y * d"},
    {"attenuation without the quadratic part",
     L(8),
     {{{SLOT_FADE, FADE_NO_QUADRATIC}}},
     "The quadratic part of the attenuation is missing.",
     "u_Attenuation.z * d * d"},
    {"attenuation without the constant part",
     L(8),
     {{{SLOT_FADE, FADE_NO_CONSTANT}}},
     "The constant part of the attenuation is missing.",
     "u_Attenuation.x"},
    {"distance of a unit vector",
     L(8),
     {{{SLOT_FADE, FADE_UNIT}}},
     "The attenuation is the same everywhere: the distance is measured after the direction was made "
     "unit, and is 1.",
     "the distance: length(u_LightPosition - point), before normalize"},
    {"attenuation of the ambient light",
     L(8),
     {{{SLOT_FADE_ON, ON_AMBIENT}}},
     "Ambient light becomes weaker with the distance, too.",
     "the brackets: u_AmbientLight is added outside of them"},
    {"highlight without attenuation",
     L(8),
     {{{SLOT_FADE_ON, ON_NO_HIGHLIGHT}}},
     "The highlight does not become weaker with the distance.",
     "the brackets: the attenuation is a factor of the highlight, too"},
    {"angle compared with a cosine",
     L(8),
     {{{SLOT_CONE, CONE_ANGLE}}, {{SLOT_CONE, CONE_ANGLE_DEGREES}}},
     "The cosine of the angle to the axis is compared with the cutoff angle itself.",
     "the comparison: dot(-L, axis) >= cos(radians(u_SpotCutoff))"},
    {"no cutoff",
     L(8),
     {{{SLOT_CONE, CONE_NONE}}},
     "The cone has no border.",
     "the comparison with cos(radians(u_SpotCutoff))"},
    {"cutoff taken for the whole angle",
     L(8),
     {{{SLOT_CONE, CONE_WHOLE}}},
     "The cone is half as wide: the cutoff is taken for the whole angle of it.",
     "cos(radians(u_SpotCutoff)), without a half"},
    {"light outside the cone",
     L(8),
     {{{SLOT_CONE, CONE_OUTSIDE}}},
     "It is lit outside the cone and dark within.",
     "the comparison: within, the cosine is larger"},
    {"spot direction reversed",
     L(8),
     {{{SLOT_CONE_SIGN, SIGN_REVERSED}}},
     "The cone points the other way.",
     "the sign in dot(-L, u_SpotDirection)"},
    {"no soft edge",
     L(8),
     {{{SLOT_CONE_FALL_OFF, FALL_OFF_NONE}}},
     "The light is as strong at the cone's border as on its axis.",
     "the factor pow(cosine, u_SpotExponent)"},
    {"spot exponent ignored",
     L(8),
     {{{SLOT_CONE_FALL_OFF, FALL_OFF_ONE}}},
     "The light falls off too slowly towards the cone's border: the exponent is missing.",
     "the factor pow(cosine, u_SpotExponent)"},
    {"ambient only within the cone",
     L(8),
     {{{SLOT_CONE_ON, ON_AMBIENT}}},
     "Outside the cone it is black: ambient light is limited by it, too.",
     "the brackets: u_AmbientLight is added outside of them"},
    {"highlight outside the cone",
     L(8),
     {{{SLOT_CONE_ON, ON_NO_HIGHLIGHT}}},
     "The highlight ignores the cone.",
     "the brackets: the spot's factor is of the highlight, too"},

    /* Two sides. */
    {"back not lit",
     L(9),
     {{{SLOT_FACING, FACING_NONE}}},
     "The back is drawn as the front: with its colour, and with its normal.",
     "gl_FrontFacing, or the sign of dot(N, V): is either used?"},
    {"back in the front's colour",
     L(9),
     {{{SLOT_BACK, BACK_FRONT_COLOR}}},
     "The back has the front's colour.",
     "u_BackColor"},
    {"back's normal not reversed",
     L(9),
     {{{SLOT_BACK, BACK_NOT_REVERSED}}},
     "The back is lit when the light is in front: its normal is not reversed.",
     "the normal on the back: -N"},
    {"gl_FrontFacing in a mirror",
     L(9),
     {{{SLOT_FACING, FACING_UNMIRRORED}}},
     "In mirrored moments front and back are swapped: a mirror turns the triangles' order round, and "
     "gl_FrontFacing with it.",
     "gl_FrontFacing: where u_Mirrored is -1.0 it says the opposite"},
    {"front and back swapped",
     L(9),
     {{{SLOT_FACING, FACING_SWAPPED}}},
     "Front and back are swapped.",
     "the branch that gl_FrontFacing or dot(N, V) chooses"},
    {"side by the light",
     L(9),
     {{{SLOT_FACING, FACING_LIGHT}}},
     "The side is chosen by where the light is; it is the eye that sees a front or a back.",
     "dot(N, V), with the view vector, not dot(N, L)"},

    /* The end. This one is not drawn, but looked for with the precision that the file asks for. */
    {"mediump overflow",
     L(5) | L(6) | L(7) | L(8) | L(9),
     {{{SLOT_STAGE, 0}}},
     "It breaks where distances are large: in 16 bits their squares overflow.",
     "the fragment shader's precision: highp float"},
    {"extra gamma",
     SHADED,
     {{{SLOT_OUTPUT, OUTPUT_GAMMA}}},
     "The picture is too pale: its colours are raised to 1 / 2.2 at the end.",
     "gl_FragColor: the sum, without pow"},
};

const int MISTAKE_COUNT = sizeof MISTAKES / sizeof MISTAKES[0];

/* Forms of other labs: a slot that this one has not. */
static bool form_applies(const Lab *lab, const Change *form)
{
    for (int i = 0; i < MISTAKE_MOST_CHANGES && form[i].choice; i++) {
        const Slot slot = form[i].slot;
        if ((slot >= SLOT_ORDER && slot <= SLOT_WORLD && !lab->given) ||
            (slot == SLOT_VIEW && !lab->specular) ||
            (slot == SLOT_PLACE && (lab->given || lab->light == LIGHT_DIRECTIONAL)) ||
            (slot == SLOT_LIGHT_SPACE && lab->given) ||
            (slot == SLOT_CONE && lab->light != LIGHT_SPOT))
            return false;
    }
    return true;
}

static Choices with_changes(Choices choices, const Change *form)
{
    for (int i = 0; i < MISTAKE_MOST_CHANGES && form[i].choice; i++)
        choices.of[form[i].slot] = form[i].choice;
    return choices;
}

Suspect *catalogue_singles(const Lab *lab, int *count)
{
    const int truths = lab->either ? 2 : lab->fitted ? 3 : 1;
    Suspect *suspects =
        malloc((size_t)(truths * MISTAKE_COUNT * MISTAKE_MOST_FORMS) * sizeof *suspects);
    *count = 0;
    for (int truth = 0; suspects && truth < truths; truth++) {
        Choices right = {{0}};
        right.of[lab->fitted ? SLOT_FIT : SLOT_STAGE] =
            truth; /* STAGE_OTHER; FIT_LEAST, FIT_FOUR */
        for (int i = 0; i < MISTAKE_COUNT; i++) {
            if (!(MISTAKES[i].labs & L(lab->number)))
                continue;
            for (int k = 0; k < MISTAKE_MOST_FORMS && MISTAKES[i].forms[k][0].choice; k++)
                if (form_applies(lab, MISTAKES[i].forms[k]))
                    suspects[(*count)++] =
                        (Suspect){{i, -1}, with_changes(right, MISTAKES[i].forms[k])};
        }
    }
    return suspects;
}

bool catalogue_pair(const Suspect *a, const Suspect *b, Suspect *pair)
{
    const int stage = a->choices.of[SLOT_STAGE], other = b->choices.of[SLOT_STAGE];
    if (a->mistakes[0] == b->mistakes[0] || a->choices.of[SLOT_FIT] || b->choices.of[SLOT_FIT])
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
    /* Lit at the vertices there is nothing to make unit at the fragments. */
    return stage != STAGE_VERTICES || other != STAGE_VERTICES;
}

bool catalogue_moves(const Suspect *suspect)
{
    const int *of = suspect->choices.of;
    /* Another depth leaves the outline. */
    return of[SLOT_CLIP] && of[SLOT_CLIP] != CLIP_FLAT && of[SLOT_CLIP] != CLIP_REVERSED;
}

int catalogue_find(const char *name)
{
    for (int i = 0; i < MISTAKE_COUNT; i++)
        if (strcmp(MISTAKES[i].name, name) == 0)
            return i;
    return -1;
}
