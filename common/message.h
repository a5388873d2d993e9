/*
 * message: the one sentence that a function which fails leaves behind.
 *
 * A fallible function takes a Message as its last argument, returns false and leaves there what
 * failed, on what, and what to do. Nothing in common/ prints an error or exits: the program's edge
 * says the message, once. The first message wins, for it is nearest to the cause.
 */
#ifndef MESSAGE_H
#define MESSAGE_H

#include <stdbool.h>

/* `text` is "subject: reason", without a newline at its end; more lines may follow the first
 * (a shader's source line, the paths that were tried). A zeroed Message is empty. */
typedef struct Message {
    char text[4096];
    bool located; /* begins "file:line:", and is said without the program's name before it */
} Message;

/* Leaves a message unless there is one already; longer text is cut. `message` may be NULL.
 * Always returns false, so that a failing function can `return message_set(...)`. */
bool message_set(Message *message, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Appends to the message that is there; for a failing function that adds lines one by one. */
bool message_add(Message *message, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
