/*
 * shader_advice: what the driver's errors usually mean.
 */
#ifndef SHADER_ADVICE_H
#define SHADER_ADVICE_H

#include "base/message.h"

#include <stddef.h>

/* What an unknown name was probably meant to be, of those in the source, and a sentence on what the
 * driver's error usually means; false: neither is known. */
bool shader_advice(const char *source, const char *message, char *advice, size_t size);

/* Adds that as a line, "  hint: ...", after the first error and its source line. */
void shader_advise(const char *source, Message *message);

#endif
