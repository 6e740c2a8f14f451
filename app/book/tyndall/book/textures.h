#pragma once
#include "files.h"
#include "values.h"

/// The reader's textures, told by their members and their values.
namespace tyndall_book {

template <class N>
std::string texture_name(scene_text& out, const typename N::texture& t);

template <class N>
class texture_text {
 public:
  using texture = typename N::texture;
  using rays = ray_traits<typename N::ray>;
  texture_text(scene_text& out, const texture& t) : out_(out), t_(t) {}

  std::string text() {
    const vector first = value(0.5, 0.5, {});
    bool one_colour = true, flat = true;
    for (int k = 0; k < 60; ++k) {
      const vector p = random_.between(0, 40) * random_.on_sphere();
      const double u = random_.next(), v = random_.next();
      one_colour = one_colour && near(value(u, v, p), first, 1e-9);
      flat = flat && near(value(u, v, p), value(u, v, {}), 1e-9);
    }
    if (one_colour) return triple(first);
    std::string made;
    N::with_class(t_, [&](const auto& o) { made = flat ? image() : pattern(o); });
    return made;
  }

 private:
  vector value(double u, double v, vector p) { return N::value(t_, u, v, rays::make_vector(p)); }
  std::string image() {
    const opened_files& files = opened_files::get();
    const auto file = files.of_object.find(dynamic_cast<const void*>(&t_));
    if (file == files.of_object.end()) refuse(t_, "no such texture in Tyndall");
    out_.has_images = true;
    if (!N::reads_linear_images)
      out_.note("its program takes the numbers of images as they are, Tyndall takes them as sRGB");
    return "{\"type\":\"image\",\"file\":" + quoted(file->second) + "}";
  }
  template <class T>
  std::string pattern(const T& o) {
    decltype(auto) even = TYNDALL_ANY(o, even, m_even, even_);
    decltype(auto) odd = TYNDALL_ANY(o, odd, m_odd, odd_);
    if constexpr (!is_absent<decltype(even)> && !is_absent<decltype(odd)>) return checker(o, part(even), part(odd));
    return noise(o);
  }
  template <class P>
  std::string part(P& member) {
    if constexpr (is_vector<P>) {
      return triple(to_vector(member));
    } else if constexpr (leads_to<texture, P>()) {
      const std::string name = texture_name<N>(out_, *pointer(member));
      if (name[0] == '[') return name;
    }
    refuse(t_, "Tyndall's checker takes two colours, not textures");
  }
  template <class T>
  std::string checker(const T& o, const std::string& even, const std::string& odd) {
    double scale = 3.14159265358979323846 / 10;  // of the sines of editions 1 to 3
    decltype(auto) inverse = pick(o, TYNDALL_GET(1 / double(o.inv_scale)), TYNDALL_GET(1 / double(o.m_inv_scale)),
                                  TYNDALL_GET(1 / double(o.invScale)), TYNDALL_GET(double(o.scale)));
    if constexpr (!is_absent<decltype(inverse)>) scale = inverse;
    for (int k = 0; k < 400; ++k) {
      const vector p = (random_.between(0, 20) * scale) * random_.on_sphere();
      const double q[3] = {p.x / scale, p.y / scale, p.z / scale};
      bool edge = false;
      double sum = 0;
      for (const double a : q) edge = edge || std::fabs(a - std::round(a)) < 1e-3, sum += std::floor(a);
      const std::string its = triple(value(0.5, 0.5, p));
      if (!edge && its != (std::fmod(std::fabs(sum), 2) < 0.5 ? even : odd))
        refuse(t_, "its squares are not those of the books");
    }
    return "{\"type\":\"checker\",\"scale\":" + number(scale) + ",\"even\":" + even + ",\"odd\":" + odd + "}";
  }
  /// The lattice of noise is anybody's: it is told by range, mean and spread.
  template <class T>
  std::string noise(const T& o) {
    double scale = 1, sum = 0, squares = 0;
    decltype(auto) member = TYNDALL_ANY_AS(double, o, scale, m_scale, scale_);
    if constexpr (!is_absent<decltype(member)>) scale = member;
    constexpr int rounds = 6000;
    for (int k = 0; k < rounds; ++k) {
      const vector one = value(0.5, 0.5, (random_.between(0, 60) / scale) * random_.on_sphere());
      if (!near(one.x, one.y, 1e-3) || !near(one.x, one.z, 1e-3) || one.x < -0.01 || one.x > 1.01)
        refuse(t_, "no such texture in Tyndall");
      sum += one.x, squares += one.x * one.x;
    }
    const double mean = sum / rounds, spread = std::sqrt(squares / rounds - mean * mean);
    const bool marble = spread > 0.27 && spread<0.39, plain = spread> 0.06 && spread < 0.2;
    if (std::fabs(mean - 0.5) > 0.06 || !(marble || plain)) refuse(t_, "no such texture in Tyndall");
    out_.has_noise = true;
    return std::string("{\"type\":\"noise\",\"style\":\"") + (marble ? "marble" : "perlin") +
           "\",\"scale\":" + number(scale) + "}";
  }

  scene_text& out_;
  const texture& t_;
  random_numbers random_;
};

template <class N>
std::string texture_name(scene_text& out, const typename N::texture& t) {
  return out.name_of(t, out.textures, [&] { return texture_text<N>(out, t).text(); });
}

}  // namespace tyndall_book
