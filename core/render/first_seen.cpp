#include "core/render/clean_film.h"

#include "core/trace/shade.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tyndall {
namespace {

/// Whether rays that hit a surface end there (matt surfaces, lights) or continue as off a mirror. False for glass and
/// wide lobes.
bool is_sharp(const SceneView& scene, std::int32_t element) {
  const std::int32_t material = scene.elements.material[element], kind = scene.materials.kind[material];
  if (has_trait<&BsdfTraits::transmissive>(kind)) return false;
  return !has_trait<&BsdfTraits::glossy>(kind) || lobe_width_of(scene, material) <= min_sampled_fuzz;
}

constexpr int planes = 8;  // of input.seen: albedo, normal, nearness, sharpness
constexpr int depth_plane = 6, sharp_plane = 7;
constexpr int max_parts = 8;
/// Number of adjacent pixels of a row that are divided together or not at all.
constexpr int group = 4;
/// Adjacent parts that are traced together, so that they fill the lanes.
constexpr int together = group * max_parts;

/// Counts of a row: pixels that see a surface, and their sum of 1 / depth.
struct RowCount {
  double seen = 0, per_depth = 0;
};

/// is_sharp() of the elements that rays hit; it remembers the last element, because most rays hit the same one.
class Sharpness {
 public:
  explicit Sharpness(const SceneView& scene) : scene_(scene) {}
  bool of(std::int32_t element) {
    if (element != element_) element_ = element, sharp_ = element < 0 || is_sharp(scene_, element);
    return sharp_;
  }

 private:
  const SceneView& scene_;
  std::int32_t element_ = -1;
  bool sharp_ = true;
};

/// Bits for the neighbours that a pixel differs from.
constexpr std::uint8_t differs_from_right = 1, differs_from_below = 2;

/// Adds `mark` to marks[i] where two rows of pixels see different things at i. a, b: positions of the rows in the
/// planes.
void mark_differences(const CleanInput& input, std::ptrdiff_t a, std::ptrdiff_t b, int count, std::uint8_t mark,
                      std::uint8_t* marks) {
  const float *row[depth_plane + 1], *other[depth_plane + 1];
  for (int k = 0; k <= depth_plane; ++k) row[k] = input.seen.plane(k) + a, other[k] = input.seen.plane(k) + b;
  const auto off = [&](int k, int i) { return std::abs(row[k][i] - other[k][i]); };
  for (int i = 0; i < count; ++i) {
    const float colour = off(0, i) + off(1, i) + off(2, i), normal = off(3, i) + off(4, i) + off(5, i);
    const bool differ = (colour > 0.02f) | (normal > 0.4f) | (off(depth_plane, i) > 0.02f);
    marks[i] = static_cast<std::uint8_t>(marks[i] | (differ ? mark : 0));
  }
}

struct FirstSeenFinder {
  const Region& region;
  const RenderEngine& engine;
  CleanInput& input;
  std::vector<RowCount> rows;
  std::vector<std::uint8_t> marks;   ///< of each pixel: differs_from_right, differs_from_below
  std::vector<std::uint8_t> unlike;  ///< of each group, row by row
  float per_depth = 0;  ///< 1 / harmonic mean of the depths of all pixels that see a surface; 1 if none does

  int width() const { return region.width(); }
  std::size_t groups() const { return static_cast<std::size_t>((width() + group - 1) / group); }
  float* row(int plane, int y) const { return input.seen.plane(plane) + y * input.seen.stride(); }

  /// Fills a row with what the pixels' centres see; stores depth instead of nearness.
  void look_at_centres(int y) {
    std::vector<FirstHit> hits(static_cast<std::size_t>(width()));
    engine.kernels.first_hits(engine.scene, {region.x0, region.y0 + y, region.x1, region.y0 + y + 1}, hits.data());
    RowCount& count = rows[static_cast<std::size_t>(y)];
    Sharpness sharpness(engine.scene);
    float* to[planes];
    for (int k = 0; k < planes; ++k) to[k] = row(k, y);
    for (int x = 0; x < width(); ++x) {
      const FirstHit& hit = hits[static_cast<std::size_t>(x)];
      const float depth = hit.element < 0 ? 0 : hit.depth;
      to[0][x] = hit.albedo.x, to[1][x] = hit.albedo.y, to[2][x] = hit.albedo.z;
      to[3][x] = hit.normal.x, to[4][x] = hit.normal.y, to[5][x] = hit.normal.z;
      to[depth_plane][x] = depth, to[sharp_plane][x] = sharpness.of(hit.element) ? 1.0f : 0.0f;
      if (depth > 0) count.per_depth += 1 / static_cast<double>(depth), ++count.seen;
    }
  }
  void convert_to_nearness(int y) const {
    float* depth = row(depth_plane, y);
    for (int x = 0; x < width(); ++x) depth[x] = depth[x] > 0 ? 1 / (1 + depth[x] * per_depth) : 0;
  }
  std::uint8_t* marks_of(int y) {
    return marks.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width());
  }
  void compare_neighbours(int y) {
    const std::ptrdiff_t stride = input.seen.stride(), at = y * stride;
    mark_differences(input, at, at + 1, width() - 1, differs_from_right, marks_of(y));
    if (y + 1 < region.height()) mark_differences(input, at, at + stride, width(), differs_from_below, marks_of(y));
  }
  /// Marks the groups in which a pixel sees something else than one of its four neighbours.
  void find_unlike(int y) {
    const std::uint8_t *own = marks_of(y), *above = marks_of(std::max(y - 1, 0));
    std::uint8_t* found = unlike.data() + static_cast<std::size_t>(y) * groups();
    for (int x = 0; x < width(); ++x)
      if (own[x] != 0 || (x > 0 && (own[x - 1] & differs_from_right) != 0) ||
          (y > 0 && (above[x] & differs_from_below) != 0))
        found[x / group] = 1;
  }
  /// Sets `count` pixels from x0 on to the means over their parts. scene: a view whose pixels are the parts.
  void divide(const SceneView& scene, int parts, int x0, int y, int count) const {
    FirstHit hits[together];
    float sum[together][planes] = {};  // of each pixel
    Sharpness sharpness(scene);
    const int left = parts * (region.x0 + x0), top = parts * (region.y0 + y);
    for (int line = top; line < top + parts; ++line) {
      engine.kernels.first_hits(scene, {left, line, left + parts * count, line + 1}, hits);
      for (int i = 0; i < count; ++i) {
        float* const all = sum[i];
        const FirstHit* const first = hits + static_cast<std::ptrdiff_t>(i) * parts;
        for (const FirstHit* hit = first; hit < first + parts; ++hit) {
          all[0] += hit->albedo.x, all[1] += hit->albedo.y, all[2] += hit->albedo.z;
          all[3] += hit->normal.x, all[4] += hit->normal.y, all[5] += hit->normal.z;
          all[depth_plane] += hit->element < 0 ? 0 : 1 / (1 + hit->depth * per_depth);
          all[sharp_plane] += sharpness.of(hit->element) ? 1.0f : 0.0f;
        }
      }
    }
    const float fraction = 1.0f / static_cast<float>(parts * parts);  // a power of two
    for (int k = 0; k < planes; ++k)
      for (int i = 0; i < count; ++i) row(k, y)[x0 + i] = fraction * sum[i][k];
    for (int i = 0; i < count; ++i) row(sharp_plane, y)[x0 + i] = fraction * sum[i][sharp_plane] < 1 ? 0.0f : 1.0f;
  }
  /// Divides the unlike pixels of a row, as many at a time as fill the lanes.
  void divide_row(const SceneView& scene, int parts, int y, const std::atomic<bool>& give_up) const {
    const std::uint8_t* chosen = unlike.data() + static_cast<std::size_t>(y) * groups();
    for (int x = 0; x < width() && !give_up.load(std::memory_order_relaxed);) {
      int end = x;
      while (end < width() && end - x < together / parts && chosen[end / group] != 0) end += group;
      if (end > x) divide(scene, parts, x, y, std::min(end, width()) - x);
      x = std::max(end, x + group);
    }
  }
};

/// The same view in a picture whose pixels are the parts of pixels.
SceneView divided(SceneView scene, int parts) {
  const float part = 1.0f / static_cast<float>(parts);
  scene.width *= parts, scene.height *= parts;
  scene.camera.du = part * scene.camera.du, scene.camera.dv = part * scene.camera.dv;
  return scene;
}

}  // namespace

int parts_of_pixels(const FirstSeenParts& made, double spp) {
  const double rays = spp * made.region.width() * made.region.height();
  int parts = max_parts;
  while (parts > 1 && static_cast<double>(made.unlike * parts * parts) > rays) parts /= 2;
  return parts;
}

bool find_first_seen(const Region& region, const RenderEngine& engine, const std::atomic<bool>& give_up,
                     CleanInput& input, FirstSeenParts& made) {
  const int height = region.height();
  input.seen.resize(region.width(), height, planes);
  FirstSeenFinder finder{region, engine, input, {}, {}, {}};
  finder.rows.resize(static_cast<std::size_t>(height));
  finder.marks.resize(static_cast<std::size_t>(height) * static_cast<std::size_t>(region.width()));
  finder.unlike.resize(finder.groups() * static_cast<std::size_t>(height));
  const auto each_row = [&](const auto& job) {
    engine.thread_pool.for_each(height, [&](int y) {
      if (!give_up.load(std::memory_order_relaxed)) job(y);
    });
    return !give_up;
  };
  if (!each_row([&](int y) { finder.look_at_centres(y); })) return false;
  RowCount all;
  for (const RowCount& row : finder.rows) all.seen += row.seen, all.per_depth += row.per_depth;
  finder.per_depth = static_cast<float>(all.seen > 0 ? all.per_depth / all.seen : 1);
  if (!each_row([&](int y) { finder.convert_to_nearness(y); }) ||
      !each_row([&](int y) { finder.compare_neighbours(y); }) || !each_row([&](int y) { finder.find_unlike(y); }))
    return false;
  made = {region, group * std::count(finder.unlike.begin(), finder.unlike.end(), std::uint8_t{1}), 1};
  made.parts = parts_of_pixels(made, input.spp);
  if (made.parts == 1) return true;
  const SceneView scene = divided(engine.scene, made.parts);
  return each_row([&](int y) { finder.divide_row(scene, made.parts, y, give_up); });
}

}  // namespace tyndall
