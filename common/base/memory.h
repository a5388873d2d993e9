/*
 * memory: small blocks of the heap, of which there always are enough.
 *
 * For what is small whatever the user asks for: names, texts, lists, states of modules. If there is
 * no memory even for these, the process ends: one line on standard error, "PROGRAM: not enough
 * memory", exit status MEMORY_EXIT; half-written files are removed (see output.h), and what
 * standard output still holds is dropped. Pictures, meshes and all else whose size the user chooses
 * are allocated by their modules, which return a message.
 *
 * All results are for free(). A block of no bytes is a block, too.
 */
#ifndef MEMORY_H
#define MEMORY_H

#include <stddef.h>
#include <string.h>

enum { MEMORY_EXIT = 1 };

/* Ends the process in this way. */
_Noreturn void memory_end(void);

/* `count` zeroed items. */
void *memory_new(size_t count, size_t size) __attribute__((malloc, returns_nonnull));

/* The block, NULL or from here, with room for `count` items; new ones are not set. */
void *memory_grow(void *block, size_t count, size_t size)
    __attribute__((warn_unused_result, returns_nonnull));

/* Twice the room for items in the list that `list` points to. */
void memory_more(void *list, int *room, size_t size);

/* One more item, not set, of the list that `list` points to, which has room for so many. */
static inline void *memory_add(void *list, int *count, int *room, size_t size)
{
    char *items;
    if (*count == *room)
        memory_more(list, room, size);
    memcpy(&items, list, sizeof items); /* a pointer of any type */
    return items + size * (size_t)(*count)++;
}

/* A copy, and a zero byte after it. */
void *memory_copy(const void *bytes, size_t size) __attribute__((malloc, returns_nonnull));
char *memory_text(const char *text) __attribute__((malloc, returns_nonnull));

/* What printf would print. */
char *memory_format(const char *format, ...)
    __attribute__((malloc, returns_nonnull, format(printf, 1, 2)));

#endif
