/*
 * json: JSON strings (RFC 8259).
 */
#ifndef JSON_H
#define JSON_H

#include <stdio.h>

/* Writes a quoted string. Bytes that are not UTF-8 become U+FFFD. */
void json_put_string(FILE *file, const char *text);

#endif
