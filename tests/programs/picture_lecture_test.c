/*
 * The pictures of the lecture's nine programs: every pixel against what a ray of the exact picture
 * (reference/reference_trace.h) sees through its centre, in double precision. The scenes are
 * written down here as data, from the lecture.
 *
 * Columns and rows are in pixels from the upper left corner of a picture; a pixel's centre is at
 * its number plus one half. Colours are in steps, 0 to 255.
 */
#include "app/options.h"
#include "app/renderer.h"
#include "core/mesh_make.h"
#include "images/picture_queue.h"
#include "reference/reference_trace.h"
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

enum { LESSON_COUNT = sizeof LESSONS / sizeof LESSONS[0] };

typedef struct Size {
    int width, height;
} Size;

/* The lecture's size; odd numbers; portrait; so narrow that every object exceeds both sides. */
static const Size SIZES[] = {{400, 400}, {257, 193}, {64, 128}, {31, 400}};

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

/* The exact picture. */

typedef struct Pixel {
    bool covered;    /* the centre is inside the silhouette */
    bool left_out;   /* too near to an edge where the colour jumps */
    double level[3]; /* of each channel */
    double shift[3]; /* change of the level by snapping of vertices */
} Pixel;

/*
 * Rasterizers move vertices to a grid of 1/2^bits pixel, each way by half a step at most: by 0.71
 * steps in all. This is a whole step, in pixels; the rest is for the floats that a projection goes
 * through (24 bits for 400 pixels: a few of 2.4e-5 pixels, against 0.29 * 2^-8 = 1.1e-3).
 */
static double snap;

static int find_snap(void **state)
{
    const CanvasOptions options = {.width = 1, .height = 1};
    Canvas canvas;
    Message message = {0};
    GLint bits = 0;
    (void)state;
    if (!canvas_open(&canvas, &options, &message)) {
        printf("%s\n", message.text);
        return -1;
    }
    glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
    canvas_close(&canvas);
    snap = ldexp(1, -bits);
    printf("vertices are moved to %d bits of a pixel\n", (int)bits);
    return bits >= 4 ? 0 : -1; /* OpenGL ES 2.0.25, table 6.18 */
}

typedef struct Exact {
    const Lesson *lesson;
    int width, height;
    double rounding; /* by shader_rounding */
    Pixel *pixels;
} Exact;

/* By the rays through the centre and four points around it: no edge is nearer than a snap that does
 * not pass between these. On a common edge of two triangles of a sphere the driver may take either:
 * the change to both sides counts. */
static void find_pixel(const Trace *trace, const Lesson *lesson, double x, double y, Pixel *pixel)
{
    static const int around[5][2] = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const double far = sqrt(2) * snap, half = lesson->half_side;
    Sample at[5];
    for (int k = 0; k < 5; k++)
        trace_sample(trace, x + far * around[k][0], y + far * around[k][1], &at[k]);
    pixel->covered = at[0].object >= 0;
    for (int k = 1; k < 5; k++) {
        pixel->left_out |= at[k].object != at[0].object ||
                           (pixel->covered && half > 0 && at[k].piece != at[0].piece);
        for (int c = 0; c < 3; c++)
            pixel->shift[c] +=
                255 / sqrt(2) * fabs((double)at[k].color[c] - (double)at[0].color[c]);
    }
    for (int c = 0; c < 3; c++)
        pixel->level[c] = 255 * (double)at[0].color[c];
}

/* The caller frees the pixels. */
static void draw_exact(const Lesson *lesson, Size size, double seconds, Exact *exact)
{
    LessonScene made;
    Trace *trace;
    lesson_open(lesson, seconds, &made);
    SUCCEEDS(
        trace_open(&trace, &made.scene,
                   &(ReferenceOptions){
                       .width = size.width, .height = size.height, .meshes = true, .threads = 1},
                   message));
    *exact = (Exact){.lesson = lesson,
                     .width = size.width,
                     .height = size.height,
                     .rounding = shader_rounding(&made.scene)};
    exact->pixels = calloc((size_t)size.width * (size_t)size.height, sizeof *exact->pixels);
    assert_non_null(exact->pixels);
    for (int i = 0; i < size.width * size.height; i++)
        find_pixel(trace, lesson, i % size.width + 0.5, i / size.width + 0.5, &exact->pixels[i]);
    trace_close(trace);
    mesh_close(&made.mesh);
}

/* The comparison. */

typedef struct Verdict {
    long compared, covered, left_out; /* pixels; covered: of those compared */
    long wrong;                       /* of those compared: colour or coverage */
    double worst, squares;            /* |picture - exact|, in steps */
    double worst_part;                /* the largest ratio of an error to its bound */
    int column, row;                  /* of the worst ratio */
} Verdict;

static const char *precision_of(bool half)
{
    return half ? NULL : "highp";
}

/*
 * How far a channel may be off, in steps: half a step for the byte's rounding, what the snapping
 * of vertices does at this pixel, 0.01 for the floats of 24 bits (20 operations: 255 * 20 * 2^-24
 * is 3e-4), and with 11 bits the shader's rounding. With highp, 0, never more than one step.
 */
static double allowed(const Pixel *pixel, int c, double rounding)
{
    const double rest = pixel->shift[c] + 0.01;
    if (!pixel->covered)
        return 0;
    return 0.5 + (pixel->level[c] > 0) * (rounding > 0 ? rounding + rest : fmin(rest, 0.5));
}

/* Counts one pixel that is not left out. Pictures are drawn with their alpha kept: 255 where the
 * shape is, else 0. */
static void compare_pixel(const unsigned char *bytes, const Pixel *pixel, double rounding,
                          Verdict *verdict)
{
    /* Relative to its bound; infinite if nothing may be there. */
    double part = bytes[3] == (pixel->covered ? 255 : 0) ? 0 : INFINITY;
    for (int c = 0; c < 3; c++) {
        const double error = fabs(bytes[c] - pixel->level[c]);
        if (error > 0)
            part = fmax(part, error / allowed(pixel, c, rounding));
        verdict->worst = fmax(verdict->worst, error);
    }
    verdict->squares += pow(bytes[0] - pixel->level[0], 2);
    verdict->compared++;
    verdict->covered += pixel->covered;
    verdict->wrong += part > 1;
    verdict->worst_part = fmax(verdict->worst_part, part);
}

static Verdict compare(const Image *picture, const Exact *exact, bool half)
{
    const unsigned char *bytes = picture->pixels;
    Verdict verdict = {0};
    for (int i = 0; i < exact->width * exact->height; i++) {
        const double before = verdict.worst_part;
        if (exact->pixels[i].left_out)
            verdict.left_out++;
        else
            compare_pixel(bytes + 4 * i, &exact->pixels[i], half ? exact->rounding : 0, &verdict);
        if (verdict.worst_part > before) {
            verdict.column = i % exact->width;
            verdict.row = i / exact->width;
        }
    }
    return verdict;
}

/* The exact picture as bytes, for inspection. */
static void exact_image(const Exact *exact, Image *image)
{
    assert_true(image_open(image, exact->width, exact->height, IMAGE_BYTE, NULL));
    for (int i = 0; i < exact->width * exact->height; i++) {
        unsigned char *bytes = (unsigned char *)image->pixels + 4 * i;
        for (int c = 0; c < 3; c++)
            bytes[c] = (unsigned char)lrint(exact->pixels[i].level[c]);
        bytes[3] = exact->pixels[i].covered ? 255 : 0;
    }
}

/* Drawing. */

static Options options_for(Size size, const char *precision)
{
    return (Options){.width = size.width,
                     .height = size.height,
                     .frames = 1,
                     .alpha = true,
                     .shaders = {.precision = precision}};
}

static void open_canvas(Canvas *canvas, const Options *options)
{
    SUCCEEDS(options_open_canvas(canvas, options, "picture.png", message));
}

static void open_picture(Picture *picture, Size size)
{
    memset(picture, 0, sizeof *picture);
    SUCCEEDS(image_open(&picture->image, size.width, size.height, IMAGE_BYTE, message));
}

static void open_example(Renderer *renderer, const Lesson *lesson, const Canvas *canvas,
                         const Options *options)
{
    const DrawRequest request = options_request(options, lesson->example);
    SUCCEEDS(renderer_open(renderer, lesson->example, canvas, &request, message));
}

static void draw_picture(Renderer *renderer, const Options *options, double seconds,
                         Picture *picture)
{
    const DrawRequest request = options_request(options, renderer->example);
    SUCCEEDS(renderer_picture(renderer, &request, seconds, &picture->image, message));
}

/* One picture, on a canvas of its own. */
static void draw_alone(const Lesson *lesson, const Options *options, double seconds,
                       Picture *picture)
{
    CLOSED(canvas_close) Canvas canvas;
    CLOSED(renderer_close) Renderer renderer;
    open_canvas(&canvas, options);
    open_picture(picture, (Size){options->width, options->height});
    open_example(&renderer, lesson, &canvas, options);
    draw_picture(&renderer, options, seconds, picture);
}

/* Every lesson at every size and time. */

/* The sums of one lesson's pictures. */
static void add_verdict(Verdict *sum, const Verdict *verdict)
{
    sum->compared += verdict->compared;
    sum->covered += verdict->covered;
    sum->left_out += verdict->left_out;
    sum->wrong += verdict->wrong;
    sum->squares += verdict->squares;
    sum->worst = fmax(sum->worst, verdict->worst);
    sum->worst_part = fmax(sum->worst_part, verdict->worst_part);
}

static void check_picture(const Exact *exact, double seconds, const Image *picture, bool half,
                          Verdict *sum)
{
    const Verdict verdict = compare(picture, exact, half);
    const long all = (long)exact->width * exact->height;
    char name[128];
    snprintf(name, sizeof name, "%s-%dx%d-%gs-%s", exact->lesson->example->name, exact->width,
             exact->height, seconds, half ? "default" : "highp");
    if (verdict.wrong && !sum->wrong) { /* write one picture per lesson */
        CLOSED(image_close) Image expected;
        printf("%s: %ld pixels are wrong; the worst, column %d, row %d, by %.2f of its bound\n",
               name, verdict.wrong, verdict.column, verdict.row, verdict.worst_part);
        exact_image(exact, &expected);
        picture_check_keep(name, picture, &expected);
    }
    /* Every object fills a tenth of its picture at least, and of a hundred covered pixels at most
     * one is too near to an edge to be compared: such strips are 3 `snap` wide, and an object of
     * d pixels across has some 8 d of them for its d^2 / 2 pixels or more. */
    if (verdict.covered < all / 10 || verdict.left_out > verdict.covered / 100)
        fail_msg("%s: of %ld pixels %ld are covered and %ld left out", name, all, verdict.covered,
                 verdict.left_out);
    add_verdict(sum, &verdict);
}

/* In both precisions. A still lesson only at the first and the last time. */
static void check_lesson(const Lesson *lesson, Size size, Canvas *canvas, Verdict sums[2])
{
    Exact exact[TIME_COUNT];
    const int step = lesson->turn_per_second > 0 ? 1 : TIME_COUNT - 1;
    for (int t = 0; t < TIME_COUNT; t += step)
        draw_exact(lesson, size, TIMES[t], &exact[t]);
    for (int half = 0; half < 2; half++) {
        const Options options = options_for(size, precision_of(half));
        CLOSED(renderer_close) Renderer renderer;
        Picture picture;
        open_picture(&picture, size);
        open_example(&renderer, lesson, canvas, &options);
        for (int t = 0; t < TIME_COUNT; t += step) {
            draw_picture(&renderer, &options, TIMES[t], &picture);
            check_picture(&exact[t], TIMES[t], &picture.image, half, &sums[half]);
        }
        image_close(&picture.image);
    }
    for (int t = 0; t < TIME_COUNT; t += step)
        free(exact[t].pixels);
}

/* With highp the exact colour, by default within the bound of 11 bits. */
TEST(every_pixel_clear_of_an_edge_has_its_colour)
{
    Verdict sums[LESSON_COUNT][2] = {0};
    long wrong = 0;
    for (int s = 0; s < SIZE_COUNT; s++) {
        const Options options = options_for(SIZES[s], NULL);
        CLOSED(canvas_close) Canvas canvas;
        open_canvas(&canvas, &options);
        for (int i = 0; i < LESSON_COUNT; i++)
            check_lesson(&LESSONS[i], SIZES[s], &canvas, sums[i]);
    }
    printf("%-40s   worst  of bound    rms   compared  covered  left out\n", "steps of 1/255");
    for (int i = 0; i < 2 * LESSON_COUNT; i++) {
        const Verdict *sum = &sums[i / 2][i % 2];
        printf("%-31s %-8s %7.3f %8.0f%% %7.3f %9ld %8ld %8ld\n", LESSONS[i / 2].example->name,
               i % 2 ? "default" : "highp", sum->worst, 100 * sum->worst_part,
               sqrt(sum->squares / (double)sum->covered), sum->compared, sum->covered,
               sum->left_out);
        wrong += sum->wrong;
    }
    assert_int_equal(wrong, 0);
}

/* The comparison itself can fail. */

/* Rejects more than 1% of the covered pixels, so rounding is not the cause. */
static void must_refuse(const char *what, const Exact *exact, const Image *picture)
{
    const Verdict verdict = compare(picture, exact, true);
    if (verdict.wrong <= verdict.covered / 100)
        fail_msg("%s: of the picture %s only %ld pixels count as wrong",
                 exact->lesson->example->name, what, verdict.wrong);
}

TEST(a_black_mirrored_or_mistimed_picture_is_refused)
{
    const Size size = SIZES[0];
    const Options options = options_for(size, NULL);
    for (int i = 0; i < LESSON_COUNT; i++) {
        Picture picture;
        Exact exact;
        draw_alone(&LESSONS[i], &options, TIMES[1], &picture);
        if (LESSONS[i].turn_per_second > 0) {
            draw_exact(&LESSONS[i], size, TIMES[2], &exact);
            must_refuse("of another moment", &exact, &picture.image);
            free(exact.pixels);
        }
        draw_exact(&LESSONS[i], size, TIMES[1], &exact);
        uint32_t *pixels = picture.image.pixels;
        for (int k = 0; k < size.width * size.height; k++) {
            const int other = k - k % size.width + size.width - 1 - k % size.width;
            const uint32_t kept = pixels[k];
            if (other > k)
                pixels[k] = pixels[other], pixels[other] = kept;
        }
        must_refuse("mirrored", &exact, &picture.image);
        memset(pixels, 0, image_row_size(&picture.image) * (size_t)size.height);
        must_refuse("in black", &exact, &picture.image);
        free(exact.pixels);
        image_close(&picture.image);
    }
}

int main(void)
{
    return picture_check_run("picture lecture", find_snap, NULL);
}
