/*
 * The time of the exact picture: solids and the teapot's mesh at the lecture's size, with one
 * thread, and the scene of `Shadows`.
 */
#include "benchmark/bench.h"
#include "reference/reference.h"
#include "scene/scene_example.h"
#include "shapes/mesh_solids.h"

extern const Example Shadows;

enum { SIZE = 400, ROUNDS = 7, CASES = 11, PROGRAM = CASES, ROWS };

typedef struct Case {
    const char *name;
    Solid solid;
    int divisions; /* of its mesh */
    ReferenceOptions options;
    Interpolation interpolation;
    Mesh mesh;
} Case;

#define EXACT(threads_)                                                                            \
    {                                                                                              \
        .width = SIZE, .height = SIZE, .threads = threads_                                         \
    }
#define AS_MESH                                                                                    \
    {                                                                                              \
        .width = SIZE, .height = SIZE, .meshes = true                                              \
    }

static Case cases[CASES] = {
    {"sphere", {.kind = SOLID_SPHERE, .radius = 1}, 24, EXACT(0), 0, {0}},
    {"sphere, one thread", {.kind = SOLID_SPHERE, .radius = 1}, 24, EXACT(1), 0, {0}},
    {"cube", {.kind = SOLID_BOX, .radius = 0.7}, 24, EXACT(0), 0, {0}},
    {"cylinder",
     {.kind = SOLID_CYLINDER, .radius = 0.7, .height = 1, .caps = MESH_CAP_BOTH},
     24,
     EXACT(0),
     0,
     {0}},
    {"cone", {.kind = SOLID_CONE, .radius = 0.8, .height = 1.2}, 24, EXACT(0), 0, {0}},
    {"torus", {.kind = SOLID_TORUS, .radius = 0.8, .tube = 0.3}, 24, EXACT(0), 0, {0}},
    {"teapot, of 262,000 triangles", {.kind = SOLID_TEAPOT, .radius = 0.7}, 36, EXACT(0), 0, {0}},
    {"teapot's mesh, 5,000 triangles", {.kind = SOLID_TEAPOT, .radius = 0.7}, 36, AS_MESH, 0, {0}},
    {"the same, lit at its corners",
     {.kind = SOLID_TEAPOT, .radius = 0.7},
     36,
     AS_MESH,
     INTERPOLATION_GOURAUD,
     {0}},
    {"the same, flat", {.kind = SOLID_TEAPOT, .radius = 0.7}, 36, AS_MESH, INTERPOLATION_FLAT, {0}},
    {"sphere's mesh, 1,100 triangles", {.kind = SOLID_SPHERE, .radius = 1}, 24, AS_MESH, 0, {0}},
};

static bool trace_picture(void *argument, Message *message)
{
    const Case *drawn = argument;
    const Light lights[2] = {
        {.kind = LIGHT_POINT, .position = {3, 3, 2}, .diffuse = {1, 1, 1}, .specular = {1, 1, 1}},
        {.kind = LIGHT_SPOT,
         .position = {-2, 1, 3},
         .direction = {2, -1, -3},
         .cutoff = 12,
         .exponent = 2,
         .diffuse = {0.5, 0.2, 0.2}},
    };
    Object object = {.mesh = &drawn->mesh,
                     .solid = drawn->solid,
                     .flat = solid_flat(&drawn->solid),
                     .front = {.ambient = {0.2, 0.2, 0.2},
                               .diffuse = {0.4, 0.6, 0.8},
                               .specular = {0.6, 0.6, 0.6},
                               .alpha = 1,
                               .shininess = 40}};
    const Scene scene = {.camera = {{0.5, 1, 4}, {0, 0, 0}, {0, 1, 0}, 40, 0.5, 20, 0},
                         .global_ambient = {0.3, 0.3, 0.3},
                         .lights = lights,
                         .light_count = 2,
                         .objects = &object,
                         .object_count = 1,
                         .interpolation = drawn->interpolation};
    Reference reference;
    object.world_from_object =
        mat4_rotate(drawn->solid.kind == SOLID_TEAPOT ? 0 : -60, (Vec3){1, 0.3, 0});
    const bool done = reference_open(&reference, &scene, &drawn->options, message);
    reference_close(&reference);
    return done;
}

static bool trace_program(void *argument, Message *message)
{
    Scene scene = {.object_count = 0};
    Reference reference;
    example_scene(&Shadows)->make(0, 0, &scene);
    const bool done = reference_open(&reference, &scene, argument, message);
    reference_close(&reference);
    return done;
}

static bool run(Message *message)
{
    static const BenchColumn time = {BENCH_TIME(0, 1e3, 1)};
    ReferenceOptions options = EXACT(0);
    BenchRun runs[ROWS] = {
        [PROGRAM] = {"Shadows, with three lights", trace_program, &options, NULL, 0}};
    Table table;
    if (!Shadows.init(&(ShaderLoader){0}, message))
        return false;
    for (int i = 0; i < CASES; i++) {
        if (!solid_mesh(&cases[i].solid, cases[i].divisions, &cases[i].mesh, message))
            return false;
        runs[i] = (BenchRun){cases[i].name, trace_picture, &cases[i], NULL, 0};
    }
    table_open(&table, "the exact picture, 400x400|ms");
    const bool done = bench_rows(&(BenchRows){runs, ROWS, 1, ROUNDS, &time, 1}, &table, message);
    bench_print(NULL, &table);
    bench_finish(runs, ROWS);
    return done;
}

static void finish(void)
{
    Shadows.finish();
    for (int i = 0; i < CASES; i++)
        mesh_close(&cases[i].mesh);
}

const Bench BENCH = {.name = "reference_benchmark", .run = run, .close = finish};
