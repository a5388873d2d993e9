/* How options are read and written whose values are of no ParameterKind. */
#include "app/options_table.h"

#include "window/backends.h"

#include <stdio.h>
#include <math.h>
#include <string.h>

bool option_put_numbers(char *text, size_t size, const double *numbers, int count)
{
    size_t length = strlen(text);
    for (int i = 0; i < count && length < size; i++) {
        char number[32];
        parse_number_text(numbers[i], number);
        length += (size_t)snprintf(text + length, size - length, "%s%s", i ? "," : "", number);
    }
    return length < size;
}

/* The value is Options.width, with the height. */
static Options *options_of_size(const Parameter *parameter)
{
    return (Options *)((char *)parameter->value - offsetof(Options, width));
}

static bool read_size(const Parameter *parameter, const char *text, Message *message)
{
    Options *options = options_of_size(parameter);
    return parse_size(text, &options->width, &options->height) ||
           message_set(
               message,
               "--size %s: must be WIDTHxHEIGHT or one number for both, 1 to %d, as in 400x400",
               text, PARSE_SIZE_MAX);
}

static bool write_size(const Parameter *parameter, char *text, size_t size)
{
    const Options *options = options_of_size(parameter);
    return snprintf(text, size, "%dx%d", options->width, options->height) < (int)size;
}

const ParameterCodec OPTION_SIZE = {"WxH", read_size, write_size};

static bool read_angle(const Parameter *parameter, const char *text, Message *message)
{
    double *seconds = parameter->value;
    if (!parse_number(text, -3e10, 3e10, seconds))
        return message_set(message, "--angle %s: must be degrees, -30 billion to 30 billion", text);
    *seconds /= DEGREES_PER_SECOND;
    return true;
}

const ParameterCodec OPTION_ANGLE = {"DEG", read_angle, NULL};

static bool read_probe(const Parameter *parameter, const char *text, Message *message)
{
    static const double min[] = {0, 0}, max[] = {PARSE_SIZE_MAX - 1, PARSE_SIZE_MAX - 1};
    Options *options = (Options *)((char *)parameter->value - offsetof(Options, probe));
    double at[2];
    options->probe.asked =
        parse_numbers(text, 2, min, max, at) == 2 && at[0] == floor(at[0]) && at[1] == floor(at[1]);
    if (!options->probe.asked)
        return message_set(message, "--probe %s: must be a column and a row, as in 200,150", text);
    options->probe.column = (int)at[0];
    options->probe.row = (int)at[1];
    return true;
}

const ParameterCodec OPTION_PROBE = {"X,Y", read_probe, NULL};

static bool read_orbit(const Parameter *parameter, const char *text, Message *message)
{
    static const double min[] = {-36000, -90, 0.01, -36000}, max[] = {36000, 90, 100, 36000};
    double values[4] = {0, 0, 1, 0};
    if (parse_numbers(text, 4, min, max, values) < 2)
        return message_set(message,
                           "--orbit %s: must be AZIMUTH,ELEVATION[,DISTANCE[,ROLL]]: degrees, "
                           "-90 to 90 for the elevation, a factor of 0.01 to 100, and degrees",
                           text);
    *(Orbit *)parameter->value = (Orbit){values[0], values[1], values[2], values[3]};
    return true;
}

/* "30,-10,0.5": with the distance and the roll where those are not 1 and 0. */
static bool write_orbit(const Parameter *parameter, char *text, size_t size)
{
    const Orbit orbit = *(const Orbit *)parameter->value;
    const double numbers[] = {orbit.azimuth, orbit.elevation, orbit_distance(orbit), orbit.roll};
    const int count = orbit.roll != 0 ? 4 : numbers[2] != 1 ? 3 : 2;
    text[0] = '\0';
    return orbit_moves(orbit) && option_put_numbers(text, size, numbers, count);
}

const ParameterCodec OPTION_ORBIT = {"AZIMUTH,ELEVATION[,DISTANCE[,ROLL]]", read_orbit,
                                     write_orbit};

static bool read_part(const Parameter *parameter, const char *text, Message *message)
{
    return parse_part(text, parameter->value) ||
           message_set(message, "--part %s: must be I/N, 1/N to N/N, as in 3/8", text);
}

const ParameterCodec OPTION_PART = {"I/N", read_part, NULL};

static bool read_backend(const Parameter *parameter, const char *text, Message *message)
{
    const CanvasBackend **backend = parameter->value;
    Message why = {0};
    *backend = backend_find(text, &why);
    return *backend || message_set(message, "--backend %s", why.text);
}

static bool write_backend(const Parameter *parameter, char *text, size_t size)
{
    const CanvasBackend *given = *(const CanvasBackend *const *)parameter->value;
    const CanvasBackend *backend = given ? given : backend_default(NULL);
    return backend && snprintf(text, size, "%s", backend->name) < (int)size;
}

const ParameterCodec OPTION_BACKEND = {NULL, read_backend, write_backend};

static bool read_window(const Parameter *parameter, const char *text, Message *message)
{
    (void)text;
    return read_backend(parameter, "window", message);
}

const ParameterCodec OPTION_WINDOW = {NULL, read_window, NULL};

static bool read_print(const Parameter *parameter, const char *text, Message *message)
{
    int *print = parameter->value;
    *print = !text                       ? SHADER_PRINT_VERTEX | SHADER_PRINT_FRAGMENT
             : strcmp(text, "vert") == 0 ? SHADER_PRINT_VERTEX
             : strcmp(text, "frag") == 0 ? SHADER_PRINT_FRAGMENT
                                         : 0;
    return *print ||
           message_set(message, "--print-shader %s: must be vert or frag, or nothing for both",
                       text);
}

const ParameterCodec OPTION_PRINT = {NULL, read_print, NULL};
