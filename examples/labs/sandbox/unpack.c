/* libarchive reads the formats. Nothing is written, so what an archive says of paths, links and
 * owners does no harm; what it unpacks to is counted as it comes. */
#include "labs/sandbox/source.h"

#include <archive.h>
#include <archive_entry.h>
#include <locale.h>
#include <string.h>
#include <strings.h>

bool unpack_is_archive(const char *name)
{
    static const char *const endings[] = {".zip",     ".tar",    ".tgz",     ".tar.gz",
                                          ".tar.bz2", ".tar.xz", ".tar.zst", ".7z"};
    const size_t length = strlen(name);
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++) {
        const size_t ending = strlen(endings[i]);
        if (length > ending && strcasecmp(name + length - ending, endings[i]) == 0)
            return true;
    }
    return false;
}

bool unpack_stays_inside(const char *path)
{
    if (path[0] == '/' || (path[0] && path[1] == ':'))
        return false;
    for (const char *part = path; *part;) {
        const size_t length = strcspn(part, "/");
        if (length == 2 && part[0] == '.' && part[1] == '.')
            return false;
        part += length + (part[length] == '/');
    }
    return true;
}

/* The path of an entry, with "/" instead of Windows's "\\". */
static bool read_path(struct archive_entry *entry, char path[BUNDLE_NAME_SIZE], Message *message)
{
    const char *given = archive_entry_pathname(entry);
    if (!given)
        given = archive_entry_pathname_utf8(entry);
    if (!given)
        return message_set(message, "the archive contains an unreadable name");
    if (strlen(given) >= BUNDLE_NAME_SIZE)
        return message_set(message, "%.40s...: the path is too long", given);
    memcpy(path, given, strlen(given) + 1);
    for (char *at = path; *at; at++)
        if (*at == '\\')
            *at = '/';
    if (!unpack_stays_inside(path))
        return message_set(message, "the archive leaves its folder: %s", path);
    return true;
}

static bool read_data(Bundle *bundle, struct archive *archive, const char *name, Message *message)
{
    size_t size = 0;
    la_ssize_t count = 1;
    static char bytes[SOURCE_FILE_MAX + 1];
    while (size <= SOURCE_FILE_MAX && count > 0) {
        count = archive_read_data(archive, bytes + size, SOURCE_FILE_MAX + 1 - size);
        size += count > 0 ? (size_t)count : 0;
    }
    const bool done =
        count < 0 ? message_set(message, "%s: %s", name, archive_error_string(archive))
        : size > SOURCE_FILE_MAX
            ? message_set(message, "%s: unpacks to more than %d KB", name, SOURCE_FILE_MAX >> 10)
            : bundle_add(bundle, name, bytes, size, message);
    return done;
}

static bool too_much(Message *message)
{
    return message_set(message, "the archive unpacks to more than %d MB", UNPACK_BYTES_MAX >> 20);
}

/* Unpacks an unwanted entry to count its bytes; a .zip can skip it. */
static bool skip_data(struct archive *archive, size_t *unpacked, Message *message)
{
    const void *block;
    size_t size;
    la_int64_t offset;
    if ((archive_format(archive) & ARCHIVE_FORMAT_BASE_MASK) == ARCHIVE_FORMAT_ZIP)
        return true;
    while (archive_read_data_block(archive, &block, &size, &offset) == ARCHIVE_OK)
        if (offset < 0 || (*unpacked += size) > UNPACK_BYTES_MAX)
            return too_much(message);
    return true;
}

static bool read_entry(Bundle *bundle, struct archive *archive, struct archive_entry *entry,
                       size_t *unpacked, Message *message)
{
    char whole[BUNDLE_NAME_SIZE];
    if (!read_path(entry, whole, message))
        return false;
    const char *path = whole;
    while (path[0] == '.' && path[1] == '/')
        path += 2;
    if (archive_entry_filetype(entry) == AE_IFDIR || !source_is_wanted(path))
        return skip_data(archive, unpacked, message);
    if (archive_entry_filetype(entry) == AE_IFLNK || archive_entry_hardlink(entry))
        return message_set(message, "%.200s: is a link; submit the file itself", path);
    if (archive_entry_filetype(entry) != AE_IFREG)
        return message_set(message, "%.200s: not a regular file", path);
    return read_data(bundle, archive, path, message);
}

static bool read_entries(Bundle *bundle, struct archive *archive, Message *message)
{
    size_t unpacked = 0;
    for (int count = 0;; count++) {
        struct archive_entry *entry;
        const int result = archive_read_next_header(archive, &entry);
        if (result == ARCHIVE_EOF)
            return true;
        if (result != ARCHIVE_OK && result != ARCHIVE_WARN)
            return message_set(message, "the archive cannot be read: %s",
                               archive_error_string(archive));
        if (count == UNPACK_ENTRIES_MAX)
            return message_set(message, "the archive has more than %d files", UNPACK_ENTRIES_MAX);
        if (!read_entry(bundle, archive, entry, &unpacked, message))
            return false;
        /* Counts also what is compressed as a whole. */
        if (archive_filter_bytes(archive, 0) > UNPACK_BYTES_MAX)
            return too_much(message);
    }
}

bool unpack_sources(Bundle *bundle, int file, Message *message)
{
    enum { BLOCK = 64 << 10 };
    setlocale(LC_CTYPE, "C.UTF-8"); /* for a .zip with UTF-8 names */
    struct archive *archive = archive_read_new();
    if (!archive)
        return message_set(message, "not enough memory");
    archive_read_support_filter_gzip(archive);
    archive_read_support_filter_bzip2(archive);
    archive_read_support_filter_xz(archive);
    archive_read_support_filter_zstd(archive);
    archive_read_support_format_zip(archive);
    archive_read_support_format_tar(archive);
    archive_read_support_format_7zip(archive);
    const bool done =
        archive_read_open_fd(archive, file, BLOCK) == ARCHIVE_OK
            ? read_entries(bundle, archive, message)
            : message_set(message, "the archive cannot be read: %s", archive_error_string(archive));
    archive_read_free(archive);
    return done;
}
