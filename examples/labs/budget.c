#include "budget.h"

#include "lighting.h"
#include "operations.h"
#include "progress.h"
#include "statistics.h"

#include <math.h>
#include <stdlib.h>

enum { SIZE = 400, ROUNDS = 15 };

/* What is drawn in turn: the submission, or the scene by the chapter's own program. */
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

static bool frame(const Way *way, const Lab *lab, const Probe *probe, const Canvas *canvas,
                  double *seconds, Message *message)
{
    const Drawn drawn = {.scene = &probe->scene, .aspect = 1};
    const double start = progress_now();
    canvas_begin(canvas);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    if (way->cull)
        glEnable(GL_CULL_FACE);
    const bool done = way->lighting ? lighting_draw(way->lighting, &probe->scene, 1, false, message)
                                    : binding_draw(lab, way->program, &way->mesh, &drawn, message);
    glDisable(GL_CULL_FACE);
    glFinish();
    *seconds = progress_now() - start;
    return done;
}

/* The median of the ratios of frames drawn in turn. */
static bool measure(const Way *way, const Way *plain, const Lab *lab, const Probe *probe,
                    const Canvas *canvas, double *ratio, Message *message)
{
    double ratios[ROUNDS], first, second;
    for (int i = -1; i < ROUNDS; i++) {
        if (!frame(way, lab, probe, canvas, &first, message) ||
            !frame(plain, lab, probe, canvas, &second, message))
            return false;
        if (i >= 0)
            ratios[i] = first / second;
    }
    *ratio = statistics_quantile(ratios, ROUNDS, 0.5);
    return true;
}

static bool count_pixels(const Way *way, const Lab *lab, const Probe *probe, const Canvas *canvas,
                         long *pixels, Message *message)
{
    double seconds;
    Image image;
    *pixels = 0;
    if (!image_open(&image, SIZE, SIZE, IMAGE_BYTE, message))
        return false;
    const bool done =
        frame(way, lab, probe, canvas, &seconds, message) && canvas_read(canvas, &image, message);
    const unsigned char *p = image.pixels;
    for (int i = 0; i < SIZE * SIZE && done; i++)
        *pixels += p[4 * i] || p[4 * i + 1] || p[4 * i + 2];
    image_close(&image);
    return done;
}

/* -1 where no tool counts them. */
static long operations_of(const SubmissionFiles *files, const char *name, ShaderStage stage)
{
    const ShaderLoader loader = {.texts = files->texts, .only_texts = true};
    ShaderSource source;
    Operations counted;
    if (!shader_source_open(&source, &loader, name, stage, NULL))
        return -1;
    const bool done = operations_count(source.text, stage, &counted, NULL);
    shader_source_close(&source);
    return done ? counted.arithmetic + counted.special : -1;
}

static void count(const Way *way, const SubmissionFiles *files, long pixels, VerdictCost *cost)
{
    const long vertex = operations_of(files, "lab10.vert", SHADER_VERTEX);
    const long fragment = vertex < 0 ? -1 : operations_of(files, "lab10.frag", SHADER_FRAGMENT);
    cost->operations = vertex < 0 || fragment < 0 ? -1 : way->vertices * vertex + pixels * fragment;
}

static void give_points(Verdict *verdict)
{
    const double ratio = verdict->cost.time_ratio;
    if (verdict->kind == VERDICT_RIGHT)
        verdict->points = 5 + floor(2 * 5 * fmin(fmax(2 * (1 - ratio), 0), 1)) / 2;
}

bool budget_score(const LabBudget *budget, GLuint program, Canvas *canvas,
                  const SubmissionFiles *files, Verdict *verdict, Message *message)
{
    const Lab *lab = &LABS[LAB_COUNT - 1];
    const ShaderLoader loader = {.precision = "highp"};
    VerdictCost *cost = &verdict->cost;
    Probe probe = {.width = 0};
    long pixels = 0;
    Way way = {.program = program, .cull = budget->cull}, plain = {.cull = false};
    bool done = canvas_resize(canvas, SIZE, SIZE, message) &&
                probe_open_usual(&probe, lab, 1, message) &&
                lighting_open(&plain.lighting, &loader, message) &&
                open_mesh(&way, budget->slices, budget->stacks, message);
    done = done && measure(&way, &plain, lab, &probe, canvas, &cost->time_ratio, message) &&
           count_pixels(&way, lab, &probe, canvas, &pixels, message);
    if (done) {
        count(&way, files, pixels, cost);
        for (int i = 0; i < verdict->probe_count; i++)
            cost->error = fmax(cost->error, verdict->probes[i].maximum);
        cost->known = true;
        give_points(verdict);
    }
    mesh_buffer_close(&way.mesh);
    lighting_close(plain.lighting);
    probe_close(&probe);
    return done;
}
