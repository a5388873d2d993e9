/*
 * panel_imgui: shared by the files of the module that links Dear ImGui, for them alone.
 */
#ifndef PANEL_IMGUI_H
#define PANEL_IMGUI_H

#include "window/panel_module.h"

#include <imgui.h>

#include <vector>

namespace panel
{

constexpr size_t LONGEST_TEXT = 8192; // in one piece: a letter is 4 vertices, with 16-bit indices

const ImVec4 PLAIN(0.90f, 0.91f, 0.93f, 1), DIM(0.56f, 0.59f, 0.64f, 1),
    HEADING(0.55f, 0.75f, 1.00f, 1), ERROR(0.93f, 0.26f, 0.24f, 1);

// A number that is being typed: the parameter is set when the field is left.
struct Typing {
    ImGuiID field; // 0: none
    double value;
    bool edited;
};

struct Context {
    ImGuiContext *imgui = nullptr;
    float scale = 0; // of fonts and style
    ImFont *sans = nullptr, *mono = nullptr;
    const char *reset_sign = "<";
    unsigned generation = 0;
    Typing typing = {};
    int object = -1;        // that was chosen of many, by its number
    float other_height = 0; // of the panel without its list of effects, in the frame before
    const PanelInput *input = nullptr; // of this frame
    std::vector<PanelVertex> vertices;
    std::vector<uint16_t> indices;
    std::vector<PanelCommand> commands;
};

// panel_style: makes fonts and sizes for a scale, if it is another than before.
void rescale(Context &context, double scale);

// panel_controls: text, and a control for each kind of parameter.

void put_text(const char *text);
void put_wrapped(const char *text);
void tooltip(const Parameter &parameter);
void close_popup_on_escape();

// Whether it set the value. `width` is what it may take of the row.
bool edit(Context &context, const Parameter &parameter, float width);

// Whether the number is being typed into a field that is shown.
bool is_typed(const Typing &typing);

constexpr int MANY = 8; // objects: a list

// panel_sections: what is below the title, in a window that may be `max` high.
void sections(Context &context, const PanelContent &content, float max, PanelResult &result);

} // namespace panel

#endif
