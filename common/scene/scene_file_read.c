/*
 * A file from anywhere, and libraries of a hundred parsers. They read it in a child process, whose
 * time and memory are limited by the file's size, and which sends back lists and meshes through a
 * pipe: it may loop, crash or lie. The parent believes the counts only up to the limits, and checks
 * every number and index.
 */
#include "base/output.h"
#include "base/process.h"
#include "core/matrix_vectors.h"
#include "core/mesh_make.h"
#include "scene/model_module.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static Plugin assimp = {PLUGIN_MODELS};

static bool check_file(const char *path, off_t *size, Message *message)
{
    struct stat status;
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC); /* a pipe does not block */
    if (file < 0 || fstat(file, &status) != 0) {
        message_set(message, "%s: %s", path, strerror(errno));
        if (file >= 0)
            close(file);
        return false;
    }
    close(file);
    if (S_ISDIR(status.st_mode))
        return message_set(message, "%s: is a folder; name a model file", path);
    if (!S_ISREG(status.st_mode))
        return message_set(message, "%s: is not a file; a model cannot be read from it", path);
    if (status.st_size == 0)
        return message_set(message, "%s: is empty", path);
    if (status.st_size > MODEL_BYTES_MAX)
        return message_set(message, "%s: %lld bytes; model files of at most %d are read", path,
                           (long long)status.st_size, MODEL_BYTES_MAX);
    *size = status.st_size;
    return true;
}

/* A child process sends an Answer, the lists but the meshes', and each mesh: an AnswerMesh, its
 * vertices, indices, and what else it has of each vertex. */

typedef struct Answer {
    bool read, photometric, own, turns;
    Scene scene;
    int counts[FILE_LISTS];
    char reason[1024];
} Answer;

typedef struct AnswerMesh {
    size_t vertex_count, index_count;
    bool colors, lit_positions;
} AnswerMesh;

/* Time and memory beyond what the process has that no sound file of this size needs. */
static void limit_child(off_t size)
{
    const rlim_t mebibyte = 1 << 20, file = (rlim_t)size;
    unsigned long pages = 0;
    FILE *memory = fopen("/proc/self/statm", "r");
    if (memory && fscanf(memory, "%lu", &pages) == 1) {
        const rlim_t now = pages * (rlim_t)sysconf(_SC_PAGESIZE);
        const rlim_t bytes = now + 1024 * mebibyte + 64 * file;
        setrlimit(RLIMIT_AS, &(struct rlimit){bytes, bytes}); /* with AddressSanitizer too */
    }
    if (memory)
        fclose(memory);
    /* Images take time beyond that, up to so much: scene/texture_mean.h. */
    const rlim_t images = 60, most = 1 + file / mebibyte + images;
    process_limit(most, RLIM_INFINITY);
    setrlimit(RLIMIT_CPU, &(struct rlimit){most - images, most});
}

static bool send_mesh(const Mesh *mesh, int pipe_end)
{
    const size_t vectors = mesh->vertex_count * sizeof *mesh->colors;
    const AnswerMesh answer = {mesh->vertex_count, mesh->index_count, mesh->colors != NULL,
                               mesh->lit_positions != NULL};
    return output_append(pipe_end, &answer, sizeof answer) &&
           output_append(pipe_end, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices) &&
           output_append(pipe_end, mesh->indices, mesh->index_count * sizeof *mesh->indices) &&
           (!mesh->colors || output_append(pipe_end, mesh->colors, vectors)) &&
           (!mesh->lit_positions || output_append(pipe_end, mesh->lit_positions, vectors));
}

_Noreturn static void read_in_child(const ModelModule *module, const char *path, ModelUp up,
                                    off_t size, int pipe_end)
{
    Answer answer = {.read = false};
    SceneFile file = {.photometric = false};
    Message reason = {0};
    /* Messages of libraries about a broken file are no output of this program. */
    process_null(STDOUT_FILENO, STDERR_FILENO);
    limit_child(size);
    file.scene.background = (Vec3){0.2, 0.2, 0.2};
    answer.read = module->read(path, up, &file, &reason);
    snprintf(answer.reason, sizeof answer.reason, "%.1000s", reason.text);
    answer.photometric = file.photometric;
    answer.own = file.own;
    answer.turns = file.turns;
    answer.scene = file.scene;
    for (int list = 0; list < FILE_LISTS; list++)
        answer.counts[list] = *scene_file_list(&file, (FileList)list).count;
    bool sent = output_append(pipe_end, &answer, sizeof answer);
    for (int list = 0; list < FILE_MESHES && answer.read && sent; list++) {
        const FileListPlace place = scene_file_list(&file, (FileList)list);
        sent = output_append(pipe_end, *place.items, (size_t)*place.count * place.size);
    }
    for (int i = 0; i < file.mesh_count && answer.read && sent; i++)
        sent = send_mesh(&file.meshes[i], pipe_end);
    _exit(sent ? 0 : 1);
}

static bool report_end(const char *path, int status, Message *message)
{
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGXCPU || signal == SIGKILL)
        return message_set(
            message, "%s: cannot read: it takes too much time or memory; is it damaged?", path);
    return message_set(message, "%s: cannot read: the reader failed on it; is it damaged?", path);
}

static bool read_exactly(int file, void *bytes, size_t size)
{
    return process_read(file, bytes, size, HUGE_VAL) == size;
}

static bool take_vectors(int pipe_end, float (**vectors)[3], size_t count)
{
    *vectors = calloc(count + 1, sizeof **vectors);
    return *vectors && read_exactly(pipe_end, *vectors, count * sizeof **vectors);
}

static bool take_mesh(int pipe_end, Mesh *mesh, size_t *vertices, size_t *indices)
{
    AnswerMesh answer;
    if (!read_exactly(pipe_end, &answer, sizeof answer) || answer.vertex_count > *vertices ||
        answer.index_count > *indices || answer.index_count % 3 != 0 ||
        !mesh_open(mesh, answer.vertex_count, answer.index_count, NULL))
        return false;
    *vertices -= answer.vertex_count;
    *indices -= answer.index_count;
    return read_exactly(pipe_end, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices) &&
           read_exactly(pipe_end, mesh->indices, mesh->index_count * sizeof *mesh->indices) &&
           (!answer.colors || take_vectors(pipe_end, &mesh->colors, mesh->vertex_count)) &&
           (!answer.lit_positions ||
            take_vectors(pipe_end, &mesh->lit_positions, mesh->vertex_count));
}

/* The child may be corrupted by what it read: nothing in its answer is trusted. */
static bool take_answer(const char *path, int pipe_end, SceneFile *file, Message *message)
{
    Answer answer;
    size_t vertices = MODEL_VERTICES_MAX, indices = 3 * (size_t)MODEL_TRIANGLES_MAX;
    if (!read_exactly(pipe_end, &answer, sizeof answer))
        return report_end(path, 0, message);
    if (!answer.read) {
        answer.reason[sizeof answer.reason - 1] = '\0';
        answer.reason[strcspn(answer.reason, "\n")] = '\0';
        return message_set(message, "%s: cannot read: %s", path, answer.reason);
    }
    file->photometric = answer.photometric;
    file->own = answer.own;
    file->turns = answer.turns;
    file->scene = answer.scene;
    file->scene.light_count = file->scene.object_count = 0;
    for (int list = 0; list < FILE_LISTS; list++) {
        const FileListPlace place = scene_file_list(file, (FileList)list);
        const size_t count = (size_t)answer.counts[list];
        if (answer.counts[list] < 0 || answer.counts[list] > place.most ||
            !(*place.items = calloc(count + 1, place.size)))
            return report_end(path, 0, message);
        *place.count = answer.counts[list];
        if (list != FILE_MESHES && !read_exactly(pipe_end, *place.items, count * place.size))
            return report_end(path, 0, message);
    }
    for (int i = 0; i < file->mesh_count; i++)
        if (!take_mesh(pipe_end, &file->meshes[i], &vertices, &indices))
            return report_end(path, 0, message);
    return true;
}

static bool read_apart(const ModelModule *module, const char *path, ModelUp up, off_t size,
                       SceneFile *file, Message *message)
{
    Message why = {0};
    int pipe_end;
    const pid_t child = process_fork(&pipe_end, &why);
    if (child < 0)
        return message_set(message, "%s: cannot read: %s", path, why.text);
    if (child == 0)
        read_in_child(module, path, up, size, pipe_end);
    const bool done = take_answer(path, pipe_end, file, &why);
    close(pipe_end); /* ends a child that still writes */
    const int status = process_wait(child);
    if (WIFSIGNALED(status) && WTERMSIG(status) != SIGPIPE)
        return report_end(path, status, message);
    return done || message_set(message, "%s", why.text);
}

/* What was read */

static bool in_range(int number, int low, int count)
{
    return number >= low && number < count;
}

static bool is_affine(const Mat4 *m)
{
    return mat4_is_finite(*m) && m->m[3] == 0 && m->m[7] == 0 && m->m[11] == 0 && m->m[15] == 1;
}

static bool is_channel(const SceneFile *file, const FileChannel *channel)
{
    const long long numbers =
        (channel->path == FILE_ROTATION ? 4 : 3) * (channel->step == FILE_CUBIC ? 3 : 1);
    return in_range(channel->node, 0, file->node_count) &&
           in_range(channel->path, 0, FILE_SCALE + 1) &&
           in_range(channel->step, 0, FILE_CUBIC + 1) && channel->count > 0 &&
           channel->first >= 0 &&
           channel->first + channel->count * (1 + numbers) <= file->key_count;
}

/* Whether everything refers to what is there. */
static bool check_references(const SceneFile *file)
{
    bool sound = true;
    for (int i = 0; i < file->object_count; i++) {
        FileObject *object = &file->objects[i];
        object->name[FILE_NAME - 1] = '\0';
        object->object.mesh = NULL;
        sound &= in_range(object->node, 0, file->node_count) &&
                 in_range(object->mesh, 0, file->mesh_count) &&
                 in_range((int)object->object.solid.kind, 0, SOLID_TEAPOT + 1);
    }
    for (int i = 0; i < file->light_count; i++) {
        file->lights[i].name[FILE_NAME - 1] = '\0';
        sound &= in_range(file->lights[i].node, -1, file->node_count);
    }
    for (int i = 0; i < file->camera_count; i++) {
        file->cameras[i].name[FILE_NAME - 1] = file->cameras[i].place[FILE_NAME - 1] = '\0';
        sound &= in_range(file->cameras[i].node, -1, file->node_count);
    }
    for (int i = 0; i < file->note_count; i++)
        file->notes[i].text[sizeof file->notes[i].text - 1] = '\0';
    for (int i = 0; i < file->channel_count; i++)
        sound &= is_channel(file, &file->channels[i]);
    return sound;
}

static bool check_numbers(const char *path, const SceneFile *file, Message *message)
{
    for (int i = 0; i < file->node_count; i++)
        if (!in_range(file->nodes[i].parent, -1, i))
            return report_end(path, 0, message);
        else if (!is_affine(&file->nodes[i].parent_from_node))
            return message_set(message, "%s: node %d: its matrix must be finite and affine", path,
                               i);
    for (int i = 0; i < file->key_count; i++)
        if (!isfinite(file->keys[i]))
            return message_set(message, "%s: an animation has a number that is not finite", path);
    for (int i = 0; i < file->mesh_count; i++) {
        Message why = {0};
        if (mesh_check(&file->meshes[i], &why))
            continue;
        if (file->mesh_count == 1)
            return message_set(message, "%s: %s", path, why.text);
        return message_set(message, "%s: mesh %d: %s", path, i, why.text + strlen("mesh: "));
    }
    return true;
}

void scene_file_tidy(Mesh *mesh)
{
    size_t kept = 0;
    for (size_t i = 0; i < mesh->index_count / 3; i++)
        if (mesh_face(mesh, i, NULL))
            memmove(&mesh->indices[3 * kept++], &mesh->indices[3 * i], 3 * sizeof *mesh->indices);
    mesh->index_count = 3 * kept;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        float *normal = mesh->vertices[i].normal;
        const Vec3 given = vec3_from_float(normal);
        Vec3 unit;
        if (fabs(vec3_dot(given, given) - 1) < 4e-7) /* its own rounding */
            continue;
        vec3_normalize(given, &unit);
        vec3_to_float(unit, normal);
    }
}

bool scene_file_read(const char *path, ModelUp up, SceneFile *file, Message *message)
{
    const ModelModule *module;
    off_t size = 0;
    *file = (SceneFile){.photometric = false};
    bool done = check_file(path, &size, message) && (module = plugin_open(&assimp, message)) &&
                read_apart(module, path, up, size, file, message);
    if (done && !check_references(file))
        done = report_end(path, 0, message);
    done = done && check_numbers(path, file, message);
    if (done && file->turns && file->node_count > 0 && up != MODEL_UP_FILE)
        file->nodes[0].parent_from_node = scene_file_upright((int)up - MODEL_UP_X, false);
    for (int i = 0; i < file->mesh_count && done; i++)
        scene_file_tidy(&file->meshes[i]);
    if (!done)
        scene_file_close(file);
    return done;
}
