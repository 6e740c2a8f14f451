#pragma once
#include "core/compile/render_scene.h"
#include "core/trace/guide_view.h"
#include "core/trace/subpixel_lights.h"

/// A RenderScene as plain pointers: all that kernels read. They must not call a container's member functions: the
/// linker keeps one copy of each for all files, and a copy with wide instructions would crash older CPUs.
namespace tyndall {

// Each view holds the columns of the struct in core/compile/render_scene.h that explains them: SphereView those of
// Spheres, and so on.

struct SphereView {
  int count = 0;
  const float *x, *y, *z, *radius, *move_x, *move_y, *move_z;
  const std::int32_t* element;
};
struct FlatView {
  int count = 0;
  int blocking = 0;  ///< count of flats that can block shadow rays; those behind them enclose the scene and never do
  const Affine* map;
  const std::int32_t* element;
  const float* column[affine_numbers];  ///< boxes only: see Flats
  const Outline* outline;               ///< triangles and disks only
};
struct TextureView {
  std::int32_t kind;
  Vec3f a, b, offset;
  float scale, z_scale, z_offset;
  NoiseStyle style;
  int width, height;
  const float* texels;
};

struct LightTreeView {
  const float *center[3], *power, *reach2;
  const std::int32_t *child, *parent, *leaf;
};
struct LightView {
  int count = 0;
  const std::int32_t *kind, *element;
  const float *corner[3], *edge_u[3], *edge_v[3], *normal[3], *center[3];
  const float *length_u, *length_v, *area, *power, *reach2;
  const float* inner;  ///< null: no light is a triangle or a disk
  LightTreeView tree;
};

struct SkyView {
  const float* texels = nullptr;  ///< null: the background is no picture
  int width, height;
  bool sampled = false;                             ///< as a light
  int rows, rows_per_texel, row_step, column_step;  ///< steps: the largest powers of two up to rows and width
  const std::int32_t *row_ends, *column_ends;
  float cos, sin, scale, irradiance, to_one;
  Vec3f sun_axis, sun_edge_u, sun_edge_v;  ///< see SkySun, after the sky's turn
  float sun_tangent;
};

struct SpecularView {
  int pairs = 0, spheres = 0, first_mirror = 0, first_slab = 0;
  bool shells, has_overlaps;  ///< whether some sphere is a shell; is overlapped
  const float *center[3], *move[3], *radius, *index, *inner_radius, *inner_index;
  const std::int32_t *outer, *inner, *overlapped, *sphere, *light, *pair_of, *sphere_of,
      *sun_pair_of;  ///< null: no pair has the sun
  const FlatRecord* flats;
  LightView choice;
  TYNDALL_INLINE bool has_spheres() const { return first_mirror > 0; }
  TYNDALL_INLINE bool has_mirrors() const { return first_mirror < first_slab; }
  TYNDALL_INLINE bool has_slabs() const { return first_slab < spheres; }
};

/// A path can split at so many of its first events: see SceneView::splits_paths.
inline constexpr int max_splits = 4;

struct SceneView {
  /// The materials that kernels know. `kind` holds indices into this list.
  template <class F>
  using MaterialList = MaterialKinds<F>;

  int width, height;
  CameraColumns camera;
  BackgroundColumns background;
  SkyView sky;
  SphereView spheres, moving_spheres;
  FlatView quads, boxes, outlined;
  const BvhNode* nodes;  ///< null: there is no tree, and every primitive is tested
  const BvhLeaf* leaves;
  int element_count, material_count;
  // elements
  const float *x, *y, *z, *inverse_radius, *move_x, *move_y, *move_z, *uv, *plane;
  const std::int32_t *material, *light_of, *disk;
  LightView lights;
  // materials
  const std::int32_t *kind, *texture_of;
  const float *red, *green, *blue;
  const float* parameter[max_material_fields];
  int texture_count;
  const TextureView* textures;
  int medium_count;
  const MediumColumns* media;
  int near_count;  ///< number of pairs of a medium and a light in it or near it, see NearLights
  const std::int32_t *near_medium, *near_light;
  const float* near_probability;  ///< of the pair, at index medium · number of lights + light
  SpecularView specular;
  GuideView guide;
  int subpixel_light_count;
  const SubpixelLight* subpixel_lights;
  const float* gradients;
  int max_depth;
  std::uint32_t seed;
  bool schlick, light_sampling;
  SamplerKind sampler;
  Integrator integrator;
  SceneFeatures features;
  KernelSet kernel;
  bool splits_paths;  ///< at smooth glass that the camera sees, see core/transport/splitting.h
  bool reuses_paths;  ///< second vertices are reused between pixels, see reuse.h

  // Kernels test these before they run the code of a model.
  TYNDALL_INLINE bool has_media() const { return features.media; }
  TYNDALL_INLINE bool has_textures() const { return features.textures; }
  TYNDALL_INLINE bool has_image_textures() const { return features.image_textures; }
  TYNDALL_INLINE bool has_lights_in_media() const { return near_count > 0; }
  TYNDALL_INLINE bool has_specular_paths() const { return specular.pairs > 0; }
  TYNDALL_INLINE bool has_guide() const { return guide.lobes > 0; }
  TYNDALL_INLINE bool has_sky() const { return sky.texels != nullptr; }
  TYNDALL_INLINE bool samples_sky() const { return sky.sampled; }
  TYNDALL_INLINE bool has_sun_paths() const { return specular.sun_pair_of != nullptr; }  ///< see specular/sun_window.h
  TYNDALL_INLINE bool has_lights() const { return lights.count > 0; }
  TYNDALL_INLINE bool has_reuse() const { return reuses_paths; }
  static constexpr bool can_split = true;  ///< whether the kernel has the code for it
  TYNDALL_INLINE bool has_splitting() const { return splits_paths; }
  TYNDALL_INLINE bool has_outlined() const { return outlined.count > 0; }  ///< triangles and disks
  TYNDALL_INLINE bool has_outlined_lights() const { return lights.inner != nullptr; }
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
  TYNDALL_INLINE bool has_lights_in_media() const { return media_and_textures && near_count > 0; }
  TYNDALL_INLINE bool has_specular_paths() const { return can_split && specular.pairs > 0; }
  TYNDALL_INLINE static constexpr bool has_guide() { return set == KernelSet::guided_paths_only; }
  TYNDALL_INLINE static constexpr bool has_reuse() { return reuse == Reuse::always; }
  static constexpr bool can_split = solves_specular_paths(set);
  TYNDALL_INLINE bool has_splitting() const { return can_split && splits_paths; }
};

/// The sky's picture as kernels read it. It points into the columns.
SkyView view_of(const SkyColumns& sky);

/// The textures of a scene as kernels read them. They point into `scene`.
std::vector<TextureView> texture_views(const RenderScene& scene);

/// A scene as kernels read it, without subpixel lights and without reuse; core/render/prepare.h adds both. It points
/// into both arguments, which must stay unchanged while it is used.
SceneView view_of(const RenderScene& scene, const std::vector<TextureView>& textures);

}  // namespace tyndall
