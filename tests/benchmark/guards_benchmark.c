/*
 * The cost of guards: the guarded program relative to one without a certain guard, and to one
 * without any, as full program and for scenes; next to it the guarded program relative to itself
 * (A/A).
 */
#include "benchmark/bench.h"
#include "core/canvas.h"
#include "lighting/lighting.h"

#include <stdio.h>

enum { SIZE = 400, ROUNDS = 41, FRAMES = 2 };

typedef struct Guard {
    const char *name;
    ShaderReplacement replaced[2];
} Guard;

#define WITHOUT(name)                                                                              \
    {                                                                                              \
        {"lighting/guards.glsl", "study/unguarded" name ".glsl"},                                  \
        {                                                                                          \
            NULL, NULL                                                                             \
        }                                                                                          \
    }

/* The first and the second are both guarded. */
static const Guard GUARDS[] = {
    {"all guards, again (A/A)", {{NULL, NULL}, {NULL, NULL}}},
    {"the length of a vector", WITHOUT("_normalize")},
    {"the distance of a light", WITHOUT("_inversesqrt")},
    {"attenuation", WITHOUT("_inverse")},
    {"pow", WITHOUT("_pow")},
    {"no highlight behind", WITHOUT("_facing")},
    {"all of these", WITHOUT("")},
};
enum { GUARD_COUNT = sizeof GUARDS / sizeof GUARDS[0] };

/* Scenes. */

typedef struct World {
    const char *name;
    bool full;
    Light lights[2];
    Object object;
    Scene scene;
} World;

enum { FULL, TOUCHING, OUTSIDE, LECTURE, WORLDS };

static World worlds[WORLDS];
static Mesh sphere;

static void make_worlds(void)
{
    const World begin = {
        .lights = {{.kind = LIGHT_SPOT,
                    .position = {1, 2, 3},
                    .direction = {-1, -2, -3},
                    .ambient = {0.2, 0.2, 0.2},
                    .diffuse = {0.6, 0.6, 0.6},
                    .specular = {0.5, 0.5, 0.5},
                    .cutoff = 60,
                    .exponent = 2,
                    .linear = 0.3,
                    .quadratic = 0.05},
                   {.kind = LIGHT_POINT,
                    .position = {-1, 1, 3},
                    .diffuse = {0.3, 0.3, 0.3},
                    .specular = {0.3, 0.3, 0.3}}},
        .object = {.mesh = &sphere,
                   .world_from_object = mat4_scale((Vec3){1, 0.9, 1.1}),
                   .closed = true,
                   .front = {.ambient = {0.6, 0.4, 0.3},
                             .diffuse = {0.6, 0.4, 0.3},
                             .specular = {0.5, 0.5, 0.5},
                             .shininess = 30,
                             .alpha = 1}},
        .scene = {.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 30, 1, 20, 0},
                  .light_count = 2,
                  .object_count = 1},
    };
    for (int i = 0; i < WORLDS; i++)
        worlds[i] = begin;
    worlds[FULL].name = "the full program";
    worlds[FULL].full = true;
    worlds[TOUCHING].name = "lights within the object's box";
    worlds[TOUCHING].lights[0].position = (Vec3){0.7, 0.7, 0.8};
    worlds[TOUCHING].lights[1].position = (Vec3){-0.7, 0.7, 0.8};
    worlds[OUTSIDE].name = "the same, lights outside";
    worlds[LECTURE].name = "one diffuse point light";
    worlds[LECTURE].scene.light_count = 1;
    worlds[LECTURE].lights[0] =
        (Light){.kind = LIGHT_POINT, .position = {2.3, 4, 3.5}, .diffuse = {1, 1, 1}};
    for (int i = 0; i < WORLDS; i++) {
        worlds[i].scene.lights = worlds[i].lights;
        worlds[i].scene.objects = &worlds[i].object;
    }
}

/* What is timed. */

typedef struct Run {
    Lighting *lighting;
    const World *world;
} Run;

static bool render(const Run *run, Message *message)
{
    canvas_clear(&bench_canvas, (Vec3){0, 0, 0}, 1);
    if (!lighting_show(
            run->lighting,
            &(LightingFrame){.scene = &run->world->scene, .aspect = 1, .full = run->world->full},
            message))
        return false;
    glFinish();
    return true;
}

static bool draw_frames(void *argument, Message *message)
{
    bool done = true;
    for (int i = 0; i < FRAMES && done; i++)
        done = render(argument, message);
    return done;
}

static bool measure_world(const World *world, Lighting *const lightings[GUARD_COUNT + 1],
                          Message *message)
{
    static const BenchColumn time = {BENCH_MEDIAN(0, 1e3 / FRAMES, 2)};
    Run drawn[GUARD_COUNT + 1];
    BenchRun runs[GUARD_COUNT + 1];
    Table table;
    char title[160];
    for (int i = 0; i <= GUARD_COUNT; i++) {
        drawn[i] = (Run){lightings[i], world};
        runs[i] = (BenchRun){world->name, draw_frames, &drawn[i], NULL, 0};
    }
    const bool done = bench_rounds(runs, GUARD_COUNT + 1, ROUNDS, message);
    if (done) {
        snprintf(title, sizeof title, "%s: %s ms a frame", world->name,
                 bench_cell(runs, &time).text);
        table_open(&table, "without|guarded over that");
        for (int i = 0; i < GUARD_COUNT; i++)
            bench_row(&table, runs, &(BenchColumn){BENCH_RATIO(0, i + 1, 3)}, 1, "%s",
                      GUARDS[i].name);
        bench_print(title, &table);
    }
    bench_finish(runs, GUARD_COUNT + 1);
    return done;
}

static Lighting *lightings[GUARD_COUNT + 1];

static bool run(Message *message)
{
    make_worlds();
    printf("A guarded frame's time over that without:\n");
    bool done = mesh_sphere(&sphere, 1, 64, 32, message);
    for (int i = 0; i <= GUARD_COUNT && done; i++) {
        ShaderLoader loader = {.folder = NULL};
        if (i > 0 && GUARDS[i - 1].replaced[0].name)
            loader.replacements = GUARDS[i - 1].replaced;
        done = lighting_open(&lightings[i], &loader, message);
    }
    for (int i = 0; i < WORLDS && done; i++)
        done = measure_world(&worlds[i], lightings, message);
    return done;
}

static void finish(void)
{
    for (int i = 0; i <= GUARD_COUNT; i++)
        lighting_close(lightings[i]);
    mesh_close(&sphere);
}

const Bench BENCH = {.name = "guards_benchmark",
                     .width = SIZE,
                     .height = SIZE,
                     .one_thread = true,
                     .run = run,
                     .close = finish};
