/*
 * Shadow maps against the exact picture of the meshes: of the pixels inside surfaces so many may be
 * wrong, and with less bias more are. Maps are drawn when something has moved.
 */
#include "lighting/shadow_world.h"
#include "scene/scene_example.h"
#include "support/examples.h"
#include "support/picture_check.h"
#include "support/testing.h"

static void use_map(int size, int smooth, Vec3 bias)
{
    const ShadowSettings settings = {SHADOWS_MAP, size, smooth, bias};
    lighting_use_shadows(lighting, &settings);
}

/* One light of each kind, of the 4000 pixels inside. Measured: 7, 0 and 0. */
TEST(maps_are_nearly_right)
{
    static const struct {
        int size, smooth;
        long long most;
    } sizes[] = {{128, 0, 20}, {1024, 0, 4}, {1024, 1, 8}};
    bool all = true;
    SUCCEEDS(Shadows.init(&(ShaderLoader){.precision = "highp"}, message));
    for (int light = 0; light < 3; light++)
        for (int i = 0; i < 3; i++) {
            Scene scene = {.object_count = 0};
            CLOSED(scene_copy_close) SceneCopy copy;
            example_scene(&Shadows)->make(1, 0, &scene);
            scene_copy_open(&copy, &scene);
            for (int k = 0; k < 3; k++)
                copy.lights[k].off = k != light;
            use_map(sizes[i].size, sizes[i].smooth, SHADOWS_DEFAULT.bias);
            all &= check_wrong(formatted("map-%d-%d-%d", light, sizes[i].size, sizes[i].smooth),
                               &copy.scene, sizes[i].most);
        }
    lighting_forget(lighting, NULL);
    Shadows.finish();
    use_way(SHADOWS_VOLUMES);
    assert_true(all);
}

/* A light among boxes, so that a cube of maps is needed; the same with depths in colors, as where
 * the driver has no depth textures. */

static PFNGLTEXIMAGE2DPROC own_image;

static void GL_APIENTRY no_depth_texture(GLenum target, GLint level, GLint made, GLsizei width,
                                         GLsizei height, GLint border, GLenum format, GLenum type,
                                         const void *pixels)
{
    if (format != GL_DEPTH_COMPONENT)
        own_image(target, level, made, width, height, border, format, type, pixels);
}

TEST_WITH(0, a_cube_of_maps_surrounds_a_light, open_meshes, close_meshes)
{
    static unsigned char before[4 * WIDTH * HEIGHT];
    const long long drawn = lighting_counts(lighting).maps;
    bool all = true;
    use_map(512, 0, SHADOWS_DEFAULT.bias);
    static const Vec3 places[2] = {{-1.5, 0.4, -1}, {1.5, 0.2, -1.2}};
    make_world(&box);
    turn_first(
        mat4_product(mat4_translate((Vec3){0, -0.6, 1.5}), mat4_scale((Vec3){0.4, 0.4, 0.4})));
    for (int i = 0; i < 2; i++) {
        world.objects[2 + i] = world.objects[0];
        world.objects[2 + i].world_from_object =
            mat4_product(mat4_translate(places[i]), mat4_scale((Vec3){0.3, 0.5 + i * 0.3, 0.4}));
    }
    world.scene.object_count = 4;
    world.lights[0].position = (Vec3){0, 0.5, -0.2};
    all &= check_wrong("cube", &world.scene, 4);
    assert_in_range(lighting_counts(lighting).maps - drawn, 2, 6);
    memcpy(before, image.pixels, sizeof before);

    Lighting *plain = lighting;
    own_image = glTexImage2D;
    glTexImage2D = no_depth_texture;
    SUCCEEDS(lighting_open(&lighting, &(ShaderLoader){.precision = "highp"}, message));
    use_map(512, 0, SHADOWS_DEFAULT.bias);
    all &= check_wrong("cube, packed", &world.scene, 4);
    glTexImage2D = own_image;
    assert_in_range(pixels_apart(before, image.pixels, WIDTH * HEIGHT, 1), 0, 13);
    lighting_close(lighting);
    lighting = plain;
    use_way(SHADOWS_VOLUMES);
    assert_true(all);
}

/* In one program. Measured: 3 and 8 wrong. */
TEST_WITH(0, each_light_has_its_map, open_meshes, close_meshes)
{
    static const int counts[] = {3, 8};
    bool all = true;
    use_map(1024, 0, SHADOWS_DEFAULT.bias);
    for (int i = 0; i < 2; i++) {
        make_eight_lights();
        world.scene.light_count = counts[i];
        all &= check_wrong(formatted("%d-maps", counts[i]), &world.scene, 16);
    }
    use_way(SHADOWS_VOLUMES);
    assert_true(all);
}

static long long maps_drawn(void)
{
    const long long before = lighting_counts(lighting).maps;
    draw(&world.scene, false);
    return lighting_counts(lighting).maps - before;
}

/* What has no room in the program goes through masks; the lights' own varyings take room, too. */
TEST_WITH(0, many_lights_with_maps_are_drawn, open_meshes, close_meshes)
{
    use_map(64, 0, SHADOWS_DEFAULT.bias);
    make_eight_lights();
    for (int i = 8; i < 20; i++)
        world.lights[i] = world.lights[i % 8];
    world.objects[0].two_sided = true;
    for (int count = 12; count <= 20; count += 4) {
        world.scene.light_count = count;
        for (int i = INTERPOLATION_PHONG; i <= INTERPOLATION_CONSTANT; i++) {
            world.scene.interpolation = (Interpolation)i;
            draw(&world.scene, false);
        }
    }
    use_way(SHADOWS_VOLUMES);
}

/* Only for a light that needs one, and only when the light or what casts has moved. */
TEST_WITH(0, maps_are_drawn_when_something_has_moved, open_meshes, close_meshes)
{
    use_map(64, 0, SHADOWS_DEFAULT.bias);
    make_world(&ball);
    world.lights[1] = world.lights[0];
    world.lights[1].position = (Vec3){0, -4, 0}; /* nothing between it and the floor's back */
    world.objects[0].front.diffuse = (Vec3){0.5, 0.6, 0.7};
    world.scene.light_count = 1;
    assert_int_equal(maps_drawn(), 1);
    assert_int_equal(maps_drawn(), 0);
    world.scene.camera.eye.x += 0.5;
    world.lights[0].diffuse = (Vec3){0.5, 0.5, 0.5};
    assert_int_equal(maps_drawn(), 0);
    world.lights[0].position.x += 1e-9;
    assert_int_equal(maps_drawn(), 1);
    turn_first(mat4_translate((Vec3){1e-9, 0, 0}));
    assert_int_equal(maps_drawn(), 1);
    use_map(65, 0, SHADOWS_DEFAULT.bias);
    assert_int_equal(maps_drawn(), 1);
    use_map(65, 1, (Vec3){0, 0, 0});
    assert_int_equal(maps_drawn(), 0);
    lighting_forget(lighting, NULL);
    assert_int_equal(maps_drawn(), 1);
    world.scene.object_count = 1; /* nothing receives */
    assert_int_equal(maps_drawn(), 0);
    world.scene.object_count = 2;
    world.lights[0].shadows = false;
    assert_int_equal(maps_drawn(), 0);
    use_way(SHADOWS_VOLUMES);
}

/* What maps without care get wrong, as tests/programs/hard_cases_test.py shows. */

static void make_grazing(void)
{
    make_world(&box);
    world.lights[0].kind = LIGHT_DIRECTIONAL;
    world.lights[0].direction = (Vec3){1, 0.12, 0.3};
    world.objects[1].solid = (Solid){.kind = SOLID_NONE}; /* not known to be convex: in its map */
}

/* A plate 0.08 thick, 0.05 above the floor. */
static void make_plate(void)
{
    make_world(&box);
    turn_first(mat4_product(mat4_translate((Vec3){0, -1.11, 0}), mat4_scale((Vec3){1, 0.05, 1})));
    world.lights[0].position = (Vec3){4, 0.2, 1};
}

static void make_slit(void)
{
    make_world(&box);
    turn_first(mat4_translate((Vec3){-0.86, 0, 0}));
    world.objects[2] = world.objects[0];
    world.objects[2].world_from_object = mat4_translate((Vec3){0.86, 0, 0});
    world.scene.object_count = 3;
    world.lights[0].position = (Vec3){0, 4, 0.3};
}

/* A ring of 7 by 10 facets with smooth normals. */
static void make_terminator(void)
{
    make_world(&coarse_ring);
    world.lights[0].position = (Vec3){3, 1, 1};
}

TEST_WITH(0, maps_are_nearly_right_in_hard_cases, open_meshes, close_meshes)
{
    static const struct {
        const char *name;
        void (*make)(void);
    } cases[] = {{"grazing light", make_grazing},
                 {"a thin plate", make_plate},
                 {"a slit", make_slit},
                 {"a coarse ring", make_terminator}};
    bool all = true;
    use_map(1024, 0, SHADOWS_DEFAULT.bias);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        cases[i].make();
        all &= check_wrong(cases[i].name, &world.scene, 8);
    }
    use_way(SHADOWS_VOLUMES);
    assert_true(all);
}

TEST_WITH(0, maps_larger_than_the_driver_has_are_refused, open_meshes, close_meshes)
{
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    use_map(most + 1, 0, SHADOWS_DEFAULT.bias);
    make_world(&ball);
    FAILS_WITH(
        lighting_show(lighting, &(LightingFrame){.scene = &world.scene, .aspect = 1}, message),
        "textures up to");
    use_way(SHADOWS_VOLUMES);
    assert_true(check("after that", &world.scene));
}

PICTURE_TEST_MAIN("shadow maps", open_all, close_all)
