/*
 * PointLightedCube_perFragment: the cube of PointLightedCube_animation, lit per fragment.
 *
 * New since PointLightedCube_animation: position and normal are interpolated instead of the colour,
 * and the fragment shader computes the light (Phong interpolation). An interpolated normal may be
 * shorter than 1, though none on a cube: it is normalized again.
 *
 * Look at how the light falls off on a face, equally in all directions: the diagonal between its
 * two triangles is no longer visible.
 */
#include "core/example.h"
#include "core/matrix.h"
#include "core/mesh_buffer.h"

/* Camera, in world coordinates; field of view in degrees, distances along the view. */
static const Vec3 EYE = {6, 6, 14}, CENTER = {0, 0, 0}, UP = {0, 1, 0};
static const double FOVY = 30, NEAR = 1, FAR = 100;

/* Point light, in world coordinates: the light direction differs at each point of the surface. */
static const Vec3 LIGHT_COLOR = {1, 1, 1};
static const Vec3 LIGHT_POSITION = {2.3, 4, 3.5};

/* Ambient light, so that surfaces away from the light are not black. */
static const Vec3 AMBIENT_LIGHT = {0.2, 0.2, 0.2};

/* A red cube of side 4. */
static const double HALF_SIDE = 2;
static const Vec3 CUBE_COLOR = {1, 0, 0};

/* Rotation about the y axis, in degrees per second. */
static const double TURN = 30;
static const Vec3 AXIS = {0, 1, 0};

static struct {
    Shader shader;
    MeshBuffer cube;
    GLint a_Position, a_Color, a_Normal;
    GLint u_MvpMatrix, u_ModelMatrix, u_NormalMatrix;
    GLint u_LightColor, u_LightPosition, u_AmbientLight;
} state;

static bool init(const ShaderLoader *loader, Message *message)
{
    const ShaderLocation locations[] = {
        {"a_Position", &state.a_Position},
        {"a_Color", &state.a_Color},
        {"a_Normal", &state.a_Normal},
        {"u_MvpMatrix", &state.u_MvpMatrix},
        {"u_ModelMatrix", &state.u_ModelMatrix},
        {"u_NormalMatrix", &state.u_NormalMatrix},
        {"u_LightColor", &state.u_LightColor},
        {"u_LightPosition", &state.u_LightPosition},
        {"u_AmbientLight", &state.u_AmbientLight},
        {NULL, NULL},
    };
    Mesh mesh;
    if (!shader_open(&state.shader, loader, "lecture/PointLightedCube_perFragment", message) ||
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
    shader_set_mat4(state.u_ModelMatrix, world_from_model);
    shader_set_mat4(state.u_NormalMatrix, normal_matrix);
    shader_set_vec3(state.u_LightColor, LIGHT_COLOR);
    shader_set_vec3(state.u_LightPosition, LIGHT_POSITION);
    shader_set_vec3(state.u_AmbientLight, AMBIENT_LIGHT);
    glDrawElements(GL_TRIANGLES, state.cube.index_count, state.cube.index_type, NULL);
}

static void finish(void)
{
    mesh_buffer_close(&state.cube);
    shader_close(&state.shader);
}

const Example PointLightedCube_perFragment = {
    .name = "PointLightedCube_perFragment",
    .summary = "a point light, per fragment",
    .tries = {"--angle 45", "--angle 80", "--angle 45 --orbit 60,20"},
    .looks = {"the edge next to the light is bright, unlike in PointLightedCube_animation",
              "the right face shows no diagonal",
              "from the side: the brightest place is within an edge"},
    .init = init,
    .draw = draw,
    .finish = finish,
};
