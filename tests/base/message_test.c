/*
 * message: long text is cut, NULL is accepted.
 */
#include "base/message.h"
#include "support/testing.h"

TEST(long_text_is_cut_and_stays_a_string)
{
    struct {
        Message message;
        char guard[16];
    } fenced = {.guard = "untouched"};
    const size_t max = sizeof fenced.message.text - 1;
    char filler[10000];
    memset(filler, 'x', sizeof filler - 1);
    filler[sizeof filler - 1] = '\0';

    message_set(&fenced.message, "%s", filler);
    assert_int_equal(strlen(fenced.message.text), max);
    message_add(&fenced.message, "%s", "more");
    assert_int_equal(strlen(fenced.message.text), max);
    assert_int_equal(strspn(fenced.message.text, "x"), max);

    /* One character short of full, then one too many. */
    fenced.message = (Message){0};
    message_set(&fenced.message, "%.*s", (int)max - 1, filler);
    message_add(&fenced.message, "yz");
    assert_int_equal(strlen(fenced.message.text), max);
    assert_int_equal(fenced.message.text[max - 1], 'y');
    assert_string_equal(fenced.guard, "untouched");
}

TEST(null_is_accepted)
{
    assert_false(message_set(NULL, "%s", "unheard"));
    assert_false(message_add(NULL, "%s", "unheard"));
}

int main(void)
{
    return testing_run(0, "message", NULL, NULL);
}
