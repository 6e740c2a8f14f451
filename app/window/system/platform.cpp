#include "app/window/system/platform.h"

#include "app/window/system/imgui_compat.h"
#include "app/window/system/platform_events.h"
#include "app/window/system/style.h"
#include "core/base/error.h"
#include "core/system/process.h"
#include "core/system/signals.h"
#include "shaders.h"

#include <glad/gl.h>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace tyndall {
namespace {

std::string last_glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

/// Room on the screen for a window, without its frame.
std::pair<int, int> screen_room() {
  int x = 0, y = 0, width = 0, height = 0;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
  return width > 0 && height > 0 ? std::pair{width, height} : std::pair{1280, 800};
}

/// Whether the processors draw: then nothing is gained by waiting for the screen's next refresh.
bool draws_in_software() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string renderer = name ? name : "";
  return renderer.find("llvmpipe") != std::string::npos || renderer.find("softpipe") != std::string::npos;
}

GLFWwindow* open_window(int image_width, int image_height) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  float sx = 1, sy = 1;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) glfwGetMonitorContentScale(monitor, &sx, &sy);
  const auto [room_width, room_height] = screen_room();
  // Room for the column and the status line, though the image may be smaller.
  constexpr float min_width = 640, min_height = 720;
  const auto room = [&](int image, float minimum, float more) {
    return std::max(image, static_cast<int>(std::lround(minimum * sx))) + static_cast<int>(std::lround(more * sx));
  };
  const int width = room(image_width, min_width, column_width);
  const int height = room(image_height, min_height, status_height);
  return glfwCreateWindow(std::min(width, room_width), std::min(height, room_height), "Tyndall", nullptr, nullptr);
}

/// By GLFW and Dear ImGui's backends, which are used here only.
class GlfwPlatform : public Platform {
 public:
  GlfwPlatform(int image_width, int image_height);
  ~GlfwPlatform() override;

  void wait(double seconds) override;
  InputEvents take_events() override;
  bool take_close_wish() override;
  void hide() override { glfwHideWindow(state_.window); }
  WindowSize size() const override;
  const std::set<int>& held() const override { return state_.held; }
  bool shift_held() const override;
  void set_title(const std::string& title) override;
  void toggle_full_screen() override;
  void begin_frame() override;
  void clear() override;
  void end_frame() override;
  void drop_frame() override;
  void skip_frame() override { end_input_frame(state_); }
  void renew_fonts() override;
  void wake() override { glfwPostEmptyEvent(); }

 private:
  WindowState state_;
};

GlfwPlatform::GlfwPlatform(int image_width, int image_height) {
  if (!glfwInit()) throw IoError("the display cannot be used: " + last_glfw_error());
  state_.window = open_window(image_width, image_height);
  if (!state_.window) {
    const std::string why = last_glfw_error();
    glfwTerminate();
    throw IoError("no window with OpenGL 3.3: " + why);
  }
  glfwMakeContextCurrent(state_.window);
  if (!gladLoadGL(glfwGetProcAddress)) {
    glfwTerminate();
    throw IoError("no window: OpenGL's functions cannot be loaded");
  }
  glfwSwapInterval(draws_in_software() ? 0 : 1);
  glfwSetWindowUserPointer(state_.window, &state_);
  glfwSetWindowSizeLimits(state_.window, 160, 120, GLFW_DONT_CARE, GLFW_DONT_CARE);
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().ConfigInputTrickleEventQueue = false;  // InputQueue says what belongs to a frame
#endif
  ImGui_ImplGlfw_InitForOpenGL(state_.window, false);
  ImGui_ImplOpenGL3_Init(glsl_version);
  install_callbacks(state_.window);
}

GlfwPlatform::~GlfwPlatform() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwTerminate();
}

void GlfwPlatform::wait(double seconds) {
  if (seconds <= 0)
    glfwPollEvents();
  else if (seconds > 1e6)
    glfwWaitEvents();
  else
    glfwWaitEventsTimeout(seconds);
}

InputEvents GlfwPlatform::take_events() {
  deliver_input(state_);
  return std::exchange(state_.events, {});
}

bool GlfwPlatform::take_close_wish() {
  if (!glfwWindowShouldClose(state_.window)) return false;
  glfwSetWindowShouldClose(state_.window, GLFW_FALSE);
  if (glfwGetWindowAttrib(state_.window, GLFW_ICONIFIED)) glfwRestoreWindow(state_.window);
  return true;
}

WindowSize GlfwPlatform::size() const {
  WindowSize size;
  GLFWwindow* window = state_.window;
  glfwGetWindowSize(window, &size.width, &size.height);
  if (!glfwGetWindowAttrib(window, GLFW_ICONIFIED))
    glfwGetFramebufferSize(window, &size.framebuffer_width, &size.framebuffer_height);
  float density = 1, unused = 1;
  glfwGetWindowContentScale(window, &density, &unused);
  size.scale = size.pixels = std::clamp(density, 0.5f, 8.0f);
  // Where the system counts the window in points, a framebuffer of more pixels makes up for the density already.
  if (size.framebuffer_width > 0)
    size.scale = size.pixels * static_cast<float>(std::max(1, size.width)) / static_cast<float>(size.framebuffer_width);
  return size;
}

bool GlfwPlatform::shift_held() const {
  return state_.held.contains(GLFW_KEY_LEFT_SHIFT) || state_.held.contains(GLFW_KEY_RIGHT_SHIFT);
}

void GlfwPlatform::set_title(const std::string& title) {
  if (title == state_.title) return;
  glfwSetWindowTitle(state_.window, title.c_str());
  state_.title = title;
}

void GlfwPlatform::toggle_full_screen() {
  GLFWwindow* window = state_.window;
  if (glfwGetWindowMonitor(window)) {
    const Rect& r = state_.windowed;
    const auto whole = [](float v) { return static_cast<int>(v); };
    glfwSetWindowMonitor(window, nullptr, whole(r.x0), whole(r.y0), whole(r.width()), whole(r.height()),
                         GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  if (!mode) return;
  int x = 0, y = 0;
  glfwGetWindowPos(window, &x, &y);
  const auto real = [](int v) { return static_cast<float>(v); };
  const WindowSize now = size();
  state_.windowed = {real(x), real(y), real(x + now.width), real(y + now.height)};
  glfwSetWindowMonitor(window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void GlfwPlatform::begin_frame() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  set_delivered_input(state_);
  compat::new_frame();
}

void GlfwPlatform::clear() {
  glDisable(GL_SCISSOR_TEST);
  const WindowSize now = size();
  glViewport(0, 0, now.framebuffer_width, now.framebuffer_height);
  const Tone ink = palette::ink;
  glClearColor(ink.x, ink.y, ink.z, 1);
  glClear(GL_COLOR_BUFFER_BIT);
}

void GlfwPlatform::end_frame() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(state_.window);
  end_input_frame(state_);
}

void GlfwPlatform::drop_frame() {
  ImGui::EndFrame();
  end_input_frame(state_);
}

void GlfwPlatform::renew_fonts() {
#if IMGUI_VERSION_NUM < 19200
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
#endif
}

}  // namespace

std::unique_ptr<Platform> open_platform(int image_width, int image_height) {
  return std::make_unique<GlfwPlatform>(image_width, image_height);
}

void end_when_display_is_lost(std::function<std::string()> before_end) {
  static std::function<std::string()> last_wish;  // the X library's handler gets no argument of its own
  last_wish = std::move(before_end);
  ignore_lost_pipes();  // the signal comes first when the connection breaks
  // Ends the program, as X demands of such a handler. Destructors are left out: they would talk to the lost server.
  using Handler = int (*)(void* display);
  const Handler on_lost = [](void*) -> int {
    const std::string more = last_wish ? last_wish() : "";
    const std::string text = "tyndall: the display went away\n" + (more.empty() ? "" : "tyndall: " + more + "\n");
    std::fputs(text.c_str(), stderr);
    std::_Exit(3);
  };
  // The window library loads X by itself; linking it here would tie the program to it.
  void* function = loaded_function("libX11.so.6", "XSetIOErrorHandler");
  if (function) reinterpret_cast<Handler (*)(Handler)>(function)(on_lost);
}

}  // namespace tyndall
