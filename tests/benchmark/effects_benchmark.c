/*
 * What effects cost: a series of scenes, each with one effect more than the one before, drawn by
 * their specialized programs and by the full program: operations, compile time and frame time. Then
 * the simplest scene against a shader written by hand for it, lights that are off, and changes of
 * values, which must compile nothing: only that can fail.
 *
 * One sphere, lit at the fragments. The full program always draws its far side too, because culling
 * is one of the effects.
 */
#include "app/options.h"
#include "base/clock.h"
#include "benchmark/measure.h"
#include "core/canvas.h"
#include "core/mesh_buffer.h"
#include "lighting/lighting.h"
#include "scene/shader_cost.h"

#include <stdio.h>
#include <stdlib.h>

enum { SIZE = 400, ROUNDS = 21, FRAMES = 4, COMPILATIONS = 3, LIGHTS = 8 };

typedef struct Step {
    const char *name;
    Light lights[LIGHTS];
    Object object;
    Scene scene;
} Step;

enum {
    UNLIT,
    DIFFUSE,
    AMBIENT,
    SPECULAR,
    LOCAL_VIEWER,
    POINT,
    PHONG,
    ATTENUATION,
    SPOT,
    OPEN,
    TWO_SIDED,
    UNEVEN,
    TWO_LIGHTS,
    FOUR_LIGHTS,
    EVERYTHING,
    THREE_OFF, /* not part of the series */
    STEPS
};

static Step steps[STEPS];
static Mesh sphere;
static Canvas canvas;
static Lighting *lighting;

/* The scenes. */

/* Points the scene to its own step's lights and object, because a copy's are elsewhere. */
static void settle(Step *step)
{
    step->object.mesh = &sphere;
    step->scene.lights = step->lights;
    step->scene.objects = &step->object;
}

static void make_steps(void)
{
    static const Vec3 grey = {0.3, 0.3, 0.3};
    Step step = {
        .lights = {{.kind = LIGHT_DIRECTIONAL, .direction = {1, 2, 3}, .diffuse = {1, 1, 0.9}}},
        .object = {.world_from_object = mat4_identity(),
                   .closed = true,
                   .front = {.diffuse = {0.6, 0.4, 0.3}, .shininess = 30, .alpha = 1}},
        .scene = {.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 30, 1, 20, 0},
                  .object_count = 1,
                  .distant_viewer = true},
    };
    Light *light = &step.lights[0];
    Material *front = &step.object.front;
    for (int i = 0; i < STEPS; i++) {
        switch (i) {
        case UNLIT:
            step.name = "unlit";
            break;
        case DIFFUSE:
            step.name = "diffuse, directional";
            step.scene.light_count = 1;
            break;
        case AMBIENT:
            step.name = "+ ambient";
            light->ambient = front->ambient = grey;
            break;
        case SPECULAR:
            step.name = "+ specular, all at infinity";
            light->specular = front->specular = grey;
            break;
        case LOCAL_VIEWER:
            step.name = "+ local viewer";
            step.scene.distant_viewer = false;
            break;
        case POINT:
            step.name = "point instead of directional";
            light->kind = LIGHT_POINT;
            light->position = (Vec3){1, 2, 3};
            break;
        case PHONG:
            step.name = "Phong instead of Blinn-Phong";
            step.scene.reflection = REFLECTION_PHONG;
            break;
        case ATTENUATION:
            step.name = "+ attenuation";
            light->constant = 1;
            light->linear = light->quadratic = 0.05;
            break;
        case SPOT:
            step.name = "+ spot";
            light->kind = LIGHT_SPOT;
            light->direction = (Vec3){-1, -2, -3};
            light->cutoff = 60;
            light->exponent = 2;
            break;
        case OPEN:
            step.name = "open, the far side drawn too";
            step.object.closed = false;
            break;
        case TWO_SIDED:
            step.name = "+ two-sided";
            step.object.two_sided = true;
            step.object.back = *front;
            break;
        case UNEVEN:
            step.name = "+ uneven scaling";
            step.object.world_from_object = mat4_scale((Vec3){1, 0.9, 1.1});
            break;
        case TWO_LIGHTS:
            step.name = "+ a second such light";
            step.scene.light_count = 2;
            break;
        case FOUR_LIGHTS:
            step.name = "+ a third and a fourth";
            step.scene.light_count = 4;
            break;
        case EVERYTHING:
            step.name = "everything, 8 lights";
            step.scene.light_count = 8;
            step.scene.linear = step.scene.show_clipped = true;
            front->emission = grey;
            front->alpha = 0.9;
            break;
        default:
            step = steps[POINT];
            step.name = "4 point lights, 3 of them off";
            step.scene.light_count = 4;
            break;
        }
        for (int k = 1; k < LIGHTS; k++) {
            step.lights[k] = *light;
            step.lights[k].position.x = light->position.x - 0.5 * k;
            step.lights[k].off = i == THREE_OFF;
            if (i == EVERYTHING) /* lights of all kinds */
                step.lights[k].kind = (LightKind)(k % 3);
            if (step.lights[k].kind == LIGHT_DIRECTIONAL)
                step.lights[k].direction = (Vec3){1, 2, 3};
        }
        steps[i] = step;
        settle(&steps[i]);
    }
}

/* The simplest scene by hand: its shaders and GL calls. */

static const ShaderText BY_HAND[] = {
    {"hand.vert", "attribute vec4 a_Position;\n"
                  "attribute vec3 a_Normal;\n"
                  "uniform mat4 u_ClipFromObject;\n"
                  "uniform mat4 u_EyeFromObject;\n"
                  "varying vec3 v_Normal;\n"
                  "void main() {\n"
                  "    gl_Position = u_ClipFromObject * a_Position;\n"
                  "    v_Normal = vec3(u_EyeFromObject * vec4(a_Normal, 0.0));\n"
                  "}\n"},
    {"hand.frag", "precision highp float;\n"
                  "uniform vec3 u_Direction;\n"
                  "uniform vec3 u_Diffuse;\n"
                  "varying vec3 v_Normal;\n"
                  "void main() {\n"
                  "    float cosine = max(dot(normalize(v_Normal), u_Direction), 0.0);\n"
                  "    gl_FragColor = vec4(u_Diffuse * cosine, 1.0);\n"
                  "}\n"},
    {NULL, NULL},
};

typedef struct Hand {
    Shader shader;
    MeshBuffer buffer;
    GLint clip_from_object, eye_from_object, direction, diffuse, normal;
} Hand;

static Hand hand;

static bool open_hand(Message *message)
{
    const ShaderLoader loader = {.texts = BY_HAND};
    return shader_open(&hand.shader, &loader, "hand", message) &&
           mesh_buffer_open(&hand.buffer, &sphere, message) &&
           shader_uniform(&hand.shader, "u_ClipFromObject", &hand.clip_from_object, message) &&
           shader_uniform(&hand.shader, "u_EyeFromObject", &hand.eye_from_object, message) &&
           shader_uniform(&hand.shader, "u_Direction", &hand.direction, message) &&
           shader_uniform(&hand.shader, "u_Diffuse", &hand.diffuse, message) &&
           shader_attribute(&hand.shader, "a_Normal", &hand.normal, message);
}

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
    canvas_clear(&canvas, (Vec3){0, 0, 0}, 1);
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

static bool draw_frames(void *argument)
{
    Message message = {0};
    for (int i = 0; i < FRAMES; i++) {
        if (!render(argument, &message)) {
            fprintf(stderr, "%s\n", message.text);
            return false;
        }
    }
    return true;
}

/* Seconds from nothing to the first frame, minus those of the second: the compile time, part of
 * which the driver postpones until the first draw call. */
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
        const double start = clock_now();
        if (!render(run, message))
            return false;
        const double first = clock_now();
        if (!render(run, message))
            return false;
        samples[i] = first - start - (clock_now() - first);
    }
    *seconds = measure_summary(samples, COMPILATIONS).median;
    return true;
}

/* "30 (1)" for each stage: all operations, and how many of them are special; "?" if no tool counts
 * them. */
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

static void put_ratio(Table *table, const char *name, const Measured *a, const Measured *b)
{
    const Summary ratio = measure_ratio(a, b, 1, ROUNDS);
    table_row(table, "%s|%s", name, measure_cell(ratio, 1, 2).text);
}

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
    measure_print_table(NULL, &table);
    return true;
}

static void print_times(const Measured measured[MEASURED])
{
    Table table;
    table_open(&table, "a frame of 400x400|ms|full, ms|over full|over the scene before");
    for (int i = 0; i < STEPS; i++) {
        const Measured *mine = &measured[2 * i + MINE], *full = &measured[2 * i + FULL];
        const Summary time = measure_summary(mine->seconds, ROUNDS);
        const Summary ratio = measure_ratio(mine, full, 1, ROUNDS);
        const Summary more = measure_ratio(mine, mine - (i ? 2 : 0), 1, ROUNDS);
        table_row(&table, "%s|%s|%.2f|%s|%s", steps[i].name,
                  measure_cell(time, 1e3 / FRAMES, 2).text,
                  1e3 * measure_summary(full->seconds, ROUNDS).median / FRAMES,
                  measure_cell(ratio, 1, 2).text,
                  i > 0 && i < THREE_OFF ? measure_cell(more, 1, 2).text : "");
    }
    measure_print_table(NULL, &table);
    table_open(&table, "ratio of times|");
    put_ratio(&table, "the simplest lit scene over the same again (A/A)", &measured[2 * DIFFUSE],
              &measured[AGAIN]);
    put_ratio(&table, "the simplest lit scene over shaders written by hand for it",
              &measured[2 * DIFFUSE], &measured[BY_HAND_TOO]);
    put_ratio(&table, "4 point lights, 3 of them off, over one", &measured[2 * THREE_OFF],
              &measured[2 * POINT]);
    measure_print_table(NULL, &table);
}

static bool measure_frames(Message *message)
{
    Run runs[MEASURED];
    Measured measured[MEASURED];
    for (int i = 0; i < MEASURED; i++) {
        runs[i] = (Run){&steps[i < AGAIN ? i / 2 : DIFFUSE], i < AGAIN ? (Way)(i % 2) : MINE};
        if (i == BY_HAND_TOO)
            runs[i].way = HAND;
        measured[i] = (Measured){runs[i].step->name, draw_frames, &runs[i], NULL};
    }
    const bool done = measure_rounds(measured, MEASURED, ROUNDS);
    if (done)
        print_times(measured);
    measure_finish(measured, MEASURED);
    return done ? true : message_set(message, "measuring failed");
}

/* Draws the last step with other values, none of them zero. */
static bool compiles_nothing(Message *message)
{
    Step step = steps[EVERYTHING];
    settle(&step);
    if (!render(&(Run){&steps[EVERYTHING], MINE}, message))
        return false;
    const int before = lighting_counts(lighting).programs;
    for (int i = 1; i <= 10; i++) {
        const Vec3 color = {0.1 * i, 0.05 * i, 0.02 * i};
        step.object.front = (Material){color, color, color, color, 0.05 * i, 10 * i};
        step.object.back = step.object.front;
        for (int k = 0; k < LIGHTS; k++) {
            step.lights[k].ambient = step.lights[k].diffuse = color;
            step.lights[k].specular = color;
        }
        if (!render(&(Run){&step, MINE}, message))
            return false;
    }
    const int compiled = lighting_counts(lighting).programs - before;
    printf("\nPrograms compiled by changing every colour ten times: %d\n", compiled);
    return compiled == 0 ? true : message_set(message, "changing a colour compiles programs");
}

int main(int argc, char *argv[])
{
    measure_begin(&argc, argv);
    Message message = {0};
    const CanvasOptions size = {.width = SIZE, .height = SIZE};
    setenv("LP_NUM_THREADS", "0", 0); /* other programs disturb one thread less than several */
    setenv("MESA_SHADER_CACHE_DISABLE", "true",
           1); /* otherwise nothing is compiled the second time */
    if (!canvas_open(&canvas, &size, &message))
        return options_fail("effects_benchmark", &message, 77);
    make_steps();
    measure_print_machine(canvas.renderer, canvas.version);
    const bool done = mesh_sphere(&sphere, 1, 64, 32, &message) && open_hand(&message) &&
                      print_sizes(&message) && measure_frames(&message) &&
                      compiles_nothing(&message);
    lighting_close(lighting);
    shader_close(&hand.shader);
    mesh_buffer_close(&hand.buffer);
    mesh_close(&sphere);
    canvas_close(&canvas);
    return done ? 0 : options_fail("effects_benchmark", &message, 1);
}
