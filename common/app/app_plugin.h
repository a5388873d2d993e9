/*
 * app_plugin: the plugin with what a program of the lecture may be asked for besides pictures in
 * files (app_plugin.c): windows, help, animations, other backends, advice on shaders. on_demand.c
 * loads it when one of them is called for; the functions have their usual names there, and all
 * other programs are linked with them.
 */
#ifndef APP_PLUGIN_H
#define APP_PLUGIN_H

#include "app/doctor.h"
#include "app/help.h"
#include "app/picture_texts.h"
#include "app/run_more.h"
#include "base/plugin.h"
#include "base/process.h"
#include "core/shader_source.h"
#include "images/animation.h"
#include "window/window.h"

/* Its functions, as X(NAME, TYPE, PARAMETERS, ARGUMENTS), and those that a first picture calls,
 * too, as X(NAME). */
#define APP_PLUGIN_FUNCTIONS(X)                                                                    \
    X(help_print, void, (const Usage *usage, const Parameter *table), (usage, table))              \
    X(help_generate, void, (const char *form, const Usage *usage, const Parameter *table),         \
      (form, usage, table))                                                                        \
    X(doctor_run, int, (void), ())                                                                 \
    X(process_restart, bool,                                                                       \
      (char *const *arguments, const char *const *settings, Message *message),                     \
      (arguments, settings, message))                                                              \
    X(run_more, bool,                                                                              \
      (const Example *example, Options *options, const ParameterValue *defaults,                   \
       Message *message),                                                                          \
      (example, options, defaults, message))                                                       \
    X(picture_texts_sources, void,                                                                 \
      (PictureSources * sources, const Example *example, const Options *options,                   \
       Picture *picture),                                                                          \
      (sources, example, options, picture))                                                        \
    X(picture_texts_kept, bool, (Picture * picture), (picture))                                    \
    X(animation_format_names, int, (const char *names[], int max), (names, max))                   \
    X(animation_check, bool, (const AnimationOptions *options, Message *message),                  \
      (options, message))                                                                          \
    X(animation_open, bool,                                                                        \
      (Animation * *animation, const AnimationOptions *options, Message *message),                 \
      (animation, options, message))                                                               \
    X(animation_add, bool, (void *animation, const Picture *picture, Message *message),            \
      (animation, picture, message))
#define APP_PLUGIN_OTHERS(X)                                                                       \
    X(shader_advise) X(shader_bounded) X(animation_format) X(animation_is_raw) X(animation_close)

/* The variable `app_plugin`. */
typedef struct AppPlugin {
    PluginVersion *version;
    const CanvasBackend *osmesa, *window;
#define APP_PLUGIN_MEMBER(name, ...) __typeof__(name) *name;
    APP_PLUGIN_FUNCTIONS(APP_PLUGIN_MEMBER)
    APP_PLUGIN_OTHERS(APP_PLUGIN_MEMBER)
} AppPlugin;

#endif
