#include "hard/judge.h"

#include "support/picture_check.h"

enum { MAX_MESHES = 64 };

static RandomMeshes meshes;

static void forget_meshes(void)
{
    for (const RandomMesh *made = meshes.first; made; made = made->next)
        hard_forget(&made->mesh);
    random_meshes_close(&meshes);
}

void judge_open(int size)
{
    hard_open(size, size);
}

bool judge_ready(RandomScene *scene)
{
    return random_scene_ready(scene, &meshes, NULL);
}

void judge_close(void)
{
    forget_meshes();
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
    SUCCEEDS(reference_open(exact, &scene->scene, &options, message));
}

/* Adds to `slack` how far the exact pictures of slightly different scenes differ from the first. */
static bool add_slack(const RandomScene *scene, const Reference *exact, float *slack)
{
    enum { PAIRS = 8 };
    const size_t count = 3 * (size_t)exact->width * (size_t)exact->height;
    Random random = {1};
    for (int pair = 0; pair < 2 * PAIRS; pair++) {
        RandomScene other = *scene;
        Reference picture;
        Random same = random;
        judge_ready(&other);
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

double judge_error(RandomScene *scene, double enough)
{
    Reference exact;
    if (meshes.count > MAX_MESHES)
        forget_meshes();
    if (!judge_ready(scene) || !scene_check(&scene->scene, NULL) || !depth_suffices(scene))
        return -1;
    exact_picture(scene, &exact);
    picture_draw(&hard.floats, hard.lightings[HARD_HIGHP], &(LightingFrame){.scene = &scene->scene},
                 &hard.real);
    float *slack = calloc(3 * (size_t)exact.width * (size_t)exact.height, sizeof *slack);
    assert_non_null(slack);
    double error = largest_error(&exact, slack);
    if (error > enough && error > 0.02 && !isinf(error))
        error = add_slack(scene, &exact, slack) ? largest_error(&exact, slack) : -1;
    free(slack);
    reference_close(&exact);
    return error;
}
