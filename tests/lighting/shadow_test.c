/*
 * Shadows as drawn, against the exact picture of the meshes: every view of the programs that are
 * scenes, all of whose lights get shadows, and hard cases. Inside surfaces, where no edge and no
 * shadow's edge runs through the pixel, no pixel may be off by more than one step of 1/255: none is
 * lit that is in shadow, or the other way round. That holds for volumes; for
 * maps see shadow_map_test.c.
 */
#include "base/random.h"
#include "core/mesh_make.h"
#include "kinds/scene_views.h"
#include "lighting/shadow_world.h"
#include "scene/scene_example.h"
#include "support/examples.h"
#include "support/picture_check.h"
#include "support/testing.h"

/* All lights get shadows. */
static void give_shadows(SceneCopy *copy, const Scene *scene)
{
    scene_copy_open(copy, scene);
    for (int i = 0; i < copy->scene.light_count; i++)
        copy->lights[i].shadows = true;
}

TEST(programs_draw_the_shadows_of_the_reference)
{
    static const double times[] = {0, 2.3};
    const int step = testing_step(60);
    int number = 0;
    for (int i = 0; i < EXAMPLE_COUNT; i++) {
        const Example *example = EXAMPLES[i];
        int columns, rows;
        SUCCEEDS(example->init(&(ShaderLoader){.precision = "highp"}, message));
        const int views = scene_view_grid(example_scene(example), &columns, &rows);
        for (int view = 0; view < views; view++)
            for (int t = 0; t < 2; t++) {
                Scene scene = {.object_count = 0};
                SceneCopy copy;
                example_scene(example)->make(times[t], view, &scene);
                if (scene.object_count == 0 || (number++ % step && example != &Shadows))
                    continue;
                give_shadows(&copy, &scene);
                assert_true(check(formatted("%s-%d-%d", example->name, view, t), &copy.scene));
                scene_copy_close(&copy);
            }
        lighting_forget(lighting, NULL);
        example->finish();
    }
}

/* Lights below the floor, behind the wall, and anywhere; eyes in front, at the side, above, behind
 * the wall and below the floor: on either side of the planes that volumes end at. */

static const Vec3 eyes[] = {{0, 2.8, 8.2}, {5, 4.4, 4.8}, {0.3, 8, 0.5}, {-4, 2, -7}, {1, -4, 6}};
enum { EYES = sizeof eyes / sizeof eyes[0] };

/* One light of the program alone, at a place or in a direction. */
static bool check_lit_from(const char *name, double seconds, int light, Vec3 place, Vec3 eye)
{
    Scene scene = {.object_count = 0};
    SceneCopy copy;
    example_scene(&Shadows)->make(seconds, 0, &scene);
    scene_copy_open(&copy, &scene);
    copy.scene.camera.eye = eye;
    for (int i = 0; i < copy.scene.light_count; i++)
        copy.lights[i].off = i != light;
    if (copy.lights[light].kind == LIGHT_DIRECTIONAL)
        copy.lights[light].direction = place;
    else
        copy.lights[light].position = place;
    const bool right = check(formatted("%s, light %d at %.17g,%.17g,%.17g, eye %.3g,%.3g,%.3g",
                                       name, light, place.x, place.y, place.z, eye.x, eye.y, eye.z),
                             &copy.scene);
    scene_copy_close(&copy);
    return right;
}

static Vec3 random_place(Random *random, double size)
{
    Vec3 place;
    place.x = random_between(random, -size, size);
    place.y = random_between(random, -size, size);
    place.z = random_between(random, -size, size);
    return place;
}

TEST(lights_may_be_behind_floor_and_wall)
{
    enum { DIRECTIONAL, POINT, RANDOM = 60 };
    static const struct {
        const char *name;
        int light;
        Vec3 place;
    } cases[] = {
        {"below the floor", POINT, {0, -6, 2}},
        {"from below", DIRECTIONAL, {0, -1, 0}},
        {"behind the wall", POINT, {0, 2, -5}},
        {"from behind", DIRECTIONAL, {0, 0.3, -1}},
        {"close below the floor", POINT, {0, -2, 0}},
        {"from below, aslant", DIRECTIONAL, {0.1, -1, 0.3}},
        {"behind and below", POINT, {-1, -3, -4}},
        {"from the side", DIRECTIONAL, {-1, 0.05, 0.1}},
    };
    enum { CASES = sizeof cases / sizeof cases[0] };
    const int step = testing_step(10);
    Random random = {testing_seed(20261122)};
    SUCCEEDS(Shadows.init(&(ShaderLoader){.precision = "highp"}, message));
    for (int i = 0; i < CASES * EYES; i += step)
        assert_true(check_lit_from(cases[i % CASES].name, 0, cases[i % CASES].light,
                                   cases[i % CASES].place, eyes[i / CASES]));
    for (int i = 0; i < RANDOM; i++) {
        const double seconds = random_between(&random, 0, 12);
        const Vec3 place = random_place(&random, i % 2 ? 6 : 3);
        const Vec3 eye = i % 4 < 2 ? eyes[random_below(&random, EYES)] : random_place(&random, 8);
        if (i % step == i / step % step) /* one of each `step`, odd and even */
            assert_true(check_lit_from("anywhere", seconds, i / 2 % 2, place, eye));
    }
    lighting_forget(lighting, NULL);
    Shadows.finish();
}

/* Hard cases: an object over a floor in the light of a point. */

/* Moves all by an offset, after scaling it. */
static void move_world(double scale, Vec3 offset)
{
    Camera *camera = &world.scene.camera;
    const Mat4 moved =
        mat4_product(mat4_translate(offset), mat4_scale((Vec3){scale, scale, scale}));
    camera->eye = mat4_transform_point(moved, camera->eye);
    camera->center = mat4_transform_point(moved, camera->center);
    camera->near *= scale;
    camera->far *= scale;
    for (int i = 0; i < world.scene.light_count; i++)
        world.lights[i].position = mat4_transform_point(moved, world.lights[i].position);
    for (int i = 0; i < world.scene.object_count; i++)
        world.objects[i].world_from_object =
            mat4_product(moved, world.objects[i].world_from_object);
}

TEST_WITH(0, any_mesh_throws_the_shadow_of_its_triangles, open_meshes, close_meshes)
{
    const Mesh *const meshes[] = {&ball, &coarse_ring, &pipe_mesh, &box, &pot, &doubled, &with_t};
    static const char *const names[] = {"ball",   "coarse ring",      "open pipe", "box",
                                        "teapot", "doubled triangle", "T-junction"};
    const Mat4 turned = mat4_rotate(-65, (Vec3){1, 0.3, 0.2});
    const Mat4 mirrored = mat4_product(turned, mat4_scale((Vec3){-1, 0.9, 1}));
    for (int i = 0; i < 7; i++)
        for (int way = 0; way < 4; way++) {
            if (meshes[i] == &doubled && way == 2)
                continue; /* two surfaces in one place, with opposite normals on each side */
            make_world(meshes[i]);
            turn_first(way == 1 ? mirrored : turned);
            world.objects[0].two_sided = way == 2;
            if (way == 3) {
                world.lights[0].kind = LIGHT_DIRECTIONAL;
                world.lights[0].direction = (Vec3){1.1, 3.2, 1.7};
            }
            assert_true(check(formatted("%s-%d", names[i], way), &world.scene));
        }
}

/* Whose front is on the side that its normals are not on, if it has a back. */
TEST_WITH(0, clockwise_meshes_are_lit_as_the_others, open_meshes, close_meshes)
{
    const Mesh *const meshes[] = {&pipe_mesh, &pot, &coarse_ring};
    const Mat4 turned = mat4_rotate(-65, (Vec3){1, 0.3, 0.2});
    for (int i = 0; i < 3; i++)
        for (int way = 0; way < 8; way++) {
            make_world(meshes[i]);
            turn_first(way & 1 ? mat4_product(turned, mat4_scale((Vec3){-1, 0.9, 1})) : turned);
            world.objects[0].clockwise = true;
            world.objects[0].two_sided = way & 2;
            if (way & 4)
                world.lights[0].position = (Vec3){0.3, 0.1, 0.2};
            assert_true(check(formatted("clockwise-%d-%d", i, way), &world.scene));
        }
}

TEST_WITH(0, eyes_and_lights_may_be_anywhere, open_meshes, close_meshes)
{
    static const struct {
        const char *name;
        const Mesh *mesh;
        LightKind kind;
        Vec3 place, direction;
    } cases[] = {
        {"occluder through the near plane", &box, LIGHT_POINT, {2, 5, 8}, {0, 0, 0}},
        {"light in a box", &box, LIGHT_POINT, {0.1, 0.2, -0.1}, {0, 0, 0}},
        {"light in a ring", &coarse_ring, LIGHT_POINT, {0.82, 0.02, 0.03}, {0, 0, 0}},
        {"light on a box", &box, LIGHT_POINT, {0.3, 0.8, 0.2}, {0, 0, 0}},
        {"grazing light", &coarse_ring, LIGHT_DIRECTIONAL, {0, 0, 0}, {1, 0.02, 0.3}},
        {"cone's edge in a shadow", &pot, LIGHT_SPOT, {1.1, 3.2, 1.7}, {-0.8, -3.2, -1.2}},
    };
    for (int i = 0; i < 6; i++) {
        Light *light = &world.lights[0];
        make_world(cases[i].mesh);
        if (i == 0) /* cut by the near plane, light behind the eye */
            turn_first(mat4_translate((Vec3){0.9, 2.2, 4.2}));
        light->kind = cases[i].kind;
        light->position = cases[i].place;
        light->direction = cases[i].direction;
        light->cutoff = 14;
        assert_true(check(cases[i].name, &world.scene));
    }
}

/* Of a triangle: a corner, the middle of a side, its own middle, or a place in its plane. */
static Vec3 touching(const Mesh *mesh, size_t triangle, int way)
{
    static const double weights[][3] = {{1, 0, 0}, {0.5, 0.5, 0}, {0.3, 0.3, 0.4}, {2.5, -1, -0.5}};
    Vec3 place = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        const MeshVertex *vertex = &mesh->vertices[mesh->indices[3 * triangle + (size_t)k]];
        place = vec3_add(place, vec3_scale(vec3_from_float(vertex->position), weights[way][k]));
    }
    return place;
}

/* Triangles that share some of their corners, at random. */
static void make_soup(Random *random, Mesh *mesh)
{
    enum { CORNERS = 12, TRIANGLES = 14 };
    SUCCEEDS(mesh_open(mesh, CORNERS, 3 * TRIANGLES, message));
    for (size_t i = 0; i < CORNERS; i++) {
        vec3_to_float(random_place(random, 0.8), mesh->vertices[i].position);
        mesh->vertices[i].normal[2] = 1;
    }
    for (size_t i = 0; i < TRIANGLES; i++) {
        const int first = random_below(random, CORNERS), second = 1 + random_below(random, 5);
        mesh->indices[3 * i] = (uint32_t)first;
        mesh->indices[3 * i + 1] = (uint32_t)((first + second) % CORNERS);
        mesh->indices[3 * i + 2] =
            (uint32_t)((first + second + 1 + random_below(random, 6)) % CORNERS);
    }
}

/* In the plane of a flat face N.L is 0 but for rounding, which decides on each point's highlight:
 * pixels that may be wrong. A lost shadow is ten times as many. */
TEST_WITH(0, lights_may_touch_what_throws_the_shadow, open_meshes, close_meshes)
{
    static const char *const ways[] = {"at a vertex", "on an edge", "on a triangle",
                                       "in its plane"};
    Mesh soup;
    Random random = {testing_seed(20261123)};
    make_soup(&random, &soup);
    const Mesh *const meshes[] = {&ball, &coarse_ring, &pipe_mesh, &box, &pot, &soup};
    static const char *const names[] = {"ball", "coarse ring", "open pipe",
                                        "box",  "teapot",      "random triangles"};
    const Mat4 turned = mat4_rotate(-65, (Vec3){1, 0.3, 0.2});
    for (int i = 0; i < 6; i++) {
        const int way_count = meshes[i] == &pot ? 1 : 4; /* its rims are as thin as rounding */
        for (int way = 0; way < way_count; way++)
            for (int turn = 0; turn < 2; turn++) {
                const size_t triangle =
                    (size_t)random_below(&random, (int)(meshes[i]->index_count / 3));
                make_world(meshes[i]);
                turn_first(turn ? turned : mat4_identity());
                world.lights[0].position = mat4_transform_point(world.objects[0].world_from_object,
                                                                touching(meshes[i], triangle, way));
                assert_true(
                    check_wrong(formatted("light %s of the %s, %zu", ways[way], names[i], triangle),
                                &world.scene, 100));
            }
    }
    lighting_forget(lighting, NULL);
    mesh_close(&soup);
}

/* Of all vertices the farthest along an axis, one way or the other. */
static Vec3 end_of(const Mesh *mesh, int axis, bool low)
{
    const float *end = mesh->vertices[0].position;
    for (size_t i = 1; i < mesh->vertex_count; i++) {
        const float *place = mesh->vertices[i].position;
        if (low ? place[axis] < end[axis] : place[axis] > end[axis])
            end = place;
    }
    return vec3_from_float(end);
}

/* Rounding decides whether such a light is within the mesh's box. */
TEST_WITH(0, lights_may_touch_an_end_of_what_throws_the_shadow, open_meshes, close_meshes)
{
    for (int i = 0; i < 12; i++) {
        make_world(&coarse_ring);
        turn_first(mat4_rotate(23 * i, (Vec3){1, 0.3, 0.2}));
        world.lights[0].position = mat4_transform_point(world.objects[0].world_from_object,
                                                        end_of(&coarse_ring, i % 3, i % 2));
        assert_true(
            check_wrong(formatted("light at an end of the coarse ring, %d", i), &world.scene, 100));
    }
}

/* In front of a triangle or behind it, so near that it fills almost half of all directions: its
 * shadow is as large as that. Nearer than a few roundings of a float, 1e-6, which side it is on is
 * not known. */
TEST_WITH(0, lights_may_be_close_before_what_throws_the_shadow, open_meshes, close_meshes)
{
    const Mesh *const meshes[] = {&pot, &pot, &pipe_mesh, &box};
    static const char *const names[] = {"teapot", "teapot", "open pipe", "box"};
    Random random = {testing_seed(20261124)};
    const int count = testing_part(4 * 60, 12);
    for (int i = 0; i < count; i++) {
        const Mesh *mesh = meshes[i % 4];
        const size_t triangle = (size_t)random_below(&random, (int)(mesh->index_count / 3));
        const MeshVertex *vertex = &mesh->vertices[mesh->indices[3 * triangle]];
        const Vec3 normal = vec3_from_float(vertex->normal);
        const double before =
            (random_below(&random, 2) ? 1 : -1) * pow(10, random_between(&random, -5, -2));
        make_world(mesh);
        world.lights[0].position =
            vec3_add(touching(mesh, triangle, 2), vec3_scale(normal, before));
        assert_true(check(formatted("light %.2g before %s, %zu", before, names[i % 4], triangle),
                          &world.scene));
    }
}

TEST_WITH(0, the_scale_and_the_place_do_not_matter, open_meshes, close_meshes)
{
    static const double scales[] = {1e-6, 1e6, 1};
    for (int i = 0; i < 3; i++) {
        make_world(&pot);
        move_world(scales[i], i == 2 ? (Vec3){1e6, -2e6, 1e6} : (Vec3){0, 0, 0});
        assert_true(
            check(formatted("scale %g%s", scales[i], i == 2 ? ", far away" : ""), &world.scene));
    }
}

TEST_WITH(0, light_at_the_vertices_is_shadowed_at_the_fragments, open_meshes, close_meshes)
{
    for (int kind = INTERPOLATION_GOURAUD; kind <= INTERPOLATION_CONSTANT; kind++) {
        make_world(&coarse_ring);
        world.scene.interpolation = (Interpolation)kind;
        assert_true(check(INTERPOLATION_NAMES[kind], &world.scene));
    }
}

/* What is left out draws nothing: with it the picture is the same. */
TEST_WITH(0, the_full_program_draws_the_same_shadows, open_meshes, close_meshes)
{
    static unsigned char before[4 * WIDTH * HEIGHT];
    const Mesh *const meshes[] = {&ball, &coarse_ring, &pot};
    for (int i = 0; i < 3; i++) {
        make_world(meshes[i]);
        world.lights[1] = world.lights[0];
        world.lights[1].position = (Vec3){0, -4, 0}; /* nothing between it and the floor's back */
        world.scene.light_count = 2;
        draw(&world.scene, false);
        memcpy(before, image.pixels, sizeof before);
        draw(&world.scene, true);
        assert_int_equal(pixels_apart(before, image.pixels, WIDTH * HEIGHT, 1), 0);
    }
}

static void get_sources(const Scene *scene, int object, ShaderSource sources[2])
{
    SUCCEEDS(lighting_sources(lighting, scene, &scene->objects[object], false, sources, message));
}

/* No volume is drawn and no code is there where nothing can come between. */
TEST_WITH(0, what_needs_no_shadow_has_none, open_meshes, close_meshes)
{
    static const struct {
        const char *name;
        Vec3 light;
        double cutoff;    /* of a spot that shines down; 0: a point */
        bool needed[2];   /* by the ball, by the floor */
        bool alone, bare; /* the floor is missing; the light has no shadows */
    } cases[] = {
        {"over both", {1, 3, 1}, 0, {false, true}, false, false},
        {"a ball alone", {1, 3, 1}, 0, {false, false}, true, false},
        {"between them", {0.2, -1.1, 0}, 0, {false, false}, false, false},
        {"below the floor", {1, -3, 1}, 0, {true, false}, false, false},
        {"a cone beside the ball", {3, 3, 1}, 20, {false, false}, false, false},
        {"without shadows", {1, 3, 1}, 0, {false, false}, false, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const long long volumes = lighting_counts(lighting).volumes;
        make_world(&ball);
        world.scene.object_count = cases[i].alone ? 1 : 2;
        world.lights[0].position = cases[i].light;
        world.lights[0].shadows = !cases[i].bare;
        if (cases[i].cutoff > 0) {
            world.lights[0].kind = LIGHT_SPOT;
            world.lights[0].direction = (Vec3){0, -1, 0};
            world.lights[0].cutoff = cases[i].cutoff;
        }
        draw(&world.scene, false);
        const bool needed = cases[i].needed[0] || cases[i].needed[1];
        if ((lighting_counts(lighting).volumes > volumes) != needed)
            fail_msg("%s: a volume is %s", cases[i].name, needed ? "missing" : "drawn");
        for (int o = 0; o < world.scene.object_count; o++) {
            ShaderSource with[2], without[2];
            get_sources(&world.scene, o, with);
            world.lights[0].shadows = false;
            get_sources(&world.scene, o, without);
            world.lights[0].shadows = !cases[i].bare;
            const bool same = strcmp(with[0].text, without[0].text) == 0 &&
                              strcmp(with[1].text, without[1].text) == 0;
            if (same == cases[i].needed[o])
                fail_msg("%s: object %d %s a shadow", cases[i].name, o, same ? "lacks" : "has");
            for (int stage = 0; stage < 2; stage++) {
                shader_source_close(&with[stage]);
                shader_source_close(&without[stage]);
            }
        }
    }
}

/* Attachments of a canvas with several samples would need as many masks. */
TEST(several_samples_of_a_pixel_are_supersampled)
{
    Canvas other;
    SUCCEEDS(canvas_open_beside(
        &other, &canvas,
        &(CanvasOptions){.width = 40, .height = 30, .samples = 4, .supersampled = true}, message));
    assert_int_equal(other.samples, 0);
    assert_int_equal(other.supersample, 2);
    SUCCEEDS(canvas_set_samples(&other, 4, false, message));
    if (other.samples > 1) { /* the driver has them */
        open_meshes(NULL);
        make_world(&ball);
        canvas_clear(&other, (Vec3){0, 0, 0}, 1);
        FAILS_WITH(lighting_show(lighting, &(LightingFrame){.scene = &world.scene, .aspect = 1.3},
                                 message),
                   "supersampling");
        close_meshes(NULL);
    }
    canvas_close(&other);
    canvas_begin(&canvas);
}

/* Shadows on a floor and a wall: of a ball, whose light may be below its top; and of a square that
 * goes through the floor, which casts a shadow on its lower half. */
TEST_WITH(0, shadows_are_exact_on_what_is_flat, open_meshes, close_meshes)
{
    static const Vec3 lights[] = {{1.1, 3.2, 1.7}, {1.4, 0.4, 0.5}, {1.3, -0.5, 0.3}, {3, 0.2, 3}};
    for (int i = 0; i < 8; i++) {
        make_world(i < 4 ? &ball : &plane);
        world.objects[0].flat = i >= 4;
        turn_first(mat4_product(mat4_translate((Vec3){0, i < 4 ? 0 : -0.9, 0}),
                                mat4_scale((Vec3){1, i % 2 ? -1 : 0.8, 1})));
        world.objects[2] = world.objects[1];
        world.objects[2].world_from_object =
            mat4_product(mat4_translate((Vec3){0, 1, -1.6}), mat4_scale((Vec3){4, 4, 4}));
        world.scene.object_count = 3;
        world.lights[0].position = lights[i % 4];
        assert_true(check(formatted("flat-%d", i), &world.scene));
    }
    make_world(&ball);
    world.lights[0].kind = LIGHT_DIRECTIONAL;
    world.lights[0].direction = (Vec3){1.1, 1.2, 1.7};
    assert_true(check("flat-directional", &world.scene));
}

/* Where two casters overlap nothing is darkened twice, and eight lights have their own. */
TEST_WITH(0, shadows_may_overlap, open_meshes, close_meshes)
{
    make_eight_lights();
    assert_true(check("overlapping", &world.scene));
    /* From nothing to all of the floor: what is beyond a light's range casts no shadow of it. */
    const long long made = lighting_counts(lighting).volumes_made;
    for (int i = 0; i < 8; i++)
        world.lights[i].range = 2 + 0.7 * i;
    assert_true(check("overlapping in their ranges", &world.scene));
    assert_in_range(lighting_counts(lighting).volumes_made - made, 1, 15);
}

static long long volumes_made(void)
{
    const long long before = lighting_counts(lighting).volumes_made;
    draw(&world.scene, false);
    return lighting_counts(lighting).volumes_made - before;
}

/* The other caster keeps its own. */
TEST_WITH(0, volumes_are_made_when_something_has_moved, open_meshes, close_meshes)
{
    make_eight_lights();
    world.scene.light_count = 1;
    assert_int_equal(volumes_made(), 2);
    assert_int_equal(volumes_made(), 0);
    world.scene.camera.eye.x += 0.5;
    assert_int_equal(volumes_made(), 0);
    world.objects[2].world_from_object =
        mat4_product(mat4_translate((Vec3){0.1, 0, 0}), world.objects[2].world_from_object);
    assert_int_equal(volumes_made(), 1);
    world.lights[0].position.x += 1e-9;
    assert_int_equal(volumes_made(), 2);
    lighting_forget(lighting, NULL);
    assert_int_equal(volumes_made(), 2);
}

PICTURE_TEST_MAIN("shadows", open_all, close_all)
