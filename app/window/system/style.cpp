#include "app/window/system/style.h"

namespace tyndall {
namespace {

/// Like Dear ImGui's style there is one for the program; the main thread's.
Theme current_theme = Theme::dark;

ImVec4 faded(Tone tone, float alpha) {
  tone.w *= alpha;
  return tone;
}

}  // namespace

ThemeTone::operator Tone() const { return current_theme == Theme::dark ? dark : light; }

ImU32 shade(Tone colour, float alpha) {
  colour.w *= alpha;
  return ImGui::ColorConvertFloat4ToU32(colour);
}

void set_style(float scale, Theme theme) {
  current_theme = theme;
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
  theme == Theme::dark ? ImGui::StyleColorsDark(&style) : ImGui::StyleColorsLight(&style);
  c[ImGuiCol_WindowBg] = palette::panel;
  c[ImGuiCol_ChildBg] = {0, 0, 0, 0};
  c[ImGuiCol_PopupBg] = palette::field;
  c[ImGuiCol_Text] = palette::text;
  c[ImGuiCol_TextDisabled] = palette::dim;
  c[ImGuiCol_TextSelectedBg] = faded(palette::blue, 0.35f);
  c[ImGuiCol_FrameBg] = palette::field;
  c[ImGuiCol_FrameBgHovered] = palette::field_hovered;
  c[ImGuiCol_FrameBgActive] = palette::field_active;
  c[ImGuiCol_SliderGrab] = palette::blue;
  c[ImGuiCol_SliderGrabActive] = palette::amber;
  c[ImGuiCol_CheckMark] = palette::blue;
  c[ImGuiCol_Button] = palette::field;
  c[ImGuiCol_ButtonHovered] = faded(palette::chosen, 0.8f);
  c[ImGuiCol_ButtonActive] = palette::blue;
  c[ImGuiCol_Header] = faded(palette::blue, 0.22f);
  c[ImGuiCol_HeaderHovered] = faded(palette::veil, 0.06f);
  c[ImGuiCol_HeaderActive] = faded(palette::veil, 0.09f);
  c[ImGuiCol_Separator] = palette::line;
  c[ImGuiCol_Border] = palette::line;
  c[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
  c[ImGuiCol_ScrollbarGrab] = faded(palette::veil, 0.10f);
  c[ImGuiCol_ScrollbarGrabHovered] = faded(palette::veil, 0.18f);
  c[ImGuiCol_ScrollbarGrabActive] = faded(palette::veil, 0.25f);
  c[ImGuiCol_ModalWindowDimBg] = {0.04f, 0.05f, 0.06f, 0.6f};
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace tyndall
