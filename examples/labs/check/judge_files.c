/* Pictures as files. */
#include "base/output.h"
#include "images/image_file.h"
#include "labs/check/judge.h"
#include "labs/program/lab_scene_open.h"

#include <string.h>

bool judge_worst(const LabPictures *pictures, int number, const Image *value, const char *folder,
                 Message *message)
{
    Image sheet = {0};
    char path[PATH_MAX];
    const ImageOptions options = {.compress = IMAGE_COMPRESS_DEFAULT};
    const bool done = judge_sheet(pictures, number, value, &sheet, message) &&
                      output_folder(folder, message) &&
                      output_path(path, folder, JUDGE_WORST, message) &&
                      image_write(&sheet, path, &options, message);
    image_close(&sheet);
    return done;
}

/* Four samples a pixel, as the exact picture has smooth edges. */
static bool draw_solution(const Lab *lab, const LabScene *lab_scene, Image *image, Message *message)
{
    const CanvasOptions options = {
        .width = lab_scene->width, .height = lab_scene->height, .samples = 4};
    const SubmissionGeometry geometry = {.mesh = NULL};
    Canvas canvas = {0};
    Shader shader = {0};
    bool done = canvas_open(&canvas, &options, message) &&
                submission_compile(&shader, lab, lab->solutions, "highp", message) &&
                binding_check(lab, &shader, message) &&
                image_open(image, lab_scene->width, lab_scene->height, IMAGE_BYTE, message);
    const Painter painter = {.lab = lab, .program = shader.program};
    done = done && painter_draw(&painter, lab_scene, &geometry, &canvas, image, message);
    shader_close(&shader);
    canvas_close(&canvas);
    return done;
}

static bool is_plain(const Image *image)
{
    const size_t row = image_row_size(image), pixel = row / (size_t)image->width;
    const char *pixels = image->pixels;
    return memcmp(pixels, pixels + pixel, row * (size_t)image->height - pixel) == 0;
}

bool judge_expected(const Lab *lab, const char *path, Message *message)
{
    enum { SIZE = 400 };
    LabScene lab_scene;
    Reference exact = {.width = 0};
    Image image = {0};
    Object objects[LAB_SCENE_MAX_OBJECTS];
    const ReferenceOptions options = {.width = SIZE, .height = SIZE, .meshes = !lab->budget};
    if (!lab_scene_open_usual(&lab_scene, lab, 1, message))
        return false;
    const Scene scene = lab_pictures_truth_scene(lab, &lab_scene, 0, objects);
    const ImageOptions file = {.compress = 9};
    lab_scene.width = lab_scene.height = SIZE;
    const bool done =
        (lab->solution_count ? draw_solution(lab, &lab_scene, &image, message)
                             : reference_open(&exact, &scene, &options, message) &&
                                   reference_image(&exact, &image, message)) &&
        image_write(&image, path, &file, message) &&
        (!is_plain(&image) ||
         message_set(message, "the solution draws one colour and nothing else: what do "
                              "the uniforms in lab.json stand for?"));
    image_close(&image);
    reference_close(&exact);
    lab_scene_close(&lab_scene);
    return done;
}
