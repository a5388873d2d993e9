// Rodrigues' formula, written out; everything in one go.
#include <math.h>
#include "lab_code.h"

#define PI 3.14159265358979323846

void lab_matrices(double t, Mat4 *M, Mat4 *N)
{
    const double a = t * 30.0 * PI / 180.0, c = cos(a), s = sin(a), k = 1 - c;
    const double length = sqrt(1 * 1 + 2 * 2 + 0.5 * 0.5);
    const double x = 1 / length, y = 2 / length, z = 0.5 / length;
    const double r[3][3] = {
        {c + k * x * x, k * x * y - s * z, k * x * z + s * y},
        {k * y * x + s * z, c + k * y * y, k * y * z - s * x},
        {k * z * x - s * y, k * z * y + s * x, c + k * z * z},
    };
    const double scale[3] = {2, 0.7, 1.2}, move[3] = {0.5, 0.3, -0.8};
    *M = mat4_identity();
    *N = mat4_identity();
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            M->m[4 * column + row] = r[row][column] * scale[column];
            /* (R S) inverted and transposed is R S^-1. */
            N->m[4 * column + row] = r[row][column] / scale[column];
        }
        M->m[12 + row] = move[row];
    }
}
