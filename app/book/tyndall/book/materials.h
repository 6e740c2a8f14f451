#pragma once
#include "textures.h"

/// The reader's materials, told by what their scatter() and emitted() do: they are asked some thousand times.
namespace tyndall_book {

/// Where a ray has met something, in the reader's terms.
struct surface_point {
  vector p{0.3, -0.2, 0.7};
  bool front = true;
  double u = 0.37, v = 0.61;
};
/// What scatter() answers.
struct scattered {
  bool does = false;
  vector part, to;
  double time = 0;
};

/// Whether a hit was from the side that the normal points to.
template <class R>
decltype(auto) front_member(R& record) {
  return TYNDALL_ANY(record, front_face, frontFace, front_facing, frontFacing, is_front, isFrontFace, isFront, outside,
                     m_front_face);
}
template <class R>
bool is_front(R& record, vector to, vector normal) {
  decltype(auto) front = front_member(record);
  if constexpr (is_absent<decltype(front)>)
    return dot(to, normal) < 0;
  else
    return front;
}
/// Whether normals in records are turned to the ray, as editions 2 to 4 have it.
template <class R>
constexpr bool has_facing_normals = !is_absent<decltype(front_member(std::declval<R&>()))>;
template <class R>
decltype(auto) material_member(R& record) {
  return TYNDALL_ANY(record, mat, mat_ptr, material, material_ptr, matPtr, materialPtr, mp, mat_pointer, m_material,
                     pMat, m_mat, Mat, m);
}
template <class N>
const typename N::material* material_in(typename N::record& record) {
  decltype(auto) member = material_member(record);
  if constexpr (leads_to<typename N::material, decltype((member))>())
    return pointer(member);
  else
    return nullptr;
}
/// What the third book's materials answer: a mirror's ray, or a density that directions are drawn from.
template <class N, class R>
void read_record(R& all, scattered& one) {
  using rays = ray_traits<typename N::ray>;
  decltype(auto) part = pick(all, TYNDALL_GET(o.attenuation), TYNDALL_GET(o.albedo));
  if constexpr (is_vector<decltype(part)>) one.part = to_vector(part);
  decltype(auto) specular = pick(all, TYNDALL_GET(bool(o.skip_pdf)), TYNDALL_GET(bool(o.is_specular)));
  decltype(auto) ray = pick(all, TYNDALL_GET(o.skip_pdf_ray), TYNDALL_GET(o.specular_ray));
  if constexpr (!is_absent<decltype(specular)> && !is_absent<decltype(ray)>)
    if (specular) one.to = rays::direction(ray);
  if constexpr (TYNDALL_HAS(R, to_vector(o.pdf_ptr->generate())))
    if (!(length(one.to) > 0) && one.does) one.to = to_vector(all.pdf_ptr->generate());
}
/// A record of a hit from above, or from below a surface whose normal is y.
template <class N>
typename N::record make_record(const surface_point& at) {
  typename N::record record{};
  using rays = ray_traits<typename N::ray>;
  record.t = 1;
  record.p = rays::make_vector(at.p);
  record.normal = rays::make_vector({0, at.front || !has_facing_normals<typename N::record> ? 1.0 : -1.0, 0});
  const auto set = [](auto&& member, auto value) {
    if constexpr (!is_absent<decltype(member)>) member = value;
  };
  set(pick(record, TYNDALL_GET(o.u)), at.u), set(pick(record, TYNDALL_GET(o.v)), at.v);
  set(front_member(record), at.front);
  return record;
}

template <class N>
class material_text {
 public:
  using material = typename N::material;
  using rays = ray_traits<typename N::ray>;
  material_text(scene_text& out, const material& m) : out_(out), m_(m) {}

  std::string text() {
    const bool shines = largest(emitted({})) > 0 || largest(emitted({{}, false})) > 0;
    const scattered first = ask({}, slanted);
    if (shines && first.does) refuse(m_, "it shines and scatters: Tyndall's lights do one of both");
    if (shines) {
      const std::string light = colour([&](const surface_point& at) { return emitted(at); });
      if (light[0] == '[') out_.shining = &m_, out_.light = emitted({});
      return "{\"type\":\"light\",\"radiance\":" + light + "}";
    }
    for (const int count : {2000, 40000})  // what two thousand rays leave open, more decide
      if (const std::string made = scattering(ask_often({}, slanted, count)); !made.empty()) return made;
    refuse(m_, "no such material in Tyndall");
  }
  /// The colour of fog.
  std::string medium() {
    vector sum;
    for (const scattered& one : ask_often({}, slanted, 2000)) sum = sum + normalized(one.to);
    if (!(length(sum) < 0.06 * 2000)) refuse(m_, "its fog does not scatter to all sides alike");
    return albedo();
  }
  vector emitted(const surface_point& at) {
    typename N::record record = make_record<N>(at);
    const vector to = at.front ? slanted : vector{slanted.x, -slanted.y, 0};
    return N::emitted(m_, rays::make(at.p - to, to, 0), record, at.u, at.v, rays::make_vector(at.p));
  }

 private:
  static constexpr vector slanted{0.8, -0.6, 0}, steep{0.28, -0.96, 0};  ///< of rays that meet the surface from above
  /// The material by how it scatters; "": by none of the books' rules.
  std::string scattering(const std::vector<scattered>& all) {
    const scattered& first = all.front();
    std::size_t absorbed = 0;
    bool same = true;
    for (const scattered& one : all) {
      absorbed += one.does ? 0 : 1;
      if (!one.does) continue;
      same = same && near(normalized(one.to), normalized(first.to), 1e-4);
    }
    const bool refracts = normalized(ask({}, steep).to).y < 0 || normalized(ask({}, steep).to).y < 0 ||
                          normalized(ask({}, steep).to).y < 0;
    if (refracts && absorbed == 0) return glass();
    if (absorbed == all.size()) return "{\"type\":\"lambertian\",\"albedo\":[0,0,0]}";
    if (same && near(normalized(first.to), mirror(slanted), 1e-3)) return metal(0);
    if (!is_matt(all)) return fuzzy(all, absorbed);
    const std::string part = albedo();
    if (part[0] == '[' && largest(first.part) > 0) out_.matt = &m_, out_.albedo = first.part;
    return "{\"type\":\"lambertian\",\"albedo\":" + part + "}";
  }
  static vector mirror(vector to) { return {to.x, -to.y, to.z}; }
  scattered ask(const surface_point& at, vector to) {
    typename N::record record = make_record<N>(at);
    scattered one = N::scatter(m_, rays::make(at.p - to, to, 0.5), record);
    if (one.does && !(length(one.to) > 0)) one.to = {0, 1, 0};
    return one;
  }
  std::vector<scattered> ask_often(const surface_point& at, vector to, int count) {
    std::vector<scattered> all;
    for (int k = 0; k < count; ++k) all.push_back(ask(at, to));
    return all;
  }
  /// A colour, or the name of the texture that it comes from.
  template <class F>
  std::string colour(const F& of) {
    const vector first = of(surface_point{});
    random_numbers random;
    bool same = true;
    for (int k = 0; k < 40; ++k)
      same = same &&
             near(of({random.between(0, 30) * random.on_sphere(), true, random.next(), random.next()}), first, 1e-9);
    if (same) return triple(first);
    std::string name;
    N::with_class(m_, [&](const auto& o) {
      decltype(auto) member =
          TYNDALL_ANY(o, tex, albedo, emit, texture, m_albedo, m_texture, albedo_, m_tex, color, m_emit);
      if constexpr (leads_to<typename N::texture, decltype((member))>()) name = texture_name<N>(out_, *pointer(member));
    });
    if (name.empty()) refuse(m_, "its colour is neither one colour nor one of its textures");
    return name;
  }
  std::string albedo() {
    return colour([&](const surface_point& at) {
      for (int k = 0; k < 1000; ++k) {
        const scattered one = ask(at, slanted);
        if (one.does) return one.part;
      }
      return vector{};
    });
  }
  std::string metal(double fuzz) {
    if (!near(normalized(ask({}, {0, -2, 0}).to), {0, 1, 0}, fuzz > 0 ? 2 : 1e-3))
      refuse(m_, "it is no mirror from everywhere");
    const std::string part = albedo();
    if (part[0] != '[') refuse(m_, "its colour is a texture: Tyndall's metals have one colour");
    return "{\"type\":\"metal\",\"albedo\":" + part + ",\"fuzz\":" + number(fuzz) + "}";
  }
  /// The mean cosine tells the edition: 2/3 by a point on the sphere, which is matt; 4/5 by one in the ball, as in the
  /// first and second.
  bool is_matt(const std::vector<scattered>& all) {
    vector sum;
    for (const scattered& one : all) {
      if (!one.does || one.to.y < 0) return false;
      sum = sum + normalized(one.to);
    }
    const vector mean = (1.0 / static_cast<double>(all.size())) * sum;
    const bool in_sphere = std::fabs(mean.y - 0.8) < 0.02;
    if ((!in_sphere && std::fabs(mean.y - 2.0 / 3) > 0.02) || std::fabs(mean.x) > 0.06 || std::fabs(mean.z) > 0.06)
      return false;
    out_.matt_in_sphere = out_.matt_in_sphere || in_sphere;
    return true;
  }
  /// Share of reflected light by Fresnel's equations, and by Schlick's rule; cosine: of incidence.
  static double fresnel(double cosine, double ratio) {
    const double sin2 = (1 - cosine * cosine) * ratio * ratio, out = std::sqrt(std::fmax(0, 1 - sin2));
    if (sin2 >= 1) return 1;
    const double s = (ratio * cosine - out) / (ratio * cosine + out),
                 p = (ratio * out - cosine) / (ratio * out + cosine);
    return 0.5 * (s * s + p * p);
  }
  static double schlick(double cosine, double ratio) {
    const double r0 = (1 - ratio) / (1 + ratio);
    return ratio * ratio * (1 - cosine * cosine) >= 1 ? 1 : r0 * r0 + (1 - r0 * r0) * std::pow(1 - cosine, 5);
  }
  std::string glass() {
    double index = 0;
    for (int k = 0; k < 2000 && index == 0; ++k) {
      const vector to = normalized(ask({}, steep).to);
      if (to.y < 0) index = steep.x / std::sqrt(to.x * to.x + to.z * to.z);
    }
    N::with_class(m_, [&](const auto& o) {
      decltype(auto) member = TYNDALL_ANY_AS(double, o, refraction_index, ir, ref_idx, ior, refractive_index, m_ior,
                                             m_ref_idx, refractionIndex);
      if constexpr (!is_absent<decltype(member)>)
        if (near(member, index, 1e-4)) index = member;
    });
    if (!(index > 0)) refuse(m_, "its glass lets nothing through");
    for (const bool front : {true, false})
      for (const double cosine : {0.95, 0.6, 0.3, 0.15}) {
        const double sine = std::sqrt(1 - cosine * cosine), ratio = front ? 1 / index : index, side = front ? -1 : 1;
        int reflected = 0;
        constexpr int rounds = 1500;
        for (int k = 0; k < rounds; ++k) {
          const scattered one = ask({{}, front}, {sine, side * cosine, 0});
          const vector to = normalized(one.to);
          if (!one.does || largest(one.part - vector{1, 1, 1}) > 1e-3)
            refuse(m_, "its glass takes light away: Tyndall's is clear");
          const bool back = to.y * side < 0;
          reflected += back ? 1 : 0;
          if (std::fabs(to.x - (back ? 1 : ratio) * sine) > 0.01)
            refuse(m_, "it refracts otherwise than the books' glass");
        }
        const double fraction = double(reflected) / rounds;
        const auto fits = [&](double r) {
          return std::fabs(fraction - r) < 5 * std::sqrt(r * (1 - r) / rounds) + 0.004;
        };
        if (!fits(schlick(cosine, ratio)) && !fits(fresnel(cosine, ratio)) && !fits(schlick(cosine, 1 / ratio)))
          refuse(m_, "it reflects " + words({fraction, schlick(cosine, ratio), cosine}) +
                         " (its share, the books', the cosine): not as the books' glass");
      }
    return "{\"type\":\"dielectric\",\"refractive_index\":" + number(index) + "}";
  }
  /// Metal with fuzz: a point in the unit ball or on its surface, times fuzz, is added to the mirror's direction.
  std::string fuzzy(const std::vector<scattered>& all, std::size_t absorbed) {
    double fuzz = -1;
    N::with_class(m_, [&](const auto& o) {
      decltype(auto) member =
          TYNDALL_ANY_AS(double, o, fuzz, fuzziness, m_fuzz, roughness, fuzz_, fuzzy, m_fuzziness, _fuzz);
      if constexpr (!is_absent<decltype(member)>) fuzz = member;
    });
    const auto spread = [&](const std::vector<vector>& to, double lost) {
      vector mean;
      for (const vector& one : to) mean = mean + normalized(one);
      mean = (1.0 / static_cast<double>(larger(to.size(), std::size_t(1)))) * mean;
      return vector{dot(mean, mirror(slanted)), mean.y, lost};
    };
    std::vector<vector> his;
    for (const scattered& one : all)
      if (one.does) his.push_back(one.to);
    const vector found = spread(his, static_cast<double>(absorbed) / static_cast<double>(all.size()));
    for (const bool on_sphere : {false, true}) {
      random_numbers random;
      std::vector<vector> ours;
      double lost = 0;
      const int rounds = static_cast<int>(2 * all.size());
      for (int k = 0; k < rounds; ++k) {
        const double radius = on_sphere ? 1 : std::cbrt(random.next());
        const vector to = mirror(slanted) + (fuzz * radius) * random.on_sphere();
        if (to.y > 0)
          ours.push_back(to);
        else
          lost += 1.0 / rounds;
      }
      if (fuzz < 0 || largest(found - spread(ours, lost)) > 0.012) continue;
      out_.fuzz_on_sphere = out_.fuzz_on_sphere || on_sphere;
      return metal(fuzz);
    }
    return "";
  }

  scene_text& out_;
  const material& m_;
};

template <class N>
std::string material_name(scene_text& out, const typename N::material& m) {
  return out.name_of(m, out.materials, [&] { return material_text<N>(out, m).text(); });
}
template <class N>
std::string medium_colour(scene_text& out, const typename N::material& m) {
  return material_text<N>(out, m).medium();
}
template <class N>
bool shines_on_one_side(const typename N::material* m) {
  scene_text none;
  material_text<N> text(none, *m);
  return m && largest(text.emitted({})) > 0 && !(largest(text.emitted({{}, false})) > 0);
}

}  // namespace tyndall_book
