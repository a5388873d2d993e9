#include "hard/random_scene.h"

#include "core/mesh_make.h"
#include "shapes/mesh_solids.h"

#include <float.h>
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

bool random_scene_draw(const RandomScene *made, const Canvas *canvas, Lighting *lighting,
                       Image *image, Message *message)
{
    canvas_clear(canvas, made->scene.background, 1);
    return lighting_show(lighting,
                         &(LightingFrame){.scene = &made->scene,
                                          .aspect = (double)canvas->width / canvas->height},
                         message) &&
           canvas_read(canvas, image, message);
}

/* Discontinuities. */

static Vec3 to_vec3(const float v[3])
{
    return (Vec3){(double)v[0], (double)v[1], (double)v[2]};
}

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
            Vec3 normal = to_vec3(vertex->normal);
            if (scene->interpolation == INTERPOLATION_FLAT && !object->flat)
                mesh_face(mesh, k / 3, &normal);
            vec3_normalize(mat4_transform_direction(normal_matrix, normal), &normal);
            const Vec3 place =
                mat4_transform_point(object->world_from_object, to_vec3(vertex->position));
            for (int j = 0; j < scene->light_count; j++) {
                const Light light = scene_world_light(scene, j);
                if (!light.off && light_grazes(&light, object, place, normal))
                    return true;
            }
        }
    }
    return false;
}

/* Numbers. */

typedef struct Numbers {
    RandomNumber *numbers;
    int count;
} Numbers;

static void add(Numbers *to, double *value, double min, double max)
{
    to->numbers[to->count++] = (RandomNumber){value, min, max};
}

static void add_vector(Numbers *to, Vec3 *v, double min, double max)
{
    add(to, &v->x, min, max);
    add(to, &v->y, min, max);
    add(to, &v->z, min, max);
}

static void add_light(Numbers *to, Light *light)
{
    add_vector(to, &light->ambient, 0, 1e6);
    add_vector(to, &light->diffuse, 0, 1e6);
    add_vector(to, &light->specular, 0, 1e6);
    if (light->kind != LIGHT_POINT)
        add_vector(to, &light->direction, -DBL_MAX, DBL_MAX);
    if (light->kind == LIGHT_DIRECTIONAL)
        return;
    add_vector(to, &light->position, -1e15, 1e15);
    add(to, &light->constant, 0, 1e30);
    add(to, &light->linear, 0, 1e30);
    add(to, &light->quadratic, 0, 1e30);
    if (light->kind == LIGHT_POINT)
        return;
    add(to, &light->cutoff, 0, 90);
    add(to, &light->exponent, 0, 128);
}

static void add_material(Numbers *to, Material *material)
{
    add_vector(to, &material->ambient, 0, 1);
    add_vector(to, &material->diffuse, 0, 1);
    add_vector(to, &material->specular, 0, 1);
    add_vector(to, &material->emission, 0, 1);
    add(to, &material->shininess, 0, 128);
}

int random_scene_numbers(RandomScene *made, RandomNumber numbers[RANDOM_MAX_NUMBERS])
{
    Numbers to = {numbers, 0};
    Camera *camera = &made->scene.camera;
    add_vector(&to, &camera->eye, -1e15, 1e15);
    add_vector(&to, &camera->center, -1e15, 1e15);
    add_vector(&to, &camera->up, -1e15, 1e15);
    add(&to, &camera->fovy, DBL_MIN, 180);
    add(&to, &camera->near, DBL_MIN, DBL_MAX);
    add(&to, &camera->far, DBL_MIN, INFINITY);
    add_vector(&to, &made->scene.global_ambient, 0, 1e6);
    for (int i = 0; i < made->scene.light_count; i++)
        add_light(&to, &made->lights[i]);
    for (int i = 0; i < made->scene.object_count; i++) {
        Object *object = &made->objects[i];
        Solid *solid = &made->shapes[i].solid;
        for (int k = 0; k < 15; k++)
            if (k % 4 < 3)
                add(&to, &object->world_from_object.m[k], -DBL_MAX, DBL_MAX);
        add_material(&to, &object->front);
        if (object->two_sided)
            add_material(&to, &object->back);
        if (solid->radius != 0)
            add(&to, &solid->radius, 1e-30, 1e30);
        if (solid->height != 0)
            add(&to, &solid->height, 1e-30, 1e30);
        if (solid->tube != 0)
            add(&to, &solid->tube, 1e-30, 1e30);
    }
    return to.count;
}

/* Text, without what is zero. */

static void print_number(FILE *file, const char *name, double value)
{
    if (isinf(value))
        fprintf(file, "%s = %sINFINITY, ", name, value < 0 ? "-" : "");
    else if (value != 0)
        fprintf(file, "%s = %.17g, ", name, value);
}

static void print_vector(FILE *file, const char *name, Vec3 v)
{
    if (v.x != 0 || v.y != 0 || v.z != 0)
        fprintf(file, "%s = {%.17g, %.17g, %.17g}, ", name, v.x, v.y, v.z);
}

static void print_choice(FILE *file, const char *name, int value, const char *const texts[])
{
    if (value != 0)
        fprintf(file, "%s = %s, ", name, texts[value]);
}

static void print_flag(FILE *file, const char *name, bool value)
{
    if (value)
        fprintf(file, "%s = true, ", name);
}

static void print_light(FILE *file, int number, const Light *light)
{
    static const char *const kinds[] = {"LIGHT_DIRECTIONAL", "LIGHT_POINT", "LIGHT_SPOT"};
    fprintf(file, ".lights[%d] = {", number);
    print_flag(file, ".off", light->off);
    print_flag(file, ".shadows", light->shadows);
    fprintf(file, ".kind = %s, ", kinds[light->kind]);
    fputs(light->space == LIGHT_EYE ? ".space = LIGHT_EYE, " : "", file);
    print_vector(file, ".position", light->position);
    print_vector(file, ".direction", light->direction);
    print_vector(file, ".ambient", light->ambient);
    print_vector(file, ".diffuse", light->diffuse);
    print_vector(file, ".specular", light->specular);
    print_number(file, ".cutoff", light->cutoff);
    print_number(file, ".exponent", light->exponent);
    print_number(file, ".constant", light->constant);
    print_number(file, ".linear", light->linear);
    print_number(file, ".quadratic", light->quadratic);
    fprintf(file, "},\n");
}

static void print_material(FILE *file, const char *name, const Material *material)
{
    fprintf(file, "%s = {", name);
    print_vector(file, ".ambient", material->ambient);
    print_vector(file, ".diffuse", material->diffuse);
    print_vector(file, ".specular", material->specular);
    print_vector(file, ".emission", material->emission);
    fprintf(file, ".alpha = %.17g, ", material->alpha);
    print_number(file, ".shininess", material->shininess);
    fprintf(file, "},\n");
}

static void print_object(FILE *file, int number, const Object *object)
{
    fprintf(file, ".objects[%d] = {.world_from_object = {{", number);
    for (int k = 0; k < 16; k++)
        fprintf(file, "%.17g, ", object->world_from_object.m[k]);
    fprintf(file, "}},\n");
    print_material(file, ".front", &object->front);
    if (object->two_sided) {
        print_flag(file, ".two_sided", true);
        print_material(file, ".back", &object->back);
    }
    print_flag(file, ".wrong_normals", object->wrong_normals);
    print_flag(file, ".clockwise", object->clockwise);
    fprintf(file, "},\n");
}

static void print_shape(FILE *file, int number, const RandomShape *shape)
{
    static const char *const forms[FORM_COUNT] = {"FORM_SOLID",       "FORM_TETRAHEDRON",
                                                  "FORM_OCTAHEDRON",  "FORM_DODECAHEDRON",
                                                  "FORM_ICOSAHEDRON", "FORM_LECTURE_SPHERE"};
    static const char *const kinds[] = {"SOLID_NONE", "SOLID_SPHERE", "SOLID_BOX",
                                        "SOLID_QUAD", "SOLID_DISC",   "SOLID_CYLINDER",
                                        "SOLID_CONE", "SOLID_TORUS",  "SOLID_TEAPOT"};
    static const char *const caps[] = {"MESH_CAP_NONE", "MESH_CAP_BOTTOM", "MESH_CAP_TOP",
                                       "MESH_CAP_BOTH"};
    fprintf(file, ".shapes[%d] = {", number);
    print_choice(file, ".form", (int)shape->form, forms);
    fprintf(file, ".solid = {");
    print_choice(file, ".kind", (int)shape->solid.kind, kinds);
    print_number(file, ".radius", shape->solid.radius);
    print_number(file, ".height", shape->solid.height);
    print_number(file, ".tube", shape->solid.tube);
    print_choice(file, ".caps", (int)shape->solid.caps, caps);
    fprintf(file, "}, .divisions = %d", shape->divisions);
    fputs(shape->colored ? ", .colored = true},\n" : "},\n", file);
}

void random_scene_print(const RandomScene *made, const char *name, FILE *file)
{
    static const char *const interpolations[] = {"INTERPOLATION_PHONG", "INTERPOLATION_GOURAUD",
                                                 "INTERPOLATION_FLAT", "INTERPOLATION_CONSTANT"};
    static const char *const reflections[] = {"REFLECTION_BLINN_PHONG", "REFLECTION_PHONG"};
    const Scene *scene = &made->scene;
    fprintf(file, "static const RandomScene %s = {\n.scene = {.camera = {", name);
    print_vector(file, ".eye", scene->camera.eye);
    print_vector(file, ".center", scene->camera.center);
    print_vector(file, ".up", scene->camera.up);
    print_number(file, ".fovy", scene->camera.fovy);
    print_number(file, ".near", scene->camera.near);
    print_number(file, ".far", scene->camera.far);
    fprintf(file, "},\n");
    print_vector(file, ".background", scene->background);
    print_vector(file, ".global_ambient", scene->global_ambient);
    fprintf(file, ".light_count = %d, .object_count = %d, ", scene->light_count,
            scene->object_count);
    print_choice(file, ".reflection", (int)scene->reflection, reflections);
    print_choice(file, ".interpolation", (int)scene->interpolation, interpolations);
    print_flag(file, ".distant_viewer", scene->distant_viewer);
    print_flag(file, ".clamp_vertex", scene->clamp_vertex);
    print_flag(file, ".linear", scene->linear);
    print_flag(file, ".show_clipped", scene->show_clipped);
    fprintf(file, "},\n");
    for (int i = 0; i < scene->light_count; i++)
        print_light(file, i, &made->lights[i]);
    for (int i = 0; i < scene->object_count; i++)
        print_object(file, i, &made->objects[i]);
    for (int i = 0; i < scene->object_count; i++)
        print_shape(file, i, &made->shapes[i]);
    fprintf(file, "};\n");
}
