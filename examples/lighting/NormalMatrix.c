/*
 * NormalMatrix: a sphere scaled unevenly, with the right normals and with the wrong ones.
 *
 * On the left normals go through the inverse transpose of the model-view matrix, on the right
 * through that matrix itself, as if they were directions on the surface.
 *
 * Look at: --normals on: the wrong ones lean towards the long axis, and the light with them.
 */
#include "example.h"
#include "shape.h"

static bool normals;

static const Parameter parameters[] = {
    {.name = "normals",
     .help = "draw normals as lines",
     .kind = PARAMETER_SWITCH,
     .value = &normals},
    {.name = NULL},
};

static struct {
    Shape shape;
    Light light;
    Object object;
} state;

static bool init(const ShaderLoader *loader, Message *message)
{
    (void)loader;
    return shape_open(&state.shape, SHAPE_SPHERE, NULL, message);
}

static void scene(double seconds, int view, Scene *scene)
{
    state.light = (Light){.kind = LIGHT_POINT,
                          .position = example_turn((Vec3){1.5, 1, 0}, seconds),
                          .ambient = {0.5, 0.5, 0.5},
                          .diffuse = {1, 1, 1},
                          .specular = {1, 1, 1}};
    state.object =
        shape_object(&state.shape, mat4_scale((Vec3){2, 0.7, 0.7}), *material_find("jade"));
    state.object.wrong_normals = view == 1;
    *scene =
        (Scene){.camera = {.eye = {3, 2, 3}, .up = {0, 1, 0}, .fovy = 60, .near = 1, .far = 100},
                .background = {0.2, 0.2, 0.2},
                .lights = &state.light,
                .light_count = 1,
                .objects = &state.object,
                .object_count = 1,
                .reflection = REFLECTION_PHONG};
}

static void annotate(double seconds, int view, const Scene *scene, Annotations *annotations)
{
    const Mat4 world_from_object = state.object.world_from_object;
    Mat4 normal_matrix = world_from_object;
    example_annotate(seconds, view, scene, annotations);
    if (view == 0)
        mat4_normal(world_from_object, &normal_matrix);
    if (normals)
        marks_add_normals(&annotations->lines, &state.shape.mesh, world_from_object, normal_matrix,
                          0.2, (Vec3){1, 1, 0});
}

static void layout(int *columns, int *rows)
{
    *columns = 2;
    *rows = 1;
}

static const char *label(int view)
{
    return view == 0 ? "right: the inverse transpose" : "wrong: the matrix itself";
}

static void finish(void)
{
    shape_close(&state.shape);
}

const Example NormalMatrix = {
    .name = "NormalMatrix",
    .summary = "normals under uneven scaling, right and wrong side by side",
    .width = 800,
    .height = 400,
    .init = init,
    .finish = finish,
    .scene = scene,
    .layout = layout,
    .annotate = annotate,
    .label = label,
    .parameters = parameters,
};
