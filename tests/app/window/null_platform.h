#pragma once
#include "app/window/system/platform.h"
#include "tests/app/window/null_imgui.h"

#include <glad/gl.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <set>
#include <string>
#include <utility>

/// A window system and an OpenGL of nothing: frames are built and thrown away.
namespace tyndall::test {

inline const unsigned char* version_text(GLenum) { return reinterpret_cast<const unsigned char*>("3.3"); }
inline void give_number(GLenum what, GLint* number) { *number = what == GL_MAX_TEXTURE_SIZE ? 16384 : 0; }
inline void give_number_of(GLuint, GLenum, GLint* number) { *number = 1; }
inline void do_nothing() {}

inline GLADapiproc null_function(const char* name) {
  const auto is = [&](const char* other) { return std::strcmp(name, other) == 0; };
  if (is("glGetString")) return reinterpret_cast<GLADapiproc>(version_text);
  if (is("glGetIntegerv")) return reinterpret_cast<GLADapiproc>(give_number);
  if (is("glGetShaderiv") || is("glGetProgramiv")) return reinterpret_cast<GLADapiproc>(give_number_of);
  return reinterpret_cast<GLADapiproc>(do_nothing);
}

/// A window system that shows nothing. Input comes from a Driver, one event before each frame.
class NullPlatform : public Platform {
 public:
  NullPlatform() {
    gladLoadGL(null_function);
    compat::mouse_pos(ImGui::GetIO(), -FLT_MAX, -FLT_MAX);  // nowhere
  }

  void wait(double seconds) override {
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, std::chrono::duration<double>(std::min(seconds, 0.02)), [&] { return woken_ || events.any; });
    woken_ = false;
  }
  InputEvents take_events() override { return std::exchange(events, {}); }
  void hide() override {}
  WindowSize size() const override { return {1280, height, 1280, height, 1, 1}; }
  const std::set<int>& held() const override { return held_keys; }
  void set_title(const std::string& text) override { title = text; }
  void toggle_full_screen() override {}
  void begin_frame() override {
    ImGui::GetIO().DisplaySize.y = static_cast<float>(height);
    compat::modifiers(ImGui::GetIO(), modifiers.control, modifiers.shift, modifiers.alt, false);
    compat::new_frame();
  }
  void clear() override {}
  void end_frame() override {
    ImGui::Render();
    compat::textures_without_window();
  }
  void drop_frame() override { ImGui::EndFrame(); }
  void skip_frame() override {}
  void renew_fonts() override { compat::init_without_window(ImGui::GetIO()); }
  void wake() override {
    const std::lock_guard lock(mutex_);
    woken_ = true;
    news_.notify_one();
  }

  InputEvents events;  ///< for the next frame
  int height = 2640;   ///< of the window: so high that all of the column is in it
  std::string title;
  Modifiers modifiers;
  std::set<int> held_keys;

 private:
  NullImGui imgui_{1280, static_cast<float>(height)};
  std::mutex mutex_;
  std::condition_variable news_;
  bool woken_ = false;
};

}  // namespace tyndall::test
