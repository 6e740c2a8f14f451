#pragma once
#include "core/compile/columns.h"
#include "core/guide/light_paths.h"
#include "core/trace/guide.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/// Sorts the landings of light paths by cells.
namespace tyndall {

/// A cell's coordinates, sorted by their key.
struct Coordinates {
  std::int32_t x = 0, y = 0, z = 0;
  std::uint64_t key() const {
    const auto part = [](std::int32_t v) {
      return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v) & 0x1fffffu);
    };
    return part(x) << 42 | part(y) << 21 | part(z);
  }
  Coordinates stepped(const std::int32_t (&step)[3]) const { return {x + step[0], y + step[1], z + step[2]}; }
};

/// Coordinates of the cell in which a point is; only the guide's sizes are used.
Coordinates coordinates_of(const Guide& g, Vec3d point, int level);

/// The landings of each cell of one level.
class Bins {
 public:
  struct Bin {
    std::uint64_t key;
    Coordinates at;
    std::size_t begin, end;  ///< in `order`
    std::size_t rest;        ///< see put_all_sequences_first()
  };
  void fill(const Guide& g, const std::vector<Landing>& landings, int level);
  /// Reorders each bin: from begin to rest one landing after each sequence of events that has landed there, then the
  /// others. numbers: of the sequence of each landing, counted from 0.
  void put_all_sequences_first(const std::vector<std::int32_t>& numbers);
  const Bin* find(const Coordinates& c) const;  ///< null: nothing has landed there

  std::vector<Bin> bins;
  std::vector<std::size_t> order;
};

/// Sets Guide::inverse_size, or that of a Guide.
void set_sizes(double middle_size, float (&inverse_size)[guide_levels]);

/// The size of middle cells: such that landings fill about a third as many cells as there are landings.
double middle_size(const std::vector<Landing>& landings);

/// Irradiance at a point, roughly, from all lights as if nothing were in the way. size: the least distance that counts.
double direct_light_at(const SceneView& s, Vec3d point, double size);

}  // namespace tyndall
