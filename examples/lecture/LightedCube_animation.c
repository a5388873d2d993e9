/*
 * LightedCube_animation: the cube of LightedCube turns.
 *
 * New since LightedCube: a model matrix, computed for each frame, and with it the normal matrix.
 * The light is fixed in world coordinates, so the normals are transformed to world coordinates as
 * well.
 *
 * Look at the faces that turn away from the light: they are completely black.
 */
#include "core/example.h"
#include "core/matrix.h"
#include "core/mesh_buffer.h"

/* Camera, in world coordinates; field of view in degrees, distances along the view. */
static const Vec3 EYE = {3, 3, 7}, CENTER = {0, 0, 0}, UP = {0, 1, 0};
static const double FOVY = 30, NEAR = 1, FAR = 100;

/* Directional light: parallel rays. The direction points to the light, in world coordinates. */
static const Vec3 LIGHT_COLOR = {1, 1, 1};
static const Vec3 LIGHT_DIRECTION = {0.5, 3, 4}; /* normalized in draw */

/* A red cube of side 2. */
static const double HALF_SIDE = 1;
static const Vec3 CUBE_COLOR = {1, 0, 0};

/* Rotation about the y axis, in degrees per second. */
static const double TURN = 30;
static const Vec3 AXIS = {0, 1, 0};

static struct {
    Shader shader;
    MeshBuffer cube;
    GLint a_Position, a_Color, a_Normal;
    GLint u_MvpMatrix, u_NormalMatrix;
    GLint u_LightColor, u_LightDirection;
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
        {NULL, NULL},
    };
    Mesh mesh;
    if (!shader_open(&state.shader, loader, "lecture/LightedCube_animation", message) ||
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
    const Mat4 world_from_model = mat4_rotate(TURN * frame->seconds, AXIS);
    const Mat4 clip_from_world = mat4_product(clip_from_eye, eye_from_world);
    const Mat4 clip_from_model = mat4_product(clip_from_world, world_from_model);
    /* The inverse transpose of the model matrix keeps normals perpendicular to the surface. */
    const Mat4 normal_matrix = mat4_normal(world_from_model);

    glUseProgram(state.shader.program);
    shader_set_mat4(state.u_MvpMatrix, clip_from_model);
    shader_set_mat4(state.u_NormalMatrix, normal_matrix);
    shader_set_vec3(state.u_LightColor, LIGHT_COLOR);
    shader_set_vec3(state.u_LightDirection, vec3_unit(LIGHT_DIRECTION));
    glDrawElements(GL_TRIANGLES, state.cube.index_count, state.cube.index_type, NULL);
}

static void finish(void)
{
    mesh_buffer_close(&state.cube);
    shader_close(&state.shader);
}

const Example LightedCube_animation = {
    .name = "LightedCube_animation",
    .summary = "LightedCube turning: a model matrix, and normals that follow it",
    .tries = {"--angle 45", "--angle 200", "--angle 45 --orbit 180,0"},
    .looks = {"each face has one colour, which its angle decides",
              "another face has turned to the light",
              "from behind only the top is lit: there is no ambient light"},
    .init = init,
    .draw = draw,
    .finish = finish,
};
