#include "gallery/manifest.h"

#include "base/output_text.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#ifdef HAVE_LIBGCRYPT
#include <gcrypt.h>

/* Of two pieces, in hexadecimal. */
static void hash_text(const void *first, size_t first_size, const void *second, size_t second_size,
                      char text[MANIFEST_HASH_SIZE])
{
    const gcry_buffer_t pieces[] = {{.data = (void *)(uintptr_t)first, .len = first_size},
                                    {.data = (void *)(uintptr_t)second, .len = second_size}};
    unsigned char hash[32];
    gcry_md_hash_buffers(GCRY_MD_SHA256, 0, hash, pieces, 2);
    for (int i = 0; i < 32; i++)
        snprintf(text + 2 * i, 3, "%02x", hash[i]);
}

bool manifest_possible(Message *message)
{
    if (!gcry_check_version(GCRYPT_VERSION))
        return message_set(message, "libgcrypt is older than %s, which this program was built for",
                           GCRYPT_VERSION);
    gcry_control(GCRYCTL_INITIALIZATION_FINISHED, 0);
    return true;
}
#else
static void hash_text(const void *first, size_t first_size, const void *second, size_t second_size,
                      char text[MANIFEST_HASH_SIZE])
{
    (void)first, (void)first_size, (void)second, (void)second_size;
    text[0] = '\0';
}

bool manifest_possible(Message *message)
{
    return message_set(message, "SHA-256: this program was built without libgcrypt; install the "
                                "package libgcrypt20-dev and build again");
}
#endif

static void hash_pixels(const Image *image, char text[MANIFEST_HASH_SIZE])
{
    char size[64];
    const int length = snprintf(size, sizeof size, "%dx%d\n", image->width, image->height);
    hash_text(size, (size_t)length, image->pixels, image_row_size(image) * (size_t)image->height,
              text);
}

/* The two hashes of a picture, which stays open. */
static bool describe(ManifestEntry *entry, const ImageFile *file, Picture *picture,
                     Message *message)
{
    *picture = (Picture){.alpha = false};
    snprintf(picture->path, sizeof picture->path, "%s.png", entry->name);
    hash_text(file->bytes, file->size, "", 0, entry->file);
    if (!picture_decode(picture, file, message))
        return false;
    hash_pixels(&picture->image, entry->pixels);
    return true;
}

bool manifest_add(Manifest *manifest, const char *name, const ImageFile *file, Message *message)
{
    Picture picture;
    ManifestEntry *entry = &manifest->entries[manifest->count];
    if (manifest->count == MANIFEST_MAX)
        return message_set(message, "manifest: more than %d pictures", MANIFEST_MAX);
    snprintf(entry->name, sizeof entry->name, "%s", name);
    const bool done = describe(entry, file, &picture, message);
    image_close(&picture.image);
    manifest->count += done;
    return done;
}

bool manifest_write(const Manifest *manifest, const char *path, Message *message)
{
    OutputText text;
    output_text_open(&text);
    fprintf(text.file, "# %s\n", manifest->command);
    for (int i = 0; i < manifest->count; i++)
        fprintf(text.file, "%s  %s.png\n# pixels %s\n", manifest->entries[i].file,
                manifest->entries[i].name, manifest->entries[i].pixels);
    return output_text_write(&text, path, message);
}

static bool is_hash(const char *text)
{
    return strlen(text) == MANIFEST_HASH_SIZE - 1 &&
           strspn(text, "0123456789abcdef") == MANIFEST_HASH_SIZE - 1;
}

/* A line, without its end. False if it is none of a manifest. */
static bool read_line(Manifest *manifest, const char *line)
{
    char hash[80], name[80];
    int end = 0;
    ManifestEntry *last = manifest->count ? &manifest->entries[manifest->count - 1] : NULL;
    if (!last && !manifest->command[0] && strncmp(line, "# ", 2) == 0) {
        const int length = snprintf(manifest->command, sizeof manifest->command, "%s", line + 2);
        return length > 0 && length < (int)sizeof manifest->command;
    }
    if (sscanf(line, "# pixels %79s%n", hash, &end) == 1 && !line[end]) {
        if (!last || last->pixels[0] || !is_hash(hash))
            return false;
        memcpy(last->pixels, hash, sizeof last->pixels);
        return true;
    }
    if (sscanf(line, "%79s %79s%n", hash, name, &end) != 2 || line[end] || !is_hash(hash) ||
        (last && !last->pixels[0]) || manifest->count == MANIFEST_MAX)
        return false;
    const size_t length = strlen(name);
    if (length < 5 || length >= sizeof last->name || strcmp(name + length - 4, ".png") != 0 ||
        strchr(name, '/'))
        return false;
    name[length - 4] = '\0';
    if (manifest_find(manifest, name))
        return false;
    ManifestEntry *entry = &manifest->entries[manifest->count++];
    *entry = (ManifestEntry){.pixels = ""};
    snprintf(entry->name, sizeof entry->name, "%.63s", name);
    memcpy(entry->file, hash, sizeof entry->file);
    return true;
}

bool manifest_read(Manifest *manifest, const char *path, Message *message)
{
    char line[1100];
    int number = 0;
    bool good = true;
    *manifest = (Manifest){.count = 0};
    FILE *file = fopen(path, "re");
    if (!file)
        return message_set(message, "%s: cannot read: %s", path, strerror(errno));
    while (good && fgets(line, sizeof line, file)) {
        const size_t length = strcspn(line, "\n");
        number++;
        good = line[length] == '\n';
        line[length] = '\0';
        good = good && read_line(manifest, line);
    }
    good = good && !ferror(file);
    fclose(file);
    if (good && manifest->count && manifest->entries[manifest->count - 1].pixels[0])
        return true;
    return message_set(message,
                       "%s: line %d: is no line of a manifest, which gallery --manifest "
                       "writes",
                       path, number);
}

const ManifestEntry *manifest_find(const Manifest *manifest, const char *name)
{
    for (int i = 0; i < manifest->count; i++)
        if (strcmp(manifest->entries[i].name, name) == 0)
            return &manifest->entries[i];
    return NULL;
}

ManifestResult manifest_compare(const ManifestEntry *entry, const ImageFile *file, Message *message)
{
    Picture picture;
    ManifestEntry has = *entry;
    const bool done = describe(&has, file, &picture, message);
    image_close(&picture.image);
    return !done                                    ? MANIFEST_FAILED
           : strcmp(has.file, entry->file) == 0     ? MANIFEST_SAME
           : strcmp(has.pixels, entry->pixels) == 0 ? MANIFEST_PIXELS
                                                    : MANIFEST_DIFFERENT;
}
