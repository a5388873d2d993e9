/*
 * What a program of the lecture may be asked for besides pictures in files: the functions under
 * their own names, which load the plugin that has them. So these programs compile fewer files, and
 * a first picture loads none of this.
 */
#include "app/app_plugin.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const AppPlugin *find(Message *message)
{
    static Plugin plugin = {"app.so", "app_plugin", "app", "", "lighting", NULL};
    return plugin_open(&plugin, message);
}

/* What was asked for cannot be done without. */
static const AppPlugin *load(void)
{
    Message message = {0};
    const AppPlugin *found = find(&message);
    if (!found)
        exit(options_fail(program_invocation_short_name, &message, EXIT_FAILED));
    return found;
}

#define FORWARD(name, TYPE, parameters, arguments)                                                 \
    TYPE name parameters                                                                           \
    {                                                                                              \
        return load()->name arguments;                                                             \
    }
APP_PLUGIN_FUNCTIONS(FORWARD)

static const CanvasBackend *load_osmesa(void)
{
    return load()->osmesa;
}

static const CanvasBackend *load_window(void)
{
    return load()->window;
}

const CanvasBackend CANVAS_OSMESA = {
    .name = "osmesa", .summary = CANVAS_OSMESA_SUMMARY, .load = load_osmesa};
const CanvasBackend CANVAS_WINDOW = {
    .name = "window", .summary = CANVAS_WINDOW_SUMMARY, .presents = true, .load = load_window};

/* Without the plugin the driver's words stand alone. */
void shader_advise(const ShaderSource sources[2], int refused, Message *message)
{
    Message none = {0};
    const AppPlugin *found = message && message->text[0] ? find(&none) : NULL;
    if (found)
        found->shader_advise(sources, refused, message);
}

/* Without macros, and functions but main, nothing grows. */
static bool is_plain(const char *text)
{
    const char *body = strchr(text, '{');
    return !(body && strchr(body + 1, '{')) && !strstr(text, "define");
}

bool shader_bounded(const ShaderSource *source, ShaderStage stage, double turns_max,
                    Message *message)
{
    Message none = {0};
    const AppPlugin *found = is_plain(source->text) && turns_max <= 0 ? NULL : find(&none);
    return !found || found->shader_bounded(source, stage, turns_max, message);
}

const char *animation_format(const char *path, int frames)
{
    const char *dot = strrchr(path, '.');
    return dot && strcasecmp(dot, ".png") != 0 ? load()->animation_format(path, frames) : NULL;
}

bool animation_is_raw(const char *format)
{
    return format && load()->animation_is_raw(format);
}

bool animation_close(Animation *animation, bool whole, Message *message)
{
    return animation ? load()->animation_close(animation, whole, message) : whole;
}
