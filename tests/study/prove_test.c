/*
 * accuracy --prove: no picture of a random scene, drawn to floats, has a larger error than is
 * proved for it; and how much larger the bound is than the error.
 */
#include "base/clock.h"
#include "base/random.h"
#include "core/mesh.h"
#include "core/orbit.h"
#include "lighting/lighting.h"
#include "reference/picture_error.h"
#include "shapes/mesh_solids.h"
#include "study/arithmetic/proof.h"
#include "support/picture_check.h"
#include "support/testing.h"

enum { WIDTH = 400, HEIGHT = 300, MESHES = 3, PIECES = 4000, VIEWS = 4 };

static Arithmetics found;
static Mesh meshes[MESHES];

FIXTURE(measure)
{
    Meter meter;
    SUCCEEDS(meter_open(&meter, NULL, message));
    SUCCEEDS(arithmetic_measure(&meter, 1 << 17, &found, message));
    meter_close(&meter);
    SUCCEEDS(mesh_sphere(&meshes[0], 1, 16, 8, message));
    SUCCEEDS(mesh_torus(&meshes[1], .3, .8, 8, 14, message));
    SUCCEEDS(mesh_quad(&meshes[2], 3, message));
}

FIXTURE(close_meshes)
{
    for (int i = 0; i < MESHES; i++)
        mesh_close(&meshes[i]);
}

typedef struct Made {
    Scene scene;
    Light lights[3];
    Object objects[2];
} Made;

static Vec3 direction(Random *random)
{
    return vec3_unit((Vec3){random_between(random, -1, 1), random_between(random, -1, 1),
                            random_between(random, -1, 1)});
}

static Vec3 color(Random *random)
{
    return (Vec3){random_between(random, 0, 1), random_between(random, 0, 1),
                  random_between(random, 0, 1)};
}

static Light random_light(Random *random)
{
    Light light = {.kind = (LightKind)random_below(random, 3),
                   .position = vec3_scale(direction(random), random_between(random, 2, 6)),
                   .diffuse = color(random),
                   .specular = color(random),
                   .cutoff = random_between(random, 10, 60),
                   .exponent = random_below(random, 2) ? random_between(random, 0, 20) : 0};
    light.direction = light.kind == LIGHT_SPOT ? vec3_scale(light.position, -1) : direction(random);
    if (random_below(random, 3) == 0)
        light.constant = 1, light.quadratic = .1;
    return light;
}

static void make(Made *made, Random *random)
{
    memset(made, 0, sizeof *made);
    Scene *scene = &made->scene;
    scene->lights = made->lights;
    scene->objects = made->objects;
    scene->light_count = 1 + random_below(random, 3);
    scene->object_count = 1 + random_below(random, 2);
    scene->reflection = (Reflection)random_below(random, 2);
    scene->distant_viewer = random_below(random, 4) == 0;
    scene->linear = random_below(random, 6) == 0;
    scene->global_ambient = (Vec3){.1, .1, .1};
    scene->camera = (Camera){.eye = vec3_scale(direction(random), random_between(random, 4, 9)),
                             .up = {.1, 1, .2},
                             .fovy = random_between(random, 20, 40),
                             .near = 1,
                             .far = 100};
    for (int i = 0; i < scene->light_count; i++)
        made->lights[i] = random_light(random);
    for (int i = 0; i < scene->object_count; i++) {
        const int mesh = random_below(random, MESHES);
        const Vec3 move = vec3_scale(direction(random), random_between(random, 0, 1));
        made->objects[i] = (Object){.mesh = &meshes[mesh],
                                    .closed = mesh < 2,
                                    .world_from_object = mat4_translate(move),
                                    .front = {.ambient = color(random),
                                              .diffuse = color(random),
                                              .specular = color(random),
                                              .shininess = random_between(random, 1, 100),
                                              .alpha = 1}};
    }
}

/* Beside a side that two triangles share, nearer than positions are resolved, either may be drawn:
 * by so much their colours may differ there, in steps, as colours change from pixel to pixel. */
static double sides_error(const Reference *exact)
{
    double most = 0;
    for (size_t i = 0; i + WIDTH + 1 < WIDTH * HEIGHT; i++)
        for (int k = 0; k < 6; k++) {
            const size_t next = i + (k < 3 ? 1 : WIDTH);
            if (exact->interior[i] == 1 && exact->interior[next] == 1 &&
                exact->object[i] == exact->object[next])
                most = fmax(most, fabs((double)exact->color[3 * i + (size_t)(k % 3)] -
                                       (double)exact->color[3 * next + (size_t)(k % 3)]));
        }
    return 255 * ldexp(most, -found.raster.subpixel_bits);
}

/* The largest error inside objects, in steps. */
static double drawn_error(const Canvas *canvas, const Scene *scene, bool narrow, double *sides)
{
    const ReferenceOptions options = {
        .width = WIDTH, .height = HEIGHT, .meshes = true, .centers = true};
    const ShaderLoader loader = {.precision = narrow ? "mediump" : "highp"};
    PictureError error = {.all = {0}};
    Reference exact;
    Lighting *lighting;
    Image image;
    SUCCEEDS(reference_open(&exact, scene, &options, message));
    SUCCEEDS(image_open(&image, WIDTH, HEIGHT, IMAGE_FLOAT, message));
    SUCCEEDS(lighting_open(&lighting, &loader, message));
    picture_draw(canvas, lighting, &(LightingFrame){.scene = scene}, &image);
    picture_error_add(&error, &image, &(ExactView){.exact = &exact, .scene = scene});
    *sides = sides_error(&exact);
    lighting_close(lighting);
    image_close(&image);
    reference_close(&exact);
    return error.interior.pixels ? error.interior.maximum : -1;
}

static double proved_error(const Scene *scene, bool narrow, const ProofCameras *cameras)
{
    const ProofDriver driver = {&found.of[METER_VERTEX][METER_HIGHP],
                                &found.of[METER_FRAGMENT][narrow], &found.raster, HEIGHT};
    Proved proved;
    double steps = 0;
    SUCCEEDS(prove_scene(scene, &driver, cameras, PIECES, &proved, message));
    for (int i = 0; i < proved.count; i++)
        steps = fmax(steps, proved.draws[i].bound.steps);
    return steps;
}

/* A float of the exact picture is rounded. */
static const double ROUNDED = 255 * 0x1p-24;

/* From the scene's camera, or from some of a range: whether an error is larger than is proved;
 * the bound over the largest error, in floats, and with a byte's rounding in both. */
static bool is_larger(const Canvas *canvas, const Scene *scene, bool narrow,
                      const ProofCameras *cameras, Random *random, double ratios[2])
{
    const double proved = proved_error(scene, narrow, cameras);
    double most = -1;
    bool larger = false;
    for (int i = 0; i < (cameras ? VIEWS : 1); i++) {
        Scene moved = *scene;
        double at[3] = {0, 0, 1}, sides;
        for (int k = 0; k < 3 && cameras; k++)
            at[k] = random_between(random, cameras->low[k], cameras->high[k]);
        orbit_move((Orbit){at[0], at[1], at[2], 0}, &moved.camera.eye, moved.camera.center,
                   &moved.camera.up);
        const double error = drawn_error(canvas, &moved, narrow, &sides);
        if (error > proved + sides + ROUNDED) {
            print_message("%s from %g,%g,%g: proved %g, is %g\n", METER_PRECISION_NAMES[narrow],
                          at[0], at[1], at[2], proved, error);
            larger = true;
        }
        most = fmax(most, error);
    }
    ratios[0] = most < 0 ? 1 : proved / fmax(most, ROUNDED);
    ratios[1] = most < 0 ? 1 : (proved + .5) / (most + .5);
    return larger;
}

static void check_scenes(int count, bool moves)
{
    const CanvasOptions options = {.width = WIDTH, .height = HEIGHT, .real = true};
    Random random = {testing_seed(28)};
    double *ratios[4];
    Canvas canvas;
    int larger = 0;
    SUCCEEDS(canvas_open(&canvas, &options, message));
    for (int i = 0; i < 4; i++)
        ratios[i] = calloc((size_t)count, sizeof *ratios[i]);
    for (int i = 0; i < count; i++) {
        Made made;
        make(&made, &random);
        ProofCameras cameras;
        for (int k = 0; k < 3; k++) {
            cameras.low[k] = k < 2 ? random_between(&random, -30, 10) : 1;
            cameras.high[k] = cameras.low[k] + random_between(&random, 0, k < 2 ? 10 : .1);
        }
        if (!scene_check(&made.scene, FAILURE))
            fail_msg("scene %d: %s", i, FAILURE->text);
        for (int k = 0; k < 2; k++) {
            double found_ratios[2];
            if (is_larger(&canvas, &made.scene, k, moves ? &cameras : NULL, &random,
                          found_ratios)) {
                print_message("scene %d\n", i);
                larger++;
            }
            ratios[k][i] = found_ratios[0];
            ratios[2 + k][i] = found_ratios[1];
        }
    }
    for (int k = 0; k < 4; k++) {
        print_message("%d scenes, %s, %s: half of the bounds within %.1f times the error, a "
                      "quarter within %.1f, three within %.1f\n",
                      count, METER_PRECISION_NAMES[k % 2], k < 2 ? "floats" : "bytes",
                      clock_median(ratios[k], count), clock_quantile(ratios[k], count, .25),
                      clock_quantile(ratios[k], count, .75));
        free(ratios[k]);
    }
    canvas_close(&canvas);
    assert_int_equal(larger, 0);
}

TEST(no_picture_has_a_larger_error_than_is_proved)
{
    check_scenes(testing_part(500, 80), false);
}

TEST(nor_has_one_from_a_range_of_cameras)
{
    check_scenes(testing_part(60, 30), true);
}

PICTURE_TEST_MAIN("prove", measure, close_meshes)
