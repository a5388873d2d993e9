/*
 * A parameter's value: kept and put back, told apart, and written so that the command line reads
 * the very same value.
 */
#include "parameter.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static double number;
static int whole, choice;
static bool on, flag;
static Vec3 color;
static const char *text;
static const char *const choices[] = {"phong", "blinn", "band", NULL};

static const Parameter NUMBER = {.name = "number",
                                 .kind = PARAMETER_NUMBER,
                                 .value = &number,
                                 .least = -DBL_MAX,
                                 .most = DBL_MAX},
                       WHOLE = {.name = "whole",
                                .kind = PARAMETER_WHOLE,
                                .value = &whole,
                                .least = INT32_MIN,
                                .most = INT32_MAX},
                       CHOICE = {.name = "choice",
                                 .kind = PARAMETER_CHOICE,
                                 .value = &choice,
                                 .choices = choices},
                       SWITCH = {.name = "switch", .kind = PARAMETER_SWITCH, .value = &on},
                       FLAG = {.name = "flag", .kind = PARAMETER_FLAG, .value = &flag},
                       COLOR = {.name = "color",
                                .kind = PARAMETER_COLOR,
                                .value = &color,
                                .least = -DBL_MAX,
                                .most = DBL_MAX},
                       TEXT = {.name = "text", .kind = PARAMETER_TEXT, .value = &text};

/* Writes the value, which is to be `expected`, and reads it back into a parameter that has another:
 * `other`. */
static void assert_written(const Parameter *parameter, const char *expected, ParameterValue other)
{
    static char written[PARAMETER_TEXT_SIZE]; /* a text that is read is kept as it is */
    Message message = {0};
    const ParameterValue value = parameter_save(parameter);
    assert_true(parameter_write(parameter, written, sizeof written));
    assert_string_equal(written, expected);
    parameter_restore(parameter, other);
    assert_false(parameter_equal(parameter, &value));
    if (!parameter_read(parameter, written, &message))
        fail_msg("%s", message.text);
    assert_true(parameter_equal(parameter, &value));
}

static void assert_left_out(const Parameter *parameter)
{
    char written[PARAMETER_TEXT_SIZE] = "something";
    assert_false(parameter_write(parameter, written, sizeof written));
    assert_string_equal(written, "");
}

static void test_numbers_in_the_fewest_digits(void **state)
{
    static const struct {
        double number;
        const char *text;
    } cases[] = {
        {0.1, "0.1"},
        {-50, "-50"},
        {100000, "100000"},
        {0.1 + 0.2, "0.30000000000000004"},
        {1.0 / 3, "0.3333333333333333"},
        {1e22, "1e+22"},
        {1e-7, "1e-07"},
        {DBL_MAX, "1.7976931348623157e+308"},
        {DBL_MIN, "2.2250738585072014e-308"},
        {9007199254740993.0, "9007199254740992"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        number = cases[i].number;
        assert_written(&NUMBER, cases[i].text, (ParameterValue){.number = 7});
    }
}

static void test_every_double_comes_back(void **state)
{
    uint64_t bits = 1;
    int tried = 0;
    (void)state;
    for (int i = 0; i < 100000; i++) {
        char written[PARAMETER_TEXT_SIZE];
        double before;
        bits = bits * 6364136223846793005U + 1442695040888963407U;
        memcpy(&before, &bits, sizeof before);
        number = before;
        if (!isfinite(before))
            continue;
        assert_true(parameter_write(&NUMBER, written, sizeof written));
        number = 0;
        assert_true(parameter_read(&NUMBER, written, NULL));
        assert_memory_equal(&number, &before, sizeof before);
        tried++;
    }
    assert_true(tried > 90000);
}

static void test_other_kinds(void **state)
{
    (void)state;
    whole = INT32_MIN;
    assert_written(&WHOLE, "-2147483648", (ParameterValue){.whole = 0});
    choice = 1;
    assert_written(&CHOICE, "blinn", (ParameterValue){.whole = 0});
    on = true;
    assert_written(&SWITCH, "on", (ParameterValue){.on = false});
    on = false;
    assert_written(&SWITCH, "off", (ParameterValue){.on = true});
    flag = true;
    assert_written(&FLAG, "", (ParameterValue){.on = false});
    color = (Vec3){0.25, 1.5, 1.0 / 3};
    assert_written(&COLOR, "0.25,1.5,0.3333333333333333", (ParameterValue){.color = {0, 0, 0}});
    color = (Vec3){0.3, 0.3, 0.3};
    assert_written(&COLOR, "0.3", (ParameterValue){.color = {0, 0.3, 0.3}});
    color = (Vec3){-DBL_MAX, -DBL_MIN, -1.0 / 3};
    assert_written(&COLOR, "-1.7976931348623157e+308,-2.2250738585072014e-308,-0.3333333333333333",
                   (ParameterValue){.color = {0, 0, 0}});
    text = "a file's name.obj";
    assert_written(&TEXT, "a file's name.obj", (ParameterValue){.text = NULL});
}

static void test_what_has_no_text_is_left_out(void **state)
{
    (void)state;
    flag = false;
    assert_left_out(&FLAG);
    text = NULL;
    assert_left_out(&TEXT);
    number = NAN;
    assert_left_out(&NUMBER);
    number = INFINITY;
    assert_left_out(&NUMBER);
    color = (Vec3){1, NAN, 1};
    assert_left_out(&COLOR);
    choice = 3;
    assert_left_out(&CHOICE);
    choice = -1;
    assert_left_out(&CHOICE);
}

static void test_no_room(void **state)
{
    char written[8];
    (void)state;
    text = "1234567";
    assert_true(parameter_write(&TEXT, written, sizeof written));
    text = "12345678";
    assert_false(parameter_write(&TEXT, written, sizeof written));
    assert_string_equal(written, "");
    color = (Vec3){0.25, 0.5, 0.75};
    assert_false(parameter_write(&COLOR, written, sizeof written));
    assert_false(parameter_write(&COLOR, NULL, 0));
}

static void test_texts_are_compared_by_their_letters(void **state)
{
    char same[] = "teapot.obj";
    const ParameterValue value = {.text = same}, none = {.text = NULL};
    (void)state;
    text = "teapot.obj";
    assert_true(parameter_equal(&TEXT, &value));
    assert_false(parameter_equal(&TEXT, &none));
    text = NULL;
    assert_false(parameter_equal(&TEXT, &value));
    assert_true(parameter_equal(&TEXT, &none));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers_in_the_fewest_digits),
        cmocka_unit_test(test_every_double_comes_back),
        cmocka_unit_test(test_other_kinds),
        cmocka_unit_test(test_what_has_no_text_is_left_out),
        cmocka_unit_test(test_no_room),
        cmocka_unit_test(test_texts_are_compared_by_their_letters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
