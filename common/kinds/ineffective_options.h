/*
 * ineffective_options: a program's own options that were given and change nothing.
 */
#ifndef INEFFECTIVE_OPTIONS_H
#define INEFFECTIVE_OPTIONS_H

#include "app/options.h"
#include "base/cache.h"

/* The times, after the first, at which options are tried. */
enum { INEFFECTIVE_MOMENTS = 3 };
extern const double INEFFECTIVE_LATER[INEFFECTIVE_MOMENTS];

/* Adds all that the example hands over, with its parameters as they are now. */
typedef bool IneffectiveKey(const Example *example, const Options *options, CacheKey *key);

/* Appends the names of the options without any one of which the key, and the picture's size, are
 * the same: "--shininess, --opacity". `defaults` as for command_write. */
void ineffective_options(const Example *example, const Options *options,
                         const ParameterValue *defaults, IneffectiveKey *add_all, char *text,
                         size_t size);

/* Whether they are not looked for: one of those that were given names a file, which might take long
 * to read. */
bool ineffective_unknown(const Example *example, const Options *options);

#endif
