/*
 * wrong_program: one program whose uniforms select a lab's right picture, any mistake of the
 * catalogue, or two at once: compiled once for all mistakes.
 */
#ifndef WRONG_PROGRAM_H
#define WRONG_PROGRAM_H

#include "labs/diagnosis/catalogue.h"
#include "labs/program/lab_scene.h"
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

/* What the choices of a wrong program make of one object: its matrices and lights. No GL. */

/* One object, with the matrices and colours that the choices give it. */
typedef struct Made {
    const Lab *lab;
    const LabScene *lab_scene;
    const Object *object;
    const Choices *choices;
    const int *of;
    Mat4 world, eye_from_world, clip_from_eye;
    Vec3 light[LAB_MAX_LIGHTS], light_color[LAB_MAX_LIGHTS];
} Made;

int made_choice(const Made *made, Slot slot);

/* 1 if the factor is another. */
double made_factor(const Made *made, Factor which);

/* The value if that is the factor. */
double made_value(const Made *made, Factor which, double otherwise);

/* The matrix, its inverse or none, by a choice of PART_. */
Mat4 made_part(Mat4 right, int choice);

/* The object's, except in lab 3, whose C makes it. The others follow from it: made->world. */
Mat4 made_model_matrix(const Made *made);
Mat4 made_clip_matrix(const Made *made);
Mat4 made_place_matrix(const Made *made);

/* The shader adds its last column to the normal. */
Mat4 made_normal_matrix(const Made *made);

void made_choose_light_colors(Made *made);
void made_choose_light_places(Made *made);

/* The colours of its terms: front and back, or each light; of `diffuse` the front comes first. */
typedef struct MadeColors {
    Vec3 base[2], limit[2], diffuse[4], specular[LAB_MAX_LIGHTS], plus;
} MadeColors;
MadeColors made_colors(const Made *made);

/* Of the highlight. */
double made_exponent(const Made *made, bool blinn_phong);

/* Of each component. */
Vec3 made_product(Vec3 a, Vec3 b);

#endif
