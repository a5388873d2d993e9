/*
 * shader: compiles and links shader files.
 */
#ifndef SHADER_H
#define SHADER_H

#include "core/gl.h"
#include "core/matrix.h"
#include "core/shader_source.h"

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
