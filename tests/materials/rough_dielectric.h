#pragma once
#include "core/materials/materials.h"
#include "tests/support/event.h"

#include <tuple>
#include <variant>

/// Ground glass, for tests alone: a material whose samples are not all of the same weight. The program does not know
/// it; it shows that a material needs its own header and a place in a list.
namespace tyndall::test {

/// A boundary of many small smooth facets, whose normals are spread as GGX says; light that meets a second facet is
/// lost. B. Walter, S. Marschner, H. Li, K. Torrance, Microfacet Models for Refraction through Rough Surfaces, EGSR
/// 2007. In comments below v is the direction back along the path, l the one in which it goes on, h a facet's normal.
template <class F = double>
struct RoughDielectric {
  static constexpr const char* type = "rough_dielectric";
  static constexpr const char* about = "Ground glass: reflects and refracts into lobes.";
  static constexpr const char* colour_name = nullptr;
  static constexpr BsdfTraits traits{.glossy = true, .transmissive = true, .light_sampling = LightSampling::weighted};
  F roughness = F(0.4);
  F refractive_index = F(1.5);
  bool operator==(const RoughDielectric&) const = default;
};

template <class F>
constexpr auto fields(const RoughDielectric<F>*) {
  return std::tuple{
      Field{"roughness", &RoughDielectric<F>::roughness, inside(0, 1), Slider{0, 1}, "", "typical slope of the facets"},
      Field{"refractive_index", &RoughDielectric<F>::refractive_index, above(0), Slider{0.5, 3}, "",
            "inside over outside; not 1"}};
}

template <class F>
constexpr double lobe_width(const RoughDielectric<F>& m) {
  return static_cast<double>(m.roughness);
}

/// Density of facet normals, per steradian and per unit area of the surface, at a cosine from the surface's normal.
template <class F>
TYNDALL_INLINE F facet_density(F roughness, F cosine) {
  const F a2 = roughness * roughness, d = mul_add(cosine * cosine, a2 - F(1.0f), F(1.0f));
  return a2 / (F(static_cast<float>(pi)) * d * d);
}

/// Fraction of the facets turned to a direction that is seen from there (Smith's masking function). cosine: of the
/// direction from the surface's normal, on either side.
template <class F>
TYNDALL_INLINE F seen_fraction(F roughness, F cosine) {
  const F c2 = max(cosine * cosine, F(1e-20f)), a2 = roughness * roughness;
  return F(2.0f) / (F(1.0f) + sqrt(mul_add(a2, (F(1.0f) - c2) / c2, F(1.0f))));
}

/// Normal of a facet that is seen from v, drawn in proportion to the area that is seen. E. Heitz, Sampling the GGX
/// Distribution of Visible Normals, JCGT 7(4), 2018.
template <class F>
TYNDALL_INLINE Vec3<F> visible_normal(F roughness, const Incident<F>& in, Pair<F> u) {
  const Basis<F> frame = basis_around(in.facing);
  const Vec3<F> v = -in.direction;
  const Vec3<F> stretched = normalize(Vec3<F>{roughness * dot(v, frame.s), roughness * dot(v, frame.t), in.cosine});
  const Pair<F> disc = in_disc(u);
  // The part of the disc that is seen of the hemisphere is cut off along `side`, which is level.
  const Vec3<F> tilt = cross(stretched, Vec3<F>{F(0.0f), F(0.0f), F(1.0f)});
  const F sine2 = dot(tilt, tilt);
  const auto straight = less(sine2, F(1e-12f));
  const Vec3<F> side =
      select(straight, Vec3<F>{F(1.0f), F(0.0f), F(0.0f)}, (F(1.0f) / sqrt(max(sine2, F(1e-12f)))) * tilt);
  const Vec3<F> up = cross(side, stretched);
  const F s = F(0.5f) * (F(1.0f) + stretched.z);
  const F y = mul_add(F(1.0f) - s, sqrt(max(neg_mul_add(disc.x, disc.x, F(1.0f)), F(0.0f))), s * disc.y);
  const F z = sqrt(max(F(1.0f) - disc.x * disc.x - y * y, F(0.0f)));
  const Vec3<F> round = point_at(point_at(disc.x * side, y, up), z, stretched);
  const Vec3<F> local = normalize(Vec3<F>{roughness * round.x, roughness * round.y, max(round.z, F(1e-6f))});
  return point_at(point_at(local.z * in.facing, local.x, frame.s), local.y, frame.t);
}

/// The event at a facet.
template <class F>
TYNDALL_INLINE Incident<F> at_facet(const Incident<F>& in, Vec3<F> h) {
  Incident<F> facet = in;
  facet.normal = facet.facing = h;
  facet.cosine = min(max(-dot(in.direction, h), F(0.0f)), F(1.0f));
  return facet;
}

/// What both pdf() and eval() say of the facets that send light from l to v.
template <class F>
struct FacetLink {
  Boundary<F> boundary;
  F cos_v, cos_l;          ///< to the normal of the facet: > 0, and < 0 for light that passes through
  F surface_v, surface_l;  ///< to the normal of the surface, likewise
  F facets;                ///< density of the facets
  F per_direction;         ///< solid angle of facets over that of l
  MaskOf<F> transmitted, possible;
};

template <class F>
TYNDALL_INLINE FacetLink<F> facet_link(const RoughDielectric<F>& m, const Incident<F>& in, Vec3<F> l) {
  FacetLink<F> link;
  const F zero = F(0.0f), eta = select(in.exiting, F(1.0f) / m.refractive_index, m.refractive_index);
  link.surface_v = in.cosine, link.surface_l = dot(l, in.facing);
  link.transmitted = less(link.surface_l, zero);
  const Vec3<F> between = point_at(-in.direction, select(link.transmitted, eta, F(1.0f)), l);
  const Vec3<F> half = normalize(between);
  const Vec3<F> h = select(less(dot(half, in.facing), zero), -half, half);
  link.boundary = boundary_at(Dielectric<F>{m.refractive_index}, at_facet(in, h));
  link.cos_v = -dot(in.direction, h), link.cos_l = dot(l, h);
  link.facets = facet_density(m.roughness, dot(h, in.facing));
  const F sum = mul_add(eta, link.cos_l, link.cos_v);
  link.per_direction = select(link.transmitted, eta * eta * abs(link.cos_l) / max(sum * sum, F(1e-30f)),
                              F(0.25f) / max(link.cos_v, F(1e-15f)));
  const auto same_side = less(zero, select(link.transmitted, -link.cos_l, link.cos_l));
  link.possible = mask_and(mask_and(less(zero, link.cos_v), same_side), less(zero, link.surface_v));
  return link;
}

/// Fraction of the light that a facet sends from l to v.
template <class F>
TYNDALL_INLINE F facet_fraction(const FacetLink<F>& link) {
  const F reflected = link.boundary.reflected;
  return select(link.transmitted, F(1.0f) - reflected, reflected);
}

/// The density of the facets that v sees, times the share that they send on. Directions on the wrong side of the
/// surface, in which a second facet is met, are left out, so the integral is less than 1.
template <class F>
TYNDALL_INLINE F pdf(const RoughDielectric<F>& m, const Incident<F>& in, Vec3<F> direction) {
  const FacetLink<F> link = facet_link(m, in, direction);
  const F seen = seen_fraction(m.roughness, link.surface_v) * link.cos_v * link.facets / max(link.surface_v, F(1e-15f));
  return select(link.possible, facet_fraction(link) * seen * link.per_direction, F(0.0f));
}

/// Walter et al., equations 20 and 21, times the cosine of l; through the surface without their square of the index on
/// the side of v over that of l.
template <class F>
TYNDALL_INLINE F eval(const RoughDielectric<F>& m, const Incident<F>& in, Vec3<F> direction) {
  const FacetLink<F> link = facet_link(m, in, direction);
  const F seen = seen_fraction(m.roughness, link.surface_v) * seen_fraction(m.roughness, link.surface_l);
  const F eta = link.boundary.eta, root = mul_add(eta, link.cos_l, link.cos_v);
  const F through = link.cos_v * abs(link.cos_l) * eta * eta / max(root * root, F(1e-30f));
  const F geometry = select(link.transmitted, through, F(0.25f)) / max(link.surface_v, F(1e-15f));
  return select(link.possible, facet_fraction(link) * seen * link.facets * geometry, F(0.0f));
}

/// Draws a facet that v sees, and reflects or refracts at it. What is left of eval over pdf is the fraction of the
/// facet that l sees.
template <class F>
TYNDALL_INLINE BsdfSample<F> sample(const RoughDielectric<F>& m, const Incident<F>& in) {
  const Vec3<F> h = visible_normal(m.roughness, in, in.sampler.next_2d(dimension::direction));
  const Incident<F> facet = at_facet(in, h);
  const Boundary<F> b = boundary_at(Dielectric<F>{m.refractive_index}, facet);
  BsdfSample<F> out = leave_boundary(b, facet, less(in.sampler.next_1d(dimension::lobe), b.reflected));
  const F cosine = dot(out.direction, in.facing);
  const F outward = select(out.flags.transmitted, -cosine, cosine);
  out.flags.absorbed = less_equal(outward, F(0.0f));
  out.weight = seen_fraction(m.roughness, cosine);
  out.pdf = pdf(m, in, out.direction);
  return out;
}

/// The program's list, and ground glass.
template <class List>
struct WithRoughDielectric;
template <class F, template <class> class... Kinds>
struct WithRoughDielectric<std::variant<Kinds<F>...>> {
  using type = std::variant<Kinds<F>..., RoughDielectric<F>>;
};
template <class F>
using LongerList = typename WithRoughDielectric<MaterialKinds<F>>::type;

/// Fraction of the light that ground glass of index 1.5 sends on, by reflection and by refraction, and the fraction of
/// the draws that meet a second facet. Integrated over the normals of facets by a program of its own, where tests
/// integrate over directions.
struct GroundGlass {
  double roughness, angle;
  bool leaving;
  double reflected, refracted, lost;
};
inline constexpr GroundGlass ground_glasses[] = {
    {0.1, 0.2, false, 0.039734, 0.959050, 0.001063}, {0.1, 1.0, true, 0.937024, 0.029338, 0.017953},
    {0.4, 0.2, false, 0.032237, 0.946193, 0.015333}, {0.4, 1.0, false, 0.047543, 0.877823, 0.025224},
    {0.4, 1.4, false, 0.091409, 0.725243, 0.018121}, {0.4, 0.2, true, 0.063674, 0.762699, 0.136031},
    {0.4, 1.0, true, 0.505048, 0.206047, 0.116674},  {0.8, 0.2, false, 0.017830, 0.905707, 0.047972},
    {0.8, 1.0, false, 0.026200, 0.750096, 0.038472}, {0.8, 1.0, true, 0.216774, 0.305090, 0.197003}};

/// Light that comes down at `angle` and meets the glass from outside or from within.
inline Incident<double> event_of(const GroundGlass& row, std::uint32_t number) {
  return event(sampler<double>(number), down_at<double>(row.angle), row.leaving ? -up<double> : up<double>);
}

}  // namespace tyndall::test
