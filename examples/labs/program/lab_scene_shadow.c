/* Scenes are drawn by lot until no light grazes a face; of 2000 tries without success the best is
 * taken. */
#include "labs/program/lab_scene_parts.h"

#include "labs/program/binding.h"
#include "shapes/mesh_solids.h"

#include <math.h>

/* Its height and half its width, and how deep objects stand in it. */
static const double FLOOR = -0.8, HALF = 2.6, SUNK = 0.05;

/* Of light on an object's faces, unless they face away. */
static const double LEAST_COSINE = 0.4;

Mat4 lab_scene_on_floor(const Mesh *mesh, Mat4 world_from_object)
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

bool lab_scene_add_floor(LabScene *lab_scene, Vec3 color, Message *message)
{
    const int i = lab_scene->scene.object_count;
    if (!mesh_quad(&lab_scene->meshes[i], 1, message))
        return false;
    const Mat4 flat =
        mat4_product(mat4_rotate(-90, (Vec3){1, 0, 0}), mat4_scale((Vec3){HALF, HALF, 1}));
    lab_scene->objects[i] =
        (Object){.mesh = &lab_scene->meshes[i],
                 .flat = true,
                 .world_from_object = mat4_product(mat4_translate((Vec3){0, FLOOR, 0}), flat)};
    set_color(&lab_scene->objects[i], color);
    lab_scene->scene.object_count++;
    return true;
}

/* The least cosine of light on the faces that face it, at their corners. */
static double least_cosine(const LabScene *lab_scene, const Object *object)
{
    const Mat4 normals = binding_normal_matrix(object->world_from_object);
    double least = 1;
    for (size_t v = 0; v < object->mesh->vertex_count; v++) {
        const MeshVertex *vertex = &object->mesh->vertices[v];
        Vec3 normal = mat4_transform_direction(normals, vec3_from_float(vertex->normal));
        Vec3 way = vec3_subtract(
            lab_scene->lights[0].position,
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
    return lab_scene_on_floor(mesh, mat4_product(mat4_translate(at), turned));
}

/* A board that stands on an edge, leans, and faces the light: too large a bias shows behind it. */
static Mat4 choose_board(const LabScene *lab_scene, const Mesh *mesh, Vec3 at, Random *random)
{
    const Vec3 light = lab_scene->lights[0].position;
    const double towards = atan2(light.x - at.x, light.z - at.z) * 180 / acos(-1);
    const double aside = random_signed(random, 5, 25);
    const double lean = random_between(random, 15, 25), width = random_between(random, 0.55, 0.7);
    const Vec3 factors = {width, random_between(random, 0.4, 0.5), 0.02};
    const Mat4 turn = mat4_product(mat4_rotate(towards + aside, (Vec3){0, 1, 0}),
                                   mat4_rotate(-lean, (Vec3){1, 0, 0}));
    return lab_scene_on_floor(
        mesh, mat4_product(mat4_translate(at), mat4_product(turn, mat4_scale(factors))));
}

static bool open_solid(Mesh *mesh, const LabScene *lab_scene, Random *random, Message *message)
{
    const int solid = (int)random_between(random, 0, 2.999);
    if (lab_scene->kind == LAB_SCENE_COARSE || solid == 0)
        return mesh_regular(mesh, MESH_DODECAHEDRON, 1.3, message);
    return solid == 1 ? mesh_regular(mesh, MESH_OCTAHEDRON, 1.4, message)
                      : mesh_cube(mesh, 1, message);
}

static bool add_caster(LabScene *lab_scene, bool board, Vec3 at, Random *random, Message *message)
{
    enum { TRIES = 2000 };
    const int i = lab_scene->scene.object_count;
    Mesh *mesh = &lab_scene->meshes[i];
    Object *object = &lab_scene->objects[i];
    if (board ? !mesh_cube(mesh, 1, message) : !open_solid(mesh, lab_scene, random, message))
        return false;
    *object = (Object){.mesh = mesh, .flat = true, .closed = true};
    if (board)
        object->world_from_object = choose_board(lab_scene, mesh, at, random);
    double best = -1;
    for (int try = 0; try < TRIES && best < LEAST_COSINE && !board; try++) {
        Object tried = *object;
        tried.world_from_object = choose_world(mesh, at, random);
        const double least = least_cosine(lab_scene, &tried);
        if (least > best)
            best = least, *object = tried;
    }
    lab_scene->scene.object_count++;
    return true;
}

/* From the floor's middle. */
static Vec3 choose_towards(LabSceneKind kind, Vec3 view, Random *random)
{
    const Vec3 up = {0, 1, 0};
    const bool behind = kind == LAB_SCENE_BEHIND || kind == LAB_SCENE_AGAINST;
    Vec3 towards;
    /* In C the light is near the eye, as in the other labs. */
    if (kind == LAB_SCENE_ALONG || kind == LAB_SCENE_COARSE)
        return random_near(random, vec3_add(view, (Vec3){0, 0.3, 0}), 5, 15);
    do
        towards = random_near(random, up, 22, 42);
    while (behind && towards.x * view.x + towards.z * view.z > -0.15);
    return towards;
}

bool lab_scene_choose_shadow(LabScene *lab_scene, Random *random, Message *message)
{
    const LabSceneKind kind = lab_scene->kind;
    const bool strong = kind == LAB_SCENE_COARSE, two = kind == LAB_SCENE_CROWD;
    Scene *scene = &lab_scene->scene;
    const Vec3 view = random_near(random, (Vec3){0, 0.9, 1}, 3, 18);
    const Vec3 towards = choose_towards(kind, view, random);
    const double near = kind == LAB_SCENE_WIDE ? 3.4 : two ? 5 : 4.2;
    scene->camera.center = (Vec3){0.05, -0.4, 0.1};
    scene->camera.eye = vec3_add(scene->camera.center, vec3_scale(view, two ? 8 : 7));
    scene->camera.fovy = random_between(random, 27, 31);
    scene->global_ambient = random_color(random, 0.1, 0.25);
    lab_scene->lights[0].position = vec3_scale(towards, near + random_between(random, 0, 0.6));
    lab_scene->lights[0].diffuse = random_color(random, strong ? 0.56 : 0.4, 0.8);
    lab_scene->lights[0].specular = lab_scene->lights[0].diffuse;
    for (int i = 0; i <= two; i++) {
        Vec3 at = {random_between(random, -0.3, 0.3), 0, random_between(random, -0.3, 0.3)};
        /* The second is behind the first and beside it. */
        if (two)
            at = vec3_add(at, i == 0 ? (Vec3){-0.5, 0, 0.5} : (Vec3){0.7, 0, -0.9});
        if (!add_caster(lab_scene, kind == LAB_SCENE_BEHIND || i == 1, at, random, message))
            return false;
        set_color(&lab_scene->objects[i],
                  random_color(random, strong ? 0.25 : 0.35, strong ? 0.5 : 0.95));
    }
    return lab_scene_add_floor(
        lab_scene, random_color(random, strong ? 0.25 : 0.45, strong ? 0.5 : 0.95), message);
}
