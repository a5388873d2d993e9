/*
 * Shadows: a teapot, a torus and a sphere cast shadows on a floor, a wall and each other.
 *
 * A directional, a point and a spot light, each on or off, circle them; --sheet has the scene
 * without and with shadows, and in each light alone.
 *
 * Look at the floor where two shadows overlap: only the third light is left there. The ambient term
 * has no shadow, so nothing is black.
 */
#include "scene/scene_example.h"
#include "shapes/mesh_solids.h"

enum { SHEET_VIEWS = 6, SHEET_COLUMNS = 3, SIDE = 400, SHEET_SIDE = 300 };

static bool sheet, directional = true, point = true, spot = true;
static double cutoff = 28;
static Vec3 global_ambient = {0.25, 0.25, 0.25};
static SceneShading shading = {REFLECTION_BLINN_PHONG, INTERPOLATION_PHONG, VIEWER_LOCAL};

static const Parameter parameters[] = {
    {"directional", "the parallel light", PARAMETER_SWITCH, .value = &directional},
    {"point", "the point light", PARAMETER_SWITCH, .value = &point},
    {"spot", "the spot light", PARAMETER_SWITCH, .value = &spot},
    {"cutoff", "half the spot's angle, in degrees", PARAMETER_NUMBER, .value = &cutoff, .min = 0,
     .max = 90},
    COLOR_PARAMETER("global-ambient", "ambient light of the scene", global_ambient),
    {"sheet", "without and with shadows, and each light alone", PARAMETER_SWITCH, .value = &sheet},
    SHADING_PARAMETERS(shading),
    {.name = NULL},
};

enum { TEAPOT, TORUS, BALL, FLOOR, WALL, OBJECTS };

static struct {
    Mesh meshes[WALL]; /* floor and wall have one */
    Light lights[3];
    Object objects[OBJECTS];
} state;

static bool init(const ShaderLoader *loader, Message *message)
{
    (void)loader;
    return mesh_teapot(&state.meshes[TEAPOT], 0.75, 10, message) &&
           mesh_torus(&state.meshes[TORUS], 0.2, 0.55, 24, 48, message) &&
           mesh_sphere(&state.meshes[BALL], 0.5, 48, 24, message) &&
           mesh_quad(&state.meshes[FLOOR], 1, message);
}

static void make_lights(double seconds, int view)
{
    const bool on[3] = {directional, point, spot};
    const Vec3 at = example_turn((Vec3){-1.7, 1.9, 2.1}, seconds);
    const Vec3 from = example_turn((Vec3){2.4, 2.6, 2.6}, -0.5 * seconds);
    state.lights[0] = (Light){.kind = LIGHT_DIRECTIONAL,
                              .direction = example_turn((Vec3){0.5, 2.5, 2.75}, 0.7 * seconds),
                              .diffuse = {0.35, 0.35, 0.3},
                              .specular = {0.3, 0.3, 0.3}};
    state.lights[1] = (Light){.kind = LIGHT_POINT,
                              .position = at,
                              .diffuse = {0.5, 0.35, 0.2},
                              .specular = {0.4, 0.3, 0.2}};
    state.lights[2] = (Light){.kind = LIGHT_SPOT,
                              .position = from,
                              .direction = vec3_scale(from, -1),
                              .cutoff = cutoff,
                              .exponent = 4,
                              .diffuse = {0.3, 0.45, 0.7},
                              .specular = {0.3, 0.4, 0.5}};
    for (int i = 0; i < 3; i++) {
        state.lights[i].off = !on[i] || (view > 1 && view != 2 + i);
        state.lights[i].shadows = !sheet || view > 0;
    }
}

static void make_objects(double seconds)
{
    const Mat4 lying = mat4_rotate(-90, (Vec3){1, 0, 0});
    const Mat4 large = mat4_scale((Vec3){2.2, 2.2, 1}), wide = mat4_scale((Vec3){2.2, 1.4, 1});
    const Mat4 places[OBJECTS] = {
        mat4_translate((Vec3){-0.1, 0, 0}),
        mat4_product(mat4_translate((Vec3){1.35, 0.2, -0.45}),
                     mat4_product(mat4_rotate(30 * seconds, (Vec3){0, 1, 0}),
                                  mat4_rotate(25, (Vec3){1, 0, 0}))),
        mat4_translate((Vec3){-1.2, -0.063, 0.8}),
        mat4_product(mat4_translate((Vec3){0, -0.563, 0.6}), mat4_product(lying, large)),
        mat4_product(mat4_translate((Vec3){0, 0.837, -1.6}), wide),
    };
    static const Solid solids[OBJECTS] = {{.kind = SOLID_TEAPOT, .radius = 0.75},
                                          {.kind = SOLID_TORUS, .radius = 0.55, .tube = 0.2},
                                          {.kind = SOLID_SPHERE, .radius = 0.5},
                                          {.kind = SOLID_QUAD},
                                          {.kind = SOLID_QUAD}};
    static const Vec3 colors[OBJECTS] = {
        {0.8, 0.8, 0.75}, {0.7, 0.3, 0.25}, {0.3, 0.5, 0.75}, {0.75, 0.75, 0.75}, {0.7, 0.75, 0.7}};
    for (int i = 0; i < OBJECTS; i++)
        state.objects[i] = (Object){
            .mesh = &state.meshes[i < WALL ? i : FLOOR],
            .solid = solids[i],
            .flat = i >= FLOOR,
            .closed = i == TORUS || i == BALL,
            .world_from_object = places[i],
            .front = {.ambient = colors[i], .diffuse = colors[i], .alpha = 1, .shininess = 30}};
    for (int i = 0; i < FLOOR; i++)
        state.objects[i].front.specular = (Vec3){0.5, 0.5, 0.5};
}

static void scene(double seconds, int view, Scene *scene)
{
    make_lights(seconds, view);
    make_objects(seconds);
    *scene = (Scene){.camera = {.eye = {0, 2.8, 8.2},
                                .center = {0, 0.35, 0},
                                .up = {0, 1, 0},
                                .fovy = 40,
                                .near = 1,
                                .far = 30},
                     .global_ambient = global_ambient,
                     .lights = state.lights,
                     .light_count = 3,
                     .objects = state.objects,
                     .object_count = OBJECTS};
    scene_shading_apply(&shading, scene);
}

static void layout(int *columns, int *rows)
{
    *columns = sheet ? SHEET_COLUMNS : 1;
    *rows = sheet ? (SHEET_VIEWS - 1) / SHEET_COLUMNS + 1 : 1;
}

static void size(int *width, int *height)
{
    *width = sheet ? SHEET_COLUMNS * SHEET_SIDE : SIDE;
    *height = sheet ? SHEET_VIEWS / SHEET_COLUMNS * SHEET_SIDE : SIDE;
}

static void annotate(double seconds, int view, const Scene *scene, Annotations *annotations)
{
    (void)seconds, (void)view;
    overlay_add_lights(&annotations->points, scene);
}

static const char *label(int view)
{
    static const char *const labels[SHEET_VIEWS] = {"without shadows",       "with shadows",
                                                    "the directional light", "the point light",
                                                    "the spot light",        "ambient light"};
    return sheet ? labels[view] : NULL;
}

/* Of what is seen with --shadows off, or some of the terms, too. */
static const char *plain_label(int view)
{
    return sheet && view < 2 ? "all lights" : label(view);
}

static void finish(void)
{
    for (int i = 0; i < WALL; i++)
        mesh_close(&state.meshes[i]);
}

const Example Shadows = {
    .name = "Shadows",
    .summary = "shadows of a teapot, a torus and a sphere in three kinds of light",
    .tries = {"--shadows off", "--sheet on", "--point off --spot off"},
    .looks = {"nothing stands on the floor any more",
              "each light has its own shadows; ambient light has none",
              "parallel rays: the sphere's shadow is an ellipse"},
    .init = init,
    .finish = finish,
    .kind = &SCENE_KIND,
    .content = &(const SceneExample){.make = scene,
                                     .shadows = true,
                                     .annotate = annotate,
                                     .layout = layout,
                                     .size = size,
                                     .label = label,
                                     .plain_label = plain_label},
    .parameters = parameters,
};
