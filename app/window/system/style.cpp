#include "app/window/system/style.h"

#include <filesystem>
#include <string>

namespace tyndall {
namespace {

/// A font file's path in the first folder that has it, of those of Debian, Arch, Fedora and the user; "" if none has.
std::string find_font(const char* file) {
  static constexpr const char* folders[] = {"/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/",
                                            "/usr/share/fonts/truetype/jetbrains-mono/",
                                            "/usr/share/fonts/TTF/",
                                            "/usr/share/fonts/google-roboto/",
                                            "/usr/share/fonts/jetbrains-mono-fonts/",
                                            "/usr/local/share/fonts/",
                                            "/Library/Fonts/"};
  std::error_code ignored;
  for (const std::string folder : folders)
    if (std::filesystem::is_regular_file(folder + file, ignored)) return folder + file;
  return "";
}

/// Latin, Greek, Cyrillic and the signs that the panels use.
const ImWchar* glyphs() {
  static constexpr ImWchar ranges[] = {0x0020, 0x017f, 0x0370, 0x045f, 0x2010, 0x2026, 0x2070, 0x209c, 0x2190, 0x2193,
                                       0x2212, 0x2212, 0x221e, 0x221e, 0x2248, 0x2248, 0x2264, 0x2265, 0};
  return ranges;
}

ImFont* add_font(const std::string& file, float size) {
  ImFontAtlas* atlas = ImGui::GetIO().Fonts;
  if (!file.empty()) {
    ImFontConfig config;
    config.OversampleH = 2;
    config.OversampleV = 1;
    if (ImFont* font = atlas->AddFontFromFileTTF(file.c_str(), size, &config, glyphs())) return font;
  }
  ImFontConfig config;
  config.SizePixels = size;
  return atlas->AddFontDefault(&config);
}

}  // namespace

ImU32 shade(Tone colour, float alpha) {
  colour.w *= alpha;
  return ImGui::ColorConvertFloat4ToU32(colour);
}

Fonts load_fonts(float pixels, float scale) {
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  const std::string regular = find_font("Roboto-Regular.ttf"), medium = find_font("Roboto-Medium.ttf"),
                    mono = find_font("JetBrainsMono-Regular.ttf");
  Fonts fonts;
  fonts.body = add_font(regular, 16 * pixels);
  fonts.small = add_font(regular, 13 * pixels);
  fonts.strong = add_font(medium, 16 * pixels);
  fonts.mono = add_font(mono, 14 * pixels);
  io.FontGlobalScale = scale / pixels;
  return fonts;
}

void set_style(float scale) {
  ImGuiStyle style;
  style.WindowRounding = 0;
  style.FrameRounding = style.GrabRounding = style.PopupRounding = 4;
  style.ChildRounding = 6;
  style.WindowBorderSize = style.PopupBorderSize = 0;
  style.WindowPadding = {16, 12};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 6};
  style.ScrollbarSize = 10;
  style.ScrollbarRounding = 5;
  ImVec4* c = style.Colors;
  ImGui::StyleColorsDark(&style);
  c[ImGuiCol_WindowBg] = palette::panel;
  c[ImGuiCol_ChildBg] = {0, 0, 0, 0};
  c[ImGuiCol_PopupBg] = palette::field;
  c[ImGuiCol_Text] = palette::text;
  c[ImGuiCol_TextDisabled] = palette::dim;
  c[ImGuiCol_TextSelectedBg] = {0.36f, 0.65f, 0.92f, 0.35f};
  c[ImGuiCol_FrameBg] = palette::field;
  c[ImGuiCol_FrameBgHovered] = palette::field_hovered;
  c[ImGuiCol_FrameBgActive] = palette::field_active;
  c[ImGuiCol_SliderGrab] = palette::blue;
  c[ImGuiCol_SliderGrabActive] = palette::amber;
  c[ImGuiCol_CheckMark] = palette::blue;
  c[ImGuiCol_Button] = palette::field;
  c[ImGuiCol_ButtonHovered] = {0.24f, 0.36f, 0.48f, 1};
  c[ImGuiCol_ButtonActive] = palette::blue;
  c[ImGuiCol_Header] = {0.36f, 0.65f, 0.92f, 0.22f};
  c[ImGuiCol_HeaderHovered] = {1, 1, 1, 0.06f};
  c[ImGuiCol_HeaderActive] = {1, 1, 1, 0.09f};
  c[ImGuiCol_Separator] = palette::line;
  c[ImGuiCol_Border] = palette::line;
  c[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
  c[ImGuiCol_ScrollbarGrab] = {1, 1, 1, 0.10f};
  c[ImGuiCol_ScrollbarGrabHovered] = {1, 1, 1, 0.18f};
  c[ImGuiCol_ScrollbarGrabActive] = {1, 1, 1, 0.25f};
  c[ImGuiCol_ModalWindowDimBg] = {0.04f, 0.05f, 0.06f, 0.6f};
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace tyndall
