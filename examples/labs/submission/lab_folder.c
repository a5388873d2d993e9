/* A lab's folder: its names, its files, and a hash of them. */
#include "labs/submission/lab_json.h"

#include "base/input.h"

#include <ctype.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static uint64_t hash_text(uint64_t hash, const char *text)
{
    while (*text)
        hash = (hash ^ (unsigned char)*text++) * 1099511628211ULL; /* FNV-1a */
    return hash;
}

/* The folder's name, and that of its shaders: what is before the first "_". */
static bool name_lab(LabFolder *folder, const char *path, Message *message)
{
    if (!realpath(path, folder->path))
        return message_set(message, "%s: no such folder", path);
    const char *name = strrchr(folder->path, '/') + 1;
    if (strlen(name) >= sizeof folder->name)
        return message_set(message, "%s: the name is too long", path);
    memcpy(folder->name, name, strlen(name) + 1);
    for (size_t i = 0; i < strcspn(name, "_"); i++)
        folder->file[i] = (char)tolower((unsigned char)name[i]);
    folder->lab = (Lab){.name = folder->name,
                        .file = folder->file,
                        .folder = folder->path,
                        .uniforms = folder->uniforms,
                        .solutions = folder->solutions,
                        .points = LAB_POINTS};
    return true;
}

static void close_folder(LabFolder *folder)
{
    for (int i = 0; i < LAB_MAX_SOLUTIONS; i++)
        submission_files_close(&folder->solutions[i]);
    json_decref(folder->json);
    *folder = (LabFolder){.json = NULL};
}

/* Do not move what was read. */
static bool open_folder(LabFolder *folder, const char *path, Message *message)
{
    enum { BYTES_MAX = 1 << 20 };
    char file[2 * PATH_MAX];
    json_error_t error;
    size_t size;
    *folder = (LabFolder){.json = NULL};
    if (!name_lab(folder, path, message))
        return false;
    snprintf(file, sizeof file, "%s/lab.json", folder->path);
    char *text = input_read(AT_FDCWD, file, file, BYTES_MAX, &size, message);
    if (!text)
        return false;
    Lab *lab = &folder->lab;
    lab->hash = hash_text(14695981039346656037ULL, text);
    folder->json = json_loadb(text, size, JSON_REJECT_DUPLICATES, &error);
    free(text);
    bool done =
        folder->json != NULL || message_set(message, "%s:%d: %s", file, error.line, error.text);
    done = done && lab_json_read(folder, message);
    for (int i = 0; i < lab->solution_count; i++)
        for (int k = 0; k < folder->solutions[i].count; k++)
            lab->hash = hash_text(lab->hash, folder->solutions[i].texts[k].text);
    if (!done)
        close_folder(folder);
    return done;
}

const Lab *lab_open(const char *text, Message *message)
{
    static LabFolder folder;
    struct stat status;
    const Lab *known = strchr(text, '/') ? NULL : lab_find(text, NULL);
    if (known || (stat(text, &status) != 0 && !strchr(text, '/')))
        return known ? known : lab_find(text, message);
    close_folder(&folder);
    return open_folder(&folder, text, message) ? &folder.lab : NULL;
}
