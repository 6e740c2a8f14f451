#pragma once
#include "app/window/main_window.h"
#include "tests/app/window/null_platform.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <utility>

/// The whole window within a test: no display, no OpenGL, input by the names that controls have in its log.
namespace tyndall::test {

inline constexpr const char* scene_text = R"({ "tyndall": 1,
  "image": { "width": 32, "height": 20 },
  "camera": { "look_from": [0, 1, 6], "look_at": [0, 0.5, 0], "vfov": 40 },
  "background": { "type": "gradient", "bottom": [0.9, 0.9, 0.9], "top": [0.2, 0.3, 0.5] },
  "render": { "spp": 2, "integrator": "path", "sampler": "random" },
  "materials": { "floor": { "type": "lambertian", "albedo": [0.4, 0.4, 0.4] },
    "gold": { "type": "metal", "albedo": [0.9, 0.6, 0.3], "fuzz": 0.2 } },
  "objects": [
    { "name": "floor", "type": "sphere", "center": [0, -1000, 0], "radius": 1000, "material": "floor" },
    { "name": "ball", "type": "sphere", "center": [0, 0.8, 0], "radius": 0.8, "material": "gold" }] })";

/// A window over a scene file, and hands for it.
class Driver {
 public:
  /// name: of a folder for this test, which becomes the current one, and has the file scene.json.
  explicit Driver(const std::string& name);
  ~Driver();

  /// Draws what input leads to; after an edit until its picture is finished and nothing will change any more.
  void settle();
  /// Puts the mouse on a control; across and down: from 0 to 1.
  void point(const std::string& name, double across = 0.5, double down = 0.5);
  void press(int button = 0) { hold(button, true); }
  void release(int button = 0) { hold(button, false); }
  void click(const std::string& name, double across = 0.5, double down = 0.5, int button = 0);
  /// A key: GLFW's number, letters by their capital.
  void key(int code, Modifiers modifiers = {});
  /// Into the control that has the keyboard, and Enter.
  void type(const std::string& text);
  /// What Ctrl + K finds first is carried out.
  void find(const std::string& words);

  /// Whether a control is on the screen, and its value as the log has it.
  bool has(const std::string& control) const { return widgets_.contains(control); }
  std::string value(const std::string& control) const;
  /// The newest line of a kind, without its first word; "": there is none.
  std::string last(const std::string& kind) const;
  /// How many edits were sent to the renderer.
  int submits() const { return submits_; }
  MainWindow& window() { return *window_; }

 private:
  struct Widget {
    float x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    std::string value;
  };
  void step();
  void hold(int button, bool down);
  void read_log();

  std::filesystem::path folder_, before_;
  NullPlatform* platform_ = nullptr;
  std::unique_ptr<MainWindow> window_;
  std::ifstream log_;
  std::map<std::string, Widget> widgets_;
  std::map<std::string, std::string> last_;
  std::string newest_;              ///< the last line
  int drawn_ = 0;                   ///< how often
  int submits_ = 0, settled_ = -1;  ///< now, and when it had settled last
};

inline Driver::Driver(const std::string& name)
    : folder_(scratch_folder() / ("window_" + name)), before_(std::filesystem::current_path()) {
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_ / "config/tyndall");
  std::filesystem::current_path(folder_);
  std::ofstream("config/tyndall/window.txt") << "clean off\n";
  for (const auto& [variable, place] : {std::pair{"XDG_STATE_HOME", "state"}, {"XDG_CONFIG_HOME", "config"}})
    setenv(variable, (folder_ / place).c_str(), 1);
  setenv("XDG_CACHE_HOME", (scratch_folder() / "window_cache").c_str(), 1);  // small pictures of scenes, made once
  std::ofstream("scene.json") << scene_text;
  WindowOptions options;
  options.scene = load_scene("scene.json");
  options.threads = 1;
  options.ui_log = folder_ / "log";
  options.hosted = true;
  auto platform = std::make_unique<NullPlatform>();
  platform_ = platform.get();
  window_ = std::make_unique<MainWindow>(options, nullptr, std::move(platform));
  log_.open(options.ui_log);
  settle();
}

inline Driver::~Driver() {
  window_.reset();
  std::filesystem::current_path(before_);
}

inline void Driver::step() {
  const int before = drawn_;
  platform_->events.any = true;
  for (int k = 0; k < 100 && drawn_ == before; ++k) {  // drawings keep a distance
    window_->step();
    read_log();
  }
}

inline void Driver::settle() {
  for (int k = 0; k < 4; ++k) step();  // what was typed or clicked reaches its control a few frames later
  const float before = std::exchange(ImGui::GetIO().DeltaTime, 1.0f);  // tooltips that wait for a moment come now
  step();
  ImGui::GetIO().DeltaTime = before;
  if (std::exchange(settled_, submits_) == submits_) return;
  for (int k = 0; k < 2000 && newest_ != "rest"; ++k) {
    window_->step();
    read_log();
  }
  REQUIRE(newest_ == "rest");
}

inline void Driver::read_log() {
  log_.clear();
  for (std::string line; std::getline(log_, line); newest_ = line) {
    std::istringstream words(line);
    std::string kind, rest;
    words >> kind;
    if (kind == "widget") {
      Widget widget;
      std::string name;
      words >> name >> widget.x0 >> widget.y0 >> widget.x1 >> widget.y1 >> std::ws;
      std::getline(words, widget.value);
      widgets_[name] = widget;
    } else if (kind == "gone") {
      words >> rest;
      widgets_.erase(rest);
    } else {
      std::getline(words >> std::ws, rest);
      last_[kind] = rest;
      submits_ += kind == "submit" ? 1 : 0;
      drawn_ += kind == "drawn" ? 1 : 0;
    }
  }
}

inline void Driver::point(const std::string& name, double across, double down) {
  REQUIRE_MESSAGE(has(name), name);
  const Widget& at = widgets_.at(name);
  compat::mouse_pos(ImGui::GetIO(), at.x0 + static_cast<float>(across) * (at.x1 - at.x0),
                    at.y0 + static_cast<float>(down) * (at.y1 - at.y0));
  step();
}

inline void Driver::hold(int button, bool down) {
  compat::mouse_button(ImGui::GetIO(), button, down);
  step();
}

inline void Driver::click(const std::string& name, double across, double down, int button) {
  point(name, across, down);
  press(button);
  release(button);
  settle();
}

inline void Driver::key(int code, Modifiers modifiers) {
  platform_->events.keys.push_back({code, modifiers, ImGui::GetIO().WantTextInput});
  settle();
}

inline void Driver::type(const std::string& text) {
  for (const char c : text) ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
  step();
  for (const bool down : {true, false}) {
    compat::key(ImGui::GetIO(), ImGuiKey_Enter, down);
    step();
  }
  settle();
}

inline void Driver::find(const std::string& words) {
  key('K', {.control = true});
  type(words);
}

inline std::string Driver::value(const std::string& control) const {
  const auto found = widgets_.find(control);
  return found == widgets_.end() ? "" : found->second.value;
}

inline std::string Driver::last(const std::string& kind) const {
  const auto found = last_.find(kind);
  return found == last_.end() ? "" : found->second;
}

}  // namespace tyndall::test
