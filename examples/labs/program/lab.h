/*
 * lab: the eleven labs as data: names, what their scenes contain, which uniforms the shaders may
 * use. No GL.
 *
 * A lab has a folder of its name with its task and starter, examples/labs/NAME in the source tree
 * and share/lighting/labs/NAME in an installation. Its shaders are NN.vert and NN.frag
 * ("lab05.vert").
 */
#ifndef LAB_H
#define LAB_H

#include "scene/scene.h"

#include <limits.h>

enum { LAB_COUNT = 11, LAB_MAX_LIGHTS = 2 };

typedef struct Lab {
    int number;          /* 1 to LAB_COUNT */
    const char *name;    /* of its folder and program: "lab05_per_fragment" */
    const char *file;    /* of its shaders, without extension: "lab05" */
    const char *summary; /* one line */
    const char *code;    /* a submission's C file: "matrices.c"; NULL: none */
    LightKind light;
    int lights; /* how many; with 2 their uniforms are arrays */
    bool ambient;
    bool specular;
    bool fitted;    /* uses Blinn-Phong's exponent fitted to the given one of Phong */
    bool flat;      /* only flat shapes, whose interpolated normals stay normalized */
    bool rigid;     /* objects are turned and moved, never scaled */
    bool either;    /* light at the vertices is as right as at the fragments */
    bool two_sided; /* the back has its own colour; objects may be mirrored */
    bool given;     /* the shaders are given, the submission is only C */
    bool shadow;    /* its light casts shadows: the shaders get its map (binding.h) */
    bool budget;    /* the submission chooses the mesh and is scored by its cost */
    Reflection reflection;
} Lab;

extern const Lab LABS[LAB_COUNT];

/* By "5", "05", "lab05", "lab5" or "lab05_per_fragment"; NULL, with a message that names the
 * nearest or all. */
const Lab *lab_find(const char *text, Message *message);

/* The names of the files that a submission has to have: its two shaders, its C, or all of them.
 * Returns how many. */
enum { LAB_MAX_FILES = 3, LAB_NAME_SIZE = 64 };
int lab_files(const Lab *lab, char names[LAB_MAX_FILES][LAB_NAME_SIZE]);

/* The folder with the lab's task and starter; false, with a message: there is none. */
bool lab_folder(const Lab *lab, char folder[PATH_MAX], Message *message);

#endif
