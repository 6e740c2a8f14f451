#include "core/render/measure.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

// The first pilot takes this many samples a pixel: enough to meet what one path in ten thousand finds.
constexpr double first_samples = 64;
// Aims at this fraction of the wanted error, because the pilot's estimate of the error may be too small.
constexpr double margin = 0.85;
// This many standard errors from the known answer the result is wrong for certain, and more samples would not help.
constexpr double far_off = 8;
// Most growth of the samples from pilot to pilot, because a pilot whose error is rough plans badly.
constexpr double max_growth = 16;

double cube(double x) { return x * x * x; }

/// Samples a pixel that reach the standard error `wanted`, if a pilot of `spp` samples had `error`.
double planned(double spp, double error, double wanted) {
  const double ratio = error / (margin * wanted);
  return std::clamp(spp * ratio * ratio, spp, max_growth * spp);
}

}  // namespace

Measured measure_mean(Scene scene, const MeasureOptions& options, const ProgressCallback& progress) {
  const double pixels = static_cast<double>(scene.width) * scene.height;
  const double maximum = std::max(first_samples, max_samples_measured / pixels);
  Measured measured;
  double spp = first_samples, seconds = 0;
  for (std::uint32_t round = 0; round < max_rounds; ++round, ++scene.render.seed) {
    RenderOptions render_options;
    render_options.threads = options.threads;
    render_options.isa = options.isa;
    render_options.spp = static_cast<std::uint32_t>(spp / 2) * 2;  // even, so that both halves have as many
    const RenderResult result = render(*prepare(scene), render_options, progress);
    seconds += result.seconds;
    measured = {film_mean(result.film), totals(result.film), seconds, result.interrupted};
    const bool reached = measured.value.error <= options.error;
    const bool hopeless = std::abs(z_score(measured.value, options.expected)) > far_off;
    if (result.interrupted || (round > 0 && (reached || hopeless || spp >= maximum))) break;
    if (!reached && !hopeless)
      spp = std::min(std::max(planned(spp, measured.value.error, options.error), 1.25 * spp), maximum);
  }
  return measured;
}

double z_score(const FilmMean& measured, double expected) {
  const double deviation = measured.mean - expected;
  return deviation == 0 ? 0 : deviation / std::hypot(measured.error, rounding_fraction * expected);
}

SquareBand mean_square_band(int count) {
  const double spread = 2.0 / (9 * count), room = 4 * std::sqrt(spread);
  return {cube(std::max(1 - spread - room, 0.0)), cube(1 - spread + room)};
}

}  // namespace tyndall
