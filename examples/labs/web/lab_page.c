/* The calls of the labs' page (lab_page.h); texts are returned as JSON. */
#include "labs/web/lab_page.h"

#include "core/shader_files.h"
#include "kinds/exact_light.h"
#include "labs/check/code.h"
#include "labs/check/judge.h"
#include "labs/program/lab_scene_open.h"
#include "labs/submission/lab_json.h"
#include "labs/submission/verdict_fields.h"
#include "probe/probe.h"
#include "probe/show.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define FOLDER "/tmp/mine"

enum { SIZE = 400 };

static struct {
    Message message;
    const Lab *lab;
    Canvas canvas;
    Image drawn, right, shown; /* `shown` is page_pixels */
    Image worst;               /* that natively is a file */
    Reference exact;
    const Lab *exact_lab; /* of which it is, and when; NULL: there is none */
    double exact_seconds;
    char *text; /* returned */
    /* Of the captured picture: its scene, and what follows rays through it. */
    Capture capture;
    GlslArithmetic driver;
    bool captured;
    double seconds;
    LabScene lab_scene;
    Scene right_scene;
    Object right_objects[LAB_SCENE_MAX_OBJECTS];
    Trace *trace;
} page;

static const ReferenceOptions EXACT = {
    .width = SIZE, .height = SIZE, .meshes = true, .centers = true, .threads = 1};

bool judge_worst(const LabPictures *pictures, int picture, const Image *value, const char *folder,
                 Message *message)
{
    (void)folder;
    image_close(&page.worst);
    return judge_sheet(pictures, picture, value, &page.worst, message);
}

/* Replaces the text that was returned last by what is written. */
static FILE *text_begin(void)
{
    static size_t size;
    free(page.text);
    page.text = NULL;
    return open_memstream(&page.text, &size);
}

static const char *text_end(FILE *file)
{
    const bool whole = file && fclose(file) == 0;
    return whole && page.text ? page.text : "";
}

const char *page_message(void)
{
    return page.message.text;
}

static bool write_file(const char *name, const char *text, size_t size)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, name[0] == '/' ? "%s" : FOLDER "/%s", name);
    for (char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        mkdir(path, 0700);
        *slash = '/';
    }
    FILE *file = fopen(path, "w");
    const bool written = file && fwrite(text, 1, size, file) == size;
    return ((!file || fclose(file) == 0) && written) ||
           message_set(&page.message, "%s: cannot be kept", name);
}

int page_own(const char *path, const char *text)
{
    page.message = (Message){0};
    return write_file(path, text, strlen(text));
}

/* The starter's files in place of all. */
static bool restore(void)
{
    char folder[PATH_MAX], names[LAB_MAX_FILES][LAB_NAME_SIZE];
    SubmissionFiles starter;
    if (!lab_folder(page.lab, folder, &page.message) ||
        !submission_files_open(&starter, page.lab, folder, &page.message))
        return false;
    bool done = true;
    for (int i = 0, count = lab_files(page.lab, names); i < count && done; i++) {
        const char *text = submission_file(&starter, names[i]);
        done = write_file(names[i], text, strlen(text));
    }
    submission_files_close(&starter);
    return done;
}

int page_open(const char *name)
{
    page.message = (Message){0};
    page.lab = lab_open(name, &page.message);
    return page.lab && restore() ? 0 : 2;
}

int page_replace(const char *name, const char *text, int size)
{
    char names[LAB_MAX_FILES][LAB_NAME_SIZE];
    page.message = (Message){0};
    if (!page.lab)
        return message_set(&page.message, "no lab is open");
    if (!name[0])
        return restore();
    const int count = lab_files(page.lab, names);
    int i = 0;
    while (i < count && strcmp(names[i], name) != 0)
        i++;
    if (i == count)
        return message_set(&page.message, "%.80s: not a file of %s", name, page.lab->name);
    if (size > SHADER_FILE_MAX)
        return message_set(&page.message, "%s: has %d bytes; at most %d are read", name, size,
                           SHADER_FILE_MAX);
    return write_file(name, text, (size_t)size);
}

/* Pictures. */

static bool open_shader(Shader *shader)
{
    char given[PATH_MAX];
    if (page.lab->given && !lab_folder(page.lab, given, &page.message))
        return false;
    const ShaderLoader loader = {.folder = page.lab->given ? given : FOLDER, .advise = true};
    return shader_open(shader, &loader, page.lab->file, &page.message) &&
           binding_check(page.lab, shader, &page.message);
}

/* Lab 3: the starter's matrices, because its C is not compiled here; lab 10: the sphere. */
static bool choose(LabScene *lab_scene, SubmissionGeometry *geometry)
{
    static const Mat4 identity = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    if (page.lab->given)
        geometry->world_from_object = geometry->normal_matrix = &identity;
    if (!page.lab->budget)
        return true;
    static Verdict verdict; /* large */
    LabBudget budget;
    SubmissionFiles files;
    verdict.message[0] = '\0';
    if (!submission_files_open(&files, page.lab, FOLDER, &page.message))
        return false;
    const Code code = {
        .lab = page.lab, .text = submission_file(&files, page.lab->code), .verdict = &verdict};
    const bool read = code_budget(&code, &budget, &page.message) ||
                      (verdict.message[0] && message_set(&page.message, "%s", verdict.message));
    submission_files_close(&files);
    if (!read)
        return false;
    mesh_close(&lab_scene->meshes[0]);
    geometry->cull = budget.cull;
    return mesh_sphere(&lab_scene->meshes[0], 1, budget.slices, budget.stacks, &page.message);
}

static bool draw_scene(LabScene *lab_scene, const Shader *shader)
{
    SubmissionGeometry geometry = {.cull = false};
    const Painter painter = {.lab = page.lab, .program = shader->program};
    lab_scene->width = lab_scene->height = SIZE;
    return choose(lab_scene, &geometry) &&
           painter_draw(&painter, lab_scene, &geometry, &page.canvas, &page.drawn, &page.message);
}

/* What page_pixels are. */
static bool show(const Image *image)
{
    image_close(&page.shown);
    if (!image_open(&page.shown, image->width, image->height, IMAGE_BYTE, &page.message))
        return false;
    memcpy(page.shown.pixels, image->pixels, image_row_size(image) * (size_t)image->height);
    return true;
}

int page_draw(double seconds)
{
    const CanvasOptions options = {.width = SIZE, .height = SIZE};
    Shader shader = {0};
    LabScene lab_scene;
    page.message = (Message){0};
    if (!page.lab)
        return message_set(&page.message, "no lab is open");
    if (!page.canvas.backend && !canvas_open(&page.canvas, &options, &page.message))
        return 0;
    if (!page.drawn.pixels && !image_open(&page.drawn, SIZE, SIZE, IMAGE_BYTE, &page.message))
        return 0;
    if (!lab_scene_open_usual(&lab_scene, page.lab, seconds, &page.message))
        return 0;
    const bool done = open_shader(&shader) && draw_scene(&lab_scene, &shader) && show(&page.drawn);
    shader_close(&shader);
    lab_scene_close(&lab_scene);
    return done;
}

/* Of a lab that has solutions, what the first draws is right. */
static bool take_solution(LabScene *lab_scene)
{
    LabSolutions solutions = {.painters = {{NULL}}};
    lab_scene->width = lab_scene->height = SIZE;
    const bool done =
        !page.lab->solution_count ||
        (lab_solutions_open(&solutions, page.lab, &page.message) &&
         painter_draw(solutions.painters, lab_scene, &(SubmissionGeometry){.cull = false},
                      &page.canvas, &page.right, &page.message));
    lab_solutions_close(&solutions);
    if (done && page.lab->solution_count)
        compare_take(&page.exact, &page.right);
    return done;
}

int page_expected(double seconds)
{
    LabScene lab_scene;
    Object objects[LAB_SCENE_MAX_OBJECTS];
    page.message = (Message){0};
    if (!page.lab)
        return message_set(&page.message, "no lab is open");
    if (page.exact_lab == page.lab && page.exact_seconds == seconds)
        return show(&page.right);
    ReferenceOptions options = EXACT;
    options.meshes = !page.lab->budget;
    reference_close(&page.exact);
    image_close(&page.right);
    page.exact_lab = NULL;
    if (!lab_scene_open_usual(&lab_scene, page.lab, seconds, &page.message))
        return 0;
    const Scene scene = lab_pictures_truth_scene(page.lab, &lab_scene, 0, objects);
    bool done = reference_open(&page.exact, &scene, &options, &page.message);
    if (done)
        lab_pictures_leave_out_edges(&page.exact);
    done = done && reference_image(&page.exact, &page.right, &page.message) &&
           take_solution(&lab_scene) && show(&page.right);
    lab_scene_close(&lab_scene);
    page.exact_lab = done ? page.lab : NULL;
    page.exact_seconds = seconds;
    return done;
}

double page_difference(void)
{
    Image difference = {0};
    page.message = (Message){0};
    if (!page.exact_lab || !page.drawn.pixels) {
        message_set(&page.message, "nothing is drawn");
        return -1;
    }
    const ErrorSum error = compare_exact(&page.drawn, &page.exact, NULL);
    const bool done =
        judge_difference(&page.drawn, &page.right, &page.exact, &difference, &page.message) &&
        show(&difference);
    image_close(&difference);
    return done ? error.maximum : -1;
}

/* Pixels of the picture. */

static void end_capture(void)
{
    capture_close(&page.capture);
    trace_close(page.trace);
    lab_scene_close(&page.lab_scene);
    page.trace = NULL;
    page.captured = false;
}

int page_capture(const char *device, double seconds)
{
    Shader shader = {0};
    /* Opens what drawing needs; and a picture that cannot be drawn says so before. */
    if (!page_draw(seconds))
        return 0;
    end_capture();
    page.seconds = seconds;
    if (!glsl_arithmetic_read(device, &page.driver))
        return message_set(&page.message, "%s: no device's arithmetic", device);
    if (!lab_scene_open_usual(&page.lab_scene, page.lab, seconds, &page.message))
        return 0;
    capture_begin(&page.capture, &page.canvas);
    page.captured = open_shader(&shader) && draw_scene(&page.lab_scene, &shader);
    capture_end(&page.capture);
    shader_close(&shader);
    return page.captured;
}

/* Of what the lab's scene should be; false: not known. The equation of a lab that has solutions is
 * its own. */
static bool tell_exact(int column, int row, ExactPixel *exact)
{
    ReferenceOptions options = EXACT;
    options.meshes = !page.lab->budget;
    page.right_scene = lab_pictures_truth_scene(page.lab, &page.lab_scene, 0, page.right_objects);
    if (!page.trace && !trace_open(&page.trace, &page.right_scene, &options, NULL))
        return false;
    exact_light_tell(exact, page.trace, &page.right_scene, (int[]){0, 0, SIZE, SIZE},
                     (double[]){column + 0.5, row + 0.5}, false);
    if (!page.lab->solution_count)
        return true;
    if (exact->equation)
        exact->equation[0] = exact->terms[0] = '\0';
    if (!page_expected(page.seconds))
        return false;
    memcpy(exact->color, page.exact.color + 3 * (row * SIZE + column), sizeof exact->color);
    return true;
}

const char *page_probe(int column, int row)
{
    ExactPixel exact = {.equation = NULL};
    ProbeQuestion question = {.capture = &page.capture,
                              .driver = &page.driver,
                              .column = column,
                              .row = row,
                              .height = SIZE};
    Probe probe;
    page.message = (Message){0};
    if (!page.captured || column < 0 || row < 0 || column >= SIZE || row >= SIZE)
        return "";
    memcpy(question.drawn, (unsigned char *)page.drawn.pixels + 4 * (row * SIZE + column), 4);
    question.exact = tell_exact(column, row, &exact) ? &exact : NULL;
    free(page.text);
    page.text = probe_open(&probe, &question, &page.message) ? probe_json(&probe) : NULL;
    probe_close(&probe);
    free(exact.equation);
    free(exact.terms);
    return page.text ? page.text : "";
}

const char *page_names(void)
{
    FILE *file = text_begin();
    for (int stage = 1; stage >= 0 && file && page.captured; stage--)
        fputs(show_names(&page.capture, &page.driver, stage, file, &page.message) ? "\n" : "",
              file);
    return text_end(file);
}

const char *page_show(const char *what)
{
    Show show = {.pixels = NULL};
    page.message = (Message){0};
    image_close(&page.shown);
    FILE *legend = text_begin();
    const bool done = legend && page.captured &&
                      image_open(&page.shown, SIZE, SIZE, IMAGE_BYTE, &page.message) &&
                      show_open(&show, &page.capture, &page.driver, what[0] ? what : NULL,
                                (int[]){SIZE, SIZE}, &page.message);
    if (done)
        show_paint(&show, &page.shown, legend);
    show_close(&show);
    return text_end(legend);
}

const unsigned char *page_pixels(void)
{
    return page.shown.pixels;
}

int page_width(void)
{
    return page.shown.width;
}

int page_height(void)
{
    return page.shown.height;
}

/* As JSON, and as what `check` prints. */
static const char *put_verdict(const Verdict *verdict)
{
    char *printed = NULL;
    size_t size;
    FILE *file = open_memstream(&printed, &size);
    if (file) {
        verdict_print(verdict, page.lab, NULL, file);
        fclose(file);
    }
    file = text_begin();
    if (file) {
        JsonWriter json = {.file = file};
        json_write_object(&json, NULL);
        verdict_put(&json, verdict, page.lab->name);
        json_write_text(&json, "text", printed ? printed : "");
        json_write_end(&json);
    }
    free(printed);
    return text_end(file);
}

const char *page_check(double seed)
{
    static Verdict verdict; /* large */
    page.message = (Message){0};
    if (!page.lab) {
        message_set(&page.message, "no lab is open");
        return "";
    }
    SubmissionFiles files;
    canvas_close(&page.canvas); /* judge opens its own */
    image_close(&page.shown);
    const JudgeOptions options = {
        .lab = page.lab, .files = &files, .seed = (uint64_t)seed, .pictures = FOLDER};
    Message why = {0};
    bool done = submission_files_open(&files, page.lab, FOLDER, &why);
    if (!done)
        verdict_refuse(&verdict, page.lab, options.seed, &why);
    done = !done || judge(&options, &verdict, &page.message);
    submission_files_close(&files);
    if (!done)
        return "";
    image_close(&page.shown);
    page.shown = page.worst;
    page.worst = (Image){.width = 0};
    return put_verdict(&verdict);
}

void page_close(void)
{
    end_capture();
    canvas_close(&page.canvas);
    image_close(&page.drawn);
    image_close(&page.right);
    image_close(&page.shown);
    reference_close(&page.exact);
    page.exact_lab = page.lab = NULL;
}
