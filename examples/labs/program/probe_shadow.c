/* Scenes are drawn by lot until no light grazes a face; of 2000 tries without success the best is
 * taken. */
#include "labs/program/probe_shadow.h"

#include "labs/program/binding.h"
#include "labs/program/probe_random.h"
#include "shapes/mesh_solids.h"

#include <math.h>

/* Its height and half its width, and how deep objects stand in it. */
static const double FLOOR = -0.8, HALF = 2.6, SUNK = 0.05;

/* Of light on an object's faces, unless they face away. */
static const double LEAST_COSINE = 0.4;

Mat4 probe_on_floor(const Mesh *mesh, Mat4 world_from_object)
{
    double lowest = HUGE_VAL;
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        const Vec3 at = vec3_from_float(mesh->vertices[v].position);
        lowest = fmin(lowest, mat4_transform_point(world_from_object, at).y);
    }
    return mat4_product(mat4_translate((Vec3){0, FLOOR - SUNK - lowest, 0}), world_from_object);
}

static void set_color(Object *object, Vec3 color)
{
    object->front = object->back = (Material){.ambient = color, .diffuse = color, .alpha = 1};
}

bool probe_add_floor(Probe *probe, Vec3 color, Message *message)
{
    const int i = probe->scene.object_count;
    if (!mesh_quad(&probe->meshes[i], 1, message))
        return false;
    const Mat4 flat =
        mat4_product(mat4_rotate(-90, (Vec3){1, 0, 0}), mat4_scale((Vec3){HALF, HALF, 1}));
    probe->objects[i] =
        (Object){.mesh = &probe->meshes[i],
                 .flat = true,
                 .world_from_object = mat4_product(mat4_translate((Vec3){0, FLOOR, 0}), flat)};
    set_color(&probe->objects[i], color);
    probe->scene.object_count++;
    return true;
}

/* The least cosine of light on the faces that face it, at their corners. */
static double least_cosine(const Probe *probe, const Object *object)
{
    const Mat4 normals = binding_normal_matrix(object->world_from_object);
    double least = 1;
    for (size_t v = 0; v < object->mesh->vertex_count; v++) {
        const MeshVertex *vertex = &object->mesh->vertices[v];
        Vec3 normal = mat4_transform_direction(normals, vec3_from_float(vertex->normal));
        Vec3 way = vec3_subtract(
            probe->lights[0].position,
            mat4_transform_point(object->world_from_object, vec3_from_float(vertex->position)));
        vec3_normalize(normal, &normal);
        vec3_normalize(way, &way);
        const double cosine = vec3_dot(normal, way);
        least = cosine > 0 && cosine < least ? cosine : least;
    }
    return least;
}

static Mat4 choose_world(const Mesh *mesh, Vec3 at, Random *random)
{
    const Vec3 axis = random_direction(random);
    const double degrees = random_signed(random, 35, 145);
    const double first = random_between(random, 0.35, 0.5);
    const double second = random_between(random, 0.7, 0.85);
    const double third = random_between(random, 0.5, 0.7);
    const Vec3 factors =
        random_chance(random) ? (Vec3){first, second, third} : (Vec3){third, first, second};
    const Mat4 turned = mat4_product(mat4_rotate(degrees, axis), mat4_scale(factors));
    return probe_on_floor(mesh, mat4_product(mat4_translate(at), turned));
}

/* A board that stands on an edge, leans, and faces the light: too large a bias shows behind it. */
static Mat4 choose_board(const Probe *probe, const Mesh *mesh, Vec3 at, Random *random)
{
    const Vec3 light = probe->lights[0].position;
    const double towards = atan2(light.x - at.x, light.z - at.z) * 180 / acos(-1);
    const double aside = random_signed(random, 5, 25);
    const double lean = random_between(random, 15, 25), width = random_between(random, 0.55, 0.7);
    const Vec3 factors = {width, random_between(random, 0.4, 0.5), 0.02};
    const Mat4 turn = mat4_product(mat4_rotate(towards + aside, (Vec3){0, 1, 0}),
                                   mat4_rotate(-lean, (Vec3){1, 0, 0}));
    return probe_on_floor(
        mesh, mat4_product(mat4_translate(at), mat4_product(turn, mat4_scale(factors))));
}

static bool open_solid(Mesh *mesh, const Probe *probe, Random *random, Message *message)
{
    const int solid = (int)random_between(random, 0, 2.999);
    if (probe->kind == PROBE_COARSE || solid == 0)
        return mesh_regular(mesh, MESH_DODECAHEDRON, 1.3, message);
    return solid == 1 ? mesh_regular(mesh, MESH_OCTAHEDRON, 1.4, message)
                      : mesh_cube(mesh, 1, message);
}

static bool add_caster(Probe *probe, bool board, Vec3 at, Random *random, Message *message)
{
    enum { TRIES = 2000 };
    const int i = probe->scene.object_count;
    Mesh *mesh = &probe->meshes[i];
    Object *object = &probe->objects[i];
    if (board ? !mesh_cube(mesh, 1, message) : !open_solid(mesh, probe, random, message))
        return false;
    *object = (Object){.mesh = mesh, .flat = true, .closed = true};
    if (board)
        object->world_from_object = choose_board(probe, mesh, at, random);
    double best = -1;
    for (int try = 0; try < TRIES && best < LEAST_COSINE && !board; try++) {
        Object tried = *object;
        tried.world_from_object = choose_world(mesh, at, random);
        const double least = least_cosine(probe, &tried);
        if (least > best)
            best = least, *object = tried;
    }
    probe->scene.object_count++;
    return true;
}

/* From the floor's middle. */
static Vec3 choose_towards(ProbeKind kind, Vec3 view, Random *random)
{
    const Vec3 up = {0, 1, 0};
    const bool behind = kind == PROBE_BEHIND || kind == PROBE_AGAINST;
    Vec3 towards;
    /* In C the light is near the eye, as in the other labs. */
    if (kind == PROBE_ALONG || kind == PROBE_COARSE)
        return random_near(random, vec3_add(view, (Vec3){0, 0.3, 0}), 5, 15);
    do
        towards = random_near(random, up, 22, 42);
    while (behind && towards.x * view.x + towards.z * view.z > -0.15);
    return towards;
}

bool probe_choose_shadow(Probe *probe, Random *random, Message *message)
{
    const ProbeKind kind = probe->kind;
    const bool strong = kind == PROBE_COARSE, two = kind == PROBE_CROWD;
    Scene *scene = &probe->scene;
    const Vec3 view = random_near(random, (Vec3){0, 0.9, 1}, 3, 18);
    const Vec3 towards = choose_towards(kind, view, random);
    const double near = kind == PROBE_WIDE ? 3.4 : two ? 5 : 4.2;
    scene->camera.center = (Vec3){0.05, -0.4, 0.1};
    scene->camera.eye = vec3_add(scene->camera.center, vec3_scale(view, two ? 8 : 7));
    scene->camera.fovy = random_between(random, 27, 31);
    scene->global_ambient = random_color(random, 0.1, 0.25);
    probe->lights[0].position = vec3_scale(towards, near + random_between(random, 0, 0.6));
    probe->lights[0].diffuse = random_color(random, strong ? 0.56 : 0.4, 0.8);
    probe->lights[0].specular = probe->lights[0].diffuse;
    for (int i = 0; i <= two; i++) {
        Vec3 at = {random_between(random, -0.3, 0.3), 0, random_between(random, -0.3, 0.3)};
        /* The second is behind the first and beside it. */
        if (two)
            at = vec3_add(at, i == 0 ? (Vec3){-0.5, 0, 0.5} : (Vec3){0.7, 0, -0.9});
        if (!add_caster(probe, kind == PROBE_BEHIND || i == 1, at, random, message))
            return false;
        set_color(&probe->objects[i],
                  random_color(random, strong ? 0.25 : 0.35, strong ? 0.5 : 0.95));
    }
    return probe_add_floor(probe, random_color(random, strong ? 0.25 : 0.45, strong ? 0.5 : 0.95),
                           message);
}
