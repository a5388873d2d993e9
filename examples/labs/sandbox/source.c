/* The files of a submission, which come in folders and under names of many kinds. */
#include "labs/sandbox/source.h"

#include "base/input.h"
#include "base/memory.h"
#include "labs/diagnosis/text_facts.h"
#include "labs/submission/submission.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

static bool part_is_junk(const char *part, size_t length)
{
    static const char MACOS[] = "__MACOSX";
    return part[0] == '.' || (length == sizeof MACOS - 1 && memcmp(part, MACOS, length) == 0);
}

/* "lab05.frag.txt" becomes "lab05.frag". */
static void drop_text_ending(char *name)
{
    const size_t length = strlen(name);
    char *end = length > 4 ? name + length - 4 : name;
    if (strcasecmp(end, ".txt") == 0)
        *end = '\0';
}

bool source_is_wanted(const char *path)
{
    static const char *const endings[] = {".vert", ".frag", ".glsl", ".vs", ".fs", ".c", ".h"};
    const char *part = path;
    for (;;) {
        const size_t length = strcspn(part, "/");
        if (part_is_junk(part, length))
            return false;
        if (!part[length])
            break;
        part += length + 1;
    }
    char name[BUNDLE_NAME_SIZE];
    snprintf(name, sizeof name, "%s", part);
    drop_text_ending(name);
    const char *ending = strrchr(name, '.');
    for (size_t i = 0; ending && i < sizeof endings / sizeof endings[0]; i++)
        if (strcasecmp(ending, endings[i]) == 0)
            return true;
    return false;
}

static bool read_at(Bundle *bundle, int folder, const char *entry, const char *name,
                    Message *message)
{
    size_t size;
    char *bytes = input_read(folder, entry, name, SOURCE_FILE_MAX, &size, message);
    const bool done = bytes && bundle_add(bundle, name, bytes, size, message);
    free(bytes);
    return done;
}

bool source_read_file(Bundle *bundle, const char *path, const char *name, Message *message)
{
    return read_at(bundle, AT_FDCWD, path, name, message);
}

enum { ENTRIES_MAX = 4096 };

/* Closes `folder`. `path` is its name in the submission; "": the top. */
static bool read_folder(Bundle *bundle, int folder, const char *path, int depth, int *entries,
                        Message *message)
{
    DIR *stream = fdopendir(folder);
    if (!stream) {
        close(folder);
        return message_set(message, "%s: %s", path[0] ? path : ".", strerror(errno));
    }
    bool done = true;
    for (struct dirent *entry; done && (entry = readdir(stream)) != NULL;) {
        char name[BUNDLE_NAME_SIZE];
        struct stat status;
        if (part_is_junk(entry->d_name, strlen(entry->d_name)))
            continue;
        if (++*entries > ENTRIES_MAX) {
            done = message_set(message, "more than %d files", ENTRIES_MAX);
        } else if (snprintf(name, sizeof name, "%s%s%s", path, path[0] ? "/" : "", entry->d_name) >=
                   (int)sizeof name) {
            done = message_set(message, "%.40s...: the path is too long", path);
        } else if (fstatat(folder, entry->d_name, &status, AT_SYMLINK_NOFOLLOW) != 0) {
            done = message_set(message, "%s: %s", name, strerror(errno));
        } else if (S_ISDIR(status.st_mode) && depth < BUNDLE_DEPTH_MAX) {
            const int below =
                openat(folder, entry->d_name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
            done = below >= 0 ? read_folder(bundle, below, name, depth + 1, entries, message)
                              : message_set(message, "%s: %s", name, strerror(errno));
        } else if (source_is_wanted(name)) {
            done = read_at(bundle, folder, entry->d_name, name, message);
        }
    }
    closedir(stream);
    return done;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(((const BundleFile *)a)->name, ((const BundleFile *)b)->name);
}

bool source_read_folder(Bundle *bundle, const char *path, Message *message)
{
    int entries = 0;
    const int folder = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder < 0)
        return message_set(message, "cannot be read: %s", strerror(errno));
    const bool done = read_folder(bundle, folder, "", 1, &entries, message);
    /* A folder's entries have no defined order. */
    qsort(bundle->files, (size_t)bundle->count, sizeof bundle->files[0], by_name);
    return done;
}

uint64_t source_hash_bytes(uint64_t hash, const void *bytes, size_t size)
{
    const unsigned char *at = bytes;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ at[i]) * 1099511628211ULL;
    return hash;
}

bool source_hash_file(const char *path, const char *name, uint64_t *hash, Message *message)
{
    size_t size;
    char *bytes = input_read(AT_FDCWD, path, name, 64 << 20, &size, message);
    const bool done = bytes != NULL;
    *hash = done ? source_hash_bytes(SOURCE_HASH_START, bytes, size) : SOURCE_HASH_START;
    free(bytes);
    return done;
}

uint64_t source_hash(const Bundle *bundle)
{
    uint64_t hash = SOURCE_HASH_START;
    for (int i = 0; i < bundle->count; i++) {
        const BundleFile *file = &bundle->files[i];
        char line[BUNDLE_NAME_SIZE + 32];
        const int length = snprintf(line, sizeof line, "%zu %s\n", file->size, file->name);
        hash = source_hash_bytes(hash, line, (size_t)length);
        hash = source_hash_bytes(hash, file->bytes, file->size);
    }
    return hash;
}

static size_t folder_length(const char *name)
{
    const char *slash = strrchr(name, '/');
    return slash ? (size_t)(slash - name) : 0;
}

static int folder_depth(const char *name)
{
    int depth = 0;
    for (; *name; name++)
        depth += *name == '/';
    return depth;
}

/* Whether the last part of a folder's path begins with "lab05" or "lab5", and no digit follows. */
static bool folder_is_of_lab(const char *folder, size_t length, int lab)
{
    size_t start = length;
    while (start > 0 && folder[start - 1] != '/')
        start--;
    if (length - start < 4 || strncasecmp(folder + start, "lab", 3) != 0)
        return false;
    char *end;
    return isdigit((unsigned char)folder[start + 3]) && strtol(folder + start + 3, &end, 10) == lab;
}

/* Keeps the files below `folder`, with names relative to it. */
static void keep_folder(Bundle *bundle, const char *folder, size_t length)
{
    int kept = 0;
    for (int i = 0; i < bundle->count; i++) {
        BundleFile file = bundle->files[i];
        if (length && (strncmp(file.name, folder, length) != 0 || file.name[length] != '/')) {
            bundle->size -= file.size;
            free(file.bytes);
            continue;
        }
        const size_t start = length ? length + 1 : 0;
        memmove(file.name, file.name + start, strlen(file.name + start) + 1);
        bundle->files[kept++] = file;
    }
    bundle->count = kept;
}

/* Whether all files directly in a folder that the lab's starter has too are the starter's. */
static bool folder_is_starter(const Bundle *bundle, const char *folder, size_t length,
                              const Lab *lab)
{
    SubmissionFiles starter;
    char path[PATH_MAX];
    int count = 0;
    if (!lab_folder(lab, path, NULL) || !submission_files_open(&starter, lab, path, NULL))
        return false;
    bool same = true;
    for (int i = 0; i < bundle->count && same; i++) {
        const BundleFile *file = &bundle->files[i];
        if (folder_length(file->name) != length || strncmp(file->name, folder, length) != 0)
            continue;
        const char *text = submission_file(&starter, file->name + length + (length > 0));
        same = text && text_is_same((const char *)file->bytes, text);
        count++;
    }
    submission_files_close(&starter);
    return same && count > 0;
}

bool source_choose(Bundle *bundle, const Lab *lab, Message *message)
{
    char chosen[BUNDLE_NAME_SIZE] = "", other[BUNDLE_NAME_SIZE] = "";
    int nearest = BUNDLE_DEPTH_MAX + 1;
    char names[LAB_MAX_FILES][LAB_NAME_SIZE];
    bool several = false;
    lab_files(lab, names);
    if (bundle->count == 0)
        return message_set(message, "no source files: %s is missing", names[0]);
    for (int i = 0; i < bundle->count; i++)
        if (folder_depth(bundle->files[i].name) < nearest)
            nearest = folder_depth(bundle->files[i].name);
    for (int i = 0; i < bundle->count; i++) {
        const char *name = bundle->files[i].name;
        const size_t length = folder_length(name);
        if (folder_depth(name) != nearest ||
            (chosen[0] && strlen(chosen) == length && strncmp(name, chosen, length) == 0))
            continue;
        const bool first = !chosen[0], ours = folder_is_of_lab(name, length, lab->number);
        const bool chosen_ours = folder_is_of_lab(chosen, strlen(chosen), lab->number);
        if (!first && folder_is_starter(bundle, name, length, lab))
            continue;
        if (!first && folder_is_starter(bundle, chosen, strlen(chosen), lab)) {
            snprintf(chosen, sizeof chosen, "%.*s", (int)length, name);
        } else if (!first && ours == chosen_ours) {
            snprintf(other, sizeof other, "%.*s", (int)length, name);
            several = true;
        } else if (first || ours) {
            snprintf(chosen, sizeof chosen, "%.*s", (int)length, name);
            several = false;
        }
    }
    if (several)
        return message_set(message, "source files in both %s and %s; submit one folder", chosen,
                           other);
    keep_folder(bundle, chosen, strlen(chosen));
    return true;
}

/* Appends a code point as UTF-8. */
static unsigned char *put_utf8(unsigned char *to, unsigned code)
{
    if (code < 0x80) {
        *to++ = (unsigned char)code;
    } else if (code < 0x800) {
        *to++ = (unsigned char)(0xC0 | code >> 6);
        *to++ = (unsigned char)(0x80 | (code & 0x3F));
    } else {
        *to++ = (unsigned char)(0xE0 | code >> 12);
        *to++ = (unsigned char)(0x80 | (code >> 6 & 0x3F));
        *to++ = (unsigned char)(0x80 | (code & 0x3F));
    }
    return to;
}

/* Text of Windows's editors, which begins with a byte order mark; surrogates, which no program
 * needs, become question marks. */
static void convert_utf16(BundleFile *file)
{
    const unsigned char *from = file->bytes;
    if (file->size < 2 || file->size % 2 ||
        !((from[0] == 0xFF && from[1] == 0xFE) || (from[0] == 0xFE && from[1] == 0xFF)))
        return;
    const bool little = from[0] == 0xFF;
    unsigned char *text = memory_new(file->size / 2 * 3 + 1, 1), *to = text;
    for (size_t i = 2; i < file->size; i += 2) {
        const unsigned low = from[i + !little], high = from[i + little], code = high << 8 | low;
        to = put_utf8(to, code >= 0xD800 && code < 0xE000 ? '?' : code);
    }
    *to = '\0';
    free(file->bytes);
    file->bytes = text;
    file->size = (size_t)(to - text);
}

/* Gives the only file with one of these endings the lab's name. */
static void rename_only(Bundle *bundle, const char *wanted, const char *const endings[])
{
    BundleFile *found = NULL;
    int count = 0;
    if (bundle_find(bundle, wanted))
        return;
    for (int i = 0; i < bundle->count; i++) {
        const char *ending = strrchr(bundle->files[i].name, '.');
        for (int k = 0; ending && !strchr(bundle->files[i].name, '/') && endings[k]; k++) {
            if (strcmp(ending, endings[k]) == 0) {
                found = &bundle->files[i];
                count++;
            }
        }
    }
    if (count == 1)
        snprintf(found->name, sizeof found->name, "%s", wanted);
}

void source_normalize(Bundle *bundle, const Lab *lab)
{
    static const char *const vertex[] = {".vert", ".vs", NULL};
    static const char *const fragment[] = {".frag", ".fs", NULL};
    static const char *const code[] = {".c", NULL};
    char wanted[64], name[BUNDLE_NAME_SIZE];
    for (int i = 0; i < bundle->count; i++) {
        BundleFile *file = &bundle->files[i];
        bundle->size -= file->size;
        convert_utf16(file);
        bundle->size += file->size;
        snprintf(name, sizeof name, "%s", file->name);
        drop_text_ending(name);
        for (char *at = name; *at; at++)
            *at = (char)tolower((unsigned char)*at);
        if (bundle_name_is_safe(name) && !bundle_find(bundle, name)) /* ".txt" has no name left */
            snprintf(file->name, sizeof file->name, "%s", name);
    }
    snprintf(wanted, sizeof wanted, "%s.vert", lab->file);
    rename_only(bundle, wanted, vertex);
    snprintf(wanted, sizeof wanted, "%s.frag", lab->file);
    rename_only(bundle, wanted, fragment);
    if (lab->code)
        rename_only(bundle, lab->code, code);
}

bool source_files(const Bundle *bundle, const Lab *lab, SubmissionFiles *files, Message *message)
{
    char names[LAB_MAX_FILES][LAB_NAME_SIZE];
    bool done = true;
    *files = (SubmissionFiles){.count = 0};
    for (int i = 0, count = lab_files(lab, names); i < count && done; i++) {
        const BundleFile *file = bundle_find(bundle, names[i]);
        done = file ? submission_files_add(files, names[i], file->bytes, file->size, message)
                    : message_set(message, "%s: " SUBMISSION_MISSING, names[i]);
    }
    for (int i = 0; i < bundle->count && done && !lab->given; i++) {
        const BundleFile *file = &bundle->files[i];
        if (!strchr(file->name, '/') && submission_may_include(file->name) &&
            !submission_file(files, file->name))
            submission_files_add(files, file->name, file->bytes, file->size, NULL);
    }
    if (!done)
        submission_files_close(files);
    return done;
}
