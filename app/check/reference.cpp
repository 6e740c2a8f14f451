#include "app/check/expectation.h"

#include "core/accuracy/error.h"
#include "core/render/render.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

constexpr std::uint32_t first_spp = 16;
constexpr double part_of_difference = 0.05, min_error = 0.002;

}  // namespace

Reference render_reference(Scene scene, const LinearImage& picture, const ReferenceLimits& limits,
                           const std::function<bool()>& go_on) {
  scene.render.sharing = false, scene.render.adaptive = false, scene.render.sampler = SamplerKind::sobol;
  scene.render.integrator = Integrator::mis;
  scene.render.seed += 0x5eed;  // the picture may be Tyndall's own, whose noise must not be taken for the truth
  const auto prepared = prepare(scene);
  const auto progress = [&](const RenderProgress&) { return go_on(); };
  RenderOptions options;
  options.spp = first_spp;
  RenderResult rendered = render(*prepared, options);
  const double difference = std::sqrt(relative_mse(picture.rgb, resolve(rendered.film)));
  options.spp = limits.spp;
  options.time_limit = std::max(0.0, limits.seconds - rendered.seconds);
  options.target_error = std::isfinite(difference) ? std::max(min_error, part_of_difference * difference) : min_error;
  if (!rendered.interrupted) rendered = render(*prepared, options, progress, std::move(rendered.film));
  const Film& film = rendered.film;
  Reference reference{{film.region.width(), film.region.height(), resolve(film)}, {}};
  reference.variance.reserve(3 * film.pixels.size());
  for (const FilmPixel& pixel : film.pixels) {
    const Vec3f half = half_mean(film, pixel, 0) - half_mean(film, pixel, 1);
    for (const float off : {half.x, half.y, half.z}) reference.variance.push_back(off * off / 4);
  }
  return reference;
}

}  // namespace tyndall
