/* Typed variables, read from words and written as words: what is written reads back as the same
 * value, in the fewest digits. */
#include "scene/parameter.h"

#include "base/parse.h"
#include "base/text.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const ON_OFF[] = {"on", "off", NULL};

const char *const *parameter_choices(const Parameter *parameter)
{
    return parameter->kind == PARAMETER_SWITCH && !parameter->choices ? ON_OFF : parameter->choices;
}

const char *parameter_placeholder(const Parameter *parameter)
{
    return parameter->placeholder || !parameter->codec ? parameter->placeholder
                                                       : parameter->codec->placeholder;
}

/* The index of a choice; -1 with a message. */
static int find_choice(const Parameter *parameter, const char *text, Message *message)
{
    const char *const *choices = parameter_choices(parameter);
    const int found = text_among(text, choices);
    if (found >= 0)
        return found;
    const char *nearest = text_nearest(text, choices);
    if (nearest)
        message_set(message, "--%s %s: there is none; did you mean %s?", parameter->name, text,
                    nearest);
    else
        message_set(message, "--%s %s: must be", parameter->name, text);
    for (int i = 0; choices[i] && !nearest; i++)
        message_add(message, "%s %s", i == 0 ? "" : choices[i + 1] ? "," : " or", choices[i]);
    return -1;
}

/* As people say it: "1 million" instead of 1000000. */
static void write_bound(double bound, char text[32])
{
    static const struct {
        double size;
        const char *name;
    } units[] = {{1e9, " billion"}, {1e6, " million"}, {1, ""}};
    int k = 0;
    while (k < 2 && (fabs(bound) < units[k].size || fmod(bound, units[k].size / 10) != 0))
        k++;
    snprintf(text, 32, "%.10g%s", bound / units[k].size, units[k].name);
}

const char *parameter_range(const Parameter *parameter, char text[PARAMETER_RANGE_SIZE])
{
    const bool whole = parameter->kind == PARAMETER_WHOLE;
    const double most = whole ? INT_MAX : (double)FLT_MAX, least = whole ? INT_MIN : -most;
    char min[32], max[32];
    write_bound(parameter->min, min);
    write_bound(parameter->max, max);
    if (parameter->min > least && parameter->max < most)
        snprintf(text, PARAMETER_RANGE_SIZE, "%s to %s", min, max);
    else if (parameter->min > least || parameter->max < most)
        snprintf(text, PARAMETER_RANGE_SIZE, parameter->min > least ? "%s or more" : "%s or less",
                 parameter->min > least ? min : max);
    else
        text[0] = '\0';
    return text;
}

static bool out_of_range(const Parameter *parameter, const char *text, const char *what,
                         Message *message)
{
    char range[PARAMETER_RANGE_SIZE];
    const char *separator = parameter->kind == PARAMETER_COLOR ? ", each " : ", ";
    parameter_range(parameter, range);
    if (parameter->kind == PARAMETER_COLOR && parameter->placeholder)
        what = parameter->placeholder;
    return message_set(message, "--%s %s: must be %s%s%s", parameter->name, text, what,
                       range[0] ? separator : "", range);
}

static bool read_color(const Parameter *parameter, const char *text)
{
    const double min[] = {parameter->min, parameter->min, parameter->min};
    const double max[] = {parameter->max, parameter->max, parameter->max};
    double values[3];
    const int count = parse_numbers(text, 3, min, max, values);
    if (count != 1 && count != 3)
        return false;
    *(Vec3 *)parameter->value = (Vec3){values[0], values[count / 2], values[count - 1]};
    return true;
}

/* `choice` is an index if the parameter has choices. */
static bool read_kind(const Parameter *parameter, const char *text, int choice, Message *message)
{
    void *value = parameter->value;
    const double min = parameter->min, max = parameter->max;
    switch (parameter->kind) {
    case PARAMETER_NUMBER:
        return parse_number(text, min, max, value) ||
               out_of_range(parameter, text, "a number", message);
    case PARAMETER_WHOLE:
        return parse_whole(text, (int)min, (int)max, value) ||
               out_of_range(parameter, text, "a whole number", message);
    case PARAMETER_COLOR:
        return read_color(parameter, text) ||
               out_of_range(parameter, text, "R,G,B or one number", message);
    case PARAMETER_CHOICE:
        *(int *)value = choice;
        return true;
    case PARAMETER_SWITCH:
    case PARAMETER_FLAG:
        *(bool *)value = choice == 0;
        return true;
    case PARAMETER_TEXT:
        *(const char **)value = parameter->choices ? parameter->choices[choice] : text;
        return min == 0 || text[0] ||
               message_set(message, "--%s: the name is empty", parameter->name);
    }
    return false;
}

bool parameter_read(const Parameter *parameter, const char *text, Message *message)
{
    const ParameterCodec *codec = parameter->codec;
    const bool choose = !codec && parameter_choices(parameter);
    const int choice = choose ? find_choice(parameter, text, message) : 0;
    if (choice < 0 || !(codec ? codec->read(parameter, text, message)
                              : read_kind(parameter, text, choice, message)))
        return false;
    if (parameter->given)
        *parameter->given = true;
    if (parameter->changed)
        parameter->changed(parameter);
    return true;
}

/* Bytes of each kind's variable. */
static const size_t SIZES[] = {
    [PARAMETER_NUMBER] = sizeof(double), [PARAMETER_WHOLE] = sizeof(int),
    [PARAMETER_CHOICE] = sizeof(int),    [PARAMETER_SWITCH] = sizeof(bool),
    [PARAMETER_FLAG] = sizeof(bool),     [PARAMETER_COLOR] = sizeof(Vec3),
    [PARAMETER_TEXT] = sizeof(char *),
};

ParameterValue parameter_save(const Parameter *parameter)
{
    ParameterValue value = {.color = {0}};
    memcpy(&value, parameter->value, SIZES[parameter->kind]);
    return value;
}

void parameter_restore(const Parameter *parameter, ParameterValue value)
{
    memcpy(parameter->value, &value, SIZES[parameter->kind]);
}

bool parameter_equal(const Parameter *parameter, const ParameterValue *value)
{
    const ParameterValue own = parameter_save(parameter);
    switch (parameter->kind) {
    case PARAMETER_NUMBER: /* 0 and -0 are equal, NaN is not */
        return own.number == value->number;
    case PARAMETER_COLOR:
        return own.color.x == value->color.x && own.color.y == value->color.y &&
               own.color.z == value->color.z;
    case PARAMETER_TEXT:
        return own.text == value->text ||
               (own.text && value->text && strcmp(own.text, value->text) == 0);
    default:
        return memcmp(&own, value, SIZES[parameter->kind]) == 0;
    }
}

static const char *write_color(Vec3 color, char buffer[PARAMETER_TEXT_SIZE])
{
    char r[32], g[32], b[32];
    if (!isfinite(color.x) || !isfinite(color.y) || !isfinite(color.z))
        return NULL;
    parse_number_text(color.x, r);
    parse_number_text(color.y, g);
    parse_number_text(color.z, b);
    const bool grey = strcmp(r, g) == 0 && strcmp(g, b) == 0;
    snprintf(buffer, PARAMETER_TEXT_SIZE, grey ? "%s" : "%s,%s,%s", r, g, b);
    return buffer;
}

const char *parameter_text(const Parameter *parameter, char buffer[PARAMETER_TEXT_SIZE])
{
    const ParameterCodec *codec = parameter->codec;
    if (codec)
        return codec->write && codec->write(parameter, buffer, PARAMETER_TEXT_SIZE) ? buffer : NULL;
    const ParameterValue value = parameter_save(parameter);
    switch (parameter->kind) {
    case PARAMETER_NUMBER:
        if (!isfinite(value.number))
            return NULL;
        parse_number_text(value.number, buffer);
        return buffer;
    case PARAMETER_WHOLE:
        snprintf(buffer, PARAMETER_TEXT_SIZE, "%d", value.whole);
        return buffer;
    case PARAMETER_CHOICE:
        for (int i = 0; parameter->choices[i]; i++)
            if (i == value.whole)
                return parameter->choices[i];
        return NULL;
    case PARAMETER_SWITCH:
        return parameter_choices(parameter)[!value.on];
    case PARAMETER_FLAG:
        return value.on ? "" : NULL;
    case PARAMETER_COLOR:
        return write_color(value.color, buffer);
    case PARAMETER_TEXT:
        return value.text;
    }
    return NULL;
}

bool parameter_write(const Parameter *parameter, char *text, size_t size)
{
    char buffer[PARAMETER_TEXT_SIZE];
    const char *written = parameter_text(parameter, buffer);
    const bool fits = written && snprintf(text, size, "%s", written) < (int)size;
    if (!fits && size > 0)
        text[0] = '\0';
    return fits;
}
