/*
 * FourLights: a dim light at the viewer, and three coloured lights that circle a teapot on a disc.
 *
 * The textbook's demo. Each coloured light goes its own way at its own speed, and a small sphere
 * marks it: it emits the light's colour, and is dark if the light is off. The base has the colours
 * of the rainbow at its vertices (glColorMaterial).
 *
 * Look at the colours where lights overlap, and at the highlights: the teapot has one per light,
 * the base none. What the spheres emit lights nothing else.
 */
#include "core/mesh_make.h"
#include "scene/scene_example.h"
#include "scene/shape.h"
#include "shapes/mesh_solids.h"

#include <math.h>

enum { COLORED = 3, BASE_SLICES = 64 };

static bool viewpoint_on = true, red_on = true, green_on = true, blue_on = true, ambient_on = true;
static bool base = true;
static ShapeModel pot;
static SceneShading shading = {REFLECTION_PHONG, INTERPOLATION_GOURAUD, VIEWER_LOCAL};
static int material = MATERIAL_COUNT;
static const Material OWN = {.ambient = {0.7, 0.7, 0.7},
                             .diffuse = {0.7, 0.7, 0.7},
                             .specular = {0.2, 0.2, 0.2},
                             .alpha = 1,
                             .shininess = 32};

static const Parameter parameters[] = {
    {"viewpoint", "the dim grey light at the viewer", PARAMETER_SWITCH, .value = &viewpoint_on,
     .fixes = 1U << AXIS_LIGHTS},
    {"red", "the red light", PARAMETER_SWITCH, .value = &red_on, .fixes = 1U << AXIS_LIGHTS},
    {"green", "the green light", PARAMETER_SWITCH, .value = &green_on, .fixes = 1U << AXIS_LIGHTS},
    {"blue", "the blue light", PARAMETER_SWITCH, .value = &blue_on, .fixes = 1U << AXIS_LIGHTS},
    {"ambient", "global ambient light", PARAMETER_SWITCH, .value = &ambient_on},
    {"base", "the coloured disc below the teapot", PARAMETER_SWITCH, .value = &base},
    DIVISIONS_PARAMETER(pot),
    {"material", "of the teapot; none: its own", PARAMETER_CHOICE, .value = &material,
     .choices = MATERIAL_NAMES},
    SHADING_PARAMETERS(shading),
    {.name = NULL},
};

static struct {
    Mesh base, marker;
    Shape teapot;
    Light lights[1 + COLORED];
    Object objects[2 + COLORED];
} state;

/* A colour of the rainbow, of value 0.6: `hue` from 0 to 1. (Smith, Color Gamut Transform Pairs,
 * SIGGRAPH 1978) */
static Vec3 rainbow(double hue)
{
    double channels[3];
    for (int k = 0; k < 3; k++) {
        const double apart = fmod(6 * hue + 9 - 2 * k, 6) - 3; /* from the channel's own hue */
        channels[k] = 0.6 * fmin(fmax(2 - fabs(apart), 0), 1);
    }
    return (Vec3){channels[0], channels[1], channels[2]};
}

/* A flat cylinder: white at the centres of its discs, the hues around its rim. */
static bool open_base(Mesh *mesh, Message *message)
{
    static const double LAST_HUE = 359.0 / 360; /* as in the demo: the seam is not red again */
    if (!mesh_cylinder(mesh, (MeshCylinder){1, 2, BASE_SLICES, 1, MESH_CAP_BOTH}, message) ||
        !mesh_open_colors(mesh, message))
        return false;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const Vec3 place = vec3_from_float(mesh->vertices[i].position);
        const double radius = fmin(hypot(place.x, place.y), 1); /* but for rounding */
        const Vec3 hue = rainbow(LAST_HUE * (double)(i % (BASE_SLICES + 1)) / BASE_SLICES);
        vec3_to_float(vec3_add(vec3_scale(hue, radius), vec3_scale((Vec3){1, 1, 1}, 1 - radius)),
                      mesh->colors[i]);
    }
    return true;
}

static bool init(const ShaderLoader *loader, Message *message)
{
    (void)loader;
    return open_base(&state.base, message) && mesh_sphere(&state.marker, 0.5, 16, 8, message) &&
           shape_open(&state.teapot, SHAPE_TEAPOT, SHAPE_TEXTBOOK, &pot, message);
}

/* The places of the three lights: a frame lasts 30 ms, and turns each by its own angle. */
static Vec3 lamp_place(double seconds, int i)
{
    static const Vec3 starts[COLORED] = {{10, 7, 0}, {9, 8, 0}, {9.5, 7.5, 0}};
    const double frame = seconds / 0.03;
    const double angles[COLORED] = {-frame, 0.8743 * (frame + 100), 1.3057 * (frame - 100)};
    return mat4_transform_point(mat4_rotate(angles[i], (Vec3){0, 1, 0}), starts[i]);
}

static void colored_light(double seconds, int i)
{
    static const Vec3 colors[COLORED] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const bool on[COLORED] = {red_on, green_on, blue_on};
    const Vec3 place = lamp_place(seconds, i);
    const Mat4 lying = mat4_rotate(90, (Vec3){1, 0, 0}); /* its poles on z, as the demo has them */
    state.lights[1 + i] = (Light){.kind = LIGHT_POINT,
                                  .off = !on[i],
                                  .position = place,
                                  .ambient = vec3_scale(colors[i], 0.1),
                                  .diffuse = vec3_scale(colors[i], 0.5),
                                  .specular = vec3_scale(colors[i], 0.5)};
    state.objects[1 + i] = (Object){.mesh = &state.marker,
                                    .solid = {.kind = SOLID_SPHERE, .radius = 0.5},
                                    .closed = true,
                                    .lamp = 1 + (1 + i),
                                    .world_from_object = mat4_product(mat4_translate(place), lying),
                                    .front = {.emission = vec3_scale(colors[i], on[i] ? 0.5 : 0),
                                              .alpha = 1,
                                              .ambient = {0.5, 0.5, 0.5},
                                              .diffuse = {0.5, 0.5, 0.5}}};
}

static void base_object(void)
{
    const Mat4 low = mat4_translate((Vec3){0, -5, 0}), lying = mat4_rotate(-90, (Vec3){1, 0, 0});
    const Mat4 centred =
        mat4_product(mat4_scale((Vec3){10, 10, 0.5}), mat4_translate((Vec3){0, 0, -1}));
    state.objects[1 + COLORED] = (Object){
        .mesh = &state.base,
        .closed = true,
        .world_from_object = mat4_product(low, mat4_product(lying, centred)),
        .front = {.alpha = 1},
    };
}

static void scene(double seconds, int view, Scene *scene)
{
    static const double SIZE = 13; /* the demo's 0.65, of a pot 20 times as large as Materials' */
    const Mat4 raised = mat4_translate((Vec3){0, 0.68, 0});
    (void)view;
    state.lights[0] = (Light){.kind = LIGHT_DIRECTIONAL,
                              .space = LIGHT_EYE,
                              .direction = {0, 0, 1},
                              .off = !viewpoint_on,
                              .diffuse = {0.5, 0.5, 0.5},
                              .specular = {0.5, 0.5, 0.5}};
    state.objects[0] =
        shape_object(&state.teapot, mat4_product(raised, mat4_scale((Vec3){SIZE, SIZE, SIZE})),
                     material < MATERIAL_COUNT ? MATERIALS[material].material : OWN);
    for (int i = 0; i < COLORED; i++)
        colored_light(seconds, i);
    base_object();
    *scene = (Scene){.camera = example_camera((Vec3){5, 10, 30}, 15),
                     .lights = state.lights,
                     .light_count = 1 + COLORED,
                     .objects = state.objects,
                     .object_count = base ? 2 + COLORED : 1 + COLORED};
    if (ambient_on)
        scene->global_ambient = (Vec3){0.15, 0.15, 0.15};
    scene_shading_apply(&shading, scene);
}

static void finish(void)
{
    mesh_close(&state.base);
    mesh_close(&state.marker);
    shape_close(&state.teapot);
}

const Example FourLights = {
    .name = "FourLights",
    .summary = "four lights on and off, spheres that emit, colours at the vertices",
    .tries = {"--viewpoint off --ambient off --time 3.1", "--terms emission", "--lighting off"},
    .looks = {"the three coloured lights alone", "what shines by itself: the lamps",
              "each surface in its own colour: no depth"},
    .init = init,
    .finish = finish,
    .kind = &SCENE_KIND,
    .content = &(const SceneExample){.make = scene},
    .parameters = parameters,
};
