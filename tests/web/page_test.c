/* The pages' module (page.h), natively. What a browser draws with it is in browser_test.py. */
#include "web/page.h"

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

TEST(an_angle_is_a_time)
{
    opened("LightedCube_animation\n--size=40x40\n--angle=45");
    assert_non_null(strstr(page_values(), "\"time\": \"1.5\""));
    page_close();
}

TEST_MAIN("page", NULL, NULL)
