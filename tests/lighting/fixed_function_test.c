/*
 * Random scenes drawn by common/lighting and by OpenGL 1.1 fixed-function lighting. The two GL
 * libraries conflict within a process, so the program runs itself again for our side (--ours SEED
 * COUNT), which writes its pixels to a pipe.
 */
#include "base/random.h"
#include "core/canvas.h"
#include "core/mesh_make.h"
#include "lighting/lighting.h"
#include "lighting/fixed_function_osmesa.h"
#include "shapes/mesh_solids.h"
#include "support/picture_check.h"
#include "support/testing.h"

#include <sys/wait.h>
#include <unistd.h>

enum { SIZE = 96, SCENES = 200, MAX_OBJECTS = 3, MAX_LIGHTS = 8, SHAPES = 6 };

/* Random scenes. */

static Random random_state;

static double uniform(double min, double max)
{
    return random_between(&random_state, min, max);
}

static int below(int limit)
{
    return random_below(&random_state, limit);
}

static bool chance(double probability)
{
    return uniform(0, 1) < probability;
}

static Vec3 random_vector(double min, double max)
{
    const double x = uniform(min, max), y = uniform(min, max), z = uniform(min, max);
    return (Vec3){x, y, z};
}

/* Black with some probability, because our programs leave out black colors. */
static Vec3 random_color(double max)
{
    return chance(0.2) ? (Vec3){0, 0, 0} : random_vector(0, max);
}

typedef struct World {
    Light lights[MAX_LIGHTS];
    Object objects[MAX_OBJECTS];
    Scene scene;
} World;

static Mesh shapes[SHAPES], colored[SHAPES]; /* the same with colors */
static const bool SHAPE_FLAT[SHAPES] = {[1] = true, [5] = true};
static const bool SHAPE_OPEN[SHAPES] = {[2] = true, [3] = true};

/* All are convex, or open sides of convex solids: no part of a side hides another part of the same
 * side, so that silhouettes can be told from sides. */
static void open_shapes(void)
{
    Message message = {0};
    if (!mesh_sphere(&shapes[0], 1, 24, 16, &message) || !mesh_cube(&shapes[1], 0.8, &message) ||
        !mesh_cylinder(&shapes[2], (MeshCylinder){0.8, 1.2, 20, 6, MESH_CAP_NONE}, &message) ||
        !mesh_quad(&shapes[3], 8, &message) || !mesh_cone(&shapes[4], 1, 1.5, 24, 8, &message) ||
        !mesh_regular(&shapes[5], MESH_ICOSAHEDRON, 1, &message)) {
        fprintf(stderr, "%s\n", message.text);
        exit(1);
    }
    Random random = {1};
    for (int i = 0; i < SHAPES; i++) {
        Mesh *mesh = &colored[i];
        if (!mesh_copy(mesh, &shapes[i], NULL) || !mesh_open_colors(mesh, NULL))
            exit(1);
        for (size_t k = 0; k < 3 * mesh->vertex_count; k++) /* 0 and 1 too */
            mesh->colors[k / 3][k % 3] =
                (float)fmin(fmax(random_between(&random, -0.2, 1.2), 0), 1);
    }
}

static void close_shapes(void)
{
    for (int i = 0; i < SHAPES; i++) {
        mesh_close(&shapes[i]);
        mesh_close(&colored[i]);
    }
}

static Material random_material(void)
{
    const Vec3 ambient = random_color(0.5), diffuse = random_color(1), specular = random_color(1);
    const Vec3 emission = chance(0.3) ? random_vector(0, 0.3) : (Vec3){0, 0, 0};
    const double alpha = chance(0.3) ? uniform(0, 1) : 1;
    /* Not 0: for 0 to the power of 0, behind the highlight, Mesa computes 0; ours is 1, as for any
     * other number to the power of 0. */
    const double shininess = pow(2, uniform(-3, 7));
    return (Material){ambient, diffuse, specular, emission, alpha, shininess};
}

static Object random_object(void)
{
    const int shape = below(SHAPES);
    const bool even = chance(0.4), rigid = even && chance(0.5), mirrored = chance(0.2);
    const double size = uniform(0.5, 1);
    Vec3 scale = even ? (Vec3){size, size, size} : random_vector(0.4, 1.3);
    if (rigid)
        scale = (Vec3){1, 1, 1};
    if (mirrored)
        scale.y = -scale.y;
    Mat4 turn = mat4_rotate(uniform(0, 360), random_vector(-1, 1));
    Mat4 matrix = mat4_product(turn, mat4_scale(scale));
    if (chance(0.2)) { /* scaled after turning: sheared */
        turn = mat4_rotate(uniform(0, 360), random_vector(-1, 1));
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

static Light random_light(double max)
{
    Light light = {.off = chance(0.1),
                   .kind = (LightKind)below(3),
                   .position = random_vector(-4, 4),
                   .direction = random_vector(-1, 1)};
    light.ambient = random_color(max / 2);
    light.diffuse = random_color(max);
    light.specular = random_color(max);
    if (light.kind == LIGHT_SPOT) {
        /* Roughly towards the scene. */
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

/* Whether rounding decides if a vertex is in the cone, which would change whole triangles. */
static bool grazes_a_vertex(int number, const Scene *scene)
{
    Vec3 axis, way;
    const Light own = scene_world_light(scene, number), *light = &own;
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

/* What this scene has of GL_FLAT, the viewer's lights, colors of vertices, clockwise front faces
 * and polygon offset. */
static void vary_object(Random *random, Object *object, bool alone)
{
    if (random_below(random, 3) == 0) {
        object->mesh = &colored[object->mesh - shapes];
        object->back.alpha = object->front.alpha; /* of the color, in OpenGL */
    }
    object->clockwise = random_below(random, 4) == 0;
    object->behind_lines =
        alone && object->closed && !object->clockwise && random_below(random, 2) == 0;
}

static Light vary_light(Random *random, Light light)
{
    if (random_below(random, 3) == 0) {
        light.space = LIGHT_EYE;
        light.position.z -= 6; /* about as far from the scene as in world coordinates */
    }
    return light;
}

static void random_world(World *world)
{
    Random more = {random_state.state ^ 0x5DEECE66D};
    memset(world, 0, sizeof *world);
    Scene *scene = &world->scene;
    scene->object_count = 1 + below(MAX_OBJECTS);
    scene->light_count = 1 + below(MAX_LIGHTS);
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
    if (random_below(&more, 3) == 0)
        scene->interpolation = INTERPOLATION_CONSTANT;
    for (int i = 0; i < scene->object_count; i++) {
        world->objects[i] = random_object();
        vary_object(&more, &world->objects[i], scene->object_count == 1);
    }
    /* Bright enough to be clamped in places, and not everywhere. */
    for (int i = 0; i < scene->light_count; i++) {
        do
            world->lights[i] = vary_light(&more, random_light(0.5 + 2.0 / scene->light_count));
        while (world->lights[i].kind == LIGHT_SPOT && grazes_a_vertex(i, scene));
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

static int main_ours(const char *seed, const char *count)
{
    Message message = {0};
    random_state.state = strtoull(seed, NULL, 10);
    open_shapes();
    const bool done = draw_ours(atoi(count), &message);
    close_shapes();
    if (!done)
        fprintf(stderr, "fixed function: our side: %s\n", message.text);
    return done ? 0 : 1;
}

/* Their side, and the comparison. */

static uint64_t seed;

static FILE *run_ours(pid_t *child, int scenes)
{
    int ends[2];
    char seed_text[24], count_text[12];
    snprintf(seed_text, sizeof seed_text, "%llu", (unsigned long long)seed);
    snprintf(count_text, sizeof count_text, "%d", scenes);
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
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            int max = 0;
            for (int c = 0; c < 4; c++) {
                const int levels = abs(pixel(ours, x, y)[c] - pixel(theirs, x, y)[c]);
                max = levels > max ? levels : max;
            }
            const bool edge = at_edge(sides, x, y);
            tally->differing += max == 1;
            tally->edges += edge;
            tally->edges_apart += edge && max > 1;
            tally->inner += !edge && pixel(sides, x, y)[0] != 0;
            apart += !edge && max > 1;
        }
    }
    return apart;
}

TEST(every_scene_is_drawn_as_opengl_1_1_draws_it)
{
    pid_t child;
    int status, wrong = 0;
    Image ours, theirs, sides;
    World world;
    Tally tally = {0};
    const int scenes = testing_part(SCENES, 15);
    FILE *pipe = run_ours(&child, scenes);
    assert_non_null(pipe);
    assert_true(image_open(&ours, SIZE, SIZE, IMAGE_BYTE, NULL));
    assert_true(image_open(&theirs, SIZE, SIZE, IMAGE_BYTE, NULL));
    assert_true(image_open(&sides, SIZE, SIZE, IMAGE_BYTE, NULL));
    random_state.state = seed;
    int i = 0;
    for (; i < scenes && fread(ours.pixels, image_row_size(&ours), SIZE, pipe) == SIZE; i++) {
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
    open_shapes();
    const int failed = testing_run(0, "fixed function", NULL, NULL);
    close_shapes();
    fixed_function_close();
    return failed;
}
