/*
 * Hard cases of views and projections: without a far plane, and scenes far from the origin.
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
