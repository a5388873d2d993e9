/*
 * Scenes as data: what is refused, and under which name; coordinates relative to the eye; copies.
 * No GL.
 */
#include "base/random.h"
#include "scene/scene.h"
#include "shapes/mesh_solids.h"
#include "support/testing.h"

/* A scene that has a meaning, all of it in one place, to be changed. */
typedef struct World {
    Light lights[3]; /* of each kind, by LightKind */
    Mesh mesh;
    Object object;
    Scene scene;
} World;

static World world;

FIXTURE(set_up)
{
    const Material material = {.diffuse = {1, 1, 1}, .alpha = 1, .shininess = 16};
    world = (World){
        .lights =
            {
                {.kind = LIGHT_DIRECTIONAL, .direction = {0, 0, 1}},
                {.kind = LIGHT_POINT, .position = {0, 0, 3}},
                {.kind = LIGHT_SPOT, .direction = {0, 0, -1}, .cutoff = 30, .exponent = 2},
            },
        .mesh = {.index_count = 3},
        .object = {.mesh = &world.mesh,
                   .world_from_object = mat4_identity(),
                   .front = material,
                   .two_sided = true,
                   .back = material},
        .scene = {.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 45, 0.1, 100, 0},
                  .lights = world.lights,
                  .light_count = 3,
                  .objects = &world.object,
                  .object_count = 1},
    };
}

/* One number of the world set to a value without meaning there, and how the message begins. */
typedef struct Refusal {
    double *number;
    double value;
    const char *message;
} Refusal;

static void assert_refused(const char *beginning)
{
    Message message = {0};
    if (scene_check(&world.scene, &message))
        fail_msg("accepted, and not refused with \"%s\"", beginning);
    if (strncmp(message.text, beginning, strlen(beginning)) != 0)
        fail_msg("\"%s\" does not begin with \"%s\"", message.text, beginning);
}

static const Refusal REFUSALS[] = {
    {&world.scene.camera.eye.x, NAN, "camera: eye (nan, 0, 5): must be"},
    {&world.scene.camera.eye.z, 0, "camera: eye (0, 0, 0), center (0, 0, 0), up"},
    {&world.scene.camera.center.y, INFINITY, "camera: center (0, inf, 0): must be"},
    {&world.scene.camera.center.y, -1e300, "camera: center (0, -1e+300, 0): must be 1e+15 at most"},
    {&world.scene.camera.up.y, 0, "camera: eye (0, 0, 5), center (0, 0, 0), up (0, 0, 0): eye and"},
    {&world.scene.camera.up.z, NAN, "camera: up (0, 1, nan): must be"},
    {&world.scene.camera.fovy, 180, "camera: fovy 180, aspect 1, near 0.1, far 100: must be"},
    {&world.scene.camera.fovy, 270, "camera: fovy 270, aspect 1, near 0.1, far 100: must be"},
    {&world.scene.camera.fovy, 360, "camera: fovy 360, aspect 1, near 0.1, far 100: must be"},
    {&world.scene.camera.fovy, 0, "camera: fovy 0, aspect 1, near 0.1, far 100: must be"},
    {&world.scene.camera.fovy, -1, "camera: fovy -1, aspect 1, near 0.1, far 100: must be"},
    {&world.scene.camera.fovy, NAN, "camera: fovy nan"},
    {&world.scene.camera.near, 0, "camera: fovy 45, aspect 1, near 0,"},
    {&world.scene.camera.near, -1, "camera: fovy 45, aspect 1, near -1,"},
    {&world.scene.camera.near, 200, "camera: fovy 45, aspect 1, near 200, far 100:"},
    {&world.scene.camera.near, NAN, "camera: fovy 45, aspect 1, near nan,"},
    {&world.scene.camera.near, INFINITY, "camera: fovy 45, aspect 1, near inf,"},
    {&world.scene.camera.far, 0.1, "camera: fovy 45, aspect 1, near 0.1, far 0.1:"},
    {&world.scene.camera.far, -20, "camera: fovy 45, aspect 1, near 0.1, far -20:"},
    {&world.scene.camera.far, NAN, "camera: fovy 45, aspect 1, near 0.1, far nan:"},
    {&world.scene.background.x, 1.5, "scene: background 1.5: must be 0 to 1"},
    {&world.scene.background.y, NAN, "scene: background nan: must be 0 to 1"},
    {&world.scene.global_ambient.z, -0.1, "scene: global ambient -0.1: must be 0 to 1e+06"},
    {&world.lights[0].ambient.x, -1, "light 0: ambient -1: must be 0 to 1e+06"},
    {&world.lights[1].diffuse.y, NAN, "light 1: diffuse nan: must be"},
    {&world.lights[2].specular.z, INFINITY, "light 2: specular inf: must be"},
    {&world.lights[0].direction.z, 0, "light 0: direction (0, 0, 0): must be finite and not zero"},
    {&world.lights[0].direction.x, NAN, "light 0: direction (nan, 0, 1): must be"},
    {&world.lights[1].position.x, INFINITY, "light 1: position (inf, 0, 3): must be"},
    {&world.lights[1].position.z, -INFINITY, "light 1: position (0, 0, -inf): must be"},
    {&world.lights[1].position.z, 2e15, "light 1: position (0, 0, 2e+15): must be"},
    {&world.lights[1].constant, -1, "light 1: constant -1: must be 0 to 1e+30"},
    {&world.lights[1].linear, NAN, "light 1: linear nan: must be"},
    {&world.lights[2].quadratic, 1e31, "light 2: quadratic 1e+31: must be"},
    {&world.lights[2].quadratic, -1e-300, "light 2: quadratic -1e-300: must be"},
    {&world.lights[2].direction.z, 0, "light 2: direction (0, 0, 0): must be"},
    {&world.lights[2].direction.y, NAN, "light 2: direction (0, nan, -1): must be"},
    {&world.lights[2].direction.y, INFINITY, "light 2: direction (0, inf, -1): must be"},
    {&world.lights[2].cutoff, 95, "light 2: cutoff 95: must be 0 to 90"},
    {&world.lights[2].cutoff, -1, "light 2: cutoff -1: must be 0 to 90"},
    {&world.lights[2].cutoff, NAN, "light 2: cutoff nan: must be 0 to 90"},
    {&world.lights[2].exponent, 129, "light 2: exponent 129: must be 0 to 128"},
    {&world.lights[2].exponent, -1e-300, "light 2: exponent -1e-300: must be 0 to 128"},
    {&world.object.front.ambient.x, 1.01, "object 0: front: ambient 1.01: must be 0 to 1"},
    {&world.object.front.diffuse.y, -0.5, "object 0: front: diffuse -0.5: must be 0 to 1"},
    {&world.object.front.specular.z, 2, "object 0: front: specular 2: must be 0 to 1"},
    {&world.object.front.emission.x, NAN, "object 0: front: emission nan: must be 0 to 1"},
    {&world.object.front.alpha, 1.5, "object 0: front: alpha 1.5: must be 0 to 1"},
    {&world.object.front.shininess, 128.5, "object 0: front: shininess 128.5: must be 0 to 128"},
    {&world.object.front.shininess, -1e-300,
     "object 0: front: shininess -1e-300: must be 0 to 128"},
    {&world.object.front.shininess, INFINITY, "object 0: front: shininess inf: must be 0 to 128"},
    {&world.object.back.shininess, -1, "object 0: back: shininess -1: must be 0 to 128"},
    {&world.object.world_from_object.m[13], NAN, "object 0: its matrix is not finite"},
    {&world.object.world_from_object.m[15], 2, "object 0: its matrix is not affine"},
    {&world.object.world_from_object.m[3], 1, "object 0: its matrix is not affine"},
};

TEST_WITH(0, each_number_outside_its_range_is_refused_by_name, set_up, NULL)
{
    for (size_t i = 0; i < sizeof REFUSALS / sizeof REFUSALS[0]; i++) {
        set_up(NULL);
        SUCCEEDS(scene_check(&world.scene, message));
        *REFUSALS[i].number = REFUSALS[i].value;
        assert_refused(REFUSALS[i].message);
    }
}

TEST_WITH(0, a_view_along_up_is_refused, set_up, NULL)
{
    world.scene.camera.up = (Vec3){0, 0, -9};
    assert_refused("camera: eye (0, 0, 5), center (0, 0, 0), up (0, 0, -9): eye and");
}

TEST_WITH(0, kinds_that_do_not_exist_are_refused, set_up, NULL)
{
    world.lights[1].kind = (LightKind)3;
    assert_refused("light 1: kind 3: must be 0 to 2");
    set_up(NULL);
    world.lights[2].space = (LightSpace)2;
    assert_refused("light 2: space 2: must be 0 to 1");
    set_up(NULL);
    world.scene.reflection = (Reflection)2;
    assert_refused("scene: reflection 2: must be 0 to 1");
    set_up(NULL);
    world.scene.interpolation = (Interpolation)4;
    assert_refused("scene: interpolation 4: must be 0 to 3");
}

TEST_WITH(0, an_object_without_triangles_is_refused, set_up, NULL)
{
    world.mesh.index_count = 0;
    assert_refused("object 0: has no triangles");
    world.object.mesh = NULL;
    assert_refused("object 0: has no triangles");
}

/* What a kind of light does not have, and the back of a one-sided object, may be anything. */
TEST_WITH(0, what_has_no_effect_is_not_checked, set_up, NULL)
{
    Message message = {0};
    world.lights[LIGHT_DIRECTIONAL].position.x = NAN;
    world.lights[LIGHT_DIRECTIONAL].linear = -1;
    world.lights[LIGHT_POINT].cutoff = 180;
    world.lights[LIGHT_POINT].direction = (Vec3){0, 0, 0};
    world.object.two_sided = false;
    world.object.back.shininess = 1000;
    assert_true(scene_check(&world.scene, &message));
    assert_string_equal(message.text, "");
}

TEST_WITH(0, ends_of_ranges_are_accepted, set_up, NULL)
{
    world.lights[LIGHT_SPOT].cutoff = 0;
    world.lights[LIGHT_SPOT].exponent = 128;
    world.lights[LIGHT_POINT].diffuse = (Vec3){1e6, 0, 0};
    world.object.front = (Material){{1, 1, 1}, {0, 0, 0}, {1, 1, 1}, {1, 1, 1}, 0, 128};
    world.scene.camera.far = INFINITY;
    assert_true(scene_check(&world.scene, NULL));
    world.lights[LIGHT_SPOT].cutoff = 90;
    assert_true(scene_check(&world.scene, NULL));
}

TEST_WITH(0, a_camera_without_aspect_is_refused, set_up, NULL)
{
    Mat4 eye_from_world, clip_from_eye;
    FAILS(scene_camera(&world.scene.camera, 0, &eye_from_world, &clip_from_eye, message),
          "camera: fovy 45, aspect 0, near 0.1, far 100: must be 0 < "
          "fovy < 180, aspect > 0, 0 < near < far");
}

/* Coordinates relative to the eye. */

static Mat4 object_matrix(Vec3 place)
{
    const Mat4 turn = mat4_rotate(33, (Vec3){1, 2, 3});
    return mat4_product(mat4_translate(place),
                        mat4_product(turn, mat4_scale((Vec3){0.5, 2, 1.25})));
}

static Mat4 eye_from_object_at(Vec3 offset, Vec3 *light_eye)
{
    Camera camera = world.scene.camera;
    Mat4 eye_from_world, clip_from_eye;
    camera.eye = vec3_add((Vec3){1.5, -2.25, 4}, offset);
    camera.center = offset;
    assert_true(scene_camera(&camera, 1, &eye_from_world, &clip_from_eye, NULL));
    *light_eye = scene_eye_point(&camera, eye_from_world, vec3_add((Vec3){3, 0.5, -7}, offset));
    return scene_eye_from_object(&camera, eye_from_world,
                                 object_matrix(vec3_add((Vec3){-1, 0.25, 0.5}, offset)));
}

/* The places above, in binary, keep all their digits at these offsets; so the eye coordinates do,
 * to the rounding of a few sums of numbers below 10: 1e-14, of which the promise is 1e-9. */
TEST_WITH(0, a_scene_far_away_has_the_eye_coordinates_of_the_same_at_the_origin, set_up, NULL)
{
    static const Vec3 offsets[] = {
        {1e6, 0, 0}, {-1e6, 1e6, 1e6}, {1e9, 0, 0}, {1e9, -1e9, 1e9}, {0, 0, -1e12}};
    Vec3 light, light_there;
    const Mat4 here = eye_from_object_at((Vec3){0, 0, 0}, &light);
    for (size_t i = 0; i < sizeof offsets / sizeof offsets[0]; i++) {
        const Mat4 there = eye_from_object_at(offsets[i], &light_there);
        for (int k = 0; k < 16; k++)
            assert_true(fabs(there.m[k] - here.m[k]) <= 1e-14);
        assert_true(vec3_length(vec3_subtract(light_there, light)) <= 1e-14);
    }
}

/* Depth. */

static Random random_state = {13};

static double between(double min, double max)
{
    return random_between(&random_state, min, max);
}

static Vec3 vector_between(double min, double max)
{
    const double x = between(min, max), y = between(min, max);
    return (Vec3){x, y, between(min, max)};
}

/* The least and the largest depth of the vertices before the eye. */
static void depths(const Scene *scene, double *near, double *far)
{
    Mat4 eye_from_world, clip_from_eye;
    assert_true(scene_camera(&scene->camera, 1, &eye_from_world, &clip_from_eye, NULL));
    *near = INFINITY;
    *far = 0;
    for (int i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        for (size_t k = 0; k < object->mesh->vertex_count; k++) {
            const Vec3 place = mat4_transform_point(
                object->world_from_object, vec3_from_float(object->mesh->vertices[k].position));
            const double depth = -scene_eye_point(&scene->camera, eye_from_world, place).z;
            *near = depth > 0 ? fmin(*near, depth) : *near;
            *far = fmax(*far, depth);
        }
    }
}

/* Whatever the orbit: what was drawn stays within the planes, down to a depth of far / 1e5, of far
 * / 1e3 around the eye. */
TEST_WITH(0, fitted_planes_clip_nothing, set_up, NULL)
{
    CLOSED(mesh_close) Mesh cube;
    Object objects[3];
    int moved = 0, before_the_near_plane = 0;
    SUCCEEDS(mesh_cube(&cube, 1, message));
    world.scene.objects = objects;
    for (int i = 0; i < 1000; i++) {
        double near, far;
        set_up(NULL);
        world.scene.objects = objects;
        world.scene.object_count = 1 + random_below(&random_state, 3);
        for (int k = 0; k < world.scene.object_count; k++)
            objects[k] =
                (Object){.mesh = &cube, .world_from_object = object_matrix(vector_between(-3, 3))};
        Camera *camera = &world.scene.camera;
        *camera = (Camera){.eye = vec3_scale(vector_between(-1, 1), exp(between(-2, 6))),
                           .center = vector_between(-0.5, 0.5),
                           .up = {0.1, 1, 0.2},
                           .fovy = 45,
                           .near = between(0.1, 2),
                           .far = between(4, 12)};
        const Camera given = *camera;
        depths(&world.scene, &near, &far);
        scene_fit_depth(&world.scene);
        moved += memcmp(&given, camera, sizeof given) != 0;
        assert_true(camera->near > 0 && camera->near < camera->far);
        assert_true(camera->far >= far || far == 0);
        assert_true(camera->near >= fmin(camera->far / 1e5, given.near));
        assert_true(camera->near <= near || camera->near <= camera->far / 1e3 * (1 + 1e-12));
        if (camera->near < given.near)
            before_the_near_plane++;
        if (near >= given.near && far <= given.far && far > 0) {
            /* Unless a box, which is larger than what is in it, or the part behind the eye, lies
             * before the near plane. */
            assert_true(camera->far == given.far && camera->near <= given.near);
        }
        const Camera fitted = *camera;
        scene_fit_depth(&world.scene);
        assert_memory_equal(&fitted, camera, sizeof fitted); /* a second time changes nothing */
    }
    assert_in_range(moved, 500, 999);
    assert_in_range(before_the_near_plane, 100, 900);
}

TEST_WITH(0, planes_around_all_objects_stay, set_up, NULL)
{
    CLOSED(mesh_close) Mesh cube;
    SUCCEEDS(mesh_cube(&cube, 1, message));
    world.object.mesh = &cube;
    Camera *camera = &world.scene.camera;
    camera->near = 4, camera->far = 6; /* exactly */
    scene_fit_depth(&world.scene);
    assert_true(camera->near == 4 && camera->far == 6);
    camera->near = 4.5, camera->far = 5.5;
    scene_fit_depth(&world.scene);
    assert_true(camera->near < 4 && camera->far > 6);
    camera->eye.z = -1; /* all is behind, and nothing to be done */
    camera->center.z = -2;
    const Camera given = *camera;
    scene_fit_depth(&world.scene);
    assert_memory_equal(camera, &given, sizeof given);
    world.scene.object_count = 0;
    scene_fit_depth(&world.scene);
    assert_memory_equal(camera, &given, sizeof given);
}

/* Field of view. */

TEST_WITH(0, a_narrow_picture_shows_as_much_of_the_width, set_up, NULL)
{
    static const double aspects[] = {0.01, 0.5, 1, 1.5, 1.999};
    static const double HALF = 0.017453292519943295 / 2;
    Camera *camera = &world.scene.camera;
    for (int i = 0; i < 5; i++) {
        camera->aspect = 0;
        assert_true(scene_fovy(camera, aspects[i]) == camera->fovy);
        camera->aspect = 2;
        const double width = tan(scene_fovy(camera, aspects[i]) * HALF) * aspects[i];
        assert_true(fabs(width - 2 * tan(camera->fovy * HALF)) < 1e-12);
    }
    assert_true(scene_fovy(camera, 2) == camera->fovy);
    assert_true(scene_fovy(camera, 5) == camera->fovy);
}

/* Lights of the viewer. */

TEST_WITH(0, a_light_of_the_viewer_has_its_place_in_the_world, set_up, NULL)
{
    for (int i = 0; i < 200; i++) {
        Mat4 eye_from_world, clip_from_eye;
        Camera *camera = &world.scene.camera;
        *camera = (Camera){vector_between(-9, 9), vector_between(-1, 1), {0.1, 1, 0}, 45, 1, 9, 0};
        Light *light = &world.lights[2];
        light->position = vector_between(-5, 5);
        light->direction = vector_between(-1, 1);
        light->space = LIGHT_WORLD;
        const Light same = scene_world_light(&world.scene, 2);
        assert_memory_equal(&same, light, sizeof same);
        light->space = LIGHT_EYE;
        const Light there = scene_world_light(&world.scene, 2);
        assert_int_equal(there.space, LIGHT_WORLD);
        assert_true(scene_camera(camera, 1, &eye_from_world, &clip_from_eye, NULL));
        const Vec3 position = scene_eye_point(camera, eye_from_world, there.position);
        const Vec3 direction = mat4_transform_direction(eye_from_world, there.direction);
        /* Rounding of sums of numbers below 20. */
        assert_true(vec3_length(vec3_subtract(position, light->position)) < 1e-13);
        assert_true(vec3_length(vec3_subtract(direction, light->direction)) < 1e-14);
        assert_true(there.cutoff == light->cutoff && there.exponent == light->exponent);
    }
}

/* Terms. */

static bool same_color(Vec3 a, Vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Each subset of terms and lights keeps those colors, and leaves the scene that was copied. */
TEST_WITH(0, terms_are_left_out_and_nothing_else, set_up, NULL)
{
    static const Vec3 black = {0, 0, 0}, white = {1, 1, 1}, color = {0.25, 0.5, 0.75};
    for (int i = 0; i < 3; i++)
        world.lights[i].ambient = world.lights[i].diffuse = world.lights[i].specular = color;
    world.scene.global_ambient = world.object.front.emission = world.object.back.emission = color;
    world.object.front.diffuse = (Vec3){0.1, 0.2, 0.3};
    const World before = world;
    for (unsigned bits = 0; bits < 1 << 8; bits++) {
        const SceneTerms terms = {bits & TERM_ALL, bits >> 4 & 7, bits >> 7};
        CLOSED(scene_copy_close) SceneCopy copy;
        scene_copy_open(&copy, &world.scene);
        scene_keep_terms(&copy, terms);
        for (int i = 0; i < 3; i++) {
            const Light *light = &copy.scene.lights[i];
            assert_int_equal(light->off, terms.unlit || (terms.lights_left_out >> i & 1));
            assert_true(same_color(light->ambient, bits & TERM_AMBIENT ? black : color));
            assert_true(same_color(light->diffuse, bits & TERM_DIFFUSE ? black : color));
            assert_true(same_color(light->specular, bits & TERM_SPECULAR ? black : color));
        }
        const Material *front = &copy.scene.objects[0].front;
        assert_true(
            same_color(front->emission, terms.unlit || bits & TERM_EMISSION ? black : color));
        assert_true(same_color(front->diffuse, world.object.front.diffuse));
        assert_true(
            same_color(front->ambient, terms.unlit ? front->diffuse : world.object.front.ambient));
        assert_true(same_color(copy.scene.global_ambient, terms.unlit           ? white
                                                          : bits & TERM_AMBIENT ? black
                                                                                : color));
    }
    assert_memory_equal(&before, &world, sizeof before);
}

/* The 32nd bit is of all lights from there on. */
TEST_WITH(0, the_last_bit_is_of_all_lights_that_follow, set_up, NULL)
{
    Light lights[40] = {{.off = false}};
    CLOSED(scene_copy_close) SceneCopy copy;
    world.scene.lights = lights;
    world.scene.light_count = 40;
    scene_copy_open(&copy, &world.scene);
    scene_keep_terms(&copy, (SceneTerms){.lights_left_out = 1U << 31 | 1U << 5});
    for (int i = 0; i < 40; i++)
        assert_int_equal(copy.scene.lights[i].off, i == 5 || i >= 31);
}

/* Of the copy every number is the same, and every place its own. */
TEST_WITH(0, a_copy_shares_nothing, set_up, NULL)
{
    Mesh quad, cube;
    Object objects[4];
    SceneCopy copy;
    SUCCEEDS(mesh_quad(&quad, 3, message) && mesh_cube(&cube, 1, message));
    for (int i = 0; i < 4; i++) {
        objects[i] = world.object;
        objects[i].front.shininess = i;
        objects[i].mesh = i % 2 ? &cube : &quad;
    }
    objects[3].mesh = NULL;
    world.scene.objects = objects;
    world.scene.object_count = 4;
    SUCCEEDS(scene_copy_open_deep(&copy, &world.scene, message));
    assert_memory_equal(&copy.scene.camera, &world.scene.camera, sizeof(Camera));
    assert_int_equal(copy.scene.light_count, 3);
    assert_memory_equal(copy.scene.lights, world.lights, sizeof world.lights);
    assert_ptr_not_equal(copy.scene.lights, world.lights);
    assert_int_equal(copy.scene.object_count, 4);
    for (int i = 0; i < 4; i++)
        assert_true(copy.scene.objects[i].front.shininess == i);
    for (int i = 0; i < 2; i++) {
        const Mesh *mine = copy.scene.objects[i].mesh, *its = i ? &cube : &quad;
        assert_ptr_not_equal(mine, its);
        assert_int_equal(mine->vertex_count, its->vertex_count);
        assert_int_equal(mine->index_count, its->index_count);
        assert_ptr_not_equal(mine->vertices, its->vertices);
        assert_memory_equal(mine->vertices, its->vertices,
                            its->vertex_count * sizeof *its->vertices);
        assert_memory_equal(mine->indices, its->indices, its->index_count * sizeof *its->indices);
    }
    assert_ptr_equal(copy.scene.objects[2].mesh, copy.scene.objects[0].mesh); /* one copy */
    assert_null(copy.scene.objects[3].mesh);
    scene_copy_close(&copy);
    scene_copy_close(&copy);
    scene_copy_close(NULL);
    world.scene = (Scene){.lights = NULL};
    SUCCEEDS(scene_copy_open_deep(&copy, &world.scene, message)); /* empty */
    scene_copy_close(&copy);
    mesh_close(&quad);
    mesh_close(&cube);
}

TEST_MAIN("scene", NULL, NULL)
