/*
 * Scenes that were wrong once, found by a search and shrunk, each with its cause and a bound that
 * follows from it; then random scenes in which things coincide exactly: lights, eye, corners.
 * HARD_SEED in the environment chooses others.
 */
#include "hard/random_scene.h"
#include "support/picture_check.h"
#include "support/testing.h"

enum { SIZE = 24 };

/* R.V is negative on the whole face and the shininess is nearly 0. The exact highlight is 0; the
 * shaders computed pow(max(cosine, 1e-37), s), which is 0.43 for s = 0.01: an error of 109 steps.
 * Fixed: a cosine of 0 or less has a branch of its own. */
static const RandomScene SHININESS_NEXT_TO_0 = {
    .scene = {.camera = {.eye = {0, 0, 3}, .up = {0, 1, 0}, .fovy = 30, .near = 1, .far = 30},
              .light_count = 1,
              .object_count = 1,
              .reflection = REFLECTION_PHONG},
    .lights[0] = {.kind = LIGHT_POINT, .position = {3, 0, 0.5}, .specular = {0, 0, 1}},
    .objects[0] = {.world_from_object = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                   .front = {.specular = {0, 0, 1}, .alpha = 1, .shininess = 0.01}},
    .shapes[0] = {.solid = {.kind = SOLID_QUAD}, .divisions = 3},
};

/* The same with a strong light: a constant attenuation below 1 makes it 12.5 times 4 as strong, and
 * 50 * 1e-37^0.1 is 0.01, 2.5 steps. Fixed by the same branch. */
static const RandomScene STRONG_LIGHT_ASIDE = {
    .scene = {.camera = {.eye = {0, -2, 1}, .up = {0, 0, 1}, .fovy = 1, .near = 0.5, .far = 1},
              .light_count = 1,
              .object_count = 1},
    .lights[0] = {.kind = LIGHT_POINT, .specular = {0, 4, 0}, .constant = 0.08},
    .objects[0] = {.world_from_object = {{1, 0, 0, 0, 0, -0.8, -0.7, 0, 0, 0, 0, 0, 0, -1, 1, 1}},
                   .front = {.specular = {0, 1, 0}, .alpha = 1, .shininess = 0.1}},
    .shapes[0] = {.solid = {.kind = SOLID_QUAD}, .divisions = 3},
};

/* A constant attenuation is part of the colors. 1 / 2e-308 is infinite as a float, and infinity
 * times 0 is NaN. */
static const RandomScene MIN_CONSTANT_ATTENUATION = {
    .scene = {.camera = {.eye = {0, 0, 1}, .up = {0, 1, 0}, .fovy = 1, .near = 0.5, .far = 30},
              .light_count = 1,
              .object_count = 1},
    .lights[0] = {.kind = LIGHT_SPOT,
                  .direction = {0, 0, 1},
                  .specular = {0, 0, 1},
                  .constant = 2e-308},
    .objects[0] = {.world_from_object = {{0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}},
                   .front = {.specular = {0, 0, 1}, .alpha = 1}},
    .shapes[0] = {.solid = {.kind = SOLID_QUAD}, .divisions = 3},
};

/* A matrix that moves corners to 1e30, whose square overflows a float. */
static const RandomScene CORNERS_TOO_FAR_AWAY = {
    .scene = {.camera = {.eye = {0, 1, 0}, .up = {1, 0, 0}, .fovy = 1, .near = 0.5, .far = 1},
              .light_count = 1,
              .object_count = 1},
    .lights[0] = {.kind = LIGHT_POINT, .diffuse = {0, 0, 1}, .constant = 1, .quadratic = 1},
    .objects[0] = {.world_from_object = {{0, 0, 1, 0, 1e30, 0, 0, 0, 0, 0, 0, 0, 0, 0.5, 0, 1}},
                   .front = {.diffuse = {0, 0, 1}, .alpha = 1}},
    .shapes[0] = {.solid = {.kind = SOLID_QUAD}, .divisions = 3},
};

/* The farthest corners allowed. The driver clips such a triangle at the sides of the view in
 * floats, whose steps are 6e7 there, so where it is cut is unspecified. Only finite values are
 * required. */
static const RandomScene CORNERS_FAR_AWAY = {
    .scene = {.camera = {.eye = {0, 0, 1}, .up = {0, 1, 0}, .fovy = 30, .near = 1, .far = 30},
              .background = {0.8, 0.05, 0.65},
              .light_count = 0,
              .object_count = 1},
    .objects[0] = {.world_from_object = {{0, 0, 1e15, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 1, 0, 1}},
                   .front = {.alpha = 1}},
    .shapes[0] = {.solid = {.kind = SOLID_QUAD}, .divisions = 3},
};

/* One light computed at the vertices and one at the fragments, both specular: both shaders have the
 * uniform of the shininess. mediump gave it two precisions, and the program did not link. */
static const RandomScene SHININESS_IN_BOTH_SHADERS = {
    .scene = {.camera = {.eye = {0, 0, 4}, .up = {0, 1, 0}, .fovy = 40, .near = 1, .far = 10},
              .light_count = 2,
              .object_count = 1,
              .distant_viewer = true},
    .lights[0] = {.kind = LIGHT_DIRECTIONAL, .direction = {0, 0, 1}, .specular = {1, 0, 0}},
    .lights[1] = {.kind = LIGHT_POINT, .position = {0, 0, 2}, .specular = {0, 1, 0}},
    .objects[0] = {.world_from_object = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                   .front = {.specular = {0.9, 0.9, 0.9}, .alpha = 1, .shininess = 8}},
    .shapes[0] = {.solid = {.kind = SOLID_QUAD}, .divisions = 3},
};

typedef struct Found {
    const char *name;
    const RandomScene *scene;
    double max; /* steps of 1/255, beyond the allowance for rounding; see judge_error */
} Found;

static const Found FOUND_SCENES[] = {
    {"SHININESS_NEXT_TO_0", &SHININESS_NEXT_TO_0, 0.1},
    {"STRONG_LIGHT_ASIDE", &STRONG_LIGHT_ASIDE, 0.1},
    {"CORNERS_FAR_AWAY", &CORNERS_FAR_AWAY, 255},
    {"CORNERS_TOO_FAR_AWAY", &CORNERS_TOO_FAR_AWAY, 255},
    {"MIN_CONSTANT_ATTENUATION", &MIN_CONSTANT_ATTENUATION, 0.1},
    {"SHININESS_IN_BOTH_SHADERS", &SHININESS_IN_BOTH_SHADERS, 0.1},
};

enum { MAX_MESHES = 64 };

static RandomMeshes meshes;

static void forget_meshes(void)
{
    for (const RandomMesh *made = meshes.first; made; made = made->next)
        hard_forget(&made->mesh);
    random_meshes_close(&meshes);
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
        random_scene_ready(&other, &meshes, NULL);
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
    for (size_t i = 0; i < (size_t)exact->width * (size_t)exact->height; i++)
        for (size_t c = 0; c < 3; c++) {
            const double value = (double)real[4 * i + c];
            if (!isfinite(value))
                return INFINITY;
            if (exact->interior[i])
                max = fmax(max,
                           255 * (fabs(fmax(0, fmin(1, value)) - (double)exact->color[3 * i + c]) -
                                  2 * (double)slack[3 * i + c]));
        }
    return max;
}

/* The largest error inside the objects of a float picture, in steps of 1/255, beyond twice the
 * effect of changing the scene's numbers in the 7th digit; INFINITY if a value is not finite. If
 * the error cannot be more than `enough`, without that allowance. -1 if a scene is not judged: it
 * is invalid, shows nothing, or needs more bits of depth than there are. */
static double judge_error(RandomScene *scene, double enough)
{
    Reference exact;
    if (meshes.count > MAX_MESHES)
        forget_meshes();
    if (!random_scene_ready(scene, &meshes, NULL) || !scene_check(&scene->scene, NULL) ||
        !depth_suffices(scene))
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

FIXTURE(open_all)
{
    hard_open(SIZE, SIZE);
}

FIXTURE(close_all)
{
    forget_meshes();
    hard_close();
}

TEST(found_scenes_stay_within_their_bounds)
{
    for (size_t i = 0; i < sizeof FOUND_SCENES / sizeof FOUND_SCENES[0]; i++) {
        const Found *found = &FOUND_SCENES[i];
        RandomScene scene = *found->scene;
        const double error = judge_error(&scene, 0);
        const bool refused = !scene_check(&scene.scene, NULL);
        const bool right = refused || (error >= 0 && error <= found->max);
        print_message("%s: %.3g steps, of %g\n", found->name, error, found->max);
        if (!right)
            fail_msg("%s: %g steps, of %g", found->name, error, found->max);
    }
}

/* In mediump only that the program links. */
TEST(shininess_in_both_shaders_links)
{
    RandomScene scene = SHININESS_IN_BOTH_SHADERS;
    assert_true(random_scene_ready(&scene, &meshes, NULL));
    for (int i = 0; i < 2; i++)
        picture_draw(&hard.floats, hard.lightings[i], &(LightingFrame){.scene = &scene.scene},
                     &hard.real);
}

/* A corner of a random face or, once in three times, the middle of an edge. */
static Vec3 random_corner(Random *random, const RandomScene *scene, Vec3 *normal)
{
    const Object *object = &scene->objects[random_below(random, scene->scene.object_count)];
    const Mesh *mesh = object->mesh;
    const size_t triangle = (size_t)random_below(random, (int)(mesh->index_count / 3));
    const float *p = mesh->vertices[mesh->indices[3 * triangle]].position;
    const float *q = mesh->vertices[mesh->indices[3 * triangle + 1]].position;
    const double share = random_below(random, 3) == 0 ? 0.5 : 0;
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
static void coincide(Random *random, RandomScene *scene)
{
    Vec3 normal;
    const Vec3 corner = random_corner(random, scene, &normal);
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
    if (way < 2 || way == 8) /* what it touches throws one */
        light->shadows = !scene->scene.clamp_vertex;
}

/* The judge can fail: a light a quarter to one side is far off. */
static Vec3 wrong_point(const Camera *camera, Mat4 eye_from_world, Vec3 point_world)
{
    return vec3_add(scene_eye_point(camera, eye_from_world, point_world), (Vec3){0.25, 0, 0});
}

static Mat4 clip_from_object(Mat4 clip_from_eye, Mat4 eye_from_world, Mat4 world_from_object,
                             Mat4 eye_from_object)
{
    (void)eye_from_world, (void)world_from_object;
    return mat4_product(clip_from_eye, eye_from_object);
}

TEST(a_light_elsewhere_is_an_error)
{
    static const LightingTransforms wrong = {scene_eye_from_object, wrong_point, clip_from_object};
    RandomScene scene = SHININESS_NEXT_TO_0;
    scene.lights[0] = (Light){.kind = LIGHT_POINT, .position = {1, 1, 1}, .diffuse = {1, 1, 1}};
    scene.objects[0].front.diffuse = (Vec3){0.8, 0.8, 0.8};
    assert_true(judge_error(&scene, 0) < 0.1);
    lighting_use_transforms(hard.lightings[HARD_HIGHP], &wrong);
    assert_true(judge_error(&scene, 0) > 8);
    lighting_use_transforms(hard.lightings[HARD_HIGHP], NULL);
}

/* Of each scene also some in which up to three things coincide. They share its programs, because
 * compiling one costs more than many pictures. */
TEST(coincidences_are_drawn_right)
{
    enum { SCENES = 240, VARIATIONS = 6 };
    const char *given = getenv("HARD_SEED");
    const unsigned long long seed = given ? strtoull(given, NULL, 10) : 1;
    double worst = 0;
    int judged = 0;
    for (int i = 0; i < testing_part(SCENES, 30); i++) {
        Random random = {seed + (unsigned)i};
        RandomScene scene;
        random_scene_make(&scene, random.state, seed);
        assert_true(random_scene_ready(&scene, &meshes, NULL));
        for (int k = 0; k < VARIATIONS; k++) {
            RandomScene varied = scene;
            assert_true(random_scene_ready(&varied, &meshes, NULL));
            for (int n = random_below(&random, 4); n > 0; n--)
                coincide(&random, &varied);
            const double error = judge_error(&varied, 0.5);
            if (error > 0.5)
                fail_msg("seed %llu, scene %d, variation %d: wrong by %g steps", seed, i, k, error);
            worst = fmax(worst, error);
            judged += error >= 0;
        }
    }
    print_message("HARD_SEED=%llu: %d scenes, at most %.3g steps of 1/255\n", seed, judged, worst);
    assert_true(judged > VARIATIONS);
}

PICTURE_TEST_MAIN("found", open_all, close_all)
