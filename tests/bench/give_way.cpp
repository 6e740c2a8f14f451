#include "tests/bench/give_way.h"

#include "core/render/pass.h"
#include "tests/bench/measure.h"
#include "tests/support/prepared.h"

#include <thread>

namespace tyndall::bench {

using namespace test;
namespace {

/// Starts a pass of that many samples, asks it to give up after some time, and measures how long it goes on. The result
/// is empty if the pass was done before. The film must have its first sample.
std::vector<double> give_way(ThreadPool& thread_pool, const SceneView& view, Film& film, std::uint32_t samples,
                             std::chrono::microseconds after) {
  const Kernels kernels = *choose_kernels("");
  std::atomic<bool> give_up = false;
  Pass pass(film.region, 1, 1 + samples);
  bool whole = false;
  Clock::time_point returned;
  std::thread runner([&] {
    whole = pass.run({thread_pool, kernels, view}, film, give_up);
    returned = Clock::now();
  });
  std::this_thread::sleep_for(after);
  const Clock::time_point query = Clock::now();
  give_up = true;
  runner.join();
  if (whole) return {};
  return {seconds_between(query, returned)};
}

}  // namespace

std::vector<double> compile_times(const Scene& from, const Scene& to, int repeat) {
  const RenderScene before = compile(from);
  std::vector<double> seconds(static_cast<std::size_t>(repeat));
  for (double& s : seconds) s = seconds_of([&] { return compile(to, &before); });
  return seconds;
}

std::vector<double> give_way_times(const Scene& scene, int repeat) {
  const RenderScene compiled = compile(scene);
  const SceneViewOf view(compiled);
  ThreadPool thread_pool(0);
  Film film =
      make_film(compiled.width, compiled.height, {0, 0, compiled.width, compiled.height}, 0, compiled.film_quantum);
  std::vector<double> seconds;
  for (int i = 0; i < repeat; ++i) {
    const std::chrono::microseconds after(5000 + 617 * (i % 16));
    const auto one = give_way(thread_pool, view.view(), film, i % 2 ? 16 : 1, after);
    seconds.insert(seconds.end(), one.begin(), one.end());
  }
  return seconds;
}

}  // namespace tyndall::bench
