#include "app/report/noisy_path.h"

#include "app/report/replay.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

double luminance(Vec3f light) {
  const double sum = 0.2126 * static_cast<double>(light.x) + 0.7152 * static_cast<double>(light.y) +
                     0.0722 * static_cast<double>(light.z);
  return std::isfinite(sum) ? sum : 0;
}

}  // namespace

NoisyPath find_noisy_path(const SceneView& scene, int x, int y, std::uint32_t samples,
                          const std::function<bool()>& stop) {
  NoisyPath found{.x = x, .y = y};
  double sum = 0, maximum = -1;
  while (found.samples < std::max(samples, 1u) && (found.samples == 0 || !stop())) {
    PathReplay path = replay(scene, x, y, found.samples);
    const double light = luminance(path.radiance);
    sum += light;
    if (light > maximum) maximum = light, found.sample = found.samples, found.path = std::move(path);
    ++found.samples;
  }
  found.fraction = sum > 0 ? maximum / sum : 0;
  found.times_mean = found.fraction * found.samples;
  return found;
}

std::vector<PathStop> stops_of(const Scene& scene, const RenderScene& compiled, const PathReplay& path) {
  std::vector<PathStop> stops;
  Vec3f before{};
  for (const PathVertex& v : path.vertices) {
    PathStop stop;
    stop.away = v.met == Met::nothing;
    const Vec3f at = stop.away ? v.direction : v.point;
    stop.point = Vec3d{at.x, at.y, at.z} + (stop.away ? Vec3d{} : compiled.origin);
    const Vec3f gained = v.radiance - before;
    before = v.radiance;
    stop.light = luminance(gained) > 0;
    stop.text = vertex_text(scene, compiled, v);
    if (stop.light)
      stop.text += fmt::format(", light {:.3g} {:.3g} {:.3g}", static_cast<double>(gained.x),
                               static_cast<double>(gained.y), static_cast<double>(gained.z));
    stops.push_back(std::move(stop));
  }
  return stops;
}

std::string sentence_of(const NoisyPath& found) {
  if (found.fraction <= 0) return fmt::format("all of {} samples are black", found.samples);
  return fmt::format("the brightest of {} samples: {:.2g} % of their light, {:.2g} times the mean", found.samples,
                     100 * found.fraction, found.times_mean);
}

}  // namespace tyndall
