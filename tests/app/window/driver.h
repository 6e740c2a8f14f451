#pragma once
#include "app/window/main_window.h"
#include "tests/app/window/null_platform.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <utility>

/// The whole window within a test: no display, no OpenGL, input by the names that controls have in its log.
namespace tyndall::test {

/// Of a small scene: a metal ball, fog and a lamp.
inline const std::string scene_text = read_text(tests_folder() / "window" / "scene.json");

/// A window over a scene file, and hands for it.
class Driver {
 public:
  /// name: of a folder for this test, which becomes the current one, and has the file scene.json. adjust(options): what
  /// the command line would say.
  explicit Driver(const std::string& name, const std::function<void(WindowOptions&)>& adjust = {});
  ~Driver();

  /// Draws what input leads to; after an edit until its picture is finished and nothing will change any more.
  void settle();
  /// Puts the mouse on a control; across and down: from 0 to 1.
  void point(const std::string& name, double across = 0.5, double down = 0.5) {
    REQUIRE_MESSAGE(has(name), name);
    const Widget& at = widgets_.at(name);
    compat::mouse_pos(ImGui::GetIO(), at.x0 + static_cast<float>(across) * (at.x1 - at.x0),
                      at.y0 + static_cast<float>(down) * (at.y1 - at.y0));
    step();
  }
  /// Moves the mouse by window units.
  void move(float right, float down) {
    const ImVec2 now = ImGui::GetIO().MousePos;
    compat::mouse_pos(ImGui::GetIO(), now.x + right, now.y + down);
    step();
  }
  void press(int button = 0) { hold(button, true); }
  void release(int button = 0) { hold(button, false); }
  void click(const std::string& name, double across = 0.5, double down = 0.5, int button = 0) {
    push(name, across, down, button), settle();
  }
  void click_ball() { click("picture", 0.5, 0.45); }
  /// The same without waiting for a picture.
  void push(const std::string& name, double across = 0.5, double down = 0.5, int button = 0) {
    point(name, across, down);
    press(button);
    release(button);
    for (int k = 0; k < 3; ++k) step();
  }
  /// Presses at one place of the picture and releases at another one.
  void drag(double from_across, double from_down, double to_across, double to_down, int button = 0) {
    point("picture", from_across, from_down);
    press(button);
    for (const double way : {0.5, 1.0})
      point("picture", from_across + way * (to_across - from_across), from_down + way * (to_down - from_down));
    release(button);
    settle();
  }
  void wheel(float notches) {
    compat::mouse_wheel(ImGui::GetIO(), notches);
    settle();
  }
  /// What is held while mouse and wheel are used, until it is told otherwise.
  void hold(Modifiers modifiers) { platform_->modifiers = modifiers; }
  /// A key that flies the camera.
  void fly(int code) {
    platform_->held_keys = {code};
    for (int k = 0; k < 3; ++k) step();
    platform_->held_keys.clear();
    settle();
  }
  /// A key: GLFW's number, letters by their capital.
  void key(int code, Modifiers modifiers = {}) { send_key(code, modifiers), settle(); }
  void send_key(int code, Modifiers modifiers = {}) {
    platform_->events.keys.push_back({code, modifiers, ImGui::GetIO().WantTextInput});
    step();
  }
  /// A key of Dear ImGui's own, for the control that has the keyboard.
  void strike(ImGuiKey key, int times = 1) {
    for (int k = 0; k < 2 * times; ++k) {
      compat::key(ImGui::GetIO(), key, k % 2 == 0);
      step();
    }
  }
  void escape() {
    strike(ImGuiKey_Escape);  // for a control that has the keyboard
    key(256);
  }
  void undo() { chord('Z'); }
  /// Characters, as shortcuts get them.
  void press_characters(const std::string& text) {
    for (const char c : text) platform_->events.keys.push_back({0, {}, false, c});
    settle();
  }
  /// Into the control that has the keyboard.
  void write(const std::string& text) {
    type_text(text.c_str());
    step();
  }
  /// The same in place of all that it holds, and Enter.
  void type(const std::string& text) {
    hold({.control = true});
    strike(ImGuiKey_A);
    hold({});
    write(text);
    strike(ImGuiKey_Enter);
    settle();
  }
  /// A value, into the box of its row.
  void set(const std::string& row, const std::string& text) {
    click(row + ".value");
    type(text);
  }
  /// What Ctrl + K finds first is carried out.
  void find(const std::string& words) {
    chord('K');
    type(words);
  }
  /// Ctrl + Z and the like.
  void chord(int code, bool shift = false) { key(code, {.control = true, .shift = shift}); }
  /// Lets the window go on until that is so.
  void wait_until(const std::function<bool()>& is_so);
  /// Until the newest line of a kind has these words, "": there is none; until the value of a control has them.
  void await(const std::string& kind, const std::string& words) {
    wait_until([&] { return words.empty() ? last(kind).empty() : last(kind).find(words) != std::string::npos; });
  }
  void await_value(const std::string& control, const std::string& words) {
    wait_until([&] { return value(control).find(words) != std::string::npos; });
  }
  void await_gone(const std::string& control) {
    wait_until([&] { return !has(control); });
  }
  void save() {
    chord('S');
    await("saved", "scene.json");
  }

  /// Whether a control is on the screen, and its value as the log has it.
  bool has(const std::string& control) const { return widgets_.contains(control); }
  std::string value(const std::string& control) const {
    const auto found = widgets_.find(control);
    return found == widgets_.end() ? "" : found->second.value;
  }
  double number(const std::string& control) const { return std::stod(value(control)); }
  /// Its width on the screen.
  float width(const std::string& control) const { return widgets_.at(control).x1 - left(control); }
  float left(const std::string& control) const { return widgets_.at(control).x0; }
  /// The newest line of a kind, without its first word; "": there is none.
  std::string last(const std::string& kind) const {
    const auto found = last_.find(kind);
    return found == last_.end() ? "" : found->second;
  }
  /// Whether the window has not been closed.
  bool is_open() const { return open_; }
  /// How many edits were sent to the renderer.
  int submits() const { return submits_; }
  NullPlatform& platform() { return *platform_; }
  MainWindow& window() { return *window_; }

 private:
  struct Widget {
    float x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    std::string value;
  };
  void pass() {
    skipped_seconds = skipped_seconds + echo_interval;  // drawings keep a distance
    open_ = window_->step();
    read_log();
  }
  /// A drawing, as after input.
  void step() {
    const int before = drawn_;
    platform_->events.any = true;
    for (int k = 0; k < 100 && drawn_ == before && open_; ++k) pass();
  }
  void hold(int button, bool down) {
    compat::mouse_button(ImGui::GetIO(), button, down);
    step();
  }
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
  bool open_ = true;
};

inline Driver::Driver(const std::string& name, const std::function<void(WindowOptions&)>& adjust)
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
  if (adjust) adjust(options);
  auto platform = std::make_unique<NullPlatform>();
  platform_ = platform.get();
  window_ = std::make_unique<MainWindow>(options, nullptr, std::move(platform));
  log_.open(options.ui_log);
  wait_until([&] { return !last("frame").empty(); });
}

inline Driver::~Driver() {
  window_.reset();
  std::filesystem::current_path(before_);
}

inline void Driver::settle() {
  for (int k = 0; k < 4; ++k) step();  // what was typed or clicked reaches its control a few frames later
  const float before = std::exchange(ImGui::GetIO().DeltaTime, 1.0f);  // tooltips that wait for a moment come now
  step();
  ImGui::GetIO().DeltaTime = before;
  const bool comes = last("state").starts_with("row ");  // a picture that is still being written
  if (std::exchange(settled_, submits_) == submits_ || comes) return;
  for (int k = 0; k < 2000 && newest_ != "rest"; ++k) {  // without skipping time, in which messages would go
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

inline void Driver::wait_until(const std::function<bool()>& is_so) {
  for (int k = 0; k < 2000 && !is_so(); ++k) pass();
  REQUIRE(is_so());
}

}  // namespace tyndall::test
