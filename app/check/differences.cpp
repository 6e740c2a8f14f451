#include "app/check/differences.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr double max_different = 1 / 150.0;  // of the small blocks of a picture that agrees
constexpr double min_seen = 0.25;            // of a difference must be seen beside the noise of another picture

}  // namespace

bool agrees_in_blocks(const RegionDifferences& regions) {
  const Misfit small = misfit_of(regions.of_small());
  return small.different <= max_different * small.blocks;
}

bool agrees(const RegionDifferences& regions) {
  return agrees_in_blocks(regions) && misfit_of(regions.of_large()).different == 0 &&
         misfit_of(regions.of_objects()).different == 0 && misfit_of(regions.whole).different == 0;
}

double left_by(const RegionDifferences& old, const RegionDifferences& now) {
  double before = 0, after = 0;
  for (std::size_t k = 0; k < old.all.size(); ++k) {
    const BlockDifference &a = old.all[k], &b = now.all[k];
    const double error = std::max(a.error, b.error);
    if (a.pixels == 0 || std::abs(a.difference - b.difference) <= a.tolerance + 2 * error) continue;
    const double weight = a.pixels / a.tolerance;
    before += weight * std::max(0.0, std::abs(a.difference) - 2 * error);
    after += weight * std::max(0.0, std::abs(b.difference) - 2 * error);
  }
  return before > 0 ? after / before : 1;
}

double gone(const RegionDifferences& before, const RegionDifferences& after) {
  const double seen = amount_of(before.all, after.all);
  return seen > min_seen * before.amount() ? 1 - amount_of(after.all, before.all) / seen : 0;
}

bool clearly_closer(const RegionDifferences& a, const RegionDifferences& b) {
  return amount_of(a.all, b.all) < clear_improvement * amount_of(b.all, a.all);
}

double unseen_light(const RegionDifferences& regions) {
  double light = 0, unseen = 0;
  for (const BlockDifference& channel : regions.whole)
    light += channel.expected, unseen += channel.tolerance + noise_limit * channel.error;
  return light > 0 ? unseen / light : 0;
}

std::vector<ObjectDifference> different_objects(const RegionDifferences& regions) {
  std::vector<ObjectDifference> found;
  const auto objects = regions.of_objects();
  for (std::size_t k = 0; k < objects.size(); k += 3) {
    const auto channels = objects.subspan(k, 3);
    if (misfit_of(channels).different == 0) continue;
    const Vec3d expected{channels[0].expected, channels[1].expected, channels[2].expected};
    const Vec3d off{channels[0].difference, channels[1].difference, channels[2].difference};
    found.push_back({static_cast<int>(k / 3), channels[0].pixels, expected + off, expected});
  }
  const auto amount = [](const ObjectDifference& d) {
    const Vec3d off = d.image - d.expected;
    return d.pixels * (std::abs(off.x) + std::abs(off.y) + std::abs(off.z));
  };
  std::sort(found.begin(), found.end(),
            [&](const ObjectDifference& a, const ObjectDifference& b) { return amount(a) > amount(b); });
  return found;
}

}  // namespace tyndall
