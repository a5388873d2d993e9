/*
 * Determinant, inverse and normal matrix.
 *
 * All three work on B, where A(i, j) = B(i, j) * 2^(row[i] + column[j]) and the largest entry of
 * each row and column of B, unless all are 0, is in [0.5, 1). Nothing is rounded, the products
 * below neither overflow nor underflow, and A's inverse and cofactors are B's times 2^-(row[i] +
 * column[j]), the cofactors up to one common factor.
 */
#include "core/matrix.h"

#include <math.h>

typedef struct Scaled {
    double b[4][8]; /* b[row][column]; room for the identity to the right of B */
    int row[4], column[4];
} Scaled;

/* Less than any sum of exponents. */
enum { EXPONENT_OF_ZERO = -100000 };

static int exponent_of(double x)
{
    int exponent;
    frexp(x, &exponent);
    return x == 0 ? EXPONENT_OF_ZERO : exponent;
}

/* The upper left n x n part of a finite `a`. All exponents are chosen before anything is scaled, so
 * that a tiny factor of a row and a huge one of a column do not underflow together. */
static Scaled scale_by_powers_of_two(Mat4 a, int n)
{
    Scaled s = {{{0}}, {0}, {0}};
    int exponent[4][4];
    for (int j = 0; j < n; j++) {
        int largest = EXPONENT_OF_ZERO;
        for (int i = 0; i < n; i++) {
            exponent[i][j] = exponent_of(a.m[4 * j + i]);
            if (exponent[i][j] > largest)
                largest = exponent[i][j];
        }
        s.column[j] = largest == EXPONENT_OF_ZERO ? 0 : largest;
    }
    for (int i = 0; i < n; i++) {
        int largest = EXPONENT_OF_ZERO / 2;
        for (int j = 0; j < n; j++)
            if (exponent[i][j] - s.column[j] > largest)
                largest = exponent[i][j] - s.column[j];
        s.row[i] = largest == EXPONENT_OF_ZERO / 2 ? 0 : largest;
        for (int j = 0; j < n; j++)
            s.b[i][j] = ldexp(a.m[4 * j + i], -(s.row[i] + s.column[j]));
    }
    return s;
}

/* Gaussian elimination with partial pivoting on the first `columns` columns of b. Returns the sign
 * of the permutation of the rows, or 0 at a pivot of 0. */
static int eliminate(double b[4][8], int columns)
{
    int sign = 1;
    for (int k = 0; k < 4; k++) {
        int pivot = k;
        for (int i = k + 1; i < 4; i++)
            if (fabs(b[i][k]) > fabs(b[pivot][k]))
                pivot = i;
        if (b[pivot][k] == 0)
            return 0;
        if (pivot != k)
            sign = -sign;
        for (int j = 0; j < columns; j++) {
            double swap = b[k][j];
            b[k][j] = b[pivot][j];
            b[pivot][j] = swap;
        }
        for (int i = k + 1; i < 4; i++) {
            double factor = b[i][k] / b[k][k];
            for (int j = k + 1; j < columns; j++)
                b[i][j] -= factor * b[k][j];
        }
    }
    return sign;
}

/* Cofactors of the upper left 3x3 part of b; returns its determinant. The cofactors keep their
 * digits (vec3_cross), so the error of the inverse is mostly that of the determinant: at most
 * 5 * 1.1e-16 * condition, and a common factor of all entries. */
static double cofactors(double b[4][8], double cofactor[3][3])
{
    for (int i = 0; i < 3; i++) {
        const double *p = b[(i + 1) % 3], *q = b[(i + 2) % 3];
        const Vec3 cross = vec3_cross((Vec3){p[0], p[1], p[2]}, (Vec3){q[0], q[1], q[2]});
        cofactor[i][0] = cross.x;
        cofactor[i][1] = cross.y;
        cofactor[i][2] = cross.z;
    }
    return b[0][0] * cofactor[0][0] + b[0][1] * cofactor[0][1] + b[0][2] * cofactor[0][2];
}

/* The determinant from cofactors(), or 0 if the matrix is singular except for rounding and the sign
 * therefore random. An entry of a product of matrices has an error of a few units of 1.1e-16 of its
 * terms, which changes the determinant by that times its cofactor. The terms exceed 1, the largest
 * of row and column here, only if a row cancels: of flattened models with random rotations, 1 in
 * 10,000 is off by more than 16 such units, and 1 in millions by more than 256. */
static double signed_determinant(double determinant, double cofactor[3][3])
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            sum += fabs(cofactor[i][j]);
    return fabs(determinant) <= 256 * 0x1p-53 * sum ? 0 : determinant;
}

static bool is_affine(const Mat4 *a)
{
    return a->m[3] == 0 && a->m[7] == 0 && a->m[11] == 0 && a->m[15] == 1;
}

double mat4_determinant(Mat4 a)
{
    if (!mat4_is_finite(a))
        return (double)NAN;
    const int n = is_affine(&a) ? 3 : 4;
    Scaled s = scale_by_powers_of_two(a, n);
    double mantissa, cofactor[3][3];
    int exponent = 0;
    if (n == 3) {
        mantissa = cofactors(s.b, cofactor);
        mantissa = signed_determinant(mantissa, cofactor);
    } else {
        mantissa = eliminate(s.b, 4);
    }
    for (int i = 0; i < n; i++) {
        int step;
        mantissa = frexp(n == 3 ? mantissa : mantissa * s.b[i][i], &step);
        exponent += step + s.row[i] + s.column[i];
    }
    return ldexp(mantissa, exponent);
}

/* Eliminates in the transpose, so it solves for the inverse row by row. That brings inverse * a,
 * which takes a vector there and back, within condition * 1.1e-16 of the identity; elimination in
 * `a` itself would do so for a * inverse. No solver does both (Higham, section 14.3). */
static bool inverse_general(Mat4 a, Mat4 *inverse)
{
    Scaled s = scale_by_powers_of_two(mat4_transpose(a), 4);
    for (int i = 0; i < 4; i++)
        s.b[i][4 + i] = 1;
    if (eliminate(s.b, 8) == 0)
        return false;
    for (int i = 3; i >= 0; i--) {
        for (int k = 0; k < 4; k++) {
            double x = s.b[i][4 + k];
            for (int j = i + 1; j < 4; j++)
                x -= s.b[i][j] * s.b[j][4 + k];
            s.b[i][4 + k] = x / s.b[i][i];
            inverse->m[4 * i + k] = ldexp(s.b[i][4 + k], -(s.row[k] + s.column[i]));
        }
    }
    return true;
}

static bool inverse_affine(Mat4 a, Mat4 *inverse)
{
    Scaled s = scale_by_powers_of_two(a, 3);
    double cofactor[3][3];
    double determinant = cofactors(s.b, cofactor);
    if (determinant == 0)
        return false;
    *inverse = mat4_identity();
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            inverse->m[4 * i + j] = ldexp(cofactor[i][j] / determinant, -(s.row[i] + s.column[j]));
    Vec3 t = mat4_transform_direction(*inverse, (Vec3){a.m[12], a.m[13], a.m[14]});
    inverse->m[12] = -t.x;
    inverse->m[13] = -t.y;
    inverse->m[14] = -t.z;
    return true;
}

bool mat4_inverse(Mat4 a, Mat4 *inverse)
{
    Mat4 result;
    const bool done = mat4_is_finite(a) &&
                      (is_affine(&a) ? inverse_affine : inverse_general)(a, &result) &&
                      mat4_is_finite(result);
    *inverse = done ? result : mat4_identity();
    return done;
}

bool mat4_try_normal(Mat4 a, Mat4 *normal_matrix)
{
    *normal_matrix = mat4_scale((Vec3){0, 0, 0});
    if (!mat4_is_finite(a))
        return false;
    Scaled s = scale_by_powers_of_two(a, 3);
    double cofactor[3][3];
    double determinant = cofactors(s.b, cofactor);
    double sign = signed_determinant(determinant, cofactor) < 0 ? -1 : 1;
    int largest = EXPONENT_OF_ZERO / 2;
    double squares = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (exponent_of(cofactor[i][j]) - s.row[i] - s.column[j] > largest)
                largest = exponent_of(cofactor[i][j]) - s.row[i] - s.column[j];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int exponent = -s.row[i] - s.column[j] - largest;
            const double entry = ldexp(sign * cofactor[i][j], exponent);
            normal_matrix->m[4 * j + i] = entry;
            squares += entry * entry;
        }
    const double length = sqrt(squares / 3);
    for (int k = 0; k < 12 && squares > 0; k++)
        normal_matrix->m[k] /= length;
    return largest != EXPONENT_OF_ZERO / 2;
}

Mat4 mat4_normal(Mat4 a)
{
    Mat4 normal_matrix;
    mat4_try_normal(a, &normal_matrix);
    return normal_matrix;
}
