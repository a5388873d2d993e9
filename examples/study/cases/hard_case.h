/*
 * hard_case: scenes on which a plain formula fails.
 */
#ifndef HARD_CASE_H
#define HARD_CASE_H

#include "lighting/lighting.h"

/* A scene for the stable form and one for the plain formula. Not to be copied: points into itself.
 */
typedef struct HardScene {
    Scene scene, naive;
    Light lights[2];
    Object objects[3], naive_objects[3]; /* copies, changed by `spoil` */
    Mesh mesh, naive_mesh;               /* naive_mesh may be empty: then `mesh` */
    Mesh floor;                          /* may be empty */
} HardScene;

typedef enum HardShape { HARD_SPHERE, HARD_TEAPOT, HARD_QUAD, HARD_CUBE, HARD_RING } HardShape;

typedef struct HardBox {
    Vec3 at, size;
} HardBox;

typedef struct HardCase {
    const char *name;           /* "mirror" */
    const char *what;           /* at most 62 characters */
    const char *naive, *stable; /* the two forms, at most 24 characters */
    /* One object at the origin, scaled, in a point light; what is zero is as usual, or not there.
     */
    HardShape shape; /* zeroed: a sphere */
    double size;
    int slices, stacks; /* of the sphere */
    Vec3 scale, light;
    double fovy, floor;            /* the height of a floor that has shadows */
    HardBox boxes[2];              /* the object's place and size, and another's */
    void (*make)(HardScene *made); /* what else there is; may be NULL */
    /* How the plain formula differs; NULL: not in this. */
    void (*spoil)(HardScene *made);
    ShaderReplacement replaced[3]; /* ended by a NULL name. Timed with the first only: the second
                                      makes its result visible */
    const char *precision;
    LightingNormalMatrix *normal_matrix;
    const LightingTransforms *(*transforms)(void);
    ShadowSettings shadows; /* of the plain way; zeroed: volumes, as in the stable one */
    bool depth_pass;        /* see lighting_use_depth_pass */
    int width, height;      /* of the picture, which is then enlarged; 0: the user's */
} HardCase;

enum { HARD_FORMULA_COUNT = 20, HARD_SHADOW_COUNT = 10 };
enum { HARD_CASE_COUNT = HARD_FORMULA_COUNT + HARD_SHADOW_COUNT };
extern const HardCase HARD_FORMULAS[HARD_FORMULA_COUNT], HARD_SHADOWS[HARD_SHADOW_COUNT];

/* By number; those of shadows are the last. */
const HardCase *hard_case(int number);

/* Makes a case's scenes; call hard_scene_close even on failure. */
bool hard_scene_open(HardScene *made, const HardCase *of, Message *message);
void hard_scene_close(HardScene *made);

/* Formulas as they are usually written, which fail. */

/* The inverse transpose; of a singular matrix the identity, as if left unchanged. */
Mat4 naive_inverse_transpose(Mat4 eye_from_object);

/* The cofactor matrix, without the sign of the determinant. */
Mat4 naive_cofactors(Mat4 eye_from_object);

/* The inverse transpose by cofactors and determinant, in single precision. */
Mat4 naive_float_inverse_transpose(Mat4 eye_from_object);

/* A view matrix in single precision: s = f x up, u = s x f. */
const LightingTransforms *naive_float_look_at(void);

/* All matrices in single precision, multiplied in the lecture's order. */
const LightingTransforms *naive_float_lecture(void);

#endif
