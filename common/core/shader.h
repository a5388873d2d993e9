/*
 * shader: compiles and links shader files.
 *
 * A file is GLSL ES 1.00. Before the driver gets it,
 *   - `#include "file"` on a line of its own is replaced by that file, searched beside the file
 * that includes it, then where all shaders are searched. A file must not include itself, also
 *     indirectly. Includes are resolved before #if is;
 *   - `#version 100` becomes the first line, and defines follow it;
 *   - `#line` is added after these, so that the driver's messages can be mapped to files.
 */
#ifndef SHADER_H
#define SHADER_H

#include "core/gl.h"
#include "core/matrix.h"
#include "core/shader_files.h"

#include <limits.h>
#include <stdio.h>

/* A file in memory: its name in #include, and its text. */
typedef struct ShaderText {
    const char *name, *text;
} ShaderText;

/* A file that replaces another in #include. */
typedef struct ShaderReplacement {
    const char *name, *by;
} ShaderReplacement;

/* Where and how shaders are loaded. Zero means default. */
typedef struct ShaderLoader {
    const char *folder;         /* searched first; NULL: none */
    const char *precision;      /* "highp" or "mediump" replaces the other in fragment shaders;
                                   NULL: as the file says */
    const char *const *defines; /* "NAME" or "NAME value", ended by NULL; may be NULL */
    const ShaderText *texts;    /* searched before any folder; ended by a NULL name; may be NULL */
    bool only_texts;            /* no file is read */
    const ShaderReplacement *replacements; /* ended by a NULL name; may be NULL */
    ShaderFiles *files;                    /* caches files; NULL: read from disk each time */
    int print;                             /* which shaders to write to `printed`, as below */
    FILE *printed, *log;                   /* the latter for compile times; NULL: not written */
    bool advise;                           /* errors of the driver end with a hint */
    bool keeps;                            /* linked programs are kept, in the cache */
    Message *warning; /* where shader_locations names what a program lacks; NULL: an error */
} ShaderLoader;

enum { SHADER_PRINT_VERTEX = 1, SHADER_PRINT_FRAGMENT = 2 };

/* The text of one shader as the driver gets it, and the files of its lines. */
typedef struct ShaderSource {
    char *text;
    size_t size;  /* without the terminating zero */
    char **files; /* the path of source string number i, as #line numbers them */
    int file_count;
} ShaderSource;

typedef enum ShaderStage { SHADER_VERTEX, SHADER_FRAGMENT } ShaderStage;

/* Whether the loader's folder and that of LIGHTING_SHADERS in the environment, if set, exist. */
bool shader_loader_check(const ShaderLoader *loader, Message *message);

/* Reads `name` ("lecture/LightedCube.vert") and its includes. Searches, in this order, the loader's
 * folder and LIGHTING_SHADERS (each by path, then by file name alone), the source tree, and the
 * installation; the message lists all paths tried. No GL. `source` is zeroed on failure. */
bool shader_source_open(ShaderSource *source, const ShaderLoader *loader, const char *name,
                        ShaderStage stage, Message *message);

void shader_source_close(ShaderSource *source);

/* A linked program. */
typedef struct Shader {
    GLuint program;
    char name[128];
    Message *warning; /* the loader's; with it the sources, by ShaderStage, are kept */
    ShaderSource sources[2];
} Shader;

/* Loads, compiles and links NAME.vert and NAME.frag. Attribute a_Position gets location 0. Messages
 * begin with "file:line:" if the driver names a line. */
bool shader_open(Shader *shader, const ShaderLoader *loader, const char *name, Message *message);

/* The location of a uniform or attribute; false, naming program and variable, if the linked program
 * has none of that name (not declared, or no output depends on it). */
bool shader_uniform(const Shader *shader, const char *name, GLint *location, Message *message);
bool shader_attribute(const Shader *shader, const char *name, GLint *location, Message *message);

/* The locations of several at once, ended by a NULL name; "a_..." is an attribute, any other name a
 * uniform. If the loader has a `warning`, a variable that the linked program lacks is no error: its
 * location is -1, and the warning one line: "file:line: warning: u_LightColor is not used". */
typedef struct ShaderLocation {
    const char *name;
    GLint *location;
} ShaderLocation;
bool shader_locations(const Shader *shader, const ShaderLocation *locations, Message *message);

/* Sets an error about a variable, at its declaration if the sources are kept: "file:line: error:
 * u_Light: ...". Always returns false. */
bool shader_complain(const Shader *shader, const char *variable, const char *text,
                     Message *message);

/* Sets an attribute for all vertices, or a uniform of the current program; -1 is ignored. */
void shader_set_attribute(GLint location, Vec3 value);
void shader_set_vec3(GLint location, Vec3 value);
void shader_set_mat4(GLint location, Mat4 value);

/* NULL or zeroed is fine. */
void shader_close(Shader *shader);

#endif
