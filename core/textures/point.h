#pragma once
#include "core/base/vec.h"

/// What a kernel tells a texture about the place whose colour it wants. Beside each kind of texture stands
/// colour_at(kind, columns, point): `kind` only names it, `columns` are its numbers as compile() laid them out.
namespace tyndall {

/// A place in a picture that is laid on a surface.
template <class F>
struct TextureUv {
  F u, v;
  MaskOf<F> wraps;  ///< whether u goes on from 1 to 0, as around a sphere; elsewhere the picture ends at its edge
};

/// Uv: a function object that gives the TextureUv of the surface there; media have none.
template <class F, class Uv>
struct TexturePoint {
  Vec3<F> point;           ///< in the compiled scene's coordinates
  Vec3<F> scaled;          ///< columns.scale · point + columns.offset
  MaskOf<F> wanted;        ///< which lanes want the colour
  const float* gradients;  ///< 3·256 floats for noise; null in scenes without it
  Uv uv;
};

}  // namespace tyndall
