#pragma once
#include "core/film/film.h"
#include "core/trace/tile_job.h"

#include <optional>
#include <string_view>
#include <vector>

/// The kernels as the rest of the program sees them: a table of functions for each instruction set. All tables are
/// compiled from the same source.
namespace tyndall {

using RenderTile = void (*)(const SceneView& scene, const TileJob& job, double film_quantum, FilmPixel* pixels,
                            EmissionSums* emission, TileCounts& counts);

/// Finds the closest surface on each of `count` rays, which fill groups of lanes in the given order. brute_force: tests
/// every primitive, without the tree.
using TraceRays = void (*)(const SceneView& scene, const TraceRay* rays, TraceHit* hits, int count, bool brute_force);

/// Finds what is seen first through the centre of each pixel. hits: one for each pixel of the region, row by row.
using FirstHits = void (*)(const SceneView& scene, const Region& region, FirstHit* hits);

struct Kernels {
  const char* isa;  ///< name of the instruction set: "scalar", "sse4", "avx2", "avx512", "neon" or "double"
  int lanes;        ///< number of paths that run together
  /// By KernelSet: for scenes without, and with, reuse of second vertices (reuse.h). A set that was not compiled has
  /// the full kernel.
  RenderTile render_alone[kernel_sets], render_reusing[kernel_sets];
  TraceRays trace;
  FirstHits first_hits;

  /// Renders a tile job with the kernel that SceneView::kernel names. Adds its samples to `pixels` (the tile, row by
  /// row, empty on entry) and to `counts`. emission: the same for EmissionSums; null: not recorded.
  void render_tile(const SceneView& scene, const TileJob& job, double film_quantum, FilmPixel* pixels,
                   TileCounts& counts, EmissionSums* emission = nullptr) const;

  /// The set whose kernel runs for a scene that needs `minimum`: `minimum` itself, or `everything` for instruction sets
  /// that have the full kernel only.
  KernelSet set_for(KernelSet minimum) const;
};

// Each is in its own file, which is compiled with the flags of that instruction set. Call only what this CPU can run.
Kernels scalar_kernels();
Kernels sse4_kernels();
Kernels avx2_kernels();
Kernels avx512_kernels();
Kernels neon_kernels();
// The tables of two of them before with_kernel_sets(), in files of their own: compilers work on both at once.
Kernels avx2_full_kernel();
Kernels avx512_full_kernel();
/// The same source over double, to see what rounding costs the other kernels. It reads the same columns of floats and
/// draws the same random numbers, but is slow. Its name is "double"; available_kernels() does not list it.
Kernels double_kernels();

/// All kernels that this build has and this CPU can run, the narrowest ("scalar", which is always there) first.
std::vector<Kernels> available_kernels();
/// The kernels of that name, "double" included; for "" the widest available ones; nothing for an unknown name.
std::optional<Kernels> choose_kernels(std::string_view isa);

}  // namespace tyndall
