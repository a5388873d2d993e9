/* Files are opened below their folder's descriptor, without following links; shaders find only
 * these. Drawing is the same for a submission, the starter and a test's fake. */
#include "labs/submission/submission.h"

#include "base/input.h"
#include "base/memory.h"
#include "core/shader_files.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_ENTRIES = 1000 }; /* of a folder that are read */

static bool ends_in(const char *name, const char *end)
{
    const size_t length = strlen(name), size = strlen(end);
    return length > size && strcmp(name + length - size, end) == 0;
}

bool submission_files_add(SubmissionFiles *files, const char *name, const void *bytes, size_t size,
                          Message *message)
{
    if (size > SHADER_FILE_MAX)
        return message_set(message, "%s: has %zu bytes; at most %d are allowed", name, size,
                           SHADER_FILE_MAX);
    if (memchr(bytes, '\0', size))
        return message_set(message, "%s: not a text file", name);
    if (files->count == SUBMISSION_MAX_FILES)
        return message_set(message, "%s: more than %d files", name, SUBMISSION_MAX_FILES);
    files->texts[files->count++] = (ShaderText){memory_text(name), memory_copy(bytes, size)};
    return true;
}

static bool read_file(SubmissionFiles *files, int folder, const char *name, Message *message)
{
    size_t size;
    if (faccessat(folder, name, F_OK, AT_SYMLINK_NOFOLLOW) != 0 && errno == ENOENT)
        return message_set(message, "%s: " SUBMISSION_MISSING, name);
    char *bytes = input_read(folder, name, name, SHADER_FILE_MAX, &size, message);
    const bool done = bytes && submission_files_add(files, name, bytes, size, message);
    free(bytes);
    return done;
}

bool submission_may_include(const char *name)
{
    return ends_in(name, ".glsl") || ends_in(name, ".vert") || ends_in(name, ".frag");
}

/* Files that may be included; unreadable ones are ignored. */
static void read_others(SubmissionFiles *files, int folder)
{
    const int again = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *list = again >= 0 ? fdopendir(again) : NULL;
    if (!list && again >= 0)
        close(again);
    struct dirent *entry;
    for (int i = 0; list && i < MAX_ENTRIES && (entry = readdir(list)); i++)
        if (submission_may_include(entry->d_name) && !submission_file(files, entry->d_name))
            read_file(files, folder, entry->d_name, NULL);
    if (list)
        closedir(list);
}

bool submission_files_open(SubmissionFiles *files, const Lab *lab, const char *folder,
                           Message *message)
{
    char names[LAB_MAX_FILES][LAB_NAME_SIZE];
    *files = (SubmissionFiles){.count = 0};
    const int directory = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (directory < 0)
        return message_set(message, "%s: %s", folder,
                           errno == ENOTDIR ? "not a folder; name the folder with the files"
                                            : strerror(errno));
    bool done = true;
    for (int i = 0, count = lab_files(lab, names); i < count && done; i++)
        done = read_file(files, directory, names[i], message);
    if (done && !lab->given)
        read_others(files, directory);
    close(directory);
    if (!done)
        submission_files_close(files);
    return done;
}

const char *submission_file(const SubmissionFiles *files, const char *name)
{
    for (int i = 0; i < files->count; i++)
        if (strcmp(files->texts[i].name, name) == 0)
            return files->texts[i].text;
    return NULL;
}

void submission_files_close(SubmissionFiles *files)
{
    if (!files)
        return;
    for (int i = 0; i < files->count; i++) {
        free((char *)files->texts[i].name);
        free((char *)files->texts[i].text);
    }
    *files = (SubmissionFiles){.count = 0};
}

bool submission_compile(Shader *shader, const Lab *lab, const SubmissionFiles *files,
                        const char *precision, Message *message)
{
    const ShaderLoader loader = {
        .texts = files->texts, .only_texts = true, .precision = precision, .advise = true};
    return shader_open(shader, &loader, lab->file, message);
}

bool lab_scene_buffers_open(LabSceneBuffers *buffers, const LabScene *lab_scene,
                            const SubmissionGeometry *geometry, Message *message)
{
    bool done = true;
    *buffers = (LabSceneBuffers){.cull = geometry->cull};
    for (int i = 0; i < lab_scene->scene.object_count && done; i++)
        done = mesh_buffer_open(&buffers->buffers[i],
                                geometry->mesh ? geometry->mesh : &lab_scene->meshes[i], message);
    if (done && lab_shadow_map_open(&buffers->map, lab_scene, message))
        return true;
    lab_scene_buffers_close(buffers);
    return false;
}

void lab_scene_buffers_close(LabSceneBuffers *buffers)
{
    for (int i = 0; i < LAB_SCENE_MAX_OBJECTS; i++)
        mesh_buffer_close(&buffers->buffers[i]);
    lab_shadow_map_close(&buffers->map);
}

static bool paint(const Painter *painter, const LabScene *lab_scene,
                  const SubmissionGeometry *geometry, Message *message)
{
    LabSceneBuffers buffers;
    bool done = lab_scene_buffers_open(&buffers, lab_scene, geometry, message);
    for (int i = 0; i < lab_scene->scene.object_count && done; i++) {
        const Drawn drawn = {.scene = &lab_scene->scene,
                             .object = i,
                             .aspect = (double)lab_scene->width / lab_scene->height,
                             .world_from_object = geometry->world_from_object,
                             .normal_matrix = geometry->normal_matrix,
                             .map = &buffers.map,
                             .own = lab_scene->own};
        done = binding_draw(painter->lab, painter->program, &buffers.buffers[i], &drawn, message);
    }
    lab_scene_buffers_close(&buffers);
    return done;
}

static bool read_part(PainterView view, Image *image, Message *message)
{
    const int left = view.left, top = view.top;
    Image whole;
    if (left == 0 && top == 0)
        return canvas_read(view.canvas, image, message);
    if (!image_open(&whole, left + image->width, top + image->height, IMAGE_BYTE, message))
        return false;
    const bool done = canvas_read(view.canvas, &whole, message);
    for (int y = 0; y < image->height && done; y++)
        memcpy((unsigned char *)image->pixels + 4 * (size_t)y * (size_t)image->width,
               (const unsigned char *)whole.pixels +
                   4 * ((size_t)(y + top) * (size_t)whole.width + (size_t)left),
               4 * (size_t)image->width);
    image_close(&whole);
    return done;
}

bool painter_draw_at(const Painter *painter, const LabScene *lab_scene,
                     const SubmissionGeometry *geometry, PainterView view, Image *image,
                     Message *message)
{
    if (!canvas_resize(view.canvas, view.left + lab_scene->width, view.top + lab_scene->height,
                       message))
        return false;
    canvas_clear(view.canvas, lab_scene->scene.background, 1);
    canvas_view(view.canvas, view.left, view.top, lab_scene->width, lab_scene->height);
    glEnable(GL_DEPTH_TEST);
    if (geometry->cull)
        glEnable(GL_CULL_FACE);
    const bool done = paint(painter, lab_scene, geometry, message);
    glDisable(GL_CULL_FACE);
    return done && read_part(view, image, message);
}

bool painter_draw(const Painter *painter, const LabScene *lab_scene,
                  const SubmissionGeometry *geometry, Canvas *canvas, Image *image,
                  Message *message)
{
    return painter_draw_at(painter, lab_scene, geometry, (PainterView){canvas, 0, 0}, image,
                           message);
}

bool lab_solutions_open(LabSolutions *solutions, const Lab *lab, Message *message)
{
    for (int i = 0; i < lab->solution_count; i++) {
        Shader *shader = &solutions->shaders[i];
        const SubmissionFiles *files = &lab->solutions[i];
        Message why = {.text = ""};
        if ((!submission_compile(shader, lab, files, "highp", NULL) &&
             !submission_compile(shader, lab, files, NULL, &why)) ||
            !binding_check(lab, shader, &why)) {
            for (char *at = why.text; *at; at++)
                *at = *at == '\n' ? ' ' : *at;
            return message_set(message, "the solution of %.200s: %.700s", lab->name, why.text);
        }
        solutions->painters[i] = (Painter){.lab = lab, .program = shader->program};
    }
    return true;
}

void lab_solutions_close(LabSolutions *solutions)
{
    for (int i = 0; i < LAB_MAX_SOLUTIONS; i++)
        shader_close(&solutions->shaders[i]);
}
