/*
 * PointLightedSphere: a sphere lit by a point light, per vertex.
 *
 * New since PointLightedCube: a curved surface. On a unit sphere the normal equals the position,
 * and one normal per vertex is enough because there are no edges. Camera and light have other
 * places, and the light is less bright.
 *
 * Look at the border between light and shade: it follows the edges of the 13 by 13 mesh.
 */
#include "core/example.h"
#include "core/matrix.h"
#include "core/mesh_buffer.h"

/* Camera, in world coordinates; field of view in degrees, distances along the view. */
static const Vec3 EYE = {0, 0, 6}, CENTER = {0, 0, 0}, UP = {0, 1, 0};
static const double FOVY = 30, NEAR = 1, FAR = 100;

/* Point light, in world coordinates: the light direction differs at each point of the surface. */
static const Vec3 LIGHT_COLOR = {0.8, 0.8, 0.8};
static const Vec3 LIGHT_POSITION = {5, 8, 7};

/* Ambient light, so that surfaces away from the light are not black. */
static const Vec3 AMBIENT_LIGHT = {0.2, 0.2, 0.2};

/* A white unit sphere of 13 slices and 13 stacks. */
static const int DIVISIONS = 13;
static const Vec3 SPHERE_COLOR = {1, 1, 1};

/* Rotation about the y axis, in degrees: none. */
static const double TURN = 0;
static const Vec3 AXIS = {0, 1, 0};

static struct {
    Shader shader;
    MeshBuffer sphere;
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
    if (!shader_open(&state.shader, loader, "lecture/PointLightedSphere", message) ||
        !shader_locations(&state.shader, locations, message) ||
        !mesh_sphere(&mesh, 1, DIVISIONS, DIVISIONS, message))
        return false;
    const bool uploaded = mesh_buffer_open(&state.sphere, &mesh, message);
    mesh_close(&mesh);
    if (!uploaded)
        return false;

    /* Position and normal are per vertex, from the buffer; the colour is the same for all. */
    mesh_buffer_bind(&state.sphere, state.a_Position, state.a_Normal);
    shader_set_attribute(state.a_Color, SPHERE_COLOR);
    glEnable(GL_DEPTH_TEST);
    return true;
}

static void draw(const Frame *frame)
{
    const Mat4 clip_from_eye = mat4_perspective(FOVY, frame->aspect, NEAR, FAR);
    /* mat4_look_at, with the eye moved as --orbit or the mouse says. */
    const Mat4 eye_from_world = frame_look_at(frame, EYE, CENTER, UP);
    const Mat4 world_from_model = mat4_rotate(TURN, AXIS);
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
    glDrawElements(GL_TRIANGLES, state.sphere.index_count, state.sphere.index_type, NULL);
}

static void finish(void)
{
    mesh_buffer_close(&state.sphere);
    shader_close(&state.shader);
}

const Example PointLightedSphere = {
    .name = "PointLightedSphere",
    .summary = "a sphere, lit per vertex: the mesh shows",
    .init = init,
    .draw = draw,
    .finish = finish,
};
