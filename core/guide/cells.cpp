#include "core/guide/cells.h"

#include "core/compile/columns.h"

#include <array>
#include <map>
#include <utility>

namespace tyndall {
namespace {

constexpr int min_in_fine_cell = 4;  // landings in a cell finer than the middle level
constexpr std::size_t max_sequences_in_cell = 6;
constexpr std::size_t max_looked_at = 64;  // landings of a cell that a cell nearby looks at
constexpr double coarse_factor = 0.05;     // on the power of sequences that a cell has from the next coarser level
constexpr double neighbour_factor = 0.1;   // on the power of landings in neighbouring cells
constexpr double min_weight = 0.02;        // of a sequence, as a fraction of its cell's power
constexpr double lonely_error = 0.01;      // variance of a lobe without an image that has too few others beside it
constexpr double eagerness = 0.5;          // queries over the fraction of light that guided light brings
constexpr double min_query_probability = 0.05;
constexpr double near_offset = 0.05;  // squared distance, in cells, at which errors are about those of the lobe itself

constexpr CellCoordinates steps[] = {{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

CellCoordinates operator+(const CellCoordinates& cell, const CellCoordinates& step) {
  return {cell.x + step.x, cell.y + step.y, cell.z + step.z};
}

/// The landings around a cell after the same events.
struct Sequence {
  std::int32_t number = 0;  ///< of CellMaker::numbers_
  const Landing* first = nullptr;
  double power = 0, inverse_size2 = 0;
  std::vector<std::size_t> own, others, extra;  ///< in the cell; in its neighbours; in coarser cells
};

double squared_distance(Vec3d a, Vec3d b) { return dot(a - b, a - b); }

/// The light's direction of flight at a point, by a landing's image or wave front. Returns false where there is none.
bool predict(const Landing& l, Vec3d point, Vec3d& flight) {
  if (l.image) {
    const SeenImage<double> seen = see_image(*l.image, point);
    flight = -seen.direction;
    return seen.exists;
  }
  const Vec3d offset = point - l.point, other = cross(l.flight, l.axis);
  const double ahead = dot(offset, l.flight), p = dot(offset, l.axis), q = dot(offset, other);
  const Symmetric& b = l.curvature;
  const double spread = b.xx * b.yy - b.xy * b.xy;
  const double determinant = (1 + ahead * b.xx) * (1 + ahead * b.yy) - ahead * ahead * b.xy * b.xy;
  if (std::abs(determinant) < 1e-3) return false;
  const double xx = (b.xx + ahead * spread) / determinant, xy = b.xy / determinant,
               yy = (b.yy + ahead * spread) / determinant;
  const Vec3d v = l.flight + (xx * p + xy * q) * l.axis + (xy * p + yy * q) * other;
  flight = (1 / std::sqrt(dot(v, v))) * v;
  return true;
}

/// Turns the landing's frame to the axes of its variance. A variance that is almost the same in all directions has none
/// that can be told: rounding would decide, and a scene in other units would be another picture.
Landing along_axes(Landing l) {
  const double mean = 0.5 * (l.variance.xx + l.variance.yy), half = 0.5 * (l.variance.xx - l.variance.yy);
  const double radius = std::sqrt(half * half + l.variance.xy * l.variance.xy);
  if (!(radius > 1e-3 * mean)) {
    l.variance = {mean, 0, mean};
    return l;
  }
  const double cosine = half / radius;  // of twice the angle
  const double c = std::sqrt(std::max(0.5 * (1 + cosine), 0.0));
  const double s = std::copysign(std::sqrt(std::max(0.5 * (1 - cosine), 0.0)), l.variance.xy);
  const Vec3d other = cross(l.flight, l.axis);
  const Symmetric b = l.curvature;
  l.axis = c * l.axis + s * other;
  l.variance = {mean + radius, 0, std::max(mean - radius, 0.0)};
  l.curvature = {c * c * b.xx + 2 * c * s * b.xy + s * s * b.yy, c * s * (b.yy - b.xx) + (c * c - s * s) * b.xy,
                 s * s * b.xx - 2 * c * s * b.xy + c * c * b.yy};
  return l;
}

class CellMaker {
 public:
  CellMaker(const LightPaths& paths, Guide& guide) : paths_(paths), landings_(paths.landings), guide_(guide) {
    set_sizes(landings_, guide_.inverse_size);
    for (int level = 0; level < guide_levels; ++level) bins_[level].fill(guide_, landings_, level);
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> known;
    for (const Landing& l : landings_)
      numbers_.push_back(
          known.try_emplace({l.events.high, l.events.low}, static_cast<std::int32_t>(known.size())).first->second);
    for (Bins& bins : bins_) bins.put_all_sequences_first(numbers_);
    place_of_.assign(known.size(), nowhere);
    list_images();
  }

  void make() {
    for (int level = 0; level < guide_levels; ++level) make_level(level);
    mark_refined();
    fill_table();
  }

 private:
  struct Cell : GuideCell {
    std::uint64_t key;
    CellCoordinates at;
  };

  double size(int level) const { return 1 / static_cast<double>(guide_.inverse_size[level]); }

  /// Cells with landings and their neighbours.
  void make_level(int level) {
    std::vector<Cell>& cells = cells_[level];
    for (const Bins::Bin& bin : bins_[level].bins)
      if (level >= guide_middle_level || bin.end - bin.begin >= min_in_fine_cell)
        for (const CellCoordinates& step : steps) cells.push_back({{}, key_of(bin.at + step), bin.at + step});
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.key < b.key; });
    cells.erase(std::unique(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.key == b.key; }),
                cells.end());
    for (Cell& cell : cells) make_cell(level, cell);
  }

  Vec3d middle_of(int level, const CellCoordinates& at) const {
    const auto middle = [&](std::int32_t v) { return (static_cast<double>(v) + 0.5 - 0.37) * size(level); };
    return {middle(at.x), middle(at.y), middle(at.z)};
  }

  /// Lists the sequences of landings around a cell. If they are few, those that it lacks come from coarser levels.
  void list_sequences(int level, Vec3d middle) {
    for (std::size_t q = 0; q < count_; ++q) place_of_[static_cast<std::size_t>(sequences_[q].number)] = nowhere;
    count_ = 0;
    double factor = 1;
    for (int coarser = level; coarser < guide_levels; ++coarser, factor *= coarse_factor) {
      const std::size_t known = count_;
      if (known >= max_sequences_in_cell) break;
      const CellCoordinates home = cell_at<float>(guide_, to_float(middle), coarser);
      for (const CellCoordinates& step : steps)
        if (const Bins::Bin* bin = find_key(bins_[coarser].bins, key_of(home + step)))
          add_landings(coarser, *bin, &step == &steps[0], known, factor);
    }
  }

  /// Adds the landings of a bin to their sequences: to all of them in a cell's own level, to those that coarser levels
  /// bring from there on. known: number of sequences that finer levels have listed; of these a few landings are kept
  /// to tell how well their lobes do.
  void add_landings(int level, const Bins::Bin& bin, bool home, std::size_t known, double factor) {
    const std::vector<std::size_t>& order = bins_[level].order;
    const std::size_t stride = std::max<std::size_t>(1, (bin.end - bin.rest) / max_looked_at);
    for (std::size_t j = bin.begin, step; j < bin.end; j += step) {
      step = j < bin.rest ? 1 : stride;
      const std::int32_t number = numbers_[order[j]];
      std::size_t& q = place_of_[static_cast<std::size_t>(number)];
      if (q < known) {
        Sequence& old = sequences_[q];
        if (old.own.size() + old.others.size() < 4 && old.extra.size() < 12) old.extra.push_back(order[j]);
        continue;
      }
      const Landing& l = landings_[order[j]];
      if (q == nowhere) {
        q = count_++;
        if (q == sequences_.size()) sequences_.emplace_back();
        Sequence& fresh = sequences_[q];
        fresh.number = number, fresh.first = &l, fresh.power = 0, fresh.inverse_size2 = 1 / (size(level) * size(level));
        fresh.own.clear(), fresh.others.clear(), fresh.extra.clear();
      }
      Sequence& s = sequences_[q];
      s.power += l.weight * static_cast<double>(step) * factor * (home ? 1 : neighbour_factor);
      (home ? s.own : s.others).push_back(order[j]);
    }
  }

  void make_cell(int level, Cell& cell) {
    const Vec3d middle = middle_of(level, cell.at);
    list_sequences(level, middle);
    double total = 0, sum = 0;
    std::vector<const Sequence*> used;
    for (std::size_t q = 0; q < count_; ++q) total += sequences_[q].power, used.push_back(&sequences_[q]);
    // Those of most power are used, the greatest first; of equal ones those that were listed first.
    const auto kept = used.begin() + static_cast<std::ptrdiff_t>(std::min(count_, max_sequences_in_cell));
    std::partial_sort(used.begin(), kept, used.end(), [](const Sequence* a, const Sequence* b) {
      return a->power != b->power ? a->power > b->power : a < b;
    });
    used.erase(kept, used.end());
    for (const Sequence* s : used) sum += std::max(s->power, min_weight * total);
    cell.first = guide_.lobes();
    for (const Sequence* s : used) add_sequence(*s, middle, std::max(s->power, min_weight * total) / sum);
    cell.end = guide_.lobes();
    const double h = size(level), brought = total / paths_.paths_of_pair / (h * h);
    cell.query_probability = static_cast<float>(
        std::clamp(eagerness * brought / direct_light_at(paths_.scene, middle, h), min_query_probability, 1.0));
  }

  /// Numbers the images of lights. Landings after the same events, of the same light, have the same one.
  void list_images() {
    Column<LightImage<float>>& images = guide_.images;
    for (const Landing& l : landings_) {
      image_of_.push_back(-1);
      if (!l.image) continue;
      const LightImage<float> image{to_float(l.image->light), to_float(l.image->sphere),
                                    static_cast<float>(l.image->radius)};
      image_of_.back() = static_cast<std::int32_t>(std::find(images.begin(), images.end(), image) - images.begin());
      if (image_of_.back() == images.count()) images.push_back(image);
    }
  }

  void add_sequence(const Sequence& s, Vec3d middle, double weight) {
    const auto nearer = [&](std::size_t a, std::size_t b) {
      return squared_distance(landings_[a].point, middle) < squared_distance(landings_[b].point, middle);
    };
    const std::vector<std::size_t>& from = s.own.empty() ? s.others : s.own;
    const std::size_t nearest = *std::min_element(from.begin(), from.end(), nearer);
    const Landing lobe = along_axes(landings_[nearest]);
    guide_.lobe.push_back({to_float(lobe.point), to_float(lobe.flight), to_float(lobe.axis),
                           to_float({lobe.curvature.xx, lobe.curvature.xy, lobe.curvature.yy}),
                           static_cast<float>(lobe.variance.xx), static_cast<float>(lobe.variance.yy),
                           static_cast<float>(error_of(s, nearest)), static_cast<float>(s.inverse_size2)});
    const Landing& l = *s.first;
    const Thing& thing = paths_.things[static_cast<std::size_t>(l.next.lowest_thing())];
    const Vec3f center = thing.is_sphere ? to_float(thing.center + 0.5 * thing.motion) : Vec3f{};
    const float radius = thing.is_sphere ? static_cast<float>(thing.radius) : 0;
    guide_.sequences.push_back({l.events.low, l.events.high, l.next.low, l.next.high, l.count, image_of_[nearest],
                                static_cast<float>(weight), radius, center});
  }

  /// How well a lobe tells the directions of other landings: half of their mean squared difference, see
  /// GuideLobe::error.
  double error_of(const Sequence& s, std::size_t own) const {
    double sum = 0, weights = 0;
    int count = 0;
    const std::vector<std::size_t>* const lists[] = {&s.own, &s.others, &s.extra};
    for (int part = 0; part < 3; ++part) {
      if (part == 2 && count >= 2) break;
      const std::vector<std::size_t>& list = *lists[part];
      const std::size_t step = std::max<std::size_t>(1, list.size() / 8);
      for (std::size_t j = 0; j < list.size(); j += step) {
        const Landing& l = landings_[list[j]];
        const bool same_image = image_of_[own] >= 0 && image_of_[own] == image_of_[list[j]];
        Vec3d flight = l.flight;
        if (list[j] == own || !(same_image || predict(landings_[own], l.point, flight))) continue;
        const double far = squared_distance(l.point, landings_[own].point) * s.inverse_size2;
        if (far > 9 && part < 2) continue;
        const double weight = 1 / (near_offset + far);
        sum += weight * weight * squared_distance(flight, l.flight), weights += weight, ++count;
      }
    }
    if (count < 2) return landings_[own].image ? 0 : lonely_error;
    return 0.5 * sum / weights;
  }

  /// Marks the cells that hold finer ones.
  void mark_refined() {
    for (int level = 0; level < guide_middle_level; ++level)
      for (const Cell& fine : cells_[level])
        for (int coarser = level + 1; coarser <= guide_middle_level; ++coarser) {
          const Vec3f middle = to_float(middle_of(level, fine.at));
          if (Cell* cell = find_key(cells_[coarser], key_of(cell_at<float>(guide_, middle, coarser))))
            cell->is_refined = 1;
        }
  }

  void fill_table() {
    std::size_t count = 8, slots = 1;
    for (const std::vector<Cell>& cells : cells_) count += cells.size();
    while (slots < 2 * count) slots *= 2;
    guide_.slot_mask = static_cast<std::int32_t>(slots - 1);
    guide_.cells.resize(slots);
    for (int level = 0; level < guide_levels; ++level)
      for (const Cell& cell : cells_[level]) insert(tag_of<float>(cell.at, level), cell);
  }

  /// A cell whose tag is taken shares the other one's slot.
  void insert(std::uint32_t tag, const Cell& cell) {
    const auto name = static_cast<std::int32_t>(tag);
    auto slot = static_cast<std::int32_t>(tag >> 1) & guide_.slot_mask;
    while (guide_.cells[slot].tag != 0 && guide_.cells[slot].tag != name) slot = (slot + 1) & guide_.slot_mask;
    if (guide_.cells[slot].tag != 0) return;
    guide_.cells[slot] = cell;
    guide_.cells[slot].tag = name;
  }

  const LightPaths& paths_;
  const std::vector<Landing>& landings_;
  Guide& guide_;
  Bins bins_[guide_levels];
  std::vector<Cell> cells_[guide_levels];
  static constexpr std::size_t nowhere = ~std::size_t{0};
  std::vector<std::int32_t> numbers_;  ///< of the sequence of events, for each landing
  std::vector<Sequence> sequences_;    ///< of the present cell: the first count_ ones
  std::vector<std::size_t> place_of_;  ///< in sequences_ as they were listed, by their numbers
  std::size_t count_ = 0;
  std::vector<std::int32_t> image_of_;  ///< of each landing, in Guide::images; -1: none
};

}  // namespace

void make_cells(const LightPaths& paths, Guide& guide) { CellMaker(paths, guide).make(); }

}  // namespace tyndall
