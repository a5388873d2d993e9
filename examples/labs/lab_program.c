/*
 * lab_program: shows a lab's usual scene with somebody's shaders, by default the starter's. The
 * build compiles this file once for each lab, with LAB as its number.
 *
 * To do a lab, copy its folder, edit the copy, and keep the picture in sight:
 *   examples/run lab05_per_fragment --shaders mine --watch
 */
#include "binding.h"
#include "example.h"
#include "probe.h"

#if LAB == 3 || LAB == 10
#include "lab_code.h"
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
           binding_check(state.lab, state.shader.program, message);
}

/* Lab 3: the places that the student's C gives; lab 10: its sphere. */
static bool choose(Probe *probe, Drawn *drawn, double seconds)
{
    (void)probe, (void)drawn, (void)seconds;
#if LAB == 3
    static Mat4 world_from_model, normal_matrix;
    world_from_model = normal_matrix = mat4_identity();
    lab_matrices(seconds, &world_from_model, &normal_matrix);
    drawn->world_from_object = &world_from_model;
    drawn->normal_matrix = &normal_matrix;
#elif LAB == 10
    LabBudget budget = {.slices = 16, .stacks = 16};
    lab_budget(&budget);
    mesh_close(&probe->meshes[0]);
    if (!mesh_sphere(&probe->meshes[0], 1, budget.slices, budget.stacks, NULL))
        return false;
    if (budget.cull)
        glEnable(GL_CULL_FACE);
#endif
    return true;
}

static bool draw(const Frame *frame)
{
    Probe probe;
    MeshBuffer mesh = {0};
    Drawn drawn = {.scene = &probe.scene, .aspect = frame->aspect};
    if (!probe_open_usual(&probe, state.lab, frame->seconds, NULL))
        return false;
    Camera *camera = &probe.scene.camera;
    orbit_move(frame->orbit, &camera->eye, camera->center, &camera->up);
    glEnable(GL_DEPTH_TEST);
    const bool done = choose(&probe, &drawn, frame->seconds) &&
                      mesh_buffer_open(&mesh, &probe.meshes[0], NULL) &&
                      binding_draw(state.lab, state.shader.program, &mesh, &drawn, NULL);
    mesh_buffer_close(&mesh);
    probe_close(&probe);
    return done;
}

static void finish(void)
{
    shader_close(&state.shader);
}

int main(int argc, char *argv[])
{
    const Lab *lab = &LABS[LAB - 1];
    const Example example = {
        .name = lab->name, .summary = lab->summary, .init = init, .draw = draw, .finish = finish};
    return example_main(&example, argc, argv);
}
