/*
 * compile_advice: one sentence on what a compiler's message usually means.
 */
#ifndef COMPILE_ADVICE_H
#define COMPILE_ADVICE_H

/* For a message of a GLSL compiler or linker; NULL: unknown. */
const char *compile_advice(const char *message);

#endif
