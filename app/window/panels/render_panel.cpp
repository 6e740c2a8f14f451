#include "app/report/contents.h"
#include "app/window/panels/panels.h"
#include "core/scene/names.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

namespace tyndall {

const char* const view_names[view_count] = {"beauty",  "albedo", "normal", "depth", "noise",
                                            "samples", "cost",   "error",  "FLIP"};

namespace {

/// Buttons for the entries of a table of names; whether the value changed.
template <class E, std::size_t n>
bool named_row(Ui& ui, const Row& row, const Named<E> (&table)[n], E& value) {
  Choice choices[n];
  int chosen = 0;
  for (std::size_t k = 0; k < n; ++k) {
    choices[k] = {table[k].name};
    if (table[k].value == value) chosen = static_cast<int>(k);
  }
  if (!choice_row(ui, row, choices, chosen)) return false;
  value = table[static_cast<std::size_t>(chosen)].value;
  return true;
}

const char* integrator_meaning(Integrator integrator) {
  switch (integrator) {
    case Integrator::path:
      return "finds lamps by chance";
    case Integrator::nee:
      return "asks a lamp at every event";
    case Integrator::mis:
      return "lamps and scattering, weighted";
  }
  return "";
}

std::string share_cut_off(const Frame* frame) {
  if (!frame || frame->spp == 0) return "scattering events of the longest path";
  const double paths = static_cast<double>(frame->spp) * frame->width * frame->height;
  const double share = static_cast<double>(frame->truncated) / paths;
  if (share == 0) return "no path was cut off";
  char text[64];
  std::snprintf(text, sizeof text, "%.2g %% of the paths cut off", 100 * share);
  return text;
}

const char* view_meaning(const PanelState& state) {
  if (state.view >= error_view && !state.accuracy->map()) return "is being computed";
  switch (state.view) {
    case cost_view:
      return "rays of a path; white: most";
    case error_view:
      return "white: wrong by 100 % and more";
    case flip_view:
      return "what an eye sees; bright: much";
    default:
      return "";
  }
}

/// A slider over whole numbers.
bool whole_row(Ui& ui, Row row, int& value) {
  double number = value;
  row.whole = true;
  if (!slider_row(ui, row, number)) return false;
  value = static_cast<int>(std::lround(number));
  return true;
}

void adaptive_row(Ui& ui, bool& adaptive) {
  const Choice choices[] = {{"off", nullptr}, {"on", nullptr}};
  int chosen = adaptive ? 1 : 0;
  const char* meaning = adaptive ? "more where the error is; spp is their mean" : "as many samples everywhere";
  if (choice_row(ui, {"adaptive", "Adaptive", {}, {}, "", "where samples are spent; view 6 shows it", meaning}, choices,
                 chosen))
    adaptive = chosen == 1;
}

void limit_rows(Ui& ui, PanelState& state) {
  RenderSettings& render = state.scene.render;
  whole_row(ui,
            {"max_depth",
             "Depth",
             between(0, 1e6),
             {1, 1000, true},
             "",
             "longest path, in scattering events",
             share_cut_off(state.frame.get())},
            render.max_depth);
  int limit = render.spp.value_or(0);
  const char* goal = limit == 0 ? "0: goes on for ever" : "samples a pixel at which it stops";
  if (whole_row(ui, {"spp", "Limit", between(0, 1 << 24), {1, 65536, true}, "", "samples a pixel; 0: no limit", goal},
                limit))
    render.spp = limit > 0 ? std::optional(limit) : std::nullopt;
  int threads = state.threads;
  const double cores = std::max(2u, std::thread::hardware_concurrency());
  if (whole_row(ui, {"threads", "Threads", between(1, 1024), {1, cores}, "", "never changes the picture", ""}, threads))
    state.wishes.threads = threads;
}

void split_row(Ui& ui, PanelState& state) {
  static constexpr Choice choices[] = {{"off"}, {"on"}};
  int chosen = state.kept_method.empty() ? 0 : 1;
  const std::string meaning = chosen == 0 ? "" : "A keeps " + state.kept_method + "; above: B";
  if (choice_row(ui,
                 {"split",
                  "Split",
                  {},
                  {},
                  "",
                  "A keeps these settings, B takes what you change: side by side, as many core-seconds each",
                  meaning},
                 choices, chosen))
    state.wishes.split = chosen == 1;
}

/// "7 spheres, 1 quad, 1 medium, 1 light".
std::string contents_text(const Scene& scene) {
  const Contents contents = contents_of(scene);
  std::string text;
  const auto add = [&](int count, const std::string& one, const std::string& many) {
    if (count > 0)
      text += (text.empty() ? "" : ", ") + format_count(static_cast<unsigned>(count)) + " " + (count == 1 ? one : many);
  };
  for (const auto& [kind, count] : contents.shapes) add(count, kind, kind == "box" ? "boxes" : kind + "s");
  add(contents.media, "medium", "media");
  add(contents.lights, "light", "lights");
  for (const auto& [kind, count] : contents.textures) add(count, kind + " texture", kind + " textures");
  return text;
}

std::string kernel_note(const Frame* frame) { return frame ? frame->isa + " × " + std::to_string(frame->lanes) : ""; }

}  // namespace

void image_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Image", "never starts over")) return;
  ui.scope = "image.";
  Display& display = state.scene.display;
  const std::string brightness = "brightness × " + format_short(std::exp2(display.exposure));
  slider_row(
      ui, {"exposure", "Exposure", between(-64, 64), {-6, 6}, " EV", "stops: brightness doubles with each", brightness},
      display.exposure);
  named_row(ui, {"tone_map", "Tone map", {}, {}, "", "srgb: clipped; aces: a film's shoulder", ""}, tone_maps,
            display.tone_map);
  Choice views[view_count];
  for (int k = 0; k < view_count; ++k) views[k] = {view_names[k], nullptr};
  if (!state.can_show_errors)
    for (const int k : {error_view, flip_view}) views[k].missing = "needs a reference: see Speed and accuracy";
  choice_row(ui, {"view", "View", {}, {}, "", "keys 1 to 9", view_meaning(state)}, views, state.view, 3);
  ui.scope.clear();
}

void render_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Render", kernel_note(state.frame.get()))) return;
  ui.scope = "render.";
  RenderSettings& render = state.scene.render;
  named_row(ui, {"integrator", "Integrator", {}, {}, "", "how light is found", integrator_meaning(render.integrator)},
            integrators, render.integrator);
  named_row(ui, {"sampler", "Sampler", {}, {}, "", "random: independent; sobol: evenly spread, less noise", ""},
            samplers, render.sampler);
  named_row(ui, {"fresnel", "Fresnel", {}, {}, "", "how much glass reflects", ""}, fresnel_rules, render.fresnel);
  if (render.fresnel == FresnelKind::schlick) {
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - 4 * ui.scale);
    note(ui, "approximation: wrong by up to 0.93", true, palette::amber);
  }
  adaptive_row(ui, render.adaptive);
  split_row(ui, state);
  limit_rows(ui, state);
  note(ui, contents_text(state.scene), false);
  ui.scope.clear();
}

}  // namespace tyndall
