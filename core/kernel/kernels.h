#pragma once
#include "core/film/film.h"
#include "core/kernel/scene_view.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

/// The kernels as the rest of the program sees them: a table of functions for each instruction set, all of one source.
namespace tyndall {

/// A unit of work: samples [first, last) of the pixels of a tile.
struct Unit {
  Region tile;                        ///< full-image coordinates
  int step = 1;                       ///< only pixels whose x and y are multiples of step; step 1: all
  int skip_step = 0;                  ///< > 0: pixels whose x and y are both multiples of it are left out (done before)
  std::uint32_t first = 0, last = 0;  ///< sample indices
  /// Null, or for each pixel of the tile, row by row, its own first and last (<= last) in place of those above.
  const std::uint32_t *first_of = nullptr, *last_of = nullptr;
};

struct UnitCounts {
  std::uint64_t rays = 0;         ///< closest-hit and occlusion queries
  std::uint64_t shadow_rays = 0;  ///< of them, occlusion queries
  ExactSum cut_throughput;        ///< sum over paths that max_depth cut off: their throughput's brightest channel
};

using RenderUnit = void (*)(const SceneView& scene, const Unit& unit, double film_unit, FilmPixel* pixels,
                            EmissionSums* emission, UnitCounts& counts);

/// One ray for `trace`.
struct TraceRay {
  Vec3f origin, direction;  ///< unit direction, RenderScene coordinates
  float time = 0;
  std::int32_t from = -4;  ///< see Ray::from
};
struct TraceHit {
  float t = 0;                ///< distance; meaningless without a hit
  std::int32_t element = -1;  ///< -1: nothing hit
  bool operator==(const TraceHit&) const = default;
};
/// Closest surfaces of `count` rays, in groups of lanes in the given order. brute_force: test every primitive.
using TraceRays = void (*)(const SceneView& scene, const TraceRay* rays, TraceHit* hits, int count, bool brute_force);

/// What is first seen through the centre of a pixel: for picking and the views.
struct FirstHit {
  std::int32_t element = -1;
  float depth = 0;  ///< distance along the camera's axis
  Vec3f albedo, normal;
};
/// `hits`: the region, row by row.
using FirstHits = void (*)(const SceneView& scene, const Region& region, FirstHit* hits);

struct Kernels {
  const char* isa;                       ///< "scalar", "sse4", "avx2", "avx512"
  int lanes;                             ///< paths that run together
  RenderUnit render_units[kernel_sets];  ///< by KernelSet; the full kernel in the place of each that was not compiled
  TraceRays trace;
  FirstHits first_hits;

  /// Gathers a unit into `pixels` (the tile, row by row, empty on entry) and counts, by the kernel set that the scene
  /// names. `taken` is set for what was sampled. emission: likewise of the tile; null: not wanted.
  void render_unit(const SceneView& scene, const Unit& unit, double film_unit, FilmPixel* pixels, UnitCounts& counts,
                   EmissionSums* emission = nullptr) const;

  /// The set whose kernel renders a scene that needs at least the models of `least`: `least` itself, or everything
  /// where this instruction set has the full kernel alone.
  KernelSet set_for(KernelSet least) const;
};

// Each is in a file of its own, which is compiled with that instruction set's flags.
Kernels scalar_kernels();
Kernels sse4_kernels();
Kernels avx2_kernels();
Kernels avx512_kernels();
RenderUnit avx2_full_kernel();
RenderUnit avx512_full_kernel();
RenderUnit avx2_chains_kernel();
RenderUnit avx512_chains_kernel();
/// The same source over double, to see what rounding costs the others. It reads the same columns of floats and draws
/// the same random numbers, but is slow. Its name is "double"; available_kernels() does not list it.
Kernels double_kernels();

/// What this build has and this CPU runs, narrowest first ("scalar" always).
std::vector<Kernels> available_kernels();
/// The widest of them for "", else the one of that name; nothing if there is none.
std::optional<Kernels> choose_kernels(std::string_view isa);

}  // namespace tyndall
