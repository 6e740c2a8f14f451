#pragma once
#include "app/check/objects.h"
#include "app/check/statistics.h"

#include <span>
#include <vector>

/// How a picture as a whole differs from what is expected, and whether that is more than noise.
namespace tyndall {

/// How the means of a picture differ from what is expected, in small blocks, in large ones, and by object: three of
/// each region; and over the whole picture.
struct RegionDifferences {
  std::vector<BlockDifference> all, whole;
  std::size_t small = 0, large = 0;  ///< how many of them are of small and of large blocks, which come first
  std::span<const BlockDifference> of_small() const { return {all.data(), small}; }
  std::span<const BlockDifference> of_large() const { return {all.data() + small, large}; }
  std::span<const BlockDifference> of_objects() const { return std::span(all).subspan(small + large); }
  double amount() const { return amount_of(all, all); }
};

/// Whether the small blocks differ by noise alone. The noise of few samples is no normal distribution: so now and then
/// one of them is beyond noise_limit.
bool agrees_in_blocks(const RegionDifferences& regions);
/// Whether all of it does.
bool agrees(const RegionDifferences& regions);

/// How much of the difference is left with `now` in place of `old`, as far as the two differ at all.
double left_by(const RegionDifferences& old, const RegionDifferences& now);
/// How much of a difference is gone; nothing, if `after` is so noisy that little of it could be seen beside its noise.
double gone(const RegionDifferences& before, const RegionDifferences& after);
/// Whether clearly less is left of a difference, where both have the same noise.
bool clearly_closer(const RegionDifferences& a, const RegionDifferences& b);
inline constexpr double clear_improvement = 0.7;  ///< of a difference is left where it has become clearly less

/// Fraction of the light by which the whole may be off without that it is seen.
double unseen_light(const RegionDifferences& regions);

/// The objects that differ, those with the largest difference first.
std::vector<ObjectDifference> different_objects(const RegionDifferences& regions);

}  // namespace tyndall
