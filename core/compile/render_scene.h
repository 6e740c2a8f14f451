#pragma once
#include "core/base/kinds.h"
#include "core/base/random.h"
#include "core/base/vec.h"
#include "core/compile/bvh.h"
#include "core/compile/column.h"
#include "core/compile/sky_columns.h"
#include "core/materials/materials.h"
#include "core/scene/integrator.h"
#include "core/shapes/outline.h"
#include "core/shapes/quad.h"
#include "core/textures/textures.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// The scene as kernels read it: flat float arrays, made from a Scene by compile(). Positions are relative to `origin`.
namespace tyndall {

/// Numbers all objects of a scene, from 0, and gives the path of each: the indices into Scene::objects and the lists of
/// its groups. Stores two numbers an object, because a scene may have millions.
class ObjectTree {
 public:
  /// Makes room for as many objects.
  void reserve(std::size_t objects) { steps_.reserve(objects); }

  /// Adds the object at `index` in the list of a group and returns its number. group: number of the group; -1:
  /// Scene::objects.
  std::int32_t add(std::int32_t group, std::size_t index) {
    steps_.push_back({group, static_cast<std::int32_t>(index)});
    return static_cast<std::int32_t>(steps_.size()) - 1;
  }

  /// The path of an object, from Scene::objects to itself.
  std::vector<int> path(std::int32_t object) const {
    std::vector<int> indices;
    for (; object >= 0; object = steps_[object].group) indices.push_back(steps_[object].index);
    std::reverse(indices.begin(), indices.end());
    return indices;
  }

 private:
  struct Step {
    std::int32_t group, index;
  };
  Column<Step> steps_;
};

/// The models that a scene contains. They select a kernel that leaves out other models; which kernel runs changes no
/// bit of the picture.
struct SceneFeatures {
  bool spheres = false, moving_spheres = false, quads = false, boxes = false, triangles = false, disks = false;
  bool media = false, phase_functions = false;                      ///< phase_functions: some medium has g != 0
  bool materials[std::variant_size_v<MaterialKinds<double>>] = {};  ///< by kind
  bool textures = false, image_textures = false;
  bool background = false, lens = false, shutter = false;
  bool operator==(const SceneFeatures&) const = default;
};
/// Whether some shape is of a kind of material: Metal<>, ...
template <class Kind>
constexpr bool has_material(const SceneFeatures& features) {
  return features.materials[place_in<Kind, MaterialKinds<double>>];
}
/// Whether some shape is of a material with a trait: needs_trait<&BsdfTraits::emits>(needs).
template <bool BsdfTraits::*trait>
constexpr bool needs_trait(const SceneFeatures& features) {
  constexpr auto list = static_cast<const MaterialKinds<double>*>(nullptr);
  bool some = false;
  for (std::size_t k = next_with<trait>(list, 0); k < std::size(features.materials); k = next_with<trait>(list, k + 1))
    some = some || features.materials[k];
  return some;
}
/// Names of the features that are set, in the order above.
std::vector<std::string> names_of(const SceneFeatures& features);

/// The surface on which the camera stands (surroundings.h). Camera rays that start within rounding of it leave it
/// like all other rays that leave a surface, so that they cannot hit the place where they start.
struct CameraSurface {
  std::int32_t element = -1;  ///< -1: the camera stands on none
  Vec3f normal;               ///< unit, outward, where the centre of the lens is
  float height = 0;           ///< of the centre of the lens above the surface, scene units; negative: below it
  float curvature = 0;        ///< 1 / radius of a sphere; 0: flat
  /// Scene units. A start within `touching` of the surface counts as on it for all rays; a start within `rounding`
  /// counts as on it for rays that go away from the surface on the side of the start.
  float rounding = 0, touching = 0;
};

/// Camera in the form of Ray Tracing in One Weekend, section 13.2: rays start in the lens and pass the plane in focus.
struct CameraColumns {
  Vec3f center;          ///< of the lens
  Vec3f corner, du, dv;  ///< from the centre to the upper left corner of the focus plane; steps of one pixel
  Vec3f lens_u, lens_v;  ///< half axes of the lens; zero without defocus
  Vec3f axis;            ///< unit, into the scene
  float shutter_open = 0, shutter_length = 0;
  CameraSurface surface;
};

enum class BackgroundKind { constant, gradient, hemispheres, picture };
struct BackgroundColumns {
  BackgroundKind kind = BackgroundKind::constant;
  Vec3f a, b;  ///< constant: a; gradient: bottom, top; hemispheres: up, down; picture: see SkyColumns
};

/// Primitives of one kind, in the order of the tree's leaves. `element`: a primitive's first element, named by hits.
struct Spheres {
  VectorColumn center, move;  ///< move: only for moving spheres, way from time 0 to 1
  Column<float> radius;       ///< > 0
  Column<std::int32_t> element;
  TYNDALL_INLINE int count() const { return element.count(); }
};
struct Flats {
  Column<Affine> map;
  Column<std::int32_t> element;  ///< a box owns six: its faces x-, x+, y-, y+, z-, z+
  /// Boxes only: the numbers of `map` once more, in columns: x, y, z of the rows, then the offsets.
  Column<float> column[affine_numbers];
  Column<Outline> outline;  ///< triangles and disks only; `map`: see triangle_map(), or that of the frame
  int bounding = 0;  ///< how many at the end are quads that bound the scene: shadow rays skip them (surroundings.h)
  TYNDALL_INLINE int count() const { return element.count(); }
};

/// Columns by element. An element is a sphere, a flat shape or a face of a box.
struct Elements {
  /// Spheres: centre and 1 / signed radius. Flats: unit outward normal and 0.
  VectorColumn center_or_normal;
  Column<float> inverse_radius;
  VectorColumn move;  ///< filled only if some sphere moves
  Column<std::int32_t> material;
  Column<std::int32_t> light;         ///< index into Lights, or -1
  Column<std::int32_t> shared_plane;  ///< see plane_numbers()
  /// For image textures; empty without image textures. Flats: u and v as affine functions of the point (8 floats).
  /// Spheres: cosine and sine of the rotation into the sphere's own frame, in the first two floats.
  Column<float> uv;
  /// For textures; empty without textures. Flats: distance from the origin, along the normal, of the plane in which the
  /// texture is looked up. This is the flat's own plane, unless the flat lies on the border between two layers of a
  /// checker: then the plane lies within the layer that floor() gives, so that rounding does not choose the cell.
  /// Spheres: 0.
  Column<float> plane;
  /// For image textures, in scenes with disks: 1 for disks, whose uv columns give fractions of the edges of their
  /// frame, see disk_uv(); 0 for others.
  Column<std::int32_t> disk;
  Column<std::int32_t> object;  ///< the number of the object that it belongs to, in RenderScene::objects
  TYNDALL_INLINE int count() const { return material.count(); }
};

/// Columns by material. parameter[i] holds the i-th field of the material's kind.
struct Materials {
  Column<std::int32_t> kind;  ///< index into MaterialKinds
  VectorColumn colour;
  Column<std::int32_t> texture;  ///< index into RenderScene::textures, or -1
  Column<float> parameter[max_material_fields];
  TYNDALL_INLINE int count() const { return kind.count(); }
};

struct TextureColumns {
  std::int32_t kind = 0;            ///< place in TextureKinds
  Vec3f a, b;                       ///< solid: a; checker: even, odd
  float scale = 1;                  ///< checker: 1 / edge; noise: cells per unit
  Vec3f offset;                     ///< added after scaling: the scene's origin, modulo the pattern's period
  float z_scale = 0, z_offset = 0;  ///< marble: turns per unit of z, and the origin's
  NoiseStyle style = NoiseStyle::marble;
  int width = 0, height = 0;
  std::shared_ptr<const Image::Pixels> pixels;  ///< the scene's own; null: no image
  const float* texels = nullptr;                ///< its numbers
};

struct MediumColumns {
  bool box = false;
  Vec3f center;  ///< sphere
  float radius = 0;
  Affine map{};                       ///< box
  std::int32_t first = 0, count = 1;  ///< the boundary's elements: those of the surface it equals, or its own
  float density = 0;                  ///< > 0
  float g = 0;
  Vec3f albedo;
  std::int32_t texture = -1;
  bool weighs = false;  ///< it only absorbs, and paths carry less behind it instead of ending there: flight.h
};

/// A binary tree of lights, from which one of many lights is chosen. Columns by node. Node 0 is the root, node 1 is not
/// used, and the children of a node are neighbours: 2 k and 2 k + 1.
struct LightTree {
  VectorColumn center;  ///< of a box that holds the node's lights
  /// Sum of the powers of the node's lights; lower limit of the squared distance from the centre.
  Column<float> power, reach2;
  Column<std::int32_t> child;  ///< >= 0: the first child; < 0: leaf of light -1 - child
  Column<std::int32_t> parent;
  Column<std::int32_t> leaf;  ///< by light: its node
};

/// Emitting primitives: spheres, flat shapes, faces of boxes. Columns by light.
struct Lights {
  /// rectangle: edges at right angles; triangle, ring: those with an outline, see Outline
  enum Kind : std::int32_t { rectangle, parallelogram, sphere, triangle, ring };
  Column<std::int32_t> kind, element;
  /// Flats: a corner and unit edges, of the frame if they have an outline. Spheres: the centre in corner, and its
  /// motion over the shutter in edge_u.
  VectorColumn corner, edge_u, edge_v, normal;
  Column<float> length_u, length_v;  ///< spheres: the radius in length_u
  Column<float> area;                ///< of what emits: of a triangle half of its frame's
  Column<float> inner;               ///< rings: Outline::size; empty without triangles and rings
  VectorColumn center;               ///< a point in the middle, for choosing a light
  Column<float> power;               ///< area times the largest component of the radiance
  Column<float> reach2;              ///< squared radius of a sphere around center that holds the light
  LightTree tree;                    ///< empty with at most max_lights_by_contribution
  TYNDALL_INLINE int count() const { return kind.count(); }
};
inline constexpr int max_lights_by_contribution = 16;

/// Pairs of a medium and a small light in or near it. The light scattered next to such a light has no upper bound
/// (inverse square law), so integrator mis samples distances by equiangular sampling (core/trace/flight.h).
struct NearLights {
  Column<std::int32_t> medium, light;
  Column<float> probability;  ///< of each pair to be chosen, by medium · number of lights + light
};

/// A flat mirror (quad or face of a box), or a slab (box of glass).
struct FlatRecord {
  /// Of a mirror as of an Affine: two that run from -1 to 1 across the face, and the unit normal, which gives the
  /// height of a point. Of a slab the unit directions of its three edges.
  Vec3f row[3];
  float offset[3];  ///< added to the products with these rows; of a slab places are measured from its middle
  float size[3];    ///< of a mirror the lengths of the first two rows; of a slab half the lengths of the edges
  // Of a slab alone.
  float index, medium_density;  ///< of refraction; density of media within
  std::int32_t closed;  ///< bit 2 · edge + (1: the upper face of the two at its ends): something else touches that face
};

/// Glass spheres, mirror spheres, flat mirrors and slabs, and for each the lights to which integrator mis solves for
/// specular paths. Flat mirrors have indices behind the spheres, and columns like mirror spheres of radius 0. Slabs
/// have indices behind the mirrors, and columns like glass spheres that enclose them; their element is that of their
/// first face.
struct SpecularPairs {
  // Columns by sphere: one sphere, or two around one centre.
  VectorColumn center, move;                ///< move: way from time 0 to 1
  Column<float> radius, index;              ///< of the outer sphere; index within it over that outside, 0: metal
  Column<float> inner_radius, inner_index;  ///< of the inner sphere, 0: none; index within it over that outside
  Column<std::int32_t> outer, inner;        ///< elements of the spheres
  Column<std::int32_t> overlapped;          ///< 1: surfaces or media other than its own are or reach into it
  int first_mirror = 0, first_slab = 0;     ///< how many spheres there are; how many spheres and flat mirrors
  Column<FlatRecord> flats;                 ///< of the flat mirrors, then of the slabs
  // Pairs of a sphere and a light.
  Column<std::int32_t> sphere, light;         ///< light: -1 for the sun of the sky's picture
  Lights choice;                              ///< the pairs as what choose_light chooses from
  Column<std::int32_t> pair_of;               ///< by sphere · number of lights + light: the pair, or -1
  Column<std::int32_t> sphere_of;             ///< by element: 2 · sphere + (1: inner sphere), or -1
  Column<std::int32_t> sun_pair_of;           ///< by sphere: its pair with the sun, or -1; empty: no pair has the sun
  bool shells = false, has_overlaps = false;  ///< whether some sphere is a shell; is overlapped
  TYNDALL_INLINE int pairs() const { return sphere.count(); }
  TYNDALL_INLINE int spheres() const { return radius.count(); }
  TYNDALL_INLINE bool has_spheres() const { return first_mirror > 0; }
  TYNDALL_INLINE bool has_mirrors() const { return first_mirror < first_slab; }
  TYNDALL_INLINE bool has_slabs() const { return first_slab < spheres(); }
};

/// The variants of the kernels, by the models that they leave out. A scene without these models gives the same picture
/// with the variant, bit by bit.
///
/// Only `everything` has triangles, disks and a picture of the sky. Guided light is in `everything` and in
/// `guided_paths_only`, which has specular paths but no media and no textures.
enum class KernelSet {
  everything,
  common_models,
  specular_paths_only,
  no_specular_paths,
  no_media_no_textures,
  guided_paths_only
};
inline constexpr int kernel_sets = 6;
/// Whether the kernels of the set have the code for specular paths.
constexpr bool solves_specular_paths(KernelSet set) {
  return set != KernelSet::no_specular_paths && set != KernelSet::no_media_no_textures;
}
/// Whether a set has a path loop for scenes that reuse paths. The few such scenes of the others are as quick in the
/// kernel with every model.
constexpr bool has_reuse_loop(KernelSet set) { return !solves_specular_paths(set) || set == KernelSet::common_models; }
const char* name_of(KernelSet set);

struct RenderScene {
  int width = 0, height = 0;
  Vec3d origin;  ///< world position of (0, 0, 0): the component-wise median of the shapes' centres
  CameraColumns camera;
  BackgroundColumns background;
  SkyColumns sky;
  Spheres spheres, moving_spheres;
  Flats quads, boxes, outlined;  ///< outlined: triangles and disks
  Bvh bvh;                       ///< empty: few primitives, all are tested
  Elements elements;
  ObjectTree objects;
  Lights lights;
  Materials materials;
  Column<TextureColumns> textures;
  Column<MediumColumns> media;
  NearLights near;
  SpecularPairs specular;
  Column<float> gradients;  ///< of noise textures, 3·256
  int max_depth = 1000;
  std::uint32_t seed = 0;
  bool schlick = false;
  SamplerKind sampler = SamplerKind::sobol;
  Integrator integrator = Integrator::mis;
  bool light_sampling = false;  ///< the integrator sends shadow rays to lights, and the scene has lights or a sky
  double film_quantum = 1;
  SceneFeatures features;
  KernelSet kernel = KernelSet::everything;  ///< the least that this scene needs
  bool splits_paths = false;     ///< follow both ways at smooth glass that the camera sees: transport/splitting.h
  bool may_guide_paths = false;  ///< light may be guided over near-specular surfaces; whether that pays: core/guide
  bool may_reuse_paths =
      false;  ///< second vertices may be shared between pixels; whether that pays: trace/scene_view.h
  int primitives() const;
  /// The path of the object that an element belongs to.
  std::vector<int> object_of(std::int32_t element) const { return objects.path(elements.object[element]); }
};

}  // namespace tyndall
