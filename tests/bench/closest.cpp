#include "tests/bench/bench.h"
#include "tests/bench/embree.h"
#include "tests/bench/measure.h"
#include "tests/bench/rays.h"
#include "tests/bench/scenes.h"
#include "tests/support/prepared.h"

#include <algorithm>
#include <cmath>

namespace tyndall::bench {

using namespace test;
namespace {

constexpr Embree::Width widths[] = {Embree::Width::one, Embree::Width::sixteen, Embree::Width::sixteen_coherent};
constexpr const char* width_keys[] = {"embree_1_mrays_per_s", "embree_16_mrays_per_s",
                                      "embree_16_coherent_mrays_per_s"};

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
void run(Duel& duel, int repeat, Json& row) {
  const bool paired = *embree_version() != '\0';
  std::vector<double> ours, theirs[std::size(widths)], ratios;
  for (int i = 0; i < repeat; ++i) {
    ours.push_back(duel.mrays(seconds_of([&] { duel.ours(); })));
    if (!paired) continue;
    double best = 0;
    for (std::size_t k = 0; k < std::size(widths); ++k) {
      theirs[k].push_back(duel.mrays(seconds_of([&] { duel.theirs(widths[k]); })));
      best = std::max(best, theirs[k].back());
    }
    ratios.push_back(ours.back() / best);
  }
  row["mrays_per_s"] = median(ours);
  for (std::size_t k = 0; k < std::size(widths); ++k)
    row[width_keys[k]] = paired ? Json(median(theirs[k])) : Json(nullptr);
  row["ratio"] = paired ? Json(median(ratios)) : Json(nullptr);
}

void add_rows(Table& table, int spheres, const Settings& settings) {
  const int repeat = settings.repeat > 0 ? settings.repeat : settings.quick ? 3 : 9;
  const std::size_t count = settings.quick ? 1u << 17 : 1u << 19;
  const Kernels kernels = *choose_kernels("");
  const RenderScene scene = compile(field_of_spheres(spheres));
  const SceneViewOf view(scene);
  const Embree embree(scene.spheres);
  const std::vector<TraceRay> in_order = rays_in_path_order(scene, kernels, count), mixed = shuffled(in_order);
  for (const bool shuffle : {false, true}) {
    Duel duel{kernels, view.view(), embree, shuffle ? mixed : in_order};
    if (*embree_version()) check(duel, scene);
    Json row;
    row["spheres"] = spheres;
    row["order"] = shuffle ? "shuffled" : "path";
    row["isa"] = kernels.isa, row["lanes"] = kernels.lanes;
    row["rays"] = count;
    row["embree"] = embree_version();
    run(duel, repeat, row);
    table.add(row);
  }
}

}  // namespace

Json measure_closest(const Settings& settings) {
  const std::string version = embree_version();
  const std::string rival = version.empty() ? "built without Embree" : "beside Embree " + version;
  Table table("Closest hits: one thread, Mrays/s, the same rays, " + rival,
              {{"spheres", "spheres", 0},
               {"order", "order", -1, 8},
               {"mrays_per_s", "Tyndall", 2},
               {"embree_1_mrays_per_s", "Embree 1", 2},
               {"embree_16_mrays_per_s", "Embree 16", 2},
               {"embree_16_coherent_mrays_per_s", "16 coherent", 2},
               {"ratio", "Tyndall / best", 2}});
  for (const int spheres : {486, 6402, 90001}) add_rows(table, spheres, settings);
  return table.rows();
}

}  // namespace tyndall::bench
