#include "labs/diagnosis/wrong_program.h"

#include "app/options.h"
#include "base/memory.h"
#include "core/example.h"

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

/* One object, with the matrices and colours that the choices give it. */
typedef struct Made {
    const Lab *lab;
    const Probe *probe;
    const Object *object;
    const Choices *choices;
    const int *of;
    Mat4 world, eye_from_world, clip_from_eye;
    Vec3 light[LAB_MAX_LIGHTS], light_color[LAB_MAX_LIGHTS];
} Made;

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

bool probe_buffers_open(ProbeBuffers *buffers, const Probe *probe,
                        const SubmissionGeometry *geometry, Message *message)
{
    *buffers = (ProbeBuffers){.cull = geometry->cull};
    for (int i = 0; i < probe->scene.object_count; i++) {
        const Mesh *mesh = geometry->mesh ? geometry->mesh : &probe->meshes[i];
        if (!mesh_buffer_open(&buffers->buffers[i], mesh, message)) {
            probe_buffers_close(buffers);
            return false;
        }
    }
    if (probe_map_open(&buffers->map, probe, message))
        return true;
    probe_buffers_close(buffers);
    return false;
}

void probe_buffers_close(ProbeBuffers *buffers)
{
    if (!buffers)
        return;
    for (int i = 0; i < PROBE_MAX_OBJECTS; i++)
        mesh_buffer_close(&buffers->buffers[i]);
    probe_map_close(&buffers->map);
}

static int choice(const Made *made, Slot slot)
{
    return made->of[slot];
}

/* 1 if the factor is another. */
static double factor(const Made *made, Factor which)
{
    return made->choices->factor == which ? made->choices->value : 1;
}

/* The value if that is the factor. */
static double value(const Made *made, Factor which, double otherwise)
{
    return made->choices->factor == which ? made->choices->value : otherwise;
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
    set_int(program, uniform, choice(made, slot));
}

/* Matrices. */

static Mat4 part(Mat4 right, int choice)
{
    Mat4 inverse;
    if (choice == PART_INVERSE && mat4_inverse(right, &inverse))
        return inverse;
    return choice == PART_MISSING ? mat4_identity() : right;
}

static void world_parts(const Made *made, Mat4 *move, Mat4 *turn, Mat4 *scale)
{
    static const Vec3 AXES[] = {[AXIS_X] = {1, 0, 0}, [AXIS_Y] = {0, 1, 0}, [AXIS_Z] = {0, 0, 1}};
    const double degrees = DEGREES_PER_SECOND * made->probe->seconds, radian = 180 / acos(-1);
    const double angles[] = {degrees, [PART_MISSING] = 0, [TURN_RADIANS] = degrees / radian,
                             [TURN_DEGREES] = degrees * radian};
    const double angle = angles[choice(made, SLOT_TURN)];
    const int axis = choice(made, SLOT_AXIS);
    probe_world_parts(made->probe->seconds, move, turn, scale);
    *move = part(*move, choice(made, SLOT_MOVE));
    *scale = part(*scale, choice(made, SLOT_SCALE));
    *turn =
        mat4_rotate(choice(made, SLOT_TURN_SIGN) ? -angle : angle, axis ? AXES[axis] : PROBE_AXIS);
}

static Mat4 product_of(Mat4 first, Mat4 second, Mat4 third)
{
    return mat4_product(first, mat4_product(second, third));
}

/* The object's, except in lab 3, whose C makes it. */
static Mat4 model_matrix(const Made *made)
{
    Mat4 move, turn, scale;
    if (!made->lab->given)
        return made->object->world_from_object;
    world_parts(made, &move, &turn, &scale);
    const int order = choice(made, SLOT_ORDER), world = choice(made, SLOT_WORLD);
    const Mat4 matrix = order == ORDER_MOVED_FIRST   ? product_of(turn, move, scale)
                        : order == ORDER_SCALED_LAST ? product_of(move, scale, turn)
                        : order == ORDER_REVERSED    ? product_of(scale, turn, move)
                                                     : product_of(move, turn, scale);
    return world == WORLD_TRANSPOSED ? mat4_transpose(matrix)
           : world == WORLD_IDENTITY ? mat4_identity()
           : world == WORLD_INVERSE  ? part(matrix, PART_INVERSE)
                                     : matrix;
}

static Mat4 clip_matrix(const Made *made)
{
    const Vec3 scales[] = {{1, 1, 1},
                           [CLIP_UPSIDE_DOWN] = {1, -1, 1},
                           [CLIP_SWAPPED] = {-1, 1, 1},
                           [CLIP_ASPECT] = {(double)made->probe->width / made->probe->height, 1, 1},
                           [CLIP_TRANSPOSED] = {1, 1, 1},
                           [CLIP_FLAT] = {1, 1, 0},
                           [CLIP_REVERSED] = {1, 1, -1}};
    const int clip = choice(made, SLOT_CLIP);
    if (clip == CLIP_NO_MODEL)
        return mat4_product(made->clip_from_eye, made->eye_from_world);
    if (clip == CLIP_NO_VIEW)
        return mat4_product(made->clip_from_eye, made->world);
    if (clip == CLIP_NO_PROJECTION)
        return mat4_product(made->eye_from_world, made->world);
    if (clip == CLIP_VIEW_LAST)
        return product_of(made->eye_from_world, made->clip_from_eye, made->world);
    const Mat4 right = product_of(made->clip_from_eye, made->eye_from_world, made->world);
    return clip == CLIP_TRANSPOSED    ? mat4_transpose(right)
           : clip == CLIP_MODEL_TWICE ? mat4_product(right, made->world)
                                      : mat4_product(mat4_scale(scales[clip]), right);
}

static Mat4 without_translation(Mat4 matrix)
{
    matrix.m[12] = matrix.m[13] = matrix.m[14] = 0;
    return matrix;
}

static Mat4 place_matrix(const Made *made)
{
    switch (choice(made, SLOT_PLACE)) {
    case PLACE_OBJECT:
        return mat4_identity();
    case PLACE_W_0:
        return without_translation(made->world);
    case PLACE_EYE:
        return mat4_product(made->eye_from_world, made->world);
    case PLACE_TRANSPOSED:
        return mat4_transpose(made->world);
    case PLACE_CLIP:
        return product_of(made->clip_from_eye, made->eye_from_world, made->world);
    case PLACE_NORMAL_MATRIX:
        return binding_normal_matrix(made->world);
    case PLACE_NOT_TO_EYE:
        return mat4_product(part(made->eye_from_world, PART_INVERSE), made->world);
    default:
        return made->world;
    }
}

/* The shader adds its last column to the normal. */
static Mat4 normal_matrix(const Made *made)
{
    static const Mat4 SWAPS[] = {{{1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1}},
                                 {{0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                                 {{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1}}};
    Mat4 move, turn, scale;
    switch (choice(made, SLOT_NORMAL)) {
    case NORMAL_OBJECT:
        return mat4_identity();
    case NORMAL_MODEL:
        return without_translation(made->world);
    case NORMAL_WORLD_POSITION:
    case NORMAL_MODEL_W_1:
        return made->world;
    case NORMAL_INVERSE:
        return mat4_transpose(binding_normal_matrix(made->world));
    case NORMAL_TRANSPOSE:
        return mat4_transpose(made->world);
    case NORMAL_EYE:
        return binding_normal_matrix(mat4_product(made->eye_from_world, made->world));
    case NORMAL_NOT_TO_EYE: /* as seen from world space */
        return mat4_product(without_translation(part(made->eye_from_world, PART_INVERSE)),
                            binding_normal_matrix(made->world));
    case NORMAL_XZY:
    case NORMAL_YXZ:
    case NORMAL_ZYX:
        return mat4_product(binding_normal_matrix(made->world),
                            SWAPS[choice(made, SLOT_NORMAL) - NORMAL_XZY]);
    case NORMAL_CLIP:
        return without_translation(
            product_of(made->clip_from_eye, made->eye_from_world, made->world));
    case NORMAL_VIEW:
        return without_translation(made->eye_from_world);
    case NORMAL_TURN:
        world_parts(made, &move, &turn, &scale);
        return turn;
    case NORMAL_UNTURNED:
        world_parts(made, &move, &turn, &scale);
        return binding_normal_matrix(scale);
    case NORMAL_REVERSED:
        world_parts(made, &move, &turn, &scale);
        return binding_normal_matrix(mat4_product(scale, turn));
    default:
        return binding_normal_matrix(made->world);
    }
}

static void set_matrices(const WrongProgram *program, const Made *made)
{
    const GLint *at = program->locations;
    Mat4 normal = normal_matrix(made);
    if (choice(made, SLOT_NORMAL_SIGN) == SIGN_REVERSED ||
        (choice(made, SLOT_NORMAL_SIGN) == SIGN_MIRRORED && mat4_determinant(made->world) < 0))
        normal = mat4_product(mat4_scale((Vec3){-1, -1, -1}), normal);
    shader_set_mat4(at[U_u_Clip], clip_matrix(made));
    shader_set_mat4(at[U_u_Place], place_matrix(made));
    shader_set_mat4(at[U_u_Normal], normal);
    set_int(program, U_u_NormalOf,
            choice(made, SLOT_NORMAL) == NORMAL_POSITION ||
                choice(made, SLOT_NORMAL) == NORMAL_WORLD_POSITION);
}

/* Lights. */

static Vec3 product(Vec3 a, Vec3 b)
{
    return (Vec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

static const Vec3 WHITE = {1, 1, 1}, BLACK = {0, 0, 0};

static void choose_light_colors(Made *made)
{
    for (int i = 0; i < LAB_MAX_LIGHTS; i++) {
        Vec3 *color = &made->light_color[i];
        *color = i < made->lab->lights ? made->probe->lights[i].diffuse : BLACK;
        if (i < made->lab->lights && choice(made, SLOT_LIGHT_COLOR) == LIGHT_COLOR_IGNORED)
            *color = WHITE;
        if (choice(made, SLOT_LIGHT_COLOR) == LIGHT_COLOR_SWAPPED)
            *color = (Vec3){color->z, color->y, color->x};
        if (choice(made, SLOT_LIGHT_COLOR) == LIGHT_COLOR_RED)
            color->y = color->z = color->x;
        if (i < made->lab->lights && made->choices->factor == FACTOR_LIGHT_VALUE)
            *color = vec3_scale(WHITE, made->choices->value);
        *color = vec3_scale(*color, factor(made, i == 0 ? FACTOR_FIRST : FACTOR_SECOND));
        if (choice(made, SLOT_LIGHT_COLOR) == LIGHT_COLOR_SQUARED)
            *color = product(*color, *color);
        if (choice(made, SLOT_LIGHTS) == LIGHTS_MEAN)
            *color = vec3_scale(*color, 1.0 / made->lab->lights);
        if ((choice(made, SLOT_LIGHTS) == LIGHTS_FIRST && i == 1) ||
            (choice(made, SLOT_LIGHTS) == LIGHTS_SECOND && i == 0))
            *color = BLACK;
    }
    const Vec3 first = made->light_color[0], second = made->light_color[1];
    const int of = choice(made, SLOT_LIGHTS);
    if (of == LIGHTS_SWAPPED || of == LIGHTS_SECOND_COLOR)
        made->light_color[0] = second;
    if (of == LIGHTS_SWAPPED || of == LIGHTS_FIRST_COLOR)
        made->light_color[1] = first;
}

static void choose_light_places(Made *made)
{
    const Vec3 center = mat4_transform_point(made->world, (Vec3){0, 0, 0});
    const bool directional = made->lab->light == LIGHT_DIRECTIONAL;
    for (int i = 0; i < LAB_MAX_LIGHTS; i++) {
        const Light *light = &made->probe->lights[i < made->lab->lights ? i : 0];
        Vec3 *place = &made->light[i];
        *place = directional ? light->direction : light->position;
        if (directional)
            vec3_normalize(*place, place);
        if (choice(made, SLOT_LIGHT_SPACE) == LIGHT_SPACE_EYE)
            *place = directional ? mat4_transform_direction(made->eye_from_world, *place)
                                 : mat4_transform_point(made->eye_from_world, *place);
        const int space = choice(made, SLOT_LIGHT_SPACE);
        const Mat4 world_from_eye = part(made->eye_from_world, PART_INVERSE);
        if (space == LIGHT_SPACE_NOT_TO_EYE)
            *place = directional ? mat4_transform_direction(world_from_eye, *place)
                                 : mat4_transform_point(world_from_eye, *place);
        if (space == LIGHT_SPACE_MODEL || space == LIGHT_SPACE_NORMAL)
            *place = mat4_transform_direction(
                space == LIGHT_SPACE_NORMAL ? binding_normal_matrix(made->world) : made->world,
                *place);
        if (space == LIGHT_SPACE_UNIT)
            vec3_normalize(*place, place);
        if (space == LIGHT_SPACE_W_0)
            *place = vec3_add(*place, made->probe->scene.camera.eye);
        if (space == LIGHT_SPACE_MODEL_W_1)
            *place = mat4_transform_point(made->world, *place);
        if (choice(made, SLOT_LIGHT) == LIGHT_FROM_CENTER)
            *place = vec3_subtract(*place, center);
    }
    for (int i = 0; i < LAB_MAX_LIGHTS; i++)
        if (choice(made, SLOT_LIGHTS) == LIGHTS_FIRST_REVERSED + i)
            made->light[i] = vec3_scale(made->light[i], -1);
    if (choice(made, SLOT_LIGHTS) == LIGHTS_FIRST_PLACE)
        made->light[1] = made->light[0];
    if (choice(made, SLOT_LIGHTS) == LIGHTS_SECOND_PLACE)
        made->light[0] = made->light[1];
}

static void set_lights(const WrongProgram *program, const Made *made)
{
    const bool directional = made->lab->light == LIGHT_DIRECTIONAL;
    set_vectors(program, U_u_Light, made->light, LAB_MAX_LIGHTS);
    set_float(program, U_u_FromPlace, directional || choice(made, SLOT_LIGHT) ? 0 : 1);
    set_int(program, U_u_Lights, made->lab->lights);
    set_float(program, U_u_LightSign, choice(made, SLOT_LIGHT_SIGN) ? -1 : 1);
    set_choice(program, U_u_LightUnit, made, SLOT_LIGHT_UNIT);
    set_choice(program, U_u_Cosine, made, SLOT_COSINE);
    set_float(program, U_u_CosinePower, factor(made, FACTOR_COSINE_POWER));
    set_int(program, U_u_PlaceUnit, choice(made, SLOT_PLACE) == PLACE_UNIT);
    /* Other modes and directions that are not normalized go beyond 1. */
    set_float(program, U_u_CosineMax,
              made->choices->factor == FACTOR_COSINE ? made->choices->value : 1e9);
}

/* Colours. */

static Vec3 surface_color(const Made *made, Vec3 color)
{
    if (choice(made, SLOT_COLOR) == COLOR_SQUARED)
        return product(color, color);
    if (choice(made, SLOT_COLOR) == COLOR_SWAPPED)
        return (Vec3){color.z, color.y, color.x};
    if (choice(made, SLOT_COLOR) == COLOR_RBG)
        return (Vec3){color.x, color.z, color.y};
    if (choice(made, SLOT_COLOR) == COLOR_GRB)
        return (Vec3){color.y, color.x, color.z};
    return choice(made, SLOT_COLOR) == COLOR_IGNORED ? WHITE : color;
}

/* A colour in the diffuse term, which may be another than in the ambient term. */
static Vec3 lit_color(const Made *made, Vec3 color)
{
    switch (choice(made, SLOT_COLOR)) {
    case COLOR_LIT_IGNORED:
        return WHITE;
    case COLOR_LIT_SQUARED:
        return product(color, color);
    case COLOR_LIT_SWAPPED:
        return (Vec3){color.z, color.y, color.x};
    default:
        return color;
    }
}

static Vec3 base_color(const Made *made, Vec3 surface)
{
    const Vec3 ambient = made->choices->factor == FACTOR_AMBIENT_VALUE
                             ? vec3_scale(WHITE, made->choices->value)
                             : made->probe->scene.global_ambient;
    const Vec3 base = vec3_scale(product(ambient, surface), factor(made, FACTOR_AMBIENT));
    const int lights = choice(made, SLOT_LIGHTS);
    switch (choice(made, SLOT_AMBIENT)) {
    case AMBIENT_MISSING:
        return BLACK;
    case AMBIENT_PER_LIGHT: /* once for each light in the sum */
        return vec3_scale(
            base, lights == LIGHTS_FIRST || lights == LIGHTS_SECOND ? 1 : made->lab->lights);
    case AMBIENT_PLAIN:
        return ambient;
    case AMBIENT_WHITE:
        return surface;
    case AMBIENT_SQUARED:
        return product(base, ambient);
    case AMBIENT_LIGHT_COLOR:
        return product(base, vec3_add(made->light_color[0], made->light_color[1]));
    default:
        return base;
    }
}

static double exponent(const Made *made, bool blinn_phong)
{
    const double shininess = made->object->front.shininess;
    const double fitted = made->probe->fitted[made->object - made->probe->objects];
    const double wrong[] = {
        0, [EXPONENT_PLAIN] = shininess, [EXPONENT_ONE] = 1, [EXPONENT_QUARTER] = shininess / 4,
        [EXPONENT_SQUARED] = shininess * shininess};
    if (choice(made, SLOT_EXPONENT))
        return wrong[choice(made, SLOT_EXPONENT)];
    if (choice(made, SLOT_REFLECTION) == REFLECTION_OTHER_FITTED)
        return blinn_phong ? 4 * shininess : shininess;
    /* Between the two right exponents: 1 step of 255 from either. */
    const double right[] = {
        (4 * shininess + fitted) / 2, [FIT_LEAST_SQUARES] = fitted, [FIT_FOUR] = 4 * shininess};
    return made->lab->fitted ? right[choice(made, SLOT_FIT)] : shininess;
}

/* What normalizes the highlight's energy. */
static double energy(const Made *made)
{
    const double n = exponent(made, made->lab->reflection == REFLECTION_BLINN_PHONG);
    return choice(made, SLOT_HIGHLIGHT_COLOR) == HIGHLIGHT_ENERGY_2 ? (n + 2) / (2 * acos(-1))
                                                                    : (n + 8) / (8 * acos(-1));
}

static void set_colors(const WrongProgram *program, const Made *made)
{
    const int *of = made->of;
    const bool mirrored = mat4_determinant(made->world) < 0;
    const bool front_only = of[SLOT_BACK] == BACK_FRONT_COLOR || !made->lab->two_sided ||
                            (of[SLOT_BACK] == BACK_NEVER_MIRRORED && mirrored);
    const bool swapped =
        of[SLOT_BACK] == BACK_COLORS_SWAPPED || (of[SLOT_BACK] == BACK_COLORS_MIRRORED && mirrored);
    const Vec3 own_front = surface_color(made, made->object->front.diffuse);
    const Vec3 front = swapped ? surface_color(made, made->object->back.diffuse) : own_front;
    const Vec3 own_back = surface_color(made, made->object->back.diffuse);
    const Vec3 back = front_only                      ? front
                      : of[SLOT_BACK] == BACK_PRODUCT ? product(own_front, own_back)
                      : swapped                       ? own_front
                                                      : own_back;
    const bool added = of[SLOT_COLOR] == COLOR_ADDED;
    const Vec3 back_base = of[SLOT_AMBIENT] == AMBIENT_FRONT ? front : back;
    const Vec3 base[2] = {
        base_color(made, added ? WHITE : front),
        of[SLOT_AMBIENT] == AMBIENT_NOT_BACK ? BLACK : base_color(made, added ? WHITE : back_base)};
    const double whole = factor(made, FACTOR_ALL);
    const double light = made->choices->factor == FACTOR_PLUS_LIGHT ? made->choices->value : 0;
    const double color = made->choices->factor == FACTOR_PLUS_COLOR ? made->choices->value : 0;
    const double limit = factor(made, FACTOR_LIMIT);
    const Vec3 limits[2] = {vec3_scale(front, limit), vec3_scale(back, limit)};
    Vec3 diffuse[4], specular[2], plus = vec3_scale(front, light);
    for (int i = 0; i < 2; i++) {
        const Vec3 lit = vec3_scale(made->light_color[i], whole * factor(made, FACTOR_DIFFUSE));
        diffuse[i] = added ? lit : product(lit_color(made, front), lit);
        diffuse[2 + i] = added ? lit : product(lit_color(made, back), lit);
        specular[i] = product(made->object->front.specular, made->light_color[i]);
        if (of[SLOT_HIGHLIGHT_COLOR] == HIGHLIGHT_TINTED)
            specular[i] = product(specular[i], front);
        if (of[SLOT_HIGHLIGHT_COLOR] == HIGHLIGHT_WHITE)
            specular[i] = made->light_color[i];
        if (of[SLOT_HIGHLIGHT_COLOR] == HIGHLIGHT_WHITE_LIGHT)
            specular[i] = i < made->lab->lights ? made->object->front.specular : BLACK;
        if (of[SLOT_HIGHLIGHT_COLOR] >= HIGHLIGHT_ENERGY_2)
            specular[i] = vec3_scale(specular[i], energy(made));
        if (made->choices->factor == FACTOR_SPECULAR_VALUE)
            specular[i] = vec3_scale(made->light_color[i], made->choices->value);
        specular[i] = vec3_scale(specular[i], whole * factor(made, FACTOR_SPECULAR));
        if (of[SLOT_HIGHLIGHT_LIGHTS] == HIGHLIGHT_LIGHTS_FIRST + 1 - i)
            specular[i] = BLACK;
    }
    plus = vec3_add(plus, added ? front : (Vec3){color, color, color});
    set_vectors(program, U_u_Base,
                (const Vec3[]){vec3_scale(base[0], whole), vec3_scale(base[1], whole)}, 2);
    set_vectors(program, U_u_Limit, limits, 2);
    set_vectors(program, U_u_Plus, &plus, 1);
    set_int(program, U_u_LimitOf,
            made->choices->factor == FACTOR_LIMIT ? LIMIT_ALL : of[SLOT_LIMIT]);
    set_choice(program, U_u_LightsOf, made, SLOT_LIGHTS);
    set_vectors(program, U_u_Diffuse, diffuse, 4);
    set_vectors(program, U_u_Highlight, specular, 2);
    set_choice(program, U_u_Ambient, made, SLOT_AMBIENT);
}

/* The highlight. */

static void set_reflection(const WrongProgram *program, const Made *made)
{
    const int of = choice(made, SLOT_REFLECTION);
    const bool other = of == REFLECTION_OTHER || of == REFLECTION_OTHER_FITTED;
    const bool blinn_phong = (made->lab->reflection == REFLECTION_BLINN_PHONG) != other;
    const int reflection = !made->lab->specular               ? REFLECTION_NONE
                           : of != REFLECTION_RIGHT && !other ? of
                           : blinn_phong                      ? REFLECTION_AS_BLINN_PHONG
                                                              : REFLECTION_AS_PHONG;
    set_int(program, U_u_Reflection, reflection);
    set_float(program, U_u_Exponent,
              reflection == REFLECTION_NONE
                  ? 1
                  : value(made, FACTOR_EXPONENT_VALUE,
                          exponent(made, blinn_phong) * factor(made, FACTOR_EXPONENT) +
                              20 * value(made, FACTOR_PLUS_EXPONENT, 0)));
    set_choice(program, U_u_Gate, made, SLOT_GATE);
    set_choice(program, U_u_Power, made, SLOT_POWER);
}

static void set_view(const WrongProgram *program, const Made *made)
{
    const double *m = made->eye_from_world.m;
    const Vec3 eye = made->probe->scene.camera.eye;
    const Vec3 center = mat4_transform_point(made->world, (Vec3){0, 0, 0});
    const Vec3 views[] = {
        eye,
        [VIEW_WORLD_ORIGIN] = BLACK,
        [VIEW_EYE_SPACE] = BLACK,
        [VIEW_FIXED_EYE] = eye,
        [VIEW_FIXED_Z] = {0, 0, 1},
        [VIEW_FIXED_AXIS] = {m[2], m[6], m[10]},
        [VIEW_FIXED_CENTER] = vec3_subtract(eye, center),
        [VIEW_RAW] = eye,
        [VIEW_REVERSED] = vec3_scale(eye, -1),
        [VIEW_NEGATED_EYE] = vec3_scale(eye, -1),
        [VIEW_OBJECT_SPACE] = eye,
        [VIEW_NOT_TO_EYE] =
            vec3_add(eye, mat4_transform_direction(part(made->eye_from_world, PART_INVERSE), eye))};
    const int of = choice(made, SLOT_VIEW);
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
    const Light *light = &made->probe->lights[0];
    const int of = choice(made, SLOT_FADE), on = choice(made, SLOT_FADE_ON);
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
    l = value(made, FACTOR_FADE_LINEAR, l);
    q = value(made, FACTOR_FADE_SQUARE, q);
    c *= factor(made, FACTOR_CONSTANT);
    l *= factor(made, FACTOR_LINEAR);
    q *= factor(made, FACTOR_QUADRATIC);
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
    const Light *light = &made->probe->lights[0];
    const int of = choice(made, SLOT_CONE), on = choice(made, SLOT_CONE_ON);
    const bool spot = made->lab->light == LIGHT_SPOT;
    const double cutoff =
        value(made, FACTOR_CUTOFF_VALUE, (spot ? light->cutoff : 90) * factor(made, FACTOR_CUTOFF));
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
    const int fall_off = choice(made, SLOT_CONE_FALL_OFF);
    const double exponents[] = {spot ? value(made, FACTOR_SPOT_EXPONENT_VALUE,
                                             light->exponent * factor(made, FACTOR_SPOT_EXPONENT))
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
    const int sign = choice(made, SLOT_CONE_SIGN);
    if (sign == AXIS_TO_EYE)
        axis = mat4_transform_direction(made->eye_from_world, axis);
    if (sign == AXIS_NOT_TO_EYE)
        axis = mat4_transform_direction(mat4_transpose(made->eye_from_world), axis);
    if (sign == AXIS_REVERSED)
        axis = vec3_scale(axis, -1);
    if (sign == AXIS_W_1 || sign == AXIS_W_1_UNIT)
        axis = vec3_subtract(axis, made->probe->scene.camera.eye);
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
    const double powers[] = {factor(made, FACTOR_GAMMA), [OUTPUT_GAMMA] = 1 / 2.2,
                             [OUTPUT_ROOT] = 0.5, [OUTPUT_POWER] = 2.2, [OUTPUT_SQUARE] = 2};
    set_float(program, U_u_Most, value(made, FACTOR_RESULT, 1e9));
    set_choice(program, U_u_Discard, made, SLOT_CULL);
    set_float(program, U_u_Gamma, output <= OUTPUT_SQUARE ? powers[output] : 1);
    set_choice(program, U_u_Output, made, SLOT_OUTPUT);
}

/* The shadow map. */

static Mat4 map_matrix(const Made *made, const ProbeMap *map)
{
    switch (choice(made, SLOT_MAP_PLACE)) {
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

static void set_shadow(const WrongProgram *program, const Made *made, const ProbeMap *map)
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
                            : biases[choice(made, SLOT_MAP_BIAS)];
    const double slope = which == FACTOR_BIAS_SLOPE ? 10 * bias : 0;
    const bool clip = which == FACTOR_BIAS_CLIP;
    const int on = choice(made, SLOT_SHADOW_ON);
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
    set_float(program, U_u_MapLight, factor(made, FACTOR_MAP_LIGHT));
}

bool wrong_program_draw(const WrongProgram *program, const Lab *lab, const Probe *probe,
                        const ProbeBuffers *buffers, const Choices *choices)
{
    Made made = {.lab = lab, .probe = probe, .choices = choices, .of = choices->of};
    if (!scene_camera(&probe->scene.camera, (double)probe->width / probe->height,
                      &made.eye_from_world, &made.clip_from_eye, NULL))
        return false;
    glUseProgram(program->shader.program);
    glEnable(GL_DEPTH_TEST);
    if (buffers->cull)
        glEnable(GL_CULL_FACE);
    choose_light_colors(&made);
    set_fade(program, &made);
    for (int i = 0; i < probe->scene.object_count; i++) {
        const MeshBuffer *mesh = &buffers->buffers[i];
        made.object = &probe->objects[i];
        set_cone(program, &made);
        made.world = model_matrix(&made);
        choose_light_places(&made);
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
