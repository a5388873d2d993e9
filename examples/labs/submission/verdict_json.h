/*
 * verdict_json: a verdict as JSON, and back. The reader does not trust the process that wrote it.
 */
#ifndef VERDICT_JSON_H
#define VERDICT_JSON_H

#include "labs/submission/verdict.h"

#include <jansson.h>

enum { VERDICT_JSON_MAX = 256 << 10 }; /* bytes */

/* Reads what verdict_write wrote. Refused, with a message that names the fault: more than
 * VERDICT_JSON_MAX bytes, anything but JSON in UTF-8, a name twice, a value that is missing, of
 * another type or out of range, lists longer than Verdict holds. Unknown names are ignored. In
 * texts control characters become spaces (`details` keeps line breaks), characters that change the
 * writing direction are removed, and long texts are cut. */
bool verdict_read(const void *bytes, size_t size, char lab[64], Verdict *verdict, Message *message);

/* The same from an object. */
bool verdict_from_json(const json_t *object, char lab[64], Verdict *verdict, Message *message);

/* Writes a verdict on the folder `submission` to a file or "-", whole or not at all. */
bool verdict_write(const Verdict *verdict, const Lab *lab, const char *submission, const char *path,
                   Message *message);

/* Reads a text, cleaned and cut as above; false, with a message, if it is missing. */
bool verdict_text(const json_t *object, const char *name, char *text, size_t size,
                  Message *message);
void verdict_clean(char *text, size_t size, const char *from, bool lines);

/* Reads a number within min..max. */
bool verdict_number(const json_t *object, const char *name, double min, double max, double *number,
                    Message *message);

#endif
