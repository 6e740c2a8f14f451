#pragma once
#include "core/compile/render_scene.h"
#include "core/trace/glints.h"

/// A RenderScene as plain pointers, which is all that kernels read. They must not call a container's member functions:
/// the linker keeps one copy of each for all files, and one with wide instructions would crash older CPUs.
namespace tyndall {

// Each of these has the columns of a struct in compile/render_scene.h, which says what they mean: SphereView those of
// Spheres, and so on.

struct SphereView {
  int count = 0;
  const float *x, *y, *z, *radius, *move_x, *move_y, *move_z;
  const std::int32_t* element;
};
struct FlatView {
  int count = 0;
  int hiding = 0;  ///< so many from the first on can be in the way of shadow rays; the others bound the scene
  const Affine* map;
  const std::int32_t* element;
  const float* column[affine_numbers];  ///< boxes only: see Flats
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
  LightTreeView tree;
};

struct ChainView {
  int pairs = 0, balls = 0, first_mirror = 0, first_pane = 0;
  bool shells, crowds;  ///< whether some ball is a shell, or crowded
  const float *center[3], *move[3], *radius, *index, *inner_radius, *inner_index;
  const std::int32_t *outer, *inner, *crowded, *ball, *light, *pair_of, *ball_of;
  const float *mirrors, *panes;
  LightView choice;
  TYNDALL_INLINE bool has_balls() const { return first_mirror > 0; }
  TYNDALL_INLINE bool has_mirrors() const { return first_mirror < first_pane; }
  TYNDALL_INLINE bool has_panes() const { return first_pane < balls; }
};

struct SceneView {
  /// The materials that kernels know; `kind` holds places in this list.
  template <class F>
  using MaterialList = MaterialKinds<F>;

  int width, height;
  CameraColumns camera;
  BackgroundColumns background;
  SphereView spheres, moving_spheres;
  FlatView quads, boxes;
  const BvhNode* nodes;  ///< null: every primitive is tested
  const BvhLeaf* leaves;
  int element_count, material_count;
  // elements
  const float *x, *y, *z, *inverse_radius, *move_x, *move_y, *move_z, *uv, *plane;
  const std::int32_t *material, *light_of;
  LightView lights;
  // materials
  const std::int32_t *kind, *texture_of;
  const float *red, *green, *blue;
  const float* parameter[max_material_fields];
  int texture_count;
  const TextureView* textures;
  int medium_count;
  const MediumColumns* media;
  int near_count;  ///< number of pairs of a medium and a lamp in it or near it: see NearLamps
  const std::int32_t *near_medium, *near_light;
  const float* near_probability;  ///< at medium · number of lights + light
  ChainView chains;
  int glint_count;
  const Glint* glints;
  const float* gradients;
  int max_depth;
  std::uint32_t seed;
  bool schlick, light_sampling;
  SamplerKind sampler;
  Integrator integrator;
  Needs needs;
  KernelSet kernel;
  bool shares;  ///< second vertices are shared between pixels: see share.h

  // What kernels ask before they run the code of a model.
  TYNDALL_INLINE bool has_media() const { return needs.media; }
  TYNDALL_INLINE bool has_textures() const { return needs.textures; }
  TYNDALL_INLINE bool has_image_textures() const { return needs.image_textures; }
  TYNDALL_INLINE bool has_lamps_in_fog() const { return near_count > 0; }
  TYNDALL_INLINE bool has_chains() const { return chains.pairs > 0; }
  TYNDALL_INLINE bool has_lamps() const { return lights.count > 0; }
  TYNDALL_INLINE bool has_reuse() const { return shares; }
};

/// The scene as a kernel that leaves models out sees it: for those models has_...() is a constant false, so that the
/// compiler drops their code.
/// reuse: whether the kernel shares second vertices between pixels (core/reuse).
template <KernelSet set, bool reuse>
struct SceneViewFor : SceneView {
  static constexpr bool fog_and_textures = set != KernelSet::no_fog_nor_textures && set != KernelSet::chains_alone;
  static constexpr bool asks_chains = set == KernelSet::everything || set == KernelSet::chains_alone;
  TYNDALL_INLINE bool has_media() const { return fog_and_textures && needs.media; }
  TYNDALL_INLINE bool has_textures() const { return fog_and_textures && needs.textures; }
  TYNDALL_INLINE bool has_image_textures() const { return fog_and_textures && needs.image_textures; }
  TYNDALL_INLINE bool has_lamps_in_fog() const { return fog_and_textures && near_count > 0; }
  TYNDALL_INLINE bool has_chains() const { return asks_chains && chains.pairs > 0; }
  TYNDALL_INLINE static constexpr bool has_reuse() { return reuse; }
};

/// The textures of a scene as kernels see them. They point into `scene`.
std::vector<TextureView> texture_views(const RenderScene& scene);

/// A scene as kernels see it, without glints and without sharing. It points into both arguments, which must stay as
/// they are while it is used. core/render/prepare.h adds what has to be found out.
SceneView view_of(const RenderScene& scene, const std::vector<TextureView>& textures);

}  // namespace tyndall
