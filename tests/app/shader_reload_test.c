/*
 * shader_reload: while shaders are edited, the renderer has the shaders on disk if they are valid,
 * otherwise the last valid ones, pixel for pixel.
 */
#include "app/shader_reload.h"
#include "images/picture_queue.h"
#include "base/clock.h"
#include "base/sanitized.h"
#include "scene/scene_example.h"
#include "scene/shape.h"
#include "support/picture_check.h"
#include "support/testing.h"

enum { SIZE = 48 };

static const double PATIENCE = 300; /* seconds to wait for a change */

extern const Example LightedCube;

/* A scene that needs another program after the first second. */

static Shape sphere;
static Light light;
static Object object;

static bool init(const ShaderLoader *loader, Message *message)
{
    (void)loader;
    return shape_open(&sphere, SHAPE_SPHERE, SHAPE_LECTURE, NULL, message);
}

static void scene(double seconds, int view, Scene *made)
{
    (void)view;
    const double towards = seconds < 1 ? 1 : -1; /* towards the light, or towards the sphere */
    light = (Light){.kind = seconds < 1 ? LIGHT_DIRECTIONAL : LIGHT_SPOT,
                    .position = {3, 3, 3},
                    .direction = {towards, towards, towards},
                    .cutoff = 20,
                    .diffuse = {1, 1, 1}};
    object = shape_object(&sphere, mat4_identity(), *material_find("silver"));
    *made =
        (Scene){.camera = {.eye = {3, 3, 3}, .up = {0, 1, 0}, .fovy = 60, .near = 1, .far = 100},
                .lights = &light,
                .light_count = 1,
                .objects = &object,
                .object_count = 1,
                .interpolation = INTERPOLATION_PHONG};
}

static void finish(void)
{
    shape_close(&sphere);
}

static const Example later = {
    .name = "later",
    .init = init,
    .finish = finish,
    .kind = &SCENE_KIND,
    .content = &(const SceneExample){.make = scene, .annotate = example_annotate}};

/* Each test has a folder with a copy of the shaders, "mine", and a canvas. */

static Canvas canvas;
static DrawRequest request;
static ShaderReload reload;
static Message error;
static Picture picture, before;

static int enter_folder(void **state)
{
    unsetenv("LIGHTING_SHADERS");
    if (testing_enter_folder(state) != 0)
        return -1;
    setenv("SHADERS_SOURCE", testing_source("shaders"), 1);
    testing_shell("cp -r \"$SHADERS_SOURCE\" mine");
    request = (DrawRequest){.fps = 30, .shaders.folder = "mine"};
    error = (Message){0};
    return canvas_open(&canvas, &(CanvasOptions){.width = SIZE, .height = SIZE}, NULL) ? 0 : -1;
}

static int leave_folder(void **state)
{
    shader_reload_close(&reload);
    canvas_close(&canvas);
    image_close(&picture.image);
    image_close(&before.image);
    return testing_leave_folder(state);
}

#define RELOAD_TEST(name) TEST_WITH(0, name, enter_folder, leave_folder)

/* Something is drawn: the middle differs from the corner. */
static bool shown(const Picture *drawn)
{
    const unsigned char *pixels = drawn->image.pixels;
    return memcmp(pixels, pixels + (size_t)4 * (SIZE / 2) * (SIZE + 1), 3) != 0;
}

static void draw_into(Picture *into)
{
    into->image.type = IMAGE_BYTE;
    if (!renderer_picture(&reload.renderer, &request, request.seconds, &into->image, &error))
        fail_msg("not drawn: %s", error.text);
    assert_true(shown(into));
}

static bool same(void)
{
    return memcmp(picture.image.pixels, before.image.pixels, (size_t)4 * SIZE * SIZE) == 0;
}

/* The result of the next change. */
static ReloadResult next(void)
{
    const double end = clock_now() + PATIENCE;
    ReloadResult result;
    error = (Message){0};
    while ((result = shader_reload_poll(&reload, PATIENCE, &error)) == RELOAD_UNCHANGED &&
           clock_now() < end)
        continue;
    if (result == RELOAD_UNCHANGED)
        fail_msg("no change is reported");
    return result;
}

static void loads(void)
{
    if (next() != RELOAD_LOADED)
        fail_msg("not loaded: %s", error.text);
}

/* Rejected with a message that begins with `said`; the stage draws as before. */
static void breaks(const char *command, const char *said)
{
    draw_into(&before);
    testing_shell(command);
    if (next() != RELOAD_BROKEN)
        fail_msg("accepted: %s", command);
    if (strncmp(error.text, said, strlen(said)) != 0)
        fail_msg("expected \"%s...\" in \"%s\"", said, error.text);
    assert_non_null(reload.renderer.example);
    error = (Message){0};
    draw_into(&picture);
    assert_true(same());
    /* Nothing more happens. */
    assert_int_equal(shader_reload_poll(&reload, 0.12, &error), RELOAD_UNCHANGED);
}

#define EDIT(file, from, to) "sed -i 's/" from "/" to "/' mine/" file

RELOAD_TEST(errors_after_compiling_are_rejected)
{
    shader_reload_open(&reload, &LightedCube, &canvas, &request);
    loads();
    breaks(EDIT("lecture/LightedCube.frag", "varying vec4 v_Color",
                "varying vec3 v_Color") "; " EDIT("lecture/LightedCube.frag", "= v_Color",
                                                  "= vec4(v_Color, 1.0)"),
           "mine/lecture/LightedCube.frag:5: linking: ");
    testing_shell("cp \"$SHADERS_SOURCE\"/lecture/LightedCube.frag mine/lecture");
    loads();
    breaks("rm -r mine", "mine: no such shader folder");
    testing_shell("mkdir mine");
    loads();
    draw_into(&picture);
    assert_true(same());
}

/* The program of a later time is compiled from the cached files, too. */
RELOAD_TEST(a_later_program_uses_the_same_files)
{
    shader_reload_open(&reload, &later, &canvas, &request);
    loads();
    request.seconds = 2;
    draw_into(&before);
    request.seconds = 0;
    testing_shell("echo >> mine/lighting.vert");
    loads();
    testing_shell("echo broken >> mine/lighting/output.glsl");
    request.seconds = 2;
    draw_into(&picture);
    assert_true(same());
    assert_int_equal(next(), RELOAD_BROKEN);
    draw_into(&picture);
    assert_true(same());
}

RELOAD_TEST(an_error_in_a_later_program_restores_the_earlier_shaders)
{
    static const char *const BREAK = "cp mine/lighting/common.glsl mine/keep; printf "
                                     "'#ifdef FRAGMENT_POSITION\\nbroken\\n#endif\\n' >> "
                                     "mine/lighting/common.glsl";
    shader_reload_open(&reload, &later, &canvas, &request);
    loads();
    request.seconds = 2;
    draw_into(&before);
    request.seconds = 0;
    testing_shell(BREAK);
    loads();
    request.seconds = 2;
    assert_false(renderer_draw(&reload.renderer, &request, 2, &error));
    assert_non_null(strstr(error.text, "mine/lighting/common.glsl:"));
    assert_true(shader_reload_revert(&reload, &error));
    assert_false(shader_reload_revert(&reload, &error)); /* nothing is earlier */
    error = (Message){0};
    draw_into(&picture);
    assert_true(same());
    assert_int_equal(shader_reload_poll(&reload, 0.2, &error), RELOAD_UNCHANGED);
    testing_shell("mv mine/keep mine/lighting/common.glsl");
    loads();
    draw_into(&picture);
    assert_true(same());
    /* An invalid time is not a shader's error. */
    assert_false(shader_reload_revert(&reload, &(Message){.text = "no matrix"}));
}

/* Every other load is rejected. The leak checker finds other leaks. */
RELOAD_TEST(two_hundred_loads_leak_nothing)
{
    static const Example *const examples[] = {&LightedCube, &later};
    static const char *const paths[] = {"mine/lecture/LightedCube.frag",
                                        "mine/lighting/output.glsl"};
    for (int e = 0; e < 2; e++) {
        int files = 0;
        long kilobytes = 0;
        shader_reload_open(&reload, examples[e], &canvas, &request);
        loads();
        for (int i = 0; i < 200; i++) {
            FILE *file = fopen(paths[e], "a");
            assert_non_null(file);
            fprintf(file, i % 2 ? "*/\n" : "\n/*\n"); /* an open comment, then its end */
            fclose(file);
            assert_int_equal(next(), i % 2 ? RELOAD_LOADED : RELOAD_BROKEN);
            draw_into(&picture);
            if (i == 49) {
                files = testing_open_files();
                kilobytes = testing_resident_kib();
            }
        }
        /* The driver's cache opens some temporarily. */
        assert_true(testing_open_files() <= files + 3);
        const long grown = testing_resident_kib() - kilobytes;
        printf("%s: %ld kB more after 150 loads\n", examples[e]->name, grown);
        /* One leaked program costs the driver more than 100 kB; 0.1 MB was measured for all loads.
         */
        if (!ADDRESS_SANITIZER) /* it keeps freed memory */
            assert_true(grown < 4096);
        shader_reload_close(&reload);
    }
}

int main(void)
{
    return picture_check_run("shader_reload", NULL, NULL);
}
