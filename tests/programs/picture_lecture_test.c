/*
 * The pictures of the lecture's nine programs: every pixel that no edge runs through against what a
 * ray of the exact picture sees through its centre, in double precision. The scenes are written
 * down here as data, from the lecture. Errors are in steps, 0 to 255.
 */
#include "app/options.h"
#include "app/renderer.h"
#include "reference/picture_error.h"
#include "support/oracle.h"
#include "support/picture_check.h"
#include "support/testing.h"

#define X(NAME) extern const Example NAME;
LECTURE_EXAMPLES
#undef X

typedef struct Lesson {
    const Example *example;
    double half_side; /* of the cube; 0: the sphere */
    Vec3 color, eye;
    LightKind kind;
    Vec3 light; /* its place, or the direction towards it */
    double light_color, ambient;
    double turn, turn_per_second; /* degrees; about y, or z where `about_z` */
    bool about_z;
    Vec3 offset; /* after the turn */
    Interpolation interpolation;
} Lesson;

#define SMALL_CUBE                                                                                 \
    .half_side = 1, .color = {1, 0, 0}, .eye = {3, 3, 7}, .light = {0.5, 3, 4}, .light_color = 1,  \
    .interpolation = INTERPOLATION_GOURAUD
#define LARGE_CUBE                                                                                 \
    .half_side = 2, .color = {1, 0, 0}, .eye = {6, 6, 14}, .kind = LIGHT_POINT,                    \
    .light = {2.3, 4, 3.5}, .light_color = 1, .ambient = 0.2
#define SPHERE                                                                                     \
    .color = {1, 1, 1}, .eye = {0, 0, 6}, .kind = LIGHT_POINT, .light = {5, 8, 7},                 \
    .light_color = 0.8, .ambient = 0.2

static const Lesson LESSONS[] = {
    {.example = &LightedCube, SMALL_CUBE},
    {.example = &LightedCube_animation, SMALL_CUBE, .turn_per_second = 30},
    {.example = &LightedCube_ambient, SMALL_CUBE, .ambient = 0.2},
    {.example = &LightedTranslatedRotatedCube,
     .half_side = 1,
     .color = {1, 0, 0},
     .eye = {3, 3, 7},
     .light = {0, 3, 4},
     .light_color = 1,
     .interpolation = INTERPOLATION_GOURAUD,
     .ambient = 0.2,
     .turn = 90,
     .about_z = true,
     .offset = {0, 0.9, 0}},
    {.example = &PointLightedCube, LARGE_CUBE, .turn = 90, .interpolation = INTERPOLATION_GOURAUD},
    {.example = &PointLightedCube_animation,
     LARGE_CUBE,
     .turn_per_second = 30,
     .interpolation = INTERPOLATION_GOURAUD},
    {.example = &PointLightedCube_perFragment, LARGE_CUBE, .turn_per_second = 30},
    {.example = &PointLightedSphere, SPHERE, .interpolation = INTERPOLATION_GOURAUD},
    {.example = &PointLightedSphere_perFragment, SPHERE, .turn = 90},
};

/* The lecture's size; odd numbers; portrait; so narrow that every object exceeds both sides. */
static const int SIZES[][2] = {{400, 400}, {257, 193}, {64, 128}, {31, 400}};
enum { SIZE_COUNT = sizeof SIZES / sizeof SIZES[0], TIME_COUNT = 4 };

/* The start, two times of the first turn, one of the second. */
static const double TIMES[TIME_COUNT] = {0, 0.4, 1.7, 13.3};

/* A lesson at one moment, as a scene; it points into itself. */
typedef struct LessonScene {
    Mesh mesh;
    Light light;
    Object object;
    Scene scene;
} LessonScene;

static void lesson_open(const Lesson *lesson, double seconds, LessonScene *made)
{
    const Vec3 grey = {lesson->light_color, lesson->light_color, lesson->light_color};
    const double degrees = lesson->turn + lesson->turn_per_second * seconds;
    const Mat4 turned = mat4_rotate(degrees, lesson->about_z ? (Vec3){0, 0, 1} : (Vec3){0, 1, 0});
    SUCCEEDS(lesson->half_side > 0 ? mesh_cube(&made->mesh, lesson->half_side, message)
                                   : mesh_sphere(&made->mesh, 1, 13, 13, message));
    made->light = (Light){.kind = lesson->kind,
                          .position = lesson->light,
                          .direction = lesson->light,
                          .diffuse = grey};
    made->object =
        (Object){.mesh = &made->mesh,
                 .flat = lesson->half_side > 0,
                 .closed = true,
                 .world_from_object = mat4_product(mat4_translate(lesson->offset), turned),
                 .front = {.ambient = lesson->color, .diffuse = lesson->color, .alpha = 1}};
    made->scene =
        (Scene){.camera = {.eye = lesson->eye, .up = {0, 1, 0}, .fovy = 30, .near = 1, .far = 100},
                .global_ambient = {lesson->ambient, lesson->ambient, lesson->ambient},
                .lights = &made->light,
                .light_count = 1,
                .objects = &made->object,
                .object_count = 1,
                .interpolation = lesson->interpolation};
}

/* What rounding to 11 bits in the fragment shader changes, in steps. Lit at the vertices, it copies
 * a shade that is rounded when written there and when read. The light is at most 5.8 from a cube's
 * middle, 3.5 from which its corners are, and at least 2.5 from the cube; the sphere's is far. */
static double shader_rounding(const Scene *scene)
{
    const double reach = (5.8 + 3.5 + 2.5) / 2.5;
    return scene->interpolation == INTERPOLATION_GOURAUD ? 255 * 2 * ORACLE_MEDIUMP_UNIT
                                                         : oracle_mediump_max(scene, reach) - 0.5;
}

static void check_picture(const char *name, const Image *picture, const Scene *scene,
                          const Reference *exact, bool half, ErrorSum *sum)
{
    const double most = half ? fmax(0.5 + shader_rounding(scene), 1) : 1;
    PictureError error = {.all = {0}};
    picture_error_add(&error, picture, &(ExactView){.exact = exact, .scene = scene});
    const ErrorSum *inside = &error.interior;
    /* What is drawn of an object is where it is, and nothing else. */
    double drawn = 0, area = 0;
    for (int i = 0; i < exact->width * exact->height; i++) {
        const double part = (double)exact->coverage[i],
                     covered = exact->object[i] < 0 ? 1 - part : part;
        const unsigned char alpha = ((const unsigned char *)picture->pixels)[4 * i + 3];
        if (alpha ? covered == 0 : covered == 1)
            fail_msg("%s: column %d, row %d: alpha %d", name, i % exact->width, i / exact->width,
                     alpha);
        drawn += alpha / 255.0;
        area += covered;
    }
    if (fabs(drawn - area) > 0.005 * area)
        fail_msg("%s: %.0f pixels are covered, not %.0f", name, drawn, area);
    assert_true(inside->pixels > exact->width * exact->height / 20);
    if (inside->maximum > most) {
        picture_check_keep_exact(name, picture, exact);
        fail_msg("%s: off by %.2f of %.2f at column %zu, row %zu", name, inside->maximum, most,
                 inside->worst % (size_t)exact->width, inside->worst / (size_t)exact->width);
    }
    sum->pixels += inside->pixels;
    sum->squares += inside->squares;
    sum->maximum = fmax(sum->maximum, inside->maximum);
}

/* In both precisions. A still lesson only at the first and the last time. */
static void check_lesson(const Lesson *lesson, const int size[2], ErrorSum sums[2])
{
    const int step = lesson->turn_per_second > 0 ? 1 : TIME_COUNT - 1;
    for (int half = 0; half < 2; half++) {
        const Options options = {.width = size[0],
                                 .height = size[1],
                                 .frames = 1,
                                 .alpha = true,
                                 .shaders = {.precision = half ? NULL : "highp"}};
        const DrawRequest request = options_request(&options, lesson->example);
        CLOSED(canvas_close) Canvas canvas;
        CLOSED(renderer_close) Renderer renderer;
        CLOSED(image_close) Image picture;
        SUCCEEDS(options_open_canvas(&canvas, &options, "picture.png", message));
        SUCCEEDS(renderer_open(&renderer, lesson->example, &canvas, &request, message));
        SUCCEEDS(image_open(&picture, size[0], size[1], IMAGE_BYTE, message));
        for (int t = 0; t < TIME_COUNT; t += step) {
            const ReferenceOptions as = {
                .width = size[0], .height = size[1], .meshes = true, .centers = true};
            CLOSED(reference_close) Reference exact;
            LessonScene made;
            lesson_open(lesson, TIMES[t], &made);
            SUCCEEDS(reference_open(&exact, &made.scene, &as, message));
            SUCCEEDS(renderer_picture(&renderer, &request, TIMES[t], &picture, message));
            check_picture(formatted("%s-%dx%d-%gs-%s", lesson->example->name, size[0], size[1],
                                    TIMES[t], half ? "default" : "highp"),
                          &picture, &made.scene, &exact, half, &sums[half]);
            mesh_close(&made.mesh);
        }
    }
}

/* With highp within a step, by default within the bound of 11 bits. */
TEST(every_pixel_has_its_colour)
{
    printf("%-40s   worst    rms     pixels\n", "steps of 1/255");
    for (size_t i = 0; i < sizeof LESSONS / sizeof LESSONS[0]; i++) {
        ErrorSum sums[2] = {{.pixels = 0}};
        for (int s = (int)i % testing_step(2); s < SIZE_COUNT; s += testing_step(2))
            check_lesson(&LESSONS[i], SIZES[s], sums);
        for (int half = 0; half < 2; half++)
            printf("%-31s %-8s %7.3f %7.3f %9lld\n", LESSONS[i].example->name,
                   half ? "default" : "highp", sums[half].maximum, error_sum_rms(&sums[half]),
                   sums[half].pixels);
    }
}

PICTURE_TEST_MAIN("picture lecture", NULL, NULL)
