/*
 * json: text as JSON has it (RFC 8259).
 */
#ifndef JSON_H
#define JSON_H

#include <stdio.h>

/* Writes a string in its quotes. Bytes that are not UTF-8 become the replacement character. */
void json_put_string(FILE *file, const char *text);

#endif
