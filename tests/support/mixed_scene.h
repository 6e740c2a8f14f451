#pragma once
#include "core/targets/kernels.h"
#include "tests/support/prepared.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

/// Scenes of all kinds of primitives mixed, and rays of all kinds through them.
namespace tyndall::test {

using Engine = std::mt19937;

inline double uniform(Engine& engine, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(engine);
}
inline Vec3d in_cube(Engine& engine, double half_width) {
  return {uniform(engine, -half_width, half_width), uniform(engine, -half_width, half_width),
          uniform(engine, -half_width, half_width)};
}
inline Vec3d direction(Engine& engine) {
  for (;;) {
    const Vec3d v = in_cube(engine, 1);
    if (dot(v, v) < 1 && dot(v, v) > 1e-3) return normalize(v);
  }
}
/// To float, and of length 1 as far as float can.
inline Vec3f unit_vector(Vec3d v) {
  const Vec3d n = normalize(v);
  return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
}
inline Vec3f rounded(Vec3d v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }
inline Vec3d exact(Vec3f v) { return {v.x, v.y, v.z}; }

struct Mixture {
  int count = 200;        ///< primitives: equally many of each kind
  double half_width = 5;  ///< of the cube that holds their centres
  Vec3d middle;           ///< of that cube
  double smallest = 0.02, largest = 1.5;
  int kinds = 5;  ///< 5: spheres, inverted and moving spheres, quads, boxes; 7: also triangles and disks
};

/// A scene of one white matt material.
inline Scene mixed_scene(Engine& engine, const Mixture& mix = {}) {
  Scene scene;
  scene.materials = {{"white", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  scene.camera = {.look_from = mix.middle + Vec3d{0, 0, 3 * mix.half_width}, .look_at = mix.middle, .shutter_close = 1};
  for (int i = 0; i < mix.count; ++i) {
    const double size = mix.smallest * std::pow(mix.largest / mix.smallest, uniform(engine, 0, 1));
    const Vec3d at = mix.middle + in_cube(engine, mix.half_width);
    Object object;
    switch (i % mix.kinds) {
      case 0:
        object.kind = Solid3d{Sphere<>{at, size, {}}, 0};
        break;
      case 1:
        object.kind = Solid3d{Sphere<>{at, -size, {}}, 0};
        break;
      case 2:
        object.kind = Solid3d{Sphere<>{at, size, at + size * direction(engine)}, 0};
        break;
      case 3:
        object.kind = Solid3d{Quad<>{at, size * direction(engine), size * direction(engine)}, 0};
        break;
      case 5:
        object.kind = Solid3d{Triangle<>{at, size * direction(engine), size * direction(engine)}, 0};
        break;
      case 6:
        object.kind = Solid3d{
            Disk<>{at, size * direction(engine), size * direction(engine), i % 2 ? uniform(engine, 0, 0.9) : 0}, 0};
        break;
      default: {
        const Vec3d half{size * uniform(engine, 0.1, 1), size * uniform(engine, 0.1, 1),
                         size * uniform(engine, 0.1, 1)};
        object.kind = Solid3d{Box<>{-half, half}, 0};
        const double degrees = i % 2 ? 90 * std::floor(uniform(engine, -4, 4)) : uniform(engine, -180, 180);
        object.transform = {RotateY{degrees}, Translate{at}};
      }
    }
    scene.objects.push_back(std::move(object));
  }
  return scene;
}

/// Rays that start anywhere and go anywhere.
inline std::vector<TraceRay> random_rays(Engine& engine, int count, double half_width) {
  std::vector<TraceRay> rays;
  for (int i = 0; i < count; ++i)
    rays.push_back({rounded(in_cube(engine, half_width)), unit_vector(direction(engine)),
                    static_cast<float>(uniform(engine, 0, 1)), from_nowhere});
  return rays;
}

/// Rays along the axes, with zeros of both signs, half of them in the planes of primitives' bounds and centres.
inline std::vector<TraceRay> parallel_rays(Engine& engine, int count, double half_width, const RenderScene& scene) {
  std::vector<float> planes;
  for (const float v : scene.elements.center_or_normal.x) planes.push_back(v);
  for (const float v : scene.spheres.center.y) planes.push_back(v);
  for (const BvhInput& input : scene.bvh.input)
    for (const Vec3f& corner : {input.bounds.low, input.bounds.high})
      planes.insert(planes.end(), {corner.x, corner.y, corner.z});
  std::vector<TraceRay> rays = random_rays(engine, count, half_width);
  for (TraceRay& ray : rays) {
    const auto pick = [&] { return planes[engine() % planes.size()]; };
    if (engine() % 2) ray.origin = {pick(), pick(), pick()};
    float d[3];
    for (float& component : d) component = engine() % 2 ? 0.0f : -0.0f;
    d[engine() % 3] = engine() % 2 ? 1.0f : -1.0f;
    ray.direction = {d[0], d[1], d[2]};
  }
  return rays;
}

/// Rays that leave where `rays` end, to either side, with their start's identity; what missed is left out.
inline std::vector<TraceRay> rays_from_surfaces(Engine& engine, const RenderScene& scene, const Kernels& kernels,
                                                const std::vector<TraceRay>& rays) {
  const SceneViewOf view(scene);
  std::vector<TraceHit> hits(rays.size());
  kernels.trace(view.view(), rays.data(), hits.data(), static_cast<int>(rays.size()), false);
  std::vector<TraceRay> leaving;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].element < 0) continue;
    const std::int32_t e = hits[i].element;
    const Elements& all = scene.elements;
    TraceRay ray{point_at(rays[i].origin, hits[i].t, rays[i].direction), unit_vector(direction(engine)), rays[i].time,
                 0};
    Vec3f outward = all.center_or_normal[e];
    if (all.inverse_radius[e] != 0) {
      if (all.move.size() > 0) outward = point_at(outward, ray.time, all.move[e]);
      outward = ray.origin - outward;
    }
    const Side side = dot(ray.direction, outward) > 0 ? Side::outward : Side::inward;
    ray.from = 4 * hits[i].element + static_cast<std::int32_t>(side);
    leaving.push_back(ray);
  }
  return leaving;
}

inline std::vector<TraceHit> traced(const Kernels& kernels, const RenderScene& scene, const std::vector<TraceRay>& rays,
                                    bool brute_force = false) {
  const SceneViewOf view(scene);
  std::vector<TraceHit> hits(rays.size());
  kernels.trace(view.view(), rays.data(), hits.data(), static_cast<int>(rays.size()), brute_force);
  return hits;
}

}  // namespace tyndall::test
