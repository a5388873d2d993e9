// What panel.c asks of Dear ImGui: the panel's C++. Built as a module, loaded at the first need; of
// the library no backend is linked, so that this needs neither GL nor a window.
// No exception leaves a function.
#include "window/panel_imgui.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <memory>

namespace panel
{

namespace
{

static_assert(sizeof(PanelVertex) == sizeof(ImDrawVert) &&
                  offsetof(PanelVertex, u) == offsetof(ImDrawVert, uv) &&
                  offsetof(PanelVertex, color) == offsetof(ImDrawVert, col),
              "vertices are copied as they are");
static_assert(sizeof(ImDrawIdx) == sizeof(uint16_t), "indices are copied as they are");

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
        if (window.typed[i] < WINDOW_TYPED_KEY)
            io.AddInputCharacter(window.typed[i]);
}

bool popup_open()
{
    return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
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

// Rings with numbers, behind the panel; and one around the object that was chosen.
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
    for (int i = 0; i < content.objects.count && content.objects.count > MANY; i++) {
        const float *ring = content.objects.all[i].ring;
        const ImVec2 at(ring[0], ring[1] + float(place[1]));
        if (content.objects.all[i].number == context.object && ring[2] > 0)
            list->AddCircle(at, ring[2], IM_COL32(255, 210, 80, 255), 64, 2 * context.scale);
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

// In the picture's upper left corner; or in the lower one, or by the pointer in that in the upper.
void notice_window(const Context &context, const char *name, const char *notice, bool below)
{
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float edge = margin(context);
    const float max = std::max(display.x - 2 * edge, 4.0f);
    const float padding = 2 * ImGui::GetStyle().WindowPadding.x;
    const float width = std::min(ImGui::CalcTextSize(notice).x + padding + 1, max);
    const int *place = context.input->place;
    const float top = float(place[1]), bottom = float(place[1] + place[3]);
    below = below && context.input->window->y < place[1] + place[3] / 2;
    ImGui::SetNextWindowPos(ImVec2(edge, below ? bottom - edge : top + edge), ImGuiCond_Always,
                            ImVec2(0, below ? 1 : 0));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, FLT_MAX));
    if (ImGui::Begin(name, nullptr, OVERLAY))
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
    if (content.view == PANEL_OPEN)
        draw_marks(context, content);
    if (content.view != PANEL_HIDDEN)
        panel_window(context, content, result);
    if (content.errors)
        errors_window(context, content.errors);
    if (content.help)
        help_window(content.help);
    if (content.notice)
        notice_window(context, "notice", content.notice, false);
    if (content.view == PANEL_OPEN && content.pixel.line)
        notice_window(context, "line", content.pixel.line, true);
    if (context.typing.field && !is_typed(context.typing))
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

} // namespace panel
