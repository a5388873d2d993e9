/*
 * model_fuzz: no file that our own readers read may do harm: what is read of it refers to what is
 * there.
 *
 * The input is the file: .ply, .glb or .gltf if it begins as one, else .obj. It is read in this
 * process, as the reader's child would.
 */
#include "fuzz/fuzz.h"
#include "scene/model_module.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/model_fuzz-XXXXXX";

static void remove_folder(void)
{
    rmdir(folder);
}

static void write_file(const char *path, const uint8_t *data, size_t size)
{
    const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    require(file >= 0 && write(file, data, size) == (ssize_t)size);
    close(file);
}

static void check_mesh(const Mesh *mesh)
{
    require(mesh->index_count % 3 == 0);
    for (size_t i = 0; i < mesh->index_count; i++)
        require(mesh->indices[i] < mesh->vertex_count);
}

static void check_file(const SceneFile *file)
{
    for (int i = 0; i < file->node_count; i++)
        require(file->nodes[i].parent >= -1 && file->nodes[i].parent < i);
    for (int i = 0; i < file->object_count; i++)
        require(file->objects[i].node >= 0 && file->objects[i].node < file->node_count &&
                file->objects[i].mesh >= 0 && file->objects[i].mesh < file->mesh_count);
    for (int i = 0; i < file->mesh_count; i++)
        check_mesh(&file->meshes[i]);
    Mat4 *poses = calloc((size_t)file->node_count + 1, sizeof *poses);
    require(poses != NULL);
    scene_file_pose(file, 0.5, poses);
    free(poses);
}

static const char *ending_of(const uint8_t *data, size_t size)
{
    return size >= 3 && memcmp(data, "ply", 3) == 0    ? "ply"
           : size >= 4 && memcmp(data, "glTF", 4) == 0 ? "glb"
           : size >= 1 && data[0] == '{'               ? "gltf"
                                                       : "obj";
}

FUZZ(data, size)
{
    SceneFile file = {.photometric = false};
    Message reason = {0};
    char path[64];
    bool other = false;
    if (folder[sizeof folder - 2] == 'X') {
        require(mkdtemp(folder) != NULL);
        atexit(remove_folder);
    }
    snprintf(path, sizeof path, "%s/a.%s", folder, ending_of(data, size));
    write_file(path, data, size);
    const bool read = own_read(path, &file, &other, &reason);
    require(read ? !reason.text[0] : other || reason.text[0]);
    if (read)
        check_file(&file);
    scene_file_close(&file);
    unlink(path);
    return 0;
}
