/*
 * LightedTranslatedRotatedCube: the cube of LightedCube_ambient, turned and moved.
 *
 * New: a model matrix, and the normal matrix that belongs to it: the inverse transpose. It is
 * found in world coordinates, for that is where the light is computed here.
 *
 * Look at which faces are light: the ones that face the light now, not those that did so before
 * the cube was turned.
 */
#include "example.h"
#include "matrix.h"
#include "mesh_buffer.h"

/* The camera, in world coordinates, and its lens: degrees, and distances along the view. */
static const Vec3 EYE = {3, 3, 7}, CENTER = {0, 0, 0}, UP = {0, 1, 0};
static const double FOVY = 30, NEAR = 1, FAR = 100;

/* A directional light: its rays are parallel. The direction, in the world, leads towards it. */
static const Vec3 LIGHT_COLOR = {1, 1, 1};
static const Vec3 LIGHT_DIRECTION = {0.5, 3, 4}; /* made unit below */

/* Light from everywhere, so that what no light reaches is not black. */
static const Vec3 AMBIENT_LIGHT = {0.2, 0.2, 0.2};

/* The object: a red cube, 2 wide. */
static const double HALF_SIDE = 1;
static const float CUBE_COLOR[3] = {1, 0, 0};

/* The model is turned about the z axis, by so many degrees, then moved up. */
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
    Mesh mesh;
    if (!shader_open(&state.shader, loader, "lecture/LightedTranslatedRotatedCube", message) ||
        !shader_attribute(&state.shader, "a_Position", &state.a_Position, message) ||
        !shader_attribute(&state.shader, "a_Color", &state.a_Color, message) ||
        !shader_attribute(&state.shader, "a_Normal", &state.a_Normal, message) ||
        !shader_uniform(&state.shader, "u_MvpMatrix", &state.u_MvpMatrix, message) ||
        !shader_uniform(&state.shader, "u_NormalMatrix", &state.u_NormalMatrix, message) ||
        !shader_uniform(&state.shader, "u_LightColor", &state.u_LightColor, message) ||
        !shader_uniform(&state.shader, "u_LightDirection", &state.u_LightDirection, message) ||
        !shader_uniform(&state.shader, "u_AmbientLight", &state.u_AmbientLight, message))
        return false;

    if (!mesh_cube(&mesh, HALF_SIDE, message))
        return false;
    const bool uploaded = mesh_buffer_open(&state.cube, &mesh, message);
    mesh_close(&mesh);
    if (!uploaded)
        return false;

    /* Position and normal come from the buffer, one for each vertex; the colour is one for all. */
    mesh_buffer_bind(&state.cube, state.a_Position, state.a_Normal);
    glVertexAttrib3fv((GLuint)state.a_Color, CUBE_COLOR);
    glEnable(GL_DEPTH_TEST);
    return true;
}

static bool draw(const Frame *frame)
{
    Mat4 clip_from_eye, eye_from_world, rotation;
    Mat4 normal_matrix;
    Vec3 light_direction;
    if (!mat4_perspective(FOVY, frame->aspect, NEAR, FAR, &clip_from_eye) ||
        !frame_look_at(frame, EYE, CENTER, UP, &eye_from_world) ||
        !mat4_rotate(TURN, AXIS, &rotation) || !vec3_normalize(LIGHT_DIRECTION, &light_direction))
        return false;
    const Mat4 world_from_model = mat4_product(mat4_translate(MOVE), rotation);
    const Mat4 clip_from_world = mat4_product(clip_from_eye, eye_from_world);
    const Mat4 clip_from_model = mat4_product(clip_from_world, world_from_model);
    /* The inverse transpose of the model matrix keeps normals perpendicular to the surface. */
    if (!mat4_normal(world_from_model, &normal_matrix))
        return false;

    glUseProgram(state.shader.program);
    shader_set_mat4(state.u_MvpMatrix, clip_from_model);
    shader_set_mat4(state.u_NormalMatrix, normal_matrix);
    shader_set_vec3(state.u_LightColor, LIGHT_COLOR);
    shader_set_vec3(state.u_LightDirection, light_direction);
    shader_set_vec3(state.u_AmbientLight, AMBIENT_LIGHT);
    glDrawElements(GL_TRIANGLES, state.cube.index_count, state.cube.index_type, NULL);
    return true;
}

static void finish(void)
{
    mesh_buffer_close(&state.cube);
    shader_close(&state.shader);
}

const Example LightedTranslatedRotatedCube = {
    .name = "LightedTranslatedRotatedCube",
    .summary = "a transformed cube, and the normal matrix that this needs",
    .init = init,
    .draw = draw,
    .finish = finish,
};
