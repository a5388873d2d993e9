/* All but pictures in files, as a plugin. It calls what the program is made of, and has no copy of
 * that: the program exports it. */
#include "app/app_plugin.h"

static const char *version(void)
{
    return NULL;
}

#define NAME(name, ...) name,
__attribute__((visibility("default"))) const AppPlugin app_plugin = {
    version, &CANVAS_OSMESA, &CANVAS_WINDOW, APP_PLUGIN_FUNCTIONS(NAME) APP_PLUGIN_OTHERS(NAME)};
