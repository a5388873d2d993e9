/*
 * Lights that are left out of an object's program, and more of them than a program has: pictures of
 * those that reach it are the full program's and the exact ones.
 */
#include "core/mesh_make.h"
#include "lighting/case_world.h"
#include "reference/picture_error.h"
#include "support/effects_of.h"
#include "support/picture_check.h"

/* A square sheet, flat or bent, so that its normals lie in a cone. */
static void make_sheet(Mesh *mesh, double bend)
{
    enum { SIDE = 8 };
    require(mesh_open(mesh, (SIDE + 1) * (SIDE + 1), mesh_grid_size(SIDE, SIDE, MESH_POLE_NONE),
                      FAILURE),
            FAILURE);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const double x = (double)(i % (SIDE + 1)) / (SIDE / 2) - 1;
        const double y = 1 - (double)(i / (SIDE + 1)) / (SIDE / 2);
        vec3_to_float((Vec3){x, y, -bend * (x * x + y * y)}, mesh->vertices[i].position);
    }
    mesh_grid(mesh->indices, 0, SIDE, SIDE, MESH_POLE_NONE);
    require(mesh_compute_normals(mesh, MESH_WEIGHT_ANGLE, false, FAILURE), FAILURE);
}

/* Lights of all brightnesses around the object: most of those on the other side are behind it, and
 * many of the others too faint. No spots: their edges are where rounding has them. */
static void make_dim_world(const Mesh *sheet)
{
    make_world(&(Case){.turn = (Turn)below(TURNS),
                       .interpolation = (Interpolation)below(3),
                       .reflection = (Reflection)below(2),
                       .distant_viewer = below(2)});
    world.scene.light_count = 12;
    world.scene.linear = below(2);
    world.scene.signed_dots = below(4) == 0;
    world.scene.camera.eye = vec3_scale(random_direction(), 4);
    world.object.mesh = sheet;
    world.object.closed = false;
    world.object.two_sided = below(4) == 0;
    world.object.front = world.object.back =
        (Material){random_color(1), random_color(1), random_color(1), {0, 0, 0}, 1, between(1, 60)};
    for (int i = 0; i < world.scene.light_count; i++) {
        const double bright = pow(10, between(-4, -0.5));
        world.lights[i] = (Light){.kind = below(4) ? LIGHT_POINT : LIGHT_DIRECTIONAL,
                                  .position = vec3_scale(random_direction(), between(0.3, 9)),
                                  .direction = random_direction(),
                                  .ambient = random_color(below(4) ? 0 : bright),
                                  .diffuse = random_color(bright),
                                  .specular = random_color(bright),
                                  .constant = below(2),
                                  .linear = between(0, 1),
                                  .quadratic = below(2) * between(0, 1),
                                  .range = below(3) ? 0 : between(5, 15)};
    }
}

static void draw_floats(const Canvas *floats, bool with_all, Image *picture)
{
    const LightingFrame frame = {.scene = &world.scene, .aspect = 1, .full = with_all};
    canvas_begin(floats);
    canvas_clear(floats, world.scene.background, 1);
    require(scene_check(&world.scene, FAILURE) && lighting_show(lighting, &frame, FAILURE) &&
                canvas_read(floats, picture, FAILURE),
            FAILURE);
}

/* The largest difference of two pictures; of the exact one, if there is one, inside objects. */
static double farthest(const Image *a, const Image *b, const Reference *exact)
{
    double most = 0;
    for (size_t i = 0; i < SIZE * SIZE; i++)
        for (size_t k = 0; k < 3 && (!exact || exact->interior[i]); k++) {
            const double one = (double)((const float *)a->pixels)[4 * i + k];
            const double other = exact ? (double)exact->color[3 * i + k]
                                       : (double)((const float *)b->pixels)[4 * i + k];
            most = fmax(most, fabs((exact ? fmin(fmax(one, 0), 1) : one) - other));
        }
    return most;
}

/* As floats, before they are rounded to bytes. */
TEST(lights_that_are_left_out_change_no_pixel_by_more_than_half_a_step)
{
    /* Of 12 lights in floats, encoded as sRGB; and highlights to the power of 60. */
    const double half = 0.5 / 255, evaluated = 0.1 / 255;
    const CanvasOptions options = {.width = SIZE, .height = SIZE, .real = true};
    Message message = {0};
    Canvas floats;
    CLOSED(mesh_close) Mesh flat = {.vertices = NULL}, bent = {.vertices = NULL};
    CLOSED(image_close) Image with = {.width = 0}, without = {.width = 0};
    int behind = 0, faint = 0;
    double worst[2] = {0, 0};
    random_state.state = testing_seed(20261124);
    if (!canvas_open_beside(&floats, &canvas, &options, &message)) {
        print_message("%s\n", message.text);
        skip();
    }
    make_sheet(&flat, 0);
    make_sheet(&bent, 0.4);
    require(image_open(&with, SIZE, SIZE, IMAGE_FLOAT, FAILURE) &&
                image_open(&without, SIZE, SIZE, IMAGE_FLOAT, FAILURE),
            FAILURE);
    for (int i = 0; i < testing_part(400, 40); i++) {
        Reference exact;
        make_dim_world(below(2) ? &flat : &bent);
        draw_floats(&floats, true, &with);
        draw_floats(&floats, false, &without);
        require(reference_open(&exact, &world.scene,
                               &(ReferenceOptions){
                                   .width = SIZE, .height = SIZE, .meshes = true, .centers = true},
                               FAILURE),
                FAILURE);
        const double apart = farthest(&without, &with, NULL);
        worst[0] = fmax(worst[0], apart);
        worst[1] = fmax(worst[1], farthest(&without, NULL, &exact));
        reference_close(&exact);
        const ObjectFacts facts = effects_facts(&world.scene, &world.object);
        behind += __builtin_popcount(facts.behind);
        faint += __builtin_popcount(facts.faint);
        double bound = 0.01;
        for (int k = 0; k < world.scene.light_count; k++)
            bound += (double)facts.steps[k];
        if (255 * apart > bound || bound > 0.51 || worst[1] > half + evaluated)
            fail_msg("scene %d: %g steps from the full program, of %g; %g from the exact picture",
                     i, 255 * apart, bound, 255 * worst[1]);
    }
    print_message("%d lights behind, %d too faint; %.3f steps at most, %.3f from exact pictures\n",
                  behind, faint, 255 * worst[0], 255 * worst[1]);
    assert_true(behind > 0 && faint > 0);
    lighting_forget(lighting, NULL);
    canvas_close(&floats);
    canvas_begin(&canvas);
}

/* Of more lights than a program has, 25 balls get those that reach them by range and cone; a
 * program each. */
TEST(of_many_lights_each_object_gets_those_that_reach_it)
{
    enum { SIDE = 5, LIGHTS = 100 };
    const int side = testing_step(2) == 1 ? SIDE : 2;
    static Light lights[LIGHTS];
    static Object objects[SIDE * SIDE];
    Reference exact;
    make_world(&RICH);
    random_state.state = testing_seed(20261127);
    for (int i = 0; i < side * side; i++) {
        const Vec3 at = {2.2 * (i % side) - 4.4, 2.2 * (i / side) - 4.4, 0};
        objects[i] = world.object;
        objects[i].mesh = &sphere;
        objects[i].solid.kind = SOLID_NONE;
        objects[i].world_from_object = mat4_translate(at);
    }
    for (int i = 0; i < LIGHTS; i++) {
        const double bright = i < 3 ? 0.1 : between(0.1, 0.6);
        lights[i] = (Light){.kind = i < 3      ? LIGHT_DIRECTIONAL
                                    : below(2) ? LIGHT_POINT
                                               : LIGHT_SPOT,
                            .position = {between(-6, 6), between(-6, 6), between(1, 2)},
                            .direction = {between(-1, 1), between(-1, 1), i < 3 ? 1 : -1},
                            .ambient = random_color(i % 5 ? 0 : 0.02),
                            .diffuse = random_color(bright),
                            .specular = random_color(bright),
                            .cutoff = between(20, 70),
                            .exponent = below(2) * between(1, 9),
                            .range = i < 3 ? 0 : between(0.5, 2.5)};
    }
    world.scene.camera = (Camera){{0, 0, 30}, {0, 0, 0}, {0, 1, 0}, 22, 5, 60, 0};
    world.scene.lights = lights;
    world.scene.light_count = LIGHTS;
    world.scene.objects = objects;
    world.scene.object_count = side * side;
    draw_both();
    assert_true(pictures_agree("many lights", &specialised, &full, 8));
    SUCCEEDS(reference_open(
        &exact, &world.scene,
        &(ReferenceOptions){.width = SIZE, .height = SIZE, .meshes = true, .centers = true},
        message));
    int inside = 0, apart = 0;
    for (size_t i = 0; i < SIZE * SIZE; i++) {
        const bool whole = exact.object[i] >= 0 && exact.coverage[i] > 0.999F;
        inside += whole;
        /* Half a step is left out, and half is rounded; where a cone ends, the driver rounds. */
        apart += whole && pixel_error(&specialised, i, &exact.color[3 * i]).largest > 1.1;
    }
    reference_close(&exact);
    assert_true(inside > 20 * side * side);
    assert_in_range(apart, 0, 8);
}

TEST(the_maximum_of_lights_is_drawn_and_one_more_casts_no_shadow)
{
    Light lights[EFFECTS_MAX_LIGHTS + 1];
    make_world(&RICH);
    world.scene.lights = lights;
    for (int i = 0; i <= EFFECTS_MAX_LIGHTS; i++) {
        lights[i] = light_of(i % 3, 7, KINDS[i % KIND_COUNT]);
        lights[i].position.y += 0.1 * i;
        lights[i].diffuse = vec3_scale(lights[i].diffuse, 0.1);
        lights[i].specular = lights[i].ambient = vec3_scale(lights[i].ambient, 0.05);
    }
    world.scene.light_count = EFFECTS_MAX_LIGHTS;
    draw_both();
    assert_true(pictures_agree("most lights", &specialised, &full, 8));
    world.scene.light_count++; /* the brightest of which are drawn */
    draw_both();
    assert_true(pictures_agree("one more", &specialised, &full, 8));
    lights[EFFECTS_MAX_LIGHTS].shadows = true;
    FAILS(lighting_show(lighting, &(LightingFrame){.scene = &world.scene, .aspect = 1}, message),
          "scene: light 32: only the first 32 may cast shadows");
}

PICTURE_TEST_MAIN("many lights", open_all, close_all)
