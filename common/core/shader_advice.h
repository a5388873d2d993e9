/*
 * shader_advice: what the front end of the shaders' language says of what a driver refuses.
 */
#ifndef SHADER_ADVICE_H
#define SHADER_ADVICE_H

#include "core/shader_source.h"

enum { SHADER_LINKING = 2 };

/* Adds a line, "  hint: ...", after the first line of the driver's message and the source quoted
 * there; with its place, unless the message begins with the same. `refused` is a stage, or
 * SHADER_LINKING. Adds nothing if the front end finds nothing wrong. */
void shader_advise(const ShaderSource sources[2], int refused, Message *message);

/* False for a text with macros that grow beyond what drivers end with, which no driver gets. */
bool shader_bounded(const ShaderSource *source, ShaderStage stage, Message *message);

#endif
