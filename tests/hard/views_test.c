/*
 * Hard cases of views and projections: cameras that look nowhere, or nearly so, projections out of
 * range or without a far plane, surfaces close behind one another, and scenes far from the origin.
 * First what the functions answer, then what reaches the screen. LIGHTING_TEST_SEED in the
 * environment replaces the seed.
 */
#include "hard.h"
#include "picture_check.h"

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 64, SLICES = 48 };

static const double infinity = (double)INFINITY, not_a_number = (double)NAN;
static unsigned long long seed = 20240607;
static Hard hard;
static Mesh sphere, quad;

/* Scenes: a sphere on a square, a point light and a directional one. */

typedef struct World {
    Light lights[2];
    Object objects[2];
    Scene scene;
} World;

enum { SHININESS = 8 };
static const double DIFFUSE = 0.5, SPECULAR = 0.3; /* of the point light */

/* Points the scene at its own lights and objects: a copy's are elsewhere. */
static void settle(World *world)
{
    world->scene.lights = world->lights;
    world->scene.objects = world->objects;
}

static void make_world(World *world)
{
    Mat4 lying, tilted;
    mat4_rotate(-90, (Vec3){1, 0, 0}, &lying);
    mat4_rotate(33, (Vec3){1, 2, 3}, &tilted);
    *world = (World){
        .lights = {{.kind = LIGHT_POINT,
                    .position = {2, 3, 4},
                    .diffuse = {DIFFUSE, DIFFUSE, DIFFUSE},
                    .specular = {SPECULAR, SPECULAR, SPECULAR}},
                   {.kind = LIGHT_DIRECTIONAL, .direction = {-1, 1, 1}, .diffuse = {0.2, 0.1, 0}}},
        .objects = {{.mesh = &sphere,
                     .closed = true,
                     .world_from_object = mat4_product(tilted, mat4_scale((Vec3){0.5, 0.9, 0.75})),
                     .front = {.ambient = {1, 0.8, 0.6},
                               .diffuse = {1, 0.9, 0.5},
                               .specular = {1, 1, 1},
                               .alpha = 1,
                               .shininess = SHININESS}},
                    {.mesh = &quad,
                     .flat = true,
                     .world_from_object = mat4_product(mat4_translate((Vec3){0, -0.75, 0}), lying),
                     .front = {.ambient = {1, 0.8, 0.6},
                               .diffuse = {0.4, 0.6, 1},
                               .specular = {0.5, 0.5, 0.5},
                               .alpha = 1,
                               .shininess = SHININESS}}},
        .scene = {.camera = {{0, 2, 4}, {0, 0, 0}, {0, 1, 0}, 35, 1, 20},
                  .background = {0.2, 0.4, 0.6},
                  .global_ambient = {0.2, 0.2, 0.2},
                  .light_count = 2,
                  .object_count = 2},
    };
    settle(world);
}

/*
 * How far an interior pixel may be from the exact picture.
 *
 * highp: half a step of rounding, and floats.
 *
 * mediump: half precision, u = 2^-11. Lit at the fragments, each worst error in units of u: N 4.5
 * (the varying 1, its length 2.5, the product 1); L 7.5 (positions of at most 6, the light at least
 * 4 away: 4; made unit 3.5); V 4.5; so N.L 15 with its own sum, H (7.5 + 4.5) / 1.4 + 4.5 = 13.1,
 * N.H 20.6, its power s times that and 4; the directional light less than 2, sums of colours 4. Lit
 * at the vertices in highp: the varying and a copy, 2 u. Each plus half a step.
 */
static double bound(const Scene *scene, HardPrecision precision)
{
    const double u = 0x1p-11;
    if (precision == HARD_HIGHP)
        return 1;
    if (scene->interpolation != INTERPOLATION_PHONG)
        return 255 * 2 * u + 0.5;
    return 255 * u * (15 * DIFFUSE + (20.6 * SHININESS + 4) * SPECULAR + 2 + 4) + 0.5;
}

static void check_exact(const char *name, const Scene *scene, HardPrecision precision,
                        const Reference *exact)
{
    const HardResult result = hard_draw(&hard, scene, precision, exact);
    const double most = bound(scene, precision);
    if (result.not_finite || result.byte_error > most || result.interior_pixels < 100)
        fail_msg("%s, %s, lit at %s: largest error %.3f of %.3f at (%d, %d), %d pixels inside, "
                 "%lld values not finite",
                 name, precision == HARD_HIGHP ? "highp" : "mediump",
                 scene->interpolation == INTERPOLATION_PHONG ? "fragments" : "vertices",
                 result.byte_error, most, result.x, result.y, result.interior_pixels,
                 result.not_finite);
}

/* Lit at fragments and at vertices, in either precision. */
static void check_each_way(const char *name, World *world)
{
    static const Interpolation ways[] = {INTERPOLATION_PHONG, INTERPOLATION_GOURAUD};
    for (int way = 0; way < 2; way++) {
        Reference exact;
        world->scene.interpolation = ways[way];
        hard_exact(&hard, &world->scene, false, &exact);
        check_exact(name, &world->scene, HARD_HIGHP, &exact);
        check_exact(name, &world->scene, HARD_MEDIUMP, &exact);
        reference_close(&exact);
    }
}

typedef unsigned char Frame[SIZE * SIZE * 4];

/* The picture that was drawn last. */
static void keep_frame(Frame frame)
{
    memcpy(frame, hard.image.pixels, sizeof(Frame));
}

/* How far two frames are apart at most in pixels that are inside objects, and in how many others
 * they differ by more than a step. */
static int apart(const Frame a, const Frame b, const Reference *exact, int *edges)
{
    int most = 0;
    *edges = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        int steps = 0;
        for (int c = 0; c < 4; c++)
            steps = (int)fmax(steps, abs(a[4 * i + c] - b[4 * i + c]));
        if (exact->interior[i])
            most = (int)fmax(most, steps);
        else
            *edges += steps > 1;
    }
    return most;
}

/* Look-at, degenerate. */

/* || R R^T - I ||, Frobenius; the sums are of numbers below 1, so their own rounding is below
 * 1e-15. */
static double orthonormality_error(Mat4 r)
{
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            double dot = i == j ? -1 : 0;
            for (int k = 0; k < 3; k++)
                dot = fma(r.m[4 * k + i], r.m[4 * k + j], dot);
            sum += dot * dot;
        }
    }
    return sqrt(sum);
}

static void look_at_degenerate_is_rigid_all_the_same(void **state)
{
    (void)state;
    HardRandom random = {seed};
    for (int i = 0; i < 1000; i++) {
        const Vec3 eye = hard_random_direction(&random), view = hard_random_direction(&random);
        const Vec3 center = vec3_add(eye, view), along = vec3_subtract(center, eye);
        const Vec3 ups[] = {{0, 0, 0}, along, vec3_scale(along, -0x1p60)};
        Mat4 eye_from_world;
        for (int k = 0; k < 3; k++) {
            assert_false(mat4_look_at(eye, center, ups[k], &eye_from_world));
            assert_true(orthonormality_error(eye_from_world) < 4e-15);
        }
        assert_false(mat4_look_at(eye, eye, view, &eye_from_world));
        assert_true(orthonormality_error(eye_from_world) < 4e-15);
    }
}

static void look_at_degenerate_is_refused_in_one_line(void **state)
{
    (void)state;
    static const struct {
        Vec3 eye, center, up;
        const char *message;
    } cases[] = {
        {{0, 4, 0}, {0, 0, 0}, {0, 1, 0}, "camera: eye (0, 4, 0), center (0, 0, 0), up (0, 1, 0):"},
        {{0, 4, 0},
         {0, 0, 0},
         {0, -9, 0},
         "camera: eye (0, 4, 0), center (0, 0, 0), up (0, -9, 0)"},
        {{1, 2, 3}, {0, 0, 0}, {2, 4, 6}, "camera: eye (1, 2, 3), center (0, 0, 0), up (2, 4, 6)"},
        {{1, 2, 3}, {0, 0, 0}, {0, 0, 0}, "camera: eye (1, 2, 3), center (0, 0, 0), up (0, 0, 0)"},
        {{1, 2, 3}, {1, 2, 3}, {0, 1, 0}, "camera: eye (1, 2, 3), center (1, 2, 3), up (0, 1, 0)"},
        {{1, 2, 3}, {0, 0, 0}, {0, (double)NAN, 0}, "camera: up (0, nan, 0)"},
        {{1, 2, (double)INFINITY}, {0, 0, 0}, {0, 1, 0}, "camera: eye (1, 2, inf)"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        World world;
        Message message = {0};
        make_world(&world);
        world.scene.camera.eye = cases[i].eye;
        world.scene.camera.center = cases[i].center;
        world.scene.camera.up = cases[i].up;
        assert_false(scene_check(&world.scene, &message));
        if (strncmp(message.text, cases[i].message, strlen(cases[i].message)) != 0 ||
            strchr(message.text, '\n'))
            fail_msg("\"%s\" does not begin with \"%s\"", message.text, cases[i].message);
    }
}

/* Look-at, nearly parallel. */

static void look_at_nearly_parallel_stays_orthonormal(void **state)
{
    (void)state;
    HardRandom random = {seed};
    for (int e = 0; e >= -16; e--) {
        double worst = 0, roll = 0;
        const double angle = pow(10, e);
        for (int i = 0; i < 1000; i++) {
            const Vec3 origin = {0, 0, 0}, view = hard_random_direction(&random);
            Vec3 across;
            Mat4 eye_from_world;
            assert_true(vec3_normalize(vec3_cross(view, hard_random_direction(&random)), &across));
            const Vec3 up = vec3_add(vec3_scale(view, cos(angle)), vec3_scale(across, sin(angle)));
            mat4_look_at(origin, view, up, &eye_from_world);
            worst = fmax(worst, orthonormality_error(eye_from_world));
            roll = fmax(roll, fabs(mat4_transform_direction(eye_from_world, across).x));
        }
        if (!(worst < 4e-15))
            fail_msg("angle 1e%d: %.2g from orthonormal", e, worst);
        /* The rounding of `up`, 2.3e-16 in each component at worst with that of its terms, is all
         * that turns the picture about the view. */
        if (!(roll < 8e-16 / angle + 8e-16))
            fail_msg("angle 1e%d: rolled by %.2g", e, roll);
    }
}

static void look_at_nearly_parallel_draws_the_exact_picture(void **state)
{
    (void)state;
    static const double angles[] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-12, 1e-15};
    static const Vec3 eyes[] = {{0, 4.5, 0}, {0.5, 4, 1.5}};
    static Frame upright, frame;
    for (int k = 0; k < 2; k++) {
        World world;
        Vec3 back, across, side;
        Reference exact;
        make_world(&world);
        Camera *camera = &world.scene.camera;
        camera->eye = eyes[k];
        assert_true(vec3_normalize(eyes[k], &back));
        assert_true(vec3_normalize(vec3_cross((Vec3){0.6, 0, -0.8}, back), &side));
        across = vec3_cross(back, side);
        camera->up = across;
        hard_exact(&hard, &world.scene, false, &exact);
        check_exact("upright", &world.scene, HARD_HIGHP, &exact);
        keep_frame(upright);
        for (int i = 0; i < 6; i++) {
            char name[32];
            int edges;
            snprintf(name, sizeof name, "up %g from the view", angles[i]);
            camera->up =
                vec3_add(vec3_scale(back, cos(angles[i])), vec3_scale(across, sin(angles[i])));
            world.scene.interpolation = INTERPOLATION_PHONG;
            /* `up` as rounded is what the exact picture has, whatever the angle. */
            check_each_way(name, &world);
            world.scene.interpolation = INTERPOLATION_PHONG;
            /* And down to 1e-12 that rolls it by 1e-3 at most, 1/30 of a pixel. */
            if (angles[i] < 1e-12)
                continue;
            check_exact(name, &world.scene, HARD_HIGHP, &exact);
            keep_frame(frame);
            if (apart(frame, upright, &exact, &edges) > 1 || edges > 8)
                fail_msg("%s: not as upright, %d pixels of edges", name, edges);
        }
        reference_close(&exact);
    }
}

/* Perspective. */

static void perspective_bad_inputs_are_refused_in_one_line(void **state)
{
    (void)state;
    const double bad[][3] = {{0, 1, 20},
                             {-1, 1, 20},
                             {180, 1, 20},
                             {360, 1, 20},
                             {270, 1, 20},
                             {not_a_number, 1, 20},
                             {35, 0, 20},
                             {35, -1, 20},
                             {35, 20, 1},
                             {35, 1, 1},
                             {35, 1, -20},
                             {35, not_a_number, 20},
                             {35, 1, not_a_number},
                             {35, infinity, infinity}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        World world;
        Message message = {0};
        char beginning[96];
        make_world(&world);
        world.scene.camera.fovy = bad[i][0];
        world.scene.camera.near = bad[i][1];
        world.scene.camera.far = bad[i][2];
        snprintf(beginning, sizeof beginning,
                 "camera: fovy %g, aspect 1, near %g, far %g:", bad[i][0], bad[i][1], bad[i][2]);
        assert_false(scene_check(&world.scene, &message));
        if (strncmp(message.text, beginning, strlen(beginning)) != 0 || strchr(message.text, '\n'))
            fail_msg("\"%s\" does not begin with \"%s\"", message.text, beginning);
    }
    const double aspects[] = {0, -1, infinity, not_a_number};
    for (int i = 0; i < 4; i++) {
        Mat4 projection;
        const Mat4 identity = mat4_identity();
        assert_false(mat4_perspective(35, aspects[i], 1, 20, &projection));
        assert_memory_equal(&projection, &identity, sizeof identity);
    }
}

static double depth_at(Mat4 projection, double distance)
{
    const Vec4 clip = mat4_transform(projection, (Vec4){0, 0, -distance, 1});
    return clip.z / clip.w;
}

static void perspective_infinite_far_has_its_limits(void **state)
{
    (void)state;
    HardRandom random = {seed};
    for (int i = 0; i < 1000; i++) {
        const double near = pow(10, hard_random(&random, -9, 9));
        const double far = near * (1 + pow(10, hard_random(&random, -1, 12)));
        Mat4 projection;
        assert_true(mat4_perspective(35, 1, near, far, &projection));
        assert_true(fabs(depth_at(projection, near) + 1) < 1e-14);
        assert_true(fabs(depth_at(projection, far) - 1) < 1e-14);
        assert_true(mat4_perspective(35, 1, near, infinity, &projection));
        assert_true(projection.m[10] == -1 && projection.m[14] == -2 * near);
        assert_true(fabs(depth_at(projection, near) + 1) < 1e-14);
        assert_true(fabs(depth_at(projection, near * 1e20) - 1) < 1e-14);
    }
}

static void perspective_infinite_far_draws_the_same_picture(void **state)
{
    (void)state;
    static const double fars[] = {20, 1e3, 1e9, 1e300, (double)INFINITY};
    static Frame first, frame;
    Reference exact;
    World world;
    make_world(&world);
    hard_exact(&hard, &world.scene, false, &exact);
    for (int i = 0; i < 5; i++) {
        world.scene.camera.far = fars[i];
        check_each_way("far plane", &world);
        world.scene.interpolation = INTERPOLATION_PHONG;
        check_exact("far plane", &world.scene, HARD_HIGHP, &exact);
        keep_frame(i == 0 ? first : frame);
        int edges;
        /* Depth alone changes, by which the sphere and the square hide one another. */
        if (i > 0 && (apart(frame, first, &exact, &edges) > 1 || edges > 4))
            fail_msg("far %g: another picture", fars[i]);
    }
    reference_close(&exact);
}

/* Depth. */

/* Two squares facing the eye or tilted, the green one farther by `gap` along the view; which is
 * drawn first is `order`. */
static void make_squares(World *world, double distance, double tilt, double near, double gap,
                         int order)
{
    Mat4 turned;
    make_world(world);
    mat4_rotate(tilt, (Vec3){0.6, 0.8, 0}, &turned);
    world->scene.camera = (Camera){{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 40, near, 1000 * distance};
    world->scene.light_count = 0;
    for (int i = 0; i < 2; i++) {
        const Vec3 place = {0, 0, -distance - (i == order ? 0 : gap)};
        world->objects[i] = (Object){
            .mesh = &quad,
            .flat = true,
            .world_from_object = mat4_product(
                mat4_translate(place),
                mat4_product(turned, mat4_scale((Vec3){distance / 4, distance / 4, distance / 4}))),
            .front = {.alpha = 1, .emission = {i == order, i != order, 0}},
        };
    }
    settle(world);
}

/* Pixels of the green square where the red one is. */
static int count_wrong(const World *world)
{
    Reference exact;
    int wrong = 0;
    hard_exact(&hard, &world->scene, false, &exact);
    assert_true(hard_draw(&hard, &world->scene, HARD_HIGHP, &exact).not_finite == 0);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const unsigned char *byte = (const unsigned char *)hard.image.pixels + 4 * i;
        wrong += exact.interior[i] && exact.color[3 * i] == 1 && byte[1] != 0;
    }
    reference_close(&exact);
    return wrong;
}

static void depth_fighting_ends_at_five_steps(void **state)
{
    (void)state;
    static const double distances[] = {2, 10, 70, 300}, nears[] = {0.01, 0.1, 1};
    for (int d = 0; d < 4; d++) {
        for (int n = 0; n < 3; n++) {
            for (int k = 0; k < 4; k++) {
                World world;
                const double z = distances[d], near = nears[n];
                const double gap = 5 * z * z / (near * 0x1p24);
                if (gap > 0.1 * z) /* no longer close */
                    continue;
                /* Of a tilted square the farthest corner counts: 2^1/2 / 4 sin 60 farther. */
                const double tilt = k < 2 ? 0 : 60, farther = 1 + 0.31 * (k >= 2);
                make_squares(&world, z, tilt, near, gap * farther * farther, k % 2);
                const int wrong = count_wrong(&world);
                if (wrong)
                    fail_msg("at %g, near %g, %g degrees: %d pixels wrong", z, near, tilt, wrong);
            }
        }
    }
}

/* What no depth buffer of 24 bits can do: depth is (1 - near / z) / (1 - near / far) in steps of
 * 2^-24, so a step is z^2 / (near 2^24) long, and what lies much closer together than that has one
 * depth, of which the first that is drawn stays. (Measured on llvmpipe: facing squares are told
 * apart from 1 step on, tilted ones from 1.6.) A near plane that is fitted to the scene makes the
 * step shorter by as much as it is farther. */
static void depth_fighting_is_mended_by_the_near_plane(void **state)
{
    (void)state;
    World world;
    const double z = 100, step = z * z / (0.01 * 0x1p24);
    make_squares(&world, z, 0, 0.01, step / 64, 1);
    print_message("1/64 of a step apart: %d pixels wrong\n", count_wrong(&world));
    make_squares(&world, z, 0, 50, step / 64, 1);
    assert_int_equal(count_wrong(&world), 0);
}

/* World at 1e4, 1e6, 1e9. */

static void move(World *world, Vec3 by)
{
    Camera *camera = &world->scene.camera;
    camera->eye = vec3_add(camera->eye, by);
    camera->center = vec3_add(camera->center, by);
    for (int i = 0; i < 2; i++) {
        world->lights[i].position = vec3_add(world->lights[i].position, by);
        world->objects[i].world_from_object =
            mat4_product(mat4_translate(by), world->objects[i].world_from_object);
    }
}

static const double OFFSETS[] = {0x1p14, 0x1p20, 0x1p30}; /* 1e4, 1e6, 1e9 */

static void world_at_1e4_1e6_1e9_has_model_views_of_the_origin(void **state)
{
    (void)state;
    HardRandom random = {seed};
    for (int i = 0; i < 1000; i++) {
        World here, there;
        Mat4 view[2], projection;
        make_world(&here);
        here.scene.camera.eye = vec3_scale(hard_random_direction(&random), 5);
        there = here;
        move(&there, vec3_scale(hard_random_direction(&random), OFFSETS[i % 3]));
        assert_true(scene_camera(&here.scene.camera, 1, &view[0], &projection, NULL));
        assert_true(scene_camera(&there.scene.camera, 1, &view[1], &projection, NULL));
        for (int k = 0; k < 2; k++) {
            float a[16], b[16];
            mat4_to_float(scene_eye_from_object(&here.scene.camera, view[0],
                                                here.objects[k].world_from_object),
                          a);
            mat4_to_float(scene_eye_from_object(&there.scene.camera, view[1],
                                                there.objects[k].world_from_object),
                          b);
            /* Coordinates at 2^30 are multiples of 2^-23 = 1.2e-7, and floats of up to 5 are
             * rounded to half of 4.8e-7. */
            for (int j = 0; j < 16; j++)
                assert_true(fabs((double)a[j] - (double)b[j]) <= 2e-6);
        }
    }
}

static void world_at_1e4_1e6_1e9_draws_the_same_picture(void **state)
{
    (void)state;
    static const Vec3 directions[] = {{1, 0, 0}, {-1, 1, 1}, {0.3, -0.7, 0.9}};
    for (int way = 0; way < 2; way++) {
        World world, moved;
        Reference exact;
        make_world(&world);
        world.scene.interpolation = way ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
        hard_exact(&hard, &world.scene, false, &exact);
        for (int i = 0; i < 9; i++) {
            for (int precision = HARD_HIGHP; precision <= HARD_MEDIUMP; precision++) {
                static Frame here, there;
                char name[48];
                int edges;
                snprintf(name, sizeof name, "%g away", OFFSETS[i % 3]);
                moved = world;
                settle(&moved);
                move(&moved, vec3_scale(directions[i / 3], OFFSETS[i % 3]));
                check_exact("at the origin", &world.scene, (HardPrecision)precision, &exact);
                keep_frame(here);
                check_exact(name, &moved.scene, (HardPrecision)precision, &exact);
                keep_frame(there);
                const int most = apart(there, here, &exact, &edges);
                if (most > 1 || edges > 2)
                    fail_msg("%s: %d steps, %d pixels of edges", name, most, edges);
            }
        }
        reference_close(&exact);
    }
}

/* Where a number's last digit is 1/16: all places of this scene are multiples of 1/4, so nothing of
 * it is lost, and the picture is the same to the last bit. */
static void world_at_the_end_of_its_range_is_bit_identical(void **state)
{
    (void)state;
    World world, moved;
    Reference exact;
    make_world(&world);
    hard_exact(&hard, &world.scene, false, &exact);
    for (int precision = HARD_HIGHP; precision <= HARD_MEDIUMP; precision++) {
        static Frame here, there;
        moved = world;
        settle(&moved);
        move(&moved, (Vec3){0x1p48, -0x1p49, 0x1p48});
        check_exact("at the origin", &world.scene, (HardPrecision)precision, &exact);
        keep_frame(here);
        check_exact("3e14 away", &moved.scene, (HardPrecision)precision, &exact);
        keep_frame(there);
        assert_memory_equal(there, here, sizeof here);
    }
    reference_close(&exact);
}

static int open_all(void **state)
{
    Message message = {0};
    (void)state;
    hard_open(&hard, SIZE, SIZE);
    if (mesh_sphere(&sphere, 1, SLICES, SLICES, &message) && mesh_quad(&quad, 8, &message))
        return 0;
    printf("%s\n", message.text);
    return 1;
}

static int close_all(void **state)
{
    (void)state;
    hard_close(&hard);
    mesh_close(&quad);
    mesh_close(&sphere);
    return 0;
}

int main(void)
{
    const char *text = getenv("LIGHTING_TEST_SEED");
    if (text && *text)
        seed = strtoull(text, NULL, 0);
    print_message("seed %llu\n", seed);
    const struct CMUnitTest functions[] = {
        cmocka_unit_test(look_at_degenerate_is_rigid_all_the_same),
        cmocka_unit_test(look_at_nearly_parallel_stays_orthonormal),
        cmocka_unit_test(perspective_infinite_far_has_its_limits),
        cmocka_unit_test(world_at_1e4_1e6_1e9_has_model_views_of_the_origin),
    };
    const struct CMUnitTest pictures[] = {
        cmocka_unit_test(look_at_degenerate_is_refused_in_one_line),
        cmocka_unit_test(look_at_nearly_parallel_draws_the_exact_picture),
        cmocka_unit_test(perspective_bad_inputs_are_refused_in_one_line),
        cmocka_unit_test(perspective_infinite_far_draws_the_same_picture),
        cmocka_unit_test(depth_fighting_ends_at_five_steps),
        cmocka_unit_test(depth_fighting_is_mended_by_the_near_plane),
        cmocka_unit_test(world_at_1e4_1e6_1e9_draws_the_same_picture),
        cmocka_unit_test(world_at_the_end_of_its_range_is_bit_identical),
    };
    const int failed = cmocka_run_group_tests_name("views", functions, NULL, NULL);
    if (!picture_check_driver("hard views"))
        return failed ? failed : EXIT_SKIPPED;
    return failed + cmocka_run_group_tests_name("views, drawn", pictures, open_all, close_all);
}
