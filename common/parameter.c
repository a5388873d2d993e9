#include "parameter.h"

#include "matrix.h"
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
    char copy[128], *rest = copy;
    double values[3];
    int count = 0;
    if (snprintf(copy, sizeof copy, "%s", text) >= (int)sizeof copy)
        return false;
    for (char *part; (part = strsep(&rest, ",")) != NULL; count++)
        if (count == 3 || !parse_number(part, parameter->least, parameter->most, &values[count]))
            return false;
    if (count == 1)
        values[1] = values[2] = values[0];
    *color = (Vec3){values[0], values[1], values[2]};
    return count == 1 || count == 3;
}

bool parameter_read(const Parameter *parameter, const char *text, Message *message)
{
    const double least = parameter->least, most = parameter->most;
    double number;
    switch (parameter->kind) {
    case PARAMETER_NUMBER:
        if (parse_number(text, least, most, parameter->value))
            return true;
        return message_set(message, "--%s %s: must be a number, %g to %g", parameter->name, text,
                           least, most);
    case PARAMETER_WHOLE:
        if (!parse_number(text, least, most, &number) || number != floor(number))
            return message_set(message, "--%s %s: must be a whole number, %g to %g",
                               parameter->name, text, least, most);
        *(int *)parameter->value = (int)number;
        return true;
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
