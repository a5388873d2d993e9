/*
 * What the panel needs of no library: where it leaves the picture, and input made harmless before
 * Dear ImGui, which aborts on sizes and positions that are not finite, sees it.
 */
#include "window/panel.h"

#include "base/memory.h"
#include "window/panel_module.h"

#include <math.h>
#include <stdlib.h>

struct Panel {
    const PanelModule *module;
    void *context;
};

static const double MIN_SCALE = 0.5, MAX_SCALE = 4, LONGEST_FRAME = 1;
static const double OUTSIDE = -1e6, MAX_PLACE = 1e6, MAX_SCROLL = 100;

static Plugin imgui = {"panel_imgui.so",       "panel_module", "Dear ImGui",
                       "the panel of windows", "libimgui-dev", NULL};

bool panel_open(Panel **panel, Message *message)
{
    char reason[256];
    const PanelModule *module = plugin_open(&imgui, message);
    *panel = NULL;
    if (!module)
        return false;
    Panel *own = memory_new(1, sizeof *own);
    own->module = module;
    if (!module->open(&own->context, reason, sizeof reason)) {
        free(own);
        return message_set(message, "panel: %s", reason);
    }
    *panel = own;
    return true;
}

static double within(double value, double min, double max, double otherwise)
{
    return isfinite(value) ? fmin(fmax(value, min), max) : otherwise;
}

void panel_margins(PanelView view, bool errors, double scale, int margins[PANEL_MARGINS])
{
    const double own = within(scale, MIN_SCALE, MAX_SCALE, 1);
    const int around = 2 * PANEL_MARGIN;
    const int wanted[PANEL_MARGINS] = {
        [PANEL_RIGHT] = view == PANEL_OPEN ? PANEL_WIDTH + around : 0,
        [PANEL_ABOVE] = view == PANEL_FOLDED ? PANEL_FOLDED_HEIGHT + around : 0,
        [PANEL_BELOW] = errors ? PANEL_ERRORS_HEIGHT + around : 0};
    for (int i = 0; i < PANEL_MARGINS; i++)
        margins[i] = (int)lrint(own * wanted[i]);
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

void panel_place(PanelView view, bool errors, double scale, int width, int height, int place[4])
{
    const int most[2] = {(int)(2LL * width / 3), (int)(2LL * height / 3)};
    int margins[PANEL_MARGINS];
    panel_margins(view, errors, scale, margins);
    const int right = least(margins[PANEL_RIGHT], most[0]);
    const int above = least(margins[PANEL_ABOVE], most[1]);
    const int below = least(margins[PANEL_BELOW], most[1] - above);
    place[0] = 0;
    place[1] = above;
    place[2] = width - right;
    place[3] = height - above - below;
}

static WindowInput sane(const WindowInput *input)
{
    WindowInput own = *input;
    own.scale = within(input->scale, MIN_SCALE, MAX_SCALE, 1);
    own.x = within(input->x, -MAX_PLACE, MAX_PLACE, OUTSIDE);
    own.y = within(input->y, -MAX_PLACE, MAX_PLACE, OUTSIDE);
    own.scroll = within(input->scroll, -MAX_SCROLL, MAX_SCROLL, 0);
    own.typed_count = own.typed_count < 0                  ? 0
                      : own.typed_count > WINDOW_MAX_TYPED ? WINDOW_MAX_TYPED
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
    panel_place(content->view, content->errors != NULL, window.scale, window.width, window.height,
                own.place);
    own.seconds = within(input->seconds, 0, LONGEST_FRAME, 0);
    *result = (PanelResult){.view = content->view, .mapped = content->error.mapped};
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

bool panel_probe(Message *findings)
{
    return plugin_probe(&imgui, findings);
}
