#include "parameter.h"

#include "parse.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool read_choice(const Parameter *parameter, const char *text, Message *message)
{
    for (int i = 0; parameter->choices[i]; i++) {
        if (strcmp(text, parameter->choices[i]) == 0) {
            *(int *)parameter->value = i;
            return true;
        }
    }
    const char *nearest = parse_nearest(text, parameter->choices);
    if (nearest)
        return message_set(message, "--%s %s: there is none; did you mean %s?", parameter->name,
                           text, nearest);
    message_set(message, "--%s %s: must be", parameter->name, text);
    for (int i = 0; parameter->choices[i]; i++)
        message_add(message, "%s %s",
                    i == 0                      ? ""
                    : parameter->choices[i + 1] ? ","
                                                : " or",
                    parameter->choices[i]);
    return false;
}

static bool read_color(const Parameter *parameter, const char *text, Vec3 *color)
{
    const double least[] = {parameter->least, parameter->least, parameter->least};
    const double most[] = {parameter->most, parameter->most, parameter->most};
    double values[3];
    const int count = parse_numbers(text, least, most, values);
    if (count != 1 && count != 3)
        return false;
    if (count == 1)
        values[1] = values[2] = values[0];
    *color = (Vec3){values[0], values[1], values[2]};
    return true;
}

bool parameter_read(const Parameter *parameter, const char *text, Message *message)
{
    const double least = parameter->least, most = parameter->most;
    switch (parameter->kind) {
    case PARAMETER_NUMBER:
        if (parse_number(text, least, most, parameter->value))
            return true;
        return message_set(message, "--%s %s: must be a number, %g to %g", parameter->name, text,
                           least, most);
    case PARAMETER_WHOLE:
        if (parse_whole(text, (int)least, (int)most, parameter->value))
            return true;
        return message_set(message, "--%s %s: must be a whole number, %g to %g", parameter->name,
                           text, least, most);
    case PARAMETER_CHOICE:
        return read_choice(parameter, text, message);
    case PARAMETER_SWITCH:
        if (strcmp(text, "on") != 0 && strcmp(text, "off") != 0)
            return message_set(message, "--%s %s: must be on or off", parameter->name, text);
        *(bool *)parameter->value = text[1] == 'n';
        return true;
    case PARAMETER_FLAG:
        *(bool *)parameter->value = true;
        return true;
    case PARAMETER_COLOR:
        if (read_color(parameter, text, parameter->value))
            return true;
        return message_set(message, "--%s %s: must be R,G,B or one number, each %g to %g",
                           parameter->name, text, least, most);
    case PARAMETER_TEXT:
        *(const char **)parameter->value = text;
        return true;
    }
    return false;
}

ParameterValue parameter_save(const Parameter *parameter)
{
    const void *value = parameter->value;
    switch (parameter->kind) {
    case PARAMETER_NUMBER:
        return (ParameterValue){.number = *(const double *)value};
    case PARAMETER_WHOLE:
    case PARAMETER_CHOICE:
        return (ParameterValue){.whole = *(const int *)value};
    case PARAMETER_SWITCH:
    case PARAMETER_FLAG:
        return (ParameterValue){.on = *(const bool *)value};
    case PARAMETER_COLOR:
        return (ParameterValue){.color = *(const Vec3 *)value};
    case PARAMETER_TEXT:
        return (ParameterValue){.text = *(const char *const *)value};
    }
    return (ParameterValue){0};
}

void parameter_restore(const Parameter *parameter, ParameterValue value)
{
    switch (parameter->kind) {
    case PARAMETER_NUMBER:
        *(double *)parameter->value = value.number;
        break;
    case PARAMETER_WHOLE:
    case PARAMETER_CHOICE:
        *(int *)parameter->value = value.whole;
        break;
    case PARAMETER_SWITCH:
    case PARAMETER_FLAG:
        *(bool *)parameter->value = value.on;
        break;
    case PARAMETER_COLOR:
        *(Vec3 *)parameter->value = value.color;
        break;
    case PARAMETER_TEXT:
        *(const char **)parameter->value = value.text;
        break;
    }
}

bool parameter_equal(const Parameter *parameter, const ParameterValue *value)
{
    const ParameterValue own = parameter_save(parameter);
    switch (parameter->kind) {
    case PARAMETER_NUMBER:
        return own.number == value->number;
    case PARAMETER_WHOLE:
    case PARAMETER_CHOICE:
        return own.whole == value->whole;
    case PARAMETER_SWITCH:
    case PARAMETER_FLAG:
        return own.on == value->on;
    case PARAMETER_COLOR:
        return own.color.x == value->color.x && own.color.y == value->color.y &&
               own.color.z == value->color.z;
    case PARAMETER_TEXT:
        return own.text == value->text ||
               (own.text && value->text && strcmp(own.text, value->text) == 0);
    }
    return false;
}

static bool write_number(double number, char text[32])
{
    if (!isfinite(number))
        return false;
    parse_number_text(number, text);
    return true;
}

static bool write_color(Vec3 color, char *text, size_t size)
{
    char r[32], g[32], b[32];
    if (!write_number(color.x, r) || !write_number(color.y, g) || !write_number(color.z, b))
        return false;
    const bool grey = strcmp(r, g) == 0 && strcmp(g, b) == 0;
    return snprintf(text, size, grey ? "%s" : "%s,%s,%s", r, g, b) < (int)size;
}

static bool write_value(const Parameter *parameter, char *text, size_t size)
{
    const ParameterValue value = parameter_save(parameter);
    const char *word = NULL;
    char number[32];
    switch (parameter->kind) {
    case PARAMETER_NUMBER:
        word = write_number(value.number, number) ? number : NULL;
        break;
    case PARAMETER_WHOLE:
        snprintf(number, sizeof number, "%d", value.whole);
        word = number;
        break;
    case PARAMETER_CHOICE:
        for (int i = 0; parameter->choices[i]; i++)
            if (i == value.whole)
                word = parameter->choices[i];
        break;
    case PARAMETER_SWITCH:
        word = value.on ? "on" : "off";
        break;
    case PARAMETER_FLAG:
        word = value.on ? "" : NULL;
        break;
    case PARAMETER_COLOR:
        return write_color(value.color, text, size);
    case PARAMETER_TEXT:
        word = value.text;
        break;
    }
    return word && snprintf(text, size, "%s", word) < (int)size;
}

bool parameter_write(const Parameter *parameter, char *text, size_t size)
{
    const bool written = write_value(parameter, text, size);
    if (!written && size > 0)
        text[0] = '\0';
    return written;
}

void parameter_help(const Parameter *parameter, FILE *file)
{
    const void *value = parameter->value;
    switch (parameter->kind) {
    case PARAMETER_NUMBER:
        fprintf(file, "      --%s %g..%g\n", parameter->name, parameter->least, parameter->most);
        fprintf(file, "%25s%s; default %g\n", "", parameter->help, *(const double *)value);
        break;
    case PARAMETER_WHOLE:
        fprintf(file, "      --%s %g..%g\n", parameter->name, parameter->least, parameter->most);
        fprintf(file, "%25s%s; default %d\n", "", parameter->help, *(const int *)value);
        break;
    case PARAMETER_CHOICE:
        fprintf(file, "      --%s ", parameter->name);
        for (int i = 0, column = 0; parameter->choices[i]; i++) {
            column +=
                fprintf(file, "%s%s", parameter->choices[i], parameter->choices[i + 1] ? "|" : "");
            if (column > 60 && parameter->choices[i + 1])
                column = fprintf(file, "\n%14s", "") - 15;
        }
        fprintf(file, "\n%25s%s; default %s\n", "", parameter->help,
                parameter->choices[*(const int *)value]);
        break;
    case PARAMETER_SWITCH:
        fprintf(file, "      --%s on|off\n", parameter->name);
        fprintf(file, "%25s%s; default %s\n", "", parameter->help,
                *(const bool *)value ? "on" : "off");
        break;
    case PARAMETER_FLAG:
        fprintf(file, "      --%s\n%25s%s\n", parameter->name, "", parameter->help);
        break;
    case PARAMETER_COLOR: {
        const Vec3 *color = value;
        fprintf(file, "      --%s R,G,B\n", parameter->name);
        fprintf(file, "%25s%s, each %g to %g; default %g,%g,%g\n", "", parameter->help,
                parameter->least, parameter->most, color->x, color->y, color->z);
        break;
    }
    case PARAMETER_TEXT:
        fprintf(file, "      --%s TEXT\n%25s%s\n", parameter->name, "", parameter->help);
        break;
    }
}
