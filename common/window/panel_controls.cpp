// A control for each kind of parameter, and the text around it.
#include "window/panel_imgui.h"

#include <imgui_internal.h> // which field is being typed into

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace panel
{

void put_text(const char *text)
{
    ImGui::TextUnformatted(text, text + strnlen(text, LONGEST_TEXT));
}

void put_wrapped(const char *text)
{
    ImGui::PushTextWrapPos(0);
    put_text(text);
    ImGui::PopTextWrapPos();
}

void tooltip(const Parameter &parameter)
{
    if (!ImGui::IsItemHovered() || ImGui::IsMouseDown(ImGuiMouseButton_Left))
        return; // it would be in the way of a drag
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 20);
    put_text(parameter.help ? parameter.help : parameter.name);
    const ParameterKind kind = parameter.kind;
    if (kind == PARAMETER_NUMBER || kind == PARAMETER_WHOLE || kind == PARAMETER_COLOR)
        ImGui::TextDisabled("%g to %g; Ctrl and a click: type it", parameter.min, parameter.max);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

bool is_typed(const Typing &typing)
{
    return ImGui::TempInputIsActive(typing.field);
}

namespace
{

bool escape_pressed()
{
#if IMGUI_VERSION_NUM >= 18700
    return ImGui::IsKeyPressed(ImGuiKey_Escape, false);
#else
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
#endif
}

} // namespace

void close_popup_on_escape()
{
    if (escape_pressed())
        ImGui::CloseCurrentPopup();
}

namespace
{

// Numbers.

// How a slider's values are written: a thousand steps from end to end, in decimal digits; over
// several decades three digits.
void step_format(double min, double max, bool logarithmic, bool whole, char format[16])
{
    const double decimals = std::ceil(-std::log10((max - min) / 1000) - 1e-9);
    if (whole)
        std::snprintf(format, 16, "%%.0f");
    else if (logarithmic || !(decimals < 18))
        std::snprintf(format, 16, "%%.3g");
    else
        std::snprintf(format, 16, "%%.%df", int(std::max(decimals, 0.0)));
}

double rounded(double value, const char *format)
{
    char text[64];
    if (std::fabs(value) > 1e15)
        return value;
    std::snprintf(text, sizeof text, format, value);
    return std::strtod(text, nullptr);
}

// As the value is, where that is not too long to be seen.
void number_format(double value, bool whole, bool narrow, char format[16])
{
    char text[32];
    std::snprintf(text, sizeof text, "%.15g", value);
    const size_t room = narrow ? 5 : 12;
    std::snprintf(format, 16, "%s",
                  whole                       ? "%.0f"
                  : std::strlen(text) <= room ? "%.15g"
                  : narrow                    ? "%.3g"
                                              : "%.6g");
}

// Sets a number to what parameter_read would accept; true where it was another one.
bool set_number(double *number, double value, double min, double max)
{
    if (!(min <= max) || std::isnan(value))
        return false;
    value = std::min(std::max(value, min), max);
    if (value == *number)
        return false;
    *number = value;
    return true;
}

// A slider, or where Ctrl is held a field to type into. A value that nobody touches keeps its bits;
// one that is typed counts when the field is left, but not by Escape.
bool slide(Context &context, const char *label, double *number, const Parameter &parameter,
           bool narrow)
{
    // Half the largest double is the most that a slider may span.
    constexpr double BOUND = DBL_MAX / 4;
    const double min = std::max(parameter.min, -BOUND), max = std::min(parameter.max, BOUND);
    const bool whole = parameter.kind == PARAMETER_WHOLE;
    const bool logarithmic = min > 0 && max / min > 1000;
    const ImGuiID field = ImGui::GetID(label);
    const bool was_typing = context.typing.field == field;
    double value = was_typing ? context.typing.value : *number;
    char step[16], format[16];
    if (!std::isfinite(value))
        value = min;
    step_format(min, max, logarithmic, whole, step);
    number_format(value, whole, narrow, format);
    if (ImGui::GetActiveID() == field && !was_typing)
        std::memcpy(format, step, sizeof format); // it is dragged, and will be rounded to this
    const bool moved =
        ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &min, &max, format,
                            ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat |
                                (logarithmic ? ImGuiSliderFlags_Logarithmic : 0));
    if (ImGui::TempInputIsActive(field)) {
        const bool edited = moved || (was_typing && context.typing.edited);
        context.typing = {field, value, edited};
        return false;
    }
    if (was_typing) {
        const bool left = escape_pressed();
        const bool edited = moved || context.typing.edited;
        context.typing = {};
        return edited && !left &&
               set_number(number, whole ? std::round(value) : value, parameter.min, parameter.max);
    }
    return moved && set_number(number, rounded(value, step), parameter.min, parameter.max);
}

// One control for each kind of parameter. Each returns whether it set the value.

bool edit_whole(Context &context, const Parameter &parameter)
{
    int *own = static_cast<int *>(parameter.value);
    double number = *own;
    if (!slide(context, "##value", &number, parameter, false))
        return false;
    *own = int(std::min(std::max(number, double(INT32_MIN)), double(INT32_MAX)));
    return true;
}

// A few choices lie side by side, and go on below where they do not fit.
bool edit_few_choices(const Parameter &parameter, int *own, float right)
{
    bool changed = false;
    ImGui::BeginGroup();
    for (int i = 0; parameter.choices[i]; i++) {
        const ImGuiStyle &style = ImGui::GetStyle();
        const float width = ImGui::GetFrameHeight() + style.ItemInnerSpacing.x +
                            ImGui::CalcTextSize(parameter.choices[i]).x;
        if (i > 0 && ImGui::GetItemRectMax().x + style.ItemSpacing.x + width <= right)
            ImGui::SameLine();
        if (ImGui::RadioButton(parameter.choices[i], *own == i) && *own != i) {
            *own = i;
            changed = true;
        }
        tooltip(parameter);
    }
    ImGui::EndGroup();
    return changed;
}

bool edit_many_choices(const Parameter &parameter, int *own, int count)
{
    const bool known = *own >= 0 && *own < count;
    bool changed = false;
    if (!ImGui::BeginCombo("##value", known ? parameter.choices[*own] : "none",
                           ImGuiComboFlags_HeightLarge)) {
        tooltip(parameter);
        return false;
    }
    for (int i = 0; i < count; i++) {
        if (ImGui::Selectable(parameter.choices[i], *own == i) && *own != i) {
            *own = i;
            changed = true;
        }
        if (*own == i && ImGui::IsWindowAppearing())
            ImGui::SetScrollHereY();
    }
    close_popup_on_escape();
    ImGui::EndCombo();
    return changed;
}

bool edit_choice(const Parameter &parameter, float right)
{
    constexpr int FEW = 4;
    int *own = static_cast<int *>(parameter.value);
    int count = 0;
    while (parameter.choices[count])
        count++;
    return count > FEW ? edit_many_choices(parameter, own, count)
                       : edit_few_choices(parameter, own, right);
}

// A switch whose states have names: the first is true.
bool edit_named_switch(const Parameter &parameter, float right)
{
    bool *own = static_cast<bool *>(parameter.value);
    int chosen = *own ? 0 : 1;
    const bool changed = edit_few_choices(parameter, &chosen, right);
    if (changed)
        *own = chosen == 0;
    return changed;
}

// A text that is one of a few, or none: then as the program has it.
bool edit_text_choice(const Parameter &parameter, float right)
{
    const char **own = static_cast<const char **>(parameter.value);
    Parameter named = parameter;
    std::vector<const char *> names = {parameter.standard ? parameter.standard : "none"};
    int chosen = 0;
    for (int i = 0; parameter.choices[i]; i++) {
        if (*own && std::strcmp(*own, parameter.choices[i]) == 0)
            chosen = i + 1;
        names.push_back(parameter.choices[i]);
    }
    names.push_back(nullptr);
    named.choices = names.data();
    const bool changed = edit_few_choices(named, &chosen, right);
    if (changed)
        *own = chosen > 0 ? parameter.choices[chosen - 1] : nullptr;
    return changed;
}

// The picker has floats: only what it changed is taken over.
bool pick_color(double *const parts[3], const Parameter &parameter)
{
    float color[3], before[3];
    bool changed = false;
    for (int i = 0; i < 3; i++)
        color[i] = before[i] = std::isfinite(*parts[i]) ? float(*parts[i]) : 0;
    const bool picked = ImGui::ColorPicker3(
        "##picker", color,
        ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoSidePreview |
            ImGuiColorEditFlags_NoInputs | (parameter.max > 1 ? ImGuiColorEditFlags_HDR : 0));
    for (int i = 0; i < 3 && picked; i++)
        if (color[i] != before[i])
            changed |= set_number(parts[i], rounded(double(color[i]), "%.3f"), parameter.min,
                                  parameter.max);
    return changed;
}

bool edit_color(Context &context, const Parameter &parameter, float width)
{
    Vec3 *color = static_cast<Vec3 *>(parameter.value);
    double *const parts[3] = {&color->x, &color->y, &color->z};
    const float spacing = 3 * context.scale, button = ImGui::GetFrameHeight();
    const bool vector = parameter.placeholder;
    bool changed = false;
    ImVec4 seen(float(color->x), float(color->y), float(color->z), 1);
    for (float *part : {&seen.x, &seen.y, &seen.z})
        *part = std::isfinite(*part) ? std::min(std::max(*part, 0.0f), 1.0f) : 0;
    for (int i = 0; i < 3; i++) {
        static const char *const labels[] = {"##red", "##green", "##blue"};
        ImGui::SetNextItemWidth(std::floor((width - button - 3 * spacing) / 3));
        changed |= slide(context, labels[i], parts[i], parameter, true);
        tooltip(parameter);
        if (!vector || i < 2)
            ImGui::SameLine(0, spacing);
    }
    if (vector)
        return changed;
    if (ImGui::ColorButton("##color", seen, ImGuiColorEditFlags_NoTooltip, ImVec2(button, button)))
        ImGui::OpenPopup("picker");
    if (ImGui::BeginPopup("picker")) {
        changed |= pick_color(parts, parameter);
        close_popup_on_escape();
        ImGui::EndPopup();
    }
    return changed;
}

// Read only: another file is another start of the program.
void show_text(const Parameter &parameter, float width)
{
    const char *text = *static_cast<const char *const *>(parameter.value);
    if (!text || !text[0]) {
        ImGui::TextDisabled("none");
        return;
    }
    const char *name = std::strrchr(text, '/');
    const char *shown = ImGui::CalcTextSize(text).x > width && name && name[1] ? name + 1 : text;
    put_text(shown);
    if (shown != text && ImGui::IsItemHovered())
        ImGui::SetTooltip("%s", text);
}

} // namespace

bool edit(Context &context, const Parameter &parameter, float width)
{
    const float right = ImGui::GetCursorScreenPos().x + width;
    ImGui::SetNextItemWidth(width);
    switch (parameter.kind) {
    case PARAMETER_NUMBER:
        return slide(context, "##value", static_cast<double *>(parameter.value), parameter, false);
    case PARAMETER_WHOLE:
        return edit_whole(context, parameter);
    case PARAMETER_CHOICE:
        return edit_choice(parameter, right);
    case PARAMETER_SWITCH:
        if (parameter.choices)
            return edit_named_switch(parameter, right);
        [[fallthrough]];
    case PARAMETER_FLAG:
        return ImGui::Checkbox("##value", static_cast<bool *>(parameter.value));
    case PARAMETER_COLOR:
        return edit_color(context, parameter, width);
    case PARAMETER_TEXT:
        if (parameter.choices)
            return edit_text_choice(parameter, right);
        show_text(parameter, width);
        return false;
    }
    return false;
}

} // namespace panel
