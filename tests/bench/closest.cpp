#include "core/base/sampling.h"
#include "tests/bench/bench.h"
#include "tests/bench/embree.h"
#include "tests/support/prepared.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

/// Closest hits in a field of spheres, by rays as a path tracer meets them; how long its tree takes, and how large it
/// is.
namespace tyndall::bench {

using namespace test;
namespace {

Object sphere(Vec3d center, double radius) {
  Object object;
  object.kind = Solid3d{Sphere<>{center, radius, std::nullopt}, 0};
  return object;
}

/// In [0, 1); the standard distributions differ between libraries.
double uniform(std::mt19937& random) { return static_cast<double>(random()) * 0x1p-32; }

/// Small spheres, one in each cell of a square of edge² cells, as far as they keep clear of the large ones.
std::vector<Object> small_spheres(int edge, std::size_t maximum) {
  std::mt19937 random(7);
  std::vector<Object> spheres;
  for (int i = 0; i < edge; ++i)
    for (int j = 0; j < edge; ++j) {
      const double x = i - edge / 2 + 0.9 * uniform(random), z = j - edge / 2 + 0.9 * uniform(random);
      const bool clear = std::abs(z) > 1.3 || std::abs(x) > 5.3;
      if (clear && spheres.size() < maximum) spheres.push_back(sphere({x, 0.2, z}, 0.2));
    }
  return spheres;
}

/// In [0, 1), in single precision.
float uniform_single(std::mt19937& random) { return static_cast<float>(random() >> 8) * 0x1p-24f; }

/// Rays from the camera, two a pixel, tile by tile; then again.
class CameraRays {
 public:
  explicit CameraRays(const RenderScene& scene) : camera_(scene.camera) {
    constexpr int tile = 32;
    for (int top = 0; top < scene.height; top += tile)
      for (int left = 0; left < scene.width; left += tile)
        for (int y = top; y < std::min(top + tile, scene.height); ++y)
          for (int x = left; x < std::min(left + tile, scene.width); ++x) pixels_.insert(pixels_.end(), 2, {x, y});
  }

  TraceRay next(std::mt19937& random) {
    const auto [column, row] = pixels_[next_++ % pixels_.size()];
    const float x = static_cast<float>(column) + uniform_single(random);
    const float y = static_cast<float>(row) + uniform_single(random);
    return {camera_.center, normalize(camera_.corner + x * camera_.du + y * camera_.dv), 0, from_nowhere};
  }

 private:
  const CameraColumns& camera_;
  std::vector<std::pair<int, int>> pixels_;
  std::size_t next_ = 0;
};

/// The ray that leaves the surface which `ray` hit, in a cosine-weighted direction. It starts a few roundings above the
/// surface, so that Embree, which does not know where rays start, does not meet that surface again.
TraceRay bounce(const Elements& elements, const TraceRay& ray, const TraceHit& hit, std::mt19937& random) {
  const std::int32_t i = hit.element;
  const Vec3f center = elements.center_or_normal[i];
  const Vec3f normal = normalize(elements.inverse_radius[i] * (point_at(ray.origin, hit.t, ray.direction) - center));
  const float radius = 1 / elements.inverse_radius[i], lift = 4e-7f * (length(center) + radius);
  const float u = uniform_single(random), v = uniform_single(random);
  const Vec3f direction = normal + 0.9999f * on_sphere(Pair<float>{u, v});  // never zero
  return {point_at(center, radius + lift, normal), normalize(direction), 0,
          4 * hit.element + static_cast<std::int32_t>(Side::outward)};
}

/// A field of `count` >= 500 or so lambertian spheres like that of the books' cover: a ground, three large ones, small
/// ones strewn around them, all apart, under the sky. A pure function of the count.
Scene field_of_spheres(int count) {
  Scene scene;
  scene.width = 400, scene.height = 225;
  scene.camera = {.look_from = {13, 2, 3}, .look_at = {0, 0, 0}, .vfov = 20};
  scene.background = Gradient{};
  scene.render.max_depth = 50;
  scene.materials = {Material{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  scene.objects = {sphere({0, -1000, 0}, 1000), sphere({0, 1, 0}, 1), sphere({-4, 1, 0}, 1), sphere({4, 1, 0}, 1)};
  const auto small = static_cast<std::size_t>(count) - scene.objects.size();
  std::vector<Object> strewn;
  for (int edge = static_cast<int>(std::sqrt(static_cast<double>(small))); strewn.size() < small; ++edge)
    strewn = small_spheres(edge, small);
  scene.objects.insert(scene.objects.end(), strewn.begin(), strewn.end());
  return scene;
}

/// `count` rays in the order in which the kernels would trace them: groups of `kernels.lanes` paths that start at the
/// camera, tile by tile, and bounce as if all surfaces were lambertian; a path that leaves is followed by the next one.
/// The scene must consist of spheres at rest. Repeatable.
std::vector<TraceRay> rays_in_path_order(const RenderScene& scene, const Kernels& kernels, std::size_t count) {
  const SceneViewOf view(scene);
  const auto lanes = static_cast<std::size_t>(kernels.lanes);
  constexpr int max_bounces = 50;
  std::mt19937 random(1);
  CameraRays camera(scene);
  std::vector<TraceRay> group(lanes), rays;
  std::vector<TraceHit> hits(lanes);
  std::vector<int> bounces(lanes);
  for (TraceRay& ray : group) ray = camera.next(random);
  while (rays.size() < count) {
    rays.insert(rays.end(), group.begin(), group.end());
    kernels.trace(view.view(), group.data(), hits.data(), kernels.lanes, false);
    for (std::size_t k = 0; k < lanes; ++k) {
      const bool on = hits[k].element >= 0 && ++bounces[k] <= max_bounces;
      if (!on) bounces[k] = 0;
      group[k] = on ? bounce(scene.elements, group[k], hits[k], random) : camera.next(random);
    }
  }
  rays.resize(count);
  return rays;
}

/// The same rays in random order. Repeatable.
std::vector<TraceRay> shuffled(std::vector<TraceRay> rays) {
  std::mt19937_64 random(3);
  for (std::size_t i = rays.size(); i > 1; --i) std::swap(rays[i - 1], rays[random() % i]);
  return rays;
}

constexpr Embree::Width widths[] = {Embree::Width::one, Embree::Width::sixteen, Embree::Width::sixteen_coherent};

/// Whether both miss, or both hit at the same distance, to a thousandth or to the rounding of single precision for a
/// sphere of that radius, in which both compute.
bool agree(const TraceHit& a, const TraceHit& b, const Elements& elements) {
  if (a.element < 0 || b.element < 0) return a.element < 0 && b.element < 0;
  const float radius = 1 / elements.inverse_radius[static_cast<std::size_t>(a.element)];
  return std::abs(a.t - b.t) <= 1e-3f * std::max(a.t, b.t) + 0x1p-22f * radius;
}

/// Throws unless nearly all hits are the same in both. The rest are rays that graze a sphere or start where two meet.
void check_agreement(const std::vector<TraceHit>& ours, const std::vector<TraceHit>& theirs, const RenderScene& scene) {
  constexpr double minimum = 0.999;
  std::size_t same = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) same += agree(ours[i], theirs[i], scene.elements);
  const double fraction = static_cast<double>(same) / static_cast<double>(ours.size());
  if (fraction < minimum)
    throw WrongResult(std::to_string(scene.primitives()) + " spheres: only " + std::to_string(100 * fraction) +
                      " % of the distances are Embree's");
}

/// The two rivals on one list of rays.
struct Duel {
  const Kernels& kernels;
  const SceneView& view;
  const Embree& embree;
  const std::vector<TraceRay>& rays;
  std::vector<TraceHit> hits = std::vector<TraceHit>(rays.size());

  void ours() { kernels.trace(view, rays.data(), hits.data(), static_cast<int>(rays.size()), false); }
  void theirs(Embree::Width width) { embree.trace(width, rays, hits); }
  double mrays(double seconds) const { return static_cast<double>(rays.size()) / seconds * 1e-6; }
};

void check(Duel& duel, const RenderScene& scene) {
  duel.ours();
  const std::vector<TraceHit> ours = duel.hits;
  for (const Embree::Width width : widths) {
    duel.theirs(width);
    check_agreement(ours, duel.hits, scene);
  }
}

/// Interleaved; the ratio is the median of the ratios of neighbouring runs, against the best of Embree's widths.
std::vector<std::string> run(Duel& duel, int repeat) {
  const bool paired = *embree_version() != '\0';
  std::vector<double> ours, theirs, ratios;
  for (int i = 0; i < repeat; ++i) {
    ours.push_back(duel.mrays(seconds_of([&] { duel.ours(); })));
    if (!paired) continue;
    double best = 0;
    for (const Embree::Width width : widths) best = std::max(best, duel.mrays(seconds_of([&] { duel.theirs(width); })));
    theirs.push_back(best), ratios.push_back(ours.back() / best);
  }
  return {cell(median(ours), 2), cell(median(theirs), 2), cell(median(ratios), 2)};
}

void add_rows(const Table& table, int spheres, bool quick) {
  const int repeat = quick ? 3 : 9;
  const Kernels kernels = *choose_kernels("");
  RenderScene scene;
  std::vector<double> build_ms;
  for (int i = 0; i < repeat; ++i)
    build_ms.push_back(1000 * seconds_of([&] { scene = compile(field_of_spheres(spheres)); }));
  const SceneViewOf view(scene);
  const Embree embree(scene.spheres);
  const std::vector<TraceRay> in_order = rays_in_path_order(scene, kernels, quick ? 1u << 17 : 1u << 19);
  for (const bool shuffle : {false, true}) {
    const std::vector<TraceRay> rays = shuffle ? shuffled(in_order) : in_order;
    Duel duel{kernels, view.view(), embree, rays};
    if (*embree_version()) check(duel, scene);
    std::vector<std::string> cells{std::to_string(spheres), cell(median(build_ms), 1),
                                   cell(static_cast<double>(bytes_of(scene)) / spheres, 0),
                                   shuffle ? "shuffled" : "path"};
    for (const std::string& figure : run(duel, repeat)) cells.push_back(figure);
    table.add(cells);
  }
}

}  // namespace

void measure_closest(const Settings& settings) {
  const std::string version = embree_version();
  const std::string rival = version.empty() ? "built without Embree" : "beside the best of Embree " + version;
  const Table table("Closest hits: one thread, Mrays/s, the same rays, " + rival,
                    {"spheres", "built in ms", "bytes each", "order", "Tyndall", "Embree", "Tyndall / Embree"});
  for (const int spheres : {486, 6402, 90001}) add_rows(table, spheres, settings.quick);
}

}  // namespace tyndall::bench
