/*
 * LightedTranslatedRotatedCube: the cube of LightedCube_ambient, turned and moved.
 *
 * New since LightedCube_ambient: a model matrix, and its normal matrix: the inverse transpose.
 * Normals go to world coordinates, because lighting is computed there. This model only turns and
 * moves, so that its normal matrix is its rotation; NormalMatrix shows a model that is scaled. The
 * light's direction no longer has an x component.
 *
 * Look at which faces are bright: those that face the light now, not those that faced it before the
 * rotation.
 */
#include "core/example.h"
#include "core/matrix.h"
#include "core/mesh_buffer.h"

/* Camera, in world coordinates; field of view in degrees, distances along the view. */
static const Vec3 EYE = {3, 3, 7}, CENTER = {0, 0, 0}, UP = {0, 1, 0};
static const double FOVY = 30, NEAR = 1, FAR = 100;

/* Directional light: parallel rays. The direction points to the light, in world coordinates. */
static const Vec3 LIGHT_COLOR = {1, 1, 1};
static const Vec3 LIGHT_DIRECTION = {0, 3, 4}; /* normalized in draw */

/* Ambient light, so that surfaces away from the light are not black. */
static const Vec3 AMBIENT_LIGHT = {0.2, 0.2, 0.2};

/* A red cube of side 2. */
static const double HALF_SIDE = 1;
static const Vec3 CUBE_COLOR = {1, 0, 0};

/* Rotation about the z axis, in degrees, then a translation upwards. */
static const double TURN = 90;
static const Vec3 AXIS = {0, 0, 1};
static const Vec3 MOVE = {0, 0.9, 0};

static struct {
    Shader shader;
    MeshBuffer cube;
    GLint a_Position, a_Color, a_Normal;
    GLint u_MvpMatrix, u_NormalMatrix;
    GLint u_LightColor, u_LightDirection, u_AmbientLight;
} state;

static bool init(const ShaderLoader *loader, Message *message)
{
    const ShaderLocation locations[] = {
        {"a_Position", &state.a_Position},
        {"a_Color", &state.a_Color},
        {"a_Normal", &state.a_Normal},
        {"u_MvpMatrix", &state.u_MvpMatrix},
        {"u_NormalMatrix", &state.u_NormalMatrix},
        {"u_LightColor", &state.u_LightColor},
        {"u_LightDirection", &state.u_LightDirection},
        {"u_AmbientLight", &state.u_AmbientLight},
        {NULL, NULL},
    };
    Mesh mesh;
    if (!shader_open(&state.shader, loader, "lecture/LightedTranslatedRotatedCube", message) ||
        !shader_locations(&state.shader, locations, message) ||
        !mesh_cube(&mesh, HALF_SIDE, message))
        return false;
    const bool uploaded = mesh_buffer_open(&state.cube, &mesh, message);
    mesh_close(&mesh);
    if (!uploaded)
        return false;

    /* Position and normal are per vertex, from the buffer; the colour is the same for all. */
    mesh_buffer_bind(&state.cube, state.a_Position, state.a_Normal);
    shader_set_attribute(state.a_Color, CUBE_COLOR);
    glEnable(GL_DEPTH_TEST);
    return true;
}

static void draw(const Frame *frame)
{
    const Mat4 clip_from_eye = mat4_perspective(FOVY, frame->aspect, NEAR, FAR);
    /* mat4_look_at, with the eye moved as --orbit or the mouse says. */
    const Mat4 eye_from_world = frame_look_at(frame, EYE, CENTER, UP);
    const Mat4 rotation = mat4_rotate(TURN, AXIS);
    const Mat4 world_from_model = mat4_product(mat4_translate(MOVE), rotation);
    const Mat4 clip_from_world = mat4_product(clip_from_eye, eye_from_world);
    const Mat4 clip_from_model = mat4_product(clip_from_world, world_from_model);
    /* The inverse transpose of the model matrix keeps normals perpendicular to the surface. */
    const Mat4 normal_matrix = mat4_normal(world_from_model);

    glUseProgram(state.shader.program);
    shader_set_mat4(state.u_MvpMatrix, clip_from_model);
    shader_set_mat4(state.u_NormalMatrix, normal_matrix);
    shader_set_vec3(state.u_LightColor, LIGHT_COLOR);
    shader_set_vec3(state.u_LightDirection, vec3_unit(LIGHT_DIRECTION));
    shader_set_vec3(state.u_AmbientLight, AMBIENT_LIGHT);
    glDrawElements(GL_TRIANGLES, state.cube.index_count, state.cube.index_type, NULL);
}

static void finish(void)
{
    mesh_buffer_close(&state.cube);
    shader_close(&state.shader);
}

const Example LightedTranslatedRotatedCube = {
    .name = "LightedTranslatedRotatedCube",
    .summary = "a turned and moved cube; its normal matrix, which here is the rotation itself",
    .init = init,
    .draw = draw,
    .finish = finish,
};
