/*
 * Which effects a scene calls for, and the reasons that are said for them. No GL.
 */
#include "effects.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

/* A cube that one light shines on, to be changed. */
typedef struct World {
    Light lights[EFFECTS_MOST_LIGHTS];
    Object object;
    Scene scene;
} World;

static World world;
static Mesh cube, sphere, fine;

static const Vec3 BLACK = {0, 0, 0}, WHITE = {1, 1, 1}, RED = {1, 0, 0}, GREEN = {0, 1, 0};

static int open_meshes(void **state)
{
    (void)state;
    return mesh_cube(&cube, 1, NULL) && mesh_sphere(&sphere, 1, 8, 4, NULL) &&
                   mesh_sphere(&fine, 1, 24, 12, NULL)
               ? 0
               : 1;
}

static int close_meshes(void **state)
{
    (void)state;
    mesh_close(&cube);
    mesh_close(&sphere);
    mesh_close(&fine);
    return 0;
}

/* A smooth open object in white directional light, lit at the fragments; black but for diffuse. */
static int set_up(void **state)
{
    (void)state;
    world = (World){
        .lights = {{.kind = LIGHT_DIRECTIONAL, .direction = {0, 1, 1}, .diffuse = WHITE}},
        .object = {.mesh = &sphere,
                   .world_from_object = mat4_identity(),
                   .front = {.diffuse = WHITE, .alpha = 1, .shininess = 16},
                   .back = {.diffuse = WHITE, .alpha = 1, .shininess = 16}},
        .scene = {.camera = {{3, 2, 5}, {0, 0, 0}, {0, 1, 0}, 45, 0.1, 100},
                  .lights = world.lights,
                  .light_count = 1,
                  .objects = &world.object,
                  .object_count = 1},
    };
    return 0;
}

static void shine_specular(void)
{
    world.lights[0].specular = WHITE;
    world.object.front.specular = WHITE;
}

static void shine_ambient(void)
{
    world.lights[0].ambient = WHITE;
    world.object.front.ambient = WHITE;
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
    put(text, effects->reflection == REFLECTION_PHONG, "phong");
    put(text, effects->clamp_vertex, "clamp");
    put(text, effects->linear, "linear");
    put(text, effects->show_clipped, "clipped");
    for (int g = 0; g < effects->group_count; g++) {
        const LightGroup *group = &effects->groups[g];
        const LightTerms *terms = &group->terms;
        put(text, true, "|");
        for (int i = 0; i < group->count; i++) {
            char number[16];
            snprintf(number, sizeof number, "%d", group->lights[i]);
            put(text, true, number);
        }
        put(text, true, terms->any ? "any" : kinds[terms->kind]);
        put(text, terms->ambient, "ambient");
        put(text, terms->diffuse, "diffuse");
        put(text, terms->specular, "specular");
        put(text, terms->attenuation, "attenuation");
        put(text, terms->exponent, "exponent");
        put(text, terms->half_vector, "half");
        put(text, terms->at_vertex, "at_vertex");
    }
}

static void assert_set(const char *expected)
{
    char text[1024];
    Message message = {0};
    if (!scene_check(&world.scene, &message))
        fail_msg("%s", message.text);
    const Effects effects = effects_of(&world.scene, &world.object);
    write_set(&effects, text);
    assert_string_equal(text, expected);
}

/* Whether effects_explain says this, as a line or the beginning of one; spaces before it do not
 * count. */
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

static void diffuse_light_alone_needs_normals_and_no_more(void **state)
{
    (void)state;
    assert_set("normals unit_fragment | 0 directional diffuse");
    assert_said("light 0: directional, computed at the fragments");
    assert_said("diffuse: light and material both have it");
    assert_said("without specular: light or material is black there");
    assert_said("without ambient:");
    assert_said("without attenuation: the light is at infinity");
    assert_said("without base: neither emission nor even ambient light");
    assert_said("without alpha: the surface is opaque");
    assert_said("without a back: it is lit as the front");
    assert_said("without local viewer: nothing is specular");
    assert_said("without normal matrix: the model-view matrix is orthogonal, and serves");
    assert_said("normals not made unit at the vertices: the transform keeps their length");
    assert_said("normals made unit at the fragments: interpolated ones are shorter");
    assert_said("without culling: the object is open");
    assert_said("without clamping at the vertices: not asked for");
    assert_said("without sRGB encoding: not asked for");
    assert_said("without painting over-exposed pixels: not asked for");
}

static void a_term_needs_its_colour_in_light_and_material_alike(void **state)
{
    (void)state;
    world.lights[0].specular = WHITE;
    assert_set("normals unit_fragment | 0 directional diffuse");
    world.object.front.specular = RED;
    assert_set("normals unit_fragment local | 0 directional diffuse specular");
    assert_said("specular: light and material both have it");
    assert_said("local viewer: the direction to the eye differs from point to point");
    world.lights[0].specular = GREEN; /* of which the red material reflects nothing */
    assert_set("normals unit_fragment | 0 directional diffuse");
    world.object.front.diffuse = BLACK;
    world.lights[0].specular = RED;
    assert_set("normals unit_fragment local | 0 directional specular");
    assert_said("without diffuse: light or material is black there");
}

static void a_light_that_is_off_or_black_is_not_there(void **state)
{
    (void)state;
    world.lights[0].off = true;
    assert_set("");
    assert_said("without light 0: it is off");
    assert_said("without normals: nothing depends on them");
    world.lights[0].off = false;
    world.lights[0].diffuse = BLACK;
    assert_set("");
    assert_said("without light 0: it has no colour that the material reflects");
    world.lights[0].diffuse = RED;
    world.object.front.diffuse = GREEN;
    assert_set("");
    world.scene.light_count = 0;
    assert_set("");
}

static void a_light_whose_cone_misses_the_object_is_not_there(void **state)
{
    Light *light = &world.lights[0];
    (void)state;
    *light = (Light){.kind = LIGHT_SPOT,
                     .position = {0, 0, 10},
                     .direction = {0, 0, -1},
                     .diffuse = WHITE,
                     .cutoff = 10};
    assert_set("normals unit_fragment | 0 spot diffuse");
    assert_said("spot: only within its cone, without fall-off: its exponent is 0");
    light->direction = (Vec3){0, 0, 1};
    assert_set("");
    assert_said("without light 0: its cone misses the object");
    light->direction = (Vec3){0, 1, -1};
    assert_set("");
    light->cutoff = 90; /* a half space: the object is in it */
    assert_set("normals unit_fragment | 0 spot diffuse");
    light->direction = (Vec3){0, 0, 1};
    assert_set("");
    light->position = (Vec3){0, 0, 0}; /* from within the object, wherever it points */
    light->cutoff = 1;
    assert_set("normals unit_fragment | 0 spot diffuse");
}

static void no_cone_that_holds_a_vertex_is_left_out(void **state)
{
    Light *light = &world.lights[0];
    (void)state;
    world.object.mesh = &cube;
    int left_out = 0;
    for (int i = 0; i < 3600; i++) {
        const double turn = i * 0.0174532925199, cutoff = i % 91;
        *light = (Light){.kind = LIGHT_SPOT,
                         .position = {2 * cos(turn) + 3, i % 7 - 3, 4 * sin(turn)},
                         .direction = {sin(3.1 * turn), cos(1.7 * turn), sin(0.9 * turn) - 0.5},
                         .diffuse = WHITE,
                         .cutoff = cutoff};
        bool holds = false;
        for (size_t k = 0; k < cube.vertex_count; k++) {
            const float *p = cube.vertices[k].position;
            Vec3 way, axis;
            vec3_normalize(
                vec3_subtract((Vec3){(double)p[0], (double)p[1], (double)p[2]}, light->position),
                &way);
            vec3_normalize(light->direction, &axis);
            holds |= vec3_dot(way, axis) >= cos(cutoff * 0.017453292519943295);
        }
        const bool there = effects_of(&world.scene, &world.object).group_count > 0;
        assert_true(there || !holds);
        left_out += !there;
    }
    assert_true(left_out > 1000);
}

static void even_ambient_light_is_part_of_the_base(void **state)
{
    (void)state;
    world.lights[0].diffuse = BLACK;
    shine_ambient();
    assert_set("base");
    assert_said("without light 0: it has no colour that the material reflects, but an ambient one");
    world.lights[0].kind = LIGHT_POINT;
    world.lights[0].constant = 2; /* the same everywhere */
    assert_set("base");
    world.lights[0].linear = 0.1;
    assert_set("| 0 point ambient attenuation");
    assert_said("ambient: varies over the surface, for the light does");
    world.lights[0] = (Light){.kind = LIGHT_SPOT,
                              .position = {0, 0, 5},
                              .direction = {0, 0, -1},
                              .ambient = WHITE,
                              .cutoff = 20};
    assert_set("| 0 spot ambient");
}

static void emission_and_global_ambient_light_are_the_base(void **state)
{
    (void)state;
    world.scene.light_count = 0;
    world.object.front.emission = RED;
    assert_set("base");
    assert_said("base: emission or ambient light that is the same everywhere");
    world.object.front.emission = BLACK;
    world.scene.global_ambient = RED;
    assert_set("");
    world.object.front.ambient = GREEN;
    assert_set("");
    world.object.front.ambient = WHITE;
    assert_set("base");
}

static void the_half_vector_is_one_only_for_far_light_far_viewer_and_blinn_phong(void **state)
{
    (void)state;
    shine_specular();
    world.scene.distant_viewer = true;
    assert_set("normals unit_fragment | 0 directional diffuse specular half");
    assert_said("half vector: one for all, since light and viewer are at infinity: computed once");
    assert_said("without local viewer: it is at infinity");
    world.scene.reflection = REFLECTION_PHONG;
    assert_set("normals unit_fragment phong | 0 directional diffuse specular");
    assert_said("without one half vector for all: the Phong reflection has none");
    world.scene.reflection = REFLECTION_BLINN_PHONG;
    world.lights[0].kind = LIGHT_POINT;
    assert_set("normals unit_fragment | 0 point diffuse specular");
    assert_said("without one half vector for all: the light is near");
    world.lights[0].kind = LIGHT_DIRECTIONAL;
    world.scene.distant_viewer = false;
    assert_set("normals unit_fragment local | 0 directional diffuse specular");
    assert_said("without one half vector for all: the viewer is near");
}

static void the_reflection_counts_only_where_something_is_specular(void **state)
{
    (void)state;
    world.scene.reflection = REFLECTION_PHONG;
    assert_set("normals unit_fragment | 0 directional diffuse");
    shine_specular();
    assert_set("normals unit_fragment local phong | 0 directional diffuse specular");
}

static void attenuation_counts_only_where_it_depends_on_distance(void **state)
{
    Light *light = &world.lights[0];
    (void)state;
    light->linear = 1;
    assert_set("normals unit_fragment | 0 directional diffuse");
    light->kind = LIGHT_POINT;
    assert_set("normals unit_fragment | 0 point diffuse attenuation");
    assert_said("attenuation: depends on the distance");
    light->linear = 0;
    light->constant = 3;
    assert_set("normals unit_fragment | 0 point diffuse");
    assert_said("without attenuation: it is the same at every distance");
    light->quadratic = 0.01;
    assert_set("normals unit_fragment | 0 point diffuse attenuation");
}

static void a_fall_off_counts_only_for_spots(void **state)
{
    Light *light = &world.lights[0];
    (void)state;
    light->exponent = 8;
    assert_set("normals unit_fragment | 0 directional diffuse");
    light->kind = LIGHT_SPOT;
    light->direction = (Vec3){0, 0, -1};
    light->cutoff = 45;
    assert_set("normals unit_fragment | 0 spot diffuse exponent");
    assert_said("spot: only within its cone, with a fall-off there");
}

static void lights_of_equal_terms_share_a_group(void **state)
{
    (void)state;
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

static void vertices_or_fragments_are_lit_as_the_interpolation_says(void **state)
{
    (void)state;
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    assert_set("normals | 0 directional diffuse at_vertex");
    assert_said("light 0: directional, computed at the vertices: colours are interpolated");
    assert_said("normals not made unit at the fragments: no light is computed there");
    world.scene.interpolation = INTERPOLATION_FLAT;
    assert_set("normals | 0 directional diffuse at_vertex");
    assert_said("light 0: directional, computed at the vertices: of flat triangles");
}

static void light_that_is_the_same_all_over_a_flat_triangle_moves_to_the_vertices(void **state)
{
    (void)state;
    world.object.mesh = &cube;
    world.object.flat = true;
    assert_set("normals | 0 directional diffuse at_vertex");
    assert_said("light 0: directional, computed at the vertices: it is the same all over");
    shine_specular(); /* the way to the eye differs */
    assert_set("normals local | 0 directional diffuse specular");
    assert_said("normals not made unit at the fragments: they are the same all over a triangle");
    world.scene.distant_viewer = true;
    assert_set("normals | 0 directional diffuse specular half at_vertex");
    world.lights[0].kind = LIGHT_POINT;
    assert_set("normals | 0 point diffuse specular");
}

static Mat4 turned(void)
{
    Mat4 turn;
    mat4_rotate(77, (Vec3){1, -2, 3}, &turn);
    return turn;
}

static Mat4 scaled(double x, double y, double z)
{
    return mat4_scale((Vec3){x, y, z});
}

static void a_normal_matrix_is_needed_only_where_the_model_view_is_not_orthogonal(void **state)
{
    const Mat4 turn = turned();
    (void)state;
    transform_by(turn);
    assert_set("normals unit_fragment | 0 directional diffuse");
    transform_by(mat4_product(mat4_translate((Vec3){1, 2, -3}), turn));
    assert_set("normals unit_fragment | 0 directional diffuse");
    transform_by(mat4_product(turn, scaled(-1, 1, 1))); /* mirrored */
    assert_set("normals unit_fragment | 0 directional diffuse");
    transform_by(mat4_product(turn, scaled(0.5, 0.5, 0.5))); /* the fragments make them unit */
    assert_set("normals unit_fragment | 0 directional diffuse");
    assert_said("normals not made unit at the vertices: the fragments do it, and all are equally");
    transform_by(mat4_product(turn, scaled(-3, 3, 3)));
    assert_set("normals unit_fragment | 0 directional diffuse");
    transform_by(mat4_product(turn, scaled(1, 1, 1.01)));
    assert_set("normals matrix unit_vertex unit_fragment | 0 directional diffuse");
    assert_said("normal matrix: the model-view matrix scales unevenly or shears");
    assert_said("normals made unit at the vertices: the transform changes their length");
    Mat4 shear = mat4_identity();
    shear.m[4] = 0.5;
    transform_by(mat4_product(turn, shear));
    assert_set("normals matrix unit_vertex unit_fragment | 0 directional diffuse");
    transform_by(scaled(1, 1, 0)); /* flattened */
    assert_set("normals matrix unit_vertex unit_fragment | 0 directional diffuse");
    transform_by(scaled(1e-20, 1e-20, 1e-20)); /* whose squares a float does not hold */
    assert_set("normals matrix unit_vertex unit_fragment | 0 directional diffuse");
}

static void an_uneven_scale_that_another_undoes_needs_no_normal_matrix(void **state)
{
    const Mat4 uneven = scaled(2, 3, 4), undone = scaled(1.0 / 2, 1.0 / 3, 1.0 / 4);
    (void)state;
    transform_by(mat4_product(mat4_product(turned(), uneven), undone));
    assert_set("normals unit_fragment | 0 directional diffuse");
}

static void normals_are_made_unit_at_the_vertices_where_their_length_counts_there(void **state)
{
    (void)state;
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    transform_by(scaled(2, 2, 2));
    assert_set("normals unit_vertex | 0 directional diffuse at_vertex");
    transform_by(scaled(-1, 1, 1));
    assert_set("normals | 0 directional diffuse at_vertex");
    transform_by(scaled(1, 2, 1));
    assert_set("normals matrix unit_vertex | 0 directional diffuse at_vertex");
    world.scene.interpolation = INTERPOLATION_PHONG;
    world.object.mesh = &cube;
    world.object.flat = true; /* no fragment makes it unit: it is the same everywhere */
    world.lights[0].kind = LIGHT_POINT;
    transform_by(scaled(2, 2, 2));
    assert_set("normals unit_vertex | 0 point diffuse");
}

static void wrong_normals_never_need_a_matrix_of_their_own(void **state)
{
    (void)state;
    world.object.wrong_normals = true;
    transform_by(scaled(1, 1, 2));
    assert_set("normals unit_vertex unit_fragment | 0 directional diffuse");
    assert_said("without normal matrix: the scene asks for the wrong one");
}

static void normals_are_not_there_where_only_ambient_light_varies(void **state)
{
    (void)state;
    world.lights[0] = (Light){.kind = LIGHT_POINT, .ambient = WHITE, .linear = 1};
    world.object.front.ambient = WHITE;
    transform_by(scaled(1, 2, 3));
    assert_set("| 0 point ambient attenuation");
}

static void a_closed_object_seen_from_outside_is_culled_and_has_no_back(void **state)
{
    (void)state;
    world.object.closed = true;
    assert_set("cull normals unit_fragment | 0 directional diffuse");
    assert_said("culling of back faces: a closed object, seen from outside");
    world.object.two_sided = true;
    world.object.back.emission = RED;
    world.object.back.alpha = 0.5;
    assert_set("cull normals unit_fragment | 0 directional diffuse");
    assert_said("without a back: it is never seen");
    world.scene.camera.eye = (Vec3){0, 0, 1.05}; /* the near plane cuts it */
    assert_set("two base alpha normals unit_fragment | 0 directional diffuse");
    assert_said("without culling: the near plane may cut the object");
    assert_said("two-sided: the back has its own material and the reversed normal");
    world.scene.camera.eye = (Vec3){0, 0, 0.5}; /* inside */
    world.object.two_sided = false;
    assert_set("normals unit_fragment | 0 directional diffuse");
}

static void the_back_counts_only_where_two_sides_are_lit(void **state)
{
    (void)state;
    world.lights[0].specular = WHITE;
    world.object.back.specular = WHITE;
    world.object.back.emission = WHITE;
    world.object.back.alpha = 0.5;
    assert_set("normals unit_fragment | 0 directional diffuse");
    world.object.two_sided = true;
    assert_set("two base alpha normals unit_fragment local | 0 directional diffuse specular");
    assert_said("alpha: the surface is not opaque");
}

static void clamping_counts_only_where_lit_vertices_are_interpolated(void **state)
{
    (void)state;
    world.scene.clamp_vertex = true;
    assert_set("normals unit_fragment | 0 directional diffuse");
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    assert_set("normals clamp | 0 directional diffuse at_vertex");
    assert_said("clamping at the vertices: asked for");
    world.scene.interpolation = INTERPOLATION_PHONG;
    world.object.mesh = &cube;
    world.object.flat = true; /* at the vertices, but by our choice */
    assert_set("normals | 0 directional diffuse at_vertex");
}

static void over_exposure_is_looked_for_only_where_it_can_be(void **state)
{
    (void)state;
    world.scene.show_clipped = true;
    assert_set("normals unit_fragment clipped | 0 directional diffuse");
    assert_said("over-exposed pixels painted: asked for");
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    assert_set("normals clipped | 0 directional diffuse at_vertex");
    world.scene.clamp_vertex = true;
    assert_set("normals clamp | 0 directional diffuse at_vertex");
    assert_said("without painting over-exposed pixels: clamped at the vertices, none is");
}

static void linear_light_is_only_there_when_asked_for(void **state)
{
    (void)state;
    world.scene.linear = true;
    assert_set("normals unit_fragment linear | 0 directional diffuse");
    assert_said("sRGB encoding at the end: asked for");
}

/* Of a number, only whether it is zero; of alpha, whether it is one. */
static void values_do_not_change_the_set(void **state)
{
    Light *light = &world.lights[0];
    char before[1024], after[1024];
    (void)state;
    shine_specular();
    shine_ambient();
    light->kind = LIGHT_SPOT;
    light->position = (Vec3){0, 0, 3};
    light->direction = (Vec3){0, 0, -1};
    light->cutoff = 40;
    light->exponent = 2;
    light->constant = light->linear = light->quadratic = 1;
    world.object.front.alpha = 0.5;
    world.object.front.emission = RED;
    const Effects effects = effects_of(&world.scene, &world.object);
    write_set(&effects, before);
    light->diffuse = (Vec3){0.001, 0, 0};
    light->specular = (Vec3){0, 1000, 0};
    light->ambient = (Vec3){0, 0, 0.5};
    light->cutoff = 3;
    light->exponent = 127;
    light->linear = 1e-6;
    light->position = (Vec3){0.5, -0.5, 30};
    world.object.front = (Material){{0, 0, 0.1}, {0.1, 1, 0}, {0, 0.1, 0}, {0, 0, 0.01}, 0, 0};
    world.scene.global_ambient = RED;
    transform_by(turned());
    const Effects others = effects_of(&world.scene, &world.object);
    write_set(&others, after);
    assert_string_equal(after, before);
    assert_memory_equal(&others, &effects, sizeof effects); /* padding too: sets may be compared */
}

static void the_full_set_has_everything_that_is_not_a_question_of_how_to_draw(void **state)
{
    char text[1024];
    (void)state;
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

/* The guards of a set: of the first group's light, then of all. */
static void assert_guards(const char *expected)
{
    char text[256] = "";
    Message message = {0};
    if (!scene_check(&world.scene, &message))
        fail_msg("%s", message.text);
    const Effects effects = effects_of(&world.scene, &world.object);
    const LightGuards *guards = &effects.groups[0].guards;
    put(text, guards->distance, "distance");
    put(text, guards->attenuation, "attenuation");
    put(text, guards->half_vector, "half");
    put(text, effects.guard_vertex, "vertex");
    put(text, effects.guard_fragment, "fragment");
    put(text, effects.guard_viewer, "viewer");
    assert_string_equal(text, expected);
}

static void a_finer_sphere_shines(void)
{
    world.object.mesh = &fine;
    shine_specular();
}

static void no_guard_is_there_where_nothing_can_go_wrong(void **state)
{
    Light *light = &world.lights[0];
    (void)state;
    a_finer_sphere_shines();
    assert_guards("");
    assert_said("without guard of the half vector: the object does not lie between");
    assert_said("without guard of the viewer's direction: nearer than the near plane nothing");
    assert_said("without guard of normals at the fragments: those of a triangle cannot cancel");
    *light = (Light){.kind = LIGHT_POINT,
                     .position = {-3, 2, 2},
                     .diffuse = WHITE,
                     .specular = WHITE,
                     .quadratic = 1};
    assert_guards("");
    assert_said("without guard of the distance: the light is outside the object");
    assert_said("without guard of the attenuation: its denominator is never 0");
    transform_by(mat4_product(turned(), scaled(1, 0.9, 1.2)));
    assert_guards("");
    assert_said("without guard of normals at the vertices: all have a length");
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    assert_guards("");
    assert_said("without guard of the viewer's direction: the eye is outside the object");
}

static void a_light_that_may_touch_the_object_is_guarded(void **state)
{
    Light *light = &world.lights[0];
    (void)state;
    a_finer_sphere_shines();
    world.object.front.specular = BLACK;
    *light = (Light){.kind = LIGHT_POINT, .position = {0, 1, 0}, .diffuse = WHITE, .linear = 1};
    assert_guards("distance attenuation");
    assert_said("guard of the distance: the light may touch the object");
    assert_said("guard of the attenuation: its denominator may be 0, or too large");
    light->constant = 1e-3;
    assert_guards("distance");
    light->constant = 1e-30;
    assert_guards("distance attenuation");
    light->position.y = 1.5;
    assert_guards("");
    light->position.y = 1.01; /* nearer than the margin */
    assert_guards("distance attenuation");
    light->linear = 0; /* the same at every distance */
    assert_guards("distance");
    world.object.mesh = &cube; /* a box is told from the sphere around it */
    world.object.flat = true;
    light->position = (Vec3){0, 0, 1.3};
    assert_guards("");
    transform_by(scaled(1, 1, 0)); /* which has no inverse */
    light->position = (Vec3){0, 0, 0.5};
    assert_guards("vertex");
}

static void a_group_has_the_guards_of_all_its_lights(void **state)
{
    (void)state;
    a_finer_sphere_shines();
    world.lights[0] = (Light){.kind = LIGHT_POINT, .position = {0, 5, 0}, .diffuse = WHITE};
    world.lights[1] = world.lights[0];
    world.scene.light_count = 2;
    assert_guards("");
    world.lights[1].position.y = 1;
    assert_set("normals unit_fragment | 0 1 point diffuse");
    assert_guards("distance");
}

static void an_object_between_light_and_viewer_is_guarded(void **state)
{
    static const Vec3 behind = {-3, -2, -5}, before = {3.3, 2.2, 5.5};
    Light *light = &world.lights[0];
    (void)state;
    a_finer_sphere_shines();
    for (int kind = LIGHT_DIRECTIONAL; kind <= LIGHT_POINT; kind++) {
        for (int distant = 0; distant < 2 - (kind == LIGHT_DIRECTIONAL); distant++) {
            world.scene.distant_viewer = distant;
            light->kind = (LightKind)kind;
            light->direction = light->position = behind;
            assert_guards("half");
            assert_said("guard of the half vector: the object may lie between light and viewer");
            light->direction = light->position = before; /* beyond the eye */
            assert_guards("");
            light->direction = light->position = (Vec3){-3, 2, 5};
            assert_guards("");
        }
    }
    world.scene.distant_viewer = false;
    world.scene.reflection = REFLECTION_PHONG; /* has no half vector */
    light->position = behind;
    assert_guards("");
    world.scene.reflection = REFLECTION_BLINN_PHONG;
    world.object.mesh = &cube; /* from below its bottom to above its top, but beside it */
    light->kind = LIGHT_POINT;
    world.scene.camera.eye = (Vec3){1.5, -6, 0};
    light->position = (Vec3){1.5, 6, 0};
    assert_guards("");
    light->position = (Vec3){-1.5, 6, 0};
    assert_guards("half");
}

static void normals_that_may_cancel_are_guarded(void **state)
{
    Mesh bent;
    (void)state;
    assert_true(mesh_sphere(&bent, 1, 24, 12, NULL));
    world.object.mesh = &bent;
    assert_guards("");
    for (int i = 0; i < 3; i++) /* a pole's */
        bent.vertices[1].normal[i] *= -1;
    assert_guards("fragment");
    assert_said("guard of normals at the fragments: those of a triangle may cancel");
    for (int i = 0; i < 3; i++)
        bent.vertices[1].normal[i] = 0;
    assert_guards("fragment");
    assert_said("guard of normals at the fragments: one at a vertex may have no length");
    transform_by(scaled(1, 2, 1));
    assert_guards("vertex fragment");
    assert_said("guard of normals at the vertices: one may have no length");
    bent.vertices[1].normal[1] = NAN;
    assert_guards("vertex fragment");
    bent.vertices[1].normal[1] = 1;
    assert_guards("");
    transform_by(scaled(1, 1e-3, 1)); /* steeper by far */
    assert_guards("fragment");
    transform_by(scaled(1, 1, 0));
    assert_guards("vertex fragment");
    world.scene.skip_renormalization = true;
    assert_guards("vertex");
    mesh_close(&bent);
}

static void a_vertex_may_be_at_the_eye_but_no_fragment_is(void **state)
{
    (void)state;
    a_finer_sphere_shines();
    world.scene.camera.eye = (Vec3){0, 0, 1};
    world.scene.camera.near = 1e-3;
    world.scene.reflection = REFLECTION_PHONG;
    assert_guards("");
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    assert_guards("viewer");
    assert_said("guard of the viewer's direction: a vertex may be at the eye");
    world.scene.distant_viewer = true;
    assert_guards("");
}

static void the_full_set_has_every_guard(void **state)
{
    (void)state;
    a_finer_sphere_shines();
    const Effects full = effects_full(&world.scene, &world.object);
    assert_true(full.guard_vertex && full.guard_fragment && full.guard_viewer);
    assert_true(full.groups[0].guards.distance && full.groups[0].guards.attenuation &&
                full.groups[0].guards.half_vector);
    Effects effects = effects_of(&world.scene, &world.object);
    effects_guard(&effects); /* as far as it has what is guarded */
    assert_true(!effects.guard_vertex && effects.guard_fragment && effects.guard_viewer);
    assert_true(!effects.groups[0].guards.distance && !effects.groups[0].guards.attenuation &&
                effects.groups[0].guards.half_vector);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup(name, set_up)
    const struct CMUnitTest tests[] = {
        TEST(diffuse_light_alone_needs_normals_and_no_more),
        TEST(a_term_needs_its_colour_in_light_and_material_alike),
        TEST(a_light_that_is_off_or_black_is_not_there),
        TEST(a_light_whose_cone_misses_the_object_is_not_there),
        TEST(no_cone_that_holds_a_vertex_is_left_out),
        TEST(even_ambient_light_is_part_of_the_base),
        TEST(emission_and_global_ambient_light_are_the_base),
        TEST(the_half_vector_is_one_only_for_far_light_far_viewer_and_blinn_phong),
        TEST(the_reflection_counts_only_where_something_is_specular),
        TEST(attenuation_counts_only_where_it_depends_on_distance),
        TEST(a_fall_off_counts_only_for_spots),
        TEST(lights_of_equal_terms_share_a_group),
        TEST(vertices_or_fragments_are_lit_as_the_interpolation_says),
        TEST(light_that_is_the_same_all_over_a_flat_triangle_moves_to_the_vertices),
        TEST(a_normal_matrix_is_needed_only_where_the_model_view_is_not_orthogonal),
        TEST(an_uneven_scale_that_another_undoes_needs_no_normal_matrix),
        TEST(normals_are_made_unit_at_the_vertices_where_their_length_counts_there),
        TEST(wrong_normals_never_need_a_matrix_of_their_own),
        TEST(normals_are_not_there_where_only_ambient_light_varies),
        TEST(a_closed_object_seen_from_outside_is_culled_and_has_no_back),
        TEST(the_back_counts_only_where_two_sides_are_lit),
        TEST(clamping_counts_only_where_lit_vertices_are_interpolated),
        TEST(over_exposure_is_looked_for_only_where_it_can_be),
        TEST(linear_light_is_only_there_when_asked_for),
        TEST(values_do_not_change_the_set),
        TEST(the_full_set_has_everything_that_is_not_a_question_of_how_to_draw),
        TEST(no_guard_is_there_where_nothing_can_go_wrong),
        TEST(a_light_that_may_touch_the_object_is_guarded),
        TEST(a_group_has_the_guards_of_all_its_lights),
        TEST(an_object_between_light_and_viewer_is_guarded),
        TEST(normals_that_may_cancel_are_guarded),
        TEST(a_vertex_may_be_at_the_eye_but_no_fragment_is),
        TEST(the_full_set_has_every_guard),
    };
    return cmocka_run_group_tests_name("effects", tests, open_meshes, close_meshes);
}
