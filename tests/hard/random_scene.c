#include "hard/random_scene.h"

#include "core/mesh_make.h"
#include "shapes/mesh_solids.h"

#include <math.h>
#include <stdlib.h>

static const double RADIANS = 0.017453292519943295;

/* Scenes. */

static bool chance(Random *random, double probability)
{
    return random_between(random, 0, 1) < probability;
}

static Vec3 vector(Random *random, double min, double max)
{
    const double x = random_between(random, min, max), y = random_between(random, min, max);
    return (Vec3){x, y, random_between(random, min, max)};
}

static Vec3 on_grid(Vec3 v)
{
    return (Vec3){rint(v.x * 0x1p20) * 0x1p-20, rint(v.y * 0x1p20) * 0x1p-20,
                  rint(v.z * 0x1p20) * 0x1p-20};
}

/* The kind decides whether there is one, the numbers give its values. */
static Vec3 color(Random *kind, Random *numbers, double max)
{
    const Vec3 c = vector(numbers, 0, max);
    return chance(kind, 0.2) ? (Vec3){0, 0, 0} : c;
}

static Material random_material(Random *kind, Random *numbers)
{
    const Vec3 ambient = color(kind, numbers, 0.5), diffuse = color(kind, numbers, 1);
    const Vec3 specular = color(kind, numbers, 1), emission = color(kind, numbers, 0.2);
    const double power = pow(2, random_between(numbers, -2, 7));
    return (Material){.ambient = ambient,
                      .diffuse = diffuse,
                      .specular = specular,
                      .emission = chance(kind, 0.3) ? emission : (Vec3){0, 0, 0},
                      .alpha = 1,
                      .shininess = chance(kind, 0.05)  ? 0
                                   : chance(kind, 0.1) ? 128
                                                       : power};
}

static Light random_light(Random *kind, Random *numbers, double max)
{
    Light light = {.off = chance(kind, 0.05),
                   .kind = (LightKind)random_below(kind, 3),
                   .position = on_grid(vector(numbers, -4, 4)),
                   .direction = hard_random_direction(numbers)};
    const Vec3 aim = vector(numbers, -1, 1);
    light.ambient = color(kind, numbers, max / 2);
    light.diffuse = color(kind, numbers, max);
    light.specular = color(kind, numbers, max);
    const double cutoff = random_between(numbers, 5, 60),
                 exponent = random_between(numbers, 0.5, 128);
    const double constant = random_between(numbers, 0.5, 2),
                 linear = random_between(numbers, 0.05, 0.5);
    const double quadratic = random_between(numbers, 0.05, 0.3);
    if (light.kind == LIGHT_SPOT) {
        light.direction = vec3_subtract(aim, light.position);
        light.cutoff = chance(kind, 0.1) ? 90 : cutoff;
        light.exponent = chance(kind, 0.4) ? 0 : exponent;
    }
    if (light.kind != LIGHT_DIRECTIONAL && chance(kind, 0.6)) {
        light.constant = chance(kind, 0.2) ? 0 : constant;
        light.linear = chance(kind, 0.4) ? 0 : linear;
        light.quadratic = chance(kind, 0.4) ? 0 : quadratic;
    }
    return light;
}

static Mat4 random_transform(Random *kind, Random *numbers)
{
    const double size = random_between(numbers, 0.5, 1.1);
    const Vec3 uneven = vector(numbers, 0.4, 1.3), then = vector(numbers, 0.6, 1.2);
    const Vec3 place = on_grid(vector(numbers, -1.2, 1.2));
    const Mat4 turn = mat4_rotate(random_between(numbers, 0, 360), hard_random_direction(numbers));
    const Mat4 other_turn =
        mat4_rotate(random_between(numbers, 0, 360), hard_random_direction(numbers));
    const bool even = chance(kind, 0.5), rigid = even && chance(kind, 0.5);
    const bool mirrored = chance(kind, 0.2), sheared = !even && chance(kind, 0.5);
    Vec3 scale = rigid ? (Vec3){1, 1, 1} : even ? (Vec3){size, size, size} : uneven;
    if (mirrored)
        scale.y = -scale.y;
    Mat4 matrix = mat4_product(turn, mat4_scale(scale));
    if (sheared)
        matrix = mat4_product(mat4_scale(then), mat4_product(other_turn, matrix));
    return mat4_product(mat4_translate(place), matrix);
}

/* Few different shapes, so that meshes are reused. */
static RandomShape random_shape(Random *kind)
{
    static const Solid solids[] = {
        {.kind = SOLID_SPHERE, .radius = 1},
        {.kind = SOLID_BOX, .radius = 0.75},
        {.kind = SOLID_QUAD},
        {.kind = SOLID_DISC, .radius = 1.25},
        {.kind = SOLID_CYLINDER, .radius = 0.75, .height = 1.25, .caps = MESH_CAP_BOTH},
        {.kind = SOLID_CYLINDER, .radius = 0.75, .height = 1.25},
        {.kind = SOLID_CYLINDER, .radius = 0.75, .height = 1.25, .caps = MESH_CAP_TOP},
        {.kind = SOLID_CONE, .radius = 1, .height = 1.5},
        {.kind = SOLID_TORUS, .radius = 1, .tube = 0.375},
        {.kind = SOLID_TEAPOT, .radius = 0.75},
    };
    static const int divisions[] = {5, 12, 24};
    RandomShape shape = {.divisions = divisions[random_below(kind, 3)]};
    if (chance(kind, 0.25)) {
        shape.form = (RandomForm)(1 + random_below(kind, FORM_COUNT - 1));
        shape.solid.radius = 1;
    } else {
        shape.solid = solids[random_below(kind, sizeof solids / sizeof solids[0])];
    }
    return shape;
}

/* The viewer's lights lie about as far from the objects as those of the world. */
static void vary(RandomScene *made, Random *kind)
{
    Scene *scene = &made->scene;
    if (chance(kind, 0.2))
        scene->interpolation = INTERPOLATION_CONSTANT;
    for (int i = 0; i < scene->light_count; i++) {
        if (!chance(kind, 0.25))
            continue;
        made->lights[i].space = LIGHT_EYE;
        made->lights[i].position.z -= 5.5;
    }
    for (int i = 0; i < scene->object_count; i++) {
        made->shapes[i].colored = chance(kind, 0.25);
        made->objects[i].clockwise = chance(kind, 0.15);
    }
}

void random_scene_make(RandomScene *made, unsigned long long kind_seed,
                       unsigned long long number_seed)
{
    Random kind = {kind_seed * 0xD1342543DE82EF95ULL + 1}, more = {~kind.state};
    Random numbers = {kind.state ^ number_seed * 0xAF251AF3B0F025B5ULL};
    *made = (RandomScene){
        .scene = {.reflection = chance(&kind, 0.5) ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG}};
    Scene *scene = &made->scene;
    scene->interpolation =
        chance(&kind, 0.5) ? INTERPOLATION_PHONG : (Interpolation)(1 + random_below(&kind, 2));
    scene->distant_viewer = chance(&kind, 0.3);
    scene->clamp_vertex = chance(&kind, 0.3);
    scene->linear = chance(&kind, 0.3);
    scene->show_clipped = chance(&kind, 0.1);
    scene->light_count = 1 + random_below(&kind, 4);
    scene->object_count = 1 + random_below(&kind, 3);
    scene->background = vector(&numbers, 0, 1);
    scene->global_ambient = color(&kind, &numbers, 0.3);
    const Vec3 from = vec3_scale(hard_random_direction(&numbers), random_between(&numbers, 4.5, 7));
    const Vec3 center = on_grid(vector(&numbers, -0.4, 0.4)), up = hard_random_direction(&numbers);
    scene->camera = (Camera){.eye = on_grid(vec3_add(center, from)),
                             .center = center,
                             .up = up,
                             .fovy = random_between(&numbers, 25, 45),
                             .near = 0.5,
                             .far = 32};
    /* Bright enough to be clamped in some places only. */
    for (int i = 0; i < scene->light_count; i++)
        made->lights[i] = random_light(&kind, &numbers, 0.5 + 1.5 / scene->light_count);
    for (int i = 0; i < scene->object_count; i++) {
        Object *object = &made->objects[i];
        made->shapes[i] = random_shape(&kind);
        object->world_from_object = random_transform(&kind, &numbers);
        object->front = random_material(&kind, &numbers);
        object->back = random_material(&kind, &numbers);
        object->two_sided = chance(&kind, 0.4);
        object->wrong_normals = chance(&kind, 0.05);
    }
    vary(made, &more);
}

/* Meshes. */

static bool same_shape(const RandomShape *a, const RandomShape *b)
{
    return a->form == b->form && a->divisions == b->divisions && a->solid.kind == b->solid.kind &&
           a->solid.radius == b->solid.radius && a->solid.height == b->solid.height &&
           a->solid.tube == b->solid.tube && a->solid.caps == b->solid.caps &&
           a->colored == b->colored;
}

static bool make_uncolored(const RandomShape *shape, Mesh *mesh, Message *message)
{
    switch (shape->form) {
    case FORM_TETRAHEDRON:
    case FORM_OCTAHEDRON:
    case FORM_DODECAHEDRON:
    case FORM_ICOSAHEDRON:
        return mesh_regular(mesh, (MeshRegular)(shape->form - FORM_TETRAHEDRON),
                            shape->solid.radius, message);
    case FORM_LECTURE_SPHERE:
        return mesh_sphere_lecture(mesh, shape->divisions, message);
    default:
        return solid_mesh(&shape->solid, shape->divisions, mesh, message);
    }
}

/* Waves along the normals, beyond 0 and 1 here and there, where they are held. */
static bool make_mesh(const RandomShape *shape, Mesh *mesh, Message *message)
{
    if (!make_uncolored(shape, mesh, message))
        return false;
    if (!shape->colored)
        return true;
    if (!mesh_open_colors(mesh, message)) {
        mesh_close(mesh);
        return false;
    }
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->vertices[i].position, *n = mesh->vertices[i].normal;
        for (int c = 0; c < 3; c++) {
            const double wave =
                0.5 + 0.6 * sin(c + (double)(p[c] - p[(c + 1) % 3]) + 2 * (double)n[c]);
            mesh->colors[i][c] = (float)fmin(fmax(wave, 0), 1);
        }
    }
    return true;
}

static const Mesh *find_mesh(RandomMeshes *meshes, const RandomShape *shape, Message *message)
{
    for (const RandomMesh *have = meshes->first; have; have = have->next)
        if (same_shape(&have->shape, shape))
            return &have->mesh;
    RandomMesh *made = calloc(1, sizeof *made);
    if (!made || !make_mesh(shape, &made->mesh, message)) {
        message_set(message, "random scene: not enough memory");
        free(made);
        return NULL;
    }
    made->shape = *shape;
    made->next = meshes->first;
    meshes->first = made;
    meshes->count++;
    return &made->mesh;
}

void random_meshes_close(RandomMeshes *meshes)
{
    while (meshes->first) {
        RandomMesh *made = meshes->first;
        meshes->first = made->next;
        mesh_close(&made->mesh);
        free(made);
    }
    meshes->count = 0;
}

static bool shape_closed(const RandomShape *shape)
{
    switch (shape->solid.kind) {
    case SOLID_QUAD:
    case SOLID_DISC:
    case SOLID_TEAPOT:
        return false;
    case SOLID_CYLINDER:
        return shape->solid.caps == MESH_CAP_BOTH;
    default:
        return true;
    }
}

bool random_scene_ready(RandomScene *made, RandomMeshes *meshes, Message *message)
{
    made->scene.lights = made->lights;
    made->scene.objects = made->objects;
    for (int i = 0; i < made->scene.object_count; i++) {
        const RandomShape *shape = &made->shapes[i];
        Object *object = &made->objects[i];
        object->mesh = find_mesh(meshes, shape, message);
        if (!object->mesh)
            return false;
        object->solid = shape->form == FORM_SOLID ? shape->solid : (Solid){.kind = SOLID_NONE};
        object->flat = shape->form == FORM_SOLID ? solid_flat(&shape->solid)
                                                 : shape->form != FORM_LECTURE_SPHERE;
        object->closed = shape_closed(shape);
    }
    return true;
}

/* Discontinuities. */

static bool black(Vec3 a, Vec3 b)
{
    return a.x * b.x == 0 && a.y * b.y == 0 && a.z * b.z == 0;
}

static bool light_grazes(const Light *light, const Object *object, Vec3 place, Vec3 normal)
{
    /* A cosine of floats has an error of a few parts in 1e7, if the direction is not a difference
     * of much longer vectors. */
    static const double NEAR = 1e-5;
    Vec3 to_light, axis;
    const bool highlight = !black(light->specular, object->front.specular) ||
                           (object->two_sided && !black(light->specular, object->back.specular));
    vec3_normalize(light->kind == LIGHT_DIRECTIONAL ? light->direction
                                                    : vec3_subtract(light->position, place),
                   &to_light);
    if (highlight && fabs(vec3_dot(normal, to_light)) < NEAR)
        return true;
    if (light->kind != LIGHT_SPOT)
        return false;
    vec3_normalize(light->direction, &axis);
    return fabs(vec3_dot(axis, to_light) + cos(light->cutoff * RADIANS)) < NEAR;
}

bool random_scene_grazes(const RandomScene *made)
{
    const Scene *scene = &made->scene;
    for (int i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        const Mesh *mesh = object->mesh;
        Mat4 normal_matrix = object->world_from_object;
        if (!object->wrong_normals)
            normal_matrix = mat4_normal(object->world_from_object);
        for (size_t k = 0; k < mesh->index_count; k++) {
            const MeshVertex *vertex = &mesh->vertices[mesh->indices[k]];
            Vec3 normal = vec3_from_float(vertex->normal);
            if (scene->interpolation == INTERPOLATION_FLAT && !object->flat)
                mesh_face(mesh, k / 3, &normal);
            vec3_normalize(mat4_transform_direction(normal_matrix, normal), &normal);
            const Vec3 place =
                mat4_transform_point(object->world_from_object, vec3_from_float(vertex->position));
            for (int j = 0; j < scene->light_count; j++) {
                const Light light = scene_world_light(scene, j);
                if (!light.off && light_grazes(&light, object, place, normal))
                    return true;
            }
        }
    }
    return false;
}
