#include "core/compile/flatten.h"
#include "tests/support/mixed_scene.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

/// Closed surfaces of triangles: no ray at their edges and corners slips between two of them.
namespace tyndall::test::watertight_test {

namespace {

/// A cube of half width 1 whose faces are n x n cells of two triangles each, or that cube blown up to a sphere. A ray
/// that passes the middle at less than `inner` goes through it. Normals point outward.
struct ClosedMesh {
  std::vector<std::array<Vec3d, 3>> triangles;
  double inner = 1;

  ClosedMesh(int n, bool is_round) {
    for (int face = 0; face < 6; ++face)
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
          const auto at = [&](int a, int b) {
            const double x = 2.0 * a / n - 1, y = 2.0 * b / n - 1, z = face < 3 ? 1 : -1;
            const Vec3d p = face % 3 == 0 ? Vec3d{x, y, z} : face % 3 == 1 ? Vec3d{z, x, y} : Vec3d{y, z, x};
            return is_round ? normalize(p) : p;
          };
          add({at(i, k), at(i + 1, k), at(i + 1, k + 1)}, face < 3);
          add({at(i, k), at(i + 1, k + 1), at(i, k + 1)}, face < 3);
        }
    for (const auto& t : triangles) inner = std::min(inner, dot(normalize(cross(t[1] - t[0], t[2] - t[0])), t[0]));
  }

  /// The objects of the mesh `scale` times as large, in two groups of the same transform.
  std::vector<Object> objects(double scale, const Transform& transform) const {
    std::vector<Object> halves{{"", Group{}, transform}, {"", Group{}, transform}};
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const Vec3d a = scale * triangles[i][0], b = scale * triangles[i][1], c = scale * triangles[i][2];
      std::get<Group>(halves[i / 2 % 2].kind).objects.push_back({"", Solid3d{Triangle<>{a, b - a, c - a}, 0}, {}});
    }
    return halves;
  }

 private:
  void add(std::array<Vec3d, 3> corners, bool outward) {
    if (!outward) std::swap(corners[1], corners[2]);
    triangles.push_back(corners);
  }
};

/// Aims rays at points on edges and at corners of a mesh, of which the half starts within it, and returns how many of
/// them do not meet it, or meet it from within although they come from outside.
int slip_through(const ClosedMesh& mesh, double scale, const Transform& transform, const Kernels& kernels, int count,
                 bool from_within) {
  Scene scene;
  scene.materials = {{"white", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  scene.objects = mesh.objects(scale, transform);
  const RenderScene compiled = compile(scene);
  const SceneViewOf view(compiled);
  const Placement placement = placement_of(transform);
  const auto in_scene = [&](Vec3d p) { return rounded(place(placement, scale * p) - compiled.origin); };
  Engine engine(1);
  const auto aimed = [&]() -> std::pair<Vec3d, Vec3d> {
    for (;;) {
      const auto& corners = mesh.triangles[engine() % mesh.triangles.size()];
      const std::size_t first = engine() % 3, kind = engine() % 4;
      const double share = kind == 0 ? 0 : kind == 1 ? std::pow(10, uniform(engine, -8, -1)) : uniform(engine, 0, 1);
      const Vec3d to = corners[first] + share * (corners[(first + 1) % 3] - corners[first]);
      const double distance = from_within ? uniform(engine, 0, 0.98) * mesh.inner : uniform(engine, 1.8, 6);
      const Vec3d from = distance * direction(engine);
      const bool through = length(cross(normalize(to - from), from)) < 0.999 * mesh.inner;
      if (from_within || (through && dot(to, to - from) < 0)) return {from, to};
    }
  };
  int leaks = 0;
  std::vector<TraceRay> rays(static_cast<std::size_t>(std::min(count, 1 << 16)));
  std::vector<TraceHit> hits(rays.size());
  for (int done = 0; done < count; done += static_cast<int>(rays.size())) {
    for (TraceRay& ray : rays) {
      const auto [from, to] = aimed();
      ray = {in_scene(from), {}, 0, from_nowhere};
      ray.direction = unit_vector(place(placement, scale * to) - compiled.origin - exact(ray.origin));
    }
    kernels.trace(view.view(), rays.data(), hits.data(), static_cast<int>(rays.size()), false);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto faces = [&] {
        return dot(compiled.elements.center_or_normal[hits[i].element], rays[i].direction) < 0;
      };
      leaks += hits[i].element < 0 || (!from_within && !faces()) ? 1 : 0;
    }
  }
  return leaks;
}

}  // namespace

TEST_CASE("triangles: no ray slips between two that share corners, from either side, at any scale, through groups") {
  const Transform turned{RotateY{33}, Translate{{3, -2, 1}}};
  constexpr int cells[] = {6, 3, 40};
  const int rays = thorough() ? 10'000'000 / 6 : 1 << 16;  // 10^7 from each side at each scale
  for (const Kernels& kernels : available_kernels())
    for (const bool is_round : {false, true})
      for (const int n : tried(cells, 1))
        for (const double scale : {1e-3, 1.0, 1e5})
          for (const bool from_within : {false, true}) {
            CAPTURE(std::string(kernels.isa));
            CAPTURE(is_round);
            CAPTURE(n);
            CAPTURE(scale);
            CAPTURE(from_within);
            const Transform transform = scale == 1 ? turned : Transform{};
            CHECK(slip_through({n, is_round}, scale, transform, kernels, rays, from_within) == 0);
          }
}

}  // namespace tyndall::test::watertight_test
