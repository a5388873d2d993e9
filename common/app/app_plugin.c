/* All but pictures in files, as a plugin. It calls what the program is made of, and has no copy of
 * that: the program exports it. */
#include "app/app_plugin.h"

#include "app/doctor.h"
#include "app/run_more.h"
#include "base/process.h"
#include "window/window.h"

static const char *version(void)
{
    return NULL;
}

__attribute__((visibility("default"))) const AppPlugin app_plugin = {version,
                                                                     &CANVAS_OSMESA,
                                                                     &CANVAS_WINDOW,
                                                                     shader_advise,
                                                                     shader_bounded,
                                                                     help_print,
                                                                     help_generate,
                                                                     doctor_run,
                                                                     process_restart,
                                                                     run_more,
                                                                     picture_texts_sources,
                                                                     picture_texts_kept,
                                                                     animation_format_names,
                                                                     animation_format,
                                                                     animation_is_raw,
                                                                     animation_check,
                                                                     animation_open,
                                                                     animation_add,
                                                                     animation_close};
