#pragma once
#include "core/film/film.h"
#include "core/kernel/scene_view.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

/// The kernels as the rest of the program sees them: a table of functions for each instruction set. All tables are
/// compiled from the same source.
namespace tyndall {

/// A unit of work: samples [first, last) of the pixels of a tile.
struct Unit {
  Region tile;        ///< full-image coordinates
  int step = 1;       ///< only pixels whose x and y are multiples of step; step 1: all
  int skip_step = 0;  ///< above 0: leaves out pixels whose x and y are both multiples of it, which are done already
  std::uint32_t first = 0, last = 0;  ///< sample indices
  /// Null, or for each pixel of the tile, row by row, its own first and last (<= last) in place of those above.
  const std::uint32_t *first_of = nullptr, *last_of = nullptr;
};

struct UnitCounts {
  std::uint64_t rays = 0;         ///< all rays that were traced
  std::uint64_t shadow_rays = 0;  ///< those of them that only asked whether something is in the way
  std::uint64_t steps = 0;        ///< how often all lanes together were taken a step further
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
/// Finds the closest surface on each of `count` rays, which fill groups of lanes in the given order. brute_force: tests
/// every primitive, without the tree.
using TraceRays = void (*)(const SceneView& scene, const TraceRay* rays, TraceHit* hits, int count, bool brute_force);

/// What is seen first through the centre of a pixel: for selecting objects with the mouse and for the views.
struct FirstHit {
  std::int32_t element = -1;  ///< -1: nothing; the other values then are 0
  float depth = 0;            ///< distance along the camera's axis
  Vec3f albedo, normal;
};
/// hits: one for each pixel of the region, row by row.
using FirstHits = void (*)(const SceneView& scene, const Region& region, FirstHit* hits);

struct Kernels {
  const char* isa;  ///< name of the instruction set: "scalar", "sse4", "avx2", "avx512", "neon" or "double"
  int lanes;        ///< how many paths run together
  /// By KernelSet, for scenes that do not share second vertices, and for those that do (share.h). For a set that was
  /// not compiled the full kernel stands.
  RenderUnit render_alone[kernel_sets], render_shared[kernel_sets];
  TraceRays trace;
  FirstHits first_hits;

  /// Renders a unit of work with the kernel that the scene names (SceneView::kernel). Adds its samples to `pixels` (the
  /// tile, row by row, empty on entry) and to `counts`. emission: the same for EmissionSums; null: not recorded.
  void render_unit(const SceneView& scene, const Unit& unit, double film_unit, FilmPixel* pixels, UnitCounts& counts,
                   EmissionSums* emission = nullptr) const;

  /// The set whose kernel really runs for a scene that needs `least`: `least` itself, or `everything` for instruction
  /// sets that have the full kernel alone.
  KernelSet set_for(KernelSet least) const;
};

// Each is in a file of its own, which is compiled with that instruction set's flags. Call only what this CPU can run.
Kernels scalar_kernels();
Kernels sse4_kernels();
Kernels avx2_kernels();
Kernels avx512_kernels();
Kernels neon_kernels();
/// The same source over double, to see what rounding costs the others. It reads the same columns of floats and draws
/// the same random numbers, but is slow. Its name is "double"; available_kernels() does not list it.
Kernels double_kernels();

/// All kernels that this build has and this CPU can run, the narrowest ("scalar", which is always there) first.
std::vector<Kernels> available_kernels();
/// The kernels of that name, also "double"; for "" the widest available ones; nothing if there are none.
std::optional<Kernels> choose_kernels(std::string_view isa);

}  // namespace tyndall
