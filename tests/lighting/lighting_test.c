/*
 * Pictures of the lighting model, and the programs that draw them: the specialized program
 * draws what the full program draws. The model itself: fixed_function_test.c, and the pictures of
 * the reference, whose equation is the oracle's (reference_solid_test.c).
 */
#include "core/mesh_make.h"
#include "hard/random_scene.h"
#include "lighting/case_world.h"
#include "support/picture_check.h"

static void check_case(const Case *c)
{
    const char *name = formatted("light%d:%d-%d%d%d%d", c->kinds[0], c->terms[0], c->interpolation,
                                 c->reflection, c->distant_viewer, c->two_sided);
    make_world(c);
    draw_both();
    /* Rounding decides for pixels on a discontinuity (a spot's cone, the end of the highlight,
     * a change of sides): at most 2 here. */
    if (!pictures_agree(name, &specialised, &full, 2))
        fail();
}

/* Every set of terms of every kind of light, at both frequencies. */
TEST(each_light_draws_its_terms_as_the_full_program)
{
    int number = 0, taken = 0;
    for (int bits = 0; bits < 2 * 2 * 2 * 2; bits++)
        for (int terms = 0; terms < 8; terms++)
            for (int kind = 0; kind < KIND_COUNT; kind++) {
                const bool two_sided = bits & 1;
                const Case c = {
                    .terms = {terms},
                    .kinds = {kind},
                    .light_count = 1,
                    .shape = two_sided ? TUBE : SPHERE,
                    .turn = (Turn)(number++ % TURNS),
                    .interpolation = bits & 2 ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG,
                    .reflection = bits & 4 ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG,
                    .distant_viewer = bits & 8,
                    .two_sided = two_sided,
                };
                if ((c.reflection == REFLECTION_BLINN_PHONG && !c.distant_viewer) ||
                    (terms & SPECULAR)) {
                    if (taken++ % testing_step(39) == 0)
                        check_case(&c);
                }
            }
}

/* Everything together, with lights that share code or do not. */
TEST(random_scenes_draw_as_the_full_program)
{
    const unsigned long long seed = testing_seed(20240611);
    RandomMeshes meshes = {.first = NULL};
    int drawn = 0;
    for (int i = 0; drawn < testing_part(150, 10); i++) {
        RandomScene made;
        Random random = {seed + (unsigned)i};
        random_scene_make(&made, random.state, seed);
        made.scene.signed_dots = random_below(&random, 3) == 0;
        for (int k = 0; k < made.scene.object_count; k++) {
            made.objects[k].front.alpha = random_below(&random, 2) ? 1 : 0.6;
            made.objects[k].back.alpha = random_below(&random, 2) ? 1 : 0.3;
        }
        SUCCEEDS(random_scene_ready(&made, &meshes, message));
        if (random_scene_grazes(&made))
            continue;
        render(&made.scene, false, &specialised);
        render(&made.scene, true, &full);
        drawn++;
        if (!pictures_agree("random", &specialised, &full, 2))
            fail_msg("scene %d", i);
    }
    lighting_forget(lighting, NULL);
    random_meshes_close(&meshes);
}

/* Guards. */

/* Whether the program guards the attenuation; all other guards are always there. */
static bool is_guarded(const Scene *scene, bool with_all)
{
    ShaderSource sources[2];
    SUCCEEDS(lighting_sources(lighting, scene, scene->objects, with_all, sources, message));
    bool found = false;
    for (int stage = 0; stage < 2; stage++) {
        found |= strstr(sources[stage].text, "#define GUARD_ATTENUATION") != NULL;
        shader_source_close(&sources[stage]);
    }
    return found;
}

/* Lights on and near the object, the object between light and eye, the eye near the object. */
TEST(guarded_cases_draw_as_the_full_program)
{
    int guarded = 0, unguarded = 0;
    random_state.state = 20240612;
    for (int i = 0; i < 150; i += testing_step(3)) {
        Case c = {.terms = {7},
                  .kinds = {below(KIND_COUNT)},
                  .light_count = 1,
                  .shape = (Shape)below(3),
                  .turn = (Turn)below(TURNS),
                  .interpolation = (Interpolation)below(2),
                  .distant_viewer = below(2)};
        make_world(&c);
        Camera *camera = &world.scene.camera;
        Light *light = &world.lights[0];
        camera->eye = vec3_scale(random_direction(), between(1.4, 5));
        camera->near = 0.01;
        light->position = vec3_scale(random_direction(), between(0.6, 3));
        if (below(3) == 0)
            light->position = vec3_scale(camera->eye, -between(0.4, 2));
        light->direction = vec3_scale(light->position, light->kind == LIGHT_SPOT ? -1 : 1);
        light->cutoff = 60;
        light->constant = below(4) == 0;
        /* Bounded so that rounding moves no pixel by more than a level. */
        light->diffuse = light->specular = (Vec3){0.3, 0.3, 0.3};
        if (is_guarded(&world.scene, false))
            guarded++;
        else
            unguarded++;
        draw_both();
        if (!pictures_agree("guards", &specialised, &full, 4))
            fail_msg("scene %d", i);
    }
    print_message("%d guarded, %d unguarded\n", guarded, unguarded);
    const int enough = testing_step(3) == 1 ? 30 : 0; /* of a dozen, any */
    assert_true(guarded > enough && unguarded > enough);
}

/* With multisampling a pixel may be shaded at a point outside the triangle: no other program is
 * needed, because guards do not depend on where the object is. */
TEST(multisampling_uses_the_same_program)
{
    Canvas samples;
    Message message = {0};
    const CanvasOptions options = {.width = SIZE, .height = SIZE, .samples = 4};
    if (!canvas_open_beside(&samples, &canvas, &options, &message)) {
        print_message("%s\n", message.text);
        skip();
    }
    make_world(&(Case){.terms = {7}, .kinds = {7}, .light_count = 1});
    render(&world.scene, false, &specialised);
    const int before = lighting_counts(lighting).programs;
    canvas_begin(&samples);
    assert_true(
        lighting_show(lighting, &(LightingFrame){.scene = &world.scene, .aspect = 1}, &message));
    assert_int_equal(lighting_counts(lighting).programs, before);
    canvas_close(&samples);
}

/* The model-view matrix instead of the normal matrix. */
TEST(wrong_normals_differ_only_where_the_scale_is_uneven)
{
    for (int turn = 0; turn < TURNS; turn++) {
        make_world(&(Case){.terms = {7}, .light_count = 1, .turn = (Turn)turn, .base = true});
        render(&world.scene, false, &full);
        world.object.wrong_normals = true;
        render(&world.scene, false, &specialised);
        const bool same = memcmp(specialised.pixels, full.pixels, (size_t)SIZE * SIZE * 4) == 0;
        assert_int_equal(same, turn != UNEVEN && turn != SHEARED);
        render(&world.scene, true, &full);
        assert_true(pictures_agree("wrong normals", &specialised, &full, 4));
    }
}

TEST(flat_is_gouraud_with_the_normals_of_triangles)
{
    CLOSED(mesh_close) Mesh flat;
    SUCCEEDS(mesh_copy(&flat, &sphere, message) && mesh_flatten(&flat, message));
    make_world(&(Case){.terms = {7}, .kinds = {1}, .light_count = 1, .turn = UNEVEN});
    world.scene.interpolation = INTERPOLATION_FLAT;
    render(&world.scene, false, &specialised);
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    render(&world.scene, false, &full);
    assert_memory_not_equal(specialised.pixels, full.pixels, (size_t)SIZE * SIZE * 4);
    world.object.mesh = &flat;
    world.object.flat = true;
    render(&world.scene, false, &full);
    assert_true(pictures_agree("flat", &specialised, &full, 0));
    lighting_forget(lighting, &flat);
}

/* Programs are shared. */

static int programs(void)
{
    return lighting_counts(lighting).programs;
}

TEST(changing_a_value_compiles_nothing)
{
    make_world(&RICH);
    render(&world.scene, false, &specialised);
    const int before = programs();
    world.lights[0].diffuse = (Vec3){0.1, 0.9, 0};
    world.lights[0].direction = (Vec3){-3, 1, 1};
    world.lights[1].position.x = -1;
    world.lights[1].quadratic = 0.3;
    world.lights[2].cutoff = 20;
    world.lights[2].exponent = 3;
    world.object.front = (Material){{0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}, {1, 0, 0}, 0.5, 99};
    world.object.world_from_object.m[0] *= 1.25;
    world.scene.camera.eye.x = 0.5;
    world.scene.global_ambient = (Vec3){0, 0, 0};
    render(&world.scene, false, &full);
    assert_int_equal(programs(), before);
    assert_memory_not_equal(specialised.pixels, full.pixels, (size_t)SIZE * SIZE * 4);
    world.lights[2].exponent = 0;
    render(&world.scene, false, &full);
    assert_int_equal(programs(), before + 1);
    world.lights[2].exponent = 2;
    render(&world.scene, false, &full);
    assert_int_equal(programs(), before + 1);
}

TEST(a_light_that_is_off_adds_nothing_and_compiles_nothing)
{
    make_world(&RICH);
    world.scene.light_count = 2;
    render(&world.scene, false, &specialised);
    const int before = programs();
    world.scene.light_count = 3;
    world.lights[2].off = true;
    render(&world.scene, false, &full);
    assert_int_equal(programs(), before);
    assert_memory_equal(specialised.pixels, full.pixels, (size_t)SIZE * SIZE * 4);
    render(&world.scene, true, &full);
    assert_true(pictures_agree("light off", &specialised, &full, 4));
}

/* Limits and failures. */

TEST(a_broken_shader_is_reported_with_its_line_and_not_counted)
{
    char folder[] = "/tmp/lighting_test_XXXXXX", path[64], beginning[80];
    Lighting *broken;
    Message message = {0};
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/group.glsl", folder);
    snprintf(beginning, sizeof beginning, "%s:3:", path);
    testing_write(path, "// One,\n// two,\nthree.\n", 23);
    make_world(&RICH);
    assert_true(lighting_open(&broken, &(ShaderLoader){.folder = folder}, &message));
    assert_false(
        lighting_show(broken, &(LightingFrame){.scene = &world.scene, .aspect = 1}, &message));
    remove(path);
    remove(folder);
    if (strncmp(message.text, beginning, strlen(beginning)) != 0)
        fail_msg("\"%s\" does not begin with \"%s\"", message.text, beginning);
    assert_int_equal(lighting_counts(broken).programs, 0);
    lighting_close(broken);
}

PICTURE_TEST_MAIN("lighting", open_all, close_all)
