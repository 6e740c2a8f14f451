#include "core/compile/bvh.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace tyndall {
namespace {

/// Converts the binary tree to nodes of up to eight children, with the lowest cost by the surface area heuristic: all
/// possibilities to fill nodes are weighed, from the leaves up. H. Ylitie, T. Karras, S. Laine, Efficient Incoherent
/// Ray Traversal on GPUs Through Compressed Wide BVHs, HPG 2017; here each child of a node has a cost, too.
class Widener {
 public:
  Widener(const BinaryTree& tree, Bvh& out) : tree_(tree), out_(out) {}

  void run() {
    struct Task {
      int binary, node, depth;
    };
    weigh();
    out_.nodes.push_back({});
    std::vector<Task> tasks{{0, 0, 1}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      out_.depth = std::max(out_.depth, task.depth);
      std::vector<int> children;
      if (is_leaf(task.binary))
        children.push_back(task.binary);
      else
        collect_both(task.binary, bvh_width, children);
      BvhNode node{};
      node.count = static_cast<std::int32_t>(children.size());
      for (std::size_t c = 0; c < children.size(); ++c) {
        const Bounds& b = binary(children[c]).bounds;
        node.low[0][c] = b.low.x, node.low[1][c] = b.low.y, node.low[2][c] = b.low.z;
        node.high[0][c] = b.high.x, node.high[1][c] = b.high.y, node.high[2][c] = b.high.z;
        if (is_leaf(children[c])) {
          node.child[c] = ~make_leaf(binary(children[c]));
        } else {
          node.child[c] = static_cast<std::int32_t>(out_.nodes.size());
          out_.nodes.push_back({});
          tasks.push_back({children[c], node.child[c], task.depth + 1});
        }
      }
      out_.nodes[static_cast<std::size_t>(task.node)] = node;
    }
  }

 private:
  const BinaryNode& binary(int i) const { return tree_.nodes[static_cast<std::size_t>(i)]; }

  /// The lowest costs of a part of the binary tree that fills at most 1, 2 … 8 slots of a wide node. Until the part's
  /// parent is weighed, the first entry is the cost of a wide node or leaf made of the part, and the others are
  /// unknown.
  using Costs = std::array<float, bvh_width>;
  static constexpr float node_cost = 4, child_cost = 1;  // times of tests over that of a sphere

  bool is_leaf(int node) const { return binary(node).left < 0; }
  Costs& costs(int node) { return costs_[static_cast<std::size_t>(node)]; }
  float cost(int node, int slots) const {
    return costs_[static_cast<std::size_t>(node)][static_cast<std::size_t>(slots - 1)];
  }
  /// The cost of a node's two sides, if the left side fills `left` of the slots.
  float cost_of_both(int node, int left, int slots) const {
    return cost(binary(node).left, left) + cost(binary(node).right, slots - left);
  }
  /// Returns the number of slots that the left side fills at the lowest cost.
  int best_left(int node, int slots) const {
    int best = 1;
    for (int left = 2; left < slots; ++left)
      if (cost_of_both(node, left, slots) < cost_of_both(node, best, slots)) best = left;
    return best;
  }

  /// Computes the costs of all parts of the binary tree, from its leaves up: a node follows its parent in the list.
  void weigh() {
    costs_.resize(tree_.nodes.size());
    for (int i = static_cast<int>(tree_.nodes.size()) - 1; i >= 0; --i) {
      const BinaryNode& node = binary(i);
      const float area = half_area(node.bounds);
      if (is_leaf(i)) {
        costs(i)[0] = area * static_cast<float>(node.count);
        continue;
      }
      weigh_child(node.left, area), weigh_child(node.right, area);
      costs(i)[0] = area * node_cost + cost_of_both(i, best_left(i, bvh_width), bvh_width);
    }
  }

  void weigh_child(int node, float area_around) {
    Costs& c = costs(node);
    c[0] += child_cost * area_around;
    for (int slots = 2; slots <= bvh_width; ++slots) {
      const auto k = static_cast<std::size_t>(slots - 1);
      c[k] = c[k - 1];
      if (!is_leaf(node)) c[k] = std::min(c[k], cost_of_both(node, best_left(node, slots), slots));
    }
  }

  /// Appends the children that fill the slots at the lowest cost.
  void collect(int node, int slots, std::vector<int>& children) const {
    while (slots > 1 && cost(node, slots) == cost(node, slots - 1)) --slots;
    if (slots == 1)
      children.push_back(node);
    else
      collect_both(node, slots, children);
  }
  void collect_both(int node, int slots, std::vector<int>& children) const {
    const int left = best_left(node, slots);
    collect(binary(node).left, left, children);
    collect(binary(node).right, slots - left, children);
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

  const BinaryTree& tree_;
  Bvh& out_;
  std::vector<Costs> costs_;
  std::array<std::int32_t, 256> slots_{};  // by PrimitiveKind, which is a byte: the slots taken
};

}  // namespace

Bvh build_bvh(const Column<BvhInput>& input) {
  assert(!input.empty() && input.size() <= bvh_max_primitives);
  Bvh bvh;
  bvh.input = input;
  const BinaryTree tree = build_binary_tree(bvh.input);
  Widener(tree, bvh).run();
  return bvh;
}

}  // namespace tyndall
