/* Draw, compare, explain: the submission is drawn in all scenes and compared with the exact
 * pictures inside the objects; then its outline, other sizes, its text and its own precision are
 * looked at; only what is wrong is diagnosed. */
#include "labs/check/judge.h"

#include "base/clock.h"
#include "core/shader_source.h"
#include "labs/check/budget.h"
#include "labs/check/code.h"
#include "labs/diagnosis/diagnose.h"
#include "labs/diagnosis/text_facts.h"
#include "labs/submission/submission.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Session {
    const JudgeOptions *options;
    const Lab *lab;
    Verdict *verdict;
    Canvas canvas;
    const SubmissionFiles *files;
    SubmissionFiles plain; /* lab 10: its shaders, preprocessed; none: they cannot be */
    Shader shader, own;    /* the latter with the files' own precision, if that is another */
    LabPictures pictures;
    LabBudget budget; /* lab 10 */
    bool settled;     /* the submission is at fault: there is a verdict */
    bool moved;       /* its outline is wrong */
    LabSolutions right;
    FirstWrong first;
} Session;

/* Settles on a verdict: the first line is the message, the others are details. */
static bool settle(Session *session, VerdictKind kind, const Message *message)
{
    Verdict *verdict = session->verdict;
    /* An error comes before warnings. */
    const char *first = strstr(message->text, "error:");
    if (!first || kind != VERDICT_ERROR || strncmp(message->text, session->lab->file, 5) != 0)
        first = message->text;
    while (first > message->text && first[-1] != '\n')
        first--;
    const size_t length = strcspn(first, "\n");
    const char *rest = first[length] ? first + length + 1 : first + length;
    session->settled = true;
    verdict->kind = kind;
    snprintf(verdict->message, sizeof verdict->message, "%.*s", (int)length, first);
    snprintf(verdict->details, sizeof verdict->details, "%.*s%s", (int)(first - message->text),
             message->text, rest);
    return true;
}

static bool open_given(Session *session, Message *message)
{
    char folder[PATH_MAX];
    if (!lab_folder(session->lab, folder, message))
        return false;
    const ShaderLoader loader = {.folder = folder, .precision = "highp"};
    return shader_open(&session->shader, &loader, session->lab->file, message);
}

/* What the lab's solutions draw becomes what is right. */
static bool take_solutions(Session *session, Message *message)
{
    return !session->lab->solution_count ||
           (lab_solutions_open(&session->right, session->lab, message) &&
            lab_pictures_use_solutions(&session->pictures, session->right.painters,
                                       &session->canvas, message));
}

/* As the files are written. */
static GLuint own_program(const Session *session)
{
    return session->own.program ? session->own.program : session->shader.program;
}

/* What "highp" would replace. */
static bool has_mediump(const SubmissionFiles *files)
{
    for (int i = 0; i < files->count; i++)
        if (strstr(files->texts[i].text, "mediump"))
            return true;
    return false;
}

/* At most this many turns of loops for a vertex or a pixel: the labs need a dozen. Drivers stop a
 * loop when they like to, and then draw. */
enum { TURNS_MAX = 100000 };

/* What the driver gets is what every other compiler would, and ends. */
static bool check_conditions(const Session *session, Message *message)
{
    static const char *const endings[] = {[SHADER_VERTEX] = ".vert", [SHADER_FRAGMENT] = ".frag"};
    const ShaderLoader loader = {.texts = session->files->texts, .only_texts = true};
    bool done = true;
    for (int stage = 0; stage < 2 && done; stage++) {
        char name[64];
        ShaderSource source = {0};
        Message why = {0};
        snprintf(name, sizeof name, "%s%s", session->lab->file, endings[stage]);
        done = shader_source_open(&source, &loader, name, (ShaderStage)stage, message);
        if (done && !compiler_dependence_check(source.text, &why))
            done = message_set(message, "%s: %s", name, why.text);
        done = done && shader_bounded(&source, (ShaderStage)stage, TURNS_MAX, message);
        shader_source_close(&source);
    }
    return done;
}

/* Compiles with the file's own precision, as the student's program does, then with highp: 16-bit
 * errors are judged separately. Lab 10 lets the student choose the precision. */
static bool open_shader(Session *session, Message *message)
{
    Message own = {0};
    if (session->lab->given)
        return open_given(session, message);
    if (!submission_compile(&session->own, session->lab, session->files, NULL, &own))
        return settle(session, VERDICT_ERROR, &own);
    if (!binding_check(session->lab, &session->own, &own))
        return settle(session, VERDICT_ERROR, &own);
    if (!check_conditions(session, &own))
        return settle(session, VERDICT_REFUSED, &own);
    if (session->lab->budget) {
        /* The driver draws the very text that is counted. */
        if (!budget_preprocess(session->files, &session->plain, NULL) ||
            !submission_compile(&session->shader, session->lab, &session->plain, NULL, NULL))
            return submission_compile(&session->shader, session->lab, session->files, NULL,
                                      message);
        return true;
    }
    if (!has_mediump(session->files)) {
        session->shader = session->own;
        session->own = (Shader){0};
        return true;
    }
    /* What links only as it is, is drawn as it is. */
    return submission_compile(&session->shader, session->lab, session->files, "highp", NULL) ||
           submission_compile(&session->shader, session->lab, session->files, NULL, message);
}

/* Adds each scene's result; returns the worst, or -1 if all are right. */
static int add_probes(const LabPictures *pictures, Verdict *verdict)
{
    int worst = -1;
    for (int i = 0; i < pictures->count; i++) {
        const LabScene *lab_scene = &pictures->items[i].lab_scene;
        const ErrorSum error = lab_picture_error(&pictures->items[i], pictures->truth);
        VerdictProbe *line = &verdict->probes[verdict->probe_count++];
        *line = (VerdictProbe){.known = lab_scene->known,
                               .width = lab_scene->width,
                               .height = lab_scene->height,
                               .seconds = lab_scene->seconds,
                               .maximum = error.maximum,
                               .rms = error_sum_rms(&error),
                               .passed = error.maximum <= lab_pictures_tolerance(pictures, i)};
        snprintf(line->name, sizeof line->name, "%s", LAB_SCENE_NAMES[lab_scene->kind]);
        if (!line->passed && (worst < 0 || line->rms > verdict->probes[worst].rms))
            worst = i;
    }
    return worst;
}

/* Lab 3: the matrices at every scene's time. */
static bool take_matrices(Session *session, const Code *code, Message *message)
{
    double seconds[LAB_PICTURES_MAX];
    CodeMatrices matrices[LAB_PICTURES_MAX];
    LabPictures *pictures = &session->pictures;
    for (int i = 0; i < pictures->count; i++)
        seconds[i] = pictures->items[i].lab_scene.seconds;
    if (!code_matrices(code, seconds, pictures->count, matrices, message))
        return false;
    for (int i = 0; i < pictures->count; i++) {
        pictures->world_from_object[i] = matrices[i].world_from_model;
        pictures->normal_matrix[i] = matrices[i].normal_matrix;
    }
    return true;
}

/* Lab 10: the mesh. */
static bool take_budget(Session *session, const Code *code, Message *message)
{
    if (!code_budget(code, &session->budget, message))
        return false;
    session->pictures.geometry.cull = session->budget.cull;
    return lab_pictures_use_sphere(&session->pictures, session->budget.slices,
                                   session->budget.stacks, message);
}

static bool take_code(Session *session, Message *message)
{
    const Lab *lab = session->lab;
    const Code code = {lab, lab->code ? submission_file(session->files, lab->code) : NULL,
                       session->options->scratch, session->verdict};
    if (!code.text || (lab->given ? take_matrices(session, &code, message)
                                  : take_budget(session, &code, message)))
        return true;
    session->settled = !message->text[0];
    return session->settled;
}

/* Draws a right submission again with its own precision: far away or, in labs whose fragment
 * shaders have the lecture's mediump, the same scenes. */
static bool look_at_precision(Session *session, Message *message)
{
    const Lab *lab = session->lab;
    const Painter painter = {.lab = lab, .program = own_program(session)};
    if (lab->given || lab->budget || lab->solution_count)
        return true;
    session->pictures.own = lab->either;
    return lab->either ? lab_pictures_draw(&session->pictures, &painter, &session->canvas, message)
                       : lab_pictures_draw_huge(&session->pictures, session->verdict->seed,
                                                &painter, &session->canvas, message);
}

/* What no text says: found by drawing otherwise. */
typedef struct Blame {
    const char *name, *sentence, *look;
} Blame;
static const Blame
    MESH =
        {"mesh too coarse",
         "Right shaders draw something else with this mesh, too: it has too few slices or stacks.",
         "slices and stacks in budget.c"},
    MEDIUMP = {"mediump too coarse",
               "In 32 bits the same shaders are right: mediump has 11 significant bits.",
               "the fragment shader's precision: highp float"},
    OVERFLOW = {"mediump overflow", "It fails at large distances: their squares overflow 16 bits.",
                "the fragment shader's precision: highp float"},
    LOWP = {"lowp may have too few bits", "lowp has as few as 9 bits, for numbers from -2 to 2.",
            "the fragment shader's precision: highp float"},
    SIZE = {"depends on the picture's size",
            "The picture is right at small sizes, and wrong at a larger one or at another place.",
            "the uses of gl_FragCoord"};

static void blame(Verdict *verdict, const char *before, Blame what)
{
    verdict_add_mistake(verdict, what.name, what.sentence, what.look, 0.9);
    snprintf(verdict->message, sizeof verdict->message, "%s%s", before, what.name);
}

/* Lab 10: a mesh that is too coarse for right shaders, too, or mediump. *found: it is that. */
static bool look_at_budget(Session *session, bool of_mesh, bool *found, Message *message)
{
    const ShaderLoader loader = {.precision = "highp"};
    char name[PATH_MAX];
    Shader shader = {0};
    bool right = false;
    *found = false;
    if (!session->lab->budget)
        return true;
    snprintf(name, sizeof name, "labs/solutions/%s/%s", session->lab->name, session->lab->file);
    if (of_mesh ? !shader_open(&shader, &loader, name, message)
                : !submission_compile(&shader, session->lab, session->files, "highp", NULL))
        return !of_mesh;
    const Painter painter = {.lab = session->lab, .program = shader.program};
    const bool done =
        lab_pictures_is_right(&session->pictures, &painter, &session->canvas, &right, message);
    shader_close(&shader);
    *found = done && right != of_mesh;
    if (*found)
        blame(session->verdict, "", of_mesh ? MESH : MEDIUMP);
    return done;
}

/* By its shaders, unless, lab 10, they cannot be right with its mesh. */
static bool explain_shaders(Session *session, Message *message)
{
    Verdict *verdict = session->verdict;
    bool found;
    if (!look_at_budget(session, true, &found, message))
        return false;
    if (!found && !diagnose(&session->pictures, &session->canvas, session->files, verdict,
                            &session->first, message))
        return false;
    if (verdict->mistake_count == 0 && !look_at_budget(session, false, &found, message))
        return false;
    if (verdict->mistake_count == 0 && text_has_word(session->files, "lowp"))
        blame(verdict, "", LOWP);
    return true;
}

/* Says why the submission is wrong. */
static bool explain(Session *session, const char *numbers, Message *message)
{
    Verdict *verdict = session->verdict;
    if (text_is_starter(session->lab, session->files)) {
        snprintf(verdict->message, sizeof verdict->message, "unchanged: this is the starter");
        return true;
    }
    if (session->lab->given) {
        matrices_name(&session->pictures, submission_file(session->files, session->lab->code),
                      verdict);
    } else if (numbers[0]) {
        if (text_has_word(session->files, "gl_FragCoord"))
            blame(verdict, "", SIZE);
        else
            snprintf(verdict->message, sizeof verdict->message, "right in small scenes only");
    } else if (!explain_shaders(session, message)) {
        return false;
    }
    if (!parts_judge(&session->pictures, session->files, verdict, message))
        return false;
    if (numbers[0])
        verdict_add_symptom(verdict, "%s", numbers);
    if (session->lab->given || !numbers[0])
        symptoms_describe(&session->pictures, session->moved, verdict);
    return true;
}

/* What the pictures' insides do not show: lab 3's numbers, and the outline. */
static bool look_closer(Session *session, const Painter *painter, int worst, bool *wrong,
                        char numbers[VERDICT_SENTENCE_SIZE], Message *message)
{
    numbers[0] = '\0';
    bool right = true;
    if (!outline_check(&session->pictures, painter, &session->canvas, &session->moved, message))
        return false;
    bool bent = false; /* the solution itself moves vertices */
    if (session->moved && session->lab->solution_count &&
        !outline_check(&session->pictures, session->right.painters, &session->canvas, &bent,
                       message))
        return false;
    session->moved &= !bent;
    *wrong =
        session->lab->given ? !matrices_are_right(&session->pictures, numbers) : session->moved;
    if (worst < 0 && !*wrong && !session->lab->given &&
        !lab_pictures_check_sizes(&session->pictures, session->options->seed, painter,
                                  &session->canvas, &right, message))
        return false;
    if (!right) {
        *wrong = true;
        snprintf(numbers, VERDICT_SENTENCE_SIZE, "%s",
                 text_has_word(session->files, "gl_FragCoord")
                     ? "The picture is right at small sizes only: it depends on the picture's size "
                       "or place, as by gl_FragCoord."
                     : "The scenes are right, but in a picture of some 400x400 pixels the error is "
                       "too large: as by a mesh or a precision that is just too coarse.");
    }
    return true;
}

void judge_limit(rlim_t seconds)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_CPU, &limit) != 0)
        return;
    limit.rlim_cur = seconds < limit.rlim_max ? seconds : limit.rlim_max;
    setrlimit(RLIMIT_CPU, &limit);
}

static bool judge_pictures(Session *session, Message *message)
{
    Verdict *verdict = session->verdict;
    const Painter painter = {.lab = session->lab, .program = session->shader.program};
    char numbers[VERDICT_SENTENCE_SIZE];
    bool outside;
    if (!lab_pictures_draw(&session->pictures, &painter, &session->canvas, message))
        return false;
    judge_limit(RLIM_INFINITY);
    int worst = add_probes(&session->pictures, verdict);
    if (!look_closer(session, &painter, worst, &outside, numbers, message))
        return false;
    bool wrong = worst >= 0 || outside, chance = false; /* right by chance */
    if (!wrong && !session->lab->given &&
        !undefined_warn(&session->pictures, session->files, verdict, &chance, message))
        return false;
    wrong |= chance;
    verdict->kind = wrong ? VERDICT_WRONG : VERDICT_RIGHT;
    if (!wrong) {
        if (!look_at_precision(session, message))
            return false;
        verdict->probe_count = 0;
        worst = add_probes(&session->pictures, verdict);
        snprintf(verdict->message, sizeof verdict->message, "Right in all %d scenes",
                 verdict->probe_count);
    } else if (!chance && !explain(session, numbers, message)) {
        return false;
    }
    verdict_score(verdict, session->lab);
    if (!wrong && worst >= 0) { /* right in 32 bits counts as right, minus a point */
        blame(verdict, "Right except in large scenes: ", OVERFLOW);
        verdict->points -= 1;
    }
    if (session->lab->budget &&
        !budget_score(&session->budget, session->shader.program, &session->canvas,
                      session->plain.count ? &session->plain : session->files, verdict, message))
        return false;
    if (worst < 0 || !session->options->pictures)
        return true;
    snprintf(verdict->picture, sizeof verdict->picture, "%s", JUDGE_WORST);
    judge_value(&session->pictures, worst, session->files, &session->first, &session->canvas,
                verdict);
    return judge_worst(&session->pictures, worst, &session->first.value, session->options->pictures,
                       message);
}

static bool judge_submission(Session *session, Message *message)
{
    const CanvasOptions canvas = {.backend = session->options->backend, .width = 96, .height = 96};
    bool done =
        lab_pictures_open(&session->pictures, session->lab, session->options->seed, message) &&
        take_code(session, message);
    if (done && !session->settled)
        done = canvas_open(&session->canvas, &canvas, message) &&
               take_solutions(session, message) && open_shader(session, message);
    if (done && !session->settled)
        done = judge_pictures(session, message);
    return done;
}

bool judge(const JudgeOptions *options, Verdict *verdict, Message *message)
{
    const double start = clock_now();
    verdict_begin(verdict, options->lab, options->seed);
    Session session = {
        .options = options, .lab = options->lab, .verdict = verdict, .files = options->files};
    const bool done = judge_submission(&session, message);
    lab_pictures_close(&session.pictures);
    shader_close(&session.shader);
    shader_close(&session.own);
    lab_solutions_close(&session.right);
    submission_files_close(&session.plain);
    canvas_close(&session.canvas);
    free(session.first.right);
    image_close(&session.first.value);
    verdict->seconds = clock_now() - start;
    return done;
}
