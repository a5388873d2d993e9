/*
 * submission: a student's shaders: read, compiled, drawn.
 *
 * Untrusted: only regular files of the folder itself are read, of at most SHADER_FILE_MAX bytes,
 * and `#include` finds only those.
 */
#ifndef SUBMISSION_H
#define SUBMISSION_H

#include "base/message.h"
#include "core/canvas.h"
#include "core/shader.h"
#include "labs/program/binding.h"
#include "labs/program/lab_scene.h"

#include <stdbool.h>

/* Files of a folder, in memory. Zeroed: none. */
enum { SUBMISSION_MAX_FILES = 64 };
typedef struct SubmissionFiles {
    ShaderText texts[SUBMISSION_MAX_FILES + 1]; /* ended by a NULL name */
    int count;
} SubmissionFiles;

/* Reads a lab's files, and *.glsl, *.vert, *.frag that they may include, from a folder. False, with
 * a message that begins with the file's name, if a required file is missing, too large, not text,
 * or not a regular file of this folder. */
bool submission_files_open(SubmissionFiles *files, const Lab *lab, const char *folder,
                           Message *message);

/* Adds a copy of a file. False, with a message: it is too large, not a text, or one too many. */
bool submission_files_add(SubmissionFiles *files, const char *name, const void *bytes, size_t size,
                          Message *message);

/* Whether a file's name is one that a shader may include. */
bool submission_may_include(const char *name);

/* What is said of a required file. */
#define SUBMISSION_MISSING "is missing from the folder"

const char *submission_file(const SubmissionFiles *files, const char *name); /* its text, or NULL */
void submission_files_close(SubmissionFiles *files);

/* Compiles LAB.vert and LAB.frag. `precision` is ShaderLoader's. Messages begin "file:line:" if the
 * driver names a line. */
bool submission_compile(Shader *shader, const Lab *lab, const SubmissionFiles *files,
                        const char *precision, Message *message);

/* Replaces a scene's own geometry. Zeroed: nothing. */
typedef struct SubmissionGeometry {
    const Mat4 *world_from_object, *normal_matrix; /* lab 3; NULL: the scene's */
    const Mesh *mesh;                              /* lab 10; NULL: the scene's */
    bool cull;
} SubmissionGeometry;

/* The meshes and the shadow map of a scene, uploaded once for many draw calls. */
typedef struct LabSceneBuffers {
    MeshBuffer buffers[LAB_SCENE_MAX_OBJECTS];
    bool cull; /* back faces */
    LabShadowMap map;
} LabSceneBuffers;
bool lab_scene_buffers_open(LabSceneBuffers *buffers, const LabScene *lab_scene,
                            const SubmissionGeometry *geometry, Message *message);
void lab_scene_buffers_close(LabSceneBuffers *buffers);

/* Draws with a submission's program. */
typedef struct Painter {
    const Lab *lab;
    GLuint program;
} Painter;

/* Resizes a canvas to a scene's size, draws the scene and reads it back into an image of bytes of
 * that size. False, with a message: the driver failed. */
bool painter_draw(const Painter *painter, const LabScene *lab_scene,
                  const SubmissionGeometry *geometry, Canvas *canvas, Image *image,
                  Message *message);

/* The same into a rectangle of a larger canvas. */
typedef struct PainterView {
    Canvas *canvas;
    int left, top; /* of its upper left pixel */
} PainterView;
bool painter_draw_at(const Painter *painter, const LabScene *lab_scene,
                     const SubmissionGeometry *geometry, PainterView view, Image *image,
                     Message *message);

/* The lab's own solutions, ready to draw. To be closed whatever opening returns; false, with a
 * message: one does not compile, which is the lab's fault. */
typedef struct LabSolutions {
    Shader shaders[LAB_MAX_SOLUTIONS];
    Painter painters[LAB_MAX_SOLUTIONS];
} LabSolutions;
bool lab_solutions_open(LabSolutions *solutions, const Lab *lab, Message *message);
void lab_solutions_close(LabSolutions *solutions); /* a zeroed one is fine */

/* What a driver draws must be what others read and count. So a text may not use the version, the
 * macros of extensions or the limits of an implementation, and where it depends on GL_ES or
 * GL_FRAGMENT_PRECISION_HIGH, its branches may differ in precision only. Nor may it read
 * gl_PointCoord, which is undefined in triangles. */

/* False, with a message that says what to remove (without the file's name): it depends on it. */
bool compiler_dependence_check(const char *text, Message *message);

#endif
