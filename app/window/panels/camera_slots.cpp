#include "app/window/panels/camera_slots.h"

#include "core/image/tonemap.h"

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
  if (slot.picture) {
    const float fit = std::min(size.x / slot.picture->width(), size.y / slot.picture->height());
    const float half_x = fit * slot.picture->width() / 2, half_y = fit * slot.picture->height() / 2;
    const ImVec2 middle{(at.x + end.x) / 2, (at.y + end.y) / 2};
    const auto texture = (ImTextureID) static_cast<std::intptr_t>(slot.picture->number());  // NOLINT: once a pointer
    draw->AddImage(texture, {middle.x - half_x, middle.y - half_y}, {middle.x + half_x, middle.y + half_y});
  }
  if (on || hovered) draw->AddRect(at, end, shade(on ? palette::blue : palette::dim), 3 * s, 0, 2 * s);
  tooltip(ui, "look through this camera; a right click forgets it");
  return pressed;
}

}  // namespace

std::vector<std::uint8_t> small_picture(const Frame& frame, const Display& display, int& width, int& height) {
  const bool beauty = frame.view == View::beauty, clean = beauty && frame.clean;
  const std::vector<float>& from = clean ? frame.clean->rgba : beauty ? frame.rgba : frame.beauty;
  const PictureGrid every_pixel{frame.width, frame.height};
  const auto [columns, rows, spacing] = clean ? frame.clean->grid : beauty ? frame.grid : every_pixel;
  width = height = 0;
  if (from.empty() || columns <= 0 || rows <= 0) return {};
  const double fit = std::min({1.0, static_cast<double>(max_width) / columns, static_cast<double>(max_height) / rows});
  width = std::max(1, static_cast<int>(std::lround(fit * columns)));
  height = std::max(1, static_cast<int>(std::lround(fit * rows)));
  std::vector<float> rgb;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int x0 = x * columns / width, x1 = std::max(x0 + 1, (x + 1) * columns / width);
      const int y0 = y * rows / height, y1 = std::max(y0 + 1, (y + 1) * rows / height);
      float sum[3] = {};
      for (int v = y0; v < y1; ++v)
        for (int u = x0; u < x1; ++u)
          for (std::size_t c = 0; c < 3; ++c)
            sum[c] += from[4 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(columns) +
                                static_cast<std::size_t>(u)) +
                           c];
      const auto count = static_cast<float>((x1 - x0) * (y1 - y0));
      rgb.insert(rgb.end(), {sum[0] / count, sum[1] / count, sum[2] / count});
    }
  return tone_map(rgb, display.exposure, display.tone_map);
}

void store_camera(CameraSlots& slots, const Camera& camera, const Frame* frame, const Display& display) {
  CameraSlot slot{camera, nullptr};
  int width = 0, height = 0;
  const std::vector<std::uint8_t> rgb =
      frame ? small_picture(*frame, display, width, height) : std::vector<std::uint8_t>{};
  if (!rgb.empty()) slot.picture = std::make_shared<const PictureTexture>(width, height, rgb);
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

SlotWish camera_slots_row(Ui& ui, CameraSlots& slots, const Camera& now) {
  SlotWish wish;
  std::optional<std::size_t> forgotten;
  const Row row{"slots", "Cameras",
                {},      {},
                "",      "cameras that you put aside; they last as long as the window",
                "",      "stored cameras, camera slots"};
  begin_row(ui, row);
  const float left = ImGui::GetCursorPosX();
  for (std::size_t k = 0; k < slots.size(); ++k) {
    if (k % 4 != 0) ImGui::SameLine(0, 4 * ui.scale);
    if (k % 4 == 0 && k > 0) ImGui::SetCursorPosX(left);
    bool right = false;
    if (slot_button(ui, slots[k], k, slots[k].camera == now, right)) wish.recall = k;
    if (right) forgotten = k;
  }
  if (!slots.empty()) ImGui::SetCursorPosX(left);
  wish.store = small_button(ui, "store", "Store this camera");
  end_row(ui, row);
  if (forgotten) slots.erase(slots.begin() + static_cast<std::ptrdiff_t>(*forgotten));
  return wish;
}

}  // namespace tyndall
