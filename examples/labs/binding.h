/*
 * binding: the interface between a lab's scene and the shaders of a submission: attributes and
 * uniforms by their names, each set where the program has it.
 *
 * Values go to what the shader declares, as far as that makes sense: a vec4 in the place of a vec3
 * gets w = 1 for a place or a colour and 0 for a direction, a mat3 in the place of a mat4 its upper
 * left part, an array shorter than the lights the first of them.
 */
#ifndef BINDING_H
#define BINDING_H

#include "lab.h"
#include "mesh_buffer.h"

/* What is drawn: one object of a scene, into a picture of this aspect, width / height. The
 * matrices are the scene's, unless these replace them (lab 3). */
typedef struct Drawn {
    const Scene *scene;
    int object;
    double aspect;
    const Mat4 *world_from_object; /* NULL: the object's */
    const Mat4 *normal_matrix;     /* NULL: the inverse transpose of that */
} Drawn;

/* Looks at every active attribute and uniform of a linked program. False, with a message about the
 * first, where one is not of the lab's interface (naming the nearest) or of another type. */
bool binding_check(const Lab *lab, GLuint program, Message *message);

/* Sets the uniforms and the colour, binds the mesh and draws it with the program, which is in use
 * from then on. False, with a message, where a matrix cannot be made. */
bool binding_draw(const Lab *lab, GLuint program, const MeshBuffer *mesh, const Drawn *drawn,
                  Message *message);

/* The inverse of the transpose of the matrix's 3x3 part, in a matrix that is the identity's
 * otherwise; the identity where it is singular. Its length counts, as mat4_normal's does not. */
Mat4 binding_normal_matrix(Mat4 matrix);

#endif
