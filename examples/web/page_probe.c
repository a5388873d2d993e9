#include "web/page_probe.h"

#include "app/probing.h"
#include "probe/show.h"
#include "web/page_state.h"

#include <stdlib.h>

extern const ProbePlugin probe_plugin;

static Probing probing;
static bool captured;

int page_capture(const char *device)
{
    Options options = page.options;
    page.message = (Message){0};
    probing_close(&probing);
    renderer_close(&page.renderer); /* one is open at a time */
    captured = false;
    if (!page.example)
        return message_set(&page.message, "no program is open");
    if (options.canvas.samples > 1)
        return message_set(&page.message, "a pixel of several samples has no one colour; leave out "
                                          "--samples");
    options.arithmetic = device;
    captured = probing_open(&probing, page.example, &options, &page.canvas, &page.message);
    page.example = NULL;
    return captured;
}

const char *page_probe(int column, int row)
{
    page.message = (Message){0};
    if (!captured || column < 0 || row < 0 || column >= page.canvas.width ||
        row >= page.canvas.height) {
        message_set(&page.message, "%d,%d: no pixel of a picture", column, row);
        return "";
    }
    free(page.text);
    page.text = probing_pixel(&probing, &probe_plugin, (int[]){column, row}, true, &page.message);
    return page.text ? page.text : "";
}

const char *page_names(void)
{
    FILE *file = page_text_begin();
    for (int stage = 1; stage >= 0 && file && captured; stage--)
        fputs(show_names(&probing.capture, &probing.driver, stage, file, &page.message) ? "\n" : "",
              file);
    return page_text_end(file);
}

const char *page_show(const char *what)
{
    page.message = (Message){0};
    if (!captured) {
        message_set(&page.message, "no picture is drawn");
        return "";
    }
    image_close(&page.image);
    if (!image_open(&page.image, page.canvas.width, page.canvas.height, IMAGE_BYTE, &page.message))
        return "";
    FILE *legend = page_text_begin();
    const bool done =
        legend && probe_plugin.show(&probing.capture, &probing.driver, what[0] ? what : NULL,
                                    &page.image, legend, &page.message) == SHOW_DONE;
    const char *text = page_text_end(legend);
    return done ? text : "";
}
