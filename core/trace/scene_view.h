#pragma once
#include "core/compile/render_scene.h"
#include "core/trace/guide.h"
#include "core/trace/subpixel_lights.h"

/// All that kernels read: a compiled scene and what is found out about it before its first sample.
namespace tyndall {

/// A path can split at so many of its first events: see SceneView::splits_paths.
inline constexpr int max_splits = 4;

/// A copy shares the columns, so that one with another camera costs microseconds.
struct SceneView : RenderScene {
  /// The materials that kernels know. Materials::kind holds indices into this list.
  template <class F>
  using MaterialList = MaterialKinds<F>;

  Guide guide{};
  Column<SubpixelLight> subpixel_lights{};
  bool reuses_paths = false;  ///< second vertices are reused between pixels, see reuse.h

  // Kernels test these before they run the code of a model.
  TYNDALL_INLINE bool has_media() const { return features.media; }
  TYNDALL_INLINE bool has_textures() const { return features.textures; }
  TYNDALL_INLINE bool has_image_textures() const { return features.image_textures; }
  TYNDALL_INLINE bool has_lights_in_media() const { return !near.medium.empty(); }
  TYNDALL_INLINE bool has_specular_paths() const { return specular.pairs() > 0; }
  TYNDALL_INLINE bool has_guide() const { return guide.lobes() > 0; }
  TYNDALL_INLINE bool has_sky() const { return sky.texels != nullptr; }
  TYNDALL_INLINE bool samples_sky() const { return sky.is_sampled(); }
  TYNDALL_INLINE bool has_sun_paths() const { return !specular.sun_pair_of.empty(); }  ///< see specular/sun_window.h
  TYNDALL_INLINE bool has_lights() const { return lights.count() > 0; }
  TYNDALL_INLINE bool has_reuse() const { return reuses_paths; }
  static constexpr bool can_split = true;  ///< whether the kernel has the code for it
  TYNDALL_INLINE bool has_splitting() const { return splits_paths; }
  TYNDALL_INLINE bool has_outlined() const { return outlined.count() > 0; }  ///< triangles and disks
  TYNDALL_INLINE bool has_outlined_lights() const { return !lights.inner.empty(); }
};

/// The view of kernels without triangles, disks and a picture of the sky, and of all but one without guides: has_...()
/// is a constant false for them, so that the compiler drops their code.
struct CommonSceneView : SceneView {
  TYNDALL_INLINE static constexpr bool has_guide() { return false; }
  TYNDALL_INLINE static constexpr bool has_sky() { return false; }
  TYNDALL_INLINE static constexpr bool samples_sky() { return false; }
  TYNDALL_INLINE static constexpr bool has_sun_paths() { return false; }
  TYNDALL_INLINE static constexpr bool has_outlined() { return false; }
  TYNDALL_INLINE static constexpr bool has_outlined_lights() { return false; }
};

/// Whether samples have weights of their own, because the scene may have subpixel lights: see subpixel_lights.h.
TYNDALL_INLINE bool has_sample_weights(const auto& s) { return s.has_specular_paths() || s.has_guide(); }

/// A kernel's view as functions that are not inlined take it: one copy of them serves all kernels of a file.
TYNDALL_INLINE const SceneView& shared_view(const SceneView& s) { return s; }
TYNDALL_INLINE const CommonSceneView& shared_view(const CommonSceneView& s) { return s; }

/// Which scenes a path loop is for: those that reuse no second vertices (core/reuse), or those that do.
enum class Reuse { never, always };

/// The view of a kernel that leaves models out. The kernel with every model reads SceneView itself.
template <KernelSet set, Reuse reuse>
requires(set != KernelSet::everything) struct SceneViewFor : CommonSceneView {
  static constexpr bool media_and_textures = set == KernelSet::common_models || set == KernelSet::no_specular_paths;
  TYNDALL_INLINE bool has_media() const { return media_and_textures && features.media; }
  TYNDALL_INLINE bool has_textures() const { return media_and_textures && features.textures; }
  TYNDALL_INLINE bool has_image_textures() const { return media_and_textures && features.image_textures; }
  TYNDALL_INLINE bool has_lights_in_media() const { return media_and_textures && !near.medium.empty(); }
  TYNDALL_INLINE bool has_specular_paths() const { return can_split && specular.pairs() > 0; }
  TYNDALL_INLINE static constexpr bool has_guide() { return set == KernelSet::guided_paths_only; }
  TYNDALL_INLINE static constexpr bool has_reuse() { return reuse == Reuse::always; }
  static constexpr bool can_split = solves_specular_paths(set);
  TYNDALL_INLINE bool has_splitting() const { return can_split && splits_paths; }
};
/// The scene itself, which a kernel's view adds no members to.
template <KernelSet set, Reuse reuse>
TYNDALL_INLINE const SceneViewFor<set, reuse>& view_for(const SceneView& scene) {
  return static_cast<const SceneViewFor<set, reuse>&>(scene);
}

}  // namespace tyndall
