/*
 * TwoSidedLighting: the back of a surface, with its own material and its normal reversed.
 *
 * The lecture's turning quad, gold in front and silver behind; or, with --object cylinder, the
 * textbook's open cylinder, purple outside and yellow inside, with a bottom.
 *
 * Look at: the back when --two-sided is off: it is lit as if it were the front, from the wrong
 * side.
 */
#include "example.h"

static int object = 0;
static bool two_sided = true;

static const char *const OBJECTS[] = {"quad", "cylinder", NULL};

static const Parameter parameters[] = {
    {.name = "object",
     .help = "the lecture's or the textbook's",
     .kind = PARAMETER_CHOICE,
     .value = &object,
     .choices = OBJECTS},
    {.name = "two-sided",
     .help = "light the back as a back",
     .kind = PARAMETER_SWITCH,
     .value = &two_sided},
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
    return object ? mesh_cylinder(&state.mesh, 1, 2, 64, 16, MESH_CAP_BOTTOM, message)
                  : mesh_quad(&state.mesh, 1, message);
}

/* The textbook's cylinder: upright, its opening tilted to the viewer, whose light it stands in. */
static void cylinder_scene(double seconds, Scene *scene)
{
    Mat4 upright;
    mat4_rotate(-90, (Vec3){1, 0, 0}, &upright);
    state.light = (Light){.kind = LIGHT_DIRECTIONAL,
                          .direction = {0, 3, 4},
                          .diffuse = {1, 1, 1},
                          .specular = {1, 1, 1}};
    state.object.world_from_object = mat4_product(mat4_product(example_turned(seconds), upright),
                                                  mat4_translate((Vec3){0, 0, -1}));
    state.object.front = PURPLE;
    state.object.back = YELLOW;
    scene->camera = (Camera){.eye = {0, 3, 4}, .up = {0, 1, 0}, .fovy = 40, .near = 1, .far = 100};
    scene->global_ambient = (Vec3){0.15, 0.15, 0.15};
}

static void quad_scene(double seconds, Scene *scene)
{
    state.light = (Light){.kind = LIGHT_POINT,
                          .position = {0, 0.5, 0.5},
                          .ambient = {0.2, 0.2, 0.2},
                          .diffuse = {1, 1, 1},
                          .specular = {1, 1, 1}};
    state.object.world_from_object = example_turned(seconds);
    state.object.front = *material_find("gold");
    state.object.back = *material_find("silver");
    scene->camera = (Camera){.eye = {3, 2, 3}, .up = {0, 1, 0}, .fovy = 60, .near = 1, .far = 100};
}

static void scene(double seconds, int view, Scene *scene)
{
    (void)view;
    state.object = (Object){.mesh = &state.mesh, .two_sided = two_sided};
    state.object.solid =
        object ? (Solid){.kind = SOLID_CYLINDER, .radius = 1, .height = 2, .caps = MESH_CAP_BOTTOM}
               : (Solid){.kind = SOLID_QUAD};
    *scene = (Scene){.background = {0.5, 0.5, 0.5},
                     .lights = &state.light,
                     .light_count = 1,
                     .objects = &state.object,
                     .object_count = 1,
                     .reflection = REFLECTION_PHONG};
    if (object)
        cylinder_scene(seconds, scene);
    else
        quad_scene(seconds, scene);
}

static void annotate(double seconds, int view, const Scene *scene, Annotations *annotations)
{
    if (!object)
        example_annotate(seconds, view, scene, annotations);
}

static void finish(void)
{
    mesh_close(&state.mesh);
}

const Example TwoSidedLighting = {
    .name = "TwoSidedLighting",
    .summary = "a material for the back, and its normal reversed",
    .init = init,
    .finish = finish,
    .scene = scene,
    .annotate = annotate,
    .parameters = parameters,
};
