/*
 * Which effects a scene needs, and the reasons given for them. No GL.
 */
#include "support/effects_of.h"
#include "support/testing.h"

/* An object lit by one source, to be changed by each test. */
typedef struct World {
    Light lights[EFFECTS_MAX_LIGHTS];
    Object object;
    Scene scene;
} World;

static World world;
static Mesh cube, sphere;

static const Vec3 BLACK = {0, 0, 0}, WHITE = {1, 1, 1}, RED = {1, 0, 0}, GREEN = {0, 1, 0};

FIXTURE(open_meshes)
{
    assert_true(mesh_cube(&cube, 1, NULL) && mesh_sphere(&sphere, 1, 8, 4, NULL));
}

FIXTURE(close_meshes)
{
    mesh_close(&cube);
    mesh_close(&sphere);
}

/* A smooth open object in white directional light, diffuse only, lit per fragment. */
FIXTURE(set_up)
{
    world = (World){
        .lights = {{.kind = LIGHT_DIRECTIONAL, .direction = {0, 1, 1}, .diffuse = WHITE}},
        .object = {.mesh = &sphere,
                   .world_from_object = mat4_identity(),
                   .front = {.diffuse = WHITE, .alpha = 1, .shininess = 16},
                   .back = {.diffuse = WHITE, .alpha = 1, .shininess = 16}},
        .scene = {.camera = {{3, 2, 5}, {0, 0, 0}, {0, 1, 0}, 45, 0.1, 100, 0},
                  .lights = world.lights,
                  .light_count = 1,
                  .objects = &world.object,
                  .object_count = 1},
    };
}

static void shine_specular(void)
{
    world.lights[0].specular = world.object.front.specular = WHITE;
}

static void shine_ambient(void)
{
    world.lights[0].ambient = world.object.front.ambient = WHITE;
}

static void transform_by(Mat4 matrix)
{
    world.object.world_from_object = matrix;
}

/* A set as text: its members, then its groups of lights with their terms. */

static void put(char *text, bool there, const char *word)
{
    if (there)
        strcat(strcat(text, text[0] ? " " : ""), word);
}

static void write_set(const Effects *effects, char text[1024])
{
    static const char *const kinds[] = {"directional", "point", "spot"};
    text[0] = '\0';
    put(text, effects->cull, "cull");
    put(text, effects->two_sided, "two");
    put(text, effects->base, "base");
    put(text, effects->alpha, "alpha");
    put(text, effects->normals, "normals");
    put(text, effects->normal_matrix, "matrix");
    put(text, effects->normalize_vertex, "unit_vertex");
    put(text, effects->normalize_fragment, "unit_fragment");
    put(text, effects->local_viewer, "local");
    put(text, effects->phong, "phong");
    put(text, effects->clamp_vertex, "clamp");
    put(text, effects->linear, "linear");
    put(text, effects->show_clipped, "clipped");
    put(text, effects->limit, "limit");
    for (int g = 0; g < effects->group_count; g++) {
        const LightGroup *group = &effects->groups[g];
        const LightTerms *terms = &group->terms;
        put(text, true, "|");
        for (int i = 0; i < group->count; i++)
            put(text, true, formatted("%d", group->lights[i]));
        put(text, true, terms->any ? "any" : kinds[terms->kind]);
        put(text, terms->ambient, "ambient");
        put(text, terms->diffuse, "diffuse");
        put(text, terms->specular, "specular");
        put(text, terms->attenuation, "attenuation");
        put(text, terms->exponent, "exponent");
        put(text, terms->half_vector, "half");
        put(text, terms->at_vertex, "at_vertex");
        put(text, terms->signed_dots, "signed");
    }
}

static void assert_set(const char *expected)
{
    char text[1024];
    SUCCEEDS(scene_check(&world.scene, message));
    const Effects effects = effects_of(&world.scene, &world.object);
    write_set(&effects, text);
    assert_string_equal(text, expected);
}

/* effects_explain writes a line that begins with this, after any indentation. */
static void assert_said(const char *line)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    effects_explain(&world.scene, &world.object, file);
    fclose(file);
    bool said = false;
    for (const char *at = text; *at && !said; at += strcspn(at, "\n") + 1) {
        at += strspn(at, " ");
        said = strncmp(at, line, strlen(line)) == 0;
    }
    if (!said)
        fail_msg("\"%s\" is not said in:\n%s", line, text);
    free(text);
}

/* The set after a change. */
#define AFTER(change, expected) ((void)(change), assert_set(expected))

static const char PLAIN[] = "normals unit_fragment | 0 directional diffuse";
static const char UNEVEN[] = "normals matrix unit_vertex unit_fragment | 0 directional diffuse";

TEST_WITH(0, diffuse_light_alone_needs_normals_and_no_more, set_up, NULL)
{
    assert_set(PLAIN);
    assert_said("light 0: directional, computed at the fragments");
    assert_said("diffuse: in light and material");
    assert_said("without specular: black in light or material");
    assert_said("without ambient:");
    assert_said("without attenuation: the light is at infinity");
    assert_said("without base: neither emission nor constant ambient light");
    assert_said("without alpha: the surface is opaque");
    assert_said("without a back side: it is lit like the front");
    assert_said("without local viewer: no term is specular");
    assert_said("without normal matrix: the model-view matrix is orthogonal");
    assert_said("normals not normalized at the vertices: the transform keeps their length");
    assert_said("normals normalized at the fragments: interpolation may shorten them");
    assert_said("without culling: the object is open");
    assert_said("without clamping at the vertices: not requested");
    assert_said("without sRGB encoding: not requested");
    assert_said("without highlighting overexposed pixels: not requested");
}

TEST_WITH(0, a_light_that_is_off_or_black_is_left_out, set_up, NULL)
{
    AFTER(world.lights[0].off = true, "");
    assert_said("without light 0: it is off");
    assert_said("without normals: no term depends on them");
    world.lights[0].off = false;
    AFTER(world.lights[0].diffuse = BLACK, "");
    assert_said("without light 0: the material reflects none of its colour");
    world.lights[0].diffuse = RED;
    AFTER(world.object.front.diffuse = GREEN, "");
    AFTER((world.lights[0].diffuse = (Vec3){0, 0, 1}), "");
    AFTER(world.scene.light_count = 0, "");
}

TEST_WITH(0, a_light_whose_cone_misses_the_object_is_left_out, set_up, NULL)
{
    Light *light = &world.lights[0];
    *light = (Light){.kind = LIGHT_SPOT,
                     .position = {0, 0, 10},
                     .direction = {0, 0, -1},
                     .diffuse = WHITE,
                     .cutoff = 10};
    assert_set("normals unit_fragment | 0 spot diffuse");
    assert_said("spot: only within its cone, without falloff: its exponent is 0");
    AFTER((light->direction = (Vec3){0, 0, 1}), "");
    assert_said("without light 0: its cone misses the object");
    AFTER((light->direction = (Vec3){0, 1, -1}), "");
    light->cutoff = 90; /* the cone is a half space that contains the object */
    assert_set("normals unit_fragment | 0 spot diffuse");
    AFTER((light->direction = (Vec3){0, 0, 1}), "");
    light->position = (Vec3){0, 0, 0}; /* inside the object, in any direction */
    AFTER(light->cutoff = 1, "normals unit_fragment | 0 spot diffuse");
}

TEST_WITH(0, even_ambient_light_is_part_of_the_base, set_up, NULL)
{
    world.lights[0].diffuse = BLACK;
    AFTER(shine_ambient(), "base");
    assert_said("without light 0: the material reflects none of its colour but the ambient");
    world.lights[0].kind = LIGHT_POINT;
    AFTER(world.lights[0].constant = 2, "base"); /* constant */
    AFTER(world.lights[0].linear = 0.1, "| 0 point ambient attenuation");
    assert_said("ambient: varies over the surface, as the light does");
    world.lights[0] = (Light){.kind = LIGHT_SPOT,
                              .position = {0, 0, 5},
                              .direction = {0, 0, -1},
                              .ambient = WHITE,
                              .cutoff = 20};
    assert_set("| 0 spot ambient");
}

TEST_WITH(0, emission_and_global_ambient_light_are_the_base, set_up, NULL)
{
    world.scene.light_count = 0;
    AFTER(world.object.front.emission = RED, "base");
    assert_said("base: emission or constant ambient light");
    world.object.front.emission = BLACK;
    AFTER(world.scene.global_ambient = RED, "");
    AFTER(world.object.front.ambient = GREEN, "");
    AFTER(world.object.front.ambient = WHITE, "base");
}

TEST_WITH(0, the_half_vector_is_constant_only_for_a_far_light_a_far_viewer_and_blinn_phong, set_up,
          NULL)
{
    shine_specular();
    world.scene.distant_viewer = true;
    assert_set("normals unit_fragment | 0 directional diffuse specular half");
    assert_said("half vector: a uniform, because light and viewer are at infinity");
    assert_said("without local viewer: the viewer is at infinity");
    world.scene.reflection = REFLECTION_PHONG;
    assert_set("normals unit_fragment phong | 0 directional diffuse specular");
    assert_said("without half vector as a uniform: the Phong reflection has none");
    world.scene.reflection = REFLECTION_BLINN_PHONG;
    AFTER(world.lights[0].kind = LIGHT_POINT, "normals unit_fragment | 0 point diffuse specular");
    assert_said("without half vector as a uniform: the light is near");
    world.lights[0].kind = LIGHT_DIRECTIONAL;
    world.scene.distant_viewer = false;
    assert_set("normals unit_fragment local | 0 directional diffuse specular");
    assert_said("without half vector as a uniform: the viewer is near");
}

TEST_WITH(0, a_fall_off_counts_only_for_spots, set_up, NULL)
{
    Light *light = &world.lights[0];
    AFTER(light->exponent = 8, PLAIN);
    light->kind = LIGHT_SPOT;
    light->direction = (Vec3){0, 0, -1};
    AFTER(light->cutoff = 45, "normals unit_fragment | 0 spot diffuse exponent");
    assert_said("spot: only within its cone, with falloff");
}

TEST_WITH(0, lights_of_equal_terms_share_a_group, set_up, NULL)
{
    world.scene.light_count = 4;
    for (int i = 1; i < 4; i++)
        world.lights[i] = world.lights[0];
    world.lights[1].kind = LIGHT_POINT;
    world.lights[2].diffuse = RED;
    world.lights[3].off = true;
    assert_set("normals unit_fragment | 0 2 directional diffuse | 1 point diffuse");
    world.lights[3].off = false;
    assert_set("normals unit_fragment | 0 2 3 directional diffuse | 1 point diffuse");
}

TEST_WITH(0, vertices_or_fragments_are_lit_as_the_interpolation_says, set_up, NULL)
{
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    assert_set("normals | 0 directional diffuse at_vertex");
    assert_said("light 0: directional, computed at the vertices: colours are interpolated");
    assert_said("normals not normalized at the fragments: no light is computed there");
    world.scene.interpolation = INTERPOLATION_FLAT;
    assert_set("normals | 0 directional diffuse at_vertex");
    assert_said("light 0: directional, computed at the vertices: of flat triangles");
}

TEST_WITH(0, constant_light_on_a_flat_triangle_moves_to_the_vertices, set_up, NULL)
{
    world.object.mesh = &cube;
    AFTER(world.object.flat = true, "normals | 0 directional diffuse at_vertex");
    assert_said("light 0: directional, computed at the vertices: constant over a flat triangle");
    shine_specular(); /* the direction to the eye varies */
    assert_set("normals local | 0 directional diffuse specular");
    assert_said("normals not normalized at the fragments: constant over a triangle");
    world.scene.distant_viewer = true;
    assert_set("normals | 0 directional diffuse specular half at_vertex");
    AFTER(world.lights[0].kind = LIGHT_POINT, "normals | 0 point diffuse specular");
}

static Mat4 turned(void)
{
    return mat4_rotate(77, (Vec3){1, -2, 3});
}

static Mat4 scaled(double x, double y, double z)
{
    return mat4_scale((Vec3){x, y, z});
}

TEST_WITH(0, a_normal_matrix_is_needed_only_where_the_model_view_is_not_orthogonal, set_up, NULL)
{
    const Mat4 turn = turned();
    AFTER(transform_by(turn), PLAIN);
    transform_by(mat4_product(mat4_translate((Vec3){1, 2, -3}), turn));
    assert_set(PLAIN);
    AFTER(transform_by(mat4_product(turn, scaled(-1, 1, 1))), PLAIN); /* mirrored */
    transform_by(mat4_product(turn, scaled(0.5, 0.5, 0.5)));          /* the fragments normalize */
    assert_set(PLAIN);
    assert_said(
        "normals not normalized at the vertices: the fragments do it, and all lengths are equal");
    AFTER(transform_by(mat4_product(turn, scaled(-3, 3, 3))), PLAIN);
    AFTER(transform_by(mat4_product(turn, scaled(1, 1, 1.01))), UNEVEN);
    assert_said("normal matrix: the model-view matrix scales unevenly or shears");
    assert_said("normals normalized at the vertices: the transform changes their length");
    Mat4 shear = mat4_identity();
    shear.m[4] = 0.5;
    AFTER(transform_by(mat4_product(turn, shear)), UNEVEN);
    AFTER(transform_by(scaled(1, 1, 0)), UNEVEN); /* flattened */
    /* Their squares underflow in float, or lose digits in 16 bits, from 1/100 and 100 on. */
    static const double extremes[] = {1e-20, 0.0099, 101}, usual[] = {0.0101, 99};
    for (int i = 0; i < 3; i++) {
        AFTER(transform_by(scaled(extremes[i], extremes[i], extremes[i])), UNEVEN);
        AFTER(transform_by(scaled(usual[i % 2], usual[i % 2], usual[i % 2])), PLAIN);
    }
}

TEST_WITH(0, uneven_scales_that_cancel_need_no_normal_matrix, set_up, NULL)
{
    const Mat4 uneven = scaled(2, 3, 4), undone = scaled(1.0 / 2, 1.0 / 3, 1.0 / 4);
    AFTER(transform_by(mat4_product(mat4_product(turned(), uneven), undone)), PLAIN);
}

TEST_WITH(0, vertices_normalize_normals_if_they_use_their_length, set_up, NULL)
{
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    AFTER(transform_by(scaled(2, 2, 2)), "normals unit_vertex | 0 directional diffuse at_vertex");
    AFTER(transform_by(scaled(-1, 1, 1)), "normals | 0 directional diffuse at_vertex");
    transform_by(scaled(1, 2, 1));
    assert_set("normals matrix unit_vertex | 0 directional diffuse at_vertex");
    world.scene.interpolation = INTERPOLATION_PHONG;
    world.object.mesh = &cube;
    world.object.flat = true; /* no fragment normalizes: constant over a triangle */
    world.lights[0].kind = LIGHT_POINT;
    AFTER(transform_by(scaled(2, 2, 2)), "normals unit_vertex | 0 point diffuse");
}

TEST_WITH(0, wrong_normals_never_need_a_matrix_of_their_own, set_up, NULL)
{
    world.object.wrong_normals = true;
    transform_by(scaled(1, 1, 2));
    assert_set("normals unit_vertex unit_fragment | 0 directional diffuse");
    assert_said("without normal matrix: the scene requests the wrong one");
}

TEST_WITH(0, a_closed_object_seen_from_outside_is_culled_and_has_no_back, set_up, NULL)
{
    AFTER(world.object.closed = true, "cull normals unit_fragment | 0 directional diffuse");
    assert_said("culling of back faces: a closed object, seen from outside");
    world.object.two_sided = true;
    world.object.back.emission = RED;
    AFTER(world.object.back.alpha = 0.5, "cull normals unit_fragment | 0 directional diffuse");
    assert_said("without a back side: it is never seen");
    world.scene.camera.eye = (Vec3){0, 0, 1.05}; /* the near plane cuts the object */
    assert_set("two base alpha normals unit_fragment | 0 directional diffuse");
    assert_said("alpha: the surface is not opaque");
    assert_said("without culling: the near plane may cut the object");
    assert_said("two-sided: the back has its own material and the opposite normal");
    world.scene.camera.eye = (Vec3){0, 0, 0.5}; /* the eye is inside */
    AFTER(world.object.two_sided = false, PLAIN);
}

TEST_WITH(0, overexposure_is_tested_only_if_it_is_possible, set_up, NULL)
{
    AFTER(world.scene.show_clipped = true, "normals unit_fragment clipped | 0 directional diffuse");
    assert_said("overexposed pixels highlighted: requested");
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    assert_set("normals clipped | 0 directional diffuse at_vertex");
    world.scene.clamp_vertex = world.scene.linear = true;
    assert_set("normals clamp linear | 0 directional diffuse at_vertex");
    assert_said("clamping at the vertices: requested");
    assert_said("sRGB encoding: requested");
    assert_said("without highlighting overexposed pixels: colours are clamped at the vertices");
}

TEST_WITH(0, dot_products_are_clamped_unless_requested_and_under_lights_with_shadows, set_up, NULL)
{
    AFTER(world.scene.signed_dots = true, "normals unit_fragment | 0 directional diffuse signed");
    assert_said("dot products not clamped: requested; where N.L is negative, the light takes "
                "light away");
    AFTER(world.lights[0].shadows = true, PLAIN);
    assert_said("dot products clamped: none of a light with shadows arrives from behind");
}

TEST_WITH(0, the_full_set_has_every_effect, set_up, NULL)
{
    char text[1024];
    world.lights[0].off = true;
    Effects full = effects_full(&world.scene, &world.object);
    write_set(&full, text);
    assert_string_equal(text, "two base alpha normals matrix unit_vertex unit_fragment local | 0 "
                              "any ambient diffuse specular attenuation exponent");
    world.scene.interpolation = INTERPOLATION_FLAT;
    world.scene.clamp_vertex = world.scene.linear = true;
    world.scene.reflection = REFLECTION_PHONG;
    world.scene.light_count = 2;
    world.lights[1] = world.lights[0];
    full = effects_full(&world.scene, &world.object);
    write_set(&full, text);
    assert_string_equal(text, "two base alpha normals matrix unit_vertex unit_fragment local phong "
                              "clamp linear | 0 1 any ambient diffuse specular attenuation "
                              "exponent at_vertex");
}

/* Guards. */

static void assert_guarded(bool expected)
{
    SUCCEEDS(scene_check(&world.scene, message));
    assert_int_equal(effects_of(&world.scene, &world.object).groups[0].guard_attenuation, expected);
}

TEST_WITH(0, attenuation_is_guarded_unless_its_constant_coefficient_bounds_it, set_up, NULL)
{
    Light *light = &world.lights[0];
    *light = (Light){.kind = LIGHT_POINT, .position = {0, 1, 0}, .diffuse = WHITE, .linear = 1};
    assert_guarded(true);
    assert_said("guard of the attenuation: its denominator may be 0, or overflow");
    light->constant = 1e-3;
    assert_guarded(false);
    assert_said("without guard of the attenuation: its constant coefficient is not 0");
    light->constant = 1e-30;
    assert_guarded(true);
    light->constant = 1;
    transform_by(scaled(1e19, 1e19, 1e19)); /* squares of distances overflow */
    assert_guarded(true);
    light->linear = 0; /* no attenuation */
    assert_guarded(false);
    assert_said("without attenuation: constant");
}

static void assert_limited(bool expected)
{
    SUCCEEDS(scene_check(&world.scene, message));
    assert_int_equal(effects_of(&world.scene, &world.object).limit, expected);
    assert_int_equal(effects_full(&world.scene, &world.object).limit, expected);
}

TEST_WITH(0, colours_are_limited_where_they_may_be_large, set_up, NULL)
{
    Light *light = &world.lights[0];
    *light = (Light){.kind = LIGHT_POINT, .position = {0, 1, 0}, .diffuse = WHITE, .constant = 0};
    assert_limited(false); /* 0 is 1 */
    light->quadratic = 1;
    assert_limited(true);
    assert_said("colours limited: drivers may draw very large ones as black");
    light->off = true;
    assert_limited(false);
    light->off = false;
    light->constant = 1e-3;
    assert_limited(false);
    light->specular = (Vec3){0, 2000, 0};
    assert_limited(true);
    light->quadratic = 0;
    assert_limited(true);
    light->kind = LIGHT_DIRECTIONAL;
    light->direction = (Vec3){0, 0, -1};
    assert_limited(false);
}

TEST_WITH(0, a_group_is_guarded_if_any_of_its_lights_needs_it, set_up, NULL)
{
    world.lights[0] = (Light){
        .kind = LIGHT_POINT, .position = {0, 5, 0}, .diffuse = WHITE, .constant = 1, .linear = 1};
    world.lights[1] = world.lights[0];
    world.scene.light_count = 2;
    assert_guarded(false);
    world.lights[1].constant = 0;
    assert_set("normals unit_fragment limit | 0 1 point diffuse attenuation");
    assert_said("attenuation: depends on the distance");
    assert_guarded(true);
    assert_true(effects_full(&world.scene, &world.object).groups[0].guard_attenuation);
}

TEST_MAIN("effects", open_meshes, close_meshes)
