#include "app/window/system/platform.h"

#include "app/window/system/imgui_compat.h"
#include "app/window/system/layout.h"
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
  int x = 0, y = 0, room_width = 0, room_height = 0;  // on the screen, for a window without its frame
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
    glfwGetMonitorContentScale(monitor, &sx, &sy);
    glfwGetMonitorWorkarea(monitor, &x, &y, &room_width, &room_height);
  }
  if (room_width <= 0 || room_height <= 0) room_width = 1280, room_height = 800;
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
  GlfwPlatform(int image_width, int image_height) {
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
  ~GlfwPlatform() override {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwTerminate();
  }

  void wait(double seconds) override {
    if (seconds <= 0)
      glfwPollEvents();
    else if (seconds > 1e6)
      glfwWaitEvents();
    else
      glfwWaitEventsTimeout(seconds);
  }
  InputEvents take_events() override {
    deliver_input(state_);
    if (glfwWindowShouldClose(state_.window)) {
      state_.events.closes = true;
      glfwSetWindowShouldClose(state_.window, GLFW_FALSE);
      if (glfwGetWindowAttrib(state_.window, GLFW_ICONIFIED)) glfwRestoreWindow(state_.window);
    }
    return std::exchange(state_.events, {});
  }
  void hide() override { glfwHideWindow(state_.window); }
  WindowSize size() const override {
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
      size.scale =
          size.pixels * static_cast<float>(std::max(1, size.width)) / static_cast<float>(size.framebuffer_width);
    return size;
  }
  const std::set<int>& held() const override { return state_.held; }
  void set_title(const std::string& title) override {
    if (title == state_.title) return;
    glfwSetWindowTitle(state_.window, title.c_str());
    state_.title = title;
  }
  void toggle_full_screen() override {
    GLFWwindow* window = state_.window;
    int(&place)[4] = state_.windowed;
    if (glfwGetWindowMonitor(window))
      return glfwSetWindowMonitor(window, nullptr, place[0], place[1], place[2], place[3], GLFW_DONT_CARE);
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (!mode) return;
    glfwGetWindowPos(window, &place[0], &place[1]);
    glfwGetWindowSize(window, &place[2], &place[3]);
    glfwSetWindowMonitor(window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  }
  void begin_frame() override {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    set_delivered_input(state_);
    compat::new_frame();
  }
  void clear() override {
    glDisable(GL_SCISSOR_TEST);
    const WindowSize now = size();
    glViewport(0, 0, now.framebuffer_width, now.framebuffer_height);
    const Tone ink = palette::ink;
    glClearColor(ink.x, ink.y, ink.z, 1);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  void end_frame() override {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(state_.window);
    end_input_frame(state_);
  }
  void drop_frame() override {
    ImGui::EndFrame();
    end_input_frame(state_);
  }
  void skip_frame() override { end_input_frame(state_); }
  void renew_fonts() override {
#if IMGUI_VERSION_NUM < 19200
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
#endif
  }
  void wake() override { glfwPostEmptyEvent(); }

 private:
  WindowState state_;
};

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
