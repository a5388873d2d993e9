/*
 * app_plugin: the plugin with what a program of the lecture may be asked for besides pictures in
 * files (app_plugin.c): windows, help, animations, other backends, advice on shaders. on_demand.c
 * loads it when one of them is called for; the functions have their usual names there, and all
 * other programs are linked with them.
 */
#ifndef APP_PLUGIN_H
#define APP_PLUGIN_H

#include "app/help.h"
#include "app/options.h"
#include "app/picture_texts.h"
#include "base/plugin.h"
#include "core/shader_source.h"
#include "images/animation.h"

/* The variable `app_plugin`: functions by their names. */
typedef struct AppPlugin {
    PluginVersion *version;
    const CanvasBackend *osmesa, *window;
    void (*shader_advise)(const ShaderSource sources[2], int refused, Message *message);
    bool (*shader_bounded)(const ShaderSource *source, ShaderStage stage, double turns_max,
                           Message *message);
    void (*help_print)(const Usage *usage, const Parameter *table);
    void (*help_generate)(const char *form, const Usage *usage, const Parameter *table);
    int (*doctor_run)(void);
    bool (*process_restart)(char *const *arguments, const char *const *settings, Message *message);
    bool (*run_more)(const Example *example, Options *options, const ParameterValue *defaults,
                     Message *message);
    void (*picture_texts_sources)(PictureSources *sources, const Example *example,
                                  const Options *options, Picture *picture);
    bool (*picture_texts_kept)(Picture *picture);
    int (*animation_format_names)(const char *names[], int max);
    const char *(*animation_format)(const char *path, int frames);
    bool (*animation_is_raw)(const char *format);
    bool (*animation_check)(const AnimationOptions *options, Message *message);
    bool (*animation_open)(Animation **animation, const AnimationOptions *options,
                           Message *message);
    bool (*animation_add)(void *animation, const Picture *picture, Message *message);
    bool (*animation_close)(Animation *animation, bool whole, Message *message);
} AppPlugin;

#endif
