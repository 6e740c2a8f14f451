#include "app/curves/curve.h"

#include "core/accuracy/error.h"
#include "core/accuracy/estimate.h"
#include "core/compile/compile.h"
#include "core/render/render.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tyndall {
namespace {

/// A render that goes on from power to power of two samples a pixel.
class GrowingPicture {
 public:
  GrowingPicture(const Scene& scene, const std::string& isa, const ChartRun& run) : scene_(compile(scene)), run_(run) {
    options_.isa = isa;
    options_.threads = run.threads;
    options_.adaptive = scene.render.adaptive;
  }
  /// Up to `spp` samples; false if it was stopped on the way.
  bool grow(std::uint32_t spp) {
    options_.spp = spp;
    const auto progress = [this](const RenderProgress& now) { return run_.go_on(seconds_ + now.seconds); };
    RenderResult result = render(scene_, options_, progress, std::move(film_));
    film_ = std::move(result.film);
    seconds_ += result.seconds;
    return !result.interrupted;
  }
  double seconds() const { return seconds_; }
  const Film& film() const { return film_; }

 private:
  RenderScene scene_;
  const ChartRun& run_;
  RenderOptions options_{};
  Film film_{};
  double seconds_ = 0;
};

double squared(double x) { return x * x; }

}  // namespace

double least_measurable(const ChartReference& reference) { return 4 * reference.rel_mse; }

ChartReference render_reference(Scene scene, double seconds, const ChartRun& run) {
  scene.render.integrator = Integrator::mis;
  scene.render.sampler = SamplerKind::random;
  scene.render.fresnel = FresnelKind::exact;
  scene.render.adaptive = false;
  scene.render.seed += 0x5eed;
  GrowingPicture picture(scene, "", run);
  std::uint32_t spp = 2;
  while (picture.grow(spp) && spp < (1u << 22) && 2 * picture.seconds() < seconds * 1.4) spp *= 2;
  const Film& film = picture.film();
  const FilmTotals sum = totals(film);
  if (sum.least_taken < 2) return {};
  return {{scene.width, scene.height, resolve(film)},
          squared(estimated_relative_error(film)),
          "mis, random numbers of another seed, " + std::to_string(sum.least_taken) + " spp"};
}

ChartCurve measure_curve(Scene scene, const ChartMethod& method, const ChartReference& reference, double seconds,
                         const ChartRun& run) {
  scene.render = method.settings;
  GrowingPicture picture(scene, method.isa, run);
  ChartCurve curve{method.name, {}};
  for (std::uint32_t spp = 1; spp < (1u << 22) && picture.grow(spp); spp *= 2) {
    const double measured = image_error(resolve(picture.film()), reference.image.rgb).rel_mse;
    const double noise = squared(estimated_relative_error(picture.film()));
    curve.points.push_back({spp, picture.seconds(), measured - reference.rel_mse, noise});
    if (measured < least_measurable(reference) || 2 * picture.seconds() > seconds * 1.4) break;
  }
  return curve;
}

std::optional<double> seconds_to(const ChartCurve& curve, double rel_mse) {
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const ChartPoint& b = curve.points[i];
    if (b.rel_mse > rel_mse) continue;
    if (i == 0) return b.seconds;
    const ChartPoint& a = curve.points[i - 1];
    const double part = std::log(a.rel_mse / rel_mse) / std::log(a.rel_mse / b.rel_mse);
    return a.seconds * std::pow(b.seconds / a.seconds, part);
  }
  return std::nullopt;
}

std::optional<double> speed_against(const ChartCurve& first, const ChartCurve& curve) {
  if (first.points.empty() || curve.points.empty()) return std::nullopt;
  const double error = std::max(first.points.back().rel_mse, curve.points.back().rel_mse);
  const auto slow = seconds_to(first, error), fast = seconds_to(curve, error);
  if (!(error > 0) || !slow || !fast) return std::nullopt;
  return *slow / *fast;
}

std::optional<double> bias_of(const ChartCurve& curve, const ChartReference& reference) {
  if (curve.points.size() < 4) return std::nullopt;
  const ChartPoint& last = curve.points.back();
  const auto before = std::find_if(curve.points.rbegin(), curve.points.rend(),
                                   [&](const ChartPoint& p) { return 2 * p.spp <= last.spp; });
  if (before == curve.points.rend()) return std::nullopt;
  const auto rest = [](const ChartPoint& p) { return p.rel_mse - p.noise; };
  // What stays from one power of two to the next, and is more than the noise: heavy tails fall, bias does not.
  const double bias = rest(last);
  const bool stays = bias > 0.7 * rest(*before) && bias > 0.5 * last.noise;
  return stays && bias > least_measurable(reference) ? std::optional(bias) : std::nullopt;
}

}  // namespace tyndall
