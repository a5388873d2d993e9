/*
 * Decimal numbers, read by the browser, which rounds them correctly: the C library computes with
 * 128 bits for it, in software, which is 2% of a page. The link has strtod's callers call this. One
 * call of the scanf family brings all of that in again, so what pages have calls none.
 */
#include <emscripten.h>
#include <stdbool.h>
#include <string.h>

EM_JS(double, number_of, (const char *text, int length),
      { return parseFloat(UTF8ToString(text, length)); });

double __wrap_strtod(const char *text, char **end);

static const char *after_digits(const char *text)
{
    return text + strspn(text, "0123456789");
}

double __wrap_strtod(const char *text, char **end)
{
    const char *start = text + strspn(text, " \t\n\r\f\v");
    const char *digits = start + (*start == '-' || *start == '+');
    const char *point = after_digits(digits);
    const char *after = *point == '.' ? after_digits(point + 1) : point;
    const bool found = after - digits > (*point == '.');
    if (found && (*after == 'e' || *after == 'E')) {
        const char *power = after + 1 + (after[1] == '-' || after[1] == '+');
        if (after_digits(power) > power)
            after = after_digits(power);
    }
    if (end)
        *end = (char *)(found ? after : text);
    return found ? number_of(start, (int)(after - start)) : 0;
}
