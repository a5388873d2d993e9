/*
 * panel_module: what panel.c asks of the module that links Dear ImGui (panel_imgui.cpp), and how
 * the two agree on it. Only these two files include it.
 */
#ifndef PANEL_MODULE_H
#define PANEL_MODULE_H

#ifdef __cplusplus
extern "C" {
#endif

#include "base/plugin.h"
#include "window/panel_frame.h"

/* In pixels of an ordinary screen: the panel's width, its height folded, the height of the errors'
 * box, and what is left around them. */
enum { PANEL_WIDTH = 340, PANEL_FOLDED_HEIGHT = 36, PANEL_ERRORS_HEIGHT = 120, PANEL_MARGIN = 8 };

/* The variable `panel_module`. Functions return true, or false with the reason in `reason` (without
 * a subject). A frame's window is at least 1x1, and its numbers are finite; a place that was none
 * is outside the window. */
typedef struct PanelModule {
    PluginVersion *version;
    bool (*open)(void **context, char *reason, size_t reason_size);
    bool (*frame)(void *context, const PanelInput *input, const PanelContent *content,
                  PanelResult *result, char *reason, size_t reason_size);
    void (*close)(void *context);
} PanelModule;

#ifdef __cplusplus
}
#endif
#endif
