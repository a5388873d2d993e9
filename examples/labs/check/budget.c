/* The cost of a picture is its operations: those of a vertex times the vertices plus those of a
 * fragment times the pixels, twice without culling, because then back faces cover them again. It is
 * counted for the chapter's own program in the same way, so the ratio is the same on all machines;
 * the time, of frames that alternate, is only told. */
#include "labs/check/budget.h"

#include "base/clock.h"
#include "base/memory.h"
#include "glsl/glsl.h"
#include "labs/program/lab_scene_open.h"
#include "lighting/lighting.h"
#include "scene/shader_cost.h"

#include <math.h>
#include <stdio.h>

enum { SIZE = 400, ROUNDS = 15 };

/* The ratio of operations that gets all points. */
static const double CHEAP = 0.63;

/* No round starts later: a mesh may have half a million triangles. */
static const double MAX_SECONDS = 0.5;

/* One of the two programs measured: the submission or the chapter's own. */
typedef struct Way {
    Lighting *lighting; /* NULL: the submission */
    GLuint program;
    MeshBuffer mesh;
    bool cull;
    long vertices;
} Way;

static bool open_mesh(Way *way, int slices, int stacks, Message *message)
{
    Mesh mesh;
    if (!mesh_sphere(&mesh, 1, slices, stacks, message))
        return false;
    way->vertices = (long)mesh.vertex_count;
    const bool done = mesh_buffer_open(&way->mesh, &mesh, message);
    mesh_close(&mesh);
    return done;
}

/* What both draw. */
typedef struct Setting {
    const Lab *lab;
    const LabScene *lab_scene;
    const Canvas *canvas;
} Setting;

static bool frame(const Way *way, const Setting *of, double *seconds, Message *message)
{
    const LabScene *lab_scene = of->lab_scene;
    const Drawn drawn = {.scene = &lab_scene->scene, .aspect = 1};
    const double start = clock_now();
    canvas_clear(of->canvas, (Vec3){0, 0, 0}, 1);
    glEnable(GL_DEPTH_TEST);
    if (way->cull)
        glEnable(GL_CULL_FACE);
    const bool done =
        way->lighting
            ? lighting_show(way->lighting,
                            &(LightingFrame){.scene = &lab_scene->scene, .aspect = 1}, message)
            : binding_draw(of->lab, way->program, &way->mesh, &drawn, message);
    glDisable(GL_CULL_FACE);
    glFinish();
    *seconds = clock_now() - start;
    return done;
}

/* The median ratio of alternating frames. */
static bool measure(const Way *way, const Way *plain, const Setting *of, double *ratio,
                    Message *message)
{
    double ratios[ROUNDS], first, second;
    int count = 0;
    const double start = clock_now();
    for (int i = -1; i < ROUNDS && (count == 0 || clock_now() < start + MAX_SECONDS); i++) {
        if (!frame(way, of, &first, message) || !frame(plain, of, &second, message))
            return false;
        if (i >= 0)
            ratios[count++] = first / second;
    }
    *ratio = clock_median(ratios, count);
    return true;
}

/* Those that the plain program covers: what a submission leaves black costs too. */
static bool count_pixels(const Way *way, const Setting *of, long *pixels, Message *message)
{
    double seconds;
    Image image;
    *pixels = 0;
    if (!image_open(&image, SIZE, SIZE, IMAGE_BYTE, message))
        return false;
    const bool done = frame(way, of, &seconds, message) && canvas_read(of->canvas, &image, message);
    const unsigned char *p = image.pixels;
    for (int i = 0; i < SIZE * SIZE && done; i++)
        *pixels += p[4 * i] || p[4 * i + 1] || p[4 * i + 2];
    image_close(&image);
    return done;
}

/* -1, with a message: they cannot be counted. */
static long operations_of(const char *text, ShaderStage stage, Message *message)
{
    ShaderCost counted;
    return shader_cost(text, stage, &counted, message) ? counted.arithmetic + counted.special : -1;
}

/* Without culling the back faces cover all of the sphere's pixels again. */
static long count(const Way *way, const ShaderSource sources[2], long pixels, Message *message)
{
    const long fragments = way->cull ? pixels : 2 * pixels;
    const long vertex = operations_of(sources[SHADER_VERTEX].text, SHADER_VERTEX, message);
    const long fragment =
        vertex < 0 ? -1 : operations_of(sources[SHADER_FRAGMENT].text, SHADER_FRAGMENT, message);
    return fragment < 0 ? -1 : way->vertices * vertex + fragments * fragment;
}

bool budget_preprocess(const SubmissionFiles *files, SubmissionFiles *plain, Message *message)
{
    static const char *const names[] = {
        [SHADER_VERTEX] = "lab10.vert", [SHADER_FRAGMENT] = "lab10.frag"};
    const ShaderLoader loader = {.texts = files->texts, .only_texts = true};
    bool done = true;
    *plain = (SubmissionFiles){.count = 0};
    for (int stage = 0; stage < 2 && done; stage++) {
        ShaderSource source = {0};
        done = shader_source_open(&source, &loader, names[stage], (ShaderStage)stage, message);
        GlslTree *tree = done ? glsl_parse(source.text, (GlslStage)stage, NULL) : NULL;
        if (done && tree->message_count)
            done = message_set(message, "operations: %s", tree->messages[0].text);
        if (done)
            plain->texts[plain->count++] =
                (ShaderText){memory_text(names[stage]), glsl_print(tree, tree->root)};
        glsl_tree_free(tree);
        shader_source_close(&source);
    }
    if (!done)
        submission_files_close(plain);
    return done;
}

static long count_submission(const Way *way, const SubmissionFiles *files, long pixels,
                             Message *message)
{
    const ShaderLoader loader = {.texts = files->texts, .only_texts = true};
    ShaderSource sources[2] = {{0}};
    const bool done = shader_source_open(&sources[SHADER_VERTEX], &loader, "lab10.vert",
                                         SHADER_VERTEX, message) &&
                      shader_source_open(&sources[SHADER_FRAGMENT], &loader, "lab10.frag",
                                         SHADER_FRAGMENT, message);
    const long operations = done ? count(way, sources, pixels, message) : -1;
    shader_source_close(&sources[SHADER_VERTEX]);
    shader_source_close(&sources[SHADER_FRAGMENT]);
    return operations;
}

static long count_plain(const Way *plain, const Scene *scene, long pixels, Message *message)
{
    ShaderSource sources[2];
    if (!lighting_sources(plain->lighting, scene, &scene->objects[0], false, sources, message))
        return -1;
    const long operations = count(plain, sources, pixels, message);
    shader_source_close(&sources[SHADER_VERTEX]);
    shader_source_close(&sources[SHADER_FRAGMENT]);
    return operations;
}

/* If operations cannot be counted, the verdict says why; a right submission keeps five points. */
static void count_both(const Way *way, const Way *plain, const LabScene *lab_scene,
                       const SubmissionFiles *files, long pixels, Verdict *verdict)
{
    VerdictCost *cost = &verdict->cost;
    Message message = {0};
    const long own = count_submission(way, files, pixels, &message);
    const long whole = own < 0 ? -1 : count_plain(plain, &lab_scene->scene, pixels, &message);
    cost->known = whole > 0;
    cost->operations = (double)own;
    cost->operations_ratio = (double)own / (double)whole;
    if (!cost->known)
        snprintf(verdict->details, sizeof verdict->details,
                 "No points for the cost, because it was not counted: %.1000s", message.text);
}

static void give_points(Verdict *verdict)
{
    const double ratio = verdict->cost.operations_ratio;
    if (verdict->kind != VERDICT_RIGHT)
        return;
    verdict->points = 5;
    if (verdict->cost.known)
        verdict->points += floor(2 * 5 * fmin(fmax((1 - ratio) / (1 - CHEAP), 0), 1)) / 2;
}

bool budget_score(const LabBudget *budget, GLuint program, Canvas *canvas,
                  const SubmissionFiles *files, Verdict *verdict, Message *message)
{
    const Lab *lab = lab_find("10", message);
    const ShaderLoader loader = {.precision = "highp"};
    VerdictCost *cost = &verdict->cost;
    LabScene lab_scene = {.width = 0};
    long pixels = 0;
    Way way = {.program = program, .cull = budget->cull}, plain = {.cull = false};
    bool done = canvas_resize(canvas, SIZE, SIZE, message) &&
                lab_scene_open_usual(&lab_scene, lab, 1, message) &&
                lighting_open(&plain.lighting, &loader, message) &&
                open_mesh(&way, budget->slices, budget->stacks, message);
    const Setting setting = {lab, &lab_scene, canvas};
    done = done && measure(&way, &plain, &setting, &cost->time_ratio, message) &&
           count_pixels(&plain, &setting, &pixels, message);
    if (done) {
        plain.vertices = (long)lab_scene.meshes[0].vertex_count;
        count_both(&way, &plain, &lab_scene, files, pixels, verdict);
        for (int i = 0; i < verdict->probe_count; i++)
            cost->error = fmax(cost->error, verdict->probes[i].maximum);
        give_points(verdict);
    }
    mesh_buffer_close(&way.mesh);
    lighting_close(plain.lighting);
    lab_scene_close(&lab_scene);
    return done;
}
