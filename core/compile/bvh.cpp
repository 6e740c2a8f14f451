#include "core/compile/bvh.h"

#include "core/compile/bvh_binary.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace tyndall {
namespace {

/// Counts the kinds of primitives. The switch has no default, so that a kind without a case does not compile.
constexpr int count_primitive_kinds() {
  for (int count = 0;; ++count) {
    switch (static_cast<PrimitiveKind>(count)) {
      case PrimitiveKind::sphere:
      case PrimitiveKind::moving_sphere:
      case PrimitiveKind::quad:
      case PrimitiveKind::box:
        continue;
    }
    return count;
  }
}
static_assert(count_primitive_kinds() == primitive_kinds, "leaves have slots for every kind of primitive");

/// Turns the binary tree into nodes of up to eight children: as long as a node has room, the child with the largest
/// surface is replaced by its own two children.
class Widener {
 public:
  Widener(const BinaryTree& tree, Bvh& out) : tree_(tree), out_(out) {}

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
  const BinaryNode& binary(int i) const { return tree_.nodes[static_cast<std::size_t>(i)]; }

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

  int make_leaf(const BinaryNode& leaf) {
    const PrimitiveKind kind =
        out_.input[static_cast<std::size_t>(tree_.order[static_cast<std::size_t>(leaf.first)])].kind;
    auto& slots = slots_[static_cast<std::size_t>(kind)];
    out_.leaves.push_back({slots, static_cast<std::int16_t>(leaf.count), kind});
    slots += leaf.count;
    for (int k = leaf.first; k < leaf.first + leaf.count; ++k)
      out_.order.push_back(tree_.order[static_cast<std::size_t>(k)]);
    return static_cast<int>(out_.leaves.size()) - 1;
  }

  static void set_bounds(BvhNode& node, std::size_t c, const Bounds& b) {
    node.low[0][c] = b.low.x, node.low[1][c] = b.low.y, node.low[2][c] = b.low.z;
    node.high[0][c] = b.high.x, node.high[1][c] = b.high.y, node.high[2][c] = b.high.z;
  }

  const BinaryTree& tree_;
  Bvh& out_;
  std::array<std::int32_t, primitive_kinds> slots_{};
};

}  // namespace

Bvh build_bvh(std::vector<BvhInput> input) {
  assert(!input.empty() && input.size() <= bvh_most_primitives);
  Bvh bvh;
  bvh.input = std::move(input);
  const BinaryTree tree = build_binary_tree(bvh.input);
  Widener(tree, bvh).run();
  return bvh;
}

}  // namespace tyndall
