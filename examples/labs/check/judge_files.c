/* Pictures as files. */
#include "base/output.h"
#include "images/image_file.h"
#include "labs/check/judge.h"
#include "labs/program/lab_scene_open.h"

bool judge_worst(const LabPictures *pictures, int number, const char *folder, Message *message)
{
    Image sheet = {0};
    char path[PATH_MAX];
    const ImageOptions options = {.compress = IMAGE_COMPRESS_DEFAULT};
    const bool done = judge_sheet(pictures, number, &sheet, message) &&
                      output_folder(folder, message) &&
                      output_path(path, folder, JUDGE_WORST, message) &&
                      image_write(&sheet, path, &options, message);
    image_close(&sheet);
    return done;
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
    const bool done = reference_open(&exact, &scene, &options, message) &&
                      reference_image(&exact, &image, message) &&
                      image_write(&image, path, &file, message);
    image_close(&image);
    reference_close(&exact);
    lab_scene_close(&lab_scene);
    return done;
}
