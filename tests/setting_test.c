/*
 * Settings: their text and back, what they make of a scene, of shaders and of a canvas; meshes of
 * solids; the classes of scenes and the table of efficient settings. No GL.
 */
#include "efficient.h"
#include "setting.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#define assert_says(message, part)                                                                 \
    do {                                                                                           \
        if (!strstr((message).text, part))                                                         \
            fail_msg("\"%s\" does not say \"%s\"", (message).text, part);                          \
    } while (0)

static void usual_settings_are_what_the_axes_say(void **state)
{
    (void)state;
    const Setting usual = setting_usual();
    char text[SETTING_TEXT_SIZE];
    for (int axis = 0; axis < AXIS_COUNT; axis++) {
        const SettingAxisInfo *info = &SETTING_AXES[axis];
        int count = 0;
        while (info->choices[count])
            count++;
        assert_int_equal(count, info->count);
        assert_in_range(info->usual, 0, info->count - 1);
        assert_int_equal(usual.choice[axis], info->usual);
        assert_non_null(info->help);
    }
    setting_text(&usual, text);
    assert_string_equal(text, "usual");
    assert_int_equal(setting_divisions(&usual), 64);
    assert_int_equal(setting_samples(&usual), 0);
    assert_int_equal(setting_supersample(&usual), 1);
}

/* Each choice alone, and all the last ones together, which make the longest text. */
static void texts_come_back_as_the_same_setting(void **state)
{
    (void)state;
    char text[SETTING_TEXT_SIZE];
    Setting last = setting_usual(), read;
    for (int axis = 0; axis < AXIS_COUNT; axis++) {
        for (int choice = 0; choice < SETTING_AXES[axis].count; choice++) {
            const Setting setting = setting_with(setting_usual(), (SettingAxis)axis, choice);
            setting_text(&setting, text);
            assert_true(setting_parse(&read, text, NULL));
            assert_true(setting_equal(&setting, &read));
        }
        last = setting_with(last, (SettingAxis)axis, SETTING_AXES[axis].count - 1);
    }
    setting_text(&last, text);
    assert_in_range(strlen(text), 200, SETTING_TEXT_SIZE - 1);
    assert_true(setting_parse(&read, text, NULL));
    assert_true(setting_equal(&last, &read));
}

static void what_is_no_setting_is_refused_by_name(void **state)
{
    static const struct {
        const char *text, *said;
    } cases[] = {
        {"interpolation=smooth", "interpolation=smooth: must be one of phong, gouraud, flat"},
        {"interpolatoin=flat", "interpolatoin: no such choice; there are interpolation, div"},
        {"divisions=7", "divisions=7: must be one of 6, 8, 12"},
        {"flat", "flat: must be AXIS=CHOICE"},
        {"usual divisions=6", "usual: must be AXIS=CHOICE"},
        {"=", ": no such choice"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Setting setting;
        Message message = {0};
        assert_false(setting_parse(&setting, cases[i].text, &message));
        assert_says(message, cases[i].said);
    }
    char endless[2000];
    memset(endless, 'x', sizeof endless - 1);
    endless[sizeof endless - 1] = '\0';
    Setting setting;
    Message message = {0};
    assert_false(setting_parse(&setting, endless, &message));
    assert_says(message, "too long");
}

/* A sphere twice and a box, a point light that fades and a directional one. */
static const Light LIGHTS[] = {
    {.kind = LIGHT_POINT,
     .position = {0, 3, 4},
     .diffuse = {1, 0.5, 0.25},
     .constant = 1,
     .quadratic = 0.04},
    {.kind = LIGHT_DIRECTIONAL, .direction = {1, 0, 0}, .diffuse = {1, 1, 1}},
};
static const Object OBJECTS[] = {
    {.solid = {.kind = SOLID_SPHERE, .radius = 1}, .front = {.alpha = 1}},
    {.solid = {.kind = SOLID_SPHERE, .radius = 1}, .front = {.alpha = 1}},
    {.solid = {.kind = SOLID_BOX, .radius = 2}, .front = {.alpha = 1}},
};
static const Scene SCENE = {.lights = LIGHTS,
                            .light_count = 2,
                            .objects = OBJECTS,
                            .object_count = 3,
                            .interpolation = INTERPOLATION_FLAT};

static void scenes_get_the_meshes_of_a_setting(void **state)
{
    (void)state;
    SettingScene made;
    SolidMeshes meshes = {NULL};
    Setting setting;
    assert_true(setting_parse(&setting, "interpolation=gouraud divisions=12", NULL));
    assert_true(setting_scene_open(&made, &SCENE, &setting, &meshes, NULL));
    assert_int_equal(made.scene.interpolation, INTERPOLATION_GOURAUD);
    assert_false(made.scene.distant_viewer);
    assert_ptr_equal(made.scene.objects[0].mesh, made.scene.objects[1].mesh);
    assert_ptr_not_equal(made.scene.objects[0].mesh, made.scene.objects[2].mesh);
    assert_int_equal(made.scene.objects[0].mesh->vertex_count, 13 * 13);
    assert_int_equal(made.scene.objects[2].mesh->vertex_count, 6 * 13 * 13);
    assert_true(made.scene.lights[0].position.z == 4 && made.scene.lights[0].quadratic == 0.04);
    setting_scene_close(&made);
    solid_meshes_close(&meshes);
    assert_null(meshes.first);
}

/* At (0, 3, 4), 5 away from the centre, 1 / (1 + 0.04 * 25) = 1/2 of the light arrives. */
static void lights_at_infinity_keep_direction_and_strength(void **state)
{
    (void)state;
    SettingScene made;
    SolidMeshes meshes = {NULL};
    const Setting setting = setting_with(
        setting_with(setting_usual(), AXIS_LIGHTS, LIGHTS_INFINITE), AXIS_VIEWER, VIEWER_INFINITE);
    assert_true(setting_scene_open(&made, &SCENE, &setting, &meshes, NULL));
    const Light *light = &made.scene.lights[0];
    assert_int_equal(light->kind, LIGHT_DIRECTIONAL);
    assert_true(light->direction.y == 3 && light->direction.z == 4);
    assert_true(light->diffuse.x == 0.5 && light->diffuse.z == 0.125);
    assert_false(light_fades(light));
    assert_true(made.scene.lights[1].direction.x == 1 && made.scene.lights[1].diffuse.y == 1);
    assert_true(made.scene.distant_viewer);
    setting_scene_close(&made);
    solid_meshes_close(&meshes);
}

static void loaders_and_canvases_follow_the_setting(void **state)
{
    (void)state;
    const ShaderLoader base = {.folder = "mine"};
    SettingLoader made;
    Setting setting = setting_usual();
    setting_loader(&made, &base, &setting);
    assert_string_equal(made.loader.precision, "highp");
    assert_null(made.loader.replacements);
    assert_string_equal(made.loader.folder, "mine");
    assert_true(setting_parse(&setting,
                              "precision=mediump guards=off highlight=cross samples=4 "
                              "supersample=3 output=dithered",
                              NULL));
    setting_loader(&made, &base, &setting);
    assert_string_equal(made.loader.precision, "mediump");
    assert_string_equal(made.loader.replacements[0].by, "study/unguarded.glsl");
    assert_string_equal(made.loader.replacements[1].by, "study/highlight_cross.glsl");
    assert_string_equal(made.loader.replacements[2].by, "study/dithered.glsl");
    assert_null(made.loader.replacements[3].name);
    const CanvasOptions canvas = setting_canvas(&setting, 20, 10);
    assert_int_equal(canvas.samples, 4);
    assert_int_equal(canvas.supersample, 3);
    assert_false(canvas.real);
    setting = setting_with(setting, AXIS_OUTPUT, OUTPUT_FLOAT);
    assert_true(setting_canvas(&setting, 20, 10).real);
}

/* Solids. */

static void solids_are_meshed_as_finely_as_asked(void **state)
{
    static const struct {
        Solid solid;
        size_t triangles; /* with 8 divisions */
    } cases[] = {
        {{.kind = SOLID_SPHERE, .radius = 1}, 2 * 8 * 7},
        {{.kind = SOLID_BOX, .radius = 1}, 6 * 2 * 8 * 8},
        {{.kind = SOLID_QUAD}, 2 * 8 * 8},
        {{.kind = SOLID_DISC, .radius = 1}, 8 + 2 * 8},
        {{.kind = SOLID_CYLINDER, .radius = 1, .height = 2}, 2 * 8 * 2},
        {{.kind = SOLID_TORUS, .radius = 1, .tube = 0.25}, 2 * 8 * 4},
        {{.kind = SOLID_TEAPOT, .radius = 1}, 0}, /* whose tube is no tube when so coarse */
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Mesh mesh;
        assert_true(solid_mesh(&cases[i].solid, 8, &mesh, NULL));
        if (cases[i].triangles)
            assert_int_equal(mesh.index_count / 3, cases[i].triangles);
        for (size_t k = 0; k < mesh.index_count && cases[i].triangles; k += 3) {
            Vec3 normal;
            const float *given = mesh.vertices[mesh.indices[k]].normal;
            assert_true(mesh_face(&mesh, k / 3, &normal));
            /* Outwards, on the side of the vertex's own normal, coarse as the mesh is. */
            assert_true(
                vec3_dot(normal, (Vec3){(double)given[0], (double)given[1], (double)given[2]}) > 0);
        }
        mesh_close(&mesh);
    }
}

/* The surface of a box is that of its mesh, however fine: 6 (2 r)^2. Sums of floats: 1e-5. */
static void boxes_have_their_area(void **state)
{
    (void)state;
    for (int divisions = 3; divisions < 40; divisions += 9) {
        const Solid box = {.kind = SOLID_BOX, .radius = 1.5};
        double area = 0;
        Mesh mesh;
        assert_true(solid_mesh(&box, divisions, &mesh, NULL));
        for (size_t k = 0; k < mesh.index_count; k += 3) {
            Vec3 corner[3];
            for (size_t c = 0; c < 3; c++) {
                const float *p = mesh.vertices[mesh.indices[k + c]].position;
                corner[c] = (Vec3){(double)p[0], (double)p[1], (double)p[2]};
            }
            area += 0.5 * vec3_length(vec3_cross(vec3_subtract(corner[1], corner[0]),
                                                 vec3_subtract(corner[2], corner[0])));
        }
        assert_true(fabs(area - 54) < 1e-5 * 54);
        mesh_close(&mesh);
    }
}

static void solids_out_of_range_are_refused(void **state)
{
    (void)state;
    const Solid none = {.kind = SOLID_NONE}, sphere = {.kind = SOLID_SPHERE, .radius = 1};
    Message message = {0};
    Mesh mesh;
    assert_false(solid_mesh(&none, 8, &mesh, &message));
    assert_says(message, "formula");
    message = (Message){0};
    assert_false(solid_mesh(&sphere, 2, &mesh, &message));
    assert_says(message, "2 divisions");
    message = (Message){0};
    assert_false(solid_mesh(&sphere, 100000, &mesh, &message));
    assert_null(mesh.vertices);
}

/* Classes and the table. */

static void scenes_are_of_the_hardest_class_they_have(void **state)
{
    (void)state;
    Light light = {.kind = LIGHT_POINT, .diffuse = {1, 1, 1}, .specular = {1, 1, 1}};
    Object object = {.flat = true, .front = {.diffuse = {1, 1, 1}, .alpha = 1}};
    const Scene scene = {.lights = &light, .light_count = 1, .objects = &object, .object_count = 1};
    assert_int_equal(scene_class(&scene), SCENE_FLAT);
    object.flat = false;
    assert_int_equal(scene_class(&scene), SCENE_CURVED);
    object.front.specular = (Vec3){0.5, 0, 0};
    object.front.shininess = 8;
    assert_int_equal(scene_class(&scene), SCENE_SHINY8);
    object.front.shininess = 8.5;
    assert_int_equal(scene_class(&scene), SCENE_SHINY32);
    object.back = (Material){.specular = {1, 1, 1}, .shininess = 33};
    assert_int_equal(scene_class(&scene), SCENE_SHINY32);
    object.two_sided = true;
    assert_int_equal(scene_class(&scene), SCENE_SHINY128);
    light.kind = LIGHT_SPOT;
    assert_int_equal(scene_class(&scene), SCENE_SPOT);
    light.off = true;
    assert_int_equal(scene_class(&scene), SCENE_CURVED);
}

static const char TABLE[] = "# a comment\n"
                            "curved,interpolation=gouraud divisions=24,3.5,0.5,1\n"
                            "curved,divisions=24,1.5,0.5,2.5\n"
                            "\n"
                            "curved,usual,0.6,0.3,3\n"
                            "curved,divisions=512,0.6,0.3,30\n"
                            "flat,usual,0.5,0.3,3";

static void the_cheapest_that_is_exact_enough_is_chosen(void **state)
{
    (void)state;
    Efficient *table = calloc(1, sizeof *table);
    Message message = {0};
    assert_true(efficient_parse(table, "t.csv", TABLE, strlen(TABLE), &message));
    assert_int_equal(table->count, 5);
    assert_true(efficient_choose(table, SCENE_CURVED, 255, &message)->milliseconds == 1);
    assert_true(efficient_choose(table, SCENE_CURVED, 3.5, &message)->milliseconds == 1);
    assert_true(efficient_choose(table, SCENE_CURVED, 3.4, &message)->milliseconds == 2.5);
    assert_true(efficient_choose(table, SCENE_CURVED, 0.6, &message)->milliseconds == 3);
    assert_null(efficient_choose(table, SCENE_CURVED, 0.5, &message));
    assert_says(message, "the least is 0.60");
    message = (Message){0};
    assert_null(efficient_choose(table, SCENE_SPOT, 5, &message));
    assert_says(message, "no row for scenes of the class spot");
    free(table);
}

static void broken_tables_are_refused_by_file_and_line(void **state)
{
    static const struct {
        const char *text, *said;
    } cases[] = {
        {"curved,usual,1,1\n", "t.csv:1: must have 5 fields"},
        {"curved,usual,1,1,1,1\n", "t.csv:1: must have 5 fields"},
        {"#\nround,usual,1,1,1\n", "t.csv:2: round: no such class"},
        {"curved,divisions=5,1,1,1\n", "t.csv:1: divisions=5: must be one of"},
        {"curved,supersample=2,1,1,1\n", "t.csv:1: supersample=2: only interpolation"},
        {"curved,usual,-1,1,1\n", "t.csv:1: errors must be"},
        {"curved,usual,nan,1,1\n", "t.csv:1: errors must be"},
        {"curved,usual,1,1,1e9\n", "t.csv:1: errors must be"},
    };
    (void)state;
    Efficient *table = calloc(1, sizeof *table);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Message message = {0};
        assert_false(
            efficient_parse(table, "t.csv", cases[i].text, strlen(cases[i].text), &message));
        assert_says(message, cases[i].said);
        assert_says(message, "--calibrate");
    }
    Message message = {0};
    assert_false(efficient_parse(table, "t.csv", "a\0b", 3, &message));
    assert_says(message, "t.csv:1");
    char *endless = malloc(100000);
    memset(endless, 'x', 100000);
    assert_false(efficient_parse(table, "t.csv", endless, 100000, &message));
    free(endless);
    free(table);
}

/* The one that comes with the sources has every class, and errors of half a step for each. */
static void the_committed_table_serves_every_class(void **state)
{
    (void)state;
    char path[4096];
    Message message = {0};
    Efficient *table = calloc(1, sizeof *table);
    snprintf(path, sizeof path, "%s/../common/efficient.csv", SHADERS_SOURCE);
    setenv("LIGHTING_EFFICIENT", path, 1);
    if (!efficient_read(table, &message))
        fail_msg("%s", message.text);
    for (int class = 0; class < SCENE_CLASS_COUNT; class ++) {
        if (!efficient_choose(table, (SceneClass) class, 1, &message))
            fail_msg("%s", message.text);
        assert_non_null(efficient_choose(table, (SceneClass) class, 255, &message));
    }
    setenv("LIGHTING_EFFICIENT", "/nonexistent/table.csv", 1);
    message = (Message){0};
    assert_false(efficient_read(table, &message));
    assert_says(message, "/nonexistent/table.csv: No such file");
    setenv("LIGHTING_EFFICIENT", "/", 1);
    message = (Message){0};
    assert_false(efficient_read(table, &message));
    assert_says(message, "/: is a folder");
    unsetenv("LIGHTING_EFFICIENT");
    free(table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(usual_settings_are_what_the_axes_say),
        cmocka_unit_test(texts_come_back_as_the_same_setting),
        cmocka_unit_test(what_is_no_setting_is_refused_by_name),
        cmocka_unit_test(scenes_get_the_meshes_of_a_setting),
        cmocka_unit_test(lights_at_infinity_keep_direction_and_strength),
        cmocka_unit_test(loaders_and_canvases_follow_the_setting),
        cmocka_unit_test(solids_are_meshed_as_finely_as_asked),
        cmocka_unit_test(boxes_have_their_area),
        cmocka_unit_test(solids_out_of_range_are_refused),
        cmocka_unit_test(scenes_are_of_the_hardest_class_they_have),
        cmocka_unit_test(the_cheapest_that_is_exact_enough_is_chosen),
        cmocka_unit_test(broken_tables_are_refused_by_file_and_line),
        cmocka_unit_test(the_committed_table_serves_every_class),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
