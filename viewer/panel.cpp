// The panel by Dear ImGui: one call each, and nothing of it is seen outside.
#include "panel.h"

#include <GLFW/glfw3.h>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <cmath>
#include <cstdio>
#include <cstring>

// Letters as large as the desktop's, from what Linux has; else Dear ImGui's own.
static void load_font(float scale) {
    static const char *const files[] = {
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
        "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
        "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
        "/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"};
    ImFontAtlas *const fonts = ImGui::GetIO().Fonts;
    for (const char *file : files) {
        if (std::FILE *const there = std::fopen(file, "rb")) {
            std::fclose(there);
            if (fonts->AddFontFromFileTTF(file, std::floor(14 * scale))) return;
        }
    }
    ImFontConfig config;
    config.SizePixels = std::floor(13 * scale);
    fonts->AddFontDefault(&config);
}

static float unit = 1; // px of a point

bool panel_exists(void) { return true; }

bool panel_create(GLFWwindow *window, float scale) {
    IMGUI_CHECKVERSION();
    if (!ImGui::CreateContext()) return false;
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::StyleColorsLight();
    ImGuiStyle &style = ImGui::GetStyle();
    style.WindowRounding = style.FrameRounding = style.GrabRounding = 3;
    style.ItemSpacing.y = 3;
    style.Colors[ImGuiCol_WindowBg].w = 0.94f;
    style.ScaleAllSizes(scale);
    unit = scale;
    load_font(scale);
    return ImGui_ImplGlfw_InitForOpenGL(window, true) && ImGui_ImplOpenGL3_Init("#version 130");
}

void panel_destroy(void) {
    if (!ImGui::GetCurrentContext()) return;
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

bool panel_wants_mouse(void) { return ImGui::GetIO().WantCaptureMouse; }
bool panel_wants_keys(void) { return ImGui::GetIO().WantTextInput; }

void panel_begin(void) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void panel_end(void) {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void panel_side(const char *title, float width) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(8 * unit, 8 * unit), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints(ImVec2(width * unit, 0),
                                        ImVec2(width * unit, size.y - 16 * unit));
    ImGui::Begin(title, nullptr,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushItemWidth(width * unit * 0.52f);
}

void panel_note(bool in_middle) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const ImVec2 place =
        in_middle ? ImVec2(size.x / 2, size.y / 2) : ImVec2(size.x - 8 * unit, size.y - 8 * unit);
    ImGui::SetNextWindowPos(place, ImGuiCond_Always, in_middle ? ImVec2(0.5f, 0.5f) : ImVec2(1, 1));
    ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), ImVec2(size.x * 0.7f, size.y));
    ImGui::Begin(in_middle ? "##middle" : "##corner", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushItemWidth(260 * unit);
}

bool panel_box(const char *title) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    bool open = true;
    ImGui::SetNextWindowPos(ImVec2(size.x / 2, size.y / 2), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0),
                                        ImVec2(size.x - 16 * unit, size.y - 16 * unit));
    ImGui::Begin(title, &open, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
    ImGui::PushItemWidth(260 * unit);
    return open;
}

void panel_close(void) {
    ImGui::PopItemWidth();
    ImGui::End();
}

void panel_text(const char *text) {
    ImGui::PushTextWrapPos(ImGui::GetIO().DisplaySize.x * 0.66f);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
}

void panel_faint(const char *text) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
}

void panel_row(const char *left, const char *right) {
    ImGui::TextUnformatted(left);
    ImGui::SameLine(150 * unit);
    ImGui::TextUnformatted(right);
}

void panel_line(const char *title) {
    ImGui::Spacing();
    ImGui::Separator();
    if (title) ImGui::TextUnformatted(title);
}

void panel_beside(void) { ImGui::SameLine(); }
bool panel_button(const char *label) { return ImGui::Button(label); }
bool panel_check(const char *label, bool *value) { return ImGui::Checkbox(label, value); }

bool panel_slider(const char *label, double *value, double least, double most, const char *format) {
    float f = static_cast<float>(*value);
    if (!ImGui::SliderFloat(label, &f, static_cast<float>(least), static_cast<float>(most), format,
                            ImGuiSliderFlags_AlwaysClamp))
        return false;
    *value = static_cast<double>(f);
    return true;
}

bool panel_choice(const char *label, const char *words, int *index) {
    char items[1024] = {0}; // with a NUL after each, and one more
    std::snprintf(items, sizeof items - 1, "%s", words);
    for (char *at = items; (at = std::strchr(at, '|')) != nullptr; *at++ = 0) {
    }
    return ImGui::Combo(label, index, items, 16);
}

void panel_bar(double fraction, const char *text) {
    const bool known = fraction >= 0;
    const double phase = std::fmod(ImGui::GetTime(), 1.0);
    ImGui::TextUnformatted(text);
    ImGui::ProgressBar(static_cast<float>(known ? fraction : phase), ImVec2(260 * unit, 0),
                       known ? nullptr : "");
}
