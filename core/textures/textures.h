#pragma once
#include "core/textures/checker.h"
#include "core/textures/image.h"
#include "core/textures/noise.h"
#include "core/textures/solid.h"

#include <variant>

/// The list of textures: what scene files, panels and kernels know of.
namespace tyndall {

/// Every texture there is. All but images are functions of the point in world space; images use uv.
template <class F>
using TextureKinds = std::variant<Solid<F>, Checker<F>, Noise<F>, Image>;

}  // namespace tyndall
