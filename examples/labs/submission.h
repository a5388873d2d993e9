/*
 * submission: the shaders that somebody handed in: read, compiled, drawn.
 *
 * Nothing of it is trusted. Only regular files that lie in the folder itself are read, of at most
 * SHADER_FILE_MOST bytes, and an `#include` finds those alone.
 */
#ifndef SUBMISSION_H
#define SUBMISSION_H

#include "binding.h"
#include "canvas.h"
#include "probe.h"
#include "shader.h"

/* Files of a folder, in memory. Zeroed: none. */
enum { SUBMISSION_MOST_FILES = 64 };
typedef struct SubmissionFiles {
    ShaderText texts[SUBMISSION_MOST_FILES + 1]; /* ended by a NULL name */
    int count;
} SubmissionFiles;

/* Reads a lab's files, and those that they may include (*.glsl, *.vert, *.frag), from a folder.
 * False, with a message that begins with the file's name, where one that the lab wants is missing,
 * is too large, no text, or is not a regular file of this folder. */
bool submission_files_open(SubmissionFiles *files, const Lab *lab, const char *folder,
                           Message *message);
const char *submission_file(const SubmissionFiles *files, const char *name); /* its text, or NULL */
void submission_files_close(SubmissionFiles *files);

/* Compiles LAB.vert and LAB.frag of these files. `precision` is ShaderLoader's. Messages begin
 * "file:line:" where the driver names a line. */
bool submission_compile(Shader *shader, const Lab *lab, const SubmissionFiles *files,
                        const char *precision, Message *message);

/* What stands in the place of what a probe has. Zeroed: nothing. */
typedef struct SubmissionGeometry {
    const Mat4 *world_from_object, *normal_matrix; /* lab 3; NULL: the probe's */
    const Mesh *mesh;                              /* lab 10; NULL: the probe's */
    bool cull;
} SubmissionGeometry;

/* What draws: a submission's program, or in a test a known mistake. */
typedef struct Painter {
    const Lab *lab;
    GLuint program;
    /* Draws a scene's objects into the canvas, which is cleared; NULL: with the program. */
    bool (*paint)(const struct Painter *painter, const Probe *probe,
                  const SubmissionGeometry *geometry, Message *message);
    const void *what; /* for `paint` */
} Painter;

/* Draws a probe into a canvas, which gets its size, and reads it back into an image of bytes of
 * that size. The background is the scene's. False, with a message, where the driver fails. */
bool painter_draw(const Painter *painter, const Probe *probe, const SubmissionGeometry *geometry,
                  Canvas *canvas, Image *image, Message *message);

#endif
