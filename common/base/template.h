/*
 * template: fills a text file's placeholders, so that a page is written as a page, not as C.
 *
 *   {{name}}                  a value, escaped for HTML and XML
 *   {{&name}}                 the same as it is
 *   {{#name}} ... {{/name}}   once for each section of this name; once, too, for a value that is
 *                             not empty
 *   {{^name}} ... {{/name}}   if there is neither
 *   {{!...}}                  a remark
 *
 * The last three leave no line if they are alone on one. A value is looked for in its section, then
 * in those around it; what follows # or ^ in its own section alone.
 */
#ifndef TEMPLATE_H
#define TEMPLATE_H

#include "base/message.h"

#include <stdio.h>

/* The values of a page or of one repetition of a section. Names are literals: not copied. */
typedef struct TemplateValues TemplateValues;

TemplateValues *template_values(void);
void template_set(TemplateValues *values, const char *name, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* One more repetition of a section, which belongs to `values`. */
TemplateValues *template_add(TemplateValues *values, const char *section);

/* With all sections; NULL is fine. */
void template_close(TemplateValues *values);

/* Fills the template in a file, FOLDER/NAME in the source tree and templates/NAME in an
 * installation. Messages about a template begin with "file:line:". */
bool template_print(const char *source, const TemplateValues *values, FILE *out, Message *message);

/* The same into the file `path`, whole or not at all. */
bool template_write(const char *source, const TemplateValues *values, const char *path,
                    Message *message);

/* With the template's text in memory; `file` is its name in messages. */
bool template_fill(const char *file, const char *text, const TemplateValues *values, FILE *out,
                   Message *message);

#endif
