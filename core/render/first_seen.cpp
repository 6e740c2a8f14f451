#include "core/render/clean_film.h"

#include "core/materials/materials.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tyndall {
namespace {

/// Whether a ray that meets the surface goes on, if at all, as one that a mirror reflects.
bool is_sharp(const SceneView& scene, std::int32_t element) {
  const std::int32_t material = scene.material[element], kind = scene.kind[material];
  if (kind == place_in<Dielectric<double>, MaterialKinds<double>>) return false;
  return kind != place_in<Metal<double>, MaterialKinds<double>> || scene.parameter[0][material] <= least_sampled_fuzz;
}

constexpr int depth_plane = 6;  // of input.seen
constexpr int most_parts = 8;
/// Pixels of a row that are divided together, so that one row of their parts fills the lanes.
constexpr int group = 4;

/// Of a row's pixels where anything is seen: how many there are, and the sum of 1 / depth. And its unlike pixels.
struct RowCount {
  double seen = 0, per_depth = 0;
  std::int64_t unlike = 0;
};

struct FirstSeenFinder {
  const Region& region;
  const RenderEngine& engine;
  CleanInput& input;
  std::vector<RowCount> rows;
  std::vector<std::uint8_t> unlike;  ///< of each group, row by row
  float per_depth = 0;               ///< over the mean depth; 0: not known yet

  int width() const { return region.width(); }
  std::size_t groups() const { return static_cast<std::size_t>((width() + group - 1) / group); }
  float* row(int plane, int y) const { return input.seen.plane(plane) + y * input.seen.stride(); }

  FirstSeen seen_at(const FirstHit& hit) const {
    if (hit.element < 0) return {};
    return {hit.albedo, hit.normal, 1 / (1 + hit.depth * per_depth), is_sharp(engine.scene, hit.element)};
  }
  /// What the pixels' centres see; the depth itself in place of the nearness.
  void look_at_centres(int y) {
    std::vector<FirstHit> hits(static_cast<std::size_t>(width()));
    engine.kernels.first_hits(engine.scene, {region.x0, region.y0 + y, region.x1, region.y0 + y + 1}, hits.data());
    RowCount& count = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < width(); ++x) {
      const FirstHit& hit = hits[static_cast<std::size_t>(x)];
      FirstSeen seen = seen_at(hit);
      seen.nearness = hit.element < 0 ? 0 : hit.depth;
      put_first_seen(seen, x, y, input);
      if (seen.nearness > 0) count.per_depth += 1 / static_cast<double>(seen.nearness), ++count.seen;
    }
  }
  /// One over the harmonic mean of the depths at which anything is seen; 1 where nothing is.
  float per_mean_depth() const {
    RowCount all;
    for (const RowCount& row : rows) all.seen += row.seen, all.per_depth += row.per_depth;
    return static_cast<float>(all.seen > 0 ? all.per_depth / all.seen : 1);
  }
  void turn_into_nearness(int y) const {
    float* depth = row(depth_plane, y);
    for (int x = 0; x < width(); ++x) depth[x] = depth[x] > 0 ? 1 / (1 + depth[x] * per_depth) : 0;
  }
  bool differ(std::ptrdiff_t a, std::ptrdiff_t b) const {
    float colour = 0, normal = 0;
    for (int k = 0; k < 3; ++k) colour += std::abs(input.seen.plane(k)[a] - input.seen.plane(k)[b]);
    for (int k = 3; k < 6; ++k) normal += std::abs(input.seen.plane(k)[a] - input.seen.plane(k)[b]);
    return colour > 0.02f || normal > 0.4f ||
           std::abs(input.seen.plane(depth_plane)[a] - input.seen.plane(depth_plane)[b]) > 0.02f;
  }
  void find_unlike(int y) {
    const std::ptrdiff_t stride = input.seen.stride();
    for (int x = 0; x < width(); ++x) {
      const std::ptrdiff_t at = y * stride + x;
      if ((x > 0 && differ(at, at - 1)) || (x + 1 < width() && differ(at, at + 1)) ||
          (y > 0 && differ(at, at - stride)) || (y + 1 < region.height() && differ(at, at + stride)))
        unlike[static_cast<std::size_t>(y) * groups() + static_cast<std::size_t>(x / group)] = 1;
    }
    const auto first = unlike.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * groups());
    rows[static_cast<std::size_t>(y)].unlike =
        group * std::count(first, first + static_cast<std::ptrdiff_t>(groups()), std::uint8_t{1});
  }
  /// Sets `count` pixels from x0 on to the means over their parts. scene: with parts for pixels.
  void divide(const SceneView& scene, int parts, int x0, int y, int count) const {
    const float share = 1.0f / static_cast<float>(parts * parts);
    FirstHit hits[group * most_parts];
    FirstSeen mean[group];
    const int left = parts * (region.x0 + x0), top = parts * (region.y0 + y);
    for (int line = top; line < top + parts; ++line) {
      engine.kernels.first_hits(scene, {left, line, left + parts * count, line + 1}, hits);
      for (int i = 0; i < parts * count; ++i) {
        const FirstSeen part = seen_at(hits[i]);
        FirstSeen& to = mean[i / parts];
        to.albedo = to.albedo + share * part.albedo;
        to.normal = to.normal + share * part.normal;
        to.nearness += share * part.nearness;
        to.sharp = to.sharp && part.sharp;
      }
    }
    for (int i = 0; i < count; ++i) put_first_seen(mean[i], x0 + i, y, input);
  }
};

/// The same view in a picture that has the parts of pixels for pixels.
SceneView divided(SceneView scene, int parts) {
  const float part = 1.0f / static_cast<float>(parts);
  scene.width *= parts, scene.height *= parts;
  scene.camera.du = part * scene.camera.du, scene.camera.dv = part * scene.camera.dv;
  return scene;
}

}  // namespace

int parts_of_pixels(const FirstSeenParts& made, double spp) {
  const double rays = spp * made.region.width() * made.region.height();
  int parts = most_parts;
  while (parts > 1 && static_cast<double>(made.unlike * parts * parts) > rays) parts /= 2;
  return parts;
}

bool find_first_seen(const Region& region, const RenderEngine& engine, const std::atomic<bool>& give_up,
                     CleanInput& input, FirstSeenParts& made) {
  const int height = region.height();
  resize_first_seen(region.width(), height, input);
  FirstSeenFinder finder{region, engine, input, {}, {}};
  finder.rows.resize(static_cast<std::size_t>(height));
  finder.unlike.resize(finder.groups() * static_cast<std::size_t>(height));
  const auto each_row = [&](const auto& job) {
    engine.crew.for_each(height, [&](int y) {
      if (!give_up.load(std::memory_order_relaxed)) job(y);
    });
    return !give_up;
  };
  if (!each_row([&](int y) { finder.look_at_centres(y); })) return false;
  finder.per_depth = finder.per_mean_depth();
  if (!each_row([&](int y) { finder.turn_into_nearness(y); }) || !each_row([&](int y) { finder.find_unlike(y); }))
    return false;
  made = {region, 0, 1};
  for (const RowCount& row : finder.rows) made.unlike += row.unlike;
  made.parts = parts_of_pixels(made, input.spp);
  if (made.parts == 1) return true;
  const SceneView scene = divided(engine.scene, made.parts);
  return each_row([&](int y) {
    const std::uint8_t* unlike = finder.unlike.data() + static_cast<std::size_t>(y) * finder.groups();
    for (int x = 0; x < region.width() && !give_up.load(std::memory_order_relaxed); x += group)
      if (unlike[x / group] != 0) finder.divide(scene, made.parts, x, y, std::min(group, region.width() - x));
  });
}

}  // namespace tyndall
