/*
 * Right pictures, by someone else's code: random scenes drawn by common/lighting and by real OpenGL
 * 1.1 lighting. The two need GL libraries that must not meet in one process: this program runs
 * itself again for our side (--ours SEED COUNT), which writes its pixels to a pipe.
 */
#include "canvas.h"
#include "fixed_function_osmesa.h"
#include "lighting.h"
#include "picture_check.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cmocka.h>

enum { SIZE = 96, SCENES = 200, MOST_OBJECTS = 3, MOST_LIGHTS = 8, SHAPES = 6 };

/* Random scenes. */

static uint64_t random_state;

/* splitmix64: the same numbers everywhere. */
static uint64_t next_random(void)
{
    uint64_t z = random_state += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
}

static double uniform(double least, double most)
{
    return least + (most - least) * (double)(next_random() >> 11) * 0x1p-53;
}

static bool chance(double probability)
{
    return uniform(0, 1) < probability;
}

static Vec3 random_vector(double least, double most)
{
    const double x = uniform(least, most), y = uniform(least, most), z = uniform(least, most);
    return (Vec3){x, y, z};
}

/* Black with some probability: black colours are left out of our programs. */
static Vec3 random_color(double most)
{
    return chance(0.2) ? (Vec3){0, 0, 0} : random_vector(0, most);
}

typedef struct World {
    Light lights[MOST_LIGHTS];
    Object objects[MOST_OBJECTS];
    Scene scene;
} World;

static Mesh shapes[SHAPES];
static const bool SHAPE_FLAT[SHAPES] = {[1] = true, [5] = true};
static const bool SHAPE_OPEN[SHAPES] = {[2] = true, [3] = true};

/* All convex, or open sides of what is: no side of an object hides a part of the same side, so that
 * silhouettes can be told from sides. */
static void open_shapes(void)
{
    Message message = {0};
    if (!mesh_sphere(&shapes[0], 1, 24, 16, &message) || !mesh_cube(&shapes[1], 0.8, &message) ||
        !mesh_cylinder(&shapes[2], 0.8, 1.2, 20, 6, MESH_CAP_NONE, &message) ||
        !mesh_quad(&shapes[3], 8, &message) || !mesh_cone(&shapes[4], 1, 1.5, 24, 8, &message) ||
        !mesh_icosahedron(&shapes[5], 1, &message)) {
        fprintf(stderr, "%s\n", message.text);
        exit(1);
    }
}

static void close_shapes(void)
{
    for (int i = 0; i < SHAPES; i++)
        mesh_close(&shapes[i]);
}

static Material random_material(void)
{
    const Vec3 ambient = random_color(0.5), diffuse = random_color(1), specular = random_color(1);
    const Vec3 emission = chance(0.3) ? random_vector(0, 0.3) : (Vec3){0, 0, 0};
    const double alpha = chance(0.3) ? uniform(0, 1) : 1;
    /* Not 0: for 0 to the power of 0, behind the highlight, Mesa has 0; we have 1, as for any other
     * number to the power of 0. */
    const double shininess = pow(2, uniform(-3, 7));
    return (Material){ambient, diffuse, specular, emission, alpha, shininess};
}

static Object random_object(void)
{
    const int shape = (int)(next_random() % SHAPES);
    const bool even = chance(0.4), rigid = even && chance(0.5), mirrored = chance(0.2);
    const double size = uniform(0.5, 1);
    Vec3 scale = even ? (Vec3){size, size, size} : random_vector(0.4, 1.3);
    Mat4 turn;
    if (rigid)
        scale = (Vec3){1, 1, 1};
    if (mirrored)
        scale.y = -scale.y;
    mat4_rotate(uniform(0, 360), random_vector(-1, 1), &turn);
    Mat4 matrix = mat4_product(turn, mat4_scale(scale));
    if (chance(0.2)) { /* scaled after turning: sheared */
        mat4_rotate(uniform(0, 360), random_vector(-1, 1), &turn);
        matrix = mat4_product(mat4_scale(random_vector(0.6, 1.2)), mat4_product(turn, matrix));
    }
    matrix = mat4_product(mat4_translate(random_vector(-1.2, 1.2)), matrix);
    const Material front = random_material(), back = random_material();
    return (Object){.mesh = &shapes[shape],
                    .flat = SHAPE_FLAT[shape],
                    .closed = !SHAPE_OPEN[shape],
                    .world_from_object = matrix,
                    .front = front,
                    .two_sided = chance(0.5),
                    .back = back};
}

static Light random_light(double most)
{
    Light light = {.off = chance(0.1),
                   .kind = (LightKind)(next_random() % 3),
                   .position = random_vector(-4, 4),
                   .direction = random_vector(-1, 1)};
    light.ambient = random_color(most / 2);
    light.diffuse = random_color(most);
    light.specular = random_color(most);
    if (light.kind == LIGHT_SPOT) {
        /* Towards the scene, more or less. */
        light.direction = vec3_subtract(random_vector(-1, 1), light.position);
        light.cutoff = chance(0.1) ? 90 : uniform(5, 60);
        light.exponent = chance(0.3) ? 0 : pow(2, uniform(-1, 7));
    }
    if (chance(0.5)) {
        light.constant = chance(0.3) ? 0 : uniform(0.5, 2);
        light.linear = chance(0.5) ? 0 : uniform(0.05, 0.5);
        light.quadratic = chance(0.5) ? 0 : uniform(0.05, 0.3);
    }
    return light;
}

/* Whether a vertex lies where rounding decides if the cone holds it: that would change whole
 * triangles. */
static bool grazes_a_vertex(const Light *light, const Scene *scene)
{
    Vec3 axis, way;
    vec3_normalize(light->direction, &axis);
    const double edge = cos(light->cutoff * 0.017453292519943295);
    for (int i = 0; i < scene->object_count; i++) {
        const Mesh *mesh = scene->objects[i].mesh;
        for (size_t k = 0; k < mesh->vertex_count; k++) {
            const float *p = mesh->vertices[k].position;
            const Vec3 point = {(double)p[0], (double)p[1], (double)p[2]};
            const Vec3 place = mat4_transform_point(scene->objects[i].world_from_object, point);
            vec3_normalize(vec3_subtract(place, light->position), &way);
            /* A float cosine from distances below 10 has an error below 1e-6. */
            if (fabs(vec3_dot(way, axis) - edge) < 1e-5)
                return true;
        }
    }
    return false;
}

static void random_world(World *world)
{
    memset(world, 0, sizeof *world);
    Scene *scene = &world->scene;
    scene->object_count = 1 + (int)(next_random() % MOST_OBJECTS);
    scene->light_count = 1 + (int)(next_random() % MOST_LIGHTS);
    scene->objects = world->objects;
    scene->lights = world->lights;
    scene->interpolation = INTERPOLATION_GOURAUD;
    scene->clamp_vertex = true;
    scene->distant_viewer = chance(0.5);
    scene->global_ambient = random_color(0.3);
    scene->background = random_vector(0, 1);
    scene->camera = (Camera){.eye = {0, 0, uniform(5, 7)},
                             .center = random_vector(-0.3, 0.3),
                             .up = {uniform(-0.5, 0.5), 1, 0},
                             .fovy = uniform(30, 45),
                             .near = 0.5,
                             .far = 30};
    for (int i = 0; i < scene->object_count; i++)
        world->objects[i] = random_object();
    /* Bright enough to be clamped in places, and not everywhere. */
    for (int i = 0; i < scene->light_count; i++) {
        do
            world->lights[i] = random_light(0.5 + 2.0 / scene->light_count);
        while (world->lights[i].kind == LIGHT_SPOT && grazes_a_vertex(&world->lights[i], scene));
    }
}

/* Our side. */

static bool draw_ours(int count, Message *message)
{
    Canvas canvas;
    Lighting *lighting;
    Image picture;
    World world;
    if (!canvas_open(&canvas, &(CanvasOptions){.width = SIZE, .height = SIZE}, message) ||
        !lighting_open(&lighting, &(ShaderLoader){0}, message) ||
        !image_open(&picture, SIZE, SIZE, IMAGE_BYTE, message))
        return false;
    for (int i = 0; i < count; i++) {
        random_world(&world);
        canvas_clear(&canvas, world.scene.background, 1);
        if (!scene_check(&world.scene, message) ||
            !lighting_draw(lighting, &world.scene, 1, false, message) ||
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

static int main_ours(const char *seed, const char *count)
{
    Message message = {0};
    random_state = strtoull(seed, NULL, 10);
    open_shapes();
    const bool done = draw_ours(atoi(count), &message);
    close_shapes();
    if (!done)
        fprintf(stderr, "fixed function: our side: %s\n", message.text);
    return done ? 0 : 1;
}

/* Their side, and the comparison. */

static uint64_t seed;

static FILE *run_ours(pid_t *child)
{
    int ends[2];
    char seed_text[24], count_text[12];
    snprintf(seed_text, sizeof seed_text, "%llu", (unsigned long long)seed);
    snprintf(count_text, sizeof count_text, "%d", SCENES);
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

/* Whether the 3x3 pixels around this one are not all of one side of one object: where matrices
 * multiplied in float put an edge on the other side of a pixel's centre. */
static bool at_edge(const Image *sides, int x, int y)
{
    for (int v = y - 1; v <= y + 1; v++)
        for (int u = x - 1; u <= x + 1; u++)
            if (u >= 0 && u < SIZE && v >= 0 && v < SIZE &&
                pixel(sides, u, v)[0] != pixel(sides, x, y)[0])
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
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            int most = 0;
            for (int c = 0; c < 4; c++) {
                const int levels = abs(pixel(ours, x, y)[c] - pixel(theirs, x, y)[c]);
                most = levels > most ? levels : most;
            }
            const bool edge = at_edge(sides, x, y);
            tally->differing += most == 1;
            tally->edges += edge;
            tally->edges_apart += edge && most > 1;
            tally->inner += !edge && pixel(sides, x, y)[0] != 0;
            apart += !edge && most > 1;
        }
    }
    return apart;
}

static void every_scene_is_drawn_as_opengl_1_1_draws_it(void **state)
{
    pid_t child;
    int status, wrong = 0;
    Image ours, theirs, sides;
    World world;
    Tally tally = {0};
    (void)state;
    FILE *pipe = run_ours(&child);
    assert_non_null(pipe);
    assert_true(image_open(&ours, SIZE, SIZE, IMAGE_BYTE, NULL));
    assert_true(image_open(&theirs, SIZE, SIZE, IMAGE_BYTE, NULL));
    assert_true(image_open(&sides, SIZE, SIZE, IMAGE_BYTE, NULL));
    random_state = seed;
    int i = 0;
    for (; i < SCENES && fread(ours.pixels, image_row_size(&ours), SIZE, pipe) == SIZE; i++) {
        random_world(&world);
        fixed_function_draw(&world.scene, &theirs);
        fixed_function_draw_sides(&world.scene, &sides);
        const int apart = compare(&ours, &theirs, &sides, &tally);
        if (apart == 0)
            continue;
        char name[32];
        snprintf(name, sizeof name, "fixed-function-%d", i);
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
    assert_int_equal(i, SCENES);
    assert_int_equal(wrong, 0);
    /* The comparison means something: a tenth of the pictures is objects. */
    assert_true(tally.inner > (long long)SCENES * SIZE * SIZE / 10);
    /* An edge falls on the other side of a pixel's centre only within rounding of it: matrices in
     * float move it by some 1e-5 of a pixel, and rasterizers snap to 1/256. Measured: 1 in 10000.
     */
    assert_true(tally.edges_apart * 2000 <= tally.edges);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_scene_is_drawn_as_opengl_1_1_draws_it),
    };
    Message message = {0};
    if (argc == 4 && strcmp(argv[1], "--ours") == 0)
        return main_ours(argv[2], argv[3]);
    if (!fixed_function_open(SIZE, SIZE, &message)) {
        printf("fixed function: skipped, %s\n", message.text);
        return EXIT_SKIPPED;
    }
    const char *given = getenv("LIGHTING_TEST_SEED");
    seed = given ? strtoull(given, NULL, 10) : 20240611;
    printf("LIGHTING_TEST_SEED=%llu\n", (unsigned long long)seed);
    open_shapes();
    const int failed = cmocka_run_group_tests_name("fixed function", tests, NULL, NULL);
    close_shapes();
    fixed_function_close();
    return failed;
}
