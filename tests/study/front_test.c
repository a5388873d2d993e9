/*
 * front: which rows are efficient, and which are not significantly faster.
 */
#include "study/measure/survey.h"
#include "study/results/results.h"
#include "support/testing.h"

static Results results;

/* A made-up row: its number makes its setting. */
static void add(int number, double error, double time)
{
    ResultRow row = {.scene = "s",
                     .quality = quality_usual(),
                     .interior_maximum = error,
                     .interior_rms = error,
                     .all_rms = error,
                     .time = time,
                     .run_times = {time, time, time},
                     .noise = 0.05};
    row.quality.choice[AXIS_DIVISIONS] = (unsigned char)(number % 14);
    row.quality.choice[AXIS_INTERPOLATION] = (unsigned char)(number / 14 % 3);
    row.quality.choice[AXIS_OUTPUT] = (unsigned char)(number / 42 % 3);
    results_add(&results, &row);
}

/* The front has the rows of these errors, in this order; -1: the end. */
static void front_is(const double *errors)
{
    Front front;
    int count = 0;
    front_find(&front, &results, "s", ERROR_INTERIOR_MAXIMUM);
    for (; errors[count] >= 0; count++)
        if (count >= front.count || front.rows[count]->interior_maximum != errors[count])
            fail_msg("%g is not number %d of %d", errors[count], count, front.count);
    assert_int_equal(front.count, count);
    for (int i = 0; i < front.count; i++)
        assert_false(front_ties(&front, front.rows[i]));
    for (int i = 0; i < front.tied_count; i++)
        assert_false(front_has(&front, front.tied[i]));
    front_close(&front);
    results_close(&results);
}

#define FRONT_IS(...) front_is((const double[]){__VA_ARGS__, -1})

/* As measured against each other: their times and errors, and how many unusual choices. */
static int chosen(const double rows[3][3], double noise, bool is_time)
{
    const ChooseLimit limit = {is_time, is_time ? 100 : 4, ERROR_INTERIOR_MAXIMUM};
    ResultRow made[3];
    for (int i = 0; i < 3; i++) {
        const double time = rows[i][0];
        made[i] = (ResultRow){.quality = quality_usual(),
                              .time = time,
                              .run_times = {time, time, time},
                              .noise = noise,
                              .interior_maximum = rows[i][1]};
        for (int axis = 0; axis < (int)rows[i][2]; axis++)
            made[i].quality.choice[axis] = (unsigned char)(!made[i].quality.choice[axis]);
    }
    const ResultRow *best = choose_among(made, 3, &limit);
    return best ? (int)(best - made) : -1;
}

TEST(of_tied_settings_the_usual_is_chosen)
{
    /* However much faster the median says: it is within the noise. */
    const double tied[3][3] = {{2, 1, 0}, {1.6, 1, 1}, {1.7, 1, 2}};
    assert_int_equal(chosen(tied, 0.3, false), 0);
    assert_int_equal(chosen(tied, 0.01, false), 1);
    /* The usual one is tied with the second, but surely slower than the third. */
    const double chain[3][3] = {{2, 1, 0}, {1.85, 1, 1}, {1.75, 1, 2}};
    assert_int_equal(chosen(chain, 0.1, false), 1);
    /* On a busy machine no time counts. */
    const double apart[3][3] = {{9, 1, 0}, {1, 1, 1}, {2, 1, 2}};
    assert_int_equal(chosen(apart, 0.1, false), 1);
    assert_int_equal(chosen(apart, 0.11, false), 0);
    /* Out of the budget. */
    const double inexact[3][3] = {{2, 4.1, 0}, {1.6, 4, 1}, {1.7, 1, 2}};
    assert_int_equal(chosen(inexact, 0.3, false), 1);
    assert_int_equal(chosen((const double[3][3]){{1, 5, 0}, {1, 5, 1}, {1, 5, 2}}, 0.3, false), -1);
    /* Of a time the most exact, and of those the usual. */
    assert_int_equal(chosen((const double[3][3]){{9, 1.005, 0}, {8, 1, 1}, {1, 2, 0}}, 0, true), 0);
    assert_int_equal(chosen((const double[3][3]){{9, 1.02, 0}, {8, 1, 1}, {1, 2, 0}}, 0, true), 1);
}

TEST(faster_is_more_than_the_noise_and_in_every_run)
{
    ResultRow a = {.time = 1, .run_times = {1, 1, 1}, .noise = 0.05}, b = a;
    assert_false(row_faster(&a, &b));
    b = (ResultRow){.time = 1.05, .run_times = {2, 2, 2}, .noise = 0.05};
    assert_false(row_faster(&a, &b)); /* not more than the noise */
    b.time = 1.051;
    assert_true(row_faster(&a, &b));
    assert_false(row_faster(&b, &a));
    b.noise = 0.06; /* the larger noise counts */
    assert_false(row_faster(&a, &b));
    b.noise = 0;
    assert_true(row_faster(&a, &b));
    for (int run = 0; run < RESULT_RUNS; run++) {
        ResultRow c = b;
        c.run_times[run] = 0.9;
        assert_false(row_faster(&a, &c) || row_faster(&c, &a));
        c.run_times[run] = 1;
        assert_false(row_faster(&a, &c));
        c.run_times[run] = NAN;
        assert_false(row_faster(&a, &c) || row_faster(&c, &a));
    }
    b.noise = NAN;
    assert_false(row_faster(&a, &b) || row_faster(&b, &a));
    b.noise = 0;
    b.time = NAN;
    assert_false(row_faster(&a, &b) || row_faster(&b, &a));
}

TEST(the_front_has_what_no_other_beats)
{
    FRONT_IS(-1); /* no rows */
    add(0, 3, 1);
    FRONT_IS(3);
    add(0, 3, 1), add(1, 2, 2), add(2, 1, 3), add(3, 2.5, 2.5), add(4, 1, 9), add(5, 4, 1.5);
    FRONT_IS(3, 2, 1);
    add(0, 0, 5), add(1, 0, 4), add(2, 1, 2); /* errors of zero */
    FRONT_IS(1, 0);
    add(0, 0, 0), add(1, 1, 0); /* and times */
    FRONT_IS(0);
}

TEST(among_tied_rows_the_most_exact_counts)
{
    for (int i = 0; i < 14; i++)
        add(i, 14 - i, 1 + 0.003 * i); /* within the noise of each other */
    FRONT_IS(1);
    /* A chain: each is tied with its neighbours, the first faster than the last. */
    add(0, 3, 1.00), add(1, 2, 1.04), add(2, 1, 1.08);
    FRONT_IS(3, 1);
    /* Those that the medians alone would take are called tied. */
    Front front;
    add(0, 3, 1.00), add(1, 2, 1.02), add(2, 1, 1.04), add(3, 2.5, 1.03);
    front_find(&front, &results, "s", ERROR_INTERIOR_MAXIMUM);
    assert_int_equal(front.count, 1);
    assert_int_equal(front.tied_count, 2);
    assert_true(front.tied[0]->interior_maximum == 2 && front.tied[1]->interior_maximum == 3);
    front_close(&front);
    results_close(&results);
    /* One run disagrees. */
    add(0, 3, 1), add(1, 2, 2);
    results.rows[0].run_times[1] = 2.5;
    FRONT_IS(2);
}

TEST(nearly_equal_errors_count_as_equal)
{
    add(0, 0.5, 3), add(1, 0.505, 2);
    FRONT_IS(0.505);
    add(0, 0.5, 3), add(1, 0.511, 2);
    FRONT_IS(0.511, 0.5);
    add(0, 0.5, 4), add(1, 0.507, 3), add(2, 0.514, 2); /* 0.014 apart is not equal */
    FRONT_IS(0.514, 0.5);
    /* Of rows that are equal in both, the most usual one. 7 divisions is the usual number. */
    add(8, 0.500, 2), add(7, 0.504, 2.01), add(22, 0.501, 1.99);
    FRONT_IS(0.504);
}

TEST(unknown_values_are_not_in_the_front)
{
    add(0, NAN, 1), add(1, 2, NAN), add(2, 1, 3), add(3, INFINITY, 0.1), add(4, 0, INFINITY);
    FRONT_IS(1);
    add(0, NAN, 1), add(1, 2, NAN);
    FRONT_IS(-1);
    add(0, 1, 5), add(1, 2, 3), add(0, 3, 1); /* the latest of a setting */
    FRONT_IS(3, 2);
}

/* Rows of the front do not beat each other; every other row is beaten. */
TEST(no_row_of_a_random_front_is_beaten)
{
    srand(1);
    for (int round = 0; round < 300; round++) {
        Front front;
        const int count = 1 + rand() % 100;
        for (int i = 0; i < count; i++) {
            const int coarse = 1 << rand() % 10;
            add(i, (rand() % (100 * coarse)) / (100.0 * coarse), 1 + rand() % 500 / 1000.0);
            ResultRow *row = &results.rows[i];
            for (int run = 0; run < RESULT_RUNS; run++)
                row->run_times[run] = row->time * (0.99 + rand() % 100 / 5000.0);
            row->noise = rand() % 50 / 1000.0;
        }
        front_find(&front, &results, "s", ERROR_INTERIOR_RMS);
        assert_true(front.count > 0);
        for (int i = 0; i < front.count; i++)
            for (int j = 0; j < front.count; j++)
                assert_true(i == j || !row_beats(front.rows[i], front.rows[j], ERROR_INTERIOR_RMS));
        for (int i = 0; i < front.count; i++)
            for (int j = i + 1; j < front.count; j++)
                assert_true(row_faster(front.rows[i], front.rows[j]));
        for (int i = 0; i < results.count; i++) {
            bool beaten = front_has(&front, &results.rows[i]);
            for (int j = 0; j < front.count; j++)
                beaten = beaten || row_beats(front.rows[j], &results.rows[i], ERROR_INTERIOR_RMS);
            assert_true(beaten);
        }
        front_close(&front);
        results_close(&results);
    }
}

TEST_MAIN("front", NULL, NULL)
