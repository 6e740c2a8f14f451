#pragma once
#include "core/base/target.h"
#include "core/film/film.h"
#include "core/trace/tile_job.h"

#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

/// The kernels as the rest of the program sees them: a table of functions for each instruction set. All tables are
/// compiled from the same source.
namespace tyndall {

struct ReusedPaths;

using RenderTile = void (*)(const SceneView& scene, const TileJob& job, double film_quantum, FilmPixel* pixels,
                            EmissionSums* emission, TileCounts& counts);

/// Finds the closest surface on each of `count` rays, which fill groups of lanes in the given order. brute_force: tests
/// every primitive, without the tree.
using TraceRays = void (*)(const SceneView& scene, const TraceRay* rays, TraceHit* hits, int count, bool brute_force);

/// Finds what is seen first through the centre of each pixel. hits: one for each pixel of the region, row by row.
using FirstHits = void (*)(const SceneView& scene, const Region& region, FirstHit* hits);

struct Kernels {
  const char* isa;                 ///< name of the instruction set, such as "avx2": see Target
  int lanes;                       ///< number of paths that run together
  RenderTile render[kernel_sets];  ///< by KernelSet; a set that was not compiled has the full kernel
  TraceRays trace;
  FirstHits first_hits;

  /// Renders a tile job with the kernel of set_for(). Adds its samples to `pixels` (the tile, row by
  /// row, empty on entry) and to `counts`. emission: the same for EmissionSums; null: not recorded.
  void render_tile(const SceneView& scene, const TileJob& job, double film_quantum, FilmPixel* pixels,
                   TileCounts& counts, EmissionSums* emission = nullptr) const;

  /// The set whose kernel renders a scene: SceneView::kernel, or `everything` for instruction sets that have the full
  /// kernel only, and for scenes that reuse paths where that set has no loop for it.
  KernelSet set_for(const SceneView& scene) const;
};

Kernels scalar_kernels();
/// Follows the paths of groups with the scalar kernel, for probe_reuse(). scene: one with reuses_paths set.
void trace_groups(const SceneView& scene, ReusedPaths& paths, TileCounts& counts);

// Each is compiled with the flags of its instruction set. Call only what this build has and this CPU can run.
template <Target target>
using TargetIs = std::integral_constant<Target, target>;
/// The kernel with every model, for all KernelSets.
Kernels full_kernel(TargetIs<Target::sse4>);
Kernels full_kernel(TargetIs<Target::avx2>);
Kernels full_kernel(TargetIs<Target::avx512>);
Kernels full_kernel(TargetIs<Target::neon>);
Kernels full_kernel(TargetIs<Target::wasm>);
/// Gives the table of the full kernel a kernel of its own for each other KernelSet. Targets of 8 lanes and more have
/// them.
void add_kernel_sets(TargetIs<Target::avx2>, Kernels& kernels);
void add_kernel_sets(TargetIs<Target::avx512>, Kernels& kernels);

/// All kernels that this build has and this CPU can run, the narrowest ("scalar", which is always there) first.
std::vector<Kernels> available_kernels();
/// The kernels of that name; for "" the widest available ones; nothing where find_target() finds none.
std::optional<Kernels> choose_kernels(std::string_view isa);

}  // namespace tyndall
