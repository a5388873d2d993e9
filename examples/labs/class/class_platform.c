/* What learning platforms hand out and take back. Their archives have one folder or some files for
 * each student, whose names class_find knows; links and paths out of the folder are refused. */
#include "labs/class/class_report.h"

#include "base/input.h"
#include "base/output.h"
#include "base/output_text.h"
#include "labs/sandbox/source.h"

#include <archive.h>
#include <archive_entry.h>
#include <fcntl.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static bool copy_entry(struct archive *from, struct archive *to, size_t *total)
{
    enum { BYTES_MAX = 1 << 30 }; /* of a class */
    const void *block;
    size_t size;
    la_int64_t offset;
    int result;
    while ((result = archive_read_data_block(from, &block, &size, &offset)) == ARCHIVE_OK) {
        *total += size;
        if (*total > BYTES_MAX || archive_write_data_block(to, block, size, offset) != ARCHIVE_OK)
            return false;
    }
    return result == ARCHIVE_EOF && archive_write_finish_entry(to) == ARCHIVE_OK;
}

static bool unpack(struct archive *from, struct archive *to, const char *folder, Message *message)
{
    enum { ENTRIES_MAX = 20000 };
    struct archive_entry *entry;
    size_t total = 0;
    char path[PATH_MAX];
    for (int count = 0; archive_read_next_header(from, &entry) == ARCHIVE_OK; count++) {
        const char *name = archive_entry_pathname(entry);
        const int type = (int)archive_entry_filetype(entry);
        if (count == ENTRIES_MAX || !name || !unpack_stays_inside(name) ||
            (type != AE_IFREG && type != AE_IFDIR) || !output_path(path, folder, name, NULL))
            return message_set(message, "not unpacked: %.200s", name ? name : "a nameless file");
        archive_entry_set_pathname(entry, path);
        archive_entry_set_perm(entry, type == AE_IFDIR ? 0755 : 0644);
        if (archive_write_header(to, entry) != ARCHIVE_OK || !copy_entry(from, to, &total))
            return message_set(message, "%.200s: %s", name,
                               archive_error_string(to) ? archive_error_string(to)
                                                        : "too large or damaged");
    }
    return archive_errno(from) == 0 || message_set(message, "%s", archive_error_string(from));
}

bool class_unpack(const char *path, const char *folder, Message *message)
{
    Message why = {.text = ""};
    setlocale(LC_CTYPE, "C.UTF-8"); /* for names in UTF-8 */
    struct archive *from = archive_read_new(), *to = archive_write_disk_new();
    archive_read_support_format_zip(from);
    archive_write_disk_set_options(to, ARCHIVE_EXTRACT_TIME | ARCHIVE_EXTRACT_SECURE_SYMLINKS |
                                           ARCHIVE_EXTRACT_SECURE_NODOTDOT);
    bool done = output_folder(folder, message);
    if (done && archive_read_open_filename(from, path, 64 << 10) != ARCHIVE_OK)
        done = message_set(message, "%s: %s; name the platform's .zip or a folder", path,
                           archive_error_string(from));
    else if (done && !unpack(from, to, folder, &why))
        done = message_set(message, "%s: %.500s", path, why.text);
    archive_read_free(from);
    archive_write_free(to);
    return done;
}

enum { FEEDBACK_MAX = 32 << 20 }; /* bytes of a file */

/* Moodle takes NAME_ID_assignfeedback_file_/FILE (mod/assign/feedback/file/importziplib.php). */
static bool add_feedback(struct archive *zip, const ClassStore *store, const ClassResult *result,
                         const char *file, Message *message)
{
    char path[PATH_MAX], name[2 * CLASS_STUDENT_SIZE + 64];
    size_t size;
    if (!class_store_path(store->folder, result->folder, file, path, message))
        return false;
    char *bytes = input_read(AT_FDCWD, path, path, FEEDBACK_MAX, &size, NULL);
    if (!bytes)
        return true; /* there is no picture */
    snprintf(name, sizeof name, "%s_%s_assignfeedback_file_/%s", result->student, result->id, file);
    for (char *at = name; at < name + strlen(result->student); at++)
        *at = *at == '/' || *at == '_' ? ' ' : *at; /* Moodle divides the name at "_" */
    struct archive_entry *entry = archive_entry_new();
    archive_entry_set_pathname_utf8(entry, name);
    archive_entry_set_filetype(entry, AE_IFREG);
    archive_entry_set_perm(entry, 0644);
    archive_entry_set_mtime(entry, (time_t)result->when, 0);
    archive_entry_set_size(entry, (la_int64_t)size);
    const bool done = archive_write_header(zip, entry) == ARCHIVE_OK &&
                      archive_write_data(zip, bytes, size) == (la_ssize_t)size;
    archive_entry_free(entry);
    free(bytes);
    return done || message_set(message, "feedback.zip: %s", archive_error_string(zip));
}

static bool write_feedback(const ClassStore *store, Message *message)
{
    char path[PATH_MAX];
    Output *output = output_path(path, store->folder, "feedback.zip", message)
                         ? output_begin(path, message)
                         : NULL;
    if (!output)
        return false;
    setlocale(LC_CTYPE, "C.UTF-8");
    struct archive *zip = archive_write_new();
    archive_write_set_format_zip(zip);
    bool done = archive_write_open_fd(zip, output_file(output)) == ARCHIVE_OK;
    for (int i = 0; i < store->count && done; i++)
        done = !store->results[i].id[0] ||
               (add_feedback(zip, store, &store->results[i], "index.html", message) &&
                add_feedback(zip, store, &store->results[i], "worst.png", message));
    done = archive_write_close(zip) == ARCHIVE_OK && done;
    archive_write_free(zip);
    if (done)
        return output_commit(output, message);
    output_abort(output);
    return message_set(message, "%s: cannot be written", path);
}

/* Moodle's grading worksheet (mod/assign/feedback/offline/importgradeslib.php refuses one without
 * the number, the grade and when it was changed) and Canvas's gradebook. */
static bool write_grades(const ClassStore *store, bool canvas, Message *message)
{
    OutputText out;
    output_text_open(&out);
    const double most = store->count ? store->results[0].verdict.most : 0;
    if (canvas)
        fprintf(out.file,
                "Student,ID,SIS User ID,SIS Login ID,Section,%s\r\n    Points Possible,,,,,%g\r\n",
                store->count ? store->results[0].lab : "", most);
    else
        fputs("Identifier,Full name,Grade,Maximum Grade,Last modified (grade)\r\n", out.file);
    for (int i = 0; i < store->count; i++) {
        const ClassResult *result = &store->results[i];
        if (!result->id[0])
            continue;
        const double points = result->verdict.points;
        if (!canvas)
            fprintf(out.file, "Participant %s,", result->id);
        class_table_csv_field(out.file, result->student);
        if (canvas)
            fprintf(out.file, ",%s,,,,%g\r\n", result->id, points);
        else
            fprintf(out.file, ",%g,%g,-\r\n", points, most);
    }
    return output_text_put(&out, store->folder, canvas ? "canvas.csv" : "moodle.csv", message);
}

bool class_platform_write(const ClassStore *store, Message *message)
{
    bool any = false;
    for (int i = 0; i < store->count; i++)
        any |= store->results[i].id[0] != '\0';
    return !any || (write_grades(store, false, message) && write_grades(store, true, message) &&
                    write_feedback(store, message));
}
