#include "core/compile/bvh_binary.h"

#include <algorithm>
#include <array>
#include <future>
#include <limits>
#include <numeric>
#include <utility>

namespace tyndall {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr Bounds nothing{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
constexpr int bins = 16;
constexpr int most_in_leaf = 8;
constexpr float traversal_cost = 4.0f;  // time for a node over that for a primitive's test; 3 to 6 were found as good
constexpr int deepest_heuristic = 48;   // below this depth ranges are halved, so that the traversal's stack is bounded

float component(const Vec3f& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Bounds join(const Bounds& a, const Bounds& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

Vec3f centroid(const Bounds& b) {
  return {0.5f * b.low.x + 0.5f * b.high.x, 0.5f * b.low.y + 0.5f * b.high.y, 0.5f * b.low.z + 0.5f * b.high.z};
}

/// A plane between two bins.
struct Plane {
  int axis = -1, bin = 0;
  float cost = infinity;
};

class Builder {
 public:
  explicit Builder(const std::vector<BvhInput>& input) : input_(input), order_(input.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    nodes_ = build({0, static_cast<int>(input.size()), 0});
  }
  BinaryTree take() { return {std::move(nodes_), std::move(order_)}; }

 private:
  struct Range {
    int begin, end, depth;
  };

  const BvhInput& at(int k) const { return input_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])]; }

  /// The subtree over a range: its root, then the left and the right half. Halves of large ranges are built at once.
  std::vector<BinaryNode> build(Range range) {
    constexpr int least_for_thread = 1 << 13, deepest_thread = 4;
    if (range.end - range.begin < least_for_thread || range.depth >= deepest_thread) return build_alone(range);
    const Split at = split(range);
    std::vector<BinaryNode> nodes{at.node};
    if (at.middle < 0) return nodes;
    // No launch policy: if the system has no further thread, the job runs here when its result is asked for.
    auto right = std::async([this, range, at] { return build({at.middle, range.end, range.depth + 1}); });
    nodes[0].left = 1;
    append(nodes, build({range.begin, at.middle, range.depth + 1}));
    nodes[0].right = static_cast<int>(nodes.size());
    append(nodes, right.get());
    return nodes;
  }

  static void append(std::vector<BinaryNode>& nodes, const std::vector<BinaryNode>& more) {
    const int first = static_cast<int>(nodes.size());
    for (BinaryNode node : more) {
      if (node.left >= 0) node.left += first, node.right += first;
      nodes.push_back(node);
    }
  }

  /// Without recursion, because a degenerate scene could be so deep that the stack overflows.
  std::vector<BinaryNode> build_alone(Range whole) {
    struct Task {
      Range range;
      int parent;
      bool right;
    };
    std::vector<BinaryNode> nodes;
    std::vector<Task> tasks{{whole, -1, false}};
    while (!tasks.empty()) {
      const auto [range, parent, is_right] = tasks.back();
      tasks.pop_back();
      const int self = static_cast<int>(nodes.size());
      if (parent >= 0)
        (is_right ? nodes[static_cast<std::size_t>(parent)].right : nodes[static_cast<std::size_t>(parent)].left) =
            self;
      const Split at = split(range);
      nodes.push_back(at.node);
      if (at.middle < 0) continue;
      tasks.push_back({{at.middle, range.end, range.depth + 1}, self, true});
      tasks.push_back({{range.begin, at.middle, range.depth + 1}, self, false});
    }
    return nodes;
  }

  /// The node of a range, and where the range is split; -1: it becomes a leaf.
  struct Split {
    BinaryNode node;
    int middle;
  };
  Split split(Range range) {
    BinaryNode node;
    node.bounds = nothing;
    for (int k = range.begin; k < range.end; ++k) node.bounds = join(node.bounds, at(k).bounds);
    const int middle = choose(range.begin, range.end, node.bounds, range.depth);
    if (middle < 0) node.first = range.begin, node.count = range.end - range.begin;
    return {node, middle};
  }

  bool one_kind(int begin, int end) const {
    for (int k = begin + 1; k < end; ++k)
      if (at(k).kind != at(begin).kind) return false;
    return true;
  }

  /// Reorders the range for the best split and returns its middle; -1: make a leaf.
  int choose(int begin, int end, const Bounds& bounds, int depth) {
    const int count = end - begin;
    if (count == 1) return -1;
    Bounds centers = nothing;
    for (int k = begin; k < end; ++k) {
      const Vec3f c = centroid(at(k).bounds);
      centers = join(centers, {c, c});
    }
    const Plane plane = best_plane(begin, end, centers);
    const bool fits = count <= most_in_leaf && one_kind(begin, end);
    const float leaf_cost = static_cast<float>(count) * half_area(bounds);
    if (fits && !(plane.cost + traversal_cost * half_area(bounds) < leaf_cost)) return -1;
    if (plane.axis < 0 || depth > deepest_heuristic) return split_equals(begin, end);
    const auto from = order_.begin() + begin, to = order_.begin() + end;
    const auto middle = std::stable_partition(from, to, [&](int i) {
      return bin_of(centroid(input_[static_cast<std::size_t>(i)].bounds), centers, plane.axis) < plane.bin;
    });
    return static_cast<int>(middle - order_.begin());
  }

  /// For primitives whose centroids are all the same: separates kinds first, then splits in the middle of the list.
  int split_equals(int begin, int end) {
    const auto from = order_.begin() + begin, to = order_.begin() + end;
    const PrimitiveKind kind = at(begin).kind;
    const auto middle =
        std::stable_partition(from, to, [&](int i) { return input_[static_cast<std::size_t>(i)].kind == kind; });
    const int by_kind = static_cast<int>(middle - order_.begin());
    return by_kind < end ? by_kind : begin + (end - begin) / 2;
  }

  static int bin_of(const Vec3f& c, const Bounds& centers, int axis) {
    const float low = component(centers.low, axis), extent = component(centers.high, axis) - low;
    const int bin = static_cast<int>(static_cast<float>(bins) * ((component(c, axis) - low) / extent));
    return std::clamp(bin, 0, bins - 1);
  }

  Plane best_plane(int begin, int end, const Bounds& centers) const {
    Plane best;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(component(centers.high, axis) > component(centers.low, axis))) continue;
      std::array<Bounds, bins> boxes;
      boxes.fill(nothing);
      std::array<int, bins> counts{};
      for (int k = begin; k < end; ++k) {
        const auto b = static_cast<std::size_t>(bin_of(centroid(at(k).bounds), centers, axis));
        boxes[b] = join(boxes[b], at(k).bounds);
        ++counts[b];
      }
      sweep(boxes, counts, axis, best);
    }
    return best;
  }

  static void sweep(const std::array<Bounds, bins>& boxes, const std::array<int, bins>& counts, int axis, Plane& best) {
    std::array<float, bins> right_cost{};
    Bounds right = nothing;
    int right_count = 0;
    for (std::size_t b = bins - 1; b > 0; --b) {
      right = join(right, boxes[b]);
      right_count += counts[b];
      right_cost[b] = right_count ? static_cast<float>(right_count) * half_area(right) : infinity;
    }
    Bounds left = nothing;
    int left_count = 0;
    for (std::size_t b = 1; b < bins; ++b) {
      left = join(left, boxes[b - 1]);
      left_count += counts[b - 1];
      const float cost = left_count ? static_cast<float>(left_count) * half_area(left) + right_cost[b] : infinity;
      if (cost < best.cost) best = {axis, static_cast<int>(b), cost};
    }
  }

  const std::vector<BvhInput>& input_;
  std::vector<int> order_;
  std::vector<BinaryNode> nodes_;
};

}  // namespace

float half_area(const Bounds& b) {
  const Vec3f d = b.high - b.low;
  if (!(d.x >= 0)) return 0;
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

BinaryTree build_binary_tree(const std::vector<BvhInput>& input) { return Builder(input).take(); }

}  // namespace tyndall
