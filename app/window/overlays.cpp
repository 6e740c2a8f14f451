#include "app/window/overlays.h"

#include "app/report/contents.h"
#include "app/text/progress.h"
#include "app/window/command.h"
#include "app/window/dialog.h"
#include "app/window/system/imgui_compat.h"
#include "core/render/clean_film.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr double notable_cut = 1e-3;  // fraction of the throughput above which the status line tells of cut paths

std::string percent(double fraction) {
  if (!std::isfinite(fraction)) return "?";
  return fraction < 0.0995 ? fmt::format("{:.2g} %", 100 * fraction) : fmt::format("{:.0f} %", 100 * fraction);
}

std::string time_left(const Frame& frame, const ErrorCurve* run) {
  if (!run || run->edit != frame.edit || run->points.empty()) return "?";
  const double seconds = seconds_left(0.01, run->points.back(), frame.seconds);
  return seconds > 0 ? duration(seconds) : "reached";
}

/// The true error that was measured last of an edit's picture, as it is or clean; "?" where it was not.
std::string measured(const ErrorCurve* run, std::uint64_t edit) {
  const bool known = run && run->edit == edit && !run->points.empty();
  return known ? percent(std::sqrt(std::max(run->points.back().rel_mse, 0.0))) : "?";
}

/// What a scene lacks to be seen; "": nothing. Without light every error is 0 %, which says nothing.
std::string missing_in(const Scene& scene) {
  const Contents contents = contents_of(scene);
  if (contents.lights > 0 || contents.background != "none") return "";
  return scene.objects.empty() ? "empty scene: add an object and a lamp" : "no light in this scene: add a lamp";
}

/// What is said of the errors: of the clean view first, as that is shown.
void add_errors(const Context& context, std::vector<StatusCell>& cells) {
  const Frame& frame = *context.frame;
  if (frame.clean) {
    cells.push_back({context.is_true ? "true clean" : "clean",
                     context.is_true ? measured(context.clean_run, frame.edit) : percent(frame.clean->relative_error),
                     1});
    if (frame.clean->spp == 0)
      cells.push_back({"", "coarse at first", 2, true});
    else if (frame.clean->spp < rough_clean_spp)
      cells.push_back({"", fmt::format("rough below {} spp", rough_clean_spp), 2, true});
  }
  const char* raw = frame.clean ? "raw" : "error";
  if (context.is_true) cells.push_back({frame.clean ? "true raw" : "true error", measured(context.run, frame.edit), 1});
  cells.push_back({context.is_true ? "estimated" : raw, percent(frame.relative_error), context.is_true ? 3 : 1});
}

/// How quickly a picture is rendered: in rays, or in samples where a caller's function computes these.
std::string speed(const Frame& frame, bool has_scene) {
  const double samples = frame.seconds > 0 ? 1e-6 * static_cast<double>(frame.samples) / frame.seconds : 0;
  const double millions = has_scene ? frame.mrays_per_s : samples;
  if (!has_scene && millions < 0.1) return fmt::format("{:.3g} samples/s", 1e6 * millions);
  return fmt::format("{:.{}f} {}/s", millions, millions < 10 ? 1 : 0, has_scene ? "Mrays" : "Msamples");
}

/// Of a picture that another program writes: nothing is rendered, but it may be compared.
std::vector<StatusCell> cells_of_picture(const Context& context) {
  const Frame* frame = context.frame.get();
  std::vector<StatusCell> cells{{"", context.arrived, 0}};
  if (frame) cells.push_back({"", fmt::format("{} x {} pixels", frame->width, frame->height), 3});
  if (frame && context.is_true) cells.push_back({"true error", measured(context.run, frame->edit), 1});
  cells.push_back({context.origin->title, "", 2});
  return cells;
}

}  // namespace

std::vector<StatusCell> status_cells(const Context& context, const Scene& scene) {
  if (!context.arrived.empty()) return cells_of_picture(context);
  const Frame* frame = context.frame.get();
  const char* state = frame ? frame->finished ? "finished" : "rendering" : "starting";
  std::vector<StatusCell> cells{{context.split ? "B" : "", context.wanted.paused ? "paused" : state, 0}};
  if (frame) {
    const std::string spp = frame->spp > 0 ? format_count(frame->spp) : fmt::format("1/{}", frame->step * frame->step);
    cells.push_back({"spp", spp, 1});
    const std::string missing = context.has_scene ? missing_in(scene) : "";
    if (missing.empty()) {
      add_errors(context, cells);
      cells.push_back({"to 1 %", time_left(*frame, context.run), 2});
    } else {
      cells.push_back({"", missing, 1, true});
    }
    cells.push_back({"", speed(*frame, context.has_scene), 3});
    cells.push_back({context.has_scene ? frame->isa + " x" + std::to_string(frame->lanes) : "",
                     std::to_string(frame->threads) + (frame->threads == 1 ? " thread" : " threads"), 7});
    cells.push_back({"film", fmt::format("{:.0f} MB", static_cast<double>(frame->film_bytes) / 1e6), 6});
    cells.push_back({"rejected", format_count(frame->rejected), frame->rejected > 0 ? 1 : 5, frame->rejected > 0});
    if (frame->rare_bright_paths) cells.push_back({"not converged", "rare bright paths", 1, true});
    if (frame->cut_throughput > notable_cut) cells.push_back({"cut off", percent(frame->cut_throughput), 1, true});
  }
  if (context.has_scene)
    cells.push_back({"", method_of(scene.render, scene.render), 4, scene.render.fresnel == FresnelKind::schlick});
  cells.push_back({context.origin->title, context.has_scene && context.edited ? "edited" : "", 2});
  return cells;
}

std::vector<std::size_t> fitting_cells(const std::vector<StatusCell>& cells, const std::vector<float>& widths,
                                       float room) {
  std::vector<std::size_t> shown(cells.size());
  for (std::size_t i = 0; i < shown.size(); ++i) shown[i] = i;
  const auto total = [&] {
    float sum = 0;
    for (const std::size_t i : shown) sum += widths[i];
    return sum;
  };
  while (shown.size() > 1 && total() > room)
    shown.erase(std::max_element(shown.begin(), shown.end(),
                                 [&](std::size_t a, std::size_t b) { return cells[a].rank < cells[b].rank; }));
  return shown;
}

void draw_status(Ui& ui, const Rect& rect, const std::vector<StatusCell>& cells) {
  if (rect.height() <= 0) return;
  const float s = ui.scale, gap = 20 * s, inner = 6 * s;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->AddRectFilled({rect.x0, rect.y0}, {rect.x1, rect.y1}, shade(palette::ink));
  compat::push_font(ui.fonts.mono);
  std::vector<float> widths;
  const auto width = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };
  for (const StatusCell& cell : cells)
    widths.push_back(width(cell.key) + width(cell.value) + (!cell.key.empty() && !cell.value.empty() ? inner : 0.0f) +
                     gap);
  float x = rect.x0 + 14 * s;
  const float y = rect.y0 + (rect.height() - ImGui::GetTextLineHeight()) / 2;
  for (const std::size_t i : fitting_cells(cells, widths, rect.width() - 28 * s + gap)) {
    const StatusCell& cell = cells[i];
    draw->AddText({x, y}, shade(palette::dim), cell.key.c_str());
    const float value_at = x + width(cell.key) + (cell.key.empty() ? 0.0f : inner);
    const Tone colour = cell.warning ? palette::amber : i == 0 ? palette::blue : palette::text;
    draw->AddText({value_at, y}, shade(colour), cell.value.c_str());
    x += widths[i];
  }
  ImGui::PopFont();
  if (ui.log) ui.log->changed("state", cells.front().value);
}

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

}  // namespace tyndall
