/*
 * Tests of common/core/matrix.h: closed forms, edge cases, and random matrices against arithmetic
 * of 113 bits. LIGHTING_TEST_SEED in the environment replaces the seed.
 */
#include <float.h>
#include <inttypes.h>

#include "base/clock.h"
#include "base/random.h"
#include "core/matrix.h"
#include "support/quad.h"
#include "support/testing.h"

/* Unit roundoff u, the largest relative error of one operation: 1.1e-16. */
#define UNIT (DBL_EPSILON / 2)

static const double infinity = (double)INFINITY, not_a_number = (double)NAN;
static uint64_t seed = 20240607;
static Random random_state;

/* Tools: assertions with details */

static void print_matrix(const char *name, Mat4 a)
{
    print_error("%s, seed %" PRIu64 "\n", name, seed);
    for (int row = 0; row < 4; row++)
        print_error("  %24.17g %24.17g %24.17g %24.17g\n", a.m[row], a.m[4 + row], a.m[8 + row],
                    a.m[12 + row]);
}

static void check_near(double value, double expected, double tolerance, int line)
{
    if (value == expected || fabs(value - expected) <= tolerance)
        return;
    print_error("line %d: %.17g is not %.17g within %.3g, seed %" PRIu64 "\n", line, value,
                expected, tolerance, seed);
    fail();
}

static void check_matrix(Mat4 value, Mat4 expected, double tolerance, int line)
{
    for (int i = 0; i < 16; i++) {
        if (value.m[i] == expected.m[i] || fabs(value.m[i] - expected.m[i]) <= tolerance)
            continue;
        print_error("line %d: entry %d differs by more than %.3g\n", line, i, tolerance);
        print_matrix("value", value);
        print_matrix("expected", expected);
        fail();
    }
}

static void check_bound(double value, double bound, Mat4 a, int line)
{
    if (value <= bound)
        return;
    print_error("line %d: %.6g is over %.6g\n", line, value, bound);
    print_matrix("matrix", a);
    fail();
}

/* The call makes `got`, which is this. */
static Mat4 got;
#define assert_made(call, expected, tolerance)                                                     \
    (assert_true(call), assert_matrix(got, expected, tolerance))
#define assert_near(value, expected, tolerance) check_near(value, expected, tolerance, __LINE__)
#define assert_matrix(value, expected, tolerance) check_matrix(value, expected, tolerance, __LINE__)
#define assert_bound(value, bound, a) check_bound(value, bound, a, __LINE__)

static void assert_vector(Vec3 value, double x, double y, double z, double tolerance)
{
    assert_near(value.x, x, tolerance);
    assert_near(value.y, y, tolerance);
    assert_near(value.z, z, tolerance);
}

/* Tools: random numbers, restarted for each test. No expression draws two of them, so
 * the order is the same with every compiler. */

FIXTURE(start_random)
{
    random_state.state = seed;
}

static double between(double low, double high)
{
    return random_between(&random_state, low, high);
}

static double random_sign(void)
{
    return random_bits(&random_state) & 1 ? 1 : -1;
}

static double random_power(double low_exponent, double high_exponent)
{
    return pow(10, between(low_exponent, high_exponent));
}

/* Of either sign, log-uniform. */
static double random_size(double low_exponent, double high_exponent)
{
    double sign = random_sign();
    return sign * random_power(low_exponent, high_exponent);
}

static Vec3 random_vector(void)
{
    Vec3 v;
    v.x = between(-1, 1);
    v.y = between(-1, 1);
    v.z = between(-1, 1);
    return v;
}

static Vec3 random_vector_of_size(double low_exponent, double high_exponent)
{
    Vec3 v = random_vector();
    return vec3_scale(v, random_power(low_exponent, high_exponent));
}

static Mat4 random_matrix(void)
{
    Mat4 a;
    for (int i = 0; i < 16; i++)
        a.m[i] = between(-1, 1);
    return a;
}

/* Orthogonal in its upper left n x n part: a product of rotations in each pair of axes. */
static Mat4 random_orthogonal(int n)
{
    Mat4 q = mat4_identity();
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) {
            double angle = between(-PI, PI), c = cos(angle), s = sin(angle);
            for (int k = 0; k < n; k++) {
                double x = q.m[4 * k + i], y = q.m[4 * k + j];
                q.m[4 * k + i] = c * x - s * y;
                q.m[4 * k + j] = s * x + c * y;
            }
        }
    return q;
}

/* U S V of size n, whose singular values go from `largest` down to largest / condition. */
static Mat4 random_conditioned(int n, double condition, double largest)
{
    Mat4 u = random_orthogonal(n), s = mat4_identity(), v = random_orthogonal(n);
    for (int i = 0; i < n; i++) {
        double part = i == 0 ? 0 : i == n - 1 ? 1 : between(0, 1);
        s.m[5 * i] = random_sign() * largest * pow(condition, -part);
    }
    return mat4_product(mat4_product(u, s), v);
}

/* Tools: against arithmetic of 113 bits */

/* The error of an inverse, in units of condition * u (Frobenius norms) */
typedef struct InverseError {
    double condition;
    double inverse;  /* || X - A^-1 || / || A^-1 || */
    double residual; /* || X A - I || */
    double scale;    /* condition * u */
    double determinant;
} InverseError;

static InverseError inverse_error(Mat4 a, Mat4 computed, QuadMatrix *reference)
{
    QuadMatrix q = quad_from(a), x = quad_from(computed), one = quad_from(mat4_identity());
    Quad determinant = quad_inverse(&q, reference);
    assert_true(determinant != 0);
    Quad norm_squared = quad_norm_squared(reference);
    QuadMatrix difference = quad_subtract(&x, reference);
    QuadMatrix product = quad_product(&x, &q);
    QuadMatrix residual = quad_subtract(&product, &one);

    InverseError error;
    error.condition = sqrt((double)(quad_norm_squared(&q) * norm_squared));
    error.scale = error.condition * UNIT;
    error.inverse = sqrt((double)(quad_norm_squared(&difference) / norm_squared)) / error.scale;
    error.residual = sqrt((double)quad_norm_squared(&residual)) / error.scale;
    error.determinant =
        (double)quad_abs(((Quad)mat4_determinant(a) - determinant) / determinant) / error.scale;
    return error;
}

/* What refuses numbers, from these numbers. */
typedef bool Maker(const double *v, Mat4 *made);

static Mat4 matrix_of(const double *v)
{
    Mat4 a;
    memcpy(a.m, v, sizeof a.m);
    return a;
}

static bool make_unit(const double *v, Mat4 *made)
{
    Vec3 unit = {7, 7, 7};
    const bool done = vec3_normalize((Vec3){v[0], v[1], v[2]}, &unit);
    *made = mat4_scale(unit);
    return done;
}

static bool make_rotation(const double *v, Mat4 *made)
{
    return mat4_try_rotate(v[3], (Vec3){v[0], v[1], v[2]}, made);
}

static bool make_view(const double *v, Mat4 *made)
{
    return mat4_try_look_at((Vec3){v[0], v[1], v[2]}, (Vec3){v[3], v[4], v[5]},
                            (Vec3){v[6], v[7], v[8]}, made);
}

static bool make_perspective(const double *v, Mat4 *made)
{
    return mat4_try_perspective(v[0], v[1], v[2], v[3], made);
}

static bool make_ortho(const double *v, Mat4 *made)
{
    return mat4_try_ortho((MatrixSides){v[0], v[1], v[2], v[3], v[4], v[5]}, made);
}

static bool make_frustum(const double *v, Mat4 *made)
{
    return mat4_try_frustum((MatrixSides){v[0], v[1], v[2], v[3], v[4], v[5]}, made);
}

static bool make_inverse(const double *v, Mat4 *made)
{
    return mat4_inverse(matrix_of(v), made);
}

static bool make_normal(const double *v, Mat4 *made)
{
    return mat4_try_normal(matrix_of(v), made);
}

static const Mat4 NONE = {{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}};

static void assert_refused(Maker *make, const double *v, Mat4 instead)
{
    Mat4 made = mat4_scale((Vec3){7, 7, 7});
    if (make(v, &made))
        print_matrix("made", made);
    assert_matrix(made, instead, 0);
    assert_false(make(v, &made));
}

TEST_WITH(0, what_is_not_finite_is_refused, start_random, NULL)
{
    static const double bad[] = {INFINITY, -INFINITY, NAN};
    static const struct {
        Maker *make;
        int count;
        double good[16];
        bool nothing; /* is made instead, not the identity */
        bool endless; /* the last number may be infinite */
    } makers[] = {
        {make_unit, 3, {1, 2, 3}, true, false},
        {make_rotation, 4, {1, 2, 3, 40}, false, false},
        {make_view, 9, {1, 2, 3, 4, 5, 7, 0, 1, 0}, false, false},
        {make_ortho, 6, {-1, 2, -3, 4, 5, 6}, false, false},
        {make_perspective, 4, {60, 1, 1, 2}, false, true},
        {make_frustum, 6, {-1, 2, -3, 4, 5, 6}, false, true},
        {make_inverse, 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, false, false},
        {make_inverse, 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2}, false, false},
        {make_normal, 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, true, false},
    };
    for (size_t k = 0; k < sizeof makers / sizeof makers[0]; k++)
        for (int i = 0; i < 3 * makers[k].count; i++) {
            double v[16];
            memcpy(v, makers[k].good, sizeof v);
            v[i / 3] = bad[i % 3];
            if (makers[k].endless && v[makers[k].count - 1] == infinity)
                continue;
            assert_refused(makers[k].make, v, makers[k].nothing ? NONE : mat4_identity());
            if (makers[k].count == 16)
                assert_true(isnan(mat4_determinant(matrix_of(v))));
        }
    assert_refused(make_rotation, (const double[]){0, 0, 0, 30}, mat4_identity());
}

/* Vectors */

TEST_WITH(0, cross_product_of_nearly_parallel_vectors_keeps_its_digits, start_random, NULL)
{
    /* (n+1)^2 - n (n+2) = 1: the products need 55 bits, so rounded ones differ by 0 or 4. */
    double n = 134217728;
    assert_true(vec3_cross((Vec3){n + 1, n, 0}, (Vec3){n + 2, n + 1, 0}).z == 1);
    for (int i = 0; i < 100000; i++) {
        Vec3 a = random_vector(), b = random_vector_of_size(-17, 0);
        b = vec3_add(vec3_scale(a, between(-2, 2)), b);
        Vec3 c = vec3_cross(a, b);
        assert_vector(vec3_cross(a, vec3_scale(a, -8)), 0, 0, 0,
                      0); /* a factor that rounds nothing */
        double values[] = {c.x, c.y, c.z};
        Quad p[] = {(Quad)a.x, (Quad)a.y, (Quad)a.z}, q[] = {(Quad)b.x, (Quad)b.y, (Quad)b.z};
        for (int j = 0; j < 3; j++) {
            int k = (j + 1) % 3, l = (j + 2) % 3;
            Quad exact = p[k] * q[l] - p[l] * q[k];
            /* 2 u of the result is the theorem of Jeannerod, Louvet and Muller. */
            assert_true(quad_abs((Quad)values[j] - exact) <= 2 * (Quad)UNIT * quad_abs(exact));
        }
    }
}

TEST_WITH(0, length_is_right_from_the_smallest_to_the_largest_number, start_random, NULL)
{
    assert_true(vec3_length((Vec3){3, 4, 12}) == 13);
    assert_true(vec3_length((Vec3){-3, 0, -4}) == 5);
    assert_true(vec3_length((Vec3){0, 0, 0}) == 0);
    double smallest = 4.9406564584124654e-324;
    assert_true(vec3_length((Vec3){0, smallest, 0}) == smallest);
    assert_true(vec3_length((Vec3){3 * smallest, 0, 4 * smallest}) == 5 * smallest);
    assert_true(vec3_length((Vec3){-DBL_MAX, 0, 0}) == DBL_MAX);
    assert_true(vec3_length((Vec3){1, 1e-300, -1e-320}) == 1);
    /* Squares, two sums and a root: less than 3 u; the rest is for the literals. */
    assert_near(vec3_length((Vec3){3e307, 4e307, 1.2e308}) / 1.3e308, 1, 4 * UNIT);
    assert_near(vec3_length((Vec3){3e-300, 4e-300, 1.2e-299}) / 1.3e-299, 1, 4 * UNIT);
    assert_true(isinf(vec3_length((Vec3){DBL_MAX, DBL_MAX, 0})));
    assert_true(isinf(vec3_length((Vec3){1, -infinity, 0})));
    assert_true(isnan(vec3_length((Vec3){not_a_number, 0, 1})));
}

TEST_WITH(0, normalize_works_at_any_finite_length, start_random, NULL)
{
    for (int i = 0; i < 20000; i++) {
        Vec3 a = random_vector(), unit;
        int exponent = (int)between(-1000, 1000);
        Vec3 scaled = {ldexp(a.x, exponent), ldexp(a.y, exponent), ldexp(a.z, exponent)};
        assert_true(vec3_normalize(scaled, &unit));
        /* Relative errors: 2 u of the sum of squares, halved by the root, 1 u there, 1 u of the
         * quotient: 3 u of the length, so 6 u of its square. */
        Quad x = (Quad)unit.x, y = (Quad)unit.y, z = (Quad)unit.z;
        assert_near((double)(x * x + y * y + z * z - 1), 0, 6 * UNIT);
        /* The components differ in direction by their own rounding only, 1 u. */
        assert_near(vec3_length(vec3_cross(unit, a)) / vec3_length(a), 0, 2 * UNIT);
        assert_true(vec3_dot(unit, a) > 0);
    }
    Vec3 unit = {7, 7, 7};
    assert_false(vec3_normalize((Vec3){0, -0.0, 0}, &unit));
    assert_vector(unit, 0, 0, 0, 0);
    assert_true(vec3_normalize((Vec3){0, -5e-324, 0}, &unit));
    assert_vector(unit, 0, -1, 0, 0);
    assert_true(vec3_normalize((Vec3){DBL_MAX, DBL_MAX, 0}, &unit));
    assert_vector(unit, sqrt(0.5), sqrt(0.5), 0, 2 * UNIT);
    assert_true(vec3_normalize((Vec3){3e-320, 0, 4e-320}, &unit));
    /* These have 12 bits: 3e-320 is rounded to a multiple of 5e-324. */
    assert_vector(unit, 0.6, 0, 0.8, 1e-4);
}

/* Simple matrices */

TEST_WITH(0, product_agrees_with_its_definition, start_random, NULL)
{
    for (int i = 0; i < 20000; i++) {
        Mat4 a, b;
        for (int j = 0; j < 16; j++) {
            a.m[j] = random_size(-9, 9);
            b.m[j] = random_size(-9, 9);
        }
        QuadMatrix p = quad_from(a), q = quad_from(b), sizes;
        QuadMatrix exact = quad_product(&p, &q), value = quad_from(mat4_product(a, b));
        for (int j = 0; j < 16; j++) {
            p.a[j / 4][j % 4] = quad_abs(p.a[j / 4][j % 4]);
            q.a[j / 4][j % 4] = quad_abs(q.a[j / 4][j % 4]);
        }
        sizes = quad_product(&p, &q);
        /* Four products and three sums in any order: at most gamma_4 = 4 u / (1 - 4 u) of the sum
         * of the terms' sizes (Higham, section 3.1). Contraction only takes roundings away. */
        Quad gamma = 4 * (Quad)UNIT / (1 - 4 * (Quad)UNIT);
        for (int j = 0; j < 16; j++) {
            Quad error = value.a[j / 4][j % 4] - exact.a[j / 4][j % 4];
            if (quad_abs(error) > gamma * sizes.a[j / 4][j % 4]) {
                print_matrix("a", a);
                print_matrix("b", b);
                fail();
            }
        }
    }
}

/* Rotation */

TEST_WITH(0, rotation_is_exact_at_multiples_of_90_degrees, start_random, NULL)
{
    const Vec3 axes[] = {{1, 0, 0},  {0, 1, 0},      {0, 0, 1},
                         {-3, 0, 0}, {0, 1e-300, 0}, {0, 0, 7e300}};
    for (int axis = 0; axis < 6; axis++) {
        Mat4 quarter, power = mat4_identity();
        assert_true(mat4_try_rotate(90, axes[axis], &quarter));
        for (int i = 1; i <= 8; i++) {
            power = mat4_product(quarter, power);
            assert_made(mat4_try_rotate(90 * i, axes[axis], &got), power, 0);
            assert_made(mat4_try_rotate(90 * i - 36000000, axes[axis], &got), power, 0);
            if (i % 4 == 0)
                assert_matrix(power, mat4_identity(), 0);
        }
        assert_made(mat4_try_rotate(-90, axes[axis], &got), mat4_transpose(quarter), 0);
    }
}

TEST_WITH(0, rotation_is_counter_clockwise_seen_from_the_tip, start_random, NULL)
{
    Mat4 r;
    assert_true(mat4_try_rotate(90, (Vec3){0, 0, 1}, &r));
    assert_vector(mat4_transform_direction(r, (Vec3){1, 0, 0}), 0, 1, 0, 0);
    assert_true(mat4_try_rotate(90, (Vec3){1, 0, 0}, &r));
    assert_vector(mat4_transform_direction(r, (Vec3){0, 1, 0}), 0, 0, 1, 0);
    assert_true(mat4_try_rotate(90, (Vec3){0, 1, 0}, &r));
    assert_vector(mat4_transform_direction(r, (Vec3){0, 0, 1}), 1, 0, 0, 0);
    /* A third of a turn about the diagonal permutes the axes. An entry is a sum of three terms of
     * at most 1.5 with an error of about 2 u each. */
    const Mat4 permutation = {{0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1}};
    assert_made(mat4_try_rotate(120, (Vec3){5, 5, 5}, &got), permutation, 8 * UNIT);
    assert_true(mat4_try_rotate(30, (Vec3){0, 0, 2}, &r));
    const Mat4 thirty = {{sqrt(0.75), 0.5, 0, 0, -0.5, sqrt(0.75), 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    assert_matrix(r, thirty, 2 * UNIT); /* sine and cosine, 1 u each, and their argument */
}

TEST_WITH(0, rotation_is_orthonormal_for_all_angles_and_axes, start_random, NULL)
{
    for (int i = 0; i < 20000; i++) {
        Vec3 axis = random_vector_of_size(-300, 300), unit;
        double degrees = random_size(-20, i % 2 ? 300 : 4);
        Mat4 r;
        assert_true(mat4_try_rotate(degrees, axis, &r));
        /* The axis has a length within 3 u of 1, its square within 6 u. The matrix has at most
         * twice that square along the axis, so 12 u there, 24 u when it is multiplied by its
         * transpose, and as much again for all other roundings. Found: 20 u. */
        assert_bound(quad_orthonormality_error(r), 48 * UNIT, r);
        assert_bound(fabs(mat4_determinant(r) - 1), 48 * UNIT, r);
        assert_true(vec3_normalize(axis, &unit));
        Vec3 fixed = mat4_transform_direction(r, unit);
        assert_vector(fixed, unit.x, unit.y, unit.z, 24 * UNIT); /* 12 u, doubled */
    }
}

TEST_WITH(0, rotation_has_the_given_angle, start_random, NULL)
{
    Mat4 r;
    for (int i = -720; i <= 720; i++) {
        assert_true(mat4_try_rotate(i * 0.5, (Vec3){0, 0, 1}, &r));
        /* The reference's argument, up to 2 PI, has an error of 2 u. */
        assert_near(r.m[0], cos(i * 0.5 * PI / 180), 16 * UNIT);
        assert_near(r.m[1], sin(i * 0.5 * PI / 180), 16 * UNIT);
    }
    /* 1e22 is an integer, and 1e22 mod 360 = 280. */
    Mat4 expected;
    assert_true(mat4_try_rotate(1e22, (Vec3){1, 2, 3}, &r));
    assert_true(mat4_try_rotate(280, (Vec3){1, 2, 3}, &expected));
    assert_matrix(r, expected, 0);
}

/* The view */

/* The guarantees of the header for every view, determined or not. The translation is R * eye with
 * three products and two sums, so gamma_3 of the sizes of its terms, and one unit more for a result
 * too small to be normal. */
static void assert_rigid(Mat4 view, Vec3 eye)
{
    QuadMatrix q = quad_from(view);
    Quad e[3] = {(Quad)eye.x, (Quad)eye.y, (Quad)eye.z};
    assert_bound(quad_orthonormality_error(view), 4e-15, view);
    for (int i = 0; i < 3; i++) {
        Quad sum = q.a[i][3], size = 0;
        for (int j = 0; j < 3; j++) {
            sum += q.a[i][j] * e[j];
            size += quad_abs(q.a[i][j] * e[j]);
        }
        Quad bound = (Quad)(3.001 * UNIT) * size + (Quad)5e-324;
        if (quad_abs(sum) > bound)
            print_matrix("view", view);
        assert_true(quad_abs(sum) <= bound);
    }
    /* det = 1 excludes reflections. */
    assert_bound(fabs(mat4_determinant(view) - 1), 4e-15, view);
    assert_true(view.m[3] == 0 && view.m[7] == 0 && view.m[11] == 0 && view.m[15] == 1);
}

TEST_WITH(0, look_at_places_eye_center_and_up_as_documented, start_random, NULL)
{
    for (int i = 0; i < 20000; i++) {
        Vec3 eye = random_vector_of_size(-3, 3);
        Vec3 center = random_vector_of_size(-3, 3);
        Vec3 up = random_vector_of_size(-3, 3);
        Mat4 view;
        assert_true(mat4_try_look_at(eye, center, up, &view));
        assert_rigid(view, eye);
        double size = vec3_length(eye) + vec3_length(center);
        Vec3 origin = mat4_transform_point(view, eye), middle = mat4_transform_point(view, center);
        Vec3 tip = mat4_transform_direction(view, up);
        /* Rows within 4e-15 of what they should be, times what they are applied to; as much again
         * for applying them. */
        assert_vector(origin, 0, 0, 0, 8e-15 * size);
        assert_vector(middle, 0, 0, -vec3_length(vec3_subtract(center, eye)), 8e-15 * size);
        assert_near(tip.x, 0, 8e-15 * vec3_length(up));
        assert_true(tip.y > 0);
    }
}

TEST_WITH(0, look_at_is_orthonormal_when_up_is_nearly_parallel_to_the_view, start_random, NULL)
{
    for (int i = 0; i < 20000; i++) {
        Vec3 eye = random_vector(), view, across, up;
        assert_true(vec3_normalize(random_vector(), &view));
        assert_true(vec3_normalize(vec3_cross(view, random_vector()), &across));
        double angle = random_power(-16, 0);
        up = vec3_add(vec3_scale(view, random_sign() * cos(angle)), vec3_scale(across, sin(angle)));
        Mat4 result = mat4_look_at(eye, vec3_add(eye, view), up);
        assert_rigid(result, eye);
        /* From the origin the view is not rounded, and `up` is parallel only by its own rounding:
         * where the angle is well above that, all is determined. */
        bool determined = mat4_try_look_at((Vec3){0, 0, 0}, view, up, &result);
        assert_true(determined || angle < 4 * UNIT);
        assert_rigid(result, (Vec3){0, 0, 0});
        /* Only the rounding of `up` turns the picture about the view: at most 2.3e-16 in each
         * component, with that of its terms. */
        if (determined)
            assert_bound(fabs(mat4_transform_direction(result, across).x), 8e-16 / angle + 8e-16,
                         result);
    }
}

TEST_WITH(0, look_at_replaces_an_up_that_is_zero_or_parallel, start_random, NULL)
{
    const Vec3 eye = {1, 2, 3}, zero = {0, 0, 0};
    const Vec3 views[] = {{1, 2, 3}, {3, 1, 2}, {2, 3, 1}, {0, 5, 0}, {0, 0, -2}, {-1, -1, -1}};
    const Vec3 instead[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}, {0, 1, 0}, {0, 1, 0}};
    const double factors[] = {0, 1, -1, 3, -7, 1e-300, 1e300};
    for (int i = 0; i < 6; i++) {
        Mat4 expected, value;
        assert_true(mat4_try_look_at(eye, vec3_add(eye, views[i]), instead[i], &expected));
        assert_false(mat4_try_look_at(eye, vec3_add(eye, views[i]), zero, &value));
        assert_rigid(value, eye);
        /* Two ways to the same unit vectors, each within 4e-15 of them; times an eye of length 4.
         */
        assert_matrix(value, expected, 3e-14);
        for (int j = 0; j < 5; j++) { /* factors that do not round */
            Vec3 up = vec3_scale(views[i], factors[j]);
            assert_false(mat4_try_look_at(eye, vec3_add(eye, views[i]), up, &value));
            assert_matrix(value, expected, 3e-14);
        }
    }
    /* Integers: exactly parallel, though their unit vectors round apart. */
    for (int i = 0; i < 10000; i++) {
        Vec3 view = vec3_scale(random_vector(), 1000);
        view = (Vec3){round(view.x), round(view.y), round(view.z)};
        Vec3 up = vec3_scale(view, round(between(-1000, 1000)));
        Mat4 value;
        assert_false(mat4_try_look_at(eye, vec3_add(eye, view), up, &value));
        assert_rigid(value, eye);
    }
    for (int j = 1; j < 7; j++) {
        Mat4 value;
        assert_false(mat4_try_look_at(eye, zero, vec3_scale(zero, factors[j]), &value));
        assert_false(mat4_try_look_at((Vec3){0, 0, 5}, zero, (Vec3){0, 0, factors[j]}, &value));
        assert_matrix(value, mat4_translate((Vec3){0, 0, -5}), 0);
    }
}

TEST_WITH(0, look_at_from_the_center_itself_looks_along_minus_z, start_random, NULL)
{
    const Vec3 eye = {1, 2, 3}, ups[] = {{0, 9, 1}, {0, 0, 0}, {0, 0, 1}};
    Mat4 view;
    for (int i = 0; i < 3; i++) {
        assert_false(mat4_try_look_at(eye, eye, ups[i], &view));
        assert_matrix(view, mat4_translate((Vec3){-1, -2, -3}), 0);
    }
    assert_false(mat4_try_look_at(eye, eye, (Vec3){-1, 0, 0}, &view));
    assert_rigid(view, eye);
    assert_vector(mat4_transform_direction(view, (Vec3){-1, 0, 0}), 0, 1, 0, 0);
}

TEST_WITH(0, look_at_takes_any_finite_size, start_random, NULL)
{
    const double sizes[] = {5e-324, 1e-310, 1e-300, 1e-160, 1e160, 1e300, 0.99 * DBL_MAX};
    for (int i = 0; i < 7; i++)
        for (int j = 0; j < 7; j++) {
            Vec3 eye = {sizes[i], 0, 0}, center = {-sizes[i], 0, 0}, up = {0, sizes[j], 0};
            const Mat4 expected = {{0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, -sizes[i], 1}};
            Mat4 view;
            assert_true(mat4_try_look_at(eye, center, up, &view));
            assert_matrix(view, expected, 0);
            for (int k = 0; k < 200; k++) {
                eye = vec3_scale(random_vector(), sizes[i]);
                center = vec3_scale(random_vector(), sizes[j]);
                up = vec3_scale(random_vector(), sizes[k % 7]);
                view = mat4_look_at(eye, center, up);
                if (vec3_length(eye) < DBL_MAX)
                    assert_rigid(view, eye);
            }
        }
    /* Partial sums of the translation overflow, the translation does not. */
    Vec3 eye = {DBL_MAX, DBL_MAX, -DBL_MAX}, center = {-DBL_MAX, -DBL_MAX, -DBL_MAX};
    Mat4 view;
    assert_true(mat4_try_look_at(eye, center, (Vec3){0, 0, 1}, &view) == false ||
                isfinite(view.m[12] + view.m[13]));
    assert_true(
        mat4_try_look_at((Vec3){1e308, 1e308, -1e308}, (Vec3){0, 0, 0}, (Vec3){1, 0, 0}, &view));
    assert_rigid(view, (Vec3){1e308, 1e308, -1e308});
    /* The translation overflows: the eye is 3e308 from the origin. */
    eye = (Vec3){DBL_MAX, DBL_MAX, DBL_MAX};
    assert_false(mat4_try_look_at(eye, (Vec3){0, 0, 0}, (Vec3){0, 1, 0}, &view));
    assert_matrix(view, mat4_identity(), 0);
}

/* Projections */

/* Depth of a point at this distance ahead, with coordinates divided by 16 so that the largest
 * distances do not overflow. */
static double depth_of(Mat4 projection, double distance)
{
    Vec4 v = mat4_transform(projection, (Vec4){0, 0, -distance / 16, 1.0 / 16});
    return v.z / v.w;
}

TEST_WITH(0, perspective_has_its_closed_forms, start_random, NULL)
{
    Mat4 p;
    assert_true(mat4_try_perspective(90, 2, 1, 3, &p));
    const Mat4 expected = {{0.5, 0, 0, 0, 0, 1, 0, 0, 0, 0, -2, -1, 0, 0, -3, 0}};
    assert_matrix(p, expected, 4 * UNIT); /* the tangent of 45 degrees, and quotients of thirds */
    assert_true(mat4_try_perspective(60, 1, 1, 3, &p));
    assert_near(p.m[5], sqrt(3), 8 * UNIT);
    /* Close to 180 degrees the cotangent is the complement's radians: 2^-20 degrees is exact. */
    assert_true(mat4_try_perspective(180 - ldexp(1, -19), 1, 1, 3, &p));
    assert_near(p.m[5] / tan(ldexp(PI, -20) / 180), 1, 4 * UNIT);
    assert_true(mat4_try_perspective(1e-300, 1, 1, 3, &p));
    assert_near(p.m[5] / (360 / PI / 1e-300), 1, 8 * UNIT);
}

TEST_WITH(0, perspective_without_a_far_plane_is_the_limit, start_random, NULL)
{
    Mat4 p, f, limit;
    assert_true(mat4_try_perspective(50, 1.5, 0.1, infinity, &p));
    assert_true(p.m[10] == -1 && p.m[14] == -0.2);
    assert_near(depth_of(p, 0.1), -1, 2 * UNIT);
    assert_near(depth_of(p, 1e300), 1, 0);
    assert_true(mat4_transform(p, (Vec4){0, 0, -1, 0}).z == 1);
    assert_true(mat4_try_perspective(50, 1.5, 0.1, 1e300, &limit));
    assert_matrix(p, limit, 0);
    assert_true(mat4_try_frustum((MatrixSides){-1, 2, -3, 4, 0.1, infinity}, &f));
    assert_true(f.m[10] == -1 && f.m[14] == -0.2);
}

TEST_WITH(0, perspective_maps_near_and_far_to_minus_and_plus_one, start_random, NULL)
{
    for (int i = 0; i < 20000; i++) {
        double near = random_power(-300, 290), far = near * (1 + random_power(-1, 15));
        double fovy = between(1, 179), aspect = random_power(-2, 2);
        Mat4 p, f;
        assert_true(mat4_try_perspective(fovy, aspect, near, far, &p));
        /* Both terms of the depth are at most 2 / (1 - near / far) <= 22, with 4 u each. */
        assert_near(depth_of(p, near), -1, 1e-14);
        assert_near(depth_of(p, far), 1, 1e-14);
        /* A tangent, its argument, a product and a quotient on either side. */
        double y = near * tan(fovy * PI / 360), x = aspect * y;
        if (y == 0 || x < 1e-300)
            continue;
        double sloppy = 8 * UNIT / cos(fovy * PI / 360);
        Vec3 corner = mat4_transform_point(p, (Vec3){x, y, -near});
        assert_near(corner.x, 1, sloppy + 16 * UNIT);
        assert_near(corner.y, 1, sloppy + 16 * UNIT);
        assert_true(mat4_try_frustum((MatrixSides){-x, x, -y, y, near, far}, &f));
        for (int j = 0; j < 16; j++)
            assert_near(f.m[j], p.m[j], (sloppy + 16 * UNIT) * fabs(p.m[j]));
    }
    /* A thin slice: the depth loses what 1 - near / far = 1e-9 takes from its terms. */
    Mat4 p;
    assert_true(mat4_try_perspective(60, 1, 1, 1 + 1e-9, &p));
    assert_near(depth_of(p, 1), -1, 16 * UNIT / 1e-9);
    assert_near(depth_of(p, 1 + 1e-9), 1, 16 * UNIT / 1e-9);
    /* Neither the sum nor the product of the planes overflows. */
    assert_true(mat4_try_perspective(90, 1, 5e307, 1.7e308, &p));
    assert_near(depth_of(p, 5e307), -1, 1e-14);
    assert_near(depth_of(p, 1.7e308), 1, 1e-14);
}

TEST_WITH(0, perspective_refuses_what_is_out_of_range, start_random, NULL)
{
    /* The last four: the cotangent overflows, its quotient by the aspect, 2 near far / (far -
     * near), 2 near. */
    const double bad[][4] = {{0, 1, 1, 2},
                             {-0.0, 1, 1, 2},
                             {-60, 1, 1, 2},
                             {180, 1, 1, 2},
                             {270, 1, 1, 2},
                             {360, 1, 1, 2},
                             {60, 0, 1, 2},
                             {60, -1, 1, 2},
                             {60, 1, 1, 1},
                             {60, 1, 2, 1},
                             {60, 1, 0, 1},
                             {60, 1, -1, 1},
                             {60, 1, infinity, infinity},
                             {1e-320, 1, 1, 2},
                             {1, 1e-308, 1, 2},
                             {60, 1, 1.6e308, 1.7e308},
                             {60, 1, 1.6e308, infinity}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_refused(make_perspective, bad[i], mat4_identity());
}

TEST_WITH(0, frustum_and_ortho_map_their_corners_to_the_unit_cube, start_random, NULL)
{
    for (int i = 0; i < 20000; i++) {
        /* Middles at most 10 radii off and far / near at least 1.1, so no difference loses more
         * than a factor of 22: six roundings of such terms. */
        double width = random_size(-9, 9), left = width * between(-5, 5);
        double height = random_size(-9, 9), bottom = height * between(-5, 5);
        double near = random_power(-9, 9), far = near * (1 + random_power(-1, 9));
        double tolerance = 6 * 22 * UNIT, right = left + width, top = bottom + height;
        Mat4 p, o;
        assert_true(mat4_try_frustum((MatrixSides){left, right, bottom, top, near, far}, &p));
        assert_true(mat4_try_ortho((MatrixSides){left, right, bottom, top, near, far}, &o));
        double grow = far / near;
        assert_vector(mat4_transform_point(p, (Vec3){left, bottom, -near}), -1, -1, -1, tolerance);
        assert_vector(mat4_transform_point(p, (Vec3){right * grow, top * grow, -far}), 1, 1, 1,
                      tolerance);
        assert_vector(mat4_transform_point(o, (Vec3){left, bottom, -near}), -1, -1, -1, tolerance);
        assert_vector(mat4_transform_point(o, (Vec3){right, top, -far}), 1, 1, 1, tolerance);
        assert_true(mat4_try_ortho((MatrixSides){left, right, bottom, top, far, -near}, &o));
        assert_vector(mat4_transform_point(o, (Vec3){right, top, -far}), 1, 1, -1, tolerance);
        assert_vector(mat4_transform_point(o, (Vec3){left, bottom, near}), -1, -1, 1, tolerance);
    }
    /* right - left overflows, the coefficients do not. */
    Mat4 p;
    assert_made(mat4_try_ortho((MatrixSides){-1.7e308, 1.7e308, -1, 1, -1.7e308, 1.7e308}, &got),
                mat4_scale((Vec3){1 / 1.7e308, 1, -1 / 1.7e308}), 0);
    assert_true(mat4_try_ortho((MatrixSides){1e308, 1.5e308, -1.5e308, -1e308, -1, 1}, &p));
    assert_vector(mat4_transform_point(p, (Vec3){1e308, -1e308, 0}), -1, 1, 0, 32 * UNIT);
    assert_true(mat4_try_frustum(
        (MatrixSides){-1.7e308, 1.7e308, -1.7e308, 1.7e308, 1.7e307, infinity}, &p));
    assert_near(p.m[0], 0.1, UNIT);
    assert_near(p.m[5], 0.1, UNIT);
    assert_true(p.m[8] == 0 && p.m[9] == 0 && p.m[10] == -1);
}

TEST_WITH(0, frustum_and_ortho_refuse_empty_or_infinite_volumes, start_random, NULL)
{
    Mat4 p;
    const double empty[][6] = {{2, 2, -3, 4, 5, 6},
                               {-1, 2, 4, 4, 5, 6},
                               {-1, 2, -3, 4, 5, 5},
                               {0, -0.0, -3, 4, 5, 6},
                               {-infinity, infinity, -3, 4, 5, 6},
                               {0, 1e-320, -1, 1, 5, 6},
                               {5e-324, 5e-324, -1, 1, 5, 6},
                               {DBL_MAX, DBL_MAX, -1, 1, 5, 6}};
    for (size_t i = 0; i < sizeof empty / sizeof *empty; i++) {
        assert_refused(make_ortho, empty[i], mat4_identity());
        assert_refused(make_frustum, empty[i], mat4_identity());
    }
    const double planes[][2] = {{0, 1}, {-1, 1}, {2, 1}, {infinity, infinity}};
    for (int i = 0; i < 4; i++)
        assert_false(mat4_try_frustum((MatrixSides){-1, 1, -1, 1, planes[i][0], planes[i][1]}, &p));
    assert_true(
        mat4_try_ortho((MatrixSides){1, -1, 1, -1, 2, 1}, &p)); /* mirrored, but not empty */
}

/* Transformation */

TEST_WITH(0, transform_multiplies_columns, start_random, NULL)
{
    const Mat4 a = {{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}};
    Vec4 v = mat4_transform(a, (Vec4){1, -1, 2, 3});
    assert_true(v.x == 53 && v.y == 58 && v.z == 63 && v.w == 68);
    assert_vector(mat4_transform_direction(a, (Vec3){1, -1, 2}), 14, 16, 18, 0);
    Vec3 point = mat4_transform_point(a, (Vec3){1, -1, 2}); /* (27, 30, 33) / 36 */
    assert_vector(point, 0.75, 30 / 36.0, 33 / 36.0, 0);
    Mat4 affine = mat4_product(mat4_translate((Vec3){1, 2, 3}), mat4_scale((Vec3){2, 2, 2}));
    assert_vector(mat4_transform_point(affine, (Vec3){1, 1, 1}), 3, 4, 5, 0);
    assert_vector(mat4_transform_direction(affine, (Vec3){1, 1, 1}), 2, 2, 2, 0);
}

TEST_WITH(0, transform_of_a_point_at_infinity_is_infinite, start_random, NULL)
{
    Mat4 p;
    assert_true(mat4_try_frustum((MatrixSides){-1, 1, -1, 1, 1, infinity}, &p));
    Vec3 point = mat4_transform_point(p, (Vec3){1, -1, 0});
    assert_true(isinf(point.x) && isinf(point.y) && isinf(point.z));
    assert_true((point.x > 0) != (point.y > 0));
}

/* Determinant */

TEST_WITH(0, determinant_overflows_only_if_the_result_does, start_random, NULL)
{
    assert_near(mat4_determinant(mat4_scale((Vec3){1e300, 1e-300, 1})), 1, 4 * UNIT);
    assert_near(mat4_determinant(mat4_scale((Vec3){1e-200, 1e300, 1e-100})), 1, 4 * UNIT);
    assert_true(mat4_determinant(mat4_scale((Vec3){1e300, -1e300, 1})) == -infinity);
    assert_true(mat4_determinant(mat4_scale((Vec3){1e-300, 1e-300, 1})) == 0);
    /* t^4 - 3 t^2 s^2, whose product of pivots is 1e400 times less without its powers of two */
    const double s = 1e100, t = 1e-70;
    const Mat4 arrow = {{t, s, s, s, s, t, 0, 0, s, 0, t, 0, s, 0, 0, t}};
    assert_near(mat4_determinant(arrow) / -3e60, 1, 32 * UNIT);
}

/* Inverse */

static void assert_no_inverse(Mat4 a)
{
    assert_refused(make_inverse, a.m, mat4_identity());
}

TEST_WITH(0, inverse_has_no_threshold, start_random, NULL)
{
    const double factors[][3] = {{1e-300, 1e-300, 1e-300}, {1e300, 1e300, 1e300},
                                 {1e300, 1e-300, 1},       {1e-200, 1e-200, 1},
                                 {1e-300, -1e300, 1e300},  {-1, 1e-150, 1e200},
                                 {1e-307, 1e-307, 1e-307}, {1e307, 1e-307, -1e-307}};
    for (size_t i = 0; i < sizeof factors / sizeof *factors; i++) {
        const double *f = factors[i];
        for (int bottom = 1; bottom <= 2; bottom++) { /* affine; not affine */
            Mat4 a = mat4_scale((Vec3){f[0], f[1], f[2]}), inverse;
            a.m[15] = bottom;
            assert_true(mat4_inverse(a, &inverse));
            /* A cofactor, the determinant and the quotient take five roundings, of 1 u each. */
            for (int j = 0; j < 3; j++)
                assert_near(inverse.m[5 * j] * f[j], 1, 6 * UNIT);
            assert_true(inverse.m[15] == 1.0 / bottom);
        }
    }
    Mat4 inverse;
    assert_true(mat4_inverse(mat4_product(mat4_translate((Vec3){1e-290, 2e10, -3}),
                                          mat4_scale((Vec3){1e-300, 1e300, 1})),
                             &inverse));
    assert_near(inverse.m[12] / -1e10, 1, 8 * UNIT);
    assert_near(inverse.m[13] / -2e-290, 1, 8 * UNIT);
    assert_near(inverse.m[14] / 3, 1, 8 * UNIT);
}

/* Powers of two in rows and columns change no digit of the cofactors, and in the elimination only
 * which rows are pivots. */
TEST_WITH(0, inverse_is_independent_of_the_scale_of_rows_and_columns, start_random, NULL)
{
    for (int i = 0; i < 5000; i++) {
        Mat4 affine = random_conditioned(3, random_power(0, 3), 1), dense;
        for (int j = 0; j < 16; j++)
            dense.m[j] = between(0.25, 1) * (j % 3 ? 1 : -1);
        Mat4 scaled_affine = affine, scaled_dense = dense, inverse, scaled_inverse;
        int row[4] = {0}, column[4] = {0};
        for (int j = 0; j < 3; j++) {
            row[j] = (int)between(-450, 450);
            column[j] = (int)between(-450, 450);
        }
        for (int j = 0; j < 16; j++) {
            scaled_affine.m[j] = ldexp(affine.m[j], row[j % 4] + column[j / 4]);
            scaled_dense.m[j] = ldexp(dense.m[j], row[j % 4] + column[j / 4]);
        }
        assert_true(mat4_inverse(affine, &inverse));
        assert_true(mat4_inverse(scaled_affine, &scaled_inverse));
        for (int j = 0; j < 16; j++)
            assert_true(scaled_inverse.m[j] == ldexp(inverse.m[j], -row[j / 4] - column[j % 4]));

        assert_true(mat4_inverse(scaled_dense, &scaled_inverse));
        for (int j = 0; j < 16; j++)
            scaled_inverse.m[j] = ldexp(scaled_inverse.m[j], row[j / 4] + column[j % 4]);
        QuadMatrix reference;
        InverseError error = inverse_error(dense, scaled_inverse, &reference);
        /* What the test of random matrices allows, for a condition that is up to 16 times as large:
         * the entries are within a factor of 4, so the powers of two that are found differ from
         * those put in by no more, in rows and in columns. */
        assert_bound(error.inverse, 16 * 12, scaled_dense);
    }
}

TEST_WITH(0, inverse_refuses_singular_matrices, start_random, NULL)
{
    const Mat4 bad[] = {{{0}},
                        NONE,
                        {{1, 2, 3, 0, 2, 4, 6, 0, 3, 6, 9, 0, 1, 2, 3, 1}}, /* rank 1 */
                        {{1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 0, 0, 0, 1}}, /* rank 2 */
                        {{1, 2, 3, 4, 2, 4, 6, 8, 1, 1, 1, 1, 5, 0, 2, 9}}, /* dense */
                        mat4_scale((Vec3){1, 0, 1}),
                        mat4_scale((Vec3){1e300, 0, 1e300})};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_no_inverse(bad[i]);
    for (int i = 0; i < 4; i++) { /* a column, a row of zeros */
        Mat4 a = random_matrix();
        for (int j = 0; j < 4; j++)
            a.m[4 * i + j] = 0;
        assert_no_inverse(a);
        assert_no_inverse(mat4_transpose(a));
    }
}

TEST_WITH(0, inverse_refuses_to_be_infinite, start_random, NULL)
{
    /* Finite, but with an inverse that is not: 1e310, and 1e300 * 1e300. */
    assert_no_inverse(mat4_scale((Vec3){1e-310, 1, 1}));
    assert_no_inverse(
        mat4_product(mat4_translate((Vec3){1e300, 0, 0}), mat4_scale((Vec3){1e-300, 1, 1})));
    Mat4 general = mat4_scale((Vec3){1e-310, 1, 1});
    general.m[15] = 2;
    assert_no_inverse(general);
}

/* Normals */

static void assert_normal_form(Mat4 normal)
{
    double squares = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            squares += normal.m[4 * i + j] * normal.m[4 * i + j];
    assert_near(squares, 3, 24 * UNIT); /* twice the 4 u of an entry and those of the sum */
    for (int i = 0; i < 3; i++)
        assert_true(normal.m[4 * i + 3] == 0 && normal.m[12 + i] == 0);
    assert_true(normal.m[15] == 1);
}

static Vec3 normal_through(Mat4 a, Vec3 n)
{
    Mat4 normal;
    Vec3 unit;
    assert_true(mat4_try_normal(a, &normal));
    assert_normal_form(normal);
    assert_true(vec3_normalize(mat4_transform_direction(normal, n), &unit));
    return unit;
}

/* N = M if M is orthogonal: a rotation or, one time in two, with a reflection in a random plane;
 * of any uniform scale the rotation remains. */
TEST_WITH(0, normal_matrix_of_an_orthogonal_matrix_is_the_matrix, start_random, NULL)
{
    for (int i = 0; i < 1000; i++) {
        Mat4 m, normal;
        Vec3 axis = random_vector(), unit;
        assert_true(mat4_try_rotate(between(-180, 180), axis, &m));
        assert_true(vec3_normalize(random_vector(), &unit));
        const double n[3] = {unit.x, unit.y, unit.z};
        Mat4 mirror = mat4_identity();
        for (int k = 0; k < 9 && i % 2; k++) /* Householder's */
            mirror.m[k / 3 * 4 + k % 3] -= 2 * n[k / 3] * n[k % 3];
        m = mat4_product(mirror, m);
        const double size = random_power(-100, 100);
        const Mat4 sized = mat4_product(m, mat4_scale((Vec3){size, size, size}));
        assert_true(mat4_try_normal(m, &normal));
        assert_normal_form(normal);
        for (int j = 0; j < 12; j++) /* the 24 u of m, in cofactors of two products */
            assert_near(normal.m[j], m.m[j], 96 * UNIT);
        assert_true(mat4_try_normal(sized, &normal));
        for (int j = 0; j < 12; j++)
            assert_near(normal.m[j], m.m[j], 96 * UNIT);
    }
    const Mat4 swap = {{0, 1, 0, 0, 0, 0, -1, 0, 1, 0, 0, 0, 0, 0, 0, 1}};
    assert_matrix(mat4_normal(swap), swap, 0);
    assert_matrix(mat4_normal(mat4_scale((Vec3){-1, 1, 1})), mat4_scale((Vec3){-1, 1, 1}), 0);
}

TEST_WITH(0, normal_matrix_exists_for_a_flattened_model, start_random, NULL)
{
    const Vec3 n = {0.6, 0, 0.8};
    assert_vector(normal_through(mat4_scale((Vec3){1, 1, 0}), n), 0, 0, 1, 0);
    assert_vector(normal_through(mat4_scale((Vec3){1e300, 1e-300, 0}), n), 0, 0, 1, 0);
    assert_vector(normal_through(mat4_scale((Vec3){0, 1e-300, 1e-300}), n), 1, 0, 0, 0);
    assert_vector(normal_through(mat4_scale((Vec3){-1, 1, 0}), n), 0, 0, -1, 0);
    /* A shear onto z = 0, cofactor (1 * 2 - 0) of z alone */
    const Mat4 shear = {{1, 0, 0, 0, 3, 2, 0, 0, 5, 7, 0, 0, 0, 0, 0, 1}};
    assert_vector(normal_through(shear, n), 0, 0, 1, 0);
    /* Rank 2 with its kernel on no axis: cofactors -3 6 -3, 6 -12 6, -3 6 -3, exact, whose squares
     * add up to 324; two roundings. */
    const Mat4 rank_two = {{1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 0, 0, 0, 1}};
    const double e = 3 / sqrt(108);
    const Mat4 expected = {
        {-e, 2 * e, -e, 0, 2 * e, -4 * e, 2 * e, 0, -e, 2 * e, -e, 0, 0, 0, 0, 1}};
    assert_made(mat4_try_normal(rank_two, &got), expected, 4 * UNIT);
}

TEST_WITH(0, normal_matrix_is_independent_of_scale, start_random, NULL)
{
    const Vec3 n = {0.6, 0, 0.8};
    const double sizes[] = {1e-300, 1e-15, 1, 1e13, 1e300, 5e-324, 1.7e308};
    for (int i = 0; i < 7; i++) {
        double s = sizes[i];
        assert_vector(normal_through(mat4_scale((Vec3){s, s, s}), n), 0.6, 0, 0.8, 2 * UNIT);
        assert_vector(normal_through(mat4_scale((Vec3){s, -s, s}), n), 0.6, 0, 0.8, 2 * UNIT);
    }
    assert_vector(normal_through(mat4_scale((Vec3){1e300, 1e-300, 1}), n), 0, 0, 1, 1e-299);
    assert_vector(normal_through(mat4_scale((Vec3){1e-200, 1e-200, 1}), n), 1, 0, 0, 1e-199);
    for (int i = 0; i < 5000; i++) {
        /* D1 R D2 with factors down to 1e-130 and up to 1e130. An entry of the normal matrix is
         * then D1^-1 R D2^-1, of which each has 2 u, so a direction along an axis has them too. */
        double d1[3], d2[3];
        for (int j = 0; j < 3; j++) {
            d1[j] = ldexp(1, (int)between(-430, 430));
            d2[j] = ldexp(1, (int)between(-430, 430));
        }
        Mat4 a = mat4_product(
            mat4_product(mat4_scale((Vec3){d1[0], d1[1], d1[2]}), random_conditioned(3, 10, 1)),
            mat4_scale((Vec3){d2[0], d2[1], d2[2]}));
        Mat4 normal;
        QuadMatrix reference = quad_normal(a), value;
        assert_true(mat4_try_normal(a, &normal));
        assert_normal_form(normal);
        value = quad_from(normal);
        for (int j = 0; j < 3; j++) {
            Vec3 axis = {j == 0, j == 1, j == 2};
            if (fabs(normal.m[4 * j]) + fabs(normal.m[4 * j + 1]) + fabs(normal.m[4 * j + 2]) > 0)
                assert_bound(quad_angle(&value, &reference, axis), 4 * UNIT, a);
        }
    }
}

TEST_WITH(0, normal_matrix_refuses_rank_below_two, start_random, NULL)
{
    const Mat4 bad[] = {{{0}},
                        NONE,
                        mat4_scale((Vec3){1, 0, 0}),
                        mat4_scale((Vec3){0, 0, 1e-300}),
                        {{1, 2, 3, 0, 2, 4, 6, 0, 3, 6, 9, 0, 1, 2, 3, 1}},
                        {{0.1, 0.2, 0.3, 0, 0.4, 0.8, 1.2, 0, -0.1, -0.2, -0.3, 0, 0, 0, 0, 1}}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_refused(make_normal, bad[i].m, NONE);
}

/* Many matrices against 113 bits */

enum { MATRICES = 100000, DECADES = 12 };

typedef struct Worst {
    int count;
    double affine, affine_residual, dense, dense_residual, determinant, normal;
} Worst;

/* The error of normals in random directions and in the worst, that which the matrix shrinks most.
 */
static double normal_error(Mat4 a, const QuadMatrix *inverse)
{
    Mat4 normal;
    assert_true(mat4_try_normal(a, &normal));
    assert_normal_form(normal);
    QuadMatrix n = quad_from(normal), transposed;
    Quad sum = 0, inverse_sum = 0;
    for (int j = 0; j < 3; j++)
        for (int k = 0; k < 3; k++) {
            transposed.a[j][k] = inverse->a[k][j];
            sum += (Quad)a.m[4 * j + k] * (Quad)a.m[4 * j + k];
            inverse_sum += inverse->a[k][j] * inverse->a[k][j];
        }
    const Vec3 any = random_vector(), rare = {a.m[0], a.m[4], a.m[8]};
    return fmax(quad_angle(&n, &transposed, any), quad_angle(&n, &transposed, rare)) /
           (sqrt((double)(sum * inverse_sum)) * UNIT);
}

/*
 * The bounds, in units of condition * u with Frobenius norms, to first order.
 *
 * Affine: a cofactor has 2 u, and each of the determinant's three terms 3 u more, so that
 * determinant has 5 u of the sum of its terms, which is at most condition * |determinant|: 5. The
 * cofactors and quotients themselves: 3 u of the inverse. Its last column: 3 u of
 * || R^-1 || || t || twice, which is at most condition * || A^-1 ||. Together 5 + 3 / 4 + 6 < 12;
 * inverse * matrix has 5 sqrt(3) + 3 + 3 < 15.
 *
 * Dense: solving for an inverse has a residual of at most 3 n u || X || || L || || U || (Higham,
 * section 14.3, with n = 4), and || L || || U || is at most a small multiple of || A || unless
 * elimination lets entries grow, which with partial pivoting random matrices do not show: 12. The
 * determinant's pivots are those of a matrix that is n u off: 12 too.
 *
 * Normals: an entry has 2 u, and the shortest image of a direction is 1 / condition of the norm: 2,
 * and 1% for second order terms.
 */
TEST_WITH(0, inverse_and_normals_agree_with_higher_precision, start_random, NULL)
{
    static double errors[2][DECADES][MATRICES / DECADES]; /* of inverses, dense and linear */
    int counts[2][DECADES] = {{0}};
    Worst worst[DECADES] = {{0}};
    for (int i = 0; i < MATRICES; i++) {
        double exponent = between(0, DECADES), condition = pow(10, exponent);
        double largest = random_power(-2, 2);
        bool affine = i % 2 == 0;
        Mat4 a = random_conditioned(affine ? 3 : 4, condition, largest), inverse;
        for (int j = 12; j < 15 && i % 4 == 0; j++)
            a.m[j] = random_size(-2, 2);
        if (!mat4_inverse(a, &inverse))
            print_matrix("not inverted", a);
        assert_true(mat4_inverse(a, &inverse));
        QuadMatrix reference;
        InverseError error = inverse_error(a, inverse, &reference);
        Worst *w = &worst[(int)exponent];
        w->count++;
        if (i % 4)
            errors[affine][(int)exponent][counts[affine][(int)exponent]++] = error.inverse;
        assert_bound(error.determinant, 12, a);
        w->determinant = fmax(w->determinant, error.determinant);
        if (!affine) {
            assert_bound(error.inverse, 12, a);
            assert_bound(error.residual, 12, a);
            w->dense = fmax(w->dense, error.inverse);
            w->dense_residual = fmax(w->dense_residual, error.residual);
            continue;
        }
        assert_bound(error.inverse, 12, a);
        assert_bound(error.residual, 15, a);
        w->affine = fmax(w->affine, error.inverse);
        w->affine_residual = fmax(w->affine_residual, error.residual);
        const double angle = normal_error(a, &reference);
        assert_bound(angle, 2.02, a);
        w->normal = fmax(w->normal, angle);
    }
    print_message(
        "worst errors in units of condition * 1.1e-16, %d matrices, seed %" PRIu64 "\n"
        "condition  count  affine X-A^-1  X A - I  dense X-A^-1  X A - I  det     normal\n",
        MATRICES, seed);
    for (int i = 0; i < DECADES; i++)
        print_message("1e%-7d %7d %14.3f %8.3f %13.3f %8.3f %7.3f %7.3f\n", i, worst[i].count,
                      worst[i].affine, worst[i].affine_residual, worst[i].dense,
                      worst[i].dense_residual, worst[i].determinant, worst[i].normal);
    /* Their medians: about half of these; another seed hardly changes them. */
    for (int i = 0; i < 2 * DECADES; i++) {
        const double median = clock_median(errors[i % 2][i / 2], counts[i % 2][i / 2]);
        assert_true(median < (i < 2 ? 0.4 : i < 4 ? 0.12 : 0.054));
    }
}

/* Uploads, aliases */

TEST_WITH(0, to_float_rounds_to_nearest, start_random, NULL)
{
    Mat4 a = mat4_identity();
    float out[16], v[3];
    a.m[1] = 0.1;
    a.m[2] = 1 + ldexp(1, -24);     /* half way: to even, down */
    a.m[3] = 1 + 3 * ldexp(1, -24); /* half way: to even, up */
    a.m[4] = 1 + ldexp(1, -24) + ldexp(1, -50);
    a.m[6] = 1e300;
    a.m[7] = -1e39;
    a.m[8] = 1e-60;
    a.m[9] = 1e-45;
    a.m[14] = -16777217;
    mat4_to_float(a, out);
    assert_true(out[0] == 1 && out[5] == 1 && out[10] == 1 && out[15] == 1 && out[11] == 0);
    assert_true(out[1] == 0.1f);
    assert_true(out[2] == 1);
    assert_true(out[3] == 1 + 2 * FLT_EPSILON);
    assert_true(out[4] == 1 + FLT_EPSILON);
    assert_true(isinf(out[6]) && out[6] > 0 && isinf(out[7]) && out[7] < 0);
    assert_true(out[8] == 0 && out[9] > 0);
    assert_true(out[14] == -16777216);
    vec3_to_float((Vec3){0.1, -1e300, 16777219}, v);
    assert_true(v[0] == 0.1f && isinf(v[1]) && v[1] < 0 && v[2] == 16777220);
}

int main(void)
{
    seed = testing_seed(20240607);
    return testing_run(0, "matrix", NULL, NULL);
}
