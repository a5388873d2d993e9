/* A name is matched against the patterns of platforms, the most special first; what then has one
 * student's name and number is one submission. */
#include "labs/class/class_find.h"

#include "base/memory.h"
#include "base/text.h"
#include "labs/sandbox/source.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <regex.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/* The numbers of the groups with the parts of a name; 0: none. */
typedef struct NamePattern {
    const char *text;
    int student, id, file, late; /* `late` -1: it is a platform's, which does not say */
} NamePattern;

static const NamePattern FOLDER_PATTERNS[] = {
    {"^(.+)_([0-9]+)_assignsubmission_file_?$", 1, 2, 0, -1},
    {"^(.+)_([0-9]{3,})$", 1, 2, 0, 0},
    {"^(.+)$", 1, 0, 0, 0},
};

static const NamePattern FILE_PATTERNS[] = {
    {"^(.+)_([0-9]+)_assignsubmission_file_(.+)$", 1, 2, 3, -1},
    {"^([^_]+)(_LATE)?_([0-9]+)_[0-9]+_(.+)$", 1, 3, 4, 2},
    {"^(.+)[_-](lab[0-9]+[^/]*)$", 1, 0, 2, 0},
};

/* Moodle's text field: not a submission. */
static const char TYPED[] = "_assignsubmission_onlinetext";

static void copy_part(char *text, size_t size, const char *from, const regmatch_t *match)
{
    const size_t length = (size_t)(match->rm_eo - match->rm_so);
    snprintf(text, size, "%.*s", (int)(length < size ? length : size - 1), from + match->rm_so);
}

static bool match(const NamePattern *pattern, const char *entry, ClassName *name)
{
    regex_t compiled;
    regmatch_t parts[5];
    if (regcomp(&compiled, pattern->text, REG_EXTENDED | REG_ICASE) != 0)
        return false;
    const bool matches = regexec(&compiled, entry, 5, parts, 0) == 0;
    regfree(&compiled);
    if (!matches)
        return false;
    *name = (ClassName){.of_platform = pattern->late != 0};
    name->late = pattern->late > 0 && parts[pattern->late].rm_so >= 0;
    copy_part(name->student, sizeof name->student, entry, &parts[pattern->student]);
    if (pattern->id)
        copy_part(name->id, sizeof name->id, entry, &parts[pattern->id]);
    if (pattern->file)
        copy_part(name->file, sizeof name->file, entry, &parts[pattern->file]);
    return true;
}

/* Canvas numbers resubmitted files: "lab05-1.frag". */
static int drop_number(char *file)
{
    int number = 0;
    char *ending = strrchr(file, '.');
    char *end = ending;
    while (end && end > file && isdigit((unsigned char)end[-1]))
        end--;
    if (end && end < ending && end > file + 1 && end[-1] == '-') {
        number = (int)strtol(end, NULL, 10);
        memmove(end - 1, ending, strlen(ending) + 1);
    }
    return number;
}

static bool is_of_digits(const char *text)
{
    return text[0] && text[strspn(text, "0123456789")] == '\0';
}

static bool match_any(const NamePattern *patterns, size_t count, const char *entry, ClassName *name)
{
    for (size_t i = 0; i < count; i++)
        if (match(&patterns[i], entry, name))
            return true;
    return false;
}

/* Removes an archive's extension, also ".tar.gz". */
static void stem(const char *entry, char text[BUNDLE_NAME_SIZE])
{
    snprintf(text, BUNDLE_NAME_SIZE, "%s", entry);
    char *ending = strrchr(text, '.');
    if (ending)
        *ending = '\0';
    ending = strrchr(text, '.');
    if (ending && strcasecmp(ending, ".tar") == 0)
        *ending = '\0';
}

/* Replaces by "?" what is not UTF-8, a control character or one of direction, because names go into
 * pages and tables. */
static void make_plain(char *text)
{
    char *to = text;
    while (*text) {
        const int size = text_character(text);
        if (!size || (unsigned char)*text < ' ' || *text == 0x7F || text_turns_direction(text)) {
            *to++ = '?';
        } else {
            memmove(to, text, (size_t)size);
            to += size;
        }
        text += size ? size : 1;
    }
    *to = '\0';
}

bool class_name_read(const char *entry, bool is_folder, ClassName *name)
{
    enum { FOLDERS = sizeof FOLDER_PATTERNS / sizeof FOLDER_PATTERNS[0] };
    enum { FILES = sizeof FILE_PATTERNS / sizeof FILE_PATTERNS[0] };
    char whole[BUNDLE_NAME_SIZE];
    const bool archive = !is_folder && unpack_is_archive(entry);
    if (entry[0] == '.' || strcmp(entry, "__MACOSX") == 0 || strlen(entry) >= sizeof whole ||
        strcasestr(entry, TYPED) || !(is_folder || archive || source_is_wanted(entry)))
        return false;
    /* An archive has a platform's name or, without its extension, a folder's. */
    bool read = !is_folder && match_any(FILE_PATTERNS, archive ? 2 : FILES, entry, name);
    if (archive && !read) {
        stem(entry, whole);
        read = match_any(FOLDER_PATTERNS, FOLDERS, whole, name);
    } else if (is_folder) {
        read = match_any(FOLDER_PATTERNS, FOLDERS, entry, name);
    }
    if (!read)
        return false;
    if (archive)
        name->file[0] = '\0';
    name->attempt = drop_number(name->file);
    if (is_of_digits(name->student) && !name->id[0])
        snprintf(name->id, sizeof name->id, "%.31s", name->student);
    make_plain(name->student);
    return name->student[0] != '\0';
}

void class_name_folder(const ClassName *name, char folder[CLASS_FOLDER_SIZE])
{
    static const char allowed[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-";
    const bool number = name->id[0] && strcmp(name->id, name->student) != 0;
    char text[CLASS_FOLDER_SIZE - 16];
    snprintf(text, sizeof text, "%.90s%s%.31s", name->student, number ? "_" : "",
             number ? name->id : "");
    /* What looks like a name with a hash gets one too, so that it cannot be another's. */
    const char *dash = strrchr(text, '-');
    bool same = strlen(name->student) <= 90 &&
                !(dash && strlen(dash) == 9 && strspn(dash + 1, "0123456789abcdef") == 8);
    for (char *at = text; *at; at++) {
        if (!strchr(allowed, *at) || (at == text && (*at == '.' || *at == '-'))) {
            *at = '_';
            same = false;
        }
    }
    uint64_t hash = source_hash_bytes(SOURCE_HASH_START, name->student, strlen(name->student) + 1);
    hash = source_hash_bytes(hash, name->id, strlen(name->id));
    if (same)
        snprintf(folder, CLASS_FOLDER_SIZE, "%s", text);
    else
        snprintf(folder, CLASS_FOLDER_SIZE, "%s-%08x", text, (unsigned)(hash ^ hash >> 32));
}

static FoundKind kind_of(mode_t mode, const char *entry)
{
    return S_ISDIR(mode)              ? FOUND_FOLDER
           : !S_ISREG(mode)           ? FOUND_OTHER
           : unpack_is_archive(entry) ? FOUND_ARCHIVE
                                      : FOUND_FILES;
}

static Found *add_found(FoundList *list)
{
    list->items = memory_grow(list->items, (size_t)list->count + 1, sizeof *list->items);
    list->items[list->count] = (Found){.count = 0};
    return &list->items[list->count++];
}

static Found *find_folder(const FoundList *list, const char *folder)
{
    for (int i = 0; i < list->count; i++)
        if (strcmp(list->items[i].folder, folder) == 0)
            return &list->items[i];
    return NULL;
}

static void add_file(Found *found, const char *path, const ClassName *name)
{
    for (int i = 0; i < found->count; i++) {
        struct FoundFile *file = &found->files[i];
        if (strcmp(file->name, name->file) != 0)
            continue;
        /* Another attempt. */
        if (name->attempt >= file->attempt) {
            snprintf(file->path, PATH_MAX, "%s", path);
            file->attempt = name->attempt;
        }
        return;
    }
    found->files = memory_grow(found->files, (size_t)found->count + 1, sizeof *found->files);
    struct FoundFile *file = &found->files[found->count++];
    snprintf(file->path, PATH_MAX, "%s", path);
    snprintf(file->name, BUNDLE_NAME_SIZE, "%s", name->file);
    file->attempt = name->attempt;
}

/* The name of an entry that is not read: without its ending it is named like an archive. */
static bool unread_name(const char *entry, ClassName *name)
{
    static const char *const junk[] = {"Thumbs.db", "desktop.ini", "__MACOSX"};
    char archive[2 * BUNDLE_NAME_SIZE], text[BUNDLE_NAME_SIZE];
    for (size_t i = 0; i < sizeof junk / sizeof junk[0]; i++)
        if (strcasecmp(entry, junk[i]) == 0)
            return false;
    if (entry[0] == '.' || strcasestr(entry, TYPED))
        return false;
    stem(entry, text);
    snprintf(archive, sizeof archive, "%.180s.zip", text[0] ? text : entry);
    return class_name_read(archive, false, name);
}

static void add_entry(FoundList *list, const char *folder, const char *entry, Message *notes)
{
    static const char *const kinds[] = {"other file", "files", "archive", "folder",
                                        "link or device"};
    bool unread = false;
    struct stat status;
    ClassName name;
    char path[PATH_MAX], key[CLASS_FOLDER_SIZE];
    if (snprintf(path, sizeof path, "%s/%s", folder, entry) >= (int)sizeof path ||
        lstat(path, &status) != 0)
        return;
    const bool is_file = S_ISREG(status.st_mode);
    if (!class_name_read(entry, S_ISDIR(status.st_mode) || (!is_file && !source_is_wanted(entry)),
                         &name)) {
        unread = unread_name(entry, &name);
        if (!unread)
            return;
    }
    const FoundKind kind = unread ? FOUND_UNREAD : kind_of(status.st_mode, entry);
    class_name_folder(&name, key);
    Found *found = find_folder(list, key);
    const bool again = found && (found->kind != FOUND_FILES || kind != FOUND_FILES);
    const bool known = again && kind != FOUND_UNREAD && found->kind != FOUND_UNREAD;
    const long long changed = (long long)status.st_mtime;
    const bool later = again && (known && changed != found->changed ? changed > found->changed
                                                                    : kind > found->kind);
    if (known && notes)
        message_add(notes, "%s%s: more than one submission; the %s is judged, which is the latest",
                    notes->text[0] ? "\n" : "", name.student, kinds[later ? kind : found->kind]);
    if (known)
        found->attempt++;
    if (again && !later)
        return;
    if (!found)
        found = add_found(list);
    if (found->attempt <= name.attempt)
        found->attempt = name.attempt + 1;
    found->name = name;
    found->kind = kind;
    found->changed = changed;
    memcpy(found->folder, key, sizeof key);
    memcpy(found->path, path, sizeof path);
    if (kind == FOUND_FILES)
        add_file(found, path, &name);
}

static int by_folder(const void *a, const void *b)
{
    return strcmp(((const Found *)a)->folder, ((const Found *)b)->folder);
}

bool class_find(const char *folder, const char *skipped, FoundList *list, Message *notes,
                Message *message)
{
    struct dirent **entries;
    *list = (FoundList){.count = 0};
    const int count = scandir(folder, &entries, NULL, alphasort);
    if (count < 0)
        return message_set(message, "%s: %s; name the folder with one submission per student",
                           folder, strerror(errno));
    for (int i = 0; i < count; i++) {
        if (!skipped || strcmp(entries[i]->d_name, skipped) != 0)
            add_entry(list, folder, entries[i]->d_name, notes);
        free(entries[i]);
    }
    free(entries);
    if (list->count == 0)
        return message_set(
            message, "%s: no submissions: expected a folder or an archive per student", folder);
    qsort(list->items, (size_t)list->count, sizeof list->items[0], by_folder);
    return true;
}

/* The only archive in a folder or its folders: learning platforms nest them. */
static bool find_archive(const char *folder, int depth, char archive[PATH_MAX], Message *message)
{
    struct dirent *entry;
    bool done = true;
    DIR *stream = opendir(folder);
    if (!stream)
        return message_set(message, "cannot be read: %s", strerror(errno));
    while (done && (entry = readdir(stream)) != NULL) {
        char path[PATH_MAX];
        struct stat status;
        if (entry->d_name[0] == '.' || strcmp(entry->d_name, "__MACOSX") == 0 ||
            snprintf(path, sizeof path, "%s/%s", folder, entry->d_name) >= (int)sizeof path ||
            lstat(path, &status) != 0)
            continue;
        if (S_ISDIR(status.st_mode) && depth < 2)
            done = find_archive(path, depth + 1, archive, message);
        else if (S_ISREG(status.st_mode) && unpack_is_archive(entry->d_name) && archive[0])
            done = message_set(message, "has several archives; submit one");
        else if (S_ISREG(status.st_mode) && unpack_is_archive(entry->d_name))
            memcpy(archive, path, sizeof path);
    }
    closedir(stream);
    return done;
}

bool class_read(const Found *found, Bundle *bundle, char archive[PATH_MAX], Message *message)
{
    archive[0] = '\0';
    switch (found->kind) {
    case FOUND_UNREAD: {
        const char *ending = strrchr(found->path, '.');
        return message_set(message, "not read: %s; hand in .vert, .frag and .c files, or a .zip",
                           ending && !strchr(ending, '/') ? ending : "a file of an unknown kind");
    }
    case FOUND_ARCHIVE:
        memcpy(archive, found->path, PATH_MAX);
        return true;
    case FOUND_FOLDER:
        return source_read_folder(bundle, found->path, message) &&
               (bundle->count > 0 || find_archive(found->path, 1, archive, message));
    case FOUND_FILES:
        for (int i = 0; i < found->count; i++)
            if (!source_read_file(bundle, found->files[i].path, found->files[i].name, message))
                return false;
        return true;
    default:
        return message_set(message, "is a link or a device; submit the files themselves");
    }
}

void class_found_close(FoundList *list)
{
    if (!list)
        return;
    for (int i = 0; i < list->count; i++)
        free(list->items[i].files);
    free(list->items);
    *list = (FoundList){.count = 0};
}
