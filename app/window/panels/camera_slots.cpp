#include "app/window/panels/camera_slots.h"

#include "app/window/accuracy/comparison.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr int max_width = 96, max_height = 60;
constexpr float slot_width = 58, slot_height = 37;  // units of the design

/// One slot's picture as a button. Returns whether it was clicked; right: whether by the right button.
bool slot_button(Ui& ui, const CameraSlot& slot, std::size_t number, bool on, bool& right) {
  const float s = ui.scale;
  const ImVec2 at = ImGui::GetCursorScreenPos(), size{slot_width * s, slot_height * s};
  ImGui::PushID(static_cast<int>(number));
  const bool pressed = ImGui::InvisibleButton("slot", size);
  right = ImGui::IsItemClicked(1);
  const bool hovered = ImGui::IsItemHovered();
  ImGui::PopID();
  log_item(ui, "slot." + std::to_string(number + 1), on ? "on" : "off");
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 end{at.x + size.x, at.y + size.y};
  draw->AddRectFilled(at, end, shade(palette::field), 3 * s);
  if (slot.picture) draw_fitted(*slot.picture, {at.x, at.y, end.x, end.y}, 0);
  if (on || hovered) draw->AddRect(at, end, shade(on ? palette::blue : palette::dim), 3 * s, 0, 2 * s);
  tooltip(ui, "look through this camera; a right click forgets it");
  return pressed;
}

}  // namespace

ScreenPicture small_picture(const Frame& frame, const Display& display) {
  const bool beauty = frame.view == View::beauty, clean = beauty && frame.clean;
  const std::vector<float>& from = clean ? frame.clean->rgba : beauty ? frame.rgba : frame.beauty;
  const PictureGrid every_pixel{frame.width, frame.height};
  const auto [columns, rows, spacing] = clean ? frame.clean->grid : beauty ? frame.grid : every_pixel;
  if (from.empty() || columns <= 0 || rows <= 0) return {};
  const double fit = std::min({1.0, static_cast<double>(max_width) / columns, static_cast<double>(max_height) / rows});
  const auto pixels = [fit](int count) { return std::max(1, static_cast<int>(std::lround(fit * count))); };
  return on_sheet({columns, rows, rgb_of(from)}, display, {pixels(columns), pixels(rows)});
}

void store_camera(CameraSlots& slots, const Camera& camera, const Frame* frame, const Display& display) {
  CameraSlot slot{camera, nullptr};
  if (const ScreenPicture small = frame ? small_picture(*frame, display) : ScreenPicture{}; !small.rgb.empty())
    slot.picture = std::make_shared<const PictureTexture>(small.width, small.height, small.rgb);
  std::erase_if(slots, [&](const CameraSlot& other) { return other.camera == camera; });
  if (slots.size() >= max_camera_slots) slots.erase(slots.begin());
  slots.push_back(std::move(slot));
}

std::optional<std::size_t> next_slot(const CameraSlots& slots, const Camera& camera) {
  if (slots.empty()) return {};
  for (std::size_t k = 0; k < slots.size(); ++k)
    if (slots[k].camera == camera) return (k + 1) % slots.size();
  return 0;
}

std::optional<Camera> camera_slots_row(Ui& ui, CameraSlots& slots, const Camera& now) {
  std::optional<Camera> recalled;
  std::optional<std::size_t> forgotten;
  const char* help = "cameras that you put aside; they last as long as the window";
  const Row row{"slots", "Cameras", {}, {}, "", help, "", "stored cameras, camera slots"};
  begin_row(ui, row);
  const float left = ImGui::GetCursorPosX();
  for (std::size_t k = 0; k < slots.size(); ++k) {
    if (k % 4 != 0) ImGui::SameLine(0, 4 * ui.scale);
    if (k % 4 == 0 && k > 0) ImGui::SetCursorPosX(left);
    bool right = false;
    if (slot_button(ui, slots[k], k, slots[k].camera == now, right)) recalled = slots[k].camera;
    if (right) forgotten = k;
  }
  if (!slots.empty()) ImGui::SetCursorPosX(left);
  if (small_button(ui, "store", "Store this camera")) ui.requests.push_back({"store the camera"});
  end_row(ui, row);
  if (forgotten) slots.erase(slots.begin() + static_cast<std::ptrdiff_t>(*forgotten));
  return recalled;
}

}  // namespace tyndall
