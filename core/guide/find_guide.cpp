#include "core/guide/find_guide.h"

#include "core/base/seconds.h"
#include "core/guide/cells.h"

#include <chrono>

namespace tyndall {
namespace {

// Many paths are traced, because rare sequences of events are found by few of them, and few landings of each sequence
// are kept, because lobes take more time than paths.
constexpr int paths_to_decide = 1000, paths_to_find = 20000, copies = 2000;
constexpr std::size_t max_found = 1200;

void fill(const SceneView& scene, Guide& guide) {
  std::vector<Thing> things = list_things(scene);
  if (things.empty()) return;
  LightPaths paths(scene, std::move(things));
  paths.trace_pairs(paths_to_decide);
  guide.expected_variance = expected_variance(scene, paths);
  guide.light_paths = paths.traced();
  if (!(guide.expected_variance >= worthwhile_variance)) return;
  paths.trace_pairs(paths_to_find - paths_to_decide);
  paths.thin_out(max_found);
  paths.trace_copies(copies);
  guide.light_paths = paths.traced();
  guide.thing_of = paths.thing_of();
  make_cells(scene, paths, guide);
}

}  // namespace

Guide find_guide(const SceneView& scene) {
  const auto start = std::chrono::steady_clock::now();
  Guide guide;
  fill(scene, guide);
  guide.milliseconds = 1e3 * seconds_since(start);
  return guide;
}

}  // namespace tyndall
