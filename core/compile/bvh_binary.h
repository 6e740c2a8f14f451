#pragma once
#include "core/base/vec.h"
#include "core/compile/column.h"

#include <cstdint>
#include <vector>

/// What trees are built from, and the binary tree from which build_bvh() makes a tree of up to eight children a node.
namespace tyndall {

struct Bounds {
  Vec3f low, high;
  bool operator==(const Bounds&) const = default;
};

/// Kinds of primitives in leaves. outlined: triangles and disks, see Outline.
enum class PrimitiveKind : std::uint8_t { sphere, moving_sphere, quad, box, outlined };
inline constexpr int primitive_kinds = static_cast<int>(PrimitiveKind::outlined) + 1;

/// A primitive as the builder sees it.
struct BvhInput {
  Bounds bounds;  ///< finite; exact or wider
  PrimitiveKind kind;
  bool operator==(const BvhInput&) const = default;
};

struct BinaryNode {
  Bounds bounds;
  int left = -1, right = -1;  ///< children; -1 in a leaf
  int first = 0, count = 0;   ///< of a leaf: its range in the tree's order
};

struct BinaryTree {
  std::vector<BinaryNode> nodes;  ///< node 0 is the root; a node's left subtree follows it, then the right one
  std::vector<int> order;         ///< inputs, in the order of the leaves
};

/// Half of the surface of a box; 0 for one that holds nothing.
float half_area(const Bounds& b);

/// Splits by the surface area heuristic over bins. Several threads build large subtrees; the result is a pure function
/// of the input.
BinaryTree build_binary_tree(const Column<BvhInput>& input);

}  // namespace tyndall
