/*
 * What shadows cost: a teapot over a floor in the light of one and of three lights, and the scene
 * of Shadows, each without shadows, without again, and with volumes.
 */
#include "benchmark/measure.h"
#include "core/canvas.h"
#include "core/example.h"
#include "scene/lighting.h"
#include "scene/scene_example.h"
#include "shapes/mesh_solids.h"

#include <stdio.h>
#include <stdlib.h>

enum { SIZE = 400, ROUNDS = 21, FRAMES = 4, SCENES = 4, WAYS = 3 };

extern const Example Shadows;

static Canvas canvas;
static Lighting *lighting;
static Mesh teapot, plane;

typedef struct Setting {
    const char *name;
    Light lights[WAYS][3]; /* those of one and two have shadows or not */
    Object objects[2];
    Scene scenes[WAYS];
} Setting;
static Setting settings[SCENES];

static void make_setting(Setting *setting, const char *name, int lights, LightKind kind)
{
    const Mat4 lying = mat4_rotate(-90, (Vec3){1, 0, 0}), large = mat4_scale((Vec3){3, 3, 3});
    const Material grey = {{0.3, 0.3, 0.3}, {0.4, 0.4, 0.4}, {0.3, 0.3, 0.3}, {0, 0, 0}, 1, 30};
    static const Vec3 places[3] = {{1.5, 3, 2}, {-2, 3, 1}, {0.5, 4, -2}};
    setting->name = name;
    setting->objects[0] = (Object){.mesh = &teapot,
                                   .solid = {.kind = SOLID_TEAPOT, .radius = 1},
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
            setting->lights[way][i] = (Light){.kind = kind,
                                              .shadows = way == WAYS - 1,
                                              .position = places[i],
                                              .direction = places[i],
                                              .diffuse = {0.4, 0.4, 0.4},
                                              .specular = {0.3, 0.3, 0.3}};
        setting->scenes[way] =
            (Scene){.camera = {{0, 2.5, 5.5}, {0, 0, 0}, {0, 1, 0}, 40, 1, 30, 0},
                    .lights = setting->lights[way],
                    .light_count = lights,
                    .objects = setting->objects,
                    .object_count = 2};
    }
}

/* The scene of the program, whose lights have shadows. */
static void make_program(Setting *setting)
{
    setting->name = "Shadows";
    for (int way = 0; way < WAYS; way++) {
        Scene *scene = &setting->scenes[way];
        Shadows.scene->make(0, 0, scene);
        for (int i = 0; i < scene->light_count; i++) {
            setting->lights[way][i] = scene->lights[i];
            setting->lights[way][i].shadows = way == WAYS - 1;
        }
        scene->lights = setting->lights[way];
    }
}

static bool draw(void *argument)
{
    const Scene *scene = argument;
    for (int i = 0; i < FRAMES; i++) {
        canvas_clear(&canvas, scene->background, 1);
        if (!lighting_draw(lighting, scene, 1, false, NULL))
            return false;
    }
    glFinish();
    return true;
}

static bool measure_setting(Setting *setting, Table *table)
{
    Measured measured[WAYS];
    for (int way = 0; way < WAYS; way++)
        measured[way] = (Measured){setting->name, draw, &setting->scenes[way], NULL};
    const LightingCounts before = lighting_counts(lighting);
    bool done = draw(&setting->scenes[WAYS - 1]);
    const LightingCounts after = lighting_counts(lighting);
    done = done && measure_rounds(measured, WAYS, ROUNDS);
    if (done) {
        const Summary time = measure_summary(measured[0].seconds, ROUNDS);
        table_row(table, "%s|%s|%s|%s|%lld", setting->name,
                  measure_cell(time, 1e3 / FRAMES, 2).text,
                  measure_cell(measure_ratio(&measured[1], &measured[0], 1, ROUNDS), 1, 2).text,
                  measure_cell(measure_ratio(&measured[2], &measured[0], 1, ROUNDS), 1, 2).text,
                  (after.volume_triangles - before.volume_triangles) / FRAMES);
    }
    measure_finish(measured, WAYS);
    return done;
}

static bool measure_all(void)
{
    Table table;
    bool done = true;
    make_setting(&settings[0], "a teapot over a floor, directional light", 1, LIGHT_DIRECTIONAL);
    make_setting(&settings[1], "the same, a point light", 1, LIGHT_POINT);
    make_setting(&settings[2], "the same, three point lights", 3, LIGHT_POINT);
    make_program(&settings[3]);
    table_open(&table,
               "|without shadows, ms|again, over that|volumes, over that|triangles of volumes");
    for (int i = 0; i < SCENES; i++)
        done = done && measure_setting(&settings[i], &table);
    measure_print_table("shadows", &table);
    return done;
}

int main(int argc, char *argv[])
{
    Message message = {0};
    measure_begin(&argc, argv);
    const bool done =
        canvas_open(&canvas, &(CanvasOptions){.width = SIZE, .height = SIZE}, &message) &&
        lighting_open(&lighting, &(ShaderLoader){0}, &message) &&
        mesh_teapot(&teapot, 1, 10, &message) && mesh_quad(&plane, 1, &message) &&
        Shadows.init(&(ShaderLoader){0}, &message);
    if (done)
        measure_print_machine(canvas.renderer, canvas.version);
    const bool measured = done && measure_all();
    if (!done)
        fprintf(stderr, "shadows_benchmark: %s\n", message.text);
    if (done)
        Shadows.finish();
    lighting_close(lighting);
    mesh_close(&teapot);
    mesh_close(&plane);
    canvas_close(&canvas);
    return measured ? 0 : 1;
}
