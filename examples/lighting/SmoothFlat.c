/*
 * SmoothFlat: the same triangles with the normals of the surface they stand for, and with their
 * own.
 *
 * A sphere of few slices and stacks; or, with --figure band, the same strip of rectangles twice:
 * above with the normals of a smooth surface, below with those of the rectangles.
 *
 * Look at: the silhouette, which no normal can make round.
 */
#include "example.h"

static int figure, normals, slices = 8, stacks = 4;
static bool edges;

static const char *const FIGURES[] = {"sphere", "band", NULL};
static const char *const NORMALS[] = {"smooth", "flat", NULL};

static const Parameter parameters[] = {
    {.name = "figure",
     .help = "what is drawn",
     .kind = PARAMETER_CHOICE,
     .value = &figure,
     .choices = FIGURES},
    {.name = "normals",
     .help = "of the sphere",
     .kind = PARAMETER_CHOICE,
     .value = &normals,
     .choices = NORMALS},
    {.name = "slices",
     .help = "of the sphere, around its axis",
     .kind = PARAMETER_WHOLE,
     .value = &slices,
     .least = 3,
     .most = 64},
    {.name = "stacks",
     .help = "of the sphere, along its axis",
     .kind = PARAMETER_WHOLE,
     .value = &stacks,
     .least = 2,
     .most = 32},
    {.name = "edges",
     .help = "draw the edges of the triangles",
     .kind = PARAMETER_SWITCH,
     .value = &edges},
    {.name = NULL},
};

static const Light LIGHT = {.kind = LIGHT_DIRECTIONAL,
                            .direction = {-1, 1, 2},
                            .diffuse = {1, 1, 1},
                            .specular = {1, 1, 1}};
static const Material MATERIAL = {.ambient = {0.7, 0.7, 0.7},
                                  .diffuse = {0.7, 0.7, 0.7},
                                  .specular = {0.2, 0.2, 0.2},
                                  .alpha = 1,
                                  .shininess = 16};

static struct {
    Mesh smooth, flat; /* the same triangles */
    Object objects[2];
} state;

/* The band is half of an open cylinder that is cut into 12. */
static bool open_mesh(Mesh *mesh, Message *message)
{
    return figure ? mesh_cylinder(mesh, 1, 0.8, 12, 1, MESH_CAP_NONE, message)
                  : mesh_sphere(mesh, 1, slices, stacks, message);
}

static bool init(const ShaderLoader *loader, Message *message)
{
    (void)loader;
    return open_mesh(&state.smooth, message) && open_mesh(&state.flat, message) &&
           mesh_flatten(&state.flat, message);
}

static Object make_object(bool flat, Mat4 world_from_object)
{
    return (Object){.mesh = flat ? &state.flat : &state.smooth,
                    .flat = flat,
                    .closed = !figure,
                    .world_from_object = world_from_object,
                    .front = MATERIAL};
}

static void scene(double seconds, int view, Scene *scene)
{
    Mat4 upright;
    const Mat4 turned = example_turned(seconds);
    (void)view;
    mat4_rotate(-90, (Vec3){1, 0, 0}, &upright);
    state.objects[0] = make_object(normals == 1, turned);
    for (int i = 0; i < 2 && figure; i++) {
        const Mat4 raised = mat4_translate((Vec3){0, i == 0 ? 0.15 : -0.95, 0});
        state.objects[i] = make_object(i == 1, mat4_product(raised, mat4_product(turned, upright)));
    }
    *scene =
        (Scene){.camera = {.eye = {0, 1, 5}, .up = {0, 1, 0}, .fovy = 30, .near = 1, .far = 100},
                .global_ambient = {0.2, 0.2, 0.2},
                .lights = &LIGHT,
                .light_count = 1,
                .objects = state.objects,
                .object_count = figure ? 2 : 1};
}

static void annotate(double seconds, int view, const Scene *scene, Annotations *annotations)
{
    (void)seconds, (void)view;
    for (int i = 0; i < scene->object_count && edges; i++)
        marks_add_edges(&annotations->lines, scene->objects[i].mesh,
                        scene->objects[i].world_from_object, (Vec3){0, 0, 0});
}

static void finish(void)
{
    mesh_close(&state.smooth);
    mesh_close(&state.flat);
}

const Example SmoothFlat = {
    .name = "SmoothFlat",
    .summary = "smooth and flat normals on the same triangles",
    .init = init,
    .finish = finish,
    .scene = scene,
    .annotate = annotate,
    .parameters = parameters,
};
