/*
 * SmoothFlat: the same triangles with the normals of the curved surface, and with their own.
 *
 * The textbook's demo: a sphere of few slices and stacks. --shape band is its figure, half a ring
 * of rectangles twice: above with smooth normals, below with flat ones. --shape square is a flat
 * square whose smooth normals are those of a sphere: normals are whatever you say they are.
 *
 * Look at the silhouette: no normal makes it round. --normals original has the demo's flat ones,
 * which are not perpendicular to the faces: four points are to be added and divided by 4, and only
 * the last one is divided.
 */
#include "scene/scene_example.h"
#include "shapes/mesh_solids.h"

#include <math.h>

enum { SPHERE, BAND, SQUARE };
static const char *const SHAPES[] = {"sphere", "band", "square", NULL};
enum { SMOOTH, FLAT, ORIGINAL };
static const char *const NORMALS[] = {"smooth", "flat", "original", NULL};

static int shape, normals, slices = 8, stacks = 4;
static bool edges, show_normals;
static Surface surface = {.name = MATERIAL_COUNT,
                          .material = {.ambient = {0.7, 0.7, 0.7},
                                       .diffuse = {0.7, 0.7, 0.7},
                                       .specular = {0.2, 0.2, 0.2},
                                       .alpha = 1,
                                       .shininess = 16}};
static LightColors light_colors = {.diffuse = {1, 1, 1}, .specular = {1, 1, 1}};
static Vec3 global_ambient = {0.2, 0.2, 0.2};
static SceneShading shading = {REFLECTION_PHONG, INTERPOLATION_GOURAUD, VIEWER_INFINITE};

/* The textbook's band is yellow. */
static void shape_changed(const Parameter *parameter)
{
    (void)parameter;
    if (shape == BAND)
        surface.material.ambient = surface.material.diffuse = (Vec3){0.75, 0.75, 0};
}

/* A choice; who draws normals by --normals in other scenes is told the name that this has here. */
static bool read_normals(const Parameter *parameter, const char *text, Message *message)
{
    Parameter choice = *parameter;
    choice.codec = NULL;
    return parameter_read(&choice, text, message) ||
           message_add(message, "; --show-normals on draws them");
}

static bool write_normals(const Parameter *parameter, char *text, size_t size)
{
    Parameter choice = *parameter;
    choice.codec = NULL;
    return parameter_write(&choice, text, size);
}

static const ParameterCodec NORMALS_CODEC = {NULL, read_normals, write_normals};

static const Parameter parameters[] = {
    {"shape", "what is drawn", PARAMETER_CHOICE, .value = &shape, .choices = SHAPES,
     .changed = shape_changed},
    {"normals",
     "of the sphere and the square; the band has both; original: flat as the textbook's demo has "
     "it; --show-normals draws them",
     PARAMETER_CHOICE, .value = &normals, .choices = NORMALS, .codec = &NORMALS_CODEC,
     .fixes = 1U << AXIS_NORMALS},
    {"slices", "around the axis of the sphere, or along the square", PARAMETER_WHOLE,
     .value = &slices, .min = 3, .max = 64, .fixes = 1U << AXIS_DIVISIONS},
    {"stacks", "of the sphere, along its axis", PARAMETER_WHOLE, .value = &stacks, .min = 2,
     .max = 32, .fixes = 1U << AXIS_DIVISIONS},
    {"edges", "draw the edges of the faces", PARAMETER_SWITCH, .value = &edges},
    {"show-normals", "draw the normals as lines", PARAMETER_SWITCH, .value = &show_normals},
    SURFACE_PARAMETERS(surface),
    SHADING_PARAMETERS(shading),
    LIGHT_PARAMETERS(light_colors, global_ambient),
    {.name = NULL},
};

static struct {
    Mesh smooth, flat; /* the same triangles */
    Light light;
    Object objects[2];
} state;

/* The square, with the normals of a sphere that bulges through it. */
static bool open_square(Mesh *mesh, Message *message)
{
    if (!mesh_quad(mesh, slices, message))
        return false;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const Vec3 place = vec3_from_float(mesh->vertices[i].position);
        Vec3 unit;
        const double square = place.x * place.x + place.y * place.y; /* 2 at the corners */
        vec3_normalize((Vec3){place.x, place.y, sqrt(2.05 - square)}, &unit);
        vec3_to_float(unit, mesh->vertices[i].normal);
    }
    return true;
}

/* The band is the half of an open cylinder that is cut into 16. */
static bool open_band(Mesh *mesh, Message *message)
{
    if (!mesh_cylinder(mesh, (MeshCylinder){4, 2.5, 16, 1, MESH_CAP_NONE}, message))
        return false;
    mesh->index_count /= 2;
    return true;
}

static bool open_mesh(Mesh *mesh, Message *message)
{
    return shape == BAND     ? open_band(mesh, message)
           : shape == SQUARE ? open_square(mesh, message)
                             : mesh_sphere(mesh, 4, slices, stacks, message);
}

/* The demo's normals of the flat sphere's faces, whose triangles are in the order of the smooth
 * one's grid: two for each face, but for those at the poles. */
static void slip_normals(const Mesh *smooth, Mesh *flat)
{
    const int corners[] = {slices + 1, 0, slices + 2, 1}; /* from a face's upper left */
    for (size_t i = 0, face = 0, row = (size_t)slices + 1; i < flat->vertex_count; face++) {
        const size_t j = face / (size_t)slices;
        const MeshVertex *corner = smooth->vertices + j * row + face % (size_t)slices;
        Vec3 sum = {0, 0, 0};
        for (int k = 0; k < 4; k++)
            sum = vec3_add(
                sum, vec3_scale(vec3_from_float(corner[corners[k]].normal), k == 3 ? 0.25 : 1));
        sum = vec3_unit(sum);
        for (int k = j == 0 || j == (size_t)stacks - 1 ? 3 : 6; k > 0; k--)
            vec3_to_float(sum, flat->vertices[i++].normal);
    }
}

static bool init(const ShaderLoader *loader, Message *message)
{
    (void)loader;
    if (!open_mesh(&state.smooth, message) || !open_mesh(&state.flat, message) ||
        !mesh_flatten(&state.flat, message))
        return false;
    if (normals == ORIGINAL && shape == SPHERE)
        slip_normals(&state.smooth, &state.flat);
    return true;
}

static Object make_object(bool flat, Mat4 world_from_object)
{
    return (Object){.mesh = flat ? &state.flat : &state.smooth,
                    .flat = flat,
                    .closed = shape == SPHERE,
                    .behind_lines = edges,
                    .world_from_object = world_from_object,
                    .front = surface.material,
                    .two_sided = shape == BAND,
                    .back = surface.material};
}

static void scene(double seconds, int view, Scene *scene)
{
    const Mat4 turned = example_turned(seconds);
    (void)view;
    /* Slices begin at +x. */
    Mat4 world_from_object = mat4_product(turned, mat4_rotate(90, (Vec3){0, 1, 0}));
    if (shape == SQUARE)
        world_from_object = mat4_product(turned, mat4_scale((Vec3){3.5, 3.5, 1}));
    state.objects[0] = make_object(normals != SMOOTH, world_from_object);
    for (int i = 0; i < 2 && shape == BAND; i++) {
        const Mat4 raised = mat4_translate((Vec3){0, i == 0 ? 0.4 : -2.9, 0});
        /* Upright, about its centroid, its inside half hidden by its outside. */
        const Mat4 upright =
            mat4_product(mat4_rotate(-90, (Vec3){1, 0, 0}), mat4_translate((Vec3){0, -2.5, 0}));
        const Mat4 open = mat4_product(mat4_rotate(-50, (Vec3){0, 1, 0}), upright);
        state.objects[i] = make_object(i == 1, mat4_product(raised, mat4_product(turned, open)));
    }
    state.light = (Light){.kind = LIGHT_DIRECTIONAL, .space = LIGHT_EYE, .direction = {0, 0, 1}};
    light_colors_apply(&light_colors, &state.light);
    *scene = (Scene){.camera = example_camera((Vec3){0, 0, 30}, 5),
                     .global_ambient = global_ambient,
                     .lights = &state.light,
                     .light_count = 1,
                     .objects = state.objects,
                     .object_count = shape == BAND ? 2 : 1};
    if (shape == BAND) { /* from above, to see outside and inside; lit so that no two faces beside
                            each other have one shade */
        scene->camera = example_camera((Vec3){0, 9, 28}, 5.5);
        state.light.direction = (Vec3){-0.7, 0.3, 1};
    }
    scene_shading_apply(&shading, scene);
}

static void annotate(double seconds, int view, const Scene *scene, Annotations *annotations)
{
    (void)seconds, (void)view;
    for (int i = 0; i < scene->object_count && edges; i++)
        overlay_add_edges(&annotations->lines, scene->objects[i].mesh,
                          scene->objects[i].world_from_object, (Vec3){0, 0, 0});
    if (show_normals)
        overlay_add_normals(&annotations->lines, scene);
}

static void finish(void)
{
    mesh_close(&state.smooth);
    mesh_close(&state.flat);
}

const Example SmoothFlat = {
    .name = "SmoothFlat",
    .summary = "smooth and flat normals on the same triangles",
    .width = 300,
    .height = 300,
    .tries = {"--slices 3 --stacks 32", "--shape square --orbit 60,20",
              "--normals flat --show-normals on --light-at 0,-0.4,0.7,1"},
    .looks = {"smooth normals hide the edges, but not in the outline",
              "flat, but shaded as if it bulged", "one normal, thus one shade, for each face"},
    .init = init,
    .finish = finish,
    .kind = &SCENE_KIND,
    .content = &(const SceneExample){.make = scene, .annotate = annotate},
    .parameters = parameters,
};
