#include "app/book/inside/reading.h"
#include "core/base/math.h"
#include "core/base/text.h"
#include "core/materials/dielectric.h"

#include <fmt/core.h>

#include <algorithm>

namespace tyndall {
namespace {

constexpr book::surface_point slanted{}, behind{slanted.p, slanted.u, slanted.v, {0.8, 0.6, 0}, false};

Vec3d mirror(Vec3d to) { return {to.x, -to.y, to.z}; }
Vec3d mean_of(const std::vector<Vec3d>& all) {
  Vec3d sum;
  for (const Vec3d& one : all) sum = sum + one;
  return (1.0 / static_cast<double>(std::max(all.size(), std::size_t(1)))) * sum;
}
bool are_near(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b, double precision) {
  return std::equal(a.begin(), a.end(), b.begin(), [&](Vec3d x, Vec3d y) { return is_near(x, y, precision); });
}
/// The slanted one, and others at random.
std::vector<book::surface_point> some_points(int count, double far) {
  RandomNumbers random;
  std::vector<book::surface_point> points{slanted};
  for (int k = 0; k < count; ++k)
    points.push_back({random.between(0, far) * random.on_sphere(), random.next(), random.next()});
  return points;
}

template <class F>
std::vector<Vec3d> values_at(const std::vector<book::surface_point>& points, const F& of) {
  std::vector<Vec3d> values;
  for (const book::surface_point& at : points) values.push_back(of(at));
  return values;
}

class MaterialReader {
 public:
  MaterialReader(Reading& reading, const void* material)
      : r_(reading), m_(material), o_(reading.described('m', material)) {}

  std::string text() {
    const Vec3d light = emitted(slanted), back = emitted(behind);
    const bool shines = largest(light) > 0 || largest(back) > 0;
    if (shines && scatter(slanted).does) o_.refuse("it shines and scatters: Tyndall's lights do one of both");
    if (shines) {
      const std::string colour = colour_of([&](const book::surface_point& at) { return emitted(at); });
      if (colour[0] == '[') r_.shining = m_, r_.light = light;
      if (!(largest(back) > 0)) r_.one_sided.insert(m_);
      return "{\"type\":\"light\",\"radiance\":" + colour + "}";
    }
    const std::string made = scattering(scatter(slanted, 2000));
    return made.empty() ? scattering(scatter(slanted, many)) : made;
  }
  std::string medium_albedo() {
    std::vector<Vec3d> to;
    for (const book::scatter_answer& one : scatter(slanted, 2000)) to.push_back(normalize(one.to));
    if (!(length(mean_of(to)) < 0.06)) o_.refuse("its fog does not scatter to all sides alike");
    return albedo();
  }

 private:
  Vec3d emitted(const book::surface_point& at) { return r_.program.emitted(m_, at); }
  book::scatter_answer scatter(const book::surface_point& at) {
    book::scatter_answer one = r_.program.scatter(m_, at);
    if (one.does && !(length(one.to) > 0)) one.to = {0, 1, 0};
    return one;
  }
  std::vector<book::scatter_answer> scatter(const book::surface_point& at, std::size_t count) {
    std::vector<book::scatter_answer> all(count);
    for (book::scatter_answer& one : all) one = scatter(at);
    return all;
  }

  /// The material by how it scatters; "": by none of the books' rules, but more rays may decide.
  std::string scattering(const std::vector<book::scatter_answer>& all) {
    std::vector<Vec3d> to;
    for (const book::scatter_answer& one : all)
      if (one.does) to.push_back(normalize(one.to));
    book::surface_point steep = slanted;
    steep.to = {0.28, -0.96, 0};
    std::vector<Vec3d> through;
    for (const book::scatter_answer& one : scatter(steep, 200))
      if (one.to.y < 0) through.push_back(normalize(one.to));
    if (through.size() > 100 && to.size() == all.size()) return glass(steep.to, through[0]);
    if (to.empty()) return "{\"type\":\"lambertian\",\"albedo\":[0,0,0]}";
    const bool same = std::all_of(to.begin(), to.end(), [&](Vec3d one) { return is_near(one, to[0], 1e-4); });
    if (same && is_near(to[0], mirror(slanted.to), 1e-3)) return metal(0);
    const Vec3d mean = mean_of(to);
    const bool above = std::all_of(to.begin(), to.end(), [](Vec3d one) { return one.y >= 0; });
    // By a point on the sphere it is matt; by one in the ball, as in editions 1 and 2, its mean cosine is larger.
    for (const double cosine : {2.0 / 3, 0.8}) {
      if (to.size() != all.size() || !above || std::fabs(mean.y - cosine) > 0.02 || std::hypot(mean.x, mean.z) > 0.06)
        continue;
      r_.picture.matt_in_sphere = r_.picture.matt_in_sphere || cosine == 0.8;
      const std::string part = albedo();
      if (part[0] == '[' && largest(all[0].part) > 0) r_.matt = m_, r_.albedo = all[0].part;
      return "{\"type\":\"lambertian\",\"albedo\":" + part + "}";
    }
    for (const double fuzz : o_.numbers())
      for (const bool on_sphere : {false, true}) {
        if (fuzz < 0 || !is_fuzzy(to, all.size(), fuzz, on_sphere)) continue;
        r_.picture.fuzz_on_sphere = r_.picture.fuzz_on_sphere || on_sphere;
        return metal(fuzz);
      }
    if (all.size() < many) return "";
    o_.refuse(
        fmt::format("no such material in Tyndall: where the normal is (0, 1, 0), its rays go in the direction "
                    "({:.2f}, {:.2f}, {:.2f}) on the average, those of matt surfaces in (0, 0.67, 0)",
                    mean.x, mean.y, mean.z));
  }
  /// Whether so many rays go as those of metals, by a point in the ball around the mirror's direction, or on its sphere
  /// as in edition 4.
  static bool is_fuzzy(const std::vector<Vec3d>& to, std::size_t count, double fuzz, bool on_sphere) {
    RandomNumbers random;
    std::vector<Vec3d> ours;
    for (std::size_t k = 0; k < 2 * count; ++k) {
      const double radius = fuzz * (on_sphere ? 1 : std::cbrt(random.next()));
      const Vec3d one = mirror(slanted.to) + radius * random.on_sphere();
      if (one.y > 0) ours.push_back(normalize(one));
    }
    const double more =
        (0.5 * static_cast<double>(ours.size()) - static_cast<double>(to.size())) / static_cast<double>(count);
    return largest(mean_of(to) - mean_of(ours)) <= 0.012 && std::fabs(more) <= 0.012;
  }
  /// A colour, or the name of the texture that it comes from. of: the values at points of a surface.
  template <class F>
  std::string colour_of(const F& of) {
    const std::vector<book::surface_point> points = some_points(40, 30);
    const std::vector<Vec3d> values = values_at(points, of);
    if (are_near(values, std::vector(values.size(), values[0]), 1e-6)) return triple(values[0]);
    for (const void* texture : o_.objects('t'))
      if (are_near(values, values_at(points, [&](const auto& at) { return r_.program.value(texture, at); }), 1e-6))
        return texture_name(r_, texture);
    o_.refuse("its colour is neither one colour nor one of its textures");
  }
  std::string albedo() {
    return colour_of([&](const book::surface_point& at) {
      for (int k = 0; k < 12; ++k)  // some rays are lost
        if (const book::scatter_answer one = scatter(at); one.does) return one.part;
      return Vec3d{};
    });
  }
  std::string metal(double fuzz) {
    book::surface_point above = slanted;
    above.to = {0, -2, 0};
    if (!is_near(normalize(scatter(above).to), Vec3d{0, 1, 0}, fuzz > 0 ? 2 : 1e-3))
      o_.refuse("it is no mirror from everywhere");
    const std::string part = albedo();
    if (part[0] != '[') o_.refuse("its colour is a texture: Tyndall's metals have one colour");
    return fmt::format("{{\"type\":\"metal\",\"albedo\":{},\"fuzz\":{}}}", part, fuzz);
  }
  /// to, through: a direction from above, and where it goes in the glass.
  std::string glass(Vec3d to, Vec3d through) {
    double index = to.x / std::sqrt(through.x * through.x + through.z * through.z);
    for (const double member : o_.numbers())
      if (is_near(member, index, 1e-4)) index = member;
    for (const bool front : {true, false})
      for (const double cosine : {0.95, 0.6, 0.3, 0.15}) check_glass(index, front, cosine);
    return fmt::format("{{\"type\":\"dielectric\",\"refractive_index\":{}}}", index);
  }
  void check_glass(double index, bool front, double cosine) {
    const double sine = std::sqrt(1 - cosine * cosine), side = front ? -1 : 1, eta = front ? index : 1 / index;
    constexpr std::size_t rounds = 1500;
    int reflected = 0;
    for (const book::scatter_answer& one :
         scatter({slanted.p, slanted.u, slanted.v, {sine, side * cosine, 0}, front}, rounds)) {
      const Vec3d to = normalize(one.to);
      if (!one.does || !is_near(one.part, {1, 1, 1}, 1e-3)) o_.refuse("its glass takes light away: Tyndall's is clear");
      const bool back = to.y * side < 0;
      reflected += back ? 1 : 0;
      if (!(std::fabs(to.x - (back ? 1 : 1 / eta) * sine) <= 0.01))
        o_.refuse("it refracts otherwise than the books' glass");
    }
    const double fraction = reflected / double(rounds);
    for (const double known : {schlick(cosine, eta), fresnel(cosine, eta), schlick(cosine, 1 / eta)})
      if (std::fabs(fraction - known) < 5 * std::sqrt(known * (1 - known) / rounds) + 0.004) return;
    o_.refuse(fmt::format("at a cosine of {} it reflects {:.3f}, the books' glass {:.3f}", cosine, fraction,
                          schlick(cosine, eta)));
  }

  static constexpr std::size_t many = 40000;  ///< rays
  Reading& r_;
  const void* m_;
  const Described& o_;
};

class TextureReader {
 public:
  TextureReader(Reading& reading, const void* texture)
      : r_(reading), t_(texture), o_(reading.described('t', texture)) {}

  std::string text() {
    std::vector<book::surface_point> points = some_points(60, 40);
    const std::vector<Vec3d> values = value(points);
    if (are_near(values, std::vector(values.size(), values[0]), 1e-9)) return triple(values[0]);
    for (book::surface_point& one : points) one.p = {};
    const bool is_flat = are_near(values, value(points), 1e-9);
    if (is_flat && o_.file.empty()) o_.refuse("no such texture in Tyndall");
    if (is_flat) {
      r_.picture.has_images = true;
      std::vector<book::image_value> told;
      for (std::size_t k = 0; k < points.size(); ++k) told.push_back({points[k].u, points[k].v, values[k]});
      book::tell('I', told.data(), told.size() * sizeof told[0]);
      return "{\"type\":\"image\",\"file\":" + in_quotes(o_.file) + "}";
    }
    for (const void* texture : o_.objects('t'))
      if (texture_name(r_, texture)[0] != '[') o_.refuse("Tyndall's checker takes two colours, not textures");
    std::vector<double> scales{pi / 10};  // of the sines of editions 1 to 3
    for (const double number : o_.numbers())
      if (number > 0) scales.insert(scales.end(), {1 / number, number});
    for (const double scale : scales)
      if (std::string made = checker(scale); !made.empty()) return made;
    return noise();
  }

 private:
  std::vector<Vec3d> value(const std::vector<book::surface_point>& points) {
    return values_at(points, [&](const auto& at) { return r_.program.value(t_, at); });
  }
  /// "": its squares are not those of the books.
  std::string checker(double scale) {
    std::vector<book::surface_point> points;
    std::vector<std::size_t> parity;
    while (points.size() < 400) {
      const Vec3d q = random_.between(0, 20) * random_.on_sphere();
      const auto to_edge = [](double a) { return std::fabs(a - std::round(a)); };
      if (std::fmin(to_edge(q.x), std::fmin(to_edge(q.y), to_edge(q.z))) < 1e-3) continue;
      points.push_back({scale * q});
      parity.push_back(std::fmod(std::fabs(std::floor(q.x) + std::floor(q.y) + std::floor(q.z)), 2) < 0.5 ? 0 : 1);
    }
    const std::vector<Vec3d> values = value(points);
    std::string colours[2];
    for (std::size_t k = 0; k < values.size(); ++k) {
      std::string& known = colours[parity[k]];
      if (known.empty()) known = triple(values[k]);
      if (triple(values[k]) != known) return "";
    }
    return fmt::format("{{\"type\":\"checker\",\"scale\":{},\"even\":{},\"odd\":{}}}", scale, colours[0], colours[1]);
  }
  /// The lattice of noise is anybody's: it is told by range, mean and spread.
  std::string noise() {
    const double scale = o_.named("scale", 1);
    double sum = 0, squares = 0;
    constexpr int rounds = 6000;
    std::vector<book::surface_point> points;
    for (int k = 0; k < rounds; ++k) points.push_back({(random_.between(0, 60) / scale) * random_.on_sphere()});
    bool is_grey = true;
    for (const Vec3d& one : value(points)) {
      is_grey = is_grey && is_near(one, {one.x, one.x, one.x}, 1e-3) && one.x >= -0.01 && one.x <= 1.01;
      sum += one.x, squares += one.x * one.x;
    }
    const double mean = sum / rounds, spread = std::sqrt(squares / rounds - mean * mean);
    const bool is_marble = spread > 0.27 && spread<0.39, is_plain = spread> 0.06 && spread < 0.2;
    if (!is_grey || !(std::fabs(mean - 0.5) <= 0.06) || !(is_marble || is_plain))
      o_.refuse("no such texture in Tyndall");
    r_.picture.has_noise = true;
    return fmt::format("{{\"type\":\"noise\",\"style\":\"{}\",\"scale\":{}}}", is_marble ? "marble" : "perlin", scale);
  }

  Reading& r_;
  const void* t_;
  const Described& o_;
  RandomNumbers random_;
};

}  // namespace

std::string material_name(Reading& reading, const void* material) {
  return reading.name_of(material, reading.described('m', material).class_name, reading.materials,
                         [&] { return MaterialReader(reading, material).text(); });
}
std::string medium_colour(Reading& reading, const void* material) {
  return MaterialReader(reading, material).medium_albedo();
}
std::string texture_name(Reading& reading, const void* texture) {
  return reading.name_of(texture, reading.described('t', texture).class_name, reading.textures,
                         [&] { return TextureReader(reading, texture).text(); });
}

}  // namespace tyndall
