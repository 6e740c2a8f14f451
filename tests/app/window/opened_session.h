#pragma once
#include "app/window/session.h"
#include "tests/app/window/scenes.h"
#include "tests/support/news.h"
#include "tests/support/paths.h"
#include "tests/support/scratch.h"

#include <atomic>
#include <cstdlib>
#include <functional>
#include <memory>
#include <mutex>

/// A window's session for tests: everything but the window.
namespace tyndall::test {

/// A session over a small scene file in a folder of its own, which is the current folder while this lives.
class OpenedSession {
 public:
  /// adjust(options): what the command line would say.
  explicit OpenedSession(const std::string& name, const std::function<void(WindowOptions&)>& adjust = {})
      : before_(std::filesystem::current_path()) {
    const std::filesystem::path folder = scratch_folder("session_" + name);
    std::filesystem::current_path(folder);
    setenv("XDG_STATE_HOME", (folder / "state").c_str(), 1);
    write(0.25);
    open(adjust);
  }
  ~OpenedSession() {
    session.reset();
    std::filesystem::current_path(before_);
  }

  /// Begins a session over what the file holds now.
  void open(const std::function<void(WindowOptions&)>& adjust = {}) {
    session.reset();
    WindowOptions options;
    options.scene = load_scene("scene.json");
    options.threads = 1;
    if (adjust) adjust(options);
    const auto on_frame = [this] {
      ++frames;
      news.tell();
      const std::lock_guard wait(gate);
    };
    session = std::make_unique<Session>(
        options, [this] { news.tell(); }, on_frame, nullptr);
  }
  /// Ends the session and begins another one, as the next start of the program does.
  void reopen(const std::function<void(WindowOptions&)>& adjust = {}) {
    session->keep_edits();
    open(adjust);
  }

  static std::string text(double fuzz) {
    return R"({ "tyndall": 1, "image": { "width": 8, "height": 8 }, "background": [1, 1, 1],
      "render": { "spp": 4, "integrator": "path", "sampler": "random" },
      "materials": { "gold": { "type": "metal", "albedo": [1, 1, 1], "fuzz": )" +
           std::to_string(fuzz) + R"( } },
      "objects": [{ "type": "sphere", "center": [0, 0, -2], "radius": 1, "material": "gold" }] })";
  }
  static void write(double fuzz, const std::string& file = "scene.json") { write_text(file, text(fuzz)); }
  static double fuzz_of(const Scene& scene) { return std::get<Metal<>>(scene.materials[0].kind).fuzz; }
  static double fuzz_in(const std::string& file) { return fuzz_of(load_scene(file).scene); }

  Editor& editor() const { return session->editor; }
  const Scene& scene() const { return editor().scene(); }
  double fuzz() const { return fuzz_of(scene()); }
  /// Makes an edit of what change(scene) does.
  template <class Change>
  void edit(const Change& change, std::uint64_t gesture = 0) {
    Scene next = scene();
    change(next);
    editor().edit(std::move(next), gesture);
  }
  void set_fuzz(double fuzz, std::uint64_t gesture = 0) {
    edit([&](Scene& next) { std::get<Metal<>>(next.materials[0].kind).fuzz = fuzz; }, gesture);
  }
  std::uint64_t sent() const { return session->renderers.edit(Half::current); }
  std::shared_ptr<const Frame> frame(Half half = Half::current) const { return session->renderers.latest(half); }
  void show(Half half = Half::current) { session->shown(half, frame(half)); }
  std::string message() const { return session->messages.current().text; }

  template <class Condition>
  bool comes_true(const Condition& condition) {
    return news.wait_until([&] {
      session->collect();
      session->accuracy.collect();
      session->send(1e9);  // out of patience
      return condition();
    });
  }
  bool becomes(double expected) {
    return comes_true([&] { return fuzz() == expected; });
  }
  bool opens(const std::string& file, double expected) {
    editor().open(std::filesystem::absolute(file).string());
    return becomes(expected);
  }
  bool says(const std::string& begin) {
    return comes_true([&] { return message().starts_with(begin); });
  }
  bool complains() {
    return comes_true([&] { return session->messages.current().error; });
  }
  bool appears(const std::string& file) {
    return comes_true([&] { return std::filesystem::exists(file) && session->saving.idle(); });
  }
  bool finishes() {
    return comes_true([&] {
      const auto now = frame();
      return now && now->finished && now->edit == sent() && session->timer.latest() > 1e100;
    });
  }

  test::News news;
  std::mutex gate;  ///< holds the renderer after its next frame
  std::atomic<int> frames = 0;
  std::unique_ptr<Session> session;

 private:
  std::filesystem::path before_;
};

}  // namespace tyndall::test
