#pragma once
#include "core/compile/column.h"

#include <cstdint>

/// The bounding volume hierarchy (BVH): a tree of boxes by which rays find the few primitives that they may hit.
namespace tyndall {

struct Bounds {
  Vec3f low, high;
  bool operator==(const Bounds&) const = default;
};

/// Kinds of primitives in leaves. outlined: triangles and disks, see Outline.
enum class PrimitiveKind : std::uint8_t { sphere, moving_sphere, quad, box, outlined };

/// A primitive as build_bvh() sees it.
struct BvhInput {
  Bounds bounds;  ///< finite; exact or wider
  PrimitiveKind kind;
  bool operator==(const BvhInput&) const = default;
};

inline constexpr int bvh_width = 8;  ///< most children of a node
inline constexpr int bvh_max_primitives = 1 << 24;
inline constexpr int bvh_stack = 640;  ///< more nodes than can wait in a traversal: 7 in each of 48 + 24 + 2 levels

/// The children's boxes, component by component, so that one ray can be tested against all boxes, or many rays against
/// one. Groups of 16 lanes may load 16 values from the start of a row of 8: the load stays within the node, because
/// other members follow.
struct alignas(64) BvhNode {
  float low[3][bvh_width], high[3][bvh_width];
  std::int32_t child[bvh_width];  ///< >= 0: node; < 0: leaf ~child
  std::int32_t count;             ///< children; the rest of the columns is 0
};

/// Primitives first … first + count - 1 of the columns of one kind.
struct BvhLeaf {
  std::int32_t first = 0;
  std::int16_t count = 0;
  PrimitiveKind kind = PrimitiveKind::sphere;
};

/// A tree of axis-parallel boxes over primitives. The boxes of children lie exactly within their parent's box, also in
/// float; the traversal relies on this.
struct Bvh {
  Column<BvhNode> nodes;  ///< node 0 is the root; empty: there is no tree
  Column<BvhLeaf> leaves;
  Column<std::int32_t> order;  ///< the inputs in the order of the tree's leaves; the columns of each kind of primitive
                               ///< (RenderScene) are filled in this order
  Column<BvhInput> input;      ///< what it was built from: equal input, equal tree
  int depth = 0;               ///< of the deepest node, root 1: bounds the traversal's stack
};

/// Builds with the surface area heuristic (J. MacDonald, K. Booth, Heuristics for Ray Tracing Using Space Subdivision,
/// The Visual Computer 6(3), 1990) over bins (I. Wald, On Fast Construction of SAH-based Bounding Volume Hierarchies,
/// IEEE Symposium on Interactive Ray Tracing, 2007). A pure function of the input. Identical centroids are split in the
/// middle of the list.
Bvh build_bvh(const Column<BvhInput>& input);

/// The binary tree from which build_bvh() makes one of up to eight children a node.
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
