/*
 * jansson: what lab_json.c calls of this library, by the browser's own JSON (json.js). A value is
 * its number in a list that is never emptied: a page has one lab.
 */
#ifndef JANSSON_H
#define JANSSON_H

#include <stdbool.h>
#include <stddef.h>

typedef struct json_t json_t;
typedef struct json_error_t {
    int line;
    const char *text;
} json_error_t;
#define JSON_REJECT_DUPLICATES 1

json_t *json_loadb(const char *text, size_t size, size_t flags, json_error_t *error);
json_t *json_pack(const char *format, const char *text); /* "[s]" */
void json_decref(json_t *value);

/* None of these minds NULL. */
bool json_is_object(const json_t *value);
bool json_is_array(const json_t *value);
bool json_is_string(const json_t *value);
bool json_is_number(const json_t *value);
bool json_is_integer(const json_t *value);
bool json_is_boolean(const json_t *value);
bool json_is_true(const json_t *value);
size_t json_array_size(const json_t *array); /* members, or letters */
#define json_object_size json_array_size
#define json_string_length json_array_size
json_t *json_object_get(const json_t *object, const char *key);
json_t *json_array_get(const json_t *array, size_t i);
double json_number_value(const json_t *value);
#define json_integer_value json_number_value
const char *json_string_value(const json_t *value); /* NULL: it is none */

const char *json_object_key(const json_t *object, const char *before); /* NULL: the first; none */
#define json_object_foreach(object, key, value)                                                    \
    for (key = json_object_key(object, NULL); key && (value = json_object_get(object, key));       \
         key = json_object_key(object, key))

#endif
