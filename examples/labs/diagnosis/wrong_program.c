/* One program draws every mistake, because compiling hundreds would take minutes: its shaders
 * branch on uniforms, whose values are the choices (catalogue_choices.def). */
#include "labs/diagnosis/wrong_program.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The uniforms, by number in `locations`. */
/* clang-format off */
#define UNIFORMS(X)                                                                               \
    X(u_Clip) X(u_Place) X(u_Normal) X(u_AtVertices) X(u_NormalUnit) X(u_Light) X(u_FromPlace)    \
    X(u_LightUnit) X(u_LightSign) X(u_Cosine) X(u_Base) X(u_Ambient)     X(u_Diffuse)             \
    X(u_Highlight) X(u_Exponent) X(u_Reflection) X(u_Gate) X(u_Power) X(u_View) X(u_ViewPlace)    \
    X(u_ViewUnit) X(u_Fade) X(u_FadeMode) X(u_FadeOn) X(u_SpotAxis) X(u_SpotCosine)               \
    X(u_SpotExponent) X(u_SpotOutside) X(u_SpotOn) X(u_Facing) X(u_Mirrored) X(u_BackNormal)      \
    X(u_Discard) X(u_Lights) X(u_Gamma) X(u_SpotShape) X(u_Limit)    \
    X(u_LimitOf) X(u_Plus) X(u_LightsOf) X(u_Output) X(u_NormalOf) X(u_CosineMax) X(u_CosinePower) X(u_PlaceUnit)         \
    X(u_Axis) X(u_Most) X(u_MapMatrix) X(u_Map) X(u_MapPlace) X(u_MapDepth) X(u_MapBias)         \
    X(u_MapTest) X(u_MapOutside) X(u_ShadowOn) X(u_ShadowLight) X(u_MapLight)
/* clang-format on */

#define NUMBER(name) U_##name,
enum { UNIFORMS(NUMBER) UNIFORM_COUNT };
#undef NUMBER
_Static_assert((int)UNIFORM_COUNT == (int)WRONG_PROGRAM_UNIFORMS, "a location for each");

#define NAME(name) #name,
static const char *const NAMES[UNIFORM_COUNT] = {UNIFORMS(NAME)};
#undef NAME

/* The choices, as the shaders have them. */
static const struct {
    const char *name;
    int number;
} NUMBERS[] = {
#define CHOICES(group) {#group "_RIGHT", group##_RIGHT},
#define CHOICE(name) {#name, name},
#include "labs/diagnosis/catalogue_choices.def"
#undef CHOICES
#undef CHOICE
};

enum { NUMBER_COUNT = sizeof NUMBERS / sizeof NUMBERS[0] };

bool wrong_program_open(WrongProgram *program, const Lab *lab, Message *message)
{
    char *defines[NUMBER_COUNT + 2] = {lab->shadow ? memory_text("SHADOWS") : NULL};
    int count = lab->shadow;
    for (int i = 0; i < NUMBER_COUNT; i++)
        defines[count++] = memory_format("%s %d", NUMBERS[i].name, NUMBERS[i].number);
    const ShaderLoader loader = {.precision = "highp", .defines = (const char *const *)defines};
    *program = (WrongProgram){.position = -1};
    const bool opened = shader_open(&program->shader, &loader, "labs/catalogue", message);
    while (count > 0)
        free(defines[--count]);
    if (!opened)
        return false;
    program->position = glGetAttribLocation(program->shader.program, "a_Position");
    program->normal = glGetAttribLocation(program->shader.program, "a_Normal");
    for (int i = 0; i < UNIFORM_COUNT; i++)
        program->locations[i] = glGetUniformLocation(program->shader.program, NAMES[i]);
    return true;
}

void wrong_program_close(WrongProgram *program)
{
    if (!program)
        return;
    shader_close(&program->shader);
    *program = (WrongProgram){.position = -1};
}

static void set_int(const WrongProgram *program, int uniform, int value)
{
    glUniform1i(program->locations[uniform], value);
}

static void set_float(const WrongProgram *program, int uniform, double value)
{
    const float rounded = (float)value;
    glUniform1fv(program->locations[uniform], 1, &rounded);
}

static void set_vec3(const WrongProgram *program, int uniform, double x, double y, double z)
{
    shader_set_vec3(program->locations[uniform], (Vec3){x, y, z});
}

static void set_vectors(const WrongProgram *program, int uniform, const Vec3 *values, int count)
{
    float rounded[12];
    for (int i = 0; i < count; i++)
        vec3_to_float(values[i], rounded + 3 * i);
    glUniform3fv(program->locations[uniform], count, rounded);
}

/* Sets a uniform to the number of the choice: the shader has the same numbers. */
static void set_choice(const WrongProgram *program, int uniform, const Made *made, Slot slot)
{
    set_int(program, uniform, made_choice(made, slot));
}

static void set_matrices(const WrongProgram *program, const Made *made)
{
    const GLint *at = program->locations;
    const int normal = made_choice(made, SLOT_NORMAL);
    shader_set_mat4(at[U_u_Clip], made_clip_matrix(made));
    shader_set_mat4(at[U_u_Place], made_place_matrix(made));
    shader_set_mat4(at[U_u_Normal], made_normal_matrix(made));
    set_int(program, U_u_NormalOf, normal == NORMAL_POSITION || normal == NORMAL_WORLD_POSITION);
}

static void set_lights(const WrongProgram *program, const Made *made)
{
    const bool directional = made->lab->light == LIGHT_DIRECTIONAL;
    set_vectors(program, U_u_Light, made->light, LAB_MAX_LIGHTS);
    set_float(program, U_u_FromPlace, directional || made_choice(made, SLOT_LIGHT) ? 0 : 1);
    set_int(program, U_u_Lights, made->lab->lights);
    set_float(program, U_u_LightSign, made_choice(made, SLOT_LIGHT_SIGN) ? -1 : 1);
    set_choice(program, U_u_LightUnit, made, SLOT_LIGHT_UNIT);
    set_choice(program, U_u_Cosine, made, SLOT_COSINE);
    set_float(program, U_u_CosinePower, made_factor(made, FACTOR_COSINE_POWER));
    set_int(program, U_u_PlaceUnit, made_choice(made, SLOT_PLACE) == PLACE_UNIT);
    /* Other modes and directions that are not normalized go beyond 1. */
    set_float(program, U_u_CosineMax,
              made->choices->factor == FACTOR_COSINE ? made->choices->value : 1e9);
}

static void set_colors(const WrongProgram *program, const Made *made)
{
    const MadeColors colors = made_colors(made);
    set_vectors(program, U_u_Base, colors.base, 2);
    set_vectors(program, U_u_Limit, colors.limit, 2);
    set_vectors(program, U_u_Plus, &colors.plus, 1);
    set_vectors(program, U_u_Diffuse, colors.diffuse, 4);
    set_vectors(program, U_u_Highlight, colors.specular, 2);
    set_int(program, U_u_LimitOf,
            made->choices->factor == FACTOR_LIMIT ? LIMIT_ALL : made_choice(made, SLOT_LIMIT));
    set_choice(program, U_u_LightsOf, made, SLOT_LIGHTS);
    set_choice(program, U_u_Ambient, made, SLOT_AMBIENT);
}

/* The highlight. */

static void set_reflection(const WrongProgram *program, const Made *made)
{
    const int of = made_choice(made, SLOT_REFLECTION);
    const bool other = of == REFLECTION_OTHER || of == REFLECTION_OTHER_FITTED;
    const bool blinn_phong = (made->lab->reflection == REFLECTION_BLINN_PHONG) != other;
    const int reflection = !made->lab->specular               ? REFLECTION_NONE
                           : of != REFLECTION_RIGHT && !other ? of
                           : blinn_phong                      ? REFLECTION_AS_BLINN_PHONG
                                                              : REFLECTION_AS_PHONG;
    set_int(program, U_u_Reflection, reflection);
    set_float(
        program, U_u_Exponent,
        reflection == REFLECTION_NONE
            ? 1
            : made_value(made, FACTOR_EXPONENT_VALUE,
                         made_exponent(made, blinn_phong) * made_factor(made, FACTOR_EXPONENT) +
                             20 * made_value(made, FACTOR_PLUS_EXPONENT, 0)));
    set_choice(program, U_u_Gate, made, SLOT_GATE);
    set_choice(program, U_u_Power, made, SLOT_POWER);
}

static void set_view(const WrongProgram *program, const Made *made)
{
    const double *m = made->eye_from_world.m;
    const Vec3 eye = made->lab_scene->scene.camera.eye;
    const Vec3 center = mat4_transform_point(made->world, (Vec3){0, 0, 0});
    const Vec3 views[] = {
        eye,
        [VIEW_WORLD_ORIGIN] = {0, 0, 0},
        [VIEW_EYE_SPACE] = {0, 0, 0},
        [VIEW_FIXED_EYE] = eye,
        [VIEW_FIXED_Z] = {0, 0, 1},
        [VIEW_FIXED_AXIS] = {m[2], m[6], m[10]},
        [VIEW_FIXED_CENTER] = vec3_subtract(eye, center),
        [VIEW_RAW] = eye,
        [VIEW_REVERSED] = vec3_scale(eye, -1),
        [VIEW_NEGATED_EYE] = vec3_scale(eye, -1),
        [VIEW_OBJECT_SPACE] = eye,
        [VIEW_NOT_TO_EYE] = vec3_add(
            eye, mat4_transform_direction(made_part(made->eye_from_world, PART_INVERSE), eye))};
    const int of = made_choice(made, SLOT_VIEW);
    const bool fixed = (of >= VIEW_FIXED_EYE && of <= VIEW_FIXED_CENTER) || of == VIEW_NEGATED_EYE;
    Mat4 inverse = mat4_identity();
    if (of == VIEW_OBJECT_SPACE)
        mat4_inverse(made->world, &inverse);
    const Mat4 place = fixed                     ? (Mat4){{0}}
                       : of == VIEW_EYE_SPACE    ? made->eye_from_world
                       : of == VIEW_REVERSED     ? mat4_scale((Vec3){-1, -1, -1})
                       : of == VIEW_OBJECT_SPACE ? inverse
                                                 : mat4_identity();
    shader_set_vec3(program->locations[U_u_View], views[of]);
    shader_set_mat4(program->locations[U_u_ViewPlace], place);
    set_int(program, U_u_ViewUnit, of != VIEW_RAW);
}

/* The spot. */

static void set_fade(const WrongProgram *program, const Made *made)
{
    const Light *light = &made->lab_scene->lights[0];
    const int of = made_choice(made, SLOT_FADE), on = made_choice(made, SLOT_FADE_ON);
    double c = light->constant, l = light->linear, q = light->quadratic;
    const bool spot = made->lab->light == LIGHT_SPOT;
    if (!spot || of == FADE_MISSING)
        c = 1, l = q = 0;
    if (of == FADE_INVERSE)
        c = q = 0, l = 1;
    if (of == FADE_ONE_PLUS_SQUARE)
        c = q = 1, l = 0;
    if (of == FADE_TUTORIAL)
        c = 1, l = 0.09, q = 0.032;
    l = made_value(made, FACTOR_FADE_LINEAR, l);
    q = made_value(made, FACTOR_FADE_SQUARE, q);
    c *= made_factor(made, FACTOR_CONSTANT);
    l *= made_factor(made, FACTOR_LINEAR);
    q *= made_factor(made, FACTOR_QUADRATIC);
    if (of == FADE_ALL_LINEAR)
        l += q, q = 0;
    if (of == FADE_ALL_SQUARED)
        q += l, l = 0;
    if (of == FADE_SWAPPED)
        l = light->quadratic, q = light->linear;
    if (of == FADE_UNIT)
        c += l + q, l = q = 0;
    if (of == FADE_INVERSE_SQUARE)
        c = l = 0, q = 1;
    c *= of != FADE_NO_CONSTANT;
    l *= of != FADE_NO_LINEAR;
    q *= of != FADE_NO_QUADRATIC;
    set_vec3(program, U_u_Fade, c, l, q);
    set_choice(program, U_u_FadeMode, made, SLOT_FADE);
    set_vec3(program, U_u_FadeOn, 1, on != ON_NO_HIGHLIGHT, on == ON_AMBIENT);
}

static void set_cone(const WrongProgram *program, const Made *made)
{
    const Light *light = &made->lab_scene->lights[0];
    const int of = made_choice(made, SLOT_CONE), on = made_choice(made, SLOT_CONE_ON);
    const bool spot = made->lab->light == LIGHT_SPOT;
    const double cutoff = made_value(
        made, FACTOR_CUTOFF_VALUE, (spot ? light->cutoff : 90) * made_factor(made, FACTOR_CUTOFF));
    const double radians = cutoff * acos(-1) / 180;
    const double cosines[] = {cos(radians),
                              [CONE_DEGREES] = cos(cutoff),
                              [CONE_ANGLE] = radians,
                              [CONE_ANGLE_DEGREES] = cutoff,
                              [CONE_NONE] = -1e30,
                              [CONE_WHOLE] = cos(radians / 2),
                              [CONE_OUTSIDE] = cos(radians),
                              [CONE_DEGREES_TWICE] = cos(cutoff * 180 / acos(-1)),
                              [CONE_HARD_COSINE] = cos(radians) * 180 / acos(-1),
                              [CONE_RADIANS_TWICE] = cos(radians * acos(-1) / 180)};
    const int fall_off = made_choice(made, SLOT_CONE_FALL_OFF);
    const double exponents[] = {
        spot ? made_value(made, FACTOR_SPOT_EXPONENT_VALUE,
                          light->exponent * made_factor(made, FACTOR_SPOT_EXPONENT))
             : 0,
        [FALL_OFF_NONE] = 0,
        [FALL_OFF_ONE] = 1,
        [FALL_OFF_LINEAR] = 1,
        [FALL_OFF_SMOOTH] = 1,
        [FALL_OFF_SHININESS] = made->object->front.shininess,
        [FALL_OFF_LINEAR_POWER] = light->exponent};
    Vec3 axis = {0, 0, 1};
    if (spot)
        vec3_normalize(light->direction, &axis);
    const int sign = made_choice(made, SLOT_CONE_SIGN);
    if (sign == AXIS_TO_EYE)
        axis = mat4_transform_direction(made->eye_from_world, axis);
    if (sign == AXIS_NOT_TO_EYE)
        axis = mat4_transform_direction(mat4_transpose(made->eye_from_world), axis);
    if (sign == AXIS_REVERSED)
        axis = vec3_scale(axis, -1);
    if (sign == AXIS_W_1 || sign == AXIS_W_1_UNIT)
        axis = vec3_subtract(axis, made->lab_scene->scene.camera.eye);
    if (sign == AXIS_W_1_UNIT)
        vec3_normalize(axis, &axis);
    shader_set_vec3(program->locations[U_u_SpotAxis], axis);
    set_float(program, U_u_SpotCosine, cosines[of]);
    set_float(program, U_u_SpotExponent, exponents[fall_off]);
    set_choice(program, U_u_SpotShape, made, SLOT_CONE_FALL_OFF);
    set_int(program, U_u_SpotOutside, of == CONE_OUTSIDE);
    set_vec3(program, U_u_SpotOn, spot, spot && on != ON_NO_HIGHLIGHT, spot && on == ON_AMBIENT);
}

static void set_rest(const WrongProgram *program, const Made *made)
{
    const int *of = made->of;
    const bool vertices =
        of[SLOT_STAGE] == STAGE_VERTICES || (of[SLOT_STAGE] == STAGE_OTHER && made->lab->either);
    set_int(program, U_u_AtVertices, vertices || made->lab->given);
    set_choice(program, U_u_NormalUnit, made, SLOT_NORMAL_UNIT);
    set_int(program, U_u_Facing, made->lab->two_sided ? of[SLOT_FACING] : FACING_NONE);
    const double *m = made->eye_from_world.m;
    set_vec3(program, U_u_Axis, m[2], m[6], m[10]);
    set_float(program, U_u_Mirrored, mat4_determinant(made->world) < 0 ? -1 : 1);
    set_int(program, U_u_BackNormal, of[SLOT_BACK] != BACK_NOT_REVERSED);
    const int output = of[SLOT_OUTPUT];
    const double powers[] = {made_factor(made, FACTOR_GAMMA), [OUTPUT_GAMMA] = 1 / 2.2,
                             [OUTPUT_ROOT] = 0.5, [OUTPUT_POWER] = 2.2, [OUTPUT_SQUARE] = 2};
    set_float(program, U_u_Most, made_value(made, FACTOR_RESULT, 1e9));
    set_choice(program, U_u_Discard, made, SLOT_CULL);
    set_float(program, U_u_Gamma, output <= OUTPUT_SQUARE ? powers[output] : 1);
    set_choice(program, U_u_Output, made, SLOT_OUTPUT);
}

/* The shadow map. */

static Mat4 map_matrix(const Made *made, const LabShadowMap *map)
{
    switch (made_choice(made, SLOT_MAP_PLACE)) {
    case MAP_PLACE_OBJECT:
        return map->clip_from_world;
    case MAP_PLACE_CLIP:
        return mat4_product(made->clip_from_eye, mat4_product(made->eye_from_world, made->world));
    case MAP_PLACE_ORDER:
        return mat4_product(made->world, map->clip_from_world);
    default:
        return mat4_product(map->clip_from_world, made->world);
    }
}

static void set_shadow(const WrongProgram *program, const Made *made, const LabShadowMap *map)
{
    const double biases[] = {0.002,
                             [MAP_BIAS_NONE] = 0,
                             [MAP_BIAS_REVERSED] = -0.002,
                             [MAP_BIAS_SMALL] = 0.001,
                             [MAP_BIAS_MIDDLE] = 0.003,
                             [MAP_BIAS_LARGE] = 0.005};
    const double value = made->choices->value;
    const Factor which = made->choices->factor;
    const double bias = which >= FACTOR_BIAS_LARGE && which <= FACTOR_BIAS_SLOPE
                            ? factor_value(made->choices)
                            : biases[made_choice(made, SLOT_MAP_BIAS)];
    const double slope = which == FACTOR_BIAS_SLOPE ? 10 * bias : 0;
    const bool clip = which == FACTOR_BIAS_CLIP;
    const int on = made_choice(made, SLOT_SHADOW_ON);
    const double left = which == FACTOR_SHADOW || which == FACTOR_SHADOW_ALL ? fmin(value, 1)
                        : which == FACTOR_SHADOW_BELOW                       ? -value
                                                                             : 0;
    if (!map->texture)
        return;
    glBindTexture(GL_TEXTURE_2D, map->texture);
    set_int(program, U_u_Map, 0);
    shader_set_mat4(program->locations[U_u_MapMatrix], map_matrix(made, map));
    set_choice(program, U_u_MapPlace, made, SLOT_MAP_PLACE);
    set_choice(program, U_u_MapDepth, made, SLOT_MAP_DEPTH);
    set_choice(program, U_u_MapTest, made, SLOT_MAP_TEST);
    set_choice(program, U_u_MapOutside, made, SLOT_MAP_OUTSIDE);
    set_vec3(program, U_u_MapBias, clip ? 0 : bias, slope, clip ? factor_value(made->choices) : 0);
    set_vec3(program, U_u_ShadowOn, on != SHADOW_ON_AMBIENT, 0,
             on != 0 || which == FACTOR_SHADOW_ALL);
    set_float(program, U_u_ShadowLight, left);
    set_float(program, U_u_MapLight, made_factor(made, FACTOR_MAP_LIGHT));
}

bool wrong_program_draw(const WrongProgram *program, const Lab *lab, const LabScene *lab_scene,
                        const LabSceneBuffers *buffers, const Choices *choices)
{
    Made made = {.lab = lab, .lab_scene = lab_scene, .choices = choices, .of = choices->of};
    if (!scene_camera(&lab_scene->scene.camera, (double)lab_scene->width / lab_scene->height,
                      &made.eye_from_world, &made.clip_from_eye, NULL))
        return false;
    glUseProgram(program->shader.program);
    glEnable(GL_DEPTH_TEST);
    if (buffers->cull)
        glEnable(GL_CULL_FACE);
    made_choose_light_colors(&made);
    set_fade(program, &made);
    for (int i = 0; i < lab_scene->scene.object_count; i++) {
        const MeshBuffer *mesh = &buffers->buffers[i];
        made.object = &lab_scene->objects[i];
        set_cone(program, &made);
        made.world = made_model_matrix(&made);
        made_choose_light_places(&made);
        set_view(program, &made);
        set_matrices(program, &made);
        set_lights(program, &made);
        set_colors(program, &made);
        set_reflection(program, &made);
        set_rest(program, &made);
        set_shadow(program, &made, &buffers->map);
        mesh_buffer_bind(mesh, program->position, program->normal);
        glDrawElements(GL_TRIANGLES, mesh->index_count, mesh->index_type, NULL);
    }
    glDisable(GL_CULL_FACE);
    return true;
}
