/*
 * wrong_program: one program that draws a lab's right picture or, by its uniforms, any mistake of
 * the catalogue or two at once: nothing is compiled for a mistake.
 */
#ifndef WRONG_PROGRAM_H
#define WRONG_PROGRAM_H

#include "catalogue.h"
#include "submission.h"

enum { WRONG_PROGRAM_UNIFORMS = 35 };

typedef struct WrongProgram {
    Shader shader;
    GLint position, normal;
    GLint locations[WRONG_PROGRAM_UNIFORMS];
} WrongProgram;

/* Loads shaders/labs/catalogue. */
bool wrong_program_open(WrongProgram *program, Message *message);
void wrong_program_close(WrongProgram *program);

/* A probe's meshes, uploaded once for many drawings. */
typedef struct ProbeBuffers {
    MeshBuffer buffers[PROBE_MOST_OBJECTS];
    bool cull; /* leave out triangles seen from behind */
} ProbeBuffers;
bool probe_buffers_open(ProbeBuffers *buffers, const Probe *probe,
                        const SubmissionGeometry *geometry, Message *message);
void probe_buffers_close(ProbeBuffers *buffers);

/* Draws a probe as a program with these choices would, into the part of the canvas that is the
 * current view, which is cleared. False where a matrix cannot be made. */
bool wrong_program_draw(const WrongProgram *program, const Lab *lab, const Probe *probe,
                        const ProbeBuffers *buffers, const Choices *choices);

#endif
