/* The evaluator's uses as a plugin. */
#include "probe/probe_plugin.h"

#include "probe/show.h"

static char *tell(const ProbeQuestion *question, bool json, Message *message)
{
    Probe probe;
    char *text = NULL;
    if (probe_open(&probe, question, message))
        text = json ? probe_json(&probe) : probe_text(&probe);
    probe_close(&probe);
    return text;
}

static ShowResult show(const Capture *capture, const GlslArithmetic *driver, const char *what,
                       Image *picture, FILE *legend, Message *message)
{
    Show shown;
    const int size[2] = {picture->width, picture->height};
    const bool done = show_open(&shown, capture, driver, what, size, message);
    const ShowResult result = done ? SHOW_DONE : shown.unknown ? SHOW_UNKNOWN : SHOW_FAILED;
    if (done)
        show_paint(&shown, picture, legend);
    for (int i = 0; i < capture->draw_count && done; i++) /* objects in turn share a program */
        if (i == 0 || capture->draws[i].sources[1] != capture->draws[i - 1].sources[1])
            probe_samplers(legend, &capture->draws[i]);
    show_close(&shown);
    return result;
}

__attribute__((visibility("default")))
const ProbePlugin probe_plugin = {tell, show, show_names, probe_exact};
