/*
 * matrix_benchmark: the algorithms that are compared, in C and in C++.
 */
#ifndef MATRIX_BENCHMARK_H
#define MATRIX_BENCHMARK_H

#ifdef __cplusplus
extern "C" {
#endif

/* Matrices one after another, 16 numbers each, by columns; an algorithm reads those of its
 * precision and writes as many. */
typedef struct Batch {
    int count;
    const double (*doubles)[16];
    const float (*floats)[16]; /* the same, rounded; aligned to 64 bytes */
    double (*double_results)[16];
    float (*float_results)[16]; /* aligned to 64 bytes */
} Batch;

#ifdef HAVE_GLM
void glm_inverse(const Batch *batch);
void glm_inverse_double(const Batch *batch);
void glm_normal(const Batch *batch); /* the result's upper left 3x3 part */
#endif

#ifdef __cplusplus
}
#endif

#endif
