/*
 * Hard cases of views and projections: degenerate and nearly degenerate cameras, projections out of
 * range or without a far plane, surfaces close behind one another, and scenes far from the origin.
 */
#include "hard/hard.h"
#include "shapes/mesh_solids.h"
#include "support/picture_check.h"
#include "support/testing.h"

enum { SIZE = 64, SLICES = 48 };

static Mesh sphere, quad;

/* Scenes: a sphere on a square, a point light and a directional one. */

static void make_world(HardWorld *world)
{
    const Mat4 lying = mat4_rotate(-90, (Vec3){1, 0, 0});
    const Mat4 tilted = mat4_rotate(33, (Vec3){1, 2, 3});
    hard_two_lights(world, &sphere, mat4_product(tilted, mat4_scale((Vec3){0.5, 0.9, 0.75})));
    world->objects[1] = world->objects[0];
    world->objects[0].closed = true;
    world->objects[1].mesh = &quad;
    world->objects[1].flat = true;
    world->objects[1].world_from_object = mat4_product(mat4_translate((Vec3){0, -0.75, 0}), lying);
    world->objects[1].front.diffuse = (Vec3){0.4, 0.6, 1};
    world->objects[1].front.specular = (Vec3){0.5, 0.5, 0.5};
    world->scene.object_count = 2;
    world->scene.camera.eye.y = 2;
}

static void check_exact(const char *name, HardWorld *world, HardPrecision precision,
                        const Reference *exact)
{
    hard_check_two_lights(name, &world->scene, precision, exact);
}

/* The largest difference of two frames in pixels inside objects, and how many other pixels differ
 * by more than a step. */
static int apart(const HardFrame *a, const HardFrame *b, const Reference *exact, int *edges)
{
    int max = 0;
    *edges = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        const int steps = hard_apart(a, i, b, i);
        if (exact->interior[i])
            max = (int)fmax(max, steps);
        else
            *edges += steps > 1;
    }
    return max;
}

TEST(look_at_nearly_parallel_draws_the_exact_picture)
{
    static const double angles[] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-12, 1e-15};
    static const Vec3 eyes[] = {{0, 4.5, 0}, {0.5, 4, 1.5}};
    static HardFrame upright, frame;
    for (int k = 0; k < 2; k++) {
        HardWorld world;
        Vec3 back, across, side;
        Reference exact;
        make_world(&world);
        Camera *camera = &world.scene.camera;
        camera->eye = eyes[k];
        assert_true(vec3_normalize(eyes[k], &back));
        assert_true(vec3_normalize(vec3_cross((Vec3){0.6, 0, -0.8}, back), &side));
        across = vec3_cross(back, side);
        camera->up = across;
        hard_exact(&world.scene, &exact);
        check_exact("upright", &world, HARD_HIGHP, &exact);
        hard_keep(&upright);
        for (int i = 0; i < 6; i++) {
            char name[32];
            int edges;
            snprintf(name, sizeof name, "up %g from the view", angles[i]);
            camera->up =
                vec3_add(vec3_scale(back, cos(angles[i])), vec3_scale(across, sin(angles[i])));
            world.scene.interpolation = INTERPOLATION_PHONG;
            /* The exact picture uses `up` as rounded, whatever the angle. */
            hard_each_way(name, &world, check_exact);
            world.scene.interpolation = INTERPOLATION_PHONG;
            /* Down to 1e-12 the rounding rolls it by at most 1e-3, 1/30 of a pixel. */
            if (angles[i] < 1e-12)
                continue;
            check_exact(name, &world, HARD_HIGHP, &exact);
            hard_keep(&frame);
            if (apart(&frame, &upright, &exact, &edges) > 1 || edges > 8)
                fail_msg("%s: not as upright, %d pixels of edges", name, edges);
        }
        reference_close(&exact);
    }
}

/* Perspective. */

TEST(perspective_infinite_far_draws_the_same_picture)
{
    static const double fars[] = {20, 1e3, 1e9, 1e300, (double)INFINITY};
    static HardFrame first, frame;
    CLOSED(reference_close) Reference exact;
    HardWorld world;
    make_world(&world);
    hard_exact(&world.scene, &exact);
    for (int i = 0; i < 5; i++) {
        world.scene.camera.far = fars[i];
        hard_each_way("far plane", &world, check_exact);
        world.scene.interpolation = INTERPOLATION_PHONG;
        check_exact("far plane", &world, HARD_HIGHP, &exact);
        hard_keep(i == 0 ? &first : &frame);
        int edges;
        /* Only depth changes, which decides where sphere and square hide one another. */
        if (i > 0 && (apart(&frame, &first, &exact, &edges) > 1 || edges > 4))
            fail_msg("far %g: another picture", fars[i]);
    }
}

/* Depth. */

/* Two squares, facing the eye or tilted, the green one farther by `gap` along the view; `order`
 * says which is drawn first. */
static void make_squares(HardWorld *world, double distance, double tilt, double near, double gap,
                         int order)
{
    make_world(world);
    const Mat4 turned = mat4_rotate(tilt, (Vec3){0.6, 0.8, 0});
    world->scene.camera = (Camera){{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 40, near, 1000 * distance, 0};
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
}

/* Counts the pixels of the green square where the red one should be. */
static int count_wrong(const HardWorld *world)
{
    Reference exact;
    int wrong = 0;
    hard_exact(&world->scene, &exact);
    assert_true(hard_draw(&world->scene, HARD_HIGHP, &exact).not_finite == 0);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const unsigned char *byte = (const unsigned char *)hard.image.pixels + 4 * i;
        wrong += exact.interior[i] && exact.color[3 * i] == 1 && byte[1] != 0;
    }
    reference_close(&exact);
    return wrong;
}

TEST(depth_fighting_ends_at_five_steps)
{
    static const double distances[] = {2, 10, 70, 300}, nears[] = {0.01, 0.1, 1};
    for (int d = 0; d < 4; d++) {
        for (int n = 0; n < 3; n++) {
            for (int k = 0; k < 4; k++) {
                HardWorld world;
                const double z = distances[d], near = nears[n];
                const double gap = 5 * z * z / (near * 0x1p24);
                if (gap > 0.1 * z) /* far enough apart */
                    continue;
                /* Of a tilted square the farthest corner counts: it is farther by sin(60 degrees)
                 * sqrt(2) / 4. */
                const double tilt = k < 2 ? 0 : 60, farther = 1 + 0.31 * (k >= 2);
                make_squares(&world, z, tilt, near, gap * farther * farther, k % 2);
                const int wrong = count_wrong(&world);
                if (wrong)
                    fail_msg("at %g, near %g, %g degrees: %d pixels wrong", z, near, tilt, wrong);
            }
        }
    }
}

/* The limit of a depth buffer of 24 bits: depth is (1 - near / z) / (1 - near / far) in steps of
 * 2^-24, so a step is z^2 / (near 2^24) long. Surfaces that are much closer together have the same
 * depth, and the one that is drawn first stays. (Measured on llvmpipe: facing squares are
 * distinguished from 1 step on, tilted ones from 1.6.) Moving the near plane towards the scene
 * shortens the step by the same factor. */
TEST(a_fitted_near_plane_ends_depth_fighting)
{
    HardWorld world;
    const double z = 100, step = z * z / (0.01 * 0x1p24);
    make_squares(&world, z, 0, 0.01, step / 64, 1);
    print_message("1/64 of a step apart: %d pixels wrong\n", count_wrong(&world));
    make_squares(&world, z, 0, 50, step / 64, 1);
    assert_int_equal(count_wrong(&world), 0);
}

/* The world far away. */

static void move(HardWorld *world, Vec3 by)
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

/* At this distance the last digit is 1/16. All coordinates of this scene are multiples of 1/4, so
 * nothing is lost, and the picture is the same to the last bit. */
TEST(world_at_the_end_of_its_range_is_bit_identical)
{
    HardWorld world, moved;
    CLOSED(reference_close) Reference exact;
    make_world(&world);
    hard_exact(&world.scene, &exact);
    for (HardPrecision precision = HARD_HIGHP; precision <= HARD_MEDIUMP; precision++) {
        static HardFrame here, there;
        moved = world;
        hard_world_settle(&moved);
        move(&moved, (Vec3){0x1p48, -0x1p49, 0x1p48});
        check_exact("at the origin", &world, precision, &exact);
        hard_keep(&here);
        check_exact("3e14 away", &moved, precision, &exact);
        hard_keep(&there);
        assert_memory_equal(&there, &here, sizeof here);
    }
}

FIXTURE(open_all)
{
    hard_open(SIZE, SIZE);
    SUCCEEDS(mesh_sphere(&sphere, 1, SLICES, SLICES, message) && mesh_quad(&quad, 8, message));
}

FIXTURE(close_all)
{
    hard_close();
    mesh_close(&quad);
    mesh_close(&sphere);
}

PICTURE_TEST_MAIN("hard views", open_all, close_all)
