#include "app/window/variations/strip.h"

#include "app/window/document/editor.h"
#include "core/image/tonemap.h"
#include "core/scene/check.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

constexpr float gap = 6, head = 22, label_height = 18;                        // units of the design
constexpr int key_right = 262, key_left = 263, key_down = 264, key_up = 265;  // GLFW's numbers

std::string value_text(const Slot& slot, double value) {
  const bool spelled = std::isalpha(static_cast<unsigned char>(*slot.unit)) != 0, whole = slot.form == ValueForm::whole;
  return (whole ? std::to_string(std::llround(value)) : format_short(value)) + (spelled ? " " : "") + slot.unit;
}

/// The scene with the values of a step; nothing: it cannot have them, or there is no such step.
std::optional<Scene> varied_scene(const Scene& scene, const std::vector<VariedValue>& axes, std::size_t index) {
  const std::size_t steps[] = {index % strip_columns, index / strip_columns};
  Scene made = scene;
  for (std::size_t k = 0; k < axes.size(); ++k)
    if (steps[k] >= axes[k].values.size() || !put_value(made, axes[k].slot.pointer, axes[k].values[steps[k]]))
      return {};
  return check(made) ? std::nullopt : std::optional(std::move(made));
}

}  // namespace

std::vector<double> varied_values(const Slot& slot, double present, int steps) {
  const Slider range = widened(slot.slider, slot.valid, present);
  std::vector<double> values;
  for (int k = 0; k < steps; ++k) {
    double value = slider_value(range, static_cast<double>(k) / (steps - 1), present);
    if (slot.form == ValueForm::whole) value = std::round(value);
    const bool known = std::find(values.begin(), values.end(), value) != values.end();
    if (slot.valid.contains(value) && !known) values.push_back(value);
  }
  const auto distance = [&](double value) {
    return std::abs(slider_position(range, value) - slider_position(range, present));
  };
  const auto nearest =
      std::min_element(values.begin(), values.end(), [&](double a, double b) { return distance(a) < distance(b); });
  if (nearest != values.end()) *nearest = present;
  return values;
}

void VariationStrip::vary(const Slot& slot) {
  const auto is_it = [&](const VariedValue& axis) { return axis.slot.pointer == slot.pointer; };
  const auto shown = std::find_if(axes_.begin(), axes_.end(), is_it);
  if (shown == axes_.end()) {
    axes_.resize(std::min<std::size_t>(axes_.size(), 1));
    const int steps = axes_.empty() ? strip_columns : strip_rows;
    axes_.push_back({slot, varied_values(slot, std::get<double>(slot.value), steps)});
  } else {
    const bool first = shown == axes_.begin();
    axes_.erase(shown);
    if (axes_.empty()) return close();
    VariedValue& left = axes_[0];
    const auto present = static_cast<std::size_t>(std::max(left.marked, 0));
    if (first) left.values = varied_values(left.slot, left.values[present], strip_columns);
  }
  base_.reset();
  stale_ = true;
}

void VariationStrip::close() {
  axes_.clear();
  cells_.clear();
  base_.reset();
  renders_.request({});
}

float VariationStrip::height(float width, int image_width, int image_height, float scale) const {
  if (!is_open() || image_width <= 0) return 0;
  const float cell = (width - (strip_columns + 1) * gap * scale) / strip_columns;
  const float picture = std::round(cell * static_cast<float>(image_height) / static_cast<float>(image_width));
  return (head + gap) * scale + static_cast<float>(rows()) * (picture + label_height * scale);
}

Rect VariationStrip::cell_at(const Rect& rect, std::size_t index, float scale) const {
  const std::size_t columns_before = index % strip_columns, rows_before = index / strip_columns;
  const auto column = static_cast<float>(columns_before), row = static_cast<float>(rows_before);
  const float space = gap * scale, width = (rect.width() - (strip_columns + 1) * space) / strip_columns;
  const float height = (rect.height() - (head + gap) * scale) / static_cast<float>(rows());
  const float x = rect.x0 + space + column * (width + space), y = rect.y0 + head * scale + row * height;
  return {std::round(x), std::round(y), std::round(x + width), std::round(y + height - label_height * scale)};
}

void VariationStrip::ask(const Context& context, const Rect& rect, float scale) {
  const Rect cell = cell_at(rect, 0, scale);
  width_ = std::max(8, static_cast<int>(std::lround(cell.width() * context.dots)));
  height_ = std::max(8, static_cast<int>(std::lround(cell.height() * context.dots)));
  clean_ = context.clean > 0;
  stale_ = false;
  cells_.clear();
  cells_.resize(count());
  const auto scene_of = [base = *base_, axes = axes_, width = width_, height = height_](std::size_t index) {
    std::optional<Scene> scene = varied_scene(base, axes, index);
    if (scene) scene->width = width, scene->height = height;
    return scene;
  };
  renders_.request({count(), scene_of, clean_, context.wanted.threads});
}

/// Asks for other pictures where that is due. Returns in how many seconds it is to be called again.
double VariationStrip::update(const Context& context, const Rect& rect, const Scene& scene, float scale) {
  constexpr double never = 1e300, patience = 0.25;  // seconds after an edit; another one may follow
  if (!is_open()) return never;
  const bool begins = !base_;
  if (seen_changes_ != context.changes || begins) {
    seen_changes_ = context.changes;
    for (auto& [slot, values, marked] : axes_) {
      const auto now = find_slot(scene, slot.pointer);
      if (!now) return close(), never;  // what it belongs to is gone
      const auto found = std::find(values.begin(), values.end(), std::get<double>(now->value));
      marked = found == values.end() ? -1 : static_cast<int>(found - values.begin());
    }
    // Which step the scene has now makes no difference to the pictures.
    std::optional<Scene> base = varied_scene(scene, axes_, 0);
    if (!base) return close(), never;
    base->render.spp.reset();
    if (begins || !same_picture(*base, *base_)) stale_ = true, changed_at_ = begins ? 0 : context.seconds;
    base_ = std::move(base);
  }
  const Rect cell = cell_at(rect, 0, scale);
  const bool resized = std::abs(cell.width() * context.dots - static_cast<float>(width_)) > 1;
  const bool wanted = (stale_ || resized || clean_ != (context.clean > 0)) && rect.width() > 0;
  const double wait = changed_at_ + patience - context.seconds;
  if (wanted && context.calm && wait <= 0) ask(context, rect, scale);
  show_pictures(scene.display);
  return wanted && context.calm && wait > 0 ? wait : never;
}

void VariationStrip::show_pictures(const Display& display) {
  const auto& pictures = renders_.pictures();
  const bool other = !(display == display_);
  display_ = display;
  for (std::size_t k = 0; k < std::min(pictures.size(), cells_.size()); ++k) {
    if (!pictures[k] || (pictures[k] == cells_[k].shown && !other)) continue;
    const SmallPicture& picture = *pictures[k];
    cells_[k].shown = pictures[k];
    cells_[k].texture = std::make_unique<PictureTexture>(picture.width, picture.height,
                                                         tone_map(picture.rgb, display.exposure, display.tone_map));
  }
}

/// Returns whether it was clicked.
bool VariationStrip::draw_cell(Ui& ui, const Rect& cell, std::size_t index) const {
  const std::size_t steps[] = {index % strip_columns, index / strip_columns};
  std::string label;
  bool marked = true;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    if (steps[k] < axes_[k].values.size())
      label += (label.empty() ? "" : ", ") + value_text(axes_[k].slot, axes_[k].values[steps[k]]);
    marked = marked && axes_[k].marked == static_cast<int>(steps[k]);
  }
  if (label.empty() || cell.width() < 1 || cell.height() < 1) return false;
  const float s = ui.scale;
  ImGui::SetCursorScreenPos({cell.x0, cell.y0});
  ImGui::PushID(static_cast<int>(index));
  const bool pressed = ImGui::InvisibleButton("cell", {cell.width(), cell.height() + label_height * s});
  ImGui::PopID();
  const Cell* known = index < cells_.size() ? &cells_[index] : nullptr;
  log_item(ui, fmt::format("strip.{}", index),
           fmt::format("{} spp {}", label, known && known->shown ? known->shown->spp : 0));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 low{cell.x0, cell.y0}, high{cell.x1, cell.y1};
  draw->AddRectFilled(low, high, shade(palette::field));
  if (known && known->texture) draw_fitted(*known->texture, cell, 0);
  if (marked)
    draw->AddRect({low.x - s, low.y - s}, {high.x + s, high.y + s}, shade(palette::amber), 2 * s, 0, 2 * s);
  else if (ImGui::IsItemHovered())
    draw->AddRect(low, high, shade(palette::blue), 2 * s, 0, 1.5f * s);
  const WithFont small(ui.fonts.small);
  clipped_text_at(label, {cell.x0 + 2 * s, cell.y1 + 2 * s}, cell.width(),
                  marked ? Tone(palette::amber) : Tone(palette::text));
  return pressed;
}

std::optional<Scene> VariationStrip::draw(Ui& ui, const Context& context, const Rect& rect, const Scene& scene) {
  std::optional<Scene> taken;
  ui.wake_in = std::min(ui.wake_in, update(context, rect, scene, ui.scale));
  if (!is_open() || rect.height() <= 0) return taken;
  const float s = ui.scale;
  std::size_t wanted = count();
  bool open = true;
  draw_part(ui, "##strip", rect, bar_flags, {gap * s, 3 * s}, [&] {
    std::string title;
    for (const VariedValue& axis : axes_) title += (title.empty() ? "" : " and ") + axis.slot.label;
    const WithFont small(ui.fonts.small);
    ImGui::TextColored(palette::dim, "%s: click or arrow keys take one over%s", title.c_str(),
                       clean_ ? "; filtered" : "");
    ImGui::SameLine(std::max(1.0f, rect.width() - 60 * s));
    if (ImGui::SmallButton("close")) open = false;
    log_item(ui, "strip.close", "button");
    for (std::size_t k = 0; k < count(); ++k)
      if (draw_cell(ui, cell_at(rect, k, s), k)) wanted = k;
  });
  if (ui.log) ui.log->changed("strip", fmt::format("{:.3f}", renders_.seconds_to_stand()));
  const std::array<int, 2> by = std::exchange(move_, {});
  if (wanted == count() && by != std::array{0, 0}) {
    std::array<std::size_t, 2> steps{};
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      const int last = static_cast<int>(axes_[k].values.size()) - 1;
      steps[k] = static_cast<std::size_t>(std::clamp(std::max(axes_[k].marked, 0) + by[k], 0, last));
    }
    wanted = steps[1] * strip_columns + steps[0];
  }
  if (wanted < count()) taken = varied_scene(scene, axes_, wanted);
  if (!open) close();
  return taken;
}

bool VariationStrip::take_key(int key) {
  if (!is_open()) return false;
  move_[0] += key == key_right ? 1 : key == key_left ? -1 : 0;
  move_[1] += key == key_down ? 1 : key == key_up ? -1 : 0;
  return key == key_right || key == key_left || key == key_down || key == key_up;
}

}  // namespace tyndall
