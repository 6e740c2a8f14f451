#pragma once
#include "core/base/ray.h"
#include "core/materials/materials.h"
#include "core/shapes/outline.h"
#include "core/textures/textures.h"
#include "core/trace/intersect.h"
#include "core/trace/scene_view.h"

#include <tuple>
#include <type_traits>
#include <utility>

/// What a ray finds at its end: the background, or a surface with its colour and its material's scattering.
namespace tyndall {

/// Radiance of the background. Gradient: Ray Tracing in One Weekend, section 4.2 "Sending Rays Into the Scene".
template <class F>
TYNDALL_INLINE Vec3<F> background_radiance(const BackgroundColumns& b, Vec3<F> direction) {
  const Vec3<F> first = splat<F>(b.a);
  if (b.kind == BackgroundKind::constant) return first;
  if (b.kind == BackgroundKind::hemispheres) return select(less(F(0.0f), direction.y), first, splat<F>(b.b));
  return point_at(first, mul_add(F(0.5f), direction.y, F(0.5f)), splat<F>(b.b) - first);
}

/// A surface point that a ray hits.
template <class F>
struct SurfacePoint {
  Vec3<F> point;
  Vec3<F> normal;      ///< unit; the surface's own, not flipped towards the ray
  MaskOf<F> inverted;  ///< the normal points inward, because the sphere's radius is negative
  IntOf<F> element;    ///< a valid index in all lanes, also in those without a hit
  IntOf<F> material;
};

template <class F>
TYNDALL_INLINE SurfacePoint<F> surface_at(const SceneView& s, const Ray<F>& ray, F t, IntOf<F> element) {
  const F safe_t = select(less(t, F(__builtin_inff())), t, F(0.0f));
  SurfacePoint<F> p;
  p.element = select(less(element, IntOf<F>(0)), IntOf<F>(0), element);
  p.point = point_at(ray.origin, safe_t, ray.direction);
  p.material = lookup<F>(s.elements.material, s.elements.count(), p.element);
  Vec3<F> column = lookup<F>(s.elements.center_or_normal, s.elements.count(), p.element);
  p.normal = column;
  p.inverted = less(F(1.0f), F(0.0f));
  if (!s.features.spheres && !s.features.moving_spheres) return p;
  const F inverse_radius = lookup<F>(s.elements.inverse_radius, s.elements.count(), p.element);
  const auto round = mask_not(equal(inverse_radius, F(0.0f)));
  if (!any(round)) return p;
  if (s.features.moving_spheres)
    column = point_at(column, ray.time, lookup<F>(s.elements.move, s.elements.count(), p.element));
  const Vec3<F> arm = p.point - column;
  const F scale = copy_sign(F(1.0f) / sqrt(max(dot(arm, arm), F(1e-37f))), inverse_radius);
  p.normal = select(round, scale * arm, p.normal);
  p.inverted = less(inverse_radius, F(0.0f));
  return p;
}

/// uv of a point for image textures; see Elements::uv.
template <class F>
TYNDALL_INLINE TextureUv<F> surface_uv(const auto& s, const SurfacePoint<F>& p) {
  const IntOf<F> at = p.element * IntOf<F>(8);
  F column[8];
  for (int i = 0; i < 8; ++i) column[i] = gather<F>(s.elements.uv + i, at);
  F u = mul_add(column[0], p.point.x, mul_add(column[1], p.point.y, mul_add(column[2], p.point.z, column[3])));
  F v = mul_add(column[4], p.point.x, mul_add(column[5], p.point.y, mul_add(column[6], p.point.z, column[7])));
  if (s.has_outlined() && s.features.disks) {
    const auto disk = equal(lookup<F>(s.elements.disk, s.elements.count(), p.element), IntOf<F>(1));
    const Pair<F> on_disk = disk_uv(u, v);
    u = select(disk, on_disk.x, u), v = select(disk, on_disk.y, v);
  }
  const auto round = mask_not(equal(lookup<F>(s.elements.inverse_radius, s.elements.count(), p.element), F(0.0f)));
  if (!any(round)) return {u, v, round};
  const Vec3<F> outward = select(p.inverted, -p.normal, p.normal);
  const Vec3<F> own{mul_add(column[0], outward.x, -(column[1] * outward.z)), outward.y,
                    mul_add(column[1], outward.x, column[0] * outward.z)};
  F round_u, round_v;
  sphere_uv(own, round_u, round_v);
  return {select(round, round_u, u), select(round, round_v, v), round};
}

/// Computes the uv coordinates of a surface for textures that need them.
template <class F, class View>
struct SurfaceUv {
  const View* scene;
  const SurfacePoint<F>* surface;  ///< null in a medium, whose textures need no uv
  TYNDALL_INLINE TextureUv<F> operator()() const { return surface_uv(*scene, *surface); }
};

// The loops over the kinds of textures and materials below are recursions on purpose. Nested closures would be simpler
// to read, but compilers then keep what they capture, all of a path, in memory.

/// Colour at a point of a texture of kind `first` or a later kind.
template <std::size_t first = 0, class F, class Uv>
TYNDALL_INLINE Vec3<F> colour_of_kind(const TextureColumns& t, const TexturePoint<F, Uv>& at) {
  using Kinds = TextureKinds<F>;
  if constexpr (first + 1 < std::variant_size_v<Kinds>)
    if (t.kind != static_cast<std::int32_t>(first)) return colour_of_kind<first + 1>(t, at);
  return colour_at(static_cast<const std::variant_alternative_t<first, Kinds>*>(nullptr), t, at);
}

/// Colour of a texture at a point, in the lanes `wanted`. surface: gives the uv coordinates for image textures; null in
/// a medium.
template <class F, class View>
TYNDALL_INLINE Vec3<F> texture_colour(const View& s, const TextureColumns& t, Vec3<F> point, MaskOf<F> wanted,
                                      const SurfacePoint<F>* surface) {
  const Vec3<F> scaled = point_at(splat<F>(t.offset), splat<F>(t.scale), point);
  return colour_of_kind<0, F, SurfaceUv<F, View>>(t, {point, scaled, wanted, s.gradients, {&s, surface}});
}

/// `colour`, or the texture's colour in lanes whose `index` is not -1.
template <class F>
TYNDALL_INLINE Vec3<F> textured(const auto& s, Vec3<F> colour, IntOf<F> index, MaskOf<F> lanes, Vec3<F> point,
                                const SurfacePoint<F>* surface) {
  for (int k = 0; k < s.textures.count(); ++k) {
    const auto here = mask_and(lanes, equal(index, IntOf<F>(k)));
    if (any(here)) colour = select(here, texture_colour(s, s.textures[k], point, here, surface), colour);
  }
  return colour;
}

/// Where a texture is looked up for a surface point: on flats exactly in Elements::plane, so that the rounding of the
/// point cannot choose between the cells of a checker on either side of the flat.
template <class F>
TYNDALL_INLINE Vec3<F> texture_point(const SceneView& s, const SurfacePoint<F>& p) {
  const auto flat = equal(lookup<F>(s.elements.inverse_radius, s.elements.count(), p.element), F(0.0f));
  if (!any(flat)) return p.point;
  const Vec3<F> normal = lookup<F>(s.elements.center_or_normal, s.elements.count(), p.element);
  const F gap = lookup<F>(s.elements.plane, s.elements.count(), p.element) - dot(normal, p.point);
  return select(flat, point_at(p.point, gap, normal), p.point);
}

template <class F>
TYNDALL_INLINE Vec3<F> surface_colour(const auto& s, const SurfacePoint<F>& p, MaskOf<F> lanes) {
  const Vec3<F> colour = lookup<F>(s.materials.colour, s.materials.count(), p.material);
  if (!s.has_textures()) return colour;
  const IntOf<F> texture = lookup<F>(s.materials.texture, s.materials.count(), p.material);
  if (!any(mask_and(lanes, less_equal(IntOf<F>(0), texture)))) return colour;
  return textured(s, colour, texture, lanes, texture_point<F>(s, p), &p);
}

/// Radiance that a light sends from a point on it. element: the light's element.
template <class F>
TYNDALL_INLINE Vec3<F> light_radiance(const auto& s, IntOf<F> element, Vec3<F> point, MaskOf<F> lanes) {
  SurfacePoint<F> p;
  p.element = element;
  p.material = lookup<F>(s.elements.material, s.elements.count(), element);
  p.point = point;
  p.inverted = less(F(1.0f), F(0.0f));
  p.normal = zero3<F>();
  if (s.has_image_textures()) {
    const Vec3<F> arm = point - lookup<F>(s.elements.center_or_normal, s.elements.count(), element);
    p.normal = (F(1.0f) / sqrt(max(dot(arm, arm), F(1e-37f)))) * arm;  // outward; only spheres use it
  }
  return surface_colour(s, p, lanes);
}

template <std::size_t first = 0, class M, class F>
TYNDALL_INLINE void load_fields(const auto& s, IntOf<F> material, M& m) {
  constexpr auto list = fields(static_cast<const M*>(nullptr));
  if constexpr (first < std::tuple_size_v<decltype(list)>) {
    constexpr auto member = std::get<first>(list).value;
    m.*member = lookup<F>(s.materials.parameter[first], s.materials.count(), material);
    load_fields<first + 1, M, F>(s, material, m);
  }
}

/// A material of kind M with its fields read from the columns.
template <class M, class F>
TYNDALL_INLINE M load_material(const auto& s, IntOf<F> material) {
  M m{};
  load_fields<0, M, F>(s, material, m);
  return m;
}

// Kernels know a list of materials by the type of the scene's view: SceneView::MaterialList. A test can give its own
// view with a longer list, and use the same path loop.

/// The materials that kernels with this view know, for lanes of type F.
template <class View, class F>
using MaterialsOf = typename std::remove_cvref_t<View>::template MaterialList<F>;

/// has_trait() for the material list of a view.
template <bool BsdfTraits::*trait, class View, class I>
TYNDALL_INLINE auto has_trait(const View&, I kind) {
  return has_trait<trait, MaterialsOf<View, double>>(kind);
}

/// Whether every material of a view changes a path's throughput by its colour alone.
template <class View>
inline constexpr bool has_constant_weights =
    all_have<&BsdfTraits::constant_weight>(static_cast<const MaterialsOf<View, double>*>(nullptr));

/// Whether the integrator samples lights where a material of kind M scatters.
template <class M>
TYNDALL_INLINE bool samples_lights(const auto& s) {
  constexpr LightSampling rule = M::traits.light_sampling;
  return rule == LightSampling::always || (rule == LightSampling::weighted && s.integrator == Integrator::mis);
}

/// Samples the BSDF in lanes whose material is of kind `first` or a later kind.
template <std::size_t first, class F>
TYNDALL_INLINE void sample_kinds(const auto& s, IntOf<F> material, IntOf<F> kind, MaskOf<F> lanes,
                                 const Incident<F>& in, BsdfSample<F>& out) {
  using List = MaterialsOf<decltype(s), F>;
  if constexpr (first < std::variant_size_v<List>) {
    using M = std::variant_alternative_t<first, List>;
    const auto here = mask_and(lanes, equal(kind, IntOf<F>(static_cast<std::int32_t>(first))));
    if (any(here)) {
      const BsdfSample<F> one = sample(load_material<M, F>(s, material), in);
      out.direction = select(here, one.direction, out.direction);
      if constexpr (!M::traits.constant_weight) out.weight = select(here, one.weight, out.weight);
      out.flags.absorbed = mask_or(out.flags.absorbed, mask_and(here, one.flags.absorbed));
      out.flags.transmitted = mask_or(out.flags.transmitted, mask_and(here, one.flags.transmitted));
      const F pdf = samples_lights<M>(s) ? one.pdf : F(one_direction);
      out.pdf = select(here, pdf, out.pdf);
    }
    sample_kinds<first + 1>(s, material, kind, lanes, in, out);
  }
}

/// Samples the BSDF of each lane's material. weight: 1 in other lanes.
template <class F>
TYNDALL_INLINE BsdfSample<F> sample_any(const auto& s, IntOf<F> material, IntOf<F> kind, MaskOf<F> lanes,
                                        const Incident<F>& in) {
  const MaskOf<F> none = less(F(1.0f), F(0.0f));
  BsdfSample<F> out{in.facing, F(1.0f), F(one_direction), {none, none}};
  sample_kinds<0>(s, material, kind, lanes, in, out);
  return out;
}

/// eval() and pdf() of one direction.
template <class F>
struct BsdfValue {
  F value, pdf;
};

/// eval() and pdf() of each lane's material. 0 for materials for which lights are not sampled, and for kinds before
/// `first`.
template <std::size_t first = 0, class F>
TYNDALL_INLINE BsdfValue<F> eval_any(const auto& s, IntOf<F> material, IntOf<F> kind, MaskOf<F> lanes,
                                     const Incident<F>& in, Vec3<F> direction) {
  using List = MaterialsOf<decltype(s), F>;
  BsdfValue<F> out{F(0.0f), F(0.0f)};
  if constexpr (first < std::variant_size_v<List>) {
    using M = std::variant_alternative_t<first, List>;
    out = eval_any<first + 1>(s, material, kind, lanes, in, direction);
    if constexpr (M::traits.light_sampling != LightSampling::never) {
      const auto here = mask_and(lanes, equal(kind, IntOf<F>(static_cast<std::int32_t>(first))));
      if (samples_lights<M>(s) && any(here)) {
        const M m = load_material<M, F>(s, material);
        out.pdf = select(here, pdf(m, in, direction), out.pdf);
        if constexpr (!has_constant_weights<decltype(s)>) out.value = select(here, eval(m, in, direction), out.value);
      }
    }
  }
  if constexpr (has_constant_weights<decltype(s)>) out.value = out.pdf;
  return out;
}

/// lobe_width() of a material of the scene.
template <std::size_t first = 0, class View>
TYNDALL_INLINE double lobe_width_of(const View& s, std::int32_t material) {
  using List = MaterialsOf<View, float>;
  if constexpr (first == std::variant_size_v<List>)
    return 1;
  else if (s.materials.kind[material] != static_cast<std::int32_t>(first))
    return lobe_width_of<first + 1>(s, material);
  else
    return lobe_width(load_material<std::variant_alternative_t<first, List>, float>(s, material));
}

/// Whether light from behind a surface may be sampled: some material that samples lights also transmits.
template <class View>
inline constexpr bool samples_lights_behind = []<class... Kinds>(const std::variant<Kinds...>*) {
  return ((Kinds::traits.transmissive && Kinds::traits.light_sampling != LightSampling::never) || ...);
}(static_cast<const MaterialsOf<View, double>*>(nullptr));

/// The smooth boundary that each lane is at; set in lanes whose material has one.
template <class F>
TYNDALL_INLINE Boundary<F> boundary_any(const auto& s, IntOf<F> material, const Incident<F>& in) {
  using List = MaterialsOf<decltype(s), F>;
  constexpr auto list = static_cast<const List*>(nullptr);
  constexpr std::size_t place = next_with<&BsdfTraits::smooth_boundary>(list, 0);
  static_assert(next_with<&BsdfTraits::smooth_boundary>(list, place + 1) == std::variant_size_v<List>,
                "a second material with smooth boundaries: select between them here, as eval_any() does");
  return boundary_at(load_material<std::variant_alternative_t<place, List>, F>(s, material), in);
}

/// Ray::from of rays that continue through a surface. from: that of rays that leave the surface on the side from which
/// they came. Swaps inside and outside.
template <class F>
TYNDALL_INLINE IntOf<F> through_surface(IntOf<F> from) {
  const IntOf<F> side = from & IntOf<F>(1);
  return from + IntOf<F>(1) - (side + side);
}

}  // namespace tyndall
