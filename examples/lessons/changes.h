/*
 * changes: which lines of a program or shader differ from its predecessor's.
 */
#ifndef CHANGES_H
#define CHANGES_H

#include "base/message.h"

typedef enum ChangeKind {
    CHANGE_SAME,
    CHANGE_REMOVED,
    CHANGE_ADDED,
    CHANGE_GAP,   /* lines that are the same are left out here */
    CHANGE_TITLE, /* of a file */
} ChangeKind;

enum { CHANGE_TEXT_SIZE = 128 };

typedef struct ChangeLine {
    ChangeKind kind;
    char text[CHANGE_TEXT_SIZE]; /* cut if it is longer */
} ChangeLine;

/* Zeroed: empty. */
typedef struct Changes {
    ChangeLine *lines;
    int count, room;
} Changes;

/* A file in memory, and the name of its program, which is no difference. */
typedef struct ChangeText {
    const char *name, *text;
    bool code; /* a C file, of which comments and blank lines, and what --help says, do not count */
} ChangeText;

/* Appends the fewest lines that, removed and added, make `after` of `before`, in order, removed
 * before added ones, with up to `around` lines that are the same on both sides; gaps are marked
 * unless that is 0. `changed` is how many were removed and added. False, with a message: a file of
 * too many lines. */
bool changes_between(Changes *changes, ChangeText before, ChangeText after, int around,
                     int *changed, Message *message);

void changes_add(Changes *changes, ChangeKind kind, const char *text, int length);

/* Appends all lines of a text, as the same. */
void changes_add_text(Changes *changes, const char *text);

void changes_close(Changes *changes);

#endif
