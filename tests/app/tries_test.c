/*
 * What each --help suggests, and each shape of each scene: it is drawn, and every object lies
 * within the picture, however wide or narrow that is.
 */
#include "app/options.h"
#include "app/renderer.h"
#include "kinds/scene_views.h"
#include "scene/scene_example.h"
#include "scene/shape.h"
#include "support/examples.h"
#include "support/picture_check.h"
#include "support/read_line.h"
#include "support/testing.h"

enum { SIZE = 96, MOST_PARAMETERS = 64 };

static Canvas canvas;

FIXTURE(open_canvas)
{
    SUCCEEDS(canvas_open(&canvas, &(CanvasOptions){.width = SIZE, .height = SIZE}, message));
}

FIXTURE(close_canvas)
{
    canvas_close(&canvas);
}

/* The textbook's teapot, turned, has the tip of its spout 0.6% beyond the original's camera. */
static const double WHOLE = 1.01;

static void check_whole(const Scene *scene, double aspect, const char *what)
{
    Mat4 eye_from_world, clip_from_eye;
    SUCCEEDS(scene_camera(&scene->camera, aspect, &eye_from_world, &clip_from_eye, message));
    const Mat4 clip_from_world = mat4_product(clip_from_eye, eye_from_world);
    for (int i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        const Mat4 clip_from_object = mat4_product(clip_from_world, object->world_from_object);
        for (size_t k = 0; k < object->mesh->index_count; k++) { /* some vertices are not used */
            const uint32_t vertex = object->mesh->indices[k];
            const Vec3 p = vec3_from_float(object->mesh->vertices[vertex].position);
            const Vec4 clip = mat4_transform(clip_from_object, (Vec4){p.x, p.y, p.z, 1});
            if (!(fabs(clip.x) <= WHOLE * clip.w && fabs(clip.y) <= WHOLE * clip.w &&
                  fabs(clip.z) <= clip.w))
                fail_msg("%s, aspect %g: object %d is cut at (%g, %g, %g)", what, aspect, i,
                         clip.x / clip.w, clip.y / clip.w, clip.z / clip.w);
        }
    }
}

/* In pictures of any shape, at moments of a turn. */
static void check_scene(Renderer *renderer, const DrawRequest *request, const char *what)
{
    for (double seconds = request->seconds; seconds < request->seconds + 12; seconds += 3.1)
        for (int view = 0; view < scene_view_count(renderer); view++) {
            SceneView opened;
            SUCCEEDS(scene_view_open(&opened, renderer, request, seconds, view, message));
            for (double aspect = 0.25; aspect <= 4; aspect *= 16)
                check_whole(&opened.scene, aspect, what);
            scene_view_close(&opened);
        }
}

/* The picture must not be empty. */
static void check_line(const Example *example, const char *line, bool drawn)
{
    Renderer renderer;
    ParameterValue before[MOST_PARAMETERS];
    const Parameter *own = example->parameters;
    int count = 0;
    for (; own && own[count].name; count++)
        before[count] = parameter_save(&own[count]);
    Options options;
    const Usage usage = options_usage(example);
    if (read_line(&options, &usage, line, FAILURE) != OPTIONS_RUN)
        fail_msg("%s %s: %s", example->name, line, FAILURE->text);
    const DrawRequest request = options_request(&options, example);
    const char *what = formatted("%s %s", example->name, line);
    SUCCEEDS(renderer_open(&renderer, example, &canvas, &request, message));
    if (example_scene(example))
        check_scene(&renderer, &request, what);
    if (drawn) {
        CLOSED(image_close) Image image;
        int colors = 0;
        SUCCEEDS(image_open(&image, SIZE, SIZE, IMAGE_BYTE, message));
        SUCCEEDS(renderer_draw(&renderer, &request, options.seconds, message) &&
                 canvas_read(&canvas, &image, message));
        for (size_t i = 4; i < 4 * SIZE * SIZE; i += 4)
            colors += memcmp((char *)image.pixels + i, image.pixels, 3) != 0;
        if (colors < 8)
            fail_msg("%s: an empty picture", what);
    }
    renderer_close(&renderer);
    for (int i = 0; i < count; i++)
        parameter_restore(&own[i], before[i]);
}

static void check_tries(const Example *const *examples, int count)
{
    for (int e = 0; e < count; e++)
        for (int i = 0; i < 3 && examples[e]->tries[i]; i++) {
            check_line(examples[e], examples[e]->tries[i], true);
            assert_in_range(strlen(examples[e]->looks[i]), 10, 78);
        }
}

TEST(what_help_suggests_is_a_whole_picture)
{
    check_tries(EXAMPLES, EXAMPLE_COUNT);
    check_tries(LECTURES, (int)(sizeof LECTURES / sizeof LECTURES[0]));
}

/* The value of each choice of the option "shape". */
TEST(every_shape_is_whole)
{
    for (int e = 0; e < EXAMPLE_COUNT; e++) {
        const Parameter *own = EXAMPLES[e]->parameters;
        check_line(EXAMPLES[e], "", false);
        while (own->name && strcmp(own->name, "shape") != 0)
            own++;
        for (int i = 0; own->name && own->choices[i]; i++) {
            check_line(EXAMPLES[e],
                       formatted("--shape %s%s", own->choices[i],
                                 EXAMPLES[e]->name[0] == 'T' && own->choices == SHAPE_NAMES
                                     ? " --costs off"
                                     : ""),
                       false);
        }
    }
}

PICTURE_TEST_MAIN("tries", open_canvas, close_canvas)
