/*
 * parse: numbers of the command line.
 */
#include "base/parse.h"
#include "support/testing.h"

#include <float.h>

TEST(a_number_is_finite_decimal_and_nothing_else)
{
    static const char *const bad[] = {
        "",         ".",   "-",     "+",     "e",      "nan", "NAN",   "inf", "-inf",
        "infinity", "0x1", "0X1p3", "1e400", "-1e400", " 1",  "1 ",    "\t1", "1\n",
        "1a",       "1e",  "--1",   "+-1",   "1.2.3",  "1,5", "1_000", "1f",  "\xC2\xB2"};
    double number = 42;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        if (parse_number(bad[i], -DBL_MAX, DBL_MAX, &number))
            fail_msg("accepted: \"%s\"", bad[i]);
    assert_true(number == 42);
    static const struct {
        const char *text;
        double value;
    } good[] = {{"0", 0},      {"-1.5", -1.5}, {"+2", 2},      {".5", 0.5}, {"5.", 5},
                {"1e3", 1000}, {"1E-2", 0.01}, {"-.25", -.25}, {"010", 10}, {"1e-400", 0}};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        assert_true(parse_number(good[i].text, -DBL_MAX, DBL_MAX, &number));
        assert_true(number == good[i].value);
    }
}

TEST(numbers_are_parted_by_commas)
{
    static const double min[] = {0, 0, 0}, max[] = {9, 9, 9};
    char long_one[200] = {0};
    double numbers[3];
    assert_int_equal(parse_numbers("1,2.5,3", 3, min, max, numbers), 3);
    assert_true(numbers[0] == 1 && numbers[1] == 2.5 && numbers[2] == 3);
    assert_int_equal(parse_numbers("4", 3, min, max, numbers), 1);
    assert_int_equal(parse_numbers("1,,2", 3, min, max, numbers), 0);
    assert_int_equal(parse_numbers("1,2,3,4", 3, min, max, numbers), 0);
    assert_int_equal(parse_numbers("1,10", 3, min, max, numbers), 0);
    memset(long_one, '0', sizeof long_one - 1);
    assert_int_equal(parse_numbers(long_one, 3, min, max, numbers), 0);
}

int main(void)
{
    return testing_run(0, "parse", NULL, NULL);
}
