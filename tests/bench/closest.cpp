#include "tests/bench/bench.h"
#include "tests/bench/embree.h"
#include "tests/bench/field.h"
#include "tests/support/prepared.h"

#include <algorithm>
#include <cmath>

namespace tyndall::bench {

using namespace test;
namespace {

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
