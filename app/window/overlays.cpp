#include "app/window/overlays.h"

#include "app/window/actions/actions.h"
#include "app/window/dialog.h"
#include "app/window/system/imgui_compat.h"

#include <algorithm>

namespace tyndall {

void draw_message(Ui& ui, const Rect& area, const Message& message) {
  if (message.text.empty() || area.width() <= 0) return;
  const float s = ui.scale;
  begin_box(ui, "##message", {area.x0 + 14 * s, area.y1 - 14 * s}, {0, 1},
            ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav);
  ImGui::PushTextWrapPos(std::max(120 * s, std::min(640 * s, area.width() - 64 * s)));
  ImGui::PushStyleColor(ImGuiCol_Text, message.error ? palette::amber : palette::text);
  ImGui::TextUnformatted(message.text.c_str());
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
  end_box();
}

void draw_help(Ui& ui, bool& open) {
  // Within the window, however small it is: what is too wide is wrapped, and what is too high is scrolled to.
  const float s = ui.scale, margin = 8 * s;
  const ImVec2 room{ImGui::GetIO().DisplaySize.x - 2 * margin, ImGui::GetIO().DisplaySize.y - 2 * margin};
  ImGui::SetNextWindowSizeConstraints({0, 0}, room);
  begin_box(ui, "##help", {margin + room.x / 2, margin + room.y / 2}, {0.5f, 0.5f}, ImGuiWindowFlags_NoNav);
  ImGui::PushTextWrapPos(room.x - 40 * s);
  compat::push_font(ui.fonts.strong);
  ImGui::TextUnformatted("Mouse and keys");
  ImGui::PopFont();
  ImGui::Separator();
  ImGui::Dummy({0, 2 * s});
  for (const HelpLine& line : help_lines()) {
    ImGui::TextUnformatted(line.input.c_str());
    ImGui::SameLine(210 * s);
    ImGui::TextColored(palette::dim, "%s", line.effect.c_str());
  }
  ImGui::PopTextWrapPos();
  const bool outside = ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows);
  if (outside && !ImGui::IsWindowAppearing()) open = false;
  if (ui.log) ui.log->changed("help", "open");
  end_box();
}

void draw_outline(Ui& ui, const Rect& image, const std::vector<ImageLine>& lines) {
  if (lines.empty() || image.width() <= 0) return;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->PushClipRect({image.x0, image.y0}, {image.x1, image.y1}, true);
  const auto at = [&](ImagePoint p) {
    // Points far outside would overflow the draw list's arithmetic.
    const auto limited = [](double v) { return static_cast<float>(std::clamp(v, -20.0, 21.0)); };
    return ImVec2{image.x0 + limited(p.x) * image.width(), image.y0 + limited(p.y) * image.height()};
  };
  for (const ImageLine& line : lines) draw->AddLine(at(line.a), at(line.b), shade(palette::blue, 0.95f), 2 * ui.scale);
  draw->PopClipRect();
}

}  // namespace tyndall
