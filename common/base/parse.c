/* Each value is read completely or refused: "12px" is no number. */
#include "base/parse.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Digits up to PARSE_SIZE_MAX; NULL: something else. */
static const char *read_length(const char *text, int *length)
{
    int digits = 0;
    for (*length = 0; *text >= '0' && *text <= '9' && digits < 6; text++, digits++)
        *length = 10 * *length + (*text - '0');
    return *length >= 1 && *length <= PARSE_SIZE_MAX ? text : NULL;
}

bool parse_size(const char *text, int *width, int *height)
{
    int wide, high;
    const char *p = read_length(text, &wide);
    high = wide;
    if (p && (*p == 'x' || *p == 'X'))
        p = read_length(p + 1, &high);
    if (!p || *p)
        return false;
    *width = wide;
    *height = high;
    return true;
}

bool parse_number(const char *text, double min, double max, double *number)
{
    char *end;
    /* strtod also accepts blanks, hexadecimal, inf and nan. */
    const char *digits = text + (*text == '-' || *text == '+');
    if (!((*digits >= '0' && *digits <= '9') || *digits == '.') || strpbrk(text, "xX"))
        return false;
    const double value = strtod(text, &end);
    if (end == text || *end || !(value >= min && value <= max))
        return false;
    *number = value;
    return true;
}

bool parse_whole(const char *text, int min, int max, int *number)
{
    double value;
    if (!parse_number(text, min, max, &value) || value != floor(value))
        return false;
    *number = (int)value;
    return true;
}

int parse_numbers(const char *text, int most, const double *min, const double *max, double *numbers)
{
    char copy[128], *rest = copy;
    int count = 0;
    if (snprintf(copy, sizeof copy, "%s", text) >= (int)sizeof copy)
        return 0;
    for (char *part; (part = strsep(&rest, ",")) != NULL; count++)
        if (count == most || !parse_number(part, min[count], max[count], &numbers[count]))
            return 0;
    return count;
}

void parse_number_text(double number, char text[32])
{
    /* 15 digits keep every decimal of 15 digits, 17 every double. */
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, 32, "%.*g", digits, number);
        if (strtod(text, NULL) == number)
            return;
    }
}

bool parse_part(const char *text, Part *part)
{
    char number[16];
    const size_t length = strcspn(text, "/");
    snprintf(number, sizeof number, "%.*s", (int)length, text);
    return length < sizeof number && text[length] &&
           parse_whole(text + length + 1, 1, PARTS_MAX, &part->count) &&
           parse_whole(number, 1, part->count, &part->number);
}

bool part_has(Part part, uint64_t item)
{
    return part.count == 0 || item % (uint64_t)part.count == (uint64_t)part.number - 1;
}
