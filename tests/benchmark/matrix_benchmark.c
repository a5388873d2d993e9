/*
 * Time and accuracy of inverses and normal matrices: this project's, and those of cglm and GLM if
 * they are installed (Debian: libcglm-dev, libglm-dev). The matrices are R1 S R2, rotations and a
 * scale whose largest and smallest factors have the ratio `condition`. Errors are relative to
 * 113-bit arithmetic.
 */
#include "benchmark/matrix_benchmark.h"

#include "base/clock.h"
#include "base/random.h"
#include "benchmark/bench.h"
#include "core/matrix.h"
#include "support/quad.h"

#ifdef HAVE_CGLM
#include <cglm/cglm.h>
#endif

#include <math.h>
#include <stdalign.h>
#include <stdio.h>
#include <string.h>

enum { ROUNDS = 101, COUNT = 1000, REPEATS = 4, DECADES = 7 };

static Random random_state = {20240607};
static double doubles[COUNT][16], double_results[COUNT][16];
static alignas(64) float floats[COUNT][16], float_results[COUNT][16];
static float normals[COUNT][3]; /* that the normal matrices are applied to */
static const Batch BATCH = {COUNT, (const double (*)[16])doubles, (const float (*)[16])floats,
                            double_results, float_results};

/* Matrices. */

static double uniform(void)
{
    return random_between(&random_state, 0, 1);
}

static Vec3 random_direction(void)
{
    const double z = 2 * uniform() - 1, angle = 2 * acos(-1) * uniform(), r = sqrt(1 - z * z);
    return (Vec3){r * cos(angle), r * sin(angle), z};
}

static Mat4 random_rotation(void)
{
    const double degrees = 360 * uniform();
    return mat4_rotate(degrees, random_direction());
}

/* Fills the batch with matrices of one condition; 0: of 1 to 1e12. */
static void fill(double condition)
{
    for (int i = 0; i < COUNT; i++) {
        const double k = condition > 0 ? condition : pow(10, 12 * uniform());
        const Mat4 first = random_rotation(), last = random_rotation();
        const Mat4 scale = mat4_scale((Vec3){1, pow(k, -uniform()), 1 / k});
        const Mat4 a = mat4_product(first, mat4_product(scale, last));
        memcpy(doubles[i], a.m, sizeof a.m);
        mat4_to_float(a, floats[i]);
        vec3_to_float(random_direction(), normals[i]);
    }
}

/* Algorithms. */

static void own_affine(const Batch *batch)
{
    for (int i = 0; i < batch->count; i++) {
        Mat4 a;
        memcpy(a.m, batch->doubles[i], sizeof a.m);
        mat4_inverse(a, &a);
        memcpy(batch->double_results[i], a.m, sizeof a.m);
    }
}

/* Twice the matrix has the bottom row 0 0 0 2, which is not affine: LU is used. */
static void own_general(const Batch *batch)
{
    for (int i = 0; i < batch->count; i++) {
        Mat4 a;
        for (int j = 0; j < 16; j++)
            a.m[j] = 2 * batch->doubles[i][j];
        mat4_inverse(a, &a);
        for (int j = 0; j < 16; j++)
            batch->double_results[i][j] = 2 * a.m[j];
    }
}

static void own_normal(const Batch *batch)
{
    for (int i = 0; i < batch->count; i++) {
        Mat4 a;
        memcpy(a.m, batch->doubles[i], sizeof a.m);
        a = mat4_normal(a);
        mat4_to_float(a, batch->float_results[i]);
    }
}

#ifdef HAVE_CGLM
#define CGLM_INVERSE(name, inverse)                                                                \
    static void name(const Batch *batch)                                                           \
    {                                                                                              \
        for (int i = 0; i < batch->count; i++) {                                                   \
            mat4 a;                                                                                \
            memcpy(a, batch->floats[i], sizeof a);                                                 \
            inverse(a, a);                                                                         \
            memcpy(batch->float_results[i], a, sizeof a);                                          \
        }                                                                                          \
    }
CGLM_INVERSE(cglm_inverse, glm_mat4_inv)
CGLM_INVERSE(cglm_inverse_precise, glm_mat4_inv_precise)

static void cglm_normal(const Batch *batch)
{
    for (int i = 0; i < batch->count; i++) {
        mat4 a;
        mat3 n;
        memcpy(a, batch->floats[i], sizeof a);
        glm_mat4_pick3(a, n);
        glm_mat3_inv(n, n);
        glm_mat3_transpose(n);
        glm_mat4_ins3(n, a);
        memcpy(batch->float_results[i], a, sizeof a);
    }
}
#else
#define cglm_inverse NULL
#define cglm_inverse_precise NULL
#define cglm_normal NULL
#endif

#ifndef HAVE_GLM
#define glm_inverse NULL
#define glm_inverse_double NULL
#define glm_normal NULL
#endif

typedef struct Algorithm {
    const char *name;
    void (*run)(const Batch *batch); /* NULL: the library is missing */
    bool real;                       /* results are floats */
    bool again;                      /* A/A: repeats the algorithm before it */
} Algorithm;

static const Algorithm INVERSES[] = {
    {"cglm glm_mat4_inv, float", cglm_inverse, true, false},
    {"cglm glm_mat4_inv_precise, float", cglm_inverse_precise, true, false},
    {"GLM inverse, float", glm_inverse, true, false},
    {"GLM inverse, double", glm_inverse_double, false, false},
    {"mat4_inverse, affine (FMA)", own_affine, false, false},
    {"the same again (A/A)", own_affine, false, true},
    {"mat4_inverse, general (LU)", own_general, false, false},
};

static const Algorithm NORMALS[] = {
    {"cglm inverse transpose, float", cglm_normal, true, false},
    {"GLM inverseTranspose, float", glm_normal, true, false},
    {"mat4_normal", own_normal, true, false},
    {"the same again (A/A)", own_normal, true, true},
};

enum { INVERSE_COUNT = sizeof INVERSES / sizeof *INVERSES };
enum { NORMAL_COUNT = sizeof NORMALS / sizeof *NORMALS };

/* Errors. */

static Mat4 matrix_of(const double *numbers)
{
    Mat4 a;
    memcpy(a.m, numbers, sizeof a.m);
    return a;
}

/* 1 (no correct digit) if it is larger or not a number. */
static double inverse_error(int i, bool real)
{
    Mat4 got = matrix_of(double_results[i]);
    for (int k = 0; k < 16 && real; k++)
        got.m[k] = (double)float_results[i][k];
    const double relative = quad_inverse_error(matrix_of(doubles[i]), got);
    return relative < 1 ? relative : 1;
}

static double normal_error(int i, bool real)
{
    (void)real;
    return quad_normal_error(matrix_of(doubles[i]), float_results[i], normals[i]);
}

typedef struct Comparison {
    const char *title;
    const Algorithm *algorithms;
    int count;
    double (*error)(int i, bool real);
    double (*errors)[DECADES][2]; /* by algorithm: median and worst */
} Comparison;

/* Times. */

static bool run_batches(void *argument, __attribute__((unused)) Message *message)
{
    const Algorithm *algorithm = argument;
    for (int i = 0; i < REPEATS; i++)
        if (algorithm->run)
            algorithm->run(&BATCH);
    return true;
}

static void put_row(Table *table, const Comparison *comparison, int k, const BenchRun *runs)
{
    const Algorithm *algorithm = &comparison->algorithms[k];
    const BenchColumn time = {BENCH_TIME(k, 1e9 / (COUNT * REPEATS), 1)};
    char errors[DECADES][24] = {{0}};
    for (int i = 0; i < DECADES && algorithm->run && !algorithm->again; i++)
        snprintf(errors[i], sizeof errors[i], "%.0e/%.0e", comparison->errors[k][i][0],
                 comparison->errors[k][i][1]);
    table_row(table, "%s|%s|%s|%s|%s|%s|%s|%s|%s", algorithm->name, errors[0], errors[1], errors[2],
              errors[3], errors[4], errors[5], errors[6],
              algorithm->run ? bench_cell(runs, &time).text : "missing");
}

static bool compare(const Comparison *comparison, Message *message)
{
    BenchRun runs[INVERSE_COUNT];
    Table table;
    static double errors[COUNT];
    for (int decade = 0; decade < DECADES; decade++) {
        fill(pow(10, 2 * decade));
        for (int k = 0; k < comparison->count; k++) {
            const Algorithm *algorithm = &comparison->algorithms[k];
            if (!algorithm->run)
                continue;
            algorithm->run(&BATCH);
            for (int i = 0; i < COUNT; i++)
                errors[i] = comparison->error(i, algorithm->real);
            comparison->errors[k][decade][0] = clock_median(errors, COUNT);
            comparison->errors[k][decade][1] = clock_quantile(errors, COUNT, 1);
        }
    }
    fill(0);
    for (int k = 0; k < comparison->count; k++)
        runs[k] = (BenchRun){comparison->algorithms[k].name, run_batches,
                             (void *)&comparison->algorithms[k], NULL, 0};
    const bool done = bench_rounds(runs, comparison->count, ROUNDS, message);
    table_open(&table, "condition|1e0|1e2|1e4|1e6|1e8|1e10|1e12|ns per call");
    for (int k = 0; k < comparison->count && done; k++)
        put_row(&table, comparison, k, runs);
    for (int k = 1; k < comparison->count && done; k++)
        if (comparison->algorithms[k].again)
            table_row(&table, "A/A||||||||%s",
                      bench_cell(runs, &(BenchColumn){BENCH_RATIO(k, k - 1, 3)}).text);
    bench_print(comparison->title, &table);
    bench_finish(runs, comparison->count);
    return done;
}

static bool run(Message *message)
{
    static double inverse_errors[INVERSE_COUNT][DECADES][2],
        normal_errors[NORMAL_COUNT][DECADES][2];
    const Comparison inverses = {
        "Inverse of R1 S R2: relative error (Frobenius norms), median/worst of 1000, by condition:",
        INVERSES, INVERSE_COUNT, inverse_error, inverse_errors};
    const Comparison normal_matrices = {
        "Normal matrix of R1 S R2: angular error of a normal in radians, applied in float, "
        "median/worst of 1000, by condition:",
        NORMALS, NORMAL_COUNT, normal_error, normal_errors};
    return compare(&inverses, message) && compare(&normal_matrices, message);
}

const Bench BENCH = {.name = "matrix_benchmark", .run = run};
