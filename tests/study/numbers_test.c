/*
 * What is concluded from results of operations: floats, halves and other numbers are told apart
 * from what they compute, whatever a driver says of them; and how errors are counted.
 */
#include "study/arithmetic/functions.h"
#include "support/testing.h"

static const Format SINGLE = {24, -126, 127, true, true, ROUNDING_NEAREST_EVEN, true, true};
static const Format HALF = {11, -14, 15, true, true, ROUNDING_NEAREST_EVEN, true, true};

/* A number of some format, as a machine with it would have it. */
static double rounded(const Format *format, double value)
{
    if (isnan(value))
        return format->nan ? value : 0;
    if (value == 0 || isinf(value))
        return value;
    const double ulp = format_ulp(format, value), least = ldexp(1, format->min_exponent);
    const double result =
        ulp * (format->rounding == ROUNDING_ZERO ? trunc(value / ulp) : rint(value / ulp));
    if (fabs(result) > format_max(format))
        return copysign(format->infinity ? (double)INFINITY : format_max(format), value);
    return fabs(result) < least && !format->denormals ? 0 : result;
}

/* As one that an operation gets. */
static double input(const Format *format, float value)
{
    Format keeps = *format;
    keeps.denormals = format->denormal_inputs;
    return rounded(&keeps, (double)value);
}

static bool found_of(const Format *machine, Format *found)
{
    FormatProbes probes;
    float sums[FORMAT_PROBES], products[FORMAT_PROBES];
    format_sums(&probes);
    for (int i = 0; i < FORMAT_PROBES; i++)
        sums[i] =
            (float)rounded(machine, input(machine, probes.x[i]) + input(machine, probes.y[i]));
    format_products(&probes);
    for (int i = 0; i < FORMAT_PROBES; i++) {
        const double product =
            rounded(machine, input(machine, probes.x[i]) * input(machine, probes.y[i]));
        products[i] = (float)rounded(machine, product * input(machine, probes.z[i]));
    }
    return format_of(sums, products, found);
}

TEST(a_machine_is_known_by_what_it_computes)
{
    const Format machines[] = {
        SINGLE,
        HALF,
        {24, -126, 127, false, false, ROUNDING_NEAREST_EVEN, true, true},
        {24, -126, 127, false, false, ROUNDING_ZERO, true, true},
        {24, -126, 127, false, true, ROUNDING_NEAREST_EVEN, true, true}, /* SSE without DAZ */
        {24, -126, 127, true, false, ROUNDING_NEAREST_EVEN, true, true},
        {17, -62, 63, false, false, ROUNDING_ZERO, true, false}, /* ATI's 24 bits, nearly */
        {11, -14, 15, false, false, ROUNDING_NEAREST_EVEN, false, false},
        {8, -126, 127, true, true, ROUNDING_NEAREST_EVEN, true, true},
        {16, -30, 31, true, true, ROUNDING_ZERO, true, true},
    };
    for (size_t i = 0; i < sizeof machines / sizeof machines[0]; i++) {
        Format found;
        assert_true(found_of(&machines[i], &found));
        if (!format_equal(&found, &machines[i]))
            fail_msg("machine %zu: %d bits, 2^%d to 2^%d, denormals %d, rounding %d, infinity %d, "
                     "NaN %d",
                     i, found.bits, found.min_exponent, found.max_exponent, found.denormals,
                     found.rounding, found.infinity, found.nan);
        assert_int_equal(format_is_half(&found), i == 1 || i == 7);
    }
}

TEST(a_driver_that_lies_is_seen_through)
{
    const Claim half = {15, 15, 10}, single = {127, 127, 23}, wide = {127, 127, 10},
                none = {0, 0, 0};
    Format found;
    char text[CLAIM_SIZE];
    assert_true(found_of(&SINGLE, &found));
    claim_text(&half, &found, text);
    assert_string_equal(text, "says 11 bits, computes with 24");
    assert_true(format_equal(&found, &SINGLE));
    claim_text(&single, &found, text);
    assert_string_equal(text, "");
    assert_true(found_of(&HALF, &found));
    claim_text(&single, &found, text);
    assert_string_equal(text, "says 24 bits, computes with 11");
    assert_true(format_equal(&found, &HALF));
    claim_text(&wide, &found, text);
    assert_string_equal(text, "says up to 2^128, computes up to 2^16");
    claim_text(&half, &found, text);
    assert_string_equal(text, "");
    claim_text(&none, &found, text);
    assert_string_equal(text, "");
}

TEST(what_is_no_floating_point_is_refused)
{
    float zeros[FORMAT_PROBES] = {0};
    Format found;
    assert_false(format_of(zeros, zeros, &found));
}

TEST(errors_are_counted_in_units_of_the_exact_result)
{
    assert_true(format_ulp(&SINGLE, 1) == 0x1p-23);
    assert_true(format_ulp(&SINGLE, 0.999) == 0x1p-24);
    assert_true(format_ulp(&HALF, 1000) == 0.5);
    assert_true(format_ulp(&HALF, 1e-7) == 0x1p-24);
    assert_true(format_max(&HALF) == 65504);
    Accuracy accuracy = {.count = 0};
    accuracy_add(&accuracy, &HALF, (float[]){3, 4}, 1000.5, 1000, 0);
    accuracy_add(&accuracy, &HALF, (float[]){5, 6}, 1, 1, 0);
    accuracy_add(&accuracy, &HALF, (float[]){7, 8}, 0.25, 0, 4); /* of a sum whose terms are 4 */
    assert_int_equal(accuracy.count, 3);
    assert_true(accuracy.largest == 64 && accuracy.at[0] == 7 && accuracy.at[1] == 8);
    assert_true(accuracy_mean(&accuracy) == 65 / 3.0);
    accuracy_add(&accuracy, &HALF, (float[]){1, 1}, 1, 1e6, 0);         /* too large for a half */
    accuracy_add(&accuracy, &HALF, (float[]){1, 1}, 1, (double)NAN, 0); /* undefined */
    accuracy_add(&accuracy, &HALF, (float[]){1, 1}, (double)INFINITY, 65000,
                 0); /* at the end of the range */
    assert_int_equal(accuracy.count, 3);
    accuracy_add(&accuracy, &HALF, (float[]){9, 1}, (double)NAN, 2, 0);
    accuracy_add(&accuracy, &HALF, (float[]){9, 1}, (double)INFINITY, 100, 0);
    assert_int_equal(accuracy.wrong, 2);
    assert_true(accuracy.at[0] == 9);
}

/* Inputs and truth. */

TEST(every_half_is_tried)
{
    static unsigned char seen[1 << 16];
    Batch *batch = malloc(sizeof *batch);
    assert_non_null(batch);
    memset(seen, 0, sizeof seen);
    assert_int_equal(batch_count(FUNCTION_EXP2, &HALF, 1L << 24), 1);
    batch_fill(batch, FUNCTION_EXP2, &HALF, 0);
    long finite = 0;
    for (int i = 0; i < 1 << 16; i++) {
        const double value = (double)batch->a[i / 4][i % 4];
        const int exponent = value == 0 ? -15 : (int)fmax(ilogb(value), -15);
        const double part =
            exponent < -14 ? fabs(value) * 0x1p24 : (fabs(value) / ldexp(1, exponent) - 1) * 1024;
        assert_true(part == floor(part) && part < 1024);
        const int bits = (signbit(value) ? 0x8000 : 0) + ((exponent + 15) << 10) + (int)part;
        finite += !seen[bits];
        seen[bits] = 1;
    }
    assert_int_equal(finite, 2 * 31 * 1024);
    free(batch);
}

TEST(inputs_are_numbers_of_the_format_and_cover_its_binades)
{
    Batch *batch = malloc(sizeof *batch);
    assert_non_null(batch);
    for (int k = 0; k < 2; k++)
        for (int function = 0; function < FUNCTION_COUNT; function += k ? 4 : 1) {
            const Format *format = k ? &SINGLE : &HALF;
            int binades[300] = {0}, count = 0;
            batch_fill(batch, (Function)function, format, 1);
            for (int i = 0; i < 4 * BATCH_COUNT; i++) {
                const double value = (double)batch->a[i / 4][i % 4];
                assert_true(fabs(value) <= format_max(format));
                assert_true(rounded(format, value) == value);
                assert_true(rounded(format, (double)batch->b[i / 4][i % 4]) ==
                            (double)batch->b[i / 4][i % 4]);
                if (value != 0)
                    count += binades[ilogb(value) + 150]++ == 0;
            }
            assert_true(FUNCTIONS[function].inputs > 2 || function == FUNCTION_SIN ||
                        function == FUNCTION_COS || function == FUNCTION_EXP2 ||
                        count >= format->max_exponent - format->min_exponent);
        }
    assert_int_equal(batch_count(FUNCTION_POW, &SINGLE, 1L << 24) * 4L * BATCH_COUNT, 1L << 24);
    free(batch);
}

TEST(the_truth_is_that_of_mpfr)
{
    Batch *batch = malloc(sizeof *batch);
    assert_non_null(batch);
    for (int function = 0; function < FUNCTION_COUNT; function++) {
        Message message = {0};
        batch_fill(batch, (Function)function, &SINGLE, 3);
        require(truth_check(batch, (Function)function, FAILURE), FAILURE);
        for (int i = 0; i < 4 * BATCH_COUNT; i++)
            batch->exact[i / 4][i % 4] *= 1 + 1e-13;
        assert_true(!truth_is_checked() || !truth_check(batch, (Function)function, &message));
    }
    free(batch);
}

TEST(a_perfect_machine_is_off_by_half_a_unit)
{
    Batch *batch = malloc(sizeof *batch);
    float(*results)[4] = malloc(sizeof(float[4]) * BATCH_COUNT);
    assert_non_null(batch);
    assert_non_null(results);
    for (int function = 0; function < FUNCTION_COUNT; function++) {
        Accuracy accuracy = {.count = 0};
        batch_fill(batch, (Function)function, &HALF, 0);
        for (int i = 0; i < 4 * BATCH_COUNT; i++)
            results[i / 4][i % 4] = (float)rounded(&HALF, batch->exact[i / 4][i % 4]);
        batch_judge(batch, (Function)function, &HALF, (const float(*)[4])results, &accuracy);
        assert_int_equal(accuracy.wrong, 0);
        assert_true(accuracy.count > 10000);
        assert_true(accuracy.largest > 0.4 && accuracy.largest <= 0.5);
        assert_true(accuracy_mean(&accuracy) < 0.26);
    }
    free(results);
    free(batch);
}

TEST_MAIN("numbers", NULL, NULL)
