#include "app/report/gain.h"

#include "core/accuracy/estimate.h"
#include "core/film/groups.h"
#include "core/render/render.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace tyndall {
namespace {

constexpr int widest = 160;  // most pixels in a row of the small picture

/// Two ways to render a picture, each of which takes about so many seconds.
struct TimedPair {
  const PreparedScene &one, &other;
  std::string isa;
  std::uint32_t min_spp;
  double seconds;
};

/// Renders both in turns, each of them first every other time. Returns how many times as long the first one took, the
/// shortest first. seen: called with the results of both.
std::vector<double> time_ratios(const TimedPair& pair, int rounds,
                                const std::function<void(const RenderResult&, const RenderResult&)>& seen) {
  std::uint32_t spp = pair.min_spp;
  const auto timed = [&](const PreparedScene& scene) {
    return render(scene, {.threads = 1, .isa = pair.isa, .spp = spp});
  };
  while (spp < 4096 && timed(pair.one).seconds < pair.seconds / 2) spp *= 2;
  std::vector<double> ratios;
  for (int round = 0; round < rounds; ++round) {
    RenderResult results[2];
    for (const int k : {round % 2, 1 - round % 2}) results[k] = timed(k == 0 ? pair.one : pair.other);
    ratios.push_back(results[0].seconds / results[1].seconds);
    seen(results[0], results[1]);
  }
  std::sort(ratios.begin(), ratios.end());
  return ratios;
}

double sum_of(Vec3f v) { return static_cast<double>(v.x) + static_cast<double>(v.y) + static_cast<double>(v.z); }

}  // namespace

KernelGain measure_kernel_gain(const PreparedScene& scene, const Kernels& kernels) {
  KernelGain result{kernels.isa};
  if (kernels.set_for(scene.view()) == KernelSet::everything) return result;
  RenderScene columns = scene.columns();
  columns.kernel = KernelSet::everything;
  const PreparedScene full(std::make_shared<const Scene>(scene.scene()), columns);
  const std::vector<double> gains =
      time_ratios({full, scene, result.isa, 1, 0.1}, 9,
                  [&](const auto& a, const auto& b) { result.same_picture &= resolve(a.film) == resolve(b.film); });
  result.pairs = static_cast<int>(gains.size());
  result.gain = gains[gains.size() / 2];
  result.minimum = gains.front(), result.maximum = gains.back();
  return result;
}

MethodGain measure_method_gain(MisMethod method, Scene scene, const std::string& isa) {
  if (scene.width > widest) {
    scene.height = std::max(scene.height * widest / scene.width, 1);
    scene.width = widest;
  }
  const auto with = prepare(scene);
  const bool has_chains = !with->columns().specular.sphere.empty() || with->guide().lobes() > 0;
  const bool used[] = {has_chains, with->columns().splits_paths, with->reuses_paths()};  // in the order of MisMethod
  if (!used[static_cast<std::size_t>(method)]) return {};
  if (method == MisMethod::specular) scene.render.caustics = Caustics::scatter;
  if (method == MisMethod::sharing) scene.render.sharing = false;
  const auto without = method == MisMethod::splitting ? prepare_without_splitting(scene) : prepare(scene);
  double own_error = 0, other_error = 0;
  const std::vector<double> times =
      time_ratios({*with, *without, isa, 4, 0.2}, 5, [&](const auto& own, const auto& other) {
        own_error = estimate_error(own.film).relative_error, other_error = estimate_error(other.film).relative_error;
      });
  const double ratio = own_error / other_error;
  return {true, times[2], other_error > 0 ? times[2] * ratio * ratio : 1};
}

FilmDifference film_difference(const Film& film, const Film& reference) {
  double sum = 0, squares = 0, noise = 0, group_noise = 0;
  bool whole = true;
  const auto deviation = [&](const FilmPixel& pixel) {
    const FilmPixel& other = reference.pixels[static_cast<std::size_t>(&pixel - film.pixels.data())];
    for (const int half : {0, 1})
      whole = whole && counted(film, pixel, half) > 0 && counted(reference, other, half) > 0;
    const Vec3f a = half_mean(film, pixel, 0) - half_mean(reference, other, 0);
    const Vec3f b = half_mean(film, pixel, 1) - half_mean(reference, other, 1);
    const Vec3f deviates = 0.5f * (a - b);
    sum += sum_of(mean(film, pixel) - mean(reference, other));
    squares += sum_of(a * b);
    noise += sum_of(deviates * deviates);
    return sum_of(deviates);
  };
  for (const double group : group_sums(film, film.region, deviation)) group_noise += group * group;
  const double values = 3.0 * static_cast<double>(film.pixels.size());
  FilmDifference difference{.mean = sum / values, .rms = std::sqrt(std::max(0.0, squares / values))};
  if (whole) difference.mean_error = std::sqrt(group_noise) / values, difference.rms_error = std::sqrt(noise / values);
  return difference;
}

}  // namespace tyndall
