#include "panel.h"

#include "module.h"
#include "panel_module.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

struct Panel {
    const PanelModule *module;
    void *context;
};

static const double LEAST_SCALE = 0.5, MOST_SCALE = 4, LONGEST_FRAME = 1;
static const double OUTSIDE = -1e6, MOST_PLACE = 1e6, MOST_SCROLL = 100;

static const PanelModule *load(Message *message)
{
    static const ModuleName name = {"panel_imgui.so", PANEL_MODULE_SYMBOL, "Dear ImGui",
                                    "libimgui-dev"};
    static const PanelModule *loaded; /* once; windows belong to one thread */
    if (!loaded) {
        const PanelModuleEntry entry = (PanelModuleEntry)module_entry(&name, message);
        if (!entry)
            return NULL;
        loaded = entry();
    }
    return loaded;
}

bool panel_open(Panel **panel, Message *message)
{
    char reason[256];
    const PanelModule *module = load(message);
    *panel = NULL;
    if (!module)
        return false;
    Panel *own = calloc(1, sizeof *own);
    if (!own)
        return message_set(message, "panel: not enough memory");
    own->module = module;
    if (!module->open(&own->context, reason, sizeof reason)) {
        free(own);
        return message_set(message, "panel: %s", reason);
    }
    *panel = own;
    return true;
}

static double within(double value, double least, double most, double otherwise)
{
    return isfinite(value) ? fmin(fmax(value, least), most) : otherwise;
}

/* Dear ImGui ends the program over numbers that cannot be. */
static WindowInput sane(const WindowInput *input)
{
    WindowInput own = *input;
    own.scale = within(input->scale, LEAST_SCALE, MOST_SCALE, 1);
    own.x = within(input->x, -MOST_PLACE, MOST_PLACE, OUTSIDE);
    own.y = within(input->y, -MOST_PLACE, MOST_PLACE, OUTSIDE);
    own.scroll = within(input->scroll, -MOST_SCROLL, MOST_SCROLL, 0);
    own.typed_count = own.typed_count < 0                   ? 0
                      : own.typed_count > WINDOW_MOST_TYPED ? WINDOW_MOST_TYPED
                                                            : own.typed_count;
    return own;
}

bool panel_frame(Panel *panel, const PanelInput *input, const PanelContent *content,
                 PanelResult *result, Message *message)
{
    enum { LARGEST = 32767 };
    char reason[256];
    const WindowInput window = sane(input->window);
    PanelInput own = *input;
    own.window = &window;
    own.seconds = within(input->seconds, 0, LONGEST_FRAME, 0);
    *result = (PanelResult){.view = content->view};
    const bool something =
        content->view != PANEL_HIDDEN || content->help || content->errors || content->notice;
    const bool visible = window.width > 0 && window.height > 0 && window.width <= LARGEST &&
                         window.height <= LARGEST;
    if (!something || !visible)
        return true;
    if (!panel->module->frame(panel->context, &own, content, result, reason, sizeof reason))
        return message_set(message, "panel: %s", reason);
    return true;
}

void panel_close(Panel *panel)
{
    if (!panel)
        return;
    panel->module->close(panel->context);
    free(panel);
}

PanelView panel_next_view(PanelView view)
{
    return view == PANEL_OPEN ? PANEL_HIDDEN : PANEL_OPEN;
}

bool panel_doctor(void)
{
    Message message = {0};
    const PanelModule *module = load(&message);
    if (module)
        printf("  Dear ImGui (the panel) %s: found\n", module->version);
    else
        printf("  Dear ImGui (the panel) missing: %s\n", message.text);
    return module != NULL;
}
