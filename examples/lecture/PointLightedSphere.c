/*
 * PointLightedSphere: a sphere in the light of a point, lit at its vertices.
 *
 * New since PointLightedCube: a curved surface. A vertex of a unit sphere has its position for its
 * normal, and one normal is enough, for there are no edges.
 *
 * Look at the border of light and shade: it follows the edges of the 13 by 13 mesh.
 */
#include "example.h"
#include "matrix.h"
#include "mesh_buffer.h"

/* The camera, in world coordinates, and its lens: degrees, and distances along the view. */
static const Vec3 EYE = {0, 0, 6}, CENTER = {0, 0, 0}, UP = {0, 1, 0};
static const double FOVY = 30, NEAR = 1, FAR = 100;

/* A point light: its rays leave one place in the world, so their direction differs everywhere. */
static const Vec3 LIGHT_COLOR = {0.8, 0.8, 0.8};
static const Vec3 LIGHT_POSITION = {5, 8, 7};

/* Light from everywhere, so that what no light reaches is not black. */
static const Vec3 AMBIENT_LIGHT = {0.2, 0.2, 0.2};

/* The object: a white unit sphere, cut into 13 slices and 13 stacks. */
static const int DIVISIONS = 13;
static const float SPHERE_COLOR[3] = {1, 1, 1};

/* The model stays where it is. */
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
    Mesh mesh;
    if (!shader_open(&state.shader, loader, "lecture/PointLightedSphere", message) ||
        !shader_attribute(&state.shader, "a_Position", &state.a_Position, message) ||
        !shader_attribute(&state.shader, "a_Color", &state.a_Color, message) ||
        !shader_attribute(&state.shader, "a_Normal", &state.a_Normal, message) ||
        !shader_uniform(&state.shader, "u_MvpMatrix", &state.u_MvpMatrix, message) ||
        !shader_uniform(&state.shader, "u_ModelMatrix", &state.u_ModelMatrix, message) ||
        !shader_uniform(&state.shader, "u_NormalMatrix", &state.u_NormalMatrix, message) ||
        !shader_uniform(&state.shader, "u_LightColor", &state.u_LightColor, message) ||
        !shader_uniform(&state.shader, "u_LightPosition", &state.u_LightPosition, message) ||
        !shader_uniform(&state.shader, "u_AmbientLight", &state.u_AmbientLight, message))
        return false;

    if (!mesh_sphere(&mesh, 1, DIVISIONS, DIVISIONS, message))
        return false;
    const bool uploaded = mesh_buffer_open(&state.sphere, &mesh, message);
    mesh_close(&mesh);
    if (!uploaded)
        return false;

    /* Position and normal come from the buffer, one for each vertex; the colour is one for all. */
    mesh_buffer_bind(&state.sphere, state.a_Position, state.a_Normal);
    glVertexAttrib3fv((GLuint)state.a_Color, SPHERE_COLOR);
    glEnable(GL_DEPTH_TEST);
    return true;
}

static bool draw(const Frame *frame)
{
    Mat4 clip_from_eye, eye_from_world, world_from_model;
    Mat4 normal_matrix;
    if (!mat4_perspective(FOVY, frame->aspect, NEAR, FAR, &clip_from_eye) ||
        !frame_look_at(frame, EYE, CENTER, UP, &eye_from_world) ||
        !mat4_rotate(TURN, AXIS, &world_from_model))
        return false;
    const Mat4 clip_from_world = mat4_product(clip_from_eye, eye_from_world);
    const Mat4 clip_from_model = mat4_product(clip_from_world, world_from_model);
    /* The inverse transpose of the model matrix keeps normals perpendicular to the surface. */
    if (!mat4_normal(world_from_model, &normal_matrix))
        return false;

    glUseProgram(state.shader.program);
    shader_set_mat4(state.u_MvpMatrix, clip_from_model);
    shader_set_mat4(state.u_ModelMatrix, world_from_model);
    shader_set_mat4(state.u_NormalMatrix, normal_matrix);
    shader_set_vec3(state.u_LightColor, LIGHT_COLOR);
    shader_set_vec3(state.u_LightPosition, LIGHT_POSITION);
    shader_set_vec3(state.u_AmbientLight, AMBIENT_LIGHT);
    glDrawElements(GL_TRIANGLES, state.sphere.index_count, state.sphere.index_type, NULL);
    return true;
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
