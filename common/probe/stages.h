/*
 * stages: both shaders of a captured draw, ready to run, and the varyings that link them.
 */
#ifndef STAGES_H
#define STAGES_H

#include "glsl/glsl_run.h"
#include "probe/capture.h"

/* A varying's registers in the fragment's run and in the vertex's, and its place among the numbers
 * that a vertex hands over. */
typedef struct StageLink {
    int fragment, vertex, count, at;
    const char *name;
} StageLink;

typedef struct Stages {
    const char *sources[2]; /* by ShaderStage */
    GlslTree *trees[2];
    GlslCode *codes[2];
    StageLink *links;
    int link_count, handed; /* handed: the numbers of all links */
} Stages;

/* To be closed whatever it returns. False: a shader cannot be run, and why. */
bool stages_open(Stages *stages, const CaptureDraw *draw, Message *message);
void stages_close(Stages *stages);

/* Where an element of a uniform is; false: the code has none. */
bool stages_uniform(const GlslCode *code, const CaptureUniform *uniform, int element,
                    GlslVariable *found);

#endif
