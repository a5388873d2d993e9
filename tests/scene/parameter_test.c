/*
 * A parameter's value: saved and restored, compared, and written so that the command line reads
 * exactly the same value.
 */
#include "scene/parameter.h"
#include "support/testing.h"

#include <float.h>

static double number;
static int whole, choice;
static bool on, flag;
static Vec3 color;
static const char *text;
static const char *const choices[] = {"phong", "blinn", "band", NULL};

static const Parameter
    NUMBER = {"number", NULL, PARAMETER_NUMBER, .value = &number, .min = -DBL_MAX, .max = DBL_MAX},
    WHOLE = {"whole", NULL, PARAMETER_WHOLE, .value = &whole, .min = INT32_MIN, .max = INT32_MAX},
    CHOICE = {"choice", NULL, PARAMETER_CHOICE, .value = &choice, .choices = choices},
    SWITCH = {"switch", NULL, PARAMETER_SWITCH, .value = &on},
    FLAG = {"flag", NULL, PARAMETER_FLAG, .value = &flag},
    COLOR = {"color", NULL, PARAMETER_COLOR, .value = &color, .min = -DBL_MAX, .max = DBL_MAX},
    TEXT = {"text", NULL, PARAMETER_TEXT, .value = &text};

/* Writes the value, which must be `expected`, and reads it back into a parameter that has the value
 * `other`. */
static void assert_written(const Parameter *parameter, const char *expected, ParameterValue other)
{
    static char written[PARAMETER_TEXT_SIZE]; /* text that is read is kept, not copied */
    const ParameterValue value = parameter_save(parameter);
    assert_true(parameter_write(parameter, written, sizeof written));
    assert_string_equal(written, expected);
    parameter_restore(parameter, other);
    assert_false(parameter_equal(parameter, &value));
    SUCCEEDS(parameter_read(parameter, written, message));
    assert_true(parameter_equal(parameter, &value));
}

static void assert_left_out(const Parameter *parameter)
{
    char written[PARAMETER_TEXT_SIZE] = "something";
    assert_false(parameter_write(parameter, written, sizeof written));
    assert_string_equal(written, "");
}

TEST(test_other_kinds)
{
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

TEST(test_what_has_no_text_is_left_out)
{
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

TEST(test_no_room)
{
    char written[8];
    text = "1234567";
    assert_true(parameter_write(&TEXT, written, sizeof written));
    text = "12345678";
    assert_false(parameter_write(&TEXT, written, sizeof written));
    assert_string_equal(written, "");
    color = (Vec3){0.25, 0.5, 0.75};
    assert_false(parameter_write(&COLOR, written, sizeof written));
    assert_false(parameter_write(&COLOR, NULL, 0));
}

TEST_MAIN("parameter", NULL, NULL)
