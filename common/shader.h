/*
 * shader: shader files to a program of the driver.
 *
 * A file is GLSL ES 1.00, with three things added before the driver sees it:
 *   - `#include "file"` on a line of its own: looked for beside the including file, then where
 * every shader is looked for; a file that includes itself, however indirectly, is refused. Includes
 *     are taken in whatever #if they stand;
 *   - `#version 100` becomes the first line, and defines follow it;
 *   - `#line` after all of these, so that the driver's messages can be told in terms of real files.
 */
#ifndef SHADER_H
#define SHADER_H

#include "gl.h"
#include "matrix.h"
#include "shader_files.h"

#include <limits.h>
#include <stddef.h>

/* A file that is made, not found: its name in #include, and its text. */
typedef struct ShaderText {
    const char *name, *text;
} ShaderText;

/* A file that stands in for another wherever that is included. */
typedef struct ShaderReplacement {
    const char *name, *by;
} ShaderReplacement;

/* Where and how shaders are loaded: the same for every shader of a program. Zero means default. */
typedef struct ShaderLoader {
    const char *folder;         /* --shaders: looked in first; NULL for none */
    const char *precision;      /* "highp" or "mediump" for every fragment shader's mediump or
                                   highp; NULL: as the file says */
    const char *const *defines; /* "NAME" or "NAME value", ended by NULL; may be NULL */
    const ShaderText *texts;    /* looked in before any folder; ended by a NULL name; may be NULL */
    bool only_texts;            /* there is nothing else: no file is read */
    const ShaderReplacement *replacements; /* ended by a NULL name; may be NULL */
    ShaderFiles *files; /* where files are read, once, and kept; NULL: each time from disk */
    int print;          /* what to print on standard output, as below */
    bool verbose;       /* report compile times on standard error */
} ShaderLoader;

enum { SHADER_PRINT_VERTEX = 1, SHADER_PRINT_FRAGMENT = 2 };

/* The text of one shader, as the driver is given it, and where its lines come from. */
typedef struct ShaderSource {
    char *text;
    size_t size;  /* without the terminating zero */
    char **files; /* the path of source string number i, as #line numbers them */
    int file_count;
} ShaderSource;

typedef enum ShaderStage { SHADER_VERTEX, SHADER_FRAGMENT } ShaderStage;

/* Whether the loader's folders are usable: --shaders and the environment's LIGHTING_SHADERS, where
 * set, must name folders that exist. */
bool shader_loader_check(const ShaderLoader *loader, Message *message);

/* Reads `name` ("lecture/LightedCube.vert") and what it includes. Looked for, in this order, in
 * the loader's folder and the environment's LIGHTING_SHADERS (by path below the folder, then by
 * file name alone), the source tree, and the installation; the message lists every path tried. No
 * GL. `source` is zeroed on failure. */
bool shader_source_open(ShaderSource *source, const ShaderLoader *loader, const char *name,
                        ShaderStage stage, Message *message);

/* The same from text in memory, as if it were a file at `path`. */
bool shader_source_parse(ShaderSource *source, const ShaderLoader *loader, const char *path,
                         const char *text, size_t size, ShaderStage stage, Message *message);
void shader_source_close(ShaderSource *source);

/* The driver's log in terms of files: each line that begins with a source string and line number
 * becomes "file:line: rest", and the first such line is followed by that line of source. */
bool shader_explain_log(const ShaderSource *source, const char *log, Message *message);

/* Whether a line of a source's text is one of its #line directives, and what it says of the next.
 */
bool shader_line_directive(const char *text, int *file, int *line);

/* A linked program. */
typedef struct Shader {
    GLuint program;
    char name[128];
} Shader;

/* Loads, compiles and links NAME.vert and NAME.frag. Attribute a_Position has location 0 where
 * there is one. Messages begin "file:line:" where the driver names a line. */
bool shader_open(Shader *shader, const ShaderLoader *loader, const char *name, Message *message);

/* The location of a uniform or attribute, in *location; false, naming program and variable, where
 * the linked program has none of that name (not declared, or nothing depends on it). */
bool shader_uniform(const Shader *shader, const char *name, GLint *location, Message *message);
bool shader_attribute(const Shader *shader, const char *name, GLint *location, Message *message);

/* Sets a uniform of the program in use, rounded to float. */
void shader_set_vec3(GLint location, Vec3 value);
void shader_set_mat4(GLint location, Mat4 value);

/* NULL or a zeroed shader is fine. */
void shader_close(Shader *shader);

#endif
