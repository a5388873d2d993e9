/* A font's file is mapped, not read: of 750 KB a label touches a few pages. */
#include "base/memory.h"

#include <stdlib.h>

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_malloc(size, user) ((void)(user), memory_new(1, size))
#define STBTT_free(block, user) ((void)(user), free(block))
#include "images/font.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

static uint32_t big_endian(const unsigned char *bytes, int count)
{
    uint32_t value = 0;
    for (int i = 0; i < count; i++)
        value = value << 8 | bytes[i];
    return value;
}

/* Whether every table lies within the file. (OpenType specification, "Table Directory") */
static bool has_whole_tables(const unsigned char *file, size_t size)
{
    enum { HEADER = 12, RECORD = 16 };
    if (size < HEADER || size < HEADER + RECORD * big_endian(file + 4, 2))
        return false;
    for (uint32_t i = 0; i < big_endian(file + 4, 2); i++) {
        const unsigned char *record = file + HEADER + RECORD * i;
        const uint32_t offset = big_endian(record + 8, 4), length = big_endian(record + 12, 4);
        if (offset > size || length > size - offset)
            return false;
    }
    return true;
}

void font_close(Font *font)
{
    if (font->file)
        munmap(font->file, font->size);
    *font = (Font){.size = 0};
}

bool font_open(Font *font, const char *path, const char *package, Message *message)
{
    struct stat status;
    *font = (Font){.size = 0};
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file >= 0 && fstat(file, &status) == 0) {
        font->size = (size_t)status.st_size;
        void *mapped = mmap(NULL, font->size, PROT_READ, MAP_PRIVATE, file, 0);
        font->file = mapped == MAP_FAILED ? NULL : mapped;
    }
    const int error = errno;
    if (file >= 0)
        close(file);
    if (font->file && has_whole_tables(font->file, font->size) &&
        stbtt_InitFont(&font->info, font->file, 0))
        return true;
    message_set(message, "%s: cannot read the font: %s; install the package %s", path,
                font->file ? "not a complete TrueType font" : strerror(error), package);
    font_close(font);
    return false;
}

int font_character(const char **text)
{
    const unsigned char *byte = (const unsigned char *)*text;
    const int more = byte[0] < 0x80           ? 0
                     : (byte[0] >> 5) == 0x6  ? 1
                     : (byte[0] >> 4) == 0xE  ? 2
                     : (byte[0] >> 3) == 0x1E ? 3
                                              : -1;
    int code = more > 0 ? byte[0] & (0x3F >> more) : byte[0];
    int read = 0;
    for (; read < more && (byte[read + 1] & 0xC0) == 0x80; read++)
        code = code << 6 | (byte[read + 1] & 0x3F);
    *text += 1 + read;
    return read == more ? code : 0xFFFD;
}
