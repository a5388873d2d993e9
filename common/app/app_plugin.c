/* All but a first picture, as a plugin. It calls what the program is made of, and has no copy of
 * that: the program exports it. */
#include "app/app_plugin.h"

#include "base/build_id.h"

__attribute__((visibility("default"))) const AppPlugin app_plugin = {
    BUILD_ID, &CANVAS_OSMESA, example_main, shader_advise, shader_bounded};
