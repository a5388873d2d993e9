/*
 * app_plugin: the plugin with all that a program of the lecture may be asked for besides its
 * picture (app_plugin.c): options, windows, animations, other backends, advice on shaders.
 * on_demand.c loads it when one of them is called for; all other programs are linked with it.
 */
#ifndef APP_PLUGIN_H
#define APP_PLUGIN_H

#include "app/options.h"
#include "app/run.h"
#include "base/plugin.h"
#include "core/shader_source.h"

/* The variable `app_plugin`. */
typedef struct AppPlugin {
    const char *build_id; /* of the sources; else program and plugin do not fit together */
    const CanvasBackend *osmesa;
    __typeof__(example_main) *main;
    __typeof__(shader_advise) *shader_advise;
    __typeof__(shader_bounded) *shader_bounded;
} AppPlugin;

#endif
