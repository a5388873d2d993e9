/*
 * The effect of rounding to double on the exact picture: the same source compiled with 113-bit
 * numbers, compared with the one that programs use. No GL.
 */
#include "hard/random_scene.h"
#include "reference/reference_trace.h"
#include "support/testing.h"

/* The names of reference_trace.h if REFERENCE_QUAD is defined. */
bool quad_trace_open(Trace **trace, const Scene *scene, const ReferenceOptions *options,
                     Message *message);
void quad_trace_sample(const Trace *trace, double x, double y, Sample *sample);
void quad_trace_close(Trace *trace);

enum { SIZE = 256, SCENES = 8, POINTS = 250 };
typedef struct Error {
    double color, depth; /* steps of 1/255; of 1 */
    int points, elsewhere;
} Error;

static void compare(const Scene *scene, bool meshes, Error *error)
{
    const ReferenceOptions options = {
        .width = SIZE, .height = SIZE, .meshes = meshes, .threads = 1};
    Trace *trace, *quad;
    Random random = {20};
    assert_true(trace_open(&trace, scene, &options, NULL));
    assert_true(quad_trace_open(&quad, scene, &options, NULL));
    for (int i = 0; i < POINTS; i++) {
        const double x = random_between(&random, 0, SIZE), y = random_between(&random, 0, SIZE);
        Sample sample, exact;
        trace_sample(trace, x, y, &sample);
        quad_trace_sample(quad, x, y, &exact);
        if (!trace_same_side(&sample, &exact)) {
            error->elsewhere++;
            continue;
        }
        if (sample.object < 0)
            continue;
        error->points++;
        error->depth = fmax(error->depth, fabs(sample.depth - exact.depth));
        for (int k = 0; k < 3; k++)
            error->color = fmax(error->color, 255 * fabs(sample.linear[k] - exact.linear[k]));
    }
    quad_trace_close(quad);
    trace_close(trace);
}

/* A random scene of one such solid, whose lights all have shadows. */
static void make_scene(RandomScene *made, Solid solid, int number)
{
    random_scene_make(made, (unsigned)number, 20);
    made->scene.object_count = 1;
    made->scene.clamp_vertex = false; /* lights with shadows would be refused */
    made->scene.camera.fovy = 18;
    made->shapes[0] = (RandomShape){.solid = solid, .divisions = 16};
    for (int i = 0; i < 3; i++) /* into the middle */
        made->objects[0].world_from_object.m[12 + i] = 0;
    for (int i = 0; i < made->scene.light_count; i++)
        made->lights[i].shadows = true;
}

TEST(double_is_as_good_as_twice_its_digits)
{
    static const char *const names[] = {"none",     "sphere", "box",   "quad",  "disc",
                                        "cylinder", "cone",   "torus", "teapot"};
    RandomMeshes shapes = {.first = NULL};
    for (SolidKind kind = SOLID_SPHERE; kind <= SOLID_TEAPOT; kind++)
        for (int meshes = 0; meshes < 2; meshes++) {
            Error error = {0, 0, 0, 0};
            if (kind == SOLID_TEAPOT && !meshes)
                continue; /* many triangles take long, so it has fewer as a mesh */
            for (int i = 0; i < SCENES; i++) {
                RandomScene made;
                const Solid solid = {kind, 1, 1.2, 0.35, (MeshCaps)(i % 4)};
                make_scene(&made, solid, (int)kind * SCENES + i);
                SUCCEEDS(random_scene_ready(&made, &shapes, message) &&
                         scene_check(&made.scene, message));
                compare(&made.scene, meshes, &error);
            }
            printf("%-9s %-7s %5d points: colour %.1e of a level, depth %.1e; %d on another side\n",
                   names[kind], meshes ? "as mesh" : "exact", error.points, error.color,
                   error.depth, error.elsewhere);
            assert_true(error.points > 200);
            /* Near its outline a solid's normal turns with the root of the distance: a point 1e-6
             * of a pixel from it has an error of 1e-16 / 1e-3, times the exponents, 255, and the
             * loss by matrices. */
            assert_true(error.color < 1e-9);
            assert_true(error.depth < 1e-11);
            assert_int_equal(error.elsewhere, 0);
        }
    random_meshes_close(&shapes);
}

TEST_MAIN("reference quad", NULL, NULL)
