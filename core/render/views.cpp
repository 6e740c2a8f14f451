#include "core/render/views.h"

#include "core/accuracy/estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

/// A grey picture, from the value of each pixel.
template <class Value>
std::vector<float> greys(std::size_t pixels, const Value& value_of) {
  std::vector<float> rgba(4 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const float value = value_of(i);
    put(rgba, i, {value, value, value});
  }
  return rgba;
}

/// Perceived brightness of a colour, in [0, 1): its differences show edges in light and in shadow alike.
float look_of(Vec3f colour) {
  const float light = std::max(0.2126f * colour.x + 0.7152f * colour.y + 0.0722f * colour.z, 0.0f);
  return std::isfinite(light) ? light / (1 + light) : 1.0f;
}

/// The colour between four pixels: the mean of the opposite pair that is clearly more alike, else of all four.
Vec3f between(Vec3f a, Vec3f opposite_a, Vec3f b, Vec3f opposite_b) {
  const float across_a = std::abs(look_of(a) - look_of(opposite_a)),
              across_b = std::abs(look_of(b) - look_of(opposite_b));
  if (2 * across_a < across_b) return 0.5f * (a + opposite_a);
  if (2 * across_b < across_a) return 0.5f * (b + opposite_b);
  return 0.25f * (a + opposite_a + b + opposite_b);
}

/// A picture of twice as many columns and rows, whose new pixels are interpolated along edges.
std::vector<float> doubled(const std::vector<float>& from, int columns, int rows, ThreadPool& thread_pool) {
  std::vector<float> to(4 * from.size());
  const auto old = [&](int x, int y) {
    return get(from, offset(columns, std::clamp(x, 0, columns - 1), std::clamp(y, 0, rows - 1)));
  };
  const auto middle = [&](int x, int y) { return between(old(x, y), old(x + 1, y + 1), old(x + 1, y), old(x, y + 1)); };
  thread_pool.for_each(rows, [&](int y) {
    for (int x = 0; x < columns; ++x) {
      const Vec3f here = old(x, y), corner = middle(x, y);
      put(to, offset(2 * columns, 2 * x, 2 * y), here);
      put(to, offset(2 * columns, 2 * x + 1, 2 * y), between(here, old(x + 1, y), middle(x, y - 1), corner));
      put(to, offset(2 * columns, 2 * x, 2 * y + 1), between(here, old(x, y + 1), middle(x - 1, y), corner));
      put(to, offset(2 * columns, 2 * x + 1, 2 * y + 1), corner);
    }
  });
  return to;
}

/// Hues a golden section of the circle apart, so that neighbours in the list differ; every second round is paler.
Vec3f colour_of_object(const std::vector<int>& path) {
  std::uint32_t number = 0;
  for (const int index : path) number = 31 * number + static_cast<std::uint32_t>(index) + 1;
  const float hue = 6 * std::fmod(0.618034f * static_cast<float>(number % 4096), 1.0f);
  const float pale = number / 7 % 2 == 0 ? 0.06f : 0.3f, bright = number / 3 % 2 == 0 ? 0.85f : 0.5f;
  const auto channel = [&](float from) {
    const float offset = std::abs(std::fmod(hue + from, 6.0f) - 3) - 1;
    return bright * (pale + (1 - pale) * std::clamp(offset, 0.0f, 1.0f));
  };
  return {channel(0), channel(4), channel(2)};
}

/// Writes the means of a film in which only every step-th pixel in x and y has samples. From a step of 3 on the picture
/// has twice as many columns and rows: pixels between samples are interpolated along edges. step >= 1.
PictureGrid coarse_rgba(const Film& film, int step, ThreadPool& thread_pool, std::vector<float>& rgba) {
  const int width = film.region.width(), height = film.region.height();
  const int columns = (width + step - 1) / step, rows = (height + step - 1) / step;
  rgba.resize(4 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  thread_pool.for_each(rows, [&](int y) {
    for (int x = 0; x < columns; ++x)
      put(rgba, offset(columns, x, y), mean(film, film.pixels[offset(width, x * step, y * step)]));
  });
  if (step < 3) return {columns, rows, static_cast<float>(step)};
  rgba = doubled(rgba, columns, rows, thread_pool);
  return {2 * columns, 2 * rows, 0.5f * static_cast<float>(step)};
}

/// Writes the mean of every pixel that has samples; pixels without show that of the coarse pass of that step.
void filled_rgba(const Film& film, int step, ThreadPool& thread_pool, std::vector<float>& rgba) {
  const int width = film.region.width(), height = film.region.height();
  rgba.resize(4 * film.pixels.size());
  thread_pool.for_each(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const FilmPixel& own = film.pixels[offset(width, x, y)];
      put(rgba, offset(width, x, y),
          mean(film, own.taken > 0 ? own : film.pixels[offset(width, x - x % step, y - y % step)]));
    }
  });
}

/// The estimated relative error of each pixel (see pixel_relative_error) as grey: white is an error of 100 % or more.
std::vector<float> noise_rgba(const std::vector<float>& errors) {
  // The error is infinite before two samples.
  return greys(errors.size(), [&](std::size_t i) { return std::min(errors[i], 1.0f); });
}

/// Rays a path through each pixel takes: the mean over cells of 4 x 4 pixels. To count them, the pixels' first 4
/// samples are rendered once more. Empty if `give_up` was set meanwhile.
std::vector<float> find_costs(const Kernels& kernels, const SceneView& scene, ThreadPool& thread_pool,
                              const std::atomic<bool>& give_up) {
  constexpr int edge = 4, samples = 4;
  SceneView alone = scene;
  alone.reuses_paths = false;  // count a pixel's own paths, not those of its groups
  std::vector<float> costs(static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height));
  const auto find = [&](const Region& cell) {
    FilmPixel pixels[edge * edge] = {};
    TileCounts counts;
    kernels.render_tile(alone, {.tile = cell, .first = 0, .last = samples}, 1, pixels, counts);
    const float cost = static_cast<float>(counts.rays) / static_cast<float>(samples * cell.width() * cell.height());
    for (int y = cell.y0; y < cell.y1; ++y)
      for (int x = cell.x0; x < cell.x1; ++x) costs[offset(scene.width, x, y)] = cost;
  };
  thread_pool.for_each((scene.height + edge - 1) / edge, [&](int row) {
    for (int x = 0; x < scene.width && !give_up; x += edge)
      find({x, edge * row, std::min(x + edge, scene.width), std::min(edge * (row + 1), scene.height)});
  });
  if (give_up) costs.clear();
  return costs;
}

/// The largest of some values, but always above 0.
template <class List, class Value>
float largest(const List& list, const Value& value_of) {
  float found = 1e-37f;
  for (const auto& one : list) found = std::max(found, value_of(one));
  return found;
}

/// Albedo, normal (x, y, z mapped to [0, 1]) or depth (grey, `white` is white) of the first hit of each pixel, or a
/// colour for each object, the same wherever it is seen. scene: owner of the elements that the hits name.
std::vector<float> first_hit_rgba(View view, const std::vector<FirstHit>& hits, const RenderScene& scene, float white) {
  std::vector<Vec3f> colours;
  if (view == View::object)
    for (const std::int32_t object : scene.elements.object)
      colours.push_back(colour_of_object(scene.objects.path(object)));
  const auto colour_of = [&](const FirstHit& hit) {
    if (hit.element < 0) return Vec3f{};
    if (view == View::object) return colours[static_cast<std::size_t>(hit.element)];
    if (view == View::albedo) return hit.albedo;
    if (view == View::normal) return 0.5f * (hit.normal + Vec3f{1, 1, 1});
    return (hit.depth / white) * Vec3f{1, 1, 1};
  };
  std::vector<float> rgba(4 * hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) put(rgba, i, colour_of(hits[i]));
  return rgba;
}

/// The first hit through the centre of each pixel of the image.
std::vector<FirstHit> find_first_hits(const Kernels& kernels, const SceneView& scene, ThreadPool& thread_pool) {
  std::vector<FirstHit> hits(static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height));
  thread_pool.for_each(scene.height, [&](int y) {
    kernels.first_hits(scene, {0, y, scene.width, y + 1}, hits.data() + offset(scene.width, 0, y));
  });
  return hits;
}

}  // namespace

void look_at_pixel(const Film& film, PixelReport& report) {
  const Region& all = film.region;
  if (report.x < all.x0 || report.x >= all.x1 || report.y < all.y0 || report.y >= all.y1) return;
  const FilmPixel& pixel = film.at(report.x, report.y);
  report.samples = pixel.taken;
  report.rejected = pixel.rejected[0] + pixel.rejected[1];
  report.mean = mean(film, pixel);
  Vec3f variance{};  // of one sample; sums over the pixels around, each weighted by what its difference tells
  float pixels = 0;
  constexpr int reach = 3;
  for (int y = std::max(report.y - reach, all.y0); y < std::min(report.y + reach + 1, all.y1); ++y)
    for (int x = std::max(report.x - reach, all.x0); x < std::min(report.x + reach + 1, all.x1); ++x) {
      const FilmPixel& near = film.at(x, y);
      if (counted(film, near, 0) == 0 || counted(film, near, 1) == 0) continue;
      const Vec3f half = 0.5f * (half_mean(film, near, 0) - half_mean(film, near, 1));
      variance = variance + static_cast<float>(near.taken) * (half * half);
      pixels += 1;
    }
  const float per = pixels > 0 ? 1 / (pixels * static_cast<float>(report.samples)) : 0;
  const auto error = [&](float sum) {
    return pixels > 0 ? std::sqrt(sum * per) : std::numeric_limits<float>::infinity();
  };
  report.standard_error = {error(variance.x), error(variance.y), error(variance.z)};
}

void Views::change_scene(std::shared_ptr<const PreparedScene> scene) {
  scene_ = std::move(scene);
  first_hits_.clear();
  costs_due_ = true;
}

/// Draws the view of noise, or that of samples, in which twice their mean is white. Until the new picture has enough
/// samples, the old drawing stays.
void Views::draw_counts(View view, const Progression& picture, std::vector<float>& rgba) {
  const Film& film = picture.film();
  const std::uint32_t minimum = view == View::noise ? 2 : 1;  // fewer samples show nothing
  if (picture.taken() >= minimum) {
    const double mean = static_cast<double>(totals(film).samples) / static_cast<double>(film.pixels.size());
    counts_of_ = view;
    white_of_counts_ = view == View::noise ? 1 : 2 * mean;
    const auto samples = [&, white = static_cast<float>(white_of_counts_)](std::size_t i) {
      return std::min(static_cast<float>(film.pixels[i].taken) / white, 1.0f);
    };
    counts_ = view == View::noise ? noise_rgba(pixel_relative_error(film)) : greys(film.pixels.size(), samples);
  }
  const bool known = counts_of_ == view && counts_.size() == 4 * film.pixels.size();
  white_ = known ? white_of_counts_ : 1;
  rgba = known ? counts_ : greys(film.pixels.size(), [](std::size_t) { return 0.5f; });
}

PictureGrid Views::draw(View view, const Progression& picture, const CleanFrame* clean, const RenderEngine& engine,
                        const std::atomic<bool>& give_up, std::vector<float>& rgba) {
  const Film& film = picture.film();
  const std::size_t pixels = film.pixels.size();
  const PictureGrid every_pixel{film.region.width(), film.region.height(), 1};
  white_ = 1;
  switch (view) {
    case View::beauty:
      if (picture.is_filling()) return filled_rgba(film, picture.step(), engine.thread_pool, rgba), every_pixel;
      return coarse_rgba(film, picture.step(), engine.thread_pool, rgba);
    case View::noise:
      if (clean && clean->spp > 0) {
        rgba = noise_rgba(clean->pixel_error);
        return every_pixel;
      }
      [[fallthrough]];
    case View::samples:
      draw_counts(view, picture, rgba);
      return every_pixel;
    case View::cost: {
      if (costs_due_) {
        std::vector<float> found = find_costs(engine.kernels, engine.scene, engine.thread_pool, give_up);
        costs_due_ = found.empty();
        if (!costs_due_) costs_ = std::move(found);
      }
      const bool known = costs_.size() == pixels;
      const float maximum = largest(costs_, [](float cost) { return cost; });
      rgba = greys(pixels, [&](std::size_t i) { return known ? costs_[i] / maximum : 0.0f; });
      white_ = static_cast<double>(maximum);
      return every_pixel;
    }
    case View::albedo:
    case View::normal:
    case View::depth:
    case View::object:
      break;
  }
  if (first_hits_.empty()) first_hits_ = find_first_hits(engine.kernels, engine.scene, engine.thread_pool);
  const float farthest = largest(first_hits_, [](const FirstHit& hit) { return hit.depth; });
  rgba = first_hit_rgba(view, first_hits_, scene_->columns(), farthest);
  if (view == View::depth) white_ = static_cast<double>(farthest);
  return every_pixel;
}

}  // namespace tyndall
