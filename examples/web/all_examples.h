/*
 * all_examples: the programs that the build names, X(LightedCube) X(LightedCube_animation)..., by
 * descriptor and as a list.
 */
#ifndef ALL_EXAMPLES_H
#define ALL_EXAMPLES_H

#include "core/example.h"

#define X(name) extern const Example name;
EXAMPLES
#undef X

#define X(name) &name,
static const Example *const ALL[] = {EXAMPLES};
#undef X

enum { COUNT = sizeof ALL / sizeof ALL[0] };

#endif
