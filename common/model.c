#include "model.h"

#include "model_module.h"
#include "module.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static bool module_open(const ModelModule **module, Message *message)
{
    static const ModuleName name = {"model_assimp.so", MODEL_MODULE_SYMBOL, "Assimp",
                                    "libassimp-dev"};
    static const ModelModule *loaded;
    if (!loaded) {
        const ModelModuleEntry entry = (ModelModuleEntry)module_entry(&name, message);
        if (!entry)
            return false;
        loaded = entry();
    }
    *module = loaded;
    return true;
}

bool model_doctor(void)
{
    Message message = {0};
    const ModelModule *module;
    if (!module_open(&module, &message)) {
        printf("  Assimp (model files) missing: %s\n", message.text);
        return false;
    }
    printf("  Assimp (model files) %s: found\n", module->version);
    return true;
}

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
    if (status.st_size > MODEL_BYTES_MOST)
        return message_set(message, "%s: %lld bytes; model files of at most %d are read", path,
                           (long long)status.st_size, MODEL_BYTES_MOST);
    *size = status.st_size;
    return true;
}

/* Reading apart: a child process reads the file and sends back an Answer, vertices, indices. */

typedef struct Answer {
    bool read;
    size_t vertex_count, index_count;
    char reason[1024];
} Answer;

static struct rlimit most(rlim_t number)
{
    return (struct rlimit){number, number};
}

/* Time and memory that no sound file of this size needs; memory beyond what the process has. Where
 * a limit is lower already, it stays. */
static void limit_child(off_t size)
{
    const rlim_t mebibyte = 1 << 20, file = (rlim_t)size;
    const struct rlimit seconds = most(1 + file / mebibyte), none = most(0);
    unsigned long pages = 0;
    FILE *memory = fopen("/proc/self/statm", "r");
    if (memory && fscanf(memory, "%lu", &pages) == 1) {
        const rlim_t now = pages * (rlim_t)sysconf(_SC_PAGESIZE);
        const struct rlimit bytes = most(now + 1024 * mebibyte + 64 * file);
        setrlimit(RLIMIT_AS, &bytes);
    }
    if (memory)
        fclose(memory);
    setrlimit(RLIMIT_CPU, &seconds);
    setrlimit(RLIMIT_CORE, &none);
}

_Noreturn static void read_in_child(const ModelModule *module, const char *path, off_t size,
                                    FILE *transfer)
{
    Answer answer = {.read = false};
    Mesh mesh = {0};
    limit_child(size);
    answer.read = module->read(path, &mesh, answer.reason, sizeof answer.reason);
    answer.vertex_count = mesh.vertex_count;
    answer.index_count = mesh.index_count;
    fwrite(&answer, sizeof answer, 1, transfer);
    if (answer.read) {
        fwrite(mesh.vertices, sizeof *mesh.vertices, mesh.vertex_count, transfer);
        fwrite(mesh.indices, sizeof *mesh.indices, mesh.index_count, transfer);
    }
    _exit(fflush(transfer) == 0 ? 0 : 1);
}

static bool say_how_it_ended(const char *path, int status, Message *message)
{
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGXCPU || signal == SIGKILL)
        return message_set(
            message, "%s: cannot read: it takes too much time or memory; is it damaged?", path);
    return message_set(message, "%s: cannot read: the reader failed on it; is it damaged?", path);
}

/* The answer of a child that may have been broken by what it read: nothing in it is trusted. */
static bool take_answer(const char *path, FILE *transfer, Mesh *mesh, Message *message)
{
    Answer answer;
    rewind(transfer);
    if (fread(&answer, sizeof answer, 1, transfer) != 1)
        return say_how_it_ended(path, 0, message);
    if (!answer.read) {
        answer.reason[sizeof answer.reason - 1] = '\0';
        answer.reason[strcspn(answer.reason, "\n")] = '\0';
        return message_set(message, "%s: cannot read: %s", path, answer.reason);
    }
    if (answer.vertex_count > MODEL_VERTICES_MOST ||
        answer.index_count > 3 * (size_t)MODEL_TRIANGLES_MOST || answer.index_count % 3 != 0)
        return say_how_it_ended(path, 0, message);
    if (!mesh_open(mesh, answer.vertex_count, answer.index_count, message))
        return false;
    if (fread(mesh->vertices, sizeof *mesh->vertices, mesh->vertex_count, transfer) !=
            mesh->vertex_count ||
        fread(mesh->indices, sizeof *mesh->indices, mesh->index_count, transfer) !=
            mesh->index_count)
        return say_how_it_ended(path, 0, message);
    return true;
}

static bool read_apart(const ModelModule *module, const char *path, off_t size, Mesh *mesh,
                       Message *message)
{
    const int memory = memfd_create("model", MFD_CLOEXEC);
    FILE *transfer = memory < 0 ? NULL : fdopen(memory, "w+");
    if (!transfer) {
        message_set(message, "%s: %s", path, strerror(errno));
        if (memory >= 0)
            close(memory);
        return false;
    }
    bool done = false;
    int status = 0;
    pid_t ended, child = fork();
    if (child == 0) {
        /* What libraries print about a broken file is no part of this program's output. */
        const int nothing = open("/dev/null", O_WRONLY);
        dup2(nothing, STDOUT_FILENO);
        dup2(nothing, STDERR_FILENO);
        read_in_child(module, path, size, transfer);
    }
    do
        ended = child < 0 ? -1 : waitpid(child, &status, 0);
    while (ended < 0 && child > 0 && errno == EINTR);
    if (ended < 0)
        message_set(message, "%s: cannot read: no process for the reader: %s", path,
                    strerror(errno));
    else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        say_how_it_ended(path, status, message);
    else
        done = take_answer(path, transfer, mesh, message);
    fclose(transfer);
    return done;
}

/* Making a mesh of what was read. */

static bool check_numbers(const char *path, const Mesh *mesh, Message *message)
{
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            if (!isfinite(mesh->vertices[i].position[axis]))
                return message_set(message, "%s: a coordinate is not finite", path);
            if (!isfinite(mesh->vertices[i].normal[axis]))
                return message_set(message, "%s: a normal is not finite", path);
        }
    }
    for (size_t i = 0; i < mesh->index_count; i++)
        if (mesh->indices[i] >= mesh->vertex_count)
            return message_set(message, "%s: an index is out of range", path);
    return true;
}

/* The place of an equal vertex, or an empty one, in a table of indices + 1. */
static uint32_t *find(uint32_t *table, size_t table_size, const MeshVertex *vertices,
                      const MeshVertex *vertex)
{
    uint32_t words[sizeof *vertex / sizeof(uint32_t)];
    uint64_t hash = 0;
    memcpy(words, vertex, sizeof *vertex);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        hash = (hash ^ words[i]) * 0x9e3779b97f4a7c15u; /* 2^64 / the golden ratio (Knuth, 6.4) */
    size_t place = (size_t)(hash >> 32) & (table_size - 1);
    while (table[place] && memcmp(&vertices[table[place] - 1], vertex, sizeof *vertex) != 0)
        place = (place + 1) & (table_size - 1);
    return &table[place];
}

/* Keeps triangles with an area and the vertices they use; one of each that are equal. */
static bool join(const char *path, const Mesh *parts, Mesh *mesh, Message *message)
{
    size_t table_size = 1;
    while (table_size < 2 * parts->vertex_count)
        table_size *= 2;
    uint32_t *table = calloc(table_size, sizeof *table);
    if (!table)
        return message_set(message, "%s: not enough memory for its vertices", path);
    if (!mesh_open(mesh, parts->vertex_count, parts->index_count, message)) {
        free(table);
        return false;
    }
    mesh->vertex_count = mesh->index_count = 0;
    for (size_t triangle = 0; triangle < parts->index_count / 3; triangle++) {
        Vec3 normal;
        if (!mesh_face(parts, triangle, &normal))
            continue;
        for (size_t i = 3 * triangle; i < 3 * triangle + 3; i++) {
            const MeshVertex *vertex = &parts->vertices[parts->indices[i]];
            uint32_t *found = find(table, table_size, mesh->vertices, vertex);
            if (!*found) {
                mesh->vertices[mesh->vertex_count++] = *vertex;
                *found = (uint32_t)mesh->vertex_count;
            }
            mesh->indices[mesh->index_count++] = *found - 1;
        }
    }
    free(table);
    if (mesh->index_count == 0)
        return message_set(message, "%s: holds no triangle with an area", path);
    return true;
}

static bool is_zero(const float normal[3])
{
    return normal[0] == 0 && normal[1] == 0 && normal[2] == 0;
}

/* Computes all normals of a copy, and takes from it those that are missing. */
static bool fill_normals(Mesh *mesh, Message *message)
{
    Mesh copy = *mesh;
    copy.vertices = malloc(mesh->vertex_count * sizeof *mesh->vertices);
    if (!copy.vertices)
        return message_set(message, "model: not enough memory for the normals of %zu vertices",
                           mesh->vertex_count);
    memcpy(copy.vertices, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
    const bool done = mesh_compute_normals(&copy, MESH_WEIGHT_ANGLE, message);
    for (size_t i = 0; done && i < mesh->vertex_count; i++)
        if (is_zero(mesh->vertices[i].normal))
            mesh->vertices[i] = copy.vertices[i];
    free(copy.vertices);
    return done;
}

static bool complete_normals(Mesh *mesh, Message *message)
{
    bool missing = false;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        float *normal = mesh->vertices[i].normal;
        Vec3 unit;
        vec3_normalize((Vec3){normal[0], normal[1], normal[2]}, &unit);
        vec3_to_float(unit, normal);
        missing |= is_zero(normal);
    }
    return !missing || fill_normals(mesh, message);
}

bool model_read(const char *path, Mesh *mesh, Message *message)
{
    const ModelModule *module;
    off_t size = 0;
    Mesh parts = {.vertices = NULL};
    *mesh = (Mesh){0};
    const bool done = check_file(path, &size, message) && module_open(&module, message) &&
                      read_apart(module, path, size, &parts, message) &&
                      check_numbers(path, &parts, message) && join(path, &parts, mesh, message) &&
                      complete_normals(mesh, message);
    mesh_close(&parts);
    if (!done)
        mesh_close(mesh);
    return done;
}
