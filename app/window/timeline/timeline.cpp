#include "app/window/timeline/timeline.h"

#include "app/window/system/imgui_compat.h"
#include "core/scene/frames.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr float bar_height = 36, button_width = 58, number_width = 92;  // units of the design
constexpr int frames_between_cameras = 48;
constexpr double frames_per_second = 24;

}  // namespace

Scene at_frame_with_keys(const Scene& scene, double frame) {
  Scene made = scene_at(scene, frame);
  made.animation = scene.animation;
  // Motion blur belongs to the frames of files: here the sphere's own end of motion stays.
  if (made.camera.shutter_close == 0 && made.camera.shutter_open == 0) return made;
  Scene still = scene;
  still.camera.shutter_open = still.camera.shutter_close = 0;
  made = scene_at(still, frame);
  made.animation = scene.animation;
  made.camera.shutter_open = scene.camera.shutter_open, made.camera.shutter_close = scene.camera.shutter_close;
  return made;
}

void add_key(Scene& scene, const Slot& slot, int frame) {
  if (!scene.animation) scene.animation.emplace();
  scene.animation->frames = std::max(scene.animation->frames, frame + 1);
  const Vec3d* vector = std::get_if<Vec3d>(&slot.value);
  set_key(*scene.animation, slot.pointer,
          {frame, vector ? std::vector{vector->x, vector->y, vector->z} : std::vector{std::get<double>(slot.value)}});
}

void remove_keys(Scene& scene, int frame) {
  if (!scene.animation) return;
  for (KeyedValue& keyed : scene.animation->keyed)
    std::erase_if(keyed.keys, [&](const KeyFrame& key) { return key.frame == frame; });
  std::erase_if(scene.animation->keyed, [](const KeyedValue& keyed) { return keyed.keys.empty(); });
  if (scene.animation->keyed.empty()) scene.animation.reset();
}

bool has_keys(const Scene& scene, int frame) {
  if (!scene.animation) return false;
  for (const KeyedValue& keyed : scene.animation->keyed)
    for (const KeyFrame& key : keyed.keys)
      if (key.frame == frame) return true;
  return false;
}

void key_cameras(Scene& scene, const CameraSlots& slots) {
  int frame = 0;
  for (const CameraSlot& slot : slots) {
    Scene seen;
    seen.camera = slot.camera;
    for (const char* value : {"/camera/look_from", "/camera/look_at", "/camera/vfov"})
      add_key(scene, *find_slot(seen, value), frame);
    frame += frames_between_cameras;
  }
}

float Timeline::height(const Scene& scene, float scale) { return scene.animation ? bar_height * scale : 0; }

void Timeline::play_or_stop(double now) {
  playing_ = !playing_;
  started_ = now - frame_ / frames_per_second;
}

void Timeline::draw_keys(Ui& ui, const Rect& track, const Animation& animation) const {
  const float s = ui.scale, middle = (track.y0 + track.y1) / 2;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float span = static_cast<float>(std::max(1, animation.frames - 1));
  const auto at = [&](int frame) { return track.x0 + track.width() * static_cast<float>(frame) / span; };
  draw->AddRectFilled({track.x0, middle - 2 * s}, {track.x1, middle + 2 * s}, shade(palette::field_active), 2 * s);
  for (const KeyedValue& keyed : animation.keyed)
    for (const KeyFrame& key : keyed.keys)
      draw->AddQuadFilled({at(key.frame), middle - 6 * s}, {at(key.frame) + 5 * s, middle},
                          {at(key.frame), middle + 6 * s}, {at(key.frame) - 5 * s, middle}, shade(palette::blue));
  draw->AddRectFilled({at(frame_) - 1.5f * s, track.y0 + 3 * s}, {at(frame_) + 1.5f * s, track.y1 - 3 * s},
                      shade(palette::amber), s);
}

TimelineWish Timeline::draw(Ui& ui, const Rect& rect, const Scene& scene, double now) {
  TimelineWish wish;
  if (!scene.animation || rect.width() <= 0 || rect.height() <= 0) {
    playing_ = false;
    return wish;
  }
  const Animation& animation = *scene.animation;
  const float s = ui.scale;
  frame_ = std::min(frame_, animation.frames - 1);
  if (playing_) {
    const auto played = static_cast<long long>((now - started_) * frames_per_second);
    wish.frame = static_cast<int>(played % animation.frames);
    ui.wake_in = std::min(ui.wake_in, 1 / frames_per_second);
  }
  draw_part(ui, "##film", rect, bar_flags, {8 * s, 5 * s}, [&] {
    if (ImGui::Button(playing_ ? "Stop" : "Play", {button_width * s, 0})) play_or_stop(now);
    log_item(ui, "film.play", playing_ ? "plays" : "rests");
    ImGui::SameLine();
    compat::push_font(ui.fonts.mono);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(fmt::format("{}/{}", frame_, animation.frames - 1).c_str());
    ImGui::PopFont();
    const float left = rect.x0 + (button_width + number_width + 20) * s, right = rect.x1 - (button_width + 30) * s;
    const Rect track{left, rect.y0 + 4 * s, std::max(left + 10, right), rect.y1 - 4 * s};
    ImGui::SetCursorScreenPos({track.x0 - 6 * s, track.y0});
    ImGui::InvisibleButton("track", {track.width() + 12 * s, track.height()});
    log_item(ui, "film.track", std::to_string(frame_));
    if (ImGui::IsItemActive()) {
      playing_ = false;
      const float part = std::clamp((ImGui::GetIO().MousePos.x - track.x0) / track.width(), 0.0f, 1.0f);
      wish.frame = static_cast<int>(std::lround(part * static_cast<float>(animation.frames - 1)));
    }
    draw_keys(ui, track, animation);
    if (has_keys(scene, frame_)) {
      ImGui::SetCursorScreenPos({rect.x1 - (button_width + 10) * s, rect.y0 + 5 * s});
      wish.remove = ImGui::Button("No key", {button_width * s, 0});
      log_item(ui, "film.no_key", "button");
      tooltip(ui, "takes the keys of this frame away");
    }
  });
  if (wish.frame == frame_ && !playing_) wish.frame.reset();
  if (wish.frame) frame_ = *wish.frame;
  return wish;
}

}  // namespace tyndall
