#include "app/check/statistics.h"
#include "core/accuracy/error.h"
#include "core/render/render.h"

namespace tyndall {

Reference render_reference(Scene scene, const LinearImage& picture, double seconds, std::uint32_t spp,
                           const std::function<bool()>& go_on) {
  scene.render.sharing = false, scene.render.adaptive = false, scene.render.sampler = SamplerKind::sobol;
  scene.render.integrator = Integrator::mis;
  scene.render.seed += 0x5eed;  // the picture may be Tyndall's own, whose noise must not be taken for the truth
  const auto prepared = prepare(scene);
  const auto progress = [&](const RenderProgress&) { return go_on(); };
  constexpr double part_of_difference = 0.05, min_error = 0.002;
  RenderOptions options;
  options.spp = 16;  // at first
  RenderResult rendered = render(*prepared, options);
  const double difference = std::sqrt(relative_mse(picture.rgb, resolve(rendered.film)));
  options.spp = spp;
  options.time_limit = std::max(0.0, seconds - rendered.seconds);
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

std::vector<CellDifference> rough_differences(const PictureNumbers& picture, const Scene& scene) {
  constexpr int count = 4;
  const Lattice lattice = lattice_of(picture.width, picture.height);
  ThreadPool pool(0);
  const auto samples = book_samples(plain_program(scene), lattice, count, pool, [] { return true; });
  ExpectedPixels expected;
  for (const SampleStatistics& number : statistics_of(samples, count, {count}))
    expected.light.push_back(number.mean - (picture.coded ? number.excess : 0));
  expected.variance.resize(expected.light.size());
  const Regions regions = blocks_of(lattice, edge_of_blocks(lattice));
  std::vector<CellDifference> best;
  for (const Reading& reading : readings_of(picture.coded, true)) {
    auto found = differences_of(read_pixels(picture, lattice, reading), expected, regions);
    if (best.empty() || amount_of(found, found) < amount_of(best, best)) best = std::move(found);
  }
  return best;
}

}  // namespace tyndall
