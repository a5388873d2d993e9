#include "lab_code.h"

void lab_matrices(double seconds, Mat4 *world_from_model, Mat4 *normal_matrix)
{
    const Mat4 turn = mat4_rotate(30 * seconds, (Vec3){1, 2, 0.5});
    Mat4 m = mat4_scale((Vec3){2, 0.7, 1.2});
    m = mat4_product(turn, m);
    m = mat4_product(mat4_translate((Vec3){0.5, 0.3, -0.8}), m);
    *world_from_model = m;
    /* The signed cofactors: the shader makes the length right. */
    *normal_matrix = mat4_normal(m);
}
