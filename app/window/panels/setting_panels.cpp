#include "app/files/memory.h"
#include "app/report/contents.h"
#include "app/window/accuracy/views.h"
#include "app/window/panels/rows.h"
#include "app/window/tools/camera_control.h"
#include "core/base/kinds.h"
#include "core/base/thread_pool.h"
#include "core/system/processors.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tyndall {

const Row sky_file{"file", "Picture", {}, {}, "", "", "", "sky picture, hdr, environment map, environment texture"};

namespace {

std::string focus_meaning(const Scene& scene) {
  const Camera& camera = scene.camera;
  if (camera.defocus_angle == 0) return "";
  const SharpRange sharp = sharp_range(camera, scene.height);
  return "sharp from " + format_short(sharp.near) +
         (std::isfinite(sharp.far) ? " to " + format_short(sharp.far) : " on");
}

/// What a background can be, by the kind's place in the variant. A picture can be chosen once there has been one.
template <class... Skies>
std::vector<Choice> sky_choices(const std::variant<Vec3d, Skies...>& background, const BackgroundMemory& seen) {
  std::vector<Choice> choices{{"colour"}, {Skies::type}...};
  constexpr auto picture = static_cast<std::size_t>(place_in<SkyPicture, Background>);
  if (background.index() != picture && !seen[picture])
    choices[picture].missing = "drop an .hdr or .exr of the sky on the window first";
  return choices;
}

std::string fraction_cut_off(const Frame* frame) {
  if (!frame || frame->spp == 0) return "scattering events of the longest path";
  const double fraction = static_cast<double>(frame->truncated) / static_cast<double>(frame->samples);
  if (fraction == 0) return "no path was cut off";
  if (fraction < 1e-5) return "cuts off less than 0.001 % of the paths";
  return fmt::format("cuts off {:.2g} % of the paths", 100 * fraction);
}

std::string sharing_meaning(const RenderSettings& render, const Frame* frame) {
  if (!render.sharing) return "each pixel by itself";
  if (render.integrator != Integrator::mis) return "a part of integrator mis";
  return frame && frame->reuses_paths ? "pays here: groups of eight pixels share" : "does not pay in this scene";
}

std::string caustics_meaning(const RenderSettings& render, const Frame* frame) {
  if (render.integrator != Integrator::mis) return "a part of integrator mis";
  if (render.caustics == Caustics::scatter) return label(render.caustics).help;
  if (!frame || frame->guide_lobes == 0) return "a guide does not pay in this scene";
  return fmt::format("a guide pays here: {} lobes, made in {:.0f} ms", frame->guide_lobes, frame->guide_ms);
}

/// The grey line beneath a setting's row.
std::string setting_meaning(const PanelState& state, std::string_view name) {
  const RenderSettings& render = state.scene->render;
  if (name == "integrator") return label(render.integrator).help;
  if (name == "caustics") return caustics_meaning(render, state.now.frame.get());
  if (name == "sharing") return sharing_meaning(render, state.now.frame.get());
  if (name == "adaptive")
    return render.adaptive ? "more samples where the error is larger; spp is the mean" : "the same number everywhere";
  if (name == "max_depth") return fraction_cut_off(state.now.frame.get());
  if (name == "spp") return render.spp ? "samples a pixel at which it stops" : "0: goes on for ever";
  return "";
}

void threads_row(Ui& ui, PanelState& state) {
  double threads = state.now.wanted.threads;
  static const double cores = std::max(2, thread_count().count);  // asking takes longer than drawing the row
  const char *help = "never changes the picture", *synonyms = "cpu, cores, processors";
  const Row row{"threads", "Threads", between(1, max_threads), {1, cores}, "", help, "", synonyms, true};
  if (slider_row(ui, row, threads)) ui.requests.push_back({"threads", std::to_string(static_cast<int>(threads))});
}

/// Width and height of the picture. Sizes that do not fit into memory are refused.
void pixels_row(Ui& ui, PanelState& state) {
  const Scene& scene = *state.scene;
  const char* help = "width and height in pixels, also of snapshots";
  const char* synonyms = "resolution, width, height, dimensions, film size";
  Row row{"size", "Image size", between(1, 65536), {0, 4000}, "", help, "", synonyms, true};
  double width = scene.width, height = scene.height;
  begin_row(ui, row);
  const float space = 4 * ui.scale, box = (value_width(ui) - space) / 2;
  row.original = Vec3d{static_cast<double>(state.now.origin->saved.width), 0, 0};
  bool changed = value_box(ui, "width", row, width, box, false);
  ImGui::SameLine(0, space);
  row.original = Vec3d{static_cast<double>(state.now.origin->saved.height), 0, 0};
  changed = value_box(ui, "height", row, height, box, false) || changed;
  end_row(ui, row);
  if (!changed) return;
  try {
    const int wide = static_cast<int>(width), high = static_cast<int>(height);
    const bool lights = has_lights(scene), clean = state.now.clean > 0;
    check_memory({.width = wide, .height = high, .emission = lights, .clean = clean, .window = true}, free_memory(),
                 "switch the clean view off");
    Scene& next = state.scene.change();
    next.width = wide, next.height = high;
  } catch (const UsageError& error) {
    ui.problem = error.what();
  }
}

/// A choice that changes nothing by itself: a command is asked for with the name of another one.
void request_row(Ui& ui, const Row& row, std::span<const Choice> choices, int chosen, const char* command) {
  if (choice_row(ui, row, choices, chosen))
    ui.requests.push_back({command, choices[static_cast<std::size_t>(chosen)].name});
}

void size_row(Ui& ui, PanelState& state) {
  static const Choice choices[] = {{"file"}, {"window"}};
  const Frame* frame = state.now.frame.get();
  const std::string meaning = frame ? fmt::format("{} x {} pixels", frame->width, frame->height) : "";
  const char* help = "the picture has the size that the scene's file says, or as many pixels as the window shows";
  const Row row{"at", "Render at", {}, {}, "", help, meaning, "window size, preview size"};
  request_row(ui, row, choices, state.at_window ? 1 : 0, "render at");
}

void split_row(Ui& ui, PanelState& state) {
  static const Choice choices[] = {{"off"}, {"on"}};
  const char* help = "A keeps these settings, B takes what you change; both get the same processor time";
  const std::string meaning = state.now.split ? "A keeps " + state.now.kept_method + "; above: B" : "";
  int chosen = state.now.split ? 1 : 0;
  if (choice_row(ui, {"split", "Split", {}, {}, "", help, meaning, "split settings"}, choices, chosen))
    ui.requests.push_back({"split view"});
}

std::string clean_meaning(const PanelState& state) {
  if (state.now.clean == 0) return "as it is in files";
  const CleanFrame* clean = state.now.frame ? state.now.frame->clean.get() : nullptr;
  if (!clean) return "from 2 samples a pixel on";
  if (clean->spp == 0) return "coarse at first, then filtered from 2 spp on";
  return fmt::format("filtered at {} spp; files are not", format_count(clean->spp));
}

void clean_row(Ui& ui, PanelState& state) {
  static const Choice choices[] = {{"off"}, {"on"}, {"beside raw"}};
  const char* help = "filters noise away where the samples show that it is noise: key N";
  const Row row{"clean", "Clean", {}, {}, "", help, clean_meaning(state), "clean view, filtered"};
  request_row(ui, row, choices, state.now.clean, "clean");
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

/// Small pictures of stored cameras: a click looks through one, a right click forgets it; and a button that stores the
/// present one.
void cameras_row(Ui& ui, PanelState& state) {
  CameraSlots& slots = state.cameras[state.now.origin->title];
  const Camera now = state.scene->camera;
  std::optional<std::size_t> forgotten;
  const char* help = "cameras that you put aside; they last as long as the window";
  const Row row{"slots", "Cameras", {}, {}, "", help, "", "stored cameras, camera slots"};
  begin_row(ui, row);
  const float s = ui.scale, left = ImGui::GetCursorPosX();
  for (std::size_t k = 0; k < slots.size(); ++k) {
    if (k % 4 != 0) ImGui::SameLine(0, 4 * s);
    if (k % 4 == 0 && k > 0) ImGui::SetCursorPosX(left);
    const ImVec2 at = ImGui::GetCursorScreenPos(), end{at.x + 58 * s, at.y + 37 * s};
    ImGui::PushID(static_cast<int>(k));
    if (ImGui::InvisibleButton("slot", {58 * s, 37 * s})) state.scene.change().camera = slots[k].camera;
    ImGui::PopID();
    if (ImGui::IsItemClicked(1)) forgotten = k;
    const bool on = slots[k].camera == now, hovered = ImGui::IsItemHovered();
    log_item(ui, "slot." + std::to_string(k + 1), on ? "on" : "off");
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(at, end, shade(palette::field), 3 * s);
    if (slots[k].picture) draw_fitted(*slots[k].picture, {at.x, at.y, end.x, end.y}, 0);
    if (on || hovered) draw->AddRect(at, end, shade(on ? palette::blue : palette::dim), 3 * s, 0, 2 * s);
    tooltip(ui, "look through this camera; a right click forgets it");
  }
  if (!slots.empty()) ImGui::SetCursorPosX(left);
  if (small_button(ui, "store", "Store this camera")) ui.requests.push_back({"store the camera"});
  end_row(ui, row);
  if (forgotten) slots.erase(slots.begin() + static_cast<std::ptrdiff_t>(*forgotten));
}

/// Why a view cannot be shown; null: it can.
const char* missing_for_view(const Context& now, int number) {
  const bool missing = !now.renders && view_entry(number).view != View::beauty;
  if (missing || (!now.has_scene && is_view_of_scene(number))) return "a picture without a scene has none";
  return shows_errors(number) && !now.can_show_errors ? "needs a reference: see Speed and accuracy" : nullptr;
}

}  // namespace

void camera_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Camera", "Home: reset")) return;
  const Scope scope(ui, "camera");
  const Camera& camera = state.scene->camera;
  const bool plain_up = camera.vup == Vec3d{0, 1, 0};
  const auto said = [&](const Slot& slot, const std::string& meaning) {
    return slot.name == std::string_view("focus_distance") ? focus_meaning(*state.scene) : meaning;
  };
  part_rows(
      ui, state, "/camera", [](const Slot& slot) { return slot.form == ValueForm::number; }, said);
  part_rows(ui, state, "/camera", [&](const Slot& slot) {
    const bool hidden = plain_up && slot.name == std::string_view("vup") && !ui.rows && !is_sought(ui, slot.label);
    return slot.form == ValueForm::place && !hidden;
  });
  cameras_row(ui, state);
}

void background_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Background", "seen beyond all objects")) return;
  const Scope scope(ui, "background");
  const Background& background = state.scene->background;
  int kind = static_cast<int>(background.index());
  const std::vector<Choice> kinds = sky_choices(background, state.backgrounds);
  const int columns = kinds.size() > 3 ? 2 : 0;  // the names of four do not fit side by side
  const Row row{"kind", "Kind", {}, {}, "", "", "", "background, sky, environment, environment light, world, hdri"};
  if (choice_row(ui, row, kinds, kind, columns))
    set_background_kind(state.scene.change().background, kind, state.backgrounds);
  const Background& now = state.scene->background;
  if (const SkyPicture* sky = std::get_if<SkyPicture>(&now)) file_row(ui, sky_file, sky->file);
  part_rows(ui, state, std::holds_alternative<Vec3d>(now) ? "" : "/background");
}

void image_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Image", state.now.renders ? "rendering goes on" : "")) return;
  const Scope scope(ui, "image");
  part_rows(ui, state, "/display");
  if (state.now.has_scene) clean_row(ui, state);
  Choice choices[view_count];
  for (int k = 0; k < view_count; ++k) choices[k] = {view_entry(k).name, missing_for_view(state.now, k)};
  int view = state.now.view;
  const bool waits = shows_errors(view) && !state.now.accuracy->map();
  const char* meaning = waits ? "is being computed" : view_entry(view).meaning;
  const Row row{"view", "View", {}, {}, "", "keys 1 to 9", meaning, "aov, render pass, passes, channel"};
  if (choice_row(ui, row, choices, view, 3)) ui.requests.push_back({std::string("view: ") + view_entry(view).name});
}

void film_panel(Ui& ui, PanelState& state) {
  const std::optional<Animation>& animation = state.scene->animation;
  if (!animation || !section(ui, "Film", std::to_string(animation->keyed.size()) + " values have keys")) return;
  const Scope scope(ui, "film");
  part_rows(ui, state, "/animation");
}

void render_panel(Ui& ui, PanelState& state) {
  const Frame* frame = state.now.frame.get();
  if (!section(ui, "Render", frame ? frame->isa + " × " + std::to_string(frame->lanes) : "")) return;
  const Scope scope(ui, "render");
  const auto said = [&](const Slot& slot, const std::string&) { return setting_meaning(state, slot.name); };
  const auto is_choice = [](const Slot& slot) { return !slot.choices.empty(); };
  part_rows(ui, state, "/render", is_choice, said);
  split_row(ui, state);
  part_rows(ui, state, "/render", std::not_fn(is_choice), said);
  pixels_row(ui, state);
  size_row(ui, state);
  threads_row(ui, state);
  note(ui, contents_text(*state.scene), false);
}

void window_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Window", "remembered")) return;
  const Scope scope(ui, "window");
  static const Choice themes[] = {{"dark"}, {"light"}};
  int theme = static_cast<int>(state.look->theme);
  const char* help = "of panels and lines; the picture stays as it is";
  if (choice_row(ui, {"theme", "Theme", {}, {}, "", help, "", "colour scheme, color scheme"}, themes, theme))
    state.look->theme = static_cast<Theme>(theme);
  std::vector<Choice> sizes;
  for (const double size : text_sizes) sizes.push_back({format_short(100 * size)});
  int chosen =
      static_cast<int>(std::find(text_sizes.begin(), text_sizes.end(), state.look->text_size) - text_sizes.begin());
  const char* keys = "of all controls: Ctrl + and Ctrl -";
  if (choice_row(ui, {"text", "Text size, %", {}, {}, "", keys, "", "text size, ui scale"}, sizes, chosen))
    state.look->text_size = text_sizes[static_cast<std::size_t>(chosen)];
}

}  // namespace tyndall
