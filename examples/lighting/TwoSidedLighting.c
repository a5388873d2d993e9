/*
 * TwoSidedLighting: the back of a surface has its own material and the reversed normal.
 *
 * The lecture's turning quad, gold in front and silver behind; or, with --shape cylinder, the
 * textbook's open cylinder, purple outside and yellow inside, with a bottom.
 *
 * Look at the back with --two-sided off: it is lit with the front's normal, as if from the wrong
 * side. With --front-face cw front and back change places.
 */
#include "scene/scene_example.h"
#include "shapes/mesh_solids.h"

enum { QUAD, CYLINDER };
static const char *const SHAPES[] = {"quad", "cylinder", NULL};
static const char *const WINDINGS[] = {"ccw", "cw", NULL};

static int shape, winding;
static int front_name = MATERIAL_COUNT, back_name = MATERIAL_COUNT;
static bool two_sided = true;
static LightColors light_colors = {{0.2, 0.2, 0.2}, {1, 1, 1}, {1, 1, 1}};
static Vec3 global_ambient = {0, 0, 0};
static SceneShading shading = {REFLECTION_PHONG, INTERPOLATION_PHONG, VIEWER_LOCAL};

/* The textbook's demos are lit at the vertices, and only the scene has ambient light. */
static void shape_changed(const Parameter *parameter)
{
    (void)parameter;
    const double scene_ambient = shape == CYLINDER ? 0.15 : 0;
    const double light_ambient = shape == CYLINDER ? 0 : 0.2;
    shading.interpolation = shape == CYLINDER ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
    global_ambient = (Vec3){scene_ambient, scene_ambient, scene_ambient};
    light_colors.ambient = (Vec3){light_ambient, light_ambient, light_ambient};
}

static const Parameter parameters[] = {
    {"shape", "the lecture's quad, or the textbook's cylinder", PARAMETER_CHOICE, .value = &shape,
     .choices = SHAPES, .changed = shape_changed},
    {"two-sided", "light the back as a back", PARAMETER_SWITCH, .value = &two_sided},
    {"front-face", "the order of the corners of a front face, as in glFrontFace", PARAMETER_CHOICE,
     .value = &winding, .choices = WINDINGS},
    {"material", "of the front; none: the original's", PARAMETER_CHOICE, .value = &front_name,
     .choices = MATERIAL_NAMES},
    {"back-material", "of the back; none: the original's", PARAMETER_CHOICE, .value = &back_name,
     .choices = MATERIAL_NAMES},
    SHADING_PARAMETERS(shading),
    LIGHT_PARAMETERS(light_colors, global_ambient),
    {.name = NULL},
};

static const Material PURPLE = {.ambient = {0.6, 0, 0.6},
                                .diffuse = {0.6, 0, 0.6},
                                .specular = {0.4, 0.4, 0.4},
                                .alpha = 1,
                                .shininess = 64};
static const Material YELLOW = {.ambient = {0.6, 0.6, 0}, .diffuse = {0.6, 0.6, 0}, .alpha = 1};

static struct {
    Mesh mesh;
    Light light;
    Object object;
} state;

static bool init(const ShaderLoader *loader, Message *message)
{
    (void)loader;
    return shape == CYLINDER
               ? mesh_cylinder(&state.mesh, (MeshCylinder){1, 2, 64, 1, MESH_CAP_BOTTOM}, message)
               : mesh_quad(&state.mesh, 1, message);
}

/* Lit from the viewer, who looks into it. */
static void cylinder_scene(double seconds, Scene *scene)
{
    const Mat4 lying = mat4_rotate(-90, (Vec3){1, 0, 0});
    const Mat4 low = mat4_product(mat4_scale((Vec3){1, 1, 0.3}), mat4_translate((Vec3){0, 0, -1}));
    state.light = (Light){.kind = LIGHT_DIRECTIONAL, .space = LIGHT_EYE, .direction = {0, 0, 1}};
    state.object.solid =
        (Solid){.kind = SOLID_CYLINDER, .radius = 1, .height = 2, .caps = MESH_CAP_BOTTOM};
    state.object.world_from_object =
        mat4_product(example_turned(seconds), mat4_product(lying, low));
    state.object.front = PURPLE;
    state.object.back = YELLOW;
    scene->camera = example_camera((Vec3){5, 10, 20}, 1.5);
}

static void quad_scene(double seconds, Scene *scene)
{
    state.light = (Light){.kind = LIGHT_POINT, .position = {0, 0.5, 0.5}};
    state.object.solid = (Solid){.kind = SOLID_QUAD};
    state.object.world_from_object = example_turned(seconds);
    state.object.front = *material_find("gold");
    state.object.back = *material_find("silver");
    scene->camera = (Camera){.eye = {3, 2, 3}, .up = {0, 1, 0}, .fovy = 60, .near = 1, .far = 100};
    scene->background = (Vec3){0.5, 0.5, 0.5};
}

static void scene(double seconds, int view, Scene *scene)
{
    (void)view;
    state.object = (Object){.mesh = &state.mesh, .two_sided = two_sided, .clockwise = winding == 1};
    *scene = (Scene){
        .lights = &state.light, .light_count = 1, .objects = &state.object, .object_count = 1};
    if (shape == CYLINDER)
        cylinder_scene(seconds, scene);
    else
        quad_scene(seconds, scene);
    light_colors_apply(&light_colors, &state.light);
    scene->global_ambient = global_ambient;
    if (front_name < MATERIAL_COUNT)
        state.object.front = MATERIALS[front_name].material;
    if (back_name < MATERIAL_COUNT)
        state.object.back = MATERIALS[back_name].material;
    scene_shading_apply(&shading, scene);
}

static void annotate(double seconds, int view, const Scene *scene, Annotations *annotations)
{
    if (shape == QUAD)
        example_annotate(seconds, view, scene, annotations);
}

static void size(int *width, int *height)
{
    *width = *height = shape == CYLINDER ? 350 : 512;
}

static void finish(void)
{
    mesh_close(&state.mesh);
}

const Example TwoSidedLighting = {
    .name = "TwoSidedLighting",
    .summary = "a material for the back, and its normal reversed",
    .tries = {"--time 6 --two-sided off", "--front-face cw", "--shape cylinder --two-sided off"},
    .looks = {"the back, lit with the front's normal: dark, though the light is before it",
              "what faces you is the back: silver, and the light is behind it",
              "the inside has the outside's colour, and the wrong normals"},
    .init = init,
    .finish = finish,
    .kind = &SCENE_KIND,
    .content = &(const SceneExample){.make = scene, .annotate = annotate, .size = size},
    .parameters = parameters,
};
