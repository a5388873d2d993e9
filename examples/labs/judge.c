#include "judge.h"

#include "budget.h"
#include "code.h"
#include "compile_advice.h"
#include "catalogue.h"
#include "diagnose.h"
#include "judge_pictures.h"
#include "progress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What is at hand while one submission is judged. */
typedef struct Session {
    const JudgeOptions *options;
    const Lab *lab;
    Verdict *verdict;
    Canvas canvas;
    SubmissionFiles files;
    Shader shader;
    Shots shots;
    LabBudget budget; /* lab 10 */
} Session;

/* Ends with a verdict about the submission itself: the first line is the message, the rest details.
 */
static bool settle(Verdict *verdict, VerdictKind kind, const Message *message, const char *advice)
{
    const char *newline = strchr(message->text, '\n');
    const int length = newline ? (int)(newline - message->text) : (int)strlen(message->text);
    verdict->kind = kind;
    snprintf(verdict->message, sizeof verdict->message, "%.*s", length, message->text);
    snprintf(verdict->details, sizeof verdict->details, "%s%s%s", newline ? newline + 1 : "",
             newline && advice ? "\n" : "", advice ? advice : "");
    return true;
}

/* False, with a verdict, where they are not what a submission may hold. */
static bool open_files(Session *session)
{
    Message own = {0};
    if (submission_files_open(&session->files, session->lab, session->options->folder, &own))
        return true;
    settle(session->verdict, VERDICT_REFUSED, &own, NULL);
    return false;
}

/* The given shaders are the lab's own. */
static bool open_given(Session *session, Message *message)
{
    char folder[PATH_MAX];
    if (!lab_folder(session->lab, folder, message))
        return false;
    const ShaderLoader loader = {.folder = folder, .precision = "highp"};
    return shader_open(&session->shader, &loader, session->lab->file, message);
}

/* Compiling with highp: what 16 bits do is looked at apart from what is wrong. */
static bool open_shader(Session *session, bool *settled, Message *message)
{
    Message own = {0};
    *settled = false;
    if (session->lab->given)
        return open_given(session, message);
    /* In lab 10 precision is one of the things to choose. */
    if (!submission_compile(&session->shader, session->lab, &session->files,
                            session->lab->budget ? NULL : "highp", &own)) {
        *settled = true;
        return settle(session->verdict, VERDICT_ERROR, &own, compile_advice(own.text));
    }
    if (!binding_check(session->lab, session->shader.program, &own)) {
        *settled = true;
        return settle(session->verdict, VERDICT_ERROR, &own, NULL);
    }
    return true;
}

/* Fills in what each scene came to; the number of the worst, or -1 where all are right. */
static int add_probes(const Shots *shots, Verdict *verdict)
{
    int worst = -1;
    for (int i = 0; i < shots->count; i++) {
        const Probe *probe = &shots->shots[i].probe;
        const ErrorSum error = shots_error(shots, i, shots->truth);
        VerdictProbe *line = &verdict->probes[verdict->probe_count++];
        *line = (VerdictProbe){.known = probe->known,
                               .width = probe->width,
                               .height = probe->height,
                               .seconds = probe->seconds,
                               .maximum = error.maximum,
                               .rms = error_sum_rms(&error),
                               .passed = error.maximum <= shots_tolerance(shots, i)};
        snprintf(line->name, sizeof line->name, "%s", PROBE_NAMES[probe->kind]);
        if (!line->passed && (worst < 0 || line->rms > verdict->probes[worst].rms))
            worst = i;
    }
    return worst;
}

/* Lab 3: the matrices of every scene's moment. */
static bool take_matrices(Session *session, const char *text, bool *settled, Message *message)
{
    double seconds[SHOTS_MOST];
    CodeMatrices matrices[SHOTS_MOST];
    Shots *shots = &session->shots;
    for (int i = 0; i < shots->count; i++)
        seconds[i] = shots->shots[i].probe.seconds;
    const bool done = code_matrices(session->lab, text, session->options->scratch, seconds,
                                    shots->count, matrices, session->verdict, message);
    *settled = !done && !message->text[0];
    for (int i = 0; i < shots->count && done; i++) {
        shots->world_from_object[i] = matrices[i].world_from_model;
        shots->normal_matrix[i] = matrices[i].normal_matrix;
    }
    return done || *settled;
}

/* What the submission's C says. */
static bool take_code(Session *session, bool *settled, Message *message)
{
    const Lab *lab = session->lab;
    const char *text = lab->code ? submission_file(&session->files, lab->code) : NULL;
    *settled = false;
    if (!text)
        return true;
    if (lab->given)
        return take_matrices(session, text, settled, message);
    const bool done = code_budget(lab, text, session->options->scratch, &session->budget,
                                  session->verdict, message);
    *settled = !done && !message->text[0];
    if (!done)
        return *settled;
    session->shots.geometry.cull = session->budget.cull;
    return shots_use_sphere(&session->shots, session->budget.slices, session->budget.stacks,
                            message);
}

/* What is right in 32 bits, in the precision that the file asks for and far away. Where light is
 * computed at the vertices or may be, the fragments' precision is the lecture's own. */
static bool look_at_precision(Session *session, Message *message)
{
    Shader shader;
    const Lab *lab = session->lab;
    if (lab->given || lab->budget || lab->either)
        return true;
    if (!submission_compile(&shader, lab, &session->files, NULL, message))
        return false;
    const Painter painter = {.lab = lab, .program = shader.program};
    const bool done = shots_draw_huge(&session->shots, session->verdict->seed, &painter,
                                      &session->canvas, message);
    shader_close(&shader);
    return done;
}

/* What is right wherever 32 bits are at hand counts as right, but for a point. */
static void note_overflow(Verdict *verdict)
{
    const Mistake *known = &MISTAKES[catalogue_find("mediump overflow")];
    verdict_add_mistake(verdict, known->name, known->sentence, known->look, 0.99);
    verdict->points -= 1;
    snprintf(verdict->message, sizeof verdict->message, "It is right, but for large scenes: %s",
             known->name);
}

static bool judge_pictures(Session *session, Message *message)
{
    Verdict *verdict = session->verdict;
    const Painter painter = {.lab = session->lab, .program = session->shader.program};
    if (!shots_draw(&session->shots, &painter, &session->canvas, message))
        return false;
    const int wrong = add_probes(&session->shots, verdict);
    int worst = wrong;
    verdict->kind = wrong < 0 ? VERDICT_RIGHT : VERDICT_WRONG;
    if (wrong < 0) {
        if (!look_at_precision(session, message))
            return false;
        verdict->probe_count = 0;
        worst = add_probes(&session->shots, verdict);
        snprintf(verdict->message, sizeof verdict->message, "It is right in all %d scenes",
                 verdict->probe_count);
    } else if (!diagnose(&session->shots, &painter, &session->canvas, verdict, message)) {
        return false;
    }
    verdict_score(verdict);
    if (wrong < 0 && worst >= 0)
        note_overflow(verdict);
    if (session->lab->budget && !budget_score(&session->budget, session->shader.program,
                                              &session->canvas, &session->files, verdict, message))
        return false;
    if (worst < 0 || !session->options->pictures)
        return true;
    snprintf(verdict->picture, sizeof verdict->picture, "%s", JUDGE_WORST);
    return judge_worst(&session->shots, worst, session->options->pictures, message);
}

static bool judge_submission(Session *session, Message *message)
{
    bool settled = false;
    const CanvasOptions canvas = {.backend = session->options->backend, .width = 96, .height = 96};
    if (!open_files(session))
        return true;
    if (!shots_open(&session->shots, session->lab, session->options->seed, message) ||
        !take_code(session, &settled, message))
        return false;
    if (settled)
        return true;
    if (!canvas_open(&session->canvas, &canvas, message) ||
        !open_shader(session, &settled, message))
        return false;
    return settled || judge_pictures(session, message);
}

bool judge(const JudgeOptions *options, Verdict *verdict, Message *message)
{
    const double start = progress_now();
    *verdict = (Verdict){.seed = options->seed};
    Session session = {.options = options, .lab = options->lab, .verdict = verdict};
    const bool done = judge_submission(&session, message);
    shots_close(&session.shots);
    shader_close(&session.shader);
    canvas_close(&session.canvas);
    submission_files_close(&session.files);
    verdict->seconds = progress_now() - start;
    return done;
}

bool judge_expected(const Lab *lab, const char *path, Message *message)
{
    enum { SIZE = 400 };
    Probe probe;
    Reference exact = {.width = 0};
    Image image = {0};
    Object objects[PROBE_MOST_OBJECTS];
    const ReferenceOptions options = {.width = SIZE, .height = SIZE, .meshes = !lab->budget};
    if (!probe_open_usual(&probe, lab, 1, message))
        return false;
    const Scene scene = shots_truth_scene(lab, &probe, 0, objects);
    const ImageOptions file = {.compress = 9};
    const bool done = reference_open(&exact, &scene, &options, message) &&
                      judge_exact_image(&exact, &image, message) &&
                      image_write(&image, path, &file, message);
    image_close(&image);
    reference_close(&exact);
    probe_close(&probe);
    return done;
}
