/*
 * The lighting model as drawn, against the lighting equation in double precision, on shapes that
 * have a formula: every kind of light, side, interpolation and output.
 */
#include "lighting/lighting_world.h"
#include "support/oracle.h"
#include "support/picture_check.h"
#include "support/testing.h"

/* False: no closed form here, or near what jumps: an edge, a light's, or the silhouette, where the
 * mesh lies inside the sphere. */
static bool closed_form(const Scene *scene, int x, int y, double expected[3])
{
    OraclePoint hit;
    if (!oracle_trace(scene, SIZE, SIZE, x, y, &hit) || hit.steepness < 0.15 ||
        (hit.object->mesh == &quad && fmax(fabs(hit.place.x), fabs(hit.place.y)) > 0.98))
        return false;
    const Vec3 sum = oracle_light(scene, &hit);
    const double max = fmax(sum.x, fmax(sum.y, sum.z));
    oracle_show(scene, sum, expected);
    return hit.from_jump >= 1e-3 && !(scene->show_clipped && fabs(max - 1) < 1e-3);
}

/* Compares every pixel that has a closed form, and reports how many. */
static int assert_closed_form(const Scene *scene, const char *name)
{
    int compared = 0, wrong = 0;
    render(scene, false, &specialised);
    memcpy(full.pixels, specialised.pixels, (size_t)SIZE * SIZE * 4);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            double expected[3];
            if (!closed_form(scene, x, y, expected))
                continue;
            compared++;
            for (int c = 0; c < 3; c++) {
                /* Half a level for rounding to bytes. The mesh of the sphere is within 1e-4 of the
                 * sphere, which changes the steepest highlight here by less than half a level. */
                wrong += fabs(pixel(&specialised, x, y)[c] - expected[c]) > 1;
                pixel(&full, x, y)[c] = (unsigned char)lround(expected[c]);
            }
        }
    }
    if (wrong) {
        picture_check_keep(name, &specialised, &full);
        fail_msg("%s: %d values more than one level from the closed form", name, wrong);
    }
    return compared;
}

static const Material SHINY = {
    {0.3, 0.2, 0.1}, {0.6, 0.5, 0.3}, {0.5, 0.6, 0.7}, {0.05, 0, 0.02}, 1, 24};
static const Material DULL = {
    {0.1, 0.2, 0.4}, {0.2, 0.5, 0.6}, {0.3, 0.1, 0.2}, {0, 0.05, 0.1}, 1, 6};

static void closed_form_world(const Mesh *mesh, Turn turn)
{
    memset(&world, 0, sizeof world);
    world.object =
        (Object){.mesh = mesh,
                 .solid = {.kind = mesh == &quad ? SOLID_QUAD : SOLID_SPHERE, .radius = 1},
                 .closed = mesh != &quad,
                 .world_from_object = turn_matrix(turn),
                 .front = SHINY,
                 .back = DULL};
    world.scene = (Scene){
        .camera = {{0.25, 0.5, 4}, {0, 0, 0}, {0.1, 1, 0}, 32, 0.5, 20, 0},
        .background = BACKGROUND,
        .global_ambient = {0.2, 0.15, 0.1},
        .lights = world.lights,
        .light_count = 1,
        .objects = &world.object,
        .object_count = 1,
    };
}

TEST(each_light_reflection_and_viewer_has_its_closed_form)
{
    for (int flat = 0; flat < 2; flat++) {
        for (int kind = 0; kind < KIND_COUNT; kind++) {
            for (int bits = 0; bits < 4; bits++) {
                char name[64];
                snprintf(name, sizeof name, "closed-form-%s-light%d-%d", flat ? "quad" : "sphere",
                         kind, bits);
                closed_form_world(flat ? &quad : &smooth_sphere, (Turn)((kind + bits) % TURNS));
                world.lights[0] = light_of(0, 7, KINDS[kind]);
                world.scene.reflection = bits & 1 ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG;
                world.scene.distant_viewer = bits & 2;
                assert_true(assert_closed_form(&world.scene, name) > SIZE * SIZE / 8);
            }
        }
    }
}

TEST(attenuation_has_its_closed_form)
{
    static const Vec3 factors[] = {{0, 0, 0}, {2, 0, 0}, {0, 0.5, 0}, {0, 0, 0.2}, {0.3, 0.2, 0.1}};
    for (size_t i = 0; i < sizeof factors / sizeof factors[0]; i++) {
        closed_form_world(&quad, RIGID);
        world.lights[0] = light_of(1, 7, (Kind){LIGHT_POINT, factors[i].x, factors[i].y, 0});
        world.lights[0].quadratic = factors[i].z;
        assert_closed_form(&world.scene, "closed-form-attenuation");
    }
}

/* The quad is seen from the front, from behind, and from behind with two sides. */
TEST(both_sides_of_a_quad_have_their_closed_forms)
{
    for (int bits = 0; bits < 4; bits++) {
        for (int turn = 0; turn < TURNS; turn++) {
            closed_form_world(&quad, (Turn)turn);
            world.lights[0] = light_of(0, 7, KINDS[3]);
            const Mat4 about = mat4_rotate(bits & 1 ? 180 : 0, (Vec3){0, 1, 0});
            world.object.world_from_object = mat4_product(about, world.object.world_from_object);
            world.object.two_sided = bits & 2;
            world.scene.camera.up = (Vec3){0, 1, 0};
            assert_true(assert_closed_form(&world.scene, "closed-form-side") > SIZE * SIZE / 16);
        }
    }
}

TEST(linear_light_and_clipping_have_their_closed_forms)
{
    for (int bits = 1; bits < 4; bits++) {
        closed_form_world(&smooth_sphere, RIGID);
        world.lights[0] = light_of(0, 7, KINDS[0]);
        world.lights[0].diffuse = (Vec3){1.5, 1.25, 1};
        world.scene.linear = bits & 1;
        world.scene.show_clipped = bits & 2;
        assert_true(assert_closed_form(&world.scene, "closed-form-output") > SIZE * SIZE / 8);
    }
}

/* Not clamped, the light behind takes from what the other one and ambient light bring. */
TEST(a_negative_cosine_takes_light_away)
{
    static const Kind BEHIND = {LIGHT_DIRECTIONAL, 0, 0, 0}, SPOT = {LIGHT_SPOT, 0, 0.1, 4};
    for (int way = 0; way < 4; way++) {
        closed_form_world(way < 2 ? &quad : &smooth_sphere, (Turn)way);
        world.lights[0] = light_of(0, 7, way & 1 ? SPOT : BEHIND);
        world.lights[0].direction = vec3_scale(world.lights[0].direction, -1);
        world.lights[0].position = vec3_scale(world.lights[0].position, -1);
        world.lights[1] = light_of(1, 7, KINDS[3]);
        world.scene.light_count = 2;
        world.scene.signed_dots = true;
        assert_true(assert_closed_form(&world.scene, "closed-form-signed") > SIZE * SIZE / 8);
        const int taken = pixel(&specialised, SIZE / 2, SIZE / 2)[0];
        world.scene.signed_dots = false;
        assert_true(assert_closed_form(&world.scene, "closed-form-signed") > SIZE * SIZE / 8);
        assert_true(taken + 8 < pixel(&specialised, SIZE / 2, SIZE / 2)[0]);
    }
}

TEST(flat_is_gouraud_with_the_normals_of_triangles)
{
    CLOSED(mesh_close) Mesh flat;
    assert_true(mesh_sphere(&flat, 1, 24, 12, NULL));
    assert_true(mesh_flatten(&flat, NULL));
    closed_form_world(&sphere, UNEVEN);
    world.lights[0] = light_of(0, 7, KINDS[1]);
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    render(&world.scene, false, &full);
    world.scene.interpolation = INTERPOLATION_FLAT;
    render(&world.scene, false, &specialised);
    assert_memory_not_equal(specialised.pixels, full.pixels, (size_t)SIZE * SIZE * 4);
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    world.object.mesh = &flat;
    world.object.flat = true;
    render(&world.scene, false, &full);
    assert_true(pictures_agree("flat", &specialised, &full, 0));
    lighting_forget(lighting, &flat);
}

/* The model-view matrix instead of the normal matrix. */
TEST(wrong_normals_differ_only_where_the_scale_is_uneven)
{
    for (int turn = 0; turn < TURNS; turn++) {
        closed_form_world(&sphere, (Turn)turn);
        world.lights[0] = light_of(0, 7, KINDS[0]);
        render(&world.scene, false, &full);
        world.object.wrong_normals = true;
        render(&world.scene, false, &specialised);
        const bool same = memcmp(specialised.pixels, full.pixels, (size_t)SIZE * SIZE * 4) == 0;
        assert_int_equal(same, turn != UNEVEN && turn != SHEARED);
        render(&world.scene, true, &full);
        assert_true(pictures_agree("wrong normals", &specialised, &full, 4));
    }
}

PICTURE_TEST_MAIN("equation", open_all, close_all)
