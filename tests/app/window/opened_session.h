#pragma once
#include "app/window/session.h"
#include "tests/support/news.h"
#include "tests/support/paths.h"

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <string>

/// A window's session for tests: everything but the window.
namespace tyndall::test {

/// A session over a small scene file in a folder of its own, which is the current folder while this lives.
class OpenedSession {
 public:
  explicit OpenedSession(const std::string& name) : folder_(scratch_folder() / ("session_" + name)) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    before_ = std::filesystem::current_path();
    std::filesystem::current_path(folder_);
    setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);
    write(0.25);
    open();
  }
  ~OpenedSession() {
    session.reset();
    std::filesystem::current_path(before_);
  }

  /// Begins a session over what the file holds now.
  void open() {
    WindowOptions options;
    options.scene = load_scene("scene.json");
    options.threads = 1;
    session = std::make_unique<Session>(
        options, [this] { news.tell(); },
        [this] {
          ++frames;
          news.tell();
          const std::lock_guard wait(gate);
        },
        nullptr);
  }
  /// Ends the session and begins another one, as the next start of the program does.
  void reopen() {
    session->keep_edits();
    session.reset();
    open();
  }

  static void write(double fuzz, const std::string& file = "scene.json") {
    std::ofstream(file) << R"({ "tyndall": 1, "image": { "width": 8, "height": 8 }, "background": [1, 1, 1],
      "render": { "spp": 4, "integrator": "path", "sampler": "random" },
      "materials": { "gold": { "type": "metal", "albedo": [1, 1, 1], "fuzz": )"
                        << fuzz << R"( } },
      "objects": [{ "type": "sphere", "center": [0, 0, -2], "radius": 1, "material": "gold" }] })";
  }
  double fuzz() const { return std::get<Metal<>>(session->editor.scene().materials[0].kind).fuzz; }
  void set_fuzz(double fuzz, std::uint64_t gesture = 0) {
    Scene scene = session->editor.scene();
    std::get<Metal<>>(scene.materials[0].kind).fuzz = fuzz;
    session->editor.edit(scene, gesture);
  }
  template <class Condition>
  bool comes_true(const Condition& condition) {
    return news.wait_until([&] {
      session->collect();
      session->accuracy.collect();
      session->send(1e9);  // out of patience
      return condition();
    });
  }
  bool finishes() {
    return comes_true([&] {
      const auto frame = session->renderers.latest(Half::current);
      return frame && frame->finished && frame->edit == session->renderers.edit(Half::current) &&
             session->timer.latest() > 1e100;
    });
  }

  test::News news;
  std::mutex gate;  ///< holds the renderer after its next frame
  std::atomic<int> frames = 0;
  std::unique_ptr<Session> session;

 private:
  std::filesystem::path folder_, before_;
};

}  // namespace tyndall::test
