#include "app/window/panels/widgets.h"
#include "app/window/system/imgui_compat.h"
#include "core/image/tonemap.h"
#include "core/scene/place.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

void draw_frame(const Ui& ui) {
  const Tone colour = ImGui::IsItemActive()    ? palette::field_active
                      : ImGui::IsItemHovered() ? palette::field_hovered
                                               : palette::field;
  ImGui::GetWindowDrawList()->AddRectFilled(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), shade(colour),
                                            4 * ui.scale);
}

/// Sets value to `wanted`, kept within what is valid; open ends cannot be reached.
bool accept(const Row& row, double wanted, double& value) {
  wanted = std::clamp(row.whole ? std::round(wanted) : wanted, row.valid.low, row.valid.high);
  if (wanted == value || !row.valid.contains(wanted)) return false;
  value = wanted;
  return true;
}

std::string shown_text(const Row& row, double value, bool fixed_digits) {
  const bool spelled = std::isalpha(static_cast<unsigned char>(*row.unit)) != 0;
  const std::string unit = (spelled ? " " : "") + std::string(row.unit);
  if (row.whole) return std::to_string(std::llround(value)) + unit;
  return (fixed_digits ? format_value(row.slider, value) : format_short(value)) + unit;
}

/// Takes what was typed. Text that was not changed leaves the value as it is: the text may show fewer digits than the
/// value has.
bool finish_edit(Ui& ui, const Row& row, double& value) {
  const std::string text = ui.edit.text;
  const bool touched = text != ui.edit.start;
  ui.edit = {};
  double typed = 0;
  if (!touched) return false;
  const bool number = parse_number(text, row.unit, typed) && (!row.whole || typed == std::round(typed));
  if (!number || !row.valid.contains(typed)) {
    ui.problem = row.name + ": found " + text + ", expected " +
                 expected_text({row.valid}, row.whole ? Form::whole : Form::number);
    return false;
  }
  const bool changed = typed != value;
  value = typed;
  return changed;
}

bool edit_box(Ui& ui, const Row& row, double& value, float width) {
  const bool fresh = ui.edit.waited == 0;
  compat::push_font(ui.fonts.mono);
  ImGui::PushStyleColor(ImGuiCol_FrameBg, palette::field_active);
  ImGui::PushID(static_cast<int>(ui.edit.id));  // the boxes of a row are different ones for Dear ImGui
  const bool ended = type_text(ui, "", width);
  ImGui::PopID();
  ImGui::PopStyleColor();
  ImGui::PopFont();
  const bool untouched = ui.edit.start == ui.edit.text;
  if (untouched && row.original && ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) {
    ui.edit = {};  // the first click began to type, the second one sets the value back
    return accept(row, row.original->x, value);
  }
  ImGui::GetWindowDrawList()->AddRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), shade(palette::blue, 0.8f),
                                      4 * ui.scale);
  const bool tab = ImGui::IsItemActive() && !fresh && compat::key_pressed(ImGuiKey_Tab);  // not the one that led here
  if (!ended && !tab) return false;
  const bool changed = finish_edit(ui, row, value);
  ui.edit.next = tab;
  return changed;
}

/// sRGB's bytes as the eye sees the colour; what is brighter than 1 is scaled.
ImVec4 swatch_colour(Vec3d c) {
  const double scale = 1 / std::max(1.0, max_component(c));
  const auto encode = [&](double x) { return srgb_encode(static_cast<float>(std::max(0.0, scale * x))); };
  return {encode(c.x), encode(c.y), encode(c.z), 1};
}

bool colour_picker(Ui& ui, Vec3d& value) {
  if (!ImGui::BeginPopup("picker")) return false;
  const double scale = std::max(1.0, max_component(value));
  const ImVec4 now = swatch_colour(value);
  float rgb[3] = {now.x, now.y, now.z};
  ImGui::SetNextItemWidth(220 * ui.scale);
  const bool changed =
      ImGui::ColorPicker3("##picker", rgb, ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoInputs);
  const auto decode = [&](float x) { return std::round(1e3 * scale * static_cast<double>(srgb_decode(x))) / 1e3; };
  if (changed) value = {decode(rgb[0]), decode(rgb[1]), decode(rgb[2])};
  if (ui.close_popup) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return changed;
}

/// Sets the value to what the scene's file has when the last item is clicked twice. Returns whether it differs.
bool reset_by_double_click(Ui& ui, const Row& row, double& value) {
  if (!row.original || !ImGui::IsItemHovered() || !ImGui::IsMouseDoubleClicked(0)) return false;
  ui.drag.reset = true;
  return accept(row, row.original->x, value);
}

/// Begins or goes on with a drag of the last item, which is active. Returns whether the drag was taken back, which
/// changes the value.
bool follow_mouse(Ui& ui, double& value) {
  const ImGuiIO& io = ImGui::GetIO();
  const auto mouse = static_cast<double>(io.MousePos.x);
  if (ImGui::IsItemActivated()) ui.drag.last = mouse, ui.drag.travel = 0, ui.drag.reset = false, ui.drag.before = value;
  ui.drag.travel += (mouse - ui.drag.last) * (io.KeyShift ? 0.1 : 1.0);
  ui.drag.last = mouse;
  ui.drag.active = !ui.drag.reset;
  if (!ui.drag.cancel || ui.drag.reset) return false;
  ui.drag.reset = true;
  return std::exchange(value, ui.drag.before) != ui.drag.before;
}

/// The value that a drag gives, snapped while Ctrl is held.
double snapped_by_keys(const Slider& range, double value) {
  const ImGuiIO& io = ImGui::GetIO();
  return io.KeyCtrl ? snapped(range, value, io.KeyShift) : value;
}

int finer_by_keys() { return ImGui::GetIO().KeyShift ? 1 : 0; }

/// Three boxes in `width`, named x y z or r g b.
bool three_boxes(Ui& ui, const Row& row, Vec3d& value, float width, const char* const names[3], bool fixed_digits) {
  const float space = 4 * ui.scale;
  bool changed = false;
  double* components[3] = {&value.x, &value.y, &value.z};
  ImGui::BeginGroup();  // the row's menu is that of all three
  for (int k = 0; k < 3; ++k) {
    if (k > 0) ImGui::SameLine(0, space);
    Row part = row;
    if (row.original)
      part.original = Vec3d{k == 0 ? row.original->x : k == 1 ? row.original->y : row.original->z, 0, 0};
    changed = value_box(ui, names[k], part, *components[k], (width - 2 * space) / 3, fixed_digits) || changed;
  }
  ImGui::EndGroup();
  row_menu(ui, row, false);
  return changed;
}

}  // namespace

bool slider(Ui& ui, const Row& row, double& value, float width) {
  const float height = ImGui::GetFrameHeight();
  ImGui::InvisibleButton("slider", {std::max(width, 8.0f), height});
  const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
  const float grab = 14 * ui.scale, pad = 2 * ui.scale, first = a.x + pad + grab / 2,
              track = b.x - a.x - 2 * pad - grab;
  const Slider range =
      ImGui::IsItemActive() && !ImGui::IsItemActivated() ? ui.drag.range : widened(row.slider, row.valid, value);
  const auto place_of = [&](double v) { return first + track * static_cast<float>(slider_position(range, v)); };
  const float mouse = ImGui::GetIO().MousePos.x;
  if (ImGui::IsItemActivated()) {
    ui.drag.range = range;
    ui.drag.offset = std::abs(mouse - place_of(value)) <= grab / 2 ? mouse - place_of(value) : 0.0f;
    ui.drag.start = static_cast<double>(mouse);
  }
  bool changed = ImGui::IsItemActive() && follow_mouse(ui, value);
  changed = reset_by_double_click(ui, row, value) || changed;
  // A press on the grab moves nothing until the mouse does.
  const bool moved = ui.drag.offset == 0 || ui.drag.travel != 0;
  if (ImGui::IsItemActive() && moved && track > 0 && !ui.drag.reset) {
    const double place =
        (ui.drag.start + ui.drag.travel - static_cast<double>(ui.drag.offset + first)) / static_cast<double>(track);
    changed = accept(row, snapped_by_keys(range, slider_value(range, place, value, finer_by_keys())), value);
  }
  draw_frame(ui);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float at = place_of(value), from = range.low < 0 && !range.logarithmic ? place_of(0) : a.x + pad;
  draw->AddRectFilled({std::min(at, from), a.y + pad}, {std::max(at, from), b.y - pad}, shade(palette::blue, 0.20f),
                      3 * ui.scale);
  if (range.low < 0 && !range.logarithmic)
    draw->AddRectFilled({from - 0.5f, b.y - 6 * ui.scale}, {from + 0.5f, b.y - pad}, shade(palette::dim));
  draw->AddRectFilled({at - grab / 2, a.y + pad}, {at + grab / 2, b.y - pad},
                      shade(ImGui::IsItemActive() ? palette::amber : palette::blue), 4 * ui.scale);
  return changed;
}

bool value_box(Ui& ui, const char* id, const Row& row, double& value, float width, bool fixed_digits) {
  const ImGuiID item = ImGui::GetID(id);
  const std::string text = shown_text(row, value, fixed_digits);
  const bool sought = std::exchange(ui.sought.types, false);
  if (sought || (ui.edit.next && ui.edit.id == 0)) begin_typing(ui, item, text);
  if (ui.edit.id == item) {
    const bool typed = edit_box(ui, row, value, width);
    log_item(ui, row.name + "." + id, "typing");
    return typed;
  }
  ImGui::InvisibleButton(id, {std::max(width, 1.0f), ImGui::GetFrameHeight()});
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ImGui::IsItemActivated()) ui.drag.start = value, ui.drag.moved = false;
  bool changed = ImGui::IsItemActive() && follow_mouse(ui, value);
  if (ImGui::IsItemActive() && !ui.drag.reset && (ui.drag.moved || ImGui::IsMouseDragging(0, 3 * ui.scale))) {
    ui.drag.moved = true;
    const double steps = ui.drag.travel / static_cast<double>(ui.scale);
    const double wanted = dragged(row.slider, ui.drag.start, steps, finer_by_keys());
    changed = accept(row, snapped_by_keys(row.slider, wanted), value);
  }
  if (ImGui::IsItemDeactivated() && !ui.drag.moved && !ui.drag.reset) begin_typing(ui, item, text);
  draw_frame(ui);
  compat::push_font(ui.fonts.mono);
  const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax(), size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at{std::max(a.x + 2, (a.x + b.x - size.x) / 2), (a.y + b.y - size.y) / 2};
  ImGui::GetWindowDrawList()->PushClipRect(a, b, true);
  ImGui::GetWindowDrawList()->AddText(at, shade(palette::text), text.c_str());
  ImGui::GetWindowDrawList()->PopClipRect();
  ImGui::PopFont();
  log_item(ui, row.name + "." + id, format_short(value));
  return changed;
}

bool vector_row(Ui& ui, const Row& row, Vec3d& value) {
  static constexpr const char* names[3] = {"x", "y", "z"};
  begin_row(ui, row);
  const bool changed = three_boxes(ui, row, value, value_width(ui), names, false);
  end_row(ui, row);
  return changed;
}

bool colour_row(Ui& ui, const Row& row, Vec3d& value) {
  static constexpr const char* names[3] = {"r", "g", "b"};
  begin_row(ui, row);
  const float side = ImGui::GetFrameHeight(), space = 6 * ui.scale;
  bool changed = three_boxes(ui, row, value, value_width(ui) - side - space, names, true);
  ImGui::SameLine(0, space);
  if (ImGui::ColorButton("##swatch", swatch_colour(value), ImGuiColorEditFlags_NoTooltip, {side, side}))
    ImGui::OpenPopup("picker");
  log_item(ui, row.name + ".swatch", "button");
  changed = colour_picker(ui, value) || changed;
  end_row(ui, row);
  return changed;
}

}  // namespace tyndall
