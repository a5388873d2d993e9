/*
 * lab_code: what the C files of two labs fill in.
 */
#ifndef LAB_CODE_H
#define LAB_CODE_H

#include "matrix.h"

#include <stdbool.h>

/* Lab 3, matrices.c: where the cube lies in the world after so many seconds, and the matrix for its
 * normals. The given shader makes unit what that matrix gives. */
void lab_matrices(double seconds, Mat4 *world_from_model, Mat4 *normal_matrix);

/* Lab 10, budget.c: what the picture is drawn with. It is a sphere of radius 1. */
typedef struct LabBudget {
    int slices, stacks; /* of the sphere: 3 to 512 and 2 to 512 (mesh_sphere) */
    bool cull;          /* leave out the triangles seen from behind */
} LabBudget;
void lab_budget(LabBudget *budget);

#endif
