// Fonts and colours of the panel.
#include "window/panel_imgui.h"

#include <imgui_internal.h> // ImFileLoadToMemory

#include <cmath>
#include <cstring>
#include <string>

namespace panel
{

// In pixels of an ordinary screen.
constexpr float TEXT_SIZE = 14, MONO_SIZE = 13;

namespace
{

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

} // namespace

void rescale(Context &context, double scale)
{
    if (context.scale == float(scale))
        return;
    context.scale = float(scale);
    make_style(context.scale);
    make_fonts(context);
}

} // namespace panel
