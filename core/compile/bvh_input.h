#pragma once
#include "core/base/vec.h"

#include <cstdint>

/// What trees are built from.
namespace tyndall {

struct Bounds {
  Vec3f low, high;
  bool operator==(const Bounds&) const = default;
};

/// Kinds of primitives in leaves.
enum class PrimitiveKind : std::uint8_t { sphere, moving_sphere, quad, box };
inline constexpr int primitive_kinds = static_cast<int>(PrimitiveKind::box) + 1;

/// A primitive as the builder sees it.
struct BvhInput {
  Bounds bounds;  ///< finite; exact or wider
  PrimitiveKind kind;
  bool operator==(const BvhInput&) const = default;
};

}  // namespace tyndall
