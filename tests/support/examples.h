/*
 * examples: the programs with a scene, and the lecture's, by descriptor and as lists. For tests
 * that link them.
 */
#ifndef EXAMPLES_H
#define EXAMPLES_H

#include "core/example.h"

#define X(NAME) extern const Example NAME;
LIGHTING_EXAMPLES
LECTURE_EXAMPLES
#undef X

#define X(NAME) &NAME,
static const Example *const EXAMPLES[] __attribute__((unused)) = {LIGHTING_EXAMPLES};
static const Example *const LECTURES[] __attribute__((unused)) = {LECTURE_EXAMPLES};
#undef X

enum {
    EXAMPLE_COUNT = sizeof EXAMPLES / sizeof EXAMPLES[0],
    LECTURE_COUNT = sizeof LECTURES / sizeof LECTURES[0]
};

#endif
