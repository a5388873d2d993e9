#include "lab_code.h"
#include <string.h>

/* Any positive multiple will do, for the shader makes the normals unit. */
void lab_matrices(double seconds, Mat4 *world_from_model, Mat4 *normal_matrix)
{
    Mat4 rotation, result;
    rotation = mat4_rotate(30.0 * seconds - 360.0, (Vec3){2, 4, 1});
    Mat4 world = mat4_product(rotation, mat4_scale((Vec3){2, 0.7, 1.2}));
    world.m[12] = 0.5;
    world.m[13] = 0.3;
    world.m[14] = -0.8;
    memcpy(world_from_model, &world, sizeof world);
    result = mat4_product(rotation, mat4_scale((Vec3){7 / 2.0, 7 / 0.7, 7 / 1.2}));
    memcpy(normal_matrix, &result, sizeof result);
}
