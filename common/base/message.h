/*
 * message: error messages as values.
 *
 * A fallible function takes a Message as its last argument; on failure it returns false and leaves
 * there what failed, on what, and what to do. Nothing in common/ prints an error or exits: main
 * prints the message, once. The first message wins, because it is nearest to the cause.
 */
#ifndef MESSAGE_H
#define MESSAGE_H

#include <stdbool.h>

/* A zeroed Message is empty. */
typedef struct Message {
    char text[4096]; /* "subject: reason", without a final newline; more lines may follow (a
                        shader's source line, the paths tried) */
    bool located;    /* begins with "file:line:"; printed without the program's name */
} Message;

/* Sets the message unless it is set already; cuts text that is too long. `message` may be NULL.
 * Returns false, so that a failing function can `return message_set(...)`. */
bool message_set(Message *message, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The same, but appends. */
bool message_add(Message *message, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* A colour's escape sequence; "" if what is written to this file descriptor may have none: it is no
 * terminal, or NO_COLOR (https://no-color.org) or TERM=dumb says so. */
enum { MESSAGE_PLAIN, MESSAGE_RED, MESSAGE_GREEN, MESSAGE_YELLOW };
const char *message_color(int color, int file);

#endif
