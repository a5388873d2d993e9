/* 법선 행렬: 전치한 다음 역행렬 */
#include <stdbool.h>
#include "lab_code.h"
const double VITESSE = 30.0;
void lab_matrices(double seconds, Mat4 *world_from_model, Mat4 *normal_matrix) {
	Mat4 S = mat4_scale((Vec3){2, 0.7, 1.2}), R, T = mat4_translate((Vec3){0.5, 0.3, -0.8}), linear;
	bool ok = mat4_try_rotate(VITESSE * seconds, (Vec3){1, 2, 0.5}, &R);
	linear = mat4_product(R, S);
	*world_from_model = mat4_product(T, linear);
	ok = ok && mat4_inverse(mat4_transpose(linear), normal_matrix);
	if (!ok) *normal_matrix = mat4_identity();
}
