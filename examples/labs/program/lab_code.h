/*
 * lab_code: the functions that the C files of labs 3 and 10 define.
 */
#ifndef LAB_CODE_H
#define LAB_CODE_H

#include "core/matrix.h"

#include <stdbool.h>

/* Lab 3, matrices.c: the cube's model matrix after so many seconds, and its normal matrix, whose
 * scale does not matter: the given shader normalizes. */
void lab_matrices(double seconds, Mat4 *world_from_model, Mat4 *normal_matrix);

/* Both forms of two functions work in a lab: by value, and with a pointer to the result as the last
 * argument, which returns whether there is one (mat4_try_*). The number of arguments decides; a
 * literal (Vec3){x, y, z} counts as three. */
#define LAB_FORM(a1, a2, a3, a4, a5, form, ...) form
#define mat4_rotate(...)                                                                           \
    LAB_FORM(__VA_ARGS__, mat4_try_rotate, mat4_rotate, mat4_try_rotate, mat4_rotate, , )          \
    (__VA_ARGS__)
#define mat4_normal(...) LAB_FORM(__VA_ARGS__, , , , mat4_try_normal, mat4_normal, )(__VA_ARGS__)

/* Lab 10, budget.c: how the sphere of radius 1 is drawn. */
typedef struct LabBudget {
    int slices, stacks; /* of the sphere: 3 to 512 and 2 to 512 (mesh_sphere) */
    bool cull;          /* back faces */
} LabBudget;
void lab_budget(LabBudget *budget);

#endif
