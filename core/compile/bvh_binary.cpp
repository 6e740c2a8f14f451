#include "core/compile/bvh.h"

#include <algorithm>
#include <array>
#include <future>
#include <limits>
#include <span>

namespace tyndall {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr Bounds nothing{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
constexpr int bins = 16;
constexpr std::size_t max_in_leaf = 8;
constexpr int deepest_heuristic = 48;  // below this depth ranges are halved, so that the traversal's stack is bounded

/// Returns the time to visit a node over the time to test a primitive. Values of 3 to 6 were about equally good for
/// spheres, 1.3 to 2 for boxes.
float traversal_cost(PrimitiveKind kind) { return kind == PrimitiveKind::box ? 1.5f : 4.0f; }

float component(const Vec3f& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Bounds join(const Bounds& a, const Bounds& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

Vec3f centroid(const Bounds& b) {
  return {0.5f * b.low.x + 0.5f * b.high.x, 0.5f * b.low.y + 0.5f * b.high.y, 0.5f * b.low.z + 0.5f * b.high.z};
}

/// An input and its index in the list. The builder reorders the items themselves, so that each range is contiguous in
/// memory.
struct Item {
  BvhInput input;
  int index;
};

/// The boxes around a range of items and around their centroids.
struct Around {
  Bounds bounds = nothing, centers = nothing;
};

/// The items along an axis: for each bin the number of items whose centroid is in it, and the box around these items
/// (undefined if the bin is empty).
struct Bins {
  std::array<Bounds, bins> boxes;
  std::array<int, bins> counts{};
};

/// A plane between two bins.
struct Plane {
  int axis = -1, bin = 0;
  float cost = infinity;
};

class Builder {
 public:
  explicit Builder(const Column<BvhInput>& input) {
    items_.reserve(input.size());
    for (const BvhInput& one : input) items_.push_back({one, static_cast<int>(items_.size())});
    scratch_ = items_;
  }
  BinaryTree build() {
    BinaryTree tree{build_alone({0, static_cast<int>(items_.size()), 0}), {}};
    tree.order.reserve(items_.size());
    for (const Item& item : items_) tree.order.push_back(item.index);
    return tree;
  }

 private:
  struct Range {
    int begin, end, depth;
    std::size_t size() const { return static_cast<std::size_t>(end - begin); }
  };

  std::vector<BinaryNode> build_alone(Range range) {
    std::vector<BinaryNode> nodes;
    nodes.reserve(range.size());  // as many nodes as a range usually needs
    build(range, nodes);
    return nodes;
  }

  /// Appends the subtree over a range: its root, then the left half, then the right half. Halves of large ranges are
  /// built in parallel. The recursion is at most as deep as the tree, which deepest_heuristic bounds.
  void build(Range range, std::vector<BinaryNode>& nodes) {
    constexpr std::size_t min_for_thread = 1 << 13;
    constexpr int deepest_thread = 4;
    const std::span<Item> list = std::span(items_).subspan(static_cast<std::size_t>(range.begin), range.size());
    const Around around = around_of(list);
    const int in_left = choose(list, around, range.depth);
    const std::size_t self = nodes.size();
    BinaryNode& node = nodes.emplace_back(BinaryNode{around.bounds});
    if (in_left == 0) {
      node.first = range.begin, node.count = range.end - range.begin;
      return;
    }
    node.left = static_cast<int>(self) + 1;
    const Range left{range.begin, range.begin + in_left, range.depth + 1}, right{left.end, range.end, left.depth};
    std::future<std::vector<BinaryNode>> others;
    // No launch policy: if the system cannot start another thread, get() runs the job here.
    if (range.size() >= min_for_thread && range.depth < deepest_thread)
      others = std::async([this, right] { return build_alone(right); });
    build(left, nodes);
    const int first = static_cast<int>(nodes.size());
    nodes[self].right = first;
    if (!others.valid()) return build(right, nodes);
    for (BinaryNode other : others.get()) {
      if (other.left >= 0) other.left += first, other.right += first;
      nodes.push_back(other);
    }
  }

  static Around around_of(std::span<const Item> list) {
    Around around;
    for (const Item& item : list) {
      const Vec3f c = centroid(item.input.bounds);
      around.bounds = join(around.bounds, item.input.bounds);
      around.centers = join(around.centers, {c, c});
    }
    return around;
  }

  /// Reorders the list for the best split and returns how many items are in its first part; 0: make a leaf.
  int choose(std::span<Item> list, const Around& around, int depth) {
    if (list.size() == 1) return 0;
    const Plane plane = best_plane(list, around.centers);
    const PrimitiveKind kind = list.front().input.kind;
    const bool fits = list.size() <= max_in_leaf && std::all_of(list.begin(), list.end(), [kind](const Item& item) {
                        return item.input.kind == kind;
                      });
    const float leaf_cost = static_cast<float>(list.size()) * half_area(around.bounds);
    const float node_cost = traversal_cost(kind) * half_area(around.bounds);
    if (fits && !(plane.cost + node_cost < leaf_cost)) return 0;
    if (plane.axis < 0 || depth > deepest_heuristic) return split_equals(list);
    return part(list, [&](const BvhInput& one) {
      return bin_of(centroid(one.bounds), around.centers, plane.axis) < plane.bin;
    });
  }

  /// For primitives whose centroids are all the same: separates kinds first, then splits in the middle of the list.
  int split_equals(std::span<Item> list) {
    const PrimitiveKind kind = list.front().input.kind;
    const int by_kind = part(list, [kind](const BvhInput& one) { return one.kind == kind; });
    const int count = static_cast<int>(list.size());
    return by_kind < count ? by_kind : count / 2;
  }

  /// Moves the items for which `first` is true to the front, in their order, and returns their number.
  int part(std::span<Item> list, auto first) {
    const auto others = scratch_.begin() + (list.data() - items_.data());
    auto end_of_others = others;
    auto middle = list.begin();
    for (const Item& item : list)
      if (first(item.input))
        *middle++ = item;
      else
        *end_of_others++ = item;
    std::copy(others, end_of_others, middle);
    return static_cast<int>(middle - list.begin());
  }

  static int bin_of(const Vec3f& c, const Bounds& centers, int axis) {
    const float low = component(centers.low, axis), extent = component(centers.high, axis) - low;
    const int bin = static_cast<int>(static_cast<float>(bins) * ((component(c, axis) - low) / extent));
    return std::clamp(bin, 0, bins - 1);
  }

  static Plane best_plane(std::span<const Item> list, const Bounds& centers) {
    std::array<Bins, 3> all;
    std::array<bool, 3> wide;
    for (int axis = 0; axis < 3; ++axis)
      wide[static_cast<std::size_t>(axis)] = component(centers.high, axis) > component(centers.low, axis);
    for (const Item& item : list) {
      const Vec3f c = centroid(item.input.bounds);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!wide[axis]) continue;
        const auto b = static_cast<std::size_t>(bin_of(c, centers, static_cast<int>(axis)));
        Bounds& box = all[axis].boxes[b];
        box = all[axis].counts[b]++ ? join(box, item.input.bounds) : item.input.bounds;
      }
    }
    Plane best;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (wide[axis]) sweep(all[axis], static_cast<int>(axis), best);
    return best;
  }

  /// Skips empty bins, which most ranges have, as they are short: a plane behind an empty bin parts the items like the
  /// plane before it.
  static void sweep(const Bins& all, int axis, Plane& best) {
    std::array<float, bins> right_cost;
    float cost_so_far = infinity;
    Bounds right = nothing;
    int right_count = 0;
    for (std::size_t b = bins - 1; b > 0; --b) {
      if (all.counts[b] > 0) {
        right = join(right, all.boxes[b]);
        right_count += all.counts[b];
        cost_so_far = static_cast<float>(right_count) * half_area(right);
      }
      right_cost[b] = cost_so_far;
    }
    Bounds left = nothing;
    int left_count = 0;
    for (std::size_t b = 1; b < bins; ++b) {
      if (all.counts[b - 1] == 0) continue;
      left = join(left, all.boxes[b - 1]);
      left_count += all.counts[b - 1];
      const float cost = static_cast<float>(left_count) * half_area(left) + right_cost[b];
      if (cost < best.cost) best = {axis, static_cast<int>(b), cost};
    }
  }

  std::vector<Item> items_;
  std::vector<Item> scratch_;  // as long; each range of items has its own part of it
};

}  // namespace

float half_area(const Bounds& b) {
  const Vec3f d = b.high - b.low;
  if (!(d.x >= 0)) return 0;
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

BinaryTree build_binary_tree(const Column<BvhInput>& input) { return Builder(input).build(); }

}  // namespace tyndall
