#include "lab_code.h"
#include "matrix.h"

static Vec3 column(const Mat4 *m, int i)
{
    Vec3 v = {m->m[4 * i], m->m[4 * i + 1], m->m[4 * i + 2]};
    return v;
}

static void set_column(Mat4 *m, int i, Vec3 v)
{
    m->m[4 * i] = v.x;
    m->m[4 * i + 1] = v.y;
    m->m[4 * i + 2] = v.z;
}

/* The images of two edges of a face span the transformed face: their cross product is its normal.
 */
void lab_matrices(double seconds, Mat4 *world_from_model, Mat4 *normal_matrix)
{
    Vec3 axis = {1.0, 2.0, 0.5};
    Mat4 r, w;
    vec3_normalize(axis, &axis);
    r = mat4_rotate(seconds * 30.0, axis);
    w = mat4_product(mat4_product(mat4_translate((Vec3){.x = 0.5, .y = 0.3, .z = -0.8}), r),
                     mat4_scale((Vec3){2.0, 0.7, 1.2}));
    *world_from_model = w;
    *normal_matrix = mat4_identity();
    set_column(normal_matrix, 0, vec3_cross(column(&w, 1), column(&w, 2)));
    set_column(normal_matrix, 1, vec3_cross(column(&w, 2), column(&w, 0)));
    set_column(normal_matrix, 2, vec3_cross(column(&w, 0), column(&w, 1)));
}
