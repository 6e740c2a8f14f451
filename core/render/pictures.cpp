#include "core/render/pictures.h"

#include "core/accuracy/estimate.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

std::size_t offset(int width, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

void put(std::vector<float>& rgba, std::size_t pixel, Vec3f colour) {
  float* to = rgba.data() + 4 * pixel;
  to[0] = colour.x, to[1] = colour.y, to[2] = colour.z, to[3] = 1;
}

Vec3f get(const std::vector<float>& rgba, std::size_t pixel) {
  const float* from = rgba.data() + 4 * pixel;
  return {from[0], from[1], from[2]};
}

Vec3f mix(Vec3f a, Vec3f b, float t) { return a + t * (b - a); }

/// Fills row y between the sampled pixels, which have their colours already.
void fill_row(std::vector<float>& rgba, int width, int height, int y, int step) {
  const int top = y / step * step, bottom = std::min(top + step, (height - 1) / step * step);
  const float down = static_cast<float>(y - top) / static_cast<float>(step);
  for (int x = 0; x < width; ++x) {
    if (x % step == 0 && y == top) continue;
    const int left = x / step * step, right = std::min(left + step, (width - 1) / step * step);
    const float across = static_cast<float>(x - left) / static_cast<float>(step);
    const Vec3f above = mix(get(rgba, offset(width, left, top)), get(rgba, offset(width, right, top)), across);
    const Vec3f below = mix(get(rgba, offset(width, left, bottom)), get(rgba, offset(width, right, bottom)), across);
    put(rgba, offset(width, x, y), mix(above, below, down));
  }
}

}  // namespace

void beauty_rgba(const Film& film, int step, Crew& crew, std::vector<float>& rgba) {
  rgba.resize(4 * film.pixels.size());
  const int width = film.region.width(), height = film.region.height();
  crew.for_each((height + step - 1) / step, [&](int row) {
    for (int x = 0; x < width; x += step) {
      const std::size_t at = offset(width, x, row * step);
      put(rgba, at, mean(film, film.pixels[at]));
    }
  });
  if (step > 1) crew.for_each(height, [&](int y) { fill_row(rgba, width, height, y, step); });
}

std::vector<float> grey_rgba(std::size_t pixels, float grey) {
  std::vector<float> rgba(4 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) put(rgba, i, {grey, grey, grey});
  return rgba;
}

std::vector<float> noise_rgba(const Film& film) { return noise_rgba(pixel_relative_error(film)); }

std::vector<float> noise_rgba(const std::vector<float>& errors) {
  std::vector<float> rgba(4 * errors.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const float error = std::min(errors[i], 1.0f);  // the error is infinite before two samples
    put(rgba, i, {error, error, error});
  }
  return rgba;
}

std::vector<float> samples_rgba(const Film& film) {
  const auto most = static_cast<float>(std::max(1u, totals(film).most_taken));
  std::vector<float> rgba(4 * film.pixels.size());
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    const float share = static_cast<float>(film.pixels[i].taken) / most;
    put(rgba, i, {share, share, share});
  }
  return rgba;
}

std::vector<float> find_costs(const Kernels& kernels, const SceneView& scene, Crew& crew,
                              const std::atomic<bool>& give_up) {
  constexpr int edge = 4, samples = 4;
  std::vector<float> costs(static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height));
  const auto find = [&](const Region& cell) {
    FilmPixel pixels[edge * edge] = {};
    UnitCounts counts;
    kernels.render_unit(scene, {.tile = cell, .first = 0, .last = samples}, 1, pixels, counts);
    const float cost = static_cast<float>(counts.rays) / static_cast<float>(samples * cell.width() * cell.height());
    for (int y = cell.y0; y < cell.y1; ++y)
      for (int x = cell.x0; x < cell.x1; ++x) costs[offset(scene.width, x, y)] = cost;
  };
  crew.for_each((scene.height + edge - 1) / edge, [&](int row) {
    for (int x = 0; x < scene.width && !give_up; x += edge)
      find({x, edge * row, std::min(x + edge, scene.width), std::min(edge * (row + 1), scene.height)});
  });
  if (give_up) costs.clear();
  return costs;
}

std::vector<float> relative_rgba(const std::vector<float>& values) {
  float most = 1e-37f;
  for (const float value : values) most = std::max(most, value);
  std::vector<float> rgba(4 * values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float share = values[i] / most;
    put(rgba, i, {share, share, share});
  }
  return rgba;
}

std::vector<float> first_hit_rgba(const std::vector<FirstHit>& hits, View view) {
  float farthest = 1e-37f;
  for (const FirstHit& hit : hits) farthest = std::max(farthest, hit.depth);
  std::vector<float> rgba(4 * hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const FirstHit& hit = hits[i];
    const float depth = hit.depth / farthest;
    const Vec3f normal = 0.5f * (hit.normal + Vec3f{1, 1, 1});
    Vec3f colour{};
    if (hit.element >= 0)
      colour = view == View::albedo ? hit.albedo : view == View::normal ? normal : Vec3f{depth, depth, depth};
    put(rgba, i, colour);
  }
  return rgba;
}

std::vector<FirstHit> find_first_hits(const Kernels& kernels, const SceneView& scene, Crew& crew) {
  std::vector<FirstHit> hits(static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height));
  crew.for_each(scene.height, [&](int y) {
    kernels.first_hits(scene, {0, y, scene.width, y + 1}, hits.data() + offset(scene.width, 0, y));
  });
  return hits;
}

}  // namespace tyndall
