/*
 * The effect of rounding to double on the exact picture: the same source compiled with 113-bit
 * numbers, compared with the one that programs use. No GL.
 */
#include "reference/reference_trace.h"
#include "shapes/mesh_solids.h"
#include "support/testing.h"

/* The names of reference_trace.h if REFERENCE_QUAD is defined. */
bool quad_trace_open(Trace **trace, const Scene *scene, const ReferenceOptions *options,
                     Message *message);
void quad_trace_sample(const Trace *trace, double x, double y, Sample *sample);
void quad_trace_close(Trace *trace);

enum { SIZE = 256, SCENES = 8, POINTS = 250 };
static const long SEED = 20;

static double uniform(double min, double max)
{
    return min + (max - min) * drand48();
}

static Vec3 vector(double min, double max)
{
    return (Vec3){uniform(min, max), uniform(min, max), uniform(min, max)};
}

static Material material(void)
{
    return (Material){vector(0, 1), vector(0, 1), vector(0, 1), vector(0, 0.2), 1, uniform(0, 60)};
}

typedef struct World {
    Mesh mesh;
    Object object;
    Light lights[3];
    Scene scene;
} World;

/* One solid, rotated and scaled, lit by one source of each kind. */
static void open_world(World *world, Solid solid)
{
    const Vec3 place = vector(-3, 3);
    assert_true(solid_mesh(&solid, 16, &world->mesh, NULL));
    const Mat4 turn = mat4_rotate(uniform(0, 360), vector(-1, 1));
    world->object = (Object){.mesh = &world->mesh,
                             .solid = solid,
                             .flat = solid_flat(&solid),
                             .world_from_object = mat4_product(turn, mat4_scale(vector(0.6, 1.4))),
                             .front = material(),
                             .two_sided = true,
                             .back = material()};
    for (int i = 0; i < 3; i++)
        world->lights[i] = (Light){.kind = (LightKind)i,
                                   .position = place,
                                   .direction = i == LIGHT_SPOT ? vec3_scale(place, -1) : place,
                                   .ambient = vector(0, 0.2),
                                   .diffuse = vector(0, 0.3),
                                   .specular = vector(0, 0.4),
                                   .cutoff = uniform(5, 40),
                                   .exponent = uniform(0, 20),
                                   .constant = 1,
                                   .quadratic = 0.1,
                                   .shadows = true};
    world->scene =
        (Scene){.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 35, 0.5, 20, 0},
                .global_ambient = {0.2, 0.2, 0.2},
                .lights = world->lights,
                .light_count = 3,
                .objects = &world->object,
                .object_count = 1,
                .reflection = drand48() < 0.5 ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG,
                .interpolation = (Interpolation)(lrand48() % 3)};
    assert_true(scene_check(&world->scene, NULL));
}

typedef struct Error {
    double color, depth; /* steps of 1/255; of 1 */
    int points, elsewhere;
} Error;

static void compare(const World *world, bool meshes, Error *error)
{
    const ReferenceOptions options = {
        .width = SIZE, .height = SIZE, .meshes = meshes, .threads = 1};
    Trace *trace, *quad;
    assert_true(trace_open(&trace, &world->scene, &options, NULL));
    assert_true(quad_trace_open(&quad, &world->scene, &options, NULL));
    for (int i = 0; i < POINTS; i++) {
        const double x = uniform(0, SIZE), y = uniform(0, SIZE);
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

TEST(double_is_as_good_as_twice_its_digits)
{
    static const char *const names[] = {"none",     "sphere", "box",   "quad",  "disc",
                                        "cylinder", "cone",   "torus", "teapot"};
    srand48(SEED);
    printf("seed %ld\n", SEED);
    for (SolidKind kind = SOLID_SPHERE; kind <= SOLID_TEAPOT; kind++) {
        for (int meshes = 0; meshes < 2; meshes++) {
            Error error = {0, 0, 0, 0};
            if (kind == SOLID_TEAPOT && !meshes)
                continue; /* many triangles take long, so it has fewer as a mesh */
            for (int i = 0; i < SCENES; i++) {
                World world;
                open_world(&world, (Solid){.kind = kind,
                                           .radius = 1,
                                           .height = 1.2,
                                           .tube = 0.35,
                                           .caps = (MeshCaps)(i % 4)});
                compare(&world, meshes, &error);
                mesh_close(&world.mesh);
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
    }
}

TEST_MAIN("reference quad", NULL, NULL)
