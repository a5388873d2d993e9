/*
 * NormalMatrix: a sphere scaled unevenly, with the right normals and with the wrong ones.
 *
 * The right ones are transformed by the inverse transpose of the model-view matrix, the wrong ones
 * by the matrix itself. --matrix both shows them side by side.
 *
 * Look at --matrix both --normals on: the wrong normals lean towards the long axis, and the light
 * follows them. With --scale 1,1,1 --rotate 30 they are the same: --explain prints both matrices.
 */
#include "scene/scene_example.h"
#include "scene/shape.h"

enum { RIGHT, WRONG, BOTH };
static const char *const MATRICES[] = {"right", "wrong", "both", NULL};

static int matrix = RIGHT;
static Vec3 scale = {2, 0.7, 0.7};
static double rotate = 0;
static Surface surface = {.name = MATERIAL_GOLD_INDEX, .material = MATERIAL_GOLD};
static LightColors light_colors = {{0.5, 0.5, 0.5}, {1, 1, 1}, {1, 1, 1}};
static Vec3 global_ambient = {0, 0, 0};
static SceneShading shading = {REFLECTION_PHONG, INTERPOLATION_PHONG, VIEWER_LOCAL};

static const Parameter parameters[] = {
    {"matrix", "the matrix by which normals are transformed", PARAMETER_CHOICE, .value = &matrix,
     .choices = MATRICES},
    {"scale", "of the sphere along the axes; 1,1,1: M is orthogonal, and the wrong matrix is right",
     PARAMETER_COLOR, .value = &scale, .min = -5, .max = 5, .placeholder = "X,Y,Z"},
    {"rotate", "turn the scaled sphere about the y axis, in degrees", PARAMETER_NUMBER,
     .value = &rotate, .min = -360, .max = 360, .placeholder = "DEG"},
    SURFACE_PARAMETERS(surface),
    SHADING_PARAMETERS(shading),
    LIGHT_PARAMETERS(light_colors, global_ambient),
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
    return shape_open(&state.shape, SHAPE_SPHERE, SHAPE_LECTURE, NULL, message);
}

static void scene(double seconds, int view, Scene *scene)
{
    state.light =
        (Light){.kind = LIGHT_POINT, .position = example_turn((Vec3){1.5, 1, 0}, seconds)};
    light_colors_apply(&light_colors, &state.light);
    const Mat4 turn = mat4_rotate(rotate, (Vec3){0, 1, 0});
    state.object =
        shape_object(&state.shape, mat4_product(turn, mat4_scale(scale)), surface.material);
    state.object.wrong_normals = matrix == WRONG || view == 1;
    *scene =
        (Scene){.camera = {.eye = {3, 2, 3}, .up = {0, 1, 0}, .fovy = 60, .near = 1, .far = 100},
                .background = {0.2, 0.2, 0.2},
                .global_ambient = global_ambient,
                .lights = &state.light,
                .light_count = 1,
                .objects = &state.object,
                .object_count = 1};
    scene_shading_apply(&shading, scene);
}

static void layout(int *columns, int *rows)
{
    *columns = matrix == BOTH ? 2 : 1;
    *rows = 1;
}

static void size(int *width, int *height)
{
    *width = matrix == BOTH ? 1024 : 512;
    *height = 512;
}

static const char *label(int view)
{
    return matrix != BOTH ? NULL : view == 0 ? "inverse transpose" : "model-view matrix";
}

static void finish(void)
{
    shape_close(&state.shape);
}

const Example NormalMatrix = {
    .name = "NormalMatrix",
    .summary = "normals of a scaled sphere, transformed rightly and wrongly",
    .tries = {"--matrix both --normals on", "--matrix wrong --terms diffuse",
              "--terms specular --matrix both"},
    .looks = {"wrong normals lean towards the long axis",
              "the light's border is in the wrong place", "wrong normals move the highlight"},
    .init = init,
    .finish = finish,
    .kind = &SCENE_KIND,
    .content = &(const SceneExample){.make = scene,
                                     .annotate = example_annotate,
                                     .layout = layout,
                                     .size = size,
                                     .label = label},
    .parameters = parameters,
};
