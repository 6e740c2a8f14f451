#include "core/render/renderer.h"
#include "tests/bench/bench.h"
#include "tests/bench/give_way.h"
#include "tests/bench/measure.h"
#include "tests/bench/scenes.h"

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

Json row_of(const NamedScene& named, const char* what, Series series, int count) {
  std::vector<double> first, full, steps;
  for (const Arrivals& arrivals : show_series(named.scene, series, count)) {
    first.push_back(arrivals.first_ms), full.push_back(arrivals.full_ms);
    steps.push_back(arrivals.step);
  }
  Json row;
  row["scene"] = named.name;
  row["edit"] = what;
  row["width"] = width, row["height"] = height;
  row["edits"] = count;
  row["first_p50_ms"] = quantile(first, 0.5), row["first_p95_ms"] = quantile(first, 0.95);
  row["step"] = median(steps);
  row["full_p50_ms"] = quantile(full, 0.5), row["full_p95_ms"] = quantile(full, 0.95);
  const std::vector<double> compiles = compile_times(series(named.scene, 0), series(named.scene, 1), 21);
  row["compile_p50_ms"] = 1000 * quantile(compiles, 0.5);
  const std::vector<double> times = give_way_times(named.scene, count / 3);
  row["give_way_p50_ms"] = 1000 * quantile(times, 0.5), row["give_way_p95_ms"] = 1000 * quantile(times, 0.95);
  row["first_ms"] = first, row["full_ms"] = full;
  return row;
}

}  // namespace

Json measure_edits(const Settings& settings) {
  const int count = settings.quick ? 15 : 60;
  Table table("Edits: interactive renderer, 1280x720, all cores, " + std::to_string(count) +
                  " of each kind; ms from request to the first and to the first full frame",
              {{"scene", "scene", -1, 13},
               {"edit", "edit", -1, 8},
               {"first_p50_ms", "first p50", 1},
               {"first_p95_ms", "p95", 1, 6},
               {"step", "step", 0},
               {"full_p50_ms", "full p50", 1},
               {"full_p95_ms", "p95", 1, 6},
               {"compile_p50_ms", "compile", 3},
               {"give_way_p50_ms", "give way p50", 2},
               {"give_way_p95_ms", "p95", 2, 6}});
  for (const char* name : {"showroom", "cornell-smoke", "cover"}) {
    NamedScene named{name, built_in(name, width, height)};
    named.scene.render.spp = 65536;  // so many that the picture is never finished
    table.add(row_of(named, "material", drag_material, count));
    table.add(row_of(named, "camera", orbit, count));
  }
  return table.rows();
}

}  // namespace tyndall::bench
