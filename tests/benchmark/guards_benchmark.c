/*
 * What guards cost: the full program and programs made for scenes, each with one guard of the
 * lighting left out and with all left out, over the guarded one; beside that the same again (A/A).
 * A scene that needs no guard has none in its program: there all of these are the same.
 */
#include "canvas.h"
#include "lighting.h"
#include "measure.h"
#include "options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

/* The first is guarded, and so is the second. */
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
static Canvas canvas;

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
        .scene = {.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 30, 1, 20},
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

static bool draw(const Run *run, Message *message)
{
    canvas_clear(&canvas, (Vec3){0, 0, 0}, 1);
    if (!lighting_draw(run->lighting, &run->world->scene, 1, run->world->full, message))
        return false;
    glFinish();
    return true;
}

static bool draw_frames(void *argument)
{
    Message message = {0};
    for (int i = 0; i < FRAMES; i++) {
        if (!draw(argument, &message)) {
            fprintf(stderr, "%s\n", message.text);
            return false;
        }
    }
    return true;
}

static bool has_guards(const Run *run, bool *has, Message *message)
{
    ShaderSource sources[2];
    if (!lighting_sources(run->lighting, &run->world->scene, &run->world->object, run->world->full,
                          sources, message))
        return false;
    *has = false;
    for (int stage = 0; stage < 2; stage++) {
        *has |= strstr(sources[stage].text, "#define GUARD") != NULL;
        shader_source_close(&sources[stage]);
    }
    return true;
}

static bool measure_world(const World *world, Lighting *const lightings[GUARD_COUNT + 1],
                          Message *message)
{
    Run runs[GUARD_COUNT + 1];
    Measured measured[GUARD_COUNT + 1];
    bool has;
    for (int i = 0; i <= GUARD_COUNT; i++) {
        runs[i] = (Run){lightings[i], world};
        measured[i] = (Measured){world->name, draw_frames, &runs[i], NULL};
    }
    if (!has_guards(&runs[0], &has, message))
        return false;
    if (!measure_rounds(measured, GUARD_COUNT + 1, ROUNDS)) {
        measure_finish(measured, GUARD_COUNT + 1);
        return message_set(message, "measuring failed");
    }
    const Summary time = measure_summary(measured[0].seconds, ROUNDS);
    printf("\n%s: %.2f ms a frame; %s\n", world->name, 1e3 * time.median / FRAMES,
           has ? "guarded" : "no guard is compiled in but pow and the highlight's");
    for (int i = 0; i < GUARD_COUNT; i++) {
        const Summary ratio = measure_ratio(&measured[0], &measured[i + 1], 1, ROUNDS);
        printf("  %-26s %5.3f [%.3f, %.3f]\n", GUARDS[i].name, ratio.median, ratio.lower,
               ratio.upper);
    }
    measure_finish(measured, GUARD_COUNT + 1);
    return true;
}

int main(void)
{
    Message message = {0};
    const CanvasOptions size = {.width = SIZE, .height = SIZE};
    ShaderLoader loaders[GUARD_COUNT + 1] = {{.folder = NULL}};
    Lighting *lightings[GUARD_COUNT + 1] = {NULL};
    setenv("LP_NUM_THREADS", "0", 0); /* other programs disturb one thread less than several */
    if (!canvas_open(&canvas, &size, &message))
        return options_fail("guards_benchmark", &message, 77);
    make_worlds();
    measure_print_machine();
    printf("%s\nA guarded frame's time over that without:\n", canvas.renderer);
    bool done = mesh_sphere(&sphere, 1, 64, 32, &message);
    for (int i = 0; i <= GUARD_COUNT && done; i++) {
        if (i > 0 && GUARDS[i - 1].replaced[0].name)
            loaders[i].replacements = GUARDS[i - 1].replaced;
        done = lighting_open(&lightings[i], &loaders[i], &message);
    }
    for (int i = 0; i < WORLDS && done; i++)
        done = measure_world(&worlds[i], lightings, &message);
    for (int i = 0; i <= GUARD_COUNT; i++)
        lighting_close(lightings[i]);
    mesh_close(&sphere);
    canvas_close(&canvas);
    return done ? 0 : options_fail("guards_benchmark", &message, 1);
}
