#include "core/compile/bvh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <numeric>

namespace tyndall {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr Bounds nothing{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
constexpr int bins = 16;
constexpr int most_in_leaf = 8;
constexpr float traversal_cost = 4.0f;  // of a binary step, in units of one primitive's test: measured, flat from 3 to 6
constexpr int deepest_heuristic = 48;   // below this depth ranges are halved, which bounds the traversal's stack

float component(const Vec3f& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Bounds join(const Bounds& a, const Bounds& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

float half_area(const Bounds& b) {
  const Vec3f d = b.high - b.low;
  if (!(d.x >= 0)) return 0;
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

Vec3f centroid(const Bounds& b) {
  return {0.5f * b.low.x + 0.5f * b.high.x, 0.5f * b.low.y + 0.5f * b.high.y, 0.5f * b.low.z + 0.5f * b.high.z};
}

/// A node of the binary tree that is then widened.
struct Binary {
  Bounds bounds;
  int left = -1, right = -1;  // children, or
  int first = 0, count = 0;   // a leaf's range in the order
};

struct Split {
  int axis = -1, bin = 0;
  float cost = infinity;
};

class Builder {
 public:
  explicit Builder(const std::vector<BvhInput>& input) : input_(input), order_(input.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    nodes_.reserve(2 * input.size());
    split_range(0, static_cast<int>(input.size()));
  }
  const std::vector<Binary>& nodes() const { return nodes_; }
  const std::vector<int>& order() const { return order_; }

 private:
  const BvhInput& at(int k) const { return input_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])]; }

  /// Makes the subtree over a range without recursion: a degenerate scene must not exhaust the stack.
  void split_range(int begin, int end) {
    struct Task {
      int begin, end, parent, depth;
      bool right;
    };
    std::vector<Task> tasks{{begin, end, -1, 0, false}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      const int self = static_cast<int>(nodes_.size());
      nodes_.push_back({});
      if (task.parent >= 0)
        (task.right ? nodes_[static_cast<std::size_t>(task.parent)].right
                    : nodes_[static_cast<std::size_t>(task.parent)].left) = self;
      Binary node;
      node.bounds = nothing;
      for (int k = task.begin; k < task.end; ++k) node.bounds = join(node.bounds, at(k).bounds);
      const int middle = choose(task.begin, task.end, node.bounds, task.depth);
      if (middle < 0) {
        node.first = task.begin;
        node.count = task.end - task.begin;
      } else {
        tasks.push_back({middle, task.end, self, task.depth + 1, true});
        tasks.push_back({task.begin, middle, self, task.depth + 1, false});
      }
      nodes_[static_cast<std::size_t>(self)] = node;
    }
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
    const Split split = best_split(begin, end, centers);
    const bool fits = count <= most_in_leaf && one_kind(begin, end);
    const float leaf_cost = static_cast<float>(count) * half_area(bounds);
    if (fits && !(split.cost + traversal_cost * half_area(bounds) < leaf_cost)) return -1;
    if (split.axis < 0 || depth > deepest_heuristic) return split_equals(begin, end);
    const auto from = order_.begin() + begin, to = order_.begin() + end;
    const auto middle = std::stable_partition(from, to, [&](int i) {
      return bin_of(centroid(input_[static_cast<std::size_t>(i)].bounds), centers, split.axis) < split.bin;
    });
    return static_cast<int>(middle - order_.begin());
  }

  /// All centroids are the same: by kind first, then in the middle of the list.
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

  Split best_split(int begin, int end, const Bounds& centers) const {
    Split best;
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

  static void sweep(const std::array<Bounds, bins>& boxes, const std::array<int, bins>& counts, int axis, Split& best) {
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
  std::vector<Binary> nodes_;
};

/// Turns the binary tree into nodes of up to eight children by opening the child of largest surface first.
class Widener {
 public:
  Widener(const Builder& builder, Bvh& out) : builder_(builder), out_(out) {}

  void run() {
    struct Task {
      int binary, node, depth;
    };
    out_.nodes.emplace_back();
    std::vector<Task> tasks{{0, 0, 1}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      out_.depth = std::max(out_.depth, task.depth);
      const std::vector<int> children = open(task.binary);
      BvhNode node{};
      node.count = static_cast<std::int32_t>(children.size());
      for (std::size_t c = 0; c < children.size(); ++c) {
        set_bounds(node, c, binary(children[c]).bounds);
        if (binary(children[c]).left < 0) {
          node.child[c] = ~make_leaf(binary(children[c]));
        } else {
          node.child[c] = static_cast<std::int32_t>(out_.nodes.size());
          out_.nodes.emplace_back();
          tasks.push_back({children[c], node.child[c], task.depth + 1});
        }
      }
      out_.nodes[static_cast<std::size_t>(task.node)] = node;
    }
  }

 private:
  const Binary& binary(int i) const { return builder_.nodes()[static_cast<std::size_t>(i)]; }

  std::vector<int> open(int root) const {
    std::vector<int> children;
    if (binary(root).left < 0) return {root};
    children = {binary(root).left, binary(root).right};
    while (children.size() < bvh_width) {
      int largest = -1;
      for (std::size_t c = 0; c < children.size(); ++c)
        if (binary(children[c]).left >= 0 &&
            (largest < 0 || half_area(binary(children[c]).bounds) >
                                half_area(binary(children[static_cast<std::size_t>(largest)]).bounds)))
          largest = static_cast<int>(c);
      if (largest < 0) break;
      const int opened = children[static_cast<std::size_t>(largest)];
      children[static_cast<std::size_t>(largest)] = binary(opened).left;
      children.push_back(binary(opened).right);
    }
    return children;
  }

  int make_leaf(const Binary& leaf) {
    const PrimitiveKind kind =
        out_.input[static_cast<std::size_t>(builder_.order()[static_cast<std::size_t>(leaf.first)])].kind;
    auto& slots = slots_[static_cast<std::size_t>(kind)];
    out_.leaves.push_back({slots, static_cast<std::int16_t>(leaf.count), kind});
    slots += leaf.count;
    for (int k = leaf.first; k < leaf.first + leaf.count; ++k)
      out_.order.push_back(builder_.order()[static_cast<std::size_t>(k)]);
    return static_cast<int>(out_.leaves.size()) - 1;
  }

  static void set_bounds(BvhNode& node, std::size_t c, const Bounds& b) {
    node.low[0][c] = b.low.x, node.low[1][c] = b.low.y, node.low[2][c] = b.low.z;
    node.high[0][c] = b.high.x, node.high[1][c] = b.high.y, node.high[2][c] = b.high.z;
  }

  const Builder& builder_;
  Bvh& out_;
  std::array<std::int32_t, 4> slots_{};
};

}  // namespace

Bvh build_bvh(std::vector<BvhInput> input) {
  assert(!input.empty() && input.size() <= bvh_most_primitives);
  Bvh bvh;
  bvh.input = std::move(input);
  const Builder builder(bvh.input);
  Widener(builder, bvh).run();
  return bvh;
}

}  // namespace tyndall
