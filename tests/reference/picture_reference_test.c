/*
 * What the driver draws against common/reference: the nine lecture programs, whose scenes are
 * written down here as data, and every view of the ten programs that are scenes. The reference has
 * the meshes as given, so that what is compared is light and its interpolation.
 *
 * Inside objects, where no edge runs through the pixel, a highp picture may be one step of 1/255
 * off: rounding to 8 bits alone makes 0.5, and arithmetic in 32 bits with a shininess up to 128
 * less than the other half.
 */
#include "app/options.h"
#include "app/renderer.h"
#include "images/picture_queue.h"
#include "lighting/lighting.h"
#include "reference/picture_error.h"
#include "scene/scene_example.h"
#include "support/examples.h"
#include "support/picture_check.h"
#include "support/testing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double MAX = 1; /* step of 1/255 */

#define X(NAME) extern const Example NAME;
LECTURE_EXAMPLES
#undef X

/* Comparing. */

/* Whether no pixel inside an object is farther than `most` steps from the exact picture, and there
 * are such pixels at all, with more than one color. Where not, says so and keeps the pictures. */
static bool check(const char *name, const Image *image, const Reference *exact, const Scene *scene,
                  double max)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    PictureError error = {.all = {0}};
    picture_error_add(&error, image, &(ExactView){.exact = exact, .scene = scene});
    const ErrorSum *inside = &error.interior;
    print_message("%-40s %6lld pixels inside, largest error %.3f\n", name, inside->pixels,
                  inside->maximum);
    if (inside->pixels > (long long)count / 100 && inside->maximum <= max)
        return true;
    printf("%s: %lld pixels inside; at column %zu, row %zu the error is %.3f\n", name,
           inside->pixels, inside->worst % (size_t)image->width,
           inside->worst / (size_t)image->width, inside->maximum);
    picture_check_keep_exact(name, image, exact);
    return false;
}

static void open_exact(Reference *exact, const Scene *scene, int width, int height, bool meshes)
{
    const ReferenceOptions options = {.width = width, .height = height, .meshes = meshes};
    require(scene_check(scene, FAILURE), FAILURE);
    require(reference_open(exact, scene, &options, FAILURE), FAILURE);
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

enum { LESSON_COUNT = sizeof LESSONS / sizeof LESSONS[0] };

/* A lesson at one moment, as a scene; it points into itself and at the mesh. */
typedef struct LessonScene {
    Light light;
    Object object;
    Scene scene;
} LessonScene;

static void lesson_scene(const Lesson *lesson, const Mesh *mesh, double seconds, LessonScene *made)
{
    const Vec3 grey = {lesson->light_color, lesson->light_color, lesson->light_color};
    const double degrees = lesson->turn + lesson->turn_per_second * seconds;
    const Mat4 turned = mat4_rotate(degrees, lesson->about_z ? (Vec3){0, 0, 1} : (Vec3){0, 1, 0});
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

TEST(lecture_programs_draw_the_reference)
{
    static const int sizes[][2] = {{400, 400}, {201, 157}};
    static const double times[] = {0, 1.7};
    bool all = true;
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        Options options = {.width = sizes[s][0],
                           .height = sizes[s][1],
                           .frames = 1,
                           .shaders = {.precision = "highp"}};
        Canvas canvas;
        Renderer renderer;
        Picture picture = {.path = ""};
        require(options_open_canvas(&canvas, &options, "x.png", FAILURE), FAILURE);
        require(image_open(&picture.image, canvas.width, canvas.height, IMAGE_BYTE, FAILURE),
                FAILURE);
        for (int i = 0; i < LESSON_COUNT; i++) {
            const Lesson *lesson = &LESSONS[i];
            Mesh mesh;
            require(lesson->half_side > 0 ? mesh_cube(&mesh, lesson->half_side, FAILURE)
                                          : mesh_sphere(&mesh, 1, 13, 13, FAILURE),
                    FAILURE);
            const DrawRequest request = options_request(&options, lesson->example);
            require(renderer_open(&renderer, lesson->example, &canvas, &request, FAILURE), FAILURE);
            for (size_t t = 0; t < sizeof times / sizeof times[0]; t++) {
                char name[96];
                LessonScene made;
                Reference exact;
                lesson_scene(lesson, &mesh, times[t], &made);
                open_exact(&exact, &made.scene, canvas.width, canvas.height, true);
                require(renderer_picture(&renderer, &request, times[t], &picture.image, FAILURE),
                        FAILURE);
                snprintf(name, sizeof name, "%s-%d-%zu", lesson->example->name, canvas.width, t);
                all &= check(name, &picture.image, &exact, &made.scene, MAX);
                reference_close(&exact);
            }
            renderer_close(&renderer);
            mesh_close(&mesh);
        }
        image_close(&picture.image);
        canvas_close(&canvas);
    }
    assert_true(all);
}

/* The programs that are scenes. */

/* Draws a scene alone, without the marks that its program draws over it. */
static void render(const Canvas *canvas, Lighting *lighting, const Scene *scene, Image *image)
{
    canvas_clear(canvas, scene->background, 1);
    require(lighting_show(
                lighting,
                &(LightingFrame){.scene = scene, .aspect = (double)canvas->width / canvas->height},
                FAILURE),
            FAILURE);
    require(canvas_read(canvas, image, FAILURE), FAILURE);
}

TEST(scenes_are_drawn_as_the_reference_has_them)
{
    static const double times[] = {0, 2.3};
    const ShaderLoader loader = {.precision = "highp"};
    const CanvasOptions options = {.width = 240, .height = 200};
    bool all = true;
    for (int i = 0; i < EXAMPLE_COUNT; i++) {
        const Example *example = EXAMPLES[i];
        Canvas canvas;
        Image image;
        Lighting *lighting;
        int columns = 1, rows = 1;
        require(canvas_open(&canvas, &options, FAILURE), FAILURE);
        require(image_open(&image, canvas.width, canvas.height, IMAGE_BYTE, FAILURE), FAILURE);
        require(example->init(&loader, FAILURE), FAILURE);
        require(lighting_open(&lighting, &loader, FAILURE), FAILURE);
        if (example_scene(example)->layout)
            example_scene(example)->layout(&columns, &rows);
        for (int view = 0; view < columns * rows; view++) {
            /* In the short form one of the moments. */
            const size_t every = (size_t)testing_step(2);
            for (size_t t = (size_t)(i + view) % every; t < sizeof times / sizeof times[0];
                 t += every) {
                char name[96];
                Scene scene = {.object_count = 0};
                Reference exact;
                example_scene(example)->make(times[t], view, &scene);
                if (scene.object_count == 0)
                    continue; /* PhongBlinn's third view is their difference */
                render(&canvas, lighting, &scene, &image);
                open_exact(&exact, &scene, canvas.width, canvas.height, true);
                snprintf(name, sizeof name, "%s-%d-%zu", example->name, view, t);
                all &= check(name, &image, &exact, &scene, MAX);
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

PICTURE_TEST_MAIN("picture reference", NULL, NULL)
