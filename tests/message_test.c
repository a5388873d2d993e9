/*
 * message: the first message wins, long ones are cut, NULL is fine.
 */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include "message.h"

#include <string.h>

static void setting_formats_and_returns_false(void **state)
{
    (void)state;
    Message message = {0};
    assert_false(message_set(&message, "%s: %d of %s", "subject", 3, "four"));
    assert_string_equal(message.text, "subject: 3 of four");
    assert_false(message.located);
}

static void the_first_message_wins(void **state)
{
    (void)state;
    Message message = {0};
    message_set(&message, "the cause");
    assert_false(message_set(&message, "a consequence"));
    assert_string_equal(message.text, "the cause");
}

static void adding_appends_and_returns_false(void **state)
{
    (void)state;
    Message message = {0};
    assert_false(message_add(&message, "first"));
    assert_false(message_add(&message, "\n  tried %s", "second"));
    assert_string_equal(message.text, "first\n  tried second");
}

static void percent_signs_of_an_argument_are_kept(void **state)
{
    (void)state;
    Message message = {0};
    message_set(&message, "%s", "100%s%n");
    message_add(&message, "%s", "%d");
    assert_string_equal(message.text, "100%s%n%d");
}

static void long_text_is_cut_and_stays_a_string(void **state)
{
    (void)state;
    struct {
        Message message;
        char guard[16];
    } fenced = {.guard = "untouched"};
    const size_t most = sizeof fenced.message.text - 1;
    char filler[10000];
    memset(filler, 'x', sizeof filler - 1);
    filler[sizeof filler - 1] = '\0';

    message_set(&fenced.message, "%s", filler);
    assert_int_equal(strlen(fenced.message.text), most);
    message_add(&fenced.message, "%s", "more");
    assert_int_equal(strlen(fenced.message.text), most);
    assert_int_equal(strspn(fenced.message.text, "x"), most);

    /* One character short of full, then one too many. */
    fenced.message = (Message){0};
    message_set(&fenced.message, "%.*s", (int)most - 1, filler);
    message_add(&fenced.message, "yz");
    assert_int_equal(strlen(fenced.message.text), most);
    assert_int_equal(fenced.message.text[most - 1], 'y');
    assert_string_equal(fenced.guard, "untouched");
}

static void no_message_is_wanted_where_it_is_null(void **state)
{
    (void)state;
    assert_false(message_set(NULL, "%s", "unheard"));
    assert_false(message_add(NULL, "%s", "unheard"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(setting_formats_and_returns_false),
        cmocka_unit_test(the_first_message_wins),
        cmocka_unit_test(adding_appends_and_returns_false),
        cmocka_unit_test(percent_signs_of_an_argument_are_kept),
        cmocka_unit_test(long_text_is_cut_and_stays_a_string),
        cmocka_unit_test(no_message_is_wanted_where_it_is_null),
    };
    return cmocka_run_group_tests_name("message", tests, NULL, NULL);
}
