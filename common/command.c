#include "command.h"

#include "parse.h"

#include <stdio.h>
#include <string.h>

/* What has been written; beyond `size` it is only counted. */
typedef struct Line {
    char *text;
    size_t size, length;
} Line;

static void put(Line *line, char letter)
{
    if (line->length < line->size)
        line->text[line->length] = letter;
    line->length++;
}

static void put_text(Line *line, const char *text)
{
    for (; *text; text++)
        put(line, *text);
}

/* Letters that no shell takes for anything else, anywhere in a word. */
static bool is_plain(const char *text)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "%+,-./:@_";
    return text[0] && text[strspn(text, plain)] == '\0';
}

/* Between single quotes all but these stand for themselves. (POSIX.1-2017, Shell Command Language,
 * section 2.2.2) */
static void put_quoted(Line *line, const char *text)
{
    if (is_plain(text)) {
        put_text(line, text);
        return;
    }
    put(line, '\'');
    for (; *text; text++) {
        if (*text == '\'')
            put_text(line, "'\\''");
        else
            put(line, *text);
    }
    put(line, '\'');
}

static void put_flag(Line *line, const char *name)
{
    put_text(line, " --");
    put_text(line, name);
}

/* A value that begins like an option is joined to its own. */
static void put_option(Line *line, const char *name, const char *value)
{
    put_flag(line, name);
    put(line, value[0] == '-' ? '=' : ' ');
    put_quoted(line, value);
}

static void put_number(Line *line, const char *name, double number)
{
    char text[32];
    parse_number_text(number, text);
    put_option(line, name, text);
}

static void put_size(Line *line, const Example *example, const Options *options)
{
    char text[32];
    const int width = example->width ? example->width : OPTIONS_SIDE;
    const int height = example->height ? example->height : OPTIONS_SIDE;
    if (options->width == width && options->height == height)
        return;
    snprintf(text, sizeof text, "%dx%d", options->width, options->height);
    put_option(line, "size", text);
}

static void put_whole(Line *line, const char *name, int number)
{
    char text[16];
    snprintf(text, sizeof text, "%d", number);
    put_option(line, name, text);
}

/* A window draws with EGL. */
static void put_backend(Line *line, const CanvasBackend *backend)
{
    const CanvasBackend *usual = canvas_default_backend(NULL);
    if (!backend)
        backend = usual;
    if (backend == &CANVAS_WINDOW)
        backend = &CANVAS_EGL;
    if (backend && backend != usual)
        put_option(line, "backend", backend->name);
}

/* Those of every program. */
static void put_options(Line *line, const Example *example, const Options *options)
{
    char orbit[96];
    if (options->output_given)
        put_option(line, "output", options->output);
    put_size(line, example, options);
    if (options->seconds != 0)
        put_number(line, "time", options->seconds);
    if (options->frames != 1 || options->numbered)
        put_whole(line, "frames", options->frames);
    if (options->fps != OPTIONS_FPS)
        put_number(line, "fps", options->fps);
    if (options->format)
        put_option(line, "format", options->format);
    if (options->canvas.samples != 0)
        put_whole(line, "samples", options->canvas.samples);
    if (orbit_text(options->orbit, orbit))
        put_option(line, "orbit", orbit);
    put_backend(line, options->canvas.backend);
    if (options->shaders.folder)
        put_option(line, "shaders", options->shaders.folder);
    if (options->shaders.precision)
        put_option(line, "precision", options->shaders.precision);
    if (options->alpha)
        put_flag(line, "alpha");
    if (options->compress != IMAGE_COMPRESS_DEFAULT)
        put_whole(line, "compress", options->compress);
}

/* Those of programs that draw scenes. */
static void put_scene_options(Line *line, const Options *options)
{
    if (options->full)
        put_flag(line, "full");
    if (options->cheap)
        put_number(line, "error", options->error);
    if (options->clamp_vertex)
        put_option(line, "clamp", "vertex");
    if (options->linear)
        put_flag(line, "linear");
    if (options->show_clipped)
        put_flag(line, "show-clipped");
}

static bool put_parameter(Line *line, const Parameter *parameter)
{
    char text[PARAMETER_TEXT_SIZE];
    if (parameter->kind == PARAMETER_TEXT) {
        const char *value = parameter_save(parameter).text;
        if (value)
            put_option(line, parameter->name, value);
        return value != NULL;
    }
    if (!parameter_write(parameter, text, sizeof text))
        return false;
    if (parameter->kind == PARAMETER_FLAG)
        put_flag(line, parameter->name);
    else
        put_option(line, parameter->name, text);
    return true;
}

bool command_write(const Example *example, const Options *options, const ParameterValue *defaults,
                   char *text, size_t size)
{
    Line line = {.text = text, .size = size};
    const Parameter *parameters = example->parameters;
    bool done = true;
    put_quoted(&line, example->name);
    put_options(&line, example, options);
    if (example->scene)
        put_scene_options(&line, options);
    for (int i = 0; done && defaults && parameters && parameters[i].name; i++)
        done =
            parameter_equal(&parameters[i], &defaults[i]) || put_parameter(&line, &parameters[i]);
    put(&line, '\0');
    done &= line.length <= size;
    if (!done && size > 0)
        text[0] = '\0';
    return done;
}
