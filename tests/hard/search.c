#include "hard/search.h"

#include "support/testing.h"

#include <float.h>

enum { STALE = 60, MAX_MESHES = 64 };

/* Errors. */

static void forget_meshes(Search *search)
{
    for (const RandomMesh *made = search->meshes.first; made; made = made->next)
        hard_forget(&made->mesh);
    random_meshes_close(&search->meshes);
}

void search_open(Search *search, int size, unsigned long long seed)
{
    *search = (Search){.random = {seed}, .error = -1};
    hard_open(size, size);
}

void search_close(Search *search)
{
    forget_meshes(search);
    hard_close();
}

/* Whether 24 bits of depth resolve the scene: far away, depth equals the background's, and both
 * sides of a flattened object have the same depth. */
static bool depth_suffices(const RandomScene *scene)
{
    const Camera *camera = &scene->scene.camera;
    if (!(camera->far <= 1e6 * camera->near))
        return false;
    for (int i = 0; i < scene->scene.object_count; i++) {
        const Object *object = &scene->objects[i];
        const double *m = object->world_from_object.m;
        const Vec3 x = {m[0], m[1], m[2]}, y = {m[4], m[5], m[6]}, z = {m[8], m[9], m[10]};
        const double size = vec3_length(x) * vec3_length(y) * vec3_length(z);
        const bool plane = object->solid.kind == SOLID_QUAD || object->solid.kind == SOLID_DISC;
        const Solid *solid = &object->solid;
        if (!plane && !(fabs(vec3_dot(vec3_cross(x, y), z)) > 1e-3 * size))
            return false;
        if ((solid->kind == SOLID_CONE || solid->kind == SOLID_CYLINDER) &&
            !(solid->height > 1e-3 * solid->radius && solid->radius > 1e-3 * solid->height))
            return false;
    }
    return true;
}

/* The effect of floats on a scene: some numbers change by a little more than their rounding, and
 * the picture moves by 1/256 of a pixel, to which drivers round the corners of triangles. `sign` is
 * 1 or -1: of two opposite changes, one crosses a discontinuity near the scene. */
static void perturb(RandomScene *scene, Random *random, double sign, int size)
{
    static const double SMALL = 0x1p-21, RADIANS = 0.017453292519943295;
    Camera *camera = &scene->scene.camera;
    double far = 0; /* the largest distance from the eye */
    for (int i = 0; i < scene->scene.object_count; i++) {
        double *m = scene->objects[i].world_from_object.m;
        const Vec3 place = {m[12] - camera->eye.x, m[13] - camera->eye.y, m[14] - camera->eye.z};
        const MeshBox box = mesh_bounds(scene->objects[i].mesh);
        const double reach = fmax(vec3_length(box.low), vec3_length(box.high));
        double scale = 0;
        for (int k = 0; k < 12; k++)
            scale = fmax(scale, fabs(m[k]));
        far = fmax(far, vec3_length(place) + 2 * scale * reach);
        for (int k = 0; k < 12; k++)
            m[k] += sign * SMALL * scale * random_between(random, -1, 1) * (k % 4 < 3);
        /* There are 24 bits of depth between near and far. */
        const double deep = pow(vec3_length(place), 2) / camera->near * 0x1p-23;
        for (int k = 12; k < 15; k++)
            m[k] += sign * fmax(deep, SMALL * vec3_length(place)) * random_between(random, -1, 1);
    }
    for (int i = 0; i < scene->scene.light_count; i++) {
        Light *light = &scene->lights[i];
        const Light there = scene_world_light(&scene->scene, i);
        const double reach = far + vec3_length(vec3_subtract(there.position, camera->eye));
        Vec3 unit;
        vec3_normalize(light->direction, &unit);
        light->position = vec3_add(light->position,
                                   vec3_scale(hard_random_direction(random), sign * SMALL * reach));
        light->direction = vec3_add(unit, vec3_scale(hard_random_direction(random), sign * SMALL));
        const double cosine = cos(light->cutoff * RADIANS) + sign * SMALL;
        light->cutoff = acos(fmax(0, fmin(1, cosine))) / RADIANS;
    }
    const Vec3 view = vec3_subtract(camera->center, camera->eye);
    const double pixel = 2 * tan(camera->fovy * RADIANS / 2) / size;
    camera->center =
        vec3_add(camera->center, vec3_scale(hard_random_direction(random),
                                            sign * vec3_length(view) * (pixel / 256 + SMALL)));
}

/* The exact picture of the mesh; edges need only be known, not exact. */
static void exact_picture(const RandomScene *scene, Reference *exact)
{
    const ReferenceOptions options = {.width = hard.floats.width,
                                      .height = hard.floats.height,
                                      .meshes = true,
                                      .edge_error = 255,
                                      .threads = 1};
    require(reference_open(exact, &scene->scene, &options, FAILURE), FAILURE);
}

/* Adds to `slack` how far the exact pictures of slightly different scenes differ from the first. */
static bool add_slack(Search *search, const RandomScene *scene, const Reference *exact,
                      float *slack)
{
    enum { PAIRS = 8 };
    const size_t count = 3 * (size_t)exact->width * (size_t)exact->height;
    Random random = {1};
    for (int pair = 0; pair < 2 * PAIRS; pair++) {
        RandomScene other = *scene;
        Reference picture;
        Random same = random;
        random_scene_ready(&other, &search->meshes, NULL);
        perturb(&other, pair % 2 ? &random : &same, pair % 2 ? 1 : -1, exact->height);
        if (!scene_check(&other.scene, NULL))
            return false;
        exact_picture(&other, &picture);
        for (size_t i = 0; i < count; i++)
            slack[i] = fmaxf(slack[i], fabsf(picture.color[i] - exact->color[i]));
        reference_close(&picture);
    }
    return true;
}

/* The largest error of the last picture inside objects, beyond the slack; -1 if there are none. */
static double largest_error(const Reference *exact, const float *slack)
{
    const float *real = hard.real.pixels;
    double max = -1;
    for (size_t i = 0; i < (size_t)exact->width * (size_t)exact->height; i++) {
        for (size_t c = 0; c < 3; c++) {
            const double value = (double)real[4 * i + c];
            if (!isfinite(value))
                return INFINITY;
            if (exact->interior[i])
                max = fmax(max,
                           255 * (fabs(fmax(0, fmin(1, value)) - (double)exact->color[3 * i + c]) -
                                  2 * (double)slack[3 * i + c]));
        }
    }
    return max;
}

double search_error(Search *search, RandomScene *scene, double enough)
{
    Reference exact;
    if (search->meshes.count > MAX_MESHES)
        forget_meshes(search);
    if (!random_scene_ready(scene, &search->meshes, NULL) || !scene_check(&scene->scene, NULL) ||
        !depth_suffices(scene))
        return -1;
    search->judged++;
    exact_picture(scene, &exact);
    require(random_scene_draw(scene, &hard.floats, hard.lightings[search->precision], &hard.real,
                              FAILURE),
            FAILURE);
    float *slack = calloc(3 * (size_t)exact.width * (size_t)exact.height, sizeof *slack);
    assert_non_null(slack);
    double error = largest_error(&exact, slack);
    if (error > enough && error > 0.02 && !isinf(error))
        error = add_slack(search, scene, &exact, slack) ? largest_error(&exact, slack) : -1;
    free(slack);
    reference_close(&exact);
    return error;
}

/* Changes. */

static double special(Random *random, const RandomNumber *number)
{
    const double values[] = {0,      1,       -1,    0.5,   1e-30,   1e30,
                             5e-324, DBL_MIN, 1e-15, 1e-38, FLT_MIN, number->min,
                             90,     128,     1e15,  1e-7,  0x1p-24, number->max};
    return values[random_below(random, sizeof values / sizeof values[0])];
}

static double changed(Random *random, const RandomNumber *number)
{
    const double value = *number->value, size = pow(10, random_between(random, -8, 1));
    switch (random_below(random, 8)) {
    case 0:
        return special(random, number);
    case 1:
        return -value;
    case 2:
        return value * pow(10, random_between(random, -3, 3));
    case 3:
        return value * pow(2, random_below(random, 41) - 20);
    case 4:
        return value + size;
    case 5:
        return value - size;
    default:
        return value * (1 + random_between(random, -1, 1) * size);
    }
}

/* The range of numbers in a scene of a few units. */
static double tamed(double value, const RandomNumber *number)
{
    if (number->min == 0 && number->max == 128 && value > 0 && value < 1)
        return 1;
    if (number->max == 1e30 && value > 0 && value < 1e-3)
        return 1e-3;
    const double max = fmin(number->max, number->max == 1e6 ? 4 : 100);
    const double min = number->min == DBL_MIN ? 1e-3 : fmax(number->min, -100);
    return fmax(min, fmin(max, value));
}

static void change_number(Search *search, RandomScene *scene)
{
    RandomNumber numbers[RANDOM_MAX_NUMBERS];
    const int count = random_scene_numbers(scene, numbers);
    const int i = random_below(&search->random, count);
    double value = changed(&search->random, &numbers[i]);
    if (random_below(&search->random, 12) == 0)
        value = *numbers[random_below(&search->random, count)].value;
    value = fmax(numbers[i].min, fmin(numbers[i].max, value));
    *numbers[i].value = search->tame ? tamed(value, &numbers[i]) : value;
}

/* A corner of a random face or, once in three times, the middle of an edge. */
static Vec3 random_corner(Search *search, const RandomScene *scene, Vec3 *normal)
{
    const Object *object =
        &scene->objects[random_below(&search->random, scene->scene.object_count)];
    const Mesh *mesh = object->mesh;
    const size_t triangle = (size_t)random_below(&search->random, (int)(mesh->index_count / 3));
    const float *p = mesh->vertices[mesh->indices[3 * triangle]].position;
    const float *q = mesh->vertices[mesh->indices[3 * triangle + 1]].position;
    const double share = random_below(&search->random, 3) == 0 ? 0.5 : 0;
    Vec3 corner;
    const Mat4 matrix = mat4_normal(object->world_from_object);
    mesh_face(mesh, triangle, normal);
    vec3_normalize(mat4_transform_direction(matrix, *normal), normal);
    corner.x = (1 - share) * (double)p[0] + share * (double)q[0];
    corner.y = (1 - share) * (double)p[1] + share * (double)q[1];
    corner.z = (1 - share) * (double)p[2] + share * (double)q[2];
    return mat4_transform_point(object->world_from_object, corner);
}

/* Puts two things at exactly the same place, plane or direction. */
static void coincide(Search *search, RandomScene *scene)
{
    Random *random = &search->random;
    Vec3 normal;
    const Vec3 corner = random_corner(search, scene, &normal);
    Camera *camera = &scene->scene.camera;
    Light given = {.off = true}, *light = &given;
    Mat4 eye_from_world, clip_from_eye;
    const Camera before = *camera;
    scene_camera(&before, 1, &eye_from_world, &clip_from_eye, NULL);
    if (scene->scene.light_count > 0) {
        const int number = random_below(random, scene->scene.light_count);
        light = &scene->lights[number];
        given = *light;
        *light = scene_world_light(&scene->scene, number);
    }
    const Vec3 to_eye = vec3_subtract(camera->eye, corner);
    const Vec3 to_light = vec3_subtract(light->position, corner);
    const int way = random_below(random, 10);
    if (way == 0)
        light->position = corner;
    else if (way == 1) /* in the plane of a face */
        light->position =
            vec3_subtract(light->position, vec3_scale(normal, vec3_dot(to_light, normal)));
    else if (way == 2)
        camera->eye = vec3_subtract(camera->eye, vec3_scale(normal, vec3_dot(to_eye, normal)));
    else if (way == 3)
        light->position = camera->eye;
    else if (way == 4)
        light->direction = vec3_subtract(corner, light->position);
    else if (way == 5)
        light->direction = normal;
    else if (way == 6) { /* mirrored at the face, so that the highlight is visible */
        light->direction = vec3_subtract(vec3_scale(normal, 2 * vec3_dot(to_eye, normal)), to_eye);
        light->position = vec3_add(corner, light->direction);
    } else if (way == 7)
        camera->center = corner;
    else if (way == 8) /* towards the light, just in front of it */
        light->position =
            vec3_add(corner, vec3_scale(to_light, pow(10, random_between(random, -8, 0))));
    else { /* a close-up */
        camera->eye = vec3_add(corner, vec3_scale(to_eye, pow(10, random_between(random, -4, 0))));
        camera->center = corner;
    }
    if (given.space == LIGHT_EYE) { /* back to where it was given */
        light->space = LIGHT_EYE;
        light->position = scene_eye_point(&before, eye_from_world, light->position);
        light->direction = mat4_transform_direction(eye_from_world, light->direction);
    }
}

static void change_choice(Search *search, RandomScene *scene)
{
    Random *random = &search->random;
    const int i = random_below(random, scene->scene.object_count);
    const int choice = random_below(random, 4);
    if (choice == 0)
        scene->scene.interpolation = (Interpolation)random_below(random, 4);
    else if (choice == 1)
        scene->scene.reflection = (Reflection)random_below(random, 2);
    else if (choice == 2)
        scene->scene.distant_viewer = !scene->scene.distant_viewer;
    else
        scene->shapes[i].divisions = 3 + random_below(random, 30);
}

bool search_step(Search *search)
{
    Random *random = &search->random;
    search->steps++;
    if (search->error < 0 || search->stale >= STALE) {
        const int kind = random_below(random, 1000000);
        random_scene_make(&search->current, (unsigned long long)kind,
                          (unsigned long long)search->steps);
        search->error = search_error(search, &search->current, 0);
        search->stale = 0;
        search->climbs++;
        return false;
    }
    RandomScene next = search->current;
    random_scene_ready(&next, &search->meshes, NULL);
    if (random_below(random, 50) == 0)
        change_choice(search, &next);
    if (random_below(random, 5) == 0)
        coincide(search, &next);
    for (int i = random_below(random, 4); i >= 0; i--)
        change_number(search, &next);
    const double error = search_error(search, &next, search->error);
    search->stale++;
    if (error > search->error) {
        search->current = next;
        search->error = error;
        search->stale = 0;
    }
    return search->stale >= STALE || isinf(search->error);
}

/* Shrinking. */

/* Keeps a simpler scene if its error is still there. */
static bool take(Search *search, RandomScene *scene, RandomScene simpler, double min)
{
    if (!(search_error(search, &simpler, 0) >= min))
        return false;
    *scene = simpler;
    return true;
}

static bool drop_things(Search *search, RandomScene *scene, double min)
{
    bool any = false;
    for (int i = scene->scene.light_count - 1; i >= 0; i--) {
        RandomScene simpler = *scene;
        for (int k = i; k + 1 < simpler.scene.light_count; k++)
            simpler.lights[k] = simpler.lights[k + 1];
        simpler.scene.light_count--;
        any |= take(search, scene, simpler, min);
    }
    for (int i = scene->scene.object_count - 1; i >= 0 && scene->scene.object_count > 1; i--) {
        RandomScene simpler = *scene;
        for (int k = i; k + 1 < simpler.scene.object_count; k++) {
            simpler.objects[k] = simpler.objects[k + 1];
            simpler.shapes[k] = simpler.shapes[k + 1];
        }
        simpler.scene.object_count--;
        any |= take(search, scene, simpler, min);
    }
    return any;
}

static void drop_choices(Search *search, RandomScene *scene, double min)
{
    for (int i = 0; i < 8 + 2 * scene->scene.object_count; i++) {
        RandomScene simpler = *scene;
        Scene *to = &simpler.scene;
        bool *const flags[] = {&to->linear, &to->show_clipped, &to->clamp_vertex,
                               &to->distant_viewer};
        const int n = i / 2 - 4; /* of an object, from the 8th case on */
        if (i < 4 ? !*flags[i]
                  : (i == 4 && to->interpolation == INTERPOLATION_PHONG) ||
                        (i == 5 && to->reflection == REFLECTION_BLINN_PHONG))
            continue;
        if (i < 4)
            *flags[i] = false;
        else if (i == 4)
            to->interpolation = INTERPOLATION_PHONG;
        else if (i == 5)
            to->reflection = REFLECTION_BLINN_PHONG;
        else if (i == 6)
            for (int k = 0; k < to->object_count; k++)
                simpler.objects[k].two_sided = simpler.objects[k].wrong_normals =
                    simpler.objects[k].clockwise = simpler.shapes[k].colored = false;
        else if (i == 7)
            to->background = (Vec3){0, 0, 0};
        else if (i % 2 == 0)
            simpler.shapes[n] = (RandomShape){.solid = {.kind = SOLID_QUAD}, .divisions = 3};
        else
            simpler.shapes[n].divisions = 3;
        take(search, scene, simpler, min);
    }
}

static bool round_numbers(Search *search, RandomScene *scene, double min)
{
    RandomNumber numbers[RANDOM_MAX_NUMBERS], simpler_numbers[RANDOM_MAX_NUMBERS];
    const int count = random_scene_numbers(scene, numbers);
    bool any = false;
    for (int i = 0; i < count; i++) {
        const double value = *numbers[i].value;
        for (int digits = -1; digits <= 12; digits += digits > 3 ? 3 : 1) {
            char text[40];
            RandomScene simpler = *scene;
            random_scene_numbers(&simpler, simpler_numbers);
            snprintf(text, sizeof text, "%.*g", digits, value);
            const double rounded = digits < 0 ? 0 : digits == 0 ? 1 : strtod(text, NULL);
            if (rounded == value)
                break;
            *simpler_numbers[i].value = rounded;
            if (take(search, scene, simpler, min)) {
                any = true;
                break;
            }
        }
    }
    return any;
}

void search_shrink(Search *search, RandomScene *scene, double min)
{
    for (int pass = 0; pass < 6; pass++) {
        bool any = drop_things(search, scene, min);
        drop_choices(search, scene, min);
        any |= round_numbers(search, scene, min);
        if (!any)
            break;
    }
    random_scene_ready(scene, &search->meshes, NULL);
}
