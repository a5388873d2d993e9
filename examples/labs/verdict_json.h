/*
 * verdict_json: a verdict as JSON, and back to data, though the process that wrote it is not to be
 * trusted.
 */
#ifndef VERDICT_JSON_H
#define VERDICT_JSON_H

#include "verdict.h"

#include <jansson.h>

enum { VERDICT_JSON_MOST = 256 << 10 }; /* bytes */

/* Reads what verdict_write wrote. Refused, with a message that names what is at fault: more than
 * VERDICT_JSON_MOST bytes, anything that is not JSON in UTF-8, a name twice, a value that is
 * missing, of another type or out of range, lists longer than Verdict holds. Unknown names are
 * passed over. Of texts, control characters become spaces (line breaks stay in `details`),
 * characters that turn the direction of writing are left out, and what is too long is cut. */
bool verdict_read(const void *bytes, size_t size, char lab[64], Verdict *verdict, Message *message);

/* The same from an object; and an object from a verdict, under the same names. NULL: no memory. Of
 * its texts, bytes that are not UTF-8 become the replacement character; numbers that are not finite
 * become null. */
bool verdict_from_json(const json_t *object, char lab[64], Verdict *verdict, Message *message);
json_t *verdict_to_json(const Verdict *verdict, const char *lab);

/* Writes a verdict on the submission in the folder `submission`, to a file or "-"; whole or not at
 * all. */
bool verdict_write(const Verdict *verdict, const Lab *lab, const char *submission, const char *path,
                   Message *message);

/* A text of an object into `text`, cleaned and cut as above; false where there is none. */
bool verdict_text(const json_t *object, const char *name, char *text, size_t size,
                  Message *message);
void verdict_clean(char *text, size_t size, const char *from, bool lines);

/* A number of an object within least..most; false where there is none. */
bool verdict_number(const json_t *object, const char *name, double least, double most,
                    double *number, Message *message);

#endif
