/*
 * Inverses are by Gauss-Jordan elimination with full pivoting, whose relative error is about the
 * condition times 1e-34 (Higham, Accuracy and Stability of Numerical Algorithms, sections 9.4 and
 * 14.4): of matrices up to a condition of 1e16 it has all digits of a double.
 */
#include "support/quad.h"

#include <math.h>

Quad quad_abs(Quad x)
{
    return x < 0 ? -x : x;
}

QuadMatrix quad_from(Mat4 a)
{
    QuadMatrix q;
    for (int i = 0; i < 16; i++)
        q.a[i % 4][i / 4] = (Quad)a.m[i];
    return q;
}

QuadMatrix quad_product(const QuadMatrix *a, const QuadMatrix *b)
{
    QuadMatrix c;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            c.a[i][j] = 0;
            for (int k = 0; k < 4; k++)
                c.a[i][j] += a->a[i][k] * b->a[k][j];
        }
    return c;
}

QuadMatrix quad_subtract(const QuadMatrix *a, const QuadMatrix *b)
{
    QuadMatrix c;
    for (int i = 0; i < 16; i++)
        c.a[i / 4][i % 4] = a->a[i / 4][i % 4] - b->a[i / 4][i % 4];
    return c;
}

Quad quad_norm_squared(const QuadMatrix *a)
{
    Quad sum = 0;
    for (int i = 0; i < 16; i++)
        sum += a->a[i / 4][i % 4] * a->a[i / 4][i % 4];
    return sum;
}

static void swap(Quad *a, Quad *b)
{
    const Quad kept = *a;
    *a = *b;
    *b = kept;
}

/* The largest entry of the rows and columns from `k` on. */
static void find_pivot(Quad w[4][8], int k, int *row, int *column)
{
    *row = *column = k;
    for (int i = k; i < 4; i++)
        for (int j = k; j < 4; j++) {
            if (quad_abs(w[i][j]) > quad_abs(w[*row][*column])) {
                *row = i;
                *column = j;
            }
        }
}

Quad quad_inverse(const QuadMatrix *a, QuadMatrix *inverse)
{
    Quad w[4][8], determinant = 1;
    int unknown[4] = {0, 1, 2, 3}; /* of each column */
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 8; j++)
            w[i][j] = j < 4 ? a->a[i][j] : (Quad)(j == 4 + i);
    for (int k = 0; k < 4; k++) {
        int row, column;
        find_pivot(w, k, &row, &column);
        for (int j = 0; j < 8; j++)
            swap(&w[k][j], &w[row][j]);
        for (int i = 0; i < 4; i++)
            swap(&w[i][k], &w[i][column]);
        const int other = unknown[k];
        unknown[k] = unknown[column];
        unknown[column] = other;
        const Quad pivot = w[k][k];
        determinant *= (row != k) == (column != k) ? pivot : -pivot;
        if (pivot == 0)
            return 0;
        for (int j = k; j < 8; j++)
            w[k][j] /= pivot;
        for (int i = 0; i < 4; i++) {
            const Quad factor = w[i][k];
            for (int j = k; j < 8 && i != k; j++)
                w[i][j] -= factor * w[k][j];
        }
    }
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            inverse->a[unknown[i]][j] = w[i][4 + j];
    return determinant;
}

QuadMatrix quad_normal(Mat4 a)
{
    const QuadMatrix q = quad_from(a);
    QuadMatrix normal = {{{0}}};
    Quad determinant = 0;
    for (int i = 0; i < 3; i++) {
        const int p = (i + 1) % 3, r = (i + 2) % 3;
        for (int j = 0; j < 3; j++) {
            const int s = (j + 1) % 3, t = (j + 2) % 3;
            normal.a[i][j] = q.a[p][s] * q.a[r][t] - q.a[p][t] * q.a[r][s];
        }
        determinant += q.a[i][0] * normal.a[i][0];
    }
    for (int i = 0; i < 9 && determinant < 0; i++)
        normal.a[i / 3][i % 3] = -normal.a[i / 3][i % 3];
    return normal;
}

static double angle_between(const Quad a[3], const Quad b[3])
{
    Quad dot = 0, cross = 0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const Quad part = a[j] * b[k] - a[k] * b[j];
        dot += a[i] * b[i];
        cross += part * part;
    }
    return dot > 0 ? atan(sqrt((double)(cross / (dot * dot)))) : acos(-1);
}

static void image_of(const QuadMatrix *a, Vec3 direction, Quad image[3])
{
    for (int i = 0; i < 3; i++)
        image[i] = a->a[i][0] * (Quad)direction.x + a->a[i][1] * (Quad)direction.y +
                   a->a[i][2] * (Quad)direction.z;
}

double quad_angle(const QuadMatrix *a, const QuadMatrix *b, Vec3 direction)
{
    Quad p[3], q[3];
    image_of(a, direction, p);
    image_of(b, direction, q);
    return angle_between(p, q);
}

double quad_orthonormality_error(Mat4 r)
{
    Quad sum = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            Quad dot = i == j ? -1 : 0;
            for (int k = 0; k < 3; k++)
                dot += (Quad)r.m[4 * k + i] * (Quad)r.m[4 * k + j];
            sum += dot * dot;
        }
    return sqrt((double)sum);
}

double quad_inverse_error(Mat4 a, Mat4 inverse)
{
    const QuadMatrix q = quad_from(a), x = quad_from(inverse);
    QuadMatrix exact;
    quad_inverse(&q, &exact);
    const QuadMatrix difference = quad_subtract(&x, &exact);
    return sqrt((double)(quad_norm_squared(&difference) / quad_norm_squared(&exact)));
}

double quad_normal_error(Mat4 a, const float normal[16], const float n[3])
{
    const QuadMatrix exact = quad_normal(a);
    Quad right[3], got[3];
    image_of(&exact, vec3_from_float(n), right);
    for (int i = 0; i < 3; i++)
        got[i] = (Quad)(normal[i] * n[0] + normal[4 + i] * n[1] + normal[8 + i] * n[2]);
    return angle_between(got, right);
}
