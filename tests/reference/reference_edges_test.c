/*
 * The exact picture: edges, what it does not depend on, and what is refused. No GL.
 */
#include "base/sanitized.h"
#include "reference/lit_world.h"
#include "support/testing.h"

#include <pthread.h>
#include <sys/resource.h>
#include <time.h>

/* Edges. */

TEST_WITH(0, the_cone_of_a_spot_is_an_edge, set_up, tear_down)
{
    add_object((Solid){.kind = SOLID_QUAD}, 3);
    world.lights[0] = (Light){.kind = LIGHT_SPOT,
                              .position = {0, 0, 2},
                              .direction = {0, 0, -1},
                              .cutoff = 20,
                              .diffuse = {1, 1, 1}};
    Reference picture = world_trace((ReferenceOptions){0});
    const double radius = 2 * tan(PI / 9) * pixels_at_one(SIZE) / 4;
    const double half = pixels_at_one(SIZE) / 4;
    int edges = 0;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            const size_t pixel = pixel_at(&picture, x, y);
            double nearest, farthest, middle;
            const double left = fabs(x - SIZE / 2.0), right = fabs(x + 1 - SIZE / 2.0);
            const double up = fabs(y - SIZE / 2.0), down = fabs(y + 1 - SIZE / 2.0);
            nearest = hypot(fmin(left, right), fmin(up, down));
            farthest = hypot(fmax(left, right), fmax(up, down));
            middle = hypot(x + 0.5 - SIZE / 2.0, y + 0.5 - SIZE / 2.0);
            if (fmax(fmax(left, right), fmax(up, down)) > half)
                continue;
            /* A bulge of 1 / (96 R) is overlooked; it reaches 1 / (32 R) into the pixel. */
            const double bulge = 1 / (32 * radius);
            if (nearest < radius - bulge && farthest > radius + bulge) {
                assert_int_equal(picture.interior[pixel], 0);
                edges++;
            } else if (farthest < radius || nearest > radius) {
                assert_int_equal(picture.interior[pixel], 1);
                assert_true(picture.coverage[pixel] == 1);
                assert_int_equal(channel(&picture, pixel, 0) > 0, middle < radius);
            }
        }
    assert_true(edges > 5 * radius);
}

TEST_WITH(0, a_steep_highlight_is_no_edge, set_up, tear_down)
{
    Object *sphere = add_object((Solid){.kind = SOLID_SPHERE, .radius = 0.2}, 8);
    sphere->front.specular = (Vec3){1, 1, 1};
    sphere->front.shininess = 128;
    world.lights[0].specular = (Vec3){1, 1, 1};
    Reference picture = world_trace((ReferenceOptions){.width = 63, .height = 63});
    for (int y = 28; y < 35; y++)
        for (int x = 28; x < 35; x++) {
            const size_t pixel = pixel_at(&picture, x, y);
            if (hypot(x - 31, y - 31) < 2.5) /* its radius is 3.8 pixels */
                assert_int_equal(picture.interior[pixel], 1);
        }
    /* Its neighbors are far less bright, and yet it has the color of its center. */
    assert_color(&picture, pixel_at(&picture, 31, 31), 1, 1, 1);
    assert_true(channel(&picture, pixel_at(&picture, 32, 31), 2) < 0.5);
}

static void open_edge_scene(void)
{
    static const SolidKind kinds[] = {SOLID_TORUS, SOLID_CONE, SOLID_BOX};
    const Mat4 turn = mat4_rotate(-50, (Vec3){1, 0.4, 0});
    for (int i = 0; i < 3; i++) {
        Object *object =
            add_object((Solid){.kind = kinds[i], .radius = 0.6, .height = 1.5, .tube = 0.25}, 24);
        object->world_from_object =
            mat4_product(mat4_translate((Vec3){0.5 * i - 0.5, 0.2 * i - 0.3, 0}), turn);
        object->front.specular = (Vec3){0.3, 0.3, 0.3};
        object->front.shininess = 10;
    }
    world.lights[0] = (Light){.kind = LIGHT_SPOT,
                              .position = {1, 1, 4},
                              .direction = {-1, -1, -4},
                              .cutoff = 12,
                              .ambient = {0.2, 0.2, 0.2},
                              .diffuse = {1, 1, 1},
                              .specular = {1, 1, 1}};
    world.lights[1] = (Light){.direction = {-1, 1, 1}, .diffuse = {0.2, 0.2, 0.3}};
    world.scene.light_count = 2;
}

TEST_WITH(0, edges_are_as_exact_as_asked_for, set_up, tear_down)
{
    double rms_before = INFINITY;
    open_edge_scene();
    Reference fine =
        world_trace((ReferenceOptions){.edge_error = testing_step(5) == 1 ? 0.002 : 0.01});
    for (double asked = 8; asked > (testing_step(5) == 1 ? 0.1 : 0.4); asked /= 2) {
        Reference picture = world_trace((ReferenceOptions){.edge_error = asked});
        const double worst = world_difference(&picture, &fine);
        double sum = 0;
        for (size_t i = 0; i < 3 * pixel_count(&picture); i++)
            sum += pow(255 * ((double)picture.color[i] - (double)fine.color[i]), 2);
        const double rms = sqrt(sum / (3 * (double)pixel_count(&picture)));
        printf("asked %.4f: worst %.4f, rms %.5f\n", asked, worst, rms);
        assert_true(worst < asked);
        /* At least its first order, within what chance does to so few pixels. */
        assert_true(rms < 0.8 * rms_before);
        rms_before = rms;
        assert_memory_equal(picture.interior, fine.interior, pixel_count(&fine));
    }
}

static bool is_mixed(const Reference *picture, int i)
{
    return (picture->object[i] < 0 ? picture->coverage[i] < 1 : !picture->interior[i]) &&
           i % 13 == 0;
}

TEST_WITH(0, edges_are_the_means_of_their_pixels, set_up, tear_down)
{
    open_edge_scene();
    const Reference picture = world_trace((ReferenceOptions){0});
    world_assert_means(&picture, 256, is_mixed, 20);
}

/* An object that no sample meets is not there; one that the center meets is, with its area. */
TEST_WITH(0, an_object_smaller_than_a_pixel_counts_if_a_sample_hits_it, set_up, tear_down)
{
    const double pixel = 4 / pixels_at_one(SIZE); /* at distance 4 */
    Object *sphere = add_object((Solid){.kind = SOLID_SPHERE, .radius = 0.2 * pixel}, 8);
    sphere->world_from_object = mat4_translate((Vec3){pixel / 2, pixel / 2, 0});
    Reference picture = world_trace((ReferenceOptions){0});
    /* A sphere's outline is as that of a circle at this distance but for its square. */
    assert_true(fabs(covered(&picture) - PI * 0.04) < 0.5 / 255 + 1e-4);
    assert_int_equal(picture.object[pixel_at(&picture, SIZE / 2, SIZE / 2 - 1)], 0);
    sphere->world_from_object = mat4_translate((Vec3){0.75 * pixel, 0.75 * pixel, 0});
    picture = world_trace((ReferenceOptions){0});
    assert_true(covered(&picture) == 0);
}

/* What the picture does not depend on. */

static void assert_same(const Reference *a, const Reference *b)
{
    assert_true(world_same(a, b));
    assert_memory_equal(a->depth, b->depth, pixel_count(a) * sizeof *a->depth);
}

TEST_WITH(0, any_number_of_threads_makes_the_same_bits, set_up, tear_down)
{
    open_edge_scene();
    world.lights[1].shadows = true;
    for (int meshes = 0; meshes < 2; meshes++) {
        Reference one = world_trace((ReferenceOptions){.threads = 1, .meshes = meshes});
        for (int i = 0; i < 3; i++) {
            const int threads[] = {0, 2, 7};
            const Reference many =
                world_trace((ReferenceOptions){.threads = threads[i], .meshes = meshes});
            assert_same(&one, &many);
        }
    }
}

/* Makes a flag true after some time. */
typedef struct Stopper {
    atomic_bool stop;
    long nanoseconds;
} Stopper;

static void *stop_later(void *argument)
{
    Stopper *stopper = argument;
    nanosleep(&(struct timespec){0, stopper->nanoseconds}, NULL);
    atomic_store(&stopper->stop, true);
    return NULL;
}

/* At whatever moment it is stopped: the whole picture, or none. */
TEST_WITH(0, a_cancelled_picture_is_empty, set_up, tear_down)
{
    static const long milliseconds[] = {0, 1, 3, 10, 20, 30, 50, 80, 120, 180, 250, 350};
    add_object((Solid){.kind = SOLID_TEAPOT, .radius = 1}, 16);
    int stopped = 0;
    for (int meshes = 0; meshes < 2; meshes++) {
        Reference whole = world_trace((ReferenceOptions){.meshes = meshes});
        for (size_t i = 0; i < sizeof milliseconds / sizeof milliseconds[0];
             i += (size_t)testing_step(3)) {
            Stopper stopper = {.nanoseconds = 1000000 * milliseconds[i]};
            const ReferenceOptions options = {.width = whole.width,
                                              .height = whole.height,
                                              .meshes = meshes,
                                              .threads = 1 + (int)i % 3,
                                              .stop = &stopper.stop};
            pthread_t thread;
            CLOSED(reference_close) Reference picture;
            Message message = {0};
            atomic_init(&stopper.stop, false);
            assert_int_equal(pthread_create(&thread, NULL, stop_later, &stopper), 0);
            if (i == 0)
                pthread_join(thread, NULL);
            if (reference_open(&picture, &world.scene, &options, &message)) {
                assert_same(&whole, &picture);
            } else {
                assert_string_equal(message.text, "reference: stopped");
                assert_null(picture.color);
                stopped++;
            }
            if (i != 0)
                pthread_join(thread, NULL);
        }
    }
    assert_true(stopped >= 2); /* at least where it was stopped before it began */
}

TEST_WITH(0, a_scene_far_from_the_origin_has_the_same_picture, set_up, tear_down)
{
    const Vec3 far = {0x1p20, -0x1p20, 0x1p21};
    open_edge_scene();
    for (int i = 0; i < 3; i++) /* so that sums with `far` are not rounded */
        for (int k = 12; k < 15; k++)
            world.objects[i].world_from_object.m[k] =
                round(world.objects[i].world_from_object.m[k] * 1024) / 1024;
    for (int meshes = 0; meshes < 2; meshes++) {
        Reference here = world_trace((ReferenceOptions){.meshes = meshes});
        const World before = world;
        for (int i = 0; i < 3; i++)
            world.objects[i].world_from_object =
                mat4_product(mat4_translate(far), world.objects[i].world_from_object);
        world.lights[0].position = vec3_add(world.lights[0].position, far);
        world.scene.camera.eye = vec3_add(world.scene.camera.eye, far);
        world.scene.camera.center = vec3_add(world.scene.camera.center, far);
        Reference there = world_trace((ReferenceOptions){.meshes = meshes});
        assert_same(&here, &there);
        world = before;
    }
}

TEST_WITH(0, pictures_have_any_shape, set_up, tear_down)
{
    static const int sizes[][2] = {{1, 1}, {1, 37}, {37, 1}, {2, 3}, {200, 9}, {9, 200}};
    add_object((Solid){.kind = SOLID_SPHERE, .radius = 1}, 8);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        const int width = sizes[i][0], height = sizes[i][1];
        Reference picture = world_trace((ReferenceOptions){.width = width, .height = height});
        const double radius = pixels_at_one(height) / sqrt(15);
        assert_int_equal(picture.width, width);
        assert_int_equal(picture.height, height);
        if (width > 2 * radius) /* the height fits always: 22.5 degrees, of which it has 14.5 */
            assert_true(fabs(covered(&picture) - PI * radius * radius) <
                        8 * fmax(radius, 1) * 0.5 / 255 + 1 / (12 * radius));
    }
}

TEST_WITH(0, objects_out_of_view_leave_the_background, set_up, tear_down)
{
    Object *sphere = add_object((Solid){.kind = SOLID_SPHERE, .radius = 1}, 8);
    sphere->world_from_object = mat4_translate((Vec3){0, 0, 8}); /* behind the eye */
    for (int i = 0; i < 3; i++) {
        if (i == 2)
            world.scene.object_count = world.scene.light_count = 0;
        Reference picture = world_trace((ReferenceOptions){.meshes = i == 1});
        for (size_t k = 0; k < pixel_count(&picture); k++) {
            assert_int_equal(picture.object[k], -1);
            assert_true(picture.coverage[k] == 1);
            assert_color(&picture, k, 0.1, 0.2, 0.3);
        }
    }
    world.scene.object_count = 1;
    sphere->world_from_object = mat4_translate((Vec3){0, 0, 4}); /* around the eye, unlit */
    Reference picture = world_trace((ReferenceOptions){0});
    for (size_t k = 0; k < pixel_count(&picture); k++)
        assert_int_equal(picture.interior[k], 1);
}

/* Refusals. */

static void assert_refused(ReferenceOptions options, const char *expected)
{
    Reference reference;
    const Reference zero = {0};
    memset(&reference, 0xa5, sizeof reference);
    FAILS(reference_open(&reference, &world.scene, &options, message), expected);
    assert_memory_equal(&reference, &zero, sizeof zero);
}

TEST_WITH(0, bad_options_are_refused, set_up, tear_down)
{
    assert_refused((ReferenceOptions){.height = 1}, "reference: size 0x1: must be 1x1 or more");
    assert_refused((ReferenceOptions){.width = 5, .height = -1},
                   "reference: size 5x-1: must be 1x1 or more");
    assert_refused((ReferenceOptions){.width = 5, .height = 5, .edge_error = -1},
                   "reference: edge error -1: must be 0 to 255");
    assert_refused((ReferenceOptions){.width = 5, .height = 5, .edge_error = NAN},
                   "reference: edge error nan: must be 0 to 255");
    assert_refused((ReferenceOptions){.width = 5, .height = 5, .threads = -1},
                   "reference: -1 threads: must be 0 or more");
    world.scene.camera.near = 0;
    assert_refused(
        (ReferenceOptions){.width = 5, .height = 5},
        "camera: fovy 45, aspect 1, near 0, far 100: must be 0 < fovy < 180, aspect > 0, "
        "0 < near < far");
}

TEST_WITH(0, a_picture_too_large_for_memory_is_rejected, set_up, tear_down)
{
    if (ADDRESS_SANITIZER)
        skip(); /* it ends the process where memory does */
    struct rlimit before;
    assert_int_equal(getrlimit(RLIMIT_AS, &before), 0);
    const struct rlimit small = {.rlim_cur = (rlim_t)1 << 30, .rlim_max = before.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_AS, &small), 0);
    assert_refused((ReferenceOptions){.width = 16384, .height = 16384},
                   "reference: 16384x16384 pixels: not enough memory");
    assert_int_equal(setrlimit(RLIMIT_AS, &before), 0);
}

TEST_WITH(0, closing_twice_or_nothing_is_fine, set_up, tear_down)
{
    Reference picture;
    const Reference zero = {0};
    const ReferenceOptions options = {.width = 1, .height = 1};
    SUCCEEDS(reference_open(&picture, &world.scene, &options, message));
    reference_close(&picture);
    assert_memory_equal(&picture, &zero, sizeof zero);
    reference_close(&picture);
    reference_close(NULL);
}

TEST_MAIN("reference edges", NULL, NULL)
