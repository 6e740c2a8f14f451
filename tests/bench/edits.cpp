#include "core/render/renderer.h"
#include "tests/bench/bench.h"

#include <cmath>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace tyndall::bench {
namespace {

constexpr int width = 1280, height = 720;
constexpr auto pause_between = std::chrono::milliseconds(40);  // so that passes run when the next edit comes
constexpr auto patience = std::chrono::seconds(30);

/// When the pictures of an edit came.
struct Arrivals {
  double first_ms = 0;  ///< from request() to the first frame
  double full_ms = 0;   ///< to the first with a sample in every pixel
  int step = 0;         ///< of the first frame
};

/// The interactive renderer without a window, and a clock.
class Viewer {
 public:
  Viewer() : renderer_(Renderer::Options{}, [this] { note_frame(); }) {}

  /// Submits a scene and waits for its first full frame. Throws WrongResult if none comes.
  Arrivals show(const Scene& scene) {
    std::unique_lock lock(mutex_);
    first_ = full_ = std::nullopt;
    lock.unlock();
    const Clock::time_point start = Clock::now();
    renderer_.request({.scene = std::make_shared<const Scene>(scene)});
    lock.lock();
    if (!arrived_.wait_for(lock, patience, [&] { return full_.has_value(); }))
      throw WrongResult("an edit was not shown within 30 s");
    return {1000 * seconds_between(start, *first_), 1000 * seconds_between(start, *full_), step_};
  }

 private:
  /// On the renderer's thread, after each frame.
  void note_frame() {
    const Clock::time_point now = Clock::now();
    const auto frame = renderer_.latest();
    const std::lock_guard lock(mutex_);
    if (!frame || frame->edit <= shown_) return;
    if (!first_) first_ = now, step_ = frame->step;
    if (frame->spp == 0) return;
    shown_ = frame->edit;
    full_ = now;
    arrived_.notify_one();
  }

  std::mutex mutex_;
  std::condition_variable arrived_;
  std::optional<Clock::time_point> first_, full_;
  std::uint64_t shown_ = 0;  ///< newest edit of which a full frame came
  int step_ = 0;
  Renderer renderer_;  // declared last, so that its threads end first
};

/// The i-th scene of a series in which one thing moves a little each time.
using Series = Scene (*)(const Scene& scene, int i);

/// Turns the camera about the vertical through what it looks at, half a degree each time.
Scene orbit(const Scene& scene, int i) {
  constexpr double degree = 3.14159265358979323846 / 180;
  Scene moved = scene;
  const double sine = std::sin(0.5 * degree * i), cosine = std::cos(0.5 * degree * i);
  const Vec3d at = scene.camera.look_at, arm = scene.camera.look_from - at;
  moved.camera.look_from = at + Vec3d{cosine * arm.x + sine * arm.z, arm.y, cosine * arm.z - sine * arm.x};
  return moved;
}

/// Moves the first fuzz, else the first density, by a hundredth of a value each time.
Scene drag_material(const Scene& scene, int i) {
  Scene moved = scene;
  for (Material& material : moved.materials)
    if (auto* metal = std::get_if<Metal<>>(&material.kind)) return metal->fuzz = 0.1 + 0.01 * i, moved;
  for (Object& object : moved.objects)
    if (auto* volume = std::get_if<Volume>(&object.kind)) return volume->medium.density *= 1 + 0.01 * i, moved;
  throw WrongResult("no metal and no medium to edit in " + scene.name);
}

/// Shows the series, each edit while passes of the one before are running.
std::vector<Arrivals> show_series(const Scene& scene, Series series, int count) {
  Viewer viewer;
  viewer.show(series(scene, 0));
  std::this_thread::sleep_for(10 * pause_between);  // so that its speed is known
  std::vector<Arrivals> arrivals;
  for (int i = 1; i <= count; ++i) {
    arrivals.push_back(viewer.show(series(scene, i)));
    std::this_thread::sleep_for(pause_between);
  }
  return arrivals;
}

void add_row(const Table& table, const NamedScene& named, const char* what, Series series, int count) {
  std::vector<double> first, full, steps;
  for (const Arrivals& arrivals : show_series(named.scene, series, count)) {
    first.push_back(arrivals.first_ms), full.push_back(arrivals.full_ms);
    steps.push_back(arrivals.step);
  }
  table.add({named.name, what, cell(median(first), 1), cell(quantile(first, 0.95), 1), cell(median(steps), 0),
             cell(median(full), 1), cell(quantile(full, 0.95), 1)});
}

}  // namespace

void measure_edits(const Settings& settings) {
  const int count = settings.quick ? 15 : 60;
  const Table table("Edits: interactive renderer, 1280x720, all cores, " + std::to_string(count) +
                        " of each kind; ms from request to the first and to the first full frame",
                    {"scene", "edit", "first p50", "p95", "step", "full p50", "p95"});
  for (const char* name : {"showroom", "cornell-smoke", "cover"}) {
    NamedScene named{name, built_in(name, width, height)};
    named.scene.render.spp = 65536;  // so many that the picture is never finished
    add_row(table, named, "material", drag_material, count);
    add_row(table, named, "camera", orbit, count);
  }
}

}  // namespace tyndall::bench
