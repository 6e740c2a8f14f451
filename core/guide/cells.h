#pragma once
#include "core/guide/light_paths.h"
#include "core/guide/lobes.h"

/// Sorts the landings of light paths into cells, and makes lobes of them.
namespace tyndall {

using CellCoordinates = CellPlace<float>;

/// The number by which cells are sorted.
std::uint64_t key_of(const CellCoordinates& cell);

/// The item of that key in a list that is sorted by keys; null: there is none.
template <class List>
auto find_key(List& list, std::uint64_t key) {
  const auto at = std::lower_bound(list.begin(), list.end(), key,
                                   [](const auto& item, std::uint64_t wanted) { return item.key < wanted; });
  return at != list.end() && at->key == key ? &*at : nullptr;
}

/// The landings of each cell of one level.
struct Bins {
  struct Bin {
    std::uint64_t key;
    CellCoordinates at;
    std::size_t begin, end;  ///< in `order`
    std::size_t rest;        ///< see put_all_sequences_first()
  };
  void fill(const Guide& sizes, const std::vector<Landing>& landings, int level);
  /// Reorders each bin: from begin to rest one landing after each sequence of events that has landed there, then the
  /// others. numbers: of the sequence of each landing, counted from 0.
  void put_all_sequences_first(const std::vector<std::int32_t>& numbers);

  std::vector<Bin> bins;  ///< sorted by keys
  std::vector<std::size_t> order;
};

/// Sets Guide::inverse_size such that landings fill about a third as many cells of the middle
/// level as there are landings.
void set_sizes(const std::vector<Landing>& landings, float (&inverse_size)[guide_levels]);

/// Irradiance at a point, roughly, from all lights as if nothing were in the way. size: the least distance that counts.
double direct_light_at(const SceneView& s, Vec3d point, double size);

/// Fills in the guide's cells and lobes.
void make_cells(const LightPaths& paths, Guide& guide);

}  // namespace tyndall
