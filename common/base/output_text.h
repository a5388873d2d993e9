/*
 * output_text: a text that is written in memory and becomes a file. There is always memory for it,
 * see memory.h.
 */
#ifndef OUTPUT_TEXT_H
#define OUTPUT_TEXT_H

#include "base/message.h"

#include <stdio.h>

typedef struct OutputText {
    FILE *file; /* writes to it */
    char *text; /* after a flush or output_text_close */
    size_t size;
} OutputText;

void output_text_open(OutputText *text);

/* The text, which the caller frees. */
char *output_text_close(OutputText *text);

/* Closes it and writes it with output_write. */
bool output_text_write(OutputText *text, const char *path, Message *message);
bool output_text_put(OutputText *text, const char *folder, const char *name, Message *message);

/* Closes it and writes it as text_wrap does, from the first column on. */
void output_text_wrap(OutputText *text, FILE *file, int indent, int width);

#endif
