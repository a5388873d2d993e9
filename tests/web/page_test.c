/* The pages' module (page.h), natively. What a browser draws with it is in browser_test.py. */
#include "web/page.h"

#include "app/options.h"
#include "web/all_examples.h"
#include "support/testing.h"

#include <malloc.h>

static uint32_t drawn(double seconds)
{
    uint32_t hash = 2166136261u;
    if (!page_draw(seconds, 0, 0, 1, 0))
        fail_msg("%s", page_message());
    const unsigned char *pixels = page_pixels();
    for (size_t i = 0; i < 4 * (size_t)page_width() * (size_t)page_height(); i++)
        hash = (hash ^ pixels[i]) * 16777619u;
    return hash;
}

static void opened(const char *lines)
{
    if (page_open(lines) != 0)
        fail_msg("%s: %s", lines, page_message());
}

/* Bytes in use. */
static size_t in_use(void)
{
    return mallinfo2().uordblks;
}

TEST(opening_again_leaks_nothing)
{
    static const char *const lines =
        "Materials\n--shape=teapot\n--light-at=0,1,2,3\n--terms=diffuse";
    for (int i = 0; i < 3; i++)
        opened(lines);
    const size_t before = in_use();
    for (int i = 0; i < 10; i++)
        opened(lines);
    assert_true(in_use() < before + 65536);
    page_close();
}

TEST(a_refused_program_leaves_none_open)
{
    static const char *const refused[] = {"Materials\n--shininess=1000",
                                          "Materials\n--light-at=7,1,2,3", "Nothing",
                                          "Materials\n--angle=x", "Materials\n--model=x"};
    opened("Materials\n--size=40x40\n--light-at=0,1,2,3");
    const uint32_t right = drawn(0);
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        assert_int_equal(page_open(refused[i]), 2);
        assert_int_equal(page_draw(0, 0, 0, 1, 0), 0);
        assert_non_null(strstr(page_message(), "no program"));
        opened("Materials\n--size=40x40\n--light-at=0,1,2,3");
        assert_int_equal(drawn(0), right);
    }
    page_close();
}

/* Texts that are not the option's value, nearest to its ends; how many. */
static int other_values(const Parameter *option, char texts[][64])
{
    const char *const *choices = parameter_choices(option);
    const bool bounded = isfinite(option->min) && option->max < 1e6;
    const double ends[] = {option->min, option->max};
    int count = 0;
    if (option->kind == PARAMETER_FLAG || (option->kind == PARAMETER_TEXT && !choices))
        return 0;
    for (int i = 0; choices && choices[i] && count < 8; i++)
        snprintf(texts[count++], 64, "%s", choices[i]);
    for (int i = 0; !choices && bounded && i < 2; i++)
        if (option->kind == PARAMETER_WHOLE)
            snprintf(texts[count++], 64, "%d", (int)fmin(ends[i], 40));
        else
            snprintf(texts[count++], 64, "%.3g", ends[i]);
    return count;
}

/* What is left of an option that was set and is set no more would be drawn. */
TEST(options_that_are_set_and_unset_leave_nothing)
{
    char texts[8][64], lines[256], plain[128];
    int count = 0;
    for (int i = 0; i < COUNT; i++) {
        const Parameter *own = ALL[i]->parameters;
        snprintf(plain, sizeof plain, "%s\n--size=60x40", ALL[i]->name);
        opened(plain);
        const uint32_t fresh = drawn(1.3);
        for (; own && own->name; own++)
            for (int k = other_values(own, texts); k > 0; k--) {
                snprintf(lines, sizeof lines, "%s\n--%s=%s", plain, own->name, texts[k - 1]);
                if (page_open(lines) != 0)
                    continue;
                drawn(1.3);
                opened(plain);
                if (drawn(1.3) != fresh)
                    fail_msg("%s --%s %s: is drawn after it was unset", ALL[i]->name, own->name,
                             texts[k - 1]);
                count++;
            }
    }
    assert_true(count > 300);
    page_close();
}

/* The command on one line as what page_open takes. */
static void command_lines(const char *command, char *lines)
{
    bool quoted = false, flag = true;
    command += strlen("examples/run ");
    for (; *command; command++)
        if (*command == '\'')
            quoted = !quoted;
        else if (*command != ' ' || quoted)
            *lines++ = *command;
        else if (strncmp(command, " --", 3) == 0) {
            *lines++ = '\n';
            flag = true;
        } else {
            *lines++ = flag ? '=' : ' ';
            flag = false;
        }
    *lines = '\0';
}

/* What an option left behind is in the command, or it is not drawn. */
TEST(a_panel_draws_what_its_command_says)
{
    char texts[8][64], plain[128], lines[4096];
    for (int i = 0; i < COUNT; i++) {
        const Parameter *own = ALL[i]->parameters;
        snprintf(plain, sizeof plain, "%s\n--size=60x40", ALL[i]->name);
        for (; own && own->name; own++)
            for (int k = other_values(own, texts); k > 0; k--) {
                if (own->kind == PARAMETER_WHOLE || strcmp(own->name, "shape") == 0)
                    continue; /* of meshes, which are opened anew */
                opened(plain);
                /* As a window's panel sets and resets one of a program's own options. */
                const ParameterValue before = parameter_save(own);
                Message message = {0};
                if (parameter_read(own, texts[k - 1], &message)) {
                    parameter_restore(own, before);
                    if (own->changed)
                        own->changed(own);
                }
                const uint32_t shown = drawn(0);
                command_lines(page_command(), lines);
                opened(lines);
                if (drawn(0) != shown)
                    fail_msg("%s --%s %s, then reset: drawn is not %s", ALL[i]->name, own->name,
                             texts[k - 1], lines);
            }
    }
    page_close();
}

TEST(an_angle_is_a_time)
{
    opened("LightedCube_animation\n--size=40x40\n--angle=45");
    assert_non_null(strstr(page_values(), "\"time\": \"1.5\""));
    page_close();
}

TEST_MAIN("page", NULL, NULL)
