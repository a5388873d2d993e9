/*
 * How far a picture can be off because of the driver's arithmetic: bounds at points of each
 * triangle (proof.h), some thousands of an object, not everywhere; tests compare them with
 * pictures.
 */
#include "study/arithmetic/proof.h"

#include <math.h>

/* At the corners, and between so many parts of a side. */
static double predict_triangle(const Proof *proof, const ProofTriangle *triangle, int parts)
{
    double steps = 0;
    for (int i = 0; i <= parts; i++)
        for (int k = 0; k <= parts - i; k++) {
            const ProofBox at = {{(double)i / parts, (double)k / parts}, {0}};
            steps = fmax(steps, proof_piece(proof, triangle, &at).steps);
        }
    return steps;
}

double predict_scene(const Scene *scene, int height, const Arithmetic *vertex,
                     const Arithmetic *fragment, const Raster *raster)
{
    enum { POINTS = 5000 };
    const ProofDriver driver = {vertex, fragment, raster, height};
    Message message = {0};
    Proof proof;
    double steps = 0;
    if (!proof_open(&proof, scene, &driver, false, NULL, &message))
        return 255;
    for (ProofTriangle triangle = {.number = -1}; proof_next(&proof, &triangle);) {
        const double triangles = proof.capture.draws[triangle.draw].vertex_count / 3.0;
        steps = fmax(steps,
                     predict_triangle(&proof, &triangle, (int)ceil(sqrt(2 * POINTS / triangles))));
    }
    proof_close(&proof);
    return fmin(steps + raster->bytes, 255);
}

double predict_pow(const Arithmetic *fragment, double shininess)
{
    double error = 0;
    for (int i = 0; i <= ilogb(fmax(shininess, .0625)) + 4 && i < 16; i++)
        error = fmax(error, (double)fragment->accuracies[FUNCTION_POW].absolute[i]);
    return 255 * error;
}
