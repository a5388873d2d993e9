/*
 * Random scenes drawn by common/lighting and by OpenGL 1.1 fixed-function lighting. The two GL
 * libraries conflict within a process, so the program runs itself again for our side (--ours SEED
 * COUNT), which writes its pixels to a pipe.
 */
#include "hard/random_scene.h"
#include "lighting/fixed_function_osmesa.h"
#include "support/picture_check.h"
#include "support/testing.h"

#include <sys/wait.h>
#include <unistd.h>

enum { SIZE = 96, SCENES = 200 };

/* Random scenes. */

static uint64_t seed;
static RandomMeshes meshes;

/* No part of a side hides another part of the same side, so that silhouettes can be told from
 * sides: convex, or open sides of convex solids. */
static bool is_convex(const RandomShape *shape)
{
    return shape->form != FORM_SOLID ||
           (shape->solid.kind != SOLID_TORUS && shape->solid.kind != SOLID_TEAPOT);
}

/* What both can draw: lit at the vertices, of one reflection, without sRGB. */
static void fit_scene(RandomScene *made, uint64_t number, Random *random)
{
    RandomScene more;
    Scene *scene = &made->scene;
    scene->interpolation =
        random_below(random, 3) == 0 ? INTERPOLATION_CONSTANT : INTERPOLATION_GOURAUD;
    scene->reflection = REFLECTION_BLINN_PHONG;
    scene->clamp_vertex = true;
    scene->linear = scene->show_clipped = false;
    random_scene_make(&more, ~number, number);
    for (int i = 0; i < more.scene.light_count && random_below(random, 2); i++)
        made->lights[scene->light_count++] = more.lights[i];
    for (int i = 0; i < scene->object_count; i++) {
        Object *object = &made->objects[i];
        Material *const sides[2] = {&object->front, &object->back};
        if (!is_convex(&made->shapes[i]))
            made->shapes[i].solid = (Solid){.kind = SOLID_SPHERE, .radius = 1};
        for (int k = 0; k < 2; k++) {
            sides[k]->alpha = random_below(random, 3) ? 1 : random_between(random, 0, 1);
            /* Not 0: for 0 to the power of 0, behind the highlight, Mesa computes 0; ours is 1, as
             * for any other number to the power of 0. */
            sides[k]->shininess = fmax(sides[k]->shininess, 0.1);
        }
        if (made->shapes[i].colored)
            object->back.alpha = object->front.alpha; /* of the color, in OpenGL */
        object->wrong_normals = false;
    }
}

/* The scene of a number; a later one if rounding decides about a vertex, which would change whole
 * triangles. */
static void make_world(RandomScene *made, uint64_t number)
{
    Message message = {0};
    Random random = {seed ^ number};
    Object *first = &made->objects[0];
    do {
        random_scene_make(made, seed + number, seed + number);
        fit_scene(made, seed + number, &random);
        if (!random_scene_ready(made, &meshes, &message)) {
            fprintf(stderr, "%s\n", message.text);
            exit(1);
        }
        number += SCENES;
    } while (random_scene_grazes(made));
    first->behind_lines = made->scene.object_count == 1 && first->closed && !first->clockwise &&
                          random_below(&random, 2);
}

/* Our side. */

static bool draw_ours(int count, Message *message)
{
    Canvas canvas;
    Lighting *lighting;
    Image picture;
    RandomScene world;
    if (!canvas_open(&canvas, &(CanvasOptions){.width = SIZE, .height = SIZE}, message) ||
        !lighting_open(&lighting, &(ShaderLoader){0}, message) ||
        !image_open(&picture, SIZE, SIZE, IMAGE_BYTE, message))
        return false;
    for (int i = 0; i < count; i++) {
        make_world(&world, (uint64_t)i);
        canvas_clear(&canvas, world.scene.background, 1);
        if (!scene_check(&world.scene, message) ||
            !lighting_show(lighting, &(LightingFrame){.scene = &world.scene, .aspect = 1},
                           message) ||
            !canvas_read(&canvas, &picture, message))
            return false;
        fwrite(picture.pixels, image_row_size(&picture), SIZE, stdout);
    }
    const LightingCounts counts = lighting_counts(lighting);
    fprintf(stderr, "fixed function: %d scenes, %d programs in %.1f s\n", count, counts.programs,
            counts.compile_seconds);
    image_close(&picture);
    lighting_close(lighting);
    canvas_close(&canvas);
    return fflush(stdout) == 0;
}

static int main_ours(const char *given_seed, const char *count)
{
    Message message = {0};
    seed = strtoull(given_seed, NULL, 10);
    const bool done = draw_ours(atoi(count), &message);
    random_meshes_close(&meshes);
    if (!done)
        fprintf(stderr, "fixed function: our side: %s\n", message.text);
    return done ? 0 : 1;
}

/* Their side, and the comparison. */

static FILE *run_ours(pid_t *child, int scenes)
{
    int ends[2];
    const char *seed_text = formatted("%llu", (unsigned long long)seed);
    const char *count_text = formatted("%d", scenes);
    assert_int_equal(pipe(ends), 0);
    *child = fork();
    if (*child == 0) {
        dup2(ends[1], STDOUT_FILENO);
        close(ends[0]);
        close(ends[1]);
        execl("/proc/self/exe", "fixed_function_test", "--ours", seed_text, count_text, NULL);
        _exit(1);
    }
    close(ends[1]);
    return fdopen(ends[0], "rb");
}

static const unsigned char *pixel(const Image *image, int x, int y)
{
    return (const unsigned char *)image->pixels + 4 * (y * SIZE + x);
}

/* Whether the 3x3 pixels around this one do not all belong to one side of one object, or to one
 * triangle if that has one color: there, matrices multiplied in float may move an edge across a
 * pixel's center. */
static bool at_edge(const Image *sides, int x, int y)
{
    for (int v = y - 1; v <= y + 1; v++)
        for (int u = x - 1; u <= x + 1; u++)
            if (u >= 0 && u < SIZE && v >= 0 && v < SIZE &&
                memcmp(pixel(sides, u, v), pixel(sides, x, y), 3) != 0)
                return true;
    return false;
}

typedef struct Tally {
    long long differing;          /* pixels that are one level apart */
    long long edges_apart, edges; /* at edges: more than one level apart, and all */
    long long inner;              /* pixels of objects that are not at edges */
} Tally;

/* How many inner pixels are more than one level apart in any channel, alpha too. */
static int compare(const Image *ours, const Image *theirs, const Image *sides, Tally *tally)
{
    int apart = 0;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            const int levels = pixel_levels(pixel(ours, x, y), pixel(theirs, x, y));
            const bool edge = at_edge(sides, x, y);
            tally->differing += levels == 1;
            tally->edges += edge;
            tally->edges_apart += edge && levels > 1;
            tally->inner += !edge && pixel(sides, x, y)[0] != 0;
            apart += !edge && levels > 1;
        }
    return apart;
}

TEST(every_scene_is_drawn_as_opengl_1_1_draws_it)
{
    pid_t child;
    int status, wrong = 0;
    Image ours, theirs, sides;
    RandomScene world;
    Tally tally = {0};
    const int scenes = testing_part(SCENES, 15);
    FILE *pipe = run_ours(&child, scenes);
    assert_non_null(pipe);
    assert_true(image_open(&ours, SIZE, SIZE, IMAGE_BYTE, NULL));
    assert_true(image_open(&theirs, SIZE, SIZE, IMAGE_BYTE, NULL));
    assert_true(image_open(&sides, SIZE, SIZE, IMAGE_BYTE, NULL));
    int i = 0;
    for (; i < scenes && fread(ours.pixels, image_row_size(&ours), SIZE, pipe) == SIZE; i++) {
        make_world(&world, (uint64_t)i);
        fixed_function_draw(&world.scene, &theirs);
        fixed_function_draw_sides(&world.scene, &sides);
        const int apart = compare(&ours, &theirs, &sides, &tally);
        if (apart == 0)
            continue;
        const char *name = formatted("fixed-function-%d", i);
        printf("scene %d: %d pixels more than one level apart\n", i, apart);
        if (wrong++ < 5)
            picture_check_keep(name, &ours, &theirs);
    }
    fclose(pipe);
    assert_int_equal(waitpid(child, &status, 0), child);
    image_close(&ours);
    image_close(&theirs);
    image_close(&sides);
    printf("%d scenes, %lld inner pixels, %lld pixels one level apart, %lld of %lld edge pixels "
           "more\n",
           i, tally.inner, tally.differing, tally.edges_apart, tally.edges);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    assert_int_equal(i, scenes);
    assert_int_equal(wrong, 0);
    /* The comparison is meaningful: objects cover a tenth of the pictures. */
    assert_true(tally.inner > (long long)scenes * SIZE * SIZE / 10);
    /* Only rounding moves an edge across a pixel's center: matrices in float move it by about 1e-5
     * of a pixel, and rasterizers snap to 1/256. Measured: 1 in 10000. */
    assert_true(tally.edges_apart * 2000 <= tally.edges);
}

int main(int argc, char **argv)
{
    Message message = {0};
    if (argc == 4 && strcmp(argv[1], "--ours") == 0)
        return main_ours(argv[2], argv[3]);
    if (!fixed_function_open(SIZE, SIZE, &message)) {
        printf("fixed function: skipped, %s\n", message.text);
        return EXIT_SKIPPED;
    }
    seed = testing_seed(20240611);
    const int failed = testing_run(0, "fixed function", NULL, NULL);
    random_meshes_close(&meshes);
    fixed_function_close();
    return failed;
}
