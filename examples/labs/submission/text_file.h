/*
 * text_file: a text that is written piece by piece, and becomes a file whole or not at all.
 */
#ifndef TEXT_FILE_H
#define TEXT_FILE_H

#include "base/message.h"

#include <limits.h>
#include <stdio.h>

typedef struct TextFile {
    FILE *file; /* in memory */
    char *text;
    size_t size;
    char path[PATH_MAX];
} TextFile;

/* Begins FOLDER/NAME, or NAME if `folder` is NULL ("-": standard output). */
bool text_file_open(TextFile *file, const char *folder, const char *name, Message *message);

/* Writes it. */
bool text_file_close(TextFile *file, Message *message);

#endif
