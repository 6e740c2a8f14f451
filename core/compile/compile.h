#pragma once
#include "core/compile/render_scene.h"
#include "core/scene/scene.h"

namespace tyndall {

/// Flattens a checked scene for the kernels: composes transforms in double, moves the origin, rounds last.
/// `before`: an earlier result for a similar scene; what is equal in it (the tree) is kept.
/// The result is a pure function of the scene.
RenderScene compile(const Scene& scene, const RenderScene* before = nullptr);

/// Approximate bytes held by the compiled scene.
std::size_t bytes_of(const RenderScene& scene);

}  // namespace tyndall
