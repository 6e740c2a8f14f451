#pragma once
#include "core/compile/render_scene.h"
#include "core/scene/scene.h"

/// From the scene that users write to the arrays of floats that kernels read.
namespace tyndall {

/// Compiles a checked scene for the kernels: composes transforms in double, moves the origin into the middle of the
/// shapes and rounds to float last. before: the result for an earlier scene, or null; equal parts, for example the
/// tree, are taken from there to save time. The result depends on `scene` alone.
RenderScene compile(const Scene& scene, const RenderScene* before = nullptr);

/// Approximate bytes held by the compiled scene.
std::size_t bytes_of(const RenderScene& scene);

}  // namespace tyndall
