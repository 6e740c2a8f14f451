#pragma once
#include "core/compile/compile.h"
#include "core/render/clean_film.h"
#include "core/render/prepare.h"
#include "core/render/render.h"
#include "core/trace/camera.h"

#include <atomic>
#include <memory>
#include <utility>

/// Compiled scenes, often with columns that a test has changed, where the program takes prepared ones.
namespace tyndall::test {

/// What kernels read of a compiled scene, with all that is found out about it.
class SceneViewOf {
 public:
  explicit SceneViewOf(const RenderScene& columns) : prepared_(std::make_shared<const Scene>(), columns) {}
  const SceneView& view() const { return prepared_.view(); }
  const PreparedScene& prepared() const { return prepared_; }

 private:
  PreparedScene prepared_;
};

/// The ray of one sample of the pixel (x, y), if it has no subpixel lights.
inline Ray<float> sample_ray(const SceneView& s, float x, float y, const Sampler<float>& sampler) {
  const Pair<float> in_pixel = sampler.next_2d(dimension::pixel);
  return ray_through(s, x + in_pixel.x, y + in_pixel.y, sampler);
}

/// A compiled scene, and what passes of it take.
struct Ready {
  RenderScene scene;
  SceneViewOf view{scene};
  Kernels kernels = *choose_kernels("");
  ThreadPool thread_pool;
  RenderEngine engine{thread_pool, kernels, view.view()};

  explicit Ready(RenderScene columns, int threads = 2) : scene(std::move(columns)), thread_pool(threads) {}
};

inline RenderResult render(const RenderScene& columns, const RenderOptions& options,
                           const ProgressCallback& progress = {}, Film film = {}) {
  return tyndall::render(SceneViewOf(columns).prepared(), options, progress, std::move(film));
}

/// What a kernel makes of samples first … last - 1 of a scene's whole picture.
inline Film drawn_by(const Kernels& kernels, const RenderScene& scene, const SceneView& view, std::uint32_t first,
                     std::uint32_t last) {
  Film film = make_film(scene.width, scene.height, {0, 0, scene.width, scene.height}, first, scene.film_quantum);
  TileCounts counts;
  kernels.render_tile(view, {film.region, 1, 0, first, last}, film.quantum, film.pixels.data(), counts);
  return film;
}

inline ErrorEstimate estimate_error(const RenderScene& columns, const Kernels& kernels, const Film& film,
                                    int threads = 0) {
  return tyndall::estimate_error(SceneViewOf(columns).prepared(), kernels, film, threads);
}

inline CleanPicture clean_film(const Film& film, const RenderScene& columns, int threads, const std::string& isa) {
  return tyndall::clean_film(film, SceneViewOf(columns).prepared(), threads, isa);
}

/// For tests of interrupted passes: lets a pass be given up after a chosen number of tile jobs.
struct Stop {
  Kernels real{};
  std::atomic<int> tiles_left = 0;
  std::atomic<bool> give_up = false;
};
inline Stop stop;

inline void stopping_tile(const SceneView& scene, const TileJob& job, double film_quantum, FilmPixel* pixels,
                          EmissionSums* emission, TileCounts& counts) {
  stop.real.render_tile(scene, job, film_quantum, pixels, counts, emission);
  if (--stop.tiles_left == 0) stop.give_up = true;
}

}  // namespace tyndall::test
