// What emscripten's GLFW lacks, or does in another way than the window expects: screens and their density, names of
// keys, the wheel, full screen and the clipboard. These functions take the place of those of the same name in its
// library.
#include <emscripten/em_js.h>
#include <emscripten/html5.h>

#include <cstdlib>

#include <GLFW/glfw3.h>

EM_JS(int, page_is_hidden, (), { return document.hidden; });
EM_JS(int, page_has_focus, (), { return document.hasFocus(); });
EM_JS(int, is_full_screen, (), { return !!document.fullscreenElement; });
EM_JS(void, set_full_screen, (int on),
      { on ? document.documentElement.requestFullscreen() : document.exitFullscreen(); });
EM_JS(void, set_clipboard, (const char* text), { Module['copy'](UTF8ToString(text)); });
EM_JS(char*, get_clipboard, (), { return stringToNewUTF8(Module['pasted']); });

namespace {

GLFWscrollfun scrolled = nullptr;

/// One notch is about 100 pixels or 3 lines, of which browsers tell either.
EM_BOOL on_wheel(int, const EmscriptenWheelEvent* event, void* window) {
  const double notch = event->deltaMode == DOM_DELTA_PIXEL ? -100 : event->deltaMode == DOM_DELTA_LINE ? -3 : -1;
  if (scrolled) scrolled(static_cast<GLFWwindow*>(window), event->deltaX / notch, event->deltaY / notch);
  return true;
}

}  // namespace

int glfwGetError(const char** text) {
  if (text) *text = nullptr;
  return 0;
}
void glfwGetMonitorContentScale(GLFWmonitor*, float* x, float* y) {
  *x = *y = static_cast<float>(emscripten_get_device_pixel_ratio());
}
void glfwGetWindowContentScale(GLFWwindow*, float* x, float* y) { glfwGetMonitorContentScale(nullptr, x, y); }
GLFWwindowcontentscalefun glfwSetWindowContentScaleCallback(GLFWwindow*, GLFWwindowcontentscalefun) { return nullptr; }
void glfwGetMonitorWorkarea(GLFWmonitor*, int*, int*, int* width, int* height) { *width = *height = 0; }
void glfwSetWindowSizeLimits(GLFWwindow*, int, int, int, int) {}
void glfwSwapInterval(int) {}

/// Its numbers of keys follow the user's keyboard already.
const char* glfwGetKeyName(int key, int) {
  static char name[2] = "";
  name[0] = static_cast<char>(key >= 'A' && key <= 'Z' ? key - 'A' + 'a' : key);
  return key > 0 && key < 128 ? name : nullptr;
}

GLFWscrollfun glfwSetScrollCallback(GLFWwindow* window, GLFWscrollfun callback) {
  emscripten_set_wheel_callback("#canvas", window, true, on_wheel);
  scrolled = callback;
  return nullptr;
}

int glfwGetWindowAttrib(GLFWwindow*, int attribute) {
  return attribute == GLFW_ICONIFIED ? page_is_hidden() : attribute == GLFW_FOCUSED ? page_has_focus() : 1;
}

const GLFWvidmode* glfwGetVideoMode(GLFWmonitor*) {
  static const GLFWvidmode mode{};
  return &mode;
}
GLFWmonitor* glfwGetWindowMonitor(GLFWwindow*) { return is_full_screen() ? glfwGetPrimaryMonitor() : nullptr; }
void glfwSetWindowMonitor(GLFWwindow*, GLFWmonitor* monitor, int, int, int, int, int) {
  set_full_screen(monitor != nullptr);
}

void glfwSetClipboardString(GLFWwindow*, const char* text) { set_clipboard(text); }
const char* glfwGetClipboardString(GLFWwindow*) {
  static char* text = nullptr;
  std::free(text);
  return text = get_clipboard();
}
