/*
 * lab_program: shows a lab's usual scene with a student's shaders, by default the starter's.
 * Compiled once for each lab, with LAB as its number.
 *
 * To do a lab, copy its folder, edit the copy, and watch the picture:
 *   examples/run lab05_per_fragment --shaders mine --watch
 */
#include "app/run.h"
#include "core/example.h"
#include "labs/program/binding.h"
#include "labs/program/lab_scene_open.h"
#include "scene/scene_example.h"

#if LAB == 3 || LAB == 10
#include "labs/program/lab_code.h"
#endif

static struct {
    const Lab *lab;
    Shader shader;
} state;

static bool init(const ShaderLoader *loader, Message *message)
{
    char folder[PATH_MAX];
    ShaderLoader own = *loader;
    state.lab = &LABS[LAB - 1];
    if (!own.folder) {
        if (!lab_folder(state.lab, folder, message))
            return false;
        own.folder = folder;
    }
    return shader_open(&state.shader, &own, state.lab->file, message) &&
           binding_check(state.lab, &state.shader, message);
}

/* Lab 3: the matrices from the student's C; lab 10: the sphere. */
static bool choose(LabScene *lab_scene, Drawn *drawn, double seconds, Message *message)
{
    (void)lab_scene, (void)drawn, (void)seconds, (void)message;
#if LAB == 3
    static Mat4 world_from_model, normal_matrix;
    world_from_model = normal_matrix = mat4_identity();
    lab_matrices(seconds, &world_from_model, &normal_matrix);
    drawn->world_from_object = &world_from_model;
    drawn->normal_matrix = &normal_matrix;
#elif LAB == 10
    LabBudget budget = {.slices = 16, .stacks = 16};
    lab_budget(&budget);
    mesh_close(&lab_scene->meshes[0]);
    if (!mesh_sphere(&lab_scene->meshes[0], 1, budget.slices, budget.stacks, message))
        return false;
    if (budget.cull)
        glEnable(GL_CULL_FACE);
#endif
    return true;
}

static bool draw_lab(const Frame *frame, Message *message)
{
    LabScene lab_scene;
    LabShadowMap map = {0};
    Drawn drawn = {.scene = &lab_scene.scene, .aspect = frame->aspect, .map = &map};
    if (!lab_scene_open_usual(&lab_scene, state.lab, frame->seconds, message))
        return false;
    Camera *camera = &lab_scene.scene.camera;
    orbit_move(frame->orbit, &camera->eye, camera->center, &camera->up);
    glEnable(GL_DEPTH_TEST);
    bool done = choose(&lab_scene, &drawn, frame->seconds, message) &&
                lab_shadow_map_open(&map, &lab_scene, message);
    for (int i = 0; i < lab_scene.scene.object_count && done; i++) {
        MeshBuffer mesh = {0};
        drawn.object = i;
        done = mesh_buffer_open(&mesh, &lab_scene.meshes[i], message) &&
               binding_draw(state.lab, state.shader.program, &mesh, &drawn, message);
        mesh_buffer_close(&mesh);
    }
    lab_shadow_map_close(&map);
    lab_scene_close(&lab_scene);
    return done;
}

static void finish(void)
{
    shader_close(&state.shader);
}

int main(int argc, char *argv[])
{
    const Lab *lab = &LABS[LAB - 1];
    const Example example = {.name = lab->name,
                             .summary = lab->summary,
                             .init = init,
                             .finish = finish,
                             .kind = &FALLIBLE_KIND,
                             .content = &(const FallibleExample){draw_lab}};
    return example_main(&example, argc, argv);
}
