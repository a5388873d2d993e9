/*
 * compile_advice: what a compiler's message usually means, in a sentence.
 */
#ifndef COMPILE_ADVICE_H
#define COMPILE_ADVICE_H

/* For a message of a GLSL compiler or linker; NULL where nothing is known of it. */
const char *compile_advice(const char *message);

#endif
