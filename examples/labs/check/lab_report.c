/* Each of the likeliest mutations of the first solution is drawn as a submission would be. One that
 * no scene shows is either as right as the solution or a mistake that the scenes hide; a person has
 * to say which.
 */
#include "labs/check/judge.h"

#include "base/memory.h"
#include "labs/diagnosis/diagnose.h"
#include "labs/diagnosis/mutation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Report {
    const Lab *lab;
    LabPictures *pictures;
    Canvas *canvas;
    FILE *file;
    const char *name; /* of the stage's file */
    int drawn, hidden;
    bool failed;
    Message *message;
} Report;

static bool try_mutant(void *context, const Mutation *mutation, const char *text)
{
    Report *report = context;
    SubmissionFiles files = *report->lab->solutions;
    Shader shader = {0};
    bool shown = false;
    double most = 0;
    /* All of them take minutes and mostly find what is as right. */
    if (!mutation->likely)
        return true;
    for (int i = 0; i < files.count; i++)
        if (strcmp(files.texts[i].name, report->name) == 0)
            files.texts[i].text = text;
    if (!submission_compile(&shader, report->lab, &files, "highp", NULL) ||
        !binding_check(report->lab, &shader, NULL)) {
        shader_close(&shader);
        return true;
    }
    const Painter painter = {.lab = report->lab, .program = shader.program};
    LabPictures *pictures = report->pictures;
    report->failed = !lab_pictures_draw(pictures, &painter, report->canvas, report->message);
    shader_close(&shader);
    for (int i = 0; i < pictures->count && !report->failed; i++) {
        const double error = lab_picture_error(&pictures->items[i], pictures->truth).maximum;
        shown |= error > lab_pictures_tolerance(pictures, i);
        most = fmax(most, error);
    }
    report->drawn++;
    report->hidden += !shown;
    if (!shown && !report->failed)
        fprintf(report->file, "  %s: %s instead of %s, at most %.2f steps\n", mutation->name,
                mutation->by[0] ? mutation->by : "nothing", mutation->was, most);
    return !report->failed;
}

static bool try_stage(Report *report, GlslStage stage)
{
    char name[LAB_NAME_SIZE + 8];
    snprintf(name, sizeof name, "%s%s", report->lab->file,
             stage == GLSL_VERTEX ? ".vert" : ".frag");
    report->name = name;
    GlslTree *tree = glsl_parse(submission_file(report->lab->solutions, name), stage, NULL);
    if (tree->message_count == 0)
        mutations_each(tree, NULL, NULL, 0, try_mutant, report);
    else
        message_set(report->message, "%s: %s", name, tree->messages[0].text);
    report->failed |= tree->message_count > 0;
    glsl_tree_free(tree);
    return !report->failed;
}

bool lab_report(const Lab *lab, FILE *file, Message *message)
{
    const CanvasOptions options = {.width = 96, .height = 96};
    LabPictures *pictures = memory_new(1, sizeof *pictures);
    Canvas canvas = {0};
    LabSolutions right = {.shaders = {{0}}};
    Report report = {lab, pictures, &canvas, file, .message = message};
    bool done =
        (lab->solution_count || message_set(message, "%s: has no solution to change", lab->name)) &&
        lab_pictures_open(pictures, lab, 1, message) && canvas_open(&canvas, &options, message) &&
        lab_solutions_open(&right, lab, message) &&
        lab_pictures_use_solutions(pictures, right.painters, &canvas, message);
    if (done)
        fprintf(file, "Likely mistakes in the solution that no scene shows; some are as right:\n");
    done = done && try_stage(&report, GLSL_VERTEX) && try_stage(&report, GLSL_FRAGMENT);
    if (done)
        at_vertices_report(pictures, file, message);
    if (done)
        fprintf(file, "%d mistakes tried; shown: %d, not shown: %d\n", report.drawn,
                report.drawn - report.hidden, report.hidden);
    lab_solutions_close(&right);
    lab_pictures_close(pictures);
    free(pictures);
    canvas_close(&canvas);
    return done;
}
