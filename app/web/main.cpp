// The window in a page: the browser calls MainWindow::step() whenever it is about to draw.
#include "app/web/link.h"
#include "app/window/main_window.h"
#include "core/base/error.h"
#include "core/system/processors.h"

#include <emscripten/emscripten.h>
#include <emscripten/html5.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>

// What is in EM_JS is JavaScript; Module's functions are page.js's.

/// The size of the page in the screen's dots becomes that of the canvas, which the style sheet stretches over the page.
EM_JS(void, fit_canvas, (), {
  const canvas = Module['canvas'], ratio = window.devicePixelRatio || 1;
  const width = Math.max(1, Math.round(window.innerWidth * ratio));
  const height = Math.max(1, Math.round(window.innerHeight * ratio));
  if (canvas.width != width || canvas.height != height) Browser.setCanvasSize(width, height, false);
});
/// What follows # in the page's address, for std::free().
EM_JS(char*, scene_of_address, (), { return stringToNewUTF8(Module['scene']()); });
EM_JS(int, address_has, (const char* word), { return new URLSearchParams(location.search).has(UTF8ToString(word)); });
EM_JS(int, address_number, (const char* word),
      { return parseInt(new URLSearchParams(location.search).get(UTF8ToString(word)) || '0'); });
/// Module.open() opens a file as one that was dropped.
EM_JS(void, take_files, (), {
  Module['open'] = function(path) {
    const file = stringToNewUTF8(path), list = _malloc(4);
    setValue(list, file, 'i32');
    getWasmTableEntry(GLFW.active.dropFunc)(GLFW.active.id, 1, list);
    _free(file), _free(list);
  };
});
EM_JS(void, tell_page, (const char* what), { Module['tell'](UTF8ToString(what)); });

namespace tyndall {
namespace {

std::unique_ptr<MainWindow> window;

void end(const std::string& why) {
  tell_page(why.c_str());
  emscripten_cancel_main_loop();
}

std::string why_of(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error)
             ? "There is no memory left for this scene: a page has 2 GB at most. Load it again, and take a smaller "
               "picture."
             : error.what();
}

void on_draw() try {
  fit_canvas();
  if (!window->step()) end("Tyndall is closed. Load the page again to open it.");
} catch (const std::exception& error) {
  end(why_of(error));
}

/// A hidden tab renders nothing.
EM_BOOL on_visibility(int, const EmscriptenVisibilityChangeEvent* event, void*) {
  window->rest(event->hidden);
  return false;
}

/// "#cornell-smoke", "#{JSON}" or what link_of_scene() has written; nothing: the showroom.
LoadedScene scene_of(const std::string& named) {
  const bool is_link = named.starts_with("z=");
  if (!is_link && !named.starts_with("{")) return load_scene(named.empty() ? "showroom" : named);
  return load_scene_text(is_link ? scene_of_link(named) : named, "the page's address", assets_folder() / "scenes");
}

void open_page() {
  const std::unique_ptr<char, decltype(&std::free)> named(scene_of_address(), &std::free);
  WindowOptions options;
  options.scene = scene_of(named.get());
  options.scene_named = *named != '\0';
  options.hosted = true;
  const int threads = address_number("threads");
  options.threads = threads > 0 ? threads : std::clamp(thread_count().count, 1, 16);
  if (address_has("log")) options.ui_log = "-";  // into the browser's console
  if (address_has("scalar")) options.isa = "scalar";
  take_files();
  const Scene& scene = options.scene.scene;
  window = std::make_unique<MainWindow>(options, nullptr, open_platform(scene.width, scene.height));
  emscripten_set_visibilitychange_callback(nullptr, false, on_visibility);
}

}  // namespace
}  // namespace tyndall

int main() try {
  setenv("TYNDALL_ASSETS", "/assets", 1);
  std::filesystem::current_path("/saved");  // which page.js makes, and hands over what comes there
  tyndall::open_page();
  tell_page("");
  emscripten_set_main_loop(tyndall::on_draw, 0, false);
} catch (const std::exception& error) {
  tell_page(tyndall::why_of(error).c_str());
  return 1;
}
