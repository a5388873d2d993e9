/*
 * What the driver draws against common/reference: the nine lecture programs, whose scenes are
 * written down here as data, and every view of the ten programs that are scenes. The reference has
 * the meshes as given, so that what is compared is light and its interpolation.
 *
 * Inside objects, where no edge runs through the pixel, a highp picture may be one step of 1/255
 * off: rounding to 8 bits alone makes 0.5, and arithmetic in 32 bits with a shininess up to 128
 * less than the other half.
 */
#include "picture_check.h"

#include "efficient.h"
#include "lighting.h"
#include "reference_error.h"
#include "stage.h"
#include "testing.h"

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double MOST = 1; /* step of 1/255 */

#define X(NAME) extern const Example NAME;
LECTURE_EXAMPLES
LIGHTING_EXAMPLES
#undef X

#define X(NAME) &NAME,
static const Example *const EXAMPLES[] = {LIGHTING_EXAMPLES};
#undef X

enum { EXAMPLE_COUNT = sizeof EXAMPLES / sizeof EXAMPLES[0] };

/* Comparing. */

static void set_pixel(Image *image, size_t pixel, const float *color)
{
    unsigned char *to = (unsigned char *)image->pixels + 4 * pixel;
    for (size_t c = 0; c < 3; c++)
        to[c] = (unsigned char)lrintf(255 * color[c]);
    to[3] = 255;
}

/* Whether no pixel inside an object is farther than `most` steps from the exact picture, and there
 * are such pixels at all, with more than one colour. Where not, says so and keeps the pictures. */
static bool check(const char *name, const Image *image, const Reference *exact, double most)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    ReferenceError error = {.all = {0}};
    reference_error_add(&error, image, 0, 0, exact, NULL);
    const ErrorSum *inside = &error.interior;
    print_message("%-40s %6lld pixels inside, largest error %.3f\n", name, inside->pixels,
                  inside->maximum);
    if (inside->pixels > (long long)count / 100 && inside->maximum <= most)
        return true;
    printf("%s: %lld pixels inside; at column %zu, row %zu the error is %.3f\n", name,
           inside->pixels, inside->worst % (size_t)image->width,
           inside->worst / (size_t)image->width, inside->maximum);
    Image expected;
    if (!image_open(&expected, image->width, image->height, IMAGE_BYTE, NULL))
        return false;
    for (size_t i = 0; i < count; i++)
        set_pixel(&expected, i, exact->color + 3 * i);
    picture_check_keep(name, image, &expected);
    image_close(&expected);
    return false;
}

static void open_exact(Reference *exact, const Scene *scene, int width, int height, bool meshes)
{
    Message message = {0};
    const ReferenceOptions options = {.width = width, .height = height, .meshes = meshes};
    require(scene_check(scene, &message), &message);
    require(reference_open(exact, scene, &options, &message), &message);
}

/* The lecture's programs. */

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
     SMALL_CUBE,
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

enum { LESSON_COUNT = sizeof LESSONS / sizeof LESSONS[0] };

/* A lesson at one moment, as a scene; it points into itself and at the mesh. */
typedef struct LessonScene {
    Light light;
    Object object;
    Scene scene;
} LessonScene;

static void lesson_scene(const Lesson *lesson, const Mesh *mesh, double seconds, LessonScene *made)
{
    Mat4 turned;
    const Vec3 grey = {lesson->light_color, lesson->light_color, lesson->light_color};
    const double degrees = lesson->turn + lesson->turn_per_second * seconds;
    mat4_rotate(degrees, lesson->about_z ? (Vec3){0, 0, 1} : (Vec3){0, 1, 0}, &turned);
    made->light = (Light){.kind = lesson->kind,
                          .position = lesson->light,
                          .direction = lesson->light,
                          .diffuse = grey};
    made->object =
        (Object){.mesh = mesh,
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

static void lecture_programs_draw_the_reference(void **state)
{
    static const struct {
        int width, height;
    } sizes[] = {{400, 400}, {201, 157}};
    static const double times[] = {0, 1.7};
    (void)state;
    bool all = true;
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        Options options = {.width = sizes[s].width,
                           .height = sizes[s].height,
                           .frames = 1,
                           .shaders = {.precision = "highp"}};
        Message message = {0};
        Canvas canvas;
        Picture picture = {.path = ""};
        require(stage_open(&canvas, &options, "x.png", &message), &message);
        require(image_open(&picture.image, canvas.width, canvas.height, IMAGE_BYTE, &message),
                &message);
        for (int i = 0; i < LESSON_COUNT; i++) {
            const Lesson *lesson = &LESSONS[i];
            Mesh mesh;
            require(lesson->half_side > 0 ? mesh_cube(&mesh, lesson->half_side, &message)
                                          : mesh_sphere(&mesh, 1, 13, 13, &message),
                    &message);
            require(stage_enter(lesson->example, &options, &message), &message);
            for (size_t t = 0; t < sizeof times / sizeof times[0]; t++) {
                char name[96];
                LessonScene made;
                Reference exact;
                lesson_scene(lesson, &mesh, times[t], &made);
                open_exact(&exact, &made.scene, canvas.width, canvas.height, true);
                require(
                    stage_picture(lesson->example, &canvas, &options, times[t], &picture, &message),
                    &message);
                snprintf(name, sizeof name, "%s-%d-%zu", lesson->example->name, canvas.width, t);
                all &= check(name, &picture.image, &exact, MOST);
                reference_close(&exact);
            }
            stage_leave(lesson->example);
            mesh_close(&mesh);
        }
        image_close(&picture.image);
        canvas_close(&canvas);
    }
    assert_true(all);
}

/* The programs that are scenes. */

/* Draws a scene alone, without the marks that its program draws over it. */
static void draw(const Canvas *canvas, Lighting *lighting, const Scene *scene, Image *image)
{
    Message message = {0};
    canvas_clear(canvas, scene->background, 1);
    require(lighting_draw(lighting, scene, (double)canvas->width / canvas->height, false, &message),
            &message);
    require(canvas_read(canvas, image, &message), &message);
}

static void scenes_are_drawn_as_the_reference_has_them(void **state)
{
    static const double times[] = {0, 2.3};
    const ShaderLoader loader = {.precision = "highp"};
    const CanvasOptions options = {.width = 240, .height = 200};
    (void)state;
    bool all = true;
    for (int i = 0; i < EXAMPLE_COUNT; i++) {
        const Example *example = EXAMPLES[i];
        Message message = {0};
        Canvas canvas;
        Image image;
        Lighting *lighting;
        int columns = 1, rows = 1;
        require(canvas_open(&canvas, &options, &message), &message);
        require(image_open(&image, canvas.width, canvas.height, IMAGE_BYTE, &message), &message);
        require(example->init(&loader, &message), &message);
        require(lighting_open(&lighting, &loader, &message), &message);
        if (example->layout)
            example->layout(&columns, &rows);
        for (int view = 0; view < columns * rows; view++) {
            for (size_t t = 0; t < sizeof times / sizeof times[0]; t++) {
                char name[96];
                Scene scene = {.object_count = 0};
                Reference exact;
                example->scene(times[t], view, &scene);
                if (scene.object_count == 0)
                    continue; /* PhongBlinn's third view is their difference */
                draw(&canvas, lighting, &scene, &image);
                open_exact(&exact, &scene, canvas.width, canvas.height, true);
                snprintf(name, sizeof name, "%s-%d-%zu", example->name, view, t);
                all &= check(name, &image, &exact, MOST);
                reference_close(&exact);
            }
        }
        lighting_close(lighting);
        example->finish();
        image_close(&image);
        canvas_close(&canvas);
    }
    assert_true(all);
}

/* Settings that were chosen by an error. */

/* Draws a view with the setting that the committed table has for an error, and gives its own. */
static double error_of_choice(const Canvas *canvas, Lighting *lighting, const Scene *scene,
                              const Efficient *table, double allowed, Image *image)
{
    Message message = {0};
    SolidMeshes meshes = {NULL};
    SettingScene made;
    Reference exact, drawn;
    const EfficientRow *row = efficient_choose(table, scene_class(scene), allowed, &message);
    require(row != NULL, &message);
    assert_int_equal(row->setting.choice[AXIS_PRECISION], PRECISION_HIGHP);
    require(setting_scene_open(&made, scene, &row->setting, &meshes, &message), &message);
    draw(canvas, lighting, &made.scene, image);
    open_exact(&exact, scene, canvas->width, canvas->height, false);
    open_exact(&drawn, &made.scene, canvas->width, canvas->height, true);
    ReferenceError error = {.all = {0}};
    reference_error_add(&error, image, 0, 0, &exact, &drawn);
    reference_close(&exact);
    reference_close(&drawn);
    for (const SolidMesh *mesh = meshes.first; mesh; mesh = mesh->next)
        lighting_forget(lighting, &mesh->mesh);
    setting_scene_close(&made);
    solid_meshes_close(&meshes);
    return error.interior.maximum;
}

static void programs_keep_the_error_they_are_given(void **state)
{
    static const double allowed[] = {1, 2, 4, 16};
    const ShaderLoader loader = {.precision = "highp"};
    const CanvasOptions options = {.width = 240, .height = 200};
    Efficient *table = calloc(1, sizeof *table);
    Message message = {0};
    Canvas canvas;
    Image image;
    Lighting *lighting;
    char path[4096];
    (void)state;
    bool all = true;
    snprintf(path, sizeof path, "%s/../common/efficient.csv", SHADERS_SOURCE);
    setenv("LIGHTING_EFFICIENT", path, 1);
    require(efficient_read(table, &message), &message);
    require(canvas_open(&canvas, &options, &message), &message);
    require(image_open(&image, canvas.width, canvas.height, IMAGE_BYTE, &message), &message);
    require(lighting_open(&lighting, &loader, &message), &message);
    for (int i = 0; i < EXAMPLE_COUNT; i++) {
        int columns = 1, rows = 1;
        require(EXAMPLES[i]->init(&loader, &message), &message);
        if (EXAMPLES[i]->layout)
            EXAMPLES[i]->layout(&columns, &rows);
        for (int view = 0; view < columns * rows; view++) {
            Scene scene = {.object_count = 0};
            EXAMPLES[i]->scene(0, view, &scene);
            if (scene.object_count == 0)
                continue;
            print_message("%-18s view %d, class %-8s:", EXAMPLES[i]->name, view,
                          SCENE_CLASS_NAMES[scene_class(&scene)]);
            for (size_t e = 0; e < sizeof allowed / sizeof allowed[0]; e++) {
                const double error =
                    error_of_choice(&canvas, lighting, &scene, table, allowed[e], &image);
                print_message("  allowed %g, is %.2f", allowed[e], error);
                all &= error <= allowed[e];
            }
            print_message("\n");
        }
        EXAMPLES[i]->finish();
    }
    lighting_close(lighting);
    image_close(&image);
    canvas_close(&canvas);
    unsetenv("LIGHTING_EFFICIENT");
    free(table);
    assert_true(all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lecture_programs_draw_the_reference),
        cmocka_unit_test(scenes_are_drawn_as_the_reference_has_them),
        cmocka_unit_test(programs_keep_the_error_they_are_given),
    };
    if (!picture_check_driver("picture_reference_test"))
        return EXIT_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
