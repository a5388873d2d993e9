// What panel.c asks of Dear ImGui: the panel's C++. Built as a module, loaded at the first need; of
// the library no backend is linked, so that this needs neither GL nor a window.
// No exception leaves a function.

#include "window/panel_module.h"

#include <imgui.h>
#include <imgui_internal.h> // which field is being typed into, for set_number

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace
{

static_assert(sizeof(PanelVertex) == sizeof(ImDrawVert) &&
                  offsetof(PanelVertex, u) == offsetof(ImDrawVert, uv) &&
                  offsetof(PanelVertex, color) == offsetof(ImDrawVert, col),
              "vertices are copied as they are");
static_assert(sizeof(ImDrawIdx) == sizeof(uint16_t), "indices are copied as they are");

// In pixels of an ordinary screen.
constexpr float TEXT_SIZE = 14, MONO_SIZE = 13;
constexpr size_t LONGEST_TEXT = 8192; // in one piece: a letter is 4 vertices, with 16-bit indices

const ImVec4 PLAIN(0.90f, 0.91f, 0.93f, 1), DIM(0.56f, 0.59f, 0.64f, 1),
    HEADING(0.55f, 0.75f, 1.00f, 1), ERROR(0.93f, 0.26f, 0.24f, 1);

constexpr int MAX_PARAMETERS = 32; // bits of PanelResult.changed

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
    float other_height = 0; // of the panel without its list of effects, in the frame before
    const PanelInput *input = nullptr; // of this frame
    std::vector<PanelVertex> vertices;
    std::vector<uint16_t> indices;
    std::vector<PanelCommand> commands;
};

// The context of ImGui's callbacks, which get a pointer of ours.

const char *get_clipboard(void *user)
{
    const PanelInput *input = static_cast<Context *>(user)->input;
    const char *text = input && input->get_clipboard ? input->get_clipboard(input->clipboard) : "";
    return text ? text : "";
}

void set_clipboard(void *user, const char *text)
{
    const PanelInput *input = static_cast<Context *>(user)->input;
    if (input && input->set_clipboard)
        input->set_clipboard(input->clipboard, text);
}

// Fonts and style.

// A TrueType font of the system. The library ends the program over a file that is none.
ImFont *add_font(const char *name, float size)
{
    static const char *const folders[] = {"/usr/share/fonts/truetype/dejavu",
                                          "/usr/share/fonts/TTF",
                                          "/usr/share/fonts/dejavu",
                                          "/usr/share/fonts/dejavu-sans-fonts",
                                          "/usr/share/fonts/dejavu-sans-mono-fonts",
                                          "/usr/local/share/fonts"};
    // Latin, Greek, Cyrillic; dashes and quotes; arrows; comparisons.
    static const ImWchar letters[] = {0x20,   0x17f,  0x370,  0x4ff,  0x2010,
                                      0x2027, 0x2190, 0x2193, 0x21ba, 0x21ba,
                                      0x2260, 0x2265, 0x25a0, 0x25a0, 0};
    static const unsigned char true_type[4] = {0, 1, 0, 0};
    for (const char *folder : folders) {
        const std::string path = std::string(folder) + "/" + name;
        size_t bytes = 0;
        void *data = ImFileLoadToMemory(path.c_str(), "rb", &bytes);
        if (!data)
            continue;
        if (bytes < 1024 || bytes > INT32_MAX || std::memcmp(data, true_type, 4) != 0) {
            ImGui::MemFree(data);
            continue;
        }
        ImFontConfig config;
        config.OversampleH = 1; // letters are drawn pixel by pixel
        config.PixelSnapH = true;
        return ImGui::GetIO().Fonts->AddFontFromMemoryTTF(data, int(bytes), size, &config, letters);
    }
    return nullptr;
}

ImFont *add_own_font(float size)
{
    ImFontConfig config;
    config.SizePixels = size;
    return ImGui::GetIO().Fonts->AddFontDefault(&config);
}

void make_fonts(Context &context)
{
    ImFontAtlas *atlas = ImGui::GetIO().Fonts;
    const float text = std::round(TEXT_SIZE * context.scale);
    const float mono = std::round(MONO_SIZE * context.scale);
    atlas->Clear();
    atlas->Flags |= ImFontAtlasFlags_NoMouseCursors;
    context.sans = add_font("DejaVuSans.ttf", text);
    context.mono = add_font("DejaVuSansMono.ttf", mono);
    if (!context.sans)
        context.sans = add_own_font(text);
    if (!context.mono)
        context.mono = add_own_font(mono);
    if (!atlas->Build()) {
        atlas->Clear();
        context.sans = context.mono = add_own_font(text);
        atlas->Build();
    }
#if IMGUI_VERSION_NUM >= 19200
    const bool has_sign = context.sans->IsGlyphInFont(0x21ba);
#else
    const bool has_sign = context.sans->FindGlyphNoFallback(0x21ba) != nullptr;
#endif
    context.reset_sign = has_sign ? "\u21ba" : "<";
    atlas->SetTexID((ImTextureID)1); // the only one; a pointer before 1.92, a number since
    context.generation++;
}

void make_style(float scale)
{
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowPadding = ImVec2(8, 8);
    style.FramePadding = ImVec2(6, 3);
    style.ItemSpacing = ImVec2(6, 5);
    style.ItemInnerSpacing = ImVec2(5, 4);
    style.ScrollbarSize = 11;
    style.GrabMinSize = 9;
    style.WindowRounding = style.PopupRounding = style.ChildRounding = 4;
    style.FrameRounding = style.GrabRounding = 3;
    style.WindowMinSize = ImVec2(4, 4);
    style.AntiAliasedLinesUseTex = false; // that would want the atlas to be interpolated
    const auto set = [&style](ImGuiCol what, float r, float g, float b, float a) {
        style.Colors[what] = ImVec4(r, g, b, a);
    };
    style.Colors[ImGuiCol_Text] = PLAIN;
    style.Colors[ImGuiCol_TextDisabled] = DIM;
    set(ImGuiCol_WindowBg, 0.07f, 0.08f, 0.10f, 0.88f);
    set(ImGuiCol_PopupBg, 0.07f, 0.08f, 0.10f, 1);
    set(ImGuiCol_ChildBg, 0, 0, 0, 0.25f);
    set(ImGuiCol_Border, 0.35f, 0.38f, 0.44f, 0.5f);
    set(ImGuiCol_FrameBg, 0.20f, 0.23f, 0.28f, 0.9f);
    set(ImGuiCol_FrameBgHovered, 0.27f, 0.32f, 0.40f, 0.9f);
    set(ImGuiCol_FrameBgActive, 0.30f, 0.37f, 0.48f, 0.9f);
    set(ImGuiCol_Header, 0.18f, 0.23f, 0.31f, 0.9f);
    set(ImGuiCol_HeaderHovered, 0.24f, 0.32f, 0.44f, 0.9f);
    set(ImGuiCol_HeaderActive, 0.28f, 0.38f, 0.52f, 0.9f);
    set(ImGuiCol_Button, 0.24f, 0.32f, 0.44f, 0.9f);
    set(ImGuiCol_SliderGrab, 0.27f, 0.45f, 0.72f, 1);
    set(ImGuiCol_SliderGrabActive, 0.35f, 0.57f, 0.90f, 1);
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

void rescale(Context &context, double scale)
{
    if (context.scale == float(scale))
        return;
    context.scale = float(scale);
    make_style(context.scale);
    make_fonts(context);
}

// Input.

#if IMGUI_VERSION_NUM >= 18700 && IMGUI_VERSION_NUM < 18900
constexpr ImGuiKey ImGuiMod_Ctrl = ImGuiKey_ModCtrl, ImGuiMod_Shift = ImGuiKey_ModShift;
#endif

// Events from version 1.87 on; before, the state of everything.
void take_input(const PanelInput &input)
{
    static const struct {
        ImGuiKey key;
        WindowKey window;
    } keys[] = {
        {ImGuiKey_Escape, WINDOW_KEY_ESCAPE},
        {ImGuiKey_Enter, WINDOW_KEY_ENTER},
        {ImGuiKey_Tab, WINDOW_KEY_TAB},
        {ImGuiKey_Backspace, WINDOW_KEY_BACKSPACE},
        {ImGuiKey_Delete, WINDOW_KEY_DELETE},
        {ImGuiKey_LeftArrow, WINDOW_KEY_LEFT},
        {ImGuiKey_RightArrow, WINDOW_KEY_RIGHT},
        {ImGuiKey_UpArrow, WINDOW_KEY_UP},
        {ImGuiKey_DownArrow, WINDOW_KEY_DOWN},
        {ImGuiKey_Home, WINDOW_KEY_HOME},
        {ImGuiKey_End, WINDOW_KEY_END},
        {ImGuiKey_A, WINDOW_KEY_A},
        {ImGuiKey_C, WINDOW_KEY_C},
        {ImGuiKey_V, WINDOW_KEY_V},
        {ImGuiKey_X, WINDOW_KEY_X},
    };
    const WindowInput &window = *input.window;
    ImGuiIO &io = ImGui::GetIO();
    io.DisplaySize = ImVec2(float(window.width), float(window.height));
    io.DeltaTime = float(std::max(input.seconds, 1e-6)); // zero is refused
#if IMGUI_VERSION_NUM >= 18700
    io.ConfigInputTrickleEventQueue = false; // the input of a frame is all at once
    io.AddMousePosEvent(float(window.x), float(window.y));
    for (int i = 0; i < WINDOW_BUTTONS; i++)
        io.AddMouseButtonEvent(i, window.buttons[i]);
    io.AddMouseWheelEvent(0, float(window.scroll));
    io.AddKeyEvent(ImGuiMod_Ctrl, window.control);
    io.AddKeyEvent(ImGuiMod_Shift, window.shift);
    for (const auto &key : keys)
        io.AddKeyEvent(key.key, window.down[key.window]);
#else
    io.MousePos = ImVec2(float(window.x), float(window.y));
    for (int i = 0; i < WINDOW_BUTTONS; i++)
        io.MouseDown[i] = window.buttons[i];
    io.MouseWheel = float(window.scroll);
    io.KeyCtrl = window.control;
    io.KeyShift = window.shift;
    for (const auto &key : keys) {
        io.KeyMap[key.key] = key.window;
        io.KeysDown[key.window] = window.down[key.window];
    }
#endif
    for (int i = 0; i < window.typed_count; i++)
        io.AddInputCharacter(window.typed[i]);
}

bool popup_open()
{
    return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

bool escape_pressed()
{
#if IMGUI_VERSION_NUM >= 18700
    return ImGui::IsKeyPressed(ImGuiKey_Escape, false);
#else
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
#endif
}

void close_popup_on_escape()
{
    if (escape_pressed())
        ImGui::CloseCurrentPopup();
}

// Text.

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

int choice_count(const Parameter &parameter)
{
    int count = 0;
    while (parameter.choices[count])
        count++;
    return count;
}

// A few choices lie side by side, and go on below where they do not fit.
bool edit_few_choices(const Parameter &parameter, int *own, float right)
{
    bool changed = false;
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
    const int count = choice_count(parameter);
    if (count > FEW)
        return edit_many_choices(parameter, own, count);
    ImGui::BeginGroup();
    const bool changed = edit_few_choices(parameter, own, right);
    ImGui::EndGroup();
    return changed;
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

bool edit_switch(const Parameter &parameter)
{
    bool *own = static_cast<bool *>(parameter.value), on = *own;
    if (!ImGui::Checkbox("##value", &on))
        return false;
    *own = on;
    return true;
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
    bool changed = false;
    ImVec4 seen(float(color->x), float(color->y), float(color->z), 1);
    for (float *part : {&seen.x, &seen.y, &seen.z})
        *part = std::isfinite(*part) ? std::min(std::max(*part, 0.0f), 1.0f) : 0;
    for (int i = 0; i < 3; i++) {
        static const char *const labels[] = {"##red", "##green", "##blue"};
        ImGui::SetNextItemWidth(std::floor((width - button - 3 * spacing) / 3));
        changed |= slide(context, labels[i], parts[i], parameter, true);
        tooltip(parameter);
        ImGui::SameLine(0, spacing);
    }
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
    case PARAMETER_FLAG:
        if (parameter.kind == PARAMETER_SWITCH && parameter.choices) {
            ImGui::BeginGroup();
            const bool changed = edit_named_switch(parameter, right);
            ImGui::EndGroup();
            return changed;
        }
        return edit_switch(parameter);
    case PARAMETER_COLOR:
        return edit_color(context, parameter, width);
    case PARAMETER_TEXT:
        if (parameter.choices) {
            ImGui::BeginGroup();
            const bool changed = edit_text_choice(parameter, right);
            ImGui::EndGroup();
            return changed;
        }
        show_text(parameter, width);
        return false;
    }
    return false;
}

// The sections of the panel.

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

// As high as the rest of the panel leaves room for. Returns its height.
float effects_section(const Context &context, const PanelContent &content, float room)
{
    constexpr float MIN_LINES = 4, MAX_LINES = 12;
    if (!content.effects || !content.effects[0] ||
        !ImGui::CollapsingHeader("Effects", ImGuiTreeNodeFlags_DefaultOpen))
        return 0;
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const float height =
        std::min(std::max(room - context.other_height, MIN_LINES * line), MAX_LINES * line);
    if (ImGui::BeginChild("effects", ImVec2(0, height), false,
                          ImGuiWindowFlags_AlwaysUseWindowPadding)) {
        const char *text = content.effects;
        const char *const last = text + strnlen(text, 4 * LONGEST_TEXT);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                            ImVec2(0, std::round(ImGui::GetStyle().ItemSpacing.y / 3)));
        ImGui::PushTextWrapPos(0);
        while (text < last) {
            const char *end = std::find(text, last, '\n');
            ImGui::PushStyleColor(ImGuiCol_Text, effect_color(text, end));
            ImGui::TextUnformatted(text, text + std::min(size_t(end - text), LONGEST_TEXT));
            ImGui::PopStyleColor();
            text = end < last ? end + 1 : last;
        }
        ImGui::PopTextWrapPos();
        ImGui::PopStyleVar();
    }
    ImGui::EndChild();
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

// The windows.

constexpr ImGuiWindowFlags FIXED = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_AlwaysAutoResize;
constexpr ImGuiWindowFlags OVERLAY =
    FIXED | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing;

float margin(const Context &context)
{
    return std::round(PANEL_MARGIN * context.scale);
}

// Its sections, below the title, in a window that may have this height.
void sections(Context &context, const PanelContent &content, float max, PanelResult &result)
{
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

bool title(const char *name, bool open)
{
    char label[256];
    std::snprintf(label, sizeof label, "%s###title", name);
    ImGui::SetNextItemOpen(open);
    ImGui::PushStyleColor(ImGuiCol_Header, ImVec4(0.20f, 0.36f, 0.58f, 0.9f));
    const bool now = ImGui::CollapsingHeader(label);
    ImGui::PopStyleColor();
    return now;
}

void panel_window(Context &context, const PanelContent &content, PanelResult &result)
{
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const ImGuiStyle &style = ImGui::GetStyle();
    const float edge = margin(context);
    const bool open = content.view == PANEL_OPEN;
    const char *name = content.name ? content.name : "";
    const float own_width = ImGui::CalcTextSize(name).x + ImGui::GetFontSize() +
                            4 * style.FramePadding.x + 2 * style.WindowPadding.x;
    // Beside the picture, or above it; the errors are below.
    const int *place = context.input->place;
    const float left = open ? float(place[2]) : 0;
    const float bottom = float(open ? place[1] + place[3] : place[1]);
    const float most = display.x - left - 2 * edge, max = bottom - 2 * edge;
    if (most < 4 * edge || max < 2 * edge)
        return;
    const float width = open ? most : std::min(own_width, most);
    ImGui::SetNextWindowPos(ImVec2(left + edge, edge));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, max));
    const ImGuiWindowFlags flags =
        (FIXED & ~ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_NoBringToFrontOnFocus;
    if (ImGui::Begin("panel", nullptr, flags)) {
        result.view = title(name, open) ? PANEL_OPEN : PANEL_FOLDED;
        if (open)
            sections(context, content, max, result);
    }
    ImGui::End();
}

// Monospaced, in a red frame below the picture.
void errors_window(Context &context, const char *errors)
{
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float edge = margin(context);
    const float top = float(context.input->place[1] + context.input->place[3]) + edge;
    const ImVec2 size(display.x - 2 * edge, display.y - top - edge);
    if (size.x < 4 || size.y < 4)
        return;
    ImGui::SetNextWindowPos(ImVec2(edge, top));
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleColor(ImGuiCol_Border, ERROR);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.13f, 0.04f, 0.04f, 0.93f));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 2 * context.scale);
    if (ImGui::Begin("errors", nullptr,
                     (FIXED & ~(ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_AlwaysAutoResize)) |
                         ImGuiWindowFlags_NoFocusOnAppearing)) {
        ImGui::PushFont(context.mono);
        put_wrapped(errors);
        ImGui::PopFont();
    }
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor(2);
}

// Rings with numbers, behind the panel.
void draw_marks(const Context &context, const PanelContent &content)
{
    ImDrawList *list = ImGui::GetBackgroundDrawList();
    const int *place = context.input->place;
    list->PushClipRect(ImVec2(0, float(place[1])),
                       ImVec2(float(place[2]), float(place[1] + place[3])));
    for (int i = 0; i < content.mark_count; i++) {
        const PanelMark &mark = content.marks[i];
        const ImVec2 at(float(mark.x), float(mark.y));
        const float radius = 9 * context.scale;
        const ImU32 color = mark.held ? IM_COL32(255, 210, 80, 255) : IM_COL32(120, 190, 255, 255);
        char number[16];
        std::snprintf(number, sizeof number, "%d", mark.number);
        list->AddCircle(at, radius, IM_COL32(0, 0, 0, 255), 24, 3.5f * context.scale);
        list->AddCircle(at, radius, color, 24, 1.5f * context.scale);
        list->AddText(ImVec2(at.x + radius, at.y + radius / 2), color, number);
    }
    list->PopClipRect();
}

void help_window(const PanelHelp *help)
{
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    float left = 0;
    for (const PanelHelp *line = help; line->key; line++)
        left = std::max(left, ImGui::CalcTextSize(line->key).x);
    left += ImGui::GetStyle().WindowPadding.x + ImGui::GetFontSize();
    ImGui::SetNextWindowPos(ImVec2(std::round(display.x / 2), std::round(display.y / 2)),
                            ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    if (ImGui::Begin("help", nullptr, OVERLAY)) {
        for (; help->key; help++) {
            ImGui::TextColored(HEADING, "%s", help->key);
            ImGui::SameLine(left);
            put_text(help->action);
        }
    }
    ImGui::End();
}

void notice_window(const Context &context, const char *notice)
{
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float edge = margin(context);
    const float max = std::max(display.x - 2 * edge, 4.0f);
    const float padding = 2 * ImGui::GetStyle().WindowPadding.x;
    const float width = std::min(ImGui::CalcTextSize(notice).x + padding + 1, max);
    // In the picture's upper left corner.
    const float top = float(context.input->place[1]);
    ImGui::SetNextWindowPos(ImVec2(edge, top + edge));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, FLT_MAX));
    if (ImGui::Begin("notice", nullptr, OVERLAY))
        put_wrapped(notice);
    ImGui::End();
}

// Output.

void add_command(Context &context, const ImDrawCmd &from, int vertex, int index)
{
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const int left = int(std::max(from.ClipRect.x, 0.0f)),
              top = int(std::max(from.ClipRect.y, 0.0f));
    const int right = int(std::ceil(std::min(from.ClipRect.z, display.x)));
    const int bottom = int(std::ceil(std::min(from.ClipRect.w, display.y)));
    if (from.ElemCount == 0 || right <= left || bottom <= top)
        return;
    context.commands.push_back({index + int(from.IdxOffset), int(from.ElemCount),
                                vertex + int(from.VtxOffset), left, top, right - left,
                                bottom - top});
}

PanelDrawing collect(Context &context)
{
    const ImDrawData *data = ImGui::GetDrawData();
    PanelDrawing drawing = {};
    unsigned char *atlas;
    context.vertices.clear();
    context.indices.clear();
    context.commands.clear();
    for (int i = 0; i < data->CmdListsCount; i++) {
        const ImDrawList *list = data->CmdLists[i];
        const int vertex = int(context.vertices.size()), index = int(context.indices.size());
        for (const ImDrawCmd &command : list->CmdBuffer)
            add_command(context, command, vertex, index);
        const auto *vertices = reinterpret_cast<const PanelVertex *>(list->VtxBuffer.Data);
        context.vertices.insert(context.vertices.end(), vertices, vertices + list->VtxBuffer.Size);
        context.indices.insert(context.indices.end(), list->IdxBuffer.begin(),
                               list->IdxBuffer.end());
    }
    drawing.vertices = context.vertices.data();
    drawing.indices = context.indices.data();
    drawing.commands = context.commands.data();
    drawing.vertex_count = int(context.vertices.size());
    drawing.index_count = int(context.indices.size());
    drawing.command_count = int(context.commands.size());
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&atlas, &drawing.atlas_width, &drawing.atlas_height);
    drawing.atlas = atlas;
    drawing.generation = context.generation;
    return drawing;
}

// What panel.c calls.

bool fail(char *reason, size_t size, const char *text)
{
    std::snprintf(reason, size, "%s", text);
    return false;
}

template <typename Work> bool guarded(char *reason, size_t size, Work work)
{
    try {
        work();
        return true;
    } catch (const std::exception &exception) {
        return fail(reason, size, exception.what());
    } catch (...) {
        return fail(reason, size, "an unknown exception");
    }
}

void close(void *opaque)
{
    Context *context = static_cast<Context *>(opaque);
    if (context && context->imgui)
        ImGui::DestroyContext(context->imgui);
    delete context;
}

bool open(void **opaque, char *reason, size_t reason_size)
{
    return guarded(reason, reason_size, [&] {
        std::unique_ptr<Context> context(new Context);
        context->imgui = ImGui::CreateContext();
        ImGui::SetCurrentContext(context->imgui);
        ImGuiIO &io = ImGui::GetIO();
        io.IniFilename = io.LogFilename = nullptr; // no files
        io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
        io.GetClipboardTextFn = get_clipboard;
        io.SetClipboardTextFn = set_clipboard;
        io.ClipboardUserData = context.get();
        *opaque = context.release();
    });
}

void make_frame(Context &context, const PanelContent &content, PanelResult &result)
{
    ImGui::NewFrame();
    const ImGuiIO &io = ImGui::GetIO();
    result.wants_pointer = io.WantCaptureMouse;
    result.wants_keys = io.WantTextInput || popup_open(); // as they were when the keys were hit
    if (content.view == PANEL_OPEN && content.marks)
        draw_marks(context, content);
    if (content.view != PANEL_HIDDEN)
        panel_window(context, content, result);
    if (content.errors)
        errors_window(context, content.errors);
    if (content.help)
        help_window(content.help);
    if (content.notice)
        notice_window(context, content.notice);
    if (context.typing.field && !ImGui::TempInputIsActive(context.typing.field))
        context.typing = {}; // its field is gone
    ImGui::Render();
}

bool frame(void *opaque, const PanelInput *input, const PanelContent *content, PanelResult *result,
           char *reason, size_t reason_size)
{
    Context &context = *static_cast<Context *>(opaque);
    ImGui::SetCurrentContext(context.imgui);
    context.input = input;
    const bool done = guarded(reason, reason_size, [&] {
        rescale(context, input->window->scale);
        take_input(*input);
        make_frame(context, *content, *result);
        result->drawing = collect(context);
    });
    context.input = nullptr;
    return done;
}

} // namespace

extern "C" __attribute__((visibility("default")))
const PanelModule panel_module = {ImGui::GetVersion, open, frame, close};
