/*
 * examples: the programs with a scene, by descriptor and as a list. For tests that link them.
 */
#ifndef EXAMPLES_H
#define EXAMPLES_H

#include "core/example.h"

#define X(NAME) extern const Example NAME;
LIGHTING_EXAMPLES
#undef X

#define X(NAME) &NAME,
static const Example *const EXAMPLES[] = {LIGHTING_EXAMPLES};
#undef X

enum { EXAMPLE_COUNT = sizeof EXAMPLES / sizeof EXAMPLES[0] };

#endif
