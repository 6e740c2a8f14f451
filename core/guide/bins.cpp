#include "core/compile/columns.h"
#include "core/guide/cells.h"

#include <utility>

namespace tyndall {
namespace {

constexpr double wanted_fill = 0.35;  // middle cells with landings, over landings

void set_sizes_by(double middle_size, float (&inverse_size)[guide_levels]) {
  for (int level = 0; level < guide_levels; ++level)
    inverse_size[level] = static_cast<float>(1 / std::ldexp(middle_size, 2 * (level - guide_middle_level)));
}

}  // namespace

std::uint64_t key_of(const CellCoordinates& cell) {
  const auto part = [](std::int32_t v) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v) & 0x1fffffu);
  };
  return part(cell.x) << 42 | part(cell.y) << 21 | part(cell.z);
}

void Bins::fill(const Guide& sizes, const std::vector<Landing>& landings, int level) {
  const auto cell_of = [&](std::size_t i) { return cell_at<float>(sizes, to_float(landings[i].point), level); };
  std::vector<std::pair<std::uint64_t, std::size_t>> keys;
  for (std::size_t i = 0; i < landings.size(); ++i) keys.emplace_back(key_of(cell_of(i)), i);
  std::sort(keys.begin(), keys.end());
  for (const auto& [key, i] : keys) {
    if (bins.empty() || bins.back().key != key)
      bins.push_back({key, cell_of(i), order.size(), order.size(), order.size()});
    order.push_back(i);
    ++bins.back().end;
  }
}

void Bins::put_all_sequences_first(const std::vector<std::int32_t>& numbers) {
  std::vector<const Bin*> met_in(numbers.size());  // the last bin with a landing after each sequence
  std::vector<std::size_t> others;
  for (Bin& bin : bins) {
    others.clear();
    bin.rest = bin.begin;
    for (std::size_t j = bin.begin; j < bin.end; ++j) {
      const bool met = std::exchange(met_in[static_cast<std::size_t>(numbers[order[j]])], &bin) == &bin;
      if (met)
        others.push_back(order[j]);
      else
        order[bin.rest++] = order[j];
    }
    std::copy(others.begin(), others.end(), order.begin() + static_cast<std::ptrdiff_t>(bin.rest));
  }
}

void set_sizes(const std::vector<Landing>& landings, float (&inverse_size)[guide_levels]) {
  Vec3d low = landings[0].point, high = low;
  for (const Landing& l : landings) {
    low = {std::min(low.x, l.point.x), std::min(low.y, l.point.y), std::min(low.z, l.point.z)};
    high = {std::max(high.x, l.point.x), std::max(high.y, l.point.y), std::max(high.z, l.point.z)};
  }
  const double diagonal = std::max(length(high - low), 1e-6 * landings[0].length);
  std::vector<std::uint64_t> keys(landings.size());
  Guide g;
  const auto fills_few = [&](double size) {
    set_sizes_by(size, g.inverse_size);
    for (std::size_t i = 0; i < keys.size(); ++i)
      keys[i] = key_of(cell_at<float>(g, to_float(landings[i].point), guide_middle_level));
    std::sort(keys.begin(), keys.end());
    const auto filled = static_cast<double>(std::unique(keys.begin(), keys.end()) - keys.begin());
    return filled < wanted_fill * static_cast<double>(landings.size());
  };
  constexpr double range = 512;
  double size = diagonal / range;  // too small
  for (double step = std::sqrt(range); step > 1.1; step = std::sqrt(step))
    if (!fills_few(step * size)) size *= step;
  set_sizes_by(1.1 * size, inverse_size);
}

double direct_light_at(const SceneView& s, Vec3d point, double size) {
  double sum = 0;
  for (int k = 0; k < s.lights.count(); ++k) {
    const Vec3d to_light = to_double(s.lights.center[k]) - point;
    sum += at(s.lights.power, k) * 0.25 / std::max(dot(to_light, to_light), size * size);
  }
  return std::max(sum, 1e-30);
}

}  // namespace tyndall
