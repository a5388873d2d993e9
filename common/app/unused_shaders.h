/*
 * unused_shaders: what --shaders was of no use for.
 */
#ifndef UNUSED_SHADERS_H
#define UNUSED_SHADERS_H

#include "core/shader_files.h"

/* Says on standard error that no file of the folder was read, and which of its files are named
 * almost as one that was looked for: LightedCube.FRAG, lightedcube.frag. */
void unused_shaders_tell(const char *program, const char *folder, const ShaderFiles *files);

#endif
