/*
 * Settings: their text and back, their effect on scenes, shaders and canvases; meshes of solids;
 * classes of scenes and the table of efficient settings. No GL.
 */
#include "core/mesh_make.h"
#include "scene/quality.h"
#include "support/testing.h"

TEST(usual_settings_are_what_the_axes_say)
{
    const Quality usual = quality_usual();
    char text[QUALITY_TEXT_SIZE];
    for (int axis = 0; axis < AXIS_COUNT; axis++) {
        const QualityAxisInfo *info = &QUALITY_AXES[axis];
        int count = 0;
        while (info->choices[count])
            count++;
        assert_int_equal(count, info->count);
        assert_in_range(info->usual, 0, info->count - 1);
        assert_int_equal(usual.choice[axis], info->usual);
        assert_non_null(info->help);
    }
    quality_text(&usual, text);
    assert_string_equal(text, "usual");
    assert_int_equal(quality_divisions(&usual), 64);
    assert_int_equal(quality_samples(&usual), 0);
    assert_int_equal(quality_supersample(&usual), 1);
}

/* Each choice alone, and all the last ones together, which make the longest text. */
TEST(texts_come_back_as_the_same_setting)
{
    char text[QUALITY_TEXT_SIZE];
    Quality last = quality_usual(), read;
    for (int axis = 0; axis < AXIS_COUNT; axis++) {
        for (int choice = 0; choice < QUALITY_AXES[axis].count; choice++) {
            const Quality setting = quality_with(quality_usual(), (QualityAxis)axis, choice);
            quality_text(&setting, text);
            assert_true(quality_parse(&read, text, NULL));
            assert_true(quality_equal(&setting, &read));
        }
        last = quality_with(last, (QualityAxis)axis, QUALITY_AXES[axis].count - 1);
    }
    quality_text(&last, text);
    assert_in_range(strlen(text), 200, QUALITY_TEXT_SIZE - 1);
    assert_true(quality_parse(&read, text, NULL));
    assert_true(quality_equal(&last, &read));
}

TEST(invalid_settings_are_refused_by_name)
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
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Quality setting;
        FAILS_WITH(quality_parse(&setting, cases[i].text, message), cases[i].said);
    }
    char endless[2000];
    memset(endless, 'x', sizeof endless - 1);
    endless[sizeof endless - 1] = '\0';
    Quality setting;
    FAILS_WITH(quality_parse(&setting, endless, message), "too long");
}

/* A sphere twice and a box, a point light with attenuation and a directional light. */
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

TEST(scenes_get_the_meshes_of_a_setting)
{
    SceneCopy made;
    SolidMeshes meshes = {NULL};
    Quality setting;
    assert_true(quality_parse(&setting, "interpolation=gouraud divisions=12", NULL));
    assert_true(quality_scene_open(&made, &SCENE, &setting, &meshes, NULL));
    assert_int_equal(made.scene.interpolation, INTERPOLATION_GOURAUD);
    assert_false(made.scene.distant_viewer);
    assert_ptr_equal(made.scene.objects[0].mesh, made.scene.objects[1].mesh);
    assert_ptr_not_equal(made.scene.objects[0].mesh, made.scene.objects[2].mesh);
    assert_int_equal(made.scene.objects[0].mesh->vertex_count, 13 * 13);
    assert_int_equal(made.scene.objects[2].mesh->vertex_count, 6 * 13 * 13);
    assert_true(made.scene.lights[0].position.z == 4 && made.scene.lights[0].quadratic == 0.04);
    scene_copy_close(&made);
    solid_meshes_close(&meshes);
    assert_null(meshes.first);
}

/* At (0, 3, 4), 5 away from the center, 1 / (1 + 0.04 * 25) = 1/2 of the light arrives. */
TEST(lights_at_infinity_keep_direction_and_strength)
{
    CLOSED(scene_copy_close) SceneCopy made;
    SolidMeshes meshes = {NULL};
    const Quality setting = quality_with(
        quality_with(quality_usual(), AXIS_LIGHTS, LIGHTS_INFINITE), AXIS_VIEWER, VIEWER_INFINITE);
    assert_true(quality_scene_open(&made, &SCENE, &setting, &meshes, NULL));
    const Light *light = &made.scene.lights[0];
    assert_int_equal(light->kind, LIGHT_DIRECTIONAL);
    assert_true(light->direction.y == 3 && light->direction.z == 4);
    assert_true(light->diffuse.x == 0.5 && light->diffuse.z == 0.125);
    assert_false(light_fades(light));
    assert_true(made.scene.lights[1].direction.x == 1 && made.scene.lights[1].diffuse.y == 1);
    assert_true(made.scene.distant_viewer);
    solid_meshes_close(&meshes);
}

TEST(a_part_has_its_own_lights)
{
    QualityParts made;
    SolidMeshes meshes = {NULL};
    Object object = OBJECTS[0];
    object.world_from_object = mat4_translate((Vec3){1, 2, -3});
    Scene scene = SCENE;
    scene.objects = &object;
    scene.object_count = 1;
    ObjectQuality quality = object_quality_plain(&scene);
    quality.divisions = 12;
    quality.far_lights = quality.matte_lights = 1;
    quality.dark_lights = 2;
    assert_true(quality_parts_open(&made, &scene, &quality, &meshes, NULL));
    const Light *lights = made.parts[0].lights;
    const Vec3 way = lights[0].direction; /* as seen from the object's origin */
    assert_true(lights[0].kind == LIGHT_DIRECTIONAL && way.x == -1 && way.y == 1 && way.z == 7);
    assert_true(!lights[0].off && lights[1].off);
    assert_int_equal(made.parts[0].objects->mesh->vertex_count, 13 * 13);
    quality_parts_close(&made);
    solid_meshes_close(&meshes);
}

/* Seen from +x, the viewer's right is -z. */
TEST(lights_of_the_viewer_at_infinity_shine_from_the_same_side)
{
    CLOSED(scene_copy_close) SceneCopy made;
    SolidMeshes meshes = {NULL};
    const Quality setting = quality_with(quality_usual(), AXIS_LIGHTS, LIGHTS_INFINITE);
    const Light light = {.kind = LIGHT_POINT,
                         .space = LIGHT_EYE,
                         .position = {2, 0, -4},
                         .diffuse = {1, 1, 1},
                         .linear = 0.5};
    const Scene scene = {.camera = {{4, 0, 0}, {0, 0, 0}, {0, 1, 0}, 45, 1, 9, 0},
                         .lights = &light,
                         .light_count = 1};
    assert_true(quality_scene_open(&made, &scene, &setting, &meshes, NULL));
    const Light far = scene_world_light(&made.scene, 0);
    assert_int_equal(far.kind, LIGHT_DIRECTIONAL);
    assert_true(fabs(far.direction.x) < 1e-15 && fabs(far.direction.z + 2) < 1e-15);
    assert_true(fabs(far.diffuse.x - 1) < 1e-15); /* two away */
}

TEST(a_mesh_with_colors_is_kept)
{
    CLOSED(mesh_close) Mesh mesh;
    SceneCopy made;
    CLOSED(solid_meshes_close) SolidMeshes meshes = {NULL};
    const Quality setting = quality_usual();
    const Object object = {.mesh = &mesh, .solid = {.kind = SOLID_SPHERE, .radius = 1}};
    const Scene scene = {.objects = &object, .object_count = 1};
    SUCCEEDS(mesh_sphere(&mesh, 1, 8, 4, message));
    for (int colored = 0; colored < 2; colored++) {
        if (colored)
            SUCCEEDS(mesh_open_colors(&mesh, message));
        assert_true(quality_scene_open(&made, &scene, &setting, &meshes, NULL));
        assert_true((made.scene.objects[0].mesh == &mesh) == colored);
        scene_copy_close(&made);
    }
}

TEST(loaders_and_canvases_follow_the_setting)
{
    const ShaderLoader base = {.folder = "mine"};
    QualityLoader made;
    Quality setting = quality_usual();
    quality_loader(&made, &base, &setting);
    assert_string_equal(made.loader.precision, "highp");
    assert_null(made.loader.replacements);
    assert_string_equal(made.loader.folder, "mine");
    assert_true(quality_parse(&setting,
                              "precision=mediump guards=off highlight=cross samples=4 "
                              "supersample=3 output=dithered",
                              NULL));
    quality_loader(&made, &base, &setting);
    assert_string_equal(made.loader.precision, "mediump");
    assert_string_equal(made.loader.replacements[0].by, "study/unguarded.glsl");
    assert_string_equal(made.loader.replacements[1].by, "study/highlight_cross.glsl");
    assert_string_equal(made.loader.replacements[2].by, "study/dithered.glsl");
    assert_null(made.loader.replacements[3].name);
    const CanvasOptions canvas = quality_canvas(&setting, 20, 10);
    assert_int_equal(canvas.samples, 4);
    assert_int_equal(canvas.supersample, 3);
    assert_false(canvas.real);
    setting = quality_with(setting, AXIS_OUTPUT, OUTPUT_FLOAT);
    assert_true(quality_canvas(&setting, 20, 10).real);
}

/* Solids. */

TEST(solids_are_meshed_as_finely_as_asked)
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
        {{.kind = SOLID_TEAPOT, .radius = 1}, 0}, /* a coarse mesh of it is not a tube */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        CLOSED(mesh_close) Mesh mesh;
        assert_true(solid_mesh(&cases[i].solid, 8, &mesh, NULL));
        if (cases[i].triangles)
            assert_int_equal(mesh.index_count / 3, cases[i].triangles);
        for (size_t k = 0; k < mesh.index_count && cases[i].triangles; k += 3) {
            Vec3 normal;
            const float *given = mesh.vertices[mesh.indices[k]].normal;
            assert_true(mesh_face(&mesh, k / 3, &normal));
            /* Outwards, on the side of the vertex's own normal, with the tolerance of a coarse
             * mesh. */
            assert_true(
                vec3_dot(normal, (Vec3){(double)given[0], (double)given[1], (double)given[2]}) > 0);
        }
    }
}

TEST(solids_out_of_range_are_refused)
{
    const Solid none = {.kind = SOLID_NONE}, sphere = {.kind = SOLID_SPHERE, .radius = 1};
    Mesh mesh;
    FAILS_WITH(solid_mesh(&none, 8, &mesh, message), "formula");
    FAILS_WITH(solid_mesh(&sphere, 2, &mesh, message), "2 divisions");
    FAILS_WITH(solid_mesh(&sphere, 100000, &mesh, message), "");
    assert_null(mesh.vertices);
}

TEST_MAIN("quality", NULL, NULL)
