/*
 * A file from anywhere, and a library of a hundred parsers. Assimp reads it in a child process,
 * whose time and memory are limited by the file's size, and which sends back counts, vertices and
 * indices through a pipe: it may loop, crash or lie. The parent believes the counts only up to the
 * limits, and checks every number and index. Then equal vertices are merged, by a hash table with
 * open addressing that holds indices (Knuth, The art of computer programming, volume 3,
 * section 6.4, algorithm L): bytes equal in position and normal are one vertex, so that computed
 * normals are smooth across triangles.
 */
#include "shapes/model.h"

#include "base/output.h"
#include "base/process.h"
#include "core/mesh_make.h"

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

static Plugin assimp = PLUGIN_MODELS;

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

/* A child process reads the file and sends an Answer, vertices and indices through a pipe. */

typedef struct Answer {
    bool read;
    size_t vertex_count, index_count;
    char reason[1024];
} Answer;

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
    process_limit(1 + file / mebibyte, RLIM_INFINITY);
}

_Noreturn static void read_in_child(const ModelModule *module, const char *path, ModelUp up,
                                    off_t size, int pipe_end)
{
    Answer answer = {.read = false};
    Mesh mesh = {0};
    /* Messages of libraries about a broken file are no output of this program. */
    process_null(STDOUT_FILENO, STDERR_FILENO);
    limit_child(size);
    answer.read = module->read(path, up, &mesh, answer.reason, sizeof answer.reason);
    answer.vertex_count = mesh.vertex_count;
    answer.index_count = mesh.index_count;
    const bool sent =
        output_append(pipe_end, &answer, sizeof answer) &&
        (!answer.read ||
         (output_append(pipe_end, mesh.vertices, mesh.vertex_count * sizeof *mesh.vertices) &&
          output_append(pipe_end, mesh.indices, mesh.index_count * sizeof *mesh.indices)));
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

/* The child may be corrupted by what it read: nothing in its answer is trusted. */
static bool take_answer(const char *path, int pipe_end, Mesh *mesh, Message *message)
{
    Answer answer;
    if (!read_exactly(pipe_end, &answer, sizeof answer))
        return report_end(path, 0, message);
    if (!answer.read) {
        answer.reason[sizeof answer.reason - 1] = '\0';
        answer.reason[strcspn(answer.reason, "\n")] = '\0';
        return message_set(message, "%s: cannot read: %s", path, answer.reason);
    }
    if (answer.vertex_count > MODEL_VERTICES_MAX ||
        answer.index_count > 3 * (size_t)MODEL_TRIANGLES_MAX || answer.index_count % 3 != 0)
        return report_end(path, 0, message);
    if (!mesh_open(mesh, answer.vertex_count, answer.index_count, message))
        return false;
    return (read_exactly(pipe_end, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices) &&
            read_exactly(pipe_end, mesh->indices, mesh->index_count * sizeof *mesh->indices)) ||
           report_end(path, 0, message);
}

static bool read_apart(const ModelModule *module, const char *path, ModelUp up, off_t size,
                       Mesh *mesh, Message *message)
{
    Message why = {0};
    int pipe_end;
    const pid_t child = process_fork(&pipe_end, &why);
    if (child < 0)
        return message_set(message, "%s: cannot read: %s", path, why.text);
    if (child == 0)
        read_in_child(module, path, up, size, pipe_end);
    const bool done = take_answer(path, pipe_end, mesh, &why);
    close(pipe_end); /* ends a child that still writes */
    const int status = process_wait(child);
    if (WIFSIGNALED(status) && WTERMSIG(status) != SIGPIPE)
        return report_end(path, status, message);
    return done || message_set(message, "%s", why.text);
}

static bool check_mesh(const char *path, const Mesh *mesh, Message *message)
{
    Message why = {0};
    return mesh_check(mesh, &why) || message_set(message, "%s: %s", path, why.text);
}

/* Finds an equal vertex, or an empty slot, in a hash table of indices + 1. */
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

/* Keeps triangles with an area and the vertices they use, equal ones merged. */
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

/* Computes the missing normals: all of a copy, of which it takes those. */
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

bool model_read(const char *path, ModelUp up, Mesh *mesh, Message *message)
{
    const ModelModule *module;
    off_t size = 0;
    Mesh parts = {.vertices = NULL};
    *mesh = (Mesh){0};
    const bool done =
        check_file(path, &size, message) && (module = plugin_open(&assimp, message)) &&
        read_apart(module, path, up, size, &parts, message) && check_mesh(path, &parts, message) &&
        join(path, &parts, mesh, message) && complete_normals(mesh, message);
    mesh_close(&parts);
    if (!done)
        mesh_close(mesh);
    return done;
}
