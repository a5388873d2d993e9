/*
 * What a scene's objects cost the processor: a thousand of a thousand triangles, drawn by lighting
 * and by a loop as one writes it by hand, which looks uniforms up once, sets those of the lights
 * once a frame, and for each object its matrices and products of colors. And scenes of files, and
 * of cubes, by their programs over the full one.
 *
 * An argument is the only table to be made: triangles or scenes.
 */
#include "benchmark/bench.h"
#include "core/canvas.h"
#include "core/mesh_buffer.h"
#include "lighting/lighting.h"
#include "lighting/lighting_state.h"
#include "scene/file_scene.h"
#include "shapes/mesh_solids.h"

#include <math.h>
#include <string.h>

enum { SIZE = 32, ROUNDS = 5, MOST_OBJECTS = 1000, MOST_LIGHTS = 8 };

static Lighting *lighting;
static Mesh cube, ball;
static const Mesh *drawn = &cube;
static MeshBuffer buffer; /* of what is drawn, for the loop */

static Light lights[MOST_LIGHTS];
static Object objects[MOST_OBJECTS];
static Scene scene;
static int frames; /* that one measurement draws */

/* A square of objects. */
static void make_scene(int object_count, int light_count)
{
    const int side = (int)ceil(sqrt(object_count));
    const double step = 20.0 / side;
    for (int i = 0; i < object_count; i++) {
        const double shade = 0.2 + 0.6 * i / object_count;
        const Vec3 at = {step * (i % side) - 10, 0.5 * step, step * (i / side) - 10};
        const Mat4 turned = mat4_product(mat4_rotate(7 * i, (Vec3){1, 1, 0}),
                                         mat4_scale((Vec3){3 * step, 3 * step, 3 * step}));
        objects[i] = (Object){.mesh = drawn,
                              .flat = drawn == &cube,
                              .closed = true,
                              .world_from_object = mat4_product(mat4_translate(at), turned),
                              .front = {{shade, 0.2, 0.1},
                                        {0.3, shade, 0.2},
                                        {0.4, 0.4, shade},
                                        {0, 0, 0},
                                        1,
                                        10 + 10 * shade}};
    }
    for (int i = 0; i < light_count; i++)
        lights[i] = (Light){.kind = LIGHT_POINT,
                            .position = {3.0 * i - 8, 9, 5.0 - i},
                            .ambient = {0.02, 0.02, 0.02},
                            .diffuse = {0.2, 0.2, 0.2},
                            .specular = {0.1, 0.1, 0.1}};
    scene = (Scene){.camera = {{0, 16, 22}, {0, 0, 0}, {0, 1, 0}, 50, 1, 60, 0},
                    .global_ambient = {0.1, 0.1, 0.1},
                    .lights = lights,
                    .light_count = light_count,
                    .objects = objects,
                    .object_count = object_count};
    frames = 1;
}

/* An argument: by the full program. */
static bool draw_lighting(void *argument, Message *message)
{
    const LightingFrame frame = {
        .scene = &scene, .aspect = 1, .full = argument != NULL, .view = argument != NULL};
    bool done = true;
    for (int i = 0; i < frames && done; i++) {
        canvas_clear(&bench_canvas, scene.background, 1);
        done = lighting_show(lighting, &frame, message);
    }
    glFinish();
    return done;
}

/* The loop */

static struct {
    GLuint program;
    GLint position, normal; /* attributes */
    GLint clip_from_object, eye_from_object;
    GLint base, shininess, light_positions, diffuse, specular;
} loop;

static bool open_loop(Message *message)
{
    LightingPlan plan = {.lighting = NULL};
    const LightingFrame frame = {.scene = &scene, .aspect = 1};
    if (!lighting_plan(&plan, lighting, &frame, message))
        return false;
    loop.program = plan.objects[0].variant->program->program;
    lighting_plan_close(&plan);
    loop.position = glGetAttribLocation(loop.program, "a_Position");
    loop.normal = glGetAttribLocation(loop.program, "a_Normal");
    loop.clip_from_object = glGetUniformLocation(loop.program, "u_ClipFromObject");
    loop.eye_from_object = glGetUniformLocation(loop.program, "u_EyeFromObject");
    loop.base = glGetUniformLocation(loop.program, "u_FrontBase");
    loop.shininess = glGetUniformLocation(loop.program, "u_FrontShininess");
    loop.light_positions = glGetUniformLocation(loop.program, "u_Position0");
    loop.diffuse = glGetUniformLocation(loop.program, "u_FrontDiffuse0");
    loop.specular = glGetUniformLocation(loop.program, "u_FrontSpecular0");
    return loop.base >= 0 && loop.shininess >= 0 && loop.light_positions >= 0 &&
           loop.diffuse >= 0 && loop.specular >= 0 && loop.eye_from_object >= 0;
}

static void loop_object(const Object *object, Mat4 eye_from_world, Mat4 clip_from_eye)
{
    float diffuse[MOST_LIGHTS][3], specular[MOST_LIGHTS][3];
    const Material *material = &object->front;
    const float shininess = (float)material->shininess;
    const Mat4 eye_from_object =
        scene_eye_from_object(&scene.camera, eye_from_world, object->world_from_object);
    Vec3 ambient = scene.global_ambient;
    for (int i = 0; i < scene.light_count; i++) {
        ambient = vec3_add(ambient, lights[i].ambient);
        vec3_to_float(color_product(lights[i].diffuse, material->diffuse), diffuse[i]);
        vec3_to_float(color_product(lights[i].specular, material->specular), specular[i]);
    }
    shader_set_mat4(loop.clip_from_object, mat4_product(clip_from_eye, eye_from_object));
    shader_set_mat4(loop.eye_from_object, eye_from_object);
    shader_set_vec3(loop.base,
                    vec3_add(material->emission, color_product(ambient, material->ambient)));
    glUniform1fv(loop.shininess, 1, &shininess);
    glUniform3fv(loop.diffuse, scene.light_count, diffuse[0]);
    glUniform3fv(loop.specular, scene.light_count, specular[0]);
    glDrawElements(GL_TRIANGLES, buffer.index_count, buffer.index_type, NULL);
}

static bool draw_loop(__attribute__((unused)) void *argument, Message *message)
{
    Mat4 eye_from_world, clip_from_eye;
    float positions[MOST_LIGHTS][3];
    for (int f = 0; f < frames; f++) {
        canvas_clear(&bench_canvas, scene.background, 1);
        if (!scene_camera(&scene.camera, 1, &eye_from_world, &clip_from_eye, message))
            return false;
        glEnable(GL_DEPTH_TEST);
        glEnable(GL_CULL_FACE);
        glUseProgram(loop.program);
        mesh_buffer_bind(&buffer, loop.position, loop.normal);
        for (int i = 0; i < scene.light_count; i++)
            vec3_to_float(scene_eye_point(&scene.camera, eye_from_world, lights[i].position),
                          positions[i]);
        glUniform3fv(loop.light_positions, scene.light_count, positions[0]);
        for (int i = 0; i < scene.object_count; i++)
            loop_object(&objects[i], eye_from_world, clip_from_eye);
        glDisable(GL_CULL_FACE);
    }
    glFinish();
    return true;
}

/* Tables */

/* A row: the loop and lighting, in seconds times a scale of what one frame takes. */
static bool measure_both(Table *table, int object_count, int light_count, double scale,
                         Message *message)
{
    BenchRun both[] = {{"loop", draw_loop, NULL, NULL, 0},
                       {"lighting", draw_lighting, NULL, NULL, 0}};
    make_scene(object_count, light_count);
    const BenchColumn columns[] = {{BENCH_TIME(0, scale / frames, 2)},
                                   {BENCH_TIME(1, scale / frames, 2)},
                                   {BENCH_RATIO(1, 0, 2)}};
    const bool done = mesh_buffer_open(&buffer, drawn, message) && draw_lighting(NULL, message) &&
                      open_loop(message) && bench_rounds(both, 2, ROUNDS, message);
    if (done)
        bench_row(table, both, columns, 3, "%d|%d", object_count, light_count);
    bench_finish(both, 2);
    mesh_buffer_close(&buffer);
    return done;
}

/* 1000 objects of 1008 triangles. */
static bool measure_triangles(Message *message)
{
    Table table;
    bool done = true;
    table_open(&table, "objects of 1008 triangles|lights|loop, ms|lighting, ms|over the loop");
    drawn = &ball;
    for (int light_count = 1; light_count <= MOST_LIGHTS && done; light_count *= 8)
        done = measure_both(&table, 1000, light_count, 1e3, message);
    drawn = &cube;
    bench_print(NULL, &table);
    return done;
}

/* Scenes: of Debian's assimp-testmodels, and this one's. */

static const char MODELS[] = "/usr/share/assimp/models/";
static const char *const FILES[] = {"3DS/fels.3ds",
                                    "3DS/test1.3ds",
                                    "ASE/ThreeCubesGreen.ASE",
                                    "Collada/duck.dae",
                                    "Collada/earthCylindrical.DAE",
                                    "FBX/global_settings.fbx",
                                    "FBX/huesitos.fbx",
                                    "FBX/spider.fbx",
                                    "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb",
                                    "glTF2/BoxTextured-glTF/BoxTextured.gltf",
                                    "glTF2/ClearCoat-glTF/ClearCoatTest.gltf",
                                    "OBJ/spider.obj",
                                    "PLY/Wuson.ply",
                                    "BLEND/TorusLightsCams_250_compressed.blend"};

static bool measure_scene(Table *table, const char *name, Message *message)
{
    enum { FRAMES = 3 };
    BenchRun both[] = {{name, draw_lighting, NULL, NULL, 0},
                       {"full", draw_lighting, &scene, NULL, 0}};
    const BenchColumn columns[] = {
        {BENCH_TIME(0, 1e3 / FRAMES, 2)}, {BENCH_TIME(1, 1e3 / FRAMES, 2)}, {BENCH_RATIO(0, 1, 2)}};
    size_t triangles = 0;
    frames = FRAMES;
    for (int i = 0; i < scene.object_count; i++)
        triangles += scene.objects[i].mesh->index_count / 3;
    const bool done = bench_rounds(both, 2, ROUNDS, message);
    if (done)
        bench_row(table, both, columns, 3, "%s|%d|%zu|%d", name, scene.object_count, triangles,
                  scene.light_count);
    bench_finish(both, 2);
    return done;
}

static bool measure_file(Table *table, const char *name, Message *message)
{
    char path[200];
    FileScene file;
    Message why = {0};
    snprintf(path, sizeof path, "%s%s", MODELS, name);
    if (!file_scene_open(&file, &(FileSceneOptions){.path = path, .camera = "fit"}, &why)) {
        file_scene_close(&file); /* not installed, or without a camera */
        return true;
    }
    file_scene_make(&file, 0, &scene);
    const bool done = measure_scene(table, name, message);
    lighting_forget(lighting, NULL);
    file_scene_close(&file);
    return done;
}

static bool measure_scenes(Message *message)
{
    enum { LARGE = 400 };
    static const int made[][2] = {{1, 1}, {10, 1}, {10, 8}, {100, 4}, {1000, 1}, {1000, 8}};
    Canvas small = bench_canvas;
    Table table;
    bool done = canvas_open_beside(&bench_canvas, &small,
                                   &(CanvasOptions){.width = LARGE, .height = LARGE}, message);
    table_open(&table, "a frame of 400x400|objects|triangles|lights|ms|full, ms|over full");
    for (size_t i = 0; i < sizeof FILES / sizeof *FILES && done; i++)
        done = measure_file(&table, FILES[i], message);
    for (size_t i = 0; i < sizeof made / sizeof *made && done; i++) {
        make_scene(made[i][0], made[i][1]);
        done = measure_scene(&table, "cubes", message);
    }
    bench_print(NULL, &table);
    canvas_close(&bench_canvas);
    bench_canvas = small;
    canvas_begin(&bench_canvas);
    return done;
}

static bool asked(const char *table)
{
    return !bench_arguments[0] || strcmp(bench_arguments[0], table) == 0;
}

static bool run(Message *message)
{
    return lighting_open(&lighting, &(ShaderLoader){0}, message) &&
           mesh_cube(&cube, 0.1, message) && mesh_sphere(&ball, 0.05, 24, 22, message) &&
           (!asked("triangles") || measure_triangles(message)) &&
           (!asked("scenes") || measure_scenes(message));
}

static void finish(void)
{
    lighting_close(lighting);
    mesh_close(&ball);
    mesh_close(&cube);
}

const Bench BENCH = {
    .name = "objects_benchmark", .width = SIZE, .height = SIZE, .run = run, .close = finish};
