/*
 * What shadows cost: a teapot over a floor in the light of one and of three lights, and the scene
 * of Shadows, each without shadows, without again, and in each way. How exact they are:
 * examples/study/report/conclusions.h.
 */
#include "benchmark/bench.h"
#include "core/canvas.h"
#include "core/example.h"
#include "lighting/lighting.h"
#include "scene/scene_example.h"
#include "shapes/mesh_solids.h"

#include <stdio.h>

enum { SIZE = 400, ROUNDS = 21, FRAMES = 4, SCENES = 5, SMALL_MAP = 512 };

/* The first two are without shadows. */
enum { WITHOUT, AGAIN, VOLUMES, MAP, MOVING_MAP, WAYS };

extern const Example Shadows;

/* Those that draw maps anew are apart: they would take the maps of those that rest. */
static Lighting *resting, *moving;
static Mesh teapot, plane, ball;

typedef struct Way {
    ShadowSettings shadows;
    bool moving; /* the lights */
    Light lights[3];
    Scene scene;
} Way;

typedef struct Setting {
    const char *name;
    Object objects[2];
    Way ways[WAYS];
} Setting;
static Setting settings[SCENES];

static void set_ways(Setting *setting)
{
    static const int ways[WAYS] = {SHADOWS_OFF, SHADOWS_OFF, SHADOWS_VOLUMES, SHADOWS_MAP,
                                   SHADOWS_MAP};
    for (int w = 0; w < WAYS; w++) {
        Way *way = &setting->ways[w];
        way->shadows = SHADOWS_DEFAULT;
        way->shadows.way = ways[w];
        way->shadows.map_size = SMALL_MAP;
        way->moving = w == MOVING_MAP;
        for (int i = 0; i < way->scene.light_count; i++)
            way->lights[i].shadows = ways[w] != SHADOWS_OFF;
        way->scene.lights = way->lights;
    }
}

static void make_setting(Setting *setting, const char *name, const Mesh *mesh, int lights,
                         LightKind kind)
{
    const Mat4 lying = mat4_rotate(-90, (Vec3){1, 0, 0}), large = mat4_scale((Vec3){3, 3, 3});
    const Material grey = {{0.3, 0.3, 0.3}, {0.4, 0.4, 0.4}, {0.3, 0.3, 0.3}, {0, 0, 0}, 1, 30};
    static const Vec3 places[3] = {{1.5, 3, 2}, {-2, 3, 1}, {0.5, 4, -2}};
    setting->name = name;
    setting->objects[0] = (Object){.mesh = mesh,
                                   .solid = {.kind = mesh == &ball ? SOLID_SPHERE : SOLID_TEAPOT,
                                             .radius = mesh == &ball ? 0.75 : 1},
                                   .closed = mesh == &ball,
                                   .world_from_object = mat4_identity(),
                                   .front = grey};
    setting->objects[1] =
        (Object){.mesh = &plane,
                 .solid = {.kind = SOLID_QUAD},
                 .flat = true,
                 .world_from_object =
                     mat4_product(mat4_translate((Vec3){0, -0.75, 0}), mat4_product(lying, large)),
                 .front = grey};
    for (int way = 0; way < WAYS; way++) {
        for (int i = 0; i < lights; i++)
            setting->ways[way].lights[i] = (Light){.kind = kind,
                                                   .position = places[i],
                                                   .direction = places[i],
                                                   .diffuse = {0.4, 0.4, 0.4},
                                                   .specular = {0.3, 0.3, 0.3}};
        setting->ways[way].scene =
            (Scene){.camera = {{0, 2.5, 5.5}, {0, 0, 0}, {0, 1, 0}, 40, 1, 30, 0},
                    .light_count = lights,
                    .objects = setting->objects,
                    .object_count = 2};
    }
    set_ways(setting);
}

static bool draw(void *argument, Message *message)
{
    Way *way = argument;
    const Scene *scene = &way->scene;
    Lighting *lighting = way->moving ? moving : resting;
    lighting_use_shadows(lighting, &way->shadows);
    for (int i = 0; i < FRAMES; i++) {
        for (int l = 0; l < scene->light_count && way->moving; l++) {
            way->lights[l].position.x += 1e-9;
            way->lights[l].direction.x += 1e-9;
        }
        canvas_clear(&bench_canvas, scene->background, 1);
        if (!lighting_show(lighting, &(LightingFrame){.scene = scene, .aspect = 1}, message))
            return false;
    }
    glFinish();
    return true;
}

static bool measure_setting(Setting *setting, Table *table, Message *message)
{
    static const BenchColumn columns[] = {{BENCH_TIME(WITHOUT, 1e3 / FRAMES, 2)},
                                          {BENCH_RATIO(AGAIN, WITHOUT, 2)},
                                          {BENCH_RATIO(VOLUMES, WITHOUT, 2)},
                                          {BENCH_RATIO(MAP, WITHOUT, 2)},
                                          {BENCH_RATIO(MOVING_MAP, WITHOUT, 2)}};
    BenchRun runs[WAYS];
    for (int way = 0; way < WAYS; way++)
        runs[way] = (BenchRun){setting->name, draw, &setting->ways[way], NULL, 0};
    const LightingCounts before = lighting_counts(resting);
    bool done = draw(&setting->ways[VOLUMES], message);
    const LightingCounts after = lighting_counts(resting);
    done = done && bench_rounds(runs, WAYS, ROUNDS, message);
    if (done) {
        char cells[WAYS][48];
        for (int way = 0; way < WAYS; way++)
            snprintf(cells[way], sizeof cells[way], "%s", bench_cell(runs, &columns[way]).text);
        table_row(table, "%s|%s|%s|%s|%s|%s|%lld", setting->name, cells[0], cells[1], cells[2],
                  cells[3], cells[4], (after.volume_triangles - before.volume_triangles) / FRAMES);
    }
    bench_finish(runs, WAYS);
    return done;
}

static bool measure_all(Message *message)
{
    Table table;
    bool done = true;
    make_setting(&settings[0], "a teapot over a floor, directional light", &teapot, 1,
                 LIGHT_DIRECTIONAL);
    make_setting(&settings[1], "the same, a point light", &teapot, 1, LIGHT_POINT);
    make_setting(&settings[2], "the same, three point lights", &teapot, 3, LIGHT_POINT);
    make_setting(&settings[3], "a sphere over a floor, a point light", &ball, 1, LIGHT_POINT);
    /* The scene of the program, whose lights have shadows. */
    settings[4].name = "Shadows";
    for (int way = 0; way < WAYS; way++) {
        Scene *scene = &settings[4].ways[way].scene;
        example_scene(&Shadows)->make(0, 0, scene);
        for (int i = 0; i < scene->light_count; i++)
            settings[4].ways[way].lights[i] = scene->lights[i];
    }
    set_ways(&settings[4]);
    table_open(&table, "|without shadows, ms|again, over that|volumes|map:512|map:512, lights "
                       "move|triangles of volumes");
    for (int i = 0; i < SCENES; i++)
        done = done && measure_setting(&settings[i], &table, message);
    bench_print("shadows", &table);
    return done;
}

static bool run(Message *message)
{
    return lighting_open(&resting, &(ShaderLoader){0}, message) &&
           lighting_open(&moving, &(ShaderLoader){0}, message) &&
           mesh_teapot(&teapot, 1, 10, message) && mesh_quad(&plane, 1, message) &&
           mesh_sphere(&ball, 0.75, 48, 24, message) && Shadows.init(&(ShaderLoader){0}, message) &&
           measure_all(message);
}

static void finish(void)
{
    Shadows.finish();
    lighting_close(resting);
    lighting_close(moving);
    mesh_close(&teapot);
    mesh_close(&plane);
    mesh_close(&ball);
}

const Bench BENCH = {
    .name = "shadows_benchmark", .width = SIZE, .height = SIZE, .run = run, .close = finish};
