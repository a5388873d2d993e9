#include "wrong_program.h"

#include "options.h"

#include <math.h>
#include <string.h>

/* The uniforms, by number in `locations`. */
/* clang-format off */
#define UNIFORMS(X)                                                                               \
    X(u_Clip) X(u_Place) X(u_Normal) X(u_AtVertices) X(u_NormalUnit) X(u_Light) X(u_FromPlace)    \
    X(u_LightUnit) X(u_LightSign) X(u_Cosine) X(u_Base) X(u_AmbientMode) X(u_Diffuse)             \
    X(u_Highlight) X(u_Exponent) X(u_Reflection) X(u_Gate) X(u_Power) X(u_View) X(u_ViewPlace)    \
    X(u_ViewUnit) X(u_Fade) X(u_FadeMode) X(u_FadeOn) X(u_SpotAxis) X(u_SpotCosine)               \
    X(u_SpotExponent) X(u_SpotOutside) X(u_SpotOn) X(u_Facing) X(u_Mirrored) X(u_BackNormal)      \
    X(u_Discard) X(u_Lights) X(u_Gamma)
/* clang-format on */

#define NUMBER(name) U_##name,
enum { UNIFORMS(NUMBER) UNIFORM_COUNT };
#undef NUMBER
_Static_assert((int)UNIFORM_COUNT == (int)WRONG_PROGRAM_UNIFORMS, "a location for each");

#define NAME(name) #name,
static const char *const NAMES[UNIFORM_COUNT] = {UNIFORMS(NAME)};
#undef NAME

/* What a mistake leaves to the matrices and colours. */
typedef struct Made {
    const Lab *lab;
    const Probe *probe;
    const Object *object;
    const int *of;
    Mat4 world, eye_from_world, clip_from_eye;
    Vec3 light[LAB_MOST_LIGHTS], light_color[LAB_MOST_LIGHTS];
} Made;

bool wrong_program_open(WrongProgram *program, Message *message)
{
    const ShaderLoader loader = {.precision = "highp"};
    *program = (WrongProgram){.position = -1};
    if (!shader_open(&program->shader, &loader, "labs/catalogue", message))
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
    return true;
}

void probe_buffers_close(ProbeBuffers *buffers)
{
    if (!buffers)
        return;
    for (int i = 0; i < PROBE_MOST_OBJECTS; i++)
        mesh_buffer_close(&buffers->buffers[i]);
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

/* Places. */

static Mat4 part(Mat4 right, int choice)
{
    Mat4 inverse;
    if (choice == PART_MISSING)
        return mat4_identity();
    if (choice == PART_INVERSE) {
        mat4_inverse(right, &inverse);
        return inverse;
    }
    return right;
}

/* What lab 3's mistakes move, turn and scale by. */
static void world_parts(const Made *made, Mat4 *move, Mat4 *turn, Mat4 *scale)
{
    static const Vec3 AXES[] = {[AXIS_X] = {1, 0, 0}, [AXIS_Y] = {0, 1, 0}, [AXIS_Z] = {0, 0, 1}};
    const double degrees = OPTIONS_DEGREES_PER_SECOND * made->probe->seconds,
                 radian = 180 / acos(-1);
    const double angles[] = {degrees, [PART_MISSING] = 0, [TURN_RADIANS] = degrees / radian,
                             [TURN_DEGREES] = degrees * radian};
    const int *of = made->of;
    const double angle = angles[of[SLOT_TURN]];
    probe_world_parts(made->probe->seconds, move, turn, scale);
    *move = part(*move, of[SLOT_MOVE]);
    *scale = part(*scale, of[SLOT_SCALE]);
    mat4_rotate(of[SLOT_TURN_SIGN] ? -angle : angle,
                of[SLOT_AXIS] ? AXES[of[SLOT_AXIS]] : PROBE_AXIS, turn);
}

/* Where lab 3's mistakes put the cube; the other labs make none. */
static Mat4 model_matrix(const Made *made)
{
    Mat4 move, turn, scale, world;
    if (!made->lab->given)
        return made->object->world_from_object;
    world_parts(made, &move, &turn, &scale);
    switch (made->of[SLOT_ORDER]) {
    case ORDER_MOVED_FIRST:
        world = mat4_product(turn, mat4_product(move, scale));
        break;
    case ORDER_SCALED_LAST:
        world = mat4_product(move, mat4_product(scale, turn));
        break;
    case ORDER_REVERSED:
        world = mat4_product(scale, mat4_product(turn, move));
        break;
    default:
        world = mat4_product(move, mat4_product(turn, scale));
    }
    return made->of[SLOT_WORLD] == WORLD_TRANSPOSED ? mat4_transpose(world)
           : made->of[SLOT_WORLD] == WORLD_INVERSE  ? part(world, PART_INVERSE)
                                                    : world;
}

static Mat4 clip_matrix(const Made *made)
{
    const Mat4 eye_from_model = mat4_product(made->eye_from_world, made->world);
    Mat4 clip = mat4_product(made->clip_from_eye, eye_from_model);
    switch (made->of[SLOT_CLIP]) {
    case CLIP_UPSIDE_DOWN:
        return mat4_product(mat4_scale((Vec3){1, -1, 1}), clip);
    case CLIP_SWAPPED:
        return mat4_product(mat4_scale((Vec3){-1, 1, 1}), clip);
    case CLIP_ASPECT:
        return mat4_product(
            mat4_scale((Vec3){(double)made->probe->width / made->probe->height, 1, 1}), clip);
    case CLIP_TRANSPOSED:
        return mat4_transpose(clip);
    case CLIP_FLAT:
        return mat4_product(mat4_scale((Vec3){1, 1, 0}), clip);
    case CLIP_REVERSED:
        return mat4_product(mat4_scale((Vec3){1, 1, -1}), clip);
    case CLIP_NO_MODEL:
        return mat4_product(made->clip_from_eye, made->eye_from_world);
    default:
        return clip;
    }
}

static Mat4 without_translation(Mat4 matrix)
{
    matrix.m[12] = matrix.m[13] = matrix.m[14] = 0;
    return matrix;
}

static Mat4 place_matrix(const Made *made)
{
    switch (made->of[SLOT_PLACE]) {
    case PLACE_OBJECT:
        return mat4_identity();
    case PLACE_W_0:
        return without_translation(made->world);
    case PLACE_EYE:
        return mat4_product(made->eye_from_world, made->world);
    case PLACE_TRANSPOSED:
        return mat4_transpose(made->world);
    default:
        return made->world;
    }
}

/* Its last column is added to a normal. */
static Mat4 normal_matrix(const Made *made)
{
    Mat4 move, turn, scale;
    switch (made->of[SLOT_NORMAL]) {
    case NORMAL_OBJECT:
        return mat4_identity();
    case NORMAL_MODEL:
        return without_translation(made->world);
    case NORMAL_MODEL_W_1:
        return made->world;
    case NORMAL_INVERSE:
        return mat4_transpose(binding_normal_matrix(made->world));
    case NORMAL_TRANSPOSE:
        return mat4_transpose(made->world);
    case NORMAL_EYE:
        return binding_normal_matrix(mat4_product(made->eye_from_world, made->world));
    case NORMAL_TURN:
        world_parts(made, &move, &turn, &scale);
        return turn;
    case NORMAL_UNTURNED:
        world_parts(made, &move, &turn, &scale);
        return binding_normal_matrix(scale);
    default:
        return binding_normal_matrix(made->world);
    }
}

static void set_matrices(const WrongProgram *program, const Made *made)
{
    const GLint *at = program->locations;
    Mat4 normal = normal_matrix(made);
    if (made->of[SLOT_NORMAL_SIGN])
        normal = mat4_product(mat4_scale((Vec3){-1, -1, -1}), normal);
    shader_set_mat4(at[U_u_Clip], clip_matrix(made));
    shader_set_mat4(at[U_u_Place], place_matrix(made));
    shader_set_mat4(at[U_u_Normal], normal);
}

/* Lights. */

static Vec3 product(Vec3 a, Vec3 b)
{
    return (Vec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

static const Vec3 WHITE = {1, 1, 1}, BLACK = {0, 0, 0};

/* The colours that the lights have, by the mistake. */
static void choose_light_colors(Made *made)
{
    for (int i = 0; i < LAB_MOST_LIGHTS; i++) {
        Vec3 *color = &made->light_color[i];
        *color = i < made->lab->lights ? made->probe->lights[i].diffuse : BLACK;
        if (i < made->lab->lights && made->of[SLOT_LIGHT_COLOR] == LIGHT_COLOR_IGNORED)
            *color = WHITE;
        if (made->of[SLOT_LIGHT_COLOR] == LIGHT_COLOR_SQUARED)
            *color = product(*color, *color);
        if (made->of[SLOT_LIGHTS] == LIGHTS_MEAN)
            *color = vec3_scale(*color, 1.0 / made->lab->lights);
        if ((made->of[SLOT_LIGHTS] == LIGHTS_FIRST && i == 1) ||
            (made->of[SLOT_LIGHTS] == LIGHTS_SECOND && i == 0))
            *color = BLACK;
    }
}

static void choose_light_places(Made *made)
{
    const Vec3 center = mat4_transform_point(made->world, (Vec3){0, 0, 0});
    const bool directional = made->lab->light == LIGHT_DIRECTIONAL;
    for (int i = 0; i < LAB_MOST_LIGHTS; i++) {
        const Light *light = &made->probe->lights[i < made->lab->lights ? i : 0];
        Vec3 *place = &made->light[i];
        *place = directional ? light->direction : light->position;
        if (directional)
            vec3_normalize(*place, place);
        if (made->of[SLOT_LIGHT_SPACE] == LIGHT_SPACE_EYE)
            *place = directional ? mat4_transform_direction(made->eye_from_world, *place)
                                 : mat4_transform_point(made->eye_from_world, *place);
        if (made->of[SLOT_LIGHT] == LIGHT_FROM_CENTER)
            *place = vec3_subtract(*place, center);
    }
}

static void set_lights(const WrongProgram *program, const Made *made)
{
    const int *of = made->of;
    const bool directional = made->lab->light == LIGHT_DIRECTIONAL;
    set_vectors(program, U_u_Light, made->light, LAB_MOST_LIGHTS);
    set_float(program, U_u_FromPlace, directional || of[SLOT_LIGHT] ? 0 : 1);
    set_int(program, U_u_LightUnit,
            of[SLOT_LIGHT_UNIT] == UNIT_NEVER         ? 0
            : of[SLOT_LIGHT_UNIT] == UNIT_AT_VERTICES ? 2
                                                      : 1);
    set_int(program, U_u_Lights, made->lab->lights);
    set_float(program, U_u_LightSign, of[SLOT_LIGHT_SIGN] ? -1 : 1);
    set_int(program, U_u_Cosine, of[SLOT_COSINE]);
}

/* Colours. */

static Vec3 surface_color(const Made *made, Vec3 color)
{
    if (made->of[SLOT_COLOR] == COLOR_SQUARED)
        return product(color, color);
    return made->of[SLOT_COLOR] == COLOR_IGNORED ? WHITE : color;
}

static Vec3 base_color(const Made *made, Vec3 surface)
{
    const Vec3 ambient = made->probe->scene.global_ambient;
    Vec3 base = product(ambient, surface);
    switch (made->of[SLOT_AMBIENT]) {
    case AMBIENT_MISSING:
        return BLACK;
    case AMBIENT_PER_LIGHT: {
        /* As often as there are lights that are summed. */
        const int of = made->of[SLOT_LIGHTS];
        return vec3_scale(base, of == LIGHTS_FIRST || of == LIGHTS_SECOND ? 1 : made->lab->lights);
    }
    case AMBIENT_PLAIN:
        return ambient;
    case AMBIENT_LIGHT_COLOR:
        return product(base, vec3_add(made->light_color[0], made->light_color[1]));
    default:
        return base;
    }
}

static void set_colors(const WrongProgram *program, const Made *made)
{
    const int *of = made->of;
    const bool front_only = of[SLOT_BACK] == BACK_FRONT_COLOR || !made->lab->two_sided;
    const Vec3 front = surface_color(made, made->object->front.diffuse);
    const Vec3 back = front_only ? front : surface_color(made, made->object->back.diffuse);
    const Vec3 base[2] = {base_color(made, front), base_color(made, back)};
    Vec3 diffuse[4], specular[2];
    for (int i = 0; i < 2; i++) {
        diffuse[i] = product(front, made->light_color[i]);
        diffuse[2 + i] = product(back, made->light_color[i]);
        specular[i] = product(made->object->front.specular, made->light_color[i]);
        if (of[SLOT_HIGHLIGHT_COLOR] == HIGHLIGHT_TINTED)
            specular[i] = product(specular[i], front);
        if (of[SLOT_HIGHLIGHT_COLOR] == HIGHLIGHT_WHITE)
            specular[i] = made->light_color[i];
        if (of[SLOT_HIGHLIGHT_COLOR] == HIGHLIGHT_WHITE_LIGHT)
            specular[i] = i < made->lab->lights ? made->object->front.specular : BLACK;
    }
    set_vectors(program, U_u_Base, base, 2);
    set_vectors(program, U_u_Diffuse, diffuse, 4);
    set_vectors(program, U_u_Highlight, specular, 2);
    set_int(program, U_u_AmbientMode,
            of[SLOT_AMBIENT] == AMBIENT_COSINE   ? 1
            : of[SLOT_AMBIENT] == AMBIENT_LARGER ? 2
                                                 : 0);
}

/* The highlight. */

static double exponent(const Made *made, bool blinn_phong)
{
    const double shininess = made->object->front.shininess;
    const double fitted = made->probe->fitted[made->object - made->probe->objects];
    switch (made->of[SLOT_EXPONENT]) {
    case EXPONENT_PLAIN:
        return shininess;
    case EXPONENT_ONE:
        return 1;
    case EXPONENT_QUARTER:
        return shininess / 4;
    default:
        break;
    }
    if (made->of[SLOT_REFLECTION] == REFLECTION_OTHER_FITTED)
        return blinn_phong ? 4 * shininess : shininess;
    /* Half way between the two that are right: 1 step from either. */
    if (made->of[SLOT_FIT] == FIT_FOUR)
        return 4 * shininess;
    if (made->of[SLOT_FIT] == FIT_LEAST)
        return fitted;
    return made->lab->fitted ? (4 * shininess + fitted) / 2 : shininess;
}

static void set_reflection(const WrongProgram *program, const Made *made)
{
    const int of = made->of[SLOT_REFLECTION];
    const bool other = of == REFLECTION_OTHER || of == REFLECTION_OTHER_FITTED;
    const bool blinn_phong = (made->lab->reflection == REFLECTION_BLINN_PHONG) != other;
    int reflection = blinn_phong ? 2 : 1;
    if (of == REFLECTION_SIGN)
        reflection = 3;
    if (of == REFLECTION_HALF_RAW)
        reflection = 4;
    if (!made->lab->specular || of == REFLECTION_NONE)
        reflection = 0;
    set_int(program, U_u_Reflection, reflection);
    set_float(program, U_u_Exponent, reflection ? exponent(made, blinn_phong) : 1);
    set_int(program, U_u_Gate, made->of[SLOT_GATE]);
    set_int(program, U_u_Power, made->of[SLOT_POWER]);
}

static void set_view(const WrongProgram *program, const Made *made)
{
    const double *m = made->eye_from_world.m;
    const Mat4 none = {{0}};
    Vec3 view = made->probe->scene.camera.eye;
    Mat4 place = mat4_identity();
    switch (made->of[SLOT_VIEW]) {
    case VIEW_WORLD_ORIGIN:
        view = BLACK;
        break;
    case VIEW_EYE_SPACE:
        view = BLACK;
        place = made->eye_from_world;
        break;
    case VIEW_FIXED_EYE:
        place = none;
        break;
    case VIEW_FIXED_CENTER:
        view = vec3_subtract(view, mat4_transform_point(made->world, (Vec3){0, 0, 0}));
        place = none;
        break;
    case VIEW_FIXED_Z:
        view = (Vec3){0, 0, 1};
        place = none;
        break;
    case VIEW_FIXED_AXIS:
        view = (Vec3){m[2], m[6], m[10]};
        place = none;
        break;
    default:
        break;
    }
    shader_set_vec3(program->locations[U_u_View], view);
    shader_set_mat4(program->locations[U_u_ViewPlace], place);
    set_int(program, U_u_ViewUnit, made->of[SLOT_VIEW] == VIEW_RAW ? 0 : 1);
}

/* The spot. */

static void set_fade(const WrongProgram *program, const Made *made)
{
    const Light *light = &made->probe->lights[0];
    const int of = made->of[SLOT_FADE], on = made->of[SLOT_FADE_ON];
    double c = light->constant, l = light->linear, q = light->quadratic;
    if (made->lab->light != LIGHT_SPOT || of == FADE_MISSING)
        c = 1, l = q = 0;
    if (of == FADE_SWAPPED)
        l = light->quadratic, q = light->linear;
    if (of == FADE_NO_LINEAR)
        l = 0;
    if (of == FADE_NO_QUADRATIC)
        q = 0;
    if (of == FADE_NO_CONSTANT)
        c = 0;
    if (of == FADE_UNIT)
        c += l + q, l = q = 0;
    if (of == FADE_INVERSE_SQUARE)
        c = l = 0, q = 1;
    set_vec3(program, U_u_Fade, c, l, q);
    set_int(program, U_u_FadeMode, of == FADE_INVERTED ? 1 : of == FADE_SQUARED ? 2 : 0);
    set_vec3(program, U_u_FadeOn, 1, on != ON_NO_HIGHLIGHT, on == ON_AMBIENT);
}

static void set_cone(const WrongProgram *program, const Made *made)
{
    const Light *light = &made->probe->lights[0];
    const int of = made->of[SLOT_CONE], on = made->of[SLOT_CONE_ON];
    const bool spot = made->lab->light == LIGHT_SPOT;
    const double cutoff = spot ? light->cutoff : 90, radians = cutoff * acos(-1) / 180;
    double cosine = cos(radians), fall_off = spot ? light->exponent : 0;
    Vec3 axis = {0, 0, 1};
    if (of == CONE_DEGREES)
        cosine = cos(cutoff);
    if (of == CONE_ANGLE)
        cosine = radians;
    if (of == CONE_ANGLE_DEGREES)
        cosine = cutoff;
    if (of == CONE_NONE)
        cosine = -1e30;
    if (of == CONE_WHOLE)
        cosine = cos(radians / 2);
    if (made->of[SLOT_CONE_FALL_OFF])
        fall_off = made->of[SLOT_CONE_FALL_OFF] == FALL_OFF_ONE ? 1 : 0;
    if (spot)
        vec3_normalize(light->direction, &axis);
    if (made->of[SLOT_CONE_SIGN])
        axis = vec3_scale(axis, -1);
    shader_set_vec3(program->locations[U_u_SpotAxis], axis);
    set_float(program, U_u_SpotCosine, cosine);
    set_float(program, U_u_SpotExponent, fall_off);
    set_int(program, U_u_SpotOutside, of == CONE_OUTSIDE);
    set_vec3(program, U_u_SpotOn, spot, spot && on != ON_NO_HIGHLIGHT, spot && on == ON_AMBIENT);
}

static void set_rest(const WrongProgram *program, const Made *made)
{
    const int *of = made->of;
    const bool vertices =
        of[SLOT_STAGE] == STAGE_VERTICES || (of[SLOT_STAGE] == STAGE_OTHER && made->lab->either);
    set_int(program, U_u_AtVertices, vertices || made->lab->given);
    set_int(program, U_u_NormalUnit,
            of[SLOT_NORMAL_UNIT] == UNIT_NEVER         ? 0
            : of[SLOT_NORMAL_UNIT] == UNIT_AT_VERTICES ? 1
            : of[SLOT_NORMAL_UNIT] == UNIT_AT_BOTH     ? 3
                                                       : 2);
    set_int(program, U_u_Facing,
            !made->lab->two_sided || of[SLOT_FACING] == FACING_NONE ? 0
            : of[SLOT_FACING] == FACING_UNMIRRORED                  ? 2
            : of[SLOT_FACING] == FACING_SWAPPED                     ? 3
            : of[SLOT_FACING] == FACING_LIGHT                       ? 4
                                                                    : 1);
    set_float(program, U_u_Mirrored, mat4_determinant(made->world) < 0 ? -1 : 1);
    set_int(program, U_u_BackNormal, of[SLOT_BACK] != BACK_NOT_REVERSED);
    set_int(program, U_u_Discard, of[SLOT_CULL] == CULL_FRONT);
    set_float(program, U_u_Gamma, of[SLOT_OUTPUT] == OUTPUT_GAMMA ? 1 / 2.2 : 1);
}

bool wrong_program_draw(const WrongProgram *program, const Lab *lab, const Probe *probe,
                        const ProbeBuffers *buffers, const Choices *choices)
{
    Made made = {.lab = lab, .probe = probe, .of = choices->of};
    if (!scene_camera(&probe->scene.camera, (double)probe->width / probe->height,
                      &made.eye_from_world, &made.clip_from_eye, NULL))
        return false;
    glUseProgram(program->shader.program);
    glEnable(GL_DEPTH_TEST);
    if (buffers->cull)
        glEnable(GL_CULL_FACE);
    choose_light_colors(&made);
    set_fade(program, &made);
    set_cone(program, &made);
    for (int i = 0; i < probe->scene.object_count; i++) {
        const MeshBuffer *mesh = &buffers->buffers[i];
        made.object = &probe->objects[i];
        made.world = model_matrix(&made);
        choose_light_places(&made);
        set_view(program, &made);
        set_matrices(program, &made);
        set_lights(program, &made);
        set_colors(program, &made);
        set_reflection(program, &made);
        set_rest(program, &made);
        mesh_buffer_bind(mesh, program->position, program->normal);
        glDrawElements(GL_TRIANGLES, mesh->index_count, mesh->index_type, NULL);
    }
    glDisable(GL_CULL_FACE);
    return true;
}
