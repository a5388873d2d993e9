/*
 * json_writer: JSON (RFC 8259), written member by member. It is read with jansson, which pages have
 * no room for.
 */
#ifndef JSON_WRITER_H
#define JSON_WRITER_H

#include <stdbool.h>
#include <stdio.h>

enum { JSON_WRITER_DEPTH = 16 };

/* {file}, or {file, lines}: of so many levels each item has a line of its own. */
typedef struct JsonWriter {
    FILE *file;
    int lines;
    int depth;
    bool filled; /* what is open has an item */
    char ends[JSON_WRITER_DEPTH];
} JsonWriter;

/* `name`: of a member; NULL in a list, and for the whole. What is opened is ended in turn. */
void json_write_object(JsonWriter *json, const char *name);
void json_write_list(JsonWriter *json, const char *name);
void json_write_end(JsonWriter *json);

/* Bytes that are not UTF-8 become U+FFFD; NULL becomes null. */
void json_write_text(JsonWriter *json, const char *name, const char *text);

/* 9 digits; null if it is not finite. */
void json_write_number(JsonWriter *json, const char *name, double value);
void json_write_whole(JsonWriter *json, const char *name, long long value);
void json_write_flag(JsonWriter *json, const char *name, bool value);

/* A value that is JSON already; "": null. */
void json_write_value(JsonWriter *json, const char *name, const char *value);

#endif
