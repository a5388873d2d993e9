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

/* False, with a message, for a text that no driver gets: its macros grow, or functions that call
 * each other, beyond what compilers end with; in a page, loops that would hang it. With `turns_max`
 * above 0 loops have to be as appendix A wants them, and to turn no more often for one vertex or
 * pixel. What does not parse is left to the driver. */
bool shader_bounded(const ShaderSource *source, ShaderStage stage, double turns_max,
                    Message *message);

#endif
