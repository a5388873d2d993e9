/* A PNG is chunks with checksums; only three kinds are needed to show it, and no other is kept. */
#include "labs/sandbox/png_copy.h"

#include <stdint.h>
#include <string.h>
#include <zlib.h>

enum { CHUNK_FRAME = 12, HEADER_SIZE = 13 }; /* length, kind and sum; IHDR's content */

static uint32_t read_number(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

static bool header_is_good(const unsigned char *header, size_t length)
{
    if (length != HEADER_SIZE)
        return false;
    const uint32_t width = read_number(header), height = read_number(header + 4);
    return width >= 1 && width <= PNG_COPY_SIDE_MAX && height >= 1 && height <= PNG_COPY_SIDE_MAX &&
           header[8] == 8 && (header[9] == 2 || header[9] == 6) && header[10] == 0 &&
           header[11] == 0 && header[12] == 0;
}

bool png_copy(unsigned char *bytes, size_t *size, Message *message)
{
    static const unsigned char signature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    size_t at = sizeof signature, kept = at, pixels = 0;
    if (*size < at || memcmp(bytes, signature, at) != 0)
        return message_set(message, "not a PNG file");
    while (*size - at >= CHUNK_FRAME) {
        const size_t length = read_number(bytes + at);
        const unsigned char *kind = bytes + at + 4;
        const bool first = at == sizeof signature;
        if (length > *size - at - CHUNK_FRAME ||
            crc32_z(0, kind, length + 4) != read_number(kind + 4 + length))
            break;
        if (first != (memcmp(kind, "IHDR", 4) == 0) || (first && !header_is_good(kind + 4, length)))
            return message_set(message,
                               "not an 8-bit RGB or RGBA PNG of at most %d pixels per side",
                               PNG_COPY_SIDE_MAX);
        const bool is_end = memcmp(kind, "IEND", 4) == 0, is_data = memcmp(kind, "IDAT", 4) == 0;
        const size_t whole = length + CHUNK_FRAME;
        if (is_end && (length > 0 || pixels == 0))
            break;
        if (first || is_end || is_data) {
            memmove(bytes + kept, bytes + at, whole);
            kept += whole;
        }
        pixels += is_data ? length : 0;
        at += whole;
        if (is_end) {
            *size = kept;
            return true;
        }
    }
    return message_set(message, "is cut or broken");
}
