/*
 * What has a closed form: the viewer's lights, the terms of the sum and the lights one by one,
 * polygon offset. Pictures of floats. Colors of vertices and one color per triangle:
 * fixed_function_test.c.
 */
#include "base/random.h"
#include "core/canvas.h"
#include "core/mesh_make.h"
#include "lighting/lighting.h"
#include "shapes/mesh_solids.h"
#include "support/picture_check.h"
#include "support/testing.h"

enum { SIZE = 64, LIGHTS = 3 };

static const double TANGENT = 0.36; /* of half the field of view */
static Canvas canvas;
static Lighting *lighting;
static Image picture, other;
static Mesh sphere, fine_sphere, quad, colored_sphere;

FIXTURE(open_all)
{
    const CanvasOptions options = {.width = SIZE, .height = SIZE, .real = true};
    SUCCEEDS(canvas_open(&canvas, &options, message) &&
             lighting_open(&lighting, &(ShaderLoader){0}, message) &&
             image_open(&picture, SIZE, SIZE, IMAGE_FLOAT, message) &&
             image_open(&other, SIZE, SIZE, IMAGE_FLOAT, message) &&
             mesh_sphere(&sphere, 1, 24, 12, message) &&
             mesh_sphere(&fine_sphere, 1, 320, 160, message) && mesh_quad(&quad, 1, message) &&
             mesh_copy(&colored_sphere, &sphere, message) &&
             mesh_open_colors(&colored_sphere, message));
    Random random = {7};
    for (size_t i = 0; i < 3 * sphere.vertex_count; i++)
        colored_sphere.colors[i / 3][i % 3] = (float)random_between(&random, 0, 1);
}

FIXTURE(close_all)
{
    Mesh *const meshes[] = {&sphere, &fine_sphere, &quad, &colored_sphere};
    for (int i = 0; i < 4; i++)
        mesh_close(meshes[i]);
    image_close(&other);
    image_close(&picture);
    lighting_close(lighting);
    canvas_close(&canvas);
}

static struct {
    Light lights[LIGHTS];
    Object object;
    Scene scene;
} world;

static void make_world(const Mesh *mesh)
{
    memset(&world, 0, sizeof world);
    world.lights[0] = (Light){.kind = LIGHT_POINT,
                              .position = {1.5, 2, 3},
                              .ambient = {0.1, 0.05, 0},
                              .diffuse = {0.3, 0.25, 0.2},
                              .specular = {0.3, 0.2, 0.3},
                              .constant = 0.75,
                              .linear = 0.125};
    world.lights[1] = (Light){.direction = {-1, 1, 2},
                              .space = LIGHT_EYE,
                              .ambient = {0, 0.05, 0.1},
                              .diffuse = {0.1, 0.2, 0.25},
                              .specular = {0.2, 0.1, 0.1}};
    world.lights[2] = (Light){.kind = LIGHT_SPOT,
                              .position = {0, 0, 4},
                              .direction = {0.05, 0, -1},
                              .ambient = {0.1, 0.1, 0.1},
                              .diffuse = {0.2, 0.1, 0.1},
                              .specular = {0.1, 0.2, 0.1},
                              .cutoff = 12,
                              .exponent = 4};
    world.object =
        (Object){.mesh = mesh,
                 .closed = mesh != &quad,
                 .world_from_object = mat4_identity(),
                 .front = {{0.5, 0.4, 0.3}, {0.6, 0.5, 0.3}, {0.5, 0.6, 0.7}, {0.05, 0, 0.1}, 1, 9},
                 .two_sided = true,
                 .back = {{0.2, 0.4, 0.6}, {0.3, 0.5, 0.6}, {0.5, 0.2, 0.3}, {0, 0.1, 0}, 1, 20}};
    world.scene = (Scene){.camera = {.eye = {0, 0, 4}, .up = {0, 1, 0}, .near = 0.5, .far = 40},
                          .global_ambient = {0.2, 0.1, 0.15},
                          .lights = world.lights,
                          .light_count = LIGHTS,
                          .objects = &world.object,
                          .object_count = 1};
    world.scene.camera.fovy = 2 * atan(TANGENT) * 57.29577951308232;
}

static void draw_scene(const Scene *scene, Image *image)
{
    picture_draw(&canvas, lighting, &(LightingFrame){.scene = scene}, image);
}

static void draw_terms(SceneTerms terms, Image *image)
{
    CLOSED(scene_copy_close) SceneCopy copy = {.lights = NULL};
    scene_copy_open(&copy, &world.scene);
    scene_keep_terms(&copy, terms);
    draw_scene(&copy.scene, image);
}

static const float *pixel(const Image *image, int x, int y)
{
    return (const float *)image->pixels + 4 * (y * SIZE + x);
}

/* The largest difference of the pixels where `counts`, NULL: of all. */
static double largest_difference(const Image *a, const Image *b, bool (*counts)(int x, int y))
{
    double max = 0;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++)
            for (int c = 0; c < 3 && (!counts || counts(x, y)); c++)
                max = fmax(max, fabs((double)pixel(a, x, y)[c] - (double)pixel(b, x, y)[c]));
    return max;
}

/* The viewer's lights. */

/* Whether the ray through a pixel's center passes the unit sphere's center, seen from 4 away,
 * nearer than 0.95. */
static bool inside_sphere(int x, int y)
{
    const double u = TANGENT * ((x + 0.5) / SIZE * 2 - 1), v = TANGENT * ((y + 0.5) / SIZE * 2 - 1);
    const double square = u * u + v * v;
    return 4 * sqrt(square / (1 + square)) < 0.95;
}

/* A normal of the fine mesh is off by its interpolation, 1e-4, which the highlight's exponent of 9
 * makes 1e-3 at most; the edge of a cone is a jump, so that there is none. */
TEST(a_sphere_lit_by_the_viewer_looks_the_same_from_every_side)
{
    Random random = {3};
    make_world(&fine_sphere);
    world.scene.light_count = 2;
    world.lights[0].space = LIGHT_EYE;
    world.lights[0].position.z -= 4;
    draw_scene(&world.scene, &picture);
    for (int i = 0; i < 12; i++) {
        const double z = random_between(&random, -0.9, 0.9), a = random_between(&random, 0, 6);
        const double r = sqrt(1 - z * z);
        world.scene.camera.eye = (Vec3){4 * r * cos(a), 4 * r * sin(a), 4 * z};
        world.scene.camera.up = (Vec3){random_between(&random, -0.2, 0.2), 0, 1};
        draw_scene(&world.scene, &other);
        assert_true(largest_difference(&picture, &other, inside_sphere) < 1e-3);
    }
    world.lights[0].space = LIGHT_WORLD; /* which moves over the picture */
    draw_scene(&world.scene, &other);
    assert_true(largest_difference(&picture, &other, inside_sphere) > 0.05);
}

/* Diffuse light. */

/* The diffuse color of a point of the plane z = 0. */
static double diffuse_of(const Light *light, double diffuse, double x, double y)
{
    const Vec3 way = vec3_subtract(light->position, (Vec3){x, y, 0});
    const double d = vec3_length(way);
    return diffuse * fmax(way.z, 0) / d / (light->constant + light->linear * d);
}

TEST(diffuse_light_does_not_depend_on_the_viewer)
{
    static const double distances[] = {1.5, 2, 2.5, 4};
    const SceneTerms diffuse = {.left_out = TERM_ALL & ~TERM_DIFFUSE, .lights_left_out = ~1U};
    for (int i = 0; i < 4; i++) {
        int compared = 0;
        make_world(&quad);
        world.scene.camera.eye.z = distances[i];
        draw_terms(diffuse, &picture);
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                const double extent = TANGENT * distances[i];
                const double u = extent * ((x + 0.5) / SIZE * 2 - 1);
                const double v = extent * (1 - (y + 0.5) / SIZE * 2);
                if (fabs(u) > 0.95 || fabs(v) > 0.95)
                    continue;
                const double expected = diffuse_of(&world.lights[0], 0.3 * 0.6, u, v);
                /* Floats, and corners rounded to 1/256 of a pixel. */
                assert_true(fabs((double)pixel(&picture, x, y)[0] - expected) < 1e-4);
                compared++;
            }
        }
        assert_true(compared > SIZE * SIZE / 4);
    }
}

/* Sums. */

static void add_picture(Image *sum, const Image *part, float factor)
{
    for (int i = 0; i < 4 * SIZE * SIZE; i++)
        ((float *)sum->pixels)[i] += factor * ((const float *)part->pixels)[i];
}

/* What is added to and taken from a black picture is the whole: twelve products at most, each
 * rounded to 2^-24 of what is below 1, by two programs whose powers may differ by 2^-20. */
static const double ROUNDING = 1e-5;

/* Each interpolation, with and without colors of vertices, from the front and from behind. */
static void for_each_world(void (*check)(void))
{
    for (int bits = 0; bits < 16; bits++) {
        make_world(bits & 4 ? &colored_sphere : &sphere);
        world.scene.interpolation = (Interpolation)(bits & 3);
        world.scene.reflection = bits & 1 ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG;
        world.object.clockwise = bits & 8;
        check();
    }
}

static void check_terms(void)
{
    static const unsigned terms[] = {TERM_AMBIENT, TERM_DIFFUSE, TERM_SPECULAR, TERM_EMISSION};
    CLOSED(image_close) Image sum = {.width = 0};
    SUCCEEDS(image_open(&sum, SIZE, SIZE, IMAGE_FLOAT, message));
    memset(sum.pixels, 0, image_row_size(&sum) * SIZE);
    for (int i = 0; i < 4; i++) {
        draw_terms((SceneTerms){.left_out = TERM_ALL & ~terms[i]}, &other);
        add_picture(&sum, &other, 1);
        for (int k = i + 1; k < 4; k++) { /* of two terms, too */
            draw_terms((SceneTerms){.left_out = TERM_ALL & ~terms[k]}, &picture);
            add_picture(&picture, &other, 1);
            CLOSED(image_close) Image both = {.width = 0};
            SUCCEEDS(image_open(&both, SIZE, SIZE, IMAGE_FLOAT, message));
            draw_terms((SceneTerms){.left_out = TERM_ALL & ~(terms[i] | terms[k])}, &both);
            assert_true(largest_difference(&picture, &both, NULL) < ROUNDING);
        }
    }
    draw_scene(&world.scene, &picture);
    assert_true((double)pixel(&picture, SIZE / 2, SIZE / 2)[1] > 0.05);
    assert_true(largest_difference(&sum, &picture, NULL) < ROUNDING);
}

TEST(the_terms_add_up_to_the_whole)
{
    for_each_world(check_terms);
}

/* Emission and global ambient light are in every picture. */
static void check_lights(void)
{
    CLOSED(image_close) Image sum = {.width = 0};
    SUCCEEDS(image_open(&sum, SIZE, SIZE, IMAGE_FLOAT, message));
    memset(sum.pixels, 0, image_row_size(&sum) * SIZE);
    for (unsigned i = 0; i < LIGHTS; i++) {
        draw_terms((SceneTerms){.lights_left_out = ~(1U << i)}, &other);
        add_picture(&sum, &other, 1);
    }
    draw_terms((SceneTerms){.lights_left_out = ~0U}, &other);
    add_picture(&sum, &other, 1 - LIGHTS);
    draw_scene(&world.scene, &picture);
    assert_true(largest_difference(&sum, &picture, NULL) < ROUNDING);
}

TEST(the_lights_add_up_to_the_whole)
{
    for_each_world(check_lights);
}

TEST(without_lighting_the_color_is_exact)
{
    static const SceneTerms unlit = {.unlit = true};
    make_world(&sphere);
    world.object.front.diffuse = (Vec3){0.1, 1, 1.0 / 3};
    draw_terms(unlit, &picture);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++)
            if (inside_sphere(x, y))
                for (int c = 0; c < 3; c++)
                    assert_true(pixel(&picture, x, y)[c] ==
                                (float)(&world.object.front.diffuse.x)[c]);
}

TEST(polygon_offset_does_not_change_colors)
{
    make_world(&sphere);
    draw_scene(&world.scene, &picture);
    world.object.behind_lines = true;
    draw_scene(&world.scene, &other);
    assert_memory_equal(picture.pixels, other.pixels, image_row_size(&picture) * SIZE);
}

PICTURE_TEST_MAIN("closed form", open_all, close_all)
