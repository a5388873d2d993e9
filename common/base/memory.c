/* calloc, realloc and friends, which end the process (memory_end) when they get nothing. */
#include "base/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void *memory_grow(void *block, size_t count, size_t size)
{
    size_t bytes;
    void *grown = NULL;
    if (!__builtin_mul_overflow(count, size, &bytes))
        grown = realloc(block, bytes ? bytes : 1);
    if (!grown)
        memory_end();
    return grown;
}

void *memory_new(size_t count, size_t size)
{
    void *block = calloc(count ? count : 1, size ? size : 1);
    if (!block)
        memory_end();
    return block;
}

void memory_more(void *list, int *room, size_t size)
{
    void *items;
    memcpy(&items, list, sizeof items);
    *room = *room ? 2 * *room : 64;
    items = memory_grow(items, (size_t)*room, size);
    memcpy(list, &items, sizeof items);
}

void *memory_copy(const void *bytes, size_t size)
{
    char *copy = memory_grow(NULL, size + 1, 1);
    if (size)
        memcpy(copy, bytes, size);
    copy[size] = '\0';
    return copy;
}

char *memory_text(const char *text)
{
    return memory_copy(text, strlen(text));
}

char *memory_format(const char *format, ...)
{
    char *text;
    va_list arguments;
    va_start(arguments, format);
    const int length = vasprintf(&text, format, arguments);
    va_end(arguments);
    if (length < 0)
        memory_end();
    return text;
}
