/*
 * shader_source: shaders assembled from text, and the way back from the driver's log to files.
 */
#ifndef SHADER_SOURCE_H
#define SHADER_SOURCE_H

#include "core/shader.h"

/* As shader_source_open, for text in memory, as if it were a file at `path`. */
bool shader_source_parse(ShaderSource *source, const ShaderLoader *loader, const char *path,
                         const char *text, size_t size, ShaderStage stage, Message *message);

/* Maps the driver's log to files: a line that begins with a source string and line number becomes
 * "file:line: rest"; the first is followed by that line of source. Always returns false. */
bool shader_explain_log(const ShaderSource *source, const char *log, Message *message);

/* Whether a line of a source is a #line directive, and the file and line it gives the next. */
bool shader_line_directive(const char *text, int *file, int *line);

#endif
