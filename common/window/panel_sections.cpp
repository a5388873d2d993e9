// The sections of the panel: a pixel, parameters, options, lights, things to try, cost, effects,
// command.
#include "window/panel_imgui.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace panel
{

namespace
{

constexpr int MAX_PARAMETERS = 32; // bits of PanelResult.changed

bool can_reset(const Parameter &parameter, const ParameterValue *value)
{
    return value && parameter.kind != PARAMETER_TEXT && !parameter_equal(&parameter, value);
}

// At the right edge, where the value is not the default.
bool reset_button(const Context &context, const Parameter &parameter, const ParameterValue *value,
                  float x)
{
    if (!can_reset(parameter, value))
        return false;
    ImGui::SameLine(x);
    ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0, 0, 0, 0));
    const float height = ImGui::GetFrameHeight();
    const bool pressed = ImGui::Button(context.reset_sign, ImVec2(height, height));
    ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) {
        char text[PARAMETER_TEXT_SIZE];
        Parameter at_first = parameter;
        ParameterValue copy = *value;
        at_first.value = &copy; // all members of the union begin where it does
        const bool written = parameter_write(&at_first, text, sizeof text);
        ImGui::SetTooltip("back to %s", !written                           ? "none"
                                        : parameter.kind == PARAMETER_FLAG ? "on"
                                                                           : text);
    }
    if (pressed)
        parameter_restore(&parameter, *value);
    return pressed;
}

uint32_t reset_all(const Parameter *parameters, const ParameterValue *defaults)
{
    uint32_t changed = 0;
    for (int i = 0; i < MAX_PARAMETERS && parameters[i].name; i++) {
        if (can_reset(parameters[i], &defaults[i])) {
            parameter_restore(&parameters[i], defaults[i]);
            changed |= uint32_t(1) << i;
        }
    }
    return changed;
}

float widest_name(const Parameter *parameters)
{
    float widest = 0;
    for (; parameters->name; parameters++)
        widest = std::max(widest, ImGui::CalcTextSize(parameters->name).x);
    return widest;
}

uint32_t edit_all(Context &context, const Parameter *parameters, const ParameterValue *defaults)
{
    const ImGuiStyle &style = ImGui::GetStyle();
    uint32_t changed = 0;
    bool others = false;
    const float all = ImGui::GetContentRegionMax().x;
    const float left =
        std::min(style.WindowPadding.x + widest_name(parameters) + style.ItemSpacing.x, all / 2);
    const float right = all - ImGui::GetFrameHeight();
    const float width = std::max(right - left - style.ItemSpacing.x, 8.0f);
    for (int i = 0; i < MAX_PARAMETERS && parameters[i].name; i++) {
        const Parameter &parameter = parameters[i];
        const ParameterValue *value = defaults ? &defaults[i] : nullptr;
        ImGui::PushID(i);
        ImGui::AlignTextToFramePadding();
        put_text(parameter.name);
        tooltip(parameter);
        ImGui::SameLine(left);
        bool now = edit(context, parameter, width);
        if (!parameter.choices && parameter.kind != PARAMETER_COLOR)
            tooltip(parameter);
        others |= can_reset(parameter, value);
        now |= reset_button(context, parameter, value, right);
        if (now && parameter.changed)
            parameter.changed(&parameter);
        ImGui::PopID();
        changed |= uint32_t(now) << i;
    }
    if (others && ImGui::Button("Reset all"))
        changed |= reset_all(parameters, defaults);
    return changed;
}

uint32_t parameters_section(Context &context, const PanelContent &content)
{
    if (!content.parameters || !content.parameters[0].name ||
        !ImGui::CollapsingHeader("Parameters", ImGuiTreeNodeFlags_DefaultOpen))
        return 0;
    return edit_all(context, content.parameters, content.defaults);
}

// The lights have the numbers of their rings.
void lights_section(Context &context, const PanelContent &content, PanelResult &result)
{
    if (!content.lights || !content.lights[0].name || !ImGui::CollapsingHeader("Lights"))
        return;
    ImGui::PushID("lights");
    result.lights = edit_all(context, content.lights, content.light_defaults);
    ImGui::PopID();
}

// The common options, and the size of letters.
void options_section(Context &context, const PanelContent &content, PanelResult &result)
{
    if (!content.options || !ImGui::CollapsingHeader("Drawing"))
        return;
    ImGui::PushID("options");
    result.options = edit_all(context, content.options, content.option_defaults);
    ImGui::AlignTextToFramePadding();
    put_text("letters");
    ImGui::SameLine();
    result.larger -= ImGui::Button("smaller");
    ImGui::SameLine();
    result.larger += ImGui::Button("larger");
    ImGui::PopID();
}

// Returns the arguments whose button was pressed.
const char *tries_section(const PanelContent &content)
{
    const char *tried = nullptr;
    if (!content.tries || !content.tries[0] || !ImGui::CollapsingHeader("Things to try"))
        return nullptr;
    for (int i = 0; content.tries[i]; i++) {
        ImGui::PushID(i);
        if (ImGui::Button(content.tries[i]))
            tried = content.tries[i];
        if (content.looks && content.looks[i]) {
            ImGui::PushStyleColor(ImGuiCol_Text, DIM);
            put_wrapped(content.looks[i]);
            ImGui::PopStyleColor();
        }
        ImGui::PopID();
    }
    return tried;
}

// A line that is there always, so that what is below stays where it is. Dim: of an earlier picture,
// while this one's is computed.
void error_row(const char *name, const char *help, const PanelErrorPart &part,
               const PanelError &error, float left)
{
    ImGui::TextUnformatted(name);
    bool hovered = ImGui::IsItemHovered();
    ImGui::SameLine(left);
    ImGui::PushStyleColor(ImGuiCol_Text, error.computing || !error.known ? DIM : PLAIN);
    if (!error.known)
        ImGui::TextUnformatted("is computed");
    else if (std::isnan(part.rms))
        ImGui::TextUnformatted("none");
    else
        ImGui::Text("rms %.3g, at most %.3g", part.rms, part.maximum);
    ImGui::PopStyleColor();
    hovered |= ImGui::IsItemHovered();
    if (hovered)
        ImGui::SetTooltip("%s", help);
}

// A switch, and what its colors mean.
void map_row(const PanelError &error, PanelResult &result)
{
    static const char *const errors[] = {"0.5", "4", "32", "255"};
    ImGui::Checkbox("map", &result.mapped);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("where the picture differs from the exact one of the shapes");
    for (int i = 0; i < 4 && error.colors; i++) {
        const unsigned char *color = error.colors[i];
        ImGui::SameLine();
        ImGui::TextColored(ImVec4(color[0] / 255.0f, color[1] / 255.0f, color[2] / 255.0f, 1),
                           "\u25a0 %s", errors[i]);
    }
}

void cost_section(const PanelContent &content, PanelResult &result)
{
    const PanelError &error = content.error;
    if (!ImGui::CollapsingHeader("Cost", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    const float left = ImGui::GetStyle().WindowPadding.x + ImGui::GetFontSize() * 7;
    ImGui::TextUnformatted("Frame");
    ImGui::SameLine(left);
    if (content.milliseconds > 0 && content.frames_per_second > 0)
        ImGui::Text("%.2f ms; %.0f a second", content.milliseconds, content.frames_per_second);
    else if (content.milliseconds > 0)
        ImGui::Text("%.2f ms; time stands still", content.milliseconds);
    else
        ImGui::TextDisabled("not measured yet");
    if (!error.known && !error.computing) // there may be nothing to compare with
        return;
    ImGui::TextUnformatted("Errors");
    ImGui::SameLine(left);
    ImGui::TextDisabled("in steps of 1/255, at %.2f s", error.seconds);
    error_row("of computing",
              "inside objects, against the exact picture of the meshes:\n"
              "rounding and precision; not known of a simplified picture",
              error.of_computing, error, left);
    error_row(
        "of the mesh",
        "inside objects, against the exact picture of the smooth shapes, lit at every point:\n"
        "flat triangles and interpolation, and the error of computing",
        error.of_mesh, error, left);
    error_row("at edges",
              "elsewhere, against the exact picture, whose edges are smooth:\n"
              "steps and corners of outlines",
              error.at_edges, error, left);
    map_row(error, result);
}

// What is left out is dim; what it is the list of, a heading.
ImVec4 effect_color(const char *begin, const char *end)
{
    static const char without[] = "without ", is_not[] = " not ";
    while (begin < end && *begin == ' ')
        begin++;
    if (begin < end && *begin == '#')
        return HEADING;
    const char *colon = std::find(begin, end, ':');
    const bool left_out = size_t(end - begin) >= sizeof without - 1 &&
                          std::memcmp(begin, without, sizeof without - 1) == 0;
    return left_out || std::search(begin, colon, is_not, is_not + sizeof is_not - 1) != colon
               ? DIM
               : PLAIN;
}

// Wrapped, each line in its color, in a window of its own that scrolls.
void put_lines(const char *name, const char *text, float height,
               ImVec4 (*color)(const char *begin, const char *end))
{
    if (ImGui::BeginChild(name, ImVec2(0, height), false,
                          ImGuiWindowFlags_AlwaysUseWindowPadding)) {
        const char *const last = text + strnlen(text, 4 * LONGEST_TEXT);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                            ImVec2(0, std::round(ImGui::GetStyle().ItemSpacing.y / 3)));
        ImGui::PushTextWrapPos(0);
        while (text < last) {
            const char *end = std::find(text, last, '\n');
            ImGui::PushStyleColor(ImGuiCol_Text, color(text, end));
            ImGui::TextUnformatted(text, text + std::min(size_t(end - text), LONGEST_TEXT));
            ImGui::PopStyleColor();
            text = end < last ? end + 1 : last;
        }
        ImGui::PopTextWrapPos();
        ImGui::PopStyleVar();
    }
    ImGui::EndChild();
}

// What is computed with numbers in it is dim.
ImVec4 pixel_color(const char *begin, const char *end)
{
    while (begin < end && *begin == ' ')
        begin++;
    return begin < end && std::strchr("=+-*/", *begin) ? DIM : PLAIN;
}

void pixel_section(const PanelContent &content, PanelResult &result)
{
    constexpr float LINES = 12;
    const PanelPixel &pixel = content.pixel;
    char label[96];
    bool open = true;
    if (!pixel.text)
        return;
    std::snprintf(label, sizeof label, "%s###pixel", pixel.title);
    const bool shown = ImGui::CollapsingHeader(label, &open, ImGuiTreeNodeFlags_DefaultOpen);
    result.pixel_closed = !open;
    if (!shown)
        return;
    put_lines("pixel", pixel.text, LINES * ImGui::GetTextLineHeightWithSpacing(), pixel_color);
    ImGui::AlignTextToFramePadding();
    put_text("show");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##show", pixel.shown[0] ? pixel.shown : "the picture")) {
        if (ImGui::Selectable("the picture", !pixel.shown[0]))
            result.shown = "";
        for (const char *const *name = pixel.names; *name; name++)
            if (ImGui::Selectable(*name, std::strcmp(*name, pixel.shown) == 0))
                result.shown = *name;
        close_popup_on_escape();
        ImGui::EndCombo();
    }
    if (!pixel.legend)
        return;
    ImGui::PushStyleColor(ImGuiCol_Text, DIM);
    put_wrapped(pixel.legend);
    ImGui::PopStyleColor();
}

// The rows of some objects that follow each other.
void put_rows(Context &context, const PanelObject *objects, int count)
{
    ImGuiListClipper clipper;
    clipper.Begin(count);
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; i++) {
            const int number = objects[i].number;
            ImGui::PushID(number); // rows may be equal
            if (ImGui::Selectable(objects[i].row, number == context.object))
                context.object = number == context.object ? -1 : number;
            ImGui::PopID();
        }
}

// One of many objects is chosen from a list that scrolls, in which those with the same effects are
// a row that opens; its effects are below.
void put_objects(Context &context, const PanelObjects &objects, float height)
{
    const PanelObject *all = objects.all, *shown = all;
    if (ImGui::BeginChild("objects", ImVec2(0, height / 2), true))
        for (int i = 0, end; i < objects.count; i = end) {
            for (end = i + 1; end < objects.count && std::strcmp(all[i].same, all[end].same) == 0;)
                end++;
            const bool alone = end == i + 1;
            if (!alone && !ImGui::TreeNode(all[i].same, "%d of %d objects: %s", end - i,
                                           objects.count, all[i].same))
                continue;
            put_rows(context, all + i, end - i);
            if (!alone)
                ImGui::TreePop();
        }
    ImGui::EndChild();
    for (int i = 0; i < objects.count; i++)
        shown = all[i].number == context.object ? &all[i] : shown;
    put_lines("effects", shown->effects, height / 2, effect_color);
}

// As high as the rest of the panel leaves room for. Returns its height.
float effects_section(Context &context, const PanelContent &content, float room)
{
    constexpr float MIN_LINES = 4, MAX_LINES = 16;
    if (!content.effects || !content.effects[0] ||
        !ImGui::CollapsingHeader("Effects", ImGuiTreeNodeFlags_DefaultOpen))
        return 0;
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const float height =
        std::min(std::max(room - context.other_height, MIN_LINES * line), MAX_LINES * line);
    if (content.objects.count > MANY)
        put_objects(context, content.objects, height);
    else
        put_lines("effects", content.effects, height, effect_color);
    return height;
}

void command_section(Context &context, const PanelContent &content)
{
    if (!content.command || !ImGui::CollapsingHeader("Command", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    ImGui::PushFont(context.mono);
    put_wrapped(content.command);
    ImGui::PopFont();
    if (ImGui::Button("Copy"))
        ImGui::SetClipboardText(content.command);
}

} // namespace

void sections(Context &context, const PanelContent &content, float max, PanelResult &result)
{
    pixel_section(content, result);
    result.changed = parameters_section(context, content);
    options_section(context, content, result);
    lights_section(context, content, result);
    result.tried = tries_section(content);
    cost_section(content, result);
    const float effects = effects_section(context, content, max);
    command_section(context, content);
    const float height = ImGui::GetCursorPosY() + ImGui::GetScrollY() +
                         ImGui::GetStyle().WindowPadding.y - ImGui::GetStyle().ItemSpacing.y;
    context.other_height = height - effects;
}

} // namespace panel
