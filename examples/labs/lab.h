/*
 * lab: the exercises, as data: what each is called, what its scenes hold and which of the
 * interface's uniforms a submission's shaders may use. No GL.
 *
 * A lab has a folder of its name with its task and starter, LABS_SOURCE/NAME in the source tree and
 * share/lighting/labs/NAME in an installation. Its shaders are NN.vert and NN.frag ("lab05.vert").
 */
#ifndef LAB_H
#define LAB_H

#include "scene.h"

#include <limits.h>

enum { LAB_COUNT = 10, LAB_MOST_LIGHTS = 2 };

typedef struct Lab {
    int number;          /* 1 to LAB_COUNT */
    const char *name;    /* of its folder and its program: "lab05_per_fragment" */
    const char *file;    /* of its shaders, without the extension: "lab05" */
    const char *summary; /* one line: what is to be done */
    const char *code;    /* the C file of a submission: "matrices.c"; NULL: none */
    LightKind light;
    int lights;     /* how many there are: with 2, their uniforms are arrays */
    bool ambient;   /* else there is none */
    bool specular;  /* has a highlight */
    bool fitted;    /* its exponent is Blinn-Phong's, to be fitted to Phong's, which is given */
    bool flat;      /* flat shapes only, whose interpolated normals stay unit */
    bool rigid;     /* objects are turned and moved, and never scaled */
    bool either;    /* light at the vertices is as right as at the fragments */
    bool two_sided; /* the back has a colour of its own; objects may be mirrored */
    bool given;     /* the shaders are given, and the submission is C alone */
    bool budget;    /* the submission chooses the mesh, and is scored by its cost */
    Reflection reflection;
} Lab;

extern const Lab LABS[LAB_COUNT];

/* By "5", "05", "lab05", "lab5" or "lab05_per_fragment"; NULL, with a message that names those
 * there are or the nearest. */
const Lab *lab_find(const char *text, Message *message);

/* The folder with the lab's task and starter; false, with a message, where there is none. */
bool lab_folder(const Lab *lab, char folder[PATH_MAX], Message *message);

#endif
