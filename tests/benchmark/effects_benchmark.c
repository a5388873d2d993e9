/*
 * What effects cost: a series of scenes, each with one effect more than the one before, drawn by
 * their specialized programs and by the full program: operations, compile time and frame time. Then
 * the simplest scene against a shader written by hand for it, and lights that are off.
 *
 * One sphere, lit at the fragments. The full program always draws its far side too, because culling
 * is one of the effects.
 */
#include "base/clock.h"
#include "benchmark/bench.h"
#include "core/canvas.h"
#include "core/mesh_buffer.h"
#include "lighting/lighting.h"
#include "scene/shader_cost.h"

#include <stdio.h>

enum { SIZE = 400, ROUNDS = 21, FRAMES = 4, COMPILATIONS = 3, LIGHTS = 8 };

typedef struct Step {
    const char *name;
    Light lights[LIGHTS];
    Object object;
    Scene scene;
} Step;

/* What a step adds to the one before. */
enum {
    LIT = 1,
    ADD_AMBIENT = 2,
    ADD_SPECULAR = 4,
    ADD_VIEWER = 8,
    ADD_POINT = 16,
    ADD_PHONG = 32,
    ADD_ATTENUATION = 64,
    ADD_SPOT = 128,
    ADD_FAR_SIDE = 256,
    ADD_BACK = 512,
    ADD_SCALING = 1024,
    ADD_REST = 2048,    /* lights of all kinds, emission, transparency */
    OFF = 4096,         /* all lights but the first; without what POINT has not */
    FAR_OF_PHONG = 8192 /* without what FAR has not, but its reflection */
};

enum { UNLIT, DIFFUSE, FAR = 3, POINT = 5, EVERYTHING = 14, THREE_OFF, FAR_PHONG, STEPS };

static const struct {
    const char *name;
    int adds, lights;
} SERIES[STEPS] = {
    [UNLIT] = {"unlit", 0, 0},
    [DIFFUSE] = {"diffuse, directional", LIT, 1},
    {"+ ambient", ADD_AMBIENT, 1},
    [FAR] = {"+ Blinn-Phong's specular, all at infinity", ADD_SPECULAR, 1},
    {"+ local viewer", ADD_VIEWER, 1},
    [POINT] = {"point instead of directional", ADD_POINT, 1},
    {"Phong instead of Blinn-Phong", ADD_PHONG, 1},
    {"+ attenuation", ADD_ATTENUATION, 1},
    {"+ spot", ADD_SPOT, 1},
    {"open, the far side drawn too", ADD_FAR_SIDE, 1},
    {"+ two-sided", ADD_BACK, 1},
    {"+ uneven scaling", ADD_SCALING, 1},
    {"+ a second such light", 0, 2},
    {"+ a third and a fourth", 0, 4},
    [EVERYTHING] = {"everything, 8 lights", ADD_REST, 8},
    /* Not part of the series. */
    [THREE_OFF] = {"4 point lights, 3 of them off", OFF, 4},
    [FAR_PHONG] = {"Phong's specular instead, all at infinity", FAR_OF_PHONG, 1},
};

static Step steps[STEPS];
static Mesh sphere;
static Lighting *lighting;

/* The scenes. */

static Light light_of(int has)
{
    static const Vec3 grey = {0.3, 0.3, 0.3}, none = {0, 0, 0};
    Light light = {.kind = LIGHT_DIRECTIONAL,
                   .direction = {1, 2, 3},
                   .diffuse = {1, 1, 0.9},
                   .ambient = has & ADD_AMBIENT ? grey : none,
                   .specular = has & ADD_SPECULAR ? grey : none};
    if (has & ADD_POINT) {
        light.kind = LIGHT_POINT;
        light.position = (Vec3){1, 2, 3};
    }
    if (has & ADD_ATTENUATION) {
        light.constant = 1;
        light.linear = light.quadratic = 0.05;
    }
    if (has & ADD_SPOT) {
        light.kind = LIGHT_SPOT;
        light.direction = (Vec3){-1, -2, -3};
        light.cutoff = 60;
        light.exponent = 2;
    }
    return light;
}

static Object object_of(int has)
{
    static const Vec3 grey = {0.3, 0.3, 0.3}, none = {0, 0, 0};
    Object object = {.world_from_object =
                         has & ADD_SCALING ? mat4_scale((Vec3){1, 0.9, 1.1}) : mat4_identity(),
                     .closed = !(has & ADD_FAR_SIDE),
                     .two_sided = (has & ADD_BACK) != 0,
                     .front = {.ambient = has & ADD_AMBIENT ? grey : none,
                               .diffuse = {0.6, 0.4, 0.3},
                               .specular = has & ADD_SPECULAR ? grey : none,
                               .shininess = 30,
                               .alpha = 1}};
    if (has & ADD_BACK)
        object.back = object.front;
    if (has & ADD_REST) {
        object.front.emission = grey;
        object.front.alpha = 0.9;
    }
    return object;
}

static void make_steps(void)
{
    for (int i = 0, has = 0; i < STEPS; i++) {
        has |= SERIES[i].adds;
        if (has & FAR_OF_PHONG)
            has = ADD_PHONG | (2 * ADD_SPECULAR - 1);
        else if (has & OFF)
            has = OFF | (2 * ADD_POINT - 1);
        const Light light = light_of(has);
        Step step = {.name = SERIES[i].name,
                     .object = object_of(has),
                     .scene = {.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 30, 1, 20, 0},
                               .light_count = SERIES[i].lights,
                               .object_count = 1,
                               .distant_viewer = !(has & ADD_VIEWER),
                               .reflection = has & ADD_PHONG ? REFLECTION_PHONG : 0,
                               .linear = (has & ADD_REST) != 0,
                               .show_clipped = (has & ADD_REST) != 0}};
        for (int k = 0; k < LIGHTS; k++) {
            step.lights[k] = light;
            step.lights[k].position.x -= 0.5 * k;
            step.lights[k].off = k > 0 && has & OFF;
            if (k > 0 && has & ADD_REST)
                step.lights[k].kind = (LightKind)(k % 3);
            if (step.lights[k].kind == LIGHT_DIRECTIONAL)
                step.lights[k].direction = (Vec3){1, 2, 3};
        }
        steps[i] = step;
        /* Points the scene to its own step's lights and object, because a copy's are elsewhere. */
        steps[i].object.mesh = &sphere;
        steps[i].scene.lights = steps[i].lights;
        steps[i].scene.objects = &steps[i].object;
    }
}

/* The simplest scene by hand: its shaders, study/by_hand, and GL calls. */

typedef struct Hand {
    Shader shader;
    MeshBuffer buffer;
    GLint clip_from_object, eye_from_object, direction, diffuse, normal;
} Hand;

static Hand hand;

static bool draw_hand(const Step *step, Message *message)
{
    const Light *light = &step->lights[0];
    const Vec3 diffuse = step->object.front.diffuse;
    Mat4 eye_from_world, clip_from_eye;
    Vec3 direction;
    if (!scene_camera(&step->scene.camera, 1, &eye_from_world, &clip_from_eye, message))
        return false;
    vec3_normalize(mat4_transform_direction(eye_from_world, light->direction), &direction);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    glUseProgram(hand.shader.program);
    shader_set_mat4(hand.clip_from_object, mat4_product(clip_from_eye, eye_from_world));
    shader_set_mat4(hand.eye_from_object, eye_from_world);
    shader_set_vec3(hand.direction, direction);
    shader_set_vec3(hand.diffuse, (Vec3){light->diffuse.x * diffuse.x, light->diffuse.y * diffuse.y,
                                         light->diffuse.z * diffuse.z});
    mesh_buffer_bind(&hand.buffer, 0, hand.normal);
    glDrawElements(GL_TRIANGLES, hand.buffer.index_count, hand.buffer.index_type, NULL);
    glDisable(GL_CULL_FACE);
    return true;
}

/* Frames. */

typedef enum Way { MINE, FULL, HAND } Way;

typedef struct Run {
    const Step *step;
    Way way;
} Run;

static bool render(const Run *run, Message *message)
{
    canvas_clear(&bench_canvas, (Vec3){0, 0, 0}, 1);
    if (run->way == HAND
            ? !draw_hand(run->step, message)
            : !lighting_show(lighting,
                             &(LightingFrame){
                                 .scene = &run->step->scene, .aspect = 1, .full = run->way == FULL},
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

/* Processor seconds from nothing to the first frame, minus those of the second: the compile time,
 * part of which the driver postpones until the first draw call. */
static bool measure_compiling(const Run *run, double *seconds, Message *message)
{
    double samples[COMPILATIONS];
    const ShaderLoader loader = {.folder = NULL};
    for (int i = 0; i < COMPILATIONS; i++) {
        lighting_close(lighting);
        /* Uploads the mesh. */
        if (!lighting_open(&lighting, &loader, message) ||
            !lighting_show(lighting, &(LightingFrame){.scene = &steps[UNLIT].scene, .aspect = 1},
                           message))
            return false;
        glFinish();
        const double start = clock_processor();
        if (!render(run, message))
            return false;
        const double first = clock_processor();
        if (!render(run, message))
            return false;
        samples[i] = first - start - (clock_processor() - first);
    }
    *seconds = clock_median(samples, COMPILATIONS);
    return true;
}

/* "30 (1)" for each stage: all operations, and how many of them are special; "?" if they cannot be
 * counted. */
static void tell_operations(const Run *run, char told[2][16])
{
    static Message said; /* once */
    ShaderSource sources[2];
    Message message = {0};
    if (!lighting_sources(lighting, &run->step->scene, &run->step->object, run->way == FULL,
                          sources, &message))
        return;
    for (int stage = 0; stage < 2; stage++) {
        ShaderCost operations;
        if (shader_cost(sources[stage].text, (ShaderStage)stage, &operations, &message))
            snprintf(told[stage], sizeof told[stage], "%d (%d)",
                     operations.arithmetic + operations.special, operations.special);
        else
            snprintf(told[stage], sizeof told[stage], "?");
        shader_source_close(&sources[stage]);
    }
    if (message.text[0] && !said.text[0])
        printf("%s\n", message.text);
    if (message.text[0])
        said = message;
}

/* What is timed: every step with both programs, and in addition: */
enum { AGAIN = 2 * STEPS, BY_HAND_TOO, MEASURED };

static bool print_sizes(Message *message)
{
    Table table;
    table_open(&table,
               "operations (of them special)|a vertex|full|a fragment|full|compile ms|full");
    for (int i = 0; i < STEPS; i++) {
        char told[2][2][16] = {{"?", "?"}, {"?", "?"}}; /* by Way and ShaderStage */
        double seconds[2];
        for (int way = MINE; way <= FULL; way++) {
            const Run run = {&steps[i], (Way)way};
            if (!measure_compiling(&run, &seconds[way], message))
                return false;
            tell_operations(&run, told[way]);
        }
        table_row(&table, "%s|%s|%s|%s|%s|%.1f|%.1f", steps[i].name, told[MINE][SHADER_VERTEX],
                  told[FULL][SHADER_VERTEX], told[MINE][SHADER_FRAGMENT],
                  told[FULL][SHADER_FRAGMENT], 1e3 * seconds[MINE], 1e3 * seconds[FULL]);
    }
    bench_print(NULL, &table);
    return true;
}

static void print_times(const BenchRun runs[MEASURED])
{
    static const struct {
        const char *name;
        BenchColumn ratio;
    } ratios[] = {
        {"the simplest lit scene over the same again (A/A)", {BENCH_RATIO(2 * DIFFUSE, AGAIN, 2)}},
        {"the simplest lit scene over shaders written by hand for it",
         {BENCH_RATIO(2 * DIFFUSE, BY_HAND_TOO, 2)}},
        {"4 point lights, 3 of them off, over one", {BENCH_RATIO(2 * THREE_OFF, 2 * POINT, 2)}},
        {"Blinn-Phong over Phong, all at infinity", {BENCH_RATIO(2 * FAR, 2 * FAR_PHONG, 2)}},
        {"Phong over Blinn-Phong, a point light and a local viewer",
         {BENCH_RATIO(2 * (POINT + 1), 2 * POINT, 2)}},
    };
    Table table;
    table_open(&table, "a frame of 400x400|ms|full, ms|over full|over the scene before");
    for (int i = 0; i < STEPS; i++) {
        const int mine = 2 * i + MINE, full = 2 * i + FULL;
        const BenchColumn columns[] = {{BENCH_TIME(mine, 1e3 / FRAMES, 2)},
                                       {BENCH_MEDIAN(full, 1e3 / FRAMES, 2)},
                                       {BENCH_RATIO(mine, full, 2)},
                                       {i > 0 && i < THREE_OFF, 2, mine, -1, mine - 2, -1, false}};
        bench_row(&table, runs, columns, 4, "%s", steps[i].name);
    }
    bench_print(NULL, &table);
    table_open(&table, "ratio of times|");
    for (size_t i = 0; i < sizeof ratios / sizeof ratios[0]; i++)
        bench_row(&table, runs, &ratios[i].ratio, 1, "%s", ratios[i].name);
    bench_print(NULL, &table);
}

static bool measure_frames(Message *message)
{
    Run drawn[MEASURED];
    BenchRun runs[MEASURED];
    for (int i = 0; i < MEASURED; i++) {
        drawn[i] = (Run){&steps[i < AGAIN ? i / 2 : DIFFUSE], i < AGAIN ? (Way)(i % 2) : MINE};
        if (i == BY_HAND_TOO)
            drawn[i].way = HAND;
        runs[i] = (BenchRun){drawn[i].step->name, draw_frames, &drawn[i], NULL, 0};
    }
    const bool done = bench_rounds(runs, MEASURED, ROUNDS, message);
    if (done)
        print_times(runs);
    bench_finish(runs, MEASURED);
    return done;
}

static bool run(Message *message)
{
    make_steps();
    return mesh_sphere(&sphere, 1, 64, 32, message) &&
           (shader_open(&hand.shader, &(ShaderLoader){0}, "study/by_hand", message) &&
            mesh_buffer_open(&hand.buffer, &sphere, message) &&
            shader_uniform(&hand.shader, "u_ClipFromObject", &hand.clip_from_object, message) &&
            shader_uniform(&hand.shader, "u_EyeFromObject", &hand.eye_from_object, message) &&
            shader_uniform(&hand.shader, "u_Direction", &hand.direction, message) &&
            shader_uniform(&hand.shader, "u_Diffuse", &hand.diffuse, message) &&
            shader_attribute(&hand.shader, "a_Normal", &hand.normal, message)) &&
           print_sizes(message) && measure_frames(message);
}

static void finish(void)
{
    lighting_close(lighting);
    shader_close(&hand.shader);
    mesh_buffer_close(&hand.buffer);
    mesh_close(&sphere);
}

const Bench BENCH = {.name = "effects_benchmark",
                     .width = SIZE,
                     .height = SIZE,
                     .one_thread = true,
                     .no_cache = true,
                     .run = run,
                     .close = finish};
