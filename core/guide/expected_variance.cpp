#include "core/guide/bins.h"
#include "core/guide/cells.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

/// What lands in a cell after the same events.
struct Found {
  OrderedEvents<double> events;
  double irradiance = 0;
  double chance = 0;  // sum over the landings: probability to find the light by BSDF sampling
  int count = 0;
};

std::vector<Found> list_found(const Bins& bins, const Bins::Bin& bin, const std::vector<Landing>& landings,
                              double scale) {
  std::vector<Found> list;
  for (std::size_t j = bin.begin; j < bin.end; ++j) {
    const Landing& l = landings[bins.order[j]];
    const Symmetric& v = l.variance;
    auto at = std::find_if(list.begin(), list.end(), [&](const Found& f) { return same_events(f.events, l.events); });
    if (at == list.end()) at = list.insert(at, Found{l.events, 0, 0, 0});
    at->irradiance += scale * l.weight;
    at->chance += l.chance * 4 * std::sqrt(std::max(v.xx * v.yy - v.xy * v.xy, 1e-30));
    ++at->count;
  }
  return list;
}

double brightest_light(const SceneView& s) {
  double radiance = 0;
  for (int k = 0; k < s.lights.count(); ++k)
    radiance = std::max(
        radiance, static_cast<double>(s.lights.power[k]) / std::max(static_cast<double>(s.lights.area[k]), 1e-37));
  return radiance;
}

/// Irradiance from the background, roughly.
double background_light(const BackgroundColumns& b) {
  const double first = static_cast<double>(max_component(b.a)), second = static_cast<double>(max_component(b.b));
  return pi * (b.kind == BackgroundKind::constant ? first : 0.5 * (first + second));
}

}  // namespace

double expected_variance(const SceneView& scene, const LightPaths& paths) {
  const std::vector<Landing>& landings = paths.landings();
  if (landings.empty()) return 0;
  Guide sizes;
  set_sizes(middle_size(landings), sizes.inverse_size);
  const int level = guide_middle_level + 1;  // cells of the middle level hold too few landings for a square
  const double h = 1 / static_cast<double>(sizes.inverse_size[level]), radiance = brightest_light(scene);
  const double background = background_light(scene.background);
  Bins bins;
  bins.fill(sizes, landings, level);
  std::vector<double> variances;
  for (const Bins::Bin& bin : bins.bins) {
    const std::vector<Found> list = list_found(bins, bin, landings, 1 / (paths.paths_of_pair() * h * h));
    double all = background + direct_light_at(scene, landings[bins.order[bin.begin]].point, h);
    for (const Found& f : list) all += f.irradiance;
    double sum = 0;
    for (const Found& f : list) {
      const double chance = std::min(f.chance / f.count, 1.0), square = f.irradiance * f.irradiance;
      sum += std::min(square / chance, f.irradiance * pi * radiance) / (all * all);
    }
    variances.push_back(sum);
  }
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  return *middle;
}

}  // namespace tyndall
