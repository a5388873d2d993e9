/*
 * class_fuzz: no name, file, picture or archive does harm. The first byte selects which one
 * follows.
 */
#include "fuzz/fuzz.h"
#include "labs/class/class_find.h"
#include "labs/sandbox/bundle.h"
#include "labs/sandbox/png_copy.h"
#include "labs/sandbox/source.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

static Bundle bundle;

static void check_bundle(void)
{
    size_t size = 0;
    for (int i = 0; i < bundle.count; i++) {
        require(bundle_name_is_safe(bundle.files[i].name));
        size += bundle.files[i].size;
    }
    require(size == bundle.size && size <= BUNDLE_BYTES_MAX);
}

/* A name, a zero byte, a size and so many bytes, again and again. */
static void read_files(const uint8_t *data, size_t size)
{
    const uint8_t *end = data + size, *name_end;
    while ((name_end = memchr(data, 0, (size_t)(end - data))) && end - name_end > 2) {
        const size_t rest = (size_t)(end - name_end) - 2;
        const size_t length = name_end[1] < rest ? name_end[1] : rest;
        Message message = {.text = ""};
        require(bundle_add(&bundle, (const char *)data, name_end + 2, length, &message) ==
                !message.text[0]);
        data = name_end + 2 + length;
    }
    check_bundle();
    for (int lab = 1; lab <= 2; lab++)
        source_choose(&bundle, &LABS[lab - 1], NULL);
    check_bundle();
    source_normalize(&bundle, &LABS[2]);
    check_bundle();
    for (int lab = 1; lab <= 3; lab++) {
        SubmissionFiles files;
        require(!source_files(&bundle, &LABS[lab - 1], &files, NULL) || files.count > 0);
        submission_files_close(&files);
    }
    bundle_close(&bundle);
}

static void read_name(const uint8_t *data, size_t size)
{
    ClassName name;
    char entry[256], folder[CLASS_FOLDER_SIZE];
    const size_t length = size < sizeof entry ? size : sizeof entry - 1;
    memcpy(entry, data, length);
    entry[length] = '\0';
    if (strchr(entry, '/'))
        return;
    for (int is_folder = 0; is_folder < 2; is_folder++) {
        if (!class_name_read(entry, is_folder, &name))
            continue;
        class_name_folder(&name, folder);
        require(name.student[0] && bundle_name_is_safe(folder) && !strchr(folder, '/') &&
                folder[0] != '.' && folder[0] != '-');
        json_t *text = json_string(name.student); /* refuses what is not UTF-8 */
        require(text);
        json_decref(text);
    }
}

static void read_picture(const uint8_t *data, size_t size)
{
    unsigned char *copy = malloc(size + 1);
    size_t kept = size, again;
    if (!copy)
        return;
    memcpy(copy, data, size);
    if (png_copy(copy, &kept, NULL)) {
        again = kept;
        require(kept <= size && png_copy(copy, &again, NULL) && again == kept);
    }
    free(copy);
}

static void read_archive(const uint8_t *data, size_t size)
{
    Message message = {.text = ""};
    const int file = memfd_create("archive", MFD_CLOEXEC);
    if (file >= 0 && write(file, data, size) == (ssize_t)size && lseek(file, 0, SEEK_SET) == 0) {
        require(unpack_sources(&bundle, file, &message) == !message.text[0]);
        check_bundle();
        bundle_close(&bundle);
    }
    if (file >= 0)
        close(file);
}

FUZZ(data, size)
{
    static void (*const readers[])(const uint8_t *, size_t) = {read_files, read_name, read_picture,
                                                               read_archive};
    if (size > 0)
        readers[data[0] % 4](data + 1, size - 1);
    return 0;
}
