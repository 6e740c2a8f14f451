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

/// What lands in a cell after the same events.
struct Found {
  OrderedEvents<double> events;
  double irradiance = 0;
  double chance = 0;  // sum over the landings: probability to find the light by BSDF sampling
  int count = 0;
};

/// What lands in a bin, apart for each sequence of events. scale: irradiance of a landing over its weight.
std::vector<Found> list_found(const Bins& bins, const Bins::Bin& bin, const std::vector<Landing>& landings,
                              double scale) {
  std::vector<Found> list;
  for (std::size_t j = bin.begin; j < bin.end; ++j) {
    const Landing& l = landings[bins.order[j]];
    const Symmetric& v = l.variance;
    auto at = std::find_if(list.begin(), list.end(), [&](const Found& f) { return same_events(f.events, l.events); });
    if (at == list.end()) at = list.insert(at, Found{l.events});
    at->irradiance += scale * l.weight;
    at->chance += l.chance * 4 * std::sqrt(std::max(v.xx * v.yy - v.xy * v.xy, 1e-30));
    ++at->count;
  }
  return list;
}

/// Irradiance from the background, roughly.
double background_light(const BackgroundColumns& b) {
  const double first = static_cast<double>(max_component(b.a)), second = static_cast<double>(max_component(b.b));
  return pi * (b.kind == BackgroundKind::constant ? first : 0.5 * (first + second));
}

/// Variance times samples, relative to the squared radiance, that BSDF sampling alone is expected to have, from where
/// light paths land: sum over sequences of events of (E of the sequence / E)^2 / (probability to find a light after
/// it). The median over cells, because a few caustics fill little of the picture. All lights count as unshadowed.
double expected_variance(const SceneView& s, const LightPaths& paths) {
  const std::vector<Landing>& landings = paths.landings;
  if (landings.empty()) return 0;
  Guide sizes;
  set_sizes(landings, sizes.inverse_size);
  const int level = guide_middle_level + 1;  // cells of the middle level hold too few landings for a square
  const double h = 1 / static_cast<double>(sizes.inverse_size[level]), background = background_light(s.background);
  double brightest = 0;  // radiance of a light
  for (int k = 0; k < s.lights.count(); ++k)
    brightest = std::max(brightest, at(s.lights.power, k) / std::max(at(s.lights.area, k), 1e-37));
  Bins bins;
  bins.fill(sizes, landings, level);
  std::vector<double> variances;
  for (const Bins::Bin& bin : bins.bins) {
    const std::vector<Found> list = list_found(bins, bin, landings, 1 / (paths.paths_of_pair * h * h));
    double all = background + direct_light_at(s, landings[bins.order[bin.begin]].point, h), sum = 0;
    for (const Found& f : list) all += f.irradiance;
    for (const Found& f : list) {
      const double chance = std::min(f.chance / f.count, 1.0), square = f.irradiance * f.irradiance;
      sum += std::min(square / chance, f.irradiance * pi * brightest) / (all * all);
    }
    variances.push_back(sum);
  }
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  return *middle;
}

void fill(const SceneView& scene, Guide& guide) {
  std::vector<Thing> things = list_things(scene);
  if (things.empty()) return;
  LightPaths paths(scene, std::move(things));
  paths.trace_pairs(paths_to_decide);
  guide.expected_variance = expected_variance(scene, paths);
  guide.light_paths = paths.traced;
  if (!(guide.expected_variance >= worthwhile_variance)) return;
  paths.trace_pairs(paths_to_find - paths_to_decide);
  paths.thin_out(max_found);
  paths.trace_copies(copies);
  guide.light_paths = paths.traced;
  guide.thing_of = paths.thing_of;
  make_cells(paths, guide);
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
