/*
 * wrong_program: one program whose uniforms select a lab's right picture, any mistake of the
 * catalogue, or two at once: compiled once for all mistakes.
 */
#ifndef WRONG_PROGRAM_H
#define WRONG_PROGRAM_H

#include "labs/diagnosis/catalogue.h"
#include "labs/submission/submission.h"

enum { WRONG_PROGRAM_UNIFORMS = 57 };

typedef struct WrongProgram {
    Shader shader;
    GLint position, normal;
    GLint locations[WRONG_PROGRAM_UNIFORMS];
} WrongProgram;

/* Loads shaders/labs/catalogue, with or without shadows. */
bool wrong_program_open(WrongProgram *program, const Lab *lab, Message *message);
void wrong_program_close(WrongProgram *program);

/* Draws a scene with these choices into the canvas's current view, which is cleared. False: the
 * camera is degenerate. */
bool wrong_program_draw(const WrongProgram *program, const Lab *lab, const LabScene *lab_scene,
                        const LabSceneBuffers *buffers, const Choices *choices);

#endif
