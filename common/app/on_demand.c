/*
 * What a program of the lecture may be asked for besides pictures in files: the functions under
 * their own names, which load the plugin that has them. So these programs compile a third of the
 * files, and a first picture loads none of this.
 */
#include "app/app_plugin.h"
#include "app/doctor.h"
#include "app/run_more.h"
#include "base/process.h"
#include "base/text.h"
#include "window/window.h"

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

#define BACKEND(name)                                                                              \
    static bool name##_open(void **context, const CanvasOptions *options, const char **platform,   \
                            Message *message)                                                      \
    {                                                                                              \
        return load()->name->open(context, options, platform, message);                            \
    }                                                                                              \
    static GlFunction name##_address(const char *function)                                         \
    {                                                                                              \
        return load()->name->address(function);                                                    \
    }                                                                                              \
    static bool name##_current(void *context)                                                      \
    {                                                                                              \
        return load()->name->current(context);                                                     \
    }                                                                                              \
    static void name##_close(void *context)                                                        \
    {                                                                                              \
        load()->name->close(context);                                                              \
    }                                                                                              \
    static bool name##_package(Message *findings)                                                  \
    {                                                                                              \
        return load()->name->package(findings);                                                    \
    }                                                                                              \
    static bool name##_probe(Message *findings)                                                    \
    {                                                                                              \
        return load()->name->probe(findings);                                                      \
    }
BACKEND(osmesa)
BACKEND(window)

const CanvasBackend CANVAS_OSMESA = {.name = "osmesa",
                                     .summary = CANVAS_OSMESA_SUMMARY,
                                     .open = osmesa_open,
                                     .address = osmesa_address,
                                     .current = osmesa_current,
                                     .close = osmesa_close,
                                     .package = osmesa_package,
                                     .probe = osmesa_probe};
const CanvasBackend CANVAS_WINDOW = {.name = "window",
                                     .summary = CANVAS_WINDOW_SUMMARY,
                                     .presents = true,
                                     .open = window_open,
                                     .address = window_address,
                                     .current = window_current,
                                     .close = window_close,
                                     .package = window_package,
                                     .probe = window_probe};

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

void help_print(const Usage *usage, const Parameter *table)
{
    load()->help_print(usage, table);
}

void help_generate(const char *form, const Usage *usage, const Parameter *table)
{
    load()->help_generate(form, usage, table);
}

int doctor_run(void)
{
    return load()->doctor_run();
}

bool process_restart(char *const *arguments, const char *const *settings, Message *message)
{
    return load()->process_restart(arguments, settings, message);
}

bool run_more(const Example *example, Options *options, const ParameterValue *defaults,
              Message *message)
{
    return load()->run_more(example, options, defaults, message);
}

void picture_texts_sources(PictureSources *sources, const Example *example, const Options *options,
                           Picture *picture)
{
    load()->picture_texts_sources(sources, example, options, picture);
}

bool picture_texts_kept(Picture *picture)
{
    return load()->picture_texts_kept(picture);
}

int animation_format_names(const char *names[], int max)
{
    return load()->animation_format_names(names, max);
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

bool animation_check(const AnimationOptions *options, Message *message)
{
    return load()->animation_check(options, message);
}

bool animation_open(Animation **animation, const AnimationOptions *options, Message *message)
{
    return load()->animation_open(animation, options, message);
}

bool animation_add(void *animation, const Picture *picture, Message *message)
{
    return load()->animation_add(animation, picture, message);
}

bool animation_close(Animation *animation, bool whole, Message *message)
{
    return animation ? load()->animation_close(animation, whole, message) : whole;
}
