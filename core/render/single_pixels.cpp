#include "core/render/single_pixels.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace tyndall {
std::vector<Vec3f> PixelLevels::of(const std::vector<std::size_t>& pixels, const Film& film, const RenderEngine& engine,
                                   const std::atomic<bool>& give_up) {
  constexpr std::uint32_t job_samples = 1024, jobs = samples / job_samples;
  std::vector<std::size_t> unknown;
  std::copy_if(pixels.begin(), pixels.end(), std::back_inserter(unknown),
               [&](std::size_t pixel) { return !known_.contains(pixel); });
  SceneView scene = engine.scene;
  scene.seed = ~scene.seed;    // samples independent of the film's
  scene.reuses_paths = false;  // a pixel's samples without its group
  const auto width = static_cast<std::size_t>(film.region.width());
  std::vector<FilmPixel> parts(unknown.size() * jobs);
  engine.thread_pool.for_each(static_cast<int>(parts.size()), [&](int i) {
    if (give_up.load(std::memory_order_relaxed)) return;
    const std::size_t part = static_cast<std::size_t>(i), pixel = unknown[part / jobs];
    const int x = film.region.x0 + static_cast<int>(pixel % width),
              y = film.region.y0 + static_cast<int>(pixel / width);
    const auto first = static_cast<std::uint32_t>(part % jobs) * job_samples;
    TileCounts counts;
    engine.kernels.render_tile(scene, {{x, y, x + 1, y + 1}, 1, 0, first, first + job_samples}, film.quantum,
                               &parts[part], counts);
  });
  if (!unknown.empty() && give_up.load(std::memory_order_relaxed)) return {};
  for (std::size_t i = 0; i < unknown.size(); ++i) {
    FilmPixel whole;
    for (std::size_t k = 0; k < jobs; ++k) add_pixel(whole, parts[i * jobs + k]);
    known_[unknown[i]] = mean(film, whole);
  }
  std::vector<Vec3f> levels;
  for (const std::size_t pixel : pixels) levels.push_back(known_.at(pixel));
  return levels;
}

LevelsOf levels_of(const Film& film, const RenderEngine& engine, PixelLevels& levels,
                   const std::atomic<bool>& give_up) {
  if (engine.samples) return {};
  return [&](const std::vector<std::size_t>& pixels) { return levels.of(pixels, film, engine, give_up); };
}

std::vector<std::size_t> pixels_with_subpixel_lights(const SceneView& scene, const Film& film) {
  constexpr std::size_t maximum = 32;
  std::set<std::size_t> places;
  for (int i = 0; i < scene.subpixel_lights.count() && places.size() <= maximum; ++i) {
    const int x = static_cast<int>(scene.subpixel_lights[i].x), y = static_cast<int>(scene.subpixel_lights[i].y);
    const Region& r = film.region;
    if (x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1) places.insert(film.index(x, y));
  }
  if (places.size() > maximum) return {};
  return {places.begin(), places.end()};
}

ErrorEstimate estimate_error(const Film& film, const RenderEngine& engine, PixelLevels& levels,
                             const std::atomic<bool>& give_up) {
  return estimate_error(film, &engine.thread_pool, levels_of(film, engine, levels, give_up),
                        pixels_with_subpixel_lights(engine.scene, film));
}

std::vector<RejectedSample> find_rejected(const Kernels& kernels, const SceneView& scene, const Film& film,
                                          std::size_t maximum) {
  std::vector<RejectedSample> found;
  for (int y = film.region.y0; y < film.region.y1; ++y)
    for (int x = film.region.x0; x < film.region.x1; ++x) {
      const FilmPixel& pixel = film.at(x, y);
      std::uint32_t left = pixel.rejected[0] + pixel.rejected[1];
      for (std::uint32_t i = 0; left > 0 && i < pixel.taken; ++i) {
        if (found.size() >= maximum) return found;
        FilmPixel again{};
        TileCounts counts;
        const std::uint32_t sample = film.first_sample + i;
        kernels.render_tile(scene, {{x, y, x + 1, y + 1}, 1, 0, sample, sample + 1}, film.quantum, &again, counts);
        if (again.rejected[sample & 1u] == 0) continue;
        found.push_back({x, y, sample});
        --left;
      }
    }
  return found;
}

}  // namespace tyndall
