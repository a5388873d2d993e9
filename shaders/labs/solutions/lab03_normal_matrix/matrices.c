/*
 * Lab 3: where the cube lies in the world, and the matrix for its normals.
 */
#include "lab_code.h"

static const Vec3 SCALE = {2, 0.7, 1.2}, AXIS = {1, 2, 0.5}, PLACE = {0.5, 0.3, -0.8};
static const double DEGREES_PER_SECOND = 30;

void lab_matrices(double seconds, Mat4 *world_from_model, Mat4 *normal_matrix)
{
    Mat4 rotation = mat4_rotate(DEGREES_PER_SECOND * seconds, AXIS);
    *world_from_model =
        mat4_product(mat4_translate(PLACE), mat4_product(rotation, mat4_scale(SCALE)));
    /* The transpose of the inverse keeps normals perpendicular to the surface. */
    Mat4 inverse;
    mat4_inverse(*world_from_model, &inverse);
    *normal_matrix = mat4_transpose(inverse);
}
