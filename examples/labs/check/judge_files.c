/* Pictures as files. */
#include "base/output.h"
#include "images/image_file.h"
#include "labs/check/judge.h"
#include "labs/check/judge_pictures.h"
#include "labs/program/probe_open.h"

#include <stdio.h>

bool judge_worst(const Shots *shots, int number, const char *folder, Message *message)
{
    Image sheet = {0};
    char path[PATH_MAX];
    const ImageOptions options = {.compress = IMAGE_COMPRESS_DEFAULT};
    bool done = judge_sheet(shots, number, &sheet, message);
    if (done && snprintf(path, sizeof path, "%s/%s", folder, JUDGE_WORST) >= (int)sizeof path)
        done = message_set(message, "%s: the path is too long", folder);
    done = done && output_folder(folder, message) && image_write(&sheet, path, &options, message);
    image_close(&sheet);
    return done;
}

bool judge_expected(const Lab *lab, const char *path, Message *message)
{
    enum { SIZE = 400 };
    Probe probe;
    Reference exact = {.width = 0};
    Image image = {0};
    Object objects[PROBE_MAX_OBJECTS];
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
