#include "submission.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_ENTRIES = 1000 }; /* that are looked at in a folder */

static bool ends_in(const char *name, const char *end)
{
    const size_t length = strlen(name), size = strlen(end);
    return length > size && strcmp(name + length - size, end) == 0;
}

static bool read_text(int file, const char *name, size_t size, char **text, Message *message)
{
    size_t got = 0;
    ssize_t part = 0;
    *text = malloc(size + 1);
    if (!*text)
        return message_set(message, "%s: not enough memory", name);
    while (got < size && (part = read(file, *text + got, size - got)) > 0)
        got += (size_t)part;
    (*text)[got] = '\0';
    if (part >= 0 && strlen(*text) == got)
        return true;
    message_set(message, "%s: %s", name, part < 0 ? strerror(errno) : "is not text");
    free(*text);
    return false;
}

/* Reads one file of an open folder; links are not followed, nothing is waited for. */
static bool read_file(SubmissionFiles *files, int folder, const char *name, Message *message)
{
    struct stat status;
    char *text = NULL, *copy = NULL;
    const int file = openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0)
        return message_set(message, "%s: %s", name,
                           errno == ELOOP    ? "is a link; hand in the file itself"
                           : errno == ENOENT ? "is missing from the folder"
                                             : strerror(errno));
    bool done = fstat(file, &status) == 0;
    if (!done)
        message_set(message, "%s: %s", name, strerror(errno));
    else if (!S_ISREG(status.st_mode))
        done = message_set(message, "%s: is not a regular file", name);
    else if (status.st_size > SHADER_FILE_MOST)
        done = message_set(message, "%s: has %lld bytes; a file of a submission has at most %d",
                           name, (long long)status.st_size, SHADER_FILE_MOST);
    done = done && read_text(file, name, (size_t)status.st_size, &text, message);
    close(file);
    if (!done)
        return false;
    copy = strdup(name);
    if (!copy || files->count == SUBMISSION_MOST_FILES) {
        free(copy);
        free(text);
        return message_set(message, "%s: is the one more than %d files", name,
                           SUBMISSION_MOST_FILES);
    }
    files->texts[files->count++] = (ShaderText){copy, text};
    return true;
}

/* What may be included; a file that cannot be read is as good as absent. */
static void read_others(SubmissionFiles *files, int folder)
{
    const int again = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *list = again >= 0 ? fdopendir(again) : NULL;
    if (!list && again >= 0)
        close(again);
    struct dirent *entry;
    for (int i = 0; list && i < MOST_ENTRIES && (entry = readdir(list)); i++)
        if ((ends_in(entry->d_name, ".glsl") || ends_in(entry->d_name, ".vert") ||
             ends_in(entry->d_name, ".frag")) &&
            !submission_file(files, entry->d_name))
            read_file(files, folder, entry->d_name, NULL);
    if (list)
        closedir(list);
}

bool submission_files_open(SubmissionFiles *files, const Lab *lab, const char *folder,
                           Message *message)
{
    static const char *const endings[] = {".vert", ".frag"};
    *files = (SubmissionFiles){.count = 0};
    const int directory = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (directory < 0)
        return message_set(message, "%s: %s", folder,
                           errno == ENOTDIR ? "is not a folder; name the one that holds the files"
                                            : strerror(errno));
    bool done = true;
    for (int i = 0; i < 2 && done && !lab->given; i++) {
        char name[64];
        snprintf(name, sizeof name, "%s%s", lab->file, endings[i]);
        done = read_file(files, directory, name, message);
    }
    if (done && lab->code)
        done = read_file(files, directory, lab->code, message);
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
    const ShaderLoader loader = {.texts = files->texts, .only_texts = true, .precision = precision};
    return shader_open(shader, &loader, lab->file, message);
}

static bool draw_object(const Lab *lab, GLuint program, const Probe *probe, int i,
                        const SubmissionGeometry *geometry, Message *message)
{
    MeshBuffer mesh;
    const Drawn drawn = {.scene = &probe->scene,
                         .object = i,
                         .aspect = (double)probe->width / probe->height,
                         .world_from_object = geometry->world_from_object,
                         .normal_matrix = geometry->normal_matrix};
    const Mesh *shape = geometry->mesh ? geometry->mesh : probe->objects[i].mesh;
    if (!mesh_buffer_open(&mesh, shape, message))
        return false;
    const bool done = binding_draw(lab, program, &mesh, &drawn, message);
    mesh_buffer_close(&mesh);
    return done;
}

static bool paint(const Painter *painter, const Probe *probe, const SubmissionGeometry *geometry,
                  Message *message)
{
    for (int i = 0; i < probe->scene.object_count; i++)
        if (!draw_object(painter->lab, painter->program, probe, i, geometry, message))
            return false;
    return true;
}

bool painter_draw(const Painter *painter, const Probe *probe, const SubmissionGeometry *geometry,
                  Canvas *canvas, Image *image, Message *message)
{
    if (!canvas_resize(canvas, probe->width, probe->height, message))
        return false;
    canvas_clear(canvas, probe->scene.background, 1);
    glEnable(GL_DEPTH_TEST);
    if (geometry->cull)
        glEnable(GL_CULL_FACE);
    const bool done = painter->paint ? painter->paint(painter, probe, geometry, message)
                                     : paint(painter, probe, geometry, message);
    glDisable(GL_CULL_FACE);
    return done && canvas_read(canvas, image, message);
}
